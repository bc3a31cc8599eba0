"""`nivel replay RECORDING`: a live run again, exactly, or by other methods."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from nivel.cli.failures import COMPUTATION_FAILED
from nivel.cli.options import file_argument, quiet_option, simulation_options
from nivel.cli.progress import progress_listener


@click.command(short_help="Repeat a recorded live run exactly, or by other methods.")
@file_argument("recording")
@simulation_options
@click.option("--take", type=click.IntRange(1), help="Which motion of the recording, from 1; default: the longest.")
@click.option(
    "--out", type=click.Path(dir_okay=False), help="Result file; default: the machine's name with .replay.nc, here."
)
@click.option("--force", is_flag=True, help="Replace an existing result.")
@quiet_option
def command(
    recording: str, take: int | None, out: str | None, force: bool, quiet: bool, settings: dict[str, Any]
) -> None:
    """Repeat the RECORDING of `nivel live --record` and write a result.

    Without further options it is done tick by tick as it was, and every frame is compared with the recorded one: exit code 3 says that they
    are not equal to the last bit. With other methods, a step or a tolerance the same inputs are simulated again;
    `nivel view one.nc other.nc` lays the results over each other.
    """
    from nivel.errors import ModelError
    from nivel.live.recorder import read_recording
    from nivel.live.replay import replay, rerun
    from nivel.results.target import check_target

    stored = read_recording(recording)
    if not stored.takes:
        raise ModelError(f"{recording} has no motion: the machine was never run")
    if take is not None and take > len(stored.takes):
        raise ModelError(f"{recording} has {len(stored.takes)} takes; there is no take {take}")
    chosen = max(stored.takes, key=lambda each: each.ticks) if take is None else stored.takes[take - 1]
    target = Path(out) if out is not None else Path(f"{stored.machine.name}.replay.nc")
    check_target(target, "result file", force=force, sources=[Path(recording)])
    say = (lambda text: None) if quiet else (lambda text: click.echo(text, err=True))
    length = f"{chosen.ticks} ticks, {chosen.ticks * stored.pace.tick:.6g} s"
    with progress_listener(quiet) as listener:
        if settings:
            rerun(stored, chosen, settings, out=target, force=force, listener=listener)
            say(f"{stored.machine.name}: {length} again by other methods\nresult: {target}")
            return
        done = replay(stored, chosen, out=target, force=force, listener=listener)
    if done.is_identical and chosen.whole:
        say(f"{stored.machine.name}: {length}; all {done.compared} frames equal the recorded ones to the last bit")
    elif done.is_identical:
        say(
            f"{stored.machine.name}: {length}; {done.compared} frames equal the recorded ones, others were not recorded"
        )
    else:
        say(
            f"{stored.machine.name}: {length}; {done.different} frames differ from the recorded ones, the first at t = {done.first:.6g} s: "
            "another processor, another version of nivel, or ticks that were not recorded"
        )
    say(f"result: {target}")
    if not (done.is_identical and chosen.whole):
        raise SystemExit(COMPUTATION_FAILED)
