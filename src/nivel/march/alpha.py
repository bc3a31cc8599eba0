"""Newmark's method, HHT-α and generalised-α, on rotations as a Lie group (Brüls, Cardona, Arnold 2012), as index 3 or as stabilised
index 2; constants: `nivel.march.alpha_constants`.

The positions of a step are base ∘ exp(h v₀ + h² (…)), so Euler parameters stay of unit length and no frame is special.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import entry, leaf, stage
from nivel.kernels.record import record_at
from nivel.kernels.status import OK
from nivel.march.residual_newton import iterate
from nivel.march.run import EVALUATIONS, REACHED, RESTART, STEP, TIME, run_at, step_signature
from nivel.march.step_control import is_fresh

# entries of run.numbers
ALPHA_M, ALPHA_F, BETA, GAMMA, DELTA_M, DELTA_F, THETA = 0, 1, 2, 3, 4, 5, 6
NUMBERS = 7
# rows of run.stages: a and v̇ of the accepted state, w and ẋ; v̇ and ẋ of the state before it, one after another; work
A, VDOT, W, XDOT, BEFORE, AHEAD = 0, 1, 2, 3, 4, 5
ROWS = 6
# a difference over this share of a step gives v̈ of the start to half the digits
DIFFERENCE = 1e-4


@leaf
def start(evaluate, machine, history, h):
    """Accelerations, rates and multipliers of the accepted state. a approximates v̇ at t + (α_m - α_f) h (Arnold, Brüls, Cardona 2015):
    a start with v̇ itself would cost the multipliers of the first steps an order. Returns a status."""
    run, record = run_at(history), record_at(machine)
    newton, residual, c, stages = record.newton, record.residual, run.numbers, run.stages
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(run.y.shape[0]) - n - states - 2
    for k in range(residual.row.shape[0]):
        residual.lam[k] = record.constraints.lam[residual.row[k]]
    ahead = DIFFERENCE * h
    for i in range(run.y.shape[0]):
        run.trial[i] = run.y[i] + ahead * run.rate[i]
    status = evaluate(machine, run.clock[TIME] + ahead, run.trial, stages[AHEAD])
    run.counter[EVALUATIONS] += 1
    shift = (c[ALPHA_M] - c[ALPHA_F]) * h / ahead
    for k in range(n + states):
        rate = run.rate[positions + k]
        slope = stages[AHEAD, positions + k] - rate if status == OK else 0.0
        shifted = rate + (shift if k < n else (c[DELTA_M] - c[DELTA_F]) * h / ahead) * slope
        if k < n:
            stages[VDOT, k], stages[A, k] = rate, shifted
            residual.vdot[k] = rate
        else:
            stages[XDOT, k - n], stages[W, k - n] = rate, shifted
            newton.rate[k - n] = rate
    keep_unknowns(run, newton, residual)
    newton.kept[0] = 0.0
    run.counter[RESTART] = 0
    return status


@stage
def keep_unknowns(run, newton, residual):
    """Remember the unknowns of the accepted state, from which and from the next ones those after it are extrapolated."""
    kept, n, states = run.stages[BEFORE], residual.vdot.shape[0], newton.state.shape[0]
    for k in range(n):
        kept[k] = residual.vdot[k]
    for k in range(states):
        kept[n + k] = newton.rate[k]
    for k in range(residual.lam.shape[0]):
        newton.lam_before[k] = residual.lam[k]


@stage
def extrapolate(run, newton, residual):
    """The unknowns at the end of the step as they would be if they changed by as much as in the step before."""
    kept, n, states = run.stages[BEFORE], residual.vdot.shape[0], newton.state.shape[0]
    for k in range(n):
        now = residual.vdot[k]
        residual.vdot[k], kept[k] = 2.0 * now - kept[k], now
    for k in range(states):
        now = newton.rate[k]
        newton.rate[k], kept[n + k] = 2.0 * now - kept[n + k], now
    for k in range(residual.lam.shape[0]):
        now = residual.lam[k]
        residual.lam[k], newton.lam_before[k] = 2.0 * now - newton.lam_before[k], now


@stage
def prepare(run, newton, n, h):
    """The state as a function of the unknowns. Returns cq, cv, cx."""
    c, stages, y = run.numbers, run.stages, run.y
    states = newton.state.shape[0]
    positions = np.int64(y.shape[0]) - n - states - 2
    share = (1.0 - c[ALPHA_F]) / (1.0 - c[ALPHA_M])
    share_x = (1.0 - c[DELTA_F]) / (1.0 - c[DELTA_M])
    for i in range(y.shape[0]):
        newton.base[i] = y[i]
    for k in range(n):
        a, v = stages[A, k], y[positions + k]
        # a₁ = share v̇₁ + known
        known = (c[ALPHA_F] * stages[VDOT, k] - c[ALPHA_M] * a) / (1.0 - c[ALPHA_M])
        newton.speed[k] = v + h * ((1.0 - c[GAMMA]) * a + c[GAMMA] * known)
        newton.turn[k] = h * v + h * h * ((0.5 - c[BETA]) * a + c[BETA] * known)
        newton.correction[k] = 0.0
    for k in range(states):
        w = stages[W, k]
        known = (c[DELTA_F] * stages[XDOT, k] - c[DELTA_M] * w) / (1.0 - c[DELTA_M])
        newton.state[k] = y[positions + n + k] + h * ((1.0 - c[THETA]) * w + c[THETA] * known)
    return h * h * c[BETA] * share, h * c[GAMMA] * share, h * c[THETA] * share_x


@stage
def accept_step(machine, run, n, h):
    """The state reached, and what the next step needs to know of it."""
    record = record_at(machine)
    newton, residual, c, stages = record.newton, record.residual, run.numbers, run.stages
    states, last = newton.state.shape[0], run.y.shape[0] - 2
    for k in range(n):
        v, before = residual.vdot[k], stages[VDOT, k]
        known = c[ALPHA_F] * before - c[ALPHA_M] * stages[A, k]
        stages[A, k] = ((1.0 - c[ALPHA_F]) * v + known) / (1.0 - c[ALPHA_M])
        stages[VDOT, k] = v
    for k in range(states):
        known = c[DELTA_F] * stages[XDOT, k] - c[DELTA_M] * stages[W, k]
        stages[W, k] = ((1.0 - c[DELTA_F]) * newton.rate[k] + known) / (1.0 - c[DELTA_M])
        stages[XDOT, k] = newton.rate[k]
    for i in range(last):
        run.y[i] = residual.y[i]
    # energies: the trapezoidal rule
    for i in range(2):
        run.y[last + i] += 0.5 * h * (run.rate[last + i] + record.control.power[i])


@entry(step_signature)
def alpha(evaluate, machine, history):
    """One step."""
    run, record = run_at(history), record_at(machine)
    n, h = record.residual.vdot.shape[0], run.clock[STEP]
    if is_fresh(run):
        status = start(evaluate, machine, history, h)
        if status != OK:
            return status
    extrapolate(run, record.newton, record.residual)
    cq, cv, cx = prepare(run, record.newton, n, h)
    status = iterate(machine, history, run.clock[REACHED], cq, cv, cx)
    if status == OK:
        accept_step(machine, run, n, h)
    return status
