"""`nivel run MACHINE`: simulate, write the result and the report, say what happened."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from nivel.cli.ending import COLOURS, computed_in, console, ended, say_checks
from nivel.cli.failures import say_faults
from nivel.cli.options import (
    allow_code_option,
    file_argument,
    force_option,
    input_option,
    json_option,
    no_report_option,
    override_option,
    quiet_option,
    setting_options,
)
from nivel.cli.progress import progress_listener
from nivel.settings import RunSettingsDict
from nivel.words.wording import set_in_motion

MOST_CHANGES = 3  # moved bodies, and changed velocities, that are listed one by one
ROUND_OFF = 1e-14  # m, rad or per second: smaller changes of the start are not reported

if TYPE_CHECKING:
    from nivel.results import Result
    from nivel.results.trust import Trust


@click.command(short_help="Simulate a machine: result file, report, summary.")
@file_argument("machine")
@setting_options(RunSettingsDict)
@override_option
@input_option
@allow_code_option
@click.option(
    "-o", "--out", type=click.Path(dir_okay=False), help="Result file; default: NAME.nc in the working directory."
)
@force_option
@click.option("--no-verify", is_flag=True, help="Make no second run, so the error is not estimated.")
@click.option(
    "--verify-limit",
    metavar="TIME",
    help="How long the second run may continue after the first, e.g. '1 min'; default: the duration of the first, and at least 10 s.",
)
@no_report_option
@quiet_option
@json_option
def command(
    machine: str,
    overrides: dict[str, str],
    inputs: dict[str, str],
    allow_code: bool,
    out: str | None,
    force: bool,
    no_verify: bool,
    verify_limit: str | None,
    no_report: bool,
    quiet: bool,
    as_json: bool,
    settings: dict[str, Any],
) -> None:
    """Simulate MACHINE and write its result (NetCDF) and report (HTML).

    A second run with other step sizes runs at the same time and estimates the error of every number in the result.

    Options override the section `simulation` of the machine file. An option that has no effect on the chosen methods is refused.

    Exit codes: 0 done, 2 fault in the input, 3 the computation failed, 130 interrupted. The results computed so far are always kept.
    """
    if out is not None:  # before all that takes time
        refuse_to_replace(None if no_report else beside(Path(out)), Path(out), force, Path(machine))
    from nivel.api import load
    from nivel.errors import ModelError, SolveError

    loaded = load(machine, overrides, allow_code=allow_code)
    target = Path(out) if out is not None else Path(f"{loaded.name}.nc")
    report = None if no_report else beside(target)
    refuse_to_replace(report, target, force, Path(machine))
    failure: SolveError | None = None
    unwritten: ModelError | None = None
    with progress_listener(quiet) as listener:
        try:
            result = loaded.simulate(
                **settings,
                inputs=inputs,
                out=target,
                force=force,
                verify=not no_verify,
                verify_limit=verify_limit,
                listener=listener,
            )
        except SolveError as error:
            failure = error
            result: Any = error.result
        if report is not None and result is not None:
            listener.say("writing the report")
            try:
                result.report(report)
            except ModelError as error:
                if failure is None:
                    raise
                unwritten = error  # the failure counts: it decides about the exit code
    if as_json and result is not None:
        click.echo(json.dumps(result.summary(), indent=2))
    if not quiet and result is not None:
        _say(result, target, None if unwritten else report, loaded.name_notes)
    if unwritten is not None:
        say_faults(unwritten)
    if failure is not None:
        raise failure
    if result is not None and result.outcome == "interrupted":
        raise KeyboardInterrupt


def beside(target: Path) -> Path:
    """The report of the result file `target`."""
    from nivel.errors import ModelError

    if target.name in ("", ".."):
        raise ModelError(f"'{target}' is a folder; the name of a result file was expected, for instance result.nc")
    return target.with_suffix(".html")


def refuse_to_replace(report: Path | None, target: Path, force: bool, machine: Path) -> None:
    """Refuse files that exist, unless they may be replaced; the machine file is never written over."""
    from nivel.errors import ModelError
    from nivel.files.target import check_target

    if report is not None and report == target:
        raise ModelError(
            f"{target}: the result is a NetCDF file and the report would be written over it; use a name ending in .nc"
        )
    check_target(target, "result file", force=force, sources=[machine])
    if report is not None:
        check_target(report, "report", force=force, sources=[machine])


def _say(result: Result, target: Path, report: Path | None, notes: Sequence[str]) -> None:
    from nivel.results.frames.occurrence import in_words

    out = console()
    trust = result.trust
    timing = result.timing
    done = ended(result)
    if timing:  # not where the run was broken off
        done += f", {timing['steps']} steps {computed_in(timing['loop_seconds'], timing['steps'])}"
    out.print(done)
    for note in notes:
        out.print(f"note: {note}", markup=False, soft_wrap=True)
    for line in assembly_lines(result):
        out.print(line)
    for line in in_words(result.events, result.stopped_by):
        out.print(f"event: {line}", markup=False)
    out.print(f"trust: {said_in_colour(trust)}", soft_wrap=True)
    say_checks(out, trust)
    out.print(f"result: {target}" + (f"\nreport: {report}" if report is not None else ""), soft_wrap=True)


def said_in_colour(trust: Trust) -> str:
    """The verdict and the headline; of a run that was not verified no green one."""
    verdict = "" if trust.accuracy_estimate is None and trust.verdict == "green" else trust.verdict
    coloured = f"[{COLOURS[verdict]}]{verdict}[/], " if verdict else ""
    return f"{coloured}{trust.headline}"


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
    yield from _changes(
        "moved",
        [(name, _amounts((d, "m"), (math.degrees(a), "deg"))) for name, d, a in _largest(moved)],
        len(moved),
        why,
    )
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
