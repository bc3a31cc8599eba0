"""`nivel kinematics MACHINE`: positions, velocities, accelerations and reactions of a driven machine; a result file and a report."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from nivel.cli.ending import COLOURS, computed_in, console, ended, say_checks
from nivel.cli.options import (
    allow_code_option,
    file_argument,
    force_option,
    json_option,
    no_report_option,
    override_option,
    quiet_option,
)
from nivel.cli.progress import progress_listener
from nivel.cli.run import assembly_lines, beside, refuse_to_replace

if TYPE_CHECKING:
    from nivel.results.analyses.configuration_curve import ConfigurationCurve
    from nivel.results.analyses.mechanism import Range
    from nivel.results.result import Result


@click.command(short_help="Positions, velocities and reactions of a driven machine.")
@file_argument("machine")
@click.option("--drive", metavar="COORDINATE", help="Drive a joint coordinate at constant speed, e.g. hinge.angle.")
@click.option(
    "--from",
    "start",
    metavar="VALUE",
    help="First value of this coordinate, e.g. '10 deg'; default: its value in the assembled machine.",
)
@click.option("--to", "end", metavar="VALUE", help="Last value of this coordinate; default: one turn more.")
@click.option(
    "--range", "ranged", is_flag=True, help="Find how far the coordinate of --drive can move in both directions."
)
@click.option(
    "--through",
    is_flag=True,
    help="Follow all positions, also past turning points of the coordinate of --drive; writes NAME-way.nc.",
)
@click.option(
    "--duration", metavar="TIME", help="Duration of the motion; default: that of the machine, 1 s with --drive."
)
@click.option("--positions", metavar="NUMBER", help="Number of positions, both ends included; default 361.")
@click.option(
    "--transmission",
    metavar="JOINTS",
    multiple=True,
    help="Transmission angle at the second of three joints, e.g. pin,rocker_pin,pivot. May be repeated.",
)
@click.option(
    "--curve",
    metavar="POINT",
    multiple=True,
    help="Path of a marker, or of a point BODY:X,Y,Z in the frame of its body. May be repeated.",
)
@click.option("--coordinates", metavar="NAME", help="Coordinates of the equations: auto, absolute, relative.")
@override_option
@allow_code_option
@click.option(
    "-o",
    "--out",
    metavar="FILE.nc",
    type=click.Path(),
    help="Result file; default: NAME-kinematics.nc in the working directory.",
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
    ranged: bool,
    through: bool,
    transmission: tuple[str, ...],
    curve: tuple[str, ...],
    **options: Any,
) -> None:
    """Move MACHINE by its drivers, or by driving one joint coordinate, without integration over time.

    If the machine cannot move any further, the message names the driver and the joints that hold it.

    Exit codes: 0 done, 2 fault in the input, 3 the machine cannot move any further, 130 interrupted. The positions up to there are kept.
    """
    from nivel.api import load
    from nivel.errors import ModelError, SolveError
    from nivel.results.analyses.mechanism import add_studies, read_curve, read_transmission

    loaded = load(machine, overrides, allow_code=allow_code)
    angles = [read_transmission(loaded.record, each) for each in transmission]
    points = [read_curve(loaded.record, each) for each in curve]
    if ranged:
        _tell_range(loaded, options, quiet, as_json)
        return
    if through:
        _tell_way(loaded, options, Path(out or f"{loaded.name}-way.nc"), force, quiet, as_json)
        return
    target = Path(out) if out is not None else Path(f"{loaded.name}-kinematics.nc")
    report = None if no_report else beside(target)
    refuse_to_replace(report, target, force, Path(machine))
    failure: SolveError | None = None
    with progress_listener(quiet) as listener:
        try:
            result = loaded.kinematics(**options, out=target, force=force, listener=listener)
        except SolveError as error:
            failure = error
            result: Any = error.result
        studies = add_studies(result, angles, points) if result is not None else None
        if report is not None and result is not None:
            listener.say("writing the report")
            try:
                result.report(report)
                if studies is not None:
                    studies.report(report.with_name(f"{report.stem}-curves.html"))
            except ModelError:
                if failure is None:
                    raise
    if as_json and result is not None:
        summary = result.summary()
        click.echo(json.dumps({**summary, "studies": studies.summary()} if studies is not None else summary, indent=2))
    if not quiet and result is not None:
        _say(result, target, report)
        for line in studies.lines() if studies is not None else ():
            click.echo(line, err=True)
    if failure is not None:
        raise failure
    if result is not None and result.outcome == "interrupted":
        raise KeyboardInterrupt


def _tell_range(loaded: Any, options: dict[str, Any], quiet: bool, as_json: bool) -> None:
    """Both ends of the way of a coordinate."""
    _alone(options, ("start", "end", "duration"), "--range")
    with progress_listener(quiet) as listener:
        found: Range = loaded.range_of_motion(
            options["drive"], coordinates=options["coordinates"], positions=options["positions"], listener=listener
        )
    if as_json:
        click.echo(json.dumps(found.summary(), indent=2))
    if not quiet:
        click.echo(str(found), err=True)


def _tell_way(loaded: Any, options: dict[str, Any], target: Path, force: bool, quiet: bool, as_json: bool) -> None:
    """All positions, and where the coordinate turns back."""
    from nivel.files.target import check_target

    _alone(options, ("start", "end", "duration", "positions", "coordinates"), "--through")
    check_target(target, "table", force=force, sources=[])
    with progress_listener(quiet) as listener:
        found: ConfigurationCurve = loaded.configuration_curve(options["drive"], listener=listener)
        found.save(target, force=force)
    if as_json:
        click.echo(json.dumps(found.summary(), indent=2))
    if not quiet:
        click.echo(f"{found}\ndata: {target}", err=True)


def _alone(options: dict[str, Any], others: tuple[str, ...], option: str) -> None:
    """Raises ModelError where a coordinate is missing, or other options say how it moves."""
    from nivel.errors import Fault, ModelError

    if options["drive"] is None:
        raise ModelError(Fault("", 0, 0, "kinematics.drive", f"{option} needs a coordinate: name it with --drive"))
    given = [name for name in others if options[name] is not None]
    if given:
        raise ModelError(
            Fault("", 0, 0, f"kinematics.{given[0]}", f"has no part in {option}, which finds the way itself")
        )


def _say(result: Result, target: Path, report: Path | None) -> None:
    out = console()
    time, timing = result.time, result.timing
    out.print(f"{ended(result)}, {len(time)} positions {computed_in(timing.get('loop_seconds', 0.0))}")
    for line in assembly_lines(result):
        out.print(line)
    out.print(f"trust: [{COLOURS[result.trust.verdict]}]{result.trust.verdict}[/]")
    say_checks(out, result.trust)
    out.print(f"result: {target}" + (f"\nreport: {report}" if report is not None else ""), soft_wrap=True)
