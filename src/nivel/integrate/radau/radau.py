"""Radau IIA with three stages, of order 5, for stiff machines (Hairer, Wanner 1996, "Solving Ordinary Differential Equations II", §IV.8).

The error is estimated by the slope at the begin of the step, which the collocation polynomial does not know: γ₀ h (f(t, y) - u̇(t)), of
order h⁴, smoothed by (1 - γ₀ h ∂f/∂y)⁻¹ for stiff entries. The estimate is that of order 3, the result that of order 5. The tolerance
of a step falls with the power 4/5 of that of the run, then the error of the result falls with the tolerance itself.

The same vector bends the polynomial to order 4 inside the step, which frames, events and the prediction of the next step make use of.
"""

import numpy as np

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop import step_control
from nivel.integrate.loop.corners import before, next_corner, pass_corner
from nivel.integrate.loop.dense import wanted
from nivel.integrate.loop.run import (
    BOUND,
    DENSE,
    FACTORISATIONS,
    ITERATIONS,
    POWERS,
    REACHED,
    RESTART,
    STEP,
    STEP_SIGNATURE,
    TIME,
    TOLERANCE,
    evaluate_at,
    run_at,
)
from nivel.integrate.radau.coupled_stages import (
    BEGIN,
    END,
    bring_back,
    factorise_stages,
    find_stage_parts,
    put_aside,
    solve_stages,
)
from nivel.integrate.radau.radau_constants import BEND, COLLOCATION, GAMMA, LEFT, LEFT_PAIR, MU, RIGHT, RIGHT_PAIR, A, C
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.rows import copy
from nivel.kernels.core.lanes import is_whole, slope, steepest, unit
from nivel.kernels.core.number import number_of
from nivel.kernels.core.status import NOT_CONVERGED, OK
from nivel.kernels.record.record import record_at
from nivel.kernels.residual.shifted_matrix import factorise_shifted, find_parts, keep_multipliers, solve_shifted_parts
from nivel.native.duals import LANES
from nivel.native.entry import entry
from nivel.native.function import leaf

# The stages of Radau IIA by simplified Newton iteration, with the exact derivatives of the equations of motion.
#
# Derivatives are found at an accepted state and serve for steps of any size as long as the iteration contracts well; only the factors
# depend on the step. Energies are integrals of what the other entries do: nothing depends on them, so they follow one iteration behind,
# do not count for the contraction, and have to come to rest with the others.
#
# Slopes of the stages, where numbers are dual, follow once the values are found: by further changes with the same factors, until these
# slopes change no more.

# Rows of run.stages: Z_i; ω₁, Re ω₂, Im ω₂; rates at the stages; d_1 … d_4 of the last accepted step; estimated error; d_1 … d_3 of this
# step are made in the rows of the rates.
Z, OMEGA, RATES, LAST, ERROR = 0, 3, 6, 9, 13
# Entries of run.numbers: the step that the factors are for (0: none), whether there are derivatives, steps since they were found,
# the share of a change that is left after it (an estimate), the largest contraction of the last step; the last step (0: none), its error,
# whether this step was rejected, the longest step for which the iteration may converge; steps that are still to be made with derivatives
# at the stages, and how many were the last time.
MADE, FOUND, AGE, LEFT_OVER, CONTRACTION, LAST_STEP, LAST_ERROR, REPEATED, LONGEST = 0, 1, 2, 3, 4, 5, 6, 7, 8
COUPLED, PATIENCE = 9, 10
NUMBERS = 11

MOST = 10
# The iteration has failed where a change is this share of the one before, or where at its pace it would not end in time.
SLOWEST = 0.9
# derivatives at the stages are found anew where a change is more than this share of the one before
CONTRACTS = 0.1
# what is left is taken for no less than this share of a change, and of the last one for no less than that
SANGUINE, LEAST_LEFT = 1e-3, 0.1
FORGET = 0.8
# Slopes change no more where they change by less than this share of the scales; passes for that at most.
SETTLED, MOST_SETTLING = 1e-10, 20


