"""A result as a table of text: one row per frame, one column per number."""

import csv
import json
import os
import re
from collections.abc import Iterable, Iterator
from fnmatch import fnmatchcase
from itertools import product
from pathlib import Path
from typing import Any, TextIO

import numpy as np

from nivel.errors import Fault, refuse
from nivel.extras import needed
from nivel.files.target import keep_sources, written
from nivel.known import Result
from nivel.lazy import pyarrow, scipy
from nivel.results.frames.contents import unknown_name

BLOCK = 4096  # frames turned into text at once


def write_csv(result: Result, path: str | os.PathLike[str], select: Iterable[str] = ()) -> Path:
    """Write the table to `path`; an existing file is replaced, but not that of the result. See `columns` for `select`."""
    target = Path(path)
    keep_sources(target, "table", [result.path] if result.path else [])
    chosen = columns(result, select)
    with written(target, "table") as draft, draft.open("w", encoding="utf-8", newline="") as file:
        write_table(result, chosen, file)
    return target


def columns(result: Result, select: Iterable[str] = ()) -> list[str]:
    """Names of the scalar columns that `select` asks for, without the time; all of them for an empty `select`.

    Each entry is a name (`position`, `crank.position`, `crank.position.x`), an element (`crank`: everything of it) or a
    pattern (`*.angle`). Columns come in the order asked for, each once; unknown names are reported together.
    """
    scalars = list(_scalars(result))
    wanted: dict[str, None] = {}
    faults: list[Fault] = []
    for entry in select:
        only = result.selection(entry).variable if entry in result else None
        found = [name for name, variable in scalars if _matches(entry, name) and only in (None, variable)]
        if entry in result.variables:
            found = [name for name, variable in scalars if variable == entry]
        if not found:
            known = {name: result.selection(name) for name in result.names}
            faults.extend(unknown_name(entry, known).faults)
        wanted.update(dict.fromkeys(found))
    refuse(faults)
    return list(wanted) if wanted else [name for name, _ in scalars]


def write_table(result: Result, chosen: list[str], file: TextIO) -> None:
    """The header (`crank.position.x [m]`) and a line per frame; numbers as short as they can be read back exactly."""
    table = csv.writer(file, lineterminator="\n")
    table.writerow(["time [s]", *(_harmless(f"{name} [{result.units(name)}]") for name in chosen)])
    needed = list(dict.fromkeys(result.selection(name).variable for name in chosen))
    places = [(result.selection(name).variable, result.selection(name).where[1:]) for name in chosen]
    for start in range(0, len(result.time), BLOCK):
        frames = slice(start, start + BLOCK)
        block = {name: result.array(name, frames) for name in needed}
        picked = [result.time[frames], *(block[name][:, *where] for name, where in places)]
        table.writerows(np.column_stack(picked).tolist())


def _harmless(text: str) -> str:
    """A text that no spreadsheet takes for a formula, whatever the file of the result calls its variables."""
    return f"'{text}" if text.startswith(("=", "+", "-", "@")) else text


def _scalars(result: Result) -> Iterator[tuple[str, str]]:
    """Every single number of a frame as (name, variable), in the order of the variables."""
    by_place = {}
    for name in result.names:
        found = result.selection(name)
        by_place.setdefault((found.variable, found.where[1:]), name)
    for variable in result.variables.values():
        sides = [range(len(result.coordinates[dim])) for dim in variable.dims[1:]]
        for place in product(*sides):
            yield by_place[variable.name, place], variable.name


def _matches(entry: str, name: str) -> bool:
    return name == entry or name.startswith(f"{entry}.") or fnmatchcase(name, entry)


def write_mat(result: Result, path: Path, select: Iterable[str] = ()) -> None:
    """Write `time` and a vector for each column; names have `_` for what MATLAB does not take, `names` has the original ones.

    Raises ModelError.
    """
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
        scipy.io.savemat(file, {**table, "names": names, "units": units}, oned_as="column", long_field_names=True)


def write_parquet(result: Result, path: Path, select: Iterable[str] = ()) -> None:
    """Write `time` and a column of each name, with its unit in the metadata of its field. Raises ModelError."""
    parquet = needed("pyarrow.parquet", "Parquet files need")
    chosen = columns(result, select)
    fields = [pyarrow.field(name, pyarrow.float64(), metadata={"unit": result.units(name)}) for name in chosen]
    schema = pyarrow.schema([pyarrow.field("time", pyarrow.float64(), metadata={"unit": "s"}), *fields])
    arrays = [pyarrow.array(np.asarray(values)) for values in (result.time, *(result.array(name) for name in chosen))]
    with written(path, "table") as draft:
        parquet.write_table(pyarrow.Table.from_arrays(arrays, schema=schema), draft, compression="zstd")


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


# by the option of `nivel export`
WRITERS = {"csv": write_csv, "mat": write_mat, "parquet": write_parquet, "mdf": write_mdf, "mcap": write_mcap}
