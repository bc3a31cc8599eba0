"""Columns of binary tables: MATLAB's MAT files, Parquet files, and signals of recordings."""

from __future__ import annotations

import io
from pathlib import Path as FilePath
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.extras import needed
from nivel.files import recording_file

KINDS: Final = (".mat", ".parquet", *recording_file.KINDS)
MOST_ROWS: Final = 20_000_000  # of a table
UNIT_KEYS: Final = (b"unit", b"units")  # of the metadata of a field


class MeasuredError(Exception):
    """Why a file gives no table, in words."""


def measured_columns(
    content: bytes, file: str, column: str | None = None
) -> dict[str, tuple[NDArray[np.float64], str]]:
    """The columns of numbers of a file, with their units where it has any; of a recording the times and values of one signal.

    column : which one, where there are several. Raises MeasuredError.
    """
    suffix = FilePath(file).suffix.lower()
    try:
        if suffix in recording_file.KINDS:
            found = _of_recording(content, file, column)
        else:
            found = _mat(content) if suffix == ".mat" else _parquet(content)
    except ModelError as error:
        raise MeasuredError(error.faults[0].message) from None
    except (ValueError, TypeError, KeyError, OSError, NotImplementedError, EOFError, IndexError, MemoryError) as error:
        raise MeasuredError(f"the file is damaged, or not what its name says: {' '.join(str(error).split())}") from None
    lengths = {len(values) for values, _ in found.values()}
    if len(found) < 2:
        raise MeasuredError("two columns of numbers or more were expected")
    if len(lengths) > 1:
        counts = ", ".join(f"`{name}` {len(values)}" for name, (values, _) in list(found.items())[:6])
        raise MeasuredError(f"its columns have different lengths: {counts}")
    if max(lengths) > MOST_ROWS:
        raise MeasuredError(f"{max(lengths)} rows; up to {MOST_ROWS} are read")
    return found


def _of_recording(content: bytes, file: str, column: str | None) -> dict[str, tuple[NDArray[np.float64], str]]:
    try:
        return recording_file.signal_columns(content, file, column)
    except ModelError:
        raise
    except ValueError as problem:
        raise MeasuredError(str(problem)) from None
    except Exception as problem:  # libraries of recordings raise errors of their own
        raise MeasuredError(
            f"the file is damaged, or not what its name says: {' '.join(str(problem).split())}"
        ) from None


def _mat(content: bytes) -> dict[str, tuple[NDArray[np.float64], str]]:
    """Vectors of real numbers; those that are called `time` or `t` come first."""
    from scipy.io import loadmat

    found = {}
    for name, value in loadmat(io.BytesIO(content)).items():
        if (
            not name.startswith("__")
            and isinstance(value, np.ndarray)
            and value.dtype.kind in "fiu"
            and value.size == max(value.shape)
        ):
            found[name] = (value.astype(np.float64).ravel(), "")
    first = [name for name in found if name.lower() in ("time", "t")]
    return {name: found[name] for name in (*first, *(name for name in found if name not in first))}


def _parquet(content: bytes) -> dict[str, tuple[NDArray[np.float64], str]]:
    parquet: Any = needed("pyarrow.parquet", "Parquet files need")
    file = parquet.ParquetFile(io.BytesIO(content))
    if file.metadata.num_rows > MOST_ROWS:
        raise ValueError(f"{file.metadata.num_rows} rows; up to {MOST_ROWS} are read")
    table, found = file.read(), {}
    for field, column in zip(table.schema, table.columns, strict=True):
        values = column.to_numpy()
        if values.dtype.kind == "M":  # instants: seconds from the first one
            values = (values - values[0]).astype("timedelta64[ns]").astype(np.float64) * 1e-9
        if values.dtype.kind not in "fiu":
            continue
        unit = next((field.metadata[key].decode() for key in UNIT_KEYS if key in (field.metadata or {})), "")
        found[field.name] = (values.astype(np.float64), unit)
    return found
