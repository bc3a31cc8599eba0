"""The linear equations of a machine in axes in which they stay the same, and whether their eigenvalues describe its motion.

Steadiness of the linear equations while the machine moves: only then their eigenvalues describe the motion.
A machine in equilibrium stays; one in steady motion passes other positions with the same A; anything else has an A(t), as has a body that
spins where its turns are measured about its own axes.
"""

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.instant import NOTHING, Instant, Lanes
from nivel.analysis.assembly.unknown_groups import unknown_name
from nivel.analysis.linearise.axes import Frames, candidates
from nivel.analysis.linearise.ports import Catalogue, Input, Output
from nivel.analysis.linearise.reduction import Reduction, velocity_names
from nivel.analysis.run.prepared_state import Moment
from nivel.elements.control.dynamics import LinearSystem
from nivel.kernels.core.status import OK
from nivel.kernels.elements import friction as columns
from nivel.kernels.record.record import NONE
from nivel.lazy import Struct
from nivel.results.trust import number
from nivel.system.system import Array

# Kinks of the equations of motion: states at which a force has one slope on one side and another on the other.
#
# A spring with a gap that just closes, a damper that is stiffer one way, a table, `abs`, `min` or a valve that shuts: linear equations have
# one of the two slopes. Slopes are taken exactly on both sides, at two distances from the state. Where the equations are smooth the
# difference goes with the distance, at a kink it stays; at a jump the forces themselves stay apart.

# distances of the sides, in lengths of the machine, radians, and these a second
FAR, NEAR = 1e-5, 1e-8
# a difference of slopes that stays to this share, and is more than this share of the largest slope, is a kink
STAYS, SEEN = 0.5, 1e-6
# or than this share of the steepest slope of that force
SMOOTH = 1e-10
# or than this share of the largest of all forces
CANCELLED = 1e-12


class Kink(Struct):
    """What has two slopes when `along` changes, and both, on the lower side and on the upper one [`units`]; where the forces themselves
    differ from side to side, `jumps`."""

    along: str
    of: str
    units: str
    lower: float
    upper: float
    jumps: bool

    def __str__(self) -> str:
        if self.jumps:
            return f"{self.of} jumps where {self.along} passes its present value"
        return f"{self.of} with {self.along} has the slope {self.lower:.6g} {self.units} below and {self.upper:.6g} {self.units} above"


class _Change(Struct):
    """A change of the state by `size` [units] of what has this name: tangent increments (n,), velocities (n,) and states (S,)."""

    name: str
    units: str
    size: float
    direction: tuple[Array, Array, Array]


def kinks(reduction: Reduction) -> list[Kink]:
    """The kinks at the state of the reduction, at most one for each of its places, rates and states of elements."""
    Z, own = reduction.unturned(reduction.Z), reduction.instant
    changes = list(_directions(reduction))
    if not changes:
        return []
    found = [[_side(own, Z, each, share) for share in (-FAR, -NEAR, NEAR, FAR)] for each in changes]
    # what a force is compared with: its slopes in all directions, and the reactions that it is the rest of
    steepest = np.max([np.abs(slope) for sides in found for _, slope in sides], axis=0)
    reactions = _projected(own, np.abs(Z), np.abs(own.along("lam").r) @ np.abs(own.lam))
    # beside the largest of all forces, as energies, what is left of those that cancel is round-off
    lengths = own.length[own.free][reduction.moving]
    known = np.zeros_like(steepest)
    known[: len(lengths)] = (
        CANCELLED * np.max(((steepest + reactions)[: len(lengths)]) * lengths, initial=0.0) / lengths
    )
    out = []
    for each, sides in zip(changes, found, strict=True):
        values, slopes = zip(*sides, strict=True)
        far, near = np.abs(slopes[3] - slopes[0]), np.abs(slopes[2] - slopes[1])
        apart, largest = np.abs(values[2] - values[1]), float(np.max(np.abs(slopes), initial=0.0))
        jump = (apart > STAYS * np.abs(values[3] - values[0])) & (
            apart > np.maximum(4.0 * NEAR * (steepest + reactions), known)
        )
        bend = (near > STAYS * far) & (near > SEEN * largest) & (near > SMOOTH * steepest)
        seen = np.flatnonzero(jump | bend)
        if len(seen):
            k = int(seen[np.argmax(np.where(jump, np.inf, near)[seen])])
            lower, upper = slopes[1][k] / each.size, slopes[2][k] / each.size
            out.append(Kink(each.name, *_named(reduction, each.units, k), float(lower), float(upper), bool(jump[k])))
    return out


def _side(own: Instant, Z: Array, change: _Change, share: float) -> tuple[Array, Array]:
    """Generalised forces on the independent velocities and rates of states, and their slopes, on a side."""
    value, slope = own.beside(change.direction, share)
    return _projected(own, Z, value), _projected(own, Z, slope)


