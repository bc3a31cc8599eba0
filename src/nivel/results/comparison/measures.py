"""Measures of the runs of a comparison: how far joints are open and how far the energy is off."""

from __future__ import annotations

import numpy as np

from nivel.results.peaks import row_units
from nivel.results.scales import Readable

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
