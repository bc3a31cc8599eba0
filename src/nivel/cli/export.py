"""`nivel export RESULT --csv [FILE]`, a result as a table; `nivel export MACHINE --c FOLDER`, `--fmu [FILE]` and `--page [FILE]`, a machine
as a C library, as an FMU, or as a web page in which it lives."""

import sys
from pathlib import Path
from typing import Any

import click

from nivel.cli.options import file_argument, force_option, override_option, repeated
from nivel.known import Machine
from nivel.lazy import nivel

BESIDE = "\0"  # stands for `--csv` or `--fmu` without a file
# ends of the names of files that are not the word of their option
SUFFIXES = {"mdf": ".mf4", "gltf": ".glb", "page": ".html", "mjcf": ".xml"}


def file_option(name: str, text: str) -> Any:
    """An option with the name of a file, or without it."""
    return click.option(f"--{name}", name, is_flag=False, flag_value=BESIDE, metavar="[FILE]", help=f"Write {text}")


@click.command()
@file_argument("source")
@file_option("csv", "a table, one row per frame; default: NAME.csv in the working directory. '-' is standard output.")
@repeated(
    "--select",
    "select",
    "NAMES",
    "Write only these columns, or outputs of a machine, separated by commas: hinge.angle, crank.position, crank, '*.force'; '*' is "
    "everything.",
)
@force_option
@click.option("--c", "folder", metavar="FOLDER", help="Write a C library of the machine SOURCE into a new folder.")
@file_option("fmu", "an FMU of the machine SOURCE for co-simulation; default: NAME.fmu in the working directory.")
@file_option(
    "page",
    "a web page in which the machine SOURCE lives, to be operated without Python or a server; default: NAME.html in the working "
    "directory.",
)
@click.option("--fmi", type=click.Choice(["3", "2"]), help="Version of FMI; default 3.")
@repeated(
    "--parameter",
    "parameters",
    "PATH",
    "A number of the machine that can be set in the FMU or page, e.g. bodies.crank.mass.",
)
@click.option(
    "--platform",
    "platforms",
    multiple=True,
    type=click.Choice(["x86_64-linux", "x86_64-windows", "aarch64-linux"]),
    help="What the FMU or C library is for; default: this system. For FMUs it may be repeated.",
)
@file_option("mjcf", "the rigid part of the machine SOURCE for MuJoCo; default: NAME.xml in the working directory.")
@file_option(
    "urdf", "the tree of rigid bodies of the machine SOURCE as a URDF; default: NAME.urdf in the working directory."
)
@file_option("gltf", "the motion of a result as an animated glTF file; default: NAME.glb in the working directory.")
@file_option("mat", "a table for MATLAB; default: NAME.mat.")
@file_option("parquet", "a Parquet table with units; default: NAME.parquet in the working directory.")
@file_option("mdf", "an MDF4 file with units; default: NAME.mf4 in the working directory.")
@file_option("mcap", "an MCAP file, a message for each frame; default: NAME.mcap in the working directory.")
@override_option
def command(
    source: str,
    select: tuple[str, ...],
    force: bool,
    folder: str | None,
    fmi: str | None,
    parameters: tuple[str, ...],
    platforms: tuple[str, ...],
    overrides: dict[str, str],
    **files: str | None,
) -> None:
    """Write a result as a table or an animation, or a machine as a C library, an FMU or a model of another program.

    A table has enough digits to read the numbers back exactly. The run of a result may still be going on, or may have been killed.

    A C library simulates the machine with the fixed step of its simulation settings. `make` builds it and an example. Its outputs are
    sensors, joint coordinates with their rates, and inputs, or what --select names.

    An FMU does the same in other simulation programs, by FMI 3.0 or 2.0. A page is one file that any browser opens from disk: the machine
    is operated there as by `nivel live`.

    An MJCF or URDF file has the rigid part of the machine. The list of what was left out is printed and stands in its comments.
    """
    names = [name.strip() for entry in select for name in entry.split(",") if name.strip()]
    wanted = {form: given for form, given in {"c": folder, **files}.items() if given is not None}
    if len(wanted) > 1:
        raise click.UsageError(
            "one of --csv, --mat, --parquet, --mdf, --mcap, --gltf, --c, --fmu, --page, --mjcf and --urdf is written at a time"
        )
    form, given = wanted.popitem() if wanted else ("", "")
    if form != "fmu" and (fmi or (parameters and form != "page")):
        raise click.UsageError("--fmi belongs to --fmu, and --parameter to --fmu and --page")
    if platforms and (len(platforms) > 1 if form == "c" else form != "fmu"):
        raise click.UsageError("--platform belongs to --fmu, or once to --c")
    if form == "c" and force:
        raise click.UsageError("--c takes a machine and a new folder; --force belongs to --csv and --fmu")
    if form in ("page", "mjcf", "urdf", "gltf") and names:
        raise click.UsageError("--select belongs to --csv, --c and --fmu")
    if form not in ("c", "fmu", "page", "mjcf", "urdf") and overrides:
        raise click.UsageError("--set changes a machine; it belongs to --c, --fmu, --page, --mjcf and --urdf")
    if form == "c":
        _write_c_library(nivel.api.load(source, overrides), given, names, "".join(platforms))
        return
    path = Path(Path(source).with_suffix(SUFFIXES.get(form, f".{form}")).name) if given == BESIDE else Path(given)
    if form == "fmu":
        options = {"fmi": int(fmi or 3), "select": names, "parameters": parameters, "platforms": platforms}
        _write_fmu(nivel.api.load(source, overrides), path, options, force)
    elif form == "page":
        _write_page(nivel.api.load(source, overrides), path, parameters, force)
    elif form in ("mjcf", "urdf"):
        loaded = nivel.api.load(source, overrides)
        if notes := (loaded.export_urdf if form == "urdf" else loaded.export_mjcf)(path, force=force):
            click.echo("\n".join(notes))
        click.echo(f"{form.upper()}: {path}", err=True)
    elif form == "gltf":
        nivel.files.target.check_target(path, "glTF file", force=force, sources=[Path(source)])
        nivel.exchange.gltf_writer.write_gltf(nivel.results.Result.open(source), path)
        click.echo(f"glTF: {path}", err=True)
    elif form:
        _write_table(source, form, path, names, force)
    else:
        raise click.UsageError(
            "say in which form: --csv or --gltf [FILE] of a result; --c FOLDER, --fmu, --page, --mjcf or --urdf [FILE] "
            "of a machine"
        )