@leaf
def make_factors(machine, history, h):
    """Derivatives where there are none, and factors for the step h: those of the error alone where the stages are to have derivatives of
    their own. Returns a status."""
    run, shifted = run_at(history), record_at(machine).newton.shifted
    status = OK
    if run.numbers[FOUND] == 0.0:
        status = find_parts(machine, run.clock[TIME], run.y, run.rate)
        run.counter[FACTORISATIONS] += 1
        if status != OK:
            return status
        run.numbers[FOUND], run.numbers[AGE], run.numbers[MADE] = 1.0, 0.0, 0.0
    if run.numbers[MADE] != h:
        status = factorise_shifted(machine, shifted.real, real(h) / GAMMA)
        if status == OK and run.numbers[COUPLED] == 0.0:
            status = factorise_shifted(machine, shifted.pair, real(h) / MU)
        run.numbers[MADE] = h if status == OK and run.numbers[COUPLED] == 0.0 else 0.0
    return status


@leaf
def predict(run, h):
    """Z and ω of the polynomial of the last step, which goes on."""
    stages, last = run.stages, run.numbers[LAST_STEP]
    if last == 0.0:
        for i in range(run.y.shape[0]):
            for m in range(6):
                stages[m, i] = 0.0
        return
    ratio = h / last
    for i in range(run.y.shape[0]):
        d1, d2, d3, d4 = stages[LAST, i], stages[LAST + 1, i], stages[LAST + 2, i], stages[LAST + 3, i]
        end = d1 + d2 + d3 + d4
        for m in range(3):
            theta = 1.0 + ratio * C[m]
            stages[m, i] = theta * (d1 + theta * (d2 + theta * (d3 + theta * d4))) - end
    write_omega(run)


@leaf
def of_pair(x0, x1, x2):
    """The part along the complex eigenvector: real and imaginary."""
    p0, p1, p2 = LEFT_PAIR[0], LEFT_PAIR[1], LEFT_PAIR[2]
    return p0.real * x0 + p1.real * x1 + p2.real * x2, p0.imag * x0 + p1.imag * x1 + p2.imag * x2


@leaf
def write_omega(run):
    """ω of Z."""
    stages = run.stages
    for i in range(run.y.shape[0]):
        z0, z1, z2 = stages[Z, i], stages[Z + 1, i], stages[Z + 2, i]
        stages[OMEGA, i] = LEFT[0] * z0 + LEFT[1] * z1 + LEFT[2] * z2
        stages[OMEGA + 1, i], stages[OMEGA + 2, i] = of_pair(z0, z1, z2)


@leaf
def evaluate_stages(evaluate, machine, history, h, end, renewed):
    """Rates at the stages, the last of them at the time `end`, with the derivatives there where they are `renewed`. Returns a status."""
    run = run_at(history)
    for m in range(3):
        for i in range(run.y.shape[0]):
            run.trial[i] = run.y[i] + run.stages[Z + m, i]
        t = run.clock[TIME] + C[m] * h if m < 2 else end
        status = evaluate_at(evaluate, machine, run, t, run.trial, run.stages[RATES + m])
        if status == OK and renewed:
            status = find_stage_parts(machine, m, t, run.trial, run.stages[RATES + m])
        if status != OK:
            return status
    return OK


@leaf
def find_changes(machine, history, h):
    """The changes of ω into the right sides of the two systems."""
    run, shifted = run_at(history), record_at(machine).newton.shifted
    stages, single, pair = run.stages, shifted.real.r, shifted.pair.r
    s, z = real(h) / GAMMA, real(h) / MU
    for i in range(run.y.shape[0]):
        f0, f1, f2 = real(stages[RATES, i]), real(stages[RATES + 1, i]), real(stages[RATES + 2, i])
        single[i] = s * (LEFT[0] * f0 + LEFT[1] * f1 + LEFT[2] * f2) - real(stages[OMEGA, i])
        re, im = of_pair(f0, f1, f2)
        pair[i] = z * complex(re, im) - complex(real(stages[OMEGA + 1, i]), real(stages[OMEGA + 2, i]))
    solve_shifted_parts(machine, shifted.real, s)
    solve_shifted_parts(machine, shifted.pair, z)


