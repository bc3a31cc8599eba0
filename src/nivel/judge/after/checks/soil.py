"""Soil: what was moved and carried, whether its volume was kept, and the size of its cells, which no second run changes."""

from __future__ import annotations

import math

import numpy as np

from nivel.judge.after.report import FRAMES, Check
from nivel.judge.after.subject import Run
from nivel.known import OnSoil
from nivel.lazy import dataclass
from nivel.results.trust import Item, Threshold, number

KEPT = Threshold(
    1e-9,
    1e-6,
    "Volume of all cells and loads, less that at the start, by the volume that was moved. Each move is of equal volumes, so that only "
    "round-off is left.",
)
SPILT = Threshold(
    1e-6, math.inf, "Volume that fell beyond the border of the heights and lies on it, by the volume that was moved."
)
LEAST = 1e-9  # [m³] of volume moved, below which nothing was


@dataclass(frozen=True)
class Moved:
    """Of all soil: volume moved [m³], and what is missing and what fell beyond the border by that, where it is most; a force on it."""

    force: str
    volume: float
    missing: float
    spilt: float


def look_at_soil(run: Run) -> Moved | None:
    """None without soil."""
    names = [force.name for force in run.machine.forces if isinstance(force, OnSoil)]
    if not names:
        return None
    moved, missing, spilt = (
        [float(np.abs(run.result.array(f"force.{name}.{what}")).max()) for name in names]
        for what in ("moved", "balance", "spilt")
    )
    by = max(sum(moved), LEAST)
    return Moved(names[0], sum(moved), max(missing) / by, max(spilt) / by)


def say_moved(found: Moved) -> Item:
    """Whether its volume was kept."""
    told = f"{number(found.volume)} m^3 moved under {found.force}, {number(found.missing)} of it missing; no second run has other cells"
    return KEPT.item("soil", f"Soil: {told}", found.missing, row=found.force)


def say_spilt(found: Moved) -> Item:
    """Whether soil fell beyond the border."""
    text = f"Soil: {number(found.spilt)} of the volume moved fell beyond the border of the `heights`, on which it lies; make them larger"
    return SPILT.item("spilt", text, found.spilt, row=found.force)


CHECKS = (
    Check("soil", Run, look_at_soil, say_moved, 228, (FRAMES,), "Soil", KEPT),
    Check("spilt", Run, look_at_soil, say_spilt, 229, (FRAMES,), "Soil", SPILT, quiet=True),
)
