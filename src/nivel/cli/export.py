"""`nivel export RESULT --csv [FILE]`, a result as a table; `nivel export MACHINE --c FOLDER`, `--fmu [FILE]` and `--page [FILE]`, a machine
as a C library, as an FMU, or as a web page in which it lives."""

from __future__ import annotations

from pathlib import Path

import click

from nivel.cli.options import file_argument, force_option, override_option
from nivel.lazy import nivel

BESIDE = "\0"  # stands for `--csv` or `--fmu` without a file


@click.command(short_help="Write a result as a table, or a machine as a C library or FMU.")
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
@click.option(
    "--fmu",
    "unit",
    is_flag=False,
    flag_value=BESIDE,
    metavar="[FILE]",
    help="Write an FMU of the machine SOURCE for co-simulation; default: NAME.fmu in the working directory.",
)
@click.option(
    "--page",
    "page",
    is_flag=False,
    flag_value=BESIDE,
    metavar="[FILE]",
    help="Write a web page in which the machine SOURCE lives, to be operated without Python or a server; default: NAME.html in the working "
    "directory.",
)
@click.option("--fmi", type=click.Choice(["3", "2"]), help="Version of FMI; default 3.")
@click.option(
    "--parameter",
    "parameters",
    multiple=True,
    metavar="PATH",
    help="A number of the machine that can be set in the FMU, e.g. bodies.crank.mass. May be repeated.",
)
@click.option(
    "--platform",
    "platforms",
    multiple=True,
    type=click.Choice(["x86_64-linux", "x86_64-windows", "aarch64-linux"]),
    help="What the FMU or C library is for; default: this system. For FMUs it may be repeated.",
)
@click.option(
    "--mjcf",
    "mjcf",
    is_flag=False,
    flag_value=BESIDE,
    metavar="[FILE]",
    help="Write the rigid part of the machine SOURCE for MuJoCo; default: NAME.xml in the working directory.",
)
@click.option(
    "--urdf",
    "urdf",
    is_flag=False,
    flag_value=BESIDE,
    metavar="[FILE]",
    help="Write the tree of rigid bodies of the machine SOURCE as a URDF; default: NAME.urdf in the working directory.",
)
@click.option(
    "--gltf",
    "film",
    is_flag=False,
    flag_value=BESIDE,
    metavar="[FILE]",
    help="Write the motion of a result as an animated glTF file; default: NAME.glb in the working directory.",
)
@click.option(
    "--mat",
    "mat",
    is_flag=False,
    flag_value=BESIDE,
    metavar="[FILE]",
    help="Write a table for MATLAB; default: NAME.mat.",
)
@click.option(
    "--parquet",
    "parquet",
    is_flag=False,
    flag_value=BESIDE,
    metavar="[FILE]",
    help="Write a Parquet table with units; default: NAME.parquet in the working directory.",
)
@click.option(
    "--mdf",
    "mdf",
    is_flag=False,
    flag_value=BESIDE,
    metavar="[FILE]",
    help="Write an MDF4 file with units; default: NAME.mf4 in the working directory.",
)
@click.option(
    "--mcap",
    "mcap",
    is_flag=False,
    flag_value=BESIDE,
    metavar="[FILE]",
    help="Write an MCAP file, a message for each frame; default: NAME.mcap in the working directory.",
)
@override_option
def command(
    source: str,
    target: str | None,
    select: tuple[str, ...],
    force: bool,
    folder: str | None,
    unit: str | None,
    page: str | None,
    fmi: str | None,
    parameters: tuple[str, ...],
    platforms: tuple[str, ...],
    mjcf: str | None,
    urdf: str | None,
    film: str | None,
    mat: str | None,
    parquet: str | None,
    mdf: str | None,
    mcap: str | None,
    overrides: dict[str, str],
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
    tables = {".mat": mat, ".parquet": parquet, ".mf4": mdf, ".mcap": mcap}
    if sum(each is not None for each in (target, folder, unit, page, mjcf, urdf, film, *tables.values())) > 1:
        raise click.UsageError(
            "one of --csv, --mat, --parquet, --mdf, --mcap, --gltf, --c, --fmu, --page, --mjcf and --urdf is written at a time"
        )
    if unit is None and (fmi or parameters):
        raise click.UsageError("--fmi and --parameter belong to --fmu")
    if platforms and (len(platforms) > 1 if folder is not None else unit is None):
        raise click.UsageError("--platform belongs to --fmu, or once to --c")
    if folder is not None:
        if force:
            raise click.UsageError("--c takes a machine and a new folder; --force belongs to --csv and --fmu")
        _write_c_library(source, folder, names, "".join(platforms), overrides)
    elif unit is not None:
        _write_fmu(source, unit, names, int(fmi or 3), parameters, platforms, force, overrides)
    elif page is not None:
        if names:
            raise click.UsageError("--select belongs to --csv, --c and --fmu")
        _write_page(source, page, force, overrides)
    elif mjcf is not None or urdf is not None:
        if names:
            raise click.UsageError("--select belongs to --csv, --c and --fmu")
        _write_model(source, mjcf, urdf, force, overrides)
    elif overrides:
        raise click.UsageError("--set changes a machine; it belongs to --c, --fmu, --page, --mjcf and --urdf")
    elif film is not None:
        if names:
            raise click.UsageError("--select belongs to --csv, --c and --fmu")
        _write_film(source, film, force)
    elif any(each is not None for each in tables.values()):
        _write_binary(source, tables, names, force)
    else:
        _write_table(source, target, names, force)


def _write_c_library(machine: str, folder: str, select: list[str], platform: str, overrides: dict[str, str]) -> None:
    written = nivel.api.load(machine, overrides).export_c(folder, select=select, platform=platform)
    sizes = f"{len(written.inputs)} inputs, {len(written.outputs)} outputs, {written.size / 1000:.0f} kB a machine"
    click.echo(
        f"C library: {written.folder}/{written.name}.h, {sizes}; `make -C {written.folder}` builds it",
        err=True,
    )
    click.echo(
        "not verified: the library makes single runs; `nivel run` with the same step estimates their error", err=True
    )


def _write_fmu(
    machine: str,
    unit: str,
    select: list[str],
    fmi: int,
    parameters: tuple[str, ...],
    platforms: tuple[str, ...],
    force: bool,
    overrides: dict[str, str],
) -> None:
    path = Path(Path(machine).with_suffix(".fmu").name) if unit == BESIDE else Path(unit)
    loaded = nivel.api.load(machine, overrides)
    written = loaded.export_fmu(path, fmi=fmi, select=select, parameters=parameters, platforms=platforms, force=force)
    counts = f"{len(written.inputs)} inputs, {len(written.outputs)} outputs, {len(written.parameters)} parameters"
    size = written.path.stat().st_size / 1000
    systems = " and ".join(written.platforms)
    click.echo(f"FMU: {written.path}, FMI {fmi}.0 co-simulation for {systems}, {counts}, {size:.0f} kB", err=True)


def _write_page(machine: str, page: str, force: bool, overrides: dict[str, str]) -> None:
    path = Path(Path(machine).with_suffix(".html").name) if page == BESIDE else Path(page)
    loaded = nivel.api.load(machine, overrides)
    with nivel.cli.progress.progress_listener(False) as listener:
        written = nivel.live.opening.export_page(loaded, path, force=force, listener=listener)
    size = written.path.stat().st_size / 1000
    click.echo(f"page: {written.path}, {len(written.inputs)} inputs, {size:.0f} kB; any browser opens it", err=True)
    click.echo("not verified: the errors of its steps were not examined; `nivel run` estimates them", err=True)


def _write_model(machine: str, mjcf: str | None, urdf: str | None, force: bool, overrides: dict[str, str]) -> None:
    given, suffix = (mjcf, ".xml") if mjcf is not None else (urdf or BESIDE, ".urdf")
    path = Path(Path(machine).with_suffix(suffix).name) if given == BESIDE else Path(given)
    loaded = nivel.api.load(machine, overrides)
    notes = (loaded.export_urdf if mjcf is None else loaded.export_mjcf)(path, force=force)
    if notes:
        click.echo("\n".join(notes))
    click.echo(f"{'URDF' if mjcf is None else 'MJCF'}: {path}", err=True)


def _write_film(result: str, film: str, force: bool) -> None:
    path = Path(Path(result).with_suffix(".glb").name) if film == BESIDE else Path(film)
    nivel.files.target.check_target(path, "glTF file", force=force, sources=[Path(result)])
    nivel.exchange.gltf_writer.write_gltf(nivel.results.Result.open(result), path)
    click.echo(f"glTF: {path}", err=True)


def _write_binary(result: str, tables: dict[str, str | None], names: list[str], force: bool) -> None:
    given, suffix = next((given, suffix) for suffix, given in tables.items() if given is not None)
    path = Path(Path(result).with_suffix(suffix).name) if given == BESIDE else Path(given)
    opened = nivel.results.Result.open(result)
    nivel.files.target.check_target(path, "table", force=force, sources=[Path(result)])
    writers = {
        ".mat": nivel.results.frames.csv_table.write_mat,
        ".parquet": nivel.results.frames.csv_table.write_parquet,
        ".mf4": nivel.results.frames.csv_table.write_mdf,
        ".mcap": nivel.results.frames.csv_table.write_mcap,
    }
    writers[suffix](opened, path, names)
    click.echo(f"table: {path}", err=True)


def _write_table(result: str, target: str | None, names: list[str], force: bool) -> None:
    import sys

    if target is None:
        raise click.UsageError(
            "say in which form: --csv or --gltf [FILE] of a result; --c FOLDER, --fmu, --page, --mjcf or --urdf [FILE] "
            "of a machine"
        )
    opened = nivel.results.Result.open(result)
    if target == "-":
        nivel.results.frames.csv_table.write_table(
            opened, nivel.results.frames.csv_table.columns(opened, names), sys.stdout
        )
        sys.stdout.flush()
        return
    path = Path(Path(result).with_suffix(".csv").name) if target == BESIDE else Path(target)
    nivel.files.target.check_target(path, "table", force=force, sources=[Path(result)])
    opened.export_csv(path, names)
    click.echo(f"table: {path}", err=True)
