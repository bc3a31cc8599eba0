"""A result as a table for other programs: MATLAB's MAT file, Parquet and MDF4 with units, or MCAP."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from nivel.extras import needed
from nivel.files.target import written
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
    with written(path, "table") as draft, draft.open("wb") as file:
        savemat(file, {**table, "names": names, "units": units}, oned_as="column", long_field_names=True)


def write_parquet(result: Result, path: Path, select: Iterable[str] = ()) -> None:
    """Write `time` and a column of each name, with its unit in the metadata of its field. Raises ModelError."""
    parquet = needed("pyarrow.parquet", "Parquet files need")
    import pyarrow as arrow  # pyright: ignore[reportMissingImports]

    chosen = columns(result, select)
    fields = [arrow.field(name, arrow.float64(), metadata={"unit": result.units(name)}) for name in chosen]
    schema = arrow.schema([arrow.field("time", arrow.float64(), metadata={"unit": "s"}), *fields])
    arrays = [arrow.array(np.asarray(values)) for values in (result.time, *(result.array(name) for name in chosen))]
    with written(path, "table") as draft:
        parquet.write_table(arrow.Table.from_arrays(arrays, schema=schema), draft, compression="zstd")


def write_mdf(result: Result, path: Path, select: Iterable[str] = ()) -> None:
    """Write an MDF 4.10 file with a channel of each name, with its unit, over the time. Raises ModelError."""
    asammdf: Any = needed("asammdf", "MDF files need")
    time = np.asarray(result.time)
    signals = [
        asammdf.Signal(np.asarray(result.array(name)), time, name=name, unit=result.units(name))
        for name in columns(result, select)
    ]
    with written(path, "table") as draft, asammdf.MDF(version="4.10") as table, draft.open("w+b") as file:
        table.append(signals, comment=f"result of nivel: {result.name}")
        table.save(file, overwrite=True)


def write_mcap(result: Result, path: Path, select: Iterable[str] = ()) -> None:
    """Write an MCAP file with a message in JSON for each frame on the topic `/nivel`, whose fields are the names. Raises ModelError."""
    writer: Any = needed("mcap.writer", "MCAP files need")
    chosen = columns(result, select)
    fields = {name: {"type": "number", "description": result.units(name)} for name in chosen}
    schema = {"type": "object", "title": result.name, "properties": fields}
    arrays = [np.asarray(result.array(name)).tolist() for name in chosen]
    with written(path, "table") as draft, draft.open("wb") as file:
        out = writer.Writer(file)
        out.start()
        number = out.register_schema("nivel", "jsonschema", json.dumps(schema).encode())
        channel = out.register_channel("/nivel", "json", number)
        for k, time in enumerate(result.time):
            content = json.dumps(dict(zip(chosen, (each[k] for each in arrays), strict=True))).encode()
            instant = round(float(time) * 1e9)
            out.add_message(channel, log_time=instant, data=content, publish_time=instant)
        out.finish()
