"""`nivel budget MACHINE`: what a step costs in real time, without running live. `nivel warmup`: compile everything ahead of the first
run."""

import time
from collections.abc import Iterator
from math import isnan
from typing import Any

import click

from nivel.cli import options
from nivel.cli.options import quiet_option
from nivel.cli.progress import progress_count
from nivel.errors import Fault, ModelError
from nivel.known import Cost
from nivel.lazy import nivel, rich
from nivel.settings import StepSettingsDict


@click.command()
@quiet_option
def warmup(quiet: bool) -> None:
    """Compile every formulation, integrator and type of force into the user's cache, on all processors.

    Entries that are compiled already are kept. After an interruption, the next call continues.
    """
    console = rich.console.Console(stderr=True, highlight=False, quiet=quiet)
    begin = time.perf_counter()
    entries = nivel.analysis.plan.compilation.all_entries()
    missing = nivel.native.library.missing(entries)
    with progress_count("compiling", quiet) as tell:
        names: list[str] = []

        def done(name: str) -> None:
            names.append(name)
            tell(len(names), len(missing), name)

        nivel.native.library.build(missing, done)
    spent = time.perf_counter() - begin
    console.print(
        f"{len(missing)} of {len(entries)} entries compiled in {spent:.1f} s; cache: {nivel.native.store.folder()}",
        soft_wrap=True,
    )


@click.command()
@options.file_argument("machine")
@options.override_option
@options.allow_code_option
@options.setting_options(StepSettingsDict, "step", "formulation", "coordinates", "stabilisation")
@options.tick_option
@options.listed(
    "--integrators",
    "integrators",
    "NAMES",
    "Methods to compare; default: that of the file and all that need no compilation.",
)
@options.quiet_option
def budget(
    machine: str,
    overrides: dict[str, str],
    allow_code: bool,
    tick: float | None,
    integrators: tuple[str, ...] | None,
    quiet: bool,
    settings: dict[str, Any],
) -> None:
    """Measure the computing time of a tick of live operation.

    MACHINE is simulated for some seconds as fast as possible while its inputs are moved to and fro. Then inputs are held at their ends,
    each alone and all together, until the machine stands still. The default methods have fixed steps: that of the machine file, and all
    others that need no compilation.

    The column `held` is the time of a tick (99.9 %) with those inputs held for which it is longest. The last column is the largest
    distance of a body, at the end, from a run by the method of the file with half the step.
    """
    for name in integrators or ():
        if name not in nivel.live.budget.fixed_methods():
            known = nivel.live.budget.fixed_methods()
            message = nivel.machine.core.record.unknown_word(name, known, "integrator")
            raise ModelError(Fault.at("integrators", message))
    record = nivel.api.load(machine, overrides, allow_code=allow_code).record
    own = record.simulation.integrator
    with nivel.cli.progress.progress_listener(quiet) as listener:
        if integrators:
            found = list(
                nivel.live.budget.costs(record, settings, tick, integrators, compiled_only=False, listener=listener)
            )
        else:
            others = [name for name in nivel.live.budget.fixed_methods() if name != own]
            found = list(nivel.live.budget.costs(record, settings, tick, [own], compiled_only=False, listener=listener))
            found += nivel.live.budget.costs(record, settings, tick, others, compiled_only=True, listener=listener)
    click.echo(
        f"{record.name}: computing time of a tick in µs\n{'':22}     50 %   99.9 %  longest     held  would hold   off by"
    )
    for cost in found:
        click.echo(_line(cost))
    first = found[0]
    if first.timing is not None:
        sentence = nivel.live.timing.in_a_sentence(
            record.name, first.integrator, first.timing, first.parts, first.rate_held
        )
        click.echo(f"\n{sentence}")
    for line in _held(first):
        click.echo(line)


def _held(cost: Cost) -> Iterator[str]:
    """With which inputs at their ends ticks are dearest, and with which the run ends."""
    worst = cost.worst
    if worst is None:
        return
    tried = f"{len(cost.held)} of {cost.combinations}" if len(cost.held) < cost.combinations else f"{cost.combinations}"
    yield (
        f"inputs held at their ends ({tried} combinations): dearest with {worst}, {1e6 * worst.cost:.0f} µs a tick (99.9 %), "
        f"longest {1e6 * worst.timing.computing[4]:.0f} µs"
    )
    for each in cost.held:
        if not isnan(each.ended):
            yield f"  with {each} the run ends at {each.ended:.4g} s"


def _line(cost: Cost) -> str:
    timing = cost.timing
    if timing is None:
        return f"{cost.integrator:22} {cost.note}"
    middle, high, longest = (1e6 * timing.computing[k] for k in (0, 3, 4))
    holds, worst = f"{cost.rate_held / 1e3:.3g} kHz", cost.worst
    held = "" if worst is None else f"{1e6 * worst.cost:.1f}"
    off = cost.note or ("" if isnan(cost.off) else f"{cost.off:.2g} m")
    return f"{cost.integrator:22}{middle:9.1f}{high:9.1f}{longest:9.1f}{held:>9}  {holds:10}   {off}"
