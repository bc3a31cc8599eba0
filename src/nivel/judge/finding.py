"""Finding: a sentence about a machine that is right by itself and may be a slip all the same."""

import math

from nivel.errors import Fault
from nivel.lazy import dataclass


@dataclass(frozen=True)
class Finding:
    """What stands at a place and what is usual, or fits.

    place : as in a machine file, ``hydraulics.pump.displacement``. number : by how many times a value is beyond what is usual; infinite
    where that is no matter of its size.
    """

    place: str
    text: str
    number: float = math.inf

    @property
    def fault(self) -> Fault:
        """The same, to be told with its place in the file."""
        return Fault.at(self.place, self.text)
