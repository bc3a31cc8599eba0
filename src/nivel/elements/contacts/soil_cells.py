"""Cells of soil that are cut, poured and slide: the wedge before a blade, and moves of equal volumes between heights.

The force on a blade is that of a wedge over a plane failure surface (Reece 1964; McKyes 1985, ch. 3), whose weight is taken from the
heights themselves, so that heaps, slopes and ledges come by themselves:

    P sin(ρ + δ + β + φ) = W sin(β + φ) + c L w cos φ

ρ : rake, from the direction of travel up to the face; δ, φ : friction of tool and soil; β : failure angle; L : length of the failure
surface; P at δ to the normal of the face.
"""

import numpy as np

from nivel.elements.contacts.soil import SoilRow
from nivel.kernels.algebra.analytic import arctan2, maximum, minimum, real
from nivel.kernels.algebra.vectors import minus, plus, put, seen
from nivel.kernels.elements.soil import ADDED, BEYOND, COUNT, FIRST, STAMP, STORED
from nivel.kernels.record.record import NONE
from nivel.native.function import leaf, part, stage

LINES, FARTHEST = 4, 100  # places along an edge at which the wedge is looked at, and cells ahead at most
SHARE = 0.25  # of the excess over the angle of repose that a node gives to a neighbour at once
MOST_SLIDES = 1500  # nodes that slide in a period; others wait
TOUCHED = 1.001  # of the steepest slope, beyond which a node slides
POURED = 5  # cells along which soil falls before an edge
UNCUT = 1.5  # cells ahead of an edge, from where on soil is as it was
MOBILISED = 0.01  # [m] of motion over which the resistance of soil comes
FAR = 1e9  # [m] beyond which a place is none


@leaf
def between_nodes(h, cell, x, y):
    """A number of the nodes between them, by straight lines; beyond the border it goes on."""
    o = 0.0 * x
    n, m = h.shape
    u, v = minimum(maximum(x / cell, o), n - 1.0 + o), minimum(maximum(y / cell, o), m - 1.0 + o)
    i, j = min(np.int64(real(u)), n - 2), min(np.int64(real(v)), m - 2)
    u, v = u - i, v - j
    return (h[i, j] * (1.0 - u) + h[i + 1, j] * u) * (1.0 - v) + (h[i, j + 1] * (1.0 - u) + h[i + 1, j + 1] * u) * v


@leaf
def height_at(cells, x, y):
    """Height between the nodes."""
    return between_nodes(cells.h, cells.number[SoilRow.CELL], x, y)


@leaf
def failure_angle(rho, phi, delta):
    """β of the least force under level ground without cohesion, P = γ w d² N_γ.

    By u = cot β N_γ is (cot ρ + u) (cot φ + u)/(c + u) but for a factor, c = cot(ρ + δ + φ). Its derivative is zero at u + c =
    √((cot ρ - c) (cot φ - c)).
    """
    c = 1.0 / np.tan(rho + delta + phi)
    u = np.sqrt((1.0 / np.tan(rho) - c) * (1.0 / np.tan(phi) - c)) - c
    return arctan2(1.0 + 0.0 * u, u)


@stage
def seen_from_corner(cells, markers, plane, p):
    """A point in axes of the plane from the first node."""
    half = 0.5 * cells.number[SoilRow.CELL]
    corner = half * (cells.h.shape[0] - 1), half * (cells.h.shape[1] - 1), 0.0
    return plus(seen(markers.A[plane], minus(p, markers.r[plane])), corner)


@leaf
def pressure_at(number, h, rest, bottom, ahead):
    """Pressure of soil of the height h, pressed down from the height `rest`, on what is at the height `bottom` and elastically so much
    deeper."""
    elastic = maximum(number[SoilRow.UNLOADING] * (h - bottom + ahead), 0.0 * bottom)
    sinkage = rest - bottom
    if real(sinkage) <= 0.0:
        return 0.0 * elastic
    return minimum(elastic, number[SoilRow.MODULUS] * sinkage ** number[SoilRow.EXPONENT])


@leaf
def mobilised_rate(v, s):
    """Rate of the share of a resistance at the speed v against it."""
    return (maximum(v, 0.0 * v) * (1.0 - s) + minimum(v, 0.0 * v) * s) / MOBILISED


