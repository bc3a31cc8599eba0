"""Degrees of freedom of the machine."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Equilibria, Positions, Run
from nivel.results.trust import Item


@dataclass(frozen=True)
class Freedom:
    """Degrees of freedom of velocities, and of positions where that is another number. modes : of flexible bodies among them. drivers :
    motions that are prescribed. circuit : whether there are no bodies, and a circuit is all."""

    velocities: int | None = None
    positions: int | None = None
    modes: int = 0
    drivers: int = 0
    circuit: bool = False


def look(subject: Run | Equilibria) -> Freedom:
    """As the machine is built."""
    prepared = subject.prepared
    redundancy, drivers = prepared.redundancy, prepared.drivers
    if not prepared.motion.system.bodies:
        return Freedom(0, circuit=True)
    if isinstance(subject, Equilibria):
        return Freedom(redundancy.degrees_of_freedom, drivers=drivers)
    modes = len(prepared.motion.system.modes)
    return Freedom(redundancy.degrees_of_freedom, redundancy.position_freedoms, modes, drivers)


def say(found: Freedom) -> Item | None:
    """How many there are."""
    count = found.velocities
    if count is None:
        return None
    if found.circuit:
        return Item("degrees_of_freedom", "green", "Freedom: a circuit without bodies (green)")
    if count < 1 and found.drivers:
        prescribed = "the driver prescribes" if found.drivers == 1 else f"{found.drivers} drivers prescribe"
        return Item("degrees_of_freedom", "green", f"Freedom: 0 degrees of freedom, {prescribed} every motion (green)")
    if count < 1:
        said = "Freedom: 0 degrees of freedom: nothing can move (green with 1 or more)"
        return Item("degrees_of_freedom", "amber", said)
    degrees = "1 degree of freedom" if count == 1 else f"{count} degrees of freedom"
    if found.positions is not None and found.positions > count:
        degrees += f" of velocities, {found.positions} of positions, as wheels roll without slip"
    modes = f", with {found.modes} modes of flexible bodies" if found.modes else ""
    return Item("degrees_of_freedom", "green", f"Freedom: {degrees}{modes} (green with 1 or more)")


CHECKS = (
    Check("degrees_of_freedom", (Run, Equilibria), look, say, 50, (), "Freedom"),
    Check(
        "degrees_of_freedom",
        Positions,
        lambda subject: Freedom(0, drivers=subject.prepared.drivers),
        lambda _: None,
        50,
    ),
)
