"""Rigid wheels on soil: the forces of its cells, and what they do to these at samples.

Pressure k z^n is a yield that memory follows, with elastic return; shear is (c + p tan φ) s, ds = (v - |v| s) dt/K for each cell, which
for one direction is 1 - exp(-j/K) (Janosi, Hanamoto 1961; cells: Krenn, Gibbesch 2011). At rest nothing creeps. All work on soil is lost.
"""

from __future__ import annotations

import numpy as np

from nivel.elements.rows import Row, element
from nivel.kernels.algebra.analytic import absolute, maximum, minimum, real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import axis, minus, plus, seen, seen_flat, times, turned_flat
from nivel.kernels.elements.soil import cells_at
from nivel.kernels.forces.wrench import add_marker_force, add_torque
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.kernels.signals.functions import fill_samples
from nivel.native.function import leaf, stage

STEEP = 0.1  # least cosine of the rim against the ground
NEAR = 1e-6  # share of the period
FAR = 1e9  # [m] beyond which a place is none
DAMPS = 2e-3  # [s] by which pressure and shear are ahead, as a damper makes them: what stands on soil comes to rest


class SoilRow(Row):
    """Numbers of a soil: the side of a CELL [m], and those of its record."""

    cell: float
    cohesion: float
    friction_angle: float
    modulus: float
    exponent: float
    unloading: float
    shear_length: float
    period: float


class WheelRow(Row):
    """The marker of the WHEEL has z along the axle; CHANGED : the state that is the time of the last change."""

    output: int
    cells: int
    plane: int
    changed: int
    wheel: int
    radius: float
    width: float


@leaf
def pressure_at(cells, i, j, bottom, ahead):
    """Pressure on a rim that is at the height `bottom` over node (i, j), and elastically so much deeper."""
    number = cells.number
    elastic = maximum(number[SoilRow.UNLOADING] * (cells.h[i, j] - bottom + ahead), 0.0 * bottom)
    sinkage = cells.rest[i, j] - bottom
    if real(sinkage) <= 0.0:
        return 0.0 * elastic
    return minimum(elastic, number[SoilRow.MODULUS] * sinkage ** number[SoilRow.EXPONENT])


@leaf
def sheared(s, v, speed, share):
    """The share of the strength behind `share` = dt/K seconds by metre of sliding with v, of size `speed`: of ds = (v - |v| s) dt/K."""
    q = speed * share
    return s + (v - speed * s) * share / (1.0 + 0.5 * q + q * q / 12.0)


@stage
def roll_wheel(machine, index, n, t, changes):
    """Forces of soil on a wheel, cell by cell; with `changes` the cells sink and shear instead. It points along f; s : to the side of its
    axle, z : out of the plane."""
    record = record_at(machine)
    markers, bodies, out = record.markers, record.bodies, record.outputs.value
    cells = cells_at(np.uint64(real(evaluate_function(machine, index[WheelRow.CELLS], t))))
    number, cell, tangent = cells.number, cells.number[SoilRow.CELL], np.tan(cells.number[SoilRow.FRICTION_ANGLE])
    i, m, first = index[WheelRow.WHEEL], index[WheelRow.PLANE], index[WheelRow.OUTPUT]
    A, R, width = markers.A[m], n[WheelRow.RADIUS], n[WheelRow.WIDTH]
    passed = real(t - record.elements.state[index[WheelRow.CHANGED]])
    if changes and passed < (1.0 - NEAR) * number[SoilRow.PERIOD]:
        return
    # the centre from the first node, in axes of the plane
    corner = 0.5 * cell * (cells.h.shape[0] - 1), 0.5 * cell * (cells.h.shape[1] - 1), 0.0
    c, z = plus(seen(A, minus(markers.r[i], markers.r[m])), corner), axis(A, 2)
    f = cross(axis(markers.A[i], 2), z)
    f = times(1.0 / np.sqrt(dot(f, f) + 1e-12), f)
    s, fx, fy = cross(z, f), dot(axis(A, 0), f), dot(axis(A, 1), f)
    V, W = markers.rdot[i], bodies.omega[markers.body[i]]
    (forth, aside, up), (roll, spin, yaw) = turned_flat(f + s + z, V), turned_flat(f + s + z, W)
    since = min(max(passed, 0.0), number[SoilRow.PERIOD])
    ahead, o = 0.0 if changes else DAMPS, 0.0 * c[0]
    f0, f1, f2, m0, m1, m2, deepest = o, o, o, o, o, o, 0.0
    cx, cy, half = real(c[0]), real(c[1]), 0.5 * (real(width) + cell)
    # a place that is no number ends the run elsewhere
    reach = real(R) if np.abs(cx + cy) < FAR else -FAR
    rx, ry = np.abs(real(fx)) * reach + np.abs(real(fy)) * half, np.abs(real(fy)) * reach + np.abs(real(fx)) * half
    p0, q0 = max(0, np.int64(np.ceil((cx - rx) / cell))), max(0, np.int64(np.ceil((cy - ry) / cell)))
    p1, q1 = np.int64(np.floor((cx + rx) / cell)), np.int64(np.floor((cy + ry) / cell))
    for p in range(p0, min(p1, cells.h.shape[0] - 1) + 1):
        for q in range(q0, min(q1, cells.h.shape[1] - 1) + 1):
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
            pressure = pressure_at(cells, p, q, bottom, -ahead * lifted)
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
                continue
            area = part * cell * cell / cosine
            strength = number[SoilRow.COHESION] + pressure * tangent
            ft, fa, fn = -area * strength * st, -area * strength * sa, area * pressure
            rise, drive = ft * sine + fn * cosine, ft * cosine - fn * sine
            f0, f1, f2 = f0 + drive, f1 + fa, f2 + rise
            m0, m1, m2 = m0 + rise * across + fa * upward, m1 - R * ft, m2 + fa * along - drive * across
    if changes:
        return
    power = add_marker_force(bodies, markers, i, seen_flat(f + s + z, (f0, f1, f2)))
    power += add_torque(bodies, markers.body[i], seen_flat(f + s + z, (m0, m1, m2)))
    record.control.power[1] -= power
    out[first], out[first + 1], out[first + 2], out[first + 3] = f2, power, f0, f1
    out[first + 4], out[first + 5] = m1, deepest


@element
def apply(machine, index, n, t):
    """Force of soil on a wheel."""
    roll_wheel(machine, index, n, t, False)


@family
def sample(machine, job, t):
    """The hook SAMPLE of machines with soil: first the cells change, then the rest is sampled."""
    record = record_at(machine)
    for k in range(record.watched.followed[3], record.watched.followed[4]):
        roll_wheel(machine, record.elements.columns[k], record.elements.number[k], t, True)
    return fill_samples(machine, t)
