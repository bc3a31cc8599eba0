"""Formulations by name. This file imports no kernel: a formulation's module is loaded, and compiled, when it is used."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class FormulationFacts:
    """Where a formulation's kernels are (`correction`: its direct correction), and what its state looks like.

    velocities a rigid body, and whether normalisation is a row: see `nivel.system.system.Equations`.
    """

    module: str
    correction: str
    velocities: int
    normalisation: bool


FORMULATIONS: dict[str, FormulationFacts] = {
    "lagrange": FormulationFacts("nivel.motion.lagrange", "nivel.motion.lagrange_correction", 7, normalisation=True),
    "newton-euler": FormulationFacts(
        "nivel.motion.newton_euler", "nivel.motion.newton_euler_correction", 6, normalisation=False
    ),
}
