"""Frictions with stiction in Newton's iteration: each slides one way, or the other, or sticks, and with every turn its equation is another.

The projection of `nivel.kernels.residual.friction_residual` says after every change which it is (the active set of semi-smooth Newton
methods:
Hintermüller, Ito, Kunisch 2003). With one friction that ends after two or three turns. Frictions that load each other may turn in a
circle, although there is a solution: after MOST_TURNS only about half of those that would turn do so, at random.

Stribeck's curve may fall so steeply within a step that a speed has two neighbours that solve the equations as well, one before the fall and
one at its foot, and the tangent leads nowhere. There the iteration goes from speed to speed, with the curve of the speed before.
"""

import numpy as np

from nivel.kernels.algebra.rows import copy
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import RESIDUAL, record_at
from nivel.native.function import leaf

# Turns in one iteration after which not all frictions turn at once.
MOST_TURNS = 3.0
# From speed to speed it comes to one that belongs to its curve, or to the foot of the fall. Where it does neither in so many iterations, it
# passes the place where the former has just ceased to be, and the curve is taken at the speed there.
MOST_STEEP = 12.0
# entries of `tally`
TURNS, STEEP, SEED = 0, 1, 2


@leaf
def next_seed(seed):
    """The minimal standard generator of numbers that look random (Park, Miller 1988)."""
    return seed * 16807 % 2147483647


@leaf
def begin_turns(residual):
    """At the begin of an iteration: what frictions do follows from the state."""
    residual.tally[TURNS], residual.tally[STEEP], residual.tally[SEED] = 0.0, 0.0, 1.0
    for k in range(residual.branch.shape[0]):
        residual.bidden[k], residual.frozen[k] = np.nan, np.nan


@leaf
def release(residual):
    """Let all frictions slide or stick as follows from the state."""
    for k in range(residual.branch.shape[0]):
        residual.bidden[k] = np.nan


@leaf
def keep_made(residual):
    """Remember what frictions did when the matrix was made."""
    copy(residual.branch, residual.made)


@leaf
def turn_some(residual):
    """Bid about half of the frictions that have turned to remain as Newton's matrix has them."""
    for k in range(residual.branch.shape[0]):
        if np.sign(residual.branch[k]) != np.sign(residual.made[k]):
            seed = next_seed(np.int64(residual.tally[SEED]))
            residual.tally[SEED] = seed
            residual.bidden[k] = np.nan if seed % 2 == 0 else np.sign(residual.made[k])


@leaf
def freeze(residual):
    """Take Stribeck's curve, where it is steep, at the speeds there are."""
    for k in range(residual.branch.shape[0]):
        if np.abs(residual.branch[k]) > 1.0:
            residual.frozen[k] = residual.rate[k]


@leaf
def follow_turns(machine, t):
    """After an evaluation of the residual: (status, whether a friction has another equation than Newton's matrix, whether some were bidden
    to remain, whether a friction is where Stribeck's curve is steep)."""
    residual, status = record_at(machine).residual, OK
    others, turned, steep = 0, 0, 0
    for k in range(residual.branch.shape[0]):
        others += residual.branch[k] != residual.made[k]
        turned += np.sign(residual.branch[k]) != np.sign(residual.made[k])
        steep += np.abs(residual.branch[k]) > 1.0
    if steep > 0:
        residual.tally[STEEP] += 1.0
        if residual.tally[STEEP] > MOST_STEEP:
            freeze(residual)
    bidding = turned > 0 and residual.tally[TURNS] >= MOST_TURNS
    if turned > 0:
        residual.tally[TURNS] += 1.0
    if bidding:
        turn_some(residual)
        status = call_hook(machine, RESIDUAL, 0, t)
    return status, others > 0, bidding, steep > 0
