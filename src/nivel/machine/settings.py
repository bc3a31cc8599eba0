"""How a machine is simulated, in words."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from nivel.machine.quantity import Duration, Rate, fault
from nivel.machine.record import Record


class Baumgarte(Record):
    """Feedback of constraint violations: C̈ + 2 α Ċ + β² C = 0."""

    alpha: Rate
    beta: Rate


class SimulationSettings(Record):
    """Time span, step and methods. Without `baumgarte`, the coefficients of that stabilisation follow from the step."""

    duration: Duration = 1.0
    step: Duration = 1e-3
    output_interval: Duration | None = Field(
        default=None, description="time between stored results; absent, the run chooses"
    )
    integrator: Literal["rk4"] = "rk4"
    formulation: Literal["newton-euler", "lagrange"] = "newton-euler"
    coordinates: Literal["auto", "absolute"] = "absolute"
    stabilisation: Literal["none", "baumgarte", "direct"] = "direct"
    baumgarte: Baumgarte | None = Field(
        default=None, description="own coefficients alpha and beta of the baumgarte stabilisation"
    )

    @model_validator(mode="after")
    def _makes_sense(self) -> SimulationSettings:
        if self.step > self.duration:
            raise fault(f"`step` {self.step:g} s is longer than `duration` {self.duration:g} s")
        if self.output_interval is not None and self.output_interval < self.step * (1 - 1e-9):
            raise fault(f"`output_interval` {self.output_interval:g} s is shorter than `step` {self.step:g} s")
        if self.baumgarte is not None and self.stabilisation != "baumgarte":
            raise fault(f"`baumgarte` needs `stabilisation: baumgarte`; it is `{self.stabilisation}`")
        return self
