"""Cells of soil that are cut, poured and slide: the wedge before a blade, and moves of equal volumes between heights.

The force on a blade is that of a wedge over a plane failure surface (Reece 1964; McKyes 1985, ch. 3), whose weight is taken from the
heights themselves, so that heaps, slopes and ledges come by themselves:

    P sin(ρ + δ + β + φ) = W sin(β + φ) + c L w cos φ

ρ : rake, from the direction of travel up to the face; δ, φ : friction of tool and soil; β : failure angle; L : length of the failure
surface; P at δ to the normal of the face.
"""

from __future__ import annotations

import numpy as np

from nivel.elements.contacts.soil import (
    ADDED,
    BEYOND,
    CELL,
    COHESION,
    COUNT,
    FIRST,
    FRICTION,
    MOMENT_X,
    MOMENT_Y,
    MOMENT_Z,
    REPOSE,
    STAMP,
    TOOL,
    WEIGHT,
)
from nivel.kernels.algebra.analytic import maximum, real
from nivel.native.function import leaf, part

LINES, FARTHEST = 4, 100  # places along an edge at which the wedge is looked at, and cells ahead at most
NARROW, TURNS, FIRST_TURNS = (
    0.03,
    18,
    40,
)  # range of a search for the failure angle [rad], its steps, and those of a first one
SHARE = 0.25  # of the excess over the angle of repose that a node gives to a neighbour at once
MOST_SLIDES = 1500  # nodes that slide in a period; others wait
TOUCHED = 1.001  # of the steepest slope, beyond which a node slides
POURED = 5  # cells along which soil falls before an edge


@leaf
def height_at(cells, x, y):
    """Height between the nodes, by straight lines; beyond the border it goes on."""
    n, m = cells.h.shape
    u, v = x / cells.number[CELL], y / cells.number[CELL]
    i, j = np.int64(min(max(real(u), 0.0), n - 1.001)), np.int64(min(max(real(v), 0.0), m - 1.001))
    u, v = u - i if 0.0 < real(u) < n - 1.0 else 0.0 * u, v - j if 0.0 < real(v) < m - 1.0 else 0.0 * v
    h = cells.h
    return (h[i, j] * (1.0 - u) + h[i + 1, j] * u) * (1.0 - v) + (h[i, j + 1] * (1.0 - u) + h[i + 1, j + 1] * u) * v


@leaf
def wedge_factor(rho, beta, phi, delta):
    """N_γ of a plane wedge under level ground: P = γ w d² N_γ without cohesion."""
    below = np.cos(rho + delta) + np.sin(rho + delta) / np.tan(beta + phi)
    return 0.5 * (1.0 / np.tan(rho) + 1.0 / np.tan(beta)) / below


@leaf
def failure_angle(rho, phi, delta, near):
    """β of the least N_γ, by golden section around `near`; over the whole range where that is 0."""
    low, high = 0.02, min(0.5 * np.pi, np.pi - rho - delta - phi - 0.02)
    if near > 0.0:
        low, high = max(low, near - NARROW), min(high, near + NARROW)
    high = max(high, low + 1e-3)
    g = 0.5 * (np.sqrt(5.0) - 1.0)
    a, b = high - g * (high - low), low + g * (high - low)
    fa, fb = wedge_factor(rho, a, phi, delta), wedge_factor(rho, b, phi, delta)
    for _ in range(TURNS if near > 0.0 else FIRST_TURNS):
        if fa < fb:
            high, b, fb = b, a, fa
            a = high - g * (high - low)
            fa = wedge_factor(rho, a, phi, delta)
        else:
            low, a, fa = a, b, fb
            b = low + g * (high - low)
            fb = wedge_factor(rho, b, phi, delta)
    return 0.5 * (low + high)


