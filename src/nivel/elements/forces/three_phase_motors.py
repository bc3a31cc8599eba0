"""Three-phase motors on a joint coordinate in dq: with magnets or by induction, with field-oriented control, inverter and battery.

    L_d di_d/dt = u_d - R i_d + ω_k L_q i_q - e_d        L_q di_q/dt = u_q - R i_q - ω_k L_d i_d - e_q
    T = 3/2 p (ψ_d i_q - ψ_q i_d + (L_d - L_q) i_d i_q)        P = 3/2 (u_d i_d + u_q i_q)

with amplitudes, in a frame that turns with ω_k (Park 1929; Schröder, Elektrische Antriebe, 2021). Magnets: ω_k = p ω, ψ_d = ψ, ψ_q = 0,
e_d = 0, e_q = p ω ψ. By induction ψ = M i_μ, and with M = L_m²/L_r, R_R = (L_m/L_r)² R_r, L_d = L_q = L_s - M (Slemon 1989)

    e_d = R_R (i_d - i_μd) - p ω ψ_q        M di_μd/dt = R_R (i_d - i_μd) + (ω_k - p ω) ψ_q        slip: ω_k - p ω = R_R/M i_q/i_μd
    e_q = R_R (i_q - i_μq) + p ω ψ_d        M di_μq/dt = R_R (i_q - i_μq) - (ω_k - p ω) ψ_d

so that the frame is that of the flux of the rotor; on the grid it is that of the voltage. The torque asked for is a current i_q, at most
what √(i_max² - i_d²) leaves. The controllers of both currents take their poles away (Harnefors and Nee 1998): with α = 2π `bandwidth`

    u = α L (i* - i) + x + what the other axis and the flux induce        ẋ = α R (i* - i) + R/L (u' - u)

so a current follows as α/(s + α), until the voltage u' is cut to U/√3 of the dc link; x then does not run away. The inverter loses
P₀ + 6/π V i + 3/2 R_s i², i the amplitude. A battery feeds the dc link: C dU/dt = I - P/U, I = (U₀ - U)/R_b, ds/dt = -I/Q.

Energy: the battery gives U₀ I, without one the dc link or the grid P; R_b I², P_inverter, 3/2 R i², 3/2 R_R |i - i_μ|² and friction are
lost; ½ C U², 3/4 L i², 3/4 M i_μ² are stored.
"""

import math
from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.facts import Output, StateFact
from nivel.elements.forces.drives import (
    Drive,
    DriveRow,
    Inductance,
    PositiveCurrent,
    PositiveVoltage,
    Resistance,
    TorqueConstant,
    Voltage,
    add_row,
    clipped,
    no_argument,
    shaft_speed,
    transmit,
)
from nivel.elements.kind import Kind
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real, tanh
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.function import evaluate_function, table_value
from nivel.kernels.record.record import NONE, record_at
from nivel.known import SystemBuilder
from nivel.machine.core.coefficient import CoordinateEffortFunction, NotNegative, Share
from nivel.machine.core.record import Checked, Problem, superfluous
from nivel.machine.given import Field, ManyNumbers, Maybe, OneNumber, OneRecord
from nivel.machine.laws.time_function import OneFunction, TimeFunction, varying
from nivel.machine.laws.varying_value import Table
from nivel.machine.units.quantity import Quantity, Whole, listed
from nivel.native.function import stage

Voltages = Annotated[ManyNumbers[Annotated[OneNumber, Quantity("voltage", positive=True)]], BeforeValidator(listed)]
Shares = Annotated[ManyNumbers[Annotated[OneNumber, Quantity("number")]], BeforeValidator(listed)]


class Battery(Checked):
    """A battery with an inner resistance, and the capacitor of the dc link that it feeds."""

    charges: Shares = Field("states of charge, from 0 to 1, increasing")
    voltages: Voltages = Field("without load, at each of `charges`")
    capacity: Annotated[OneNumber, Quantity("charge", positive=True)] = Field("charge of a full one")
    resistance: Annotated[OneNumber, Quantity("resistance", positive=True)] = Field("inner one")
    start: Share = Field("state of charge at the start", default=0.8)
    dc_link: Annotated[OneNumber, Quantity("capacitance", positive=True)] = Field(
        "capacitance of the dc link", default=1e-3
    )

    def problems(self) -> Iterator[Problem]:
        if len(self.charges) != len(self.voltages) or len(self.charges) < 2:
            counts = f"got {len(self.charges)} and {len(self.voltages)}"
            yield Problem(("voltages",), f"as many voltages as charges were expected, two or more; {counts}")
        elif any(b <= a for a, b in zip(self.charges, self.charges[1:], strict=False)):
            yield Problem(("charges",), "states of charge that increase were expected")
        elif self.charges[0] < 0.0 or self.charges[-1] > 1.0:
            yield Problem(("charges",), f"shares from 0 to 1 were expected, got {self.charges[-1]:g}; 80 % are 0.8")


