"""Ways of bodies over ground with heights within a step: a hill, a ridge or a kerb between its ends is seen whatever the speed.

Between its ends the place and the axes of a shape go on cubics. The way of a point is looked at in pieces of some meshes. Over a piece that
is higher than all heights below it nothing touches, and over one whose heights bend by less than the overlap nothing begins or ends;
elsewhere the overlap is found at every half of a mesh. Within one the ground is one cubic, which the tangents at the ends of a step show.

Where steps are chosen, a step ends where a point is on its other side. If a point touches, a step goes on no further than the ground ahead
is about a parabola. What fixed steps pass is noted.
"""

import numpy as np

from nivel.elements.contacts.heights import (
    BEND,
    END,
    GROUND,
    HIGHEST,
    MISSED,
    MISSED_AT,
    SEEN,
    ball_of,
    find_point_over_ground,
    look_at_heights,
    mesh_of,
    meshes,
)
from nivel.elements.contacts.law import COUNT, DEEPEST, MARKER, NORMAL, OTHER, POINT, RADIUS
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import axis, minus, plus, put, seen, times
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.kernels.signals.watch import AHEAD, ARRIVE, KEEP, LOOK, read_watched
from nivel.native.function import leaf, stage

# what is kept of an accepted state behind the points in the memory of an element: pose and twist of the shape in axes of the ground (place,
# axes, velocity, angular velocity), time, 1
PLACE, AXES, SPEED, SPIN, SINCE, KNOWN, KEPT = 0, 3, 12, 15, 18, 19, 20


@stage
def write_pose(machine, k, out, first):
    """Pose and twist of the shape of element k in axes of its ground, into out[first:]."""
    record = record_at(machine)
    markers, bodies, columns = record.markers, record.bodies, record.elements.columns[k]
    i, j = columns[MARKER], columns[OTHER]
    B, W = markers.A[j], bodies.omega[markers.body[j]]
    d = minus(markers.r[i], markers.r[j])
    v = minus(minus(markers.rdot[i], markers.rdot[j]), cross(W, d))
    turning = seen(B, minus(bodies.omega[markers.body[i]], W))
    put(out, first + PLACE, seen(B, d))
    put(out, first + SPEED, seen(B, v))
    put(out, first + SPIN, turning)
    for a in range(3):
        column = seen(B, axis(markers.A[i], a))
        for b in range(3):
            out[first + AXES + 3 * b + a] = column[b]


@leaf
def values_at(x, first, step=1):
    """The values of three numbers, `step` places apart."""
    return real(x[first]), real(x[first + step]), real(x[first + 2 * step])


@stage
def predict(out, end, memory, first, h):
    """The pose at the end of a step of length h with the twist kept, into out[end:]."""
    w = values_at(memory, first + SPIN)
    rate = np.sqrt(dot(w, w))
    s, c = (np.sin(rate * h) / rate, (1.0 - np.cos(rate * h)) / (rate * rate)) if rate > 0.0 else (h, 0.5 * h * h)
    for a in range(3):
        out[end + PLACE + a] = memory[first + PLACE + a] + h * memory[first + SPEED + a]
        out[end + SPEED + a], out[end + SPIN + a] = memory[first + SPEED + a], memory[first + SPIN + a]
        x = values_at(memory, first + AXES + a, 3)
        y = cross(w, x)
        z = cross(w, y)
        for b in range(3):
            out[end + AXES + 3 * b + a] = x[b] + s * y[b] + c * z[b]


@stage
def set_pose(machine, k, theta, h):
    """Put the shape of element k where it is at the share θ of a step of length h, by cubics through the pose kept and that at the end."""
    record = record_at(machine)
    markers, columns, n = record.markers, record.elements.columns[k], record.elements.number[k]
    memory, first = record.elements.memory[k], np.int64(columns[COUNT])
    i, j, end = columns[MARKER], columns[OTHER], END
    one = theta * theta * (3.0 - 2.0 * theta)
    low, high = h * theta * (1.0 - theta) * (1.0 - theta), -h * theta * theta * (1.0 - theta)
    B, o = markers.A[j], markers.r[j]
    w, W = values_at(memory, first + SPIN), values_at(n, end + SPIN)
    for c in range(4):
        at, step = (PLACE, 1) if c == 3 else (AXES + c, 3)
        x, y = values_at(memory, first + at, step), values_at(n, end + at, step)
        u, v = cross(w, x), cross(W, y)
        if c == 3:
            u, v = values_at(memory, first + SPEED), values_at(n, end + SPEED)
        p = plus(plus(plus(x, times(one, minus(y, x))), times(low, u)), times(high, v))
        for a in range(3):
            q = real(B[a, 0]) * p[0] + real(B[a, 1]) * p[1] + real(B[a, 2]) * p[2]
            if c == 3:
                markers.r[i, a] = real(o[a]) + q
            else:
                markers.A[i, a, c] = q


