"""`nivel optimise STUDY`: the values of its parameters with which an output is least, within limits of others."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from nivel.cli.search_command import Given, Kind, make_search, numbers_table, search_options

if TYPE_CHECKING:
    from nivel.analysis.optimise.optimise import Optimum


@click.command(short_help="Find the best values of a machine's parameters.")
@search_options
def command(**given: Any) -> None:
    """Find the values of the parameters of STUDY with which one of its outputs is least, within the limits of the others.

    The study says so with `optimise: {output: NAME}`. The data file and the report have every variant that was computed. The best
    machine is run once more, with a second run beside it, to say how exact it is.

    Exit codes: 0 a best one within all limits was found, 2 fault in the input, 3 no values keep all limits, or runs fail.
    """
    kind = Kind(
        lambda study, **options: study.optimise(**options),
        facts=_facts,
        say=_say,
        is_found=lambda found: found.kept,
    )
    make_search(Given(**given), kind)


def _facts(found: Optimum) -> dict[str, Any]:
    return {
        "values": dict(found.values),
        "outputs": dict(found.outputs),
        "kept": found.kept,
        "reached": found.reached.tolist(),
        "evaluations": found.evaluations,
        "message": found.message,
    }


def _say(found: Optimum) -> None:
    rows = [*((path, value, "parameter") for path, value in found.values.items())]
    rows += [(name, value, "output") for name, value in found.outputs.items() if name != "objective"]
    numbers_table(("name", "value", ""), [(name, f"{value:.6g}", what) for name, value, what in rows])
    kept = "all limits are kept" if found.kept else "NOT ALL LIMITS ARE KEPT"
    click.echo(f"{kept}; {found.message}", err=True)
