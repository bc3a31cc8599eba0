"""Facts of a result: `nivel explain`, how far it can be trusted; `nivel loads`, peaks, power and work, rainflow cycles of signals."""

from __future__ import annotations

import json
from typing import Any

import click

from nivel.cli.options import fatigue_option, file_argument, json_option, listed
from nivel.cli.progress import COLOURS
from nivel.errors import Fault, ModelError
from nivel.known import Result
from nivel.lazy import nivel, rich, xarray

SIGNS = {"green": "✓", "amber": "!", "red": "✕"}


@click.command()
@file_argument("result")
@json_option
def explain(result: str, as_json: bool) -> None:
    """Print the trust report of RESULT: every number, its threshold, and the reason for the threshold.

    The run of RESULT may still be going on, or may have been killed.
    """
    opened = nivel.results.Result.open(result)
    if as_json:
        click.echo(opened.trust.to_json())
    else:
        _print_trust(opened)


def _print_trust(result: Result) -> None:
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


@click.command()
@file_argument("result")
@listed("--cycles", "signals", "NAMES", "Count rainflow cycles of signals, e.g. pin.force.x.")
@fatigue_option
@click.option("--repeating", is_flag=True, help="The history is periodic: count no half cycles.")
@click.option(
    "--period",
    metavar="TIME",
    help="Period of the machine, e.g. '0.5 s': also print the work in the last whole period.",
)
@json_option
def loads(
    result: str,
    signals: tuple[str, ...] | None,
    fatigue: dict[str, str],
    repeating: bool,
    period: str | None,
    as_json: bool,
) -> None:
    """Print the loads of RESULT: peak and RMS reactions of every joint, and power and work of drivers and forces.

    With --cycles, also count the rainflow cycles of signals (ASTM E1049).
    """
    for option, given in (("repeating", repeating), ("fatigue", fatigue)):
        if given and not signals:
            message = "belongs to --cycles: name a signal, e.g. --cycles pin.force.x"
            raise ModelError(Fault.at(f"loads.{option}", message))
    opened = nivel.results.Result.open(result)
    tables = _tables(opened, signals or (), repeating, period, fatigue or None)
    if as_json:
        plain = {name: _plain(table) for name, table in tables.items()}
        click.echo(json.dumps({**plain, "trust": {name: _trust(table) for name, table in tables.items()}}, indent=2))
        return
    for name, table in tables.items():
        _print(name, table)


def _tables(
    result: Result, signals: tuple[str, ...], repeating: bool, period: str | None, fatigue: dict[str, str] | None
) -> dict[str, xarray.Dataset]:
    """Tables by their titles. Raises ModelError where there is nothing to show."""
    out: dict[str, xarray.Dataset] = {}
    if "joint_force" in result.variables and result.coordinates.get("joint"):
        out["reactions"] = result.reactions()
    if period is not None or any(name.endswith(".power") for name in result.variables):
        out["power and work"] = result.powers(period=period)
    for name in signals:
        out[f"cycles of {name}"] = result.cycles(name, repeating=repeating, fatigue=fatigue)
    if not out:
        raise ModelError("the result has neither reactions of joints nor power of drivers or forces")
    return out


def _trust(table: xarray.Dataset) -> dict[str, Any]:
    return {name: table.attrs[name] for name in ("verdict", "verified", "headline")}


def _plain(table: xarray.Dataset) -> dict[str, Any]:
    return {str(name): values.to_numpy().tolist() for name, values in {**table.coords, **table.data_vars}.items()}


def _print(title: str, table: xarray.Dataset) -> None:
    names = [str(name) for name in table.data_vars]
    shown = rich.table.Table(title=rich.text.Text(title), title_justify="left")
    rows = next(iter(table.sizes.values()))
    labels = [str(each) for each in next(iter(table.coords.values())).to_numpy()] if table.coords else []
    for heading in [*(["of"] if labels else []), *(_heading(table, name) for name in names)]:
        shown.add_column(rich.text.Text(heading), justify="left" if heading == "of" else "right")
    for k in range(rows):
        shown.add_row(*labels[k : k + 1], *(f"{float(table[name].to_numpy()[k]):.6g}" for name in names))
    console = rich.console.Console(highlight=False, width=140)
    console.print(shown)
    if "damage" in table.attrs:
        console.print(rich.text.Text(f"damage: {table.attrs['damage']:.6g} (failure at 1)"), soft_wrap=True)
    console.print(
        rich.text.Text(f"trust: {nivel.results.trust.told(table.attrs['verdict'], table.attrs['headline'])}"),
        soft_wrap=True,
    )


def _heading(table: xarray.Dataset, name: str) -> str:
    unit = table[name].attrs.get("units", "")
    return name.replace("_", " ") + (f" [{unit}]" if unit not in ("", "1") else "")
