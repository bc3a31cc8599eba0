"""Settings of variable pumps with a swash actuator, limited by pressure and torque.

    λ = min(1, T/(D h), curve(h))        h = ±(p_B - p_A), the pressure against which it delivers

T is the limit of the torque: a hyperbola of flow and pressure. With a pilot X the torque is that of D times the mean of h and of p_X - p_A,
as where two pumps share an engine. The setting ε follows its command c, cut to ±λ, as a spool:

    ε̈ = ω² (c - ε) - 2 ζ ω ε̇, or with a greatest speed r, ε̇ = r tanh(ω (c - ε)/r)

Without a frequency ε = c. With load sensing c is a state that holds a margin above the sensed pressure:

    ċ = g/√(1 + g²)/T        g = min(p_LS + margin - p_B, p_max - p_B)/range, or (λ - c)/END where that is less
"""

import math
from collections.abc import Iterator

import numpy as np

from nivel.elements.circuits.curves import Pressures, as_many, held_curve, rising
from nivel.elements.circuits.kind import Phase, called, slopes_of
from nivel.elements.circuits.smooth import slope_of_step, step
from nivel.elements.circuits.tangent import add_by_pressure
from nivel.elements.facts import StateFact
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real, tanh
from nivel.kernels.record.function import evaluate_function, table_value
from nivel.kernels.record.record import NONE, record_at
from nivel.known import HydraulicMotor, Pump, SystemBuilder
from nivel.machine.core.coefficient import Numbers
from nivel.machine.core.record import Checked, Problem
from nivel.machine.given import Field
from nivel.machine.laws.varying_value import Table
from nivel.native.function import leaf, stage


class CutOffCurve(Checked):
    """The greatest setting over the difference of pressure, straight lines between points, constant outside."""

    pressures: Pressures = Field("difference of pressure, increasing")
    settings: Numbers = Field("greatest share of the displacement there, from 0 to 1")

    def problems(self) -> Iterator[Problem]:
        yield from rising("pressures", self.pressures)
        yield from as_many("settings", self.settings, "`pressures`", len(self.pressures))
        if any(not 0.0 <= each <= 1.0 for each in self.settings):
            yield Problem(("settings",), "settings from 0 to 1 were expected")


# share of the displacement over which a load-sensing pump comes to rest at its ends
END = 0.05
# columns of `columns`; output: setting; states of the setting, its speed, the command of load sensing; command; nodes A, B, LS, X; function
# of the greatest torque; table of the greatest setting over pressure. NONE: without it
OUTPUT, STATE, SPEED, SOUGHT, COMMAND, LOW, HIGH, SENSED, PILOT, TORQUE, CURVE = range(11)
# columns of `number`: D [m³/rad], ω [rad/s], ζ, r [1/s] (0: second order), least and greatest setting; of load sensing the margin and range
# [Pa], time [s], greatest pressure [Pa]
DISPLACEMENT, FREQUENCY, DAMPING, RATE, LEAST, GREATEST, MARGIN, RANGE, TIME, CUT_OFF = range(10)


@stage
def torque_share(machine, index, n, t, way):
    """T/(D h) at which the torque is at its limit; one where that is not met."""
    circuit = record_at(machine).circuit
    high = (circuit.pressure[index[HIGH]] - circuit.pressure[index[LOW]]) * way
    if index[PILOT] != NONE:
        high = 0.5 * (high + circuit.pressure[index[PILOT]] - circuit.pressure[index[LOW]])
    greatest = evaluate_function(machine, index[TORQUE], t)
    taken = n[DISPLACEMENT] * high
    return greatest / taken if real(taken) > real(greatest) else 0.0 * high + 1.0


@stage
def greatest_share(machine, index, n, t, way):
    """λ where fluid is delivered to B (way 1) or A (-1)."""
    record = record_at(machine)
    circuit = record.circuit
    share = 0.0 * circuit.pressure[index[HIGH]] + 1.0
    if index[TORQUE] != NONE:
        share = torque_share(machine, index, n, t, way)
    if index[CURVE] != NONE:
        high = (circuit.pressure[index[HIGH]] - circuit.pressure[index[LOW]]) * way
        least, _, _ = table_value(record.functions, index[CURVE], high)
        if real(least) < real(share):
            share = least + 0.0 * share
    return share


