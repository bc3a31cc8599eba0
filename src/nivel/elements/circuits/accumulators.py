"""Accumulators: a volume with gas in it, behind an inlet.

With a thermal time τ the gas exchanges heat with its surroundings. It is compressed without heat, p V^γ = P V₀^γ; heat changes P, which is
a state (Pourmovahed and Otis 1990, for an ideal gas):

    dP/dt = P (T₀/T - 1)/τ        T/T₀ = p V/(p₀ V₀) = P/p₀ (V/V₀)^(1 - γ)

At rest T = T₀ and p V = p₀ V₀. P stands in place of the precharge among the constants of the volume
(`nivel.elements.circuits.volumes`); how its pressure depends on P on dual numbers is a room that is zero in its real part.

Nitrogen has θ, its temperature at the precharge's density on its adiabat, in place of P, and c_v dθ/θ = ds = c_v(ρ, T) (T₀/T - 1)/τ dt.
"""

import math
from collections.abc import Iterator
from typing import Any, ClassVar, Literal

import numpy as np

from nivel.elements.circuits import ranges
from nivel.elements.circuits.chambers import DEAD_SHARE
from nivel.elements.circuits.component import Component
from nivel.elements.circuits.fluids import ROOM
from nivel.elements.circuits.kind import ComponentKind, Phase, called, slopes_of
from nivel.elements.circuits.ledger import lose, lose_between, transfer
from nivel.elements.circuits.nitrogen import gas_state, newton_step, on_adiabat
from nivel.elements.circuits.nodes import volume_node
from nivel.elements.circuits.restrictions import TRANSITION, add_flow, restrict
from nivel.elements.circuits.smooth import ramp, root_flow, step
from nivel.elements.circuits.symbol import Symbol, path
from nivel.elements.circuits.tangent import add_flow_by_pressure
from nivel.elements.circuits.volumes import (
    EXPONENT,
    GAS,
    LAST_DENSITY,
    LAST_TEMPERATURE,
    NITROGEN,
    OPEN,
    PRECHARGE,
    PRESSURE,
    THETA,
    nitrogen_room,
)
from nivel.elements.facts import StateFact
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real
from nivel.kernels.record.record import record_at
from nivel.known import Node, Swept, SystemBuilder
from nivel.machine.core.coefficient import Exponent
from nivel.machine.core.coefficient import Volume as VolumeSize
from nivel.machine.core.record import Name, Problem, entry, superfluous
from nivel.machine.given import Field, Maybe
from nivel.machine.units.quantity import Duration
from nivel.native.function import leaf

LEAST_NITROGEN, MOST_NITROGEN, COLD, HOT = 1e5, 4e7, 233.0, 423.0  # Pa, K: of the precharge of nitrogen


