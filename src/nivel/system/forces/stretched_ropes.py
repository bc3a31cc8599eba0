"""Ropes that are stretched far beyond their length as the machine is placed: a slip of a number, or of the sign of a radius."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from nivel.errors import ModelError
from nivel.judge.finding import Finding
from nivel.machine.forces.rope import Rope
from nivel.machine.machine_record import MachineRecord
from nivel.system.forces.ropes import length_as_placed, way_as_placed

# Ropes of steel break at 1 to 3 % of strain, those of fibres at 3 to 30 %, and work at less than half of it.
USUAL: Final = 0.1
# [N] stiffness times length; below it stands rubber, which may be stretched to several times its length.
RUBBER: Final = 1e4


def stretched_ropes(machine: MachineRecord) -> Iterator[Finding]:
    """Each rope whose way as placed is more than 10 % longer than its unstressed length."""
    for rope in machine.forces:
        if not isinstance(rope, Rope) or rope.length is None or rope.stiffness * rope.length < RUBBER:
            continue
        way = length_as_placed(machine, rope)
        if way > (1.0 + USUAL) * rope.length:
            yield Finding(
                f"forces.{rope.name}",
                f"its way as placed is {way:.4g} m, {100.0 * (way / rope.length - 1.0):.3g} % longer than `length`, so the run begins with "
                f"a tension of {rope.stiffness * (way - rope.length):.3g} N{_other_side(machine, rope)}",
            )


def _other_side(machine: MachineRecord, rope: Rope) -> str:
    """The radius whose other sign makes the way a usual one, if there is one."""
    radii, length = rope.radii or (), rope.length or 0.0
    for k, radius in enumerate(radii):
        other = (*radii[:k], -radius, *radii[k + 1 :])
        try:
            way = way_as_placed(machine, rope, other).length if radius else 0.0
        except ModelError:  # on that side it would lie within another wheel
            continue
        if radius and way <= (1.0 + USUAL) * length:
            written = ", ".join(f"{each:g}" for each in other)
            return f"; on the other side of the wheel at point {k + 1} it would be {way:.4g} m: `radii: [{written}]`"
    return ""
