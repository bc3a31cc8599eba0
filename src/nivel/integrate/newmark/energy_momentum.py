"""The energy–momentum method: a fixed step over which energy, and the momenta that the machine's symmetries keep, stay what they are
(Simo, Tarnow, Wong 1992; with constraints Gonzalez 1999). Order 2; no damping at any frequency.
The equations: `nivel.motion.energy_momentum_residual`.

Positions are closed at the ends of steps; velocities are only in the mean over a step, so that Ċ is of the order of the step squared.
"""

import numpy as np

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import EVALUATIONS, REACHED, STEP, STEP_SIGNATURE, run_at
from nivel.integrate.newmark.newton_state import set_state
from nivel.integrate.newmark.residual_newton import TOLERANCE as NEWTON_TOLERANCE
from nivel.integrate.newmark.residual_newton import find_change, iterate, take_change
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import RESIDUAL, record_at
from nivel.motion.energy_momentum_residual import begin_interval
from nivel.native.entry import entry
from nivel.native.function import leaf

# Changes after those that the tolerance asks for: what the iteration leaves in the velocities is energy. A smaller tolerance might be one
# that the round-off of the positions never lets it meet.
FURTHER = 2


@leaf
def prepare(machine, history, h):
    """The state as a function of accelerations that hold over the step, and as a first guess those of the accepted state."""
    run, record = run_at(history), record_at(machine)
    newton, residual, y = record.newton, record.residual, run.y
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(y.shape[0]) - n - states - 2
    # y[0] is a place, its scale at least the machine's length
    begin_interval(machine, h, run.scale[0])
    for i in range(y.shape[0]):
        newton.base[i] = y[i]
        residual.y[i] = y[i]
    for k in range(n):
        v = y[positions + k]
        newton.speed[k], newton.turn[k], newton.correction[k] = v, h * v, 0.0
        residual.vdot[k] = run.rate[positions + k]
    for k in range(states):
        newton.state[k], newton.rate[k] = y[positions + n + k], run.rate[positions + n + k]
    for k in range(residual.lam.shape[0]):
        residual.lam[k] = record.constraints.lam[residual.row[k]]


@entry(STEP_SIGNATURE)
def energy_momentum(evaluate, machine, history):
    """One step."""
    run, record = run_at(history), record_at(machine)
    h, end, last = run.clock[STEP], run.clock[REACHED], run.y.shape[0] - 2
    prepare(machine, history, h)
    cq, cv, cx = 0.5 * h * h, h, h
    status = iterate(machine, history, end, cq, cv, cx, record.newton.settings[NEWTON_TOLERANCE], False)
    for k in range(FURTHER + 1):
        if status == OK:
            status = call_hook(machine, RESIDUAL, 0, end)
            run.counter[EVALUATIONS] += 1
        if status != OK:
            return status
        if k < FURTHER:
            find_change(machine, cq, cv)
            take_change(record.newton, record.residual, record.newton.b, record.newton.moved, 1.0)
            set_state(machine, cq, cv, cx)
    for i in range(last):
        run.y[i] = record.residual.y[i]
    for i in range(2):
        run.y[last + i] += h * record.control.power[i]
    return OK


FACTS = (
    IntegratorFacts(
        "energy-momentum",
        energy_momentum,
        order=2,
        kind="corrector",
        needs="whole steps",
        over_step="nivel.motion.energy_momentum_residual",
    ),
)
