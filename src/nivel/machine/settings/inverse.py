"""Settings of inverse dynamics: the actuators, their limits, and the motion that they make."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from os import PathLike
from typing import Any

from nivel.machine.core.checked import Checked, Problem
from nivel.machine.given import Field, Maybe
from nivel.machine.settings.values import FEWEST_POSITIONS, Names, Positions


class InverseSettings(Checked):
    """Settings of inverse dynamics. Of more actuators than needed the least Σ (weight · effort)² is taken within the limits."""

    actuators: Names | None = Field(
        default=None,
        description="joint coordinates, or motors, which then do not act themselves",
        absent="the motors, or the coordinates that the drivers prescribe",
    )
    motion: Any = Field(
        default=None,
        description="result of a run or of kinematics",
        option="--motion RESULT.nc",
        absent="the motion that the drivers prescribe",
    )
    trajectory: str | PathLike[str] | None = Field(
        default=None,
        description="table of joint coordinates over time, in place of a motion",
        option="--trajectory FILE.csv",
    )
    limits: Mapping[str, Any] = Field(
        default={},
        description="greatest effort of an actuator",
        option="--limit NAME=VALUE",
        absent="those of the motors",
    )
    weights: Mapping[str, Any] = Field(
        default={},
        description="weight of an effort, if there are more actuators than needed",
        option="--weight NAME=NUMBER",
        absent="one over the limit, or 1",
    )
    hold: Names = Field(default=(), description="drivers that keep what they prescribe", option="--hold DRIVERS")
    positions: Maybe[Positions] = Field(
        default=None,
        description="number of positions of the drivers' motion or of a trajectory",
        absent=FEWEST_POSITIONS,
    )

    def problems(self) -> Iterator[Problem]:
        """Two motions."""
        if self.motion is not None and self.trajectory is not None:
            yield Problem(("trajectory",), "stands in place of `motion`; give one of them")
