"""Unresolved forces: those that work so much in a step of fixed size that their effect decays, or vibrates, within the step.

A damper takes from what it stops with a rate r = c/m the share 2 r h of its kinetic energy in a step h, as far as its power at the begin of
the step says; a spring with the frequency ω takes up to ω h. Where that is of the order of one no formula on steps h has its work right.
"""

from __future__ import annotations

import json
from dataclasses import dataclass

import numpy as np

from nivel.machine.forces import FORCES
from nivel.results.scales import Readable, largest_mechanical_energy

# Work in a step as a share of the largest energy from which on it is not followed, and of the energy error that it can explain.
FOLLOWED, EXPLAINS = 0.5, 0.01


@dataclass(frozen=True)
class Unresolved:
    """A force, the work [J] that its power at this time [s] does in a step [s], and the largest energy of the run [J]: kinetic, change of
    potential energy, or work of external forces. A slow machine under loads has far more of the latter than a force does in one step."""

    force: str
    work: float
    time: float
    step: float
    energy: float


def unresolved_force(result: Readable, error: float) -> Unresolved | None:
    """The force whose work in a step is largest, where it is too much for the step and of a size with the energy error [J]; None where
    there is none, and where steps are chosen."""
    settings = json.loads(str(result.attributes.get("settings", "{}")))
    if "step" not in settings or "tolerance" in settings or not len(result.time):
        return None
    step, energy = float(settings["step"]), largest_mechanical_energy(result)
    found = [Unresolved(name, work, time, step, energy) for name, work, time in _works(result, step)]
    worst = max(found, key=lambda each: each.work, default=None)
    if worst is None or worst.work < max(FOLLOWED * energy, EXPLAINS * error if np.isfinite(error) else 0.0):
        return None
    return worst


def _works(result: Readable, step: float) -> list[tuple[str, float, float]]:
    """(name, largest work in a step [J], its time [s]) of the forces that can be stiff and do any."""
    record = json.loads(str(result.attributes.get("machine_record", "{}")))
    # a load that is given, or dry friction, changes no faster than what makes it
    steady = [kind.model_fields["type"].default for kind in FORCES if not kind.stiff]
    out = []
    for force in record.get("forces", ()):
        variable = f"force.{force['name']}.power"
        if force["type"] in steady or variable not in result.variables:
            continue
        work = step * np.abs(result.array(variable))
        work[~np.isfinite(work)] = 0.0
        k = int(np.argmax(work)) if len(work) else 0
        if len(work) and work[k] > 0.0:
            out.append((force["name"], float(work[k]), float(result.time[k])))
    return out
