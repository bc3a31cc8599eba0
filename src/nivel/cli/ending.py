"""Ending of a command: how far it came, what it cost, and what its checks say."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from nivel.lazy import rich
from nivel.words.wording import seconds

if TYPE_CHECKING:
    from rich.console import Console

    from nivel.results.result import Result
    from nivel.results.trust import Trust

COLOURS = {"green": "green", "amber": "yellow", "red": "red"}
OUTCOMES = {"done": "completed", "failed": "failed", "interrupted": "interrupted"}


def console(*, stderr: bool = True) -> Console:
    """What prints lines: folded at the width of a terminal, whole in a file or a pipe."""
    stream = sys.stderr if stderr else sys.stdout
    return rich.console.Console(stderr=stderr, highlight=False, soft_wrap=not stream.isatty())


def ended(result: Result) -> str:
    """`completed (t = 8 s)`, with the time that was reached."""
    reached = f" (t = {result.time[-1]:.6g} s)" if len(result.time) else ""
    return f"[bold]{result.name}[/bold]: {OUTCOMES.get(result.outcome, result.outcome)}{reached}"


def computed_in(time: float, steps: int = 0) -> str:
    """`computed in 31 ms (3.9 µs per step)`; without steps only the time [s]."""
    return f"computed in {seconds(time)}" + (f" ({seconds(time / steps)} per step)" if steps else "")


def said_in_colour(trust: Trust) -> str:
    """The light and the headline; of what was not verified no green one."""
    coloured = f"[{COLOURS[trust.light]}]{trust.light}[/], " if trust.light in COLOURS else ""
    return f"{coloured}{trust.headline}"


def say_checks(out: Console, trust: Trust) -> None:
    """The checks that are not green, in full, and how many passed."""
    checks = [item for item in trust.items if item.name != "outcome" or item.verdict != "green"]
    open_ones = [item for item in checks if item.verdict != "green"]
    for item in open_ones:
        out.print(f"  [{COLOURS[item.verdict]}]●[/] {item.text}")
    passed = len(checks) - len(open_ones)
    if not open_ones:
        out.print(f"All {passed} numerical checks passed; `nivel explain` shows them.")
    elif passed:
        out.print(f"  The other {passed} checks passed; `nivel explain` shows them.", soft_wrap=True)


def say_files(out: Console, target: Path, report: Path | None) -> None:
    """Names of the result file and of the report, if one was written."""
    out.print(f"result: {target}" + (f"\nreport: {report}" if report is not None else ""), soft_wrap=True)