def _projected(own: Instant, Z: Array, found: Array) -> Array:
    """found (n,) or, with the rates of states, (n + S,)."""
    return np.concatenate(
        [Z.T @ found[: own.n][own.free], found[own.n :], np.zeros(max(0, own.n + own.state_count - len(found)))]
    )


def _directions(reduction: Reduction) -> Iterator[_Change]:
    """Each place, rate and state of an element."""
    own, names = reduction.instant, velocity_names(reduction.instant.system)
    none, still = np.zeros(own.n), np.zeros(own.state_count)
    for chosen, motions, rate in ((reduction.selected, reduction.Zq, False), (reduction.moving, reduction.Z, True)):
        for k, place in enumerate(own.free[chosen]):
            (name, units), size = names[place], float(own.length[place])
            whole = none.copy()
            whole[own.free] = reduction.unturned(motions)[:, k] * size
            if rate:
                yield _Change(f"{name}.rate", f"{units}/s", size, (none, whole, still))
            else:
                yield _Change(name, units, size, (whole, none, still))
    for k, fact in enumerate(own.system.states):
        change = still.copy()
        change[k] = fact.scale or 1.0
        yield _Change(f"state.{fact.name}", fact.units, fact.scale or 1.0, (none, none, change))


def _named(reduction: Reduction, units: str, k: int) -> tuple[str, str]:
    """What the k-th of the projected equations says, and the unit of its slope."""
    own = reduction.instant
    if k >= len(reduction.moving):
        fact = own.system.states[k - len(reduction.moving)]
        return f"the rate of state.{fact.name}", f"{fact.units}/s per {units}"
    name, of = velocity_names(own.system)[own.free[reduction.moving[k]]]
    effort = {"m": "N", "rad": "N m"}.get(of, "1")
    return f"the effort on {name}", {"m": f"{effort}/m", "m/s": f"{effort} s/m"}.get(units, f"{effort} per {units}")


# An effort is that of sliding to this share of it. tanh of so much is one to the last bit.
EQUAL, SATURATED = 1e-9, 40.0


def let_slide(motion: MotionEquations, t: float, y: Array) -> frozenset[str]:
    """Give frictions that slide in the state y at t [s] the law of sliding, in place of one that may hold. Returns their names."""
    system, record = motion.system, motion.system.record
    friction, out = record.friction, frozenset[str]()
    if not len(friction.columns) or not motion.holds(t, y):
        return out
    for k, (index, n) in enumerate(zip(friction.columns.tolist(), friction.number, strict=True)):
        if index[columns.MODEL] != columns.STICTION or index[columns.ROW] != NONE:
            continue
        rate = record.coordinates.rate[index[columns.COORDINATE]]
        outputs = record.outputs.value[index[columns.OUTPUT] :]
        dry = friction.force[k] + n[columns.VISCOUS] * rate
        if index[columns.WAY] == columns.ONE_WAY:
            if not rate > 0.0 or dry != 0.0:
                continue
            n[columns.KINETIC] = n[columns.STATIC] = 0.0  # it runs ahead
        elif (
            not -dry * np.sign(rate)
            >= (1.0 - EQUAL) * _sliding(n, rate * n[columns.ARM]) * outputs[columns.THIRD] * n[columns.ARM]
        ):
            continue
        friction.columns[k, columns.MODEL] = columns.COULOMB
        n[columns.TRANSITION] = abs(rate) * n[columns.ARM] / SATURATED
        out |= {system.frictions[k]}
    return out


def _sliding(n: Array, speed: float) -> float:
    """Coefficient of friction of surfaces that slide with a speed."""
    if n[columns.STATIC] == n[columns.KINETIC] or n[columns.STRIBECK] == 0.0:
        return float(n[columns.KINETIC])
    return float(
        n[columns.KINETIC] + (n[columns.STATIC] - n[columns.KINETIC]) * np.exp(-((speed / n[columns.STRIBECK]) ** 2))
    )


# shares of scales below which a machine is at rest, and in equilibrium
REST, BALANCE = 1e-9, 1e-6
# A may change by this share of the largest entry of a row while the machine turns by one radian, and round-off by this share of all
SAME, ROUND_OFF = 1e-4, 1e-12
# changes of an entry by less than this share of the largest of its row are round-off, as of what stays the same
ROUNDED = 1e-14
# the machine is looked at again after turns and ways of so many radians and lengths, by steps of this size at most
LATER, STEP = (0.7, 1.9), 4e-3
# what grows is not awaited for longer than so many of its time constants: it leaves a steady motion by the last digit that was given
GROWN = 1.0
# the fastest motion is followed by steps of this share of its time constant, and by so many steps
FOLLOWED, MOST_STEPS = 0.2, 1500