@leaf
def size_of_changes(machine, history):
    """The largest change of Z as a share of the scales, of the motion and of the energies, and its place."""
    run, shifted = run_at(history), record_at(machine).newton.shifted
    single, pair = shifted.real.r, shifted.pair.r
    largest, energies, worst = 0.0, 0.0, 0
    for i in range(run.y.shape[0]):
        change = 0.0
        for m in range(3):
            change = max(change, np.abs(RIGHT[m] * single[i] + 2.0 * (RIGHT_PAIR[m] * pair[i]).real))
        share = change / run.scale[i] + (single[i] - single[i])
        if i >= run.y.shape[0] - 2:
            energies = max(energies, share)
        elif not share <= largest:
            largest, worst = share, i
            if np.isnan(share):
                break
    return largest, energies, worst


@leaf
def take_changes(machine, history):
    """Add the changes asked for to ω and Z."""
    run, shifted = run_at(history), record_at(machine).newton.shifted
    stages, single, pair = run.stages, shifted.real.r, shifted.pair.r
    for i in range(run.y.shape[0]):
        stages[OMEGA, i] += single[i]
        stages[OMEGA + 1, i] += pair[i].real
        stages[OMEGA + 2, i] += pair[i].imag
        for m in range(3):
            stages[Z + m, i] += RIGHT[m] * single[i] + 2.0 * (RIGHT_PAIR[m] * pair[i]).real


@leaf
def change_slopes_of_pair(machine, history, h, lane):
    """One change of the slopes of ω₂ and Z along a direction, for the rates at the stages. Returns the largest as a share of scales."""
    run, shifted = run_at(history), record_at(machine).newton.shifted
    stages, pair, largest = run.stages, shifted.pair.r, 0.0
    for i in range(run.y.shape[0]):
        re, im = of_pair(h * stages[RATES, i], h * stages[RATES + 1, i], h * stages[RATES + 2, i])
        missed = complex(slope(re, lane), slope(im, lane)) / MU
        pair[i] = missed - complex(slope(stages[OMEGA + 1, i], lane), slope(stages[OMEGA + 2, i], lane))
    solve_shifted_parts(machine, shifted.pair, real(h) / MU)
    for i in range(run.y.shape[0]):
        stages[OMEGA + 1, i] += number_of(machine, unit(lane, pair[i].real))
        stages[OMEGA + 2, i] += number_of(machine, unit(lane, pair[i].imag))
        for m in range(3):
            change = 2.0 * (RIGHT_PAIR[m] * pair[i]).real
            stages[Z + m, i] += number_of(machine, unit(lane, change))
            largest = max(largest, np.abs(change) / real(run.scale[i]))
    return largest


@leaf
def settle_slopes(evaluate, machine, history, h, end):
    """Slopes of the stages, whose values are found: changes with the factors there, until they change no more. Returns a status."""
    run, single = run_at(history), record_at(machine).newton.shifted.real.r
    stages = run.stages
    for _ in range(MOST_SETTLING):
        status = evaluate_stages(evaluate, machine, history, h, end, False)
        if status != OK:
            return status
        for i in range(run.y.shape[0]):
            f = LEFT[0] * stages[RATES, i] + LEFT[1] * stages[RATES + 1, i] + LEFT[2] * stages[RATES + 2, i]
            missed = h / GAMMA * f - stages[OMEGA, i]
            single[i] = missed - real(missed)
        solve_shifted_parts(machine, record_at(machine).newton.shifted.real, real(h) / GAMMA)
        largest = 0.0
        for i in range(run.y.shape[0]):
            stages[OMEGA, i] += single[i]
            for m in range(3):
                stages[Z + m, i] += RIGHT[m] * single[i]
                largest = max(largest, RIGHT[m] * steepest(single[i]) / real(run.scale[i]))
        for lane in range(LANES):
            largest = max(largest, change_slopes_of_pair(machine, history, h, lane))
        if largest <= SETTLED:
            break
    return OK


