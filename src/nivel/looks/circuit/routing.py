"""Lines between the parts of a circuit. Rows of parts are separated by channels, in which every node has a track of its own; where a node
has pins in several channels, a vertical line beside a column joins its tracks. So no line crosses a symbol, and no two lie upon each other.
"""

from collections.abc import Iterator

from nivel.elements.circuits.symbol import LETTER
from nivel.lazy import Struct, field
from nivel.looks.circuit.parts import VALUE, Circuit, Part

TRACK, LANE, MARGIN, EDGE = 19.0, 11.0, 14.0, 10.0  # [px] between tracks and lanes; above and below tracks; around all
DRAIN = 26.0  # height of a tank with its line
APART = 7.0  # least distance of vertical lines
JOG = 5.0  # length of a line before it steps aside


class Pin(Struct, frozen=False):
    """Where a line meets a symbol: x at the symbol and beside it, y, and the channel it leads into. up : whether it leads up."""

    node: str
    part: Part
    port: str
    x: float
    y: float
    channel: int
    up: bool
    aside: float = 0.0

    @property
    def at(self) -> float:
        """[px] x of its line in the channel."""
        return self.x + self.aside


class Line(Struct, frozen=False):
    """A polyline of a node, dashed where no fluid flows."""

    node: str
    points: list[tuple[float, float]]
    dashed: bool


class Label(Struct, frozen=False):
    """The name and pressure of a node: lower left corner, width; the line below it, where it is beside that of its node."""

    node: str
    x: float
    y: float
    wide: float
    leader: Line | None = None


class Drawing(Struct, frozen=False):
    """All that is drawn beside the symbols. tanks : x, y, whether above its pin, node. dots : where lines of a node meet."""

    wide: float
    high: float
    lines: list[Line] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)
    tanks: list[tuple[float, float, bool, str]] = field(default_factory=list)
    dots: list[tuple[float, float]] = field(default_factory=list)


