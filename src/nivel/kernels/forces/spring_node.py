"""A node without mass where springs meet: it is where their energy V(p) = Σ ½ k_i (|p - r_i| - f_i)² is least, next to where it was.

With e = p - r_i, l = |e|, u = e/l and the tension T = k (l - f): ∂V/∂p = Σ T u = 0, H = Σ k u uᵀ + (T/l) (1 - u uᵀ). Newton's method on
values, with H shifted where it is not positive definite or a step does not lower V (Levenberg 1944), then one step with slopes. The forces
on the ends are those of the node held: its own motion adds nothing to them, as V is stationary.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_marker_force
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf, stage

# columns of `columns`; FIRST: the first of COUNT markers; outputs: first tension, power, x, y, z, tensions
OUTPUT, COUNT, FIRST = 0, 1, 2
# columns of `number`: at the start x, y, z and a length of the springs; then SPRING for each
ONLY_PULLS, PLACE, SIZE, STIFF, SPRINGS = 0, 1, 4, 5, 6
STIFFNESS, FREE = 0, 1
SPRING = 2
STEPS = 200
# shares of the size and of the stiffness: a step that is round-off, a pivot that is none, the first shift
SETTLED, NO_PIVOT, SHIFT = 1e-14, 1e-12, 1e-3


@stage
def energy_at(machine, k, x, y, z):
    """V, its gradient and H (xx, xy, xz, yy, yz, zz) with the node of element k at this place, as numbers."""
    record = record_at(machine)
    index, numbers, markers = record.elements.columns[k], record.elements.number[k], record.markers
    V, gx, gy, gz, xx, xy, xz, yy, yz, zz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(np.int64(index[COUNT])):
        r, at = markers.r[index[FIRST + i]], SPRINGS + SPRING * i
        stiffness, free = real(numbers[at + STIFFNESS]), real(numbers[at + FREE])
        ex, ey, ez = x - real(r[0]), y - real(r[1]), z - real(r[2])
        length = np.sqrt(ex * ex + ey * ey + ez * ez)
        if length == 0.0 or (real(numbers[ONLY_PULLS]) > 0.0 and length < free):
            continue
        T = stiffness * (length - free)
        ux, uy, uz, across = ex / length, ey / length, ez / length, T / length
        along = stiffness - across
        V += 0.5 * T * (length - free)
        gx, gy, gz = gx + T * ux, gy + T * uy, gz + T * uz
        xx, yy, zz = xx + along * ux * ux + across, yy + along * uy * uy + across, zz + along * uz * uz + across
        xy, xz, yz = xy + along * ux * uy, xz + along * ux * uz, yz + along * uy * uz
    return V, gx, gy, gz, xx, xy, xz, yy, yz, zz


@leaf
def step_to_balance(H, shift, floor, gx, gy, gz):
    """-(H + shift)⁻¹ g by L D Lᵀ; whether all pivots are above the floor."""
    a, d, f = H[0] + shift, H[3] + shift, H[5] + shift
    if not a > floor:
        return False, gx, gy, gz
    l1, l2 = H[1] / a, H[2] / a
    d, e = d - l1 * H[1], H[4] - l1 * H[2]
    if not d > floor:
        return False, gx, gy, gz
    l3 = e / d
    f = f - l2 * H[2] - l3 * e
    if not f > floor:
        return False, gx, gy, gz
    y = gy - l1 * gx
    z = (gz - l2 * gx - l3 * y) / f
    y = y / d - l3 * z
    x = gx / a - l1 * y - l2 * z
    return True, -x, -y, -z


@leaf
def step_from_saddle(H, floor, gx, gy, gz):
    """-H⁻¹ g by cofactors, where H is not positive definite; whether no direction is without stiffness."""
    a, b, c, d, e, f = H
    xx, xy, xz, yy, yz, zz = d * f - e * e, c * e - b * f, b * e - c * d, a * f - c * c, b * c - a * e, a * d - b * b
    whole = a * xx + b * xy + c * xz
    if not abs(whole) > floor * max(abs(xx), abs(yy), abs(zz)):
        return False, gx, gy, gz
    x = (xx * gx + xy * gy + xz * gz) / whole
    y = (xy * gx + yy * gy + yz * gz) / whole
    z = (xz * gx + yz * gy + zz * gz) / whole
    return True, -x, -y, -z


@stage
def balance(machine, k):
    """Where the springs of element k balance, from where they last did: (x, y, z) as numbers."""
    record = record_at(machine)
    numbers, memory = record.elements.number[k], record.elements.memory[k]
    x, y, z = (
        real(numbers[PLACE]) + memory[0],
        real(numbers[PLACE + 1]) + memory[1],
        real(numbers[PLACE + 2]) + memory[2],
    )
    stiff, size = real(numbers[STIFF]), real(numbers[SIZE])
    V, gx, gy, gz, xx, xy, xz, yy, yz, zz = energy_at(machine, k, x, y, z)
    shift = 0.0
    for _ in range(STEPS):
        found, dx, dy, dz = step_to_balance((xx, xy, xz, yy, yz, zz), shift, NO_PIVOT * stiff, gx, gy, gz)
        if found:
            W, hx, hy, hz, xx2, xy2, xz2, yy2, yz2, zz2 = energy_at(machine, k, x + dx, y + dy, z + dz)
            way = dx * dx + dy * dy + dz * dz
            # of two energies that differ by round-off alone the smaller gradient tells
            lower = W < V - 1e-12 * V or hx * hx + hy * hy + hz * hz <= gx * gx + gy * gy + gz * gz
            if lower and W <= V + 1e-12 * V:
                x, y, z = x + dx, y + dy, z + dz
                V, gx, gy, gz, xx, xy, xz, yy, yz, zz = W, hx, hy, hz, xx2, xy2, xz2, yy2, yz2, zz2
                shift = 0.25 * shift if shift > NO_PIVOT * stiff else 0.0
                if way <= SETTLED * SETTLED * size * size:
                    break
                continue
            if way <= SETTLED * SETTLED * size * size:
                break
        shift = max(4.0 * shift, SHIFT * stiff)
    return x, y, z


@stage
def refined(machine, k, x, y, z):
    """The same place with its slopes: one step of Newton's method with the gradient as it depends on the ends."""
    record = record_at(machine)
    index, numbers, markers = record.elements.columns[k], record.elements.number[k], record.markers
    _, _, _, _, xx, xy, xz, yy, yz, zz = energy_at(machine, k, x, y, z)
    gx, gy, gz = 0.0 * markers.r[index[FIRST], 0], 0.0 * markers.r[index[FIRST], 0], 0.0 * markers.r[index[FIRST], 0]
    for i in range(np.int64(index[COUNT])):
        T, ux, uy, uz = pull(markers.r[index[FIRST + i]], numbers, i, x, y, z)
        gx, gy, gz = gx + T * ux, gy + T * uy, gz + T * uz
    stiff = real(numbers[STIFF])
    found, dx, dy, dz = step_to_balance((xx, xy, xz, yy, yz, zz), 0.0, NO_PIVOT * stiff, gx, gy, gz)
    if not found:
        # symmetry holds it where its springs push, as in a plane
        found, dx, dy, dz = step_from_saddle((xx, xy, xz, yy, yz, zz), NO_PIVOT * stiff, gx, gy, gz)
    if not found:
        # a direction without stiffness: the node stays in it
        found, dx, dy, dz = step_to_balance((xx, xy, xz, yy, yz, zz), SHIFT * stiff, 0.0, gx, gy, gz)
    if not found:
        return x + 0.0 * gx, y + 0.0 * gy, z + 0.0 * gz
    return x + dx, y + dy, z + dz


