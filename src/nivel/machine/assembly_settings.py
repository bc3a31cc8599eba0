"""Settings of the assembly of a machine."""

from __future__ import annotations

from typing import Annotated

from nivel.machine.core.coefficient import NotNegative
from nivel.machine.core.record import Record
from nivel.machine.given import Field, Maybe
from nivel.machine.units.quantity import Angle, PositiveLength


class AssemblySettings(Record):
    """What the assembly may do to close the joints."""

    largest_gap: Maybe[PositiveLength] = Field(
        default=None,
        description="by which joints may be open as given; absent, a tenth of the size of the machine",
    )
    parallel: Annotated[Angle, NotNegative] = Field(
        default=1e-6,
        description="axes of joints that differ by no more, as placed, are taken as parallel: those of an export with six digits are",
    )
