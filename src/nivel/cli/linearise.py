"""`nivel linearise MACHINE`: eigenvalues, modes and the linear model about a state; data, a page, a summary."""

from pathlib import Path
from typing import Any

import click

from nivel.cli.analysis_command import Order, analysis_command
from nivel.cli.options import listed
from nivel.errors import Fault, ModelError
from nivel.known import LinearModel, LinearSweep, Listener, MachineRecord
from nivel.lazy import nivel, replace
from nivel.settings import LineariseSettingsDict

SHOWN = 20  # modes in the terminal
MOST = 1000  # values of a parameter


@analysis_command(LineariseSettingsDict, "NAME-linear.nc")
@click.option(
    "--over",
    metavar="PATH=FROM:TO:COUNT UNIT",
    help="Eigenvalues as functions of a number in the file, e.g. parameters.rope='1:8:15 m'.",
)
@listed("--orders", "orders", "NUMBERS", "Campbell diagram: multiples of the rotational speed that --over varies.")
@click.option(
    "--verify", "with_others", is_flag=True, help="With --over: also vibrations with other elements of beams."
)
@click.option(
    "--psd",
    multiple=True,
    metavar="INPUT=LEVEL|FILE",
    help="Response to random vibration: one-sided power spectral density of an input, a level ('0.01 N^2/Hz': white noise) or a table "
    "(CSV) with a column `frequency [Hz]`. May be repeated.",
)
@click.option(
    "--tune",
    metavar="BLOCK=PHASE,GAIN",
    multiple=True,
    help="Gains of a sampled PID with the largest ki of this phase margin in degrees and gain margin, e.g. position=60,2.",
)
@click.option("--mode", "shown", type=int, multiple=True, metavar="N", help="Also write an animation of mode N.")
def command(
    order: Order,
    over: str | None,
    orders: tuple[str, ...] | None,
    with_others: bool,
    psd: tuple[str, ...],
    tune: tuple[str, ...],
    shown: tuple[int, ...],
) -> None:
    """Linearise the equations of motion of MACHINE about a state.

    Computes natural frequencies, damping and modes of small motions, and the state-space model between inputs and outputs.

    Exit codes: 0 done, 2 fault in the input, 3 the computation failed, 130 interrupted.
    """
    if over is not None:
        if tune:
            raise ModelError(Fault.at("linearise.tune", "is of one model, and --over makes many"))
        if psd:
            raise ModelError(Fault.at("linearise.psd", "is of one model, and --over makes many"))
        if with_others and "verify" in order.settings:
            raise ModelError(Fault.at("linearise.verify", "--verify and --no-verify contradict each other"))
        _sweep(order, over, read_orders(orders), verify=with_others)
        return
    if with_others:
        raise ModelError(Fault.at("linearise.verify", "belongs to --over; without it models are verified"))
    if orders is not None:
        raise ModelError(Fault.at("linearise.orders", "belongs to --over, and no parameter is given"))
    spectra = {name: level for name, _, level in (each.partition("=") for each in psd)}
    if faulty := [name for name, level in spectra.items() if not level.strip()]:
        said = f"an input and its level or table were expected, as `{faulty[0] or 'floor'}=0.01`"
        raise ModelError(Fault.at("linearise.psd", said))
    machine = order.load()
    name = f"{machine.name}-linear.nc"
    target, _ = order.files(name)
    pages = {number: target.with_name(f"{target.stem}-mode-{number}.html") for number in shown}
    for page in pages.values():
        nivel.files.target.check_target(page, "page", force=order.force, sources=[Path(order.machine)])

    def compute(listener: Listener) -> LinearModel:
        settings = {"inputs": tuple(spectra), **order.settings} if spectra else order.settings
        model = machine.linearise(**settings, listener=listener)
        if spectra:
            model = replace(model, random=model.random_response(spectra))
        for number, page in pages.items():
            model.mode(number).export_scene(page)
        return model

    def lines(model: LinearModel) -> list[str]:
        return [*_said(model), *(_tuned(machine.record, model, each) for each in tune)]

    order.keep(name, compute, lines)


