"""Blocks of the control that stand at their limits all the time, so that their gains do nothing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.trust.check import Check, Need
from nivel.analysis.trust.subject import Run
from nivel.results.trust import Item

WHOLE = 0.999  # share of the frames after the first
LEAST = 5  # frames of which something can be said
FRAMES = Need("frames", lambda run: len(run.result.time) > LEAST)


@dataclass(frozen=True)
class Saturated:
    """A block whose value was a limit in all frames but the first."""

    name: str


def look(run: Run) -> list[Saturated]:
    """The blocks at a limit."""
    out = []
    for block in run.machine.control:
        limits = getattr(block, "limits", None)
        name = f"control.{block.name}"
        if limits is None or name not in run.result.variables:
            continue
        values = run.result.array(name)[1:]
        if np.mean((values <= limits[0]) | (values >= limits[1])) >= WHOLE:
            out.append(Saturated(block.name))
    return out


def say(found: Saturated) -> Item:
    """A block whose gains did nothing."""
    said = f"{found.name} stood at its limits for the whole run, so its gains did nothing"
    text = f"Control: {said}; check the signs of its inputs, its gains and its limits"
    return Item("control", "amber", text, row=found.name)


CHECKS = (Check("control", Run, look, say, 410, (FRAMES,), "Control"),)
