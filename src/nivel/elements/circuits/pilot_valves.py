"""Valves in two stages: pilot-operated relief and reducing valves, and cartridges."""

from typing import ClassVar, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Rated
from nivel.elements.circuits.composed import INNER_VOLUME, OF_POPPETS, add_opened
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.nodes import inner_nodes
from nivel.elements.circuits.restrictions import add_flow
from nivel.elements.circuits.symbol import BAR, Symbol, path, square
from nivel.known import SystemBuilder, TimeFunction
from nivel.machine.core.coefficient import Leakage, Pressure, Share, VolumeFlow
from nivel.machine.given import Field


class _Piloted(Rated):
    """What pilot-operated valves share: a main poppet or spool, moved by the drop over an orifice to its spring chamber X."""

    nodes: ClassVar[tuple[str, ...]] = (".X",)
    early: ClassVar[tuple[str, ...]] = ("pressure_X",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position", "orifice_flow", "pilot_flow", "pilot_position")

    pilot_flow: VolumeFlow = Field(
        "of the orifice at `pilot_pressure_drop`; that of the open pilot is twice it", default=2e-3 / 60.0
    )
    pilot_pressure_drop: ranges.Drop = Field(default=5e5)
    pilot_range: ranges.Drop = Field("over which the pilot opens wholly", default=3e5)
    spring: ranges.LeastDrop = Field("difference of pressure at which the main stage begins to move", default=2e5)
    opening_range: Pressure = Field("from there to the other end of its stroke", default=3e5)
    lag: ranges.Lag = Field("time constant of the main stage; 0: none", default=0.005)
    leakage: Leakage = Field(default=0.0)
    inner_volume: ranges.Size = Field("of the spring chamber", default=INNER_VOLUME)

    @property
    def pilot_conductance(self) -> float:
        """K [m³/s/√Pa] of the orifice to the spring chamber."""
        return self.pilot_flow / self.pilot_pressure_drop**0.5


class PilotReliefValve(_Piloted):
    """A relief valve in two stages: a pilot drains the chamber X above `opens_at`, and the main poppet opens by the drop to X.

    A valve from NAME.X to a tank unloads it; a relief valve there sets a lower pressure from afar.
    """

    needs: ClassVar[tuple[str, ...]] = ("P", "T")
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    relieves: ClassVar[str] = "P"

    type: Literal["pilot-relief-valve"] = "pilot-relief-valve"
    opens_at: ranges.VaryingLevel = Field("difference of pressure of X and T at which the pilot opens")


class PilotReducingValve(_Piloted):
    """A reducing valve in two stages: a pilot drains the chamber X to T above `pressure`, and the main spool closes from P to A by the
    drop from A to X."""

    needs: ClassVar[tuple[str, ...]] = ("P", "A", "T")
    functions: ClassVar[tuple[str, ...]] = ("pressure",)

    type: Literal["pilot-reducing-valve"] = "pilot-reducing-valve"
    pressure: ranges.VaryingLevel = Field("difference of pressure of X and T at which the pilot opens")


class CartridgeValve(Rated):
    """A two-way cartridge (logic element): opens between A and B as p_A a + p_B (1 - a) exceeds p_X by `opens_at`, a = `area_share`."""

    needs: ClassVar[tuple[str, ...]] = ("A", "B", "X")
    late: ClassVar[tuple[str, ...]] = ("flow", "position")
    passes: ClassVar[tuple[tuple[str, str], ...]] = ()

    type: Literal["cartridge-valve"] = "cartridge-valve"
    area_share: Share = Field("area of A over that of X; 1: B does not act", default=0.5)
    opens_at: ranges.LeastDrop = Field("of its spring, on the area of X", default=2e5)
    opening_range: ranges.Drop = Field("from there to fully open", default=3e5)
    lag: ranges.Lag = Field("time constant of the opening; 0: none", default=0.0)
    leakage: Leakage = Field(default=0.0)


def add_pilot_relief(builder: SystemBuilder, component: PilotReliefValve) -> None:
    """An orifice from P to X, a pilot from X to T, and the main poppet that p_P - p_X lifts."""
    add_opened(builder, component, "flow", ("P", "T"), {"P": 1.0, ".X": -1.0}, component.spring)
    _add_pilot(builder, component, "P", component.opens_at)


def add_pilot_reducing(builder: SystemBuilder, component: PilotReducingValve) -> None:
    """An orifice from A to X, a pilot from X to T, and the main spool that p_A - p_X closes."""
    spring = component.spring + component.opening_range
    add_opened(builder, component, "flow", ("P", "A"), {"A": -1.0, ".X": 1.0}, spring, 1.0)
    _add_pilot(builder, component, "A", component.pressure)


def _add_pilot(builder: SystemBuilder, component: _Piloted, before: str, setting: TimeFunction) -> None:
    """before : the port before its orifice."""
    size, corner = component.pilot_conductance, component.transition
    add_flow(builder, component, "orifice_flow", (before, ".X"), [size, corner, 0.0])
    how = {"numbers": [2.0 * size, corner, 0.0], "span": component.pilot_range, "lag": 0.0}
    add_opened(builder, component, "pilot_flow", (".X", "T"), {".X": 1.0, "T": -1.0}, setting, **how)


def add_cartridge(builder: SystemBuilder, component: CartridgeValve) -> None:
    """p_A and p_B on their shares of the area of X against p_X and the spring."""
    factors = {"A": component.area_share, "B": 1.0 - component.area_share, "X": -1.0}
    add_opened(builder, component, "flow", ("A", "B"), factors, component.opens_at)


PILOT = path("M16 -9 l9 4 l-9 4 z", "full") + path("M0 -17 H-18 V0 H-12 M26 0 H34 V-20", "dashed")
PILOT_RELIEF = Symbol(
    square(False, False) + PILOT, 34.0, 20.0, {"P": 0.0, "X": 34.0}, {"T": 0.0}, "relief",
    key="opens_at", unit=BAR, arrow=(13, 9, 27, -10),
)  # fmt: skip

PILOT_REDUCING = Symbol(
    square(True, True, drained=True) + PILOT, 34.0, 20.0, {"A": 0.0, "X": 34.0}, {"P": 0.0, "T": 20.0},
    key="pressure", unit=BAR,
)  # fmt: skip

# A below, B beside, X above its spring
CONE = path("M-14 -16 H14 V16 H-14 Z M-8 -6 H8 V4 L3 11 H-3 L-8 4 Z M0 16 V22 M14 8 H24 V-22")
PRESSED = path("M-4 -6 l8 -2 l-8 -3 l8 -2 l-4 -3") + path("M-8 -22 V-16", "dashed")
CARTRIDGE = Symbol(CONE + PRESSED, 24.0, 22.0, {"X": -8.0, "B": 24.0}, {"A": 0.0}, key="opens_at", unit=BAR)

KINDS = (
    ComponentKind(PilotReliefValve, add_pilot_relief, OF_POPPETS, symbol=PILOT_RELIEF, nodes=inner_nodes("X")),
    ComponentKind(PilotReducingValve, add_pilot_reducing, OF_POPPETS, symbol=PILOT_REDUCING, nodes=inner_nodes("X")),
    ComponentKind(CartridgeValve, add_cartridge, OF_POPPETS, symbol=CARTRIDGE),
)
