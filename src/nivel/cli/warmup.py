"""`nivel warmup`: compile everything ahead of the first run."""

from __future__ import annotations

import time

import click

from nivel.cli.options import quiet_option


@click.command(short_help="Compile all kernels ahead of the first run.")
@quiet_option
def command(quiet: bool) -> None:
    """Compile every formulation, integrator and kind of force into the user's cache, and say how long each took."""
    from importlib import import_module

    from rich.console import Console

    from nivel.analysis.compilation import complex_modules, rare_modules
    from nivel.kernels import cache
    from nivel.kernels.hook import compile_on_complex_numbers
    from nivel.march.catalogue import INTEGRATORS
    from nivel.motion.catalogue import FLEXIBLE, PATHS

    console = Console(stderr=True, highlight=False, quiet=quiet)
    modules = [
        "nivel.kernels.observe",
        "nivel.march.loop",
        "nivel.kernels.tangent_entries",
        "nivel.kernels.static_entries",
    ]
    modules += [
        module for facts in (*PATHS.values(), *FLEXIBLE.values()) for module in (facts.module, facts.correction)
    ]
    modules += [facts.dependent for facts in (*PATHS.values(), *FLEXIBLE.values()) if facts.dependent]
    modules += [facts.module for facts in INTEGRATORS.values()]
    modules += rare_modules()
    total = time.perf_counter()
    for module in dict.fromkeys(modules):
        begin = time.perf_counter()
        with console.status(f"compiling {module}"):
            import_module(module)
        console.print(f"{module:36} {time.perf_counter() - begin:6.2f} s")
    for module in complex_modules():
        begin = time.perf_counter()
        with console.status(f"compiling exact derivatives of {module}"):
            compile_on_complex_numbers(import_module(module))
        console.print(f"{module:36} {time.perf_counter() - begin:6.2f} s, exact derivatives")
    console.print(f"ready in {time.perf_counter() - total:.1f} s; cache: {cache.directory()}", soft_wrap=True)
