"""`nivel warmup`: compile everything ahead of the first run."""

from __future__ import annotations

import time

import click

from nivel.cli.options import quiet_option


@click.command(short_help="Compile all kernels ahead of the first run.")
@quiet_option
def command(quiet: bool) -> None:
    """Compile every formulation, integrator and type of force into the user's cache, on all processors.

    Entries that are compiled already are kept. After an interruption, the next call continues.
    """
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    from nivel.analysis.plan.compilation import all_entries
    from nivel.native import library, store

    console = Console(stderr=True, highlight=False, quiet=quiet)
    begin = time.perf_counter()
    entries = all_entries()
    missing = library.missing(entries)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as progress:
        task = progress.add_task("compiling", total=len(missing))

        def done(name: str) -> None:
            progress.update(task, advance=1, description=name)

        library.build(missing, done)
    spent = time.perf_counter() - begin
    console.print(
        f"{len(missing)} of {len(entries)} entries compiled in {spent:.1f} s; cache: {store.folder()}", soft_wrap=True
    )