class ThreePhaseMotor(Drive):
    """A motor in dq with field-oriented control, and what feeds it."""

    outputs: ClassVar[tuple[str, ...]] = (
        *Drive.outputs,
        Output("current_d", "A", "current along the flux"),
        Output("current_q", "A", "current that makes torque"),
        Output("dc_voltage", "V", "voltage of the dc link"),
        Output("inverter_loss", "W"),
    )

    pole_pairs: Whole = Field("p", default=4)
    bandwidth: Annotated[OneNumber, Quantity("frequency", positive=True)] = Field(
        "of the current controllers", default=300.0
    )
    dc_voltage: Maybe[PositiveVoltage] = Field("of the dc link; or `battery`", default=None)
    battery: Maybe[OneRecord[Battery]] = Field("that feeds the dc link", default=None)
    inverter_power: Annotated[OneNumber, Quantity("power"), NotNegative] = Field(
        "P₀, that it takes always", default=0.0
    )
    inverter_drop: Annotated[OneNumber, Quantity("voltage"), NotNegative] = Field(
        "V, of a conducting switch, its switching losses per current among it", default=0.0
    )
    inverter_resistance: Annotated[OneNumber, Quantity("resistance"), NotNegative] = Field(
        "R_s, of a conducting switch", default=0.0
    )
    windings: ClassVar[tuple[str, ...]] = ("resistance", "inductance")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        for key in self.windings:
            if not getattr(self, key):
                yield Problem((), f"`{key}` is missing: of the winding, greater than zero")
        if self.controlled and (self.dc_voltage is None) == (self.battery is None):
            yield Problem((), "the dc link has a `dc_voltage`, or a `battery`, one of them")

    @property
    def controlled(self) -> bool:
        """Whether an inverter feeds it."""
        return True


class SynchronousMotor(ThreePhaseMotor):
    """A permanent-magnet synchronous motor with field-oriented control and inverter."""

    type: Literal["synchronous-motor"] = "synchronous-motor"
    effort: CoordinateEffortFunction = Field("command, as an effort on the coordinate, without losses")
    torque_constant: TorqueConstant = Field("3/2 p ψ: torque per amplitude of the current i_q")
    inductance: Inductance = Field("L_q, across the magnets")
    inductance_d: Maybe[Inductance] = Field("L_d, along the magnets; default `inductance`", default=None)
    current_limit: PositiveCurrent = Field("greatest amplitude of the current")
    current_d: Annotated[OneFunction, varying("current")] = Field(
        "i_d asked for; negative: it weakens the field", default=0.0
    )


class InductionMotor(ThreePhaseMotor):
    """An induction motor with field-oriented control and inverter, or at a grid."""

    outputs: ClassVar[tuple[str, ...]] = (
        *ThreePhaseMotor.outputs,
        Output("flux", "V*s", "amplitude of the flux of the rotor, M i_μ"),
        Output("slip", "rad/s", "electrical speed of the frame less that of the rotor"),
    )

    type: Literal["induction-motor"] = "induction-motor"
    effort: Maybe[CoordinateEffortFunction] = Field(
        "command, as an effort on the coordinate, without losses; or `voltage`", default=None
    )
    voltage: Maybe[Voltage] = Field("of a grid, rms between two phases, in place of `effort`", default=None)
    frequency: Maybe[Annotated[OneFunction, varying("frequency")]] = Field("of the grid", default=None)
    pole_pairs: Whole = Field("p", default=2)
    inductance: Inductance = Field("L_m, magnetising")
    stator_leakage: Inductance = Field("L_s - L_m")
    rotor_leakage: Inductance = Field("L_r - L_m, on the side of the stator")
    rotor_resistance: Resistance = Field("R_r, of a phase, on the side of the stator")
    current_limit: Maybe[PositiveCurrent] = Field("greatest amplitude of the current", default=None)
    current_d: Maybe[Annotated[OneFunction, varying("current")]] = Field(
        "i_d asked for, which makes the flux M i_d; less of it weakens the field", default=None
    )
    windings: ClassVar[tuple[str, ...]] = (
        *ThreePhaseMotor.windings,
        "rotor_resistance",
        "stator_leakage",
        "rotor_leakage",
    )

    @property
    def controlled(self) -> bool:
        return self.voltage is None

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if (self.effort is None) == (self.voltage is None):
            yield Problem(
                (), "the motor has an `effort`, asked of its inverter, or the `voltage` of a grid, one of them"
            )
            return
        needed, foreign = ("current_limit", "current_d"), ("frequency",)
        if not self.controlled:
            needed, foreign = foreign, (*needed, "dc_voltage", "battery", "inverter_power", "inverter_drop")
            foreign = (*foreign, "inverter_resistance", "bandwidth")
        for key in needed:
            if getattr(self, key) is None:
                yield Problem((), f"`{key}` is missing: it goes with `{'effort' if self.controlled else 'voltage'}`")
        for key in foreign:
            if getattr(self, key) != type(self).model_fields[key].default:
                yield superfluous(
                    key, f"belongs to {'a `voltage`' if self.controlled else 'an `effort`'}, and none is given"
                )


