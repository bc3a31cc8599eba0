"""Linear equations (1 - s ∂f/∂y) x = r of the equations of motion as ẏ = f(t, y), for any s, real or complex, from derivatives found once.

As in `nivel.kernels.residual.shifted_along`, with Δv = r_v + s Δv̇, Δx = r_x + s Δẋ and Δq = X (r_q + s Δv):

    [M + s D + s K X s, C_qᵀ; ∂C̈/∂v̇ + …, 0] [Δv̇, Δẋ; Δλ] = -D (r_v, r_x) - K X (r_q + s r_v)

so a right-hand side costs products with the entries of D and K instead of evaluations. X is 1 for plain positions. Euler parameters turn
with the body, θ̇ = ½ θ ∘ (0, ω̄), and 1 - s ∂θ̇/∂θ has the inverse (1 + a Θ)/(1 + a² ω̄²), Θ d = d ∘ (0, ω̄), a = s/2, since Θ² = -ω̄².
The energies at the end of y, on which nothing depends, have x = r.

Of derivatives and of the state the values alone count, whatever r is: where r is of dual numbers, x has the slopes of r, not those that it
has by what (1 - s ∂f/∂y) is. That is enough for iterations.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rotation import angular_velocity
from nivel.kernels.algebra.rows import clear, copy
from nivel.kernels.record.record import NONE, record_at
from nivel.kernels.residual.residual import known_multiplier
from nivel.kernels.residual.tangent import differentiate_parts
from nivel.kernels.solve.newton_matrix import factorise_entries, solve_entries
from nivel.native.function import leaf


@leaf
def keep_multipliers(machine):
    """`residual.lam` := the multipliers of the state last evaluated."""
    record = record_at(machine)
    for k in range(record.residual.lam.shape[0]):
        record.residual.lam[k] = known_multiplier(record, k)


@leaf
def find_parts(machine, t, y, rate):
    """Derivatives at the state y with the rate f(t, y) and the multipliers kept. Returns a status."""
    record = record_at(machine)
    residual = record.residual
    n = residual.vdot.shape[0]
    positions = np.int64(y.shape[0]) - n - record.newton.state.shape[0] - 2
    copy(y, residual.y)
    for k in range(n):
        residual.vdot[k] = rate[positions + k]
    return differentiate_parts(machine, t)


@leaf
def three_values(x, k):
    """Values of three entries from k on."""
    return real(x[k]), real(x[k + 1]), real(x[k + 2])


@leaf
def four_values(x, k):
    """Values of four entries from k on."""
    return real(x[k]), real(x[k + 1]), real(x[k + 2]), real(x[k + 3])


@leaf
def turned(theta, w, d, x, a):
    """(1 + a Θ)/(1 + a² ω̄²) of d + a θ ∘ (0, x): four numbers."""
    x0, x1, x2 = a * x[0], a * x[1], a * x[2]
    d0 = d[0] - theta[1] * x0 - theta[2] * x1 - theta[3] * x2
    d1 = d[1] + theta[0] * x0 - theta[3] * x1 + theta[2] * x2
    d2 = d[2] + theta[3] * x0 + theta[0] * x1 - theta[1] * x2
    d3 = d[3] - theta[2] * x0 + theta[1] * x1 + theta[0] * x2
    w0, w1, w2 = a * w[0], a * w[1], a * w[2]
    share = 1.0 / (1.0 + w0 * w0 + w1 * w1 + w2 * w2)
    return (
        share * (d0 - d1 * w0 - d2 * w1 - d3 * w2),
        share * (d1 + d0 * w0 - d3 * w1 + d2 * w2),
        share * (d2 + d3 * w0 + d0 * w1 - d1 * w2),
        share * (d3 - d2 * w0 + d1 * w1 + d0 * w2),
    )


@leaf
def combine(machine, factors, s):
    """factors.value := M + s D + s K X s."""
    record = record_at(machine)
    newton, y = record.newton, record.residual.y
    M, D, K, value = newton.shifted.M, newton.shifted.D, newton.shifted.K, factors.value
    n, states = newton.place.shape[0], newton.state.shape[0]
    positions = np.int64(y.shape[0]) - n - states - 2
    for p in range(M.shape[0]):
        value[p] = real(M[p]) + s * real(D[p])
    for j in range(n):
        first = np.int64(newton.entry_start[j])
        count = np.int64(newton.entry_start[j + 1]) - first
        if newton.place[j, 1] == NONE:
            for e in range(first, first + count):
                p = newton.entry[e, 1]
                value[p] += s * s * real(K[p])
        elif newton.place[j, 1] == 0:
            # the columns of the three axes have the same rows
            a = 0.5 * s
            w0, w1, w2 = real(y[positions + j]), real(y[positions + j + 1]), real(y[positions + j + 2])
            share = s * s / (1.0 + a * a * (w0 * w0 + w1 * w1 + w2 * w2))
            for e in range(first, first + count):
                p0, p1, p2 = newton.entry[e, 1], newton.entry[e + count, 1], newton.entry[e + 2 * count, 1]
                k0, k1, k2 = real(K[p0]), real(K[p1]), real(K[p2])
                value[p0] += share * (k0 + a * (k2 * w1 - k1 * w2))
                value[p1] += share * (k1 + a * (k0 * w2 - k2 * w0))
                value[p2] += share * (k2 + a * (k1 * w0 - k0 * w1))


@leaf
def factorise_shifted(machine, factors, s):
    """Factors for this s. Returns a status; the unknown without a pivot is left in control.failure."""
    record = record_at(machine)
    combine(machine, factors, s)
    return factorise_entries(record.newton, factors, record.control.failure)


@leaf
def move_by_right_side(newton, y, factors, s):
    """factors.moved := X (r_q + s r_v); of rotations, r is overwritten by it as Euler parameters."""
    r, moved = factors.r, factors.moved
    n = newton.place.shape[0]
    positions = np.int64(y.shape[0]) - n - newton.state.shape[0] - 2
    for k in range(n):
        p, axis, v = np.int64(newton.place[k, 0]), newton.place[k, 1], positions + k
        if axis == NONE:
            moved[k] = r[p] + s * r[v]
        elif axis == 0:
            theta, d = four_values(y, p), r[p : p + 4]
            d[0], d[1], d[2], d[3] = turned(theta, three_values(y, v), d, r[v : v + 3], 0.5 * s)
            angular_velocity(theta, d, moved[k : k + 3])


@leaf
def load_right_side(newton, factors, positions):
    """factors.b := -D (r_v, r_x) - K moved."""
    b, r, moved, D, K = factors.b, factors.r, factors.moved, newton.shifted.D, newton.shifted.K
    n = newton.place.shape[0]
    clear(b)
    for j in range(n + newton.state.shape[0]):
        along = r[positions + j]
        for e in range(newton.entry_start[j], newton.entry_start[j + 1]):
            row, p = newton.entry[e, 0], newton.entry[e, 1]
            b[row] -= real(D[p]) * along
            if j < n:
                b[row] -= real(K[p]) * moved[j]


@leaf
def solve_shifted_parts(machine, factors, s):
    """Overwrite factors.r (ny,) with x, for factors of the same s."""
    record = record_at(machine)
    newton, y, r, b = record.newton, record.residual.y, factors.r, factors.b
    n, states = newton.place.shape[0], newton.state.shape[0]
    positions = np.int64(y.shape[0]) - n - states - 2
    move_by_right_side(newton, y, factors, s)
    load_right_side(newton, factors, positions)
    solve_entries(newton, factors)
    for k in range(n + states):
        b[k] *= s
    for k in range(n):
        p, axis, v = np.int64(newton.place[k, 0]), newton.place[k, 1], positions + k
        if axis == NONE:
            r[p] += s * (r[v] + b[k])
        elif axis == 0:
            none = (0.0, 0.0, 0.0, 0.0)
            c0, c1, c2, c3 = turned(four_values(y, p), three_values(y, v), none, b[k : k + 3], 0.5 * s)
            r[p] += c0
            r[p + 1] += c1
            r[p + 2] += c2
            r[p + 3] += c3
    for k in range(n + states):
        r[positions + k] += b[k]
