"""Characteristic curves of the valves of a machine at rest: flow over position, over pressure, or over setting, as SVG."""

import math
from collections.abc import Callable, Iterator, Mapping
from html import escape
from pathlib import Path
from typing import Any, Final

import numpy as np

from nivel.elements.circuits import COMPONENTS
from nivel.elements.circuits.check_valves import (
    BrakeValve,
    CheckValve,
    CounterbalanceValve,
    FlushingValve,
    ShuttleValve,
)
from nivel.elements.circuits.component import Component, Rating
from nivel.elements.circuits.directional_valves import CENTRED, EDGES, DirectionalValve
from nivel.elements.circuits.ejectors import Ejector
from nivel.elements.circuits.flow_valves import FlowControl, FlowDivider, PriorityValve
from nivel.elements.circuits.fluids import OIL, Fluid, Gas
from nivel.elements.circuits.pilot_valves import CartridgeValve, PilotReducingValve, PilotReliefValve
from nivel.elements.circuits.pressure_valves import (
    CrossPortRelief,
    ReducingValve,
    ReliefValve,
    SequenceValve,
    UnloadingValve,
)
from nivel.elements.circuits.restrictions import CRITICAL_RATIO, Orifice
from nivel.elements.circuits.sections import Section
from nivel.elements.circuits.spool_valves import SpoolValve, conductances
from nivel.lazy import Struct
from nivel.machine.core.vectors import Array

HALVINGS: Final = 60


BAR, LITRE_PER_MINUTE = 1e5, 1e-3 / 60.0
POINTS: Final = 121


class Curve(Struct):
    """x as its axis says, y [L/min]."""

    label: str
    x: Array
    y: Array


class Chart(Struct):
    """The curves of one valve. across : what x is, with its unit."""

    name: str
    type: str
    across: str
    curves: tuple[Curve, ...]


def root(difference: Array | float, corner: float) -> Any:
    """Δp (Δp² + c²)^(-1/4)."""
    return difference * (np.asarray(difference) ** 2 + corner**2) ** -0.25