@part
def wedge(cells, edge, fx, fy, rho, beta):
    """(force [N], mean depth [m] of the edge) of the wedge before an edge between two points (6,), which looks along (fx, fy)."""
    number, cell = cells.number, cells.number[SoilRow.CELL]
    step = 0.5 * cell
    phi, delta = number[SoilRow.FRICTION_ANGLE], number[SoilRow.TOOL_FRICTION]
    dx, dy, dz = edge[3] - edge[0], edge[4] - edge[1], edge[5] - edge[2]
    width = np.sqrt(dx * dx + dy * dy + dz * dz)
    area, length, mean = 0.0 * width, 0.0 * width, 0.0 * width
    for k in range(LINES):
        a = (k + 0.5) / LINES
        x, y, z = edge[0] + a * dx, edge[1] + a * dy, edge[2] + a * dz
        # the height ahead reaches back over the blade, under which nodes have been cut already
        before = height_at(cells, x + UNCUT * cell * fx, y + UNCUT * cell * fy) - z
        if real(before) <= 0.0:
            continue
        mean += before / LINES
        area += 0.5 * before * before / np.tan(rho) / LINES
        for n in range(2 * FARTHEST):
            s = (n + 1) * step
            r = max(s, UNCUT * cell)
            over = height_at(cells, x + r * fx, y + r * fy) - z - s * np.tan(beta)
            # up to where the surface comes to the ground
            share = 1.0 + 0.0 * over if real(over) > 0.0 else before / (before - over)
            area += 0.5 * (before + maximum(over, 0.0 * over)) * share * step / LINES
            length += share * step / np.cos(beta) / LINES
            if real(over) <= 0.0:
                break
            before = over
    weight = -number[SoilRow.DENSITY] * number[SoilRow.GRAVITY + 2] * area * width
    held = number[SoilRow.COHESION] * length * width * np.cos(phi)
    return (weight * np.sin(beta + phi) + held) / np.sin(rho + delta + beta + phi), mean


@leaf
def mark(cells, node):
    """Put a node on the ring of those that may slide, once."""
    if cells.marked[node] == 0:
        cells.marked[node] = 1
        cells.ring[(cells.turn[FIRST] + cells.turn[COUNT]) % cells.ring.shape[0]] = node
        cells.turn[COUNT] += 1


@leaf
def raise_node(cells, i, j, dz):
    """Raise a node, which is undisturbed then and may slide, and keep account of volume and potential energy."""
    number, sums, cell = cells.number, cells.sum, cells.number[SoilRow.CELL]
    before, after = cells.h[i, j], cells.h[i, j] + dz
    volume, middle = (after - before) * cell * cell, 0.5 * (before + after)
    cells.h[i, j] = cells.rest[i, j] = after
    g = number[SoilRow.GRAVITY :]
    works = number[SoilRow.ORIGIN] + (g[0] * i + g[1] * j) * cell + g[2] * middle
    sums[ADDED] += volume
    sums[STORED] -= number[SoilRow.DENSITY] * volume * works
    mark(cells, i * cells.h.shape[1] + j)


@leaf
def nodes_between(low, high, cell, count):
    """First node of `count` along an axis that is not below `low` [m], and one past the last that is not above `high`."""
    return max(0, np.int64(np.ceil(low / cell))), min(count - 1, np.int64(np.floor(high / cell))) + 1


@part
def cut(cells, edge, left):
    """Lower all nodes over the strip that an edge (6,) has swept from `left` (6,) down to it; returns the volume taken [m³].

    Nodes just behind the edge are held: the soil ahead leans on the blade.
    """
    cell = cells.number[SoilRow.CELL]
    n, m = cells.h.shape
    ex, ey = edge[3] - edge[0], edge[4] - edge[1]
    length = ex * ex + ey * ey
    sx, sy = 0.5 * (edge[0] + edge[3] - left[0] - left[3]), 0.5 * (edge[1] + edge[4] - left[1] - left[4])
    sweep = np.sqrt(sx * sx + sy * sy)
    low_x, high_x = min(edge[0], edge[3], left[0], left[3]), max(edge[0], edge[3], left[0], left[3])
    low_y, high_y = min(edge[1], edge[4], left[1], left[4]), max(edge[1], edge[4], left[1], left[4])
    volume, near = 0.0, 2.0 * cell
    # a sum that is no number ends the run elsewhere
    if not length > 0.0 or not np.abs(low_x + high_x + low_y + high_y) < FAR:
        return volume
    i0, i1 = nodes_between(low_x - near, high_x + near, cell, n)
    j0, j1 = nodes_between(low_y - near, high_y + near, cell, m)
    for i in range(i0, i1):
        for j in range(j0, j1):
            px, py = i * cell - edge[0], j * cell - edge[1]
            a = (px * ex + py * ey) / length
            bx, by = px - a * ex, py - a * ey
            behind = -(bx * sx + by * sy) / sweep if sweep > 0.0 else np.sqrt(bx * bx + by * by)
            if a < 0.0 or a > 1.0 or behind < -0.5 * cell or behind > sweep + 1.5 * cell:
                continue
            if behind <= 1.5 * cell:
                cells.held[i * m + j] = cells.turn[STAMP]
            # shares of the cell that are swept now, and that were before: so volume comes in evenly, not by whole cells
            now, then = min(max(behind / cell + 0.5, 0.0), 1.0), min(max((behind - sweep) / cell + 0.5, 0.0), 1.0)
            share = min(max(behind / sweep, 0.0), 1.0) if sweep > 0.0 else 0.0
            z = (edge[2] + a * (edge[5] - edge[2])) * (1.0 - share) + share * (left[2] + a * (left[5] - left[2]))
            if cells.h[i, j] > z and now > then:
                dz = (z - cells.h[i, j]) * (now - then) / (1.0 - then)
                volume -= dz * cell * cell
                raise_node(cells, i, j, dz)
    return volume


