"""Signals of a control that are computed anew in every evaluation, each after those that it reads."""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at

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