class Accumulator(Component):
    """A volume with gas in it, behind an inlet."""

    needs: ClassVar[tuple[str, ...]] = ("A",)
    nodes: ClassVar[tuple[str, ...]] = ("",)
    early: ClassVar[tuple[str, ...]] = ("pressure",)
    late: ClassVar[tuple[str, ...]] = ("flow", "temperature")

    type: Literal["accumulator"] = "accumulator"
    volume: ranges.Size = Field("of the gas at its precharge")
    precharge: ranges.Level = Field("pressure of the gas without oil, absolute")
    gas_exponent: Maybe[Exponent] = Field(
        "polytropic exponent of the gas, default 1.3; with a `thermal_time` the adiabatic one, default 1.4",
        default=None,
    )
    thermal_time: Maybe[Duration] = Field(
        "time constant with which the gas takes the temperature of its surroundings", default=None
    )
    temperature: ranges.Warmth = Field("of the surroundings, with a `thermal_time`", default=ROOM)
    gas: Literal["ideal", "nitrogen"] = Field(
        "with a `thermal_time` also `nitrogen` by its own equation of state", default="ideal"
    )
    piston_friction: ranges.LeastDrop = Field(
        "difference of pressure that moves the piston between oil and gas", default=0.0
    )
    dead_volume: Maybe[VolumeSize] = Field("of oil when it is empty; default 2 % of the volume", default=None)
    flow: ranges.Flow = Field("through the inlet at `pressure_drop`")
    pressure_drop: ranges.Drop = Field("at which `flow` is measured")
    start: Maybe[ranges.Level] = Field("pressure at the start; default: that of a steady circuit", default=None)
    fluid: Name | None = Field("default: the only one", default=None)

    @property
    def exponent(self) -> float:
        """Of the law p Vⁿ of the gas."""
        return self.gas_exponent or (1.3 if self.thermal_time is None else 1.4)

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        warm = entry(data, "thermal_time") is not None
        return (*cls.early, *cls.late[: None if warm else 1])

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.gas == "nitrogen":
            if self.thermal_time is None:
                yield Problem(
                    ("gas",),
                    "nitrogen with its own equation of state needs a `thermal_time`, such as `thermal_time: 20 s`",
                )
            if self.gas_exponent is not None:
                yield superfluous("gas_exponent", "belongs to an ideal gas; nitrogen has its own equation of state")
            if not LEAST_NITROGEN <= self.precharge <= MOST_NITROGEN or not COLD <= self.temperature <= HOT:
                told = "the equation of nitrogen holds from 1 to 400 bar of precharge and from 233 to 423 K"
                yield Problem(("gas",), f"{told}, got {self.precharge:g} Pa at {self.temperature:g} K")
        if self.thermal_time is None and self.temperature != ROOM:
            yield superfluous("temperature", "belongs to a `thermal_time`, and none is given")
        if self.thermal_time is not None and self.exponent == 1.0:
            yield Problem(("gas_exponent",), "with a `thermal_time` an adiabatic exponent above 1 was expected, got 1")


# inlets of accumulators with pistons: columns of `columns`, then of `number`: K [m³/s/√Pa], corner c [Pa], friction F [Pa],
# creep G [m³/s/Pa]
FROM, TO = 1, 2
FLOW, CORNER, STICK, CREEP = 0, 1, 2, 3
ROUNDED = 0.1  # share of the friction within which it is rounded


@called(Phase.FLOWS, 15)
@element
def rub(machine, index, n, t):
    """Inlets of accumulators with pistons: what is left of the difference of pressure beyond their friction drives the flow,

    Q = K e (e² + c²)^(-1/4) + G Δp, e = R(Δp - F) - R(-Δp - F)

    A piston that sticks creeps by G: without it a step would not see that it breaks loose.
    """
    record = record_at(machine)
    circuit = record.circuit
    secant = circuit.secant[0]
    a, b = index[FROM], index[TO]
    difference = circuit.pressure[a] - circuit.pressure[b]
    left = beyond(difference, n[STICK])
    flow = n[FLOW] * root_flow(left, n[CORNER], secant) + n[CREEP] * difference
    mass_flow = 0.5 * (circuit.density[a] + circuit.density[b]) * flow
    lose_between(machine, a, b, mass_flow, transfer(machine, a, b, mass_flow))
    record.outputs.value[index[OUTPUT]] = flow


@leaf
def beyond(difference, friction):
    """What of a difference of pressure is beyond the friction of a piston, with its sign."""
    width = ROUNDED * friction
    return ramp(difference - friction, width) - ramp(-difference - friction, width)


@slopes_of(rub)
@element
def add_slopes_of_inlets(machine, index, n, t):
    """Slopes of the flows through such inlets, as secants from F on."""
    record = record_at(machine)
    circuit = record.circuit
    a, b = index[FROM], index[TO]
    difference = circuit.pressure[a] - circuit.pressure[b]
    left = beyond(difference, n[STICK])
    density = 0.5 * (circuit.density[a] + circuit.density[b])
    opened = step((np.abs(difference) - n[STICK]) / (ROUNDED * n[STICK]))
    slope = density * (n[FLOW] * opened / np.sqrt(np.sqrt(left * left + n[CORNER] * n[CORNER])) + n[CREEP])
    add_flow_by_pressure(circuit, a, b, a, slope)
    add_flow_by_pressure(circuit, a, b, b, -slope)


