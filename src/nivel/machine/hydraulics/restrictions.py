"""Orifices and pipes in words."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi
from typing import Annotated, Any, ClassVar, Literal

from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import HeatTransfer, Leakage, NotNegativeNumber, Pressure, Share, Truth
from nivel.machine.core.record import Name, entry
from nivel.machine.given import Field, Maybe, OneRecord
from nivel.machine.hydraulics.component import Component, Rating, problem_of_share
from nivel.machine.hydraulics.maps import LengthExpansion
from nivel.machine.hydraulics.usual import BORE, DIFFERENCE, HEAT_TRANSFER, PIPE_LENGTH, PRESSURE, WALL_MODULUS
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import PositiveLength, Whole

MOST_SEGMENTS = 100
AIR_VISCOSITY = 18.2e-6  # Pa s, at 20 °C
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


class Line(Component):
    """A long pipe or hose in segments, each a volume, with inertia and friction that depends on the frequency between them.

    `segments` volumes NAME.1 … lie between A and B; the first and the last flow pass half of one.
    """

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("A", "B"), ("B", "A"))
    nodes: ClassVar[tuple[str, ...]] = (".1",)
    late: ClassVar[tuple[str, ...]] = ("flow_A", "flow_B")

    type: Literal["line"] = "line"
    diameter: PositiveLength = Field(usual=BORE)
    diameter_B: Maybe[PositiveLength] = Field(
        default=None, description="at B, where it changes evenly along the line", usual=BORE
    )
    length: PositiveLength = Field(usual=PIPE_LENGTH)
    segments: Whole = Field(default=10, description="number of its volumes, up to 100")
    unsteady_friction: Truth = Field(default=True, description="whether friction depends on the frequency (Zielke)")
    bends: NotNegativeNumber = Field(default=0.0, description="sum of the loss coefficients of bends and fittings")
    wall_modulus: Maybe[Pressure] = Field(default=None, description="as of a volume", usual=WALL_MODULUS)
    expansion: Maybe[OneRecord[LengthExpansion]] = Field(
        default=None, description="growth of a hose over the pressure, in place of `wall_modulus`"
    )
    start: Maybe[Pressure] = Field(
        default=None, description="pressure at the start; default: that of a steady circuit", usual=PRESSURE
    )
    fluid: Name | None = Field(default=None, description="default: the only one")

    def diameter_at(self, share: float) -> float:
        """[m] at a share of the length from A."""
        return self.diameter + share * ((self.diameter_B or self.diameter) - self.diameter)

    @property
    def areas_of_segments(self) -> list[float]:
        """[m²] in the middle of each."""
        return [0.25 * pi * self.diameter_at((k + 0.5) / self.segments) ** 2 for k in range(self.segments)]

    @classmethod
    def nodes_in(cls, data: Any) -> tuple[str, ...]:
        count = entry(data, "segments")
        return tuple(f".{k + 1}" for k in range(count if isinstance(count, int) else 10))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not 1 <= self.segments <= MOST_SEGMENTS:
            yield Problem(("segments",), f"1 to {MOST_SEGMENTS} segments were expected, got {self.segments}")
        if self.expansion is not None and self.wall_modulus is not None:
            yield superfluous("wall_modulus", "is of walls that grow evenly; `expansion` is a curve; give one of them")


class Tube(Component):
    """A tube of gas in segments, with the inertia and friction of the gas between them: pressure waves run through it with √(κ R T)."""

    gases: ClassVar[bool] = True
    liquids: ClassVar[bool] = False
    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("A", "B"), ("B", "A"))
    nodes: ClassVar[tuple[str, ...]] = (".1",)
    late: ClassVar[tuple[str, ...]] = ("flow_A", "flow_B")

    type: Literal["tube"] = "tube"
    diameter: PositiveLength = Field(description="inside", usual=BORE)
    length: PositiveLength = Field(usual=PIPE_LENGTH)
    segments: Whole = Field(default=10, description="number of its volumes, up to 100")
    bends: NotNegativeNumber = Field(default=0.0, description="sum of the loss coefficients of bends and fittings")
    heat_transfer: HeatTransfer = Field(
        default=0.0,
        description="heat over the area of its walls and the difference of temperature",
        usual=HEAT_TRANSFER,
    )
    start: Maybe[Pressure] = Field(
        default=None, description="pressure at the start; default: that of a steady circuit", usual=PRESSURE
    )
    fluid: Name | None = Field(default=None, description="default: the only one")

    @classmethod
    def nodes_in(cls, data: Any) -> tuple[str, ...]:
        count = entry(data, "segments")
        return tuple(f".{k + 1}" for k in range(count if isinstance(count, int) else 10))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not 1 <= self.segments <= MOST_SEGMENTS:
            yield Problem(("segments",), f"1 to {MOST_SEGMENTS} segments were expected, got {self.segments}")
