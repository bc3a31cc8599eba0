"""Start of Newmark's method, HHT-α and generalised-α, at the start and beyond a corner: accelerations, rates, and their slopes.

a approximates v̇ at t + (α_m - α_f) h (Arnold, Brüls, Cardona 2015): to begin with v̇ itself would cost the multipliers of the first steps
an order. But what decays, or vibrates, much faster than a step has a slope that says nothing of the step, ω h times the accelerations:
taken for true it would throw the velocities by as much. So what is fast is left out of steep slopes.
"""

import numpy as np

from nivel.integrate.loop.corners import before, jump_at
from nivel.integrate.loop.run import ALL_STEPS, FACTORISATIONS, RESTART, STEP, evaluate_at, run_at
from nivel.integrate.newmark.alpha_step import (
    AHEAD,
    ALPHA_F,
    ALPHA_M,
    BEFORE,
    BETA,
    DELTA_F,
    DELTA_M,
    GAMMA,
    GOES_ON,
    LAST_STEP,
    SMOOTHED,
    THETA,
    VDOT,
    XDOT,
    A,
    W,
)
from nivel.integrate.newmark.correction_slopes import (
    FAR,
    KEPT_LAM,
    KEPT_VDOT,
    MISSED,
    MOVED,
    MOVED_LAM,
    Y,
    copy_unknowns,
    size_of_moved,
)
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rotation import rates_of_parameters
from nivel.kernels.algebra.rows import advance, clear, copy
from nivel.kernels.core.lanes import is_whole, slope, unit
from nivel.kernels.core.number import number_of
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_family, call_hook
from nivel.kernels.record.record import NONE, RESIDUAL, record_at
from nivel.kernels.residual.residual import known_multiplier
from nivel.kernels.residual.tangent import POSITIONS, differentiate, load_twin, move_unknown
from nivel.kernels.solve.newton_matrix import factorise, solve
from nivel.native.function import leaf

# a difference over this share of a step gives slopes to half the digits
DIFFERENCE = 1e-4
# With slopes up to so many times the accelerations a decay is followed well enough: what they leave of a speed is less than half of it.
STEEP = 5.0
# Corners nearer to each other than so many of it are one.
NEXT = 10.0
# rows of run.stages, which errors use after a step: what is added to accelerations and rates, and by what these go on to change in a step,
# and what is fast
JUMP, SLOPE, FAST = 7, 8, 9


@leaf
def is_steep(run, newton):
    """Whether SLOPE is larger than STEEP times JUMP, as shares of the scales."""
    n, states, scale = newton.place.shape[0], newton.state.shape[0], run.scale
    positions = np.int64(scale.shape[0]) - n - states - 2
    jump, slope = 0.0, 0.0
    for k in range(n + states):
        jump = max(jump, np.abs(run.stages[JUMP, k]) / scale[positions + k])
        slope = max(slope, np.abs(run.stages[SLOPE, k]) / scale[positions + k])
    return slope > STEEP * jump


@leaf
def move_here(newton, residual, run, far, cq, cv, cx, accelerates):
    """Move the state in rows Y, KEPT_VDOT and KEPT_LAM of run.stages, `far` times, along the values of its rows MOVED and MOVED_LAM."""
    stages, n, states = run.stages, residual.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(run.y.shape[0]) - n - states - 2
    copy(stages[Y], residual.y)
    for k in range(n):
        along = far * real(stages[MOVED, k])
        p, axis = np.int64(newton.place[k, 0]), newton.place[k, 1]
        residual.y[positions + k] += cv * along
        residual.vdot[k] = stages[KEPT_VDOT, k] + (along if accelerates else 0.0)
        if axis == NONE:
            residual.y[p] += cq * along
        elif axis == 0:
            change = newton.last[0:4]
            turn = (along, far * real(stages[MOVED, k + 1]), far * real(stages[MOVED, k + 2]))
            rates_of_parameters(stages[Y, p : p + 4], turn, change)
            for i in range(4):
                residual.y[p + i] += cq * change[i]
    for k in range(n, n + states):
        residual.y[positions + k] += cx * (far * real(stages[MOVED, k]))
    for k in range(min(residual.lam.shape[0], run.y.shape[0])):
        residual.lam[k] = stages[KEPT_LAM, k] + (far * real(stages[MOVED_LAM, k]) if accelerates else 0.0)


