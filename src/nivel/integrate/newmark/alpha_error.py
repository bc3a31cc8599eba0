"""The error of a step of Newmark's method, HHT-α and generalised-α, apart for what is slow and what vibrates.

With v̈ and v⃛ from differences of v̇, a step errs by (⅙ - β - ½ Δ) h³ v̈ in q and by -(1/12 + ½ Δ²) h³ v⃛ in v, Δ = α_m - α_f. Errors of slow
motion add up: of each a step may make its part of the time of the run. In vibrations faster than the step they do not: a method that
lets no amplitude grow can be wrong by twice the amplitude, after any number of steps. So there the amplitude counts, as a displacement;
what it is as a speed, or as an acceleration, says nothing: of stiff springs both are large and change their sign. But the cubic between two
steps takes the speeds at its ends for true: what it sways by for those that a vibration leaves there counts as its amplitude does.

The two are told apart by `nivel.integrate.newmark.alpha_error` for steps REACH times as long, so that also a step of the length of a
vibration, in
which its differences are largest, leaves it out. Filtering costs a matrix: it is asked for where the plain error would shorten a step,
and as long as it helps.
"""

from __future__ import annotations

import numpy as np

from nivel.integrate.loop.run import END, FACTORISATIONS, START, TOLERANCE, run_at
from nivel.integrate.loop.step_control import EXACT, fastest_turn
from nivel.integrate.newmark.alpha_step import (
    ALPHA_F,
    ALPHA_M,
    BEFORE,
    BETA,
    DELTA_F,
    DELTA_M,
    GAMMA,
    LAST_STEP,
    THETA,
    VDOT,
    XDOT,
)
from nivel.integrate.newmark.residual_newton import apply_turns
from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.lanes import slope, unit
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_family
from nivel.kernels.record.record import NONE, record_at
from nivel.kernels.residual.tangent import POSITIONS, differentiate, load_twin
from nivel.kernels.solve.newton_matrix import factorise_entries, solve_entries
from nivel.native.function import leaf


@leaf
def find_filter(machine, t, cq, cv, cx):
    """The factors at the state, accelerations and multipliers in `residual`, frictions with stiction neither holding nor braking what they
    hold: an error of that is one of its place for ever. Returns a status."""
    record = record_at(machine)
    newton, stick = record.newton, record.control.stick
    tau, stick[0] = stick[0], np.inf
    status = differentiate(machine, t, cq, cv, cx, POSITIONS)
    stick[0] = tau
    for p in range(newton.value.shape[0]):
        newton.filter.value[p] = newton.value[p]
    return factorise_entries(newton, newton.filter, record.control.failure) if status == OK else status


@leaf
def keep_slow(machine, t, x):
    """Overwrite x, accelerations and then rates of states of forces, by what of it is slow. Returns a status."""
    record = record_at(machine)
    newton, here = record.newton, record.residual
    b, n, states = newton.filter.b, here.vdot.shape[0], newton.state.shape[0]
    twin, moving = load_twin(machine)
    for k in range(n):
        moving.vdot[k] += unit(0, real(x[k]))
    status = call_family(newton.address[1], twin, 0, t)
    if status != OK:
        return status
    for k in range(n):
        b[k] = slope(moving.value[k], 0)
    for k in range(states):
        b[n + k] = x[n + k]
    for k in range(n + states, b.shape[0]):
        b[k] = 0.0
    solve_entries(newton, newton.filter)
    apply_turns(newton, b)
    for k in range(n + states):
        x[k] = b[k]
    return OK


