"""Trust report: the checks of the folder `checks`, what they need, measure and say, and what they find of a subject."""

from collections.abc import Callable, Iterable, Mapping
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import Any, Final, Generic, TypeVar

import numpy as np

from nivel.judge.after import checks
from nivel.judge.after.subject import Equilibria, Motion, Positions, Run, Subject
from nivel.lazy import Struct, all_kept
from nivel.results.result import Result
from nivel.results.scales import Readable
from nivel.results.trust import Item, Threshold, Trust, plain, worst


class Need(Struct):
    """What a check cannot do without, in words, and whether a subject has it."""

    words: str
    met: Callable[[Any], bool]


S = TypeVar("S", bound=Subject)
F = TypeVar("F")
FRAMES: Final = Need("frames", lambda subject: len(subject.result.time) > 0)
STEPS: Final = Need("steps", lambda run: run.finished.pace is not None and FRAMES.met(run))
FIXED_STEPS: Final = Need("steps of fixed size", lambda run: run.plan.settings.steps > 0 and STEPS.met(run))
SECOND_RUN: Final = Need("a second run", lambda run: run.second is not None and STEPS.met(run))
ESTIMATE: Final = Need("a second run", lambda run: run.estimate is not None and STEPS.met(run))
OTHERS: Final = Need("a result with other elements of beams", lambda subject: subject.elements is not None)


class Check(Struct, Generic[S, F]):
    """A check, made as `CHECKS` of a module of `nivel.judge.after.checks`.

    name : of what it finds, in `Trust.found`. of : kinds of subjects that it looks at. needs : what they must have.
    look : what it finds: a record, a list of them where each has a line, or None. The fields of records are numbers, texts, and records
    or tuples of these.
    say : the line of a record, None where nothing is to be said.
    place : of its lines in the report, which are in rising order. title : of its lines in the page. threshold : that its numbers are held
    against. line : the name of its lines, by default that of the check.
    blind : why a second run may be wrong alike where a line is not green; `{row}` and `{time}` are those of the line.
    quiet : green lines are not told. last : it looks at lines of the others, `subject.items`. apart : its colour is that of numbers
    on which the motion does not depend, so it turns no light.
    """

    name: str
    of: type[S] | tuple[type[S], ...]
    look: Callable[[S], F | list[F] | None]
    say: Callable[[F], Item | None]
    place: int
    needs: tuple[Need, ...] = ()
    title: str = ""
    threshold: Threshold | None = None
    blind: str = ""
    line: str = ""
    quiet: bool = False
    last: bool = False
    apart: bool = False

    def applies(self, subject: Subject) -> bool:
        """Whether it looks at such a subject."""
        return isinstance(subject, self.of)

    def lacks(self, subject: Subject) -> str:
        """What it needs and such a subject has not, in words; empty where it has all."""
        return next((need.words for need in self.needs if not need.met(subject)), "")

    def lines(self, found: F | list[F] | None) -> list[Item]:
        """The lines of what it has found."""
        every: list[Any] = found if isinstance(found, list) else [] if found is None else [found]
        said = [self.say(each) for each in every]
        return [each for each in said if each is not None and not (self.quiet and each.verdict == "green")]


# subjects of analyses that results name; others are runs
KINDS: Final[dict[str, type[Subject]]] = {"statics": Equilibria, "kinematics": Positions}


@cache
def every_check() -> tuple[Check[Any, Any], ...]:
    """All checks, in the order of their lines."""
    modules = [import_module(f"{checks.__name__}.{module.name}") for module in iter_modules(checks.__path__)]
    found = [check for module in modules for check in getattr(module, "CHECKS", ())]
    return tuple(sorted(found, key=lambda check: check.place))


# a run that grew beyond all bounds is red, not a warning
@np.errstate(over="ignore", invalid="ignore", divide="ignore")
@all_kept()
def assess(subject: Subject, given: Mapping[str, Any] | None = None) -> Trust:
    """The trust report of a subject.

    given : what checks have found already, by their names, also of checks that do not look at such subjects.
    """
    found, lines = dict(given or {}), dict[str, list[Item]]()
    applying = [check for check in every_check() if check.applies(subject)]
    others = found.keys() - {check.name for check in applying}
    more = (next(check for check in every_check() if check.name == name) for name in others)
    applying = sorted([*applying, *more], key=lambda check: check.place)
    for check in sorted(applying, key=lambda check: check.last):
        if check.name not in found and not check.lacks(subject):
            seen = subject.with_lines(_in_order(applying, lines)) if check.last else subject
            looked = check.look(seen)
            if looked is not None and looked != []:
                found[check.name] = looked
        lines[check.name] = check.lines(found.get(check.name))
    items = _in_order(applying, lines)
    kept = {check.name: plain(found[check.name]) for check in applying if check.name in found}
    light = worst(item for check in applying if not check.apart for item in lines[check.name])
    return Trust(light, subject.outcome, kept, items)


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


def lines_apart() -> frozenset[str]:
    """Names of the lines that turn no light."""
    return frozenset(check.line or check.name for check in every_check() if check.apart)


def thresholds_of(result: Readable, *, quiet: bool = True) -> dict[str, Threshold]:
    """Thresholds of the lines of such results by their names; those of lines that are told where they are not green only where `quiet`
    says so."""
    kind = KINDS.get(str(result.attributes.get("analysis", "")), Run)
    told = [each for each in every_check() if issubclass(kind, each.of) and (quiet or not each.quiet)]
    return {each.line or each.name: each.threshold for each in told if each.threshold is not None}


def titles() -> dict[str, str]:
    """Titles of lines by their names."""
    return {each.line or each.name: each.title for each in every_check() if each.title}


def _in_order(applying: Iterable[Check[Any, Any]], lines: Mapping[str, list[Item]]) -> tuple[Item, ...]:
    return tuple(item for check in applying for item in lines.get(check.name, ()))
