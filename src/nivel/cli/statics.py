"""`nivel statics MACHINE`: where a machine rests under its loads; a result file, a report beside it, a summary."""

import json
from pathlib import Path
from typing import Final

from nivel.cli.analysis_command import Order, analysis_command
from nivel.cli.progress import computed_in, console, ended, say_trust_and_files
from nivel.cli.run import assembly_lines
from nivel.known import Result
from nivel.settings import StaticsSettingsDict

SHOWN: Final = 12  # vibrations, and joint coordinates, in the terminal


@analysis_command(StaticsSettingsDict, "NAME-statics.nc")
def command(order: Order) -> None:
    """Find the static equilibrium of MACHINE, and follow it while time changes its loads and drivers.

    Velocities are zero, so dampers and the speeds of drivers have no effect.

    Exit codes: 0 done, 2 fault in the input, 3 no equilibrium found, 130 interrupted. The states found so far are always kept.
    """
    machine = order.load()
    order.run(f"{machine.name}-statics.nc", machine.statics, _say)


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