@leaf
def unknown_at(newton, place, positions):
    """Number of the unknown that moves entry `place` of y."""
    if place >= positions:
        return place - positions
    found = 0
    for k in range(newton.place.shape[0]):
        first, axis = np.int64(newton.place[k, 0]), newton.place[k, 1]
        if place == first or (axis == 0 and first <= place < first + 4):
            found = k
    return found


@leaf
def fails(k, contraction, change):
    """Whether iteration k, with this contraction and a change so many times what may be left, will not come to an end."""
    return not contraction < SLOWEST or contraction ** (MOST - 1 - k) / (1.0 - contraction) * change > 1.0


@leaf
def iterate(evaluate, machine, history, h, end, close):
    """Z of the step h to the time `end`, until what is left to change is `close`. Returns a status; where the iteration fails, the unknown
    that changes most is left in control.failure."""
    run = run_at(history)
    numbers, last, contraction, worst = run.numbers, np.inf, 0.0, 0
    # what was seen steps ago counts less and less: towards 1, which asks for a second iteration
    left = numbers[LEFT_OVER] ** FORGET
    for k in range(MOST):
        status = evaluate_stages(evaluate, machine, history, h, end, False)
        run.counter[ITERATIONS] += 1
        if status != OK:
            return status
        find_changes(machine, history, h)
        change, energies, worst = size_of_changes(machine, history)
        if not change < np.inf:
            break
        take_changes(machine, history)
        if k > 0:
            now = change / last if last > 0.0 else 0.0
            contraction = np.sqrt(now * contraction) if k > 1 and contraction < 1.0 else now
            numbers[CONTRACTION] = contraction
            left = max(LEAST_LEFT, contraction / (1.0 - contraction)) if contraction < 1.0 else np.inf
            if change > close and fails(k, contraction, change / close):
                break
        if max(change, energies) * min(left, 1.0) <= close:
            numbers[LEFT_OVER] = max(left, SANGUINE)
            return settle_slopes(evaluate, machine, history, h, end) if is_whole(machine) else OK
        last = change
    numbers[LEFT_OVER] = 1.0
    return no_convergence(machine, history, worst)


@leaf
def no_convergence(machine, history, worst):
    """The status of an iteration that found nothing, with the unknown that moves entry `worst` of y in control.failure."""
    run, record = run_at(history), record_at(machine)
    positions = np.int64(run.y.shape[0]) - record.newton.place.shape[0] - record.newton.state.shape[0] - 2
    record.control.failure[0] = unknown_at(record.newton, worst, positions)
    return NOT_CONVERGED


@leaf
def take_stage_changes(machine, history, h, positions):
    """One change of Z by the factors that there are. Returns its size, that of the energies, and the entry of y that changes most."""
    run, own = run_at(history), record_at(machine).newton.shifted.coupled
    stages, largest, energies, worst = run.stages, 0.0, 0.0, 0
    for i in range(run.y.shape[0]):
        f0, f1, f2 = stages[RATES, i], stages[RATES + 1, i], stages[RATES + 2, i]
        for m in range(3):
            own.r[m, i] = h * (A[m, 0] * f0 + A[m, 1] * f1 + A[m, 2] * f2) - stages[Z + m, i]
    solve_stages(machine, positions, h)
    for i in range(run.y.shape[0]):
        change = 0.0
        for m in range(3):
            change = step_control.larger(change, own.r[m, i], run.scale[i])
            stages[Z + m, i] += own.r[m, i]
        if i >= run.y.shape[0] - 2:
            energies = max(energies, change)
        elif not change <= largest:
            largest, worst = change, i
            if np.isnan(change):
                break
    return largest, energies, worst


