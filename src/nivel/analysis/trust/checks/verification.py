"""Verification: what has examined a result beside its computation, and what of it nothing has. It has no line, the headline tells it."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.checks.followed import not_compared
from nivel.analysis.trust.other_elements import Compared
from nivel.analysis.trust.subject import (
    Actuated,
    Curve,
    Equilibria,
    Led,
    Linearisation,
    Methods,
    Positions,
    Reach,
    Run,
    Sweep,
)
from nivel.machine.machine_record import MachineRecord

SHOWN = 4  # names in a sentence


@dataclass(frozen=True)
class Verification:
    """What has examined a result, and what of it nothing has, in words that stand after "by" and after "not verified:"."""

    by: tuple[str, ...]
    lacks: tuple[str, ...] = ()


def look_at_run(run: Run) -> Verification:
    """The second run, and the one with other elements."""
    if run.second is None or not len(run.second.result.time):
        return Verification((), ("no second run was made",))
    by, lacks = examined_elements(run.machine, run.elements)
    return Verification((f"a second run with {run.second.refinement.words}", *by), lacks)


def look_at_equilibria(subject: Equilibria) -> Verification:
    """The balance of forces, and the equilibria with other elements."""
    by, lacks = examined_elements(subject.machine, subject.elements)
    return Verification(("the balance of forces in every state", *by), lacks)


def look_at_positions(subject: Positions) -> Verification:
    """Constraints, and functions of drivers that are evaluated apart from them."""
    by, lacks = _followed(subject)
    return Verification(("the closed joints", *by), lacks)


def look_at_efforts(subject: Actuated) -> Verification:
    """The balance of forces, what the motion says of itself, and the functions of the drivers."""
    by, lacks = _followed(subject)
    motion = subject.result.trust
    if not motion.verified:
        lacks = ("the motion", *lacks)
    return Verification(("the balance of forces at every time", *by), lacks)


def _followed(subject: Positions | Actuated) -> tuple[tuple[str, ...], tuple[str, ...]]:
    left = not_compared(subject)
    lacks = (f"what {listed(left)} prescribe{'s' * (len(left) == 1)}",) if left else ()
    compared = len(left) < len(subject.drivers)
    return ("the functions of its drivers, evaluated apart",) if compared else (), lacks


def look_at_led(subject: Led) -> Verification:
    """The postures themselves: where they put the point, evaluated at each of them."""
    return Verification(("the place of the point in every posture, with its joints closed",))


def look_at_reach(subject: Reach) -> Verification:
    """The kinematic analyses of both ways, and the turning points of the curve of positions."""
    ways = "the closed joints of both ways"
    if subject.range.full_turn or not (subject.range.low_reason or subject.range.high_reason):
        return Verification((ways,))
    if not subject.turning:
        return Verification((ways,), ("the ends of the range",))
    return Verification((ways, "the turning points of the curve of positions"))


def look_at_curve(_: Curve) -> Verification:
    """The joints at all places."""
    return Verification(("the closed joints at every position",))


def look_at_linear(subject: Linearisation) -> Verification:
    """What eigenvalues are of: an equilibrium, or a motion that was followed; and vibrations with other elements."""
    if subject.unsteady or any(each.jumps for each in subject.kinks):
        return Verification((), ("the linear equations, which describe no motion",))
    by = "A at two later moments of the motion" if subject.moves else "the equilibrium of the state"
    judged = subject.others is not None and not subject.others.why
    more, lacks = _elements(subject.machine, subject.others.pair.words if subject.others and judged else "")
    run = (f"the run to the state at {subject.reached:.6g} s",) if subject.reached else ()
    return Verification((by, *more), (*lacks, *run))


def look_at_methods(subject: Methods) -> Verification:
    """The references, each of which checks the other."""
    references, rows = subject.references, [each for each in subject.rows if each.outcome == "done"]
    if not references or not rows:
        return Verification((), ("the motions, as there is no reference",))
    if any(each.blind for each in references):
        return Verification((), ("errors of motions, as references may have the same",))
    if len(references) == 1:
        return Verification((references[0].name,), ("the reference, as no other method came to the end",))
    return Verification(tuple(each.name for each in references))


def look_at_sweep(sweep: Sweep) -> Verification:
    """The variants that were verified, and those that were not."""
    ran = [each for each in sweep.variants if each.verdict]
    left = [each for each in ran if not each.verified]
    if len(left) == len(ran):
        return Verification((), (sweep.without,))
    count = len(ran) - len(left)
    lacks = (f"{len(left)} of {len(ran)} variants",) if left else ()
    return Verification((f"{sweep.by} of {count} variant{'s' * (count > 1)}",), lacks)


def examined_elements(machine: MachineRecord, elements: Compared | None) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """(by, lacks) of the elements of beams, nothing of machines without."""
    return _elements(machine, elements.pair.words if elements is not None and elements.errors is not None else "")


def _elements(machine: MachineRecord, words: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """words : which other elements there were; empty where none have told anything."""
    if not machine.beams:
        return (), ()
    return ((f"a machine with {words} elements of beams",), ()) if words else ((), ("the elements of beams",))


def listed(names: list[str]) -> str:
    """The first of them."""
    return ", ".join(names[:SHOWN]) + (f" and {len(names) - SHOWN} more" if len(names) > SHOWN else "")


CHECKS = (
    Check("verification", Run, look_at_run, lambda _: None, 1),
    Check("verification", Equilibria, look_at_equilibria, lambda _: None, 1),
    Check("verification", Positions, look_at_positions, lambda _: None, 1),
    Check("verification", Actuated, look_at_efforts, lambda _: None, 1),
    Check("verification", Led, look_at_led, lambda _: None, 1),
    Check("verification", Reach, look_at_reach, lambda _: None, 1),
    Check("verification", Curve, look_at_curve, lambda _: None, 1),
    Check("verification", Linearisation, look_at_linear, lambda _: None, 1),
    Check("verification", Methods, look_at_methods, lambda _: None, 1),
    Check("verification", Sweep, look_at_sweep, lambda _: None, 1),
)
