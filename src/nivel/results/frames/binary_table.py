"""A result as a table for other programs: MATLAB's MAT file, or Parquet with units."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from nivel.errors import ModelError
from nivel.extras import needed
from nivel.results.frames.csv_table import columns

if TYPE_CHECKING:
    from nivel.results.result import Result


def write_mat(result: Result, path: Path, select: Iterable[str] = ()) -> None:
    """Write `time` and a vector for each column; names have `_` for what MATLAB does not take, `names` has the original ones.

    Raises ModelError.
    """
    from scipy.io import savemat

    chosen = columns(result, select)
    table: dict[str, Any] = {"time": np.asarray(result.time)}
    for name in chosen:
        plain = base = (re.sub(r"\W", "_", name, flags=re.ASCII) or "x")[:60]
        plain = base = plain if plain[0].isalpha() else f"x_{plain}"
        count = 2
        while plain in table:
            plain, count = f"{base}_{count}", count + 1
        table[plain] = np.asarray(result.array(name))
    names = np.array(["time", *chosen], dtype=object)
    units = np.array(["s", *(result.units(name) for name in chosen)], dtype=object)
    try:
        savemat(path, {**table, "names": names, "units": units}, oned_as="column", long_field_names=True)
    except OSError as error:
        raise ModelError(f"the table {path} cannot be written: {(error.strerror or str(error)).lower()}") from None


def write_parquet(result: Result, path: Path, select: Iterable[str] = ()) -> None:
    """Write `time` and a column of each name, with its unit in the metadata of its field. Raises ModelError."""
    parquet = needed("pyarrow.parquet", "Parquet files need")
    import pyarrow as arrow  # pyright: ignore[reportMissingImports]

    chosen = columns(result, select)
    fields = [arrow.field(name, arrow.float64(), metadata={"unit": result.units(name)}) for name in chosen]
    schema = arrow.schema([arrow.field("time", arrow.float64(), metadata={"unit": "s"}), *fields])
    arrays = [arrow.array(np.asarray(values)) for values in (result.time, *(result.array(name) for name in chosen))]
    try:
        parquet.write_table(arrow.Table.from_arrays(arrays, schema=schema), path, compression="zstd")
    except OSError as error:
        raise ModelError(f"the table {path} cannot be written: {(error.strerror or str(error)).lower()}") from None
