"""Commands that search: `nivel optimise STUDY`, values of parameters with which an output is least within limits of others; `nivel identify
STUDY`, those that explain measurements, and how certain they are. Each writes a data file and a report."""

import json
from collections.abc import Callable, Sequence
from math import isnan
from pathlib import Path
from typing import Any

import click

from nivel.cli.analysis_command import StudyOrder, study_command
from nivel.cli.failures import COMPUTATION_FAILED
from nivel.cli.sweep import is_complete, say_how_to_go_on
from nivel.errors import SolveError
from nivel.known import Identified, Optimum
from nivel.lazy import nivel, rich

Facts = Callable[[Any], dict[str, Any]]
SEARCH = ("--threads", "Runs beside each other; default: one for each processor.")


def make_search(order: StudyOrder, method: str, facts: Facts, say: Callable[[Any], None]) -> Any:
    """Make the search that a `method` of studies is, and the files. The machine that was found runs once more, to say how exact it is.

    Where no start has a result, the data file has all variants nevertheless. facts : what was found, for programs; say : the same for
    people. Returns it, with `dataset` and `evaluations`; None where nothing was left to compute.
    """
    loaded = nivel.studies.load_study(order.study, order.overrides, allow_code=order.allow_code)
    target, page = order.targets(loaded)
    sources, replaces = [Path(order.study), Path(loaded.file.machine_file)], order.force or order.resume
    nivel.files.target.check_target(target, "data file", force=replaces, sources=sources)
    if page is not None:
        nivel.files.target.check_target(page, "report", force=replaces, sources=sources)
    if order.resume and is_complete(target, page, order.quiet):
        return None
    try:
        found = getattr(loaded, method)(out=target, threads=order.count, resume=order.resume, force=order.force)
    except (nivel.analysis.optimise.evaluations.NothingFoundError, SolveError) as error:
        table: Any = error.result
        if table is not None:
            if page is not None:
                nivel.studies.write_study_report(table, page)
            if not order.quiet:
                click.echo(f"all variants: {target}", err=True)
        raise
    except KeyboardInterrupt:
        say_how_to_go_on(target)
        raise
    trust = nivel.results.trust.Trust.from_json(found.dataset.attrs["trust"])
    if page is not None:
        nivel.studies.write_study_report(found.dataset, page)
    if order.as_json:
        click.echo(json.dumps({**facts(found), "headline": str(trust.headline)}, indent=2))
    if not order.quiet:
        say(found)
        click.echo(f"{found.evaluations} runs; the machine that was found: {trust.headline}", err=True)
        click.echo(f"data: {target}" + ("" if page is None else f"\nreport: {page}"), err=True)
    return found


def numbers_table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print a table on standard output."""
    table = rich.table.Table(*heads)
    for row in rows:
        table.add_row(*row)
    rich.console.Console().print(table)


@study_command(*SEARCH)
def optimise(order: StudyOrder) -> None:
    """Find the values of the parameters of STUDY with which one of its outputs is least, within the limits of the others.

    The study says so with `optimise: {output: NAME}`. The data file and the report have every variant that was computed. The best
    machine is run once more, with a second run beside it, to say how exact it is.

    Exit codes: 0 a best one within all limits was found, 2 fault in the input, 3 no values keep all limits, or runs fail.
    """
    found = make_search(order, "optimise", _facts_of_optimum, _say_optimum)
    if found is not None and not found.kept:
        raise SystemExit(COMPUTATION_FAILED)


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


@study_command(*SEARCH)
def identify(order: StudyOrder) -> None:
    """Find the values of the parameters of STUDY with which the machine moves as it was measured, by least squares.

    The study names the measurements with `identify: {data: FILE.csv}`. The data file and the report have every variant that was
    computed, and the covariance of what was found. The machine that was found is run once more, with a second run beside it, to
    say how exact it is.

    Exit codes: 0 all parameters were found, 2 fault in the input, 3 the measurements do not tell some of them apart, or runs fail.
    """
    found = make_search(order, "identify", _facts_of_fit, _say_fit)
    if found is not None and found.undetermined:
        raise SystemExit(COMPUTATION_FAILED)


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
    deviations = {path: f"{each:.2g}" for path, each in found.deviations.items()}
    deviations |= dict.fromkeys(found.on_bounds, "on its bound")
    rows = [(path, f"{value:.6g}", deviations[path]) for path, value in found.values.items()]
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
