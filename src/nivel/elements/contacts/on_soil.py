"""Forces on soil: blades and buckets that cut and carry it, wheels and tracks that sink into it; and what they do to its cells at samples.

**Blade.** The wedge before the edge resists with the share s of its force, ds = (1 - s) dx/l into the soil and s dx/l out of it, so that
it never pulls and stands still at rest. The floor behind the edge bears as a strip foundation (Terzaghi; N_γ of Vesic 1973), likewise.
What is cut is carried up to the capacity, and else pushed ahead. What the mouth does not hold falls out, onto the ground or into the
opening of another one. What is carried is mass of the
body from one sample to the next; it was at rest, so its impulse acts on the body until the next sample: momentum is kept.

**Wheel.** Pressure k z^n is a yield that memory follows, with elastic return; shear is (c + p tan φ) s, ds = (v - |v| s) dt/K for each
cell, which for one direction is 1 - exp(-j/K) (Janosi, Hanamoto 1961; cells: Krenn, Gibbesch 2011). At rest nothing creeps.

**Track.** See `nivel.elements.contacts.tracks`.

All work on soil is lost but what it stores as potential energy; that of a sample goes to the account of losses until the next one.
"""

import numpy as np

from nivel.elements.contacts.soil import MOVED_OUT, ForceRow, SoilRow
from nivel.elements.contacts.soil_cells import (
    FAR,
    cut,
    failure_angle,
    mobilised_rate,
    nodes_between,
    open_mouth,
    pour,
    pressure_at,
    seen_from_corner,
    slide,
    wedge,
)
from nivel.elements.contacts.tracks import OUTPUTS, crawl, press_cells
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import absolute, arctan2, maximum, minimum, real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import axis, minus, plus, put, seen, seen_flat, times, turned, turned_flat
from nivel.kernels.elements.soil import ADDED, BEYOND, LOST, STAMP, STORED, cells_at
from nivel.kernels.forces.wrench import add_force_at, add_marker_force, add_torque
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.kernels.signals.functions import fill_samples
from nivel.native.function import leaf, part, stage

SHALLOW = 0.02  # [m] of depth over which the floor comes to bear
FALLS = 0.15  # [s] in which most of what the mouth does not hold falls out
LEAST_RAKE, REST = 0.26, 0.2  # [rad] between which a rake counts as it is: from the first to π - δ - φ - the second
STEEP = 0.1  # least cosine of the rim against the ground
NEAR = 1e-6  # share of the period
DAMPS = 2e-3  # [s] by which pressure and shear are ahead, as a damper makes them: what stands on soil comes to rest


@stage
def look_at_edge(markers, index, n, cells):
    """(ends of the edge from the first node (6,), x and y of where it looks, by unit length, angle of its nose below the plane, rake)."""
    i, m, number = index[ForceRow.LEFT], index[ForceRow.PLANE], cells.number
    a = seen_from_corner(cells, markers, m, markers.r[i])
    b = seen_from_corner(cells, markers, m, markers.r[index[ForceRow.RIGHT]])
    fx, fy, fz = seen(markers.A[m], axis(markers.A[i], 0))
    level = np.sqrt(fx * fx + fy * fy + 1e-12)
    down = arctan2(-fz, level)
    most = np.pi - number[SoilRow.TOOL_FRICTION] - number[SoilRow.FRICTION_ANGLE] - REST
    rake = minimum(maximum(n[ForceRow.RAKE] + down, LEAST_RAKE + 0.0 * down), most + 0.0 * down)
    return a + b, fx / level, fy / level, down, rake


@leaf
def bearing(number, depth, floor):
    """Pressure that soil bears under a strip (Terzaghi 1943, general shear; N_γ of Vesic 1973)."""
    phi, weight = number[SoilRow.FRICTION_ANGLE], -number[SoilRow.DENSITY] * number[SoilRow.GRAVITY + 2]
    nq = np.exp(np.pi * np.tan(phi)) * np.tan(0.25 * np.pi + 0.5 * phi) ** 2
    held = number[SoilRow.COHESION] * (nq - 1.0) / np.tan(phi)
    return held + weight * depth * nq + weight * floor * (nq + 1.0) * np.tan(phi)


@leaf
def load_of(cells, volume):
    """(mass, inertia about its middle) of a load, as a ball."""
    mass = cells.number[SoilRow.DENSITY] * volume
    return mass, 0.4 * mass * (0.75 * volume / np.pi) ** (2.0 / 3.0)


