"""Rows of run.stages and entries of run.numbers of the multistep methods, and how a change of a state is measured."""

from __future__ import annotations

import numpy as np

from nivel.native.function import leaf

# Rows of run.stages, all (ny,): the known part of an implicit equation, the rate of its iterate, its prediction; five stages of a
# one-step method; rates and states accepted, newest first.
KNOWN, RATE, PREDICTED, WORK, RATES, STATES = 0, 1, 2, 3, 8, 13
ROWS = 17
# Entries of run.numbers: share of the rate in the equations that run.matrix is for [s] (0: none), accepted states in the history, the
# step between them [s].
SHARE, PAST, SPACING = 0, 1, 2
NUMBERS = 3


@leaf
def larger(largest, change, weight):
    """The larger one of `largest` and |change|/weight; NaN once anything is NaN."""
    share = np.abs(change)
    if share > 0.0:
        share /= weight
    return largest if share <= largest else share + 0.0 * largest
