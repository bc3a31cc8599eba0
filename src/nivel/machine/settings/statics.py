"""Settings of statics: time, on which loads and drivers depend, iteration, vibrations and buckling."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from nivel.machine.core.checked import Checked, Problem
from nivel.machine.given import Field, Given, Maybe, OneNumber
from nivel.machine.settings.run import SHORTEST
from nivel.machine.settings.values import Between, Modes, OfStatics, Time
from nivel.machine.units.quantity import Duration

MOST_STEPS = 1_000_000
STEPS = 20


class StaticsSettings(Checked):
    """Settings of statics. Duration 0: the equilibrium at t = 0 alone."""

    duration: Time = Field(
        default=1.0, description="last time of the loads and drivers; 0: only t = 0", absent="that of the machine"
    )
    step: Maybe[Duration] = Field(
        default=None, description="time between two states", absent="a twentieth of the duration"
    )
    arc_length: bool = Field(
        default=False, description="path of equilibria through limit points, where time turns back"
    )
    tolerance: Annotated[OneNumber, Between("1e-14", "1e-2")] = Field(
        default=1e-10,
        description="largest last correction of Newton's method, in lengths of the machine and in radians",
    )
    most_iterations: Annotated[Given[int, int, int | str], Between("2", "1000")] = Field(
        default=25, description="limit of Newton iterations for a state"
    )
    line_search: bool = Field(
        default=True, description="shortening of Newton steps that come no nearer", option="--no-line-search"
    )
    modes: Modes = Field(default=0, description="number of natural frequencies and modes about every state")
    buckling: Modes = Field(
        default=0, description="number of linearised buckling loads, from the first and the last state"
    )
    coordinates: OfStatics = Field(
        default="auto", description="coordinates of the equations", absent="those of the machine"
    )
    verify: bool = Field(
        default=True, description="states with other elements of beams, to estimate their error", option="--no-verify"
    )

    @property
    def interval(self) -> float:
        """Time between states [s]."""
        return self.step or self.duration / STEPS or 1.0

    def as_dict(self) -> dict[str, object]:
        """For the result's `settings`."""
        return {"analysis": "statics", **self.model_dump(), "step": self.interval}

    def problems(self) -> Iterator[Problem]:
        """Steps that do not go with the duration, and what needs loads that grow."""
        duration, step = self.duration, self.interval
        if 0.0 < duration < SHORTEST:
            message = f"{duration:g} s is shorter than {SHORTEST:g} s; use 0 for the equilibrium at t = 0 alone"
            yield Problem(("duration",), message)
        if duration and step > duration:
            yield Problem(("step",), f"{step:g} s is longer than the duration of {duration:g} s")
        if duration / step > MOST_STEPS:
            message = f"{step:g} s makes more than {MOST_STEPS} steps in {duration:g} s; use a larger one"
            yield Problem(("step",), message)
        for name in ("buckling", "arc_length"):
            if getattr(self, name) and not duration:
                yield Problem((name,), "needs loads that grow with time: a duration above zero")
