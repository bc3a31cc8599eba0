"""Symbols of components after ISO 1219-1: paths about the middle of a symbol, and where lines meet it. Units are pixels; y goes down."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import pi
from typing import Any, Final, Literal

from nivel.machine.hydraulics.component import SENSING
from nivel.system.hydraulics.valve_symbol import directional_valve

SPRING: Final = "l3 -5 l4 10 l4 -10 l3 5"
LETTER: Final = 6.4  # px, at 11 px
PIN: Final = 22.0  # px between pins of a box


@dataclass(frozen=True)
class Symbol:
    """What is drawn of a component.

    body : SVG about (0, 0). wide, high : half of its size. above, below : x of the pin of each port above, or below, the symbol.
    row : where it stands in the diagram; a relief valve beside what it protects, "" between actuators and pumps. settings : said below its
    name. text : in the middle of a box, whose pins have the letters of their ports.
    """

    body: str
    wide: float
    high: float
    above: Mapping[str, float] = field(default_factory=dict)
    below: Mapping[str, float] = field(default_factory=dict)
    row: Literal["actuator", "valve", "relief", "supply", ""] = ""
    settings: tuple[str, ...] = ()
    text: str = ""


def path(d: str, style: str = "") -> str:
    """An SVG path, of a class `style`: dashed, full (filled)."""
    return f'<path{f" class={style!r}" if style else ""} d="{d}"/>'.replace("'", '"')


def _circle(radius: float, y: float = 0.0) -> str:
    return f'<circle cx="0" cy="{y:g}" r="{radius:g}"/>'


def arrow(x: float, y0: float, y1: float) -> str:
    """An arrow along y, with its tip at y1."""
    way = 1.0 if y1 > y0 else -1.0
    return path(f"M{x:g} {y0:g} V{y1:g}") + path(f"M{x:g} {y1:g} l-3 {-6 * way:g} h6 z", "full")


def adjustable(x0: float, y0: float, x1: float, y1: float) -> str:
    """The oblique arrow of what can be set."""
    return path(f"M{x0:g} {y0:g} L{x1:g} {y1:g}") + path(f"M{x1:g} {y1:g} l-7 1.5 l5 5 z", "full")


def varies(data: Mapping[str, Any], key: str) -> bool:
    return not isinstance(data.get(key), float | int | None)


def _setting(data: Mapping[str, Any], key: str, factor: float, unit: str) -> tuple[str, ...]:
    """A constant of a component in the unit of a diagram; none where it varies or is not given."""
    value = data.get(key)
    return (f"{factor * value:.4g} {unit}",) if isinstance(value, float | int) else ()


def in_bar(data: Mapping[str, Any], key: str) -> tuple[str, ...]:
    return _setting(data, key, 1e-5, "bar")


def _displacement(data: Mapping[str, Any]) -> tuple[str, ...]:
    return _setting(data, "displacement", 2e6 * pi, "cm³/rev")


def orifice(data: Mapping[str, Any]) -> Symbol:
    """A restriction."""
    body = path("M0 -16 V16 M-8 -8 Q-1 0 -8 8 M8 -8 Q1 0 8 8")
    if varies(data, "opening"):
        body += adjustable(-13, 12, 13, -12)
    return Symbol(body, 13.0, 16.0, {"B": 0.0}, {"A": 0.0})


def pipe(data: Mapping[str, Any]) -> Symbol:
    """A pipe."""
    dots = "".join(f'<circle class="full" cx="0" cy="{y}" r="2"/>' for y in (-12, 12))
    size = f"{data['length']:.3g} m × {1e3 * data['diameter']:.3g} mm"
    body = path("M0 -16 V-12 C9 -5 -9 5 0 12 V16") + dots
    return Symbol(body, 8.0, 16.0, {"B": 0.0}, {"A": 0.0}, settings=(size,))


CHECK: Final = path("M0 16 V7 M-8 -4 L0 7 L8 -4 M0 -7 V-16") + _circle(5.0, -2.0)


def check(data: Mapping[str, Any]) -> Symbol:
    """A check valve, with or without a pilot."""
    pilot = path("M24 16 V3 H3", "dashed") if "X" in (data.get("ports") or {}) else ""
    return Symbol(CHECK + pilot, 24.0 if pilot else 9.0, 16.0, {"B": 0.0}, {"A": 0.0} | ({"X": 24.0} if pilot else {}))


def relief(data: Mapping[str, Any]) -> Symbol:
    """A relief valve."""
    body = path("M-12 -12 H12 V12 H-12 Z M0 -20 V-12 M0 12 V20") + arrow(-5, -12, 12)
    body += path(f"M12 0 {SPRING}") + path("M0 -17 H-18 V0 H-12", "dashed")
    if varies(data, "opens_at"):
        body += adjustable(13, 9, 27, -10)
    return Symbol(body, 27.0, 20.0, {"P": 0.0}, {"T": 0.0}, "relief", in_bar(data, "opens_at"))


def reducing(data: Mapping[str, Any]) -> Symbol:
    """A reducing valve."""
    body = path("M-12 -12 H12 V12 H-12 Z M0 -20 V-12 M0 12 V20") + arrow(0, 12, -12)
    body += path(f"M12 0 {SPRING}") + path("M0 -17 H-18 V0 H-12", "dashed")
    drain = "T" in (data.get("ports") or {})
    body += path("M8 12 V16 H30 V20") if drain else ""
    below = {"P": 0.0} | ({"T": 30.0} if drain else {})
    return Symbol(body, 30.0 if drain else 27.0, 20.0, {"A": 0.0}, below, settings=in_bar(data, "pressure"))


def compensator(data: Mapping[str, Any]) -> Symbol:
    """A pressure compensator."""
    body = path("M-12 -12 H12 V12 H-12 Z M0 -20 V-12 M0 12 V20") + arrow(0, 12, -12)
    body += path(f"M12 0 {SPRING}") + path("M0 -17 H-18 V0 H-12 M26 0 H34 V20", "dashed")
    return Symbol(body, 34.0, 20.0, {"A": 0.0}, {"P": 0.0, "LS": 34.0}, settings=in_bar(data, "margin"))


def counterbalance(data: Mapping[str, Any]) -> Symbol:
    """A counterbalance valve with its check valve."""
    square = path("M-26 -10 H-6 V10 H-26 Z") + arrow(-20, -10, 10) + path("M-6 0 l2 -4 l3 8 l3 -8 l2 4")
    sides = path("M0 -26 V-18 M-16 -10 V-18 H20 V-9 M0 26 V18 M-16 10 V18 H20 V9")
    check = path("M20 9 V6 M13 -3 L20 6 L27 -3 M20 -6 V-9") + '<circle cx="20" cy="-1.5" r="4"/>'
    pilots = path("M-16 -15 H-30 V-4 H-26 M-36 26 V4 H-26", "dashed")
    frame = path("M-33 -22 H31 V22 H-33 Z", "frame")
    body, below = square + sides + check + pilots + frame, {"V": 0.0, "X": -36.0}
    if data.get("pilot_orifice") is not None:
        body += path("M-40 12 Q-36 15.5 -40 19 M-32 12 Q-36 15.5 -32 19")
    if "T" in (data.get("ports") or {}):
        body, below = body + path("M5 0 H10 V26", "dashed"), {**below, "T": 10.0}
    return Symbol(body, 40.0, 26.0, {"L": 0.0}, below, settings=in_bar(data, "opens_at"))


def pump(data: Mapping[str, Any]) -> Symbol:
    """A pump, or a source of flow."""
    body = _circle(16.0) + path("M0 -16 l-6 10 h12 z", "full") + path("M0 -24 V-16 M0 16 V24 M-16 -2 H-26 M-16 2 H-26")
    if data.get("margin") is not None or varies(data, "setting") or data.get("setting", 1.0) != 1.0:
        body += adjustable(-15, 17, 17, -17)
    if _has_two_ways(data):
        body += path("M0 16 l-6 -10 h12 z", "full")
    ports = data.get("ports") or {}
    sensed = {port: 30.0 + 10.0 * k for k, port in enumerate(port for port in ("LS", "X") if port in ports)}
    body += (
        path(" ".join(f"M16 {5.0 * k:g} H{x:g} V-24" for k, x in enumerate(sensed.values())), "dashed")
        if sensed
        else ""
    )
    drain = {"L": 14.0} if "L" in ports else {}
    body += path("M10 12.5 L14 17 V24", "dashed") if drain else ""
    wide = max([26.0, *sensed.values()])
    below = {"A": 0.0} | drain
    return Symbol(body, wide, 24.0, {"B": 0.0} | sensed, below, "supply", _displacement(data))


def _has_two_ways(data: Mapping[str, Any]) -> bool:
    """Whether a pump swings over centre: it is told to, or its setting varies with nothing that bounds it to one way."""
    least = data.get("least_setting")
    if least is not None:
        return least < 0.0
    return data.get("frequency") is not None and data.get("margin") is None and varies(data, "setting")


def engine(data: Mapping[str, Any]) -> Symbol:
    """A combustion engine."""
    body = path("M-18 -18 H18 V18 H-18 Z M-8 -18 V18 M-8 4 H-18 M18 -2 H28 M18 2 H28")
    return Symbol(body, 28.0, 18.0, {}, {}, "supply", _setting(data, "speed", 30.0 / pi, "rpm"), "M")


def motor(data: Mapping[str, Any]) -> Symbol:
    """A hydraulic motor."""
    body = _circle(16.0) + path("M-6 0 l-10 -6 v12 z M6 0 l10 -6 v12 z", "full")
    body += path("M-16 0 H-26 V24 M16 0 H26 V24 M-2 -16 V-24 M2 -16 V-24")
    if varies(data, "setting"):
        body += adjustable(-15, 17, 17, -17)
    drain = {"L": 12.0} if "L" in (data.get("ports") or {}) else {}
    body += path("M10 12.5 L12 16 V24", "dashed") if drain else ""
    return Symbol(body, 26.0, 24.0, {}, {"A": -26.0, "B": 26.0} | drain, "actuator", _displacement(data))


def cylinder(data: Mapping[str, Any]) -> Symbol:
    """A cylinder."""
    body = path("M-46 -14 H22 V14 H-46 Z M-18 -14 V14 M-12 -14 V14 M-12 -3 H48 V3 H-12 M-38 14 V22")
    if data.get("cushion_A"):
        body += path("M-26 -4 H-18 V4 H-26 Z")
    if data.get("cushion_B"):
        body += path("M-12 -6 H-4 V6 H-12 Z")
    both = data.get("acting") not in ("single", "plunger")
    if data.get("acting") == "plunger":
        body = path("M-46 -14 H22 V-8 M-46 -14 V14 H22 V8 M-34 -8 H48 V8 H-34 Z M-38 14 V22")
        return Symbol(body, 48.0, 22.0, {}, {"A": -38.0}, "actuator")
    body += path("M14 14 V22") if both else path("M-12 0 m2 9 l6 -18 l6 18 l6 -18 l6 18 l4 -9")
    return Symbol(body, 48.0, 22.0, {}, {"A": -38.0} | ({"B": 14.0} if both else {}), "actuator")


def telescope(_: Mapping[str, Any]) -> Symbol:
    """A telescopic cylinder."""
    body = path("M-46 -14 H6 V14 H-46 Z M-30 -14 V14 M-30 -8 H28 V8 H-30 M-22 -8 V8 M-22 -3 H48 V3 H-22 M-38 14 V22")
    return Symbol(body, 48.0, 22.0, {}, {"A": -38.0}, "actuator")


def rotary(_: Mapping[str, Any]) -> Symbol:
    """A rotary actuator."""
    body = path("M-18 6 A18 18 0 0 1 18 6 Z M0 -12 V-20 M-10 6 V22 M10 6 V22 M0 6 L8 -6")
    return Symbol(body, 18.0, 22.0, {}, {"A": -10.0, "B": 10.0}, "actuator")


def accumulator(data: Mapping[str, Any]) -> Symbol:
    """An accumulator."""
    body = path("M-10 -10 A10 10 0 0 1 10 -10 V6 A10 10 0 0 1 -10 6 Z M-10 -2 H10 M0 16 V22 M-4 -8 h8 l-4 5 z")
    return Symbol(body, 10.0, 22.0, {}, {"A": 0.0}, "supply", _setting(data, "volume", 1e3, "L"))


def cooler(_: Mapping[str, Any]) -> Symbol:
    """A cooler: heat leaves on both sides."""
    body = path("M0 -14 L14 0 L0 14 L-14 0 Z M0 -20 V20") + path("M-14 0 l6 -4 v8 z M14 0 l-6 -4 v8 z", "full")
    return Symbol(body, 14.0, 20.0, {"B": 0.0}, {"A": 0.0})


def shuttle(_: Mapping[str, Any]) -> Symbol:
    """A load-sensing signal."""
    body = path("M-18 -8 H18 V8 H-18 Z M-10 -4 L-5 0 L-10 4 M10 -4 L5 0 L10 4") + _circle(4.0)
    return Symbol(body + path("M0 -16 V-8", "dashed"), 18.0, 16.0, {"LS": 0.0}, {}, "supply")


def source(_: Mapping[str, Any]) -> Symbol:
    """A supply of constant pressure."""
    body = _circle(12.0) + path("M0 -12 l-6 10 h12 z", "full") + path("M0 -12 V-18")
    return Symbol(body, 12.0, 18.0, {"P": 0.0}, {}, "supply")


def directional(data: Mapping[str, Any]) -> Symbol:
    """A directional valve."""
    body, wide, high, above, below = directional_valve(data)
    return Symbol(body, wide, high, above, below, "valve", (str(data["ways"]),))


def box(word: str, ports: Sequence[str]) -> Symbol:
    """A box with a word in it, for components without a symbol: every second port above, those that feel a pressure below."""
    flowing = [port for port in ports if port not in SENSING]
    above, below = flowing[1::2], [*flowing[::2], *(port for port in ports if port in SENSING)]
    wide = max(0.5 * LETTER * len(word) + 6.0, 0.5 * PIN * max(len(above), len(below)))

    def spread(side: Sequence[str]) -> dict[str, float]:
        return {port: PIN * (k - 0.5 * (len(side) - 1)) for k, port in enumerate(side)}

    pins = (spread(above), spread(below))
    lines = [*(f"M{x:g} -18 V-26" for x in pins[0].values()), *(f"M{x:g} 18 V26" for x in pins[1].values())]
    body = path(" ".join([f"M{-wide:g} -18 H{wide:g} V18 H{-wide:g} Z", *lines]))
    return Symbol(body, wide, 26.0, *pins, text=word)


def flipped(symbol: Symbol) -> Symbol:
    """The same symbol upside down."""
    body = f'<g transform="scale(1 -1)">{symbol.body}</g>'
    return replace(symbol, body=body, above=symbol.below, below=symbol.above)