# behind the columns of a drive: command of i_d, states of both currents and controllers, of the dc link and the charge, and the voltage
# over the charge, the last three NONE without a battery; states of i_μ, NONE with magnets; frequency, NONE with an inverter
DIRECT, CURRENT_D, CURRENT_Q, CONTROL_D, CONTROL_Q, LINK, CHARGE, OPEN, MAGNETISING_D, MAGNETISING_Q, GRID = range(
    7, 18
)
# behind its numbers: p, ψ, L_d, L_q, α, U, C, R_b, Q, P₀, V, R_s, M, R_R
POLES, FLUX, L_D, L_Q, ALPHA, DC, CAPACITANCE, INNER, CAPACITY, STANDBY, DROP, SWITCH, MUTUAL, ROTOR = range(14, 28)
UNMAGNETISED = 0.01  # share of the greatest current that the controller takes for i_μ where it is less


@stage
def flux_seen(machine, index, n):
    """ψ_d by which the controller finds slip and currents: that of the magnets, or of the rotor, then never none."""
    state = record_at(machine).elements.state
    if index[MAGNETISING_D] == NONE:
        return n[FLUX] + 0.0 * state[index[CURRENT_D]]
    least, magnetising = UNMAGNETISED * n[DriveRow.LIMIT], state[index[MAGNETISING_D]]
    return n[MUTUAL] * (magnetising if real(magnetising) > real(least) else least + 0.0 * magnetising)


@stage
def turned_frame(machine, index, n, i_q, turning, t):
    """ω_k: of the grid, of the magnets, or of the flux of the rotor."""
    if index[GRID] != NONE:
        return 2.0 * np.pi * evaluate_function(machine, index[GRID], t) + 0.0 * turning
    if index[MAGNETISING_D] == NONE:
        return turning + 0.0 * i_q
    return turning + n[ROTOR] * i_q / flux_seen(machine, index, n)


@stage
def induced(machine, index, n, i_d, i_q, turning, frame):
    """(ψ_d, ψ_q, e_d, e_q, loss in the rotor); i_μ has its rates and its energy."""
    record = record_at(machine)
    elements = record.elements
    if index[MAGNETISING_D] == NONE:
        none = 0.0 * turning
        return n[FLUX] + none, none, none, turning * n[FLUX], none
    m_d, m_q = elements.state[index[MAGNETISING_D]], elements.state[index[MAGNETISING_Q]]
    psi_d, psi_q = n[MUTUAL] * m_d, n[MUTUAL] * m_q
    r_d, r_q, slip = i_d - m_d, i_q - m_q, frame - turning
    elements.state_rate[index[MAGNETISING_D]] += (n[ROTOR] * r_d + slip * psi_q) / n[MUTUAL]
    elements.state_rate[index[MAGNETISING_Q]] += (n[ROTOR] * r_q - slip * psi_d) / n[MUTUAL]
    record.control.stored[0] += 0.75 * n[MUTUAL] * (m_d * m_d + m_q * m_q)
    e_d, e_q = n[ROTOR] * r_d - turning * psi_q, n[ROTOR] * r_q + turning * psi_d
    return psi_d, psi_q, e_d, e_q, 1.5 * n[ROTOR] * (r_d * r_d + r_q * r_q)


