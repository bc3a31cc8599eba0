"""Options and tables of the commands that search: `nivel optimise` and `nivel identify`."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

out_option = click.option(
    "-o",
    "--out",
    metavar="FILE.nc",
    type=click.Path(dir_okay=False, path_type=Path),
    help="Data file; default: NAME.nc in the working directory.",
)
threads_option = click.option(
    "--threads",
    type=click.IntRange(1),
    metavar="NUMBER",
    help="Runs beside each other; default: one for each processor.",
)


def target_of(study: Any, out: Path | None, force: bool, source: str) -> Path:
    """The data file. Raises ModelError where it exists and is not to be replaced."""
    from nivel.files.target import check_target

    target = out or Path(f"{study.file.record.name}.nc")
    check_target(target, "data file", force=force, sources=[Path(source), Path(study.file.machine_file)])
    return target


def numbers_table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print a table on standard output."""
    from rich.console import Console
    from rich.table import Table

    table = Table(*heads)
    for row in rows:
        table.add_row(*row)
    Console().print(table)
