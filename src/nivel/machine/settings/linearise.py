"""Settings of a linear model: the state that it is about, its inputs and outputs."""

from __future__ import annotations

from typing import Annotated, Any, Final

from pydantic import BeforeValidator

from nivel.machine.core.record import Record
from nivel.machine.given import Field
from nivel.machine.settings.values import Names, OfStatics
from nivel.machine.units.quantity import expression_fault, fault, read_quantity, shown
from nivel.machine.units.tree import ExpressionError

START, EQUILIBRIUM, ROTATION = "start", "equilibrium", "rotation"
AT: Final = {START: "its start", EQUILIBRIUM: "its equilibrium at t = 0", ROTATION: "its steady rotation"}


def _state(value: Any) -> str | float:
    """A word, or a time [s]."""
    if isinstance(value, str) and value.strip() in AT:
        return value.strip()
    try:
        time = read_quantity(value, "time", {})
    except ExpressionError as problem:
        said = expression_fault(problem, value).message()
        raise fault(f"`start`, `equilibrium`, `rotation` or a time was expected: {said}") from None
    if time < 0.0:
        raise fault(f"a time of zero or more was expected, got {shown(value)}")
    return time


class LineariseSettings(Record):
    """Settings of a linear model."""

    about: Annotated[float | str, BeforeValidator(_state)] = Field(
        default=START,
        description="state to linearise about: start, equilibrium, rotation (steady, strained by it), or a time up to which the machine is "
        "simulated, e.g. '2 s'",
        option="--about STATE",
        absent="the start of the machine",
    )
    inputs: Names | None = Field(
        default=None, description="inputs, e.g. hinge.angle", absent="motors, drivers, commands of circuits"
    )
    outputs: Names | None = Field(
        default=None, description="outputs", absent="sensors, or joint coordinates and pressures"
    )
    coordinates: OfStatics = Field(
        default="auto", description="coordinates of the equations", absent="those of the machine"
    )
    verify: bool = Field(
        default=True,
        description="vibrations with other elements of beams, to estimate their error",
        option="--no-verify",
    )

    @property
    def time(self) -> float:
        """Of the run before [s]; 0 without one."""
        return self.about if isinstance(self.about, float) else 0.0

    @property
    def words(self) -> str:
        """The state in words."""
        return AT.get(str(self.about), f"t = {self.time:.6g} s of its run")

    def as_dict(self) -> dict[str, object]:
        """For the `settings` of results."""
        about = "time" if isinstance(self.about, float) else self.about
        return {"analysis": "linearise", **self.model_dump(), "about": about, "time": self.time}
