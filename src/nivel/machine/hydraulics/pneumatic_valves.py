"""Valves of pneumatic circuits in words: quick exhaust and soft start."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import Leakage, NotNegativeDuration, Pressure, Share
from nivel.machine.given import Field
from nivel.machine.hydraulics.component import Rated
from nivel.machine.hydraulics.usual import DIFFERENCE, LAG


class QuickExhaust(Rated):
    """Lets fluid from P to A while p_P is higher, and from A to R while p_A is."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("P", "A", "R")
    late: ClassVar[tuple[str, ...]] = ("flow_PA", "flow_AR", "position", "exhaust_position")

    type: Literal["quick-exhaust"] = "quick-exhaust"
    opens_at: Pressure = Field(default=0.05e5, description="difference at which it begins to open", usual=DIFFERENCE)
    opening_range: Pressure = Field(
        default=0.2e5, description="difference of pressure from there to fully open", usual=DIFFERENCE
    )
    lag: NotNegativeDuration = Field(default=0.0, description="time constant of the opening; 0: none", usual=LAG)
    leakage: Leakage = Field(default=0.0)


class SoftStart(Rated):
    """Fills A from P through a throttle until p_A is a share of p_P; then it opens."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("P", "A")
    late: ClassVar[tuple[str, ...]] = ("flow", "throttled_flow", "position")
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("P", "A"), ("A", "P"))

    type: Literal["soft-start"] = "soft-start"
    throttle: Share = Field(default=0.05, description="opening while it fills, as a share of the whole one")
    switches_at: Share = Field(default=0.5, description="p_A over p_P, absolute, at which it opens")
    opening_range: Pressure = Field(
        default=0.2e5, description="difference of pressure from there to fully open", usual=DIFFERENCE
    )
    lag: NotNegativeDuration = Field(default=0.05, description="time constant of the opening; 0: none", usual=LAG)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not 0.0 < self.throttle < 1.0:
            yield Problem(("throttle",), f"a share above 0 and below 1 was expected, got {self.throttle:g}")
