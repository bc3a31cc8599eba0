"""`nivel run MACHINE`: simulate, write the result and the report, say what happened."""

import json
import math
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import click

from nivel.cli.analysis_command import Order, analysis_command
from nivel.cli.options import input_option
from nivel.cli.progress import computed_in, console, ended, progress_listener, say_trust_and_files
from nivel.known import Machine, Result
from nivel.lazy import nivel
from nivel.settings import RunSettingsDict
from nivel.words.wording import set_in_motion

MOST_CHANGES = 3  # moved bodies, and changed velocities, that are listed one by one
ROUND_OFF = 1e-14  # m, rad or per second: smaller changes of the start are not reported


@analysis_command(RunSettingsDict, "NAME.nc")
@input_option
@click.option("--no-verify", is_flag=True, help="Make no second run, so the error is not estimated.")
@click.option("--operate", is_flag=True, help="Put the machine into the report, to be operated there; 0.5 MB or more.")
@click.option(
    "--verify-limit",
    metavar="TIME",
    help="How long the second run may continue after the first, e.g. '1 min'; default: the duration of the first, and at least 10 s.",
)
def command(order: Order, inputs: dict[str, str], no_verify: bool, operate: bool, verify_limit: str | None) -> None:
    """Simulate MACHINE and write its result (NetCDF) and report (HTML).

    A second run with other step sizes runs at the same time and estimates the error of every number in the result.

    Options override the section `simulation` of the machine file. An option that has no effect on the chosen methods is refused.

    Exit codes: 0 done, 2 fault in the input, 3 the computation failed, 130 interrupted. The results computed so far are always kept.
    """
    if order.out is not None:  # before all that takes time
        order.files(order.out)
    machine = order.load()
    simulate = partial(machine.simulate, inputs=inputs, verify=not no_verify, verify_limit=verify_limit)
    reported = (
        (_operated(machine.with_settings(order.settings), order.quiet),) if operate and not order.no_report else ()
    )
    order.run(f"{machine.name}.nc", simulate, partial(_say, notes=machine.name_notes), reported=reported)


def _operated(machine: Machine, quiet: bool) -> str:
    """The page in which the machine is run again. Raises ModelError where a page cannot carry it."""
    with TemporaryDirectory() as folder, progress_listener(quiet) as listener:
        return nivel.live.page.export_page(machine, Path(folder) / "page.html", listener=listener).path.read_text(
            encoding="utf-8"
        )


def _say(result: Result, target: Path, report: Path | None, notes: Sequence[str]) -> None:
    out = console()
    timing = result.timing
    done = ended(result)
    if timing:  # not where the run was broken off
        done += f", {timing['steps']} steps {computed_in(timing['loop_seconds'], timing['steps'])}"
    out.print(done)
    for note in notes:
        out.print(f"note: {note}", markup=False, soft_wrap=True)
    if reason := result.settings.get("reason"):
        method, later = result.settings["integrator"], result.settings.get("went_on")
        more = f"; stiff at t = {later['from']:.4g} s, where {later['integrator']} went on" if later else ""
        out.print(f"method: {method}, because {reason}{more}", markup=False, soft_wrap=True)
    for line in assembly_lines(result):
        out.print(line)
    for line in nivel.results.frames.summary.in_words(result.events, result.stopped_by):
        out.print(f"event: {line}", markup=False)
    say_trust_and_files(out, result.trust, target, report)


def assembly_lines(result: Result) -> Iterator[str]:
    """What the start differs from the file in: nothing is changed silently."""
    assembly = json.loads(str(result.attributes.get("assembly", "{}")))
    moved, changed = (
        [each for each in assembly.get(kind, []) if max(each[1:]) > ROUND_OFF] for kind in ("moved", "velocity_change")
    )
    if assembly.get("gap", 0.0) > ROUND_OFF:
        why = f"to close {assembly['gap_row']}, open by {assembly['gap']:.3g} as given"
    else:
        why = "to reach the start values of joints"
    amounts = [(name, _amounts((d, "m"), (math.degrees(a), "deg"))) for name, d, a in _largest(moved)]
    yield from _changes("moved", amounts, len(moved), why)
    followed = assembly.get("followed", [])
    changed = [each for each in changed if each[0] not in followed]
    amounts = [(name, _amounts((v, "m/s"), (w, "rad/s"))) for name, v, w in _largest(changed)]
    yield from _changes("given another velocity", amounts, len(changed), "to fit the joints")
    if followed:
        yield f"assembly: {set_in_motion(followed)}"


def _largest(changes: list[Any]) -> list[Any]:
    """All changes if these are few, else the largest."""
    return changes if len(changes) <= MOST_CHANGES else [max(changes, key=lambda each: max(each[1:]))]


def _changes(what: str, amounts: list[tuple[str, str]], count: int, why: str) -> Iterator[str]:
    """A line for each of a few changes; for many one line with the largest."""
    if count > MOST_CHANGES:
        ((name, amount),) = amounts
        yield f"assembly: {count} bodies were {what} {why}; the largest change is that of {name}, {amount}"
        return
    for name, amount in amounts:
        changed = f"{name} was moved by" if what == "moved" else f"the velocity of {name} was changed by"
        yield f"assembly: {changed} {amount} {why}"


def _amounts(*amounts: tuple[float, str]) -> str:
    """Amounts with their units, those at round-off left out."""
    largest = max(amount for amount, _ in amounts)
    return " and ".join(f"{amount:.3g} {unit}" for amount, unit in amounts if amount > 1e-9 * largest)
