"""`nivel explain RESULT`: how far a result can be trusted, and why."""

import click

from nivel.cli.options import file_argument, json_option
from nivel.cli.progress import COLOURS
from nivel.known import Result
from nivel.lazy import nivel, rich

SIGNS = {"green": "✓", "amber": "!", "red": "✕"}


@click.command()
@file_argument("result")
@json_option
def command(result: str, as_json: bool) -> None:
    """Print the trust report of RESULT: every number, its threshold, and the reason for the threshold.

    The run of RESULT may still be going on, or may have been killed.
    """
    opened = nivel.results.Result.open(result)
    if as_json:
        click.echo(opened.trust.to_json())
    else:
        _print(opened)


def _print(result: Result) -> None:
    console, text = rich.console.Console(highlight=False), rich.text.Text
    trust, time = result.trust, result.time
    frames = f"{len(time)} frame{'s' * (len(time) != 1)}"
    extent = f"{time[0]:.6g} to {time[-1]:.6g} s, {frames}" if len(time) > 1 else frames
    console.print(text.assemble((result.name, "bold"), f": {extent}"))
    light = (trust.light, f"bold {COLOURS[trust.light]}") if trust.light in COLOURS else ""
    console.print(text.assemble("trust: ", light, f"{', ' if light else ''}{trust.headline}", "\n"))
    lines = rich.table.Table.grid(padding=(0, 1))
    for item in trust.items:
        lines.add_row(text(f"{SIGNS[item.verdict]} {item.verdict}", COLOURS[item.verdict]), text(item.text))
    console.print(lines)
    if result.advice:
        console.print(text(f"\n{result.advice}"))
    reasons = rich.table.Table.grid(padding=(0, 2))
    for name, threshold in nivel.judge.after.report.thresholds_of(result).items():
        reasons.add_row(text(f"{name.replace('_', ' ')}\n{threshold}", "dim"), text(threshold.reason, "dim"))
    for name, rule in nivel.results.scales.RULES.items():
        reasons.add_row(text(name.replace("_", " "), "dim"), text(f"{rule[:1].upper()}{rule[1:]}.", "dim"))
    reasons.columns[0].max_width = 24
    console.print(text("\nwhy these thresholds", "dim bold"))
    console.print(reasons)