@stage
def controlled(machine, index, n, torque, direct, from_flux, frame, link):
    """Voltages (u_d, u_q) that the inverter gives; the states of the controllers have their rates. from_flux : (e_d, e_q)."""
    elements = record_at(machine).elements
    i_d, i_q = elements.state[index[CURRENT_D]], elements.state[index[CURRENT_Q]]
    x_d, x_q = elements.state[index[CONTROL_D]], elements.state[index[CONTROL_Q]]
    limit = n[DriveRow.LIMIT]
    wanted_d = clipped(direct, limit)
    left = np.sqrt(limit * limit - wanted_d * wanted_d + 1e-12 * limit * limit)
    per_current = 1.5 * n[POLES] * (flux_seen(machine, index, n) + (n[L_D] - n[L_Q]) * wanted_d)
    wanted_q = clipped(torque / per_current, left)
    e_d, e_q = wanted_d - i_d, wanted_q - i_q
    u_d = n[ALPHA] * n[L_D] * e_d + x_d - frame * n[L_Q] * i_q + from_flux[0]
    u_q = n[ALPHA] * n[L_Q] * e_q + x_q + frame * n[L_D] * i_d + from_flux[1]
    largest, size = link / np.sqrt(3.0), np.sqrt(u_d * u_d + u_q * u_q)
    share = largest / size if real(size) > real(largest) else 1.0 + 0.0 * size
    cut_d, cut_q = share * u_d, share * u_q
    rate, resistance = elements.state_rate, n[DriveRow.RESISTANCE]
    rate[index[CONTROL_D]] += n[ALPHA] * resistance * e_d + resistance / n[L_D] * (cut_d - u_d)
    rate[index[CONTROL_Q]] += n[ALPHA] * resistance * e_q + resistance / n[L_Q] * (cut_q - u_q)
    return cut_d, cut_q


@stage
def fed(machine, index, n, power, link):
    """(power from outside, loss in the battery) where the inverter takes `power` from the dc link at the voltage `link`."""
    record = record_at(machine)
    elements = record.elements
    if index[LINK] == NONE:
        return power, 0.0 * power
    voltage, _, _ = table_value(record.functions, index[OPEN], elements.state[index[CHARGE]])
    current = (voltage - link) / n[INNER]
    elements.state_rate[index[LINK]] += (current - power / link) / n[CAPACITANCE]
    elements.state_rate[index[CHARGE]] -= current / n[CAPACITY]
    record.control.stored[0] += 0.5 * n[CAPACITANCE] * link * link
    return voltage * current, n[INNER] * current * current


@element
def turn_by_field(machine, k, index, n, t):
    """Currents, torques and effort of a three-phase motor."""
    record = record_at(machine)
    elements, control, out = record.elements, record.control, record.outputs.value
    omega = shaft_speed(machine, index, n)
    command, turning = evaluate_function(machine, index[DriveRow.COMMAND], t), n[POLES] * omega
    link = n[DC] + 0.0 * omega
    if index[LINK] != NONE:
        link = elements.state[index[LINK]]
    i_d, i_q = elements.state[index[CURRENT_D]], elements.state[index[CURRENT_Q]]
    frame = turned_frame(machine, index, n, i_q, turning, t)
    psi_d, psi_q, e_d, e_q, rotor_loss = induced(machine, index, n, i_d, i_q, turning, frame)
    if index[GRID] != NONE:
        u_d, u_q = np.sqrt(2.0 / 3.0) * command + 0.0 * omega, 0.0 * omega
    else:
        direct = evaluate_function(machine, index[DIRECT], t)
        u_d, u_q = controlled(machine, index, n, command / n[DriveRow.GEAR], direct, (e_d, e_q), frame, link)
    resistance = n[DriveRow.RESISTANCE]
    elements.state_rate[index[CURRENT_D]] += (u_d - resistance * i_d + frame * n[L_Q] * i_q - e_d) / n[L_D]
    elements.state_rate[index[CURRENT_Q]] += (u_q - resistance * i_q - frame * n[L_D] * i_d - e_q) / n[L_Q]
    torque = 1.5 * n[POLES] * (psi_d * i_q - psi_q * i_d + (n[L_D] - n[L_Q]) * i_d * i_q)
    square = i_d * i_d + i_q * i_q
    amplitude = np.sqrt(square + 1e-12 * n[DriveRow.LIMIT] * n[DriveRow.LIMIT])
    switching = n[STANDBY] + 6.0 / np.pi * n[DROP] * amplitude + 1.5 * n[SWITCH] * square
    taken = 1.5 * (u_d * i_d + u_q * i_q) + switching
    supplied, inner = fed(machine, index, n, taken, link)
    rubbing = n[DriveRow.FRICTION_TORQUE] * tanh(omega / n[DriveRow.TRANSITION_SPEED]) + n[DriveRow.VISCOUS] * omega
    effort, lost = transmit(machine, k, torque - rubbing, omega)
    loss = 1.5 * resistance * square + rotor_loss + rubbing * omega + lost + switching + inner
    control.power[0] += supplied
    control.power[1] += loss
    control.stored[0] += 0.75 * (n[L_D] * i_d * i_d + n[L_Q] * i_q * i_q)
    first = np.int64(index[DriveRow.OUTPUT])
    out[first], out[first + 1] = effort, add_coordinate_force(machine, index[DriveRow.COORDINATE], effort)
    out[first + 2], out[first + 3], out[first + 4] = omega, torque, amplitude
    out[first + 5], out[first + 6], out[first + 7] = np.sqrt(u_d * u_d + u_q * u_q), taken, loss
    out[first + 8], out[first + 9], out[first + 10], out[first + 11] = i_d, i_q, link, switching
    if index[MAGNETISING_D] != NONE:
        out[first + 12], out[first + 13] = np.sqrt(psi_d * psi_d + psi_q * psi_q), frame - turning


