"""Settings of the assembly of a machine."""

from __future__ import annotations

from pydantic import Field

from nivel.machine.record import Record
from nivel.machine.units.quantity import PositiveLength


class AssemblySettings(Record):
    """What the assembly may do to close the joints."""

    largest_gap: PositiveLength | None = Field(
        default=None,
        description="by which joints may be open as given; absent, a tenth of the size of the machine",
    )
