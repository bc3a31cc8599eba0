"""Progress of long computations on standard error: a bar in a terminal, plain lines in a file or a pipe."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from nivel.lazy import nivel, rich

if TYPE_CHECKING:
    from nivel.analysis.progress.log import Listener


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
    columns = (
        rich.progress.TextColumn("{task.description}"),
        rich.progress.BarColumn(),
        rich.progress.TextColumn("{task.fields[reached]}"),
        rich.progress.TimeElapsedColumn(),
    )
    console = rich.console.Console(stderr=True)
    with rich.progress.Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("starting", total=None, reached="")

        def stage(text: str, total: float | None = None) -> None:
            if text.startswith("compiling"):
                console.print(text)  # stays
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
    columns = (
        rich.progress.TextColumn("{task.description}"),
        rich.progress.BarColumn(),
        rich.progress.TimeElapsedColumn(),
    )
    with rich.progress.Progress(*columns, console=rich.console.Console(stderr=True), transient=True) as bar:
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
    columns = (
        rich.progress.TextColumn("{task.description}"),
        rich.progress.BarColumn(),
        rich.progress.MofNCompleteColumn(),
        rich.progress.TimeElapsedColumn(),
    )
    with rich.progress.Progress(*columns, console=rich.console.Console(stderr=True), transient=True) as bar:
        task = bar.add_task(what, total=None)
        yield lambda done, count, name: bar.update(task, completed=done, total=count, description=name or what)
