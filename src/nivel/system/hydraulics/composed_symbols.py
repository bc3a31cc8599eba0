"""Symbols of valves that are composed of others, after ISO 1219-1, in the units of `nivel.system.hydraulics.symbols`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from nivel.machine.hydraulics.spool_valve import ends_of
from nivel.system.hydraulics.symbols import (
    SPRING,
    Symbol,
    adjustable,
    arrow,
    in_bar,
    path,
    varies,
)
from nivel.system.hydraulics.valve_symbol import boxes, directional_valve

SQUARE: Final = "M-12 -12 H12 V12 H-12 Z"
STUBS: Final = "M0 -20 V-12 M0 12 V20"
THROTTLE: Final = "M-7 -7 Q-1 0 -7 7 M7 -7 Q1 0 7 7"


def _moved(body: str, x: float, y: float) -> str:
    return f'<g transform="translate({x:g} {y:g})">{body}</g>'


def _check(x: float, y: float, up: bool = True) -> str:
    """A ball on its seat; `up`: fluid passes upwards."""
    way = 1.0 if up else -1.0
    seat = path(f"M{x - 6:g} {y - 3 * way:g} L{x:g} {y + 5 * way:g} L{x + 6:g} {y - 3 * way:g}")
    return seat + f'<circle cx="{x:g}" cy="{y - 2 * way:g}" r="3.6"/>'


def _letters(ports: Mapping[str, tuple[float, float]]) -> str:
    return "".join(f'<text class="port" x="{x:g}" y="{y:g}">{port}</text>' for port, (x, y) in ports.items())


def _square(open_at_rest: bool, upwards: bool, drained: bool = False) -> str:
    """A square with its arrow, in line with the ports or beside them, and its spring."""
    x = 0.0 if open_at_rest else -5.0
    ends = (12.0, -12.0) if upwards else (-12.0, 12.0)
    body = path(f"{SQUARE} {STUBS}") + arrow(x, *ends) + path(f"M12 0 {SPRING}")
    return body + (path("M20 5 V20", "dashed") if drained else "")


def flow_control(data: Mapping[str, Any]) -> Symbol:
    """A flow control valve, of two or three ways."""
    body = path(f"M-14 -14 H14 V14 H-14 Z M0 -20 V20 {THROTTLE}") + path("M0 -14 l-3 6 h6 z", "full")
    if varies(data, "setting") or data.get("setting", 1.0) != 1.0:
        body += adjustable(-13, 12, 13, -12)
    three = "T" in (data.get("ports") or {})
    body += path("M0 9 H10 V20") if three else ""
    if data.get("free_return"):
        body += path("M0 -17 H22 V-7 M22 7 V17 H0") + _check(22.0, 0.0, up=False)
    right = 29.0 if data.get("free_return") else 14.0
    return Symbol(body, right, 20.0, {"A": 0.0}, {"P": 0.0} | ({"T": 10.0} if three else {}))


def divider(data: Mapping[str, Any]) -> Symbol:
    """A flow divider, or one that combines."""
    body = path("M-24 -14 H24 V14 H-24 Z M0 20 V6 H-14 V-20 M0 6 H14 V-20")
    body += _moved(path("M-5 -5 Q0 0 -5 5 M5 -5 Q0 0 5 5"), -14, -4) + _moved(
        path("M-5 -5 Q0 0 -5 5 M5 -5 Q0 0 5 5"), 14, -4
    )
    tip = "M{x} 4 l-3 -6 h6 z" if data.get("combines") else "M{x} -14 l-3 5 h6 z"
    body += "".join(path(tip.format(x=x), "full") for x in (-14, 14))
    share = data.get("share", 0.5)
    said = (f"{100.0 * share:.3g} : {100.0 * (1.0 - share):.3g}",)
    return Symbol(body, 24.0, 20.0, {"A": -14.0, "B": 14.0}, {"P": 0.0}, settings=said)


def priority(data: Mapping[str, Any]) -> Symbol:
    """A priority valve: at rest the way to CF is open."""
    body = path("M-24 -12 H0 V12 H-24 Z M0 -12 H24 V12 H0 Z M6 -20 V-12 M18 -20 V-12 M12 12 V20")
    body += path("M12 12 L7 -7") + path("M6 -12 l-1 6.5 l5 -1.5 z", "full")
    body += path("M-12 12 L-7 -7") + path("M-6 -12 l1 6.5 l-5 -1.5 z", "full") + path("M18 -12 v5 m-3 0 h6")
    body += path(f"M24 0 {SPRING}") + path("M38 0 V20 M6 -16 H-30 V0 H-24", "dashed")
    body += _letters({"CF": (-8.0, -14.0), "EF": (20.0, -14.0)})
    return Symbol(body, 38.0, 20.0, {"CF": 6.0, "EF": 18.0}, {"P": 12.0, "LS": 38.0}, settings=in_bar(data, "margin"))


def shuttle(_: Mapping[str, Any]) -> Symbol:
    """A shuttle valve."""
    body = path("M-20 -9 H20 V9 H-20 Z M-13 -5 L-6 0 L-13 5 M13 -5 L6 0 L13 5 M0 -9 V-16")
    body += path("M-20 0 H-26 V16 M20 0 H26 V16") + '<circle cx="-4" cy="0" r="4"/>'
    return Symbol(body, 26.0, 16.0, {"C": 0.0}, {"A": -26.0, "B": 26.0})


def unloading(data: Mapping[str, Any]) -> Symbol:
    """An unloading valve: P above, as of a relief valve."""
    ports = data.get("ports") or {}
    body = _square(False, False)
    if "X" in ports:
        body += path("M-30 20 V0 H-12", "dashed")
        return Symbol(body, 30.0, 20.0, {"P": 0.0}, {"T": 0.0, "X": -30.0}, "relief", in_bar(data, "opens_at"))
    body += path("M0 -17 H-18 V0 H-12 M26 0 H34 V20", "dashed")
    return Symbol(body, 34.0, 20.0, {"P": 0.0}, {"T": 0.0, "LS": 34.0}, "relief", in_bar(data, "opens_at"))


def sequence(data: Mapping[str, Any]) -> Symbol:
    """A sequence valve, drained outside."""
    drained = "T" in (data.get("ports") or {})
    body = _square(False, True, drained) + path("M0 17 H-18 V0 H-12", "dashed")
    if data.get("free_return"):
        body += path("M0 -17 H34 V-7 M34 7 V17 H0") + _check(34.0, 0.0, up=False)
    if varies(data, "opens_at"):
        body += adjustable(13, 9, 27, -10)
    below = {"P": 0.0} | ({"T": 20.0} if drained else {})
    wide = 41.0 if data.get("free_return") else 27.0
    return Symbol(body, wide, 20.0, {"A": 0.0}, below, settings=in_bar(data, "opens_at"))


def cartridge(data: Mapping[str, Any]) -> Symbol:
    """A two-way cartridge valve: A below, B beside, X above its spring."""
    body = path("M-14 -16 H14 V16 H-14 Z M-8 -6 H8 V4 L3 11 H-3 L-8 4 Z M0 16 V22 M14 8 H24 V-22")
    body += path("M-4 -6 l8 -2 l-8 -3 l8 -2 l-4 -3") + path("M-8 -22 V-16", "dashed")
    said = in_bar(data, "opens_at")
    return Symbol(body, 24.0, 22.0, {"X": -8.0, "B": 24.0}, {"A": 0.0}, settings=said)


def pilot_relief(data: Mapping[str, Any]) -> Symbol:
    """A pilot-operated relief valve with its vent port X."""
    body = _square(False, False) + path("M16 -9 l9 4 l-9 4 z", "full")
    body += path("M0 -17 H-18 V0 H-12 M26 0 H34 V-20", "dashed")
    if varies(data, "opens_at"):
        body += adjustable(13, 9, 27, -10)
    return Symbol(body, 34.0, 20.0, {"P": 0.0, "X": 34.0}, {"T": 0.0}, "relief", in_bar(data, "opens_at"))


def pilot_reducing(data: Mapping[str, Any]) -> Symbol:
    """A pilot-operated reducing valve with its drain T."""
    body = _square(True, True, drained=True) + path("M16 -9 l9 4 l-9 4 z", "full")
    body += path("M0 -17 H-18 V0 H-12 M26 0 H34 V-20", "dashed")
    below = {"P": 0.0, "T": 20.0}
    return Symbol(body, 34.0, 20.0, {"A": 0.0, "X": 34.0}, below, settings=in_bar(data, "pressure"))


def cross_port(data: Mapping[str, Any]) -> Symbol:
    """Two relief valves between two lines, and anti-cavitation valves from below."""
    anti = "T" in (data.get("ports") or {})
    body = path("M-40 -30 V-14 M40 -30 V-14 M-40 -24 H-22 V-20 M40 -8 H-22 V-12 M40 -24 H22 V-20 M-40 -8 H22 V-12")
    for x in (-22.0, 22.0):
        body += path(f"M{x - 6:g} -20 h12 v8 h-12 z") + path(f"M{x + 6:g} -16 l2 -3 l2 6 l2 -6 l2 3")
    body += path("M-40 -14 V-8 M40 -14 V-8")
    if anti:
        body += path("M-40 -8 V4 M-40 17 V24 H40 V17 M40 4 V-8 M0 24 V30") + _check(-40.0, 10.0) + _check(40.0, 10.0)
    body += path("M-48 -27 H48 V27 H-48 Z", "frame")
    above = {"A": -40.0, "B": 40.0}
    return Symbol(body, 48.0, 30.0, above, {"T": 0.0} if anti else {}, settings=in_bar(data, "opens_at"))


def brake(data: Mapping[str, Any]) -> Symbol:
    """A brake valve: for each side a check valve in, and a piloted edge back."""
    body = path("M-48 -24 H48 V24 H-48 Z", "frame")
    for side in (-1.0, 1.0):
        x = 22.0 * side
        body += path(f"M{x:g} -30 V30 M{x:g} -18 H{x + 15 * side:g} V-10 M{x + 15 * side:g} 10 V18 H{x:g}")
        body += _moved(path("M-7 -7 H7 V7 H-7 Z") + arrow(-3, -7, 7), x + 15 * side, 0.0)
        body += _check(x, 0.0)
    body += path("M-22 22 L28 5 M22 22 L-28 5", "dashed")
    return Symbol(
        body, 48.0, 30.0, {"A": -22.0, "B": 22.0}, {"VA": -22.0, "VB": 22.0}, settings=in_bar(data, "opens_at")
    )


def spool_valve(data: Mapping[str, Any]) -> Symbol:
    """A spool with a box for each side to which its edges open."""
    forward, middle, back = [], [], []
    for pair, edge in (data.get("edges") or {}).items():
        ends = ends_of(pair)
        if ends is not None:
            for group, sign in ((forward, 1.0), (middle, 0.0), (back, -1.0)):
                if _is_open(edge, sign):
                    group.append(ends)
    ports = sorted({port for pair in data.get("edges") or {} for port in ends_of(pair) or ()}, key=_place)
    top = [port for port in ports if port in ("A", "B", "C")]
    bottom = [port for port in ports if port not in top]
    groups = [forward, middle, back] if back else [forward, middle]
    body, wide, high, above, below = boxes(groups, top, bottom, spring="both" if back else "one")
    return Symbol(body, wide, high, above, below, "valve")


def _place(port: str) -> int:
    return "ABCPTRSLS".find(port) if port != "LS" else 99


def _is_open(edge: Mapping[str, Any], at: float) -> bool:
    """Whether an edge is open at a position, by its record as JSON."""
    curve = edge.get("flow") or edge.get("area") or next(iter(edge.get("flows") or ()), None)
    if curve is None:
        starts = [each.get("begins", 0.0) for each in edge.get("notches") or ()]
        return any(at > x >= 0.0 or at < x < 0.0 for x in starts)
    points, values = curve["points"], curve["values"]
    k = min(range(len(points)), key=lambda j: abs(points[j] - at))
    return abs(points[k] - at) < 0.5 and values[k] > 0.0


def section(data: Mapping[str, Any]) -> Symbol:
    """A section: its spool, and its compensator before or behind the metering edge."""
    spool, wide, high, above, below = directional_valve({"ways": "4/3", "frequency": data.get("frequency") or 1.0})
    kind = data.get("compensation") or "pre"
    if kind == "none":
        return Symbol(spool, wide, high, above, below, "valve")
    body = _moved(spool, 0.0, -13.0)
    p, t = below["P"], below["T"]
    if kind == "pre":
        body += path(f"M{p:g} 8 V12 M{p:g} 28 V34 M{p - 8:g} 12 h16 v16 h-16 z") + arrow(p, 28, 12)
        body += path(f"M{p + 8:g} 20 l2 -4 l3 8 l3 -8 l2 4") + path(f"M{p + 18:g} 20 H40 V34", "dashed")
        body += path(f"M{p:g} 10 H{p - 13:g} V20 H{p - 8:g}", "dashed") + path(f"M{t:g} 8 V34")
    else:
        body += path(f"M{p:g} 8 V34 M{t:g} 8 V34 M-36 8 h16 v16 h-16 z M-28 8 V4 H{p:g} M-28 24 V30 H{p:g}")
        body += arrow(-28, 24, 8) + path("M-20 16 H40 V34", "dashed")
    body += path(f"M{-wide + 2:g} -32 H{wide - 2:g} V31 H{-wide + 2:g} Z", "frame")
    return Symbol(body, wide, 34.0, above, {**below, "LS": 40.0}, "valve", in_bar(data, "margin"))


def quick_exhaust(_: Mapping[str, Any]) -> Symbol:
    """A quick exhaust valve: a shuttle whose common port is A, with its exhaust."""
    body = path("M-20 -9 H20 V9 H-20 Z M-13 -5 L-6 0 L-13 5 M13 -5 L6 0 L13 5 M0 -9 V-16")
    body += path("M-20 0 H-26 V16 M20 0 H26 V16") + '<circle cx="10" cy="0" r="4"/>'
    return Symbol(body, 26.0, 16.0, {"A": 0.0}, {"P": -26.0, "R": 26.0})


def soft_start(_: Mapping[str, Any]) -> Symbol:
    """A soft start valve: a throttle beside what its outlet opens."""
    body = path("M-30 -12 H-6 V12 H-30 Z M-18 -20 V-12 M-18 12 V20 M-18 -8 V8 M-18 -8 l-3 6 h6 z")
    body += path("M-18 -16 H14 V-8 M14 8 V16 H-18 M14 -8 V8 M6 -8 Q13 0 6 8 M22 -8 Q15 0 22 8")
    body += path("M-18 -18 H-36 V0 H-30", "dashed")
    return Symbol(body, 36.0, 20.0, {"A": -18.0}, {"P": -18.0})


def ejector(_: Mapping[str, Any]) -> Symbol:
    """A vacuum generator: a jet that draws from A."""
    body = path("M-24 -10 H24 V10 H-24 Z M-24 0 H-34 V18 M24 0 H34 V18 M0 -10 V-18")
    body += path("M-18 -6 L-4 -2 V2 L-18 6 M4 -3 L18 -6 M4 3 L18 6") + path("M-2 -3 L6 0 L-2 3 z")
    return Symbol(body, 34.0, 18.0, {"A": 0.0}, {"P": -34.0, "R": 34.0})
