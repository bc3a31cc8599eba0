"""The linear equations of a machine in axes in which they stay the same, and whether their eigenvalues describe its motion.

Steadiness of the linear equations while the machine moves: only then their eigenvalues describe the motion.
A machine in equilibrium stays; one in steady motion passes other positions with the same A; anything else has an A(t), as has a body that
spins where its turns are measured about its own axes.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.instant import NOTHING, Instant, Lanes
from nivel.analysis.assembly.unknown_groups import unknown_name
from nivel.analysis.linearise.axes import Frames, candidates
from nivel.analysis.linearise.ports import Catalogue, Input, Output
from nivel.analysis.linearise.reduction import Reduction, StateSpace, velocity_names
from nivel.analysis.run.prepared_state import Moment
from nivel.kernels.core.status import OK
from nivel.kernels.record.record import NONE
from nivel.lazy import dataclass
from nivel.results.trust import number
from nivel.system.system import Array

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
Found = tuple[Reduction, Array, Array, StateSpace]


@dataclass(frozen=True)
class Judged:
    """Linear equations, and `space` with the signs of the results: places, rates, -1 where a joint coordinate grows against its velocity.

    moves : whether the machine does. unsteady : why eigenvalues do not describe the motion, in sentences; none where they do. remarks : on
    what the states are. drift : by which A changes all the same.
    """

    reduction: Reduction
    places: Array
    rates: Array
    space: StateSpace
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


def signed(space: StateSpace, signs: Array) -> StateSpace:
    """The equations with these signs of the first states."""
    more = np.ones(len(space.A))
    more[: len(signs)] = signs
    return StateSpace(more[:, None] * space.A * more, more[:, None] * space.B, space.C * more, space.D)


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
