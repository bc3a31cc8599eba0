"""Level of reservoirs: the volume of their liquid over their height.

The node of a reservoir is a volume whose room is the air above the liquid (`nivel.kernels.hydraulics.volume`): closed in, it is the gas of
an accumulator; that of an open one gives way to the liquid at atmospheric pressure.
"""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.hydraulics.fluid import HEAT_CAPACITY, START
from nivel.kernels.hydraulics.phase import Phase, called
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at

# columns of `columns`; STATE: of the mass; output of the temperature. Outputs: level [m], volume of the liquid [m³]
OUTPUT, NODE, STATE, TEMPERATURE = 0, 1, 2, 3
# column of `number`: area of its surface [m²]
AREA = 0


@called(Phase.PRESSURES, slow=True)
@family
def apply(machine, number, t):
    """Level and volume of the liquid in each."""
    record = record_at(machine)
    elements, circuit, value = record.elements, record.circuit, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        f = circuit.fluid[circuit.node[index[NODE], 0]]
        volume = elements.state[index[STATE]] / circuit.density[index[NODE]]
        if f[HEAT_CAPACITY] == 0.0:
            value[index[TEMPERATURE]] = f[START] + 0.0 * volume
        value[index[OUTPUT]], value[index[OUTPUT] + 1] = volume / elements.number[k, AREA], volume
    return OK
