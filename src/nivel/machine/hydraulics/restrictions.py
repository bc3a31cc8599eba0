"""Orifices and pipes in words."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from nivel.machine.checked import Problem, superfluous
from nivel.machine.coefficient import Leakage, Pressure, Share, Truth, VolumeFlow
from nivel.machine.hydraulics.component import Component, problem_of_share
from nivel.machine.quantity import PositiveLength
from nivel.machine.time_function import TimeFunction, varying

Opening = Annotated[TimeFunction, varying("number")]


class Orifice(Component):
    """A restriction between two nodes: by its diameter, by a flow at a difference of pressure, or a leak alone."""

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    functions: ClassVar[tuple[str, ...]] = ("opening",)
    late: ClassVar[tuple[str, ...]] = ("flow",)

    type: Literal["orifice"] = "orifice"
    diameter: PositiveLength | None = None
    discharge_coefficient: Share = 0.65
    flow: VolumeFlow | None = Field(default=None, description="at `pressure_drop`, in place of `diameter`")
    pressure_drop: Pressure | None = Field(default=None, description="at which `flow` is measured")
    leakage: Leakage = Field(default=0.0, description="flow over the difference of pressure, laminar")
    opening: Opening = Field(default=1.0, description="from 0, closed, to 1")
    transition: Pressure = Field(default=0.5e5, description="difference of pressure below which the root is rounded")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from problem_of_share("opening", self.opening, 0.0)
        if (self.flow is None) != (self.pressure_drop is None):
            lacking = "flow" if self.flow is None else "pressure_drop"
            yield Problem((), f"`{lacking}` is missing: a flow is given at a difference of pressure")
        if self.diameter is not None and self.flow is not None:
            yield superfluous("flow", "stands in place of `diameter`; give one of them")
        if self.diameter is None and self.flow is None and not self.leakage:
            yield Problem(
                (), "`diameter`, `flow` and `pressure_drop`, or `leakage` is needed: what lets the fluid through"
            )


class Pipe(Component):
    """The loss of a round pipe, laminar and turbulent (Blasius), and the inertia of the fluid in it where that is wanted.

    The volume of the fluid belongs to the nodes at its ends.
    """

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    late: ClassVar[tuple[str, ...]] = ("flow",)

    type: Literal["pipe"] = "pipe"
    diameter: PositiveLength
    length: PositiveLength
    inertia: Truth = Field(default=False, description="whether the flow has inertia: a state")
