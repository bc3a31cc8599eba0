"""The diagram of the circuits of a machine as SVG, with a pressure at every node."""

from collections.abc import Iterator, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any, Final

from nivel.elements.circuits.symbol import Symbol, flipped
from nivel.looks.circuit.parts import Circuit, Part, circuit_of, variable_of
from nivel.looks.circuit.routing import Drawing, Line, Router

ACTUATOR, LOAD, VALVE, BEFORE, SUPPLY = 0, 1, 2, 3, 4
RANKS: Final = {"actuator": ACTUATOR, "valve": VALVE, "supply": SUPPLY}
UPRIGHT: Final = ("actuator", "valve", "supply")  # never turned upside down
WIDEST = 7  # parts in a row
SWEEPS = 4


def place(circuit: Circuit) -> int:
    """Set row and column of every part, and turn those upside down whose lines come from the other side. Returns the number of rows."""
    ranks: dict[int, list[Part]] = {}
    for part in circuit.parts:
        ranks.setdefault(_rank(part, circuit), []).append(part)
    rows: list[list[Part]] = []
    for rank in sorted(ranks):
        parts = ranks[rank]
        rows += [parts[k : k + WIDEST] for k in range(0, len(parts), WIDEST)]
    for number, row in enumerate(rows):
        for column, part in enumerate(row):
            part.row, part.column = number, column
    for sweep in range(SWEEPS):
        for row in rows if sweep % 2 == 0 else reversed(rows):
            _settle(row, circuit)
    least = min((part.column for part in circuit.parts), default=0)
    for part in circuit.parts:
        part.column -= least
        if _is_upside_down(part, circuit):
            part.symbol = flipped(part.symbol)
    return len(rows)


def _rank(part: Part, circuit: Circuit) -> int:
    row = part.symbol.row
    if row in RANKS:
        return RANKS[row]
    of_actuators = {node for node, other, _ in circuit.pins() if other.symbol.row == "actuator"}
    at_load = [node in of_actuators for node in part.lines.values() if node not in circuit.drains]
    if row == "relief":
        return LOAD if at_load and all(at_load) else SUPPLY
    return LOAD if any(at_load) else BEFORE


def _settle(row: Sequence[Part], circuit: Circuit) -> None:
    """Columns of a row: each part as near as there is room to the middle of those that it is connected with in other rows."""
    wished = {id(part): _wish(part, circuit) for part in row}
    least = -(10**6)
    ordered = sorted(row, key=lambda part: (wished[id(part)], part.column))
    for part in ordered:
        # half of those that wish the same place go to its left
        same = [other for other in ordered if round(wished[id(other)]) == round(wished[id(part)])]
        shift = (len(same) - 1) // 2 if same[0] is part else 0
        part.column = max(least, round(wished[id(part)]) - shift)
        least = part.column + 1


def _wish(part: Part, circuit: Circuit) -> float:
    pull, weight = 0.0, 0.0
    for node in part.lines.values():
        if node in circuit.drains:
            continue
        others = [other for line, other, _ in circuit.pins() if line == node and other is not part]
        for other in others:
            share = (1.0 if other.row != part.row else 0.2) / len(others) ** 2
            pull, weight = pull + share * other.column, weight + share
    return pull / weight if weight else float(part.column)


def _is_upside_down(part: Part, circuit: Circuit) -> bool:
    """Whether the lines at the upper pins lead down more than those at the lower ones."""
    if part.symbol.row in UPRIGHT:
        return False

    def height(ports: Sequence[str]) -> float:
        rows = [
            float(other.row)
            for port in ports
            for line, other, _ in circuit.pins()
            if port not in part.sensing
            and line == part.lines.get(port)
            and other is not part
            and line not in circuit.drains
        ]
        return sum(rows) / len(rows) if rows else 1e3  # tanks are below all

    upper, lower = height(list(part.symbol.above)), height(list(part.symbol.below))
    return upper > lower


LARGEST = 120  # components that can be read in one drawing
COLD, KEYS = 220.0, 6  # hue of no pressure; patches of the key of colours
STYLE: Final = Path(__file__).with_suffix(".css").read_text(encoding="utf-8")


def circuit_diagram(record: Mapping[str, Any], pressures: Mapping[str, float]) -> str:
    """SVG of the circuits of a machine record as JSON; empty without one, or where it is too large to be read.

    pressures : [Pa] at the start, by the name of the result variable.
    """
    circuit = circuit_of(record)
    if not 0 < len(circuit.parts) <= LARGEST:
        return ""
    drawing = laid_out(circuit)
    size = f'viewBox="0 0 {drawing.wide:.0f} {drawing.high:.0f}" width="{drawing.wide:.0f}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" class="circuit" {size} role="img" aria-label="circuit diagram">'
    return "\n".join([head, f"<style>{STYLE}</style>", *_drawn(circuit, drawing, pressures), "</svg>"])


def laid_out(circuit: Circuit) -> Drawing:
    """Place all parts, and lay the lines between them."""
    return Router(circuit, place(circuit)).drawing()


