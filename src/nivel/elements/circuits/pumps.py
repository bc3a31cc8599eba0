"""Pumps, motors and sources of flow."""

import math
from collections.abc import Iterator, Mapping
from math import pi
from typing import Annotated, Any, ClassVar, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Component, problem_of_share
from nivel.elements.circuits.efficiency_maps import lose_by_map, map_tables
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.pump_control import CutOffCurve, add_setting, regulate
from nivel.elements.circuits.restrictions import TRANSITION, add_flow, restrict
from nivel.elements.circuits.rotary import SETTING, RotaryMachine, Setting, supply, turn
from nivel.elements.circuits.symbol import Symbol, adjustable, circle, path, setting, varies
from nivel.kernels.record.record import NONE
from nivel.known import SystemBuilder
from nivel.machine.core.coefficient import Displacement, Share
from nivel.machine.core.record import Name, Problem, superfluous
from nivel.machine.given import Field, Maybe, OneNumber, OneRecord
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.formula import linear
from nivel.machine.units.quantity import Duration, Quantity

Speed = Annotated[OneFunction, varying("angular velocity")]

Torque = Annotated[OneFunction, varying("torque")]


class FlowSource(Component):
    """An ideal pump: a given flow from A to B, at whatever pressure."""

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    functions: ClassVar[tuple[str, ...]] = ("flow",)
    late: ClassVar[tuple[str, ...]] = ("flow", "power")
    delivers: ClassVar[str] = "B"

    type: Literal["flow-source"] = "flow-source"
    flow: Annotated[OneFunction, varying("volume flow")] = Field(
        "at the density of the side it comes from", usual=ranges.FLOW
    )


class Pump(RotaryMachine):
    """A pump from A (suction) to B, at a given speed or turned by a joint or an engine; its displacement fixed, given, or load sensing."""

    may: ClassVar[tuple[str, ...]] = ("LS", "X", "L")
    functions: ClassVar[tuple[str, ...]] = ("speed", "setting", "torque_limit")
    delivers: ClassVar[str] = "B"

    type: Literal["pump"] = "pump"
    displacement: Displacement = Field(usual=ranges.PUMP_DISPLACEMENT)
    speed: Maybe[Speed] = Field("of its shaft, in place of `coordinate`", default=None, usual=ranges.SHAFT_SPEED)
    engine: Name | None = Field("that turns it, in place of `speed`", default=None)
    setting: Setting = Field("share of the displacement", default=1.0)
    least_setting: Maybe[Annotated[OneNumber, Quantity("number")]] = Field(
        "of the actuator; default 0 with load sensing, else -1: it swings over centre", default=None
    )
    greatest_setting: Share = Field("of the actuator", default=1.0)
    torque_limit: Maybe[Torque] = Field(
        "greatest torque of D times the pressure, without friction; with a port X, times the mean of both pressures",
        default=None,
        usual=ranges.TORQUE,
    )
    cut_off_curve: Maybe[OneRecord[CutOffCurve]] = Field(
        "greatest setting over the difference of pressure", default=None
    )
    margin: Maybe[ranges.Drop] = Field("load sensing: held between B and LS", default=None)
    control_range: ranges.Drop = Field("load sensing: pressure error at which it moves at full speed", default=10e5)
    response: Duration = Field("load sensing: time from empty to full", default=0.08)
    cut_off: Maybe[ranges.Drop] = Field("load sensing: greatest pressure at B", default=None)

    @property
    def range_of_settings(self) -> tuple[float, float]:
        """Least and greatest setting."""
        least = self.least_setting
        return (0.0 if self.margin is not None else -1.0) if least is None else least, self.greatest_setting

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        turned = [key for key in ("speed", "coordinate", "engine") if getattr(self, key) is not None]
        if len(turned) != 1:
            got = f"got {' and '.join(f'`{key}`' for key in turned)}" if turned else "got none of them"
            yield Problem(
                (), f"a pump needs a `speed`, the `coordinate` of a joint or the `engine` that turns it; {got}"
            )
        limits = (self.torque_limit, self.cut_off_curve, self.least_setting)
        is_limited = any(each is not None for each in limits) or self.greatest_setting < 1.0
        if self.margin is None and is_limited and self.frequency is None:
            yield Problem((), "`frequency` is missing: limits act on an actuator; write for example `frequency: 4 Hz`")
        if self.cut_off is not None and self.margin is None:
            told = "belongs to load sensing; a given setting falls along a `cut_off_curve`"
            yield superfluous("cut_off", f"{told}: {{pressures: [280 bar, 300 bar], settings: [1, 0]}}")
        if ("X" in self.ports) and self.torque_limit is None:
            yield superfluous("ports", "port X is the pressure of the other pump that shares a `torque_limit`")
        if not -1.0 <= self.range_of_settings[0] < self.greatest_setting:
            told = f"from -1 to below {self.greatest_setting:g} was expected, got {self.range_of_settings[0]:g}"
            yield Problem(("least_setting",), f"a setting {told}")
        if ("LS" in self.ports) != (self.margin is not None):
            lacking = "`margin` is" if self.margin is None else "port LS is"
            yield Problem((), f"{lacking} missing: a load-sensing pump has a port LS and a `margin`")
        yield from problem_of_share("setting", self.setting, -1.0)
        if self.margin is not None and self.setting != 1.0:
            yield superfluous("setting", "is found by the load sensing itself")
        if self.pistons is not None and self.coordinate is None and not isinstance(self.speed, float | int):
            yield superfluous("pistons", "need a constant `speed`, or a `coordinate`: the ripple follows the angle")


