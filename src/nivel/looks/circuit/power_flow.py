"""Power flow of a circuit over a run as a Sankey diagram: engines, pumps and supplies, the circuit, what it loses where, and bodies.

Widths are energies. What components lose by their flows and differences of pressure is not all: friction of pistons, heat through walls and
what is told of fluid that is compressed are the rest.
"""

from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Final

from nivel.lazy import Struct

WIDE, BAR, GAP, TOP, HIGH = 830.0, 12.0, 9.0, 26.0, 260.0
COLUMNS: Final = (120.0, 300.0, 430.0, 560.0)  # x of the bars: engines, pumps and other sources, the circuit, sinks
MOST: Final = 9  # sinks that are named, the largest ones
LEAST: Final = 1e-3  # share of the whole below which nothing is drawn
SOURCE, LOSS, WORK, STORE = "#2f6fb3", "#c0392b", "#2e8b57", "#b8860b"
STYLE: Final = Path(__file__).with_suffix(".css").read_text(encoding="utf-8")


class Stream(Struct):
    """An energy [J] over a run by its name. kind : SOURCE, LOSS, WORK or STORE. engine : that turns a pump, "" without one."""

    name: str
    energy: float
    kind: str
    engine: str = ""


class PowerFlow(Struct):
    """What goes into a circuit and what comes out of it over a run of `duration` [s]; both have the same sum."""

    sources: tuple[Stream, ...]
    sinks: tuple[Stream, ...]
    duration: float

    @property
    def whole(self) -> float:
        """[J] that goes through."""
        return sum(each.energy for each in self.sources)


class _Bar(Struct):
    x: float
    y: float
    high: float


def power_diagram(flow: PowerFlow) -> str:
    """SVG of a power flow; empty where no energy flows."""
    whole = flow.whole
    if not whole > 0.0 or not flow.sinks:
        return ""
    sinks = _gathered(flow.sinks, whole)
    sources = tuple(each for each in flow.sources if each.energy > LEAST * whole)
    scale = HIGH / whole
    column = _stacked(sources, COLUMNS[1], scale)
    ends = _stacked(sinks, COLUMNS[3], scale)
    circuit = _Bar(COLUMNS[2], TOP, HIGH)
    body = [
        _bar(circuit, SOURCE),
        f'<text x="{COLUMNS[2] + 0.5 * BAR:g}" y="{TOP - 8:g}" text-anchor="middle">circuit</text>',
    ]
    body += _joined(sources, column, circuit, scale)
    body += _engines(sources, column, scale)
    at = circuit.y
    for each, end in zip(sinks, ends, strict=True):
        body.append(_band((circuit.x + BAR, at), (end.x, end.y), end.high, each.kind))
        body.append(_bar(end, each.kind) + _label(each, end, flow.duration, right=True))
        at += end.high
    bottom = max(bar.y + bar.high for bar in (*column, *ends, circuit)) + 10.0
    left = 0.0 if any(each.engine for each in sources) else 100.0
    view = f'viewBox="{left:g} 0 {WIDE - left:g} {bottom:.0f}" width="{WIDE - left:g}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" class="power" {view}'
    return f'{head} role="img" aria-label="power flow"><style>{STYLE}</style>{"".join(body)}</svg>'


def _gathered(sinks: Sequence[Stream], whole: float) -> tuple[Stream, ...]:
    """The largest sinks, losses first, and the others together."""
    order = {LOSS: 0, STORE: 1, WORK: 2}
    kept = sorted(sinks, key=lambda each: -each.energy)
    named = [each for each in kept[:MOST] if each.energy > LEAST * whole]
    left = sum(each.energy for each in kept if each not in named)
    if left > LEAST * whole:
        named.append(Stream("others", left, LOSS))
    return tuple(sorted(named, key=lambda each: (order[each.kind], -each.energy)))


def _stacked(streams: Sequence[Stream], x: float, scale: float) -> list[_Bar]:
    """Bars of a column one below the other, with room for their labels."""
    out, y = [], TOP
    for each in streams:
        high = each.energy * scale
        out.append(_Bar(x, y, high))
        y += max(high, 13.0) + GAP
    return out


def _joined(sources: Sequence[Stream], bars: Sequence[_Bar], circuit: _Bar, scale: float) -> list[str]:
    out, at = [], circuit.y
    for each, bar in zip(sources, bars, strict=True):
        out.append(_band((bar.x + BAR, bar.y), (circuit.x, at), bar.high, SOURCE))
        out.append(_bar(bar, each.kind))
        at += each.energy * scale
    return out