@part
def give_mass(bodies, b, cells, slot, p):
    """Body b := what it is without load and a ball at p, in its frame, of the volume that is carried in this slot."""
    m, j = load_of(cells, cells.volume[slot])
    c, J, K, L = bodies.centre_b[b], bodies.inertia_b[b], bodies.inertia_origin_b[b], bodies.whitener_b[b]
    own = cells.body[slot]
    if (
        own[0] == 0.0 or own[0] == bodies.mass[b]
    ):  # of a body without load in the frame that it has here: coordinates move frames
        own[0] = bodies.mass[b]
        put(own, 1, c)
        for i in range(3):
            put(own, 4 + 3 * i, J[i])
    whole, lever = own[0] + m, minus(p, own[1:4])
    bodies.mass[b], bodies.inverse_root_mass[b] = whole, 1.0 / np.sqrt(whole)
    put(c, 0, plus(own[1:4], times(m / whole, lever)))
    for i in range(3):
        for q in range(3):
            same = 1.0 if i == q else 0.0
            apart = same * dot(lever, lever) - lever[i] * lever[q]
            J[i, q] = own[4 + 3 * i + q] + same * j + own[0] * m / whole * apart
            K[i, q] = J[i, q] + whole * (same * dot(c, c) - c[i] * c[q])
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
def push_blade(machine, index, n, cells, passed):
    """Forces of soil on a blade; returns its outputs."""
    record = record_at(machine)
    markers, bodies, share, rate = record.markers, record.bodies, record.elements.state, record.elements.state_rate
    slot, number, period = index[ForceRow.SLOT], cells.number, cells.number[SoilRow.PERIOD]
    i, j, m = index[ForceRow.LEFT], index[ForceRow.RIGHT], index[ForceRow.LOAD]
    push, held = index[ForceRow.PUSH], index[ForceRow.BEARING]
    b, A, (mass, _) = markers.body[i], markers.A[index[ForceRow.PLANE]], load_of(cells, cells.volume[slot])
    if bodies.mass[b] != cells.body[slot, 0] + mass:  # at the start; and that of another run or moment
        give_mass(bodies, b, cells, slot, markers.position_b[m])
    edge, fx, fy, _, rake = look_at_edge(markers, index, n, cells)
    beta = failure_angle(rake, number[SoilRow.FRICTION_ANGLE], number[SoilRow.TOOL_FRICTION])
    most, depth = wedge(cells, edge, fx, fy, rake, beta)
    span, z, turn = minus(markers.r[j], markers.r[i]), axis(A, 2), rake + number[SoilRow.TOOL_FRICTION]
    bears = np.sqrt(dot(span, span)) * n[ForceRow.FLOOR] * bearing(number, depth, n[ForceRow.FLOOR])
    u = turned(A, (np.sin(turn) * fx, np.sin(turn) * fy, np.cos(turn)))
    v, place = times(0.5, plus(markers.rdot[i], markers.rdot[j])), times(0.5, plus(markers.r[i], markers.r[j]))
    rate[push] += mobilised_rate(dot(u, v), share[push])
    rate[held] += mobilised_rate(-dot(z, v), share[held])
    p, q = share[push] * most, share[held] * bears * minimum(depth / SHALLOW, 1.0 + 0.0 * depth)
    f = minus(times(q, z), times(p, u))
    power = add_force_at(bodies, b, place, f)
    if passed <= period * (1.0 + NEAR):
        power += add_marker_force(bodies, markers, m, times(1.0 / period, cells.impulse[slot, :3]))
        power += add_torque(bodies, b, times(1.0 / period, cells.impulse[slot, 3:]))
    return np.sqrt(dot(f, f)), power, p, q, depth, mass


