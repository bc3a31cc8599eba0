"""Messages and exit codes of failed commands. Nothing else in the command line decides about either.

0 done, also where nobody reads the output to its end; 2 the input is at fault (also wrong options, by click); 3 the computation failed;
130 interrupted.
What is neither is a defect of nivel and keeps its traceback.
"""

import errno
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final, NoReturn

import click

from nivel.errors import Fault, ModelError, SolveError
from nivel.lazy import rich

if TYPE_CHECKING:
    from rich.text import Text

INPUT_AT_FAULT: Final = 2
COMPUTATION_FAILED: Final = 3
INTERRUPTED: Final = 130
NO_ROOM: Final = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EROFS)


@contextmanager
def told() -> Iterator[None]:
    """Tell what goes wrong inside on standard error, and leave with the code that belongs to it."""
    try:
        yield
    except ModelError as error:
        say_faults(error)
        raise SystemExit(INPUT_AT_FAULT) from None
    except SolveError as error:
        say_failure(error)
        raise SystemExit(COMPUTATION_FAILED) from None
    except KeyboardInterrupt:
        _say("interrupted")
        raise SystemExit(INTERRUPTED) from None
    except BrokenPipeError:
        _read_no_more()
    except SystemExit as end:
        if not isinstance(end.__context__, BrokenPipeError):
            raise
        _read_no_more()
    except OSError as error:
        if error.errno not in NO_ROOM:
            raise
        _say(f"{error.filename or 'the output'} cannot be written: {os.strerror(error.errno).lower()}")
        raise SystemExit(COMPUTATION_FAILED) from None


def _read_no_more() -> NoReturn:
    """Leave as done where the reader of the output, `head` for instance, has enough: no failure."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what Python still flushes at its end
    raise SystemExit(0) from None


def say_faults(error: ModelError) -> None:
    """One line for each fault: `file:line:column  element  message`. The order is that of the file."""
    for fault in error.faults:
        _say(fault_line(fault))
    if len(error.faults) > 1:
        _say(f"{len(error.faults)} faults")


def fault_line(fault: Fault) -> "Text":
    """A fault in colours: the place to click on, the element, the message."""
    parts = []
    if fault.line:
        parts.append(rich.text.Text(f"{fault.file}:{fault.line}:{fault.column}", style="cyan"))
    if fault.path:
        parts.append(rich.text.Text(fault.path if fault.line else option_of(fault.path), style="bold"))
    parts.append(rich.text.Text(fault.message, style="" if parts else "red"))
    return rich.text.Text("  ").join(parts)


def option_of(path: str) -> str:
    """The option of the command that runs by which what is at fault came, `--step` for `step` and `statics.step`; else the path."""
    context = click.get_current_context(silent=True)
    if context is None or not isinstance(context.command, click.Group) or context.invoked_subcommand is None:
        return path
    command = context.command.get_command(context, context.invoked_subcommand)
    name = path.removeprefix(f"{context.invoked_subcommand}.").split(".")[0]
    options = (
        [each for each in command.params if isinstance(each, click.Option) and each.name == name] if command else []
    )
    return options[0].opts[-1] if options else path


def say_failure(error: SolveError) -> None:
    """What failed, when, and what to try."""
    _say(rich.text.Text.assemble(("the computation failed: ", "red"), error.message))
    if error.advice:
        _say(error.advice)


def _say(text: "Text | str") -> None:
    # soft_wrap: a line is a line also in a narrow terminal or a pipe, for people and programs that look for places
    try:
        rich.console.Console(stderr=True, highlight=False, soft_wrap=True, markup=False).print(text)
    except (BrokenPipeError, SystemExit):  # nobody reads it: the exit code still tells
        return