@stage
def overlap_at(machine, k, n, theta, h):
    """Overlap of point n at the share θ; its place in axes of the ground: of a ball that of its middle."""
    record = record_at(machine)
    markers, columns, numbers = record.markers, record.elements.columns[k], record.elements.number[k]
    set_pose(machine, k, theta, h)
    depth = real(find_point_over_ground(machine, k, n))
    p = seen(markers.A[columns[OTHER]], minus(numbers[POINT:NORMAL], markers.r[columns[OTHER]]))
    ball = ball_of(machine, k)
    if ball > 0.0:
        # the point of a ball was put on the ground
        m = seen(markers.A[columns[OTHER]], (numbers[NORMAL], numbers[NORMAL + 1], numbers[NORMAL + 2]))
        p = plus(p, times(ball - depth, m))
    return depth, values_at(p, 0)


@stage
def kept(machine, k):
    """Place, axes and normal of element k as they are, which ways change."""
    record = record_at(machine)
    i, n = record.elements.columns[k, MARKER], record.elements.number[k]
    r, A = record.markers.r[i], record.markers.A[i]
    return (r[0], r[1], r[2]), axis(A, 0), axis(A, 1), axis(A, 2), (n[NORMAL], n[NORMAL + 1], n[NORMAL + 2])


@stage
def put_back(machine, k, own):
    """Put back what `kept` gave."""
    record = record_at(machine)
    i, n = record.elements.columns[k, MARKER], record.elements.number[k]
    for a in range(3):
        record.markers.r[i, a], n[NORMAL + a] = own[0][a], own[4][a]
        put(record.markers.A[i, a], 0, (own[1][a], own[2][a], own[3][a]))


# the share that is never reached
NEVER = 2.0
# Places at which a mesh is looked at, and those of a piece.
IN_A_MESH, IN_A_PIECE = 2, 8
# Ground that bends by less than this share of a mesh is a plane. Meshes along a side of a rectangle that is looked at as a whole, at most.
PLANE, WHOLE = 1e-12, 16.0
# Bends below this share of the overlap change no side. A way is about a parabola where it leaves its tangent by this share of what its
# largest bend would make of it.
SLIGHT, PARABOLA = 0.5, 0.25


@stage
def is_plane(machine, k):
    """Whether all ground of element k is a plane."""
    ground = record_at(machine).elements.number[k, GROUND:]
    return real(ground[BEND]) <= PLANE * mesh_of(ground)


@stage
def meshes_within(machine, k, out, at, h):
    """A bound of the meshes that points of element k pass with the twist of the pose in out[at:] in the time h."""
    n = record_at(machine).elements.number[k]
    v, w = values_at(out, at + SPEED), values_at(out, at + SPIN)
    arm = real(n[RADIUS]) - ball_of(machine, k)
    speed = np.sqrt(dot(v, v)) + arm * np.sqrt(dot(w, w))
    return h * speed / mesh_of(n[GROUND:])


@stage
def passes_nothing(machine, k, h):
    """Whether element k goes less than a mesh in a step of length h, is above all heights on its way, or over a plane."""
    record = record_at(machine)
    n, memory, first = record.elements.number[k], record.elements.memory[k], np.int64(record.elements.columns[k, COUNT])
    end, ground = END, n[GROUND:]
    mesh, way = mesh_of(ground), max(meshes_within(machine, k, memory, first, h), meshes_within(machine, k, n, end, h))
    if way <= 1.0:
        return True
    falls = max(-real(memory[first + SPEED + 2]), 0.0) + max(real(n[end + SPEED + 2]), 0.0)
    lower = min(real(memory[first + PLACE + 2]), real(n[end + PLACE + 2])) - real(n[RADIUS]) - h * falls
    if lower > real(ground[HIGHEST]):
        return True
    # the whole way is not longer than the bound of speeds has it
    around = 0.5 * way * mesh + real(n[RADIUS])
    if not around <= 0.5 * WHOLE * mesh:
        return False
    x, y = 0.5 * real(memory[first] + n[end]), 0.5 * real(memory[first + 1] + n[end + 1])
    highest, bend = look_at_heights(ground, x - around, x + around, y - around, y + around)
    return lower > highest or bend * way * way <= 8.0 * PLANE * mesh