@leaf
def settle_coupled(evaluate, machine, history, h, end, positions):
    """`settle_slopes` with the factors of `iterate_coupled`. Returns a status."""
    run, r = run_at(history), record_at(machine).newton.shifted.coupled.r
    for _ in range(MOST_SETTLING):
        status = evaluate_stages(evaluate, machine, history, h, end, False)
        if status != OK:
            return status
        take_stage_changes(machine, history, h, positions)
        largest = 0.0
        for i in range(run.y.shape[0]):
            for m in range(3):
                largest = max(largest, steepest(r[m, i]) / real(run.scale[i]))
        if largest <= SETTLED:
            break
    return OK


@leaf
def iterate_coupled(evaluate, machine, history, h, end, close):
    """The same as `iterate` by Newton's iteration with derivatives at the stages, which serve as long as changes contract by CONTRACTS."""
    run, record = run_at(history), record_at(machine)
    positions = np.int64(run.y.shape[0]) - record.newton.place.shape[0] - record.newton.state.shape[0] - 2
    last, contraction, worst, left, status = np.inf, 0.0, 0, 1.0, OK
    put_aside(machine)
    for k in range(MOST):
        renewed = k == 0 or not contraction < CONTRACTS
        status = evaluate_stages(evaluate, machine, history, h, end, renewed)
        run.counter[ITERATIONS] += 1
        if status == OK and renewed:
            status = factorise_stages(machine, positions, h)
            run.counter[FACTORISATIONS] += 1
        if status != OK:
            break
        change, energies, worst = take_stage_changes(machine, history, h, positions)
        status = NOT_CONVERGED
        if not change < np.inf:
            break
        if k > 0:
            contraction = change / last if last > 0.0 else 0.0
            left = max(LEAST_LEFT, contraction / (1.0 - contraction)) if contraction < 1.0 else np.inf
        if max(change, energies) * min(left, 1.0) <= close:
            status = settle_coupled(evaluate, machine, history, h, end, positions) if is_whole(machine) else OK
            break
        last = change
    bring_back(machine, BEGIN, run.y)
    return no_convergence(machine, history, worst) if status == NOT_CONVERGED else status


@leaf
def write_polynomial(run):
    """d_1 … d_3 of this step in the rows of the rates."""
    stages = run.stages
    for i in range(run.y.shape[0]):
        z0, z1, z2 = stages[Z, i], stages[Z + 1, i], stages[Z + 2, i]
        for k in range(3):
            stages[RATES + k, i] = COLLOCATION[k, 0] * z0 + COLLOCATION[k, 1] * z1 + COLLOCATION[k, 2] * z2


# of the error of one step with its estimate
ORDER = 4.0
# A step may err, by its estimate, by SHARE tolerance^(4/5); its stages are found to CLOSE of the tolerance.
SHARE, CLOSE = 0.06, 1e-3
# what counts of an error that settles within a step
SETTLING = 0.2
# Derivatives are found anew where a change is more than this share of the one before.
GOOD = 0.02
LEAST_CHANGE, MOST_CHANGE = 0.2, 8.0
# A step whose iteration fails is halved; the steps after it grow to its length by this factor each.
HALF, REGAIN = 0.5, 1.1
# After a step whose iteration contracts only with derivatives at its stages so many steps have these, twice as many each time.
FEWEST, MOST_PATIENCE = 4.0, 64.0
# A step is kept, and its factors, where it might be longer by less than this.
WORTH = 1.2


@leaf
def forget(run):
    """No polynomial, no derivatives."""
    numbers = run.numbers
    numbers[MADE], numbers[FOUND], numbers[AGE], numbers[LEFT_OVER] = 0.0, 0.0, 0.0, 1.0
    numbers[LAST_STEP], numbers[LAST_ERROR], numbers[LONGEST] = 0.0, 1.0, np.inf
    numbers[COUPLED], numbers[PATIENCE] = 0.0, 0.0
    run.counter[RESTART] = 0