@leaf
def pull(r, numbers, i, x, y, z):
    """Tension of spring i from the point r to the node, and its direction; no tension where both are one."""
    at = SPRINGS + SPRING * i
    ex, ey, ez = x - r[0], y - r[1], z - r[2]
    square = ex * ex + ey * ey + ez * ez
    if real(square) == 0.0:
        return 0.0 * square, 0.0 * square, 0.0 * square, 0.0 * square
    length = np.sqrt(square)
    T = numbers[at + STIFFNESS] * (length - numbers[at + FREE])
    if real(numbers[ONLY_PULLS]) > 0.0 and real(T) < 0.0:
        T = 0.0 * T
    return T, ex / length, ey / length, ez / length


@family
def apply(machine, number, t):
    """Places of the nodes, and the tensions of their springs on the bodies."""
    record = record_at(machine)
    elements, markers, control, out = record.elements, record.markers, record.control, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, numbers = elements.columns[k], elements.number[k]
        first, count = index[OUTPUT], np.int64(index[COUNT])
        x0, y0, z0 = balance(machine, k)
        x, y, z = refined(machine, k, x0, y0, z0)
        power = 0.0 * x
        for i in range(count):
            m = index[FIRST + i]
            T, ux, uy, uz = pull(markers.r[m], numbers, i, x, y, z)
            power += add_marker_force(record.bodies, markers, m, T * ux, T * uy, T * uz)
            control.stored[0] += 0.5 * T * T / numbers[SPRINGS + SPRING * i + STIFFNESS]
            out[first + 5 + i] = T
        out[first], out[first + 1] = out[first + 5], power
        out[first + 2], out[first + 3], out[first + 4] = x, y, z
        for i in range(3):
            elements.proposal[k, i] = out[first + 2 + i] - numbers[PLACE + i]
    return OK
