"""Functions and contacts of a machine that nothing in the trust report has examined."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.curves.functions import LawCurve, varying
from nivel.analysis.curves.path import path_of
from nivel.analysis.trust.check import STEPS, Check
from nivel.analysis.trust.subject import Run
from nivel.analysis.trust.touching_pairs import spheres_among
from nivel.machine.forces import Contacts
from nivel.results.trust import Item

SHOWN = 6  # names in a sentence


@dataclass(frozen=True)
class Unexamined:
    """Names of functions that read a signal which is not in the result, of Python laws, which are known at samples only, and of heaps in
    which too many spheres are too fast for *Contact*."""

    functions: tuple[str, ...]
    laws: tuple[str, ...]
    contacts: tuple[str, ...] = ()


def look(run: Run) -> Unexamined | None:
    """The functions of which *Loads* knows too little."""
    every = list(varying(run.machine))
    hidden = tuple(each.name for each in every if path_of(each, run.machine, run.result) is None)
    laws = tuple(each.name for each in every if isinstance(each.curve, LawCurve) and each.name not in hidden)
    contacts = _unknown_contacts(run)
    return Unexamined(hidden, laws, contacts) if hidden or laws or contacts else None


def _unknown_contacts(run: Run) -> tuple[str, ...]:
    """Heaps of which too many spheres are fast."""
    machine, result = run.machine, run.result
    heaps = (each for each in machine.forces if isinstance(each, Contacts))
    return tuple(each.name for each in heaps if spheres_among(machine, each, result) is None)


def say(found: Unexamined) -> Item:
    """What was not looked at, by name. The line is green: nothing is known against the result."""
    said = []
    if found.functions:
        said.append(f"what the steps miss of {_listed(found.functions)}, which read signals that are not in the result")
    if found.laws:
        said.append(f"what {_listed(found.laws)} may do within a sixteenth of a step: Python functions have no bounds")
    if found.contacts:
        said.append(f"whether bodies pass through each other within a step at {_listed(found.contacts)}")
    return Item("unexamined", "green", f"Not examined: {'; '.join(said)}")


def _listed(names: tuple[str, ...]) -> str:
    shown = ", ".join(names[:SHOWN])
    return f"{shown} and {len(names) - SHOWN} more" if len(names) > SHOWN else shown


CHECKS = (Check("unexamined", (Run,), look, say, 910, (STEPS,), "Not examined"),)