@part
def wedge(cells, edge, fx, fy, rho, beta):
    """(force [N], mean depth [m] of the edge) of the wedge before an edge between two points (6,), which looks along (fx, fy)."""
    number = cells.number
    cell, phi, delta = number[CELL], number[FRICTION], number[TOOL]
    step = 0.5 * cell
    dx, dy, dz = edge[3] - edge[0], edge[4] - edge[1], edge[5] - edge[2]
    width = np.sqrt(dx * dx + dy * dy + dz * dz)
    area, length, mean = 0.0 * width, 0.0 * width, 0.0 * width
    for k in range(LINES):
        a = (k + 0.5) / LINES
        x, y, z = edge[0] + a * dx, edge[1] + a * dy, edge[2] + a * dz
        # the height just ahead reaches back over the blade, under which nodes have been cut already
        depth = height_at(cells, x + cell * fx, y + cell * fy) - z
        if real(depth) <= 0.0:
            continue
        mean += depth / LINES
        area += 0.5 * depth * depth / np.tan(rho) / LINES
        before = depth
        for n in range(2 * FARTHEST):
            s = (n + 1) * step
            r = max(s, cell)
            over = height_at(cells, x + r * fx, y + r * fy) - z - s * np.tan(beta)
            share = (
                1.0 + 0.0 * over if real(over) > 0.0 else before / (before - over)
            )  # up to where the surface comes to the ground
            area += 0.5 * (before + maximum(over, 0.0 * over)) * share * step / LINES
            length += share * step / np.cos(beta) / LINES
            if real(over) <= 0.0:
                break
            before = over
    weight = number[WEIGHT] * area * width
    force = (weight * np.sin(beta + phi) + number[COHESION] * length * width * np.cos(phi)) / np.sin(
        rho + delta + beta + phi
    )
    return force, mean


@leaf
def mark(cells, i, j):
    """Put a node on the ring of those that may slide, once."""
    n, m = cells.h.shape
    node = i * m + j
    if cells.marked[node] == 0:
        cells.marked[node] = 1
        cells.ring[(cells.turn[FIRST] + cells.turn[COUNT]) % (n * m)] = node
        cells.turn[COUNT] += 1


@leaf
def add_height(cells, i, j, dz):
    """Raise a node, and keep account of volume and moments."""
    cell = cells.number[CELL]
    volume, before = dz * cell * cell, cells.h[i, j]
    cells.h[i, j] = before + dz
    cells.sum[ADDED] += volume
    cells.sum[MOMENT_X] += volume * i * cell
    cells.sum[MOMENT_Y] += volume * j * cell
    cells.sum[MOMENT_Z] += volume * (before + 0.5 * dz)


@part
def cut(cells, edge, left):
    """Lower all nodes over the strip that an edge (6,) has swept from `left` (6,) down to it; returns the volume taken [m³].

    Nodes just behind the edge are held: the soil ahead leans on the blade.
    """
    cell = cells.number[CELL]
    n, m = cells.h.shape
    ex, ey = edge[3] - edge[0], edge[4] - edge[1]
    length = ex * ex + ey * ey
    sx, sy = 0.5 * (edge[0] + edge[3] - left[0] - left[3]), 0.5 * (edge[1] + edge[4] - left[1] - left[4])
    sweep = np.sqrt(sx * sx + sy * sy)
    low_x, high_x = min(edge[0], edge[3], left[0], left[3]), max(edge[0], edge[3], left[0], left[3])
    low_y, high_y = min(edge[1], edge[4], left[1], left[4]), max(edge[1], edge[4], left[1], left[4])
    # a sum that is no number ends the run elsewhere
    if not length > 0.0 or not np.abs(low_x + high_x + low_y + high_y) < 1e9:
        return 0.0
    volume = 0.0
    for i in range(max(0, np.int64(np.floor(low_x / cell)) - 2), min(n - 1, np.int64(np.ceil(high_x / cell)) + 2) + 1):
        for j in range(
            max(0, np.int64(np.floor(low_y / cell)) - 2), min(m - 1, np.int64(np.ceil(high_y / cell)) + 2) + 1
        ):
            px, py = i * cell - edge[0], j * cell - edge[1]
            a = (px * ex + py * ey) / length
            if a < 0.0 or a > 1.0:
                continue
            bx, by = px - a * ex, py - a * ey
            behind = -(bx * sx + by * sy) / sweep if sweep > 0.0 else np.sqrt(bx * bx + by * by)
            if behind < -0.5 * cell or behind > max(sweep, 1.5 * cell):
                continue
            if behind <= 1.5 * cell:
                cells.held[i * m + j] = cells.turn[STAMP]
            # the strip is as wide as a cell, so that none is left out
            if behind > max(sweep, 0.5 * cell):
                continue
            share = min(max(behind / sweep, 0.0), 1.0) if sweep > 0.0 else 0.0
            z = (edge[2] + a * (edge[5] - edge[2])) * (1.0 - share) + share * (left[2] + a * (left[5] - left[2]))
            if cells.h[i, j] > z:
                volume += (cells.h[i, j] - z) * cell * cell
                add_height(cells, i, j, z - cells.h[i, j])
                cells.rest[i, j] = cells.h[i, j]
                mark(cells, i, j)
    return volume


