"""Eigenvalues of the machine with other elements of its beams."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nivel.analysis.linearise.opened import Opened
from nivel.analysis.linearise.run import linear_model
from nivel.analysis.plan.plan import Methods, Plan, methods_of
from nivel.analysis.progress.listener import Listener
from nivel.analysis.run.prepared_state import run_until
from nivel.errors import ModelError, SolveError
from nivel.judge.after.other_elements import other_elements
from nivel.judge.after.subject import OtherVibrations
from nivel.machine.settings.linearise import LineariseSettings


def other_vibrations(
    opened: Opened, methods: Methods, settings: LineariseSettings, run: Plan | None
) -> OtherVibrations | None:
    """What the trust report compares the vibrations with; None where there are no beams. run : to the state, or None."""
    pair = other_elements(opened.machine)
    if pair is None:
        return None
    try:
        posture = None
        if run is not None:
            its = other_elements(run.machine)
            assert its is not None  # it has the same beams
            at = methods_of(its.machine, run.methods.formulation, run.methods.coordinates)
            posture = run_until(replace(run, machine=its.machine, methods=at), Listener())
        its_methods = methods_of(pair.machine, methods.formulation, methods.coordinates)
        model, _ = linear_model(replace(opened, machine=pair.machine), its_methods, settings, posture=posture)
    except (ModelError, SolveError) as error:
        return OtherVibrations(pair, np.zeros(0, dtype=np.complex128), str(error))
    return OtherVibrations(pair, model.eigenvalues)
