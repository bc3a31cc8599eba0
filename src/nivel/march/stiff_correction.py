"""What the correction of the loop does to stiff springs, kept out of the past of BDF.

The direct correction moves a state onto the constraints by the change d that is least in the metric of the masses. Stiff springs are
stretched by that: a crank that is turned back to its driver pulls at the spring on it, while the rocker at the other end rests. The next
step finds the rocker where the spring wants it. Its past, which d has not moved, is out of place by about d, so that its speed comes out
wrong by d/h, its acceleration and with it the load on the driver by d/h²: that would decide how long steps are, and the shorter the worse.

So the past follows by the change that is least in the metric M + s² K, s = h/c_1, which closes the constraints as d does and stretches no
stiff spring: positions by (1 - s ∂f/∂y)⁻¹ of what d moves positions by, velocities by that of what it moves velocities by. Where the last
error had nothing stiff in it the past follows by d.

The rate of the accepted state is that of stretched springs too: where a polynomial begins anew, it is taken only where it is slow.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import leaf
from nivel.kernels.record import record_at
from nivel.kernels.status import OK
from nivel.march.exact_matrix import solve_matrix
from nivel.march.run import run_at
from nivel.march.step_control import EXACT, size
from nivel.march.variable_workspace import CHANGE, ENERGIES, FAST, SCALED, SHARE, SLOPE, SLOW, STIFF, Z

# What passes (1 - s ∂f/∂y)⁻¹ so many times is slow; a change of rates is taken for slow where that leaves as much of it.
FOLDS, MOSTLY = 3, 0.5


@leaf
def count_positions(machine, run):
    """How many positions stand before the velocities in y."""
    newton = record_at(machine).newton
    return np.int64(run.y.shape[0]) - newton.place.shape[0] - newton.state.shape[0] - ENERGIES


@leaf
def follow(machine, history):
    """The value of the polynomial after the correction of the loop, which is in y. Returns a status."""
    run = run_at(history)
    stages, n = run.stages, run.y.shape[0]
    positions, value, moved, sped = count_positions(machine, run), stages[Z], stages[SLOW], stages[FAST]
    for i in range(n):
        stages[CHANGE, i] = run.y[i] - value[i]
    if run.numbers[STIFF] == 0.0 or run.numbers[SHARE] == 0.0 or size(run, stages[CHANGE]) <= EXACT:
        for i in range(n):
            value[i] = run.y[i]
        return OK
    for i in range(n):
        moved[i] = stages[CHANGE, i] if i < positions else 0.0
        sped[i] = 0.0 if i < positions else stages[CHANGE, i]
    status = solve_matrix(machine, history, moved)
    if status == OK:
        status = solve_matrix(machine, history, sped)
    for i in range(n):
        value[i] += moved[i] if i < positions else sped[i]
    return status


@leaf
def find_slope(machine, history):
    """CHANGE := the rate to begin anew with: that of the accepted state, or where it is that of a stretched spring the one of the
    polynomial."""
    run = run_at(history)
    stages, n, status = run.stages, run.y.shape[0], OK
    slow, change = stages[SLOW], stages[CHANGE]
    for i in range(n):
        change[i] = run.rate[i] - stages[SLOPE, i] / run.numbers[SCALED]
        slow[i] = change[i] if i < n - ENERGIES else 0.0
    before = size(run, slow)
    for _ in range(FOLDS):
        if status == OK and run.numbers[SHARE] > 0.0:
            status = solve_matrix(machine, history, slow)
    is_slow = status != OK or size(run, slow) >= MOSTLY * before
    for i in range(n):
        change[i] = run.rate[i] if is_slow else stages[SLOPE, i] / run.numbers[SCALED]
