"""`nivel export RESULT --csv [FILE]`, a result as a table, and `nivel export MACHINE --c FOLDER`, a machine as a C library."""

from __future__ import annotations

from pathlib import Path

import click

from nivel.cli.options import file_argument, force_option, override_option

BESIDE = "\0"  # stands for `--csv` without a file


@click.command(short_help="Write a result as a table, or a machine as a C library.")
@file_argument("source")
@click.option(
    "--csv",
    "target",
    is_flag=False,
    flag_value=BESIDE,
    metavar="[FILE]",
    help="Write a table, one row per frame; default: NAME.csv in the working directory. '-' is standard output.",
)
@click.option(
    "--select",
    multiple=True,
    metavar="NAMES",
    help="Write only these columns, separated by commas: hinge.angle, crank.position, crank, '*.force'. May be repeated.",
)
@force_option
@click.option("--c", "folder", metavar="FOLDER", help="Write a C library of the machine SOURCE into a new folder.")
@override_option
def command(
    source: str, target: str | None, select: tuple[str, ...], force: bool, folder: str | None, overrides: dict[str, str]
) -> None:
    """Write a result as a table, or a machine as a C library.

    A table has enough digits to read the numbers back exactly. The run of a result may still be going on, or may have been killed.

    A C library simulates the machine with the fixed step of its simulation settings. `make` builds it and an example.
    """
    if folder is not None:
        if target is not None or select or force:
            raise click.UsageError("--c takes a machine; --csv, --select and --force belong to results")
        _write_c_library(source, folder, overrides)
        return
    if overrides:
        raise click.UsageError("--set changes a machine; it belongs to --c")
    _write_table(source, target, select, force)


def _write_c_library(machine: str, folder: str, overrides: dict[str, str]) -> None:
    from nivel.api import load

    written = load(machine, overrides).export_c(folder)
    sizes = f"{len(written.inputs)} inputs, {len(written.outputs)} outputs, {written.size / 1000:.0f} kB a machine"
    click.echo(
        f"C library: {written.folder}/{written.name}.h, {sizes}; `make -C {written.folder}` builds it",
        err=True,
    )


def _write_table(result: str, target: str | None, select: tuple[str, ...], force: bool) -> None:
    import sys

    from nivel.files.target import check_target
    from nivel.results import Result
    from nivel.results.frames.csv_table import columns, write_table

    if target is None:
        raise click.UsageError("say in which form: --csv [FILE] of a result, --c FOLDER of a machine")
    opened = Result.open(result)
    names = [name.strip() for entry in select for name in entry.split(",") if name.strip()]
    if target == "-":
        write_table(opened, columns(opened, names), sys.stdout)
        sys.stdout.flush()
        return
    path = Path(Path(result).with_suffix(".csv").name) if target == BESIDE else Path(target)
    check_target(path, "table", force=force, sources=[Path(result)])
    opened.export_csv(path, names)
    click.echo(f"table: {path}", err=True)
