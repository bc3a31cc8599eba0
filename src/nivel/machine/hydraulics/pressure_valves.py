"""Valves that bound, switch or hold pressures, in words: unloading, sequence, pilot-operated, cartridge, cross-port and brake valves."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, ClassVar, Literal

from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import (
    Leakage,
    NotNegativeDuration,
    NotNegativePressure,
    Pressure,
    Share,
    Truth,
    Volume,
    VolumeFlow,
)
from nivel.machine.core.record import entry
from nivel.machine.given import Field, Maybe
from nivel.machine.hydraulics.component import Rated
from nivel.machine.hydraulics.flow_valves import INNER_VOLUME
from nivel.machine.hydraulics.usual import DIFFERENCE, FLOW, LAG, PRESSURE, VOLUME
from nivel.machine.hydraulics.valves import VaryingPressure

CHECK_OPENS_AT, CHECK_RANGE = 0.5e5, 3e5  # Pa, of check valves within other valves


class UnloadingValve(Rated):
    """Opens from P to T where P is more than `opens_at` above LS, or where a pilot X is above it."""

    needs: ClassVar[tuple[str, ...]] = ("P", "T")
    may: ClassVar[tuple[str, ...]] = ("LS", "X")
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position")
    relieves: ClassVar[str] = "P"

    type: Literal["unloading-valve"] = "unloading-valve"
    opens_at: VaryingPressure = Field(
        description="with LS: difference of P and LS; with X: that of X and the air", usual=PRESSURE
    )
    opening_range: Pressure = Field(default=3e5, description="from there to fully open", usual=DIFFERENCE)
    lag: NotNegativeDuration = Field(default=0.01, description="time constant of the opening; 0: none", usual=LAG)
    leakage: Leakage = Field(default=0.0)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if ("LS" in self.ports) == ("X" in self.ports):
            got = "got both" if "X" in self.ports else "got neither"
            yield Problem((), f"an unloading valve has a port LS, which it stands above, or a pilot X; {got}")


class SequenceValve(Rated):
    """Opens from P to A where P is more than `opens_at` above its spring chamber, which drains to T, or to the air without one."""

    needs: ClassVar[tuple[str, ...]] = ("P", "A")
    may: ClassVar[tuple[str, ...]] = ("T",)
    sensing: ClassVar[tuple[str, ...]] = ("T",)
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position", "check_flow")

    type: Literal["sequence-valve"] = "sequence-valve"
    opens_at: VaryingPressure = Field(description="pressure of P above that of the drain", usual=PRESSURE)
    opening_range: Pressure = Field(default=10e5, description="from there to fully open", usual=DIFFERENCE)
    lag: NotNegativeDuration = Field(default=0.0, description="time constant of the opening; 0: none", usual=LAG)
    free_return: Truth = Field(default=False, description="whether a check valve lets fluid pass from A to P")
    leakage: Leakage = Field(default=0.0)

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        return tuple(each for each in cls.late if each != "check_flow" or entry(data, "free_return"))


class _Piloted(Rated):
    """What pilot-operated valves share: a main poppet or spool, moved by the drop over an orifice to its spring chamber X."""

    nodes: ClassVar[tuple[str, ...]] = (".X",)
    early: ClassVar[tuple[str, ...]] = ("pressure_X",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position", "orifice_flow", "pilot_flow", "pilot_position")

    pilot_flow: VolumeFlow = Field(
        default=2e-3 / 60.0, description="of the orifice at `pilot_pressure_drop`; that of the open pilot is twice it"
    )
    pilot_pressure_drop: Pressure = Field(default=5e5, usual=DIFFERENCE)
    pilot_range: Pressure = Field(default=3e5, description="over which the pilot opens wholly", usual=DIFFERENCE)
    spring: NotNegativePressure = Field(
        default=2e5, description="difference of pressure at which the main stage begins to move", usual=DIFFERENCE
    )
    opening_range: Pressure = Field(default=3e5, description="from there to the other end of its stroke")
    lag: NotNegativeDuration = Field(default=0.005, description="time constant of the main stage; 0: none", usual=LAG)
    leakage: Leakage = Field(default=0.0)
    inner_volume: Volume = Field(default=INNER_VOLUME, description="of the spring chamber", usual=VOLUME)

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
    opens_at: VaryingPressure = Field(
        description="difference of pressure of X and T at which the pilot opens", usual=PRESSURE
    )


class PilotReducingValve(_Piloted):
    """A reducing valve in two stages: a pilot drains the chamber X to T above `pressure`, and the main spool closes from P to A by the
    drop from A to X."""

    needs: ClassVar[tuple[str, ...]] = ("P", "A", "T")
    functions: ClassVar[tuple[str, ...]] = ("pressure",)

    type: Literal["pilot-reducing-valve"] = "pilot-reducing-valve"
    pressure: VaryingPressure = Field(
        description="difference of pressure of X and T at which the pilot opens", usual=PRESSURE
    )


class CartridgeValve(Rated):
    """A two-way cartridge (logic element): opens between A and B as p_A a + p_B (1 - a) exceeds p_X by `opens_at`, a = `area_share`."""

    needs: ClassVar[tuple[str, ...]] = ("A", "B", "X")
    late: ClassVar[tuple[str, ...]] = ("flow", "position")
    passes: ClassVar[tuple[tuple[str, str], ...]] = ()

    type: Literal["cartridge-valve"] = "cartridge-valve"
    area_share: Share = Field(default=0.5, description="area of A over that of X; 1: B does not act")
    opens_at: NotNegativePressure = Field(default=2e5, description="of its spring, on the area of X", usual=DIFFERENCE)
    opening_range: Pressure = Field(default=3e5, description="from there to fully open", usual=DIFFERENCE)
    lag: NotNegativeDuration = Field(default=0.0, description="time constant of the opening; 0: none", usual=LAG)
    leakage: Leakage = Field(default=0.0)


class CrossPortRelief(Rated):
    """Two relief valves between the lines of a motor, from A to B and from B to A; with a port T also anti-cavitation valves from there."""

    needs: ClassVar[tuple[str, ...]] = ("A", "B")
    may: ClassVar[tuple[str, ...]] = ("T",)
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    late: ClassVar[tuple[str, ...]] = (
        "flow_AB",
        "flow_BA",
        "position_AB",
        "position_BA",
        "flow_TA",
        "flow_TB",
        "position_TA",
        "position_TB",
    )

    type: Literal["cross-port-relief"] = "cross-port-relief"
    opens_at: VaryingPressure = Field(description="difference of pressure of both lines", usual=PRESSURE)
    opening_range: Pressure = Field(default=20e5, description="from there to fully open", usual=DIFFERENCE)
    lag: NotNegativeDuration = Field(default=0.0, description="time constant of the relief valves; 0: none", usual=LAG)
    check_flow: Maybe[VolumeFlow] = Field(
        default=None, description="of the anti-cavitation valves; default `flow`", usual=FLOW
    )
    check_pressure_drop: Maybe[Pressure] = Field(
        default=None, description="of these; default `pressure_drop`", usual=DIFFERENCE
    )
    check_opens_at: NotNegativePressure = Field(default=0.2e5, usual=DIFFERENCE)
    check_opening_range: Pressure = Field(default=1e5, usual=DIFFERENCE)
    leakage: Leakage = Field(default=0.0)

    @property
    def check_conductance(self) -> float:
        """K [m³/s/√Pa] of the anti-cavitation valves."""
        flow, drop = self.check_flow or self.flow, self.check_pressure_drop or self.pressure_drop
        return flow / drop**0.5 if flow and drop else 0.0

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        return cls.late if "T" in cls.ports_in(data) else cls.late[:4]


class BrakeValve(Rated):
    """A brake valve of a motor: fluid passes freely from VA to A and from VB to B; back it passes as the other side is pressurised.

    From A to VA it opens where VB is `opens_at` above the air, from B to VB where VA is.
    """

    needs: ClassVar[tuple[str, ...]] = ("VA", "VB", "A", "B")
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    late: ClassVar[tuple[str, ...]] = (
        "flow_A",
        "flow_B",
        "position_A",
        "position_B",
        "check_flow_A",
        "check_flow_B",
    )

    type: Literal["brake-valve"] = "brake-valve"
    opens_at: VaryingPressure = Field(default=10e5, description="of the pilot, above the air", usual=PRESSURE)
    opening_range: Pressure = Field(default=15e5, description="from there to fully open", usual=DIFFERENCE)
    lag: NotNegativeDuration = Field(default=0.02, description="time constant of the spool; 0: none", usual=LAG)
    leakage: Leakage = Field(default=0.0)
