"""Vibrations of a linear model that are beyond the modes of its flexible bodies."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from nivel.analysis.linearise.eigenvalues import Complex
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.trust.checks.modes import NEAR_LEFT, modal_bases
from nivel.machine.machine_record import MachineRecord
from nivel.results.trust import number


def modal_notes(machine: MachineRecord, prepared: Prepared, eigenvalues: Complex) -> Iterator[str]:
    """A sentence for each flexible body that lacks modes of the frequencies of these eigenvalues (n,) [1/s]."""
    if not machine.is_flexible or not len(eigenvalues):
        return
    fastest = float(np.abs(eigenvalues).max())
    for basis in modal_bases(machine, prepared):
        if not len(basis.left.eigenvalues):
            continue
        lowest = float(np.sqrt(basis.left.eigenvalues.min()))
        if fastest > NEAR_LEFT * lowest:
            first, limit = (number(each / (2.0 * np.pi)) for each in (lowest, NEAR_LEFT * lowest))
            yield (
                f"modes: {basis.body.name} leaves out modes from {first} Hz on, so vibrations above {limit} Hz are not those of the whole "
                f"body; use more `modes` if they matter"
            )
