"""First-order states whose errors the tolerance hardly controls: they stay far below the scales by which these are measured."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.trust.check import Check, Need
from nivel.analysis.trust.subject import Run
from nivel.results.peaks import peak
from nivel.results.trust import Item, number

# A state whose values stay below this share of its scale is not followed, and where the tolerance is finer below the share of which that is
# FOLLOWED.
SMALL, FOLLOWED = 0.01, 1e-4


def _controls_errors(run: Run) -> bool:
    facts = run.prepared.integrator
    return bool(facts.chooses_steps or facts.optional_control or facts.residual)


TOLERANCE = Need("a method with a tolerance", _controls_errors)


@dataclass(frozen=True)
class SmallState:
    """A first-order state whose `largest` magnitude stayed far below its `scale`, by which its errors were measured."""

    name: str
    largest: float
    scale: float


def look(run: Run) -> list[SmallState]:
    """The small states; scales of components of circuits are those of their components."""
    small = min(SMALL, (run.plan.settings.tolerance or 1.0) / FOLLOWED)
    out, components = [], {component.name for component in run.machine.hydraulics}
    for fact in run.prepared.motion.system.states:
        if fact.integral or fact.name.partition(".")[0] in components:
            continue
        largest = peak(run.result, fact.result).value
        if not fact.sampled and 0.0 < largest < small * fact.scale:
            out.append(SmallState(fact.name, largest, fact.scale))
    return out


def say(found: SmallState) -> Item:
    """A state of which the tolerance says little."""
    said = f"the largest value of {found.name} is {number(found.largest)}, its scale is {number(found.scale)}: the tolerance hardly held"
    section, name = ("states", found.name)
    if found.name.startswith("control."):
        section, name = found.name.split(".")[:2]
    advice = f"write `{section}: {{{name}: {{scale: {found.largest:.1g}}}}}`"
    return Item("states", "amber", f"States: {said} it; {advice}", row=found.name)


CHECKS = (Check("states", Run, look, say, 400, (TOLERANCE,), "States"),)
