"""Redundant constraints, and whether reactions are unique."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Equilibria, Positions, Run
from nivel.results.trust import Item


@dataclass(frozen=True)
class Redundancy:
    """Rows that repeat others, and the joints whose reactions depend on which of them are kept."""

    rows: tuple[str, ...] = ()
    joints: tuple[str, ...] = ()


def look(subject: Run | Equilibria | Positions) -> Redundancy:
    """As the machine was assembled."""
    redundancy = subject.prepared.redundancy
    return Redundancy(tuple(redundancy.redundant_rows), tuple(redundancy.non_unique_joints))


def say(found: Redundancy) -> Item:
    """Constraints that repeat others."""
    if not found.rows:
        said = "Redundancy: no redundant constraints, every reaction is unique (green if none)"
        return Item("redundancy", "green", said)
    count = len(found.rows)
    repeats = "1 constraint row repeats others" if count == 1 else f"{count} constraint rows repeat others"
    unsure = (
        f"how {', '.join(found.joints)} share the load is not unique: `nivel check` lists the unique components, and the range "
        "of the others"
        if found.joints
        else "the reactions are unique"
    )
    rows = ", ".join(found.rows)
    text = f"Redundancy: {repeats} ({rows}). They do not change the motion; {unsure} (green if none, amber otherwise)"
    return Item("redundancy", "amber", text)


CHECKS = (Check("redundancy", (Run, Equilibria, Positions), look, say, 60, (), "Redundancy"),)
