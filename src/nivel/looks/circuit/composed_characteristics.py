"""Characteristic curves of valves that are composed of others: shuttle, flushing, priority, divider, brake and pilot-operated valves."""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from nivel.elements.circuits.check_valves import BrakeValve, FlushingValve, ShuttleValve
from nivel.elements.circuits.flow_valves import FlowDivider, PriorityValve
from nivel.elements.circuits.pilot_valves import PilotReducingValve, PilotReliefValve
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
