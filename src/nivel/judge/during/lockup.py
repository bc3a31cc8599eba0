"""Machines that are driven beyond the last position in which their joints can be closed: when, and what holds which driver there.

Up to a jam there are positions q(t) that close all rows C(q, t) = 0, beyond it there are none nearby. Where C_q has its full rank they go
on (implicit function theorem), so a jam is a singular position. Towards it speeds and reactions grow without bound, and each method fails
in a way of its own, or opens the joints. So the positions are asked, and not the method.
"""

from collections.abc import Iterator
from contextlib import contextmanager, suppress

import numpy as np

from nivel.analysis.assembly.closing import close_positions
from nivel.analysis.assembly.redundancy import scaled_jacobian
from nivel.analysis.preparation.memory import arrays_of
from nivel.analysis.preparation.preparation import Prepared
from nivel.errors import ModelError
from nivel.judge.during.stop import named_row, unit_of
from nivel.kernels.output.observe import observe
from nivel.lazy import Struct
from nivel.system.system import Array
from nivel.words.wording import listed

# How far beyond a failure a jam is looked for, in steps: methods that solve for accelerations fail some steps before it, and a driver may
# be back within its reach a few steps after it.
AHEAD = (0.1, 0.3, 1.0, 3.0, 10.0, 50.0)
# How far before it, where joints are open already, in powers of ten of a step.
BACK = 6
# Halvings of the time between a position that can be closed and one that cannot; after so many it shows whether it is a singular one.
HALVINGS, SHOWS = 20, 4
# Iterations that close positions from nearby, at most, and entries of C_q with which many of them are still quick.
ITERATIONS, MOST_ENTRIES = 30, 200_000
# The least singular value of C_q falls as the square root of the time to the jam. This share of what it was at the start is near it.
LOST = 0.05
# And soon before, as where the run failed if that is not in the step that leads beyond the jam, it has fallen to this.
FALLEN = 0.5
# And to this beside a position where motions branch, in which steps shrink.
BESIDE = 1e-3
# Rows take part in what is lost with at least this share of the one that does most.
TAKES_PART = 0.1


class Jam(Struct):
    """The position beyond which joints cannot be closed.

    time : [s]. joints, drivers : whose rows depend on each other there; couplings are with the joints. places : where these drivers are
    then, in words. later : a time beyond it [s], at
    which `row`, in words, is open by `gap`, with its unit, and most of all rows, when all are as nearly closed as was found.
    """

    time: float
    joints: tuple[str, ...]
    drivers: tuple[str, ...]
    places: tuple[str, ...]
    later: float
    gap: str
    row: str

    @property
    def message(self) -> str:
        """When and where the machine jams."""
        held = f"{listed(self.drivers)} {'are' if len(self.drivers) > 1 else 'is'} held by {listed(self.joints)}"
        held = held if self.drivers else f"{listed(self.joints)} depend on each other"
        places = f" There {listed(self.places)}." if self.places else ""
        return (
            f"the machine jams at t = {self.time:.6g} s, in a singular position beyond which its joints cannot be closed: there {held}."
            f"{places} At t = {self.later:.6g} s {self.row} would be open by {self.gap}"
        )

    @property
    def advice(self) -> str:
        """What to try."""
        prescribed = f"what {listed(self.drivers)} prescribe{'s' * (len(self.drivers) == 1)}"
        what = prescribed if self.drivers else "how they move with time"
        return (
            f"Look at {what} against the lengths between {listed(self.joints)}: let it stop or turn back before t = {self.time:.4g} s, or "
            "drive another coordinate. No step and no method goes on from there."
        )


def can_be_asked(prepared: Prepared) -> bool:
    """Whether positions of the machine can be closed apart from its motion: of bodies that do not bend, and few enough of them."""
    system = prepared.absolute.system
    entries = system.machine_rows * 6 * system.body_count
    sliding = len(prepared.motion.system.record.tree.slider) > 0
    return 0 < entries <= MOST_ENTRIES and not sliding and not len(prepared.motion.system.modes)


