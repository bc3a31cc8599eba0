"""Progress of long computations on standard error: a bar in a terminal, plain lines in a file or a pipe."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from nivel.lazy import nivel, rich
from nivel.words.wording import seconds

if TYPE_CHECKING:
    from rich.console import Console

    from nivel.analysis.progress.log import Listener
    from nivel.results.result import Result
    from nivel.results.trust import Trust


@contextmanager
def progress_listener(quiet: bool) -> Iterator[Listener]:
    """Hears what is being done: says nothing where `quiet`, else stages and how far they are."""
    if quiet:
        yield nivel.analysis.progress.log.Listener()
        return
    if not sys.stderr.isatty():
        log = nivel.analysis.progress.log.Log()
        yield log.listener
        log.end()
        return
    columns = (rich.progress.TextColumn("{task.fields[reached]}"), rich.progress.TimeElapsedColumn())
    with nivel.analysis.progress.log.bar_of(*columns) as bar:
        task = bar.add_task("starting", total=None, reached="")

        def stage(text: str, total: float | None = None) -> None:
            if text.startswith("compiling"):
                bar.console.print(text)  # stays
            bar.update(task, description=text, total=total, completed=0, reached="")

        def progress(time: float) -> None:
            bar.update(task, completed=time, reached=f"t = {time:.3f} s")

        yield nivel.analysis.progress.log.Listener(stage, progress)


@contextmanager
def progress_stage(quiet: bool) -> Iterator[Callable[[str, float], None]]:
    """Hears what begins and which share of all is done, from 0 to 1: says nothing where `quiet`."""
    if quiet:
        yield lambda _text, _share: None
        return
    if not sys.stderr.isatty():
        with progress_listener(quiet) as listener:
            yield lambda text, _share: listener.say(text)
        return
    with nivel.analysis.progress.log.bar_of(rich.progress.TimeElapsedColumn()) as bar:
        task = bar.add_task("starting", total=1.0)
        yield lambda text, share: bar.update(task, description=text, completed=share)


@contextmanager
def progress_count(what: str, quiet: bool) -> Iterator[Callable[[int, int, str], None]]:
    """Hears how many of how many are done, and which is the last; `what` is done with all. Says nothing where `quiet`."""
    if quiet:
        yield lambda _done, _count, _name: None
        return
    if not sys.stderr.isatty():
        with progress_listener(quiet) as listener:
            listener.say(what)
            yield lambda done, count, _name: listener.say(f"{what}: {done} of {count}")
        return
    columns = (rich.progress.MofNCompleteColumn(), rich.progress.TimeElapsedColumn())
    with nivel.analysis.progress.log.bar_of(*columns) as bar:
        task = bar.add_task(what, total=None)
        yield lambda done, count, name: bar.update(task, completed=done, total=count, description=name or what)


COLOURS = {"green": "green", "amber": "yellow", "red": "red"}
OUTCOMES = {"done": "completed", "failed": "failed", "interrupted": "interrupted"}


def console(*, stderr: bool = True) -> Console:
    """What prints lines: folded at the width of a terminal, whole in a file or a pipe."""
    stream = sys.stderr if stderr else sys.stdout
    return rich.console.Console(stderr=stderr, highlight=False, soft_wrap=not stream.isatty())


def ended(result: Result) -> str:
    """`completed (t = 8 s)`, with the time that was reached."""
    reached = f" (t = {result.time[-1]:.6g} s)" if len(result.time) else ""
    return f"[bold]{result.name}[/bold]: {OUTCOMES.get(result.outcome, result.outcome)}{reached}"


def computed_in(time: float, steps: int = 0) -> str:
    """`computed in 31 ms (3.9 µs per step)`; without steps only the time [s]."""
    return f"computed in {seconds(time)}" + (f" ({seconds(time / steps)} per step)" if steps else "")


def in_colour(light: str) -> str:
    """`red, ` before a headline; nothing where there is no light: of what was not verified no green one."""
    return f"[{COLOURS[light]}]{light}[/], " if light in COLOURS else ""


def say_trust_and_files(out: Console, trust: Trust, target: Path, report: Path | None) -> None:
    """The light and the headline, the checks that are not green, in full, how many passed, and names of the files that were written."""
    out.print(f"trust: {in_colour(trust.light)}{trust.headline}", soft_wrap=True)
    checks = [item for item in trust.items if item.name != "outcome" or item.verdict != "green"]
    open_ones = [item for item in checks if item.verdict != "green"]
    for item in open_ones:
        out.print(f"  [{COLOURS[item.verdict]}]●[/] {item.text}")
    passed = len(checks) - len(open_ones)
    if not open_ones:
        out.print(f"All {passed} numerical checks passed; `nivel explain` shows them.")
    elif passed:
        out.print(f"  The other {passed} checks passed; `nivel explain` shows them.", soft_wrap=True)
    out.print(f"result: {target}" + (f"\nreport: {report}" if report is not None else ""), soft_wrap=True)
