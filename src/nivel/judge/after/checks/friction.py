"""Indeterminate friction: several frictions hold one motion at rest; what they hold it with together is known, their shares are not."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.named_freedoms import coordinate_derivatives
from nivel.judge.after.report import FRAMES, Check
from nivel.judge.after.subject import Run
from nivel.kernels.elements import friction as columns
from nivel.known import Contact, Friction
from nivel.lazy import Struct, scipy
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import resolve
from nivel.results.frames.contents import own_units
from nivel.results.scales import Readable, machine_size, span
from nivel.results.trust import Item
from nivel.system.system import Array
from nivel.words.wording import first_of, listed

# A rate below this share of the largest one of the run, and of the machine's size or a radian once in the run, is none.
STILL = 1e-9
SHOWN = 3  # spans in a sentence
# A coordinate that sticks is not exactly at rest: what changes of its load leave it is slower than this share of what `still` asks for.
RESTING = 1e-6
# An effort below the greatest one by more than this share of it is that of a friction that sticks.
WITHIN = 1e-6
MOST_PATTERNS = 8  # sets of contacts that stick
# A motion of which no more than this share is left beside others follows from them.
LEFT = 1e-7


class Held(Struct):
    """A friction with stiction on a joint coordinate (`pin.angle`) whose motion is prescribed by these drivers, or without any of them by
    these joints and couplings."""

    friction: str
    coordinate: str
    drivers: tuple[str, ...]
    others: tuple[str, ...] = ()


class Sticking(Struct):
    """A friction with stiction on a joint coordinate that may move.

    left : (n,) unit direction of the coordinate's derivative in the motions that the constraints allow. static : its greatest effort at
    rest over its normal load [- or m]. viscous : effort per rate.
    """

    friction: str
    coordinate: str
    left: Array
    static: float
    viscous: float


class Shared(Struct):
    """Who holds which joint coordinates at rest together, which results are not unique then, and the times [s] of the first and the last
    frame of each span in which they do.

    holders : in words, `driver turn`.
    """

    holders: tuple[str, ...]
    coordinates: tuple[str, ...]
    efforts: tuple[str, ...]
    spans: tuple[tuple[float, float], ...]


class SharedLoads(Struct):
    """Who shares loads in no certain way, and the results that are not unique then."""

    shared: tuple[Shared, ...]
    efforts: tuple[str, ...]


def look(run: Run) -> SharedLoads | None:
    """Frictions that hold something at rest together, with what prescribes its motion or with each other."""
    held, sticking = resting_frictions(run.machine, run.prepared.absolute, run.prepared.assembly.y)
    joints = (*shared_loads(run.result, held), *loads_held_together(run.result, sticking))
    shared = (*joints, *contacts_together(run))
    efforts = tuple(dict.fromkeys(name for each in shared for name in each.efforts))
    return SharedLoads(shared, efforts) if shared else None


def say(found: SharedLoads) -> Item:
    """Who holds what, and that it does not matter for the motion."""
    text = (
        f"Friction: {'; '.join(map(in_words, found.shared))}. The motion does not depend on how they share the load, which is not unique "
        f"(green if none, amber otherwise)"
    )
    return Item("shared_friction", "amber", text, time=min(each.spans[0][0] for each in found.shared))


def resting_frictions(
    machine: MachineRecord, motion: MotionEquations, y: Array
) -> tuple[tuple[Held, ...], tuple[Sticking, ...]]:
    """In the assembled state y of absolute coordinates: frictions whose coordinate is a combination of constraint rows, and whose rows
    these are; and all others, whose coordinates may move. Of machines that bend the former are only those that a driver moves directly, and
    of the latter only those of one coordinate follow from each other, for all else may follow from bending."""
    rubbing = [force for force in machine.forces if isinstance(force, Friction) and force.model == "stiction"]
    if not rubbing or not motion.system.machine_rows:
        return (), ()
    system = motion.system
    motion.evaluate(0.0, y)
    places = [
        int(system.record.friction.columns[system.frictions.index(force.name), columns.COORDINATE]) for force in rubbing
    ]
    wanted = _unit(coordinate_derivatives(motion, places))
    rows = _unit(motion.jacobian_in_lengths())
    share = np.linalg.lstsq(rows.T, wanted.T, rcond=LEFT)[0].T
    left = wanted - share @ rows
    moves = (np.unique(places)[:, None] == places).T.astype(float) if machine.is_flexible else _unit(left)
    held, sticking = [], []
    for k, force in enumerate(rubbing):
        name = ".".join(resolve(force.coordinate, machine.joints))
        used = np.flatnonzero(np.abs(share[k]) > LEFT)
        driven = all(system.rows[row].endswith(".driver") for row in used)
        if np.linalg.norm(left[k]) > LEFT:
            arm = system.record.friction.number[system.frictions.index(force.name), columns.ARM]
            sticking.append(Sticking(force.name, name, moves[k], float(force.static * arm), force.viscous))
        elif driven or not machine.is_flexible:
            owners = {system.row_owner[row]: system.rows[row].endswith(".driver") for row in used}
            drivers = tuple(name for name, drives in owners.items() if drives)
            held.append(Held(force.name, name, *(drivers, tuple(name for name in owners if name not in drivers))))
    return tuple(held), tuple(sticking)


def contacts_together(run: Run) -> tuple[Shared, ...]:
    """Contacts that hold one motion together, over two frames or more: of those that stick in a frame, whose slips and spins follow from
    each other. Each set of contacts that stick is looked at in the middle of its frames, the commonest of them first."""
    result, motion = run.result, run.prepared.absolute
    names = [each.name for each in run.machine.forces if isinstance(each, Contact) and each.sticks]
    if len(names) < 2:
        return ()
    sticks = np.array([result.array(f"force.{name}.sticks") > 0.5 for name in names]).T
    patterns, of_frame, counts = np.unique(sticks, axis=0, return_inverse=True, return_counts=True)
    found: dict[tuple[str, ...], NDArray[np.bool_]] = {}
    for k in np.argsort(-counts)[:MOST_PATTERNS]:
        frames = of_frame.ravel() == k
        held = [name for name, holds in zip(names, patterns[k], strict=True) if holds]
        if len(held) > 1 and (group := _dependent(run, motion, held, int(np.flatnonzero(frames)[frames.sum() // 2]))):
            found[group] = found.get(group, np.zeros(len(frames), dtype=bool)) | frames
    out = []
    for group, frames in found.items():
        if spans := spans_of(result.time, frames):
            efforts = (f"force.{name}.friction_{what}" for name in group for what in ("force", "x", "y", "z"))
            out.append(Shared(tuple(f"contact {name}" for name in group), ("slip",), tuple(efforts), spans))
    return tuple(out)


def _dependent(run: Run, motion: MotionEquations, names: list[str], frame: int) -> tuple[str, ...]:
    """Those of these contacts whose slips and spins in a frame follow from those of the others."""
    system, result = motion.system, run.result
    own = [k for k, each in enumerate(system.frictions) if each.rpartition(".")[0] in names]
    R, theta = (result.array(what)[frame][: system.body_count] for what in ("position", "orientation"))
    still = np.zeros((system.body_count, 3))
    motion.evaluate(float(result.time[frame]), system.state(np.hstack([R, theta]).ravel(), still, still))
    places = [int(system.record.friction.columns[k, columns.COORDINATE]) for k in own]
    wanted = coordinate_derivatives(motion, places)
    if system.machine_rows:
        basis = _basis(_unit(motion.jacobian_in_lengths()))
        wanted = wanted - wanted @ basis.T @ basis
    _, size, every = np.linalg.svd(wanted.T)
    free = every[int(np.sum(size > LEFT * max(size.max(initial=0.0), 1e-300))) :]
    taking = [k for k, part in zip(own, np.abs(free).max(axis=0, initial=0.0), strict=True) if part > LEFT]
    return tuple(dict.fromkeys(system.frictions[k].rpartition(".")[0] for k in taking))


def _unit(rows: Array) -> Array:
    """Rows of unit length."""
    return rows / np.maximum(np.linalg.norm(rows, axis=1, keepdims=True), 1e-300)


def shared_loads(result: Readable, held: Sequence[Held]) -> tuple[Shared, ...]:
    """Those of the frictions `held` that rest over two frames or more, and when: a motion that turns back rests for no time."""
    found = []
    for each in held:
        spans = spans_of(result.time, still(result, each.coordinate, STILL))
        if spans:
            efforts = f"force.{each.friction}.magnitude", *(f"driver.{name}.effort" for name in each.drivers)
            found.append(Shared((each.friction, _prescriber(each)), (each.coordinate,), efforts, spans))
    return tuple(found)


def in_words(shared: Shared) -> str:
    """Who holds which coordinates, and when."""
    when = first_of([f"{first:.6g} to {last:.6g} s" for first, last in shared.spans], SHOWN, more="times more")
    return f"{listed(shared.holders)} hold {listed(shared.coordinates)} at rest together (t = {when})"


def still(result: Readable, coordinate: str, share: float) -> NDArray[np.bool_]:
    """(frames,) whether the joint coordinate is at rest: slower than a share of its largest rate, or of the machine's size or a radian once
    in the run."""
    place = result.coordinates[result.variables["joint_rate"].dims[1]].index(coordinate)
    rate = np.abs(result.array("joint_rate")[:, place])
    known = np.isfinite(rate)
    size = machine_size(result)[0] if own_units(result.attributes, "joint_coordinate", coordinate) == "m" else 1.0
    once = size / span(result)
    return known & (rate <= share * max(once, float(np.max(rate, initial=0.0, where=known))))


def spans_of(time: Array, rests: NDArray[np.bool_]) -> tuple[tuple[float, float], ...]:
    """First and last times of the frames that follow each other in `rests`, two at least."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], rests, [False]]).astype(int)))
    pairs = zip(edges[::2], edges[1::2] - 1, strict=True)
    return tuple((float(time[first]), float(time[last])) for first, last in pairs if last > first)


