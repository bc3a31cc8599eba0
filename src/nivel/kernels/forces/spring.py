"""Springs and dampers on a coordinate: a distance, an angle, a joint coordinate."""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.function import evaluate_function, table_value
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at

# columns of `columns`; outputs: tension (what resists the coordinate), power, coordinate, rate
OUTPUT, COORDINATE, TABLE, ENERGY, LAW = 0, 1, 2, 3, 4
# columns of `number`
STIFFNESS, DAMPING, FREE, PRELOAD = 0, 1, 2, 3


@family
def apply(machine, number, t):
    """Tension k (c - c0) + preload + d ċ, with a table in place of k (c - c0), or a law in place of all of it.

    Spring and preload store energy (the table's integral is table ENERGY), the damper dissipates, a law works from outside.
    """
    record = record_at(machine)
    elements, coordinates, control = record.elements, record.coordinates, record.control
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, numbers = elements.columns[k], elements.number[k]
        q = index[COORDINATE]
        c, rate = coordinates.value[q], coordinates.rate[q]
        if index[LAW] != NONE:
            tension = evaluate_function(machine, index[LAW], t)
            control.power[0] -= tension * rate
        else:
            stretch = c - numbers[FREE]
            damping = numbers[DAMPING] * rate
            tension = numbers[STIFFNESS] * stretch + numbers[PRELOAD] + damping
            control.stored[0] += (0.5 * numbers[STIFFNESS] * stretch + numbers[PRELOAD]) * stretch
            control.power[1] += damping * rate
            if index[TABLE] != NONE:
                force, _, _ = table_value(record.functions, index[TABLE], stretch)
                energy, _, _ = table_value(record.functions, index[ENERGY], stretch)
                tension += force
                control.stored[0] += energy
        out = record.outputs.value
        first = index[OUTPUT]
        out[first], out[first + 1] = tension, add_coordinate_force(machine, q, -tension)
        out[first + 2], out[first + 3] = c, rate
    return OK
