"""Commands that search: `nivel optimise STUDY`, values of parameters with which an output is least within limits of others; `nivel identify
STUDY`, those that explain measurements, and how certain they are. Each writes a data file and a report."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from math import isnan
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from nivel.cli.failures import COMPUTATION_FAILED
from nivel.cli.options import (
    allow_code_option,
    file_argument,
    force_option,
    json_option,
    no_report_option,
    quiet_option,
)
from nivel.cli.sweep import is_complete, resume_option, say_how_to_go_on, set_option
from nivel.errors import ModelError, SolveError
from nivel.lazy import dataclass, nivel, rich

if TYPE_CHECKING:
    from nivel.analysis.optimise.identify import Identified
    from nivel.analysis.optimise.optimise import Optimum
    from nivel.studies import Study

Command = Callable[..., Any]

OPTIONS = (
    file_argument("study"),
    set_option,
    allow_code_option,
    click.option(
        "-o",
        "--out",
        metavar="FILE.nc",
        type=click.Path(dir_okay=False, path_type=Path),
        help="Data file; default: NAME.nc in the working directory.",
    ),
    click.option(
        "--threads",
        type=click.IntRange(1),
        metavar="NUMBER",
        help="Runs beside each other; default: one for each processor.",
    ),
    resume_option,
    force_option,
    no_report_option,
    quiet_option,
    json_option,
)


def search_options(command: Command) -> Command:
    """Give a command all OPTIONS, in their order."""
    for option in reversed(OPTIONS):
        command = option(command)
    return command


@dataclass(frozen=True)
class Given:
    """What the command line says."""

    study: str
    overrides: dict[str, str]
    allow_code: bool
    out: Path | None
    threads: int | None
    resume: bool
    force: bool
    no_report: bool
    quiet: bool
    as_json: bool


@dataclass(frozen=True)
class Kind:
    """A kind of search. search : of a study, with `out`, `threads`, `resume` and `force`; facts : what was found, for programs; say : the
    same for people; is_found : whether nothing is left open. Their results have `dataset` and `evaluations`."""

    search: Callable[..., Any]
    facts: Callable[[Any], dict[str, Any]]
    say: Callable[[Any], None]
    is_found: Callable[[Any], bool]


def make_search(given: Given, kind: Kind) -> None:
    """Make the search, and the files. The machine that was found runs once more, to say how exact it is.

    Where no start has a result, the data file has all variants nevertheless.
    """
    loaded = nivel.studies.load_study(given.study, given.overrides, allow_code=given.allow_code)
    target, page = _targets(loaded, given)
    if given.resume and is_complete(target, page, given.quiet):
        return
    try:
        found = kind.search(loaded, out=target, threads=given.threads, resume=given.resume, force=given.force)
    except (nivel.analysis.optimise.evaluations.NothingFoundError, SolveError) as error:
        table: Any = error.result
        if table is not None:
            if page is not None:
                nivel.studies.write_study_report(table, page)
            if not given.quiet:
                click.echo(f"all variants: {target}", err=True)
        raise
    except KeyboardInterrupt:
        say_how_to_go_on(target)
        raise
    trust = nivel.results.trust.Trust.from_json(found.dataset.attrs["trust"])
    if page is not None:
        nivel.studies.write_study_report(found.dataset, page)
    if given.as_json:
        click.echo(json.dumps({**kind.facts(found), "headline": str(trust.headline)}, indent=2))
    if not given.quiet:
        kind.say(found)
        click.echo(f"{found.evaluations} runs; the machine that was found: {trust.headline}", err=True)
        click.echo(f"data: {target}" + ("" if page is None else f"\nreport: {page}"), err=True)
    if not kind.is_found(found):
        raise SystemExit(COMPUTATION_FAILED)


def _targets(study: Study, given: Given) -> tuple[Path, Path | None]:
    """Data file and report. Raises ModelError where one exists and is not to be replaced."""
    target = given.out or Path(f"{study.file.record.name}.nc")
    page = None if given.no_report else nivel.cli.analysis_command.beside(target)
    if page == target:
        raise ModelError(f"{target}: the report would be written over the data file; use a name ending in .nc")
    sources = [Path(given.study), Path(study.file.machine_file)]
    nivel.files.target.check_target(target, "data file", force=given.force or given.resume, sources=sources)
    if page is not None:
        nivel.files.target.check_target(page, "report", force=given.force or given.resume, sources=sources)
    return target, page


def numbers_table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print a table on standard output."""
    table = rich.table.Table(*heads)
    for row in rows:
        table.add_row(*row)
    rich.console.Console().print(table)


