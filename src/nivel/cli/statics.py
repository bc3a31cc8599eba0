"""`nivel statics MACHINE`: where a machine rests under its loads; a result file, a report beside it, a summary."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

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
    from nivel.results.result import Result

SHOWN: Final = 12  # vibrations, and joint coordinates, in the terminal


@click.command(short_help="Find the static equilibrium of a machine under its loads.")
@file_argument("machine")
@click.option("--duration", metavar="TIME", help="Last time of the loads and drivers, e.g. 1; 0: only t = 0.")
@click.option("--step", metavar="TIME", help="Time between two states; default: a twentieth of the duration.")
@click.option("--arc-length", is_flag=True, help="Follow the path through limit points, where time turns back.")
@click.option(
    "--tolerance",
    metavar="NUMBER",
    help="Largest last correction of Newton's method, in lengths of the machine and in radians; default 1e-10.",
)
@click.option("--most-iterations", metavar="NUMBER", help="Limit of Newton iterations for a state; default 25.")
@click.option("--no-line-search", is_flag=True, help="Use only full Newton steps.")
@click.option("--modes", metavar="NUMBER", help="Number of natural frequencies and modes about every state.")
@click.option(
    "--buckling", metavar="NUMBER", help="Number of linearised buckling loads, from the first and the last state."
)
@click.option("--coordinates", metavar="NAME", help="Coordinates of the equations: auto, absolute, relative.")
@override_option
@allow_code_option
@click.option(
    "-o",
    "--out",
    metavar="FILE.nc",
    type=click.Path(),
    help="Result file; default: NAME-statics.nc in the working directory.",
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
    no_line_search: bool,
    **options: Any,
) -> None:
    """Find the static equilibrium of MACHINE, and follow it while time changes its loads and drivers.

    Velocities are zero, so dampers and the speeds of drivers have no effect.

    Exit codes: 0 done, 2 fault in the input, 3 no equilibrium found, 130 interrupted. The states found so far are always kept.
    """
    from nivel.api import load
    from nivel.errors import ModelError, SolveError

    loaded = load(machine, overrides, allow_code=allow_code)
    target = Path(out) if out is not None else Path(f"{loaded.name}-statics.nc")
    report = None if no_report else beside(target)
    refuse_to_replace(report, target, force, Path(machine))
    failure: SolveError | None = None
    with progress_listener(quiet) as listener:
        try:
            result = loaded.statics(
                **options, line_search=not no_line_search, out=target, force=force, listener=listener
            )
        except SolveError as error:
            failure = error
            result: Any = error.result
        if report is not None and result is not None:
            listener.say("writing the report")
            try:
                result.report(report)
            except ModelError:
                if failure is None:
                    raise
    if as_json and result is not None:
        click.echo(json.dumps(result.summary(), indent=2))
    if not quiet and result is not None:
        _say(result, target, report)
    if failure is not None:
        raise failure
    if result is not None and result.outcome == "interrupted":
        raise KeyboardInterrupt


def _say(result: Result, target: Path, report: Path | None) -> None:
    out = console()
    time, timing = result.time, result.timing
    states = f"{len(time)} state{'s' * (len(time) != 1)}"
    count = timing.get("iterations", 0)
    iterations = f"{count} iteration{'s' * (count != 1)}"
    out.print(f"{ended(result)}, {states}, {iterations} {computed_in(timing.get('loop_seconds', 0.0))}")
    for line in rest_lines(result):
        out.print(line, markup=False)
    for line in assembly_lines(result):
        out.print(line)
    for line in vibration_lines(result):
        out.print(line, markup=False)
    for each in json.loads(str(result.attributes.get("buckling", "[]"))):
        out.print(f"buckling: at t = {each['time']:.6g} s by extrapolation; most moves: {each['moves']}", markup=False)
    out.print(f"trust: [{COLOURS[result.trust.verdict]}]{result.trust.verdict}[/]")
    say_checks(out, result.trust)
    out.print(f"result: {target}" + (f"\nreport: {report}" if report is not None else ""), soft_wrap=True)


def rest_lines(result: Result) -> list[str]:
    """The joint coordinates of the last state, a line each."""
    from math import degrees

    if "joint_coordinate" not in result.variables or not len(result.time):
        return []
    names = result.coordinates[result.variables["joint_coordinate"].dims[1]]
    lines = []
    for name, value in zip(names, result.array("joint_coordinate")[-1], strict=True):
        unit = result.units(name)
        angle = f" ({degrees(value):.4g} deg)" if unit == "rad" else ""
        lines.append(f"rests at {name} = {value:.6g} {unit}{angle}")
    return lines if len(lines) <= SHOWN else [*lines[:SHOWN], f"and {len(lines) - SHOWN} more in the result"]


def vibration_lines(result: Result) -> list[str]:
    """The vibrations about the last state, a line each."""
    from math import isnan, sqrt

    if "vibration_stiffness" not in result.variables or not len(result.time):
        return []
    last = slice(len(result.time) - 1, None)
    squares = result.array("vibration_stiffness", last)[0]
    known = [float(value) for value in squares if not isnan(value)]
    lines, about = [], f" at t = {result.time[-1]:.6g} s" if len(result.time) > 1 else ""
    for k, value in enumerate(known[:SHOWN]):
        if value > 0.0:
            said = f"{sqrt(value) / 6.283185307179586:.6g} Hz"
        else:
            said = f"unstable, grows as exp({sqrt(-value):.4g} t/s)" if value < 0.0 else "a rigid motion, 0 Hz"
        lines.append(f"vibration {k + 1}: {said}{about}")
    if len(known) > SHOWN:
        lines.append(f"and {len(known) - SHOWN} more in the result")
    return lines