@leaf
def add_mixed(machine, run, t, cq, cv, cx, of_result):
    """Add to newton.b the slopes of N x, or of -S y where it is `of_result`, by those of the matrix alone; x, y and its multipliers are in
    rows MOVED and MOVED_LAM of run.stages. Returns a status."""
    record, status = record_at(machine), OK
    newton, residual = record.newton, record.residual
    b, n, states, rows = newton.b, residual.vdot.shape[0], newton.state.shape[0], residual.lam.shape[0]
    first, size = n + states, size_of_moved(newton, run, cq, cv)
    if not size > 0.0:
        return OK
    far = FAR / size
    for sign in (1.0, -1.0):
        move_here(newton, residual, run, sign * far, cq, cv, cx, of_result)
        if status == OK:
            status = call_hook(machine, RESIDUAL, 0, t)
        share = (-sign if of_result else sign) / (2.0 * far)
        for k in range(n + states):
            found = residual.value[k] - real(residual.value[k])
            b[k] += share * found if k < n else -share * found
        for k in range(rows):
            row = first + k if k < residual.row.shape[0] else first + 2 * rows + k
            found = residual.value[row] - real(residual.value[row])
            if of_result:
                b[first + k] += share * found / (cq if k < residual.row.shape[0] else 1.0)
    return status


@leaf
def follow_matrices(machine, run, t, cq, coefficients, x):
    """Add to newton.b = E x its slopes by those of E = S⁻¹ N: S δ(E x) = N δx + δN x - δS E x, mixed derivatives of the residual
    by differences of its slopes, as in `nivel.integrate.newmark.correction_slopes`. cq : of N; coefficients : of S. Returns a status."""
    record, stages = record_at(machine), run.stages
    newton, residual = record.newton, record.residual
    b, n, room = newton.b, residual.vdot.shape[0], min(residual.lam.shape[0], run.y.shape[0])
    first = n + newton.state.shape[0]
    copy(residual.y, stages[Y])
    copy_unknowns(residual, run, KEPT_VDOT, KEPT_LAM)
    for k in range(first):
        stages[MOVED, k], stages[MISSED, k], b[k] = x[k], b[k], 0.0
    status = add_mixed(machine, run, t, cq, coefficients[1], coefficients[2], False)
    for k in range(first):
        stages[MOVED, k] = stages[MISSED, k]
    for k in range(room):
        stages[MOVED_LAM, k], b[first + k] = b[first + k], 0.0
    if status == OK:
        status = add_mixed(machine, run, t, coefficients[0], coefficients[1], coefficients[2], True)
    solve(machine)
    for k in range(first):
        b[k] += stages[MISSED, k]
    copy(stages[Y], residual.y)
    copy(stages[KEPT_VDOT], residual.vdot)
    copy(stages[KEPT_LAM], residual.lam)
    return status