def is_at_rest(instant: Instant) -> bool:
    """Whether nothing moves, for the time scale of its accelerations."""
    own = instant
    speed = np.abs(own.y[own.positions : own.first_state] / own.length)
    return bool(
        np.max(speed, initial=0.0) <= REST * max(1.0, np.sqrt(np.max(np.abs(own.vdot / own.length), initial=0.0)))
    )


def acceleration_of(instant: Instant) -> Array:
    """(n,) accelerations in lengths of the machine and radians."""
    return np.abs(instant.vdot / instant.length)


def drift(motion: MotionEquations, instant: Instant, find: Callable[[float, Array], Array | None]) -> Array | None:
    """How A, which `find` makes of a time and a state, changes until two later moments of the motion, entry by entry; None where it is not
    the same there.

    motion : equations that can be evaluated, in the coordinates of the instant. The sooner the moments have to be, the less A may change.
    """
    own = instant
    speed = float(np.max(np.abs(own.y[own.positions : own.first_state] / own.length), initial=0.0))
    first = find(own.t, own.y)
    if first is None or speed == 0.0 or not first.size:
        return first
    t, y = own.t, own.y.copy()
    step, last = _times(first, speed)
    row, whole = np.abs(first).max(axis=1, keepdims=True), np.abs(first).max()
    changed = np.zeros_like(first)
    for until in np.array(LATER) * last:
        moved = _advanced(motion, t, y, own.t + until, step)
        if moved is None:
            return None
        t, y = moved
        later = find(t, y)
        if later is None or later.shape != first.shape:
            return None
        changed = np.maximum(changed, np.abs(later - first))
        if np.any(changed > SAME * speed * last * row + ROUND_OFF * whole):
            return None
    return np.where(changed > ROUNDED * row, changed, 0.0)


def _times(A: Array, speed: float) -> tuple[float, float]:
    """(step, time) [s] to follow the motion by, and in which it makes a turn of one radian or a way of one length, or what of that can be
    followed: without an instability that grows, and with steps that are few."""
    values = np.linalg.eigvals(A)
    growth, fastest = float(np.max(values.real, initial=0.0)), float(np.max(np.abs(values), initial=0.0))
    last = 1.0 / max(speed, LATER[-1] * growth / GROWN)
    step = min(STEP / speed, FOLLOWED / fastest) if fastest > 0.0 else STEP / speed
    return step, min(last, MOST_STEPS * step / LATER[-1])


@np.errstate(over="ignore", invalid="ignore")  # of stiff machines, whose motion these steps do not follow
def _advanced(motion: MotionEquations, t: float, y: Array, end: float, step: float) -> tuple[float, Array] | None:
    """(t, y) at `end` by the classical Runge–Kutta method; None where the motion cannot be evaluated."""
    count = max(1, int(np.ceil((end - t) / step)))
    h = (end - t) / count
    for _ in range(count):
        slopes: list[Array] = []
        for share in (0.0, 0.5, 0.5, 1.0):
            at = y + share * h * slopes[-1] if slopes else y
            status, rate = motion.evaluate(t + share * h, at)
            if status != OK:
                return None
            slopes.append(rate)
        y = y + h / 6.0 * (slopes[0] + 2.0 * slopes[1] + 2.0 * slopes[2] + slopes[3])
        t += h
    return (t, y) if np.isfinite(y).all() else None


# of the square of the largest speed, in lengths of the machine and radians: accelerations that change a motion
CHANGES = 1e-6
Found = tuple[Reduction, Array, Array, LinearSystem]


class Judged(Struct):
    """Linear equations, and `space` with the signs of the results: places, rates, -1 where a joint coordinate grows against its velocity.

    moves : whether the machine does. unsteady : why eigenvalues do not describe the motion, in sentences; none where they do. remarks : on
    what the states are. drift : by which A changes all the same.
    """

    reduction: Reduction
    places: Array
    rates: Array
    space: LinearSystem
    moves: bool
    unsteady: tuple[str, ...] = ()
    remarks: tuple[str, ...] = ()
    drift: Array | None = None


