"""`nivel kinematics`, `nivel statics` and `nivel inverse`: a machine that is moved, at rest, or made to follow a motion; data, a page, a
summary."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

import click

from nivel.cli.analysis_command import Order, analysis_command
from nivel.cli.options import repeated
from nivel.cli.progress import computed_in, console, ended, progress_listener, say_trust_and_files
from nivel.cli.run import assembly_lines
from nivel.errors import Fault, ModelError
from nivel.known import Machine, Result, Studies
from nivel.lazy import Struct, nivel
from nivel.settings import InverseSettingsDict, KinematicsSettingsDict, StaticsSettingsDict

SHOWN: Final = 12  # vibrations, and joint coordinates, in the terminal


@analysis_command(StaticsSettingsDict, "NAME-statics.nc")
def statics(order: Order) -> None:
    """Find the static equilibrium of MACHINE, and follow it while time changes its loads and drivers.

    Velocities are zero, so dampers and the speeds of drivers have no effect.

    Exit codes: 0 done, 2 fault in the input, 3 no equilibrium found, 130 interrupted. The states found so far are always kept.
    """
    machine = order.load()
    order.run(f"{machine.name}-statics.nc", machine.statics, _say_statics)


def _say_statics(result: Result, target: Path, report: Path | None) -> None:
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
    say_trust_and_files(out, result.trust, target, report)


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


@analysis_command(InverseSettingsDict, "NAME-inverse.nc")
@click.option(
    "--path",
    metavar="FILE.csv",
    help="Inverse kinematics: path of --point as a table time,x,y,z, optionally with Euler parameters e0,e1,e2,e3.",
)
@click.option("--point", metavar="MARKER", help="Marker or body that follows --path.")
def inverse(order: Order, path: str | None, point: str | None) -> None:
    """Find the efforts of actuators that make MACHINE follow a motion: that of its drivers, a recorded one, or joint trajectories.

    With --path and --point (inverse kinematics), find the joint coordinates for which a point follows a path. They are written to
    NAME-joints.csv, which --trajectory can read.

    Exit codes: 0 done, 2 fault in the input, 3 the motion cannot be reached, 130 interrupted.
    """
    if path is not None or point is not None:
        _lead(order, path, point)
        return
    machine = order.load()
    name = f"{machine.name}-inverse.nc"
    order.keep(name, lambda listener: machine.inverse(**order.settings, listener=listener), lambda found: [str(found)])


def _lead(order: Order, path: str | None, point: str | None) -> None:
    """Inverse kinematics: write the table of joint coordinates."""
    machine = order.load()
    if path is None or point is None:
        missing = "path" if path is None else "point"
        raise ModelError(Fault.at(f"inverse.{missing}", "is missing: a path leads a point, so both are needed"))
    for name in order.settings:
        raise ModelError(Fault.at(f"inverse.{name}", "has no part in inverse kinematics: leave it out"))
    target = Path(order.out or f"{machine.name}-joints.csv")
    nivel.files.target.check_target(target, "table", force=order.force, sources=[Path(path)])
    times, places, orientations = nivel.analysis.inverse.run.read_path(path)
    with progress_listener(order.quiet) as listener:
        found = machine.inverse_kinematics(point, places, times=times, orientations=orientations, listener=listener)
        found.save_csv(target)
    order.tell(found, lambda: click.echo(f"{found}\ntable: {target}", err=True))


@analysis_command(KinematicsSettingsDict, "NAME-kinematics.nc")
@click.option(
    "--range", "ranged", is_flag=True, help="Find how far the coordinate of --drive can move in both directions."
)
@click.option(
    "--through",
    is_flag=True,
    help="Follow all positions, also past turning points of the coordinate of --drive; writes NAME-way.nc.",
)
@repeated(
    "--transmission",
    "transmission",
    "JOINTS",
    "Transmission angle at the second of three joints, e.g. pin,rocker_pin,pivot.",
)
@repeated("--curve", "curve", "POINT", "Path of a marker, or of a point BODY:X,Y,Z in the frame of its body.")
def kinematics(
    order: Order, ranged: bool, through: bool, transmission: tuple[str, ...], curve: tuple[str, ...]
) -> None:
    """Move MACHINE by its drivers, or by driving one joint coordinate, without integration over time.

    If the machine cannot move any further, the message names the driver and the joints that hold it.

    Exit codes: 0 done, 2 fault in the input, 3 the machine cannot move any further, 130 interrupted. The positions up to there are kept.
    """
    machine = order.load()
    angles = [nivel.results.analyses.mechanism.read_transmission(machine.record, each) for each in transmission]
    points = [nivel.results.analyses.mechanism.read_curve(machine.record, each) for each in curve]
    if ranged:
        found = _find(order, "--range", ("start", "end", "duration"), machine.range_of_motion)
        order.tell(found, lambda: click.echo(str(found), err=True))
    elif through:
        _follow(order, machine)
    else:

        def studied(result: Result) -> "Studied":
            return Studied(result, nivel.results.analyses.mechanism.add_studies(result, angles, points))

        order.run(f"{machine.name}-kinematics.nc", machine.kinematics, _say, studied)


class Studied(Struct):
    """A result with transmission angles and curves, if some were asked for."""

    result: Result
    studies: Studies | None

    @property
    def outcome(self) -> str:
        """That of the result."""
        return self.result.outcome

    def summary(self) -> dict[str, Any]:
        """The summary of both."""
        found = self.result.summary()
        return found if self.studies is None else {**found, "studies": self.studies.summary()}

    def report(self, page: Path) -> None:
        """The reports of both."""
        self.result.report(page)
        if self.studies is not None:
            self.studies.report(page.with_name(f"{page.stem}-curves.html"))


def _follow(order: Order, machine: Machine) -> None:
    """All positions, and where the coordinate turns back."""
    target = Path(order.out or f"{machine.name}-way.nc")
    nivel.files.target.check_target(target, "table", force=order.force, sources=[])
    others = ("start", "end", "duration", "positions", "coordinates")
    found = _find(order, "--through", others, machine.configuration_curve)
    found.save(target, force=order.force)
    order.tell(found, lambda: click.echo(f"{found}\ndata: {target}", err=True))


def _find(order: Order, option: str, others: tuple[str, ...], find: Callable[..., Any]) -> Any:
    """What an option finds for the coordinate of --drive. Raises ModelError where that is missing, or `others` say how it moves."""
    settings = dict(order.settings)
    drive = settings.pop("drive", None)
    if drive is None:
        raise ModelError(Fault.at("kinematics.drive", f"{option} needs a coordinate: name it with --drive"))
    given = [name for name in others if name in settings]
    if given:
        raise ModelError(Fault.at(f"kinematics.{given[0]}", f"has no part in {option}, which finds the way itself"))
    with progress_listener(order.quiet) as listener:
        return find(drive, **settings, listener=listener)


def _say(studied: Studied, target: Path, report: Path | None) -> None:
    out, result = console(), studied.result
    time, timing = result.time, result.timing
    out.print(f"{ended(result)}, {len(time)} positions {computed_in(timing.get('loop_seconds', 0.0))}")
    for line in assembly_lines(result):
        out.print(line)
    say_trust_and_files(out, result.trust, target, report)
    for line in studied.studies.lines() if studied.studies is not None else ():
        click.echo(line, err=True)
