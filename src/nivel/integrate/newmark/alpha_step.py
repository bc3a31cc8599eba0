"""One attempt at a step of Newmark's method, HHT-α and generalised-α: the state as a function of the unknowns, and what is kept of it."""

import numpy as np

from nivel.integrate.loop.run import END, FACTORISATIONS, START, TOLERANCE, run_at
from nivel.integrate.loop.step_control import EXACT, fastest_turn
from nivel.integrate.newmark.residual_newton import apply_turns, iterate
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rows import add_times, clear, copy
from nivel.kernels.core.lanes import slope, unit
from nivel.kernels.core.status import NOT_CONVERGED, OK, SINGULAR
from nivel.kernels.record.hook import call_family, call_hook
from nivel.kernels.record.record import DEPART, LOCK, NONE, PASS, RESIDUAL, RESUME, record_at
from nivel.kernels.residual.tangent import POSITIONS, differentiate, load_twin
from nivel.kernels.solve.newton_matrix import factorise_entries, solve_entries
from nivel.kernels.tree.tree import has_passed
from nivel.native.function import leaf

# entries of run.numbers: the constants; the step before, 0 after a start (then BEFORE is what it would have been a step earlier)
ALPHA_M, ALPHA_F, BETA, GAMMA, DELTA_M, DELTA_F, THETA = 0, 1, 2, 3, 4, 5, 6
LAST_STEP = 7
# 1 where accelerations went on to change in the last step as in the one before
GOES_ON = 8
# 1 where accelerations have been begun with anew without what decays within a step: those of the state are not to be taken
SMOOTHED = 13
# rows of run.stages: a and v̇ of the accepted state, w and ẋ; v̇ and ẋ of the state before; work; rate at the begin of the step
A, VDOT, W, XDOT, BEFORE, AHEAD, RATE = 0, 1, 2, 3, 4, 5, 6
# In independent coordinates accelerations are what the iteration leaves them, step for step, so it ends at this share of its tolerance, but
# not below round-off.
CLOSER, ROUND = 0.01, 1e-13
# A part of a step cut at a corner that is shorter than this share of the step before says nothing of the changes of accelerations.
SHORT = 0.1


@leaf
def refresh(machine, run):
    """As index 1 or 2, take accelerations, rates and multipliers of the accepted state from its evaluation by the loop.

    In a step only the mean of the accelerations at both ends counts for an undamped method: what it got wrong once along the constraints
    would alternate for ever. a becomes what `keep_step` would have made of these accelerations. Efforts with stiction stay as they are:
    where several hold one motion the evaluation may share it out otherwise. As index 3, of a redundant machine take the multipliers alone:
    what does nothing would grow from step to step.
    """
    if run.numbers[SMOOTHED] == 1.0:
        run.numbers[SMOOTHED] = 0.0
        return
    record = record_at(machine)
    newton, residual = record.newton, record.residual
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    positions = np.int64(run.y.shape[0]) - n - states - 2
    c, stages, rate = run.numbers, run.stages, run.rate
    share, share_x = (1.0 - c[ALPHA_F]) / (1.0 - c[ALPHA_M]), (1.0 - c[DELTA_F]) / (1.0 - c[DELTA_M])
    if newton.level[0] < 3:
        for k in range(n):
            stages[A, k] += share * (rate[positions + k] - stages[VDOT, k])
            stages[VDOT, k] = rate[positions + k]
        for k in range(states):
            stages[W, k] += share_x * (rate[positions + n + k] - stages[XDOT, k])
            stages[XDOT, k] = rate[positions + n + k]
    if newton.level[0] < 3 or record.saddle.dense.shape[0] > 0:
        for k in range(residual.row.shape[0]):
            newton.lam[k] = record.constraints.lam[residual.row[k]]


@leaf
def predict(run, newton, residual, h):
    """The unknowns at the end of the step as if they went on to change as in the step before, or as they are now: whichever would have
    been nearer there. Accelerations of stiff parts change their sign from step to step."""
    stages, n, last = run.stages, residual.vdot.shape[0], run.numbers[LAST_STEP]
    ratio = h / last if last > 0.0 and run.numbers[GOES_ON] == 1.0 else 0.0
    for k in range(n):
        residual.vdot[k] = stages[VDOT, k] + ratio * (stages[VDOT, k] - stages[BEFORE, k])
    for k in range(newton.state.shape[0]):
        newton.rate[k] = stages[XDOT, k] + ratio * (stages[XDOT, k] - stages[BEFORE, n + k])
    for k in range(residual.lam.shape[0]):
        residual.lam[k] = newton.lam[k] + ratio * (newton.lam[k] - newton.lam_before[k])