@stage
def given_command(machine, index, n, t):
    """(c, the way it delivers, whether λ cuts it) of a given command."""
    command = evaluate_function(machine, index[COMMAND], t)
    if real(command) > real(n[GREATEST]):
        command = 0.0 * command + n[GREATEST]
    elif real(command) < real(n[LEAST]):
        command = 0.0 * command + n[LEAST]
    way = 1.0 if real(command) >= 0.0 else -1.0
    share = greatest_share(machine, index, n, t, way)
    if way * real(command) > real(share):
        return way * share, way, True
    return command + 0.0 * share, way, False


@stage
def lacking_share(machine, index, n, t, own):
    """(g of load sensing at the command `own`, which of its bounds is the least one: 0 margin, 1 greatest pressure, 2 λ)."""
    circuit = record_at(machine).circuit
    high = circuit.pressure[index[HIGH]]
    g, bound = (circuit.pressure[index[SENSED]] + n[MARGIN] - high) * (1.0 / n[RANGE]), 0
    spare = (n[CUT_OFF] - high) * (1.0 / n[RANGE])
    if real(spare) < real(g):
        g, bound = spare, 1
    if index[TORQUE] != NONE or index[CURVE] != NONE:
        over = (greatest_share(machine, index, n, t, 1.0) - own) * (1.0 / END)
        if real(over) < real(g):
            g, bound = over, 2
    return g, bound


@called(Phase.POSITIONS, 4)
@element
def regulate(machine, index, n, t):
    """Settings, and the rates of their states."""
    record = record_at(machine)
    elements = record.elements
    state, rate = elements.state, elements.state_rate
    own = index[STATE]
    if index[SOUGHT] == NONE:
        command, _, _ = given_command(machine, index, n, t)
    else:
        command = state[index[SOUGHT]]
        g, _ = lacking_share(machine, index, n, t, command)
        room = n[GREATEST] - command if real(g) > 0.0 else command - n[LEAST]
        rate[index[SOUGHT]] += g / np.sqrt(1.0 + g * g) * (1.0 / n[TIME]) * step(room * (1.0 / END))
    if own == NONE:
        record.outputs.value[index[OUTPUT]] = command
        return
    if own != index[SOUGHT]:
        omega = n[FREQUENCY]
        if index[SPEED] == NONE:
            rate[own] += n[RATE] * tanh(omega / n[RATE] * (command - state[own]))
        else:
            speed = state[index[SPEED]]
            rate[own] += speed
            rate[index[SPEED]] += omega * omega * (command - state[own]) - 2.0 * n[DAMPING] * omega * speed
    record.outputs.value[index[OUTPUT]] = state[own]


@leaf
def add_share_by_pressure(machine, index, n, t, way, row, factor):
    """Add `factor` times the slopes of λ to a row."""
    record = record_at(machine)
    circuit = record.circuit
    high = (circuit.pressure[index[HIGH]] - circuit.pressure[index[LOW]]) * way
    share = torque_share(machine, index, n, t, way) if index[TORQUE] != NONE else 1.0
    if index[CURVE] != NONE:
        least, slope, _ = table_value(record.functions, index[CURVE], high)
        if least < share:
            add_by_pressure(circuit, row, index[HIGH], factor * slope * way)
            add_by_pressure(circuit, row, index[LOW], -factor * slope * way)
            return
    if share >= 1.0:
        return
    greatest = evaluate_function(machine, index[TORQUE], t)
    slope = -share * share * n[DISPLACEMENT] / greatest * factor
    if index[PILOT] == NONE:
        add_by_pressure(circuit, row, index[HIGH], slope * way)
        add_by_pressure(circuit, row, index[LOW], -slope * way)
        return
    add_by_pressure(circuit, row, index[HIGH], 0.5 * slope * way)
    add_by_pressure(circuit, row, index[PILOT], 0.5 * slope)
    add_by_pressure(circuit, row, index[LOW], -0.5 * slope * (1.0 + way))


