"""Pumps, motors and sources of flow in numbers."""

from __future__ import annotations

import math

from nivel.kernels.hydraulics import rotary
from nivel.kernels.hydraulics.tangent import SETTING, TURN
from nivel.kernels.record.record import NONE
from nivel.machine.hydraulics import FlowSource, HydraulicMotor, Pump
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import symbols
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.signals.state_facts import StateFact

WITHOUT_CUT_OFF = 1e12  # Pa


def add_flow_source(builder: SystemBuilder, component: FlowSource) -> None:
    """A given flow."""
    name = component.name
    first = builder.outputs.add(
        (f"hydraulics.{name}.flow", "m^3/s", f"flow of {name}"), (f"hydraulics.{name}.power", "W", f"power into {name}")
    )
    ends = [builder.node(component.ports[port]) for port in "AB"]
    builder.elements.add(rotary.supply, [first, *ends, builder.function(component.flow)])


def add_machine(builder: SystemBuilder, component: Pump | HydraulicMotor) -> None:
    """A pump or motor, and what sets its displacement."""
    name, ports = component.name, component.ports
    first = builder.outputs.add(
        (f"hydraulics.{name}.flow", "m^3/s", f"flow from A to B of {name}"),
        (f"hydraulics.{name}.torque", "N m", f"torque that drives the shaft of {name}"),
        (f"hydraulics.{name}.power", "W", f"power into the shaft of {name}"),
        (f"hydraulics.{name}.setting", "1", f"share of the displacement of {name}"),
    )
    a, b = builder.node(ports["A"]), builder.node(ports["B"])
    speed, coordinate = NONE, NONE
    if component.coordinate is not None:
        coordinate = builder.coordinate(component.coordinate, "angle")
    else:
        assert isinstance(component, Pump)
        assert component.speed is not None  # the record was checked
        speed = builder.function(component.speed)
    periods, share = ripple(component.pistons)
    numbers = [component.displacement, component.ratio, component.whole_leakage, *component.friction, periods, share]
    builder.elements.add(rotary.turn, [first, a, b, speed, coordinate], numbers)
    _add_setting(builder, component, first + rotary.SETTING, b)


def ripple(pistons: int | None) -> tuple[float, float]:
    """(periods a turn, half the relative ripple) of the flow of an odd number z of pistons: π/(2 z) tan(π/(4 z)) of 2 z periods."""
    if pistons is None:
        return 0.0, 0.0
    return 2.0 * pistons, 0.25 * math.pi / pistons * math.tan(0.25 * math.pi / pistons)


def _add_setting(builder: SystemBuilder, component: Pump | HydraulicMotor, output: int, high: int) -> None:
    if isinstance(component, Pump) and component.margin is not None:
        state = builder.own_state(
            StateFact(f"{component.name}.setting", "1", f"displacement of {component.name}", 0.0, 1.0)
        )
        cut_off = component.cut_off or WITHOUT_CUT_OFF
        numbers = [component.margin, component.control_range, cut_off, component.response]
        columns = [output, state, NONE, high, builder.node(component.ports["LS"])]
        builder.elements.add(rotary.set_displacement, columns, numbers)
        return
    builder.elements.add(rotary.set_displacement, [output, NONE, builder.function(component.setting), NONE, NONE])


SLOPES = {rotary.set_displacement: SETTING, rotary.turn: TURN}
KINDS = (
    ComponentKind(Pump, add_machine, tuple(SLOPES), symbols.pump, SLOPES),
    ComponentKind(HydraulicMotor, add_machine, tuple(SLOPES), symbols.motor, SLOPES),
    ComponentKind(FlowSource, add_flow_source, (rotary.supply,), symbols.pump, {}),  # a given flow has no slopes
)
