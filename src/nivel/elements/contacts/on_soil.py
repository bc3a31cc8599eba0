"""Forces on soil: blades and buckets that cut it and carry it, rigid wheels that sink into it; and what they do to its cells at samples.

**Blade.** The wedge before the edge resists with the share s of its force, ds = (1 - s) dx/l into the soil and s dx/l out of it, so that
it never pulls and stands still at rest. The floor behind the edge bears as a strip foundation (Terzaghi; N_γ of Vesic 1973), likewise.
What is cut is carried up to the capacity, and else pushed ahead. What the mouth does not hold falls out. What is carried is mass of the
body from one sample to the next; it was at rest, so its impulse acts on the body until the next sample: momentum is kept.

**Wheel.** Pressure k z^n is a yield that memory follows, with elastic return; shear is (c + p tan φ) s, ds = (v - |v| s) dt/K for each
cell, which for one direction is 1 - exp(-j/K) (Janosi, Hanamoto 1961; cells: Krenn, Gibbesch 2011). At rest nothing creeps.

All work on soil is lost but what it stores as potential energy; that of a sample goes to the account of losses until the next one.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nivel.elements.contacts.soil import (
    ADDED,
    BALANCE_OUT,
    BEYOND,
    CELL,
    CENTRE,
    CHANGED,
    CHANGES,
    CHANGES_OUT,
    COHESION,
    COUNT,
    DENSITY,
    EDGE,
    EXPONENT,
    FAILURE,
    FRICTION,
    GRAVITY,
    IMPULSE,
    INERTIA,
    JUMP,
    KNOWN,
    MASS,
    MODULUS,
    MOMENT_X,
    MOMENT_Y,
    MOMENT_Z,
    MOVED,
    MOVED_OUT,
    NOTED,
    ORIGIN,
    PENDING,
    PERIOD,
    PRESSED,
    REPOSE,
    SHEAR,
    SPILT_OUT,
    STAMP,
    TIME,
    TOOL,
    TURN,
    UNLOAD,
    VOLUME,
    WEIGHT,
    cells_at,
)
from nivel.elements.contacts.soil_cells import MOST_SLIDES, cut, failure_angle, pour, slide, wedge
from nivel.elements.rows import Row, several
from nivel.kernels.algebra.analytic import absolute, maximum, minimum, real
from nivel.kernels.algebra.spatial import dot
from nivel.kernels.core.status import OK
from nivel.kernels.elements.patch import axis, minus
from nivel.kernels.forces.wrench import add_force_at, add_marker_force, add_torque
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import FAMILIES, family
from nivel.kernels.record.record import Elements, record_at
from nivel.kernels.signals.functions import fill_samples
from nivel.native.function import leaf, part, stage

BLADE, WHEEL = 0, 1  # kinds
MOBILISED = 0.01  # [m] of motion over which the resistance of soil comes
SHALLOW = 0.02  # [m] of depth over which the floor comes to bear
FALLS = 0.15  # [s] in which most of what the mouth does not hold falls out
LEAST_RAKE, REST_OF_RAKE = (
    0.26,
    0.2,
)  # [rad] between which a rake counts as it is: from the first to π - δ - φ - the second
STEEP = 0.1  # least cosine of the rim against the ground
NEAR = 1e-6  # share of the period
DAMPS = 2e-3  # [s] by which pressure and shear are ahead, as a damper makes them: what stands on soil comes to rest


class BladeRow(Row):
    """Markers of the ends of the EDGE, of the PLANE and of the middle of the LOAD; CHANGES and two shares are states; WORK: the edge."""

    output: int
    cells: int
    slot: int
    kind: int = BLADE
    plane: int
    changes: int
    left: int
    right: int
    load: int
    push: int
    bearing: int
    rake: float
    capacity: float
    floor: float
    work: Sequence[float] = several(6)


class WheelRow(Row):
    """The marker of the WHEEL has z along the axle."""

    output: int
    cells: int
    slot: int
    kind: int = WHEEL
    plane: int
    changes: int
    wheel: int
    radius: float
    width: float


@stage
def soil_of(machine, k, t):
    """The cells under element k."""
    index = record_at(machine).elements.columns[k]
    return cells_at(np.uint64(real(evaluate_function(machine, index[BladeRow.CELLS], t))))


@stage
def seen_from_corner(cells, A, r, p):
    """A point in axes of the plane (A, r) from the first node."""
    d = minus(p, r)
    x, y = 0.5 * (cells.h.shape[0] - 1) * cells.number[CELL], 0.5 * (cells.h.shape[1] - 1) * cells.number[CELL]
    return dot(axis(A, 0), d) + x, dot(axis(A, 1), d) + y, dot(axis(A, 2), d)


@stage
def look_at_edge(machine, k, cells):
    """The ends of the edge into its work; (x and y of where it looks, by unit length, angle of its nose below the plane, rake)."""
    record = record_at(machine)
    index, n, markers = record.elements.columns[k], record.elements.number[k], record.markers
    i, j, m = index[BladeRow.LEFT], index[BladeRow.RIGHT], index[BladeRow.PLANE]
    A, r = markers.A[m], markers.r[m]
    a, b = seen_from_corner(cells, A, r, markers.r[i]), seen_from_corner(cells, A, r, markers.r[j])
    for c in range(3):
        n[BladeRow.WORK + c], n[BladeRow.WORK + 3 + c] = a[c], b[c]
    x = axis(markers.A[i], 0)
    fx, fy, fz = dot(axis(A, 0), x), dot(axis(A, 1), x), dot(axis(A, 2), x)
    level = np.sqrt(fx * fx + fy * fy + 1e-12)
    down = np.arctan2(-fz, level)
    most = np.pi - cells.number[TOOL] - cells.number[FRICTION] - REST_OF_RAKE
    rake = minimum(maximum(n[BladeRow.RAKE] + down, LEAST_RAKE + 0.0 * down), most + 0.0 * down)
    return fx / level, fy / level, down, rake


@leaf
def mobilised_rate(v, s):
    """Rate of the share of a resistance at the speed v against it."""
    return (maximum(v, 0.0 * v) * (1.0 - s) + minimum(v, 0.0 * v) * s) / MOBILISED


@leaf
def bearing(number, depth, floor):
    """Pressure that soil bears under a strip (Terzaghi 1943, general shear; N_γ of Vesic 1973)."""
    phi = number[FRICTION]
    nq = np.exp(np.pi * np.tan(phi)) * np.tan(0.25 * np.pi + 0.5 * phi) ** 2
    return (
        number[COHESION] * (nq - 1.0) / np.tan(phi)
        + number[WEIGHT] * depth * nq
        + number[WEIGHT] * floor * (nq + 1.0) * np.tan(phi)
    )


@leaf
def inertia_of(volume, density):
    """Of a load about its middle, as a ball."""
    return 0.4 * density * volume * (0.75 * volume / np.pi) ** (2.0 / 3.0)


@part
def give_mass(bodies, b, empty, p, m, j):
    """Body b := what it is without load and a ball of mass m at p, in its frame, of inertia j about its middle."""
    whole = empty[MASS] + m
    bodies.mass[b], bodies.inverse_root_mass[b] = whole, 1.0 / np.sqrt(whole)
    c, J, K, L = bodies.centre_b[b], bodies.inertia_b[b], bodies.inertia_origin_b[b], bodies.whitener_b[b]
    for i in range(3):
        c[i] = (empty[MASS] * empty[CENTRE + i] + m * p[i]) / whole
    reduced, square, far = empty[MASS] * m / whole, 0.0, 0.0
    for i in range(3):
        square += (p[i] - empty[CENTRE + i]) ** 2
        far += c[i] * c[i]
    for i in range(3):
        for q in range(3):
            same = 1.0 if i == q else 0.0
            apart = (p[i] - empty[CENTRE + i]) * (p[q] - empty[CENTRE + q])
            J[i, q] = empty[INERTIA + 3 * i + q] + same * j + reduced * (same * square - apart)
            K[i, q] = J[i, q] + whole * (same * far - c[i] * c[q])
    # the inverse of the lower Cholesky factor
    a = np.sqrt(J[0, 0])
    d, e = J[1, 0] / a, J[2, 0] / a
    f = np.sqrt(J[1, 1] - d * d)
    g = (J[2, 1] - e * d) / f
    h = np.sqrt(J[2, 2] - e * e - g * g)
    L[0, 0], L[0, 1], L[0, 2] = 1.0 / a, 0.0, 0.0
    L[1, 0], L[1, 1], L[1, 2] = -d / (a * f), 1.0 / f, 0.0
    L[2, 0], L[2, 1], L[2, 2] = (d * g - e * f) / (a * f * h), -g / (f * h), 1.0 / h


@stage
def push_blade(machine, k, cells, t):
    """Forces of soil on a blade."""
    record = record_at(machine)
    elements, markers, bodies, out = record.elements, record.markers, record.bodies, record.outputs.value
    index, n, own = elements.columns[k], elements.number[k], cells.load[elements.columns[k, BladeRow.SLOT]]
    i, j, m, first = index[BladeRow.LEFT], index[BladeRow.RIGHT], index[BladeRow.LOAD], index[BladeRow.OUTPUT]
    b, A, number, period = markers.body[i], markers.A[index[BladeRow.PLANE]], cells.number, cells.number[PERIOD]
    empty, mass = cells.empty[index[BladeRow.SLOT]], number[DENSITY] * own[VOLUME]
    if empty[NOTED] == 1.0 and bodies.mass[b] != empty[MASS] + mass:  # of another run, or another moment
        give_mass(bodies, b, empty, markers.position_b[m], mass, inertia_of(own[VOLUME], number[DENSITY]))
    fx, fy, _, rake = look_at_edge(machine, k, cells)
    beta = own[FAILURE]
    if beta == 0.0:
        beta = failure_angle(real(rake), number[FRICTION], number[TOOL], 0.0)
    most, depth = wedge(cells, n[BladeRow.WORK :], fx, fy, rake, beta)
    span = minus(markers.r[j], markers.r[i])
    floor = n[BladeRow.FLOOR]
    bears = np.sqrt(dot(span, span)) * floor * bearing(number, depth, floor)
    bears = bears * minimum(depth / SHALLOW, 1.0 + 0.0 * depth)
    s, c = np.sin(rake + number[TOOL]), np.cos(rake + number[TOOL])
    x, y, z = axis(A, 0), axis(A, 1), axis(A, 2)
    u = (
        s * (fx * x[0] + fy * y[0]) + c * z[0],
        s * (fx * x[1] + fy * y[1]) + c * z[1],
        s * (fx * x[2] + fy * y[2]) + c * z[2],
    )
    v, w = markers.rdot[i], markers.rdot[j]
    v = 0.5 * (v[0] + w[0]), 0.5 * (v[1] + w[1]), 0.5 * (v[2] + w[2])
    push, held = elements.state[index[BladeRow.PUSH]], elements.state[index[BladeRow.BEARING]]
    elements.state_rate[index[BladeRow.PUSH]] += mobilised_rate(dot(u, v), push)
    elements.state_rate[index[BladeRow.BEARING]] += mobilised_rate(-dot(z, v), held)
    p, q = push * most, held * bears
    f0, f1, f2 = q * z[0] - p * u[0], q * z[1] - p * u[1], q * z[2] - p * u[2]
    place = markers.r[i, 0] + 0.5 * span[0], markers.r[i, 1] + 0.5 * span[1], markers.r[i, 2] + 0.5 * span[2]
    power = add_force_at(bodies, b, place, f0, f1, f2)
    if real(t) <= cells.sum[TIME] + period * (1.0 + NEAR):
        g, h = own[IMPULSE:TURN], own[TURN:EDGE]
        power += add_marker_force(bodies, markers, m, g[0] / period, g[1] / period, g[2] / period)
        power += add_torque(bodies, b, h[0] / period, h[1] / period, h[2] / period)
    record.control.power[1] -= power
    out[first], out[first + 1], out[first + 2], out[first + 3] = np.sqrt(f0 * f0 + f1 * f1 + f2 * f2), power, p, q
    out[first + 4], out[first + 5] = depth, mass


@part
def cut_with_blade(machine, k, cells, t):
    """What a blade does to soil in a period: it cuts, takes in, pushes ahead and lets fall; and what it carries is mass of its body."""
    record = record_at(machine)
    index, n, markers, bodies = record.elements.columns[k], record.elements.number[k], record.markers, record.bodies
    own, empty, number = cells.load[index[BladeRow.SLOT]], cells.empty[index[BladeRow.SLOT]], cells.number
    fx, fy, down, rake = look_at_edge(machine, k, cells)
    edge = n[BladeRow.WORK :]
    if own[KNOWN] == 0.0:
        for c in range(6):
            own[EDGE + c] = edge[c]
        own[KNOWN] = 1.0
    own[FAILURE] = failure_angle(rake, number[FRICTION], number[TOOL], own[FAILURE])
    taken, before = cut(cells, edge, own[EDGE:KNOWN]), own[VOLUME]
    holds = n[BladeRow.CAPACITY] * min(max(1.0 - max(down, 0.0) / number[REPOSE], 0.0), 1.0)
    excess = max(before + taken - holds, 0.0)
    ahead = min(excess, taken)
    falls = (excess - ahead) * (1.0 - np.exp(-number[PERIOD] / FALLS))
    if ahead + falls > 0.0:
        pour(cells, edge, fx, fy, ahead + falls)
    own[VOLUME] = before + (taken - ahead) - falls
    for c in range(6):
        own[EDGE + c] = edge[c]
    for c in range(6):
        own[IMPULSE + c] = 0.0
    own[MOVED] += taken + falls
    if own[VOLUME] == before:
        return taken > 0.0
    b, m = markers.body[index[BladeRow.LEFT]], index[BladeRow.LOAD]
    if empty[NOTED] == 0.0:
        empty[NOTED], empty[MASS] = 1.0, bodies.mass[b]
        for i in range(3):
            empty[CENTRE + i] = bodies.centre_b[b, i]
            for q in range(3):
                empty[INERTIA + 3 * i + q] = bodies.inertia_b[b, i, q]
    v, w, r, g = markers.rdot[m], bodies.omega[b], markers.r[m], bodies.gravity
    added = number[DENSITY] * (own[VOLUME] - before)
    j = inertia_of(own[VOLUME], number[DENSITY])
    turned = j - inertia_of(before, number[DENSITY])
    for c in range(3):
        own[IMPULSE + c] = -number[DENSITY] * (taken - ahead) * v[c]
        own[TURN + c] = -max(turned, 0.0) * w[c]
    cells.sum[JUMP] += 0.5 * (added * dot(v, v) + turned * dot(w, w)) - added * dot(g, r)
    give_mass(bodies, b, empty, markers.position_b[m], number[DENSITY] * own[VOLUME], j)
    return True


@leaf
def cells_across(f, g, low, high, at):
    """Between which places u a line f u + g at, with f not zero, is between low and high."""
    a, b = (low - g * at) / f, (high - g * at) / f
    return min(a, b), max(a, b)


@leaf
def rows_under(fx, fy, x, radius, width):
    """Between which places along y, from the centre, nodes at x from the centre may be under a wheel that points along (fx, fy)."""
    low, high = -radius - width, radius + width
    if np.abs(fx) > 1e-9:
        a, b = cells_across(fx, -fy, -0.5 * width, 0.5 * width, x)
        low, high = max(low, a), min(high, b)
    elif np.abs(fy * x) > 0.5 * width:
        return 1.0, 0.0
    if np.abs(fy) > 1e-9:
        a, b = cells_across(fy, fx, -radius, radius, x)
        low, high = max(low, a), min(high, b)
    return low, high


@leaf
def pressure_at(cells, i, j, bottom, ahead):
    """Pressure on a rim that is at the height `bottom` over node (i, j), and elastically so much deeper."""
    number = cells.number
    elastic = maximum(number[UNLOAD] * (cells.h[i, j] - bottom + ahead), 0.0 * bottom)
    sinkage = cells.rest[i, j] - bottom
    if real(sinkage) <= 0.0:
        return 0.0 * elastic
    return minimum(elastic, number[MODULUS] * sinkage ** number[EXPONENT])


@leaf
def sheared(s, v, speed, share):
    """The share of the strength behind `share` = dt/K seconds by metre of sliding with v, of size `speed`: of ds = (v - |v| s) dt/K."""
    q = speed * share
    return s + (v - speed * s) * share / (1.0 + 0.5 * q + q * q / 12.0)


@stage
def press_wheel(machine, k, cells, t, changes):
    """Sums of forces and moments of soil on a wheel; with `changes` the cells sink and shear instead. Returns (along, across, up, moments
    about these axes, greatest sinkage, volume pressed [m³])."""
    record = record_at(machine)
    index, n, markers, bodies = record.elements.columns[k], record.elements.number[k], record.markers, record.bodies
    i, m, cell, number = index[WheelRow.WHEEL], index[WheelRow.PLANE], cells.number[CELL], cells.number
    A, b, R, width = markers.A[m], markers.body[i], n[WheelRow.RADIUS], n[WheelRow.WIDTH]
    c = seen_from_corner(cells, A, markers.r[m], markers.r[i])
    y, ax, ay, az = axis(markers.A[i], 2), axis(A, 0), axis(A, 1), axis(A, 2)
    fx, fy = dot(ay, y), -dot(ax, y)
    level = np.sqrt(fx * fx + fy * fy + 1e-12)
    fx, fy = fx / level, fy / level
    V, W = markers.rdot[i], bodies.omega[b]
    vx, vy, up = dot(ax, V), dot(ay, V), dot(az, V)
    wx, wy, yaw = dot(ax, W), dot(ay, W), dot(az, W)
    forth, aside, roll, spin = fx * vx + fy * vy, fx * vy - fy * vx, fx * wx + fy * wy, fx * wy - fy * wx
    since = min(max(real(t) - cells.sum[TIME], 0.0), 2.0 * number[PERIOD]) / number[SHEAR]
    o = 0.0 * c[0]
    f0, f1, f2, m0, m1, m2, deepest, pressed = o, o, o, o, o, o, 0.0, 0.0
    reach, nodes, rows = real(R) + real(width), cells.h.shape[0], cells.h.shape[1]
    cx, cy, rx, ry = real(c[0]), real(c[1]), real(fx), real(fy)
    if not np.abs(cx + cy) < 1e9:
        return f0, f1, f2, m0, m1, m2, deepest, pressed
    for p in range(
        max(0, np.int64(np.ceil((cx - reach) / cell))), min(nodes - 1, np.int64(np.floor((cx + reach) / cell))) + 1
    ):
        low, high = rows_under(rx, ry, p * cell - cx, real(R), real(width) + cell)
        for q in range(
            max(0, np.int64(np.ceil((cy + low) / cell))), min(rows - 1, np.int64(np.floor((cy + high) / cell))) + 1
        ):
            dx, dy = p * cell - c[0], q * cell - c[1]
            along, across = fx * dx + fy * dy, fx * dy - fy * dx
            if real(along * along) >= real(R * R):
                continue
            upward = np.sqrt(R * R - along * along)
            bottom = c[2] - upward
            if cells.h[p, q] <= real(bottom):
                continue
            # the rim over the soil: along it, and across
            lifted, cosine, sine = up + roll * across, maximum(upward / R, STEEP + o), along / R
            ahead = 0.0 if changes else DAMPS
            pressure = pressure_at(cells, p, q, bottom, -ahead * lifted)
            vt = (forth - yaw * across) * cosine + lifted * sine - spin * R
            va = aside + yaw * along + roll * upward
            speed = np.sqrt(vt * vt + va * va + 1e-24)
            sx, sy = cells.shear[p, q, 0], cells.shear[p, q, 1]
            share = since + ahead / number[SHEAR]
            st, sa = sheared(fx * sx + fy * sy, vt, speed, share), sheared(fx * sy - fy * sx, va, speed, share)
            deepest = max(deepest, real(cells.rest[p, q] - bottom))
            if changes:
                cells.shear[p, q, 0], cells.shear[p, q, 1] = real(fx * st - fy * sa), real(fy * st + fx * sa)
                sunk = cells.h[p, q] - real(bottom) - real(pressure) / number[UNLOAD]
                if sunk > 0.0:
                    cells.h[p, q] -= sunk
                    pressed += sunk * cell * cell
                continue
            # cells at the sides bear with the part of them that is under the rim
            part = minimum(maximum((0.5 * width - absolute(across)) / cell + 0.5, o), 1.0 + o)
            area = part * cell * cell / cosine
            strength = number[COHESION] + pressure * np.tan(number[FRICTION])
            ft, fa, fn = -area * strength * st, -area * strength * sa, area * pressure
            rise, drive = ft * sine + fn * cosine, ft * cosine - fn * sine
            f0, f1, f2 = f0 + drive, f1 + fa, f2 + rise
            m0, m1, m2 = m0 + rise * across + fa * upward, m1 - R * ft, m2 + fa * along - drive * across
    return f0, f1, f2, m0, m1, m2, deepest, pressed


@stage
def carry_wheel(machine, k, cells, t):
    """Forces of soil on a wheel."""
    record = record_at(machine)
    markers, out = record.markers, record.outputs.value
    index = record.elements.columns[k]
    f0, f1, f2, m0, m1, m2, deepest, _ = press_wheel(machine, k, cells, t, False)
    i, first, A = index[WheelRow.WHEEL], index[WheelRow.OUTPUT], markers.A[index[WheelRow.PLANE]]
    y, x, z = axis(markers.A[i], 2), axis(A, 0), axis(A, 2)
    a, b = dot(axis(A, 1), y), -dot(x, y)
    level = np.sqrt(a * a + b * b + 1e-12)
    a, b, v = a / level, b / level, axis(A, 1)
    f = a * x[0] + b * v[0], a * x[1] + b * v[1], a * x[2] + b * v[2]
    s = a * v[0] - b * x[0], a * v[1] - b * x[1], a * v[2] - b * x[2]
    power = add_marker_force(
        record.bodies,
        markers,
        i,
        f0 * f[0] + f1 * s[0] + f2 * z[0],
        f0 * f[1] + f1 * s[1] + f2 * z[1],
        f0 * f[2] + f1 * s[2] + f2 * z[2],
    )
    power += add_torque(
        record.bodies,
        markers.body[i],
        m0 * f[0] + m1 * s[0] + m2 * z[0],
        m0 * f[1] + m1 * s[1] + m2 * z[1],
        m0 * f[2] + m1 * s[2] + m2 * z[2],
    )
    record.control.power[1] -= power
    out[first], out[first + 1], out[first + 2], out[first + 3] = f2, power, f0, f1
    out[first + 4], out[first + 5] = m1, deepest


@leaf
def potential(cells):
    """Potential energy [J] of what was added to the cells."""
    sums, g = cells.sum, cells.number[GRAVITY:ORIGIN]
    moments = g[0] * sums[MOMENT_X] + g[1] * sums[MOMENT_Y] + g[2] * sums[MOMENT_Z]
    return -cells.number[DENSITY] * (moments + cells.number[ORIGIN] * sums[ADDED])


@family
def apply(machine, number, t):
    """Forces of all elements on soil, and what soil stores and loses."""
    record = record_at(machine)
    elements = record.elements
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, cells = elements.columns[k], soil_of(machine, k, t)
        if index[BladeRow.KIND] == BLADE:
            push_blade(machine, k, cells, t)
        else:
            carry_wheel(machine, k, cells, t)
        out, own = record.outputs.value[np.int64(index[BladeRow.OUTPUT]) :], cells.load[index[BladeRow.SLOT]]
        out[MOVED_OUT], out[CHANGES_OUT], out[SPILT_OUT] = own[MOVED], own[CHANGES], cells.sum[BEYOND]
        out[BALANCE_OUT] = cells.sum[ADDED]
        for n in range(cells.load.shape[0]):
            out[BALANCE_OUT] += cells.load[n, VOLUME]
        if index[BladeRow.SLOT] == 0:
            left, period = cells.sum[TIME] + cells.number[PERIOD] - real(t), cells.number[PERIOD]
            record.control.stored[0] += potential(cells) + cells.sum[PENDING] * max(left, 0.0) / period
            if left >= -NEAR * period:
                record.control.power[1] += cells.sum[PENDING] / period
    return OK


@stage
def is_due(machine, k):
    """Whether the cells under element k are sampled now."""
    record = record_at(machine)
    sampled, state = record.sampled, record.elements.columns[k, BladeRow.CHANGES]
    for n in range(sampled.state.shape[0]):
        if sampled.state[n] == state:
            return sampled.due[n] == 1
    return False


@stage
def change_cells(machine, k, t):
    """What element k does to its cells in a period; behind the last one on a soil that slides."""
    record = record_at(machine)
    index, cells = record.elements.columns[k], soil_of(machine, k, t)
    slot, sums, changed = np.int64(index[BladeRow.SLOT]), cells.sum, False
    own = cells.load[slot]
    if slot == 0:
        cells.turn[STAMP] += 1
        left = max(sums[TIME] + cells.number[PERIOD] - t, 0.0) / cells.number[PERIOD]
        sums[JUMP] = -potential(cells) - left * sums[PENDING]
    if index[BladeRow.KIND] == BLADE:
        changed = cut_with_blade(machine, k, cells, t)
    else:
        _, _, _, _, _, _, _, pressed = press_wheel(machine, k, cells, t, True)
        sums[PRESSED] += pressed
        own[MOVED] += pressed
        changed = True
    if slot == cells.load.shape[0] - 1:
        changed = changed or cells.turn[COUNT] > 0
        slide(cells, MOST_SLIDES)
        sums[PENDING], sums[TIME] = -sums[JUMP] - potential(cells), t
    # forces that end at a sample are a change too
    if changed or own[CHANGED] > 0.0:
        own[CHANGES] += 1.0
    own[CHANGED] = 1.0 if changed else 0.0
    record.outputs.value[np.int64(index[BladeRow.OUTPUT]) + CHANGES_OUT] = own[CHANGES]


@family
def sample(machine, job, t):
    """The hook SAMPLE of machines with soil: first the cells change, then the rest is sampled."""
    record = record_at(machine)
    for k in range(record.watched.followed[3], record.watched.followed[4]):
        if is_due(machine, k):
            change_cells(machine, k, t)
    fill_samples(machine, t)
    return OK


def rows_on_soil(elements: Elements) -> tuple[int, int]:
    """First element on soil, and one past the last."""
    for address, (first, last) in zip(elements.address, elements.span, strict=True):
        if FAMILIES.get(int(address)) is apply:
            return int(first), int(last)
    return 0, 0