def _prescriber(held: Held) -> str:
    if not held.drivers:
        return ", ".join(held.others)
    return f"driver{'s' * (len(held.drivers) > 1)} {', '.join(held.drivers)}"


def loads_held_together(result: Readable, frictions: Sequence[Sticking]) -> tuple[Shared, ...]:
    """Frictions that hold one motion at rest together, over two frames or more.

    A friction that sticks has an effort below its greatest one, so of frictions that stick, where the motion of one follows from those of
    the others, each may give up something to the others. One that has come to its greatest effort and does not move may too.
    """
    if len(frictions) < 2:
        return ()
    left = np.array([each.left for each in frictions])
    rests, sticks = _holding(result, frictions)
    out: dict[tuple[int, ...], NDArray[np.bool_]] = {}
    patterns, of_frame = np.unique(np.concatenate([rests, sticks], axis=1), axis=0, return_inverse=True)
    for k, pattern in enumerate(patterns):
        for group in _groups(left, *np.split(pattern, 2)):
            out.setdefault(group, np.zeros(len(rests), dtype=bool))[of_frame.ravel() == k] = True
    found = []
    for group, frames in out.items():
        spans = spans_of(result.time, frames)
        if spans:
            names = tuple(frictions[k].friction for k in group)
            coordinates = tuple(dict.fromkeys(frictions[k].coordinate for k in group))
            found.append(Shared(names, coordinates, tuple(f"force.{name}.magnitude" for name in names), spans))
    return tuple(found)


