"""The embedded pair of orders 5 and 4 of Dormand & Prince (1980), with dense output of order 4.

Coefficients: Hairer, Nørsett, Wanner 1993, table II.5.2; dense output: the weights of eq. II.6.12 in the form of its code. Steps are
controlled by the difference of the two results, and the better one is kept.

A run that may go on with another method ends with STIFF where stability bounds its steps. The last two stages k_6 and k_7 are at the same
time: h |k_7 - k_6|/|Y_7 - Y_6| is h |λ| of the fastest rate as soon as that rate alone makes the two differ (Hairer, Wanner 1996, §IV.2).
"""

import numpy as np

from nivel.integrate.explicit.embedded import evaluate_stages, take_step
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.dense import cubic, wanted
from nivel.integrate.loop.run import DENSE, POWERS, STEP_SIGNATURE, run_at, sum_rows
from nivel.integrate.loop.step_control import EXACT, size
from nivel.kernels.core.status import OK
from nivel.native.entry import entry
from nivel.native.function import leaf

STAGES = 7
ORDER = 5.0  # of the error of one step with its estimate
SHARE = 0.1
# Entries of run.numbers behind those of `embedded`: whether stiff steps are counted, how many there were, and since then others.
COUNTS, STIFF_STEPS, OTHER_STEPS = 2, 3, 4
NUMBERS = 5
# Stiff steps turn the fastest rate by more than the method is stable for on the imaginary axis [rad]. After so many of them it is left;
# so many others between two make the count begin anew.
STABLE, MOST_STIFF, FORGIVEN = 1.0, 15.0, 6.0
# status of a run that is left, apart from those of `nivel.kernels.core.status`
STIFF = 100

C = np.array([0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1, 1])
A = np.array(
    [
        [0, 0, 0, 0, 0, 0],
        [1 / 5, 0, 0, 0, 0, 0],
        [3 / 40, 9 / 40, 0, 0, 0, 0],
        [44 / 45, -56 / 15, 32 / 9, 0, 0, 0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0, 0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0],
        [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    ]
)
# the states of the last two stages, the later minus the other one
LAST_TWO = A[STAGES - 1] - A[STAGES - 2]
# result of order 5 minus that of order 4
E = np.array([71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])
# the fourth row of the dense output
D = np.array(
    [
        -12715105075 / 11282082432,
        0,
        87487479700 / 32700410799,
        -10690763975 / 1880347072,
        701980252875 / 199316789632,
        -1453857185 / 822651844,
        69997945 / 29380423,
    ]
)


@leaf
def _attempt(evaluate, machine, history, h):
    run = run_at(history)
    status = evaluate_stages(evaluate, machine, history, h, A, C, 1, STAGES)
    if status != OK:
        return status, 0.0
    sum_rows(run.stages, h, E, STAGES, run.scratch)
    return OK, size(run, run.scratch)


@leaf
def _fill_dense(run, h):
    cubic(run, h, run.stages[0], run.stages[STAGES - 1])
    sum_rows(run.stages, h, D, STAGES, run.dense[3])
    run.counter[DENSE], run.counter[POWERS] = 4, 0


@leaf
def count_stiff(run, h):
    """Count the step h just accepted as stiff, or as another one."""
    numbers, last, slopes, states = run.numbers, STAGES - 1, 0.0, 0.0
    sum_rows(run.stages, h, LAST_TWO, last, run.scratch)
    # nothing depends on the energies at the end of y
    for i in range(run.y.shape[0] - 2):
        slopes = max(slopes, np.abs(run.stages[last, i] - run.stages[last - 1, i]) / run.scale[i])
        states = max(states, np.abs(run.scratch[i]) / run.scale[i])
    if states > EXACT and h * slopes > STABLE * states:
        numbers[STIFF_STEPS], numbers[OTHER_STEPS] = numbers[STIFF_STEPS] + 1.0, 0.0
    elif numbers[STIFF_STEPS] > 0.0:
        numbers[OTHER_STEPS] += 1.0
        if numbers[OTHER_STEPS] == FORGIVEN:
            numbers[STIFF_STEPS] = 0.0


@entry(STEP_SIGNATURE)
def dopri5(evaluate, machine, history):
    """One accepted step; none, and STIFF, where too many were stiff."""
    run = run_at(history)
    if run.numbers[STIFF_STEPS] >= MOST_STIFF:
        return STIFF
    status, h = take_step(evaluate, machine, history, ORDER, SHARE, _attempt)
    if h > 0.0 and run.numbers[COUNTS] == 1.0:
        count_stiff(run, h)
    if h > 0.0 and wanted(run):
        _fill_dense(run, h)
    return status


FACTS = (IntegratorFacts("dopri5", dopri5, order=5, stages=STAGES, numbers=NUMBERS),)
