"""Volumes, tanks and reservoirs.

The node of a reservoir is a volume whose room is the air above the liquid (`nivel.elements.circuits.volumes`): closed in, it is the gas of
an accumulator; that of an open one gives way to the liquid at atmospheric pressure.
"""

from collections.abc import Iterator
from typing import ClassVar, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Component, VaryingTemperature
from nivel.elements.circuits.curves import VolumeExpansion, hose_points
from nivel.elements.circuits.density import HEAT_CAPACITY, START
from nivel.elements.circuits.fluids import ATMOSPHERE
from nivel.elements.circuits.kind import ComponentKind, Phase, called
from nivel.elements.circuits.nodes import (
    NO_ACCUMULATOR,
    RIGID,
    Node,
    gas_of,
    growth_of_walls,
    is_warm,
    pressure_output,
    volume_node,
)
from nivel.elements.circuits.symbol import Symbol, circle, path
from nivel.elements.circuits.volumes import GIVEN
from nivel.elements.facts import Coupled
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.known import Swept, SystemBuilder
from nivel.machine.core.coefficient import Area, Exponent, ThermalConductance, Truth
from nivel.machine.core.record import Name, Problem, superfluous
from nivel.machine.given import Field, Maybe, OneRecord
from nivel.machine.units.quantity import PositiveLength


class Volume(Component):
    """A volume of fluid at one pressure: a line, a hose, a block. What is connected to it meets there."""

    nodes: ClassVar[tuple[str, ...]] = ("",)
    early: ClassVar[tuple[str, ...]] = ("pressure",)
    gases: ClassVar[bool] = True

    type: Literal["volume"] = "volume"
    volume: ranges.Size = Field(default=2e-4)
    wall_modulus: Maybe[ranges.WallModulus] = Field(
        "pressure over the relative growth of the volume; default: rigid walls", default=None
    )
    expansion: Maybe[OneRecord[VolumeExpansion]] = Field(
        "growth of the volume over the pressure, of a hose, in place of `wall_modulus`", default=None
    )
    heat_conductance: Maybe[ThermalConductance] = Field(
        "of gases, and of liquids that are not isothermal: heat through walls over the difference of temperature",
        default=None,
    )
    heat_transfer: Maybe[ranges.WallTransfer] = Field(
        "of gases: heat over a `surface` and the difference of temperature; not with `heat_conductance`", default=None
    )
    surface: Maybe[Area] = Field("of its walls, with `heat_transfer`", default=None, usual=ranges.SURFACE)
    start: Maybe[ranges.Level] = Field("pressure at the start; default: that of a steady circuit", default=None)
    fluid: Name | None = Field("default: the only one", default=None)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.surface is None and self.heat_transfer is not None:
            yield Problem((), "`surface` is missing: the area of the walls that `heat_transfer` is of")
        if self.surface is not None and self.heat_transfer is None:
            yield superfluous("surface", "belongs to a `heat_transfer`, and none is given")
        if self.heat_transfer is not None and self.heat_conductance is not None:
            yield superfluous("heat_conductance", "is `heat_transfer` times `surface`; give one of them")
        if self.expansion is not None and self.wall_modulus is not None:
            yield superfluous("wall_modulus", "is of walls that grow evenly; `expansion` is a curve; give one of them")


class Tank(Component):
    """A node of given pressure: a tank, or a supply that holds its pressure whatever flows, and its temperature."""

    nodes: ClassVar[tuple[str, ...]] = ("",)
    functions: ClassVar[tuple[str, ...]] = ("pressure", "temperature")
    early: ClassVar[tuple[str, ...]] = ("pressure",)
    gases: ClassVar[bool] = True

    type: Literal["tank"] = "tank"
    pressure: ranges.VaryingLevel = Field("absolute", default=ATMOSPHERE)
    temperature: Maybe[VaryingTemperature] = Field(
        "of a liquid that is not isothermal; default: that of the fluid", default=None, usual=ranges.TEMPERATURE
    )
    fluid: Name | None = Field("default: the only one", default=None)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if isinstance(self.pressure, float | int) and self.pressure <= 0.0:
            told = f"pressures are absolute: one greater than zero was expected, got {self.pressure:g} Pa"
            yield Problem(("pressure",), f"{told}; the air has 1.01325 bar")


