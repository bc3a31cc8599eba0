"""The path of a point as a CSV file."""

from __future__ import annotations

import numpy as np

from nivel.analysis.inverse.number_table import read_table
from nivel.errors import Fault, ModelError
from nivel.system.system import Array

PLACE, AXES = ("time", "x", "y", "z"), ("e0", "e1", "e2", "e3")


def read_path(path: str) -> tuple[Array, Array, Array | None]:
    """Times (T,) [s], places (T, 3) [m] and Euler parameters (T, 4) or None. Raises ModelError."""
    names, columns = read_table(path, "inverse.path")
    if tuple(names) not in (PLACE, PLACE + AXES) or not columns[0]:
        wanted = f"`{','.join(PLACE)}`, with `{','.join(AXES)}` behind them or not, and then numbers"
        raise ModelError(Fault.at("inverse.path", f"{path} must begin with {wanted}; got `{','.join(names)}`"))
    values = np.array(columns)
    return values[0], values[1:4].T, values[4:].T if len(values) > len(PLACE) else None
