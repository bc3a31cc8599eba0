"""Temperature of liquids, a state of their volumes: losses, and what flows in, warm them.

The law of density holds at constant entropy, so that its bulk modulus is the isentropic one. The state is the temperature θ that the
liquid would have at atmospheric pressure, expanded without heat; what fills a volume is m exp(α (θ - θ₀)) at θ₀. With μ = ∫ dp/ρ from pa

    v = φ(p)/ρ₀ exp(α (θ - θ₀))        h = c (θ - θ₀) + μ        T = ∂h/∂s = θ (1 + α μ/c)        ds = c dθ/θ

and the first law, m T ds = Σ ṁ_in (h_in - h) + heat, becomes

    m (c + α μ) dθ/dt = Σ ṁ_in c (θ_up - θ) + losses on the way in - H (T - T₀)

Mechanical energy is m μ - (p - pa) V: of the heat, m α μ dθ/dt becomes mechanical as the liquid expands. c and α are constant.

Coolers: heat that a liquid gives to a coolant of a given temperature on its way through.

    heat = ṁ c (T_in - T_c) (1 - exp(-H/(ṁ c)))

which is the law of a heat exchanger whose other side keeps its temperature; H is its conductance. The liquid behind it is colder by
heat/(ṁ c): T_out - T_c = (T_in - T_c) exp(-H/(ṁ c)).
"""

from typing import Annotated, ClassVar, Literal

import numpy as np

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Rated, VaryingTemperature
from nivel.elements.circuits.density import AROUND, EXPANSION, HEAT_CAPACITY, START
from nivel.elements.circuits.fluids import ROOM
from nivel.elements.circuits.kind import ComponentKind, Phase, called, slopes_of
from nivel.elements.circuits.ledger import WARMTH, lose
from nivel.elements.circuits.restrictions import add_flow, rated, restrict
from nivel.elements.circuits.smooth import magnitude_within
from nivel.elements.circuits.symbol import Symbol, path
from nivel.elements.circuits.volumes import VOLUME, find_pressure, give_pressure
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import NO_VOLUME, OK
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.known import SystemBuilder
from nivel.machine.given import Field
from nivel.machine.laws.time_function import OneFunction, varying

VaryingConductance = Annotated[OneFunction, varying("thermal conductance")]


class Cooler(Rated):
    """A restriction that gives heat of a liquid to air or water of a given temperature."""

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    functions: ClassVar[tuple[str, ...]] = ("heat_conductance", "coolant_temperature")
    late: ClassVar[tuple[str, ...]] = ("flow", "heat")
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("A", "B"), ("B", "A"))

    type: Literal["cooler"] = "cooler"
    heat_conductance: VaryingConductance = Field(
        "heat over the difference of temperature, of coolant and liquid at the same place"
    )
    coolant_temperature: VaryingTemperature = Field(default=ROOM, usual=ranges.TEMPERATURE)


# columns of `columns`: those of `nivel.elements.circuits.volumes`, and the function of a given temperature; outputs: pressure, temperature
OUTPUT, NODE, KIND, STATE, FUNCTION, TEMPERATURE = 0, 1, 2, 3, 4, 5
# column of `number`: H, heat through the walls [W/K]
WALLS = 0
# At rest liquids have the temperature of their start: they go there with this rate [1/s].
CALM = 1.0