def _holding(result: Readable, frictions: Sequence[Sticking]) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """(frames, frictions) which rest under a load, and which of them stick."""
    rests, sticks = [], []
    coordinates, rates = result.coordinates[result.variables["joint_rate"].dims[1]], result.array("joint_rate")
    for each in frictions:
        rate = rates[:, coordinates.index(each.coordinate)]
        largest = each.static * result.array(f"force.{each.friction}.normal_load")
        effort = np.abs(result.array(f"force.{each.friction}.magnitude") + each.viscous * rate)
        resting = still(result, each.coordinate, RESTING) & (largest > 0.0)
        rests.append(resting)
        sticks.append(resting & (effort < (1.0 - WITHIN) * largest))
    return np.array(rests).T, np.array(sticks).T


def _groups(left: Array, rests: NDArray[np.bool_], sticks: NDArray[np.bool_]) -> list[tuple[int, ...]]:
    """Frictions whose efforts may change together without changing what they do, in groups that have nothing to do with each other."""
    held = _basis(left[sticks])
    beside = np.linalg.norm(left - left @ held.T @ held, axis=1)
    chosen = np.flatnonzero(sticks | (rests & (beside < LEFT)))
    if not len(chosen):
        return []
    _, size, every = np.linalg.svd(left[chosen].T)
    free = every[int(np.sum(size > LEFT)) :]
    # of the projection onto the changes that do nothing, the columns of two groups are perpendicular
    together = np.abs(free.T @ free) > LEFT
    _, group = scipy.sparse.csgraph.connected_components(together, directed=False)
    alike = [np.flatnonzero(group == g) for g in dict.fromkeys(group.tolist())]
    return [tuple(chosen[own].tolist()) for own in alike if together[own[0], own[0]]]


def _basis(rows: Array) -> Array:
    """Orthonormal rows that span the same."""
    if not len(rows):
        return rows
    _, size, every = np.linalg.svd(rows, full_matrices=False)
    return every[size > LEFT]


CHECKS = (Check("shared_friction", Run, look, say, 70, (FRAMES,), "Friction", apart=True),)
