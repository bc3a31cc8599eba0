"""Chambers of actuators, with the pistons between them."""

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Component
from nivel.elements.circuits.kind import Swept
from nivel.elements.circuits.nodes import growth_of_walls, volume_node
from nivel.elements.circuits.pistons import STAGES, PistonFriction, displace, guide, press
from nivel.elements.contacts.impact import damping_of_restitution
from nivel.elements.facts import Coupled
from nivel.kernels.bodies.coordinate import DISTANCE
from nivel.kernels.record.record import NONE
from nivel.known import Node, SystemBuilder
from nivel.machine.core.coefficient import Restitution, ThermalConductance
from nivel.machine.core.element import Ends
from nivel.machine.core.record import Name, entry
from nivel.machine.given import Field, Maybe, OneNumber, Usual
from nivel.machine.units.quantity import Quantity

StopStiffness = Annotated[OneNumber, Quantity(("stiffness", "torsional stiffness"), positive=True)]
SINGLE = ("single", "plunger")  # what has no chamber B
DEAD_SHARE = 0.02  # of the swept volume, that is left at the end of the stroke where nothing is said


class Actuator(Component):
    """What all actuators share: chambers, the ends of the stroke, and their start."""

    early: ClassVar[tuple[str, ...]] = ("pressure_A", "pressure_B", "position", "speed")
    late: ClassVar[tuple[str, ...]] = ("force", "power", "friction")
    gases: ClassVar[bool] = True
    usual: ClassVar[Mapping[str, Usual]] = {**Component.usual, "speed": ranges.PISTON_SPEED}

    dead_volume_A: Maybe[ranges.Size] = Field(
        "of A, with its hose, at the start of the stroke; default 2 % of what is swept", default=None
    )
    dead_volume_B: Maybe[ranges.Size] = Field(
        "of B, with its hose, at the end of the stroke; default 2 % of what is swept", default=None
    )
    wall_modulus: Maybe[ranges.WallModulus] = Field("as of a volume, of dead volumes with their hoses", default=None)
    heat_conductance: Maybe[ThermalConductance] = Field("of the walls of each chamber, as of a volume", default=None)
    start_A: Maybe[ranges.Level] = Field("pressure in A at the start; default: what carries the load", default=None)
    start_B: Maybe[ranges.Level] = Field("pressure in B at the start; default: what carries the load", default=None)
    stop_stiffness: StopStiffness = Field("of the ends of the stroke", default=2e8)
    stop_restitution: Restitution = Field("speed after over speed before the end is met", default=0.2)
    fluid: Name | None = Field("default: the only one", default=None)

    @property
    def inlets(self) -> tuple[str, ...]:
        return ()

    @property
    def chambers(self) -> tuple[str, ...]:
        """A, or A and B."""
        return ("A", "B")

    @property
    def way(self) -> float:
        """Stroke [m or rad]."""
        raise NotImplementedError

    @property
    def chamber_areas(self) -> dict[str, tuple[float, ...]]:
        """Areas of the stages of each chamber [m², of turning ones m³/rad]."""
        raise NotImplementedError

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        single = entry(data, "acting") in SINGLE or ".B" not in cls.nodes
        return tuple(each for each in (*cls.early, *cls.late) if not (single and each == "pressure_B"))


def chamber_nodes(builder: SystemBuilder, component: Actuator, swept: Swept) -> Iterator[Node]:
    """The chambers of an actuator that are no parts of other volumes, and what is between a cushion and its port."""
    for chamber, dead in _dead_volumes(component).items():
        if chamber in component.ports:
            continue
        start = getattr(component, f"start_{chamber}")
        cushion = getattr(component, f"cushion_{chamber}", None)
        room = (dead, growth_of_walls(dead, component.wall_modulus), 0.0, 1.0, 1.0)
        inner = chamber_node(component, chamber)
        transfer, ends = getattr(component, "heat_transfer", None), (0.0, 0.0)
        if transfer is not None:
            ends = component.walls(chamber)  # type: ignore[attr-defined]
        walls = tuple((transfer or 0.0) * each for each in ends)
        yield volume_node(builder, component, inner, f"_{chamber}", room, start, swept, walls)
        if cushion is not None:
            room = (cushion.port_volume, 0.0, 0.0, 1.0, 1.0)
            yield volume_node(builder, component, f"{component.name}.{chamber}", f"_port_{chamber}", room, start, swept)


def chamber_place(component: Actuator, chamber: str) -> str:
    """The port that a chamber is a part of, or that within the actuator which is one."""
    if getattr(component, f"cushion_{chamber}", None) is not None:
        return f".chamber_{chamber}"
    return chamber if chamber in component.ports else f".{chamber}"


def chamber_node(component: Actuator, chamber: str) -> str:
    """Name of the node that a chamber is, or is a part of."""
    return component.node(chamber_place(component, chamber))


