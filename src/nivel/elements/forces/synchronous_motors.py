"""Synchronous motors with permanent magnets on a joint coordinate, with field-oriented control, inverter and battery.

    L_d di_d/dt = u_d - R i_d + ω_e L_q i_q        L_q di_q/dt = u_q - R i_q - ω_e (L_d i_d + ψ)        ω_e = p ω
    T = 3/2 p (ψ i_q + (L_d - L_q) i_d i_q)        P = 3/2 (u_d i_d + u_q i_q)

in the frame of the rotor, with amplitudes (Park 1929; Schröder, Elektrische Antriebe, 2021). The torque asked for is a current i_q, at most
what √(i_max² - i_d²) leaves. The controllers of both currents take their poles away (Harnefors and Nee 1998): with α = 2π `bandwidth`

    u = α L (i* - i) + x + what the other axis induces        ẋ = α R (i* - i) + R/L (u' - u)

so a current follows as α/(s + α), until the voltage u' is cut to U/√3 of the dc link; x then does not run away. The inverter loses
P₀ + 6/π V i + 3/2 R_s i², i the amplitude. A battery feeds the dc link: C dU/dt = I - P/U, I = (U₀ - U)/R_b, ds/dt = -I/Q.

Energy: the battery gives U₀ I, without one the dc link P; R_b I², P_inverter, 3/2 R i² and friction are lost; ½ C U², 3/4 L i² are stored.
"""

from __future__ import annotations

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
    TorqueConstant,
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
from nivel.machine.core.record import Checked, Problem
from nivel.machine.given import Field, ManyNumbers, Maybe, OneNumber, OneRecord
from nivel.machine.laws.time_function import OneFunction, varying
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


class SynchronousMotor(Drive):
    """A permanent-magnet synchronous motor with field-oriented control and inverter."""

    outputs: ClassVar[tuple[str, ...]] = (
        *Drive.outputs,
        Output("current_d", "A", "current along the magnets"),
        Output("current_q", "A", "current that makes torque"),
        Output("dc_voltage", "V", "voltage of the dc link"),
        Output("inverter_loss", "W"),
    )

    type: Literal["synchronous-motor"] = "synchronous-motor"
    effort: CoordinateEffortFunction = Field("command, as an effort on the coordinate, without losses")
    torque_constant: TorqueConstant = Field("3/2 p ψ: torque per amplitude of the current i_q")
    pole_pairs: Whole = Field("p", default=4)
    inductance: Inductance = Field("L_q, across the magnets")
    inductance_d: Maybe[Inductance] = Field("L_d, along the magnets; default `inductance`", default=None)
    current_limit: PositiveCurrent = Field("greatest amplitude of the current")
    current_d: Annotated[OneFunction, varying("current")] = Field(
        "i_d asked for; negative: it weakens the field", default=0.0
    )
    bandwidth: Annotated[OneNumber, Quantity("frequency", positive=True)] = Field(
        "of the current controllers", default=300.0
    )
    dc_voltage: Maybe[Annotated[OneNumber, Quantity("voltage", positive=True)]] = Field(
        "of the dc link; or `battery`", default=None
    )
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

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        for key in ("resistance", "inductance"):
            if not getattr(self, key):
                yield Problem((), f"`{key}` is missing: of the winding, greater than zero")
        if (self.dc_voltage is None) == (self.battery is None):
            yield Problem((), "the dc link has a `dc_voltage`, or a `battery`, one of them")


# behind the columns of a drive: command of i_d, states of both currents and controllers, of the dc link and the charge, and the voltage
# over the charge, the last three NONE without a battery
DIRECT, CURRENT_D, CURRENT_Q, CONTROL_D, CONTROL_Q, LINK, CHARGE, OPEN = range(7, 15)
# behind its numbers: p, ψ, L_d, L_q, α, U, C, R_b, Q, P₀, V, R_s
POLES, FLUX, L_D, L_Q, ALPHA, DC, CAPACITANCE, INNER, CAPACITY, STANDBY, DROP, SWITCH = range(14, 26)