@contextmanager
def _asked(prepared: Prepared) -> Iterator[None]:
    """Positions are asked: coordinates share their records, and a run may go on. Some are so far apart that nothing can be computed with
    them."""
    kept = [(array, array.copy()) for array in arrays_of(prepared.motion.system.record) if array.flags.writeable]
    try:
        with suppress(ModelError, np.linalg.LinAlgError):
            yield
    finally:
        for array, numbers in kept:
            array[...] = numbers


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # of states that may be beyond all bounds
def find_jam(prepared: Prepared, time: float, step: float, short: float, end: float, y: Array) -> Jam | None:
    """The jam in or beside the step from `time` [s] with the accepted state y of the run; None where none is found.

    short : what the user calls a short time [s], where steps are chosen. end : of the run [s]. The record is left as it was.
    """
    if not can_be_asked(prepared) or not np.isfinite(y).all():
        return None
    with _asked(prepared):
        return _Nearby(prepared, time, y).jam(step, max(step, short), end)
    return None


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # of states that may be beyond all bounds
def branching_joints(prepared: Prepared, time: float, y: Array) -> tuple[str, ...]:
    """Joints whose rows depend on each other beside the state y of the run at `time` [s], but not at the start; none elsewhere."""
    if not can_be_asked(prepared) or not np.isfinite(y).all():
        return ()
    with _asked(prepared):
        near = _Nearby(prepared, time, y)
        if not near.has_lost(time, near.y, BESIDE):
            return ()
        shares = np.abs(np.linalg.svd(near.rows_at(time, near.y), full_matrices=False)[0][:, near.rank - 1])
        owners = prepared.absolute.system.row_owner
        return tuple(dict.fromkeys(owners[row] for row in np.flatnonzero(shares >= TAKES_PART * shares.max())))
    return ()


def branching_advice(joints: tuple[str, ...], step: float) -> tuple[str, str]:
    """(message, advice) of steps that shrink beside a singular position. step : the present one [s]."""
    return (
        f"steps have shrunk to {step:.2g} s beside a singular position, where rows of {listed(joints)} depend on each other: the motion "
        f"branches there, and a method that chooses its steps may turn into the other branch",
        f"A fixed step passes it by inertia, as `integrator: rk4`; so may a larger tolerance. To have one motion alone, keep "
        f"{listed(joints)} from coming into line, or add what decides there: a second crank, a spring, a limit.",
    )


