"""The linear equations of a machine in axes in which they stay the same, and whether their eigenvalues describe its motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nivel.analysis.assembly.instant import Complex, Instant
from nivel.analysis.assembly.unknowns import unknown_name
from nivel.analysis.linearise.axes import Frames, candidates
from nivel.analysis.linearise.names import velocity_names
from nivel.analysis.linearise.ports import Catalogue, Input, Output
from nivel.analysis.linearise.reduction import Reduction, StateSpace
from nivel.analysis.linearise.steady import BALANCE, acceleration_of, drift, is_at_rest
from nivel.analysis.run.prepared_state import Moment
from nivel.kernels.record.record import NONE
from nivel.system.system import Array

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
        return reduction, places, rates, _signed(reduction.state_space(), np.concatenate([places, rates]))

    if is_at_rest(instant):
        found = equations(Frames())
        return Judged(*found, False, tuple(_unrest(moment, instant, found[0], found[-1].A)))
    for frames in candidates(instant):
        found = equations(frames)

        def later(t: float, y: Array, frames: Frames = frames, found: Found = found) -> Array:
            own = instant if t == instant.t else Instant(moment.motion, t, y)
            then = Reduction(own, ports, nothing, found[0].chosen, frames.at(own))
            return _signed(then.state_space(), np.concatenate(found[1:3])).A

        changed = drift(moment.prepared.motion, instant, later)
        if changed is not None:
            return Judged(*found, True, (), tuple(frames.notes()), changed)
    found = equations(Frames())
    spinning = instant.place[instant.free[found[0].selected], 1] != NONE
    hint = (
        "where a body spins, measure it by joint coordinates: --coordinates relative"
        if np.any(spinning)
        else "A, B, C and D hold at this moment alone"
    )
    note = f"A changes while the machine moves, so its eigenvalues describe no motion: {hint}"
    return Judged(*found, True, (note,))


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


def nothing(_: Instant) -> Complex:
    """What a reader of no outputs reads."""
    return np.zeros(0, dtype=np.complex128)


def _signed(space: StateSpace, signs: Array) -> StateSpace:
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
    facts, moving = instant.system.states, len(reduction.selected) + len(reduction.moving)
    for k, fact in enumerate(facts):
        if fact.integral:
            continue
        if abs(g[k]) > BALANCE * (fact.scale or 1.0) * max(1.0, abs(A[moving + k]).max()):
            notes.append(
                f"the state {fact.name} changes at a rate of {g[k]:.4g} per second: linearise about equilibrium"
            )
    return notes
