"""Options that several commands share, spelt the same everywhere."""

from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from pathlib import Path
from typing import Annotated, Any, Literal, get_args, get_origin, get_type_hints

import click

FILE = click.Path(dir_okay=False, path_type=Path)


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


def fatigue_option(command: Any) -> Any:
    """Numbers of an S–N curve."""
    names, form = "strength, knee, slope, slope_below, ultimate", "NAME=VALUE"
    meaning = f"A number of the S-N curve by which cycles do damage: {names}. May be repeated."
    return click.option("--fatigue", multiple=True, metavar=form, callback=assignments(form), help=meaning)(command)


def set_option(of: str, example: str, more: str = "") -> Any:
    """Values of the file of a machine or study."""
    return click.option(
        "--set",
        "overrides",
        multiple=True,
        metavar="PATH=VALUE",
        callback=assignments(f"PATH=VALUE, e.g. {example}", empty=True),
        help=f"Set any value of the {of} file, e.g. {example}{more}. May be repeated.",
    )


override_option = set_option("machine", "bodies.crank.mass='22 kg'")

input_option = click.option(
    "--input",
    "inputs",
    multiple=True,
    metavar="NAME=TABLE.csv",
    callback=assignments("NAME=TABLE.csv, e.g. lever=lever.csv, or NAME=NUMBER"),
    help="Value of an input of the machine: a CSV file with the columns time,value, or a number. May be repeated.",
)

allow_code_option = click.option(
    "--allow-code",
    is_flag=True,
    help="Allow Python functions and FMUs in the machine file. They run with all your rights.",
)

force_option = click.option("--force", is_flag=True, help="Overwrite existing files.")

no_report_option = click.option("--no-report", is_flag=True, help="Write no HTML report.")

json_option = click.option("--json", "as_json", is_flag=True, help="Print the results as JSON on standard output.")

quiet_option = click.option("--quiet", is_flag=True, help="Print errors only.")


tick_option = click.option(
    "--tick",
    type=float,
    metavar="SECONDS",
    help="Time between two readings of the inputs: a whole number of steps. Default: 1 ms, or one step if that is longer.",
)

resume_option = click.option("--resume", is_flag=True, help="Go on with an interrupted study.")


def out_option(what: str, name: str, form: str | None = "FILE.nc", kind: click.Path = FILE, **more: Any) -> Any:
    """The file of what is computed, `name` by default."""
    text = f"{what}; default: {name} in the working directory."
    return click.option("-o", "--out", metavar=form, type=kind, help=text, **more)


def report_option(of: str) -> Any:
    """The page of what is computed, beside the file that it is `of`."""
    text = f"HTML page; default: the name of the {of} with .html."
    return click.option("--report", type=FILE, help=text)


def separated(_context: click.Context, _parameter: click.Parameter, values: tuple[str, ...]) -> tuple[str, ...] | None:
    """The words of an option that takes several, separated by commas, or that is repeated; None where it is not given.

    Words that are empty are kept: their reader refuses them.
    """
    return tuple(word.strip() for text in values for word in text.split(",")) if values else None


def listed(option: str, name: str, metavar: str, meaning: str) -> Any:
    """An option of several words, `separated`."""
    return click.option(option, name, metavar=metavar, multiple=True, callback=separated, help=meaning)


def repeated(option: str, name: str, metavar: str, meaning: str, **more: Any) -> Any:
    """An option that may be given several times."""
    return click.option(option, name, metavar=metavar, multiple=True, help=f"{meaning} May be repeated.", **more)


class SettingOption(click.Option):
    """The option of a setting, whose help ends with the words of which the setting may be one."""

    def __init__(self, name: str, takes: Any, declaration: str, meaning: str) -> None:
        option, _, metavar = declaration.partition(" ")
        more: dict[str, Any] = {}
        kinds = {get_origin(each) or each for each in get_args(takes)}
        if bool in kinds:
            more |= {
                "is_flag": True,
                "callback": lambda _context, _option, given: not option.startswith("--no-") if given else None,
            }
        elif Sequence in kinds:
            more |= {"multiple": True, "callback": separated}
        elif Mapping in kinds:
            more |= {"multiple": True, "callback": assignments(metavar)}
        self.words = [word for each in get_args(takes) if get_origin(each) is Literal for word in get_args(each)]
        said = f"{meaning} {', '.join(self.words)}." if self.words else meaning
        super().__init__([option, name], metavar=metavar or None, help=said, **more)


def setting_options(keys: Any, *names: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Options for the settings in a mapping of `nivel.settings`, or for some; those that were given come as the mapping `settings`."""
    options = [
        SettingOption(name, kind.__origin__, *kind.__metadata__)
        for name, kind in get_type_hints(keys, include_extras=True).items()
        if get_origin(kind) is Annotated and name in (names or (name,))
    ]

    def with_options(command: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(command)
        def gathered(**values: Any) -> Any:
            settings = {option.name: values.pop(option.name) for option in options if option.name}
            return command(**values, settings={name: each for name, each in settings.items() if each not in (None, {})})

        gathered.__click_params__ = [*getattr(command, "__click_params__", ()), *reversed(options)]  # type: ignore[attr-defined]
        return gathered

    return with_options