@part
def pour(cells, edge, fx, fy, volume):
    """Put a volume [m³] on the nodes before an edge (6,) that looks along (fx, fy), by equal shares."""
    cell = cells.number[CELL]
    n, m = cells.h.shape
    dx, dy = edge[3] - edge[0], edge[4] - edge[1]
    across = max(1, np.int64(np.sqrt(dx * dx + dy * dy) / cell))
    for k in range(across * POURED):
        a, ahead = (k // POURED + 0.5) / across, (k % POURED + 1.5) * cell
        u, v = (edge[0] + a * dx + ahead * fx) / cell, (edge[1] + a * dy + ahead * fy) / cell
        i, j = np.int64(min(max(np.floor(u + 0.5), 0.0), n - 1.0)), np.int64(min(max(np.floor(v + 0.5), 0.0), m - 1.0))
        if np.abs(u - i) > 0.6 or np.abs(v - j) > 0.6:
            cells.sum[BEYOND] += volume / (across * POURED)
        add_height(cells, i, j, volume / (across * POURED * cell * cell))
        cells.rest[i, j] = cells.h[i, j]
        mark(cells, i, j)


@part
def slide(cells, most):
    """Let at most so many nodes of the ring slide to the angle of repose; moves of equal volumes keep the whole to round-off.

    A node that gave or got goes back on the ring, and so does one that a blade holds.
    """
    n, m = cells.h.shape
    count, steepest = cells.turn, np.tan(cells.number[REPOSE]) * cells.number[CELL]
    for _ in range(min(most, count[COUNT])):
        node = cells.ring[count[FIRST]]
        count[FIRST] = (count[FIRST] + 1) % (n * m)
        count[COUNT] -= 1
        cells.marked[node] = 0
        i, j = node // m, node % m
        if cells.held[node] == count[STAMP]:
            mark(cells, i, j)
            continue
        moved = False
        for e in range(9):
            a, b = i + e // 3 - 1, j + e % 3 - 1
            if e == 4 or a < 0 or b < 0 or a >= n or b >= m or cells.held[a * m + b] == count[STAMP]:
                continue
            allowed = steepest * (np.sqrt(2.0) if e % 2 == 0 else 1.0)
            drop = cells.h[i, j] - cells.h[a, b]
            if np.abs(drop) <= allowed * TOUCHED:
                continue
            amount = SHARE * (drop - np.copysign(allowed, drop))
            add_height(cells, i, j, -amount)
            add_height(cells, a, b, amount)
            cells.rest[i, j], cells.rest[a, b] = cells.h[i, j], cells.h[a, b]
            moved = True
            mark(cells, a, b)
        if moved:
            mark(cells, i, j)
