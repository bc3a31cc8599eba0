"""Electric drives: windings or current loops, shafts with friction, gears that are rigid or elastic.

Energy: electrical power u i goes in; R i², friction and the damping of the gear are lost; ½ L i², ½ J ω² and ½ k δ² are stored.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import absolute, real, tanh
from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.function import evaluate_function, table_value
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import stage

# columns of `columns`: STATE of the current or the torque, TWIST and SPEED of an elastic gear, or NONE;
# outputs: effort on the coordinate, power, speed, torque, current, voltage, electrical power, loss
OUTPUT, COORDINATE, COMMAND, STATE, TWIST, SPEED, CURVE = range(7)
# columns of `number`; KIND 0: a winding, 1: a current loop; its LAG is L or the time constant
KIND, GEAR, RESISTANCE, CONSTANT, LAG, LIMIT, VOLTAGE_LIMIT, DRY, TRANSITION, VISCOUS, ROTOR, STIFFNESS, DAMPING = (
    range(13)
)


@stage
def clipped(x, limit):
    """x between ± limit; what is no number stays none."""
    if real(x) > real(limit):
        return limit + 0.0 * x
    if real(x) < -real(limit):
        return -limit + 0.0 * x
    return x


@stage
def winding(machine, k, command, omega):
    """(current, voltage, power of the magnetic field) of a winding at a voltage."""
    elements = record_at(machine).elements
    n, index = elements.number[k], elements.columns[k]
    u, limit = clipped(command, n[VOLTAGE_LIMIT]), n[LIMIT]
    if index[STATE] == NONE:
        i = clipped((u - n[CONSTANT] * omega) / n[RESISTANCE], limit)
        return i, n[RESISTANCE] * i + n[CONSTANT] * omega
    # a step may leave the state beyond the limit, at which the current stays until the state comes back
    x = elements.state[index[STATE]]
    i = clipped(x, limit)
    rate = (u - n[RESISTANCE] * i - n[CONSTANT] * omega) / n[LAG]
    if (real(x) >= real(limit) and real(rate) > 0.0) or (real(x) <= -real(limit) and real(rate) < 0.0):
        rate = 0.0 * rate
    elements.state_rate[index[STATE]] += rate
    record_at(machine).control.stored[0] += 0.5 * n[LAG] * i * i
    if np.abs(real(x)) > real(limit):
        rate = 0.0 * rate
    return i, n[RESISTANCE] * i + n[CONSTANT] * omega + n[LAG] * rate


@stage
def current_loop(machine, k, command, omega):
    """(current, voltage) of a motor whose torque follows command / gear within its limits; without a torque constant, as if that were 1."""
    record = record_at(machine)
    elements = record.elements
    n, index = elements.number[k], elements.columns[k]
    limit = n[LIMIT]
    if index[CURVE] != NONE:
        limit, _, _ = table_value(record.functions, index[CURVE], absolute(omega))
    torque = clipped(command / n[GEAR], limit)
    if index[STATE] != NONE:
        wanted, torque = torque, elements.state[index[STATE]]
        elements.state_rate[index[STATE]] += (wanted - torque) / n[LAG]
    i = torque / n[CONSTANT]
    return i, n[RESISTANCE] * i + n[CONSTANT] * omega


@stage
def shaft_speed(machine, k):
    """Speed of the shaft: that of its rotor, or of the coordinate through the gear."""
    record = record_at(machine)
    index = record.elements.columns[k]
    if index[SPEED] != NONE:
        return record.elements.state[index[SPEED]]
    return record.elements.number[k, GEAR] * record.coordinates.rate[index[COORDINATE]]


@stage
def transmit(machine, k, torque, omega):
    """(effort on the coordinate, loss in the gear) of what the shaft gives to the gear."""
    record = record_at(machine)
    elements = record.elements
    n, index = elements.number[k], elements.columns[k]
    if index[TWIST] == NONE:
        return n[GEAR] * torque, 0.0 * torque
    twist = elements.state[index[TWIST]]
    rate = omega / n[GEAR] - record.coordinates.rate[index[COORDINATE]]
    effort = n[STIFFNESS] * twist + n[DAMPING] * rate
    elements.state_rate[index[TWIST]] += rate
    elements.state_rate[index[SPEED]] += (torque - effort / n[GEAR]) / n[ROTOR]
    record.control.stored[0] += 0.5 * n[ROTOR] * omega * omega + 0.5 * n[STIFFNESS] * twist * twist
    return effort, n[DAMPING] * rate * rate


@family
def apply(machine, number, t):
    """Currents, torques and efforts of all drives."""
    record = record_at(machine)
    elements, control, out = record.elements, record.control, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        n, index = elements.number[k], elements.columns[k]
        omega = shaft_speed(machine, k)
        command = evaluate_function(machine, index[COMMAND], t)
        if real(n[KIND]) == 0.0:
            i, u = winding(machine, k, command, omega)
        else:
            i, u = current_loop(machine, k, command, omega)
        torque = n[CONSTANT] * i
        rubbing = n[DRY] * tanh(omega / n[TRANSITION]) + n[VISCOUS] * omega
        effort, lost = transmit(machine, k, torque - rubbing, omega)
        loss = n[RESISTANCE] * i * i + rubbing * omega + lost
        control.power[0] += u * i
        control.power[1] += loss
        first = np.int64(index[OUTPUT])
        out[first], out[first + 1] = effort, add_coordinate_force(machine, index[COORDINATE], effort)
        out[first + 2], out[first + 3], out[first + 4], out[first + 5] = omega, torque, i, u
        out[first + 6], out[first + 7] = u * i, loss
    return OK
