"""`nivel optimise STUDY`: the values of its parameters with which an output is least, within limits of others."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from nivel.cli.options import allow_code_option, file_argument, force_option, json_option, quiet_option
from nivel.cli.search_options import numbers_table, out_option, target_of, threads_option
from nivel.cli.sweep import set_option

if TYPE_CHECKING:
    from nivel.analysis.optimise.optimise import Optimum


@click.command(short_help="Find the best values of a machine's parameters.")
@file_argument("study")
@set_option
@allow_code_option
@out_option
@threads_option
@force_option
@quiet_option
@json_option
def command(
    study: str,
    overrides: dict[str, str],
    allow_code: bool,
    out: Path | None,
    threads: int | None,
    force: bool,
    quiet: bool,
    as_json: bool,
) -> None:
    """Find the values of the parameters of STUDY with which one of its outputs is least, within the limits of the others.

    The study says so with `optimise: {output: NAME}`. The data file has every variant that was computed. The best machine is run once more,
    with a second run beside it, to say how exact it is.

    Exit codes: 0 a best one within all limits was found, 2 fault in the input, 3 no values keep all limits, or runs fail.
    """
    from nivel.cli.failures import COMPUTATION_FAILED
    from nivel.studies import load_study

    loaded = load_study(study, overrides, allow_code=allow_code)
    target = target_of(loaded, out, force, study)
    found = loaded.optimise(threads=threads)
    found.dataset.to_netcdf(target, engine="h5netcdf")
    headline = str(found.machine.simulate().trust.headline)
    if as_json:
        click.echo(json.dumps(_facts(found, headline), indent=2))
    if not quiet:
        _say(found, headline, target)
    if not found.kept:
        raise SystemExit(COMPUTATION_FAILED)


def _facts(found: Optimum, headline: str) -> dict[str, Any]:
    return {
        "values": dict(found.values),
        "outputs": dict(found.outputs),
        "kept": found.kept,
        "reached": found.reached.tolist(),
        "evaluations": found.evaluations,
        "message": found.message,
        "headline": headline,
    }


def _say(found: Optimum, headline: str, target: Path) -> None:
    rows = [*((path, value, "parameter") for path, value in found.values.items())]
    rows += [(name, value, "output") for name, value in found.outputs.items() if name != "objective"]
    numbers_table(("name", "value", ""), [(name, f"{value:.6g}", what) for name, value, what in rows])
    kept = "all limits are kept" if found.kept else "NOT ALL LIMITS ARE KEPT"
    click.echo(f"{found.evaluations} runs, {kept}; {found.message}", err=True)
    click.echo(f"the best machine: {headline}", err=True)
    click.echo(str(target), err=True)
