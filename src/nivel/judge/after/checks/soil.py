"""Soil: what was moved and carried, whether its volume was kept, and the size of its cells, which no second run changes."""

from __future__ import annotations

import math

import numpy as np

from nivel.elements.contacts.soil import OnSoil
from nivel.judge.after.report import FRAMES, Check
from nivel.judge.after.subject import Run
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


@dataclass(frozen=True)
class Moved:
    """Of the soil of some forces: volume moved [m³], cells [m], period [s], what is missing and what fell beyond the border by the volume
    moved; the greatest load [kg]."""

    forces: tuple[str, ...]
    volume: float
    cell: float
    period: float
    missing: float
    spilt: float
    load: float


def look_at_soil(run: Run) -> list[Moved]:
    """Every soil."""
    of: dict[object, list[OnSoil]] = {}
    for force in run.machine.forces:
        if isinstance(force, OnSoil):
            of.setdefault(repr(force.ground), []).append(force)
    return [_moved(run, forces) for forces in of.values()]


def _moved(run: Run, forces: list[OnSoil]) -> Moved:
    def values(force: OnSoil, name: str) -> np.ndarray:
        return np.abs(run.result.array(f"force.{force.name}.{name}"))

    volume = sum(float(values(each, "moved")[-1]) for each in forces)
    by = max(volume, 1e-300)
    loads = [float(values(each, "load").max()) for each in forces if each.type == "blade"]
    return Moved(
        forces=tuple(each.name for each in forces),
        volume=volume,
        cell=forces[0].heights.size[0] / (forces[0].heights.heights.shape[1] - 1),
        period=forces[0].soil.period,
        missing=float(values(forces[0], "balance").max()) / by,
        spilt=float(values(forces[0], "spilt")[-1]) / by,
        load=max(loads, default=0.0),
    )


def say_moved(found: Moved) -> Item:
    """Whether its volume was kept."""
    carried = f", {number(found.load)} kg carried at most" if found.load else ""
    told = f"{number(found.volume)} m^3 moved under {found.forces[0]}{carried}, {number(found.missing)} of it missing"
    fixed = f"cells of {number(found.cell)} m that change every {number(found.period)} s are of the model: no second run has others"
    return KEPT.item("soil", f"Soil: {told}; {fixed}", found.missing, row=found.forces[0])


def say_spilt(found: Moved) -> Item:
    """Whether soil fell beyond the border."""
    text = f"Soil: {number(found.spilt)} of the volume moved fell beyond the border of the `heights`, on which it lies; make them larger"
    return SPILT.item("spilt", text, found.spilt, row=found.forces[0])


CHECKS = (
    Check("soil", Run, look_at_soil, say_moved, 228, (FRAMES,), "Soil", KEPT),
    Check("spilt", Run, look_at_soil, say_spilt, 229, (FRAMES,), "Soil", SPILT, quiet=True),
)
