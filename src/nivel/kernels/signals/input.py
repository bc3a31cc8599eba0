"""Inputs: their values at the time of an evaluation, for all that reads them as signals."""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at

# columns of `columns`
OUTPUT, FUNCTION = 0, 1


@family
def apply(machine, number, t):
    """The value of every input at time t [s], a function of time alone. Inputs come before all elements that may read them."""
    record = record_at(machine)
    elements = record.elements
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        record.outputs.value[index[OUTPUT]] = evaluate_function(machine, index[FUNCTION], t)
    return OK
