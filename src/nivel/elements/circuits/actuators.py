"""Cylinders and rotary actuators."""

import math
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.elements.circuits import ranges
from nivel.elements.circuits.chambers import SINGLE, Actuator, chamber_nodes, chamber_place
from nivel.elements.circuits.component import Component, Rating
from nivel.elements.circuits.composed import add_check_between
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.pistons import PistonFriction, displace, guide, press
from nivel.elements.circuits.poppets import lift
from nivel.elements.circuits.restrictions import CUSHION, TRANSITION, add_flow, rated, restrict
from nivel.elements.circuits.symbol import Symbol, path
from nivel.known import SystemBuilder
from nivel.machine.core.coefficient import Displacement, Leakage, Share, Volume
from nivel.machine.core.element import Ends
from nivel.machine.core.record import Problem, superfluous
from nivel.machine.given import Field, ManyNumbers, Maybe, OneNumber, OneRecord, Usual
from nivel.machine.units.quantity import Angle, PositiveLength, Quantity, listed
from nivel.machine.uses.coordinate_reference import CoordinateReference

MOST_STAGES = 5


class Cushion(Rating):
    """The outlet of a chamber is throttled on the last part of the stroke; a check valve beside it lets fluid in."""

    length: PositiveLength = Field("of the part of the stroke that is cushioned")
    least_opening: Share = Field("share of the opening that is left at the end", default=0.02)
    port_volume: Volume = Field("of the fluid between the cushion and what is connected", default=1e-4)

    def problems(self) -> Iterator[Problem]:
        yield from self.problems_of_rating()


class HydraulicCylinder(Ends, Actuator):
    """A cylinder between two points, its rod to the second one; double or single acting, or a plunger: then B is open to the air.

    With `ports`, its chambers are parts of volumes; without, they are volumes of their own: NAME.A (piston side) and NAME.B.
    """

    may: ClassVar[tuple[str, ...]] = ("A", "B")
    nodes: ClassVar[tuple[str, ...]] = (".A", ".B")

    type: Literal["cylinder"] = "cylinder"
    piston: PositiveLength = Field("diameter", usual=ranges.DIAMETER)
    rod: Annotated[OneNumber, Quantity("length")] = Field("diameter", default=0.0)
    stroke: ranges.Stroke = Field()
    retracted_length: ranges.Stroke = Field("distance of its ends at the start of the stroke")
    acting: Literal["double", "single", "plunger"] = "double"
    seal_leakage: Leakage = Field("flow from A to B past the piston, laminar", default=0.0)
    friction: Maybe[OneRecord[PistonFriction]] = Field(default=None)
    heat_transfer: Maybe[ranges.WallTransfer] = Field(
        "of gases: heat over the area of the walls of a chamber and the difference of temperature; not with `heat_conductance`",
        default=None,
    )
    cushion_A: Maybe[OneRecord[Cushion]] = Field("at the start of the stroke", default=None)
    cushion_B: Maybe[OneRecord[Cushion]] = Field("at the end of the stroke", default=None)

    @property
    def chambers(self) -> tuple[str, ...]:
        return ("A", "B") if self.acting == "double" else ("A",)

    @property
    def way(self) -> float:
        return self.stroke

    @property
    def chamber_areas(self) -> dict[str, tuple[float, ...]]:
        return {chamber: (area,) for chamber, area in zip(self.chambers, self.areas, strict=False)}

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
        "diameters, falling", usual=ranges.DIAMETER
    )
    strokes: Annotated[ManyNumbers[PositiveLength], BeforeValidator(listed)] = Field(
        "of each stage", usual=ranges.STROKE
    )
    transition: PositiveLength = Field("stroke over which one stage passes to the next", default=5e-3)
    retracted_length: ranges.Stroke = Field("distance of its ends at the start of the stroke")
    friction: Maybe[OneRecord[PistonFriction]] = Field(default=None)

    @property
    def chambers(self) -> tuple[str, ...]:
        return ("A",)

    @property
    def stroke(self) -> float:
        """[m] of all stages."""
        return sum(self.strokes)

    @property
    def way(self) -> float:
        return self.stroke

    @property
    def chamber_areas(self) -> dict[str, tuple[float, ...]]:
        return {"A": self.areas}

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
    coordinate: CoordinateReference = Field("angle of a joint")
    displacement: Displacement
    lower: Angle = Field("angle at the start of the stroke")
    upper: Angle = Field("angle at its end")
    seal_leakage: Leakage = Field("flow from A to B past the vane, laminar", default=0.0)

    @property
    def way(self) -> float:
        return self.upper - self.lower

    @property
    def chamber_areas(self) -> dict[str, tuple[float, ...]]:
        return dict.fromkeys(("A", "B"), (self.displacement,))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.upper <= self.lower:
            yield Problem(
                ("upper",), f"an angle above `lower`, {self.lower:g} rad, was expected, got {self.upper:g} rad"
            )


