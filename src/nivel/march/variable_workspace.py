"""Rows of run.stages and entries of run.numbers of the multistep methods that choose their steps and orders."""

from __future__ import annotations

MOST_ORDER = 12
# Rows of run.stages, all (ny,): the Nordsieck array, the same predicted; the correction e of this step, D_q of the last one, the rate of
# the iterate, its change; h ẏ of the last corrected polynomial; what of e counts as an error; work of `nivel.march.stiff_vibration`.
Z, PREDICTED = 0, MOST_ORDER + 1
CORRECTION, LAST, RATE, CHANGE, SLOPE, ESTIMATE = 26, 27, 28, 29, 30, 31
SLOW, FAST = 32, 33
ROWS = 34
# Entries of run.numbers: the step that Z is scaled with [s]; how much an iteration reduces the error; the h/c_1 that run.matrix is for [s]
# (0: none); accepted steps until the order is looked at again; the step of LAST [s] (0: none).
SCALED, CONTRACTION, SHARE, WAIT, LAST_STEP = 0, 1, 2, 3, 4
# … and where vectors begin there: the last steps, newest first [s]; ξ; the coefficients c; work for polynomials
STEPS, XI, C, WORK = 5, 20, 35, 50
# … and of vibrations: how far they are dealt with, steps since they were looked at, after how many they are again; the longest step with
# free orders since then [s], how often they grew, the step that they held [s], the one last looked
# at in vain [s].
VIBRATING, UNCHECKED, PATIENCE, LONGEST, TRIES, ENTRY, LOOKED = 66, 67, 68, 69, 70, 71, 72
# … and for how many more errors a part of them is taken for stiff
STIFF = 73
# … and the time [s] that tells what vibrates from what is slow, kept while order two goes on
SPAN = 74
NUMBERS = 75
# energies at the end of y, on which nothing depends
ENERGIES = 2
