"""What long computations tell on standard error while they go on."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from nivel.analysis.progress.listener import Listener


@contextmanager
def progress_listener(quiet: bool) -> Iterator[Listener]:
    """Hears what is being done: says nothing where `quiet`, else stages and a progress bar."""
    from nivel.analysis.progress.listener import Listener

    if quiet:
        yield Listener()
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.fields[reached]}"), TimeElapsedColumn())
    console = Console(stderr=True)
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("starting", total=None, reached="")

        def stage(text: str, total: float | None = None) -> None:
            if text.startswith("compiling"):
                console.print(text)  # stays, also where no bar can be shown
            bar.update(task, description=text, total=total, completed=0, reached="")

        def progress(time: float) -> None:
            bar.update(task, completed=time, reached=f"t = {time:.3f} s")

        yield Listener(stage, progress)


@contextmanager
def progress_stage(quiet: bool) -> Iterator[Callable[[str, float], None]]:
    """Hears what begins and which share of all is done, from 0 to 1: says nothing where `quiet`, else a progress bar."""
    if quiet:
        yield lambda _text, _share: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("starting", total=1.0)
        yield lambda text, share: bar.update(task, description=text, completed=share)
