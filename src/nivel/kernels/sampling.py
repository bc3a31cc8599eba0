"""The hook of machines with sampled states: their values after the samples that are due."""

from __future__ import annotations

from nivel.kernels.function import evaluate_function
from nivel.kernels.hook import family
from nivel.kernels.record import record_at
from nivel.kernels.status import OK


@family
def sample(machine, job, t):
    """Fill `sampled.value` where `sampled.due`, from the state last evaluated."""
    sampled = record_at(machine).sampled
    for k in range(sampled.state.shape[0]):
        if sampled.due[k] == 1:
            sampled.value[k] = evaluate_function(machine, sampled.function[k], t)
    return OK