@leaf
def prepare(run, newton, n, h):
    """The state as a function of the unknowns. Returns cq, cv, cx.

    a and w stand a share of their step away from the accepted state: for another step they are moved to the same share of that.
    """
    c, stages, y = run.numbers, run.stages, run.y
    states = newton.state.shape[0]
    positions = np.int64(y.shape[0]) - n - states - 2
    ratio = h / c[LAST_STEP] if c[LAST_STEP] > 0.0 else 1.0
    share = (1.0 - c[ALPHA_F]) / (1.0 - c[ALPHA_M])
    share_x = (1.0 - c[DELTA_F]) / (1.0 - c[DELTA_M])
    copy(y, newton.base)
    for k in range(n):
        v, vdot = y[positions + k], stages[VDOT, k]
        a = vdot + ratio * (stages[A, k] - vdot)
        # a₁ = share v̇₁ + known
        known = (c[ALPHA_F] * vdot - c[ALPHA_M] * a) / (1.0 - c[ALPHA_M])
        newton.speed[k] = v + h * ((1.0 - c[GAMMA]) * a + c[GAMMA] * known)
        newton.turn[k] = h * v + h * h * ((0.5 - c[BETA]) * a + c[BETA] * known)
        newton.correction[k] = 0.0
    for k in range(states):
        xdot = stages[XDOT, k]
        w = xdot + ratio * (stages[W, k] - xdot)
        known = (c[DELTA_F] * xdot - c[DELTA_M] * w) / (1.0 - c[DELTA_M])
        newton.state[k] = y[positions + n + k] + h * ((1.0 - c[THETA]) * w + c[THETA] * known)
    return h * h * c[BETA] * share, h * c[GAMMA] * share, h * c[THETA] * share_x


@leaf
def begin_frictions(machine, y, h, t):
    """What rows of frictions with stiction need to know of the accepted state y: rates and efforts. Returns a status."""
    record = record_at(machine)
    residual, friction = record.residual, record.friction
    copy(y, residual.y)
    status = call_hook(machine, RESIDUAL, 0, t)
    for k in range(residual.stiction.shape[0]):
        residual.begun[k] = residual.rate[k]
        friction.anchor[residual.stiction[k]] = record.newton.lam[residual.row.shape[0] + k]
    residual.span[0] = h if record.newton.level[0] == 2 else 0.0
    return status


@leaf
def move_by_velocity(run, newton, residual, h, cq):
    """Accelerations with which positions change by h times the velocities at the start of the step."""
    n = residual.vdot.shape[0]
    positions = np.int64(run.y.shape[0]) - n - newton.state.shape[0] - 2
    for k in range(n):
        residual.vdot[k] = (h * run.y[positions + k] - newton.turn[k]) / cq


@leaf
def attempt(machine, history, h, end, tolerance):
    """The state after a step h, which ends at time `end`, in `residual.y`. tolerance : see `iterate`. Returns a status.

    Where a body has passed a node of the beam that carries it, it is found again on the element reached:
    `nivel.kernels.residual.element_crossing`.
    """
    run, record = run_at(history), record_at(machine)
    passes = record.hooks.address[PASS] != 0
    if passes:
        copy(run.y, record.residual.y)
        call_hook(machine, PASS, LOCK, end)
    status = solve_step(machine, history, h, end, tolerance)
    if passes and status == OK:
        status = call_hook(machine, PASS, DEPART, end)
        if status == OK and has_passed(record.tree):
            status = solve_step(machine, history, h, end, tolerance)
            if status == OK:
                status = call_hook(machine, PASS, RESUME, end)
    return status


@leaf
def solve_step(machine, history, h, end, tolerance):
    """The same on the elements where bodies are held that beams carry.

    Accelerations of stiff parts say little about the next ones: where they lead the iteration astray, it starts again from the positions
    that the velocities lead to, and then from those there are.
    """
    run, record = run_at(history), record_at(machine)
    if record.residual.stiction.shape[0] > 0:
        status = begin_frictions(machine, run.y, h, end)
        if status != OK:
            return status
    if record.newton.level[0] == 0:
        tolerance = min(tolerance, max(CLOSER * tolerance, ROUND))
    predict(run, record.newton, record.residual, h)
    cq, cv, cx = prepare(run, record.newton, record.residual.vdot.shape[0], h)
    status = iterate(machine, history, end, cq, cv, cx, tolerance, True)
    for share in (1.0, 0.0):
        if status not in (NOT_CONVERGED, SINGULAR):
            break
        predict(run, record.newton, record.residual, h)
        cq, cv, cx = prepare(run, record.newton, record.residual.vdot.shape[0], h)
        move_by_velocity(run, record.newton, record.residual, share * h, cq)
        status = iterate(machine, history, end, cq, cv, cx, tolerance, share == 1.0)
    return status


@leaf
def goes_on(run, residual, states, h):
    """Whether the accelerations of the step just done are nearer to those extrapolated than to those before it."""
    stages, n, ratio = run.stages, residual.vdot.shape[0], h / run.numbers[LAST_STEP]
    positions = np.int64(run.scale.shape[0]) - n - states - 2
    extrapolated, constant = 0.0, 0.0
    for k in range(n):
        scale = run.scale[positions + k]
        change = residual.vdot[k] - stages[VDOT, k]
        constant = max(constant, np.abs(change) / scale)
        extrapolated = max(extrapolated, np.abs(change - ratio * (stages[VDOT, k] - stages[BEFORE, k])) / scale)
    return extrapolated < constant


