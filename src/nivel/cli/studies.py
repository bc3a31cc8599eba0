"""Commands of studies: `nivel sweep STUDY`, many variants of a machine; `nivel optimise STUDY`, values of parameters with which an output
is least within limits of others; `nivel identify STUDY`, those that explain measurements, and how certain they are. Each writes a data
file and a report."""

import json
import sys
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from math import isnan
from pathlib import Path
from time import monotonic
from typing import Any, Final

import click

from nivel.cli.analysis_command import StudyOrder, study_command
from nivel.cli.failures import COMPUTATION_FAILED
from nivel.errors import SolveError
from nivel.known import Identified, Optimum, Study
from nivel.lazy import nivel, numpy, rich, xarray
from nivel.words.wording import seconds

SHOWN: Final = 8  # variants in the live table, and reasons in the summary
COLUMNS: Final = 8  # numbers in a row of the live table
STYLES: Final = {"done": "green", "stopped": "green", "refused": "yellow"}


@study_command(
    "--workers",
    "Processes; default: one for each processor.",
    click.option("--scheduler", default="", metavar="ADDRESS", help="Compute on the Dask cluster with this scheduler."),
)
def sweep(order: StudyOrder, scheduler: str) -> None:
    """Compute the variants of STUDY, a file that names a machine, what varies, an analysis and its outputs.

    Variants that fail, take longer than the time limit, or end their process are rows of the table with their reason. Until all are
    finished, FILE.nc.journal has those that are: --resume goes on after any interruption.

    Exit codes: 0 the variants were computed, 2 fault in the input, 3 every variant failed, 130 interrupted.
    """
    loaded = nivel.studies.load_study(order.study, order.overrides, allow_code=order.allow_code)
    target, page = order.targets(loaded)
    if order.resume and is_complete(target, page, order.quiet):
        return
    if page is not None:
        nivel.files.target.check_target(page, "report", force=order.force or order.resume, sources=[Path(order.study)])
    with _progress(loaded, order.quiet) as (listener, heard):
        engine = {"workers": order.count, "scheduler": scheduler, "listener": listener, "heard": heard}
        found = loaded.sweep(out=target, resume=order.resume, force=order.force, **engine)
    interrupted = "not run" in found["outcome"].values
    if page is not None and not interrupted:
        nivel.studies.write_study_report(found, page)
    if order.as_json:
        click.echo(json.dumps(summary(found), indent=2))
    if not order.quiet:
        _say(found, target, page, interrupted)
    if interrupted:
        raise KeyboardInterrupt
    if not any(outcome in ("done", "stopped") for outcome in found["outcome"].values.reshape(-1)):
        raise SystemExit(COMPUTATION_FAILED)


def is_complete(target: Path, page: Path | None, quiet: bool) -> bool:
    """Whether an interrupted study had come to its data file, which is said; its report is written where it is missing."""
    if not target.exists() or target.with_name(f"{target.name}.journal").exists():
        return False
    if page is not None and not page.exists():
        nivel.studies.write_study_report(target, page)
    if not quiet:
        click.echo(f"{target} is complete: nothing is left to compute", err=True)
    return True


def say_how_to_go_on(target: Path) -> None:
    """Where an interrupted study has what was computed."""
    if target.with_name(f"{target.name}.journal").exists():
        click.echo(f"what was computed is in {target}.journal; go on with --resume", err=True)


def summary(found: "xarray.Dataset") -> dict[str, Any]:
    """Outcomes, and numbers of each output, for programs."""
    table = nivel.results.study_statistics.Table.of(found)
    outputs = {}
    for name, values in table.outputs.items():
        known = values[numpy.isfinite(values)]
        facts: dict[str, Any] = {"units": table.units[name], "count": len(known)}
        if len(known):
            facts |= {"min": float(known.min()), "mean": float(known.mean()), "max": float(known.max())}
            facts["standard_deviation"] = float(known.std(ddof=1)) if len(known) > 1 else 0.0
        if name in table.limited:
            facts["within_limits"] = nivel.results.study_statistics.share_within(table, name).value
        outputs[name] = facts
    out = {
        "study": str(found.attrs.get("study", "")),
        "machine": str(found.attrs["machine"]),
        "variants": len(table.outcome),
        "outcomes": {each: table.outcome.count(each) for each in dict.fromkeys(table.outcome)},
        "verdict": str(found.attrs["verdict"]),
        "outputs": outputs,
    }
    return out | ({"yield": nivel.results.study_statistics.share_within(table).value} if table.limited else {})