class Reservoir(Component):
    """A tank of liquid with a level, below air that is open to the atmosphere or closed in."""

    nodes: ClassVar[tuple[str, ...]] = ("",)
    early: ClassVar[tuple[str, ...]] = ("pressure", "level", "oil", "temperature")

    type: Literal["reservoir"] = "reservoir"
    volume: ranges.Size = Field("of liquid and air")
    oil: ranges.Size = Field("volume of the liquid at the start")
    height: Maybe[PositiveLength] = Field(
        "of the tank, whose walls are upright; default: that of a cube", default=None, usual=ranges.TANK_HEIGHT
    )
    closed: Truth = Field("whether its air is closed in; else it comes and goes", default=False)
    start: Maybe[ranges.Level] = Field(
        "pressure of the air at the start, absolute; default: that of the atmosphere", default=None
    )
    gas_exponent: Maybe[Exponent] = Field("polytropic exponent of air that is closed in; default 1", default=None)
    heat_conductance: Maybe[ThermalConductance] = Field("as of a volume", default=None)
    fluid: Name | None = Field("default: the only one", default=None)

    @property
    def pressure(self) -> float:
        """[Pa] of the air at the start."""
        return self.start or ATMOSPHERE

    @property
    def area(self) -> float:
        """[m²] of the surface of the liquid."""
        return self.volume / (self.height or self.volume ** (1.0 / 3.0))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not self.oil < self.volume:
            told = f"less than the `volume` of {self.volume:g} m^3 was expected, got {self.oil:g} m^3"
            yield Problem(("oil",), f"{told}; above the liquid is air")
        if not self.closed:
            for name in ("start", "gas_exponent"):
                if getattr(self, name) is not None:
                    yield superfluous(name, "belongs to air that is closed in; write `closed: true` too")


# columns of `columns`; STATE: of the mass; output of the temperature. Outputs: level [m], volume of the liquid [m³]
LEVEL, NODE, STATE, TEMPERATURE = 0, 1, 2, 3
# column of `number`: area of its surface [m²]
SURFACE = 0


@called(Phase.PRESSURES, 3, slow=True)
@family
def find_levels(machine, number, t):
    """Level and volume of the liquid in each."""
    record = record_at(machine)
    elements, circuit, value = record.elements, record.circuit, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        f = circuit.fluid[circuit.node[index[NODE], 0]]
        volume = elements.state[index[STATE]] / circuit.density[index[NODE]]
        if f[HEAT_CAPACITY] == 0.0:
            value[index[TEMPERATURE]] = f[START] + 0.0 * volume
        value[index[LEVEL]], value[index[LEVEL] + 1] = volume / elements.number[k, SURFACE], volume
    return OK


# share of a closed reservoir that oil fills in any case; pressure by which the air of an open one gives way [Pa]
LEAST_OIL, OPEN = 1e-3, 1e-3


def volume_nodes(builder: SystemBuilder, component: Volume, swept: Swept) -> Iterator[Node]:
    """The node that a volume is."""
    compliance = growth_of_walls(component.volume, component.wall_modulus)
    room = (component.volume, compliance, *NO_ACCUMULATOR, *hose_points(component.expansion, 1.0))
    walls = (component.heat_transfer or 0.0) * (component.surface or 0.0)
    yield volume_node(builder, component, component.name, "", room, component.start, swept, (walls, 0.0))


def tank_nodes(builder: SystemBuilder, component: Tank, _: Swept) -> Iterator[Node]:
    """A node of given pressure."""
    fluid, name = builder.circuit.fluid[component.name], component.name
    gas = gas_of(builder, fluid) is not None
    output = pressure_output(builder, name, "pressure", "temperature" if gas or is_warm(builder, fluid) else "")
    yield Node(name, GIVEN, fluid, NONE, RIGID, 0.0, None, name, output, gas)


def reservoir_nodes(builder: SystemBuilder, component: Reservoir, swept: Swept) -> Iterator[Node]:
    """The liquid of a reservoir. Its room is the air: closed in, the gas of an accumulator that would be empty at `pressure`; that of an
    open one gives way within OPEN of the pressure."""
    air = component.volume - component.oil
    if component.closed:
        exponent, gas = component.gas_exponent or 1.0, (1.0 - LEAST_OIL) * component.volume
        room = (component.volume - gas, 0.0, gas, component.pressure * (air / gas) ** exponent, exponent)
    else:
        room = (component.oil, component.volume / OPEN, *NO_ACCUMULATOR)
    yield volume_node(builder, component, component.name, "", room, component.pressure, swept, warmer=True)


def add_reservoir(builder: SystemBuilder, component: Reservoir) -> None:
    """Level and volume of a reservoir, which are known with the pressures."""
    name, node = component.name, builder.circuit.nodes[component.name]
    first = builder.outputs.add(
        (f"hydraulics.{name}.level", "m", f"level of {name}"),
        (f"hydraulics.{name}.oil", "m^3", f"volume of the liquid in {name}"),
    )
    columns = [first, builder.circuit.index(name), node.state, node.output + 1]
    builder.elements.add(find_levels, columns, [component.area])
    known = builder.circuit.depends.setdefault(name, Coupled(frozenset(), node.states))
    for k, quantity in enumerate(("level", "oil")):
        builder.circuit.signals[f"{name}.{quantity}"] = (first + k, known)
    builder.circuit.signals[f"{name}.temperature"] = (node.output + 1, known)


BODY = circle(12.0) + path("M0 -12 l-6 10 h12 z", "full") + path("M0 -12 V-18")
SOURCE = Symbol(BODY, 12.0, 18.0, {"P": 0.0}, {}, "supply")

KINDS = (
    ComponentKind(Volume, None, (), nodes=volume_nodes),
    ComponentKind(Tank, None, (), symbol=SOURCE, nodes=tank_nodes),
    ComponentKind(Reservoir, None, (find_levels,), nodes=reservoir_nodes, present=add_reservoir),
)