@leaf
def keep_slopes(run, residual, newton, h):
    """Accelerations and rates of the state reached, changing as they did before. A step this short says nothing of their changes, and of
    themselves what the tolerance of its velocities leaves over its length."""
    stages, n, share = run.stages, residual.vdot.shape[0], h / run.numbers[LAST_STEP]
    for k in range(n):
        gained = share * (stages[VDOT, k] - stages[BEFORE, k])
        stages[A, k] += gained
        stages[BEFORE, k] += gained
        stages[VDOT, k] += gained
    for k in range(newton.state.shape[0]):
        gained = share * (stages[XDOT, k] - stages[BEFORE, n + k])
        stages[W, k] += gained
        stages[BEFORE, n + k] += gained
        stages[XDOT, k] += gained


@leaf
def keep_changes(run, residual, newton, h):
    """a and w of the state reached, its accelerations and rates, and those before."""
    c, stages = run.numbers, run.stages
    n, states = residual.vdot.shape[0], newton.state.shape[0]
    ratio = h / c[LAST_STEP] if c[LAST_STEP] > 0.0 else 1.0
    if c[LAST_STEP] > 0.0:
        c[GOES_ON] = 1.0 if goes_on(run, residual, states, h) else 0.0
    for k in range(n):
        new, old = residual.vdot[k], stages[VDOT, k]
        a = old + ratio * (stages[A, k] - old)
        stages[A, k] = ((1.0 - c[ALPHA_F]) * new + c[ALPHA_F] * old - c[ALPHA_M] * a) / (1.0 - c[ALPHA_M])
        stages[BEFORE, k], stages[VDOT, k] = old, new
    for k in range(states):
        new, old = newton.rate[k], stages[XDOT, k]
        w = old + ratio * (stages[W, k] - old)
        stages[W, k] = ((1.0 - c[DELTA_F]) * new + c[DELTA_F] * old - c[DELTA_M] * w) / (1.0 - c[DELTA_M])
        stages[BEFORE, n + k], stages[XDOT, k] = old, new
    c[LAST_STEP] = h


@leaf
def keep_step(machine, run, h, is_part):
    """The state reached, and what the next step needs to know of it. is_part : of a step cut at a corner."""
    record = record_at(machine)
    newton, residual, last = record.newton, record.residual, run.y.shape[0] - 2
    if is_part and h < SHORT * run.numbers[LAST_STEP]:
        keep_slopes(run, residual, newton, h)
    else:
        keep_changes(run, residual, newton, h)
    for k in range(residual.lam.shape[0]):
        newton.lam_before[k], newton.lam[k] = newton.lam[k], residual.lam[k]
    for i in range(last):
        run.y[i] = residual.y[i]
    # energies: the trapezoidal rule
    for i in range(2):
        run.y[last + i] += 0.5 * h * (run.rate[last + i] + record.control.power[i])


# The error of a step of Newmark's method, HHT-α and generalised-α, apart for what is slow and what vibrates.
#
# With v̈ and v⃛ from differences of v̇, a step errs by (⅙ - β - ½ Δ) h³ v̈ in q and by -(1/12 + ½ Δ²) h³ v⃛ in v, Δ = α_m - α_f. Errors of slow
# motion add up: of each a step may make its part of the time of the run. In vibrations faster than the step they do not: a method that
# lets no amplitude grow can be wrong by twice the amplitude, after any number of steps. So there the amplitude counts, as a displacement;
# what it is as a speed, or as an acceleration, says nothing: of stiff springs both are large and change their sign. But the cubic between
# two steps takes the speeds at its ends for true: what it sways by for those that a vibration leaves there counts as its amplitude does.
#
# The two are told apart by a filter for steps REACH times as long, so that also a step of the length of a vibration, in which its
# differences are largest, leaves it out. Filtering costs a matrix: it is asked for where the plain error would shorten a step, and as long
# as it helps.


@leaf
def find_filter(machine, t, cq, cv, cx):
    """The factors at the state, accelerations and multipliers in `residual`, frictions with stiction neither holding nor braking what they
    hold: an error of that is one of its place for ever. Returns a status."""
    record = record_at(machine)
    newton, stick = record.newton, record.control.stick
    tau, stick[0] = stick[0], np.inf
    status = differentiate(machine, t, cq, cv, cx, POSITIONS)
    stick[0] = tau
    copy(newton.value, newton.filter.value)
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
    clear(stages[fast])
    for fold in range(FOLDS):
        if status == OK:
            status = keep_slow(machine, t, stages[row])
        sign = 1.0 if fold == 0 else (-3.0 if fold == 1 else (3.0 if fold == 2 else -1.0))
        add_times(sign, stages[row], stages[fast])
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
    change = size_of_displacement(run, newton, FAST_CHANGE, cq, cx)
    bend = size_of_displacement(run, newton, FAST_BEND, cq, cx)
    amplitude = max(change * change / bend, bend) if bend > 0.0 else 0.0
    slow = size_of_error(run, newton, h) / part_of(run, h)
    largest = max(2.0 * amplitude, size_of_sway(run, record.residual, newton, h))
    return slow, largest / max(SHARE * run.clock[TOLERANCE], EXACT)
