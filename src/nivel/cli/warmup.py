"""`nivel warmup`: compile everything ahead of the first run."""

import time

import click

from nivel.cli.options import quiet_option
from nivel.cli.progress import progress_count
from nivel.lazy import nivel, rich


@click.command()
@quiet_option
def command(quiet: bool) -> None:
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
