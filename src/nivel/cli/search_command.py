"""Course of the commands that search, `nivel optimise` and `nivel identify`: the study, the search, its data file and its report."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
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
