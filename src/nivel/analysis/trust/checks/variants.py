"""Variants of a sweep: how many came to their end, and how far each can be trusted."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Sweep, Variant
from nivel.results.trust import Item, Verdict

ENDED = ("done", "stopped")  # outcomes of variants that ran as intended
WORST = ("red", "amber")  # of which one is named


@dataclass(frozen=True)
class Ran:
    """How many variants there are, how many came to their end, and the first one that did not, with the reason."""

    count: int
    ended: int
    first: str
    reason: str


@dataclass(frozen=True)
class Judged:
    """How many variants have a red and an amber trust report, of how many; the first of the worst and what is said of it."""

    count: int
    red: int
    amber: int
    worst: str
    headline: str


def look_at_ends(sweep: Sweep) -> Ran:
    """Variants that failed, were refused or not run."""
    others = [each for each in sweep.variants if each.outcome not in ENDED]
    first, reason = (others[0].name, others[0].reason or others[0].outcome) if others else ("", "")
    return Ran(len(sweep.variants), len(sweep.variants) - len(others), first, reason)


def say_ends(found: Ran) -> Item:
    """How many came to their end."""
    said = f"Variants: {found.ended} of {found.count} came to their end"
    if found.ended == found.count:
        return Item("variants", "green", f"{said} (green if all do)")
    verdict: Verdict = "amber" if found.ended else "red"
    text = f"{said}; the first that did not is {found.first}: {found.reason} (green if all do, amber if some do)"
    return Item("variants", verdict, text, row=found.first)


def look_at_verdicts(sweep: Sweep) -> Judged:
    """The trust reports of the variants."""
    by: dict[str, list[Variant]] = {
        colour: [each for each in sweep.variants if each.verdict == colour] for colour in WORST
    }
    worst = next((each[0] for each in by.values() if each), None)
    count = sum(bool(each.verdict) for each in sweep.variants)
    return Judged(count, len(by["red"]), len(by["amber"]), worst.name if worst else "", worst.headline if worst else "")


def say_verdicts(found: Judged) -> Item:
    """The worst of them."""
    if not found.red and not found.amber:
        text = f"Verdicts: no trust report of {found.count} is amber or red (the colour is that of the worst)"
        return Item("verdicts", "green", text)
    said = f"Verdicts: of {found.count} trust reports {found.red} are red and {found.amber} amber"
    text = f"{said}; {found.worst}: {found.headline} (the colour is that of the worst)"
    return Item("verdicts", "red" if found.red else "amber", text, row=found.worst)


CHECKS = (
    Check("variants", Sweep, look_at_ends, say_ends, 12, (), "Variants"),
    Check("verdicts", Sweep, look_at_verdicts, say_verdicts, 14, (), "Verdicts"),
)