@leaf
def open_mouth(cells, slot, a, b, fx, fy):
    """Say where soil falls into what carries it: between two corners, in the direction (fx, fy) and across it."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    put(cells.mouth[slot], 0, (a[0], a[1], fx))
    put(cells.mouth[slot], 3, (fy, dx * fx + dy * fy, dy * fx - dx * fy))
    cells.mouth[slot, 6] = max(a[2], b[2])


@leaf
def mouth_below(cells, x, y, z):
    """The number of the force into whose mouth soil falls from a place; NONE where it falls on the ground."""
    for slot in range(cells.mouth.shape[0]):
        its = cells.mouth[slot]
        along, across = (x - its[0]) * its[2] + (y - its[1]) * its[3], (y - its[1]) * its[2] - (x - its[0]) * its[3]
        if z > its[6] and 0.0 < along * its[4] < its[4] ** 2 and 0.0 < across * its[5] < its[5] ** 2:
            return slot
    return NONE


@part
def pour(cells, edge, fx, fy, volume, forth, left):
    """Put a volume [m³] on the nodes before an edge (6,) that looks along (fx, fy), by equal shares, or into a mouth below.

    It is cast so far forth and to the left of there [m].
    """
    cell = cells.number[SoilRow.CELL]
    n, m = cells.h.shape
    dx, dy = edge[3] - edge[0], edge[4] - edge[1]
    across = max(1, np.int64(np.sqrt(dx * dx + dy * dy) / cell))
    each = volume / (across * POURED)
    for k in range(across * POURED):
        a, ahead = (k // POURED + 0.5) / across, (k % POURED + 1.5) * cell
        ahead += forth
        x, y = edge[0] + a * dx + ahead * fx - left * fy, edge[1] + a * dy + ahead * fy + left * fx
        below = mouth_below(cells, x, y, edge[2] + a * (edge[5] - edge[2]))
        if below != NONE:
            cells.fallen[below] += each
            continue
        u, v = x / cell, y / cell
        i, j = np.int64(min(max(np.floor(u + 0.5), 0.0), n - 1.0)), np.int64(min(max(np.floor(v + 0.5), 0.0), m - 1.0))
        if np.abs(u - i) > 0.6 or np.abs(v - j) > 0.6:
            cells.sum[BEYOND] += each
        raise_node(cells, i, j, each / (cell * cell))


@part
def slide(cells):
    """Let nodes of the ring slide to the angle of repose, MOST_SLIDES at most; moves of equal volumes keep the whole to round-off.

    A node that gave or got goes back on the ring, and so does one that a blade holds.
    """
    n, m = cells.h.shape
    count, steepest = cells.turn, np.tan(cells.number[SoilRow.REPOSE]) * cells.number[SoilRow.CELL]
    for _ in range(min(MOST_SLIDES, count[COUNT])):
        node = cells.ring[count[FIRST]]
        count[FIRST] = (count[FIRST] + 1) % cells.ring.shape[0]
        count[COUNT] -= 1
        cells.marked[node] = 0
        i, j = node // m, node % m
        if cells.held[node] == count[STAMP]:
            mark(cells, node)
            continue
        for e in range(9):
            a, b = i + e // 3 - 1, j + e % 3 - 1
            if e == 4 or a < 0 or b < 0 or a >= n or b >= m or cells.held[a * m + b] == count[STAMP]:
                continue
            allowed = steepest * (np.sqrt(2.0) if e % 2 == 0 else 1.0)
            drop = cells.h[i, j] - cells.h[a, b]
            if np.abs(drop) > allowed * TOUCHED:
                amount = SHARE * (drop - np.copysign(allowed, drop))
                raise_node(cells, i, j, -amount)
                raise_node(cells, a, b, amount)