def judged(
    catalogue: Catalogue, moment: Moment, instant: Instant, inputs: Sequence[Input], outputs: Sequence[Output]
) -> Judged:
    """The equations at an instant: of a moving machine in the first axes in which A is the same later on, else in those of its bodies."""
    ports, reader = catalogue.ports(inputs), catalogue.reader(outputs)
    every = coordinate_signs(catalogue, instant)

    def equations(frames: Frames) -> Found:
        reduction = Reduction(instant, ports, reader, axes=frames.at(instant))
        places, rates = (every[chosen] for chosen in reduction.chosen)
        return reduction, places, rates, signed(reduction.state_space(), np.concatenate([places, rates]))

    if is_at_rest(instant):
        found = equations(Frames())
        return Judged(*found, False, tuple(_unrest(moment, instant, found[0], found[-1].A)))
    for frames in candidates(instant):
        found = equations(frames)

        def later(t: float, y: Array, frames: Frames = frames, found: Found = found) -> Array:
            own = instant if t == instant.t else Instant(moment.motion, t, y)
            then = Reduction(own, ports, nothing, found[0].chosen, frames.at(own))
            return signed(then.state_space(), np.concatenate(found[1:3])).A

        changed = drift(moment.prepared.motion, instant, later)
        if changed is not None:
            return Judged(*found, True, (), tuple(frames.notes()), changed)
    found = equations(Frames())
    return Judged(*found, True, (_unsteady(instant, found[0]),))


def _unsteady(instant: Instant, reduction: Reduction) -> str:
    """Why a moving machine has no eigenvalues: what of its motion changes, as seen from axes that turn as steadily as they can."""
    own = instant
    own.value()
    v, vdot = own.y[own.positions : own.first_state][own.free], own.vdot[own.free]
    frames = candidates(own)[0]
    turned = frames.at(own)
    rate = vdot if turned is None else turned.turn @ vdot + turned.rate @ (turned.turn @ v)
    length = own.length[own.free]
    size, speed = np.abs(rate / length), float(np.max(np.abs(v / length), initial=0.0))
    said = "A changes while the machine moves, so its eigenvalues describe no motion"
    worst = int(np.argmax(size)) if len(size) else 0
    if len(size) and size[worst] > CHANGES * speed**2:
        name, unit = velocity_names(own.system)[own.free[worst]]
        return f"{said}: it does not move steadily, {name} accelerates most, by {number(abs(float(rate[worst])))} {unit}/s²"
    if np.any(own.place[own.free[reduction.selected], 1] != NONE) and not frames.bodies:
        return f"{said}: where a body spins, measure it by joint coordinates: --coordinates relative"
    return (
        f"{said}: its speeds stay, but its equations change with its position; A, B, C and D hold at this moment alone"
    )


def coordinate_signs(catalogue: Catalogue, instant: Instant) -> Array:
    """(f,) -1 where a joint coordinate of the results grows against the velocity of the same name, else 1."""
    names = velocity_names(instant.system)
    known = catalogue.coordinates
    place = {name: k for k, name in enumerate(known)}
    outputs = [catalogue.outputs[name] for name in known]
    slopes = instant.along("q", catalogue.reader(outputs)).seen if outputs else np.zeros((0, len(instant.free)))
    out = np.ones(len(instant.free))
    for k, j in enumerate(instant.free):
        row = place.get(names[j][0])
        if row is not None and slopes[row, k] < 0.0:
            out[k] = -1.0
    return out


def nothing(_: Instant) -> Lanes:
    """What a reader of no outputs reads."""
    return np.zeros((0, len(NOTHING)))


def signed(space: LinearSystem, signs: Array) -> LinearSystem:
    """The equations with these signs of the first states."""
    more = np.ones(len(space.A))
    more[: len(signs)] = signs
    return LinearSystem(more[:, None] * space.A * more, more[:, None] * space.B, space.C * more, space.D)


def _unrest(moment: Moment, instant: Instant, reduction: Reduction, A: Array) -> list[str]:
    """Why a machine at rest is not in equilibrium, states of elements included."""
    gravity = float(np.linalg.norm(instant.record.bodies.gravity)) / instant.system.size
    rate = float(np.max(np.abs(A), initial=0.0))
    size = acceleration_of(instant)
    worst = int(np.argmax(size)) if len(size) else 0
    notes = []
    if len(size) and size[worst] > BALANCE * max(gravity, rate, 1e-12):
        name = unknown_name(instant.system, worst)
        notes.append(
            f"the machine is at rest but not in equilibrium ({name} accelerates most), so eigenvalues describe no motion: "
            "linearise about equilibrium"
        )
    g = instant.value()[instant.n :][: instant.state_count]
    moving, changing = len(reduction.selected) + len(reduction.moving), []
    for k, fact in enumerate(instant.system.states):
        share = abs(g[k]) / ((fact.scale or 1.0) * max(1.0, abs(A[moving + k]).max()))
        if share > BALANCE and not fact.integral:
            changing.append((share, k))
    if changing:
        k = max(changing)[1]
        fact, others = instant.system.states[k], len(changing) - 1
        more = f", and {others} more states change" if others else ""
        notes.append(
            f"the state {fact.name} changes by {g[k]:.4g} {fact.units}/s{more}, so eigenvalues describe no motion: "
            "linearise about equilibrium"
        )
    return notes
