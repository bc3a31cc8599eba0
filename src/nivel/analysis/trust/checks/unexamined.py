"""Functions and contacts of a machine that nothing in the trust report has examined."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.curves.functions import LawCurve, varying
from nivel.analysis.curves.path import path_of
from nivel.analysis.trust.check import STEPS, Check
from nivel.analysis.trust.checks.contact import hulls_of, spheres_of
from nivel.analysis.trust.subject import Run
from nivel.machine.forces import Contact, Contacts
from nivel.machine.machine_record import MachineRecord
from nivel.results.trust import Item

SHOWN = 6  # names in a sentence


@dataclass(frozen=True)
class Unexamined:
    """Names of functions that read a signal which is not in the result, of Python laws, which are known at samples only, and of contacts of
    shapes that *Contact* does not know."""

    functions: tuple[str, ...]
    laws: tuple[str, ...]
    contacts: tuple[str, ...] = ()


def look(run: Run) -> Unexamined | None:
    """The functions of which *Loads* knows too little."""
    every = list(varying(run.machine))
    hidden = tuple(each.name for each in every if path_of(each, run.machine, run.result) is None)
    laws = tuple(each.name for each in every if isinstance(each.curve, LawCurve) and each.name not in hidden)
    contacts = _unknown_contacts(run.machine)
    return Unexamined(hidden, laws, contacts) if hidden or laws or contacts else None


def _unknown_contacts(machine: MachineRecord) -> tuple[str, ...]:
    """Contacts of two bodies that are neither two spheres nor two convex hulls, and those of many: steps may pass them."""
    known = {pair.contact for pair in (*spheres_of(machine), *hulls_of(machine))}
    pairs = [each.name for each in machine.forces if isinstance(each, Contact) and each.bodies is not None]
    many = [each.name for each in machine.forces if isinstance(each, Contacts)]
    return tuple(name for name in (*pairs, *many) if name not in known)


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
