"""ROS2 of `nivel.integrate.rosenbrock.rosenbrock` for machines whose only stiffness is that of modes, in relative coordinates.

Its J is that of `nivel.motion.modal_shift`, taken in the state of each stage: J of the second is J of the first and O(h), which in

    y₁ = y + h f + ½ h² f' f + ½ γ h² (J₁ - J₂) f + O(h³)

costs no order, and saves keeping the factors while the second stage is evaluated.
"""

from __future__ import annotations

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import EVALUATIONS, FACTORISATIONS, REACHED, STEP, STEP_SIGNATURE, run_at
from nivel.integrate.rosenbrock.rosenbrock import FIRST, GAMMA, ROWS, SECOND
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_evaluate
from nivel.motion.modal_shift import factorise_shifted_modes, solve_shifted_modes
from nivel.native.entry import entry


@entry(STEP_SIGNATURE)
def ros2(evaluate, machine, history):
    """One step."""
    run = run_at(history)
    h, y, first, second = run.clock[STEP], run.y, run.stages[FIRST], run.stages[SECOND]
    share = GAMMA * h
    status = factorise_shifted_modes(machine, share)
    if status != OK:
        return status
    for i in range(y.shape[0]):
        first[i] = run.rate[i]
    status = solve_shifted_modes(machine, y, first, share)
    if status != OK:
        return status
    for i in range(y.shape[0]):
        run.trial[i] = y[i] + h * first[i]
    status = call_evaluate(evaluate, machine, run.clock[REACHED], run.trial, second)
    run.counter[EVALUATIONS] += 1
    if status == OK:
        status = factorise_shifted_modes(machine, share)
    run.counter[FACTORISATIONS] += 2
    if status != OK:
        return status
    for i in range(y.shape[0]):
        second[i] -= 2.0 * first[i]
    status = solve_shifted_modes(machine, y, second, share)
    for i in range(y.shape[0]):
        y[i] += 0.5 * h * (3.0 * first[i] + second[i])
    return status


# all but the modes is advanced explicitly
FACTS = (IntegratorFacts("ros2", ros2, order=2, stages=ROWS, machines="modes"),)