def _engines(sources: Sequence[Stream], bars: Sequence[_Bar], scale: float) -> list[str]:
    """The bars of engines, with the bands to their pumps; and the labels of all sources."""
    names = list(dict.fromkeys(each.engine for each in sources if each.engine))
    out, y = [], TOP
    for name in names:
        own = [(each, bar) for each, bar in zip(sources, bars, strict=True) if each.engine == name]
        whole = Stream(name, sum(each.energy for each, _ in own), SOURCE)
        bar = _Bar(COLUMNS[0], y, whole.energy * scale)
        at = y
        for _, pump in own:
            out.append(_band((bar.x + BAR, at), (pump.x, pump.y), pump.high, SOURCE))
            at += pump.high
        out += [_bar(bar, SOURCE), _label(whole, bar, 0.0, right=False)]
        y += max(bar.high, 13.0) + GAP
    out += [_label(each, bar, 0.0, right=False) for each, bar in zip(sources, bars, strict=True)]
    return out


def _bar(bar: _Bar, colour: str) -> str:
    return f'<rect x="{bar.x:.1f}" y="{bar.y:.1f}" width="{BAR:g}" height="{max(bar.high, 0.8):.1f}" fill="{colour}"/>'


def _band(begin: tuple[float, float], end: tuple[float, float], high: float, colour: str) -> str:
    """A band from the point `begin` at its upper left to `end` at its upper right."""
    (x0, y0), (x1, y1), high = begin, end, max(high, 0.6)
    middle = 0.5 * (x0 + x1)
    d = f"M{x0:.1f} {y0:.1f} C{middle:.1f} {y0:.1f} {middle:.1f} {y1:.1f} {x1:.1f} {y1:.1f} V{y1 + high:.1f} "
    d += f"C{middle:.1f} {y1 + high:.1f} {middle:.1f} {y0 + high:.1f} {x0:.1f} {y0 + high:.1f} Z"
    return f'<path d="{d}" fill="{colour}" fill-opacity="0.3"/>'


def _label(each: Stream, bar: _Bar, duration: float, *, right: bool) -> str:
    x, anchor = (bar.x + BAR + 5.0, "start") if right else (bar.x - 5.0, "end")
    y = bar.y + max(0.5 * bar.high, 5.0) + 4.0
    mean = f", {_shown(each.energy / duration, 'W')}" if duration else ""
    number = f'<tspan class="words"> {_shown(each.energy, "J")}{mean}</tspan>'
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{escape(each.name)}{number}</text>'


def _shown(value: float, unit: str) -> str:
    for factor, prefix in ((1e6, "M"), (1e3, "k")):
        if value >= factor:
            return f"{value / factor:.3g} {prefix}{unit}"
    return f"{value:.3g} {unit}"


def power_flow(
    balances: Sequence[Mapping[str, float | str]],
    totals: Mapping[str, float],
    engines: Mapping[str, str],
    duration: float,
) -> PowerFlow:
    """The flow of what components take, give and lose. balances : name, type, supplied, delivered, lost [J] of each. totals [J] : supplied
    by shafts and supplies, and stored, by the whole circuit. engines : of pumps, by their names."""
    sources, sinks = [], []
    shafts = 0.0
    for each in balances:
        if each["type"] == "engine":  # what it gives is what its pumps take
            continue
        name, supplied, delivered = str(each["name"]), float(each["supplied"]), float(each["delivered"])
        turned = str(each["type"]) in ("pump", "hydraulic-motor", "flow-source")
        shafts += supplied - delivered if turned else 0.0
        if supplied > 0.0:
            sources.append(Stream(name, supplied, SOURCE, engines.get(name, "")))
        if delivered > 0.0:
            sinks.append(Stream(name, delivered, WORK))
        elif delivered < 0.0:
            sources.append(Stream(f"{name}, from bodies", -delivered, WORK))
        if float(each["lost"]) > 0.0:
            sinks.append(Stream(f"{name}, lost", float(each["lost"]), LOSS))
    for name, energy, kind in (
        ("supplies and tanks", totals["supplied"] - shafts, SOURCE),
        ("stored", -totals["stored"], STORE),
    ):
        if energy > 0.0:
            sources.append(Stream(name, energy, kind))
        elif energy < 0.0:
            sinks.append(Stream(name, -energy, LOSS if kind == SOURCE else STORE))
    rest = sum(each.energy for each in sources) - sum(each.energy for each in sinks)
    if rest > 0.0:
        sinks.append(Stream("friction of pistons, rest", rest, LOSS))
    elif rest < 0.0:
        # what is told of components is more than the circuit lost: flows times differences of pressure of fluid that is compressed
        lost = sum(each.energy for each in sinks if each.kind == LOSS)
        share = max(0.0, 1.0 + rest / lost) if lost else 0.0
        sinks = [Stream(each.name, each.energy * share, each.kind) if each.kind == LOSS else each for each in sinks]
    return PowerFlow(tuple(sorted(sources, key=lambda each: -each.energy)), tuple(sinks), duration)
