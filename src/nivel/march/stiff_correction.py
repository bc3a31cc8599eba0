"""What the correction of the loop does to stiff springs, kept out of the past of BDF.

The direct correction moves a state onto the constraints by the change d that is least in the metric of the masses. Stiff springs are
stretched by that: a crank that is turned back to its driver pulls at the spring on it, while the rocker at the other end rests. The next
step finds the rocker where the spring wants it. Its past, which d has not moved, is out of place by about d, so that its speed comes out
wrong by d/h, its acceleration and with it the load on the driver by d/h²: that would decide how long steps are, and the shorter the worse.

So the past follows by the change that is least in the metric M + s² K, s = h/c_1, which closes the constraints as d does and stretches no
stiff spring: positions by (1 - s ∂f/∂y)⁻¹ of what d moves positions by, velocities by that of what it moves velocities by. Of a machine
without stiff springs that is d.
"""

from __future__ import annotations

from nivel.kernels.compile import leaf
from nivel.kernels.status import OK
from nivel.march.exact_matrix import solve_matrix
from nivel.march.run import run_at
from nivel.march.step_control import EXACT, size
from nivel.march.stiff_vibration import count_positions
from nivel.march.variable_workspace import CHANGE, FAST, SHARE, SLOW, Z


@leaf
def follow(machine, history):
    """The value of the polynomial after the correction of the loop, which is in y. Returns a status."""
    run = run_at(history)
    stages, n = run.stages, run.y.shape[0]
    positions, value, moved, sped = count_positions(machine, run), stages[Z], stages[SLOW], stages[FAST]
    for i in range(n):
        stages[CHANGE, i] = run.y[i] - value[i]
    if run.numbers[SHARE] == 0.0 or size(run, stages[CHANGE]) <= EXACT:
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
