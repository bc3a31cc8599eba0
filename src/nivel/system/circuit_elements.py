"""Circuits of a machine while it is built: their nodes, their elements with rows, and the kernels that these need."""

from typing import Final

from nivel.elements.circuits import COMPONENTS
from nivel.elements.circuits.chambers import Actuator, add_actuator, chamber_node, swept_by_node
from nivel.elements.circuits.coolers import find_warm_pressures, warm
from nivel.elements.circuits.density import START, fluid_constants
from nivel.elements.circuits.fluids import OIL, Fluid, Gas
from nivel.elements.circuits.gases import find_gas_pressures
from nivel.elements.circuits.kind import PHASES
from nivel.elements.circuits.ledger import balance_ledger, begin_ledger
from nivel.elements.circuits.nodes import is_warm
from nivel.elements.circuits.restrictions import restrict_gas
from nivel.elements.circuits.tanks import Tank
from nivel.elements.circuits.volumes import GIVEN, SIGNAL, find_pressures
from nivel.elements.facts import Coupled, StateFact
from nivel.errors import located
from nivel.known import Component, Family, MachineRecord, SystemBuilder
from nivel.machine.uses.hydraulic_uses import makers

OF_NODES: Final = (begin_ledger, find_pressures, balance_ledger)  # of every circuit
OF_WARMTH: Final = (find_warm_pressures, warm)  # of liquids whose temperature is a state, before the ledger
OF_GASES: Final = (find_gas_pressures, restrict_gas)
LEDGER: Final = {
    "supplied": ("J", "energy that shafts and tanks gave to fluids"),
    "delivered": ("J", "energy that fluids gave to bodies"),
    "lost": ("J", "energy that fluids lost"),
    "taken_in": ("kg", "mass that tanks gave to volumes"),
}


def families() -> list[Family]:
    """All kernels of circuits."""
    of_kinds = (family for kind in COMPONENTS.values() for family in kind.families)
    return [*dict.fromkeys((*OF_WARMTH, *OF_NODES, *OF_GASES, *of_kinds))]


def sensed_and_acting(machine: MachineRecord) -> tuple[list[Family], list[Family]]:
    """The kernels of a machine before and after a control, in the order of an evaluation."""
    every = families_of(machine)
    sensed = [each for each in every if PHASES[each][0].sensed]
    return sensed, every[len(sensed) :]


def families_of(machine: MachineRecord) -> list[Family]:
    """The kernels that the circuits of a machine may need, in the order of an evaluation."""
    kinds = (COMPONENTS[each.type] for each in machine.hydraulics)
    needed = {*OF_NODES, *(family for kind in kinds for family in kind.families)}
    if any(isinstance(fluid, Gas) for fluid in machine.fluids):
        needed.update(OF_GASES)
    if any(isinstance(fluid, Fluid) and not fluid.isothermal for fluid in machine.fluids):
        needed.update(OF_WARMTH)
    return sorted(needed, key=lambda family: (*PHASES[family], family.module))


def without_slopes(machine: MachineRecord) -> list[Component]:
    """The components of a machine whose derivatives are not known by hand."""
    return [each for each in machine.hydraulics if not COMPONENTS[each.type].has_slopes]


def has_slopes(machine: MachineRecord) -> bool:
    """Whether the derivatives of all its circuits are known by hand; those of gases are not."""
    return not without_slopes(machine) and not any(isinstance(fluid, Gas) for fluid in machine.fluids)


def add_circuits(builder: SystemBuilder) -> None:
    """Fluids, nodes and pressures of all circuits of a machine, and its pistons."""
    add_fluids(builder)
    add_nodes(builder)
    _add_pressures(builder)
    for component in builder.machine.hydraulics:
        if (present := COMPONENTS[component.type].present) is not None:
            with located(f"hydraulics.{component.name}"), builder.noting():
                present(builder, component)


def add_components(builder: SystemBuilder) -> None:
    """What flows through and acts, after the control that steers it."""
    # positions of valves and torques of pumps before what reads them
    for component in sorted(builder.machine.hydraulics, key=lambda each: COMPONENTS[each.type].last):
        if (add := COMPONENTS[component.type].add) is not None:
            with located(f"hydraulics.{component.name}"), builder.noting():
                add(builder, component)
            _know_late(builder, component)