@called(Phase.PRESSURES, 0)
@family
def find_warm_pressures(machine, number, t):
    """Pressure, density and temperature of every node of such a liquid; no heat flows into it yet."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    count = circuit.node.shape[0]
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        node, out = index[NODE], index[OUTPUT]
        f = circuit.fluid[circuit.node[node, 0]]
        if index[KIND] == VOLUME:
            theta = elements.state[circuit.node[node, WARMTH]]
            growth = np.exp(f[EXPANSION] * (theta - f[START]))
            if not real(theta) > 0.0:
                record.control.failure[0] = node
                return NO_VOLUME
            status = find_pressure(machine, node, elements.state[index[STATE]] * growth)
            if status != OK:
                return status
        else:
            theta = evaluate_function(machine, index[TEMPERATURE], t)
            growth = np.exp(f[EXPANSION] * (theta - f[START]))
            give_pressure(machine, node, evaluate_function(machine, index[FUNCTION], t))
        circuit.density[node] = circuit.density[node] / growth
        circuit.enthalpy[node] = circuit.enthalpy[node] * growth
        circuit.temperature[node] = theta * (1.0 + f[EXPANSION] / f[HEAT_CAPACITY] * circuit.enthalpy[node])
        circuit.inflow[node], circuit.inflow[count + node] = 0.0, 0.0
        record.outputs.value[out], record.outputs.value[out + 1] = circuit.pressure[node], circuit.temperature[node]
    return OK


@called(Phase.BALANCE, 0)
@element
def warm(machine, index, n, t):
    """Rates of the temperatures of volumes; at rest they go back to that of the start."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    node = index[NODE]
    f, own = circuit.fluid[circuit.node[node, 0]], circuit.node[node, WARMTH]
    mass, expansion = elements.state[index[STATE]], f[EXPANSION] * circuit.enthalpy[node]
    heat = circuit.inflow[node] - n[WALLS] * (circuit.temperature[node] - f[AROUND])
    rate = heat / (mass * (f[HEAT_CAPACITY] + expansion))
    if record.sampled.at_rest[0] == 1:
        rate = CALM * (f[START] - elements.state[own])
    elements.state_rate[own] += rate
    lose(machine, -mass * expansion * rate)


@slopes_of(warm)
@element
def add_slopes(machine, index, n, t):
    """Slopes of the temperatures with themselves; heat is slow beside steps."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    tangent, count = circuit.tangent, circuit.node.shape[0]
    node = index[NODE]
    capacity = circuit.fluid[circuit.node[node, 0], HEAT_CAPACITY]
    own = tangent.unknown[circuit.node[node, WARMTH]]
    falling = circuit.inflow[count + node] + n[WALLS] / capacity
    tangent.slopes[own, own] -= falling / elements.state[index[STATE]]


# columns of `columns`; FLOW: output of the flow through it; functions of H [W/K] and T_c [K]. Output: heat [W]
HEAT, FROM, TO, FLOW, CONDUCTANCE, COOLANT = 0, 1, 2, 3, 4, 5
# mass flow [kg/s] within which its magnitude is rounded
STILL = 1e-6


@called(Phase.FLOWS, 3, slow=True)
@element
def cool(machine, index, n, t):
    """Heat of all coolers, taken from the liquid behind them."""
    record = record_at(machine)
    circuit, value = record.circuit, record.outputs.value
    a, b, flow = index[FROM], index[TO], value[index[FLOW]]
    up, down = (a, b) if real(flow) >= 0.0 else (b, a)
    capacity = circuit.fluid[circuit.node[a, 0], HEAT_CAPACITY]
    mass_flow = 0.5 * (circuit.density[a] + circuit.density[b]) * flow
    rate = capacity * magnitude_within(mass_flow, STILL)
    units = evaluate_function(machine, index[CONDUCTANCE], t) / rate
    heat = rate * (1.0 - np.exp(-units)) * (circuit.temperature[up] - evaluate_function(machine, index[COOLANT], t))
    if circuit.node[down, WARMTH] != NONE:
        circuit.inflow[down] -= heat
    value[index[HEAT]] = heat


def add_cooler(builder: SystemBuilder, component: Cooler) -> None:
    """The flow through a cooler, and the heat that it takes."""
    add_flow(builder, component, "flow", ("A", "B"), rated(component, 0.0))
    flow = len(builder.outputs.entries) - 1
    first = builder.outputs.add((f"hydraulics.{component.name}.heat", "W", f"heat that {component.name} takes"))
    functions = [builder.function(component.heat_conductance), builder.function(component.coolant_temperature)]
    columns = [first, *(builder.node(component.ports[port]) for port in "AB"), flow, *functions]
    builder.elements.add(cool, columns)


# heat leaves on both sides
BODY = path("M0 -14 L14 0 L0 14 L-14 0 Z M0 -20 V20") + path("M-14 0 l6 -4 v8 z M14 0 l-6 -4 v8 z", "full")
COOLER = Symbol(BODY, 14.0, 20.0, {"B": 0.0}, {"A": 0.0})

KINDS = (ComponentKind(Cooler, add_cooler, (restrict, cool), symbol=COOLER),)