# What steps may be wrong by in all, as a share of the tolerance.
SHARE = 0.3
# A step over a jump of the accelerations errs in proportion to its length, as its part of the tolerance gets smaller. The part is no
# smaller than that of a step of this share of the time of the run: with less than a million such steps that is no more than SHARE.
LEAST_PART = 1e-6
# The filter is for steps so many times as long, but for none in which the machine moves by more than a radian or its own length: what
# changes in the time of that is slow. Steps in which it moves by more than the second number are too long for the two to be told apart.
REACH, MOST_MOVED = 30.0, 0.1
# What passes the filter so many times is slow.
FOLDS = 4
# rows of run.stages: h² times the second derivative of v̇ and ẋ, and their change in the step; what is fast of these; the change of the
# velocities
BEND, CHANGE, FAST_BEND, FAST_CHANGE, SPEED = 7, 8, 9, 10, 11
# A cubic through equal positions with velocities u and -u at the ends of a step h sways by h u/4. They change by 2 u then, accelerations
# by 4 u/h.
BY_SPEED, BY_CHANGE = 1.0 / 8.0, 1.0 / 16.0


@leaf
def part_of(run, h):
    """What a step h may be wrong by, as a share of the scales."""
    span = run.clock[END] - run.clock[START]
    return max(SHARE * run.clock[TOLERANCE] * max(h / span, LEAST_PART), EXACT)


@leaf
def find_differences(run, residual, newton, h):
    """Fill BEND and CHANGE."""
    stages, n, last = run.stages, residual.vdot.shape[0], run.numbers[LAST_STEP]
    for k in range(n + newton.state.shape[0]):
        now = residual.vdot[k] if k < n else newton.rate[k - n]
        start = stages[VDOT, k] if k < n else stages[XDOT, k - n]
        ratio = h / last if last > 0.0 else 1.0
        stages[CHANGE, k] = now - start
        stages[BEND, k] = 2.0 * (now - start - ratio * (start - stages[BEFORE, k])) / (1.0 + 1.0 / ratio)
        if last == 0.0:
            stages[BEND, k] *= 2.0


@leaf
def size_of_error(run, newton, h):
    """Largest error in q and v by CHANGE and BEND, as a share of the scales."""
    c, stages, scale = run.numbers, run.stages, run.scale
    n, states = newton.place.shape[0], newton.state.shape[0]
    positions = np.int64(scale.shape[0]) - n - states - 2
    shift = c[ALPHA_M] - c[ALPHA_F]
    of_position = np.abs(1.0 / 6.0 - c[BETA] - 0.5 * shift)
    of_velocity = 1.0 / 12.0 + 0.5 * shift * shift + np.abs(0.5 - c[GAMMA] - shift)
    largest = 0.0
    for k in range(n + states):
        share = of_velocity * np.abs(h * stages[BEND, k]) / scale[positions + k]
        if k < n:
            share = max(share, of_position * np.abs(h * h * stages[CHANGE, k]) / scale[newton.place[k, 0]])
        if not share <= largest:
            largest = share
    return largest


@leaf
def size_of_displacement(run, newton, row, cq, cx):
    """Largest displacement by the accelerations in this row of the stages, as a share of the scales."""
    n, states, scale = newton.place.shape[0], newton.state.shape[0], run.scale
    positions = np.int64(scale.shape[0]) - n - states - 2
    largest = 0.0
    for k in range(n + states):
        at = newton.place[k, 0] if k < n else positions + k
        share = (cq if k < n else cx) * np.abs(run.stages[row, k]) / scale[at]
        if not share <= largest:
            largest = share
    return largest


@leaf
def plain_error(machine, history, h):
    """The error of the step just attempted as a share of the allowed one, all of it taken for slow. Fills BEND and CHANGE."""
    run, record = run_at(history), record_at(machine)
    find_differences(run, record.residual, record.newton, h)
    return size_of_error(run, record.newton, h) / part_of(run, h)


@leaf
def rate_of_motion(machine, history):
    """How fast the machine moves in the state last evaluated, in radians or its own lengths per second."""
    run, newton = run_at(history), record_at(machine).newton
    y = record_at(machine).residual.y
    n, states = newton.place.shape[0], newton.state.shape[0]
    positions = np.int64(y.shape[0]) - n - states - 2
    largest = fastest_turn(machine)
    for k in range(n):
        if newton.place[k, 1] == NONE:
            largest = max(largest, np.abs(y[positions + k]) / run.scale[newton.place[k, 0]])
    return largest