@part
def cut_with_blade(machine, index, n, cells):
    """What a blade does to soil in a period: it cuts, takes in, pushes ahead and lets fall; and what it carries is mass of its body."""
    record = record_at(machine)
    markers, bodies, slot, number = record.markers, record.bodies, index[ForceRow.SLOT], cells.number
    edge, fx, fy, down, _ = look_at_edge(markers, index, n, cells)
    before, known = cells.volume[slot], record.elements.state[index[ForceRow.CHANGED]] >= 0.0
    corner, far, plane = index[ForceRow.NEAR], index[ForceRow.FAR], index[ForceRow.PLANE]
    if corner != NONE:
        a, b = (
            seen_from_corner(cells, markers, plane, markers.r[corner]),
            seen_from_corner(cells, markers, plane, markers.r[far]),
        )
        open_mouth(cells, slot, a, b, fx, fy)
    dug = cut(cells, edge, cells.edge[slot]) if known else 0.0
    taken = dug + cells.fallen[slot]
    cells.fallen[slot] = 0.0
    holds = n[ForceRow.CAPACITY] * min(max(1.0 - max(down, 0.0) / number[SoilRow.REPOSE], 0.0), 1.0)
    excess = max(before + taken - holds, 0.0)
    ahead = min(excess, taken)
    falls = (excess - ahead) * (1.0 - np.exp(-number[SoilRow.PERIOD] / FALLS))
    if ahead + falls > 0.0:
        pour(cells, edge, fx, fy, ahead + falls, n[ForceRow.CAST_AHEAD], n[ForceRow.CAST_LEFT])
    cells.volume[slot] = before + (taken - ahead) - falls
    cells.moved[slot] += dug + falls
    b, m = markers.body[index[ForceRow.LEFT]], index[ForceRow.LOAD]
    v, w = markers.rdot[m], bodies.omega[b]
    (mass, inertia), (mass_before, inertia_before) = load_of(cells, cells.volume[slot]), load_of(cells, before)
    added, turned = mass - mass_before, inertia - inertia_before
    for c in range(3):
        cells.edge[slot, c], cells.edge[slot, 3 + c] = edge[c], edge[3 + c]
        cells.impulse[slot, c] = -number[SoilRow.DENSITY] * (taken - ahead) * v[c]
        cells.impulse[slot, 3 + c] = -max(turned, 0.0) * w[c]
    if added != 0.0:
        cells.sum[LOST] += added * (dot(bodies.gravity, markers.r[m]) - 0.5 * dot(v, v)) - 0.5 * turned * dot(w, w)
        give_mass(bodies, b, cells, slot, markers.position_b[m])


@leaf
def sheared(s, v, speed, share):
    """The share of the strength behind `share` = dt/K seconds by metre of sliding with v, of size `speed`: of ds = (v - |v| s) dt/K."""
    q = speed * share
    return s + (v - speed * s) * share / (1.0 + 0.5 * q + q * q / 12.0)


@stage
def roll_wheel(machine, index, n, cells, passed, changes):
    """Forces of soil on a wheel, cell by cell; returns its outputs. With `changes` the cells sink and shear instead, and it has no force.
    It points along f; s : to the side of its axle, z : out of the plane."""
    record = record_at(machine)
    markers, bodies = record.markers, record.bodies
    number, cell, tangent = cells.number, cells.number[SoilRow.CELL], np.tan(cells.number[SoilRow.FRICTION_ANGLE])
    i, m, since = index[ForceRow.WHEEL], index[ForceRow.PLANE], min(max(passed, 0.0), number[SoilRow.PERIOD])
    A, R, width = markers.A[m], n[ForceRow.RADIUS], n[ForceRow.WIDTH]
    c, z = seen_from_corner(cells, markers, m, markers.r[i]), axis(A, 2)
    f = cross(axis(markers.A[i], 2), z)
    f = times(1.0 / np.sqrt(dot(f, f) + 1e-12), f)
    s, fx, fy = cross(z, f), dot(axis(A, 0), f), dot(axis(A, 1), f)
    V, W = markers.rdot[i], bodies.omega[markers.body[i]]
    (forth, aside, up), (roll, spin, yaw) = turned_flat(f + s + z, V), turned_flat(f + s + z, W)
    ahead, o = 0.0 if changes else DAMPS, 0.0 * c[0]
    f0, f1, f2, m0, m1, m2, deepest = o, o, o, o, o, o, 0.0
    cx, cy, half = real(c[0]), real(c[1]), 0.5 * (real(width) + cell)
    # a place that is no number ends the run elsewhere
    reach = real(R) if np.abs(cx + cy) < FAR else -FAR
    rx, ry = np.abs(real(fx)) * reach + np.abs(real(fy)) * half, np.abs(real(fy)) * reach + np.abs(real(fx)) * half
    p0, p1 = nodes_between(cx - rx, cx + rx, cell, cells.h.shape[0])
    q0, q1 = nodes_between(cy - ry, cy + ry, cell, cells.h.shape[1])
    for p in range(p0, p1):
        for q in range(q0, q1):
            dx, dy = p * cell - c[0], q * cell - c[1]
            along, across = fx * dx + fy * dy, fx * dy - fy * dx
            # cells at the sides bear with the part of them that is under the rim
            part = minimum((0.5 * width - absolute(across)) / cell + 0.5, 1.0 + o)
            square, above = R * R - along * along, real(c[2]) - cells.h[p, q]
            if real(part) <= 0.0 or real(square) <= max(above, 0.0) ** 2:
                continue
            upward = np.sqrt(square)
            bottom = c[2] - upward
            # the rim over the soil: along it, and across
            lifted, cosine, sine = up + roll * across, maximum(upward / R, STEEP + o), along / R
            pressure = pressure_at(number, cells.h[p, q], cells.rest[p, q], bottom, -ahead * lifted)
            vt = (forth - yaw * across) * cosine + lifted * sine - spin * R
            va = aside + yaw * along + roll * upward
            speed = np.sqrt(vt * vt + va * va + 1e-24)
            sx, sy = cells.shear[p, q, 0], cells.shear[p, q, 1]
            share = (since + ahead) / number[SoilRow.SHEAR_LENGTH]
            st, sa = sheared(fx * sx + fy * sy, vt, speed, share), sheared(fx * sy - fy * sx, va, speed, share)
            deepest = max(deepest, real(cells.rest[p, q] - bottom))
            if changes:
                cells.shear[p, q, 0], cells.shear[p, q, 1] = real(fx * st - fy * sa), real(fy * st + fx * sa)
                sunk = cells.h[p, q] - real(bottom) - real(pressure) / number[SoilRow.UNLOADING]
                if sunk > 0.0:
                    cells.h[p, q] -= sunk
                    cells.moved[index[ForceRow.SLOT]] += sunk * cell * cell
                continue
            area = part * cell * cell / cosine
            strength = number[SoilRow.COHESION] + pressure * tangent
            ft, fa, fn = -area * strength * st, -area * strength * sa, area * pressure
            rise, drive = ft * sine + fn * cosine, ft * cosine - fn * sine
            f0, f1, f2 = f0 + drive, f1 + fa, f2 + rise
            m0, m1, m2 = m0 + rise * across + fa * upward, m1 - R * ft, m2 + fa * along - drive * across
    power = add_marker_force(bodies, markers, i, seen_flat(f + s + z, (f0, f1, f2)))
    power += add_torque(bodies, markers.body[i], seen_flat(f + s + z, (m0, m1, m2)))
    return f2, power, f0, f1, m1, deepest


