"""Pumps and motors, and what sets their displacement.

Fluid goes from A to B as the shaft turns forward; losses are leakage and friction, so that power is lost in all four quadrants:

    ṁ = ρ_in D ε ω - ρ̄ C (p_B - p_A)        T = D ε (p_B - p_A) + T_v ω + c D |p_B - p_A| sgn ω

ρ_in is the density on the side from which fluid is taken in; within SLOW of no speed, it passes from one to the other. T is the torque
that drives the shaft forward. Its first part is that of catalogues (ISO 4409); isentropic work, ρ_in D ε (h_B - h_A), differs by about
Δp/2β, which is lost as fluid springs back between the sides. With that in its place an ideal motor on closed lines would feed its own
vibration, since ρ_in is greater on the way from the higher pressure than on the way back.
"""

from collections.abc import Iterator
from typing import Annotated, ClassVar

import numpy as np

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Component
from nivel.elements.circuits.curves import EfficiencyMap
from nivel.elements.circuits.density import thickness
from nivel.elements.circuits.kind import Phase, called, slopes_of
from nivel.elements.circuits.ledger import DELIVERED, SUPPLIED, lose_between, transfer
from nivel.elements.circuits.smooth import magnitude_within, sign_within
from nivel.elements.circuits.tangent import add_by_pressure, add_flow_by_column, add_flow_by_pressure
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.record import NONE, record_at
from nivel.machine.core.coefficient import Displacement, Frequency, Leakage, PositiveNumber, Share
from nivel.machine.core.record import Problem, superfluous
from nivel.machine.given import Field, Maybe, OneNumber, OneRecord
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import Quantity, Rate, Whole
from nivel.machine.uses.coordinate_reference import CoordinateReference
from nivel.native.function import stage

Setting = Annotated[OneFunction, varying("number")]

Inertia = Annotated[OneNumber, Quantity("inertia", positive=True)]
PositiveAngularVelocity = Annotated[OneNumber, Quantity("angular velocity", positive=True)]
COULOMB_SHARE = 0.6  # of the friction at the nominal point, that does not depend on the speed


class RotaryMachine(Component):
    """What pumps and motors share: fluid goes from A to B as the shaft turns forward; on it acts D (p_A - p_B) less friction."""

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    late: ClassVar[tuple[str, ...]] = ("flow", "torque", "power", "setting")

    displacement: Displacement = Field(usual=ranges.DISPLACEMENT)
    coordinate: CoordinateReference | None = Field("angle of a joint that its shaft turns with", default=None)
    ratio: PositiveNumber = Field("turns of the shaft per turn of the joint", default=1.0)
    volumetric_efficiency: Share = Field("at the nominal point", default=1.0)
    mechanical_efficiency: Share = Field("at the nominal point", default=1.0)
    nominal_pressure: Maybe[ranges.Drop] = Field("difference of pressure of the efficiencies", default=None)
    nominal_speed: Maybe[PositiveAngularVelocity] = Field(
        "speed of the efficiencies", default=None, usual=ranges.SHAFT_SPEED
    )
    leakage: Leakage = Field("flow over the difference of pressure, beside that of the efficiency", default=0.0)
    pistons: Whole | None = Field("their number, an odd one, for the ripple of the flow", default=None)
    efficiency: Maybe[OneRecord[EfficiencyMap]] = Field(
        "a map, in place of the efficiencies at a nominal point", default=None
    )
    case_leakage: Leakage = Field("flow from A and from B to the drain L, laminar", default=0.0)
    frequency: Maybe[Frequency] = Field("natural frequency of the actuator of the setting", default=None)
    damping_ratio: PositiveNumber = Field(default=0.8)
    rate_limit: Maybe[Rate] = Field("greatest speed of the setting; the actuator is then of first order", default=None)

    @property
    def range_of_settings(self) -> tuple[float, float]:
        """Least and greatest setting."""
        return -1.0, 1.0

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


# machines: columns of `columns`; SPEED: function, or NONE; outputs: flow, torque, power, setting
OUTPUT, FROM, TO, SPEED, COORDINATE = 0, 1, 2, 3, 4
FLOW, TORQUE, POWER, SETTING = 0, 1, 2, 3
# columns of `number`: D [m³/rad], turns of the shaft per turn of the joint, C [m³/s/Pa], T_v [N m s], c, ripple: periods a turn, share
DISPLACEMENT, RATIO, LEAK, VISCOUS, DRY, PERIODS, RIPPLE = 0, 1, 2, 3, 4, 5, 6
# speed [rad/s] and difference of pressure [Pa] within which signs are rounded
SLOW, SMALL = 1.0, 1e5