class HydraulicMotor(RotaryMachine):
    """A motor that turns a joint: forward where the pressure at A is higher."""

    may: ClassVar[tuple[str, ...]] = ("L",)
    functions: ClassVar[tuple[str, ...]] = ("setting",)

    type: Literal["hydraulic-motor"] = "hydraulic-motor"
    setting: Setting = Field("share of the displacement", default=1.0)

    @property
    def losses(self) -> tuple[float, float]:
        """The same of a motor: Q = D ω/η and T = η D Δp."""
        return 1.0 / self.volumetric_efficiency - 1.0, 1.0 - self.mechanical_efficiency

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from problem_of_share("setting", self.setting, -1.0)
        if self.coordinate is None:
            yield Problem((), "`coordinate` is missing: the angle of a joint that it turns")


def add_flow_source(builder: SystemBuilder, component: FlowSource) -> None:
    """A given flow."""
    name = component.name
    first = builder.outputs.add(
        (f"hydraulics.{name}.flow", "m^3/s", f"flow of {name}"), (f"hydraulics.{name}.power", "W", f"power into {name}")
    )
    ends = [builder.node(component.ports[port]) for port in "AB"]
    builder.elements.add(supply, [first, *ends, builder.function(component.flow)])


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
    builder.elements.add(turn, [first, a, b, *turning], numbers)
    if component.efficiency is not None:
        tables = map_tables(builder, component, pumps=isinstance(component, Pump))
        builder.elements.add(lose_by_map, [first, a, b, *turning, *tables], numbers[:2])
    if "L" in ports:
        for port, quantity in (("B", "case_flow"), ("A", "case_flow_A")):
            if ports[port] != ports["L"]:
                add_flow(builder, component, quantity, (port, "L"), [0.0, TRANSITION, component.case_leakage])
    add_setting(builder, component, first + SETTING, (a, b))


def _turning(builder: SystemBuilder, component: Pump | HydraulicMotor) -> tuple[int, int]:
    """What turns a machine: SPEED and COORDINATE of `nivel.elements.circuits.rotary`."""
    if component.coordinate is not None:
        return NONE, builder.coordinate(component.coordinate, "angle")
    assert isinstance(component, Pump)
    if component.engine is not None:
        return builder.function(linear((component.ratio, f"{component.engine}.speed"))), NONE
    assert component.speed is not None  # the record was checked
    return builder.function(component.speed), NONE


def ripple(pistons: int | None) -> tuple[float, float]:
    """(periods a turn, half the relative ripple) of the flow of an odd number z of pistons: π/(2 z) tan(π/(4 z)) of 2 z periods."""
    if pistons is None:
        return 0.0, 0.0
    return 2.0 * pistons, 0.25 * math.pi / pistons * math.tan(0.25 * math.pi / pistons)


def _displacement(data: Mapping[str, Any]) -> tuple[str, ...]:
    return setting(data, "displacement", 2e6 * pi, "cm³/rev")


def pump(data: Mapping[str, Any]) -> Symbol:
    """A pump, or a source of flow."""
    body = circle(16.0) + path("M0 -16 l-6 10 h12 z", "full") + path("M0 -24 V-16 M0 16 V24 M-16 -2 H-26 M-16 2 H-26")
    if data.get("margin") is not None or varies(data, "setting") or data.get("setting", 1.0) != 1.0:
        body += adjustable(-15, 17, 17, -17)
    if _has_two_ways(data):
        body += path("M0 16 l-6 -10 h12 z", "full")
    ports = data.get("ports") or {}
    sensed = {port: 30.0 + 10.0 * k for k, port in enumerate(port for port in ("LS", "X") if port in ports)}
    body += (
        path(" ".join(f"M16 {5.0 * k:g} H{x:g} V-24" for k, x in enumerate(sensed.values())), "dashed")
        if sensed
        else ""
    )
    drain = {"L": 14.0} if "L" in ports else {}
    body += path("M10 12.5 L14 17 V24", "dashed") if drain else ""
    wide = max([26.0, *sensed.values()])
    below = {"A": 0.0} | drain
    return Symbol(body, wide, 24.0, {"B": 0.0} | sensed, below, "supply", _displacement(data))


def _has_two_ways(data: Mapping[str, Any]) -> bool:
    """Whether a pump swings over centre: it is told to, or its setting varies with nothing that bounds it to one way."""
    least = data.get("least_setting")
    if least is not None:
        return least < 0.0
    return data.get("frequency") is not None and data.get("margin") is None and varies(data, "setting")


def motor(data: Mapping[str, Any]) -> Symbol:
    """A hydraulic motor."""
    body = circle(16.0) + path("M-6 0 l-10 -6 v12 z M6 0 l10 -6 v12 z", "full")
    body += path("M-16 0 H-26 V24 M16 0 H26 V24 M-2 -16 V-24 M2 -16 V-24")
    if varies(data, "setting"):
        body += adjustable(-15, 17, 17, -17)
    drain = {"L": 12.0} if "L" in (data.get("ports") or {}) else {}
    body += path("M10 12.5 L12 16 V24", "dashed") if drain else ""
    return Symbol(body, 26.0, 24.0, {}, {"A": -26.0, "B": 26.0} | drain, "actuator", _displacement(data))


OF_MACHINES = (turn, lose_by_map, regulate, restrict)
KINDS = (
    ComponentKind(Pump, add_machine, OF_MACHINES, symbol=pump),
    ComponentKind(HydraulicMotor, add_machine, OF_MACHINES, symbol=motor),
    ComponentKind(FlowSource, add_flow_source, (supply,), symbol=pump),
)
