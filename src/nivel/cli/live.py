"""`nivel live MACHINE`: the machine in real time, operated in the browser."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from nivel.cli.failures import COMPUTATION_FAILED
from nivel.cli.options import (
    allow_code_option,
    file_argument,
    force_option,
    method_option,
    override_option,
    quiet_option,
)

if TYPE_CHECKING:
    from nivel.live.session import Session


@click.command(short_help="Operate a machine in real time in the browser.")
@file_argument("machine")
@override_option
@allow_code_option
@click.option("--step", metavar="TIME", help="Time step, e.g. '1 ms'.")
@click.option(
    "--tick",
    type=float,
    metavar="SECONDS",
    help="Time between two readings of the inputs: a whole number of steps. Default: 1 ms, or one step if that is longer.",
)
@method_option("integrator")
@method_option("formulation")
@method_option("coordinates")
@method_option("stabilisation")
@click.option("--record", type=click.Path(dir_okay=False), help="Write the recording to this file, for `nivel replay`.")
@force_option
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
@quiet_option
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
    **methods: Any,
) -> None:
    """Simulate MACHINE in real time and operate it on a page in the browser.

    The section `inputs` of the machine file defines the inputs. The solver has fixed steps and runs in a process of its own. Ctrl-C ends
    the run and prints a report of the timing.
    """
    from nivel.api import load
    from nivel.cli.progress import progress_listener
    from nivel.live.datagrams import Datagrams, place_of
    from nivel.live.opening import session_of
    from nivel.live.recording import write_recording
    from nivel.live.source import LiveSource
    from nivel.live.timing import in_a_sentence, in_words
    from nivel.results.frames.target import check_target
    from nivel.view.opening import serve

    def say(text: str) -> None:
        if not quiet:
            click.echo(text, err=True)

    if record is not None:
        check_target(Path(record), "recording", force=force, sources=[Path(machine)])
    settings = {name: value for name, value in methods.items() if value is not None}
    listen, send = udp and place_of(udp, "udp"), udp_to and place_of(udp_to, "udp_to")
    loaded = load(machine, overrides, allow_code=allow_code)
    with ExitStack() as stack:
        with progress_listener(quiet) as listener:
            listener.say("preparing")
            folder = None if record is None else Path(record).absolute().parent
            opened = session_of(
                loaded, settings, tick=tick, urgent=not no_priority, recorded_in=folder, listener=listener
            )
            session = stack.enter_context(opened)
            outside = Datagrams(session, listen or None, send or None)
            stack.callback(outside.close)
            source = LiveSource(session, outside if listen else None)
            session.on_frame = both(session.on_frame, outside.send)
        for line in introduction(session):
            say(line)
        session.command("run")
        serve(source, host=host, port=port, browser=not no_browser, say=say)
        timing, problem = session.timing, session.problem if session.mode == "failed" else ""
    for line in in_words(timing):
        say(line)
    if timing.ticks:
        integrator = session.plan.settings.integrator
        say(f"  {in_a_sentence(session.plan.machine.name, integrator, timing, session.parts)}")
    if listen:
        say(f"datagrams: {outside.counts}")
    if record is not None:
        write_recording(
            record, session.plan.machine, loaded.origin.source, settings, session.pace, session.recorder.parts
        )
        say(f"recording: {record}{session.recorder.problem and f' ({session.recorder.problem})'}")
    if problem:
        click.echo(problem, err=True)
        raise SystemExit(COMPUTATION_FAILED)


def both(first: Callable[[], None], second: Callable[[], None]) -> Callable[[], None]:
    """One after the other."""

    def call() -> None:
        first()
        second()

    return call


def introduction(session: Session) -> Iterator[str]:
    """What the machine is run with, and its keys."""
    pace = session.pace
    steps = "one step" if pace.substeps == 1 else f"{pace.substeps} steps"
    yield f"{session.plan.machine.name}: ticks of {1e3 * pace.tick:g} ms, each of {steps}; {', '.join(session.said)}"
    for each in session.inputs:
        if each.keys is not None:
            yield f"  {each.name}: {each.keys.raise_ or '–'} raises, {each.keys.lower or '–'} lowers"
