"""`nivel linearise MACHINE`: eigenvalues, modes and the linear model about a state; data, a page, a summary."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from nivel.cli.options import (
    allow_code_option,
    file_argument,
    force_option,
    json_option,
    no_report_option,
    override_option,
    quiet_option,
    separated,
)
from nivel.cli.progress import progress_listener
from nivel.cli.run import beside, refuse_to_replace

if TYPE_CHECKING:
    from nivel.results.analyses.linear_model import LinearModel

SHOWN = 20  # modes in the terminal
MOST = 1000  # values of a parameter


@click.command(short_help="Eigenvalues, modes and the linear model about a state.")
@file_argument("machine")
@click.option(
    "--about",
    metavar="STATE",
    help="State to linearise about: start, equilibrium, or a time up to which the machine is simulated, e.g. '2 s'.",
)
@click.option(
    "--inputs",
    metavar="NAMES",
    multiple=True,
    callback=separated,
    help="Inputs, e.g. hinge.angle; default: motors and drivers.",
)
@click.option(
    "--outputs",
    metavar="NAMES",
    multiple=True,
    callback=separated,
    help="Outputs; default: sensors, or all joint coordinates.",
)
@click.option("--coordinates", metavar="NAME", help="Coordinates of the equations: auto, absolute, relative.")
@click.option(
    "--over",
    metavar="PATH=FROM:TO:COUNT UNIT",
    help="Eigenvalues as functions of a number in the file, e.g. parameters.rope='1:8:15 m'.",
)
@click.option(
    "--orders",
    metavar="NUMBERS",
    multiple=True,
    callback=separated,
    help="Campbell diagram: multiples of the rotational speed that --over varies.",
)
@override_option
@allow_code_option
@click.option(
    "-o",
    "--out",
    metavar="FILE.nc",
    type=click.Path(),
    help="Result file; default: NAME-linear.nc in the working directory.",
)
@click.option("--mode", "shown", type=int, multiple=True, metavar="N", help="Also write an animation of mode N.")
@force_option
@no_report_option
@quiet_option
@json_option
def command(
    machine: str,
    about: str | None,
    inputs: tuple[str, ...] | None,
    outputs: tuple[str, ...] | None,
    coordinates: str | None,
    over: str | None,
    orders: tuple[str, ...] | None,
    overrides: dict[str, str],
    allow_code: bool,
    out: str | None,
    shown: tuple[int, ...],
    force: bool,
    no_report: bool,
    quiet: bool,
    as_json: bool,
) -> None:
    """Linearise the equations of motion of MACHINE about a state.

    Computes natural frequencies, damping and modes of small motions, and the state-space model between inputs and outputs.

    Exit codes: 0 done, 2 fault in the input, 3 the computation failed, 130 interrupted.
    """
    from nivel.api import load
    from nivel.errors import Fault, ModelError
    from nivel.files.target import check_target

    asked = {"about": about, "inputs": inputs, "outputs": outputs, "coordinates": coordinates}
    if over is not None:
        _sweep(machine, overrides, allow_code, (over, orders), asked, out, force, no_report, quiet, as_json)
        return
    if orders is not None:
        raise ModelError(Fault("", 0, 0, "linearise.orders", "belongs to --over, and no parameter is given"))
    loaded = load(machine, overrides, allow_code=allow_code)
    target = Path(out) if out is not None else Path(f"{loaded.name}-linear.nc")
    report = None if no_report else beside(target)
    refuse_to_replace(report, target, force, Path(machine))
    pages = {number: target.with_name(f"{target.stem}-mode-{number}.html") for number in shown}
    for page in pages.values():
        check_target(page, "page", force=force, sources=[Path(machine)])
    with progress_listener(quiet) as listener:
        model = loaded.linearise(**asked, listener=listener)
        model.save(target, force=force)
        if report is not None:
            model.report(report)
        for number, page in pages.items():
            model.mode(number).export_scene(page)
    if as_json:
        click.echo(json.dumps(model.summary(), indent=2))
    if not quiet:
        _say(model, target, report)


def _sweep(
    machine: str,
    overrides: dict[str, str],
    allow_code: bool,
    wanted: tuple[str, tuple[str, ...] | None],
    asked: dict[str, Any],
    out: str | None,
    force: bool,
    no_report: bool,
    quiet: bool,
    as_json: bool,
) -> None:
    """Eigenvalues over a parameter."""
    import numpy as np

    from nivel.api import load
    from nivel.results.analyses.linear_sweep import LinearSweep

    path, values, unit = read_range(wanted[0])
    orders = read_orders(wanted[1])
    name = load(machine, overrides, allow_code=allow_code).name
    target = Path(out) if out is not None else Path(f"{name}-sweep.nc")
    report = None if no_report else beside(target)
    refuse_to_replace(report, target, force, Path(machine))
    models = []
    with progress_listener(quiet) as listener:
        for value in values:
            text = f"{value!r} {unit}".strip()
            models.append(
                load(machine, {**overrides, path: text}, allow_code=allow_code).linearise(**asked, listener=listener)
            )
        sweep = LinearSweep(path, unit, np.array(values), tuple(models))
        sweep.save(target, force=force)
        if report is not None:
            sweep.report(report, orders)
    if as_json:
        click.echo(json.dumps(sweep.summary(), indent=2))
    if not quiet:
        lines = [f"{name}: eigenvalues at {len(values)} values of {path}", *sweep.statements()]
        lines += [
            f"mode {each.mode} has {each.order:g} times the speed at {each.value:.6g}, {each.frequency:.6g} Hz"
            for each in sweep.crossings(orders)
        ]
        lines += [f"data: {target}"] + ([f"report: {report}"] if report is not None else [])
        click.echo("\n".join(lines), err=True)


def read_range(text: str) -> tuple[str, list[float], str]:
    """Path, values and unit of `PATH=FROM:TO:COUNT UNIT`. Raises ModelError."""
    from nivel.errors import Fault, ModelError

    path, _, rest = text.partition("=")
    numbers, _, unit = rest.strip().partition(" ")
    parts = numbers.split(":")
    try:
        low, high, count = float(parts[0]), float(parts[1]), int(parts[2])
    except (ValueError, IndexError):
        low, high, count = 0.0, 0.0, 0
    if not path.strip() or len(parts) != 3 or not low < high or not 2 <= count <= MOST:
        said = f"`{text}` is not of the form PATH=FROM:TO:COUNT UNIT, e.g. parameters.rope='1:8:15 m'; FROM < TO, COUNT from 2 to {MOST}"
        raise ModelError(Fault("", 0, 0, "linearise.over", said))
    return path.strip(), [low + (high - low) * k / (count - 1) for k in range(count)], unit.strip()


def read_orders(words: tuple[str, ...] | None) -> list[float]:
    """Multiples of a speed. Raises ModelError."""
    from nivel.errors import Fault, ModelError

    try:
        return [float(word) for word in words or ()]
    except ValueError:
        raise ModelError(
            Fault("", 0, 0, "linearise.orders", f"numbers were expected, got {', '.join(words or ())}")
        ) from None


def _say(model: LinearModel, target: Path, report: Path | None) -> None:
    from rich.console import Console

    from nivel.results.analyses.linear_model import mode_in_words

    console = Console(stderr=True, highlight=False, soft_wrap=True, markup=False)
    judged = ("stable" if model.stable else "unstable") if model.steady else "not judged"
    console.print(f"{model.name}: linear about {model.about}, {len(model.states)} states, {judged}")
    for text in model.notes:
        console.print(text)
    modes = model.modes if model.steady else ()
    for mode in modes[:SHOWN]:
        console.print(f"mode {mode.number}: {mode_in_words(mode)}")
    if len(modes) > SHOWN:
        console.print(f"and {len(modes) - SHOWN} more in the data")
    console.print(f"data: {target}" + (f"\nreport: {report}" if report is not None else ""))
