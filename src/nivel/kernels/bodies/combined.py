"""Combined coordinates: Σ factor coordinate of other coordinates, such as the slip of a clutch between two shafts.

The parts of a combined coordinate are those of the coordinates that it is made of, one after the other, each of which has two parts or
more: at the first of them `coordinates.station` is the factor, at the second the number of the coordinate. These are measured before, as
they have lower numbers.
"""

from __future__ import annotations

import numpy as np

from nivel.native.function import stage

# kind of the coordinates
COMBINED = 21


@stage
def combined(coordinates, k):
    """(value, rate, bias) of coordinate k; its parts of C_q are filled."""
    part, last = np.int64(coordinates.start[k]), np.int64(coordinates.start[k + 1])
    first = np.int64(coordinates.station[part + 1])
    factor = coordinates.station[part]
    value, rate, bias = (
        factor * coordinates.value[first],
        factor * coordinates.rate[first],
        factor * coordinates.bias[first],
    )
    begin = part
    while part < last:
        factor, q = coordinates.station[part], np.int64(coordinates.station[part + 1])
        if part > begin:
            value += factor * coordinates.value[q]
            rate += factor * coordinates.rate[q]
            bias += factor * coordinates.bias[q]
        for source in range(np.int64(coordinates.start[q]), np.int64(coordinates.start[q + 1])):
            for i in range(6):
                coordinates.J[part, i] = factor * coordinates.J[source, i]
            part += 1
    return value, rate, bias
