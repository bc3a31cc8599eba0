"""Lines as delays: a wave that leaves one end arrives at the other after T = L/c, and nothing else joins the ends.

    Z Q = p - w        w'(t) = p + Z Q - Δp(Q)        w at the other end = w'(t - T)        Z = ρ c/A

Q flows from the node of an end into the line (method of characteristics, Wylie and Streeter 1993, chapter 3). The friction Δp of the
whole line, of `nivel.elements.circuits.line_friction`, acts where a wave leaves, by the flow there; so a steady flow has the loss of the
line, and parts of the friction that are slower than T follow the frequency.

Samples of w' are states, each with its turn in a ring: sample k stands at place k modulo their number. Between samples w is the cubic
through four of them (Lagrange). Before the first samples w is that of the steady flow at the start.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from nivel.elements.circuits.curves import hose_points
from nivel.elements.circuits.density import VISCOSITY, density_and_modulus
from nivel.elements.circuits.kind import Phase, called, slopes_of
from nivel.elements.circuits.ledger import LOST, SUPPLIED, TAKEN_IN
from nivel.elements.circuits.line_friction import (
    BENDS,
    CRITICAL,
    CRITICAL_REYNOLDS,
    DECAY,
    KINETIC_DENSITY,
    RATES,
    RESISTANCE,
    SMALL,
    UNSTEADY,
    WEIGHTS,
    flow_ratio,
    slope_of_loss,
    steady_loss,
)
from nivel.elements.circuits.nodes import TYPICAL
from nivel.elements.circuits.smooth import magnitude_within
from nivel.elements.circuits.tangent import add_by_pressure
from nivel.elements.facts import StateFact
from nivel.elements.rows import element
from nivel.errors import Fault, ModelError
from nivel.kernels.algebra.analytic import real
from nivel.kernels.record.record import NONE, record_at
from nivel.machine.units.formula import linear
from nivel.native.function import leaf, stage

if TYPE_CHECKING:
    from nivel.elements.circuits.lines import Line
    from nivel.system.builder import SystemBuilder

# columns of `columns`, one row for an end; outputs: flow into the line [m³/s], the wave that leaves [Pa]. BEGAN: state of the wave that
# comes at the start, 0 before; SAMPLES: first of the states of the waves that left the other end
OUTPUT, WAVE, NODE, OTHER, BEGAN, SAMPLES, COUNT, FIRST_PART, PARTS = range(9)
# columns of `number` beyond those of `nivel.elements.circuits.line_friction`: Z [Pa s/m³], T, time between samples [s]
IMPEDANCE, DELAY, PERIOD = 8, 9, 10
MOST_SAMPLES = 1000
STEADY_ITERATIONS = 20


@leaf
def steady_flow(n, density, difference):
    """Q at a difference of pressure, by Newton's method on its real part."""
    q = flow_ratio(real(difference) / (n[RESISTANCE] * density * n[CRITICAL])) * n[CRITICAL]
    for _ in range(STEADY_ITERATIONS):
        slope = density * (slope_of_loss(n, 1.0, q) + 2.0 * n[BENDS] * magnitude_within(q, n[SMALL]))
        q -= (steady_loss(n, 1.0, density, q) - real(difference)) / slope
    slope = density * (slope_of_loss(n, 1.0, q) + 2.0 * n[BENDS] * magnitude_within(q, n[SMALL]))
    return q + (difference - steady_loss(n, 1.0, density, q)) / slope


@stage
def sampled_wave(machine, index, n, k):
    """Sample k of the other end; before the first one the wave at the start."""
    state = record_at(machine).elements.state
    if k < 0:
        return state[index[BEGAN]]
    return state[np.int64(index[SAMPLES]) + k % np.int64(index[COUNT])]


@stage
def wave_that_comes(machine, index, n, t):
    """w'(t - T) of the other end [Pa]."""
    at = (t - n[DELAY]) / n[PERIOD]
    k = np.int64(np.floor(real(at) + 1e-9))
    s = at - k
    before, here = sampled_wave(machine, index, n, k - 1), sampled_wave(machine, index, n, k)
    after, last = sampled_wave(machine, index, n, k + 1), sampled_wave(machine, index, n, k + 2)
    out = here * (1.0 - s * s) * (2.0 - s) / 2.0 + after * s * (1.0 + s) * (2.0 - s) / 2.0
    return out - before * s * (1.0 - s) * (2.0 - s) / 6.0 - last * s * (1.0 - s) * (1.0 + s) / 6.0


@called(Phase.FLOWS, 11)
@element
def pass_waves(machine, index, n, t):
    """Flows into lines, the waves that leave them, and what their friction remembers.

    What a line holds is in no volume: the ledger counts its mass and its energy as those of a tank.
    """
    record = record_at(machine)
    elements, circuit, rate = record.elements, record.circuit, record.elements.state_rate
    node, density = index[NODE], n[KINETIC_DENSITY]
    p = circuit.pressure[node]
    if record.sampled.at_rest[0] == 1 or real(elements.state[index[BEGAN]]) == 0.0:
        flow = steady_flow(n, density, p - circuit.pressure[index[OTHER]])
    else:
        flow = (p - wave_that_comes(machine, index, n, t)) / n[IMPEDANCE]
    total = 0.0 * flow
    for i in range(index[PARTS]):
        own = index[FIRST_PART] + i
        part = elements.state[own] + WEIGHTS[i] * flow
        total += part
        rate[own] -= RATES[i] * n[DECAY] * part
    friction = steady_loss(n, 1.0, density, flow) + n[UNSTEADY] * density * total
    leaving = p + n[IMPEDANCE] * flow
    record.outputs.value[index[OUTPUT]] = flow
    record.outputs.value[index[WAVE]] = leaving - friction
    mass_flow, lost = density * flow, friction * (2.0 * leaving - friction) / (4.0 * n[IMPEDANCE])
    if circuit.node[node, 1] != NONE:
        rate[circuit.node[node, 1]] -= mass_flow
        circuit.power[TAKEN_IN] -= mass_flow
        taken = mass_flow * circuit.enthalpy[node]
        circuit.power[SUPPLIED] += lost - taken
        record.control.power[0] += lost - taken
    else:
        circuit.power[SUPPLIED] += lost
        record.control.power[0] += lost
    circuit.power[LOST] += lost
    record.control.power[1] += lost


