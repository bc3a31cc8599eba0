"""What all forces share."""

from __future__ import annotations

from typing import ClassVar, Final

from nivel.machine.checked import Checked
from nivel.machine.record import Name

OUTPUTS: Final = ("magnitude", "power")


class ForceElement(Checked):
    """A named element that loads bodies.

    outputs : what a sensor can read of it.
    """

    collection: ClassVar[str] = "forces"
    outputs: ClassVar[tuple[str, ...]] = OUTPUTS

    name: Name
