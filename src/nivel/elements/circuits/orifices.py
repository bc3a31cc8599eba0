"""Orifices: restrictions between two nodes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Component, Rating, problem_of_share
from nivel.elements.circuits.gases import GAS_CONSTANT, RATIO, REFERENCE
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.restrictions import FIXED, GIVEN, add_flow, rated, restrict
from nivel.elements.circuits.symbol import Symbol, path
from nivel.known import Node, SystemBuilder
from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import Leakage, Share
from nivel.machine.given import Field, Maybe
from nivel.machine.laws.time_function import OneFunction, varying

Opening = Annotated[OneFunction, varying("number")]


class Orifice(Rating, Component):
    """A restriction between two nodes: by its diameter, by a flow at a difference of pressure, or a leak alone."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    functions: ClassVar[tuple[str, ...]] = ("opening",)
    late: ClassVar[tuple[str, ...]] = ("flow",)
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("A", "B"), ("B", "A"))

    type: Literal["orifice"] = "orifice"
    diameter: Maybe[ranges.Bore] = Field(default=None)
    discharge_coefficient: Share = Field(default=0.65)
    leakage: Leakage = Field(default=0.0, description="flow over the difference of pressure, laminar")
    opening: Opening = Field(default=1.0, description="from 0, closed, to 1")
    transition: ranges.Drop = Field(default=0.5e5, description="difference of pressure below which the root is rounded")

    def problems(self) -> Iterator[Problem]:
        yield from Component.problems(self)
        yield from problem_of_share("opening", self.opening, 0.0)
        given = [name for name in ("flow", "pressure_drop", "sonic_conductance") if getattr(self, name) is not None]
        if given:
            yield from self.problems_of_rating()
        if self.diameter is not None and given:
            yield superfluous(given[0], "stands in place of `diameter`; give one of them")
        if self.diameter is None and not given and not self.leakage:
            yield Problem(
                (),
                "`diameter`, `flow` and `pressure_drop`, of gases `sonic_conductance`, or `leakage` is needed: what lets the fluid through",
            )


def add_orifice(builder: SystemBuilder, component: Orifice) -> None:
    """A restriction, fixed or with an opening that varies."""
    ends = component.ports["A"], component.ports["B"]
    numbers = rated(component, component.leakage)
    if component.diameter is not None:
        area = 0.25 * math.pi * component.diameter**2 * component.discharge_coefficient
        fluid = builder.circuit.fluids[flowing(builder, ends).fluid]
        numbers[:2] = (
            _nozzle(area, fluid)
            if flowing(builder, ends).gas
            else (area * math.sqrt(2.0 / fluid[4]), component.transition)
        )
    opening = (FIXED, 0)
    if component.opening != 1.0:
        opening = (GIVEN, builder.function(component.opening))
    add_flow(builder, component.name, "flow", ends, numbers, opening)


def _nozzle(area: float, gas: tuple[float, ...]) -> tuple[float, float]:
    """(C [m³/s/Pa], b) of a gas that expands without loss into an area [m²]: the sonic flow (Saint-Venant and Wantzel 1839)."""
    ratio = gas[RATIO]
    critical = (2.0 / (ratio + 1.0)) ** (ratio / (ratio - 1.0))
    sonic = math.sqrt(ratio / gas[GAS_CONSTANT]) * (2.0 / (ratio + 1.0)) ** (0.5 * (ratio + 1.0) / (ratio - 1.0))
    return area * sonic / gas[REFERENCE], critical


def flowing(builder: SystemBuilder, ends: tuple[str, str]) -> Node:
    return builder.circuit.nodes[ends[0]]


BODY = path("M0 -16 V16 M-8 -8 Q-1 0 -8 8 M8 -8 Q1 0 8 8")
ORIFICE = Symbol(BODY, 13.0, 16.0, {"B": 0.0}, {"A": 0.0}, key="opening", arrow=(-13, 12, 13, -12))

KINDS = (ComponentKind(Orifice, add_orifice, (restrict,), symbol=ORIFICE),)
