"""`nivel inverse MACHINE`: the efforts of actuators that make a machine follow a motion; data, a page, a summary."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import click

from nivel.cli.options import (
    allow_code_option,
    assignments,
    file_argument,
    force_option,
    json_option,
    no_report_option,
    override_option,
    quiet_option,
    separated,
)
from nivel.cli.progress import progress_listener
from nivel.cli.run import beside, refuse_to_replace

_values = assignments("NAME=VALUE, e.g. hinge.angle='20 N m'")


@click.command(short_help="Efforts of actuators that make a machine follow a motion.")
@file_argument("machine")
@click.option(
    "--actuators",
    metavar="NAMES",
    multiple=True,
    callback=separated,
    help="Joint coordinates or motors; default: the motors, or the coordinates that the drivers prescribe.",
)
@click.option(
    "--motion",
    metavar="RESULT.nc",
    help="Result of a run or of kinematics; default: the motion that the drivers prescribe.",
)
@click.option("--trajectory", metavar="FILE.csv", help="Table of joint coordinates over time, instead of --motion.")
@click.option(
    "--limit",
    "limits",
    metavar="NAME=VALUE",
    multiple=True,
    callback=_values,
    help="Greatest effort of an actuator. May be repeated.",
)
@click.option(
    "--weight",
    "weights",
    metavar="NAME=NUMBER",
    multiple=True,
    callback=_values,
    help="Weight of an effort, if there are more actuators than needed. May be repeated.",
)
@click.option("--hold", metavar="DRIVERS", multiple=True, callback=separated, help="Drivers that remain active.")
@click.option(
    "--positions", metavar="NUMBER", help="Number of positions of the drivers' motion or of a trajectory; default 361."
)
@click.option(
    "--path",
    metavar="FILE.csv",
    help="Inverse kinematics: path of --point as a table time,x,y,z, optionally with Euler parameters e0,e1,e2,e3.",
)
@click.option("--point", metavar="MARKER", help="Marker or body that follows --path.")
@override_option
@allow_code_option
@click.option(
    "-o",
    "--out",
    metavar="FILE.nc",
    type=click.Path(),
    help="Result file; default: NAME-inverse.nc in the working directory.",
)
@force_option
@no_report_option
@quiet_option
@json_option
def command(
    machine: str,
    overrides: dict[str, str],
    allow_code: bool,
    out: str | None,
    force: bool,
    no_report: bool,
    quiet: bool,
    as_json: bool,
    path: str | None,
    point: str | None,
    **options: Any,
) -> None:
    """Find the efforts of actuators that make MACHINE follow a motion: that of its drivers, a recorded one, or joint trajectories.

    With --path and --point (inverse kinematics), find the joint coordinates for which a point follows a path. They are written to
    NAME-joints.csv, which --trajectory can read.

    Exit codes: 0 done, 2 fault in the input, 3 the motion cannot be reached, 130 interrupted.
    """
    from nivel.api import load

    loaded = load(machine, overrides, allow_code=allow_code)
    if path is not None or point is not None:
        _lead(loaded, path, point, options, Path(out or f"{loaded.name}-joints.csv"), force, quiet, as_json)
        return
    target = Path(out) if out is not None else Path(f"{loaded.name}-inverse.nc")
    report = None if no_report else beside(target)
    refuse_to_replace(report, target, force, Path(machine))
    with progress_listener(quiet) as listener:
        efforts = loaded.inverse(**options, listener=listener)
        efforts.save(target, force=force)
        if report is not None:
            efforts.report(report)
    if as_json:
        click.echo(json.dumps(efforts.summary(), indent=2))
    if not quiet:
        click.echo(str(efforts), err=True)
        click.echo(f"data: {target}" + (f"\nreport: {report}" if report is not None else ""), err=True)


def _lead(
    loaded: Any,
    path: str | None,
    point: str | None,
    options: dict[str, Any],
    target: Path,
    force: bool,
    quiet: bool,
    as_json: bool,
) -> None:
    """Inverse kinematics: write the table of joint coordinates."""
    from nivel.analysis.inverse.path_file import read_path
    from nivel.errors import Fault, ModelError
    from nivel.files.target import check_target

    if path is None or point is None:
        missing = "path" if path is None else "point"
        raise ModelError(Fault("", 0, 0, f"inverse.{missing}", "is missing: a path leads a point, so both are needed"))
    idle = [name for name, value in options.items() if value]
    if idle:
        raise ModelError(Fault("", 0, 0, f"inverse.{idle[0]}", "has no part in inverse kinematics: leave it out"))
    check_target(target, "table", force=force, sources=[Path(path)])
    times, places, orientations = read_path(path)
    with progress_listener(quiet) as listener:
        found = loaded.inverse_kinematics(point, places, times=times, orientations=orientations, listener=listener)
        found.save_csv(target)
    if as_json:
        click.echo(json.dumps(found.summary(), indent=2))
    if not quiet:
        click.echo(f"{found}\ntable: {target}", err=True)