def accumulator_nodes(builder: SystemBuilder, component: Accumulator, swept: Swept) -> Iterator[Node]:
    """The node behind the inlet of an accumulator."""
    dead = component.dead_volume or DEAD_SHARE * component.volume
    if component.gas == "nitrogen":
        room = nitrogen_room(dead, component.volume, component.precharge, component.temperature, component.start)
    else:
        room = (dead, 0.0, component.volume, first_charge(component), component.exponent)
    yield volume_node(
        builder, component, component.name, "", room, component.start, swept, temperature="oil_temperature"
    )


def first_charge(component: Accumulator) -> float:
    """The precharge; with a thermal time that of the compression without heat that ends at the start at the temperature around it."""
    if component.thermal_time is None or component.start is None:
        return component.precharge
    return component.precharge * min(1.0, component.precharge / component.start) ** (component.exponent - 1.0)


CREEP_SHARE = 1e-3  # share of the rated flow by which a piston that sticks moves at the limit of its friction


def add_inlet(builder: SystemBuilder, component: Accumulator) -> None:
    """The inlet of an accumulator."""
    conductance = component.flow / math.sqrt(component.pressure_drop)
    if component.piston_friction:
        first = builder.outputs.add((f"hydraulics.{component.name}.flow", "m^3/s", f"flow of {component.name}"))
        columns = [first, builder.node(component.ports["A"]), builder.node(component.name)]
        friction = component.piston_friction
        builder.elements.add(rub, columns, [conductance, TRANSITION, friction, CREEP_SHARE * component.flow / friction])
    else:
        add_flow(builder, component, "flow", ("A", ""), [conductance, TRANSITION, 0.0])
    if component.thermal_time is not None:
        _add_gas(builder, component, component.thermal_time)


def _add_gas(builder: SystemBuilder, component: Accumulator, time: float) -> None:
    """The temperature of the gas of an accumulator."""
    name, real = component.name, component.gas == "nitrogen"
    if real:
        words = f"temperature of the gas in {name} on its adiabat at the density of its precharge"
        theta = builder.circuit.nodes[name].room[THETA]
        fact = StateFact(f"{name}.gas_temperature", "K", words, theta, component.temperature)
    else:
        words = f"P of the gas in {name}, as of a precharge"
        fact = StateFact(f"{name}.charge", "Pa", words, first_charge(component), component.precharge)
    state = builder.own_state(fact)
    first = builder.outputs.add((f"hydraulics.{name}.temperature", "K", f"temperature of the gas in {name}"))
    columns = [first, builder.node(name), state]
    builder.elements.add(charge_nitrogen if real else charge, columns)
    numbers = [component.precharge, time, component.temperature]
    builder.elements.add(warm_nitrogen if real else exchange_heat, columns, numbers)


# columns of `columns`; output: temperature of the gas
OUTPUT, NODE, STATE = 0, 1, 2
# columns of `number`: p₀ [Pa], τ [s], T₀ [K]
FILLED, TIME, SURROUNDINGS = 0, 1, 2
CHANGED = 1e-12


@leaf
def share_of_gas(room, pressure):
    """V/V₀ at the real pressure [Pa]; one below P."""
    return min(1.0, (room[PRECHARGE] / pressure) ** (1.0 / room[EXPONENT]))


@called(Phase.VOLUMES, 1, slow=True)
@element
def charge(machine, index, n, t):
    """Put P among the constants of each volume."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    node = index[NODE]
    room, known, own = circuit.room[node], circuit.known[node], elements.state[index[STATE]]
    if room[PRECHARGE] != real(own):
        room[PRECHARGE] = real(own)
        known[OPEN] += CHANGED * (known[OPEN] + room[GAS])  # what is known holds for another P
    by_state = 0.0
    if known[PRESSURE] > room[PRECHARGE]:
        by_state = -room[GAS] * share_of_gas(room, known[PRESSURE]) / (room[EXPONENT] * room[PRECHARGE])
    circuit.volume[node] = by_state * (own - real(own))


@called(Phase.FLOWS, 13, slow=True)
@element
def exchange_heat(machine, index, n, t):
    """Rates of P, and the heat that leaves the gas."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    room, own = circuit.room[index[NODE]], elements.state[index[STATE]]
    pressure = circuit.pressure[index[NODE]]
    left = (own / pressure) ** (1.0 / room[EXPONENT])
    if real(left) > 1.0:
        left = 0.0 * left + 1.0
    over = room[EXPONENT] - 1.0
    warmth = own / n[FILLED] * np.exp(-over * np.log(left))
    rate = own * (1.0 / warmth - 1.0) / n[TIME]
    elements.state_rate[index[STATE]] += rate
    work = (np.exp(-over * np.log(left)) - 1.0) / over if over > 0.0 else -np.log(left)
    lose(machine, -room[GAS] * work * rate)
    record.outputs.value[index[OUTPUT]] = n[SURROUNDINGS] * warmth


