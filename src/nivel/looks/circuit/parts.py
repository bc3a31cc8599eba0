"""The components and nodes of a circuit as they are drawn: which symbol has a pin on which line."""

from collections.abc import Iterator, Mapping
from typing import Any, Final

from nivel.elements.circuits import COMPONENTS
from nivel.elements.circuits.component import SENSING
from nivel.elements.circuits.symbol import LETTER, Symbol, box
from nivel.lazy import Struct, field, replace

HIGHEST: Final = 5e5  # Pa; a tank of a constant pressure above is a supply, others have a symbol at each of their pins
VALUE: Final = "000.0 bar"  # room for a pressure
LETTERS: Final = 22  # of a name that are shown


class Part(Struct, frozen=False):
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
    def sensing(self) -> tuple[str, ...]:
        """Ports that feel a pressure and take no flow."""
        return COMPONENTS[self.type].record.sensing if self.type in COMPONENTS else SENSING

    @property
    def label(self) -> str:
        """Its name, cut where it is long."""
        return self.name if len(self.name) <= LETTERS else f"{self.name[: LETTERS - 1]}…"

    @property
    def label_width(self) -> float:
        """[px] of name and setting."""
        below = (len(text) + len(VALUE) * (variable != "") for text, variable in self.words)
        return LETTER * max(len(self.label), *below, 0)


class Circuit(Struct, frozen=False):
    """Parts. drains : nodes that are drawn as a tank at every pin. values : result variables of the pressures of volumes, which are lines
    alone. gases : drains of gas, which are drawn as exhausts."""

    parts: list[Part]
    drains: frozenset[str]
    values: dict[str, str] = field(default_factory=dict)
    gases: frozenset[str] = frozenset()

    def pins(self) -> Iterator[tuple[str, Part, str]]:
        """(node, part, port) of every pin."""
        for part in self.parts:
            for port, node in part.lines.items():
                yield node, part, port


def circuit_of(record: Mapping[str, Any]) -> Circuit:
    """The circuit of a machine record as JSON. A component without a symbol is a box with its type; a volume is a line with its name."""
    parts, drains, values, gases = [], set(), {}, set()
    fluids = {str(each["name"]): str(each.get("type")) for each in record.get("fluids") or ()}
    of_gas = {name for name, type_ in fluids.items() if type_ == "ideal-gas"}
    for data in record.get("hydraulics") or ():
        kind, name = str(data["type"]), str(data["name"])
        gas = str(data.get("fluid")) in of_gas or (data.get("fluid") is None and of_gas == {*fluids} != set())
        if kind == "reservoir" or (kind == "tank" and not _is_supply(data)):
            drains.add(name)
            gases |= {name} if gas else set()
        elif kind in COMPONENTS and COMPONENTS[kind].symbol is COMPONENTS[kind].add is None:  # where lines meet
            values[name] = f"hydraulics.{name}.pressure"
        else:
            symbol = _symbol(data, kind)
            if kind == "tank" and gas:  # a triangle that is not filled is a source of gas
                symbol = replace(symbol, body=symbol.body.replace('class="full"', 'class="hollow"'))
            lines = _lines(data, kind, symbol)
            parts.append(Part(name, kind, symbol, lines, tuple(_words(data, kind, symbol))))
    return Circuit(parts, frozenset(drains), values, frozenset(gases))


def variable_of(node: str) -> str:
    """The result variable of the pressure of a node, without its first word: `lift.pressure_A` of the chamber `lift.A`."""
    name, _, inner = node.partition(".")
    return f"{name}.pressure_{inner}" if inner else f"{name}.pressure"


def _is_supply(tank: Mapping[str, Any]) -> bool:
    pressure = tank.get("pressure")
    return not isinstance(pressure, float | int) or pressure > HIGHEST


def _ports(data: Mapping[str, Any]) -> dict[str, str]:
    return {str(port): str(node) for port, node in (data.get("ports") or {}).items()}


def _nodes(kind: str) -> tuple[str, ...]:
    """Its nodes that others connect to: "" for itself, ".A" for its chamber A."""
    return COMPONENTS[kind].record.nodes if kind in COMPONENTS else ()


def _symbol(data: Mapping[str, Any], kind: str) -> Symbol:
    """Its symbol, or a box where it has none, or none with a pin for each of its ports."""
    ports, draw = _ports(data), COMPONENTS[kind].symbol if kind in COMPONENTS else None
    if draw is not None:
        symbol = draw(data)
        if {*ports} <= {*symbol.above, *symbol.below}:
            return symbol
    return box(kind, [*dict.fromkeys((*ports, *(node[1:] for node in _nodes(kind))))])


def _lines(data: Mapping[str, Any], kind: str, symbol: Symbol) -> dict[str, str]:
    """The node at each pin of the symbol: what is connected, its chambers, and itself at a pin that is no port."""
    name, ports, nodes = str(data["name"]), _ports(data), _nodes(kind)
    own = {}
    for pin in (*symbol.above, *symbol.below):
        if f".{pin}" in nodes:
            own[pin] = ports.get(pin, f"{name}.{pin}")
        elif "" in nodes and pin not in ports:
            own[pin] = name
    return own | {port: node for port, node in ports.items() if port not in own}


def _words(data: Mapping[str, Any], kind: str, symbol: Symbol) -> Iterator[tuple[str, str]]:
    """The settings of a component in a few letters, and its pressures."""
    name, ports, nodes = data["name"], _ports(data), _nodes(kind)
    yield from ((setting, "") for setting in symbol.settings)
    if "" in nodes:
        yield "", f"hydraulics.{name}.pressure"
    for pin in (*symbol.above, *symbol.below):
        if f".{pin}" in nodes and pin not in ports:
            yield f"{pin} ", f"hydraulics.{name}.pressure_{pin}"