@leaf
def smooth(machine, history, h, slope):
    """ERROR := (1 - γ₀ h ∂f/∂y)⁻¹ γ₀ (h slope - d_1)."""
    run, factors = run_at(history), record_at(machine).newton.shifted.real
    for i in range(run.y.shape[0]):
        factors.r[i] = (h * slope[i] - run.stages[RATES, i]) / GAMMA
    solve_shifted_parts(machine, factors, real(h) / GAMMA)
    copy(factors.r, run.stages[ERROR])


@leaf
def estimate(evaluate, machine, history, h, tolerance):
    """Fill ERROR and the rows of the polynomial; returns the error as a share of the allowed one. Where it is too large, stiff entries
    and energies may be to blame that are far from what they settle to within the step: they are looked at once more after they have.

    What settles is a speed of stiff springs that the step before left wrong, by its length to the power 3 (index 3); while it does, it
    pushes what is slow as far as the springs turn. So SETTLING of it counts, though not where the step was rejected: a shorter one
    begins as wrong.
    """
    run = run_at(history)
    write_polynomial(run)
    smooth(machine, history, h, run.rate)
    error = step_control.size(run, run.stages[ERROR]) / tolerance
    if not error <= 1.0 and error < np.inf:
        settling = 0.0 if run.numbers[REPEATED] == 1.0 or run.numbers[LAST_STEP] == 0.0 else SETTLING * error
        for i in range(run.y.shape[0]):
            run.trial[i] = run.y[i] + run.stages[ERROR, i]
        if evaluate_at(evaluate, machine, run, run.clock[TIME], run.trial, run.scratch) == OK:
            smooth(machine, history, h, run.scratch)
            settled = step_control.size(run, run.stages[ERROR]) / tolerance
            error = settling if settled < settling else settled
    record = record_at(machine)
    if error <= 1.0 and run.numbers[COUPLED] > 0.0 and record.friction.columns.shape[0] > 0:
        # A coordinate that friction held at the begin, and not at the end, forgets nothing of what it is wrong by: the derivatives of the
        # last stage tell. Springs that turn are as stiff at both.
        shifted = record.newton.shifted
        bring_back(machine, END, shifted.coupled.state[END])
        if factorise_shifted(machine, shifted.real, real(h) / GAMMA) == OK:
            smooth(machine, history, h, run.rate)
            error = max(error, step_control.size(run, run.stages[ERROR]) / tolerance)
        bring_back(machine, BEGIN, run.y)
    return error


@leaf
def accept(run, h):
    """The new state, and the polynomial of the step for what comes after it."""
    stages = run.stages
    for i in range(run.y.shape[0]):
        bend = GAMMA * stages[ERROR, i]
        for k in range(3):
            stages[LAST + k, i] = stages[RATES + k, i] + BEND[k] * bend
        stages[LAST + 3, i] = BEND[3] * bend
        run.y[i] += stages[Z + 2, i]
    run.numbers[LAST_STEP] = h
    if wanted(run):
        for k in range(4):
            copy(stages[LAST + k], run.dense[k])
        run.counter[DENSE], run.counter[POWERS] = 4, 1


@leaf
def next_step(run, h, error, last):
    """The step after a step h of this error, before it one of length `last`: it follows the trend of the error (Gustafsson 1994)."""
    numbers, error = run.numbers, max(error, 1e-10)
    factor = step_control.SAFETY * error ** (-1.0 / ORDER)
    if last > 0.0:
        factor = min(factor, step_control.SAFETY * h / last * (numbers[LAST_ERROR] / (error * error)) ** (1.0 / ORDER))
    factor = max(LEAST_CHANGE, min(1.0 if numbers[REPEATED] == 1.0 else MOST_CHANGE, factor))
    numbers[LAST_ERROR] = max(error, 1e-2)
    if numbers[CONTRACTION] > GOOD or numbers[COUPLED] > 0.0:
        numbers[FOUND] = 0.0
    elif 1.0 <= factor < WORTH:
        factor = 1.0
    return h * factor


