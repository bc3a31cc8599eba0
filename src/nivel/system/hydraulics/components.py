"""Components of a circuit in numbers, by type."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

from nivel.kernels.hydraulics import (
    gas,
    gas_flow,
    ledger,
    load_signal,
    pipe,
    piston,
    restriction,
    rotary,
    spool,
    volume,
)
from nivel.kernels.record.hook import Family
from nivel.machine.hydraulics import (
    Accumulator,
    Actuator,
    CheckValve,
    Compensator,
    Component,
    CounterbalanceValve,
    DirectionalValve,
    FlowSource,
    Gas,
    HydraulicCylinder,
    HydraulicMotor,
    LoadSensing,
    Orifice,
    Pipe,
    Pump,
    ReducingValve,
    ReliefValve,
    Tank,
    Volume,
)
from nivel.machine.machine_record import MachineRecord
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics.directional import add_directional, add_load_signal
from nivel.system.hydraulics.machines import add_flow_source, add_machine
from nivel.system.hydraulics.nodes import add_fluids, add_nodes
from nivel.system.hydraulics.poppets import (
    add_check,
    add_compensator,
    add_counterbalance,
    add_reducing,
    add_relief,
)
from nivel.system.hydraulics.restrictions import add_cushions, add_inlet, add_orifice, add_pipe
from nivel.system.located import located
from nivel.system.signals.state_facts import StateFact

# in the order of an evaluation: what a control may read at once, and what it acts on
SENSED: Final[tuple[Family, ...]] = (ledger.begin, piston.displace, volume.apply, gas.apply, piston.guide)
ACTING: Final[tuple[Family, ...]] = (
    piston.press,
    spool.move,
    spool.lift,
    load_signal.apply,
    rotary.set_displacement,
    rotary.turn,
    rotary.supply,
    restriction.apply,
    gas_flow.apply,
    pipe.apply,
    ledger.apply,
)
FAMILIES: Final = (*SENSED, *ACTING)
ADDERS: Final[dict[type[Component], Callable[[SystemBuilder, Any], None]]] = {
    Accumulator: add_inlet,
    LoadSensing: add_load_signal,
    Orifice: add_orifice,
    Pipe: add_pipe,
    CheckValve: add_check,
    ReliefValve: add_relief,
    CounterbalanceValve: add_counterbalance,
    ReducingValve: add_reducing,
    Compensator: add_compensator,
    DirectionalValve: add_directional,
    FlowSource: add_flow_source,
    Pump: add_machine,
    HydraulicMotor: add_machine,
    HydraulicCylinder: add_cushions,
}
_POPPETS = (CheckValve, ReliefValve, CounterbalanceValve, ReducingValve, Compensator)
_NEEDED: Final[dict[type[Component], tuple[Family, ...]]] = {
    **dict.fromkeys(_POPPETS, (spool.lift, restriction.apply)),
    Volume: (),
    Tank: (),
    Accumulator: (restriction.apply,),
    LoadSensing: (load_signal.apply,),
    Orifice: (restriction.apply,),
    Pipe: (pipe.apply,),
    DirectionalValve: (spool.move, restriction.apply),
    FlowSource: (rotary.supply,),
    Pump: (rotary.set_displacement, rotary.turn),
    HydraulicMotor: (rotary.set_displacement, rotary.turn),
    Actuator: (piston.displace, piston.guide, piston.press),
    HydraulicCylinder: (piston.displace, piston.guide, piston.press),
}
LEDGER: Final = {
    "supplied": ("J", "energy that shafts and tanks gave to fluids"),
    "delivered": ("J", "energy that fluids gave to bodies"),
    "lost": ("J", "energy that fluids lost"),
    "taken_in": ("kg", "mass that tanks gave to volumes"),
}


def families_of(machine: MachineRecord) -> list[Family]:
    """The kernels that the circuits of a machine need."""
    if not machine.hydraulics:
        return []
    needed = {ledger.begin, volume.apply, ledger.apply}
    if any(isinstance(fluid, Gas) for fluid in machine.fluids):
        needed.update((gas.apply, gas_flow.apply))
    for component in machine.hydraulics:
        kind = next(kind for kind in type(component).__mro__ if kind in _NEEDED)
        needed.update(_NEEDED[kind])
        if isinstance(component, HydraulicCylinder) and (component.cushion_A or component.cushion_B):
            needed.update((spool.lift, restriction.apply))
    return [family for family in FAMILIES if family in needed]


def add_circuits(builder: SystemBuilder) -> None:
    """Fluids, nodes and pressures of all circuits of a machine, and its pistons."""
    if builder.machine.hydraulics:
        add_fluids(builder)
        add_nodes(builder)
        _add_pressures(builder)


def add_components(builder: SystemBuilder) -> None:
    """What flows through and acts, after the control that steers it."""
    components = builder.machine.hydraulics
    if not components:
        return
    # positions of valves before what reads them
    for component in sorted(components, key=lambda each: isinstance(each, LoadSensing)):
        if (add := ADDERS.get(type(component))) is not None:
            with located(f"hydraulics.{component.name}"), builder.noting():
                add(builder, component)
            _know_late(builder, component)
    _add_ledger(builder)


def _add_pressures(builder: SystemBuilder) -> None:
    """One row for each node."""
    builder.elements.add(ledger.begin, [])
    given = {each.name: each for each in builder.machine.hydraulics if isinstance(each, Tank)}
    for k, node in enumerate(builder.circuit.nodes.values()):
        function = 0
        if node.kind == volume.GIVEN:
            with located(f"hydraulics.{node.owner}.pressure"), builder.noting():
                function = builder.function(given[node.owner].pressure)
        if node.gas:
            builder.elements.add(
                gas.apply, [node.output, k, node.kind, node.state, function, node.energy], [node.walls]
            )
        else:
            builder.elements.add(volume.apply, [node.output, k, node.kind, node.state, function])


def _know_late(builder: SystemBuilder, component: Component) -> None:
    """What a component reports, as signals."""
    coupled, start = builder.noted[-1], f"hydraulics.{component.name}."
    for k, (name, _, _) in enumerate(builder.outputs.entries):
        if name.startswith(start):
            builder.circuit.signals.setdefault(name.removeprefix("hydraulics."), (k, coupled))


def _add_ledger(builder: SystemBuilder) -> None:
    """Three energies and a mass as states that nothing depends on."""
    first = builder.outputs.add(("hydraulics.stored", "J", "energy stored in fluids, hoses and accumulators"))
    states = []
    for name, (units, words) in LEDGER.items():
        fact = StateFact(f"hydraulics.{name}", units, words, 0.0, 1.0, integral=True)
        with builder.noting():
            states.append(builder.own_state(fact))
    builder.elements.add(ledger.apply, [first, states[0]])
