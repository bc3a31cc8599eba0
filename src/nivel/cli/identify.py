"""`nivel identify STUDY`: the values of its parameters that explain measurements, and how certain they are."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from nivel.cli.options import allow_code_option, file_argument, force_option, json_option, quiet_option
from nivel.cli.search_options import numbers_table, out_option, target_of, threads_option
from nivel.cli.sweep import set_option

if TYPE_CHECKING:
    from nivel.analysis.optimise.identify import Identified


@click.command(short_help="Find the values of a machine's parameters from measurements.")
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
    """Find the values of the parameters of STUDY with which the machine moves as it was measured, by least squares.

    The study names the measurements with `identify: {data: FILE.csv}`. The data file has every variant that was computed, and the
    covariance of what was found.

    Exit codes: 0 all parameters were found, 2 fault in the input, 3 the measurements do not tell some of them apart.
    """
    from nivel.cli.failures import COMPUTATION_FAILED
    from nivel.studies import load_study

    loaded = load_study(study, overrides, allow_code=allow_code)
    target = target_of(loaded, out, force, study)
    found = loaded.identify(threads=threads)
    found.dataset.to_netcdf(target, engine="h5netcdf")
    if as_json:
        click.echo(json.dumps(_facts(found), indent=2))
    if not quiet:
        _say(found, target)
    if found.undetermined:
        raise SystemExit(COMPUTATION_FAILED)


def _facts(found: Identified) -> dict[str, Any]:
    return {
        "values": dict(found.values),
        "standard_deviations": dict(found.deviations),
        "covariance": found.covariance.tolist(),
        "deviation_of": dict(found.deviation_of),
        "undetermined": list(found.undetermined),
        "reached": found.reached.tolist(),
        "evaluations": found.evaluations,
    }


def _say(found: Identified, target: Path) -> None:
    rows = [(path, f"{value:.6g}", f"{found.deviations[path]:.2g}") for path, value in found.values.items()]
    numbers_table(("parameter", "value", "standard deviation"), rows)
    for name, deviation in found.deviation_of.items():
        click.echo(f"{name}: what is left has a standard deviation of {deviation:.3g}", err=True)
    if found.undetermined:
        click.echo(f"the measurements do not tell apart: {', '.join(found.undetermined)}", err=True)
    click.echo(f"{found.evaluations} runs", err=True)
    click.echo(str(target), err=True)
