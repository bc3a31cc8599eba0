"""Effective mass of each constraint row: the diagonal of S = C_q M⁻¹ C_qᵀ in a given state."""

from __future__ import annotations

import numpy as np

from nivel.analysis.assembly.always_dependent_rows import LEAST
from nivel.analysis.assembly.equations import MotionEquations
from nivel.system.system import Array

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
