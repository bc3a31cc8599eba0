"""Valves that bound a pressure, hold or switch it: relief and unloading, reducing and sequence valves, compensators, soft start."""

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Literal

from nivel.elements.circuits import ranges
from nivel.elements.circuits.component import Rated, VaryingPressure
from nivel.elements.circuits.composed import OF_POPPETS, PASSES, add_check_between, add_opened
from nivel.elements.circuits.fluids import ATMOSPHERE
from nivel.elements.circuits.kind import ComponentKind
from nivel.elements.circuits.restrictions import add_flow, rated
from nivel.elements.circuits.symbol import BAR, Symbol, adjustable, check_at, in_bar, path, square, varies
from nivel.known import SystemBuilder
from nivel.machine.core.coefficient import Leakage, Share, Truth
from nivel.machine.core.element import Inequalities
from nivel.machine.core.record import Problem, entry
from nivel.machine.given import Field, Maybe


class ReliefValve(Rated):
    """Opens from P to T where the difference of pressure exceeds `opens_at`."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("P", "T")
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position")
    relieves: ClassVar[str] = "P"

    inequalities: ClassVar[Inequalities] = (PASSES,)

    type: Literal["relief-valve"] = "relief-valve"
    opens_at: ranges.VaryingLevel = Field("difference of pressure at which it begins to open")
    opening_range: ranges.Drop = Field("difference of pressure from there to fully open")
    lag: ranges.Lag = Field("time constant of the opening; 0: none", default=0.0)
    leakage: Leakage = Field(default=0.0)

    @property
    def inlets(self) -> tuple[str, ...]:
        return ("P", "T") if self.leakage else ("T",)


class UnloadingValve(Rated):
    """Opens from P to T where P is more than `opens_at` above LS, or where a pilot X is above it."""

    needs: ClassVar[tuple[str, ...]] = ("P", "T")
    may: ClassVar[tuple[str, ...]] = ("LS", "X")
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position")
    relieves: ClassVar[str] = "P"

    type: Literal["unloading-valve"] = "unloading-valve"
    opens_at: ranges.VaryingLevel = Field("with LS: difference of P and LS; with X: that of X and the air")
    opening_range: ranges.Drop = Field("from there to fully open", default=3e5)
    lag: ranges.Lag = Field("time constant of the opening; 0: none", default=0.01)
    leakage: Leakage = Field(default=0.0)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if ("LS" in self.ports) == ("X" in self.ports):
            got = "got both" if "X" in self.ports else "got neither"
            yield Problem((), f"an unloading valve has a port LS, which it stands above, or a pilot X; {got}")


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
    opens_at: ranges.VaryingLevel = Field("difference of pressure of both lines")
    opening_range: ranges.Drop = Field("from there to fully open", default=20e5)
    lag: ranges.Lag = Field("time constant of the relief valves; 0: none", default=0.0)
    check_flow: Maybe[ranges.Flow] = Field("of the anti-cavitation valves; default `flow`", default=None)
    check_pressure_drop: Maybe[ranges.Drop] = Field("of these; default `pressure_drop`", default=None)
    check_opens_at: ranges.LeastDrop = Field(default=0.2e5)
    check_opening_range: ranges.Drop = Field(default=1e5)
    leakage: Leakage = Field(default=0.0)

    @property
    def check_conductance(self) -> float:
        """K [m³/s/√Pa] of the anti-cavitation valves."""
        flow, drop = self.check_flow or self.flow, self.check_pressure_drop or self.pressure_drop
        return flow / drop**0.5 if flow and drop else 0.0

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        return cls.late if "T" in cls.ports_in(data) else cls.late[:4]


def add_relief(builder: SystemBuilder, component: ReliefValve) -> None:
    """p_P - p_T against the spring."""
    add_opened(builder, component, "flow", ("P", "T"), {"P": 1.0, "T": -1.0}, component.opens_at)


def add_unloading(builder: SystemBuilder, component: UnloadingValve) -> None:
    """p_P - p_LS, or a pilot above the air, against the spring."""
    piloted = "X" in component.ports
    factors, constant = ({"X": 1.0}, -ATMOSPHERE) if piloted else ({"P": 1.0, "LS": -1.0}, 0.0)
    add_opened(builder, component, "flow", ("P", "T"), factors, component.opens_at, constant=constant)


def add_cross_port(builder: SystemBuilder, component: CrossPortRelief) -> None:
    """A relief valve each way, and check valves from the tank line."""
    for a, b in (("A", "B"), ("B", "A")):
        add_opened(builder, component, f"flow_{a}{b}", (a, b), {a: 1.0, b: -1.0}, component.opens_at)
    for side in "AB" if "T" in component.ports else "":
        numbers = [component.check_conductance, component.transition, 0.0]
        spring = (component.check_opens_at, component.check_opening_range)
        add_check_between(builder, component, f"flow_T{side}", ("T", side), numbers, spring)


RELIEF = Symbol(
    square(False, False) + path("M0 -17 H-18 V0 H-12", "dashed"), 27.0, 20.0, {"P": 0.0}, {"T": 0.0}, "relief",
    key="opens_at", unit=BAR, arrow=(13, 9, 27, -10),
)  # fmt: skip


def unloading(data: Mapping[str, Any]) -> Symbol:
    """An unloading valve: P above, as of a relief valve."""
    ports = data.get("ports") or {}
    body = square(False, False)
    if "X" in ports:
        body += path("M-30 20 V0 H-12", "dashed")
        return Symbol(body, 30.0, 20.0, {"P": 0.0}, {"T": 0.0, "X": -30.0}, "relief", in_bar(data, "opens_at"))
    body += path("M0 -17 H-18 V0 H-12 M26 0 H34 V20", "dashed")
    return Symbol(body, 34.0, 20.0, {"P": 0.0}, {"T": 0.0, "LS": 34.0}, "relief", in_bar(data, "opens_at"))


def cross_port(data: Mapping[str, Any]) -> Symbol:
    """Two relief valves between two lines, and anti-cavitation valves from below."""
    anti = "T" in (data.get("ports") or {})
    body = path("M-40 -30 V-14 M40 -30 V-14 M-40 -24 H-22 V-20 M40 -8 H-22 V-12 M40 -24 H22 V-20 M-40 -8 H22 V-12")
    for x in (-22.0, 22.0):
        body += path(f"M{x - 6:g} -20 h12 v8 h-12 z") + path(f"M{x + 6:g} -16 l2 -3 l2 6 l2 -6 l2 3")
    body += path("M-40 -14 V-8 M40 -14 V-8")
    if anti:
        body += (
            path("M-40 -8 V4 M-40 17 V24 H40 V17 M40 4 V-8 M0 24 V30") + check_at(-40.0, 10.0) + check_at(40.0, 10.0)
        )
    body += path("M-48 -27 H48 V27 H-48 Z", "frame")
    above = {"A": -40.0, "B": 40.0}
    return Symbol(body, 48.0, 30.0, above, {"T": 0.0} if anti else {}, settings=in_bar(data, "opens_at"))


class ReducingValve(Rated):
    """Closes from P to A as the pressure at A comes to `pressure`; with a port T it relieves A above that."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("P", "A")
    may: ClassVar[tuple[str, ...]] = ("T",)
    functions: ClassVar[tuple[str, ...]] = ("pressure",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position", "relief_flow")

    type: Literal["reducing-valve"] = "reducing-valve"
    pressure: ranges.VaryingLevel = Field("at A, absolute, at which it is closed")
    opening_range: ranges.Drop = Field("pressure below that at which it is fully open", default=5e5)
    lag: ranges.Lag = Field("time constant of the opening; 0: none", default=0.0)
    leakage: Leakage = Field(default=0.0)

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        ports = entry(data, "ports")
        relieves = isinstance(ports, Mapping) and "T" in ports
        return tuple(each for each in cls.late if relieves or each != "relief_flow")


class Compensator(Rated):
    """Holds the pressure at A, in front of a valve, a `margin` above the load pressure LS; in series, from P to A.

    Opening S(½ - (p_A - p_LS - margin)/opening_range).
    """

    needs: ClassVar[tuple[str, ...]] = ("P", "A", "LS")
    functions: ClassVar[tuple[str, ...]] = ("margin",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position")

    type: Literal["compensator"] = "compensator"
    margin: VaryingPressure = Field("held between A and LS", default=7e5, usual=ranges.DIFFERENCE)
    opening_range: ranges.Drop = Field("from closed to fully open", default=6e5)
    lag: ranges.Lag = Field("time constant of the opening; 0: none", default=0.01)
    leakage: Leakage = Field(default=0.0)


class SequenceValve(Rated):
    """Opens from P to A where P is more than `opens_at` above its spring chamber, which drains to T, or to the air without one."""

    needs: ClassVar[tuple[str, ...]] = ("P", "A")
    may: ClassVar[tuple[str, ...]] = ("T",)
    sensing: ClassVar[tuple[str, ...]] = ("T",)
    functions: ClassVar[tuple[str, ...]] = ("opens_at",)
    late: ClassVar[tuple[str, ...]] = ("flow", "position", "check_flow")

    type: Literal["sequence-valve"] = "sequence-valve"
    opens_at: ranges.VaryingLevel = Field("pressure of P above that of the drain")
    opening_range: ranges.Drop = Field("from there to fully open", default=10e5)
    lag: ranges.Lag = Field("time constant of the opening; 0: none", default=0.0)
    free_return: Truth = Field("whether a check valve lets fluid pass from A to P", default=False)
    leakage: Leakage = Field(default=0.0)

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        return tuple(each for each in cls.late if each != "check_flow" or entry(data, "free_return"))


class SoftStart(Rated):
    """Fills A from P through a throttle until p_A is a share of p_P; then it opens."""

    gases: ClassVar[bool] = True
    needs: ClassVar[tuple[str, ...]] = ("P", "A")
    late: ClassVar[tuple[str, ...]] = ("flow", "throttled_flow", "position")
    passes: ClassVar[tuple[tuple[str, str], ...]] = (("P", "A"), ("A", "P"))

    type: Literal["soft-start"] = "soft-start"
    throttle: Share = Field("opening while it fills, as a share of the whole one", default=0.05)
    switches_at: Share = Field("p_A over p_P, absolute, at which it opens", default=0.5)
    opening_range: ranges.Drop = Field("difference of pressure from there to fully open", default=0.2e5)
    lag: ranges.Lag = Field("time constant of the opening; 0: none", default=0.05)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not 0.0 < self.throttle < 1.0:
            yield Problem(("throttle",), f"a share above 0 and below 1 was expected, got {self.throttle:g}")


def add_reducing(builder: SystemBuilder, component: ReducingValve) -> None:
    """The setting against p_A; the other way round for what relieves A."""
    add_opened(builder, component, "flow", ("P", "A"), {"A": -1.0}, component.pressure, 1.0)
    if "T" in component.ports:
        numbers = rated(component, 0.0)
        add_opened(builder, component, "relief_flow", ("A", "T"), {"A": 1.0}, component.pressure, numbers=numbers)


def add_compensator(builder: SystemBuilder, component: Compensator) -> None:
    """The margin and half the range against p_A - p_LS."""
    factors, half = {"A": -1.0, "LS": 1.0}, 0.5 * component.opening_range
    add_opened(builder, component, "flow", ("P", "A"), factors, component.margin, 1.0, half)


def add_sequence(builder: SystemBuilder, component: SequenceValve) -> None:
    """p_P against the spring and its drain; perhaps a check valve back."""
    drained = "T" in component.ports
    factors, constant = ({"P": 1.0, "T": -1.0}, 0.0) if drained else ({"P": 1.0}, -ATMOSPHERE)
    add_opened(builder, component, "flow", ("P", "A"), factors, component.opens_at, constant=constant)
    if component.free_return:
        add_check_between(builder, component, "check_flow", ("A", "P"))


def add_soft_start(builder: SystemBuilder, component: SoftStart) -> None:
    """p_A - share p_P opens what lies beside a throttle."""
    head, share, factors = rated(component, 0.0), component.throttle, {"A": 1.0, "P": -component.switches_at}
    add_opened(builder, component, "flow", ("P", "A"), factors, 0.0, 1.0, numbers=[(1.0 - share) * head[0], *head[1:]])
    add_flow(builder, component, "throttled_flow", ("P", "A"), [share * head[0], *head[1:]])


def reducing(data: Mapping[str, Any]) -> Symbol:
    """A reducing valve."""
    body, drain = square(True, True) + path("M0 -17 H-18 V0 H-12", "dashed"), "T" in (data.get("ports") or {})
    body += path("M8 12 V16 H30 V20") if drain else ""
    below = {"P": 0.0} | ({"T": 30.0} if drain else {})
    return Symbol(body, 30.0 if drain else 27.0, 20.0, {"A": 0.0}, below, settings=in_bar(data, "pressure"))


FELT = path("M0 -17 H-18 V0 H-12 M26 0 H34 V20", "dashed")
COMPENSATOR = Symbol(square(True, True) + FELT, 34.0, 20.0, {"A": 0.0}, {"P": 0.0, "LS": 34.0}, key="margin", unit=BAR)


def sequence(data: Mapping[str, Any]) -> Symbol:
    """A sequence valve, drained outside."""
    drained = "T" in (data.get("ports") or {})
    body = square(False, True, drained) + path("M0 17 H-18 V0 H-12", "dashed")
    if data.get("free_return"):
        body += path("M0 -17 H34 V-7 M34 7 V17 H0") + check_at(34.0, 0.0, up=False)
    if varies(data, "opens_at"):
        body += adjustable(13, 9, 27, -10)
    below = {"P": 0.0} | ({"T": 20.0} if drained else {})
    wide = 41.0 if data.get("free_return") else 27.0
    return Symbol(body, wide, 20.0, {"A": 0.0}, below, settings=in_bar(data, "opens_at"))


# a throttle beside what its outlet opens
VALVE = path("M-30 -12 H-6 V12 H-30 Z M-18 -20 V-12 M-18 12 V20 M-18 -8 V8 M-18 -8 l-3 6 h6 z")
THROTTLE = path("M-18 -16 H14 V-8 M14 8 V16 H-18 M14 -8 V8 M6 -8 Q13 0 6 8 M22 -8 Q15 0 22 8")
SOFT_START = Symbol(VALVE + THROTTLE + path("M-18 -18 H-36 V0 H-30", "dashed"), 36.0, 20.0, {"A": -18.0}, {"P": -18.0})


KINDS = (
    ComponentKind(ReliefValve, add_relief, OF_POPPETS, symbol=RELIEF),
    ComponentKind(UnloadingValve, add_unloading, OF_POPPETS, symbol=unloading),
    ComponentKind(CrossPortRelief, add_cross_port, OF_POPPETS, symbol=cross_port),
    ComponentKind(ReducingValve, add_reducing, OF_POPPETS, symbol=reducing),
    ComponentKind(Compensator, add_compensator, OF_POPPETS, symbol=COMPENSATOR),
    ComponentKind(SequenceValve, add_sequence, OF_POPPETS, symbol=sequence),
    ComponentKind(SoftStart, add_soft_start, OF_POPPETS, symbol=SOFT_START),
)