@element
def apply(machine, index, n, t):
    """Forces of an element on soil; with the first on a soil also what that stores and loses."""
    record = record_at(machine)
    cells = cells_at(np.uint64(real(evaluate_function(machine, index[ForceRow.CELLS], t))))
    out, sums, slot, period = record.outputs.value, cells.sum, index[ForceRow.SLOT], cells.number[SoilRow.PERIOD]
    passed, first = real(t - record.elements.state[index[ForceRow.CHANGED]]), np.int64(index[ForceRow.OUTPUT])
    if index[ForceRow.FRONT] != NONE:
        power, behind = crawl(machine, index, n, cells, DAMPS), OUTPUTS
    else:
        if index[ForceRow.WHEEL] == NONE:
            told = push_blade(machine, index, n, cells, passed)
        else:
            told = roll_wheel(machine, index, n, cells, passed, False)
        put(out, first, told[:3])
        put(out, first + 3, told[3:])
        power, behind = told[1], MOVED_OUT
    put(out, first + behind, (cells.moved[slot], sums[ADDED] + cells.volume.sum() + cells.fallen.sum(), sums[BEYOND]))
    record.control.power[1] -= power
    left = 1.0 - passed / period
    if slot == 0:
        record.control.stored[0] += sums[STORED] + sums[LOST] * max(left, 0.0)
    if slot == 0 and left >= -NEAR:
        record.control.power[1] += sums[LOST] / period


@family
def sample(machine, job, t):
    """The hook SAMPLE of machines with soil: first the cells change, then the rest is sampled. The first element on a soil begins its
    sample, behind the last one it slides."""
    record = record_at(machine)
    for k in range(record.watched.followed[3], record.watched.followed[4]):
        index, n = record.elements.columns[k], record.elements.number[k]
        cells = cells_at(np.uint64(real(evaluate_function(machine, index[ForceRow.CELLS], t))))
        sums, slot, period = cells.sum, index[ForceRow.SLOT], cells.number[SoilRow.PERIOD]
        passed = t - record.elements.state[index[ForceRow.CHANGED]]
        if passed < (1.0 - NEAR) * period:
            continue
        if slot == 0:
            cells.turn[STAMP] += 1
            sums[LOST] = sums[STORED] + max(1.0 - passed / period, 0.0) * sums[LOST]
        if index[ForceRow.FRONT] != NONE:
            press_cells(machine, index, n, cells)
        elif index[ForceRow.WHEEL] == NONE:
            cut_with_blade(machine, index, n, cells)
        else:
            roll_wheel(machine, index, n, cells, passed, True)
        if slot == cells.volume.shape[0] - 1:
            slide(cells)
            sums[LOST] -= sums[STORED]
    return fill_samples(machine, t)
