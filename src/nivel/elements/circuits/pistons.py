"""Pistons: what they displace, the forces of their pressures, their friction and end stops.

A chamber has the volume V(s) = V₀ + A s + Σ ΔA_k R(s - s_k) over the stroke s, R a ramp: the area of a telescope falls from stage to stage.
The force (p - pa) dV/ds does exactly the work that its fluid loses; pa acts on the rod.
"""

from collections.abc import Iterator
from typing import Annotated

import numpy as np

from nivel.elements.circuits.fluids import ATMOSPHERE
from nivel.elements.circuits.kind import Phase, called, slopes_of
from nivel.elements.circuits.ledger import DELIVERED
from nivel.elements.circuits.smooth import magnitude_within, ramp, step
from nivel.elements.circuits.tangent import add_by_pressure, softness
from nivel.elements.contacts.impact import impact, meet, part, slopes_of_impact
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real, tanh
from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.machine.core.coefficient import Damping, NotNegativeForce, NotNegativeNumber, PositiveSpeed
from nivel.machine.core.record import Checked, Problem
from nivel.machine.given import Field, OneNumber
from nivel.machine.units.quantity import Quantity
from nivel.native.function import leaf


class PistonFriction(Checked):
    """(F_c + (static - 1) F_c exp(-(v/v_s)²)) tanh(v/v_t) + viscous v, with F_c = sliding + by_pressure |p_A - p_B| A_A."""

    sliding: NotNegativeForce = Field("without pressure", default=0.0)
    by_pressure: NotNegativeNumber = Field("friction over the force of the pressure, by seals", default=0.0)
    static: Annotated[OneNumber, Quantity("number")] = Field("static over sliding friction", default=1.0)
    stribeck_speed: PositiveSpeed = Field("v_s: speed over which the static part falls", default=0.02)
    transition_speed: PositiveSpeed = Field("v_t: speed over which it changes its sign", default=0.004)
    viscous: Damping = Field(default=0.0)

    def problems(self) -> Iterator[Problem]:
        if self.static < 1.0:
            yield Problem(("static",), f"static friction is at least the sliding one: 1 or more, got {self.static:g}")


# chambers: columns of `columns`; OUTPUT: of the piston
OUTPUT, NODE, COORDINATE = 0, 1, 2
# columns of `number`: value of the coordinate at s = 0, volume V₀, area A, width of a change of area [m], then STAGES pairs ΔA, s_k
ORIGIN, ROOM, AREA, WIDTH, FIRST_STAGE = 0, 1, 2, 3, 4
STAGES = 4

# pistons: columns of `columns`; COORDINATE as above; outputs: force, power, position, speed, friction
NODE_A, NODE_B = 1, 3
FORCE, POWER, POSITION, SPEED, FRICTION = 0, 1, 2, 3, 4
# columns of `number`: friction without pressure, by pressure [N/Pa], static over sliding, speeds of Stribeck's curve and of the change of
# sign, viscous friction; stroke, stiffness of its ends, x of `nivel.elements.contacts.impact`
COULOMB, SEAL, STATIC, STRIBECK, TRANSITION, VISCOUS, STROKE, STIFFNESS, LOSS = 1, 2, 3, 4, 5, 6, 7, 8, 9
# pressure difference [Pa] below which the friction by pressure is rounded
ROUNDED = 1e5
# bits of the number that says which end stops push; further ones count as met in every step in which they push
BITS = 62


@leaf
def swept(n, s):
    """(V [m³], dV/ds [m²]) at the stroke s."""
    volume, area = n[ROOM] + n[AREA] * s, n[AREA] + 0.0 * s
    for k in range(STAGES):
        change = n[FIRST_STAGE + 2 * k]
        if real(change) == 0.0:
            continue
        beyond = s - n[FIRST_STAGE + 2 * k + 1]
        volume += change * ramp(beyond, n[WIDTH])
        area += change * step(beyond * (1.0 / n[WIDTH]))
    return volume, area