@stage
def way_of(machine, k, n, h):
    """(number of places at which the way of point n is looked at, none where it is short; of pieces; how far it is beside the chord of a
    piece, at most)."""
    ground = record_at(machine).elements.number[k, GROUND:]
    _, p = overlap_at(machine, k, n, 0.0, h)
    _, q = overlap_at(machine, k, n, 0.5, h)
    _, r = overlap_at(machine, k, n, 1.0, h)
    off = minus(q, times(0.5, plus(p, r)))
    way = meshes(ground, p, q) + meshes(ground, q, r)
    if not 1.0 < way < np.inf:
        return 0, 0, 0.0
    count = np.int64(np.ceil(IN_A_MESH * way))
    pieces = (count + IN_A_PIECE - 1) // IN_A_PIECE
    return count, pieces, 4.0 * np.sqrt(dot(off, off)) / (pieces * pieces)


@stage
def piece_of(machine, k, n, piece, count, beside, h):
    """(first and last place of a piece of the way of point n, whether it is clear of the ground there, how far its overlap may bend)."""
    first, last = piece * IN_A_PIECE, min(count, (piece + 1) * IN_A_PIECE)
    numbers = record_at(machine).elements.number[k]
    ground, ball = numbers[GROUND:], ball_of(machine, k)
    _, p = overlap_at(machine, k, n, first / count, h)
    _, q = overlap_at(machine, k, n, last / count, h)
    around = ball + beside
    highest, bend = look_at_heights(
        ground, min(p[0], q[0]) - around, max(p[0], q[0]) + around, min(p[1], q[1]) - around, max(p[1], q[1]) + around
    )
    way = meshes(ground, p, q)
    return first, last, min(p[2], q[2]) - around > highest, bend * way * way / 8.0 + beside