@leaf
def keep_fast(machine, run, t, cq, coefficients, x):
    """x := E x of accelerations, then of rates of states of forces: E = (M + c_v D + c_q K)⁻¹ (c_v D + c_q K) along the constraints, with
    the factors there are. Of what decays with d or vibrates with ω that is (c_v d + c_q ω²)/(1 + c_v d + c_q ω²), of what is across the
    constraints nothing. coefficients : c_q, c_v and c_x; cq : that in the numerator, which may be 0. newton.change must be zero. Returns a
    status."""
    record, cv, cx = record_at(machine), coefficients[1], coefficients[2]
    newton, here = record.newton, record.residual
    b, n, states = newton.b, here.vdot.shape[0], newton.state.shape[0]
    twin, moving = load_twin(machine)
    for k in range(n + states):
        move_unknown(newton, moving, k, unit(0, real(x[k])), cq, cv, cx)
    for k in range(n):
        moving.vdot[k] = real(here.vdot[k])
    status = call_family(newton.address[1], twin, 0, t)
    if status != OK:
        return status
    for k in range(n + states):
        b[k] = (1.0 if k < n else -1.0) * slope(moving.value[k], 0)
    for k in range(n + states, b.shape[0]):
        b[k] = 0.0
    if is_whole(machine):
        twin, moving = load_twin(machine)
        for k in range(n + states):
            move_unknown(newton, moving, k, x[k] - real(x[k]), cq, cv, cx)
        for k in range(n):
            moving.vdot[k] = real(here.vdot[k])
        status = call_family(newton.address[1], twin, 0, t)
        for k in range(n + states):
            along = moving.value[k] - real(moving.value[k])
            b[k] += (1.0 if k < n else -1.0) * number_of(machine, along)
    solve(machine)
    if is_whole(machine) and status == OK:
        status = follow_matrices(machine, run, t, cq, coefficients, x)
    for k in range(n + states):
        x[k] = b[k]
    return status


@leaf
def leave_out_fast(machine, run, t, coefficients):
    """SLOPE := (1 - E)³ SLOPE, with the factors there are: of a fast decay less is left than of accelerations. Where steps are fixed,
    JUMP := (1 - E)² (1 + 2 E) JUMP too, which changes what is resolved only to the order of the method; E of dampers alone, for what stiff
    springs store is not lost. Chosen steps get as short as a decay asks for."""
    stages, newton = run.stages, record_at(machine).newton
    n = newton.place.shape[0] + newton.state.shape[0]
    for _ in range(3):
        for k in range(n):
            stages[FAST, k] = stages[SLOPE, k]
        if keep_fast(machine, run, t, coefficients[0], coefficients, stages[FAST]) == OK:
            for k in range(n):
                stages[SLOPE, k] -= stages[FAST, k]
    if run.counter[ALL_STEPS] == 0:
        return
    # (1 - E)² (1 + 2 E) = 1 - 3 E² + 2 E³
    for k in range(n):
        stages[FAST, k] = stages[JUMP, k]
    for weight in (0.0, 3.0, -2.0):
        if keep_fast(machine, run, t, 0.0, coefficients, stages[FAST]) == OK:
            run.numbers[SMOOTHED] = 1.0
            for k in range(n):
                stages[JUMP, k] -= weight * stages[FAST, k]


@leaf
def smooth(machine, run, t):
    """Leave what is fast out of a steep SLOPE and its JUMP. `residual` has the accelerations and multipliers of the state run.y at time
    t."""
    record = record_at(machine)
    newton, residual, c, stick = record.newton, record.residual, run.numbers, record.control.stick
    if not is_steep(run, newton):
        return
    copy(run.y, residual.y)
    clear(newton.change)
    h = run.clock[STEP]
    share, share_x = (1.0 - c[ALPHA_F]) / (1.0 - c[ALPHA_M]), (1.0 - c[DELTA_F]) / (1.0 - c[DELTA_M])
    cq, cv, cx = h * h * c[BETA] * share, h * c[GAMMA] * share, h * c[THETA] * share_x
    # stiction decays within a step by itself
    tau, stick[0] = stick[0], np.inf
    status = differentiate(machine, t, cq, cv, cx, POSITIONS)
    if status == OK and factorise(machine) == OK:
        leave_out_fast(machine, run, t, (cq, cv, cx))
    stick[0] = tau
    run.counter[FACTORISATIONS] += 1
    newton.kept[0] = 0.0


@leaf
def add(run, newton):
    """Add JUMP to accelerations and rates, and SLOPE to what they change by in a step."""
    c, stages, n = run.numbers, run.stages, newton.place.shape[0]
    for k in range(n + newton.state.shape[0]):
        jump, slope = stages[JUMP, k], stages[SLOPE, k]
        stages[BEFORE, k] += jump - slope
        if k < n:
            stages[VDOT, k] += jump
            stages[A, k] += jump + (c[ALPHA_M] - c[ALPHA_F]) * slope
        else:
            stages[XDOT, k - n] += jump
            stages[W, k - n] += jump + (c[DELTA_M] - c[DELTA_F]) * slope


