"""Combustion engines with a governor, whose shaft drives pumps: the speed ω is a state.

    J ω̇ = T - Σ i T_pump - T_load        T = k (ω_0 - ω), between -T_drag and T_full(ω)        k = max T_full/(δ ω_0)

ω_0 is the speed that is asked for without load, δ the droop: what it falls by at the greatest torque.
"""

from collections.abc import Iterator, Mapping
from math import pi
from typing import ClassVar, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Component
from nivel.elements.circuits.curves import Speeds, as_many, held_curve, rising
from nivel.elements.circuits.kind import ComponentKind, Phase, called, slopes_of
from nivel.elements.circuits.pumps import Pump, Speed, Torque
from nivel.elements.circuits.rotary import SETTING, Inertia
from nivel.elements.circuits.rotary import TORQUE as OF_TORQUE
from nivel.elements.circuits.symbol import Symbol, path
from nivel.elements.circuits.tangent import add_by_pressure, add_flow_by_column
from nivel.elements.facts import Coupled, StateFact
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real
from nivel.kernels.record.function import evaluate_function, table_value
from nivel.kernels.record.record import NONE, record_at
from nivel.known import SystemBuilder
from nivel.machine.core.coefficient import NotNegativeTorque, Share, Torques
from nivel.machine.core.record import Checked, Problem
from nivel.machine.given import Field, OneRecord, Usual
from nivel.machine.laws.varying_value import Table
from nivel.native.function import stage


class TorqueCurve(Checked):
    """The torque at full load over the speed, straight lines between points, constant outside."""

    speeds: Speeds = Field("increasing")
    torques: Torques = Field("at full load, one for each speed")

    def problems(self) -> Iterator[Problem]:
        yield from rising("speeds", self.speeds)
        yield from as_many("torques", self.torques, "`speeds`", len(self.speeds))
        if max(self.torques, default=0.0) <= 0.0 or min(self.torques, default=0.0) < 0.0:
            yield Problem(("torques",), "torques of 0 or more were expected, one of them above 0")


class Engine(Component):
    """A combustion engine with a governor, which turns pumps; its speed is a state. `pumps` name it as their `engine`."""

    functions: ClassVar[tuple[str, ...]] = ("speed", "load")
    early: ClassVar[tuple[str, ...]] = ("speed",)
    late: ClassVar[tuple[str, ...]] = ("torque", "power")
    usual: ClassVar[Mapping[str, Usual]] = {"speed": ranges.SHAFT_SPEED, "torque": ranges.TORQUE, "power": ranges.POWER}

    type: Literal["engine"] = "engine"
    speed: Speed = Field("asked for, without load", usual=ranges.SHAFT_SPEED)
    torque_curve: OneRecord[TorqueCurve] = Field("full load")
    inertia: Inertia = Field("of the shaft and all that turns with it")
    droop: Share = Field("fall of the speed at the greatest torque, as a share of `speed`", default=0.05)
    drag: NotNegativeTorque = Field("torque with which it brakes without fuel", default=0.0)
    load: Torque = Field("torque of what else it drives: fan, alternator", default=0.0)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.droop == 0.0:
            yield Problem(("droop",), "a governor has a droop above 0, such as 0.05, got 0")


# columns of `columns`; outputs: speed, torque, power; function ω_0, table T_full, function T_load; then of each pump the output that is its
# torque, and its nodes A and B
OUTPUT, STATE, ASKED, FULL, LOAD, FIRST_PUMP, WIDE = 0, 1, 2, 3, 4, 5, 3
TURNING, TORQUE, POWER = 0, 1, 2
MOST = 8
# columns of `number`: J [kg m²], max T_full [N m], droop, T_drag [N m], then i and D [m³/rad] of each pump
INERTIA, PEAK, DROOP, DRAG, FIRST_RATIO = 0, 1, 2, 3, 4


@called(Phase.STROKES, 1, slow=True)
@element
def turn(machine, index, n, t):
    """Speeds, before what they turn."""
    record = record_at(machine)
    elements = record.elements
    record.outputs.value[index[OUTPUT] + TURNING] = elements.state[index[STATE]]


