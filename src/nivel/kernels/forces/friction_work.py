"""Work of the friction of contacts since the start: a state that nothing depends on, whose rate is the power that friction turns to heat.

That of a law of Coulomb is known when all forces are, so these elements come last; that of a patch which sticks is known behind them, and
`nivel.kernels.elements.friction` adds it.
"""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at

# columns of `columns`; OUTPUT: the work; POWER: output with the power of friction, or NONE where a patch adds it
OUTPUT, STATE, POWER = 0, 1, 2


@family
def apply(machine, number, t):
    """Report the work of each contact, and add to its rate."""
    record = record_at(machine)
    elements, out = record.elements, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        out[index[OUTPUT]] = elements.state[index[STATE]]
        if index[POWER] != NONE:
            elements.state_rate[index[STATE]] += out[index[POWER]]
    return OK
