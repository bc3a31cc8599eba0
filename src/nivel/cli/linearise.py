"""`nivel linearise MACHINE`: eigenvalues, modes and the linear model about a state; data, a page, a summary."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import click

from nivel.cli.options import allow_code_option, file_argument, override_option, quiet_option, separated
from nivel.cli.progress import progress_listener
from nivel.cli.run import beside, refuse_to_replace

if TYPE_CHECKING:
    from nivel.results.linear_model import LinearModel

SHOWN = 20  # modes in the terminal


@click.command(short_help="Eigenvalues, modes and the linear model about a state.")
@file_argument("machine")
@click.option("--about", metavar="STATE", help="start, equilibrium, or a time to which the machine is run, e.g. '2 s'.")
@click.option(
    "--inputs",
    metavar="NAMES",
    multiple=True,
    callback=separated,
    help="Default: motors and drivers. E.g. hinge.angle.",
)
@click.option(
    "--outputs", metavar="NAMES", multiple=True, callback=separated, help="Default: sensors, or all joint coordinates."
)
@click.option("--coordinates", metavar="NAME", help="What the equations are written in: auto, absolute, relative.")
@override_option
@allow_code_option
@click.option(
    "--out", metavar="FILE.nc", type=click.Path(), help="Matrices and eigenvalues. Default: NAME-linear.nc, here."
)
@click.option("--mode", "shown", type=int, multiple=True, metavar="N", help="Also write mode N as a page to be played.")
@click.option("--force", is_flag=True, help="Replace existing files.")
@click.option("--no-report", is_flag=True, help="Write no HTML page.")
@quiet_option
@click.option("--json", "as_json", is_flag=True, help="Print the summary as JSON on standard output.")
def command(
    machine: str,
    about: str | None,
    inputs: tuple[str, ...] | None,
    outputs: tuple[str, ...] | None,
    coordinates: str | None,
    overrides: dict[str, str],
    allow_code: bool,
    out: str | None,
    shown: tuple[int, ...],
    force: bool,
    no_report: bool,
    quiet: bool,
    as_json: bool,
) -> None:
    """Make the equations of motion of MACHINE linear about a state: natural frequencies, damping and modes of small motions, and the
    state-space model between inputs and outputs.

    Exit code 0 done, 2 the input is at fault, 3 the computation failed, 130 interrupted.
    """
    from nivel.api import load
    from nivel.results.target import check_target

    loaded = load(machine, overrides, allow_code=allow_code)
    target = Path(out) if out is not None else Path(f"{loaded.name}-linear.nc")
    report = None if no_report else beside(target)
    refuse_to_replace(report, target, force, Path(machine))
    pages = {number: target.with_name(f"{target.stem}-mode-{number}.html") for number in shown}
    for page in pages.values():
        check_target(page, "page", force=force, sources=[Path(machine)])
    with progress_listener(quiet) as listener:
        model = loaded.linearise(
            about=about, inputs=inputs, outputs=outputs, coordinates=coordinates, listener=listener
        )
        model.save(target, force=force)
        if report is not None:
            model.report(report)
        for number, page in pages.items():
            model.mode(number).export_scene(page)
    if as_json:
        click.echo(json.dumps(model.summary(), indent=2))
    if not quiet:
        _say(model, target, report)


def _say(model: LinearModel, target: Path, report: Path | None) -> None:
    from rich.console import Console

    from nivel.results.linear_model import mode_in_words

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