@leaf
def load_speeds(run, residual, newton):
    """SPEED := the change of the velocities in the step just attempted."""
    n, speed = residual.vdot.shape[0], run.stages[SPEED]
    positions = np.int64(run.y.shape[0]) - n - newton.state.shape[0] - 2
    speed[:] = 0.0
    for k in range(n):
        speed[k] = residual.y[positions + k] - run.y[positions + k]


@leaf
def size_of_sway(run, residual, newton, h):
    """What the cubic of this step sways by for the vibrations in its velocities, of which CHANGE and SPEED are what is slow, as a share of
    the scales. What turns with a stiff rod changes its velocity as a vibration does, but not its acceleration; vibrations that an undamped
    method has stepped over change their acceleration by more than their velocity says."""
    stages, scale, n = run.stages, run.scale, residual.vdot.shape[0]
    positions = np.int64(scale.shape[0]) - n - newton.state.shape[0] - 2
    largest = 0.0
    for k in range(n):
        of_change = residual.vdot[k] - stages[VDOT, k] - stages[CHANGE, k]
        of_speed = residual.y[positions + k] - run.y[positions + k] - stages[SPEED, k]
        sway = min(BY_CHANGE * np.abs(h * h * of_change), BY_SPEED * np.abs(h * of_speed))
        largest = max(largest, sway / scale[newton.place[k, 0]])
    return largest


@leaf
def split(machine, history, t, row, fast):
    """Overwrite this row of the stages by F⁴ of it, what is slow; `fast` by F (1 - F)³ of it. Returns a status."""
    run = run_at(history)
    stages = run.stages
    status = OK
    for k in range(stages.shape[1]):
        stages[fast, k] = 0.0
    for fold in range(FOLDS):
        if status == OK:
            status = keep_slow(machine, t, stages[row])
        sign = 1.0 if fold == 0 else (-3.0 if fold == 1 else (3.0 if fold == 2 else -1.0))
        for k in range(stages.shape[1]):
            stages[fast, k] += sign * stages[row, k]
    return status


@leaf
def filtered_error(machine, history, t, h):
    """The error of the step just attempted, to time t: of the slow part, and twice the amplitude of the vibrations, each as a share of the
    allowed one. Overwrites BEND and CHANGE. Infinite where they cannot be found, or would be those of the motion itself.

    A vibration ω of amplitude a changes its displacement in a step by C = ω h a, the change by B = ω h C; of long steps both are about a.
    """
    run, record = run_at(history), record_at(machine)
    newton, c = record.newton, run.numbers
    rate = rate_of_motion(machine, history)
    if rate * h > MOST_MOVED:
        return np.inf, np.inf
    reach = min(REACH * h, 1.0 / max(rate, 1e-300))
    share, share_x = (1.0 - c[ALPHA_F]) / (1.0 - c[ALPHA_M]), (1.0 - c[DELTA_F]) / (1.0 - c[DELTA_M])
    cq, cv, cx = reach * reach * c[BETA] * share, reach * c[GAMMA] * share, reach * c[THETA] * share_x
    status = find_filter(machine, t, cq, cv, cx)
    run.counter[FACTORISATIONS] += 1
    if status == OK:
        status = split(machine, history, t, BEND, FAST_BEND)
    if status == OK:
        status = split(machine, history, t, CHANGE, FAST_CHANGE)
    load_speeds(run, record.residual, newton)
    for _ in range(FOLDS):
        if status == OK:
            status = keep_slow(machine, t, run.stages[SPEED])
    if status != OK:
        return np.inf, np.inf
    change, bend = (
        size_of_displacement(run, newton, FAST_CHANGE, cq, cx),
        size_of_displacement(run, newton, FAST_BEND, cq, cx),
    )
    amplitude = max(change * change / bend, bend) if bend > 0.0 else 0.0
    slow = size_of_error(run, newton, h) / part_of(run, h)
    largest = max(2.0 * amplitude, size_of_sway(run, record.residual, newton, h))
    return slow, largest / max(SHARE * run.clock[TOLERANCE], EXACT)
