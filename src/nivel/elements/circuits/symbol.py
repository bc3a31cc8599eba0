"""Symbols of components after ISO 1219-1: paths about the middle of a symbol, and where lines meet it. Units are pixels; y goes down."""

from collections.abc import Mapping, Sequence
from typing import Any, Final, Literal

from nivel.elements.circuits.component import SENSING
from nivel.lazy import Struct, field, replace

SPRING: Final = "l3 -5 l4 10 l4 -10 l3 5"
BAR: Final = 1e-5, "bar"
LETTER: Final = 6.4  # px, at 11 px
PIN: Final = 22.0  # px between pins of a box


class Symbol(Struct):
    """What is drawn of a component.

    body : SVG about (0, 0). wide, high : half of its size. above, below : x of the pin of each port above, or below, the symbol.
    row : where it stands in the diagram; a relief valve beside what it protects, "" between actuators and pumps. settings : said below its
    name. text : in the middle of a box, whose pins have the letters of their ports.
    key : of its record, which is said below its name in a `unit`, a factor and its word; arrow : from where to where its oblique arrow
    goes, where it varies.
    """

    body: str
    wide: float
    high: float
    above: Mapping[str, float] = field(default_factory=dict)
    below: Mapping[str, float] = field(default_factory=dict)
    row: Literal["actuator", "valve", "relief", "supply", ""] = ""
    settings: tuple[str, ...] = ()
    text: str = ""
    key: str = ""
    unit: tuple[float, str] | None = None
    arrow: tuple[float, float, float, float] | None = None

    def __call__(self, data: Mapping[str, Any]) -> "Symbol":
        """The symbol of a component with this record, as JSON."""
        body = self.body + adjustable(*self.arrow) if self.arrow and varies(data, self.key) else self.body
        return replace(self, body=body, settings=setting(data, self.key, *self.unit) if self.unit else self.settings)


def path(d: str, style: str = "") -> str:
    """An SVG path, of a class `style`: dashed, full (filled)."""
    return f'<path{f" class={style!r}" if style else ""} d="{d}"/>'.replace("'", '"')


def circle(radius: float, y: float = 0.0) -> str:
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


def setting(data: Mapping[str, Any], key: str, factor: float, unit: str) -> tuple[str, ...]:
    """A constant of a component in the unit of a diagram; none where it varies or is not given."""
    value = data.get(key)
    return (f"{factor * value:.4g} {unit}",) if isinstance(value, float | int) else ()


def in_bar(data: Mapping[str, Any], key: str) -> tuple[str, ...]:
    return setting(data, key, 1e-5, "bar")


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


def pipe(data: Mapping[str, Any]) -> Symbol:
    """A pipe."""
    dots = "".join(f'<circle class="full" cx="0" cy="{y}" r="2"/>' for y in (-12, 12))
    size = f"{data['length']:.3g} m × {1e3 * data['diameter']:.3g} mm"
    body = path("M0 -16 V-12 C9 -5 -9 5 0 12 V16") + dots
    return Symbol(body, 8.0, 16.0, {"B": 0.0}, {"A": 0.0}, settings=(size,))


SQUARE: Final = "M-12 -12 H12 V12 H-12 Z"
STUBS: Final = "M0 -20 V-12 M0 12 V20"


def moved(body: str, x: float, y: float) -> str:
    return f'<g transform="translate({x:g} {y:g})">{body}</g>'


def check_at(x: float, y: float, up: bool = True) -> str:
    """A ball on its seat; `up`: fluid passes upwards."""
    way = 1.0 if up else -1.0
    seat = path(f"M{x - 6:g} {y - 3 * way:g} L{x:g} {y + 5 * way:g} L{x + 6:g} {y - 3 * way:g}")
    return seat + f'<circle cx="{x:g}" cy="{y - 2 * way:g}" r="3.6"/>'


def letters(ports: Mapping[str, tuple[float, float]]) -> str:
    return "".join(f'<text class="port" x="{x:g}" y="{y:g}">{port}</text>' for port, (x, y) in ports.items())


def square(open_at_rest: bool, upwards: bool, drained: bool = False) -> str:
    """A square with its arrow, in line with the ports or beside them, and its spring."""
    x = 0.0 if open_at_rest else -5.0
    ends = (12.0, -12.0) if upwards else (-12.0, 12.0)
    body = path(f"{SQUARE} {STUBS}") + arrow(x, *ends) + path(f"M12 0 {SPRING}")
    return body + (path("M20 5 V20", "dashed") if drained else "")
