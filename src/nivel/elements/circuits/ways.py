"""Ways of directional valves, and the symbol of those: a box for each position, with the ways that it joins."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import hypot
from typing import Any, Final, Literal

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


def directional_valve(data: Mapping[str, Any]) -> tuple[str, float, float, dict[str, float], dict[str, float]]:
    """(body, half width, half height, ports above, ports below) of a valve; its lines meet the box of its rest."""
    ways, centre = str(data["ways"]), str(data.get("centre") or "closed")
    top = TOP.get(ways, USUAL_TOP)
    bottom = BOTTOM.get(ways.replace("5/3", "5/2"), USUAL_BOTTOM)
    forward, back = EDGES[ways]
    centred = ways in CENTRED
    boxes = [forward, centre_pairs(ways, centre), back] if centred else [forward, back]
    first = -0.5 * BOX * (len(boxes) - 1)
    body = "".join(
        line for k, pairs in enumerate(boxes) for line in _box(first + k * BOX, pairs, PORTS[ways], top, bottom)
    )
    rest = 0.0 if centred else first + BOX
    half = 0.5 * BOX
    body += "".join(f'<path d="M{rest + x:g} {-half:g} v-6"/>' for x in top.values())
    body += "".join(f'<path d="M{rest + x:g} {half:g} v6"/>' for x in bottom.values())
    end = -first + half
    body += _solenoid(-end, -1.0) + (_solenoid(end, 1.0) if centred else _spring(end))
    if centred:
        body += _centring(-end, -1.0) + _centring(end, 1.0)
    if centred and data.get("frequency") is not None:
        body += f'<path d="M{-end:g} {-half - 3:g} H{end:g} M{-end:g} {half + 3:g} H{end:g}"/>'
    above, below = ({port: rest + x for port, x in side.items()} for side in (top, bottom))
    return body, end + (26.0 if centred else 14.0), half + 6.0, above, below


def boxes(
    groups: Sequence[Sequence[tuple[str, str]]], top: Sequence[str], bottom: Sequence[str], spring: str
) -> tuple[str, float, float, dict[str, float], dict[str, float]]:
    """As `directional_valve`, of a spool with any ports.

    groups : pairs that it joins in each box, of which the second is at rest. spring : of "one" side, or of "both": solenoids act on both.
    """
    count = max(len(top), len(bottom), 2)
    wide = max(BOX, 16.0 * count)
    half = 0.5 * wide
    first = -0.5 * wide * (len(groups) - 1)
    rest = first + wide

    def spread(side: Sequence[str]) -> dict[str, float]:
        step = wide / max(len(side), 1) if len(side) > 2 else 16.0
        return {port: step * (k - 0.5 * (len(side) - 1)) for k, port in enumerate(side)}

    above, below = spread(top), spread(bottom)
    body = "".join(
        line for k, pairs in enumerate(groups) for line in _wide_box(first + k * wide, half, pairs, above, below)
    )
    body += "".join(f'<path d="M{rest + x:g} {-0.5 * BOX:g} v-6"/>' for x in above.values())
    body += "".join(f'<path d="M{rest + x:g} {0.5 * BOX:g} v6"/>' for x in below.values())
    end = 0.5 * wide * len(groups)
    body += _solenoid(-end, -1.0) + (_solenoid(end, 1.0) if spring == "both" else _spring(end))
    if spring == "both":
        body += _centring(-end, -1.0) + _centring(end, 1.0)
    up, down = ({port: rest + x for port, x in side.items()} for side in (above, below))
    return body, end + 26.0, 0.5 * BOX + 6.0, up, down


def _wide_box(
    x: float, half: float, pairs: Sequence[tuple[str, str]], top: Mapping[str, float], bottom: Mapping[str, float]
) -> Iterator[str]:
    high = 0.5 * BOX
    yield f'<path d="M{x - half:g} {-high:g} h{2 * half:g} v{BOX:g} h{-2 * half:g} z"/>'
    place = {port: (x + at, -high) for port, at in top.items()} | {port: (x + at, high) for port, at in bottom.items()}
    for a, b in pairs:
        yield _way(place[a], place[b])
    joined = {port for pair in pairs for port in pair}
    for port, (px, py) in place.items():
        if port not in joined:
            yield f'<path d="M{px:g} {py:g} v{STUB if py < 0.0 else -STUB:g} m-3 0 h6"/>'


def _centring(x: float, side: float) -> str:
    """A spring beside a solenoid."""
    return f'<path d="M{x + 12 * side:g} 0 l{2 * side:g} -5 l{3 * side:g} 10 l{3 * side:g} -10 l{3 * side:g} 10 l{side:g} -5"/>'


def _box(
    x: float, pairs: tuple[str, ...], ports: tuple[str, ...], top: Mapping[str, float], bottom: Mapping[str, float]
) -> Iterator[str]:
    """A box with arrows of what it joins and stubs of what it closes."""
    half = 0.5 * BOX
    yield f'<path d="M{x - half:g} {-half:g} h{BOX:g} v{BOX:g} h{-BOX:g} z"/>'
    place = {port: (x + at, -half) for port, at in top.items()} | {port: (x + at, half) for port, at in bottom.items()}
    for pair in pairs:
        yield _way(place[pair[0]], place[pair[1]])
    for port in ports:
        if not any(port in pair for pair in pairs):
            px, py = place[port]
            inward = STUB if py < 0.0 else -STUB
            yield f'<path d="M{px:g} {py:g} v{inward:g} m-3 0 h6"/>'


def _way(start: tuple[float, float], end: tuple[float, float]) -> str:
    """An arrow between two ports; where both are below, a line through the box."""
    (x0, y0), (x1, y1) = start, end
    if y0 == y1:
        return f'<path d="M{x0:g} {y0:g} V0 H{x1:g} V{y1:g}"/>'
    length = hypot(x1 - x0, y1 - y0)
    ux, uy = (x1 - x0) / length, (y1 - y0) / length
    bx, by = x1 - 6.0 * ux, y1 - 6.0 * uy
    tip = f"M{x1:g} {y1:g} L{bx - 2.6 * uy:.1f} {by + 2.6 * ux:.1f} L{bx + 2.6 * uy:.1f} {by - 2.6 * ux:.1f} z"
    return f'<path d="M{x0:g} {y0:g} L{bx:.1f} {by:.1f}"/><path class="full" d="{tip}"/>'


def _solenoid(x: float, side: float) -> str:
    return f'<path d="M{x:g} -6 h{12 * side:g} v12 h{-12 * side:g} M{x + 3 * side:g} 6 l{6 * side:g} -12"/>'


def _spring(x: float) -> str:
    return f'<path d="M{x:g} 0 l2 -5 l3 10 l3 -10 l3 10 l2 -5"/>'
