"""Outputs of contacts: where surfaces touch, what they exert there, and how they slide."""

from nivel.kernels.record.record import record_at
from nivel.native.function import stage

# outputs of a contact, behind its magnitude and power. LOST: power that friction turns to heat; GIVEN: power of a surface that moves over
# its body; HELD: 1 where friction holds; PLACE, NORMAL, DRAG: middle of the normal forces, normal from the second body to the first, and
# friction on the first, three numbers each in global axes
MAGNITUDE, POWER, DEPTH, FORCE, RATE, RUB, SLIP, LOST, GIVEN, HELD, PLACE, NORMAL, DRAG = (
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 13, 16,
)  # fmt: skip
COUNT = 19


@stage
def write_touch(machine, first, p, normal, drag, lost, given):
    """Where contact number `first` of the outputs touches, its normal, its friction on the first body, the power that this loses, and that
    of the moving surface."""
    out = record_at(machine).outputs.value
    out[first + LOST], out[first + GIVEN], out[first + HELD] = lost, given, 0.0
    for a in range(3):
        out[first + PLACE + a], out[first + NORMAL + a], out[first + DRAG + a] = p[a], normal[a], drag[a]


@stage
def leave_touch(machine, first):
    """The surfaces do not touch."""
    out = record_at(machine).outputs.value
    for a in range(LOST, COUNT):
        out[first + a] = 0.0
