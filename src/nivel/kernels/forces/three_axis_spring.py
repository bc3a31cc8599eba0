"""Springs and dampers along the global axes.

Along each axis the displacement x of the second point from the first is drawn back by k (x - x0) + preload + d ẋ. The axes do not turn, so
the springs have the potential Σ ½ k (x - x0)² + preload (x - x0), and act at the two points without a moment between them.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_marker_force
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at

# columns of `columns`; outputs: magnitude, power, force on the second body (3)
OUTPUT, FIRST, SECOND = 0, 1, 2
# columns of `number`, three each
STIFFNESS, DAMPING, FREE, PRELOAD = 0, 3, 6, 9


@family
def apply(machine, number, t):
    """Forces of all elements, their energy and losses."""
    record = record_at(machine)
    bodies, markers, elements, control = record.bodies, record.markers, record.elements, record.control
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        i, j, first = elements.columns[k, FIRST], elements.columns[k, SECOND], elements.columns[k, OUTPUT]
        n, force = elements.number[k], record.outputs.value[first + 2 : first + 5]
        for a in range(3):
            stretch = markers.r[j, a] - markers.r[i, a] - n[FREE + a]
            rate = markers.rdot[j, a] - markers.rdot[i, a]
            damping = n[DAMPING + a] * rate
            force[a] = -(n[STIFFNESS + a] * stretch + n[PRELOAD + a] + damping)
            control.stored[0] += (0.5 * n[STIFFNESS + a] * stretch + n[PRELOAD + a]) * stretch
            control.power[1] += damping * rate
        x, y, z = force[0], force[1], force[2]
        power = add_marker_force(bodies, markers, j, x, y, z) + add_marker_force(bodies, markers, i, -x, -y, -z)
        record.outputs.value[first] = np.sqrt(x * x + y * y + z * z)
        record.outputs.value[first + 1] = power
    return OK