@stage
def turning(machine, index, n, t):
    """(speed [rad/s], angle [rad]) of a shaft."""
    coordinates = record_at(machine).coordinates
    if index[SPEED] == NONE:
        q = index[COORDINATE]
        return n[RATIO] * coordinates.rate[q], n[RATIO] * coordinates.value[q]
    omega = evaluate_function(machine, index[SPEED], t)
    return omega, omega * t


@called(Phase.FLOWS, 5)
@element
def turn(machine, index, n, t):
    """Flows and torques of pumps and motors."""
    record = record_at(machine)
    circuit, value = record.circuit, record.outputs.value
    a, b, out = index[FROM], index[TO], index[OUTPUT]
    omega, angle = turning(machine, index, n, t)
    swept = n[DISPLACEMENT] * value[out + SETTING] * (1.0 + n[RIPPLE] * np.cos(n[PERIODS] * angle))
    displaced = swept * omega
    mean = 0.5 * (circuit.density[a] + circuit.density[b])
    taken = sign_within(omega * value[out + SETTING], SLOW)
    density = mean + 0.5 * (circuit.density[a] - circuit.density[b]) * taken
    difference = circuit.pressure[b] - circuit.pressure[a]
    leak = n[LEAK] / thickness(circuit, a, b) * difference
    flow = density * displaced - mean * leak
    torque = swept * difference + n[VISCOUS] * omega
    dry = n[DRY] * n[DISPLACEMENT] * magnitude_within(difference, SMALL)
    torque += dry * sign_within(omega, SLOW)
    power = torque * omega
    lose_between(machine, a, b, flow, power + transfer(machine, a, b, flow))
    if index[SPEED] == NONE:
        add_coordinate_force(machine, index[COORDINATE], -n[RATIO] * torque)
        circuit.power[DELIVERED] -= power
    else:
        record.control.power[0] += power
        circuit.power[SUPPLIED] += power
    value[out + FLOW], value[out + TORQUE], value[out + POWER] = displaced - leak, torque, power


@called(Phase.FLOWS, 7, slow=True)
@element
def supply(machine, index, n, t):
    """Sources of flow: ideal pumps; SPEED is the flow. Outputs: flow, power."""
    record = record_at(machine)
    circuit, value = record.circuit, record.outputs.value
    a, b = index[FROM], index[TO]
    flow = evaluate_function(machine, index[SPEED], t)
    density = circuit.density[a] if real(flow) > 0.0 else circuit.density[b]
    power = -transfer(machine, a, b, density * flow)
    record.control.power[0] += power
    circuit.power[SUPPLIED] += power
    value[index[OUTPUT]], value[index[OUTPUT] + 1] = flow, power


@slopes_of(turn)
@element
def add_slopes(machine, index, n, t):
    """Slopes of the flows and torques of pumps and motors."""
    record = record_at(machine)
    circuit, value = record.circuit, record.outputs.value
    tangent = circuit.tangent
    states, coordinates = tangent.state.shape[0], tangent.coordinate.shape[0]
    a, b, setting = index[FROM], index[TO], index[OUTPUT] + SETTING
    omega, angle = turning(machine, index, n, t)
    full = n[DISPLACEMENT] * (1.0 + n[RIPPLE] * np.cos(n[PERIODS] * angle))
    swept = full * value[setting]
    mean = 0.5 * (circuit.density[a] + circuit.density[b])
    taken = sign_within(omega * value[setting], SLOW)
    density = mean + 0.5 * (circuit.density[a] - circuit.density[b]) * taken
    leak = mean * n[LEAK] / thickness(circuit, a, b)
    add_flow_by_pressure(circuit, a, b, a, leak)
    add_flow_by_pressure(circuit, a, b, b, -leak)
    if tangent.source[setting, 0] != NONE:
        add_flow_by_column(circuit, a, b, tangent.source[setting, 0], density * full * omega)
    if index[SPEED] != NONE:
        return
    c, ratio = np.int64(tangent.number[index[COORDINATE]]), n[RATIO]
    rate, row = states + coordinates + c, tangent.effort[c]
    add_flow_by_column(circuit, a, b, rate, density * swept * ratio)
    difference = circuit.pressure[b] - circuit.pressure[a]
    dry = n[DRY] * n[DISPLACEMENT] * magnitude_within(difference, SMALL)
    row[rate] -= ratio * ratio * (n[VISCOUS] + dry * SLOW * SLOW / (omega * omega + SLOW * SLOW) ** 1.5)
    add_by_pressure(circuit, row, b, -ratio * swept)
    add_by_pressure(circuit, row, a, ratio * swept)
