"""Valves of pneumatic circuits in words: quick exhaust, soft start, ejector."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import (
    Leakage,
    NotNegativeDuration,
    NotNegativePressure,
    Pressure,
    Share,
    SonicConductance,
)
from nivel.machine.given import Field, ManyNumbers, Maybe, OneNumber
from nivel.machine.hydraulics.component import Component, Rated
from nivel.machine.hydraulics.usual import CONDUCTANCE, DIFFERENCE, FLOW, LAG
from nivel.machine.units.quantity import Quantity, listed

MOST_POINTS = 5  # of the characteristic of an ejector


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


class Ejector(Component):
    """A jet from P to R draws gas from A: a vacuum generator, by the points of its catalogue."""

    gases: ClassVar[bool] = True
    liquids: ClassVar[bool] = False
    needs: ClassVar[tuple[str, ...]] = ("P", "A", "R")
    late: ClassVar[tuple[str, ...]] = ("flow", "suction_flow")

    type: Literal["ejector"] = "ejector"
    sonic_conductance: SonicConductance = Field(description="of its jet: C of ISO 6358", usual=CONDUCTANCE)
    critical_ratio: Maybe[Share] = Field(default=None, description="of its jet: b of ISO 6358; default 0.5")
    vacuums: Annotated[ManyNumbers[NotNegativePressure], BeforeValidator(listed)] = Field(
        description="p_R - p_A of the points, which rise; the last one is the greatest vacuum", usual=DIFFERENCE
    )
    suction_flows: Annotated[ManyNumbers[Annotated[OneNumber, Quantity("volume flow")]], BeforeValidator(listed)] = (
        Field(description="at these, at 20 °C and 1 bar; the last one is 0", usual=FLOW)
    )
    drive: Pressure = Field(
        default=3e5, description="p_P - p_R from which on it draws with its whole flow", usual=DIFFERENCE
    )

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if len(self.vacuums) != len(self.suction_flows) or not 2 <= len(self.vacuums) <= MOST_POINTS:
            message = (
                f"2 to {MOST_POINTS} points were expected, as many flows as vacuums, got {len(self.suction_flows)}"
            )
            yield Problem(("suction_flows",), f"{message} and {len(self.vacuums)}")
            return
        if any(b <= a for a, b in pairwise(self.vacuums)):
            yield Problem(("vacuums",), "vacuums that rise were expected")
        if self.suction_flows[-1] != 0.0 or any(b > a or a <= 0.0 for a, b in pairwise(self.suction_flows)):
            yield Problem(("suction_flows",), "flows that fall to 0 at the greatest vacuum were expected")