# difference of pressure at which the check valve beside a cushion opens, and from there to fully open [Pa]
CHECK, CHECK_OF_GAS = (0.5e5, 3e5), (0.05e5, 0.2e5)


def add_seal(builder: SystemBuilder, component: HydraulicCylinder | RotaryActuator) -> None:
    """The leak past a piston or vane."""
    if component.seal_leakage:
        inner = (chamber_place(component, "A"), chamber_place(component, "B"))
        add_flow(builder, component, "seal_flow", inner, [0.0, TRANSITION, component.seal_leakage])


def add_cylinder(builder: SystemBuilder, component: HydraulicCylinder) -> None:
    """The throttled outlets of a cylinder, each with a check valve beside it, and the leak past its piston."""
    add_seal(builder, component)
    for chamber in component.chambers:
        cushion = getattr(component, f"cushion_{chamber}")
        if cushion is None:
            continue
        inner, port = f".chamber_{chamber}", f".{chamber}"
        head = rated(cushion, 0.0)
        end, sign = (0.0, 1.0) if chamber == "A" else (component.stroke, -1.0)
        position, coupled = builder.circuit.signals[f"{component.name}.position"]
        builder.note(coupled)
        numbers = [*head, sign, end, cushion.length, 1.0, cushion.least_opening]
        add_flow(builder, component, f"cushion_flow_{chamber}", (inner, port), numbers, (CUSHION, position))
        spring = CHECK_OF_GAS if builder.circuit.nodes[component.node(inner)].gas else CHECK
        quantity, position = f"check_flow_{chamber}", f"check_{chamber}"
        add_check_between(builder, component, quantity, (port, inner), head, spring, position)


def cylinder(data: Mapping[str, Any]) -> Symbol:
    """A cylinder."""
    body = path("M-46 -14 H22 V14 H-46 Z M-18 -14 V14 M-12 -14 V14 M-12 -3 H48 V3 H-12 M-38 14 V22")
    if data.get("cushion_A"):
        body += path("M-26 -4 H-18 V4 H-26 Z")
    if data.get("cushion_B"):
        body += path("M-12 -6 H-4 V6 H-12 Z")
    both = data.get("acting") not in ("single", "plunger")
    if data.get("acting") == "plunger":
        body = path("M-46 -14 H22 V-8 M-46 -14 V14 H22 V8 M-34 -8 H48 V8 H-34 Z M-38 14 V22")
        return Symbol(body, 48.0, 22.0, {}, {"A": -38.0}, "actuator")
    body += path("M14 14 V22") if both else path("M-12 0 m2 9 l6 -18 l6 18 l6 -18 l6 18 l4 -9")
    return Symbol(body, 48.0, 22.0, {}, {"A": -38.0} | ({"B": 14.0} if both else {}), "actuator")


STAGES = path("M-46 -14 H6 V14 H-46 Z M-30 -14 V14 M-30 -8 H28 V8 H-30 M-22 -8 V8 M-22 -3 H48 V3 H-22 M-38 14 V22")
TELESCOPE = Symbol(STAGES, 48.0, 22.0, {}, {"A": -38.0}, "actuator")

VANE = path("M-18 6 A18 18 0 0 1 18 6 Z M0 -12 V-20 M-10 6 V22 M10 6 V22 M0 6 L8 -6")
ROTARY = Symbol(VANE, 18.0, 22.0, {}, {"A": -10.0, "B": 10.0}, "actuator")

OF_PISTONS = (displace, guide, press)
KINDS = (
    ComponentKind(HydraulicCylinder, add_cylinder, (*OF_PISTONS, lift, restrict), symbol=cylinder, nodes=chamber_nodes),
    ComponentKind(TelescopicCylinder, None, OF_PISTONS, symbol=TELESCOPE, nodes=chamber_nodes),
    ComponentKind(RotaryActuator, add_seal, (*OF_PISTONS, restrict), symbol=ROTARY, nodes=chamber_nodes),
)
