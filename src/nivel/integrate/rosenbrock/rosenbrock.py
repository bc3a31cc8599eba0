"""ROS2, a linearly implicit method of order 2 with a fixed step and a fixed cost: one exact tangent, one factorisation and two solutions
a step, no iteration (Verwer, Spee, Blom, Hundsdorfer 1999).

    (1 - γ h J) k₁ = f(t, y) + γ h f_t                     y₁ = y + h (3 k₁ + k₂)/2
    (1 - γ h J) k₂ = f(t + h, y + h k₁) - γ h f_t - 2 k₁

The order is 2 for any γ, J and f_t, so the parts of J that `nivel.kernels.residual.shifted_along` leaves out cost no order. Both γ = 1 ±
1/√2 make
the method L-stable for the exact J. With the larger one neither the step nor the state inside it overshoots where a motion only decays, but
the error of everything else, (3 γ² - 2 γ³ - 1/6) h³, is 34 times as large: a machine with springs swings, so the smaller one.

On dual numbers k₁ and k₂ have the slopes that J gives them too (`nivel.kernels.residual.shifted_along`).
"""

import numpy as np

from nivel.elements.circuits.ledger import balance_mass, mass_apart
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import FACTORISATIONS, REACHED, STEP, STEP_SIGNATURE, TIME, evaluate_at, run_at
from nivel.kernels.algebra.rows import add_times, advance, copy
from nivel.kernels.core.lanes import is_whole
from nivel.kernels.core.status import OK
from nivel.kernels.residual.shifted_along import ROWS as OF_SLOPES
from nivel.kernels.residual.shifted_along import prepare_shifted, return_to, settle_solution, solve_shifted
from nivel.motion.modal_shift import factorise_shifted_modes, solve_shifted_modes
from nivel.native.entry import entry
from nivel.native.function import leaf

GAMMA = 1.0 - np.sqrt(0.5)
# rows of run.stages: k₁ and k₂; a right-hand side, and work for its slopes
FIRST, SECOND, GIVEN, WORK = 0, 1, 2, 3
ROWS = 3 + OF_SLOPES


@leaf
def solve_for(machine, run, t, row, share, ahead):
    """Overwrite a row of run.stages with the solution of (1 - share J) k = row + share ahead f_t. Returns a status."""
    x, given = run.stages[row], run.stages[GIVEN]
    copy(x, given)
    apart = mass_apart(machine, x)
    status = solve_shifted(machine, t, x, share, ahead)
    if status == OK and is_whole(machine):
        status = settle_solution(machine, t, given, x, share, ahead, run.scale, run.stages[WORK : WORK + OF_SLOPES])
    balance_mass(machine, x, apart)
    return status


@entry(STEP_SIGNATURE)
def ros2(evaluate, machine, history):
    """One step."""
    run = run_at(history)
    t, h, y, first, second = run.clock[TIME], run.clock[STEP], run.y, run.stages[FIRST], run.stages[SECOND]
    share = GAMMA * h
    status = prepare_shifted(machine, t, y, run.rate, share)
    run.counter[FACTORISATIONS] += 1
    copy(run.rate, first)
    if status == OK:
        status = solve_for(machine, run, t, FIRST, share, 1.0)
    if status != OK:
        return status
    advance(y, h, first, run.trial)
    status = evaluate_at(evaluate, machine, run, run.clock[REACHED], run.trial, second)
    if status != OK:
        return status
    add_times(-2.0, first, second)
    return_to(machine, y, run.rate)
    status = solve_for(machine, run, t, SECOND, share, -1.0)
    for i in range(y.shape[0]):
        y[i] += 0.5 * h * (3.0 * first[i] + second[i])
    return status


# ROS2 for machines whose only stiffness is that of modes, in relative coordinates.
#
# Its J is that of `nivel.motion.modal_shift`, taken in the state of each stage: J of the second is J of the first and O(h), which in
#
#     y₁ = y + h f + ½ h² f' f + ½ γ h² (J₁ - J₂) f + O(h³)
#
# costs no order, and saves keeping the factors while the second stage is evaluated.


@entry(STEP_SIGNATURE)
def modal_ros2(evaluate, machine, history):
    """One step."""
    run = run_at(history)
    h, y, first, second = run.clock[STEP], run.y, run.stages[FIRST], run.stages[SECOND]
    share = GAMMA * h
    status = factorise_shifted_modes(machine, share)
    if status != OK:
        return status
    copy(run.rate, first)
    status = solve_shifted_modes(machine, y, first, share)
    if status != OK:
        return status
    advance(y, h, first, run.trial)
    status = evaluate_at(evaluate, machine, run, run.clock[REACHED], run.trial, second)
    if status == OK:
        status = factorise_shifted_modes(machine, share)
    run.counter[FACTORISATIONS] += 2
    if status != OK:
        return status
    add_times(-2.0, first, second)
    status = solve_shifted_modes(machine, y, second, share)
    for i in range(y.shape[0]):
        y[i] += 0.5 * h * (3.0 * first[i] + second[i])
    return status


# all but the modes is advanced explicitly


FACTS = (
    IntegratorFacts("ros2", ros2, order=2, stages=ROWS, kind="implicit", needs="directions"),
    IntegratorFacts("ros2", modal_ros2, order=2, stages=ROWS, machines="modes"),
)
