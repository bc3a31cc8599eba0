"""Suction of ejectors: a flow of gas that a jet draws from a low pressure to a higher one, by the points of a catalogue.

    ṁ = ρ_N Q(p_R - p_A) S((p_P - p_R)/Δp)        S = 3 t² - 2 t³

Q is linear between its points and zero beyond the last, the greatest vacuum. The jet itself is a restriction from P to R.
"""

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Component
from nivel.elements.circuits.gases import REFERENCE
from nivel.elements.circuits.kind import ComponentKind, Phase, called
from nivel.elements.circuits.ledger import lose, transfer
from nivel.elements.circuits.restrictions import REFERENCE_ROOT, add_flow, carry_heat, restrict
from nivel.elements.circuits.smooth import step
from nivel.elements.circuits.symbol import Symbol, path
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real
from nivel.kernels.record.record import record_at
from nivel.known import SystemBuilder
from nivel.machine.core.coefficient import NotNegativePressure, Share, SonicConductance
from nivel.machine.core.record import Problem
from nivel.machine.given import Field, ManyNumbers, Maybe, OneNumber
from nivel.machine.units.quantity import Quantity, listed
from nivel.native.function import leaf

MOST_OF_EJECTOR = 5  # of the characteristic of an ejector


class Ejector(Component):
    """A jet from P to R draws gas from A: a vacuum generator, by the points of its catalogue."""

    gases: ClassVar[bool] = True
    liquids: ClassVar[bool] = False
    needs: ClassVar[tuple[str, ...]] = ("P", "A", "R")
    late: ClassVar[tuple[str, ...]] = ("flow", "suction_flow")

    type: Literal["ejector"] = "ejector"
    sonic_conductance: SonicConductance = Field("of its jet: C of ISO 6358", usual=ranges.CONDUCTANCE)
    critical_ratio: Maybe[Share] = Field("of its jet: b of ISO 6358; default 0.5", default=None)
    vacuums: Annotated[ManyNumbers[NotNegativePressure], BeforeValidator(listed)] = Field(
        "p_R - p_A of the points, which rise; the last one is the greatest vacuum", usual=ranges.DIFFERENCE
    )
    suction_flows: Annotated[ManyNumbers[Annotated[OneNumber, Quantity("volume flow")]], BeforeValidator(listed)] = (
        Field("at these, at 20 °C and 1 bar; the last one is 0", usual=ranges.FLOW)
    )
    drive: ranges.Drop = Field("p_P - p_R from which on it draws with its whole flow", default=3e5)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if len(self.vacuums) != len(self.suction_flows) or not 2 <= len(self.vacuums) <= MOST_OF_EJECTOR:
            message = (
                f"2 to {MOST_OF_EJECTOR} points were expected, as many flows as vacuums, got {len(self.suction_flows)}"
            )
            yield Problem(("suction_flows",), f"{message} and {len(self.vacuums)}")
            return
        if any(b <= a for a, b in pairwise(self.vacuums)):
            yield Problem(("vacuums",), "vacuums that rise were expected")
        if self.suction_flows[-1] != 0.0 or any(b > a or a <= 0.0 for a, b in pairwise(self.suction_flows)):
            yield Problem(("suction_flows",), "flows that fall to 0 at the greatest vacuum were expected")


# columns of `columns`; output: flow at the reference of ISO 8778 [m³/s]
OUTPUT, INLET, SUCTION, EXHAUST = 0, 1, 2, 3
# columns of `number`: Δp [Pa], number of points, then MOST_POINTS pairs: vacuum [Pa], flow [m³/s]
DRIVE, POINTS, FIRST_POINT, MOST_POINTS = 0, 1, 2, 5


@leaf
def suction(n, vacuum):
    """Q [m³/s] at a vacuum [Pa], that at none where the pressure is higher than outside."""
    count = int(n[POINTS])
    if real(vacuum) <= n[FIRST_POINT]:
        return 0.0 * vacuum + n[FIRST_POINT + 1]
    for k in range(count - 1):
        place = FIRST_POINT + 2 * k
        if real(vacuum) < n[place + 2]:
            return n[place + 1] + (vacuum - n[place]) * ((n[place + 3] - n[place + 1]) / (n[place + 2] - n[place]))
    return 0.0 * vacuum


@called(Phase.FLOWS, 11)
@element
def draw(machine, index, n, t):
    """Suction of all ejectors."""
    record = record_at(machine)
    circuit = record.circuit
    a, b = index[SUCTION], index[EXHAUST]
    f = circuit.fluid[circuit.node[a, 0]]
    driven = step((circuit.pressure[index[INLET]] - circuit.pressure[b]) * (1.0 / n[DRIVE]))
    flow = suction(n, circuit.pressure[b] - circuit.pressure[a]) * driven
    mass_flow = flow * f[REFERENCE] / REFERENCE_ROOT
    lose(machine, transfer(machine, a, b, mass_flow) - carry_heat(machine, a, b, mass_flow))
    record.outputs.value[index[OUTPUT]] = flow


JET_RATIO = 0.5  # b of jets that do not say


def add_ejector(builder: SystemBuilder, component: Ejector) -> None:
    """The jet, and what it draws."""
    ports, name = component.ports, component.name
    ratio = JET_RATIO if component.critical_ratio is None else component.critical_ratio
    add_flow(builder, component, "flow", ("P", "R"), [component.sonic_conductance, ratio, 0.0])
    first = builder.outputs.add((f"hydraulics.{name}.suction_flow", "m^3/s", f"suction flow of {name}"))
    columns = [first, *(builder.node(ports[port]) for port in ("P", "A", "R"))]
    points = [number for pair in zip(component.vacuums, component.suction_flows, strict=True) for number in pair]
    builder.elements.add(draw, columns, [component.drive, float(len(component.vacuums)), *points])


# a jet that draws from A
JET = path("M-18 -6 L-4 -2 V2 L-18 6 M4 -3 L18 -6 M4 3 L18 6") + path("M-2 -3 L6 0 L-2 3 z")
BODY = path("M-24 -10 H24 V10 H-24 Z M-24 0 H-34 V18 M24 0 H34 V18 M0 -10 V-18") + JET
EJECTOR = Symbol(BODY, 34.0, 18.0, {"A": 0.0}, {"P": -34.0, "R": 34.0})

KINDS = (ComponentKind(Ejector, add_ejector, (restrict, draw), symbol=EJECTOR),)
