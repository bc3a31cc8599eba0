"""Nodes of a circuit in numbers: volumes, chambers of actuators, given pressures, signals."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from nivel.elements.restitution import damping_of_restitution
from nivel.elements.states import Coupled, StateFact
from nivel.kernels.bodies.coordinate import DISTANCE
from nivel.kernels.hydraulics import volume
from nivel.kernels.hydraulics.fluid import ATMOSPHERE, HEAT_CAPACITY, START
from nivel.kernels.hydraulics.piston import STAGES, displace, guide, press
from nivel.kernels.record.record import NONE
from nivel.machine.core.between import Ends
from nivel.machine.hydraulics import (
    Accumulator,
    Actuator,
    Component,
    Fluid,
    Gas,
    HoseExpansion,
    HydraulicCylinder,
    Line,
    LoadSensing,
    Reservoir,
    RotaryActuator,
    Tank,
    TelescopicCylinder,
    Tube,
    Volume,
)
from nivel.machine.hydraulics.actuators import DEAD_SHARE, PistonFriction
from nivel.machine.hydraulics.fluid import OIL, REFERENCE_PRESSURE, REFERENCE_TEMPERATURE
from nivel.machine.hydraulics.grades import GRADES
from nivel.machine.hydraulics.nodes import ROOM
from nivel.machine.uses.hydraulic_uses import makers
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics.circuit import FLUID, Node
from nivel.system.hydraulics.fluid_law import density_and_modulus
from nivel.system.hydraulics.nitrogen_gas import nitrogen_room
from nivel.system.located import located

# pressure that the tolerance is a share of [Pa], and that masses start from until the circuit is at rest
TYPICAL = 1e7
TYPICAL_OF_GAS = 5e5
# share of a closed reservoir that oil fills in any case; pressure by which the air of an open one gives way [Pa]
LEAST_OIL, OPEN = 1e-3, 1e-3
Swept = dict[str, float]  # what pistons leave open in each node at half their strokes [m³]
NodeMaker = Callable[[SystemBuilder, Any, Swept], Iterator[Node]]
NO_GAS = (0.0, 0.0, 0.0, 0.0)  # constants of gases, of a liquid
NO_ACCUMULATOR = (0.0, 1.0, 1.0)  # GAS, PRECHARGE, EXPONENT of `Circuit.room`
RIGID = (0.0, 0.0, 0.0, 1.0, 1.0)  # of `Circuit.room`: no volume, no wall, no gas


def add_fluids(builder: SystemBuilder) -> None:
    """Rows of constants."""
    for fluid in builder.machine.fluids or (OIL,):
        builder.circuit.fluids.append(fluid_constants(fluid))


def fluid_constants(fluid: Fluid | Gas) -> tuple[float, ...]:
    """A row of `Circuit.fluid`: constants of liquids, then of gases. A gas at T₀ is as a liquid that is all air."""
    if isinstance(fluid, Gas):
        density = ATMOSPHERE / (fluid.gas_constant * fluid.temperature)
        reference = REFERENCE_PRESSURE / (fluid.gas_constant * math.sqrt(REFERENCE_TEMPERATURE))
        of_gas = (fluid.gas_constant, fluid.heat_capacity_ratio, fluid.temperature, reference)
        return (1.0, ATMOSPHERE, 0.0, 1.0, density, 0.0, *of_gas, *[0.0] * (FLUID - 10))
    liquid = fluid.liquid
    of_liquid = (fluid.air, liquid.bulk_modulus, liquid.bulk_modulus_slope, fluid.gas_exponent)
    released = (fluid.dissolved_air, fluid.saturation_pressure, fluid.least_pressure, liquid.pressure_viscosity)
    return (*of_liquid, fluid.mixed_density, liquid.viscosity, *NO_GAS, *released, *_constants_of_warmth(fluid))


def _constants_of_warmth(fluid: Fluid) -> tuple[float, ...]:
    """HEAT_CAPACITY … AROUND of a liquid. Air that is in it has its temperature, and no heat capacity."""
    start = fluid.temperature
    if fluid.isothermal or fluid.grade is None:
        return (0.0, 0.0, start, 0.0, 0.0, 1.0, start)
    grade, liquid = GRADES[fluid.grade], fluid.liquid
    walther = (*grade.walther, 1e-6 / grade.viscosity(start))
    return (liquid.heat_capacity, liquid.expansion, start, *walther, fluid.surroundings or ROOM)


def add_nodes(builder: SystemBuilder, makers: Mapping[str, NodeMaker]) -> None:
    """All nodes, and chambers of actuators with their pistons. makers : of the nodes of components, by type."""
    components = builder.machine.hydraulics
    swept = _swept_by_node(components)
    for component in components:
        with located(f"hydraulics.{component.name}"):
            for node in makers[component.type](builder, component, swept) if component.type in makers else ():
                builder.circuit.nodes[node.name] = node
    for component in components:
        if isinstance(component, Actuator):
            with located(f"hydraulics.{component.name}"), builder.within(f"hydraulics.{component.name}"):
                _add_actuator(builder, component)
    for component in components:
        _know_pressures(builder, component)


def _know_pressures(builder: SystemBuilder, component: Component) -> None:
    """Pressures as signals; and of actuators, what their forces depend on, now that all that moves a node is known."""
    circuit = builder.circuit
    for node in circuit.nodes.values():
        if node.owner == component.name and not isinstance(component, Actuator):
            circuit.depends.setdefault(node.name, Coupled(frozenset(), node.states))
            circuit.signals[f"{component.name}.{node.quantity}"] = (node.output, circuit.depends[node.name])
    if isinstance(component, Actuator):
        with builder.noting():
            for chamber in _sweep(component)[1]:
                name = chamber_node(component, chamber)
                builder.node(name)
                circuit.signals[f"{component.name}.pressure_{chamber}"] = (
                    circuit.nodes[name].output,
                    circuit.depends[name],
                )
        for node in circuit.nodes.values():
            if node.owner == component.name:
                circuit.depends.setdefault(node.name, Coupled(frozenset(), node.states))


def volume_nodes(builder: SystemBuilder, component: Volume, swept: Swept) -> Iterator[Node]:
    """The node that a volume is."""
    compliance = _compliance(component.volume, component.wall_modulus)
    room = (component.volume, compliance, *NO_ACCUMULATOR, *hose_points(component.expansion, 1.0))
    walls = (component.heat_transfer or 0.0) * (component.surface or 0.0)
    yield _volume(builder, component, component.name, "", room, component.start, swept, (walls, 0.0))


def tube_nodes(builder: SystemBuilder, component: Tube, swept: Swept) -> Iterator[Node]:
    """The volumes of the segments of a tube of gas."""
    length = component.length / component.segments
    room = (0.25 * math.pi * component.diameter**2 * length, 0.0, *NO_ACCUMULATOR)
    walls = component.heat_transfer * math.pi * component.diameter * length
    for k in range(component.segments):
        name = f"{component.name}.{k + 1}"
        yield _volume(builder, component, name, f"_{k + 1}", room, component.start, swept, (walls, 0.0))


def hose_points(expansion: HoseExpansion | None, length: float) -> list[float]:
    """POINTS … of `Circuit.room`: the growth of a hose of this length [m], or of a whole one."""
    if expansion is None:
        return []
    pairs = zip(expansion.pressures, expansion.volumes, strict=True)
    points = [number for p, volume in pairs for number in (p + ATMOSPHERE, volume * length)]
    return [float(len(expansion.pressures)), *points]


def line_nodes(builder: SystemBuilder, component: Line, swept: Swept) -> Iterator[Node]:
    """The volumes of the segments of a line."""
    length = component.length / component.segments
    for k, area in enumerate(component.areas_of_segments):
        size = area * length
        curve = hose_points(component.expansion, length)
        room = (size, _compliance(size, component.wall_modulus), *NO_ACCUMULATOR, *curve)
        yield _volume(builder, component, f"{component.name}.{k + 1}", f"_{k + 1}", room, component.start, swept)


def accumulator_nodes(builder: SystemBuilder, component: Accumulator, swept: Swept) -> Iterator[Node]:
    """The node behind the inlet of an accumulator."""
    dead = component.dead_volume or DEAD_SHARE * component.volume
    if component.gas == "nitrogen":
        room = nitrogen_room(dead, component.volume, component.precharge, component.temperature, component.start)
    else:
        room = (dead, 0.0, component.volume, first_charge(component), component.exponent)
    yield _volume(builder, component, component.name, "", room, component.start, swept)


def first_charge(component: Accumulator) -> float:
    """The precharge; with a thermal time that of the compression without heat that ends at the start at the temperature around it."""
    if component.thermal_time is None or component.start is None:
        return component.precharge
    return component.precharge * min(1.0, component.precharge / component.start) ** (component.exponent - 1.0)


def tank_nodes(builder: SystemBuilder, component: Tank, _: Swept) -> Iterator[Node]:
    """A node of given pressure."""
    fluid, name = _fluid(builder, component), component.name
    gas = _gas(builder, fluid) is not None
    output = _pressure_output(builder, name, "pressure", "temperature" if gas or is_warm(builder, fluid) else "")
    yield Node(name, volume.GIVEN, fluid, NONE, RIGID, 0.0, None, name, output, gas)


def reservoir_nodes(builder: SystemBuilder, component: Reservoir, swept: Swept) -> Iterator[Node]:
    """The liquid of a reservoir. Its room is the air: closed in, the gas of an accumulator that would be empty at `pressure`; that of an
    open one gives way within OPEN of the pressure."""
    air = component.volume - component.oil
    if component.closed:
        exponent, gas = component.gas_exponent or 1.0, (1.0 - LEAST_OIL) * component.volume
        room = (component.volume - gas, 0.0, gas, component.pressure * (air / gas) ** exponent, exponent)
    else:
        room = (component.oil, component.volume / OPEN, *NO_ACCUMULATOR)
    yield _volume(builder, component, component.name, "", room, component.pressure, swept)


def signal_nodes(builder: SystemBuilder, component: LoadSensing, _: Swept) -> Iterator[Node]:
    """A node whose pressure is a signal."""
    name = component.name
    output = _pressure_output(builder, name, "pressure")
    state = builder.own_state(StateFact(f"{name}.pressure", "Pa", f"load signal of {name}", ATMOSPHERE, TYPICAL))
    yield Node(name, volume.SIGNAL, 0, state, RIGID, 0.0, None, name, output)


def chamber_nodes(builder: SystemBuilder, component: Actuator, swept: Swept) -> Iterator[Node]:
    """The chambers of an actuator that are no parts of other volumes, and what is between a cushion and its port."""
    for chamber, dead in _dead_volumes(component).items():
        if chamber in component.ports:
            continue
        start = getattr(component, f"start_{chamber}")
        cushion = getattr(component, f"cushion_{chamber}", None)
        room = (dead, _compliance(dead, component.wall_modulus), 0.0, 1.0, 1.0)
        inner = chamber_node(component, chamber)
        transfer, ends = getattr(component, "heat_transfer", None), (0.0, 0.0)
        if transfer is not None:
            ends = component.walls(chamber)  # type: ignore[attr-defined]
        walls = tuple((transfer or 0.0) * each for each in ends)
        yield _volume(builder, component, inner, f"_{chamber}", room, start, swept, walls)
        if cushion is not None:
            room = (cushion.port_volume, 0.0, 0.0, 1.0, 1.0)
            yield _volume(builder, component, f"{component.name}.{chamber}", f"_port_{chamber}", room, start, swept)


def inner_nodes(*names: str) -> NodeMaker:
    """Small volumes within a valve, NAME.C of a name C, each of the size `inner_volume`."""

    def make(builder: SystemBuilder, component: Any, swept: Swept) -> Iterator[Node]:
        room = (component.inner_volume, 0.0, 0.0, 1.0, 1.0)
        for name in names:
            if f".{name}" in component.nodes_in(component):
                yield _volume(builder, component, f"{component.name}.{name}", f"_{name}", room, None, swept)

    return make


def chamber_node(component: Actuator, chamber: str) -> str:
    """Name of the node that a chamber is, or is a part of."""
    if getattr(component, f"cushion_{chamber}", None) is not None:
        return f"{component.name}.chamber_{chamber}"
    return component.ports.get(chamber, f"{component.name}.{chamber}")


def _volume(
    builder: SystemBuilder,
    component: Component,
    name: str,
    ending: str,
    room: tuple[float, ...],
    start: float | None,
    swept: Swept,
    more_walls: tuple[float, ...] = (0.0, 0.0),
) -> Node:
    """A node with mass, at first at TYPICAL pressure. more_walls : beside its `heat_conductance`, as in `Node`."""
    fluid = _fluid(builder, component)
    constants = builder.circuit.fluids[fluid]
    size = room[0] + swept.get(name, 0.0)
    gas = _gas(builder, fluid)
    typical = TYPICAL if gas is None else TYPICAL_OF_GAS
    density, modulus = density_and_modulus(constants, typical)
    scale = density * size / modulus * typical
    fact = StateFact(
        f"{component.name}.mass{ending}",
        "kg",
        f"mass of the fluid in {name}",
        start=density * size,
        scale=scale,
        relative=False,
    )
    warmer = isinstance(component, Reservoir) or gas is not None or is_warm(builder, fluid)
    named = "oil_temperature" if isinstance(component, Accumulator) else f"temperature{ending}"
    output = _pressure_output(builder, component.name, f"pressure{ending}", named if warmer else "")
    state, energy, walls = builder.own_state(fact), NONE, getattr(component, "heat_conductance", None) or 0.0
    if gas is not None and not gas.isothermal:
        inner = scale * gas.temperature * gas.gas_constant / (gas.heat_capacity_ratio - 1.0)
        words = f"inner energy of the gas in {name}"
        energy = builder.own_state(
            StateFact(f"{component.name}.energy{ending}", "J", words, inner, inner, relative=False)
        )
    warmth = _add_warmth(builder, component, name, ending) if is_warm(builder, fluid) else NONE
    return Node(
        name,
        volume.VOLUME,
        fluid,
        state,
        room,
        size - room[0],
        start,
        component.name,
        output,
        gas=gas is not None,
        energy=energy,
        warmth=warmth,
        walls=walls + more_walls[0],
        walls_by_volume=more_walls[1],
        quantity=f"pressure{ending}",
    )


def _add_warmth(builder: SystemBuilder, component: Component, node: str, ending: str) -> int:
    """The state of the temperature of a liquid."""
    words = f"temperature of the fluid in {node}, expanded to atmospheric pressure without heat"
    start = builder.circuit.fluids[_fluid(builder, component)][START]
    fact = StateFact(f"{component.name}.temperature{ending}", "K", words, start, start, relative=False)
    return builder.own_state(fact)


def is_warm(builder: SystemBuilder, fluid: int) -> bool:
    """Whether the temperature of a liquid of this number is a state of its volumes."""
    return builder.circuit.fluids[fluid][HEAT_CAPACITY] > 0.0


def _pressure_output(builder: SystemBuilder, name: str, quantity: str, temperature: str = "") -> int:
    """Index of the pressure of a node, and of its temperature behind it where that has a name."""
    words = quantity.replace("_", " in ", 1)
    first = (f"hydraulics.{name}.{quantity}", "Pa", f"{words} of {name}, absolute")
    if not temperature:
        return builder.outputs.add(first)
    said = f"{temperature.replace('_', ' ')} of {name}"
    return builder.outputs.add(first, (f"hydraulics.{name}.{temperature}", "K", said))


def _gas(builder: SystemBuilder, fluid: int) -> Gas | None:
    """The gas of this number; None where it is a liquid."""
    found = (builder.machine.fluids or (OIL,))[fluid]
    return found if isinstance(found, Gas) else None


def _fluid(builder: SystemBuilder, component: Component) -> int:
    """Number of the fluid of a component; of the volumes within a valve that of what it is connected to."""
    name = getattr(component, "fluid", None)
    if name is None and "fluid" not in type(component).model_fields:
        by_node = makers(builder.machine.hydraulics)
        fluids = (getattr(by_node.get(node), "fluid", None) for node in component.ports.values())
        name = next((each for each in fluids if each is not None), None)
    return 0 if name is None else [fluid.name for fluid in builder.machine.fluids].index(name)


def _compliance(size: float, modulus: float | None) -> float:
    """Room that walls make per pressure [m³/Pa]."""
    return size / modulus if modulus else 0.0


def _sweep(component: Actuator) -> tuple[float, dict[str, tuple[float, ...]]]:
    """Stroke, and areas of the stages of each chamber [m², of turning ones m³/rad]."""
    match component:
        case HydraulicCylinder():
            return component.stroke, {c: (component.areas[k],) for k, c in enumerate(component.chambers)}
        case TelescopicCylinder():
            return component.stroke, {"A": component.areas}
        case RotaryActuator():
            return component.upper - component.lower, dict.fromkeys(("A", "B"), (component.displacement,))
    raise TypeError(component.type)


def stroke_of(component: Actuator) -> float:
    """Stroke [m or rad]."""
    return _sweep(component)[0]


def _dead_volumes(component: Actuator) -> dict[str, float]:
    """Of each chamber [m³]."""
    stroke, areas = _sweep(component)
    given = {chamber: getattr(component, f"dead_volume_{chamber}") for chamber in areas}
    return {chamber: given[chamber] or DEAD_SHARE * areas[chamber][0] * stroke for chamber in areas}


def _swept_by_node(components: tuple[Component, ...]) -> Swept:
    """What pistons leave open in each node at half their strokes [m³], with dead volumes of chambers that are parts of other volumes."""
    out: Swept = {}
    for component in components:
        if not isinstance(component, Actuator):
            continue
        stroke, areas = _sweep(component)
        for chamber, its in areas.items():
            node = chamber_node(component, chamber)
            dead = _dead_volumes(component)[chamber] if chamber in component.ports else 0.0
            out[node] = out.get(node, 0.0) + dead + 0.5 * its[0] * stroke
    return out


def _add_actuator(builder: SystemBuilder, component: Actuator) -> None:
    """Chambers, and the piston between them."""
    stroke, areas = _sweep(component)
    dead = _dead_volumes(component)
    with builder.noting():
        if isinstance(component, RotaryActuator):
            coordinate, origin = builder.coordinate(component.coordinate), component.lower
        else:
            assert isinstance(component, Ends)
            coordinate = builder.coordinates.add(DISTANCE, *builder.ends(component.ends))
            builder.coordinates.use(coordinate)
            origin = component.retracted_length  # type: ignore[attr-defined]
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
    """Numbers of a chamber: ORIGIN … of `nivel.kernels.hydraulics.piston`."""
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
    """COULOMB … VISCOUS of `nivel.kernels.hydraulics.piston`."""
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
    turns = isinstance(component, RotaryActuator)
    units = ("N m", "W", "rad", "rad/s", "N m") if turns else ("N", "W", "m", "m/s", "N")
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