@leaf
def add_slopes_of_sought(machine, index, n, t):
    """Slopes of a command of load sensing."""
    record = record_at(machine)
    circuit, own = record.circuit, record.elements.state[index[SOUGHT]]
    unknown = circuit.tangent.unknown[index[SOUGHT]]
    row = circuit.tangent.slopes[unknown]
    g, bound = lacking_share(machine, index, n, t, own)
    root = np.sqrt(1.0 + g * g)
    room, sign = (n[GREATEST] - own, -1.0) if g > 0.0 else (own - n[LEAST], 1.0)
    row[unknown] += g / root / n[TIME] * slope_of_step(room / END) * sign / END
    slope = step(room / END) / (root * root * root * n[TIME])
    if bound == 2:
        row[unknown] -= slope / END
        add_share_by_pressure(machine, index, n, t, 1.0, row, slope / END)
        return
    add_by_pressure(circuit, row, index[HIGH], -slope / n[RANGE])
    if bound == 0:
        add_by_pressure(circuit, row, index[SENSED], slope / n[RANGE])


@slopes_of(regulate)
@element
def add_slopes(machine, index, n, t):
    """Slopes of all states of settings."""
    record = record_at(machine)
    elements, tangent = record.elements, record.circuit.tangent
    if index[SOUGHT] != NONE:
        add_slopes_of_sought(machine, index, n, t)
    if index[STATE] == index[SOUGHT]:
        return
    own, omega = tangent.unknown[index[STATE]], n[FREQUENCY]
    if index[SPEED] == NONE:
        share = elements.state_rate[index[STATE]] / n[RATE]
        follows, by_command = own, omega * (1.0 - share * share)
        tangent.slopes[own, own] -= by_command
    else:
        follows, by_command = tangent.unknown[index[SPEED]], omega * omega
        tangent.slopes[own, follows] += 1.0
        tangent.slopes[follows, own] -= by_command
        tangent.slopes[follows, follows] -= 2.0 * n[DAMPING] * omega
    row = tangent.slopes[follows]
    if index[SOUGHT] != NONE:
        row[tangent.unknown[index[SOUGHT]]] += by_command
        return
    _, way, is_cut = given_command(machine, index, n, t)
    if is_cut:
        add_share_by_pressure(machine, index, n, t, way, row, way * by_command)


WITHOUT_CUT_OFF = 1e12  # Pa


def add_setting(builder: SystemBuilder, component: Pump | HydraulicMotor, output: int, ends: tuple[int, int]) -> None:
    """What sets the displacement: a command, an actuator, load sensing, limits."""
    name, ports, omega = component.name, component.ports, 2.0 * math.pi * (component.frequency or 0.0)
    margin, torque, curve, cut_off = (
        getattr(component, key, None) for key in ("margin", "torque_limit", "cut_off_curve", "cut_off")
    )

    def state(word: str, words: str, units: str = "1", scale: float = 1.0) -> int:
        return builder.own_state(StateFact(f"{name}.{word}", units, f"{words} of {name}", 0.0, scale))

    own, speed, sought, command = NONE, NONE, NONE, NONE
    if margin is not None and omega:
        sought = state("sought_setting", "sought displacement")
    if margin is not None or omega:
        own = state("setting", "displacement")
    if omega and component.rate_limit is None:
        speed = state("setting_speed", "speed of the setting", "1/s", omega)
    if margin is None:
        command = builder.function(component.setting)
    elif not omega:
        sought = own
    felt = [builder.node(ports[port]) if port in ports else NONE for port in ("LS", "X")]
    limit = NONE if torque is None else builder.function(torque)
    table = NONE if curve is None else held_curve(builder, Table(curve.pressures, curve.settings, of="pressure"))
    numbers = [component.displacement, omega, component.damping_ratio, component.rate_limit or 0.0]
    numbers += component.range_of_settings
    if isinstance(component, Pump):
        numbers += [margin or 0.0, component.control_range, component.response, cut_off or WITHOUT_CUT_OFF]
    builder.elements.add(regulate, [output, own, speed, sought, command, *ends, *felt, limit, table], numbers)