@leaf
def find_slope(evaluate, machine, history, t, rate, ahead):
    """run.stages[AHEAD] := the rate a time `ahead` after the state run.y at time t, whose rate is `rate`. Returns a status."""
    run = run_at(history)
    advance(run.y, ahead, rate, run.trial)
    return evaluate_at(evaluate, machine, run, t + ahead, run.trial, run.stages[AHEAD])


@leaf
def start(evaluate, machine, history, t, h):
    """Accelerations, rates and multipliers of the state run.y at time t, whose rate is run.rate, for steps h."""
    run, record = run_at(history), record_at(machine)
    newton, residual, c, stages = record.newton, record.residual, run.numbers, run.stages
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(run.y.shape[0]) - n - states - 2
    for k in range(residual.lam.shape[0]):
        newton.lam[k] = residual.lam[k] = known_multiplier(record, k)
    status = find_slope(evaluate, machine, history, t, run.rate, DIFFERENCE * h)
    for k in range(n + states):
        rate = run.rate[positions + k]
        stages[JUMP, k] = rate
        stages[SLOPE, k] = (stages[AHEAD, positions + k] - rate) / DIFFERENCE if status == OK else 0.0
        stages[BEFORE, k] = 0.0
        if k < n:
            stages[A, k], stages[VDOT, k], residual.vdot[k] = 0.0, 0.0, rate
        else:
            stages[W, k - n], stages[XDOT, k - n] = 0.0, 0.0
    smooth(machine, run, t)
    add(run, newton)
    c[SMOOTHED] = 0.0
    newton.kept[0], c[LAST_STEP], c[GOES_ON] = 0.0, 0.0, 1.0
    run.counter[RESTART] = 0


@leaf
def go_on_beyond(evaluate, machine, history, t):
    """Let accelerations and rates be those beyond a corner at time t, where speeds do not jump. Returns a status.

    Corners next to each other are one, which is passed at the last of them: a jump of a load.
    To what the method has for them comes the difference of both sides, at one state, of themselves and of their slopes. To begin anew with
    those of the state would be wrong for stiff springs: the slope of their accelerations is ω² times the speed of vibrations that
    the steps before have stepped over.
    """
    run, record = run_at(history), record_at(machine)
    newton, residual, stages = record.newton, record.residual, run.stages
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(run.y.shape[0]) - n - states - 2
    aside, status = DIFFERENCE * run.numbers[LAST_STEP], OK
    begin, is_end = jump_at(machine, t, NEXT * aside)
    if not is_end:
        return OK
    for k in range(n + states):
        stages[JUMP, k], stages[SLOPE, k] = 0.0, 0.0
    for sign in (-1.0, 1.0):
        at = before(begin) if sign < 0.0 else t
        if status == OK:
            status = evaluate_at(evaluate, machine, run, at, run.y, run.scratch)
        if status == OK:
            for k in range(residual.lam.shape[0]):
                newton.lam[k] += sign * known_multiplier(record, k)
                newton.lam_before[k] += sign * known_multiplier(record, k)
            status = find_slope(evaluate, machine, history, at, run.scratch, sign * aside)
        if status == OK:
            for k in range(n + states):
                rate = run.scratch[positions + k]
                stages[JUMP, k] += sign * rate
                # backwards the difference is that of the slope with its sign changed, as it is to be taken away
                stages[SLOPE, k] += (stages[AHEAD, positions + k] - rate) / DIFFERENCE
    if status == OK:
        for k in range(n):
            residual.vdot[k] = stages[VDOT, k] + stages[JUMP, k]
        copy(newton.lam, residual.lam)
        smooth(machine, run, t)
        add(run, newton)
    return status
