"""The command `nivel`. Its sub-commands are modules that are imported when they are called, so that help is there at once."""

import gc
import os
import re
import sys
import warnings
from difflib import get_close_matches
from importlib import import_module
from typing import Final, NamedTuple

import click

from nivel import __version__
from nivel.cli.failures import told
from nivel.errors import ModelError
from nivel.lazy import nivel


class CommandPlace(NamedTuple):
    """Where a sub-command lives, `module` or `module:function` (default: `command`), and what it is for in one line."""

    module: str
    help: str


COMMANDS: Final[dict[str, CommandPlace]] = {
    "new": CommandPlace("nivel.cli.new", "Write a small example machine file with comments."),
    "check": CommandPlace("nivel.cli.check", "Check and assemble a machine, and describe it."),
    "run": CommandPlace("nivel.cli.run", "Simulate a machine: result file, report, summary."),
    "demo": CommandPlace("nivel.cli.live:demo", "Operate one of the machines that come with nivel."),
    "live": CommandPlace("nivel.cli.live", "Operate a machine in real time in the browser."),
    "replay": CommandPlace("nivel.cli.live:replay", "Repeat a recorded live run exactly, or with other methods."),
    "budget": CommandPlace("nivel.cli.budget:budget", "Measure the computing time of a step, by method and by part."),
    "statics": CommandPlace("nivel.cli.motions:statics", "Find the static equilibrium of a machine under its loads."),
    "kinematics": CommandPlace(
        "nivel.cli.motions:kinematics", "Positions, velocities and reactions of a driven machine."
    ),
    "inverse": CommandPlace("nivel.cli.motions:inverse", "Efforts of actuators that make a machine follow a motion."),
    "linearise": CommandPlace("nivel.cli.linearise", "Eigenvalues, modes and the linear model about a state."),
    "sweep": CommandPlace("nivel.cli.studies:sweep", "Compute many variants of a machine: data file, report, summary."),
    "optimise": CommandPlace("nivel.cli.studies:optimise", "Find the best values of a machine's parameters."),
    "identify": CommandPlace(
        "nivel.cli.studies:identify", "Find the values of a machine's parameters from measurements."
    ),
    "handling": CommandPlace(
        "nivel.cli.vehicles:handling", "Drive a vehicle through standard manoeuvres: numbers, and a page."
    ),
    "kc": CommandPlace("nivel.cli.vehicles:kc", "Kinematics and compliance of a suspension on a rig."),
    "compare": CommandPlace("nivel.cli.compare", "Run many methods and compare their speed and accuracy."),
    "reduce": CommandPlace("nivel.cli.models:reduce", "Reduce a finite-element model to a flexible body."),
    "view": CommandPlace("nivel.cli.view", "Show a result or move a machine in the browser."),
    "explain": CommandPlace("nivel.cli.results:explain", "Show how far a result can be trusted, and why."),
    "loads": CommandPlace("nivel.cli.results:loads", "Peak reactions, power and work, and load cycles of signals."),
    "stress": CommandPlace("nivel.cli.stress", "Find the largest stresses in a flexible body."),
    "export": CommandPlace("nivel.cli.export", "Write a result as a table, or a machine as a C library or FMU."),
    "import": CommandPlace(
        "nivel.cli.models:import_model", "Translate a model of another program into a machine file."
    ),
    "warmup": CommandPlace("nivel.cli.budget:warmup", "Compile all kernels ahead of the first run."),
}


ONE_THREAD: Final = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
# Between two looks for cycles. Modules, records and tables have none and stay: looks at every 700 take a tenth of a short run.
NEW_OBJECTS: Final = 500_000


class LazyGroup(click.Group):
    """A group whose commands are those of COMMANDS. What they raise is told in failures.py."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        place = COMMANDS.get(cmd_name)
        if place is None:
            return None
        # Matrices here are small: threads of linear algebra wait for each other, on a busy machine for minutes. Read as NumPy is loaded.
        for variable in ONE_THREAD:
            os.environ.setdefault(variable, "1")
        os.environ.setdefault(
            "PYDANTIC_DISABLE_PLUGINS", "__all__"
        )  # it would read of everything installed what plugins it has
        gc.set_threshold(NEW_OBJECTS)
        module, _, name = place.module.partition(":")
        command: click.Command = getattr(import_module(module), name or "command")
        command.short_help = place.help
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        if args and not args[0].startswith("-") and args[0] not in COMMANDS:
            if args[0] in ("help", "version"):
                ctx.fail(f"write `nivel {'--version' if args[0] == 'version' else ' '.join([*args[1:2], '--help'])}`")
            near = get_close_matches(args[0], COMMANDS, n=1)
            hint = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(COMMANDS)}."
            ctx.fail(f"there is no command '{args[0]}'; {hint}")
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl([(name, place.help) for name, place in COMMANDS.items()])

    def invoke(self, ctx: click.Context) -> object:
        with told():
            _asked_level()
            try:
                with warnings.catch_warnings():
                    if not sys.warnoptions:  # reports say what is no number, and where
                        warnings.simplefilter("ignore", RuntimeWarning)
                    return super().invoke(ctx)
            except click.NoSuchOption as problem:
                raise _with_our_word(problem) from None

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        with told():  # help, too, may find no room
            return super().parse_args(ctx, args)


def _with_our_word(problem: click.NoSuchOption) -> click.NoSuchOption:
    """With what an option of other programs is called here."""
    options = problem.ctx.command.params if problem.ctx is not None else []
    ours = [option.removeprefix("--") for each in options for option in each.opts if option.startswith("--")]
    found = re.fullmatch(
        r"did you mean `(.*)`\?", nivel.words.vocabulary.translated(problem.option_name.lstrip("-"), ours)
    )
    if not found:
        return problem
    # possibilities given to it would be left out where they are spelled otherwise
    message = f"No such option '{problem.option_name}'. Did you mean '--{found[1]}'?"
    return click.NoSuchOption(problem.option_name, message, ctx=problem.ctx)


def _say_version(ctx: click.Context, _: click.Parameter, wanted: bool) -> None:
    if not wanted:
        return
    with told():
        asked = _asked_level()
    level = nivel.native.shipped.level()
    made = f"compiled {f'for {asked} ' if asked else ''}when it is first needed"
    click.echo(f"nivel {__version__}\nmachine code: {f'the library for {level} that came with it' if level else made}")
    ctx.exit()


def _asked_level() -> str:
    """The level of processors that the environment asks for; empty: none. Raises ModelError where it cannot be had."""
    try:
        return nivel.native.processor.asked_level()
    except nivel.native.processor.CompilationError as problem:
        raise ModelError(str(problem)) from None


@click.group(cls=LazyGroup, invoke_without_command=True, context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--version", is_flag=True, is_eager=True, expose_value=False, callback=_say_version, help="Print the version."
)
@click.pass_context
def main(ctx: click.Context) -> None:
    """Simulate machines and mechanisms (multibody dynamics), with an estimate of the error of each result.

    `nivel COMMAND --help` describes a command.
    """
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())
