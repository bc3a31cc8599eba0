"""Check of the trust report: what it needs, what it measures and what it says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, Generic, TypeVar

from nivel.analysis.trust.subject import Subject
from nivel.results.trust import Item, Threshold


@dataclass(frozen=True)
class Need:
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


@dataclass(frozen=True)
class Check(Generic[S, F]):
    """A check, made as `CHECKS` of a module of `nivel.analysis.trust.checks`.

    name : of what it finds, in `Trust.found`. of : kinds of subjects that it looks at. needs : what they must have.
    look : what it finds: a record, a list of them where each has a line, or None. The fields of records are numbers, texts, and records
    or tuples of these.
    say : the line of a record, None where nothing is to be said.
    place : of its lines in the report, which are in rising order. title : of its lines in the page. threshold : that its numbers are held
    against. line : the name of its lines, by default that of the check.
    blind : why a second run may be wrong alike where a line is not green; `{row}` and `{time}` are those of the line.
    quiet : green lines are not told. last : it looks at lines of the others, `subject.items`.
    """

    name: str
    of: type[S] | tuple[type[S], ...]
    look: Callable[[S], F | list[F] | None]
    say: Callable[[F], Item | None]
    place: int
    needs: tuple[Need, ...] = ()
    title: str = ""
    threshold: Threshold | None = None
    line: str = ""
    blind: str = ""
    quiet: bool = False
    last: bool = False

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