@leaf
def gas_at(room, theta, pressure):
    """(ρ, T) of nitrogen at a pressure, not below that of its precharge's density, for θ; exact on dual numbers."""
    least, _, _, entropy, _, _ = gas_state(room[NITROGEN], theta)
    if real(pressure) < real(least):
        pressure = least
    rho, T = on_adiabat(real(pressure), real(entropy), real(room[LAST_DENSITY]), real(room[LAST_TEMPERATURE]))
    return newton_step(pressure, entropy, rho, T)


@leaf
def room_by_theta(room, theta, pressure):
    """∂V_oil/∂θ [m³/K] at a real pressure."""
    _, _, _, _, heat_at_rest, _ = gas_state(room[NITROGEN], theta)
    rho, T = gas_at(room, theta, pressure)
    _, by_density, by_heat, _, heat, _ = gas_state(rho, T)
    falling = -by_heat / (by_density * heat / T + by_heat * by_heat / (rho * rho))  # of ρ with s
    return room[GAS] * room[NITROGEN] / (rho * rho) * falling * heat_at_rest / theta


@called(Phase.VOLUMES, 2, slow=True)
@element
def charge_nitrogen(machine, index, n, t):
    """Put θ among the constants of each volume, and the pressure of its precharge's density."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    node = index[NODE]
    room, known, own = circuit.room[node], circuit.known[node], elements.state[index[STATE]]
    if room[THETA] != real(own):
        room[THETA] = real(own)
        room[PRECHARGE] = gas_state(real(room[NITROGEN]), real(own))[0]
        known[OPEN] += CHANGED * (known[OPEN] + room[GAS])  # what is known holds for another θ
    by_state = 0.0
    if known[PRESSURE] > room[PRECHARGE]:
        by_state = room_by_theta(room, real(own), known[PRESSURE])
    circuit.volume[node] = by_state * (own - real(own))


@called(Phase.FLOWS, 14, slow=True)
@element
def warm_nitrogen(machine, index, n, t):
    """Rates of θ, and the heat that leaves the gas."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    room, own = circuit.room[index[NODE]], elements.state[index[STATE]]
    rho, T = gas_at(room, own, circuit.pressure[index[NODE]])
    _, _, _, _, heat, _ = gas_state(rho, T)
    _, _, _, _, heat_at_rest, _ = gas_state(room[NITROGEN], own)
    rate = heat * (n[SURROUNDINGS] / T - 1.0) / n[TIME]  # of s
    elements.state_rate[index[STATE]] += rate * own / heat_at_rest
    # the energy on the adiabat is counted from θ on
    lose(machine, -room[GAS] * room[NITROGEN] * (T - own) * rate)
    record.outputs.value[index[OUTPUT]] = T


OF_ACCUMULATORS = (restrict, charge, exchange_heat, charge_nitrogen, warm_nitrogen, rub)

BODY = path("M-10 -10 A10 10 0 0 1 10 -10 V6 A10 10 0 0 1 -10 6 Z M-10 -2 H10 M0 16 V22 M-4 -8 h8 l-4 5 z")
ACCUMULATOR = Symbol(BODY, 10.0, 22.0, {}, {"A": 0.0}, "supply", key="volume", unit=(1e3, "L"))

KINDS = (ComponentKind(Accumulator, add_inlet, OF_ACCUMULATORS, symbol=ACCUMULATOR, nodes=accumulator_nodes),)
