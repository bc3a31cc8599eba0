"""Options that several commands share, spelt the same everywhere."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, Final

import click

from nivel.methods import known_words


def file_argument(name: str) -> Any:
    """A machine or result file; whether it exists is found out by its reader, which knows what to say."""
    return click.argument(name, type=click.Path(dir_okay=True))


def assignments(form: str, empty: bool = False) -> Any:
    """What reads the repeated words NAME=VALUE of an option, which are of a `form`; `empty`: a value may be empty.

    A name given twice is refused.
    """

    def read(_context: click.Context, _parameter: click.Parameter, values: tuple[str, ...]) -> dict[str, str]:
        out: dict[str, str] = {}
        for text in values:
            name, equals, value = (part.strip() for part in text.partition("="))
            if not equals or not name or not (value or empty):
                raise click.BadParameter(f"'{text}' is not of the form {form}")
            if name in out:
                raise click.BadParameter(f"'{name}' is given twice")
            out[name] = value
        return out

    return read


override_option = click.option(
    "--set",
    "overrides",
    multiple=True,
    metavar="PATH=VALUE",
    callback=assignments("PATH=VALUE, e.g. bodies.crank.mass='22 kg'", empty=True),
    help="Set any value of the machine file, e.g. bodies.crank.mass='22 kg'. May be repeated.",
)


input_option = click.option(
    "--input",
    "inputs",
    multiple=True,
    metavar="NAME=TABLE.csv",
    callback=assignments("NAME=TABLE.csv, e.g. lever=lever.csv, or NAME=NUMBER"),
    help="Value of an input of the machine: a CSV file with the columns time,value, or a number. May be repeated.",
)

allow_code_option = click.option(
    "--allow-code", is_flag=True, help="Allow Python functions in the machine file. They run with all your rights."
)

force_option = click.option("--force", is_flag=True, help="Overwrite existing files.")

no_report_option = click.option("--no-report", is_flag=True, help="Write no HTML report.")

json_option = click.option("--json", "as_json", is_flag=True, help="Print the results as JSON on standard output.")

quiet_option = click.option("--quiet", is_flag=True, help="Print errors only.")


def separated(_context: click.Context, _parameter: click.Parameter, values: tuple[str, ...]) -> tuple[str, ...] | None:
    """The words of an option that takes several, separated by commas, or that is repeated; None where it is not given.

    Words that are empty are kept: their reader refuses them.
    """
    return tuple(word.strip() for text in values for word in text.split(",")) if values else None


class MethodOption(click.Option):
    """An option whose help ends with the words that the simulation setting `setting` knows."""

    def __init__(self, *declarations: Any, setting: str, **attributes: Any) -> None:
        super().__init__(*declarations, **attributes)
        self.setting = setting

    def get_help_record(self, ctx: click.Context) -> tuple[str, str] | None:
        record = super().get_help_record(ctx)
        return record and (record[0], f"{record[1]} {', '.join(known_words(self.setting))}.")


# Settings that are words, and what their help says before the words.
METHODS: Final[dict[str, str]] = {
    "integrator": "Time integration method:",
    "formulation": "Equations of motion:",
    "coordinates": "Coordinates of the equations:",
    "rotations": "Rotation coordinates, for lagrange in absolute coordinates:",
    "stabilisation": "Constraint stabilisation:",
    "start": "Initial state:",
    "step_control": "Step size control of implicit integrators:",
}


def method_option(setting: str, *, plural: bool = False) -> Any:
    """`--integrator NAME`, or `--integrators NAMES` that takes several."""
    common: dict[str, Any] = {"cls": MethodOption, "setting": setting, "help": METHODS[setting]}
    if not plural:
        return click.option(f"--{setting.replace('_', '-')}", metavar="NAME", **common)
    name = f"--{setting}" if setting.endswith("s") else f"--{setting}s"
    return click.option(name, metavar="NAMES", multiple=True, callback=separated, **common)


duration_option = click.option("--duration", metavar="TIME", help="Simulated time, e.g. 8 or '8 s'.")
output_interval_option = click.option(
    "--output-interval",
    metavar="TIME",
    help="Time between frames of the result. With a fixed step: a multiple of it.",
)
largest_step_option = click.option(
    "--largest-step", metavar="TIME", help="Longest step of integrators that choose their steps; default: the duration."
)
cut_option = click.option(
    "--cut",
    metavar="JOINT",
    multiple=True,
    help="A joint that closes a loop: it stays a constraint in relative coordinates. May be repeated; default: chosen automatically.",
)

_SIMULATION: Final[dict[str, Any]] = {
    "duration": duration_option,
    "step": click.option(
        "--step", metavar="TIME", help="Time step, e.g. '1 ms'. First step of integrators that choose their steps."
    ),
    "output_interval": output_interval_option,
    **{setting: method_option(setting) for setting in METHODS},
    "tolerance": click.option(
        "--tolerance",
        metavar="NUMBER",
        help="Relative tolerance of the motion, for integrators that choose their steps.",
    ),
    "largest_step": largest_step_option,
    "cut": cut_option,
}


def simulation_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Options for every simulation setting; those that were given come as the mapping `settings`."""

    @wraps(command)
    def gathered(**values: Any) -> Any:
        settings = {name: values.pop(name) for name in _SIMULATION}
        return command(**values, settings={name: each for name, each in settings.items() if each not in (None, ())})

    out: Callable[..., Any] = gathered
    for option in reversed(_SIMULATION.values()):
        out = option(out)
    return out
