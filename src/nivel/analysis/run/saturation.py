"""Blocks of a control that stood at a limit for a whole run: their gains did nothing."""

from __future__ import annotations

from typing import Final

import numpy as np

from nivel.machine.machine_record import MachineRecord
from nivel.results.result import Result

WHOLE: Final = 0.999  # share of the frames after the first
LEAST: Final = 5  # frames of which something can be said


def saturated_blocks(machine: MachineRecord, result: Result) -> tuple[str, ...]:
    """Names of the blocks whose value was a limit in all frames but the first."""
    out = []
    for block in machine.control:
        limits = getattr(block, "limits", None)
        name = f"control.{block.name}"
        if limits is None or name not in result.variables or len(result.time) <= LEAST:
            continue
        values = result.array(name)[1:]
        if np.mean((values <= limits[0]) | (values >= limits[1])) >= WHOLE:
            out.append(block.name)
    return tuple(out)
