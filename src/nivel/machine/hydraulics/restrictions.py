"""Orifices and pipes in words."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import Leakage, Pressure, Share, Truth
from nivel.machine.given import Field, Maybe
from nivel.machine.hydraulics.component import Component, Rating, problem_of_share
from nivel.machine.hydraulics.usual import BORE, DIFFERENCE, PIPE_LENGTH
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import PositiveLength

Opening = Annotated[OneFunction, varying("number")]


class Orifice(Rating, Component):
    """A restriction between two nodes: by its diameter, by a flow at a difference of pressure, or a leak alone."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    functions: ClassVar[tuple[str, ...]] = ("opening",)
    late: ClassVar[tuple[str, ...]] = ("flow",)
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("A", "B"), ("B", "A"))

    type: Literal["orifice"] = "orifice"
    diameter: Maybe[PositiveLength] = Field(default=None, usual=BORE)
    discharge_coefficient: Share = Field(default=0.65)
    leakage: Leakage = Field(default=0.0, description="flow over the difference of pressure, laminar")
    opening: Opening = Field(default=1.0, description="from 0, closed, to 1")
    transition: Pressure = Field(
        default=0.5e5, description="difference of pressure below which the root is rounded", usual=DIFFERENCE
    )

    def problems(self) -> Iterator[Problem]:
        yield from Component.problems(self)
        yield from problem_of_share("opening", self.opening, 0.0)
        given = [name for name in ("flow", "pressure_drop", "sonic_conductance") if getattr(self, name) is not None]
        if given:
            yield from self.problems_of_rating()
        if self.diameter is not None and given:
            yield superfluous(given[0], "stands in place of `diameter`; give one of them")
        if self.diameter is None and not given and not self.leakage:
            yield Problem(
                (),
                "`diameter`, `flow` and `pressure_drop`, of gases `sonic_conductance`, or `leakage` is needed: what lets the fluid through",
            )


class Pipe(Component):
    """The loss of a round pipe, laminar and turbulent (Blasius), and the inertia of the fluid in it where that is wanted.

    The volume of the fluid belongs to the nodes at its ends.
    """

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    late: ClassVar[tuple[str, ...]] = ("flow",)
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("A", "B"), ("B", "A"))

    type: Literal["pipe"] = "pipe"
    diameter: PositiveLength = Field(usual=BORE)
    length: PositiveLength = Field(usual=PIPE_LENGTH)
    inertia: Truth = Field(default=False, description="whether the flow has inertia: a state")