@stage
def first_other_side(machine, k, n, theta, h):
    """The first share behind θ at which point n is on the other side than in the accepted state; NEVER where it is not seen on it."""
    record = record_at(machine)
    touches = real(record.elements.memory[k, n]) > 0.0
    count, pieces, beside = way_of(machine, k, n, h)
    side = 1.0 if touches else -1.0
    for piece in range(np.int64(theta * count) // IN_A_PIECE, pieces):
        begin, last, is_clear, bend = piece_of(machine, k, n, piece, count, beside, h)
        if is_clear and not touches:
            continue
        f, g = -np.inf, overlap_at(machine, k, n, begin / count, h)[0] * side
        if bend <= SLIGHT * min(g, overlap_at(machine, k, n, last / count, h)[0] * side):
            continue
        for i in range(begin + 1, last + 1):
            d = overlap_at(machine, k, n, i / count, h)[0] * side
            if d < 0.0 and i > theta * count:
                return min(i / count, 1.0)
            # a parabola through three of them
            if g < f and g <= d and f < np.inf and f - 2.0 * g + d > 0.0:
                at = (i - 1.0 + 0.5 * (f - d) / (f - 2.0 * g + d)) / count
                least = g - (d - f) ** 2 / (8.0 * (f - 2.0 * g + d))
                if at > theta and least < 0.0 and overlap_at(machine, k, n, at, h)[0] * side < 0.0:
                    return at
            f, g = g, d
    return NEVER


@stage
def share_ahead(machine, k, n, h):
    """Up to which share of a step of length h point n may go on: as far as the ground is about a parabola, and a mesh in any case."""
    count, pieces, beside = way_of(machine, k, n, h)
    if count == 0:
        return 1.0
    first = overlap_at(machine, k, n, 0.0, h)[0]
    slope = overlap_at(machine, k, n, 1.0 / count, h)[0] - first
    most, away = 0.0, 0.0
    for piece in range(pieces):
        begin, last, _, bend = piece_of(machine, k, n, piece, count, beside, h)
        if bend <= SLIGHT * first:
            continue
        f, g = np.nan, overlap_at(machine, k, n, begin / count, h)[0]
        for i in range(begin + 1, last + 1):
            d = overlap_at(machine, k, n, i / count, h)[0]
            away = max(away, np.abs(d - first - slope * i))
            if i > begin + 1:
                most = max(most, np.abs(f - 2.0 * g + d))
            if 0.5 * most * i * i > max(away / PARABOLA, SLIGHT * first):
                return max(i - 1.0, 1.0 * IN_A_MESH) / count
            f, g = g, d
    return 1.0


@stage
def deepest_between(machine, k, n, h):
    """(share, overlap) of point n where it is deepest within the step."""
    count, pieces, beside = way_of(machine, k, n, h)
    deepest, share = -np.inf, 0.0
    for piece in range(pieces):
        begin, last, is_clear, bend = piece_of(machine, k, n, piece, count, beside, h)
        at_begin, at_end = overlap_at(machine, k, n, begin / count, h)[0], overlap_at(machine, k, n, last / count, h)[0]
        if is_clear or bend <= SLIGHT * np.abs(max(at_begin, at_end)):
            continue
        for i in range(begin, last + 1):
            d = overlap_at(machine, k, n, i / count, h)[0]
            if d > deepest:
                deepest, share = d, i / count
    return share, deepest


@stage
def note_missed(machine, k, t, h):
    """Note the deepest overlap within the step that ends in the state last evaluated, and that at its end."""
    elements = record_at(machine).elements
    numbers = elements.number[k]
    numbers[SEEN] = max(real(numbers[SEEN]), real(numbers[DEEPEST]))
    if meshes_within(machine, k, elements.memory[k], np.int64(elements.columns[k, COUNT]), h) <= 0.5:
        return
    write_pose(machine, k, numbers, END)
    if passes_nothing(machine, k, h):
        return
    own = kept(machine, k)
    for n in range(elements.columns[k, COUNT]):
        share, depth = deepest_between(machine, k, n, h)
        if depth > real(numbers[MISSED]):
            numbers[MISSED], numbers[MISSED_AT] = depth, t - (1.0 - share) * h
    put_back(machine, k, own)


@stage
def keep(machine, k, t):
    """Keep the pose of the state last evaluated; where steps are fixed, note what the step to it has passed."""
    record = record_at(machine)
    elements = record.elements
    memory, first = elements.memory[k], np.int64(elements.columns[k, COUNT])
    if record.watched.followed[0] == 0 and real(memory[first + KNOWN]) > 0.0:
        note_missed(machine, k, t, t - real(memory[first + SINCE]))
    write_pose(machine, k, elements.proposal[k], first)
    elements.proposal[k, first + SINCE], elements.proposal[k, first + KNOWN] = t, 1.0


@stage
def look(machine, j, t):
    """Value j that is watched, a share of the step that ends at t, becomes the first share behind it at which its surface is on its other
    side."""
    record = record_at(machine)
    elements, watched = record.elements, record.watched
    surface = watched.surface[j - watched.event.shape[0]]
    k, n = np.int64(surface[0]), np.int64(surface[1])
    theta = real(watched.value[j])
    watched.value[j] = NEVER
    if watched.followed[1] <= k < watched.followed[2] and not is_plane(machine, k):
        h = t - real(elements.memory[k, np.int64(elements.columns[k, COUNT]) + SINCE])
        if passes_nothing(machine, k, h):
            return
        own = kept(machine, k)
        watched.value[j] = first_other_side(machine, k, n, theta, h)
        put_back(machine, k, own)


@stage
def look_ahead(machine, k, t):
    """Share of the step to t that element k allows."""
    elements = record_at(machine).elements
    memory, first, share, touches = elements.memory[k], np.int64(elements.columns[k, COUNT]), 1.0, False
    for n in range(first):
        touches = touches or real(memory[n]) > 0.0
    h = t - real(memory[first + SINCE])
    if not touches or meshes_within(machine, k, memory, first, h) <= 1.0:
        return share
    predict(elements.number[k], END, memory, first, h)
    if passes_nothing(machine, k, h):
        return share
    own = kept(machine, k)
    for n in range(first):
        if real(memory[n]) > 0.0:
            share = min(share, share_ahead(machine, k, n, h))
    put_back(machine, k, own)
    return share


@family
def watch(machine, job, t):
    """The hook WATCH of machines with such ground: job 0 as of others; KEEP the pose of the accepted state; ARRIVE: that at the end of a
    step; AHEAD: the first value that is watched becomes the share of a step to t that is allowed; LOOK, see `look`."""
    record = record_at(machine)
    watched = record.watched
    if job == 0:
        read_watched(machine, t)
        return OK
    t = real(t)
    if job >= LOOK:
        look(machine, np.int64(job) - LOOK, t)
    else:
        share = 1.0
        for k in range(watched.followed[1], watched.followed[2]):
            if is_plane(machine, k):
                continue
            if job == KEEP:
                keep(machine, k, t)
            elif job == ARRIVE:
                write_pose(machine, k, record.elements.number[k], END)
            else:
                share = min(share, look_ahead(machine, k, t))
        if job == AHEAD:
            watched.value[0] = share
    return OK
