"""`nivel explain RESULT`: how far a result can be trusted, and why."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from nivel.cli.options import file_argument, json_option

if TYPE_CHECKING:
    from nivel.results import Result

COLOURS = {"green": "green", "amber": "yellow", "red": "red"}
SIGNS = {"green": "✓", "amber": "!", "red": "✕"}


@click.command(short_help="Show how far a result can be trusted, and why.")
@file_argument("result")
@json_option
def command(result: str, as_json: bool) -> None:
    """Print the trust report of RESULT: every number, its threshold, and the reason for the threshold.

    The run of RESULT may still be going on, or may have been killed.
    """
    from nivel.results import Result

    opened = Result.open(result)
    if as_json:
        click.echo(opened.trust.to_json())
    else:
        _print(opened)


def _print(result: Result) -> None:
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    from nivel.judge.after.report import thresholds_of
    from nivel.results.scales import RULES

    console, trust = Console(highlight=False), result.trust
    time = result.time
    frames = f"{len(time)} frame{'s' * (len(time) != 1)}"
    extent = f"{time[0]:.6g} to {time[-1]:.6g} s, {frames}" if len(time) > 1 else frames
    console.print(Text.assemble((result.name, "bold"), f": {extent}"))
    light = (trust.light, f"bold {COLOURS[trust.light]}") if trust.light in COLOURS else ""
    console.print(Text.assemble("trust: ", light, f"{', ' if light else ''}{trust.headline}", "\n"))
    lines = Table.grid(padding=(0, 1))
    for item in trust.items:
        lines.add_row(Text(f"{SIGNS[item.verdict]} {item.verdict}", COLOURS[item.verdict]), Text(item.text))
    console.print(lines)
    if result.advice:
        console.print(Text(f"\n{result.advice}"))
    reasons = Table.grid(padding=(0, 2))
    for name, threshold in thresholds_of(result).items():
        reasons.add_row(Text(f"{name.replace('_', ' ')}\n{threshold}", "dim"), Text(threshold.reason, "dim"))
    for name, rule in RULES.items():
        reasons.add_row(Text(name.replace("_", " "), "dim"), Text(f"{rule[:1].upper()}{rule[1:]}.", "dim"))
    reasons.columns[0].max_width = 24
    console.print(Text("\nwhy these thresholds", "dim bold"))
    console.print(reasons)
