"""Rates of user states."""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at

# columns of `columns`; SAMPLED: whether the function is the value after a sample
STATE, FUNCTION, SAMPLED = 0, 1, 2


@family
def apply(machine, number, t):
    """ẋ of each state is a function of time and signals; of sampled ones it is zero, and in statics what a sample changes them by."""
    record = record_at(machine)
    elements, at_rest = record.elements, record.sampled.at_rest[0] == 1
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        own = index[STATE]
        if index[SAMPLED] == 0:
            elements.state_rate[own] += evaluate_function(machine, index[FUNCTION], t)
        elif at_rest:
            elements.state_rate[own] += evaluate_function(machine, index[FUNCTION], t) - elements.state[own]
    return OK
