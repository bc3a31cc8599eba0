"""Rows and columns of the parts of a circuit: actuators above, then what holds their loads, directional valves, what is before them, and
pumps below; each part near to those that it is connected with."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from nivel.elements.circuits.symbol import flipped
from nivel.looks.circuit.parts import Circuit, Part

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
