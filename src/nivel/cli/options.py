"""Options that several commands share, spelt the same everywhere."""

from __future__ import annotations

from typing import Any

import click


def file_argument(name: str) -> Any:
    """A machine or result file; whether it exists is found out by its reader, which knows what to say."""
    return click.argument(name, type=click.Path(dir_okay=True))


def _assignments(_context: click.Context, _parameter: click.Parameter, values: tuple[str, ...]) -> dict[str, str]:
    out: dict[str, str] = {}
    for text in values:
        path, equals, value = text.partition("=")
        if not equals or not path.strip():
            raise click.BadParameter(f"'{text}' is not of the form PATH=VALUE, e.g. bodies.crank.mass='22 kg'")
        if path.strip() in out:
            raise click.BadParameter(f"'{path.strip()}' is set twice")
        out[path.strip()] = value.strip()
    return out


override_option = click.option(
    "--set",
    "overrides",
    multiple=True,
    metavar="PATH=VALUE",
    callback=_assignments,
    help="Set any value of the machine file, e.g. bodies.crank.mass='22 kg'. May be repeated.",
)

allow_code_option = click.option(
    "--allow-code", is_flag=True, help="Laws of the machine may be Python functions; they run with all your rights."
)

quiet_option = click.option("--quiet", is_flag=True, help="Say nothing on standard error but errors.")