def _say(found: "xarray.Dataset", target: Path, page: Path | None, interrupted: bool) -> None:
    out, table, facts = nivel.cli.progress.console(), nivel.results.study_statistics.Table.of(found), summary(found)
    loop, took = float(found.attrs["loop_seconds"]), float(found.attrs["seconds"])
    steps = f", {seconds(loop)} of it in loops of runs" if loop else ""
    out.print(f"[bold]{facts['study']}[/bold]: {found.attrs['outcomes']} in {seconds(took)}{steps}")
    if table.outputs:
        shown = rich.table.Table("output", "unit", box=rich.box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
        for title in ("least", "mean", "greatest", "deviation", "within limits"):
            shown.add_column(title, justify="right")
        for name, each in facts["outputs"].items():
            numbers = [
                f"{each[key]:.5g}" if key in each else "" for key in ("min", "mean", "max", "standard_deviation")
            ]
            share = f"{100 * each['within_limits']:.4g} %" if "within_limits" in each else ""
            shown.add_row(name, each["units"], *numbers, share)
        out.print(shown)
    if table.limited:
        share = nivel.results.study_statistics.share_within(table)
        low, high = share.interval
        between = f"{100 * low:.3g} to {100 * high:.3g} % with a confidence of 95 %"
        out.print(
            f"yield: {share.count} of {share.of} variants are within all limits, {100 * share.value:.4g} % ({between})"
        )
    reasons = [(k, each, why) for k, (each, why) in enumerate(zip(table.outcome, table.reason, strict=True)) if why]
    others = [each for each in reasons if each[1] != "stopped"]
    for number, outcome, why in others[:SHOWN]:
        out.print(f"  variant {number}: {outcome}: {why}", markup=False)
    if len(others) > SHOWN:
        out.print(f"  and {len(others) - SHOWN} more that came to no end")
    coloured = nivel.cli.progress.in_colour(str(found.attrs["verdict"]))
    out.print(f"trust: {coloured}{found.attrs['headline']}", soft_wrap=True)
    if interrupted:
        say_how_to_go_on(target)
    else:
        out.print(f"data: {target}" + (f"\nreport: {page}" if page is not None else ""), soft_wrap=True)


@contextmanager
def _progress(study: Study, quiet: bool) -> Iterator[tuple[Any, Callable[[int, Any], None] | None]]:
    """A listener, and what hears each variant: in a terminal a bar with the time that is left, over a table of the last variants."""
    if quiet:
        yield nivel.analysis.progress.log.Listener(), None
        return
    count = len(study.variants.values)
    left = _Left(count)
    if not sys.stderr.isatty():
        with nivel.cli.progress.progress_listener(quiet) as listener:
            yield (
                nivel.analysis.progress.log.Listener(
                    listener.stage, lambda done: listener.say(f"{left.done(done)} of {count} variants{left}")
                ),
                None,
            )
        return
    text, counted = rich.progress.TextColumn, rich.progress.MofNCompleteColumn()
    bar = rich.progress.Progress(
        text("{task.description}"), rich.progress.BarColumn(), counted, text("{task.fields[left]}")
    )
    task = bar.add_task("variants", total=count, left="")
    last: deque[tuple[int, Any]] = deque(maxlen=SHOWN)
    with rich.live.Live(bar, console=rich.console.Console(stderr=True), transient=True, refresh_per_second=4) as live:

        def heard(number: int, run: Any) -> None:
            last.append((number, run))
            live.update(rich.console.Group(bar, _recent(study, last)))

        yield (
            nivel.analysis.progress.log.Listener(
                lambda text, _total: bar.update(task, description=text),
                lambda done: bar.update(task, completed=left.done(done), left=str(left)),
            ),
            heard,
        )


class _Left:
    """The time that is left, by how long the variants took that followed the first one of this run: that one waited for its process."""

    def __init__(self, count: int) -> None:
        self._count, self._begin, self._first, self._done = count, 0.0, -1, 0

    def done(self, done: float) -> int:
        """So many are finished."""
        self._done = int(done)
        if self._first < 0:
            self._first, self._begin = self._done, monotonic()
        return self._done

    def __str__(self) -> str:
        new = self._done - self._first
        if new < 1 or self._done >= self._count:
            return ""
        return f", about {seconds((monotonic() - self._begin) / new * (self._count - self._done))} left"


def _recent(study: Study, last: deque[tuple[int, Any]]) -> Any:
    record, values = study.file.record, study.variants.values
    parameters, outputs = list(record.parameters)[:COLUMNS], list(record.outputs)[:COLUMNS]
    shown = rich.table.Table(box=rich.box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    for title in ("variant", *parameters, "outcome", *outputs):
        shown.add_column(title, justify="left" if title == "outcome" else "right", no_wrap=True)
    for number, run in last:
        numbers = [_shown(values[number][path]) for path in parameters]
        found = [_shown(run.outputs[name].value) if name in run.outputs else "" for name in outputs]
        outcome = rich.text.Text(run.outcome, style=STYLES.get(run.outcome, "red"))
        shown.add_row(str(number), *numbers, outcome, *found)
    return shown


def _shown(value: Any) -> str:
    return f"{value:.5g}" if isinstance(value, float) else str(value)


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
