"""Modes of the machine with other elements of its beams: up to which one the eigenvalues are known."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from nivel.analysis.linearise.run import linearise
from nivel.analysis.plan.plan import Methods, Plan, methods_of
from nivel.analysis.progress.listener import Listener
from nivel.analysis.run.prepared_state import run_until
from nivel.analysis.trust.checks.beam_mesh import THRESHOLD
from nivel.analysis.trust.other_elements import Pair, other_elements
from nivel.errors import ModelError, SolveError
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.linearise import LineariseSettings
from nivel.results.analyses.linear_model import LinearModel, Mode
from nivel.results.trust import number
from nivel.system.system import Array


def with_note(
    model: LinearModel, machine: MachineRecord, methods: Methods, settings: LineariseSettings, run: Plan | None
) -> LinearModel:
    """The model with a note on the elements of beams, where there are any. run : to the state that it is about, or None."""
    pair = other_elements(machine)
    if pair is None:
        return model

    def linearised() -> LinearModel:
        posture = None
        if run is not None:
            its = other_elements(run.machine)
            assert its is not None  # it has the same beams
            at = methods_of(its.machine, run.methods.formulation, run.methods.coordinates)
            posture = run_until(replace(run, machine=its.machine, methods=at), Listener())
        its_methods = methods_of(pair.machine, methods.formulation, methods.coordinates)
        return linearise(pair.machine, its_methods, settings, posture=posture)

    said = _note(model, pair, linearised)
    return replace(model, notes=(*model.notes, said)) if said else model


def _note(model: LinearModel, pair: Pair, linearised: Callable[[], LinearModel]) -> str:
    """A sentence on what the elements of beams make wrong. linearised : gives the model of the pair."""
    names = ", ".join(pair.beams)
    try:
        other = linearised()
    except (ModelError, SolveError) as error:
        return f"mesh: the elements of {names} are not judged: with {pair.words} {error}"
    vibrations, off = _off([each for each in model.modes if each.eigenvalue.imag > 0.0], other, pair.factor)
    if len(vibrations) == 0:
        return ""
    limit = THRESHOLD.green
    wrong = np.flatnonzero(~(off < limit))
    if not len(wrong):
        return f"mesh: by the elements of {names} every vibration is off by less than {number(float(off.max()))} of it"
    first = vibrations[int(wrong[0])]
    share = off[int(wrong[0])]
    by = f"by {number(float(share))} of it" if np.isfinite(share) else "by an unknown share"
    less = f"; those below by less than {number(float(off[: wrong[0]].max()))}" if wrong[0] else ""
    advice = "use twice as many `elements`" + (", or `order: 2`" if pair.order == 1 else "")
    return (
        f"mesh: by the elements of {names} the vibration of mode {first.number}, {number(first.natural_frequency)} Hz, is off {by}, and "
        f"those above by more{less}; if they matter, {advice}"
    )


def _off(vibrations: list[Mode], other: LinearModel, factor: float) -> tuple[list[Mode], Array]:
    """The vibrations, and by which share of themselves their eigenvalues are off: each against that of the same rank, infinite where there
    is none."""
    others = [each.eigenvalue for each in other.modes if each.eigenvalue.imag > 0.0]
    off = np.full(len(vibrations), np.inf)
    for k, (own, its) in enumerate(zip(vibrations, others, strict=False)):
        off[k] = factor * abs(own.eigenvalue - its) / abs(own.eigenvalue)
    return vibrations, off