@stage
def controlled(machine, index, n, torque, direct, electrical, link):
    """Voltages (u_d, u_q) that the inverter gives; the states of the controllers have their rates."""
    elements = record_at(machine).elements
    i_d, i_q = elements.state[index[CURRENT_D]], elements.state[index[CURRENT_Q]]
    x_d, x_q = elements.state[index[CONTROL_D]], elements.state[index[CONTROL_Q]]
    limit = n[DriveRow.LIMIT]
    wanted_d = clipped(direct, limit)
    left = np.sqrt(limit * limit - wanted_d * wanted_d + 1e-12 * limit * limit)
    per_current = 1.5 * n[POLES] * (n[FLUX] + (n[L_D] - n[L_Q]) * wanted_d)
    wanted_q = clipped(torque / per_current, left)
    e_d, e_q = wanted_d - i_d, wanted_q - i_q
    u_d = n[ALPHA] * n[L_D] * e_d + x_d - electrical * n[L_Q] * i_q
    u_q = n[ALPHA] * n[L_Q] * e_q + x_q + electrical * (n[L_D] * i_d + n[FLUX])
    largest, size = link / np.sqrt(3.0), np.sqrt(u_d * u_d + u_q * u_q)
    share = largest / size if real(size) > real(largest) else 1.0 + 0.0 * size
    cut_d, cut_q = share * u_d, share * u_q
    rate, resistance = elements.state_rate, n[DriveRow.RESISTANCE]
    rate[index[CONTROL_D]] += n[ALPHA] * resistance * e_d + resistance / n[L_D] * (cut_d - u_d)
    rate[index[CONTROL_Q]] += n[ALPHA] * resistance * e_q + resistance / n[L_Q] * (cut_q - u_q)
    rate[index[CURRENT_D]] += (cut_d - resistance * i_d + electrical * n[L_Q] * i_q) / n[L_D]
    rate[index[CURRENT_Q]] += (cut_q - resistance * i_q - electrical * (n[L_D] * i_d + n[FLUX])) / n[L_Q]
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
    """Currents, torques and effort of a synchronous motor."""
    record = record_at(machine)
    elements, control, out = record.elements, record.control, record.outputs.value
    omega = shaft_speed(machine, index, n)
    asked = evaluate_function(machine, index[DriveRow.COMMAND], t) / n[DriveRow.GEAR]
    direct = evaluate_function(machine, index[DIRECT], t)
    link = n[DC] + 0.0 * omega
    if index[LINK] != NONE:
        link = elements.state[index[LINK]]
    i_d, i_q = elements.state[index[CURRENT_D]], elements.state[index[CURRENT_Q]]
    u_d, u_q = controlled(machine, index, n, asked, direct, n[POLES] * omega, link)
    torque = 1.5 * n[POLES] * (n[FLUX] * i_q + (n[L_D] - n[L_Q]) * i_d * i_q)
    square = i_d * i_d + i_q * i_q
    amplitude = np.sqrt(square + 1e-12 * n[DriveRow.LIMIT] * n[DriveRow.LIMIT])
    switching = n[STANDBY] + 6.0 / np.pi * n[DROP] * amplitude + 1.5 * n[SWITCH] * square
    taken = 1.5 * (u_d * i_d + u_q * i_q) + switching
    supplied, inner = fed(machine, index, n, taken, link)
    rubbing = n[DriveRow.FRICTION_TORQUE] * tanh(omega / n[DriveRow.TRANSITION_SPEED]) + n[DriveRow.VISCOUS] * omega
    effort, lost = transmit(machine, k, torque - rubbing, omega)
    loss = 1.5 * n[DriveRow.RESISTANCE] * square + rubbing * omega + lost + switching + inner
    control.power[0] += supplied
    control.power[1] += loss
    control.stored[0] += 0.75 * (n[L_D] * i_d * i_d + n[L_Q] * i_q * i_q)
    first = np.int64(index[DriveRow.OUTPUT])
    out[first], out[first + 1] = effort, add_coordinate_force(machine, index[DriveRow.COORDINATE], effort)
    out[first + 2], out[first + 3], out[first + 4] = omega, torque, amplitude
    out[first + 5], out[first + 6], out[first + 7] = np.sqrt(u_d * u_d + u_q * u_q), taken, loss
    out[first + 8], out[first + 9], out[first + 10], out[first + 11] = i_d, i_q, link, switching


def add_synchronous_motor(builder: SystemBuilder, force: SynchronousMotor) -> None:
    """Its shaft, its currents with their controllers, and what feeds it."""
    name, battery = force.name, force.battery
    flux = force.torque_constant / (1.5 * force.pole_pairs)
    full = math.inf if battery is None else max(battery.voltages)
    scale = force.dc_voltage or full

    def state(word: str, units: str, words: str, start: float, size: float) -> int:
        return builder.own_state(StateFact(f"{name}.{word}", units, f"{words} of {name}", start, size))

    columns = [builder.function(force.current_d)]
    columns += [state(f"current_{axis}", "A", f"current i_{axis}", 0.0, force.current_limit) for axis in "dq"]
    columns += [state(f"control_{axis}", "V", f"controller of i_{axis}", 0.0, scale) for axis in "dq"]
    numbers = [force.pole_pairs, flux, force.inductance_d or force.inductance, force.inductance]
    numbers += [2.0 * math.pi * force.bandwidth, force.dc_voltage or 0.0]
    if battery is None:
        columns, numbers = [*columns, NONE, NONE, NONE], [*numbers, 0.0, 0.0, 0.0]
    else:
        open_voltage = Table(battery.charges, battery.voltages, of="charge")
        columns.append(state("dc_link", "V", "voltage of the dc link", open_voltage(battery.start), full))
        columns.append(state("charge", "1", "state of charge of the battery", battery.start, 1.0))
        columns.append(builder.functions.add(open_voltage, no_argument))
        numbers += [battery.dc_link, battery.resistance, battery.capacity]
    numbers += [force.inverter_power, force.inverter_drop, force.inverter_resistance]

    own = {"kind": 0.0, "state": NONE, "curve": NONE, "constant": force.torque_constant, "lag": 0.0}
    own |= {"limit": force.current_limit, "voltage_limit": math.inf}
    add_row(builder, force, force.effort, turn_by_field, (columns, numbers), **own)


KINDS = (Kind(SynchronousMotor, add_synchronous_motor, (turn_by_field,)),)
