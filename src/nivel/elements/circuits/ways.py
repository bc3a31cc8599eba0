"""Ways of directional valves, and the symbol of those: a box for each position, with the ways that it joins."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import hypot
from typing import Any, Final, Literal

from nivel.elements.circuits.symbol import Symbol, path
from nivel.lazy import replace

Ways = Literal["2/2", "3/2", "4/2", "4/3", "5/2", "5/3"]
Centre = Literal["closed", "tandem", "open", "float"]
PORTS: Final[dict[str, tuple[str, ...]]] = {
    "2/2": ("P", "A"),
    "3/2": ("P", "T", "A"),
    "4/2": ("P", "T", "A", "B"),
    "4/3": ("P", "T", "A", "B"),
    "5/2": ("P", "A", "B", "R", "S"),
    "5/3": ("P", "A", "B", "R", "S"),
}
# valves with a centre, whose positions go from -1 to 1
CENTRED: Final = ("4/3", "5/3")
# edges that open with a position from 0 to 1 (of centred valves), with one from 0 to -1 (of others: that close towards 1)
EDGES: Final[dict[str, tuple[tuple[str, ...], tuple[str, ...]]]] = {
    "2/2": (("PA",), ()),
    "3/2": (("PA",), ("AT",)),
    "4/2": (("PA", "BT"), ("PB", "AT")),
    "4/3": (("PA", "BT"), ("PB", "AT")),
    "5/2": (("PA", "BS"), ("PB", "AR")),
    "5/3": (("PA", "BS"), ("PB", "AR")),
}
CENTRES: Final[dict[str, tuple[str, ...]]] = {
    "closed": (),
    "tandem": ("PT",),
    "open": ("PT", "AT", "BT"),
    "float": ("AT", "BT"),
}
OF_FIVE: Final = {"AT": "AR", "BT": "BS"}  # outlets of A and B in valves with five ports


def centre_pairs(ways: str, centre: str) -> tuple[str, ...]:
    """Pairs of ports that are joined at the centre."""
    pairs = CENTRES.get(centre, ())
    return tuple(OF_FIVE.get(pair, pair) for pair in pairs) if ways == "5/3" else pairs


BOX, STUB = 30.0, 6.0  # side of a box; a line that ends in it
# x of ports from the middle of a box: those above it and those below
TOP: Final = {"2/2": {"A": 0.0}, "3/2": {"A": -8.0}}
BOTTOM: Final = {"2/2": {"P": 0.0}, "5/2": {"R": -11.0, "P": 0.0, "S": 11.0}}
USUAL_TOP: Final = {"A": -8.0, "B": 8.0}
USUAL_BOTTOM: Final = {"P": -8.0, "T": 8.0}


def directional_valve(data: Mapping[str, Any]) -> Symbol:
    """A valve, whose lines meet the box of its rest."""
    ways, centred = str(data["ways"]), data["ways"] in CENTRED
    forward, back = EDGES[ways]
    groups = [forward, centre_pairs(ways, str(data.get("centre") or "closed")), back] if centred else [forward, back]
    top, bottom = TOP.get(ways, USUAL_TOP), BOTTOM.get(ways.replace("5/3", "5/2"), USUAL_BOTTOM)
    drawn = boxes(groups, top, bottom, BOX)
    if not centred:
        return replace(drawn, wide=drawn.wide - 12.0)
    end, high = drawn.wide - 26.0, 0.5 * BOX + 3.0
    proportional = path(f"M{-end:g} {-high:g} H{end:g} M{-end:g} {high:g} H{end:g}")
    return replace(drawn, body=drawn.body + proportional) if data.get("frequency") is not None else drawn


def spool(groups: Sequence[Sequence[tuple[str, str]]], top: Sequence[str], bottom: Sequence[str]) -> Symbol:
    """A spool with any ports. groups : pairs that it joins in each box."""
    wide = max(BOX, 16.0 * max(len(top), len(bottom), 2))

    def spread(side: Sequence[str]) -> dict[str, float]:
        step = wide / max(len(side), 1) if len(side) > 2 else 16.0
        return {port: step * (k - 0.5 * (len(side) - 1)) for k, port in enumerate(side)}

    return boxes(groups, spread(top), spread(bottom), wide)


def boxes(
    groups: Sequence[Sequence[str | tuple[str, str]]],
    top: Mapping[str, float],
    bottom: Mapping[str, float],
    wide: float,
) -> Symbol:
    """A box for each group of joined pairs, the second at rest. top, bottom : x of ports from the middle of a box of this width.

    With three boxes solenoids act on both sides, and springs centre it.
    """
    first, high = -0.5 * wide * (len(groups) - 1), 0.5 * BOX
    rest, end = first + wide, 0.5 * wide * len(groups)
    body = "".join(line for k, pairs in enumerate(groups) for line in _box(first + k * wide, wide, pairs, top, bottom))
    body += "".join(path(f"M{rest + x:g} {-high:g} v-6") for x in top.values())
    body += "".join(path(f"M{rest + x:g} {high:g} v6") for x in bottom.values())
    body += _solenoid(-end, -1.0)
    if len(groups) > 2:
        body += _solenoid(end, 1.0) + _centring(-end, -1.0) + _centring(end, 1.0)
    else:
        body += path(f"M{end:g} 0 l2 -5 l3 10 l3 -10 l3 10 l2 -5")
    above, below = ({port: rest + x for port, x in side.items()} for side in (top, bottom))
    return Symbol(body, end + 26.0, high + 6.0, above, below, "valve")


def _box(
    x: float, wide: float, pairs: Sequence[str | tuple[str, str]], top: Mapping[str, float], bottom: Mapping[str, float]
) -> Iterator[str]:
    """A box with arrows of what it joins and stubs of what it closes."""
    high = 0.5 * BOX
    yield path(f"M{x - 0.5 * wide:g} {-high:g} h{wide:g} v{BOX:g} h{-wide:g} z")
    place = {port: (x + at, -high) for port, at in top.items()} | {port: (x + at, high) for port, at in bottom.items()}
    for a, b in pairs:
        yield _way(place[a], place[b])
    joined = {port for pair in pairs for port in pair}
    for port, (px, py) in place.items():
        if port not in joined:
            yield path(f"M{px:g} {py:g} v{STUB if py < 0.0 else -STUB:g} m-3 0 h6")


def _way(start: tuple[float, float], end: tuple[float, float]) -> str:
    """An arrow between two ports; where both are below, a line through the box."""
    (x0, y0), (x1, y1) = start, end
    if y0 == y1:
        return path(f"M{x0:g} {y0:g} V0 H{x1:g} V{y1:g}")
    length = hypot(x1 - x0, y1 - y0)
    ux, uy = (x1 - x0) / length, (y1 - y0) / length
    bx, by = x1 - 6.0 * ux, y1 - 6.0 * uy
    tip = f"M{x1:g} {y1:g} L{bx - 2.6 * uy:.1f} {by + 2.6 * ux:.1f} L{bx + 2.6 * uy:.1f} {by - 2.6 * ux:.1f} z"
    return path(f"M{x0:g} {y0:g} L{bx:.1f} {by:.1f}") + path(tip, "full")


def _solenoid(x: float, side: float) -> str:
    return path(f"M{x:g} -6 h{12 * side:g} v12 h{-12 * side:g} M{x + 3 * side:g} 6 l{6 * side:g} -12")


def _centring(x: float, side: float) -> str:
    """A spring beside a solenoid."""
    at = x + 12 * side
    return path(f"M{at:g} 0 l{2 * side:g} -5 l{3 * side:g} 10 l{3 * side:g} -10 l{3 * side:g} 10 l{side:g} -5")
