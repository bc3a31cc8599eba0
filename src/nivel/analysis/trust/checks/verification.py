"""Verification: what has examined a result beside its computation, and what of it nothing has. It has no line, the headline tells it."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.checks.followed import not_compared
from nivel.analysis.trust.other_elements import Compared
from nivel.analysis.trust.subject import Equilibria, Positions, Run, Sweep
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
        return Verification((), ("the motion, as no second run was made",))
    by, lacks = examined_elements(run.machine, run.elements)
    return Verification((f"a second run with {run.second.refinement.words}", *by), lacks)


def look_at_equilibria(subject: Equilibria) -> Verification:
    """The balance of forces, and the equilibria with other elements."""
    by, lacks = examined_elements(subject.machine, subject.elements)
    return Verification(("the balance of forces in every state", *by), lacks)


def look_at_positions(subject: Positions) -> Verification:
    """Constraints, and functions of drivers that are evaluated apart from them."""
    left = not_compared(subject.machine, subject.prepared.motion.system)
    lacks = (f"what {listed(left)} prescribe{'s' * (len(left) == 1)}",) if left else ()
    by = "the functions of its drivers, evaluated apart" if len(left) < len(subject.machine.drivers) else ""
    return Verification(tuple(each for each in ("the closed joints", by) if each), lacks)


def look_at_sweep(sweep: Sweep) -> Verification:
    """The variants that were verified, and those that were not."""
    ran = [each for each in sweep.variants if each.verdict]
    left = [each for each in ran if not each.verified]
    if len(left) == len(ran):
        return Verification((), ("the variants, as no second runs were made",))
    lacks = (f"{len(left)} of {len(ran)} variants",) if left else ()
    count = len(ran) - len(left)
    return Verification((f"second runs of {count} variants" if count > 1 else "a second run of the variant",), lacks)


def examined_elements(machine: MachineRecord, elements: Compared | None) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """(by, lacks) of the elements of beams, nothing of machines without."""
    if not machine.beams:
        return (), ()
    if elements is None or elements.errors is None:
        return (), ("the elements of beams",)
    return (f"a machine with {elements.pair.words} elements of beams",), ()


def listed(names: list[str]) -> str:
    """The first of them."""
    return ", ".join(names[:SHOWN]) + (f" and {len(names) - SHOWN} more" if len(names) > SHOWN else "")


CHECKS = (
    Check("verification", Run, look_at_run, lambda _: None, 1),
    Check("verification", Equilibria, look_at_equilibria, lambda _: None, 1),
    Check("verification", Positions, look_at_positions, lambda _: None, 1),
    Check("verification", Sweep, look_at_sweep, lambda _: None, 1),
)
