"""Damping by the method: energy that it takes from the motion, and takes from that of a second run with other steps too."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.trust.check import SECOND_RUN, Check, Need
from nivel.analysis.trust.subject import Run
from nivel.results.motion import common_frames
from nivel.results.scales import largest_energy
from nivel.results.trust import Item, quantity

# A loss of energy counts above this share of the largest energy; it does not get less where this share of it is left.
LOSS, STAYS = 1e-8, 0.7
IMPLICIT = Need("an implicit method", lambda run: run.prepared.integrator.needs != "evaluations")


@dataclass(frozen=True)
class Damped:
    """Energy [J] that the run lost, and what the second run did. method : the integrator. longer : the steps of the second run are."""

    lost: float
    lost_other: float
    method: str
    longer: bool


def look(run: Run) -> Damped | None:
    """Energy that the method takes from the motion whatever the step: None where it takes none that counts, or less with finer steps."""
    result, other, longer = run.result, run.finer.result, run.finer.refinement.left > 1.0
    if "energy_error" not in result.variables:
        return None
    first, second = common_frames(result.time, other.time)
    if not len(first):
        return None
    errors, others = result.array("energy_error")[first], other.array("energy_error")[second]
    k = int(np.argmin(errors))
    lost, lost_other = -float(errors[k]), -float(others[k])
    finer, coarser = (lost, lost_other) if longer else (lost_other, lost)
    scale = largest_energy(result, run.scales.size, at_rest=run.scales.at_rest)[0]
    if not (lost > LOSS * scale and finer > STAYS * coarser):
        return None
    return Damped(lost, lost_other, run.plan.settings.integrator, longer)


def say(found: Damped) -> Item:
    """How much it takes, and what to do."""
    steps = "longer" if found.longer else "finer"
    text = (
        f"Damped: {found.method} takes {quantity(found.lost, 'J')} from the motion, and {quantity(found.lost_other, 'J')} with {steps} "
        f"steps: vibrations faster than the steps are damped numerically; use steps of a tenth of their period, or add damping to the "
        f"model if these vibrations do not matter "
        f"(green if finer steps lose less, amber otherwise)"
    )
    return Item("damped", "amber", text, found.lost)


CHECKS = (
    Check("damped", Run, look, say, 330, (SECOND_RUN, IMPLICIT), "Damped", blind="their method damps vibrations"),
)