@called(Phase.VOLUMES, 0)
@family
def displace(machine, number, t):
    """Volumes of chambers and their rates."""
    record = record_at(machine)
    elements, circuit, coordinates = record.elements, record.circuit, record.coordinates
    for node in range(circuit.volume.shape[0]):
        circuit.volume[node], circuit.volume_rate[node] = 0.0, 0.0
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        q = index[COORDINATE]
        volume, area = swept(n, coordinates.value[q] - n[ORIGIN])
        circuit.volume[index[NODE]] += volume
        circuit.volume_rate[index[NODE]] += area * coordinates.rate[q]
    return OK


@leaf
def friction_force(n, v, difference):
    """Friction [N] against the speed v at a difference of pressure."""
    sliding = n[COULOMB] + n[SEAL] * magnitude_within(difference, ROUNDED)
    ratio = v / n[STRIBECK]
    dry = sliding * (1.0 + (n[STATIC] - 1.0) * np.exp(-ratio * ratio))
    return dry * tanh(v / n[TRANSITION]) + n[VISCOUS] * v


@called(Phase.STROKES, 0)
@family
def guide(machine, number, t):
    """Friction and end stops of pistons; their outputs begin here."""
    record = record_at(machine)
    elements, circuit, coordinates, control = record.elements, record.circuit, record.coordinates, record.control
    followed = record.watched.followed[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n, memory, proposal = elements.columns[k], elements.number[k], elements.memory[k], elements.proposal[k]
        q, out, depth = index[COORDINATE], index[OUTPUT], elements.depth[k]
        s, v = coordinates.value[q] - n[ORIGIN], coordinates.rate[q]
        difference = circuit.pressure[index[NODE_A]] - ATMOSPHERE
        if index[NODE_B] != NONE:
            difference = circuit.pressure[index[NODE_A]] - circuit.pressure[index[NODE_B]]
        friction = friction_force(n, v, difference)
        depth[0], depth[1] = -s, s - n[STROKE]
        if followed == 1:
            elements.depth_rate[k, 0], elements.depth_rate[k, 1] = -v, v
        up, stored, loss, proposal[0] = impact(depth[0], -v, n[STIFFNESS], 1.0, n[LOSS], memory[0], followed)
        control.stored[0] += stored
        control.power[1] += loss
        down, stored, loss, proposal[1] = impact(depth[1], v, n[STIFFNESS], 1.0, n[LOSS], memory[1], followed)
        control.stored[0] += stored
        control.power[1] += loss + friction * v
        effort = up - down - friction
        value = record.outputs.value
        value[out + FORCE], value[out + POWER] = effort, add_coordinate_force(machine, q, effort)
        value[out + POSITION], value[out + SPEED], value[out + FRICTION] = s, v, friction
    return OK


@called(Phase.FLOWS, 1)
@element
def press(machine, index, n, t):
    """Forces of the pressures in chambers."""
    record = record_at(machine)
    circuit, coordinates = record.circuit, record.coordinates
    q, out = index[COORDINATE], index[OUTPUT]
    _, area = swept(n, coordinates.value[q] - n[ORIGIN])
    effort = (circuit.pressure[index[NODE]] - ATMOSPHERE) * area
    power = add_coordinate_force(machine, q, effort)
    circuit.power[DELIVERED] += power
    record.outputs.value[out + FORCE] += effort
    record.outputs.value[out + POWER] += power


@slopes_of(displace)
@element
def add_slopes_of_rooms(machine, index, n, t):
    """Slopes of the pressures of chambers with the strokes of their pistons."""
    record = record_at(machine)
    circuit, coordinates = record.circuit, record.coordinates
    tangent = circuit.tangent
    q = index[COORDINATE]
    _, area = swept(n, coordinates.value[q] - n[ORIGIN])
    if circuit.node[index[NODE], 1] != NONE:
        tangent.by_stroke[index[NODE], tangent.number[q]] -= softness(circuit, index[NODE]) * area


@slopes_of(press)
@element
def add_slopes_of_pressing(machine, index, n, t):
    """Slopes of the forces of pressures on pistons."""
    record = record_at(machine)
    circuit, coordinates = record.circuit, record.coordinates
    tangent = circuit.tangent
    q = index[COORDINATE]
    _, area = swept(n, coordinates.value[q] - n[ORIGIN])
    add_by_pressure(circuit, tangent.effort[tangent.number[q]], index[NODE], area)


@slopes_of(guide)
@family
def add_slopes_of_guides(machine, number, t):
    """Slopes of the friction of pistons and of their end stops."""
    record = record_at(machine)
    elements, circuit, coordinates = record.elements, record.circuit, record.coordinates
    tangent = circuit.tangent
    states, count = tangent.state.shape[0], tangent.coordinate.shape[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        q = index[COORDINATE]
        c, v = np.int64(tangent.number[q]), coordinates.rate[q]
        row = tangent.effort[c]
        other = circuit.pressure[index[NODE_B]] if index[NODE_B] != NONE else ATMOSPHERE
        difference = circuit.pressure[index[NODE_A]] - other
        size, ratio, sign = magnitude_within(difference, ROUNDED), v / n[STRIBECK], tanh(v / n[TRANSITION])
        extra = (n[STATIC] - 1.0) * np.exp(-ratio * ratio)
        sliding = n[COULOMB] + n[SEAL] * size
        turning = (1.0 + extra) * (1.0 - sign * sign) / n[TRANSITION] - 2.0 * extra * ratio / n[STRIBECK] * sign
        row[states + count + c] -= sliding * turning + n[VISCOUS]
        by_pressure = n[SEAL] * difference / size * (1.0 + extra) * sign
        add_by_pressure(circuit, row, index[NODE_A], -by_pressure)
        if index[NODE_B] != NONE:
            add_by_pressure(circuit, row, index[NODE_B], by_pressure)
        for end in range(2):
            rate = v if end == 1 else -v
            by_depth, by_rate = slopes_of_impact(
                elements.depth[k, end], rate, n[STIFFNESS], n[LOSS], elements.memory[k, end]
            )
            row[states + c] -= by_depth
            row[states + count + c] -= by_rate
    return OK


@leaf
def stop_pushes(elements, k, end, v):
    """Whether an end stop of piston k pushes it at the speed v, in the state last evaluated."""
    rate = v if end == 1 else -v
    by_depth, _ = slopes_of_impact(
        elements.depth[k, end], rate, elements.number[k, STIFFNESS], elements.number[k, LOSS], elements.memory[k, end]
    )
    return by_depth > 0.0


@leaf
def pushing_stops(machine, number):
    """The end stops that push in the state last evaluated, with which a part of a step begins: bit j of the j-th of the first BITS."""
    record = record_at(machine)
    elements, coordinates = record.elements, record.coordinates
    pushing, j = np.int64(0), np.int64(0)
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        for end in range(2):
            part(elements, k, end)
            meet(elements, k, end)
            if j < BITS and stop_pushes(elements, k, end, coordinates.rate[elements.columns[k, COORDINATE]]):
                pushing |= np.int64(1) << j
            j += 1
    return pushing


@leaf
def a_stop_is_met(machine, number, before):
    """Whether an end stop pushes in the state last evaluated that is not among those of `before`; the speed at which it is met is kept."""
    record = record_at(machine)
    elements, coordinates = record.elements, record.coordinates
    met, j = False, np.int64(0)
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        for end in range(2):
            meet(elements, k, end)
            known = j < BITS and (before >> j) & 1 == 1
            if not known and stop_pushes(elements, k, end, coordinates.rate[elements.columns[k, COORDINATE]]):
                met = True
            j += 1
    return met
