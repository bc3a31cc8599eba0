"""`nivel compare MACHINE`: run all combinations of methods, hold them against a reference, say what each is worth."""

from pathlib import Path
from typing import Any, Final

import click

from nivel.cli import options
from nivel.cli.failures import COMPUTATION_FAILED, INPUT_AT_FAULT
from nivel.cli.progress import progress_listener
from nivel.cli.studies import is_complete, say_how_to_go_on
from nivel.errors import Fault, ModelError
from nivel.known import Comparison
from nivel.lazy import nivel, rich
from nivel.settings import CompareSettingsDict

FORMATS: Final = (".csv", ".json")
WIDEST: Final = 1000  # a line of the table is a line also in a narrow terminal or a pipe
STYLES: Final = {"failed": "red", "refused": "yellow"}


@click.command()
@options.file_argument("machine")
@options.setting_options(CompareSettingsDict)
@click.option(
    "--repeat",
    type=click.IntRange(1),
    default=3,
    show_default=True,
    help="Number of runs of every combination; the fastest counts.",
)
@options.override_option
@options.allow_code_option
@click.option(
    "-o",
    "--out",
    multiple=True,
    type=options.FILE,
    help="Table, .csv or .json. May be repeated; default: NAME-compare.csv and .json in the working directory.",
)
@options.report_option("table")
@options.no_report_option
@options.resume_option
@options.force_option
@options.quiet_option
@options.json_option
def command(
    machine: str,
    repeat: int,
    overrides: dict[str, str],
    allow_code: bool,
    out: tuple[Path, ...],
    report: Path | None,
    no_report: bool,
    resume: bool,
    force: bool,
    quiet: bool,
    as_json: bool,
    settings: dict[str, Any],
) -> None:
    """Run MACHINE with all combinations of the given words, and compare their computing times and errors.

    Words are separated by commas. A setting without an option is that of the machine file. Every run is compared with a reference
    solution of another method, whose own error is estimated. A combination that fails or is impossible is reported, and the others are
    still run.

    Exit codes: 0 the combinations were run, 2 fault in the input, 3 every run failed, 130 interrupted. The results computed so far are
    always written. Until all combinations are run, a journal beside the first table has those that are: --resume goes on after any
    interruption.
    """
    if no_report and report is not None:
        raise ModelError(f"--no-report and --report {report} contradict each other: take one of them away")
    loaded = nivel.api.load(machine, overrides, allow_code=allow_code)
    tables = out or tuple(Path(f"{loaded.name}-compare{suffix}") for suffix in FORMATS)
    if others := [path for path in tables if path.suffix not in FORMATS]:
        message = "a table ends with .csv or .json; the page is named with --report"
        raise ModelError(Fault.at("", f"{path}: {message}") for path in others)
    page = None if no_report else report or tables[0].with_suffix(".html")
    _refuse_to_replace(tables, page, force or resume, Path(machine))
    if resume and is_complete(tables[0], None, quiet):
        return
    of = nivel.analysis.progress.journal.fingerprint(loaded, sorted(settings.items()), repeat)
    with nivel.analysis.progress.journal.open_journal(
        tables[0], of, "runs", resume=resume, force=force, sources=[Path(machine)]
    ) as journal:
        with progress_listener(quiet) as listener:
            comparison = loaded.compare(**settings, repeat=repeat, journal=journal, listener=listener)
        unwritten = _written(comparison, tables, page, quiet)
        assert journal is not None
        journal.complete = unwritten is None and comparison.outcome != "interrupted"
    if as_json:
        click.echo(comparison.to_json(), nl=False)
    else:
        _print(comparison)
    if unwritten is not None:
        raise unwritten
    if comparison.outcome == "interrupted":
        say_how_to_go_on(tables[0])
        raise KeyboardInterrupt
    if not comparison.completed:
        failed = any(row.outcome == "failed" for row in comparison.rows)
        raise SystemExit(COMPUTATION_FAILED if failed else INPUT_AT_FAULT)


def _refuse_to_replace(tables: tuple[Path, ...], page: Path | None, force: bool, machine: Path) -> None:
    """Refuse, before anything is run, files that cannot be written or exist and may not be replaced."""
    for path in tables:
        nivel.files.target.check_text_target(path, "table", force=force, sources=[machine])
    if page is not None:
        if page in tables:
            raise ModelError(f"{page}: the page would be written over the table; use a name ending in .html")
        nivel.files.target.check_text_target(page, "report", force=force, sources=[machine])


def _written(comparison: Comparison, tables: tuple[Path, ...], page: Path | None, quiet: bool) -> ModelError | None:
    """Write all files and name them; what cannot be written comes back: the comparison is printed first."""
    try:
        for path in tables:
            write = comparison.to_csv if path.suffix == ".csv" else comparison.to_json
            write(path, force=True)  # whether it may be replaced was asked before the grid was run
        if page is not None:
            comparison.report(page, force=True)
    except ModelError as error:
        return error
    if not quiet:
        click.echo("written: " + ", ".join(str(path) for path in (*tables, page) if path is not None), err=True)
    return None


def _print(comparison: Comparison) -> None:
    """The table on standard output, as wide as it is where that is no terminal."""
    shown = nivel.results.comparison_table.columns(comparison)
    table = rich.table.Table(box=rich.box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    words = len(comparison.varying or ("integrator",))
    for k, column in enumerate(shown):
        table.add_column(column.title, justify="left" if k < words else "right", no_wrap=True)
    for row in comparison.rows:
        table.add_row(*(rich.text.Text(column.cell(row)) for column in shown), style=STYLES.get(row.outcome))
    console = rich.console.Console(highlight=False, width=WIDEST)
    console.print(table)
    for line in nivel.results.comparison_table.lines(comparison):
        console.print(rich.text.Text(line), soft_wrap=True)