def _add_pressures(builder: SystemBuilder) -> None:
    builder.elements.add(begin_ledger, [])
    given = {each.name: each for each in builder.machine.hydraulics if isinstance(each, Tank)}
    for k, node in enumerate(builder.circuit.nodes.values()):
        function, temperature = 0, 0
        if node.kind == GIVEN:
            with located(f"hydraulics.{node.owner}.pressure"), builder.noting():
                function = builder.function(given[node.owner].pressure)
            if is_warm(builder, node.fluid):
                with located(f"hydraulics.{node.owner}.temperature"), builder.noting():
                    known = given[node.owner].temperature
                    temperature = builder.function(
                        builder.circuit.fluids[node.fluid][START] if known is None else known
                    )
        if node.gas:
            builder.elements.add(
                find_gas_pressures,
                [node.output, k, node.kind, node.state, function, node.energy],
                [node.walls, node.walls_by_volume],
            )
        elif is_warm(builder, node.fluid) and node.kind != SIGNAL:
            columns = [node.output, k, node.kind, node.state, function, temperature]
            builder.elements.add(find_warm_pressures, columns)
            if node.is_volume:
                builder.elements.add(warm, columns, [node.walls])
        else:
            builder.elements.add(find_pressures, [node.output, k, node.kind, node.state, function])


def _know_late(builder: SystemBuilder, component: Component) -> None:
    """What a component reports, as signals."""
    coupled, start = builder.noted[-1], f"hydraulics.{component.name}."
    for k, (name, _, _) in enumerate(builder.outputs.entries):
        if name.startswith(start):
            builder.circuit.signals.setdefault(name.removeprefix("hydraulics."), (k, coupled))


def add_ledger(builder: SystemBuilder) -> None:
    """Three energies and a mass as states that nothing depends on, behind all other states of the machine."""
    first = builder.outputs.add(("hydraulics.stored", "J", "energy stored in fluids, hoses and accumulators"))
    states = []
    for name, (units, words) in LEDGER.items():
        fact = StateFact(f"hydraulics.{name}", units, words, 0.0, 1.0, integral=True)
        with builder.noting():
            states.append(builder.own_state(fact))
    builder.elements.add(balance_ledger, [first, states[0]])


def add_fluids(builder: SystemBuilder) -> None:
    """Rows of constants, and the fluid of each component: its own, or that of what it is connected to."""
    machine, circuit = builder.machine, builder.circuit
    for fluid in machine.fluids or (OIL,):
        circuit.fluids.append(fluid_constants(fluid))
    numbers, by_node = {fluid.name: k for k, fluid in enumerate(machine.fluids)}, makers(machine.hydraulics)
    for component in machine.hydraulics:
        asked = [component] if "fluid" in type(component).model_fields else map(by_node.get, component.ports.values())
        named = (name for each in asked if (name := getattr(each, "fluid", None)) is not None)
        circuit.fluid[component.name] = numbers.get(next(named, ""), 0)


def add_nodes(builder: SystemBuilder) -> None:
    """All nodes, and chambers of actuators with their pistons."""
    components = builder.machine.hydraulics
    swept = swept_by_node(components)
    for component in components:
        with located(f"hydraulics.{component.name}"):
            make = COMPONENTS[component.type].nodes
            for node in make(builder, component, swept) if make is not None else ():
                builder.circuit.nodes[node.name] = node
    for component in components:
        if isinstance(component, Actuator):
            with located(f"hydraulics.{component.name}"), builder.within(f"hydraulics.{component.name}"):
                add_actuator(builder, component)
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
            for chamber in component.chamber_areas:
                name = chamber_node(component, chamber)
                builder.node(name)
                circuit.signals[f"{component.name}.pressure_{chamber}"] = (
                    circuit.nodes[name].output,
                    circuit.depends[name],
                )
        for node in circuit.nodes.values():
            if node.owner == component.name:
                circuit.depends.setdefault(node.name, Coupled(frozenset(), node.states))
