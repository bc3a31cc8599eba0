"""Real time: `nivel live MACHINE` and `nivel demo`, a machine operated in the browser; `nivel replay`, a recording made to a result."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Any, Final

import click

from nivel.cli import options
from nivel.cli.failures import COMPUTATION_FAILED
from nivel.cli.options import allow_code_option, file_argument, force_option, out_option, quiet_option, setting_options
from nivel.cli.progress import progress_listener
from nivel.demos import DEMOS, demo_file
from nivel.errors import ModelError
from nivel.known import Replay, Result
from nivel.lazy import nivel
from nivel.settings import RunSettingsDict, StepSettingsDict

if TYPE_CHECKING:
    from nivel.live.session import Session
    from nivel.view.server import Stop


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
def replay(
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


@click.command()
@click.argument("name", type=click.Choice(tuple(DEMOS)), default=next(iter(DEMOS)))
@click.option("--port", type=click.IntRange(0, 65535), default=0, help="Port to listen at; default: any free port.")
@click.option("--no-browser", is_flag=True, help="Do not open a browser.")
@click.pass_context
def demo(ctx: click.Context, name: str, port: int, no_browser: bool) -> None:
    """Operate a machine that comes with nivel, in the browser; default: the loader crane.

    The command prints the path of the machine file. `nivel live` with this file does the same.
    """
    nivel.extras.require("the page needs", "websockets")
    file = demo_file(name)
    click.echo(f"{name}: {DEMOS[name]}\nmachine file: {file}", err=True)
    ctx.invoke(command, machine=str(file), overrides={}, port=port, no_browser=no_browser)


SIGNALLED: Final = 128  # and the number of the signal: the exit code
# as the page shows them
KEYS: Final = {"ArrowLeft": "←", "ArrowRight": "→", "ArrowUp": "↑", "ArrowDown": "↓", " ": "space"}
TOLD: Final = 1.0  # s in which pages hear that the solver has ended


@click.command()
@options.file_argument("machine")
@options.override_option
@options.allow_code_option
@options.setting_options(StepSettingsDict, "step", "integrator", "formulation", "coordinates", "stabilisation")
@options.tick_option
@click.option(
    "--record",
    type=click.Path(dir_okay=False),
    help="Record into this file, for `nivel replay`. FILE.part until the run ends.",
)
@options.force_option
@click.option(
    "--udp",
    metavar="HOST:PORT",
    help="Receive inputs as datagrams at this address. While they come, pages can only watch.",
)
@click.option("--udp-to", metavar="HOST:PORT", help="Send the sensors to this address with every frame.")
@click.option(
    "--host",
    default="127.0.0.1",
    help="Address to listen at. With another address than the default, clients need the token.",
)
@click.option("--port", type=click.IntRange(0, 65535), default=0, help="Port to listen at; default: any free port.")
@click.option("--no-browser", is_flag=True, help="Do not open a browser.")
@click.option("--no-priority", is_flag=True, help="Do not ask for real-time priority and locked memory.")
@options.quiet_option
def command(
    machine: str,
    overrides: dict[str, str],
    allow_code: bool,
    tick: float | None,
    record: str | None,
    force: bool,
    udp: str | None,
    udp_to: str | None,
    host: str,
    port: int,
    no_browser: bool,
    no_priority: bool,
    quiet: bool,
    settings: dict[str, Any],
) -> None:
    """Simulate MACHINE in real time and operate it on a page in the browser.

    The section `inputs` of the machine file defines the inputs. The solver has fixed steps and runs in a process of its own. Ctrl-C ends
    the run and prints a report of the timing.
    """
    nivel.extras.require("the page needs", "websockets")

    def say(text: str) -> None:
        if not quiet:
            tell(text)

    target = None if record is None else Path(record)
    if target is not None:
        nivel.files.target.check_target(target, "recording", force=force, sources=[Path(machine)])
        nivel.live.recording.check_journal(nivel.live.recording.journal_of(target), force=force)
    listen = udp and nivel.live.datagrams.place_of(udp, "udp")
    send = udp_to and nivel.live.datagrams.place_of(udp_to, "udp_to")
    loaded = nivel.api.load(machine, overrides, allow_code=allow_code)
    stop = nivel.view.server.Stop()
    with orderly_end(stop), ExitStack() as stack:
        with nivel.cli.progress.progress_listener(quiet) as listener:
            listener.say("preparing")
            opened = nivel.live.page.session_of(
                loaded, settings, tick=tick, urgent=not no_priority, record=target, force=force, listener=listener
            )
            session = stack.enter_context(opened)
            if target is not None:
                stack.callback(keep, session, target)
            outside = nivel.live.datagrams.Datagrams(session, listen or None, send or None)
            stack.callback(outside.close)
            source = nivel.live.source.LiveSource(session, outside if listen else None)
            before = session.on_frame

            def on_frame() -> None:
                before()
                outside.send()

            session.on_frame = on_frame
            session.on_gone = lambda: threading.Timer(TOLD, stop.ask).start()
        for line in introduction(session):
            say(line)
        if target is not None:
            say(f"recording: {nivel.live.recording.journal_of(target)}, which becomes {target} when the run ends")
        if listen:
            say(f"datagrams: received at {':'.join(map(str, outside.address))}")
        session.command("run")
        try:
            nivel.view.server.serve(source, host=host, port=port, browser=not no_browser, say=say, stop=stop)
        except ModelError:  # of the address
            session.recorder.discard()
            raise
        problem = session.problem if session.mode in ("failed", "gone") else ""
        stack.close()
        for line in conclusion(session):
            say(line)
        if listen:
            say(f"datagrams: {outside.counts}")
        if target is not None:
            say(f"recording: {target}{session.recorder.problem and f' ({session.recorder.problem})'}")
        if problem:
            tell(problem)
            raise SystemExit(COMPUTATION_FAILED)


def tell(text: str) -> None:
    """Say something on standard error, where somebody still reads it: the terminal may be closed."""
    with suppress(OSError):
        click.echo(text, err=True)


def keep(session: Session, target: Path) -> None:
    """End the session and let its recording take its place. Where that is interrupted, say what there is."""
    try:
        session.close()
        session.recorder.complete(target)
    except KeyboardInterrupt:
        journal = nivel.live.recording.journal_of(target)
        tell(f"the recording was not completed; what was recorded is in {journal}: `nivel replay {journal}` plays it")
        raise


@contextmanager
def orderly_end(stop: Stop) -> Iterator[None]:
    """SIGTERM and SIGHUP, which a terminal sends when it is closed, end the run as Ctrl-C does, with the exit code that shells expect.

    What the program was told to ignore it ignores.
    """
    came: list[int] = []

    def end(number: int, _frame: FrameType | None) -> None:
        came.append(number)
        if stop.can_be_asked:
            stop.ask()
        elif not stop.has_ended and len(came) == 1:
            raise SystemExit(SIGNALLED + number)

    numbers = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
    before = {each: signal.signal(each, end) for each in numbers if signal.getsignal(each) is not signal.SIG_IGN}
    try:
        yield
    finally:
        for each, handler in before.items():
            signal.signal(each, handler)
    if came:
        raise SystemExit(SIGNALLED + came[0])


def conclusion(session: Session) -> Iterator[str]:
    """How the run went."""
    timing = session.timing
    yield from nivel.live.timing.in_words(timing)
    if timing.ticks:
        integrator = session.plan.settings.integrator
        yield f"  {nivel.live.timing.in_a_sentence(session.plan.machine.name, integrator, timing, session.parts)}"
    light = session.light
    if light.verdict == "green":
        yield "energy, joints, circuits and computing time: green"
    else:
        yield f"the trust report of this run would be {light.verdict}:"
        yield from (f"  {each}" for each in light.reasons)
    yield "not verified: the errors of its steps were not examined; `nivel replay` of a recording estimates them"


def introduction(session: Session) -> Iterator[str]:
    """What the machine is run with, and what its keys move."""
    pace = session.pace
    steps = "one step" if pace.substeps == 1 else f"{pace.substeps} steps"
    yield f"{session.plan.machine.name}: ticks of {1e3 * pace.tick:g} ms, each of {steps}; {', '.join(session.said)}"
    for each in session.inputs:
        if each.keys is not None:
            up, down = (KEYS.get(key or "", key or "–").upper() for key in (each.keys.raise_, each.keys.lower))
            moves = f" ({each.description})" if each.description else ""
            yield f"  {each.label or nivel.words.wording.label_of(each.name)}{moves}: {up}, the other way {down}"
