"""References of a comparison of methods: whether they may have the same error, so that errors measured against them say nothing."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Methods
from nivel.results.trust import Item, number


@dataclass(frozen=True)
class Held:
    """Names of the references, their own errors as shares of the size, or radians, and why each may miss something; empty where nothing
    says so."""

    names: tuple[str, ...]
    errors: tuple[float, ...]
    blind: tuple[str, ...]


def look(subject: Methods) -> Held:
    """The references, the best first."""
    every = subject.references
    return Held(
        tuple(each.name for each in every), tuple(each.error for each in every), tuple(each.blind for each in every)
    )


def say(found: Held) -> Item:
    """Whether errors of motions are known."""
    limits = "(green with two references of different methods that miss nothing)"
    if not found.names:
        return Item("references", "amber", f"References: there are none, so no error of a motion is known {limits}")
    blind = next((each for each in found.blind if each), "")
    if all(found.blind):
        several = "all of them" if len(found.names) > 1 else "the only one"
        said = f"{several} may have the same error as the runs: {blind}; errors of motions may be larger than they are shown"
        return Item("references", "amber", f"References: {said} {limits}")
    if blind:
        names = ", ".join(name for name, why in zip(found.names, found.blind, strict=True) if why)
        return Item("references", "amber", f"References: {names} may have an error that is not known: {blind} {limits}")
    if len(found.names) == 1:
        return Item("references", "amber", f"References: {found.names[0]} alone, which no other method checks {limits}")
    errors = " and ".join(number(each) for each in found.errors)
    said = f"{' and '.join(found.names)}, whose own errors are {errors}, check each other"
    return Item("references", "green", f"References: {said} {limits}")


CHECKS = (Check("references", Methods, look, say, 10, (), "References"),)
