"""`nivel export RESULT --csv [FILE]`: a result as a table for other programs."""

from __future__ import annotations

import os
from pathlib import Path

import click

from nivel.cli.options import file_argument

BESIDE = "\0"  # stands for `--csv` without a file


@click.command(short_help="Write a result in another format.")
@file_argument("result")
@click.option(
    "--csv",
    "target",
    is_flag=False,
    flag_value=BESIDE,
    metavar="[FILE]",
    help="Write a table, one row per frame; default: the result's name with .csv, here. '-' is standard output.",
)
@click.option(
    "--select",
    multiple=True,
    metavar="NAMES",
    help="Only these columns, separated by commas: hinge.angle, crank.position, crank, '*.force'. May be repeated.",
)
@click.option("--force", is_flag=True, help="Replace an existing file.")
def command(result: str, target: str | None, select: tuple[str, ...], force: bool) -> None:
    """Write RESULT in another format.

    RESULT may be of a run that still goes on or was killed. Numbers are written so that they are read back exactly.
    """
    import sys

    from nivel.results import Result
    from nivel.results.csv_table import columns, write_table
    from nivel.results.target import check_target

    if target is None:
        raise click.UsageError("say in which format: --csv [FILE]")
    opened = Result.open(result)
    names = [name.strip() for entry in select for name in entry.split(",") if name.strip()]
    if target == "-":
        try:
            write_table(opened, columns(opened, names), sys.stdout)
            sys.stdout.flush()
        except BrokenPipeError:  # the reader, `head` for instance, has enough: no failure
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what Python still flushes at its end
        return
    path = Path(Path(result).with_suffix(".csv").name) if target == BESIDE else Path(target)
    check_target(path, "table", force=force, sources=[Path(result)])
    opened.export_csv(path, names)
    click.echo(f"table: {path}", err=True)
