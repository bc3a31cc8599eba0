"""The components and nodes of a circuit as they are drawn: which symbol has a pin on which line."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Final

from nivel.looks.circuit.symbols import SYMBOLS, Symbol

SENSING: Final = ("LS", "X")  # ports that only feel a pressure: dashed lines
CHAMBERED: Final = ("cylinder", "telescopic-cylinder", "rotary-actuator")
ACTUATORS: Final = (*CHAMBERED, "hydraulic-motor")
HIGHEST: Final = 5e5  # Pa; a tank of a constant pressure above is a supply, others have a symbol at each of their pins
# what is said of a component below its name: key, factor and unit
SETTINGS: Final[Mapping[str, tuple[str, float, str]]] = {
    "relief-valve": ("opens_at", 1e-5, "bar"),
    "counterbalance-valve": ("opens_at", 1e-5, "bar"),
    "reducing-valve": ("pressure", 1e-5, "bar"),
    "compensator": ("margin", 1e-5, "bar"),
    "pump": ("displacement", 6.283185307179586e6, "cm³/rev"),
    "hydraulic-motor": ("displacement", 6.283185307179586e6, "cm³/rev"),
    "accumulator": ("volume", 1e3, "L"),
    "directional-valve": ("ways", 1.0, ""),
}
CHARACTER: Final = 6.4  # px, at 11 px
VALUE: Final = "000.0 bar"  # room for a pressure
LETTERS: Final = 22  # of a name that are shown


@dataclass
class Part:
    """One symbol. lines : the node at each of its pins. words : what is said below its name, each with the result variable of a pressure
    or with "". row : from above; column : from the left; x, y : of its middle [px]."""

    name: str
    type: str
    symbol: Symbol
    lines: dict[str, str]
    words: tuple[tuple[str, str], ...] = ()
    row: int = 0
    column: int = 0
    x: float = 0.0
    y: float = 0.0

    @property
    def label(self) -> str:
        """Its name, cut where it is long."""
        return self.name if len(self.name) <= LETTERS else f"{self.name[: LETTERS - 1]}…"

    @property
    def label_width(self) -> float:
        """[px] of name and setting."""
        return CHARACTER * max(
            len(self.label), *(len(text) + len(VALUE) * (variable != "") for text, variable in self.words), 0
        )


@dataclass
class Circuit:
    """Parts. drains : nodes that are drawn as a tank at every pin. values : result variables of the pressures of volumes, which are lines
    alone."""

    parts: list[Part]
    drains: frozenset[str]
    values: dict[str, str] = field(default_factory=dict)

    def pins(self) -> Iterator[tuple[str, Part, str]]:
        """(node, part, port) of every pin."""
        for part in self.parts:
            for port, node in part.lines.items():
                yield node, part, port


def circuit_of(record: Mapping[str, Any]) -> Circuit:
    """The circuit of a machine record as JSON."""
    components = list(record.get("hydraulics") or ())
    parts, drains, values = [], set(), {}
    for data in components:
        kind, name = str(data["type"]), str(data["name"])
        if kind == "tank" and not _is_supply(data):
            drains.add(name)
        if kind == "volume":
            values[name] = f"hydraulics.{name}.pressure"
        if kind in SYMBOLS and name not in drains:
            lines = _lines(data, kind, name)
            parts.append(Part(name, kind, SYMBOLS[kind](data), lines, tuple(_words(data, kind, lines))))
    return Circuit(parts, frozenset(drains), values)


def _is_supply(tank: Mapping[str, Any]) -> bool:
    pressure = tank.get("pressure")
    return not isinstance(pressure, float | int) or pressure > HIGHEST


def _lines(data: Mapping[str, Any], kind: str, name: str) -> dict[str, str]:
    """The node at each pin of the symbol."""
    ports = {str(port): str(node) for port, node in (data.get("ports") or {}).items()}
    if kind in CHAMBERED:
        symbol = SYMBOLS[kind](data)
        return {port: ports.get(port, f"{name}.{port}") for port in (*symbol.above, *symbol.below)}
    return ports | {"tank": {"P": name}, "load-sensing": {"LS": name}}.get(kind, {})


def _words(data: Mapping[str, Any], kind: str, lines: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """The setting of a component in a few letters, and its pressures."""
    name = data["name"]
    if kind == "pipe":
        yield f"{data['length']:.3g} m × {1e3 * data['diameter']:.3g} mm", ""
    key, factor, unit = SETTINGS.get(kind, ("", 1.0, ""))
    value = data.get(key)
    if isinstance(value, float | int):
        yield f"{factor * value:.4g} {unit}", ""
    elif kind == "directional-valve":
        yield str(value), ""
    if kind in ("tank", "accumulator", "load-sensing"):
        yield "", f"hydraulics.{name}.pressure"
    if kind in CHAMBERED:
        for port in lines:
            if port not in (data.get("ports") or {}):
                yield f"{port} ", f"hydraulics.{name}.pressure_{port}"
