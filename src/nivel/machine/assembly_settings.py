"""Settings of the assembly of a machine."""

from __future__ import annotations

from nivel.machine.core.record import Record
from nivel.machine.given import Field, Maybe
from nivel.machine.units.quantity import PositiveLength


class AssemblySettings(Record):
    """What the assembly may do to close the joints."""

    largest_gap: Maybe[PositiveLength] = Field(
        default=None,
        description="by which joints may be open as given; absent, a tenth of the size of the machine",
    )
