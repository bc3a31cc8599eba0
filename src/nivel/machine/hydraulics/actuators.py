"""Cylinders and rotary actuators in words."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.machine.core.between import Ends
from nivel.machine.core.checked import Checked, Problem, superfluous
from nivel.machine.core.coefficient import (
    Damping,
    Displacement,
    HeatTransfer,
    Leakage,
    NotNegativeForce,
    NotNegativeNumber,
    PositiveSpeed,
    Pressure,
    Restitution,
    Share,
    ThermalConductance,
    Volume,
)
from nivel.machine.core.record import Name, entry
from nivel.machine.given import Field, ManyNumbers, Maybe, OneNumber, OneRecord, Usual
from nivel.machine.hydraulics.component import Component, Rating
from nivel.machine.hydraulics.usual import DIAMETER, HEAT_TRANSFER, PISTON_SPEED, PRESSURE, STROKE, VOLUME, WALL_MODULUS
from nivel.machine.units.quantity import Angle, PositiveLength, Quantity, listed
from nivel.machine.uses.coordinate_reference import CoordinateReference

StopStiffness = Annotated[OneNumber, Quantity(("stiffness", "torsional stiffness"), positive=True)]
SINGLE = ("single", "plunger")  # what has no chamber B
DEAD_SHARE = 0.02  # of the swept volume, that is left at the end of the stroke where nothing is said
MOST_STAGES = 5


class PistonFriction(Checked):
    """(F_c + (static - 1) F_c exp(-(v/v_s)²)) tanh(v/v_t) + viscous v, with F_c = sliding + by_pressure |p_A - p_B| A_A."""

    sliding: NotNegativeForce = Field(default=0.0, description="without pressure")
    by_pressure: NotNegativeNumber = Field(default=0.0, description="friction over the force of the pressure, by seals")
    static: Annotated[OneNumber, Quantity("number")] = Field(default=1.0, description="static over sliding friction")
    stribeck_speed: PositiveSpeed = Field(default=0.02, description="v_s: speed over which the static part falls")
    transition_speed: PositiveSpeed = Field(default=0.004, description="v_t: speed over which it changes its sign")
    viscous: Damping = Field(default=0.0)

    def problems(self) -> Iterator[Problem]:
        if self.static < 1.0:
            yield Problem(("static",), f"static friction is at least the sliding one: 1 or more, got {self.static:g}")


class Cushion(Rating):
    """The outlet of a chamber is throttled on the last part of the stroke; a check valve beside it lets fluid in."""

    length: PositiveLength = Field(description="of the part of the stroke that is cushioned")
    least_opening: Share = Field(default=0.02, description="share of the opening that is left at the end")
    port_volume: Volume = Field(default=1e-4, description="of the fluid between the cushion and what is connected")

    def problems(self) -> Iterator[Problem]:
        yield from self.problems_of_rating()


class Actuator(Component):
    """What all actuators share: chambers, the ends of the stroke, and their start."""

    early: ClassVar[tuple[str, ...]] = ("pressure_A", "pressure_B", "position", "speed")
    late: ClassVar[tuple[str, ...]] = ("force", "power", "friction")
    gases: ClassVar[bool] = True
    usual: ClassVar[Mapping[str, Usual]] = {**Component.usual, "speed": PISTON_SPEED}

    dead_volume_A: Maybe[Volume] = Field(
        default=None,
        description="of A, with its hose, at the start of the stroke; default 2 % of what is swept",
        usual=VOLUME,
    )
    dead_volume_B: Maybe[Volume] = Field(
        default=None,
        description="of B, with its hose, at the end of the stroke; default 2 % of what is swept",
        usual=VOLUME,
    )
    wall_modulus: Maybe[Pressure] = Field(
        default=None, description="as of a volume, of dead volumes with their hoses", usual=WALL_MODULUS
    )
    heat_conductance: Maybe[ThermalConductance] = Field(
        default=None, description="of the walls of each chamber, as of a volume"
    )
    start_A: Maybe[Pressure] = Field(
        default=None, description="pressure in A at the start; default: what carries the load", usual=PRESSURE
    )
    start_B: Maybe[Pressure] = Field(
        default=None, description="pressure in B at the start; default: what carries the load", usual=PRESSURE
    )
    stop_stiffness: StopStiffness = Field(default=2e8, description="of the ends of the stroke")
    stop_restitution: Restitution = Field(default=0.2, description="speed after over speed before the end is met")
    fluid: Name | None = Field(default=None, description="default: the only one")

    @property
    def inlets(self) -> tuple[str, ...]:
        return ()

    @property
    def chambers(self) -> tuple[str, ...]:
        """A, or A and B."""
        return ("A", "B")

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        single = entry(data, "acting") in SINGLE or ".B" not in cls.nodes
        return tuple(each for each in (*cls.early, *cls.late) if not (single and each == "pressure_B"))


class HydraulicCylinder(Ends, Actuator):
    """A cylinder between two points, its rod to the second one; double or single acting, or a plunger: then B is open to the air.

    With `ports`, its chambers are parts of volumes; without, they are volumes of their own: NAME.A (piston side) and NAME.B.
    """

    may: ClassVar[tuple[str, ...]] = ("A", "B")
    nodes: ClassVar[tuple[str, ...]] = (".A", ".B")

    type: Literal["cylinder"] = "cylinder"
    piston: PositiveLength = Field(description="diameter", usual=DIAMETER)
    rod: Annotated[OneNumber, Quantity("length")] = Field(default=0.0, description="diameter")
    stroke: PositiveLength = Field(usual=STROKE)
    retracted_length: PositiveLength = Field(
        description="distance of its ends at the start of the stroke", usual=STROKE
    )
    acting: Literal["double", "single", "plunger"] = "double"
    seal_leakage: Leakage = Field(default=0.0, description="flow from A to B past the piston, laminar")
    friction: Maybe[OneRecord[PistonFriction]] = Field(default=None)
    heat_transfer: Maybe[HeatTransfer] = Field(
        default=None,
        description="of gases: heat over the area of the walls of a chamber and the difference of temperature; not with `heat_conductance`",
        usual=HEAT_TRANSFER,
    )
    cushion_A: Maybe[OneRecord[Cushion]] = Field(default=None, description="at the start of the stroke")
    cushion_B: Maybe[OneRecord[Cushion]] = Field(default=None, description="at the end of the stroke")

    @property
    def chambers(self) -> tuple[str, ...]:
        return ("A", "B") if self.acting == "double" else ("A",)

    @property
    def areas(self) -> tuple[float, float]:
        """[m²] of the piston, and of the ring around the rod."""
        whole = 0.25 * math.pi * self.piston**2
        return whole, whole - 0.25 * math.pi * self.rod**2

    def walls(self, chamber: str) -> tuple[float, float]:
        """Of a chamber the area of its ends [m²], and the area of bore and rod over its volume [1/m]."""
        inner = self.rod if chamber == "B" else 0.0
        area = self.areas[("A", "B").index(chamber)]
        return 2.0 * area, math.pi * (self.piston + inner) / area

    def problems(self) -> Iterator[Problem]:
        yield from Ends.problems(self)
        yield from self.problems_of_line()
        yield from self.problems_of_ports((), self.chambers)
        if self.heat_transfer is not None and self.heat_conductance is not None:
            yield superfluous("heat_conductance", "stands in place of `heat_transfer`; give one of them")
        if not 0.0 <= self.rod < self.piston:
            yield Problem(("rod",), f"a rod is thinner than its piston of {self.piston:g} m, got {self.rod:g} m")
        if self.acting == "plunger" and self.rod:
            yield superfluous("rod", "belongs to a piston; a plunger is as thick as `piston` says")
        if self.acting in SINGLE:
            if self.seal_leakage:
                yield superfluous(
                    "seal_leakage", "belongs to a double-acting cylinder; here it would leave the circuit"
                )
            for name in ("dead_volume_B", "start_B", "cushion_B"):
                if getattr(self, name) is not None:
                    yield superfluous(name, "belongs to a double-acting cylinder; B is open to the air")
        for chamber in self.chambers:
            if getattr(self, f"cushion_{chamber}") is not None and chamber in self.ports:
                yield superfluous(f"cushion_{chamber}", f"needs a chamber of its own; leave port {chamber} to others")


class TelescopicCylinder(Ends, Actuator):
    """A single-acting telescope between two points; stages move one after the other, the largest first."""

    may: ClassVar[tuple[str, ...]] = ("A",)
    nodes: ClassVar[tuple[str, ...]] = (".A",)

    type: Literal["telescopic-cylinder"] = "telescopic-cylinder"
    stages: Annotated[ManyNumbers[PositiveLength], BeforeValidator(listed)] = Field(
        description="diameters, falling", usual=DIAMETER
    )
    strokes: Annotated[ManyNumbers[PositiveLength], BeforeValidator(listed)] = Field(
        description="of each stage", usual=STROKE
    )
    transition: PositiveLength = Field(default=5e-3, description="stroke over which one stage passes to the next")
    retracted_length: PositiveLength = Field(
        description="distance of its ends at the start of the stroke", usual=STROKE
    )
    friction: Maybe[OneRecord[PistonFriction]] = Field(default=None)

    @property
    def chambers(self) -> tuple[str, ...]:
        return ("A",)

    @property
    def stroke(self) -> float:
        """[m] of all stages."""
        return sum(self.strokes)

    @property
    def areas(self) -> tuple[float, ...]:
        """[m²] of the stages."""
        return tuple(0.25 * math.pi * diameter**2 for diameter in self.stages)

    def problems(self) -> Iterator[Problem]:
        yield from Ends.problems(self)
        yield from self.problems_of_line()
        yield from self.problems_of_ports((), self.chambers)
        if len(self.stages) != len(self.strokes) or not 1 <= len(self.stages) <= MOST_STAGES:
            yield Problem(
                ("strokes",),
                f"as many strokes as stages, at most {MOST_STAGES}, were expected, got {len(self.strokes)}",
            )
        elif list(self.stages) != sorted(set(self.stages), reverse=True):
            yield Problem(("stages",), "diameters that fall from stage to stage were expected")
        for name in ("dead_volume_B", "start_B"):
            if getattr(self, name) is not None:
                yield superfluous(name, "belongs to a double-acting cylinder; a telescope has A alone")


class RotaryActuator(Actuator):
    """A vane or rack that turns a joint: A drives its angle up, B down."""

    may: ClassVar[tuple[str, ...]] = ("A", "B")
    nodes: ClassVar[tuple[str, ...]] = (".A", ".B")

    usual: ClassVar[Mapping[str, Usual]] = Component.usual

    type: Literal["rotary-actuator"] = "rotary-actuator"
    coordinate: CoordinateReference = Field(description="angle of a joint")
    displacement: Displacement
    lower: Angle = Field(description="angle at the start of the stroke")
    upper: Angle = Field(description="angle at its end")
    seal_leakage: Leakage = Field(default=0.0, description="flow from A to B past the vane, laminar")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.upper <= self.lower:
            yield Problem(
                ("upper",), f"an angle above `lower`, {self.lower:g} rad, was expected, got {self.upper:g} rad"
            )
