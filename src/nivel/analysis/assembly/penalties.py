"""The numbers of penalty methods: how stiff each row is, how violations are fed back.

Eliminating the accelerations from M v̇ + C_qᵀ α (C_q v̇ - γ + 2 Ω μ Ċ + Ω² C) = Q (report 44, eq. 116) gives the multipliers from
(S + 1/α) λ = C_q M⁻¹ Q - γ + 2 Ω μ Ċ + Ω² C with S = C_q M⁻¹ C_qᵀ: the same equations, well conditioned for every α, and solvable where
rows depend on each other. 1/S_kk is the mass that row k moves, so α = factor/S_kk needs no guess.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nivel.analysis.assembly.effective_mass import mobility
from nivel.analysis.assembly.equations import MotionEquations
from nivel.errors import Fault, ModelError
from nivel.machine.settings.run import Penalty, SimulationSettings
from nivel.motion.catalogue import FormulationFacts
from nivel.system.system import Array

# Ω times the step, without an Ω of the user: violations die out within some ten steps, and explicit methods stay stable
FEEDBACK = 0.1
# mobility 1/S_kk of a row, as a share of the largest, below which it counts as this share
IMMOBILE = 1e-6


def penalise(
    motion: MotionEquations, y: Array, settings: SimulationSettings, facts: FormulationFacts
) -> MotionEquations:
    """The same equations with penalties in place of multipliers, for the start y."""
    record, penalty = motion.system.record, settings.penalty
    rows = len(record.saddle.row)
    # dependent rows need no rank: S + 1/α is positive definite
    saddle = record.saddle._replace(dense=np.zeros((0, 0)), null=np.zeros((0, 0)), pivot=np.zeros(0, dtype=np.uint32))
    system = replace(motion.system, record=record._replace(saddle=saddle))
    penalised = MotionEquations(system, motion.kernels)
    mobile = mobility(penalised, y)
    size = motion.system.size
    units = record.constraints.scale[saddle.row] ** 2
    # what nothing can move still needs a penalty; where this is all rows, they move nothing less than the whole machine
    largest = np.max(mobile / units, initial=0.0) or 1.0 / (record.bodies.mass.sum() * size**2)
    least = IMMOBILE * units * largest
    if penalty.alpha and np.any(penalty.alpha * mobile[mobile > least] < 1.0):
        raise ModelError(_too_soft(motion, penalty.alpha, np.where(mobile > least, mobile, np.inf)))
    mobile = np.maximum(mobile, least)
    saddle.shift[:] = 1.0 / penalty.alpha if penalty.alpha else mobile / (penalty.factor or facts.factor)
    record.control.rank[0] = rows
    record.control.iterations[0] = penalty.iterations if facts.iterated else 1
    return penalised


def _too_soft(motion: MotionEquations, alpha: float, mobile: Array) -> Fault:
    k = int(np.argmin(mobile))
    row = motion.system.rows[motion.system.record.saddle.row[k]]
    message = (
        f"α = {alpha:.3g} does not hold {row}, which moves a mass of {1.0 / mobile[k]:.3g}: α has to be many times that, 1e4 or more; "
        f"`factor` in place of `alpha` takes that share for every row"
    )
    return Fault("", 0, 0, "simulation.penalty.alpha", message)


def feedback(penalty: Penalty, step: float, corrected: bool) -> tuple[float, float]:
    """(2 Ω μ, Ω²) for runs with this step [s]; without an Ω of the user none where states are `corrected` after every step."""
    omega = penalty.omega
    if omega is None:
        omega = 0.0 if corrected else FEEDBACK / step
    return 2.0 * omega * penalty.mu, omega**2