class Router:
    """Places of columns, rows, lanes and tracks, then lines and labels."""

    def __init__(self, circuit: Circuit, rows: int) -> None:
        self.circuit, self.rows = circuit, rows
        self.columns = 1 + max(part.column for part in circuit.parts)
        self.channels: dict[str, set[int]] = {}
        for node, part, port in circuit.pins():
            if node not in circuit.drains:
                self.channels.setdefault(node, set()).add(_channel(part, port))
        self.lane: dict[str, float] = {}
        self._place_columns()
        self.pins = list(self._pins())
        self._step_aside()
        self.track: dict[tuple[str, int], int] = {}
        self.top: list[float] = []
        self._place_rows()

    # --- places ---

    def _place_columns(self) -> None:
        """x of all parts and lanes; each lane is in the gap beside the middle of the pins of its node."""
        gaps: dict[int, list[str]] = {}
        for node, channels in self.channels.items():
            if len(channels) > 1:
                columns = [part.column for line, part, _ in self.circuit.pins() if line == node]
                gaps.setdefault(round(sum(columns) / len(columns) + 0.5), []).append(node)
        x = EDGE
        for column in range(self.columns + 1):
            for k, node in enumerate(gaps.get(column, ())):
                self.lane[node] = x + LANE * (k + 0.5)
            x += LANE * len(gaps.get(column, ())) + EDGE
            here = [part for part in self.circuit.parts if part.column == column]
            left = max((part.symbol.wide for part in here), default=0.0)
            for part in here:
                part.x = x + left
            x += left + max((part.symbol.wide + 8.0 + part.label_width for part in here), default=0.0) + EDGE
        self.wide = x

    def _pins(self) -> Iterator[Pin]:
        for node, part, port in self.circuit.pins():
            up = port in part.symbol.above
            sides = part.symbol.above if up else part.symbol.below
            yield Pin(node, part, port, part.x + sides[port], 0.0, _channel(part, port), up)

    def _step_aside(self) -> None:
        """Lines that would lie upon another one of the same channel step aside; those of tanks stay."""
        for channel in range(self.rows + 1):
            lines = [pin for pin in self.pins if pin.channel == channel and pin.node not in self.circuit.drains]
            for pin in lines:
                for aside in (0.0, APART, -APART, 2 * APART, -2 * APART):
                    pin.aside = aside
                    if not any(
                        other is not pin
                        and other.node != pin.node
                        and other.up != pin.up
                        and abs(other.at - pin.at) < APART - 1e-6
                        for other in lines
                    ):
                        break

    def _place_rows(self) -> None:
        """Tracks of all channels, then y of all rows."""
        y = EDGE
        for channel in range(self.rows + 1):
            here = [pin for pin in self.pins if pin.channel == channel]
            drained = [pin.up for pin in here if pin.node in self.circuit.drains]
            y += DRAIN if False in drained else 0.0
            self.top.append(y + MARGIN)
            count = self._set_tracks(channel)
            y += MARGIN + TRACK * count + (DRAIN if True in drained else 0.0)
            row = [part for part in self.circuit.parts if part.row == channel]
            high = max((part.symbol.high for part in row), default=0.0)
            for part in row:
                part.y = y + high
            y += 2.0 * high
        self.high = y + EDGE
        for pin in self.pins:
            pin.y = pin.part.y + (-pin.part.symbol.high if pin.up else pin.part.symbol.high)

    def _set_tracks(self, channel: int) -> int:
        """A track for each node with pins here, free over its whole length. Returns their number."""
        taken: list[list[tuple[float, float]]] = []
        spans = {node: self._span(node, channel) for node, channels in self.channels.items() if channel in channels}
        for node, (low, last) in sorted(spans.items(), key=lambda each: each[1]):
            high = max(last, low + self._label_width(node)) if self._label_channel(node) == channel else last
            free = [k for k, its in enumerate(taken) if all(high + APART < a or low - APART > b for a, b in its)]
            if not free:
                free = [len(taken)]
                taken.append([])
            taken[free[0]].append((low, high))
            self.track[node, channel] = free[0]
        return len(taken)

    def _span(self, node: str, channel: int) -> tuple[float, float]:
        """x from the first to the last line of a node in a channel."""
        xs = [pin.at for pin in self.pins if pin.node == node and pin.channel == channel]
        xs += [self.lane[node]] if node in self.lane else []
        return min(xs), max(xs)

    def _label_channel(self, node: str) -> int:
        return max(self.channels[node])

    def _label_width(self, node: str) -> float:
        return LETTER * (len(node) + 2 + len(VALUE)) if node in self.circuit.values else 0.0

    def _y(self, node: str, channel: int) -> float:
        return self.top[channel] + TRACK * (self.track[node, channel] + 0.5)

    # --- lines ---

    def drawing(self) -> Drawing:
        """All lines, dots, tanks and labels."""
        out = Drawing(self.wide, self.high)
        for pin in self.pins:
            if pin.node in self.circuit.drains:
                out.tanks.append((pin.x, pin.y, pin.up, pin.node))
            else:
                out.lines.append(self._stub(pin))
        for node, channels in self.channels.items():
            dashed = all(pin.port in pin.part.sensing for pin in self.pins if pin.node == node)
            ends = []
            for channel in sorted(channels):
                y, (low, high) = self._y(node, channel), self._span(node, channel)
                ends.append(y)
                if high > low:
                    out.lines.append(Line(node, [(low, y), (high, y)], dashed))
                out.dots += self._dots(node, channel, y, (low, high))
            if node in self.lane:
                out.lines.append(Line(node, [(self.lane[node], ends[0]), (self.lane[node], ends[-1])], dashed))
        for node in self.channels:
            if node in self.circuit.values:
                out.labels.append(self._label(node, out))
        out.wide = max([out.wide, *(label.x + label.wide + EDGE for label in out.labels)])
        return out

    def _stub(self, pin: Pin) -> Line:
        """The line from a pin to its track."""
        y = self._y(pin.node, pin.channel)
        points = [(pin.x, pin.y), (pin.x, y)]
        if pin.aside:
            level = pin.y + (-JOG if pin.up else JOG)
            points = [(pin.x, pin.y), (pin.x, level), (pin.at, level), (pin.at, y)]
        return Line(pin.node, points, pin.port in pin.part.sensing)

    def _dots(self, node: str, channel: int, y: float, span: tuple[float, float]) -> Iterator[tuple[float, float]]:
        """Points of a track where three lines meet."""
        xs = [(pin.at, 1) for pin in self.pins if pin.node == node and pin.channel == channel]
        if node in self.lane:
            inner = min(self.channels[node]) < channel < max(self.channels[node])
            xs.append((self.lane[node], 2 if inner else 1))
        for x in {x for x, _ in xs}:
            count = sum(each for at, each in xs if at == x) + (x > span[0]) + (x < span[1])
            if count > 2:
                yield x, y

    def _label(self, node: str, out: Drawing) -> Label:
        """A free place on a track of the node, as near to its line as there is one."""
        wide = self._label_width(node)
        best: tuple[float, Label] | None = None
        for channel in sorted(self.channels[node], reverse=True):
            y, (low, high) = self._y(node, channel), self._span(node, channel)
            x = EDGE
            while x <= self.wide:
                away = max(low - x, x + wide - high, 0.0)
                label = Label(node, x, y - 3.0, wide, _leader(node, x, wide, y, low, high))
                if (best is None or away < best[0] - 1e-6) and _is_free(label, out):
                    best = (away, label)
                x += 3.0
            if best is not None and best[0] == 0.0:
                break
        return best[1] if best is not None else Label(node, self.wide, self._y(node, self._label_channel(node)), wide)


def _channel(part: Part, port: str) -> int:
    return part.row if port in part.symbol.above else part.row + 1


def _leader(node: str, x: float, wide: float, y: float, low: float, high: float) -> Line | None:
    """The line from that of the node, low to high, to the far end of a label."""
    if x < low:
        return Line(node, [(x, y), (low, y)], False)
    return Line(node, [(high, y), (x + wide, y)], False) if x + wide > high else None


def _is_free(label: Label, out: Drawing) -> bool:
    """Whether no line and no other label is where a label would be."""
    left, right, top, bottom = label.x - 3.0, label.x + label.wide + 3.0, label.y - 11.0, label.y + 2.0
    for line in out.lines:
        for (x0, y0), (x1, y1) in zip(line.points, line.points[1:], strict=False):
            if min(x0, x1) < right and max(x0, x1) > left and min(y0, y1) < bottom and max(y0, y1) > top:
                return False
    if label.leader is not None and any(_lies_upon(label.leader, line) for line in out.lines):
        return False
    if any(x - 9.0 < right and x + 9.0 > left and y - DRAIN < bottom and y + DRAIN > top for x, y, *_ in out.tanks):
        return False
    return not any(
        other.x < right and other.x + other.wide > left and other.y - 11.0 < bottom and other.y + 2.0 > top
        for other in out.labels
    )


def _lies_upon(leader: Line, line: Line) -> bool:
    """Whether a horizontal line of another node is at the same height and place."""
    (a, y), (b, _) = leader.points
    for (x0, y0), (x1, y1) in zip(line.points, line.points[1:], strict=False):
        if line.node != leader.node and y0 == y1 and abs(y0 - y) < 2.0 and min(x0, x1) < b and max(x0, x1) > a:
            return True
    return False
