"""Settings of variable pumps with a swash actuator, limited by pressure and torque.

    λ = min(1, T/(D h), curve(h))        h = ±(p_B - p_A), the pressure against which it delivers

T is the limit of the torque: a hyperbola of flow and pressure. With a pilot X the torque is that of D times the mean of h and of p_X - p_A,
as where two pumps share an engine. The setting ε follows its command c, cut to ±λ, as a spool:

    ε̈ = ω² (c - ε) - 2 ζ ω ε̇, or with a greatest speed r, ε̇ = r tanh(ω (c - ε)/r)

With load sensing c is a state, as of `nivel.kernels.hydraulics.rotary`, where g is the least of the error of the pressure, of what the
greatest pressure leaves and of (λ - c)/END; without a frequency ε = c.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real, tanh
from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.phase import Phase, called, slopes_of
from nivel.kernels.hydraulics.rotary import END
from nivel.kernels.hydraulics.smooth import slope_of_step, step
from nivel.kernels.hydraulics.tangent import add_by_pressure
from nivel.kernels.record.function import evaluate_function, table_value
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf, stage

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


@called(Phase.POSITIONS)
@family
def regulate(machine, number, t):
    """Settings, and the rates of their states."""
    record = record_at(machine)
    elements = record.elements
    state, rate = elements.state, elements.state_rate
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        own = index[STATE]
        if index[SOUGHT] == NONE:
            command, _, _ = given_command(machine, index, n, t)
        else:
            command = state[index[SOUGHT]]
            g, _ = lacking_share(machine, index, n, t, command)
            room = n[GREATEST] - command if real(g) > 0.0 else command - n[LEAST]
            rate[index[SOUGHT]] += g / np.sqrt(1.0 + g * g) * (1.0 / n[TIME]) * step(room * (1.0 / END))
        if own != index[SOUGHT]:
            omega = n[FREQUENCY]
            if index[SPEED] == NONE:
                rate[own] += n[RATE] * tanh(omega / n[RATE] * (command - state[own]))
            else:
                speed = state[index[SPEED]]
                rate[own] += speed
                rate[index[SPEED]] += omega * omega * (command - state[own]) - 2.0 * n[DAMPING] * omega * speed
        record.outputs.value[index[OUTPUT]] = state[own]
    return OK


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
@family
def add_slopes(machine, number, t):
    """Slopes of all states of settings."""
    record = record_at(machine)
    elements, tangent = record.elements, record.circuit.tangent
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        if index[SOUGHT] != NONE:
            add_slopes_of_sought(machine, index, n, t)
        if index[STATE] == index[SOUGHT]:
            continue
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
            continue
        _, way, is_cut = given_command(machine, index, n, t)
        if is_cut:
            add_share_by_pressure(machine, index, n, t, way, row, way * by_command)
    return OK
