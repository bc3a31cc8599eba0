"""Pumps, motors and sources of flow in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, ClassVar, Literal

from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import (
    Displacement,
    Frequency,
    Leakage,
    NotNegativeTorque,
    PositiveNumber,
    Pressure,
    Share,
)
from nivel.machine.core.record import Name
from nivel.machine.given import Field, Maybe, OneNumber, OneRecord, Usual
from nivel.machine.hydraulics.component import Component, problem_of_share
from nivel.machine.hydraulics.maps import CutOffCurve, EfficiencyMap, TorqueCurve
from nivel.machine.hydraulics.usual import DIFFERENCE, DISPLACEMENT, FLOW, POWER, PUMP_DISPLACEMENT, SHAFT_SPEED, TORQUE
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import Duration, Quantity, Rate, Whole
from nivel.machine.uses.coordinate_reference import CoordinateReference

Speed = Annotated[OneFunction, varying("angular velocity")]
Setting = Annotated[OneFunction, varying("number")]
Torque = Annotated[OneFunction, varying("torque")]
Inertia = Annotated[OneNumber, Quantity("inertia", positive=True)]
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
    efficiency: Maybe[OneRecord[EfficiencyMap]] = Field(
        default=None, description="a map, in place of the efficiencies at a nominal point"
    )
    case_leakage: Leakage = Field(default=0.0, description="flow from A and from B to the drain L, laminar")
    frequency: Maybe[Frequency] = Field(default=None, description="natural frequency of the actuator of the setting")
    damping_ratio: PositiveNumber = Field(default=0.8)
    rate_limit: Maybe[Rate] = Field(
        default=None, description="greatest speed of the setting; the actuator is then of first order"
    )

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
        if self.efficiency is not None and lossy:
            yield superfluous("efficiency", "holds for all pressures and speeds; leave out the other efficiencies")
        if ("L" in self.ports) != (self.case_leakage > 0.0):
            lacking = "port L is" if self.case_leakage else "`case_leakage` is"
            yield Problem((), f"{lacking} missing: a case drain has a port L and a `case_leakage`")
        if self.rate_limit is not None and self.frequency is None:
            yield superfluous("rate_limit", "belongs to an actuator with a `frequency`")
        if self.pistons is not None and (self.pistons < 3 or self.pistons % 2 == 0):
            yield Problem(("pistons",), f"an odd number of pistons from 3 on was expected, got {self.pistons}")


class Pump(RotaryMachine):
    """A pump from A (suction) to B, at a given speed or turned by a joint or an engine; its displacement fixed, given, or load sensing."""

    may: ClassVar[tuple[str, ...]] = ("LS", "X", "L")
    functions: ClassVar[tuple[str, ...]] = ("speed", "setting", "torque_limit")
    delivers: ClassVar[str] = "B"

    type: Literal["pump"] = "pump"
    displacement: Displacement = Field(usual=PUMP_DISPLACEMENT)
    speed: Maybe[Speed] = Field(default=None, description="of its shaft, in place of `coordinate`", usual=SHAFT_SPEED)
    engine: Name | None = Field(default=None, description="that turns it, in place of `speed`")
    setting: Setting = Field(default=1.0, description="share of the displacement")
    least_setting: Maybe[Annotated[OneNumber, Quantity("number")]] = Field(
        default=None, description="of the actuator; default 0 with load sensing, else -1: it swings over centre"
    )
    greatest_setting: Share = Field(default=1.0, description="of the actuator")
    torque_limit: Maybe[Torque] = Field(
        default=None,
        description="greatest torque of D times the pressure, without friction; with a port X, times the mean of both pressures",
        usual=TORQUE,
    )
    cut_off_curve: Maybe[OneRecord[CutOffCurve]] = Field(
        default=None, description="greatest setting over the difference of pressure"
    )
    margin: Maybe[Pressure] = Field(default=None, description="load sensing: held between B and LS", usual=DIFFERENCE)
    control_range: Pressure = Field(
        default=10e5, description="load sensing: pressure error at which it moves at full speed", usual=DIFFERENCE
    )
    response: Duration = Field(default=0.08, description="load sensing: time from empty to full")
    cut_off: Maybe[Pressure] = Field(default=None, description="load sensing: greatest pressure at B", usual=DIFFERENCE)

    @property
    def is_regulated(self) -> bool:
        """Whether an actuator or limits have a part in its setting, beside simple load sensing."""
        limits = (self.frequency, self.torque_limit, self.cut_off_curve, self.least_setting)
        return any(each is not None for each in limits) or self.greatest_setting < 1.0

    @property
    def range_of_settings(self) -> tuple[float, float]:
        """Least and greatest setting."""
        least = self.least_setting
        return (0.0 if self.margin is not None else -1.0) if least is None else least, self.greatest_setting

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        turned = [key for key in ("speed", "coordinate", "engine") if getattr(self, key) is not None]
        if len(turned) != 1:
            got = f"got {' and '.join(f'`{key}`' for key in turned)}" if turned else "got none of them"
            yield Problem(
                (), f"a pump needs a `speed`, the `coordinate` of a joint or the `engine` that turns it; {got}"
            )
        if self.margin is None and self.is_regulated and self.frequency is None:
            yield Problem((), "`frequency` is missing: limits act on an actuator; write for example `frequency: 4 Hz`")
        if self.cut_off is not None and self.margin is None:
            told = "belongs to load sensing; a given setting falls along a `cut_off_curve`"
            yield superfluous("cut_off", f"{told}: {{pressures: [280 bar, 300 bar], settings: [1, 0]}}")
        if ("X" in self.ports) and self.torque_limit is None:
            yield superfluous("ports", "port X is the pressure of the other pump that shares a `torque_limit`")
        if not -1.0 <= self.range_of_settings[0] < self.greatest_setting:
            told = f"from -1 to below {self.greatest_setting:g} was expected, got {self.range_of_settings[0]:g}"
            yield Problem(("least_setting",), f"a setting {told}")
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

    may: ClassVar[tuple[str, ...]] = ("L",)
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


class Engine(Component):
    """A combustion engine with a governor, which turns pumps; its speed is a state. `pumps` name it as their `engine`."""

    functions: ClassVar[tuple[str, ...]] = ("speed", "load")
    early: ClassVar[tuple[str, ...]] = ("speed",)
    late: ClassVar[tuple[str, ...]] = ("torque", "power")
    usual: ClassVar[Mapping[str, Usual]] = {"speed": SHAFT_SPEED, "torque": TORQUE, "power": POWER}

    type: Literal["engine"] = "engine"
    speed: Speed = Field(description="asked for, without load", usual=SHAFT_SPEED)
    torque_curve: OneRecord[TorqueCurve] = Field(description="full load")
    inertia: Inertia = Field(description="of the shaft and all that turns with it")
    droop: Share = Field(default=0.05, description="fall of the speed at the greatest torque, as a share of `speed`")
    drag: NotNegativeTorque = Field(default=0.0, description="torque with which it brakes without fuel")
    load: Torque = Field(default=0.0, description="torque of what else it drives: fan, alternator")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.droop == 0.0:
            yield Problem(("droop",), "a governor has a droop above 0, such as 0.05, got 0")
