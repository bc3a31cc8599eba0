"""The state of a run: everything a loop needs to go on where it stopped."""

from __future__ import annotations

from typing import NamedTuple

from numba import types

from nivel.kernels.arrays import F1, F2, I1, numba_type
from nivel.kernels.handle import address_type, reader
from nivel.kernels.record import correct_signature, evaluate_signature

# entries of Run.clock
TIME, STEP, START, END = 0, 1, 2, 3
# entries of Run.count
DONE_STEPS, ALL_STEPS, EVERY, FRAMES, LAST_FRAME, BUDGET, EVALUATIONS, EVALUATED = 0, 1, 2, 3, 4, 5, 6, 7
COUNTS = 8


class Run(NamedTuple):
    """History and output of one run. All of it is here, so the result does not depend on how the run is cut into chunks."""

    clock: F1  # (4,) [s] time, step size, start, end
    # (8,) steps done, steps in all, steps between frames, frames in the buffer, step of the last frame, budget, evaluations,
    # and whether `rate` is that of y
    counter: I1
    y: F1  # (ny,) state
    rate: F1  # (ny,) ẏ at the accepted state
    previous: F1  # (ny,) the accepted state: where a failed step started
    scratch: F1  # (ny,) rates that nobody needs
    stages: F2  # (·, ny) work and history of the integrator
    frames: F2  # (capacity, width) output


run_at = reader(numba_type(Run))
evaluate_type = types.FunctionType(evaluate_signature)
correct_type = types.FunctionType(correct_signature)
step_signature = types.int64(evaluate_type, address_type, address_type)
step_type = types.FunctionType(step_signature)
