"""Formulations by name. This file imports no kernel: a formulation's module is loaded, and compiled, when it is used."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class FormulationFacts:
    """Where a formulation's kernels are, and what its state looks like: see `nivel.system.system.Equations`."""

    module: str
    velocities: int
    normalisation: bool


FORMULATIONS: dict[str, FormulationFacts] = {
    "lagrange": FormulationFacts("nivel.motion.lagrange", 7, normalisation=True),
    "newton-euler": FormulationFacts("nivel.motion.newton_euler", 6, normalisation=False),
}
