"""The numbers of penalty methods: how stiff each row is, how violations are fed back.

Eliminating the accelerations from M v̇ + C_qᵀ α (C_q v̇ - γ + 2 Ω μ Ċ + Ω² C) = Q (report 44, eq. 116) gives the multipliers from
(S + 1/α) λ = C_q M⁻¹ Q - γ + 2 Ω μ Ċ + Ω² C with S = C_q M⁻¹ C_qᵀ: the same equations, well conditioned for every α, and solvable where
rows depend on each other. 1/S_kk is the mass that row k moves, so α = factor/S_kk needs no guess.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import TypeVar

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.unique_reactions import LEAST
from nivel.errors import Fault, ModelError, refuse
from nivel.machine.settings.run import Penalty, SimulationSettings
from nivel.motion.catalogue import FormulationFacts
from nivel.system.system import Array, System
from nivel.words.wording import unknown_word

PLACE = "simulation.penalty"
# Ω times the step, without an Ω of the user: violations die out within some ten steps, and explicit methods stay stable
FEEDBACK = 0.1
# mobility 1/S_kk of a row, as a share of the largest, below which it counts as this share
IMMOBILE = 1e-6
# α of redundant rows, in multiples of the mass that a row moves. A state that is open by a share of 1/√factor, as one predicted may be,
# makes dependent rows look independent; each iteration leaves 1/factor of what the one before left
REDUNDANT = 1e4


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
    mobile, least = _mobilities(penalised, y)
    alpha, factor = _stiffness(motion.system, penalty, facts)
    held = np.where((alpha > 0.0) & (mobile > least), alpha * mobile, np.inf)
    if np.any(held < 1.0):
        raise ModelError(_too_soft(motion, alpha, mobile, int(np.argmin(held))))
    saddle.shift[:] = np.where(alpha > 0.0, 1.0 / np.where(alpha > 0.0, alpha, 1.0), np.maximum(mobile, least) / factor)
    record.control.rank[0] = rows
    record.control.iterations[0] = penalty.iterations if facts.iterated else 1
    record.control.settled[0] = penalty.tolerance**2
    return penalised


def soft_rows(motion: MotionEquations, y: Array) -> Array:
    """1/α of each row of S in the matrix by which implicit methods meet all rows of a redundant machine, in least squares; y : the start.

    Iterations are those of the augmented Lagrangian, so nothing is left open.
    """
    return np.maximum(*_mobilities(motion, y)) / REDUNDANT


# A row that can be moved by this share of what it was at first, or less, cannot be moved: of 1e-11 radians beside a position in line.
IMMOVABLE = 1e-22


def mobility(motion: MotionEquations, y: Array) -> Array:
    """1/S_kk of a row is the mass that it moves [1/kg for rows in metres, rad²/(N m s²)]; (K,) in the order of the rows of S."""
    saddle = motion.system.record.saddle
    motion.evaluate(0.0, y)
    diagonal = np.zeros(len(saddle.row))
    diagonal[saddle.order] = saddle.S[saddle.S_start[1:].astype(int) - 1]
    return diagonal


def bound_pivots(motion: MotionEquations, y: Array) -> None:
    """Note in the record which pivots of S are nothing but round-off, judged by the mobility at the start y.

    In relative coordinates a row may lose all its mobility: the bars of its loop are in line. Then its diagonal is no scale. Rows that are
    left out stay so.
    """
    record = motion.system.record
    units = record.constraints.scale[record.saddle.row] ** 2
    largest = np.max(mobility(motion, y) / units, initial=0.0)
    least = record.saddle.least
    bound = np.maximum(IMMOVABLE * largest * units[record.saddle.order], LEAST)
    least[:] = np.where(least < 0.0, -bound, bound)


def _mobilities(motion: MotionEquations, y: Array) -> tuple[Array, Array]:
    """1/S_kk of each row, and the least that counts: what nothing can move still needs a penalty. Where this is all rows, they move nothing
    less than the whole machine."""
    record, mobile = motion.system.record, mobility(motion, y)
    units = record.constraints.scale[record.saddle.row] ** 2
    largest = np.max(mobile / units, initial=0.0) or 1.0 / (record.bodies.mass.sum() * motion.system.size**2)
    return mobile, IMMOBILE * units * largest


Settings = TypeVar("Settings")


def of_rows(system: System, given: Mapping[str, Settings], place: str) -> dict[int, Settings]:
    """Row → its own settings; those of a row by its name go before those of its joint.

    place : of the settings, e.g. `simulation.baumgarte`. Raises ModelError with every name that no constraint has.
    """
    constrained = set(system.record.saddle.row.tolist())
    faults: list[Fault] = []
    of_joints: dict[int, Settings] = {}
    of_single: dict[int, Settings] = {}
    for name, settings in given.items():
        rows = [k for k, row in enumerate(system.rows) if name == row or row.startswith(f"{name}.")]
        if not rows:
            names = [*dict.fromkeys(row.split(".")[0] for row in system.rows), *system.rows]
            faults.append(Fault.at(f"{place}.rows.{name}", unknown_word(name, names, "constraint")))
        elif not constrained.intersection(rows):
            message = (
                f"`{name}` is no constraint in relative coordinates: it carries a body of the tree; write `coordinates: absolute`, or "
                f"`cut: [{name.split('.')[0]}]`"
            )
            faults.append(Fault.at(f"{place}.rows.{name}", message))
        (of_single if "." in name else of_joints).update(dict.fromkeys(rows, settings))
    refuse(faults)
    return {**of_joints, **of_single}


def refuse_unknown_rows(system: System, settings: SimulationSettings, *, penalised: bool) -> None:
    """Refuse names of the settings in use that no constraint has."""
    if penalised:
        of_rows(system, settings.penalty.rows, "simulation.penalty")
    if settings.stabilisation == "baumgarte" and settings.baumgarte is not None:
        of_rows(system, settings.baumgarte.rows, "simulation.baumgarte")


def _stiffness(system: System, penalty: Penalty, facts: FormulationFacts) -> tuple[Array, Array]:
    """α of each row of S, 0 where it has none of its own, and the factor that it has then."""
    rows = system.record.saddle.row
    alpha = np.full(len(rows), penalty.alpha or 0.0)
    factor = np.full(len(rows), penalty.factor or facts.factor)
    own = of_rows(system, penalty.rows, PLACE)
    for k, row in enumerate(rows.tolist()):
        if row in own and (own[row].alpha is not None or own[row].factor is not None):
            alpha[k], factor[k] = own[row].alpha or 0.0, own[row].factor or factor[k]
    return alpha, factor


def _too_soft(motion: MotionEquations, alpha: Array, mobile: Array, k: int) -> Fault:
    row = motion.system.rows[motion.system.record.saddle.row[k]]
    message = (
        f"α = {alpha[k]:.3g} does not hold {row}, which moves a mass of {1.0 / mobile[k]:.3g}: α has to be many times that, 1e4 or more; "
        f"`factor` in place of `alpha` takes that share for every row"
    )
    return Fault.at("simulation.penalty.alpha", message)


def feedback(system: System, penalty: Penalty, step: float, corrected: bool) -> Array:
    """(K, 2) 2 Ω μ and Ω² of all rows for runs with this step [s]; without an Ω of the user none where states are `corrected` after every
    step."""
    usual = penalty.omega
    if usual is None:
        usual = 0.0 if corrected else FEEDBACK / step
    out = np.tile([2.0 * usual * penalty.mu, usual**2], (len(system.rows), 1))
    for row, own in of_rows(system, penalty.rows, PLACE).items():
        omega = usual if own.omega is None else own.omega
        out[row] = 2.0 * omega * (penalty.mu if own.mu is None else own.mu), omega**2
    return out
