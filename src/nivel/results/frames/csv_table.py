"""A result as a table of text: one row per frame, one column per number."""

from __future__ import annotations

import csv
import os
from collections.abc import Iterable, Iterator
from fnmatch import fnmatchcase
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.files.target import keep_sources, written
from nivel.results.frames.names import unknown_name

if TYPE_CHECKING:
    from nivel.results.result import Result

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
    if faults:
        raise ModelError(faults)
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
