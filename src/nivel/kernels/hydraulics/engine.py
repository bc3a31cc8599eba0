"""Combustion engines with a governor, whose shaft drives pumps: the speed ω is a state.

    J ω̇ = T - Σ i T_pump - T_load        T = k (ω_0 - ω), between -T_drag and T_full(ω)        k = max T_full/(δ ω_0)

ω_0 is the speed that is asked for without load, δ the droop: what it falls by at the greatest torque.
"""

from __future__ import annotations

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.phase import Phase, called, slopes_of
from nivel.kernels.hydraulics.rotary import SETTING
from nivel.kernels.hydraulics.rotary import TORQUE as OF_TORQUE
from nivel.kernels.hydraulics.tangent import add_by_pressure, add_flow_by_column
from nivel.kernels.record.function import evaluate_function, table_value
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import stage

# columns of `columns`; outputs: speed, torque, power; function ω_0, table T_full, function T_load; then of each pump the output that is its
# torque, and its nodes A and B
OUTPUT, STATE, ASKED, FULL, LOAD, FIRST_PUMP, WIDE = 0, 1, 2, 3, 4, 5, 3
TURNING, TORQUE, POWER = 0, 1, 2
MOST = 8
# columns of `number`: J [kg m²], max T_full [N m], droop, T_drag [N m], then i and D [m³/rad] of each pump
INERTIA, PEAK, DROOP, DRAG, FIRST_RATIO = 0, 1, 2, 3, 4


@called(Phase.STROKES, slow=True)
@family
def turn(machine, number, t):
    """Speeds, before what they turn."""
    record = record_at(machine)
    elements = record.elements
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        record.outputs.value[index[OUTPUT] + TURNING] = elements.state[index[STATE]]
    return OK


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


@called(Phase.BALANCE)
@family
def drive(machine, number, t):
    """Torques, and the rates of speeds, behind all pumps. The work of the shafts was counted with the pumps."""
    record = record_at(machine)
    elements, value, control = record.elements, record.outputs.value, record.control
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
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
    return OK


@slopes_of(drive)
@family
def add_slopes(machine, number, t):
    """Slopes of speeds, and of the flows that they make; those of losses are left out."""
    record = record_at(machine)
    elements, circuit, value = record.elements, record.circuit, record.outputs.value
    tangent = circuit.tangent
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
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
                row[tangent.source[setting, 0]] -= (
                    ratio * full * (circuit.pressure[b] - circuit.pressure[a]) / n[INERTIA]
                )
    return OK
