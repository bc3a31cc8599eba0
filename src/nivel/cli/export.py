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
    help="Write only these columns, or outputs of a machine, separated by commas: hinge.angle, crank.position, crank, '*.force'; '*' is "
    "everything. May be repeated.",
)
@force_option
@click.option("--c", "folder", metavar="FOLDER", help="Write a C library of the machine SOURCE into a new folder.")
@override_option
def command(
    source: str, target: str | None, select: tuple[str, ...], force: bool, folder: str | None, overrides: dict[str, str]
) -> None:
    """Write a result as a table, or a machine as a C library.

    A table has enough digits to read the numbers back exactly. The run of a result may still be going on, or may have been killed.

    A C library simulates the machine with the fixed step of its simulation settings. `make` builds it and an example. Its outputs are
    sensors, joint coordinates with their rates, and inputs, or what --select names.
    """
    names = [name.strip() for entry in select for name in entry.split(",") if name.strip()]
    if folder is not None:
        if target is not None or force:
            raise click.UsageError("--c takes a machine; --csv and --force belong to results")
        _write_c_library(source, folder, names, overrides)
        return
    if overrides:
        raise click.UsageError("--set changes a machine; it belongs to --c")
    _write_table(source, target, names, force)


def _write_c_library(machine: str, folder: str, select: list[str], overrides: dict[str, str]) -> None:
    from nivel.api import load

    written = load(machine, overrides).export_c(folder, select=select)
    sizes = f"{len(written.inputs)} inputs, {len(written.outputs)} outputs, {written.size / 1000:.0f} kB a machine"
    click.echo(
        f"C library: {written.folder}/{written.name}.h, {sizes}; `make -C {written.folder}` builds it",
        err=True,
    )


def _write_table(result: str, target: str | None, names: list[str], force: bool) -> None:
    import sys

    from nivel.files.target import check_target
    from nivel.results import Result
    from nivel.results.frames.csv_table import columns, write_table

    if target is None:
        raise click.UsageError("say in which form: --csv [FILE] of a result, --c FOLDER of a machine")
    opened = Result.open(result)
    if target == "-":
        write_table(opened, columns(opened, names), sys.stdout)
        sys.stdout.flush()
        return
    path = Path(Path(result).with_suffix(".csv").name) if target == BESIDE else Path(target)
    check_target(path, "table", force=force, sources=[Path(result)])
    opened.export_csv(path, names)
    click.echo(f"table: {path}", err=True)