@slopes_of(pass_waves)
@element
def add_slopes(machine, index, n, t):
    """Slopes of the flows at the ends with the pressure there, and of what their friction remembers."""
    record = record_at(machine)
    circuit = record.circuit
    tangent, node = circuit.tangent, index[NODE]
    if circuit.node[node, 1] != NONE:
        row = tangent.slopes[tangent.unknown[circuit.node[node, 1]]]
        add_by_pressure(circuit, row, node, -n[KINETIC_DENSITY] / n[IMPEDANCE])
    for i in range(index[PARTS]):
        part = tangent.unknown[index[FIRST_PART] + i]
        decay = RATES[i] * n[DECAY]
        tangent.slopes[part, part] -= decay
        add_by_pressure(circuit, tangent.slopes[part], node, -decay * WEIGHTS[i] / n[IMPEDANCE])


def add_delay(builder: SystemBuilder, component: Line) -> None:
    """Both ends, with the samples of the waves that leave them.

    Raises ModelError where waves pass in less than two samples, or need too many, and where friction is more than a wave.
    """
    name, ends, period = component.name, (component.ports["A"], component.ports["B"]), component.sample_time
    fluid = builder.circuit.fluids[builder.circuit.fluid[name]]
    density, modulus = density_and_modulus(fluid, component.mean_pressure)
    d, length, viscosity = component.diameter, component.length, fluid[VISCOSITY]
    area = 0.25 * math.pi * d**2
    soft = 1.0 / modulus + (1.0 / component.wall_modulus if component.wall_modulus else 0.0)
    if component.expansion is not None:
        _, *points = hose_points(component.expansion, 1.0)
        p, volume = np.array([0.0, *points[::2]]), np.array([0.0, *points[1::2]])
        k = min(int(np.searchsorted(p, component.mean_pressure)), len(p) - 1)
        soft += (volume[k] - volume[k - 1]) / (p[k] - p[k - 1]) / area
    speed = math.sqrt(1.0 / (density * soft))
    delay, slowness = length / speed, 4.0 * viscosity / d**2
    count = math.ceil(delay / period) + 4
    _refuse(name, delay, period, count, 8.0 * slowness * delay)
    critical = CRITICAL_REYNOLDS * viscosity * area / d
    terms = sum(each * slowness * delay < 1.0 for each in RATES) if component.unsteady_friction else 0
    numbers = [128.0 * viscosity * length / (math.pi * d**4), critical, area / length, density]
    numbers += [0.5 * component.bends / area**2, 16.0 * viscosity * length / (d**2 * area), slowness, 1e-3 * critical]
    numbers += [density * speed / area, delay, period]
    rows, samples, began = [], [], []
    for side in "AB":
        output = builder.outputs.add(
            (f"hydraulics.{name}.flow_{side}", "m^3/s", f"flow at {side} into {name}"),
            (f"hydraulics.{name}.wave_{side}", "Pa", f"wave that leaves {name} at {side}"),
        )
        words = f"friction at {side} of {name}"
        facts = [StateFact(f"{name}.friction_{side}_{i + 1}", "m^3/s", words, 0.0, critical) for i in range(terms)]
        parts = [builder.own_state(fact) for fact in facts]
        rows.append((output, parts[0] if parts else 0))
        with builder.noting():  # what was sampled waits for nothing
            began.append(
                builder.own_state(_sample(f"{name}.began_{side}", f"wave at the start that left {name} at {side}"))
            )
            words = f"sample of the wave that left {name} at {side}"
            samples.append([builder.own_state(_sample(f"{name}.sample_{side}_{k + 1}", words)) for k in range(count)])
            wave = linear((1.0, f"{name}.wave_{side}"))
            builder.samples.append((began[-1], wave, None, 0.0))
            builder.samples += [(state, wave, count * period, k * period) for k, state in enumerate(samples[-1])]
    for (output, part), other, own in zip(rows, (1, 0), (0, 1), strict=True):
        nodes = [builder.node(ends[own]), builder.node(ends[other])]
        columns = [output, output + 1, *nodes, began[other], samples[other][0], count, part, terms]
        builder.elements.add(pass_waves, columns, numbers)


def _sample(name: str, words: str) -> StateFact:
    return StateFact(name, "Pa", words, 0.0, TYPICAL, sampled=True)


def _refuse(name: str, delay: float, period: float, count: int, damping: float) -> None:
    """What a delay cannot be."""
    if delay < 2.0 * period:
        told = f"waves pass it in {delay:.3g} s: at least two samples; write `sample_time: {0.5 * delay:.2g}` or less"
    elif count > MOST_SAMPLES:
        told = f"{count} samples would wait, up to {MOST_SAMPLES} are kept; write `sample_time: {delay / MOST_SAMPLES * 1.1:.2g}`"
    elif damping > 1.0:
        told = f"friction takes {damping:.2g} of a wave, which a delay does not follow; write `model: segments`"
    else:
        return
    raise ModelError([Fault.at(f"hydraulics.{name}", told)])