def step(t: Array) -> Array:
    """3 t² - 2 t³, from 0 to 1."""
    t = np.clip(t, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def _edges(valve: Any, across: str, middle: float, openings: dict[str, tuple[float, float]]) -> Chart:
    """Flows of edges at the rated difference of pressure, over the pressure that moves their spool. openings : label → sign of the opening
    with the pressure above `middle`, and share of the flow."""
    x = np.linspace(middle - valve.opening_range, middle + valve.opening_range, POINTS)
    drop, whole = (valve.pressure_drop or 0.0) / BAR, (valve.flow or 0.0) / LITRE_PER_MINUTE
    curves = [
        Curve(
            f"{label} at {drop:.3g} bar", x / BAR, share * whole * step(0.5 + sign * (x - middle) / valve.opening_range)
        )
        for label, (sign, share) in openings.items()
    ]
    return Chart(valve.name, valve.type, across, tuple(curves))


def _of_shuttle(valve: ShuttleValve, _: float) -> Chart:
    return _edges(valve, "p_A - p_B, bar", 0.0, {"A to C": (1.0, 1.0), "B to C": (-1.0, 1.0)})


def _of_flushing(valve: FlushingValve, setting: float) -> Chart:
    middle = setting + 0.5 * valve.opening_range
    return _edges(valve, "p_B - p_A, bar", middle, {"A to C": (1.0, 1.0)})


def _of_priority(valve: PriorityValve, margin: float) -> Chart:
    return _edges(valve, "p_CF - p_LS, bar", margin, {"P to CF": (-1.0, 1.0), "P to EF": (1.0, 1.0)})


def _of_divider(valve: FlowDivider, _: float) -> Chart:
    way = -1.0 if valve.combines else 1.0
    return _edges(valve, "p_M - p_N, bar", 0.0, {"A": (way, valve.share), "B": (-way, 1.0 - valve.share)})


def _of_brake(valve: BrakeValve, setting: float) -> Chart:
    middle = setting + 0.5 * valve.opening_range
    return _edges(valve, "p_VB above the air, bar", middle, {"A to VA": (1.0, 1.0)})


def _pilot_chamber(valve: PilotReliefValve | PilotReducingValve, setting: float, p: Array) -> Array:
    """p_X above the drain for the pressure before the orifice above it: what flows in flows out, found by halving."""
    low, high = np.zeros_like(p), p.copy()
    for _ in range(HALVINGS):
        x = 0.5 * (low + high)
        opened = 2.0 * step((x - setting) / valve.pilot_range)
        fills = root(p - x, valve.transition) > opened * root(x, valve.transition)
        low, high = np.where(fills, x, low), np.where(fills, high, x)
    return 0.5 * (low + high)


def _of_pilot_relief(valve: PilotReliefValve, setting: float) -> Chart:
    p = np.linspace(0.0, 1.1 * (setting + valve.spring + valve.opening_range + valve.pilot_range), 8 * POINTS)
    x = _pilot_chamber(valve, setting, p)
    opening = step((p - x - valve.spring) / valve.opening_range)
    flow = valve.conductance * opening * root(p, valve.transition) + valve.leakage * p
    flow = (flow + valve.pilot_conductance * root(p - x, valve.transition)) / LITRE_PER_MINUTE
    return Chart(valve.name, valve.type, "p_P - p_T, bar", (Curve(f"opens at {setting / BAR:.4g} bar", p / BAR, flow),))


def _of_pilot_reducing(valve: PilotReducingValve, setting: float) -> Chart:
    before, end = 2.0 * setting, setting + valve.pilot_range + valve.spring + valve.opening_range
    p = np.linspace(max(0.0, 2.0 * setting - end), 1.02 * end, 8 * POINTS)
    x = _pilot_chamber(valve, setting, p)
    opening = 1.0 - step((p - x - valve.spring) / valve.opening_range)
    flow = valve.conductance * opening * root(before - p, valve.transition) / LITRE_PER_MINUTE
    label = f"from P at {before / BAR:.4g} bar"
    return Chart(valve.name, valve.type, "p_A - p_T, bar", (Curve(label, p / BAR, flow),))


OF_COMPOSED: Final[dict[type | tuple[type, ...], tuple[Callable[[Any, float], Chart | None], str]]] = {
    ShuttleValve: (_of_shuttle, ""),
    FlushingValve: (_of_flushing, "opens_at"),
    PriorityValve: (_of_priority, "margin"),
    FlowDivider: (_of_divider, ""),
    BrakeValve: (_of_brake, "opens_at"),
    PilotReliefValve: (_of_pilot_relief, "opens_at"),
    PilotReducingValve: (_of_pilot_reducing, "pressure"),
}


SUPPLY: Final = 7e5  # Pa absolute, before valves of gas
STATED: Final = 10e5  # Pa over an edge whose catalogue states no difference of pressure
WIDE, HIGH, LEFT, BOTTOM, TOP, RIGHT = 300.0, 190.0, 46.0, 34.0, 34.0, 12.0
COLOURS: Final = ("#2f6fb3", "#c0392b", "#2e8b57", "#b8860b", "#7d4fa3", "#555555", "#008b8b", "#d2691e")
STYLE: Final = Path(__file__).with_suffix(".css").read_text(encoding="utf-8")


def valve_charts(record: Mapping[str, Any]) -> tuple[Chart, ...]:
    """The charts of all valves of a machine record as JSON."""
    densities = {str(each["name"]): _density(each) for each in record.get("fluids") or ()}
    density = next(iter(densities.values()), OIL.mixed_density)
    out = []
    for data in record.get("hydraulics") or ():
        component = COMPONENTS[str(data["type"])].record.model_validate(data) if data["type"] in COMPONENTS else None
        if isinstance(component, Rating) and component.is_of_gas:
            out.append(_of_gas(component))
            continue
        for kind, (draw, key) in _DRAWN.items():
            setting = getattr(component, key) if key and isinstance(component, kind) else density
            if isinstance(component, kind) and isinstance(setting, float | int):
                out.append(draw(component, float(setting)))
    return tuple(filter(None, out))


def _density(fluid: Mapping[str, Any]) -> float:
    kind = Gas if fluid.get("type") == "ideal-gas" else Fluid
    known = kind.model_validate({key: value for key, value in fluid.items() if value is not None})
    return known.mixed_density if isinstance(known, Fluid) else known.density


def ramp(z: Array, width: float) -> Array:
    """0 below zero, z - width/2 above `width`, with two continuous derivatives."""
    t = np.clip(z / width, 0.0, 1.0)
    return np.where(z >= width, z - 0.5 * width, width * t**3 * (1.0 - 0.5 * t))


def _of_spool(valve: SpoolValve, density: float) -> Chart:
    u = np.linspace(-1.0 if valve.two_sided else 0.0, 1.0, POINTS)
    curves = []
    for pair, edge in valve.edges.items():
        drops, tables = conductances(valve, edge, density)
        for drop, table in zip(drops, tables, strict=True):
            at = drop or STATED
            flow = np.array([table(float(x)) for x in u]) * root(at, valve.transition)
            curves.append(Curve(f"{pair} at {at / BAR:.3g} bar", u, flow / LITRE_PER_MINUTE))
    return Chart(valve.name, valve.type, "position", tuple(curves))


def _edge(u: Array, sign: float, shift: float, overlap: float, rounding: float) -> Array:
    full = 1.0 - overlap - 0.5 * rounding
    return ramp(sign * u + shift, rounding) / full


def _of_directional(valve: DirectionalValve, _: float) -> Chart:
    centred = valve.ways in (*CENTRED, "2/2")
    u = np.linspace(-1.0 if valve.ways in CENTRED else 0.0, 1.0, POINTS)
    whole = (valve.flow or 0.0) / LITRE_PER_MINUTE
    curves = []
    for pairs, sign in zip(EDGES[valve.ways], (1.0, -1.0), strict=True):
        factor, shift = (sign, -valve.overlap) if centred else (2.0 * sign, -sign - valve.overlap)
        for pair in pairs:
            opening = _edge(u, factor, shift, valve.overlap, valve.rounding)
            curves.append(Curve(f"{pair} at {(valve.pressure_drop or 0.0) / BAR:.3g} bar", u, whole * opening))
    return Chart(valve.name, valve.type, "position", tuple(curves))


def _of_section(valve: Section, _: float) -> Chart:
    u = np.linspace(-1.0, 1.0, POINTS)
    drop = (valve.pressure_drop or 0.0) / BAR
    curves = []
    for side, sign, flow in (("A", 1.0, valve.flow), ("B", -1.0, valve.flow_B or valve.flow)):
        opening = _edge(u, sign, -valve.overlap, valve.overlap, valve.rounding)
        if sign < 0.0 and valve.float_from is not None:
            full = 1.0 - valve.overlap - 0.5 * valve.rounding
            opening *= full / (full + valve.float_from - 1.0) * (1.0 - step((-u - valve.float_from) / valve.rounding))
        curves.append(Curve(f"to {side} at {drop:.3g} bar", u, (flow or 0.0) / LITRE_PER_MINUTE * opening))
    if valve.open_centre is not None:
        neutral = (valve.bypass_flow or valve.flow or 0.0) / LITRE_PER_MINUTE
        curves.append(Curve(f"N to C at {drop:.3g} bar", u, neutral * (1.0 - step(np.abs(u) / valve.bypass_closes))))
    return Chart(valve.name, valve.type, "position", tuple(curves))


def _opening(valve: Any, setting: float, label: str, across: str, factor: float = 1.0) -> Chart:
    """Flow over a difference of pressure that opens the valve by itself; factor : of that in what opens it."""
    end = (setting + valve.opening_range) / factor
    p = np.linspace(0.0, 1.15 * end, POINTS)
    opening = step((factor * p - setting) / valve.opening_range)
    flow = (valve.conductance * opening * root(p, valve.transition) + valve.leakage * p) / LITRE_PER_MINUTE
    return Chart(valve.name, valve.type, across, (Curve(label, p / BAR, flow),))


def _of_pressure(valve: ReliefValve | CheckValve | SequenceValve | UnloadingValve, setting: float) -> Chart | None:
    if isinstance(valve, UnloadingValve) and "X" in valve.ports:
        return None
    across = {
        "relief-valve": "p_P - p_T, bar",
        "check-valve": "p_A - p_B, bar",
        "sequence-valve": "p_P above its drain, A at the drain, bar",
        "unloading-valve": "p_P above LS, T at LS, bar",
    }[valve.type]
    return _opening(valve, setting, f"opens at {setting / BAR:.4g} bar", across)


def _of_counterbalance(valve: CounterbalanceValve, setting: float) -> Chart:
    p = np.linspace(0.0, 1.15 * (setting + valve.opening_range), POINTS)
    curves = []
    for pilot in (0.0, 0.1, 0.2):
        felt = p + valve.pilot_ratio * pilot * setting
        flow = valve.conductance * step((felt - setting) / valve.opening_range) * root(p, valve.transition)
        curves.append(Curve(f"pilot {pilot * setting / BAR:.3g} bar", p / BAR, flow / LITRE_PER_MINUTE))
    return Chart(valve.name, valve.type, "p_L, V at the pressure of the air, bar", tuple(curves))


def _of_cartridge(valve: CartridgeValve, setting: float) -> Chart:
    return _opening(valve, setting, "X and B without pressure", "p_A - p_B, bar", valve.area_share)


def _of_cross_port(valve: CrossPortRelief, setting: float) -> Chart:
    return _opening(valve, setting, "A to B, and B to A", "p_A - p_B, bar")


def _of_reducing(valve: ReducingValve, setting: float) -> Chart:
    before = 2.0 * setting
    p = np.linspace(max(setting - 2.0 * valve.opening_range, 0.0), setting + 0.2 * valve.opening_range, POINTS)
    flow = valve.conductance * step((setting - p) / valve.opening_range) * root(before - p, valve.transition)
    curve = Curve(f"from P at {before / BAR:.4g} bar", p / BAR, flow / LITRE_PER_MINUTE)
    return Chart(valve.name, valve.type, "p_A, bar", (curve,))


def _of_flow_control(valve: FlowControl, _: float) -> Chart:
    s = np.linspace(0.0, 1.0, POINTS)
    flow = valve.conductance * s * root(valve.margin, valve.transition) / LITRE_PER_MINUTE
    return Chart(valve.name, valve.type, "setting", (Curve(f"margin {valve.margin / BAR:.3g} bar", s, flow),))


def _of_orifice(valve: Orifice, density: float) -> Chart:
    size = valve.conductance
    if valve.diameter is not None:
        size = valve.discharge_coefficient * 0.25 * math.pi * valve.diameter**2 * math.sqrt(2.0 / density)
    p = np.linspace(0.0, max(2.0 * (valve.pressure_drop or 0.0), STATED), POINTS)
    flow = (size * root(p, valve.transition) + valve.leakage * p) / LITRE_PER_MINUTE
    return Chart(valve.name, valve.type, "p_A - p_B, bar", (Curve("wholly open", p / BAR, flow),))


def _of_gas(valve: Rating) -> Chart:
    """By ISO 6358, from a supply of usual pressure."""
    assert valve.sonic_conductance is not None
    assert isinstance(valve, Component)
    critical = CRITICAL_RATIO if valve.critical_ratio is None else valve.critical_ratio
    p = np.linspace(0.0, SUPPLY, POINTS)
    x = np.clip((1.0 - p / SUPPLY) / (1.0 - critical), 0.0, 1.0)
    flow = valve.sonic_conductance * SUPPLY * np.sqrt(x * (2.0 - x)) / LITRE_PER_MINUTE
    curve = Curve(f"wholly open, from {SUPPLY / BAR:g} bar", p / BAR, flow)
    return Chart(valve.name, valve.type, "pressure behind it, bar absolute", (curve,))


def _of_ejector(valve: Ejector, _: float) -> Chart:
    flow = np.array(valve.suction_flows) / LITRE_PER_MINUTE
    curve = Curve("suction", np.array(valve.vacuums) / BAR, flow)
    return Chart(valve.name, valve.type, "vacuum, bar", (curve,))


# what draws valves, and the setting that it takes, where that does not vary; without one it takes the density of the fluid
_DRAWN: Final[dict[type | tuple[type, ...], tuple[Callable[[Any, float], Chart | None], str]]] = {
    SpoolValve: (_of_spool, ""),
    DirectionalValve: (_of_directional, ""),
    Section: (_of_section, ""),
    (ReliefValve, CheckValve, SequenceValve, UnloadingValve): (_of_pressure, "opens_at"),
    CounterbalanceValve: (_of_counterbalance, "opens_at"),
    CartridgeValve: (_of_cartridge, "opens_at"),
    CrossPortRelief: (_of_cross_port, "opens_at"),
    ReducingValve: (_of_reducing, "pressure"),
    FlowControl: (_of_flow_control, ""),
    Orifice: (_of_orifice, ""),
    Ejector: (_of_ejector, ""),
    **OF_COMPOSED,
}


def valve_diagram(record: Mapping[str, Any], columns: int = 3) -> str:
    """SVG of the characteristic curves of all valves of a machine record as JSON; empty without any."""
    charts = valve_charts(record)
    if not charts:
        return ""
    rows = math.ceil(len(charts) / columns)
    wide, high = WIDE * min(columns, len(charts)), HIGH * rows
    head = f'<svg xmlns="http://www.w3.org/2000/svg" class="valves" viewBox="0 0 {wide:g} {high:g}" width="{wide:g}"'
    body = []
    for k, chart in enumerate(charts):
        x, y = WIDE * (k % columns), HIGH * (k // columns)
        body.append(f'<g transform="translate({x:g} {y:g})">{"".join(_drawn(chart))}</g>')
    return f'{head} role="img" aria-label="curves of valves"><style>{STYLE}</style>{"".join(body)}</svg>'


def _drawn(chart: Chart) -> Iterator[str]:
    x0, x1 = (float(f([f(curve.x) for curve in chart.curves])) for f in (np.min, np.max))
    y1 = 1.08 * float(np.max([np.max(curve.y) for curve in chart.curves])) or 1.0
    width, height = WIDE - LEFT - RIGHT, HIGH - TOP - BOTTOM

    def at(x: float, y: float) -> tuple[float, float]:
        return LEFT + width * (x - x0) / (x1 - x0), HIGH - BOTTOM - height * y / y1

    yield f'<text class="name" x="{LEFT:g}" y="12">{escape(chart.name)}</text>'
    yield f'<text class="words" x="{WIDE - RIGHT:g}" y="12" text-anchor="end">{escape(chart.type)}</text>'
    for value in _marks(0.0, y1):
        _, y = at(x0, value)
        yield f'<path class="{"grid" if value else "zero"}" d="M{LEFT:g} {y:.1f} H{WIDE - RIGHT:g}"/>'
        yield f'<text class="words" x="{LEFT - 4:g}" y="{y + 3:.1f}" text-anchor="end">{value:g}</text>'
    for value in _marks(x0, x1):
        x, _ = at(value, 0.0)
        yield f'<path class="{"grid" if value else "zero"}" d="M{x:.1f} {TOP:g} V{HIGH - BOTTOM:g}"/>'
        yield f'<text class="words" x="{x:.1f}" y="{HIGH - BOTTOM + 12:g}" text-anchor="middle">{value:g}</text>'
    place = 0.5 * (LEFT + WIDE - RIGHT)
    yield f'<text class="words" x="{place:g}" y="{HIGH - 8:g}" text-anchor="middle">{escape(chart.across)}</text>'
    yield f'<text class="words" x="{LEFT - 30:g}" y="{TOP - 6:g}">L/min</text>'
    for k, curve in enumerate(chart.curves):
        colour = COLOURS[k % len(COLOURS)]
        points = " ".join(
            "{:.1f},{:.1f}".format(*at(float(a), float(b))) for a, b in zip(curve.x, curve.y, strict=True)
        )
        yield f'<path style="stroke:{colour}" d="M{points}"><title>{escape(curve.label)}</title></path>'
    yield from _legend(chart)


def _legend(chart: Chart) -> Iterator[str]:
    """The first labels, in one line above the plot."""
    x, short = LEFT, [curve.label.partition(" at ")[0] for curve in chart.curves]
    whole = len(chart.curves) == 1 or len({*short}) < len(short)
    for k, curve in enumerate(chart.curves[: 3 if whole else 4]):
        label = curve.label if whole else short[k]
        yield f'<text x="{x:.0f}" y="{TOP - 6:g}" style="fill:{COLOURS[k]}">{escape(label)}</text>'
        x += 5.6 * len(label) + 10.0


def _marks(low: float, high: float) -> list[float]:
    """Round numbers between two."""
    raw = (high - low) / 4.0
    size = 10.0 ** math.floor(math.log10(raw))
    each = next(size * factor for factor in (1.0, 2.0, 5.0, 10.0) if size * factor >= raw)
    first = math.ceil(low / each - 1e-9)
    return [round(k * each, 12) for k in range(first, math.floor(high / each + 1e-9) + 1)]