def _write_c_library(machine: Machine, folder: str, select: list[str], platform: str) -> None:
    written = machine.export_c(folder, select=select, platform=platform)
    sizes = f"{len(written.inputs)} inputs, {len(written.outputs)} outputs, {written.size / 1000:.0f} kB a machine"
    click.echo(f"C library: {written.folder}/{written.name}.h, {sizes}; `make -C {written.folder}` builds it", err=True)
    click.echo(
        "not verified: the library makes single runs; `nivel run` with the same step estimates their error", err=True
    )


def _write_fmu(machine: Machine, path: Path, options: dict[str, Any], force: bool) -> None:
    written = machine.export_fmu(path, force=force, **options)
    counts = f"{len(written.inputs)} inputs, {len(written.outputs)} outputs, {len(written.parameters)} parameters"
    size = written.path.stat().st_size / 1000
    systems = " and ".join(written.platforms)
    version = f"FMI {options['fmi']}.0 co-simulation"
    click.echo(f"FMU: {written.path}, {version} for {systems}, {counts}, {size:.0f} kB", err=True)


def _write_page(machine: Machine, path: Path, parameters: tuple[str, ...], force: bool) -> None:
    with nivel.cli.progress.progress_listener(False) as listener:
        written = nivel.live.page.export_page(machine, path, parameters=parameters, force=force, listener=listener)
    size = written.path.stat().st_size / 1000
    click.echo(
        f"page: {written.path}, {len(written.inputs)} inputs, {len(written.parameters)} parameters, {size:.0f} kB; any browser opens it",
        err=True,
    )
    click.echo("not verified: the errors of its steps were not examined; `nivel run` estimates them", err=True)


def _write_table(result: str, form: str, path: Path, names: list[str], force: bool) -> None:
    opened, table = nivel.results.Result.open(result), nivel.results.frames.csv_table
    if form == "csv" and str(path) == "-":
        table.write_table(opened, table.columns(opened, names), sys.stdout)
        sys.stdout.flush()
        return
    nivel.files.target.check_target(path, "table", force=force, sources=[Path(result)])
    table.WRITERS[form](opened, path, names)
    click.echo(f"table: {path}", err=True)
