"""Tables of machines and hoses: efficiencies, greatest settings over pressure, torque over speed, growth over pressure."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Annotated, Any

import numpy as np
from pydantic import BeforeValidator

from nivel.machine.core.checked import Checked, Problem
from nivel.machine.core.coefficient import Numbers, Pressure, Torques, Volume
from nivel.machine.given import Field, ManyNumbers, OneNumber
from nivel.machine.units.quantity import Quantity, listed

Area = Annotated[OneNumber, Quantity("area", positive=True)]
MOST_POINTS = 6  # of the growth of a hose
Pressures = Annotated[ManyNumbers[Pressure], BeforeValidator(listed)]
Speeds = Annotated[
    ManyNumbers[Annotated[OneNumber, Quantity("angular velocity", positive=True)]], BeforeValidator(listed)
]


def _rising(key: str, values: Sequence[float]) -> Iterator[Problem]:
    for at in range(1, len(values)):
        if values[at] <= values[at - 1]:
            yield Problem((key, at), f"{key} increase; {values[at]:g} does not come after {values[at - 1]:g}")
            return


def _as_many(key: str, values: Sequence[float], over: str, count: int) -> Iterator[Problem]:
    if len(values) != count:
        yield Problem((key,), f"{count} {key} were expected, one for each of {over}, got {len(values)}")


class CutOffCurve(Checked):
    """The greatest setting over the difference of pressure, straight lines between points, constant outside."""

    pressures: Pressures = Field(description="difference of pressure, increasing")
    settings: Numbers = Field(description="greatest share of the displacement there, from 0 to 1")

    def problems(self) -> Iterator[Problem]:
        yield from _rising("pressures", self.pressures)
        yield from _as_many("settings", self.settings, "`pressures`", len(self.pressures))
        if any(not 0.0 <= each <= 1.0 for each in self.settings):
            yield Problem(("settings",), "settings from 0 to 1 were expected")


class TorqueCurve(Checked):
    """The torque at full load over the speed, straight lines between points, constant outside."""

    speeds: Speeds = Field(description="increasing")
    torques: Torques = Field(description="at full load, one for each speed")

    def problems(self) -> Iterator[Problem]:
        yield from _rising("speeds", self.speeds)
        yield from _as_many("torques", self.torques, "`speeds`", len(self.speeds))
        if max(self.torques, default=0.0) <= 0.0 or min(self.torques, default=0.0) < 0.0:
            yield Problem(("torques",), "torques of 0 or more were expected, one of them above 0")


class EfficiencyMap(Checked):
    """Efficiencies at points of speed, difference of pressure and setting, all magnitudes.

    `volumetric` and `mechanical` have one number for each point; the setting changes first, then the pressure, then the speed.
    """

    speeds: Speeds = Field(description="of the shaft, increasing")
    pressures: Pressures = Field(description="difference of pressure, increasing")
    settings: Numbers = Field(default=(1.0,), description="share of the displacement, increasing")
    volumetric: Numbers = Field(description="volumetric efficiency of each point")
    mechanical: Numbers = Field(description="hydraulic-mechanical efficiency of each point")

    @property
    def shape(self) -> tuple[int, int, int]:
        """Points along speeds, pressures and settings."""
        return len(self.speeds), len(self.pressures), len(self.settings)

    def points(self) -> tuple[np.ndarray, ...]:
        """(ω [rad/s], Δp [Pa], ε, η_v, η_hm), each of the `shape`."""
        axes = np.meshgrid(self.speeds, self.pressures, self.settings, indexing="ij")
        return (*axes, *(np.reshape(each, self.shape) for each in (self.volumetric, self.mechanical)))

    def problems(self) -> Iterator[Problem]:
        for key in ("speeds", "pressures", "settings"):
            yield from _rising(key, getattr(self, key))
        if any(not 0.0 < each <= 1.0 for each in self.settings):
            yield Problem(("settings",), "settings above 0 and up to 1 were expected")
        count = int(np.prod(self.shape))
        over = "all speeds, pressures and settings"
        for key in ("volumetric", "mechanical"):
            yield from _as_many(key, getattr(self, key), over, count)
            if any(not 0.0 < each <= 1.0 for each in getattr(self, key)):
                yield Problem((key,), "efficiencies above 0 and up to 1 were expected")


class HoseExpansion(Checked):
    """What a hose grows by over the pressure above that of the air: straight lines from none, and on beyond the last point."""

    pressures: Pressures = Field(description="above that of the air, increasing")
    volumes: ManyNumbers[Any]

    def problems(self) -> Iterator[Problem]:
        yield from _rising("pressures", self.pressures)
        yield from _as_many("volumes", self.volumes, "`pressures`", len(self.pressures))
        yield from _rising("volumes", self.volumes)
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
