"""Signals of a control that are computed anew in every evaluation, each after those that it reads."""

from __future__ import annotations

from nivel.kernels.function import evaluate_function
from nivel.kernels.hook import family
from nivel.kernels.record import record_at
from nivel.kernels.status import OK

# columns of `columns`
OUTPUT, FUNCTION = 0, 1


@family
def apply(machine, number, t):
    """Each signal is a function of time and of other signals."""
    record = record_at(machine)
    elements, outputs = record.elements, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        outputs[index[OUTPUT]] = evaluate_function(machine, index[FUNCTION], t)
    return OK
