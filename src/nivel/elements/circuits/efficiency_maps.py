"""Losses of pumps and motors by maps over speed, difference of pressure and setting.

The machine itself is without losses (`nivel.elements.circuits.rotary`). Here fluid leaks from the higher pressure to the lower one, and
friction acts on the shaft, whichever way it turns:

    Q = C(|ω|, |Δp|, |ε|) Δp        T = c(|ω|, |Δp|, |ε|) D |Δp| sgn ω

C and c lie on the points of the map, and trilinear between them; outside, the nearest point holds. Both are such that the efficiencies at
the points are those of the map.
"""

import numpy as np

from nivel.elements.circuits.density import thickness
from nivel.elements.circuits.kind import Phase, called, slopes_of
from nivel.elements.circuits.ledger import DELIVERED, SUPPLIED, lose_between, transfer
from nivel.elements.circuits.rotary import (
    COORDINATE,
    FLOW,
    FROM,
    OUTPUT,
    POWER,
    SETTING,
    SLOW,
    SMALL,
    SPEED,
    TO,
    TORQUE,
    turning,
)
from nivel.elements.circuits.smooth import magnitude_within, sign_within
from nivel.elements.circuits.tangent import add_by_pressure, add_flow_by_pressure
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.record import NONE, record_at
from nivel.known import RotaryMachine, SystemBuilder
from nivel.native.function import leaf, stage

# columns of `columns` behind those of `nivel.elements.circuits.rotary`: tables whose knots are the speeds, pressures and settings; one
# whose coefficients are C and c, the last axis changing first
FIRST_AXIS, GRID = 5, 8
AXES = 3
# columns of `number`: D [m³/rad], turns of the shaft per turn of the joint
DISPLACEMENT, RATIO = 0, 1


@leaf
def place_on_axis(functions, axis, x):
    """(point at or below x, points of the axis, share of the way to the next one)."""
    first, end = np.int64(functions.table[axis, 0]), np.int64(functions.table[axis, 1])
    count = end - first
    if count == 1 or real(x) <= functions.knots[first]:
        return np.int64(0), count, 0.0 * x
    low = np.int64(0)
    while low + 2 < count and real(x) >= functions.knots[first + low + 1]:
        low += 1
    share = (x - functions.knots[first + low]) / (functions.knots[first + low + 1] - functions.knots[first + low])
    if real(share) > 1.0:
        return low, count, 0.0 * x + 1.0
    return low, count, share


@stage
def coefficients_at(machine, index, speed, pressure, setting):
    """(C [m³/s/Pa], c) at the magnitudes of speed, difference of pressure and setting."""
    functions = record_at(machine).functions
    i, _, u = place_on_axis(functions, index[FIRST_AXIS], speed)
    j, across, v = place_on_axis(functions, index[FIRST_AXIS + 1], pressure)
    k, along, w = place_on_axis(functions, index[FIRST_AXIS + 2], setting)
    first = np.int64(functions.table[index[GRID], 0])
    leak, dry = 0.0 * (u + v + w), 0.0 * (u + v + w)
    for corner in range(8):
        a, b, c = corner & 1, (corner >> 1) & 1, corner >> 2
        share = (u if a == 1 else 1.0 - u) * (v if b == 1 else 1.0 - v) * (w if c == 1 else 1.0 - w)
        if real(share) == 0.0:
            continue
        row = functions.coefficients[first + ((i + a) * across + j + b) * along + k + c]
        leak, dry = leak + share * row[0], dry + share * row[1]
    return leak, dry


@called(Phase.FLOWS, 6)
@element
def lose_by_map(machine, index, n, t):
    """Leaks and friction of all machines with maps."""
    record = record_at(machine)
    circuit, value = record.circuit, record.outputs.value
    a, b, out = index[FROM], index[TO], index[OUTPUT]
    omega, _ = turning(machine, index, n, t)
    difference = circuit.pressure[b] - circuit.pressure[a]
    size = magnitude_within(difference, SMALL)
    speed, setting = magnitude_within(omega, SLOW), magnitude_within(value[out + SETTING], 1e-6)
    conductance, share = coefficients_at(machine, index, speed, size, setting)
    leak = conductance / thickness(circuit, a, b) * difference
    torque = share * n[DISPLACEMENT] * size * sign_within(omega, SLOW)
    power = torque * omega
    flow = 0.5 * (circuit.density[a] + circuit.density[b]) * leak
    lose_between(machine, b, a, flow, power + transfer(machine, b, a, flow))
    if index[SPEED] == NONE:
        add_coordinate_force(machine, index[COORDINATE], -n[RATIO] * torque)
        circuit.power[DELIVERED] -= power
    else:
        record.control.power[0] += power
        circuit.power[SUPPLIED] += power
    value[out + FLOW] -= leak
    value[out + TORQUE] += torque
    value[out + POWER] += power


@slopes_of(lose_by_map)
@element
def add_slopes(machine, index, n, t):
    """Slopes of leaks and friction with pressures, for C and c as they are."""
    record = record_at(machine)
    circuit, value = record.circuit, record.outputs.value
    tangent = circuit.tangent
    a, b = index[FROM], index[TO]
    omega, _ = turning(machine, index, n, t)
    difference = circuit.pressure[b] - circuit.pressure[a]
    size = magnitude_within(difference, SMALL)
    speed, setting = magnitude_within(omega, SLOW), magnitude_within(value[index[OUTPUT] + SETTING], 1e-6)
    conductance, share = coefficients_at(machine, index, speed, size, setting)
    slope = 0.5 * (circuit.density[a] + circuit.density[b]) * conductance / thickness(circuit, a, b)
    add_flow_by_pressure(circuit, a, b, a, slope)
    add_flow_by_pressure(circuit, a, b, b, -slope)
    if index[SPEED] == NONE:
        row = tangent.effort[tangent.number[index[COORDINATE]]]
        slope = n[RATIO] * share * n[DISPLACEMENT] * difference / size * sign_within(omega, SLOW)
        add_by_pressure(circuit, row, b, -slope)
        add_by_pressure(circuit, row, a, slope)


def map_tables(builder: SystemBuilder, component: RotaryMachine, *, pumps: bool) -> list[int]:
    """The axes and the grid of the map of a pump, or of a motor: FIRST_AXIS … GRID of `nivel.elements.circuits.efficiency_maps`."""
    efficiency = component.efficiency
    assert efficiency is not None
    speed, pressure, setting, volumetric, mechanical = efficiency.points()
    flow = component.displacement * setting * speed
    if pumps:
        leak, dry = (1.0 - volumetric) * flow / pressure, setting * (1.0 / mechanical - 1.0)
    else:
        leak, dry = (1.0 / volumetric - 1.0) * flow / pressure, setting * (1.0 - mechanical)
    axes = (efficiency.speeds, efficiency.pressures, efficiency.settings)
    grid = np.zeros((leak.size, 4))
    grid[:, 0], grid[:, 1] = leak.ravel(), dry.ravel()
    tables = [builder.functions.add_table(list(axis), np.zeros((len(axis), 4))) for axis in axes]
    return [*tables, builder.functions.add_table(list(range(len(grid))), grid)]
