"""Pumps, motors and sources of flow in words."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import Displacement, Leakage, PositiveNumber, Pressure, Share
from nivel.machine.given import Field, Maybe, OneNumber
from nivel.machine.hydraulics.component import Component, problem_of_share
from nivel.machine.hydraulics.usual import DIFFERENCE, DISPLACEMENT, FLOW, SHAFT_SPEED
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import Duration, Quantity, Whole
from nivel.machine.uses.coordinate_reference import CoordinateReference

Speed = Annotated[OneFunction, varying("angular velocity")]
Setting = Annotated[OneFunction, varying("number")]
PositiveAngularVelocity = Annotated[OneNumber, Quantity("angular velocity", positive=True)]
COULOMB_SHARE = 0.6  # of the friction at the nominal point, that does not depend on the speed


class FlowSource(Component):
    """An ideal pump: a given flow from A to B, at whatever pressure."""

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    functions: ClassVar[tuple[str, ...]] = ("flow",)
    late: ClassVar[tuple[str, ...]] = ("flow", "power")
    delivers: ClassVar[str] = "B"

    type: Literal["flow-source"] = "flow-source"
    flow: Annotated[OneFunction, varying("volume flow")] = Field(
        description="at the density of the side it comes from", usual=FLOW
    )


class RotaryMachine(Component):
    """What pumps and motors share: fluid goes from A to B as the shaft turns forward; on it acts D (p_A - p_B) less friction."""

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    late: ClassVar[tuple[str, ...]] = ("flow", "torque", "power", "setting")

    displacement: Displacement = Field(usual=DISPLACEMENT)
    coordinate: CoordinateReference | None = Field(
        default=None, description="angle of a joint that its shaft turns with"
    )
    ratio: PositiveNumber = Field(default=1.0, description="turns of the shaft per turn of the joint")
    volumetric_efficiency: Share = Field(default=1.0, description="at the nominal point")
    mechanical_efficiency: Share = Field(default=1.0, description="at the nominal point")
    nominal_pressure: Maybe[Pressure] = Field(
        default=None, description="difference of pressure of the efficiencies", usual=DIFFERENCE
    )
    nominal_speed: Maybe[PositiveAngularVelocity] = Field(
        default=None, description="speed of the efficiencies", usual=SHAFT_SPEED
    )
    leakage: Leakage = Field(
        default=0.0, description="flow over the difference of pressure, beside that of the efficiency"
    )
    pistons: Whole | None = Field(default=None, description="their number, an odd one, for the ripple of the flow")

    @property
    def losses(self) -> tuple[float, float]:
        """What is lost at the nominal point, as shares of D ω and of D Δp: of a pump Q = η D ω and T = D Δp/η."""
        return 1.0 - self.volumetric_efficiency, 1.0 / self.mechanical_efficiency - 1.0

    @property
    def whole_leakage(self) -> float:
        """[m³/s/Pa] of flow back per difference of pressure."""
        return self.leakage + (self.losses[0] * self.displacement * self._nominal_speed / self._nominal_pressure)

    @property
    def friction(self) -> tuple[float, float]:
        """(viscous torque over speed [N m s], dry torque over D Δp): the friction at the nominal point in two shares."""
        lost = self.losses[1]
        viscous = (1.0 - COULOMB_SHARE) * lost * self.displacement * self._nominal_pressure / self._nominal_speed
        return viscous, COULOMB_SHARE * lost

    @property
    def _nominal_speed(self) -> float:
        return self.nominal_speed or 1.0

    @property
    def _nominal_pressure(self) -> float:
        return self.nominal_pressure or 1.0

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        lossy = min(self.volumetric_efficiency, self.mechanical_efficiency) < 1.0
        for name in ("nominal_pressure", "nominal_speed"):
            if lossy and getattr(self, name) is None:
                yield Problem((), f"`{name}` is missing: the efficiencies hold at one pressure and speed")
        if self.pistons is not None and (self.pistons < 3 or self.pistons % 2 == 0):
            yield Problem(("pistons",), f"an odd number of pistons from 3 on was expected, got {self.pistons}")


class Pump(RotaryMachine):
    """A pump from A (suction) to B, at a given speed or turned by a joint; its displacement fixed, given, or load sensing."""

    may: ClassVar[tuple[str, ...]] = ("LS",)
    functions: ClassVar[tuple[str, ...]] = ("speed", "setting")
    delivers: ClassVar[str] = "B"

    type: Literal["pump"] = "pump"
    speed: Maybe[Speed] = Field(default=None, description="of its shaft, in place of `coordinate`", usual=SHAFT_SPEED)
    setting: Setting = Field(default=1.0, description="share of the displacement")
    margin: Maybe[Pressure] = Field(default=None, description="load sensing: held between B and LS", usual=DIFFERENCE)
    control_range: Pressure = Field(
        default=10e5, description="load sensing: pressure error at which it moves at full speed", usual=DIFFERENCE
    )
    response: Duration = Field(default=0.08, description="load sensing: time from empty to full")
    cut_off: Maybe[Pressure] = Field(default=None, description="load sensing: greatest pressure at B", usual=DIFFERENCE)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if (self.speed is None) == (self.coordinate is None):
            got = "got both" if self.speed is not None else "got neither"
            yield Problem((), f"a pump needs a `speed`, or the `coordinate` of a joint that turns it; {got}")
        if ("LS" in self.ports) != (self.margin is not None):
            lacking = "`margin` is" if self.margin is None else "port LS is"
            yield Problem((), f"{lacking} missing: a load-sensing pump has a port LS and a `margin`")
        yield from problem_of_share("setting", self.setting, -1.0)
        if self.margin is not None and self.setting != 1.0:
            yield superfluous("setting", "is found by the load sensing itself")
        if self.pistons is not None and self.coordinate is None and not isinstance(self.speed, float | int):
            yield superfluous("pistons", "need a constant `speed`, or a `coordinate`: the ripple follows the angle")


class HydraulicMotor(RotaryMachine):
    """A motor that turns a joint: forward where the pressure at A is higher."""

    functions: ClassVar[tuple[str, ...]] = ("setting",)

    type: Literal["hydraulic-motor"] = "hydraulic-motor"
    setting: Setting = Field(default=1.0, description="share of the displacement")

    @property
    def losses(self) -> tuple[float, float]:
        """The same of a motor: Q = D ω/η and T = η D Δp."""
        return 1.0 / self.volumetric_efficiency - 1.0, 1.0 - self.mechanical_efficiency

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from problem_of_share("setting", self.setting, -1.0)
        if self.coordinate is None:
            yield Problem((), "`coordinate` is missing: the angle of a joint that it turns")
