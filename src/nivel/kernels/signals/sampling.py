"""The hook of machines with sampled states: their values after the samples that are due."""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at


@family
def sample(machine, job, t):
    """Fill `sampled.value` where `sampled.due`, from the state last evaluated and the new values of what is sampled at once before.

    Signals are computed anew. `elements.state` has the new values of what is sampled at once.
    """
    record = record_at(machine)
    sampled, outputs, state = record.sampled, record.outputs.value, record.elements.state
    for k in range(sampled.state.shape[0]):
        if sampled.output[k] != NONE:
            outputs[sampled.output[k]] = evaluate_function(machine, sampled.function[k], t)
        elif sampled.due[k] == 1:
            sampled.value[k] = evaluate_function(machine, sampled.function[k], t)
            if sampled.at_once[k] == 1:
                state[sampled.state[k]] = sampled.value[k]
    return OK