@click.command(short_help="Find the best values of a machine's parameters.")
@search_options
def optimise(**given: Any) -> None:
    """Find the values of the parameters of STUDY with which one of its outputs is least, within the limits of the others.

    The study says so with `optimise: {output: NAME}`. The data file and the report have every variant that was computed. The best
    machine is run once more, with a second run beside it, to say how exact it is.

    Exit codes: 0 a best one within all limits was found, 2 fault in the input, 3 no values keep all limits, or runs fail.
    """
    kind = Kind(
        lambda study, **options: study.optimise(**options),
        facts=_facts_of_optimum,
        say=_say_optimum,
        is_found=lambda found: found.kept,
    )
    make_search(Given(**given), kind)


def _facts_of_optimum(found: Optimum) -> dict[str, Any]:
    return {
        "values": dict(found.values),
        "outputs": dict(found.outputs),
        "kept": found.kept,
        "reached": found.reached.tolist(),
        "evaluations": found.evaluations,
        "message": found.message,
    }


def _say_optimum(found: Optimum) -> None:
    rows = [*((path, value, "parameter") for path, value in found.values.items())]
    rows += [(name, value, "output") for name, value in found.outputs.items() if name != "objective"]
    numbers_table(("name", "value", ""), [(name, f"{value:.6g}", what) for name, value, what in rows])
    kept = "all limits are kept" if found.kept else "NOT ALL LIMITS ARE KEPT"
    click.echo(f"{kept}; {found.message}", err=True)


@click.command(short_help="Find the values of a machine's parameters from measurements.")
@search_options
def identify(**given: Any) -> None:
    """Find the values of the parameters of STUDY with which the machine moves as it was measured, by least squares.

    The study names the measurements with `identify: {data: FILE.csv}`. The data file and the report have every variant that was
    computed, and the covariance of what was found. The machine that was found is run once more, with a second run beside it, to
    say how exact it is.

    Exit codes: 0 all parameters were found, 2 fault in the input, 3 the measurements do not tell some of them apart, or runs fail.
    """
    kind = Kind(
        lambda study, **options: study.identify(**options),
        facts=_facts_of_fit,
        say=_say_fit,
        is_found=lambda found: not found.undetermined,
    )
    make_search(Given(**given), kind)


def _facts_of_fit(found: Identified) -> dict[str, Any]:
    deviations = {path: None if path in found.on_bounds else each for path, each in found.deviations.items()}
    return {
        "values": dict(found.values),
        "standard_deviations": deviations,
        "covariance": [[None if isnan(each) else each for each in row] for row in found.covariance.tolist()],
        "deviation_of": dict(found.deviation_of),
        "undetermined": list(found.undetermined),
        "on_bounds": list(found.on_bounds),
        "reached": found.reached.tolist(),
        "evaluations": found.evaluations,
    }


def _say_fit(found: Identified) -> None:
    rows = [(path, f"{value:.6g}", _deviation(found, path)) for path, value in found.values.items()]
    numbers_table(("parameter", "value", "standard deviation"), rows)
    for name, deviation in found.deviation_of.items():
        click.echo(f"{name}: what is left has a standard deviation of {deviation:.3g}", err=True)
    if found.on_bounds:
        listed = ", ".join(found.on_bounds)
        click.echo(
            f"on a bound, without a deviation: {listed}; move the bound to see where the squares are least", err=True
        )
    if found.undetermined:
        click.echo(f"the measurements do not tell apart: {', '.join(found.undetermined)}", err=True)


def _deviation(found: Identified, path: str) -> str:
    return "on its bound" if path in found.on_bounds else f"{found.deviations[path]:.2g}"