@stage
def driving_torque(machine, index, n, t, omega):
    """(T [N m], the real -∂T/∂ω where the governor decides, or 0)."""
    asked = evaluate_function(machine, index[ASKED], t)
    braking = real(n[DRAG]) if real(omega) > 0.0 else 0.0
    if real(asked) <= 0.0:
        return 0.0 * (asked + omega) - braking, 0.0
    stiffness = real(n[PEAK]) / (real(n[DROOP]) * real(asked))
    torque = stiffness * (asked - omega)
    full, _, _ = table_value(record_at(machine).functions, index[FULL], omega)
    if real(torque) > real(full):
        return full + 0.0 * torque, 0.0
    if real(torque) < -braking:
        return 0.0 * torque - braking, 0.0
    return torque, stiffness


@called(Phase.BALANCE, 2)
@element
def drive(machine, index, n, t):
    """Torques, and the rates of speeds, behind all pumps. The work of the shafts was counted with the pumps."""
    record = record_at(machine)
    elements, value, control = record.elements, record.outputs.value, record.control
    own, out = index[STATE], index[OUTPUT]
    omega = elements.state[own]
    torque, _ = driving_torque(machine, index, n, t, omega)
    load = evaluate_function(machine, index[LOAD], t)
    left = torque - load
    for i in range(MOST):
        if index[FIRST_PUMP + WIDE * i] == NONE:
            break
        left = left - n[FIRST_RATIO + 2 * i] * value[index[FIRST_PUMP + WIDE * i]]
    elements.state_rate[own] += left / n[INERTIA]
    control.stored[0] += 0.5 * n[INERTIA] * omega * omega
    control.power[0] += left * omega
    value[out + TORQUE], value[out + POWER] = torque, torque * omega


@slopes_of(drive)
@element
def add_slopes(machine, index, n, t):
    """Slopes of speeds, and of the flows that they make; those of losses are left out."""
    record = record_at(machine)
    elements, circuit, value = record.elements, record.circuit, record.outputs.value
    tangent = circuit.tangent
    _, stiffness = driving_torque(machine, index, n, t, elements.state[index[STATE]])
    own = tangent.unknown[index[STATE]]
    row = tangent.slopes[own]
    row[own] -= stiffness / n[INERTIA]
    for i in range(MOST):
        first = FIRST_PUMP + WIDE * i
        if index[first] == NONE:
            break
        ratio, setting = n[FIRST_RATIO + 2 * i], index[first] + SETTING - OF_TORQUE
        a, b, full = index[first + 1], index[first + 2], n[FIRST_RATIO + 2 * i + 1]
        swept = full * value[setting]
        taken = circuit.density[a] if swept > 0.0 else circuit.density[b]
        add_flow_by_column(circuit, a, b, own, taken * swept * ratio)
        slope = ratio * swept / n[INERTIA]
        add_by_pressure(circuit, row, b, -slope)
        add_by_pressure(circuit, row, a, slope)
        if tangent.source[setting, 0] != NONE:
            row[tangent.source[setting, 0]] -= ratio * full * (circuit.pressure[b] - circuit.pressure[a]) / n[INERTIA]


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
    builder.elements.add(turn, [first, state])
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
    full_load = held_curve(builder, Table(curve.speeds, curve.torques, of="speed"))
    columns = [first, state, builder.function(component.speed), full_load]
    columns += [builder.function(component.load), *driven, *[NONE] * (WIDE * MOST - len(driven))]
    numbers = [component.inertia, max(curve.torques), component.droop, component.drag]
    numbers += [number for pump in pumps for number in (pump.ratio, pump.displacement)]
    builder.elements.add(drive, columns, numbers)


BODY = path("M-18 -18 H18 V18 H-18 Z M-8 -18 V18 M-8 4 H-18 M18 -2 H28 M18 2 H28")
ENGINE = Symbol(BODY, 28.0, 18.0, row="supply", text="M", key="speed", unit=(30.0 / pi, "rpm"))

KINDS = (ComponentKind(Engine, add_engine, (turn, drive), symbol=ENGINE, present=present_engine, last=True),)
