"""Outcome: whether the analysis came to its end."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Actuated, Equilibria, Linearisation, Methods, Motion, Positions, Subject, Sweep
from nivel.results.trust import Item, Verdict

VERDICTS: dict[str, Verdict] = {"done": "green", "interrupted": "amber", "failed": "red", "running": "amber"}
SAID: dict[type[Subject], dict[str, str]] = {
    Motion: {
        "done": "the run reached its end",
        "interrupted": "interrupted; the result ends there",
        "failed": "the computation failed; the result ends there",
        "running": "the file was not closed: the run is still going on, or it was killed",
    },
    Equilibria: {
        "done": "every state of equilibrium was found",
        "interrupted": "interrupted; the result has the states up to there",
        "failed": "the computation failed; the result has the states up to there",
    },
    Positions: {
        "done": "every position was found",
        "interrupted": "interrupted; the result has the positions up to there",
        "failed": "the machine cannot move any further; the result has the positions up to there",
    },
    Actuated: {"done": "efforts were found for every time of the motion"},
    Linearisation: {"done": "the linear equations were found"},
    Methods: {"done": "every cell was tried", "interrupted": "interrupted; cells are missing"},
    Sweep: {
        "done": "every variant was tried",
        "interrupted": "interrupted; some variants are not run",
    },
}


@dataclass(frozen=True)
class Outcome:
    """How an analysis ended, in a word and a sentence."""

    outcome: str
    said: str


def look(subject: Subject) -> Outcome:
    """The outcome, with the failure or the event that ended it."""
    words = next((each for kind, each in SAID.items() if isinstance(subject, kind)), {})
    said = words.get(subject.outcome, subject.outcome)
    if isinstance(subject, Motion) and subject.stopped_by:
        said = f"the event {subject.stopped_by} ended the run, as intended"
    return Outcome(subject.outcome, f"{said}: {subject.failure}" if subject.failure else said)


def say(found: Outcome) -> Item:
    """The line of the outcome."""
    return Item("outcome", VERDICTS.get(found.outcome, "red"), f"Outcome: {found.said}")


CHECKS = (Check("outcome", Subject, look, say, 0, (), "Outcome"),)