@leaf
def attempt(evaluate, machine, history, h, end, tolerance):
    """A status, the error of a step h to the time `end` as a share of the allowed one, and how much shorter the step has to be for no body
    to turn too far. Its stages are in Z."""
    run = run_at(history)
    close = max(CLOSE * run.clock[TOLERANCE], step_control.EXACT)
    status = make_factors(machine, history, h)
    if status != OK:
        return status, 0.0, 1.0
    predict(run, h)
    if run.numbers[COUPLED] == 0.0:
        status = iterate(evaluate, machine, history, h, end, close)
    else:
        status = iterate_coupled(evaluate, machine, history, h, end, close)
    if status != OK:
        return status, 0.0, 1.0
    shorter = step_control.exceeds_rotation_limit(machine, h)
    return OK, estimate(evaluate, machine, history, h, tolerance), shorter


@entry(STEP_SIGNATURE)
def radau(evaluate, machine, history):
    """One accepted step."""
    run = run_at(history)
    numbers, tolerance = run.numbers, max(SHARE * run.clock[TOLERANCE] ** 0.8, step_control.EXACT)
    keep_multipliers(machine)
    step_control.enter_boldly(machine, history, ORDER - 1.0, tolerance)
    if step_control.is_fresh(run):
        forget(run)
    numbers[REPEATED] = 0.0
    run.clock[STEP] = min(run.clock[STEP], numbers[LONGEST])
    status, error = OK, 0.0
    while True:
        h = step_control.reach(run)
        if h == 0.0:
            return step_control.too_small(run, status, error)
        corner, end, wish = next_corner(machine, run.clock[TIME], run.clock[REACHED]), run.clock[REACHED], h
        if corner < np.inf:
            # just beyond it, where functions are what follows, even those that are no number at the corner
            end = before(corner)
            run.clock[REACHED] = min(corner + (corner - end), run.clock[BOUND])
            h = run.clock[REACHED] - run.clock[TIME]
        status, error, shorter = attempt(evaluate, machine, history, h, end, tolerance)
        if status != OK:
            if numbers[AGE] > 0.0 and numbers[FOUND] == 1.0:
                # the same step with the derivatives of this state
                numbers[FOUND] = 0.0
                continue
            if status == NOT_CONVERGED and numbers[COUPLED] == 0.0:
                # and with those at its stages, as the steps after it
                numbers[PATIENCE] = min(max(FEWEST, 2.0 * numbers[PATIENCE]), MOST_PATIENCE)
                numbers[COUPLED] = numbers[PATIENCE]
                continue
            numbers[FOUND] = 0.0
            step_control.reject(run, h, HALF if status == NOT_CONVERGED else step_control.AFTER_FAILURE)
            numbers[LONGEST] = run.clock[STEP]
        elif error <= 1.0 and shorter == 1.0:
            break
        else:
            step_control.reject(
                run, h, min(shorter, step_control.factor_after_rejection(OK, error, ORDER) if not error <= 1.0 else 1.0)
            )
        numbers[REPEATED] = 1.0
    last = numbers[LAST_STEP]
    accept(run, h)
    numbers[AGE] += 1.0
    numbers[LONGEST] *= REGAIN
    run.clock[STEP] = next_step(run, h, error, last)
    if numbers[COUPLED] > 0.0:
        numbers[COUPLED] -= 1.0
    else:
        numbers[PATIENCE] = max(0.0, numbers[PATIENCE] - 1.0)
    if corner < np.inf:
        # what was before it says nothing about what comes
        run.clock[STEP], run.counter[RESTART] = max(run.clock[STEP], wish), 1
        return pass_corner(machine, history, run.clock[REACHED])[0]
    return OK


FACTS = (
    IntegratorFacts(
        "radau", radau, order=5, stages=14, numbers=11, kind="implicit", needs="complex shifts", ends="corners"
    ),
)
