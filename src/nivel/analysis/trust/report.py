"""Trust report: the checks of the folder `checks`, and what they find and say of a subject."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import Any, Final

import numpy as np

from nivel.analysis.trust import checks
from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Equilibria, Motion, Positions, Run, Subject
from nivel.results.result import Result
from nivel.results.scales import Readable
from nivel.results.trust import Item, Threshold, Trust, plain, worst

# subjects of analyses that results name; others are runs
KINDS: Final[dict[str, type[Subject]]] = {"statics": Equilibria, "kinematics": Positions}


@cache
def every_check() -> tuple[Check[Any, Any], ...]:
    """All checks, in the order of their lines."""
    modules = [import_module(f"{checks.__name__}.{module.name}") for module in iter_modules(checks.__path__)]
    found = [check for module in modules for check in getattr(module, "CHECKS", ())]
    return tuple(sorted(found, key=lambda check: check.place))


@np.errstate(
    over="ignore", invalid="ignore", divide="ignore"
)  # a run that grew beyond all bounds is red, not a warning
def assess(subject: Subject, given: Mapping[str, Any] | None = None) -> Trust:
    """The trust report of a subject.

    given : what checks have found already, by their names, also of checks that do not look at such subjects.
    """
    found, lines = dict(given or {}), dict[str, list[Item]]()
    applying = [check for check in every_check() if check.applies(subject)]
    others = found.keys() - {check.name for check in applying}
    applying = sorted([*applying, *map(_check_of, others)], key=lambda check: check.place)
    for check in sorted(applying, key=lambda check: check.last):
        if check.name not in found and not check.lacks(subject):
            seen = subject.with_lines(_in_order(applying, lines)) if check.last else subject
            looked = check.look(seen)
            if looked is not None and looked != []:
                found[check.name] = looked
        lines[check.name] = check.lines(found.get(check.name))
    items = _in_order(applying, lines)
    kept = {check.name: plain(found[check.name]) for check in applying if check.name in found}
    return Trust(worst(items), subject.outcome, kept, items)


def assess_remains(result: Result) -> Trust:
    """The trust report of a run that was killed, or still goes on."""
    return assess(Motion(result=result, outcome=result.outcome, failure=result.failure))


def blindness(items: Iterable[Item]) -> str:
    """Why two runs may be wrong alike, in words; empty where nothing says so."""
    blind = {check.line or check.name: check.blind for check in every_check() if check.blind}
    for item in items:
        if item.verdict != "green" and item.name in blind:
            return blind[item.name].format(row=item.row, time=f"{item.time or 0.0:.6g}")
    return ""


def thresholds_of(result: Readable, *, quiet: bool = True) -> dict[str, Threshold]:
    """Thresholds of the lines of such results by their names; those of lines that are told where they are not green only where `quiet`
    says so."""
    kind = KINDS.get(str(result.attributes.get("analysis", "")), Run)
    told = [each for each in every_check() if issubclass(kind, each.of) and (quiet or not each.quiet)]
    return {each.line or each.name: each.threshold for each in told if each.threshold is not None}


def titles() -> dict[str, str]:
    """Titles of lines by their names."""
    return {each.line or each.name: each.title for each in every_check() if each.title}


def _check_of(name: str) -> Check[Any, Any]:
    return next(check for check in every_check() if check.name == name)


def _in_order(applying: Iterable[Check[Any, Any]], lines: Mapping[str, list[Item]]) -> tuple[Item, ...]:
    return tuple(item for check in applying for item in lines.get(check.name, ()))
