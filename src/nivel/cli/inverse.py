"""`nivel inverse MACHINE`: the efforts of actuators that make a machine follow a motion; data, a page, a summary."""

from pathlib import Path

import click

from nivel.cli.analysis_command import Order, analysis_command
from nivel.cli.progress import progress_listener
from nivel.errors import Fault, ModelError
from nivel.lazy import nivel
from nivel.settings import InverseSettingsDict


@analysis_command(InverseSettingsDict, "NAME-inverse.nc")
@click.option(
    "--path",
    metavar="FILE.csv",
    help="Inverse kinematics: path of --point as a table time,x,y,z, optionally with Euler parameters e0,e1,e2,e3.",
)
@click.option("--point", metavar="MARKER", help="Marker or body that follows --path.")
def command(order: Order, path: str | None, point: str | None) -> None:
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