def _tuned(record: MachineRecord, model: LinearModel, asked: str) -> str:
    """Gains of a controller in words. asked : BLOCK=PHASE,GAIN. Raises ModelError."""
    name, _, margins = asked.partition("=")
    try:
        phase, gain = map(float, (margins or "60,2").split(","))
    except ValueError:
        said = f"`{asked}` is not of the form BLOCK=PHASE,GAIN, e.g. position=60,2: degrees, and a factor"
        raise ModelError(Fault.at("linearise.tune", said)) from None
    return nivel.analysis.linearise.sampled.tuned(record, model.sampled, name.strip(), phase, gain).words


def _sweep(order: Order, over: str, orders: list[float], *, verify: bool) -> None:
    """Eigenvalues over a parameter. verify : each model, though they are many."""
    path, values, unit = read_range(over)
    if orders:
        nivel.results.analyses.linear_sweep.speed_of(unit, path)
    name = order.load().name
    settings: dict[str, Any] = {**order.settings, "verify": verify}

    def compute(listener: Listener) -> LinearSweep:
        models = [
            order.load({path: f"{value!r} {unit}".strip()}).linearise(**settings, listener=listener) for value in values
        ]
        return nivel.analysis.linearise.linearise.over(path, unit, values, models)

    def said(sweep: LinearSweep) -> list[str]:
        return [
            f"{name}: eigenvalues at {len(values)} values of {path}",
            *sweep.statements(),
            *(each.words(unit) for each in sweep.crossings(orders)),
            f"trust: {sweep.trust.told}",
        ]

    order.keep(f"{name}-sweep.nc", compute, said, orders)


def read_range(text: str) -> tuple[str, list[float], str]:
    """Path, values and unit of `PATH=FROM:TO:COUNT UNIT`. Raises ModelError."""
    path, _, rest = text.partition("=")
    numbers, _, unit = rest.strip().partition(" ")
    parts = numbers.split(":")
    try:
        low, high, count = float(parts[0]), float(parts[1]), int(parts[2])
    except (ValueError, IndexError):
        low, high, count = 0.0, 0.0, 0
    if not path.strip() or len(parts) != 3 or not low < high or not 2 <= count <= MOST:
        said = f"`{text}` is not of the form PATH=FROM:TO:COUNT UNIT, e.g. parameters.rope='1:8:15 m'; FROM < TO, COUNT from 2 to {MOST}"
        raise ModelError(Fault.at("linearise.over", said))
    return path.strip(), [low + (high - low) * k / (count - 1) for k in range(count)], unit.strip()


def read_orders(words: tuple[str, ...] | None) -> list[float]:
    """Multiples of a speed. Raises ModelError."""
    try:
        return [float(word) for word in words or ()]
    except ValueError:
        raise ModelError(Fault.at("linearise.orders", f"numbers were expected, got {', '.join(words or ())}")) from None


def _said(model: LinearModel) -> list[str]:
    judged = ("stable" if model.stable else "unstable") if model.steady else "not judged"
    modes = model.modes if model.steady else ()
    poles = model.sampled.modes if model.sampled is not None else ()
    rms = (
        zip(model.outputs, model.random.rms.values, model.output_units, strict=True) if model.random is not None else ()
    )
    return [
        f"{model.name}: linear about {model.about}, {len(model.states)} states, {judged}",
        *model.notes,
        *(f"mode {mode.number}: {nivel.results.analyses.linear_model.mode_in_words(mode)}" for mode in modes[:SHOWN]),
        *([f"and {len(modes) - SHOWN} more in the data"] if len(modes) > SHOWN else []),
        *(f"rms of {name}: {value:.6g} {units}" for name, value, units in rms),
        *(model.sampled.words if model.sampled is not None else ()),
        *(f"pole {pole.number}: {pole.words}" for pole in poles[:SHOWN]),
        f"trust: {model.trust.told}",
    ]
