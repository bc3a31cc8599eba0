"""Largest numbers of histories, with the rows and times that they belong to, and those of a comparison of runs."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping

import numpy as np

from nivel.lazy import dataclass
from nivel.results.scales import Readable, blocks


@dataclass(frozen=True)
class Peak:
    """The largest number of a history: its value, the name it belongs to, and the time in seconds."""

    value: float
    row: str = ""
    time: float = 0.0


def peak(result: Readable, name: str) -> Peak:
    """The largest magnitude of a history without rows; the first NaN counts as the largest."""
    if name not in result.variables or not len(result.time):
        return Peak(0.0)
    values = np.abs(result.array(name))
    k = int(np.argmax(values))
    return Peak(float(values[k]), "", float(result.time[k]))


def worst_row(result: Readable, name: str, fraction_of: Mapping[str, float]) -> tuple[Peak, str]:
    """The row of `name` (time, row) that is largest as a fraction, and its units: m, rad or 1.

    fraction_of : factor that turns a value into a fraction: of lengths ("m"), of all others ("1").
    """
    if name not in result.variables:
        return Peak(0.0), "m"
    rows = result.coordinates[result.variables[name].dims[1]]
    units = row_units(result, rows)
    factors = np.array([fraction_of["m" if each == "m" else "1"] for each in units])
    best, largest = (0, 0), -1.0
    for frames in blocks(result):
        block = np.abs(result.array(name, frames)) * factors
        if not block.size:
            continue
        k, row = np.unravel_index(int(np.argmax(block)), block.shape)
        if not block[k, row] <= largest:  # also when it is NaN
            best, largest = (frames.start + int(k), int(row)), float(block[k, row])
        if math.isnan(largest):
            break
    if largest < 0.0:
        return Peak(0.0), "m"
    k, row = best
    value = float(abs(result.array(name, slice(k, k + 1))[0, row]))
    return Peak(value, rows[row], float(result.time[k])), units[row]


def row_units(result: Readable, rows: tuple[str, ...]) -> tuple[str, ...]:
    """Units of the constraint rows at position level, m, rad or 1; rows without a stated unit count as lengths.

    They are stated by the attribute `constraint_units` (JSON: row → units).
    """
    stated = json.loads(str(result.attributes.get("constraint_units", "{}")))
    return tuple(stated.get(row, "m") or "1" for row in rows)


NORMALISATION = ".euler_parameters"  # rows of lagrange that are not of the machine


@np.errstate(over="ignore", invalid="ignore")  # a run that grew beyond all bounds is far off, not a warning
def constraint_measures(result: Readable, name: str, size: float) -> tuple[float, float]:
    """(largest, mean) magnitude of the variable `name` over frames and rows; rows in metres divided by `size` [m].

    name : `constraint_violation` or `constraint_rate_violation`. Rows that only normalise rotation coordinates are left out: not all
    formulations have them.
    """
    if name not in result.variables or not len(result.time):
        return 0.0, 0.0
    rows = result.coordinates[result.variables[name].dims[1]]
    kept = [k for k, row in enumerate(rows) if not row.endswith(NORMALISATION)]
    if not kept:
        return 0.0, 0.0
    factors = np.array([1.0 / size if units == "m" else 1.0 for units in row_units(result, rows)])
    values = np.abs(result.array(name)[:, kept]) * factors[kept]
    return float(np.max(values)), float(np.mean(values))


@np.errstate(over="ignore", invalid="ignore")
def energy_measures(result: Readable, kinetic_energy: float) -> tuple[float, float | None]:
    """(largest energy error [J], the same divided by `kinetic_energy` [J], None where that is zero)."""
    if "energy_error" not in result.variables or not len(result.time):
        return 0.0, None
    error = float(np.max(np.abs(result.array("energy_error"))))
    return error, error / kinetic_energy if kinetic_energy > 0.0 else None