def _dead_volumes(component: Actuator) -> dict[str, float]:
    """Of each chamber [m³]."""
    stroke, areas = component.way, component.chamber_areas
    given = {chamber: getattr(component, f"dead_volume_{chamber}") for chamber in areas}
    return {chamber: given[chamber] or DEAD_SHARE * areas[chamber][0] * stroke for chamber in areas}


def swept_by_node(components: tuple[Component, ...]) -> Swept:
    """What pistons leave open in each node at half their strokes [m³], with dead volumes of chambers that are parts of other volumes."""
    out: Swept = {}
    for component in components:
        if not isinstance(component, Actuator):
            continue
        stroke, areas = component.way, component.chamber_areas
        for chamber, its in areas.items():
            node = chamber_node(component, chamber)
            dead = _dead_volumes(component)[chamber] if chamber in component.ports else 0.0
            out[node] = out.get(node, 0.0) + dead + 0.5 * its[0] * stroke
    return out


def add_actuator(builder: SystemBuilder, component: Actuator) -> None:
    """Chambers, and the piston between them."""
    stroke, areas = component.way, component.chamber_areas
    dead = _dead_volumes(component)
    with builder.noting():
        if isinstance(component, Ends):
            coordinate = builder.coordinates.add(DISTANCE, *builder.ends(component.ends))
            builder.coordinates.use(coordinate)
            origin = component.retracted_length  # type: ignore[attr-defined]
        else:
            coordinate, origin = builder.coordinate(component.coordinate), component.lower  # type: ignore[attr-defined]
        first = _outputs(builder, component)
        nodes = {chamber: chamber_node(component, chamber) for chamber in areas}
        for chamber, its in areas.items():
            node = builder.circuit.nodes[nodes[chamber]]
            extra = dead[chamber] if chamber in component.ports else 0.0
            numbers = _chamber_numbers(component, chamber, its, origin, stroke, extra)
            columns = [first, builder.circuit.index(node.name), coordinate]
            builder.elements.add(displace, columns, numbers)
            builder.elements.add(press, columns, numbers)
            builder.note(Coupled(frozenset(), node.states))
        ends = [builder.circuit.index(nodes[c]) if c in nodes else NONE for c in ("A", "B")]
        numbers = [origin, *_friction(component), stroke, component.stop_stiffness]
        numbers.append(damping_of_restitution(component.stop_restitution))
        builder.elements.add(guide, [first, ends[0], coordinate, ends[1]], numbers, 2, (0, 1))
    moved = builder.noted[-1]
    for node in nodes.values():
        own = Coupled(frozenset(), builder.circuit.nodes[node].states)
        known = builder.circuit.depends.get(node, own)
        builder.circuit.depends[node] = Coupled(known.bodies | moved.bodies, known.states)
    for k, quantity in enumerate(("force", "power", "position", "speed", "friction")):
        builder.circuit.signals[f"{component.name}.{quantity}"] = (first + k, moved)


def _chamber_numbers(
    component: Actuator, chamber: str, areas: tuple[float, ...], origin: float, stroke: float, dead: float
) -> list[float]:
    """Numbers of a chamber: ORIGIN … of `nivel.elements.circuits.pistons`."""
    if chamber == "B":
        return [origin, dead + areas[0] * stroke, -areas[0], 1.0, *[0.0, 0.0] * STAGES]
    out = [origin, dead, areas[0], getattr(component, "transition", 1.0)]
    at, strokes = 0.0, getattr(component, "strokes", ())
    for k in range(STAGES):
        change = areas[k + 1] - areas[k] if k + 1 < len(areas) else 0.0
        at += strokes[k] if k < len(strokes) else 0.0
        out += [change, at - 0.5 * out[3]]
    return out


def _friction(component: Actuator) -> list[float]:
    """COULOMB … VISCOUS of `nivel.elements.circuits.pistons`."""
    friction: PistonFriction | None = getattr(component, "friction", None)
    if friction is None:
        return [0.0, 0.0, 1.0, 1.0, 1.0, 0.0]
    area = component.areas[0]  # type: ignore[attr-defined]
    return [
        friction.sliding,
        friction.by_pressure * area,
        friction.static,
        friction.stribeck_speed,
        friction.transition_speed,
        friction.viscous,
    ]


def _outputs(builder: SystemBuilder, component: Actuator) -> int:
    """Index of the first output of a piston."""
    slides = isinstance(component, Ends)
    units = ("N", "W", "m", "m/s", "N") if slides else ("N m", "W", "rad", "rad/s", "N m")
    words = (
        "effort on what it moves, positive where it extends",
        "power into the machine",
        "stroke",
        "speed",
        "friction",
    )
    names = ("force", "power", "position", "speed", "friction")
    entries = [
        (f"hydraulics.{component.name}.{name}", unit, f"{word} of {component.name}")
        for name, unit, word in zip(names, units, words, strict=True)
    ]
    return builder.outputs.add(*entries)
