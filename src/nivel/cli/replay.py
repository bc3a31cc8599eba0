"""`nivel replay RECORDING`: a live run again, exactly, or by other methods."""

from pathlib import Path
from typing import Any

import click

from nivel.cli.failures import COMPUTATION_FAILED
from nivel.cli.options import allow_code_option, file_argument, force_option, out_option, quiet_option, setting_options
from nivel.cli.progress import progress_listener
from nivel.errors import ModelError
from nivel.known import Replay, Result
from nivel.lazy import nivel
from nivel.settings import RunSettingsDict


@click.command()
@file_argument("recording")
@setting_options(RunSettingsDict)
@click.option(
    "--take", type=click.IntRange(1), help="Number of the take in the recording, from 1; default: the longest take."
)
@out_option("Result file", "NAME.replay.nc", None)
@force_option
@allow_code_option
@quiet_option
def command(
    recording: str,
    take: int | None,
    out: Path | None,
    force: bool,
    allow_code: bool,
    quiet: bool,
    settings: dict[str, Any],
) -> None:
    """Repeat the RECORDING of `nivel live --record` and write a result.

    Without further options the run is repeated tick by tick, and every frame is compared with the recorded one. Exit code 3: they are
    not equal to the last bit.

    With another method, step or tolerance the same inputs are simulated again. `nivel view one.nc other.nc` shows both results together.
    """
    stored = nivel.live.recording.read_recording(recording)
    if stored.has_code and not allow_code:
        raise ModelError(
            f"{recording} holds functions in Python, which run with your rights; if you trust who recorded it, add --allow-code"
        )
    if not stored.takes:
        raise ModelError(f"{recording} has no motion: the machine was never run")
    if take is not None and take > len(stored.takes):
        raise ModelError(
            f"{recording} has {len(stored.takes)} take{'s'[: len(stored.takes) != 1]}; there is no take {take}"
        )
    chosen = max(stored.takes, key=lambda each: each.ticks) if take is None else stored.takes[take - 1]
    target = out or Path(f"{stored.machine.name}.replay.nc")
    nivel.files.target.check_target(target, "result file", force=force, sources=[Path(recording)])
    say = (lambda text: None) if quiet else (lambda text: click.echo(text, err=True))
    length = f"{chosen.ticks} ticks, {chosen.ticks * stored.pace.tick:.6g} s"
    with progress_listener(quiet) as listener:
        if settings:
            machine = nivel.api.Machine.from_record(nivel.live.replay.machine_of(stored, chosen))
            other = machine.simulate(**settings, out=target, force=force, listener=listener)
            say(f"{stored.machine.name}: {length} again by other methods; {_trust(other)}\nresult: {target}")
            return
        done = nivel.live.replay.replay(stored, chosen, out=target, force=force, listener=listener)
    say(f"{stored.machine.name}: {length}; {_comparison(done)}; {_trust(done.result)}")
    if not chosen.whole:
        say(
            "this take went on after its last tick here: the run was killed, the recorder could not follow, or its disk was full"
        )
    say(f"result: {target}")
    if not done.is_identical:
        raise SystemExit(COMPUTATION_FAILED)


def _trust(result: Result) -> str:
    """The verdict and its reason; nothing is green that was not run twice."""
    return f"trust: {result.trust.told}"


def _comparison(done: Replay) -> str:
    if done.is_identical:
        return f"all {done.compared} recorded frames are repeated to the last bit"
    return (
        f"{done.different} of {done.compared} frames differ from the recorded ones, the first at t = {done.first:.6g} s: "
        "another processor, another version of nivel, or another machine"
    )
