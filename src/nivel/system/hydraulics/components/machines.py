"""Pumps, motors and sources of flow in numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from nivel.elements.states import Coupled, StateFact
from nivel.kernels.hydraulics import engine, pump_control, restriction, rotary, rotary_map
from nivel.kernels.record.record import NONE
from nivel.machine.hydraulics import Engine, FlowSource, HydraulicMotor, Pump
from nivel.machine.units.linear_function import linear
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import symbols
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.restrictions import TRANSITION, add_flow

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
    turning = _turning(builder, component)
    periods, share = ripple(component.pistons)
    losses = (component.leakage, 0.0, 0.0) if component.efficiency else (component.whole_leakage, *component.friction)
    numbers = [component.displacement, component.ratio, *losses, periods, share]
    builder.elements.add(rotary.turn, [first, a, b, *turning], numbers)
    if component.efficiency is not None:
        tables = _map_tables(builder, component)
        builder.elements.add(rotary_map.lose_by_map, [first, a, b, *turning, *tables], numbers[:2])
    if "L" in ports:
        for port, quantity in (("B", "case_flow"), ("A", "case_flow_A")):
            if ports[port] != ports["L"]:
                add_flow(builder, name, quantity, (ports[port], ports["L"]), [0.0, TRANSITION, component.case_leakage])
    _add_setting(builder, component, first + rotary.SETTING, (a, b))


def _turning(builder: SystemBuilder, component: Pump | HydraulicMotor) -> tuple[int, int]:
    """What turns a machine: SPEED and COORDINATE of `nivel.kernels.hydraulics.rotary`."""
    if component.coordinate is not None:
        return NONE, builder.coordinate(component.coordinate, "angle")
    assert isinstance(component, Pump)
    if component.engine is not None:
        return builder.function(linear((component.ratio, f"{component.engine}.speed"))), NONE
    assert component.speed is not None  # the record was checked
    return builder.function(component.speed), NONE


def _map_tables(builder: SystemBuilder, component: Pump | HydraulicMotor) -> list[int]:
    """The axes and the grid of a map: FIRST_AXIS … GRID of `nivel.kernels.hydraulics.rotary_map`."""
    efficiency = component.efficiency
    assert efficiency is not None
    speed, pressure, setting, volumetric, mechanical = efficiency.points()
    flow = component.displacement * setting * speed
    if isinstance(component, Pump):
        leak, dry = (1.0 - volumetric) * flow / pressure, setting * (1.0 / mechanical - 1.0)
    else:
        leak, dry = (1.0 / volumetric - 1.0) * flow / pressure, setting * (1.0 - mechanical)
    axes = (efficiency.speeds, efficiency.pressures, efficiency.settings)
    grid = np.zeros((leak.size, 4))
    grid[:, 0], grid[:, 1] = leak.ravel(), dry.ravel()
    tables = [builder.functions.add_table(list(axis), np.zeros((len(axis), 4))) for axis in axes]
    return [*tables, builder.functions.add_table(list(range(len(grid))), grid)]


def held_table(builder: SystemBuilder, points: Sequence[float], values: Sequence[float]) -> int:
    """A table of straight lines between points, constant outside."""
    slopes = np.diff(values) / np.diff(points) if len(points) > 1 else np.zeros(0)
    pieces = np.zeros((len(points) + 1, 4))
    pieces[:, 0] = [values[0], *values]
    pieces[1:-1, 1] = slopes
    return builder.functions.add_table([points[0] - 1.0, *points], pieces)


def ripple(pistons: int | None) -> tuple[float, float]:
    """(periods a turn, half the relative ripple) of the flow of an odd number z of pistons: π/(2 z) tan(π/(4 z)) of 2 z periods."""
    if pistons is None:
        return 0.0, 0.0
    return 2.0 * pistons, 0.25 * math.pi / pistons * math.tan(0.25 * math.pi / pistons)


def _add_setting(builder: SystemBuilder, component: Pump | HydraulicMotor, output: int, ends: tuple[int, int]) -> None:
    if isinstance(component, Pump) and component.is_regulated:
        _add_regulated(builder, component, output, ends)
    elif component.frequency is not None:
        numbers = [component.displacement, *_actuator(component), -1.0, 1.0]
        states = _actuator_states(builder, component)
        command = builder.function(component.setting)
        columns = [output, *states, NONE, command, *ends, NONE, NONE, NONE, NONE]
        builder.elements.add(pump_control.regulate, columns, numbers)
    elif isinstance(component, Pump) and component.margin is not None:
        numbers = [component.margin, component.control_range, component.cut_off or WITHOUT_CUT_OFF, component.response]
        columns = [output, _setting_state(builder, component), NONE, ends[1], builder.node(component.ports["LS"])]
        builder.elements.add(rotary.set_displacement, columns, numbers)
    else:
        builder.elements.add(rotary.set_displacement, [output, NONE, builder.function(component.setting), NONE, NONE])


def _add_regulated(builder: SystemBuilder, component: Pump, output: int, ends: tuple[int, int]) -> None:
    """The actuator of a pump, with its limits and load sensing."""
    sensing, ports = component.margin is not None, component.ports
    sought, command = NONE, NONE
    if not sensing:
        states = _actuator_states(builder, component)
        command = builder.function(component.setting)
    elif component.frequency is None:
        sought = _setting_state(builder, component)
        states = [sought, NONE]
    else:
        words = f"sought displacement of {component.name}"
        sought = builder.own_state(StateFact(f"{component.name}.sought_setting", "1", words, 0.0, 1.0))
        states = _actuator_states(builder, component)
    felt = [builder.node(ports[port]) if port in ports else NONE for port in ("LS", "X")]
    torque = NONE if component.torque_limit is None else builder.function(component.torque_limit)
    curve = component.cut_off_curve
    table = NONE if curve is None else held_table(builder, curve.pressures, curve.settings)
    numbers = [component.displacement, *_actuator(component), *component.range_of_settings]
    numbers += [component.margin or 0.0, component.control_range, component.response]
    numbers.append(component.cut_off or WITHOUT_CUT_OFF)
    columns = [output, *states, sought, command, *ends, *felt, torque, table]
    builder.elements.add(pump_control.regulate, columns, numbers)


def _setting_state(builder: SystemBuilder, component: Pump | HydraulicMotor) -> int:
    return builder.own_state(StateFact(f"{component.name}.setting", "1", f"displacement of {component.name}", 0.0, 1.0))


def _actuator_states(builder: SystemBuilder, component: Pump | HydraulicMotor) -> list[int]:
    """States of the setting and its speed; NONE for one of first order."""
    state = _setting_state(builder, component)
    if component.rate_limit is not None:
        return [state, NONE]
    words, scale = f"speed of the setting of {component.name}", 2.0 * math.pi * (component.frequency or 0.0)
    return [state, builder.own_state(StateFact(f"{component.name}.setting_speed", "1/s", words, 0.0, scale))]


def _actuator(component: Pump | HydraulicMotor) -> tuple[float, float, float]:
    """FREQUENCY, DAMPING, RATE of `nivel.kernels.hydraulics.pump_control`."""
    return 2.0 * math.pi * (component.frequency or 0.0), component.damping_ratio, component.rate_limit or 0.0


def present_engine(builder: SystemBuilder, component: Engine) -> None:
    """The speed of an engine, which controls and pumps may read."""
    name = component.name
    first = builder.outputs.add(
        (f"hydraulics.{name}.speed", "rad/s", f"speed of {name}"),
        (f"hydraulics.{name}.torque", "N m", f"torque of {name}"),
        (f"hydraulics.{name}.power", "W", f"power of {name}"),
    )
    speed = component.speed if isinstance(component.speed, float | int) else 0.0
    fact = StateFact(f"{name}.speed", "rad/s", f"speed of {name}", float(speed), max(component.torque_curve.speeds))
    state = builder.own_state(fact)
    builder.elements.add(engine.turn, [first, state])
    builder.circuit.signals[f"{name}.speed"] = (first, Coupled(frozenset(), frozenset({state})))


def add_engine(builder: SystemBuilder, component: Engine) -> None:
    """The torque of an engine and those of its pumps."""
    first, behind = builder.circuit.signals[f"{component.name}.speed"]
    builder.note(behind)
    state = builder.state(f"{component.name}.speed")
    pumps = [each for each in builder.machine.hydraulics if isinstance(each, Pump) and each.engine == component.name]
    driven: list[int] = []
    for pump in pumps:
        output, coupled = builder.circuit.signals[f"{pump.name}.torque"]
        builder.note(coupled)
        driven += [output, builder.node(pump.ports["A"]), builder.node(pump.ports["B"])]
    curve = component.torque_curve
    columns = [first, state, builder.function(component.speed), held_table(builder, curve.speeds, curve.torques)]
    columns += [builder.function(component.load), *driven, *[NONE] * (engine.WIDE * engine.MOST - len(driven))]
    numbers = [component.inertia, max(curve.torques), component.droop, component.drag]
    numbers += [number for pump in pumps for number in (pump.ratio, pump.displacement)]
    builder.elements.add(engine.drive, columns, numbers)


OF_MACHINES = (rotary.set_displacement, rotary.turn, rotary_map.lose_by_map, pump_control.regulate, restriction.apply)
KINDS = (
    ComponentKind(Pump, add_machine, OF_MACHINES, symbols.pump),
    ComponentKind(HydraulicMotor, add_machine, OF_MACHINES, symbols.motor),
    ComponentKind(FlowSource, add_flow_source, (rotary.supply,), symbols.pump),
    ComponentKind(Engine, add_engine, (engine.turn, engine.drive), symbols.engine, present=present_engine),
)
