"""`nivel identify STUDY`: the values of its parameters that explain measurements, and how certain they are."""

from __future__ import annotations

from math import isnan
from typing import TYPE_CHECKING, Any

import click

from nivel.cli.search_command import Given, Kind, make_search, numbers_table, search_options

if TYPE_CHECKING:
    from nivel.analysis.optimise.identify import Identified


@click.command(short_help="Find the values of a machine's parameters from measurements.")
@search_options
def command(**given: Any) -> None:
    """Find the values of the parameters of STUDY with which the machine moves as it was measured, by least squares.

    The study names the measurements with `identify: {data: FILE.csv}`. The data file and the report have every variant that was
    computed, and the covariance of what was found. The machine that was found is run once more, with a second run beside it, to
    say how exact it is.

    Exit codes: 0 all parameters were found, 2 fault in the input, 3 the measurements do not tell some of them apart, or runs fail.
    """
    kind = Kind(
        lambda study, **options: study.identify(**options),
        facts=_facts,
        say=_say,
        is_found=lambda found: not found.undetermined,
    )
    make_search(Given(**given), kind)


def _facts(found: Identified) -> dict[str, Any]:
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


def _say(found: Identified) -> None:
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