def _drawn(circuit: Circuit, drawing: Drawing, pressures: Mapping[str, float]) -> Iterator[str]:
    highest = max(pressures.values(), default=0.0)
    for line in drawing.lines:
        yield _line(line, level=_colour(pressures.get(f"hydraulics.{variable_of(line.node)}"), highest))
    yield from (f'<circle class="full" cx="{x:.1f}" cy="{y:.1f}" r="2.4"/>' for x, y in drawing.dots)
    for x, y, up, node in drawing.tanks:
        yield _exhaust(x, y, up) if node in circuit.gases else _tank(x, y, up)
    if highest:
        yield from _key(drawing, highest)
    yield from (_symbol(part, pressures) for part in circuit.parts)
    for label in drawing.labels:
        if label.leader is not None:
            yield _line(label.leader, "leader")
        value = _pressure(circuit.values[label.node], pressures)
        yield f'<text class="node" x="{label.x:.1f}" y="{label.y:.1f}">{escape(label.node)} {value}</text>'


def _pressure(variable: str, pressures: Mapping[str, float]) -> str:
    """The pressure at the start, which the page replaces by that at the cursor."""
    value = f"{pressures[variable] / 1e5:.4g} bar" if variable in pressures else ""
    return f'<tspan data-pressure="{escape(variable.removeprefix("hydraulics."))}">{value}</tspan>'


def _line(line: Line, style: str = "", level: str = "") -> str:
    """A line of a node. level : the colour of its pressure; a line of a node with a pressure says which, so that it can change."""
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in line.points)
    words = style or " ".join(
        word for word, is_so in (("dashed", line.dashed), ("level", level and not line.dashed)) if is_so
    )
    shown = f' class="{words}"' if words else ""
    shown += f' style="stroke:{level}"' if level else ""
    shown += "" if style else f' data-level="{escape(variable_of(line.node))}"'
    return f'<polyline{shown} points="{points}"><title>{escape(line.node)}</title></polyline>'


def _colour(pressure: float | None, highest: float) -> str:
    """From blue at no pressure over green and yellow to red at the highest one; nothing where the pressure is not known."""
    if pressure is None or highest <= 0.0:
        return ""
    return f"hsl({COLD * (1.0 - min(max(pressure / highest, 0.0), 1.0)):.0f} 80% 42%)"


def _key(drawing: Drawing, highest: float) -> Iterator[str]:
    """What the colours of lines are, below the drawing; a page whose pressures change says its own highest one."""
    y = drawing.high - 4.0
    for k in range(KEYS):
        at = k / (KEYS - 1)
        x = 10.0 + 14.0 * k
        yield f'<path d="M{x:g} {y - 3:.1f} h14" style="stroke:{_colour(at, 1.0)};stroke-width:4"/>'
    words = f'0 to <tspan data-highest="{highest:.6g}">{highest / 1e5:.4g}</tspan> bar'
    yield f'<text class="key" x="{14.0 * KEYS + 16.0:g}" y="{y:.1f}">{words}</text>'


def _tank(x: float, y: float, up: bool) -> str:
    way = -1.0 if up else 1.0
    return f'<path d="M{x:.1f} {y:.1f} v{14 * way:g} m-6 -5 v5 h12 v-5"/>'


def _exhaust(x: float, y: float, up: bool) -> str:
    """A triangle that is not filled, away from what it drains: gas goes into the open."""
    way = -1.0 if up else 1.0
    return f'<path class="hollow" d="M{x:.1f} {y:.1f} v{6 * way:g} m-5 0 h10 l-5 {8 * way:g} z"/>'


def _symbol(part: Part, pressures: Mapping[str, float]) -> str:
    """A symbol with its name, settings and pressures to its right."""
    x, first = part.x + part.symbol.wide + 6.0, part.y + 4.0 - 6.5 * len(part.words)
    words = ""
    for k, (text, variable) in enumerate(part.words):
        value = _pressure(variable, pressures) if variable else ""
        words += f'<text class="words" x="{x:.1f}" y="{first + 13.0 * (k + 1):.1f}">{escape(text)}{value}</text>'
    return (
        f'<g class="symbol" transform="translate({part.x:.1f} {part.y:.1f})"><title>{escape(part.name)}: {part.type}</title>'
        f'{part.symbol.body}{_lettering(part.symbol)}</g><text class="name" x="{x:.1f}" y="{first:.1f}">{escape(part.label)}</text>{words}'
    )


def _lettering(symbol: Symbol) -> str:
    """The word in a box, and the ports at its pins."""
    if not symbol.text:
        return ""
    ports = [(port, x, y) for side, y in ((symbol.above, -9.0), (symbol.below, 15.0)) for port, x in side.items()]
    letters = (
        f'<text class="port" text-anchor="middle" x="{x:g}" y="{y:g}">{escape(port)}</text>' for port, x, y in ports
    )
    return f'<text text-anchor="middle" y="4">{escape(symbol.text)}</text>{"".join(letters)}'
