"""`nivel kinematics MACHINE`: positions, velocities, accelerations and reactions of a driven machine; a result file and a report."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from nivel.cli.analysis_command import Order, analysis_command
from nivel.cli.options import repeated
from nivel.cli.progress import computed_in, console, ended, progress_listener, say_trust_and_files
from nivel.cli.run import assembly_lines
from nivel.errors import Fault, ModelError
from nivel.known import Machine, Result, Studies
from nivel.lazy import Struct, nivel
from nivel.settings import KinematicsSettingsDict


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
def command(order: Order, ranged: bool, through: bool, transmission: tuple[str, ...], curve: tuple[str, ...]) -> None:
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