def add_synchronous_motor(builder: SystemBuilder, force: SynchronousMotor) -> None:
    """Magnets."""
    flux = force.torque_constant / (1.5 * force.pole_pairs)
    inductances = (force.inductance_d or force.inductance, force.inductance)
    add_windings(builder, force, force.effort, flux, inductances, (NONE, NONE, NONE), (0.0, 0.0))


def add_induction_motor(builder: SystemBuilder, force: InductionMotor) -> None:
    """A rotor that currents magnetise: as much as is asked for from the start on, or from nothing at a grid."""
    name, limit = force.name, force.current_limit or 1.0
    share = force.inductance / (force.inductance + force.rotor_leakage)
    mutual = share * force.inductance
    states = [
        builder.own_state(
            StateFact(f"{name}.magnetising_{axis}", "A", f"magnetising current i_μ{axis} of {name}", 0.0, limit)
        )
        for axis in "dq"
    ]
    grid = NONE if force.frequency is None else builder.function(force.frequency)
    inductance, rotor = force.stator_leakage + force.inductance - mutual, (mutual, share**2 * force.rotor_resistance)
    command = force.voltage or force.effort or 0.0
    add_windings(builder, force, command, 0.0, (inductance, inductance), (states[0], states[1], grid), rotor)
    if force.current_d is not None:
        builder.samples.append((states[0], force.current_d, None, 0.0))


def add_windings(
    builder: SystemBuilder,
    force: SynchronousMotor | InductionMotor,
    command: TimeFunction,
    flux: float,
    inductances: tuple[float, float],
    columns_of_rotor: tuple[int, int, int],
    numbers_of_rotor: tuple[float, float],
) -> None:
    """Shaft, currents with their controllers, and what feeds it."""
    name, battery = force.name, force.battery
    full = math.inf if battery is None else max(battery.voltages)
    scale = force.dc_voltage or (full if battery else 1.0)
    limit = force.current_limit or 1.0

    def state(word: str, units: str, words: str, start: float, size: float) -> int:
        return builder.own_state(StateFact(f"{name}.{word}", units, f"{words} of {name}", start, size))

    columns = [NONE if force.current_d is None else builder.function(force.current_d)]
    columns += [state(f"current_{axis}", "A", f"current i_{axis}", 0.0, limit) for axis in "dq"]
    if force.controlled:
        columns += [state(f"control_{axis}", "V", f"controller of i_{axis}", 0.0, scale) for axis in "dq"]
    else:
        columns += [NONE, NONE]
    numbers = [force.pole_pairs, flux, *inductances, 2.0 * math.pi * force.bandwidth, force.dc_voltage or 0.0]
    if battery is None:
        columns, numbers = [*columns, NONE, NONE, NONE], [*numbers, 0.0, 0.0, 0.0]
    else:
        open_voltage = Table(battery.charges, battery.voltages, of="charge")
        columns.append(state("dc_link", "V", "voltage of the dc link", open_voltage(battery.start), full))
        columns.append(state("charge", "1", "state of charge of the battery", battery.start, 1.0))
        columns.append(builder.functions.add(open_voltage, no_argument))
        numbers += [battery.dc_link, battery.resistance, battery.capacity]
    numbers += [force.inverter_power, force.inverter_drop, force.inverter_resistance, *numbers_of_rotor]

    own = {"kind": 0.0, "state": NONE, "curve": NONE, "constant": 0.0, "lag": 0.0}
    own |= {"limit": limit, "voltage_limit": math.inf}
    add_row(builder, force, command, turn_by_field, ([*columns, *columns_of_rotor], numbers), **own)


KINDS = (
    Kind(SynchronousMotor, add_synchronous_motor, (turn_by_field,)),
    Kind(InductionMotor, add_induction_motor, (turn_by_field,)),
)
