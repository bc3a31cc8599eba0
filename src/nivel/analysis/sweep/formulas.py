"""Numbers of a prepared machine as functions of its parameters: a constant and one or two powers, found from several machines."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Terms = tuple[tuple[float, float], ...]  # (factor, power)

# powers that numbers may follow, one or two at once
POWERS: Final = ((1.0,), (2.0,), (-0.5,), (-1.0,), (3.0,), (-2.0,), (0.5,), (1.0, 2.0), (1.0, 3.0))
FITS: Final = 1e-11

# Numbers that each evaluation computes again, by the beginnings of their names in the record.
WORKSPACE: Final = (
    "bodies.wrench",
    "bodies.Rddot",
    "bodies.alpha_b",
    "constraints.lam",
    "friction.force",
    "saddle.",
    "tree.rows.lam",
    "tree.inertia",
    "tree.U",
    "tree.Dinv",
    "tree.root",
    "tree.wrench",
    "tree.delta",
    "tree.small",
    "frames.",
    "elements.state",
    "circuit.known",
    "circuit.pressure",
    "circuit.density",
    "circuit.enthalpy",
    "circuit.power",
    "circuit.stored",
    "outputs.",
    "control.energy",
    "control.power",
    "control.stored",
)


def fit(x: Array, y: Array) -> Terms | None:
    """Factors and powers of the first formula that fits all points y (n,) of the parameter x (n,)."""
    found, terms = fit_all(x, y[:, None])
    return terms[0] if found[0] else None


def fit_all(x: Array, y: Array) -> tuple[NDArray[np.bool_], list[Terms]]:
    """Which of the numbers y (n, m) follow a formula, and the terms of each; none of the others."""
    count = y.shape[1]
    fitted, terms = np.zeros(count, dtype=bool), [()] * count
    finite = np.isfinite(y).all(axis=0)
    for powers in POWERS:
        left = np.flatnonzero(~fitted & finite)
        if not len(left) or (min(x) <= 0.0 and any(power < 0.0 or power % 1.0 for power in powers)):
            continue
        columns = np.array([np.ones_like(x), *(x**power for power in powers)]).T
        size = np.abs(columns).max(axis=0)
        factors = np.linalg.lstsq(columns / size, y[:, left], rcond=None)[0] / size[:, None]
        fits = np.abs(columns @ factors - y[:, left]).max(axis=0) <= FITS * np.abs(y[:, left]).max(axis=0)
        for place, own in zip(left[fits], factors.T[fits], strict=True):
            fitted[place] = True
            terms[place] = tuple((float(factor), power) for factor, power in zip(own[1:], powers, strict=True))
    return fitted, terms


def named_arrays(record: Any, name: str = "") -> Iterator[tuple[str, NDArray[Any]]]:
    """The arrays of a record with their names, as `bodies.mass`."""
    for field, part in zip(record._fields, record, strict=True):
        whole = f"{name}.{field}" if name else field
        if isinstance(part, tuple):
            yield from named_arrays(part, whole)
        else:
            yield whole, part
