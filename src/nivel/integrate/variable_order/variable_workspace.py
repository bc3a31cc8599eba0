"""Rows of run.stages and entries of run.numbers of the multistep methods that choose their steps and orders."""

from __future__ import annotations

MOST_ORDER = 12
# Rows of run.stages, all (ny,): the Nordsieck array, the same predicted; the correction e of this step, D_q of the last one, the rate of
# the iterate, its change; h ẏ of the last corrected polynomial; what of e counts as an error.
Z, PREDICTED = 0, MOST_ORDER + 1
CORRECTION, LAST, RATE, CHANGE, SLOPE, ESTIMATE = 26, 27, 28, 29, 30, 31
ROWS = 32
# Entries of run.numbers: the step that Z is scaled with [s]; how much an iteration reduces the error; the h/c_1 that run.matrix is for [s]
# (0: none); accepted steps until the order is looked at again; the step of LAST [s] (0: none).
SCALED, CONTRACTION, SHARE, WAIT, LAST_STEP = 0, 1, 2, 3, 4
# … and where vectors begin there: the last steps, newest first [s]; ξ; the coefficients c; work for polynomials
STEPS, XI, C, WORK = 5, 20, 35, 50
NUMBERS = 66