class _Nearby:
    """Positions near those of the state y of a run at `time` [s], in absolute coordinates."""

    def __init__(self, prepared: Prepared, time: float, y: Array) -> None:
        motion, self.absolute = prepared.motion, prepared.absolute
        self.start, self.rank, self.time = prepared.assembly.y, prepared.redundancy.rank, time
        self.reference = motion.system.record.coordinates.reference.copy()
        system, count = self.absolute.system, self.absolute.system.body_count
        motion.evaluate(time, y)
        observe(motion.handle.address, time, y, frame := np.zeros(motion.system.layout.width))
        R, theta = frame[1 : 1 + 3 * count].reshape(count, 3), frame[1 + 3 * count : 1 + 7 * count].reshape(count, 4)
        still = np.zeros((count, 3))
        self.y = system.state(np.hstack([R, theta]).ravel(), still, still)

    def closed(self, t: float, y: Array) -> tuple[bool, Array]:
        """Whether all rows can be closed at t from y, and the state in which they are, or the best one found."""
        near = y.copy()
        self.absolute.system.record.coordinates.reference[:] = self.reference
        return close_positions(self.absolute, t, near, iterations=ITERATIONS, from_afar=False), near

    def jam(self, step: float, unit: float, end: float) -> Jam | None:
        """The first one from here on, or where joints are open already, the last one before. unit : at least a step [s]."""
        farthest = max(end, self.time + step)
        later = sorted({self.time, self.time + step, *(min(self.time + share * unit, farthest) for share in AHEAD)})
        open_at = next((t for t in later if not self.closed(t, self.y)[0]), None)
        if open_at is None:
            return None
        earlier = [self.time, *(self.time - 10.0**k * unit for k in range(BACK)), 0.0]
        for last in (t for t in earlier if 0.0 <= t < open_at):
            closed, q = self.closed(last, self.y)
            if closed:
                leads_there = open_at <= self.time + step
                return self.between(last, open_at, q) if leads_there or self.has_lost(last, q, FALLEN) else None
        return None

    def between(self, last: float, later: float, q: Array) -> Jam | None:
        """The jam between `last`, when q closes all rows, and `later`, when nothing does; None where the rows stay independent."""
        open_at = later
        for k in range(HALVINGS):
            if k == SHOWS and not self.has_lost(last, q, FALLEN):
                return None
            half = 0.5 * (last + open_at)
            closed, nearer = self.closed(half, q)
            if closed:
                last, q = half, nearer
            else:
                open_at = half
        if not self.has_lost(last, q, LOST):
            return None
        shares, _, _ = np.linalg.svd(self.rows_at(last, q), full_matrices=False)
        return self.told(last, later, q, np.abs(shares[:, self.rank - 1]))

    def has_lost(self, t: float, y: Array, share: float) -> bool:
        """Whether the least singular value of C_q, redundant rows apart, is below this share of what it was at the start."""
        now, first = (np.linalg.svd(self.rows_at(*at), compute_uv=False) for at in ((t, y), (0.0, self.start)))
        return bool(now[self.rank - 1] <= share * first[self.rank - 1])

    def rows_at(self, t: float, y: Array) -> Array:
        """C_q in units of the machine, rows of unit length."""
        self.absolute.evaluate(t, y)
        return scaled_jacobian(self.absolute)

    def told(self, last: float, later: float, q: Array, lost: Array) -> Jam:
        """The jam at `last` in the position q, where the rows lose a combination to which they add the shares `lost`."""
        system, constraints = self.absolute.system, self.absolute.system.record.constraints
        owners = dict.fromkeys(system.row_owner[row] for row in np.flatnonzero(lost >= TAKES_PART * lost.max()))
        rows = {
            system.row_owner[row]: row for row, name in enumerate(system.rows[: len(lost)]) if name.endswith(".driver")
        }
        drivers = tuple(name for name in owners if name in rows)
        self.closed(last, q)
        places = tuple(place for name in drivers for place in self.driven_to(rows[name]))
        self.closed(later, q)
        violation = np.abs(constraints.C[: len(lost)])
        worst = int(np.argmax(violation / constraints.scale[: len(lost)]))
        return Jam(
            time=last,
            joints=tuple(name for name in owners if name not in rows) or ("the joints",),
            drivers=drivers,
            places=places,
            later=later,
            gap=f"{violation[worst]:.3g} {unit_of(system, worst)}",
            row=named_row(system, worst),
        )

    def driven_to(self, row: int) -> Iterator[str]:
        """The joint coordinate that this row drives, and its value in the state last evaluated, in words; nothing for markers."""
        system = self.absolute.system
        constraints, coordinates = system.record.constraints, system.record.coordinates
        known = system.record.joints.coordinate.tolist()
        for _, first, *_ in constraints.combination[constraints.combination[:, 0] == row].tolist():
            k = int(constraints.term[first, 0])
            if k in known:
                place = known.index(k)
                unit = system.coordinate_units[place]
                value = float(coordinates.value[k])
                turned = f" ({np.degrees(value):.6g}°)" if unit == "rad" else ""
                name = system.layout.coordinates["joint_coordinate"][place]
                yield f"{name} is {value:.6g} {unit}{turned}"
