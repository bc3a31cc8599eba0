"""Elements of the circuits of a machine: the kernels that they need, and their rows."""

from __future__ import annotations

from typing import Final

from nivel.elements.states import StateFact
from nivel.kernels.hydraulics import gas, gas_flow, ledger, volume, warmth
from nivel.kernels.hydraulics.fluid import START
from nivel.kernels.hydraulics.phase import PHASES
from nivel.kernels.record.hook import Family
from nivel.machine.hydraulics import Component, Engine, Fluid, Gas, LoadSensing, Tank
from nivel.machine.machine_record import MachineRecord
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics.components import COMPONENTS
from nivel.system.hydraulics.nodes import add_fluids, add_nodes, is_warm
from nivel.system.located import located

OF_NODES: Final = (ledger.begin, volume.apply, ledger.apply)  # of every circuit
OF_WARMTH: Final = (warmth.apply, warmth.warm)  # of liquids whose temperature is a state, before the ledger
OF_GASES: Final = (gas.apply, gas_flow.apply)
LEDGER: Final = {
    "supplied": ("J", "energy that shafts and tanks gave to fluids"),
    "delivered": ("J", "energy that fluids gave to bodies"),
    "lost": ("J", "energy that fluids lost"),
    "taken_in": ("kg", "mass that tanks gave to volumes"),
}


def families() -> list[Family]:
    """All kernels of circuits, in the order of an evaluation."""
    of_kinds = (family for kind in COMPONENTS.values() for family in kind.families)
    return sorted(dict.fromkeys((*OF_WARMTH, *OF_NODES, *OF_GASES, *of_kinds)), key=PHASES.__getitem__)


def sensed_and_acting() -> tuple[list[Family], list[Family]]:
    """The same, before and after a control."""
    every = families()
    return [each for each in every if PHASES[each].sensed], [each for each in every if not PHASES[each].sensed]


def families_of(machine: MachineRecord) -> list[Family]:
    """The kernels that the circuits of a machine may need."""
    if not machine.hydraulics:
        return []
    needed = {*OF_NODES, *(family for each in machine.hydraulics for family in COMPONENTS[each.type].families)}
    if any(isinstance(fluid, Gas) for fluid in machine.fluids):
        needed.update(OF_GASES)
    if any(isinstance(fluid, Fluid) and not fluid.isothermal for fluid in machine.fluids):
        needed.update(OF_WARMTH)
    return [family for family in families() if family in needed]


def without_slopes(machine: MachineRecord) -> list[Component]:
    """The components of a machine whose derivatives are not known by hand."""
    return [each for each in machine.hydraulics if not COMPONENTS[each.type].has_slopes]


def has_slopes(machine: MachineRecord) -> bool:
    """Whether the derivatives of all its circuits are known by hand; those of gases are not."""
    return not without_slopes(machine) and not any(isinstance(fluid, Gas) for fluid in machine.fluids)


def add_circuits(builder: SystemBuilder) -> None:
    """Fluids, nodes and pressures of all circuits of a machine, and its pistons."""
    if builder.machine.hydraulics:
        add_fluids(builder)
        add_nodes(builder, {word: kind.nodes for word, kind in COMPONENTS.items() if kind.nodes is not None})
        _add_pressures(builder)
        for component in builder.machine.hydraulics:
            if (present := COMPONENTS[component.type].present) is not None:
                with located(f"hydraulics.{component.name}"), builder.noting():
                    present(builder, component)


def add_components(builder: SystemBuilder) -> None:
    """What flows through and acts, after the control that steers it."""
    components = builder.machine.hydraulics
    if not components:
        return
    # positions of valves and torques of pumps before what reads them
    for component in sorted(components, key=lambda each: isinstance(each, LoadSensing | Engine)):
        if (add := COMPONENTS[component.type].add) is not None:
            with located(f"hydraulics.{component.name}"), builder.noting():
                add(builder, component)
            _know_late(builder, component)


def _add_pressures(builder: SystemBuilder) -> None:
    """One row for each node."""
    builder.elements.add(ledger.begin, [])
    given = {each.name: each for each in builder.machine.hydraulics if isinstance(each, Tank)}
    for k, node in enumerate(builder.circuit.nodes.values()):
        function, temperature = 0, 0
        if node.kind == volume.GIVEN:
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
                gas.apply,
                [node.output, k, node.kind, node.state, function, node.energy],
                [node.walls, node.walls_by_volume],
            )
        elif is_warm(builder, node.fluid) and node.kind != volume.SIGNAL:
            columns = [node.output, k, node.kind, node.state, function, temperature]
            builder.elements.add(warmth.apply, columns)
            if node.is_volume:
                builder.elements.add(warmth.warm, columns, [node.walls])
        else:
            builder.elements.add(volume.apply, [node.output, k, node.kind, node.state, function])


def _know_late(builder: SystemBuilder, component: Component) -> None:
    """What a component reports, as signals."""
    coupled, start = builder.noted[-1], f"hydraulics.{component.name}."
    for k, (name, _, _) in enumerate(builder.outputs.entries):
        if name.startswith(start):
            builder.circuit.signals.setdefault(name.removeprefix("hydraulics."), (k, coupled))


def add_ledger(builder: SystemBuilder) -> None:
    """Three energies and a mass as states that nothing depends on, behind all other states of the machine."""
    if not builder.machine.hydraulics:
        return
    first = builder.outputs.add(("hydraulics.stored", "J", "energy stored in fluids, hoses and accumulators"))
    states = []
    for name, (units, words) in LEDGER.items():
        fact = StateFact(f"hydraulics.{name}", units, words, 0.0, 1.0, integral=True)
        with builder.noting():
            states.append(builder.own_state(fact))
    builder.elements.add(ledger.apply, [first, states[0]])
