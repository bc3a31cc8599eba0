"""Growth of hoses over the pressure."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any

from pydantic import BeforeValidator

from nivel.elements.circuits.curves import Pressures, as_many, rising
from nivel.elements.circuits.fluids import ATMOSPHERE
from nivel.machine.core.checked import Checked, Problem
from nivel.machine.core.coefficient import Volume
from nivel.machine.given import Field, ManyNumbers, OneNumber
from nivel.machine.units.quantity import Quantity, listed

Area = Annotated[OneNumber, Quantity("area", positive=True)]
MOST_POINTS = 6  # of the growth of a hose


class HoseExpansion(Checked):
    """What a hose grows by over the pressure above that of the air: straight lines from none, and on beyond the last point."""

    pressures: Pressures = Field(description="above that of the air, increasing")
    volumes: ManyNumbers[Any]

    def problems(self) -> Iterator[Problem]:
        yield from rising("pressures", self.pressures)
        yield from as_many("volumes", self.volumes, "`pressures`", len(self.pressures))
        yield from rising("volumes", self.volumes)
        if not 1 <= len(self.pressures) <= MOST_POINTS:
            yield Problem(("pressures",), f"1 to {MOST_POINTS} points were expected, got {len(self.pressures)}")


class VolumeExpansion(HoseExpansion):
    """Growth of a whole volume."""

    volumes: Annotated[ManyNumbers[Volume], BeforeValidator(listed)] = Field(description="that it grows by")


class LengthExpansion(HoseExpansion):
    """Growth of each length of a hose, as catalogues state it."""

    volumes: Annotated[ManyNumbers[Area], BeforeValidator(listed)] = Field(
        description="that each length grows by: cm^3/m"
    )


def hose_points(expansion: HoseExpansion | None, length: float) -> list[float]:
    """POINTS … of `Circuit.room`: the growth of a hose of this length [m], or of a whole one."""
    if expansion is None:
        return []
    pairs = zip(expansion.pressures, expansion.volumes, strict=True)
    points = [number for p, volume in pairs for number in (p + ATMOSPHERE, volume * length)]
    return [float(len(expansion.pressures)), *points]
