"""The control as a block diagram (SVG): from left to right what is measured, blocks as signals flow, and what they act on."""

import re
from collections.abc import Iterator, Mapping, Sequence
from html import escape
from typing import Any, Final

from nivel.known import Result
from nivel.lazy import dataclass, field
from nivel.report.panel import GROUPS, MOST, Curve, Group, Panel, left_out

WIDE, HIGH, ACROSS, DOWN = 168.0, 40.0, 64.0, 14.0  # [px] of boxes, and between them
MARGIN = 8.0
LARGEST = 80  # boxes
LETTERS = 24  # of a name that is shown
_SYMBOL: Final = re.compile(r"(?<![\w.])([^\W\d][\w-]*)\.([^\W\d]\w*)")
# keys whose texts hold no symbols
PLAIN: Final = ("name", "source", "file", "function", "coordinate", "units", "type", "to")
# where values of blocks act, besides blocks themselves
ACTING: Final = ("forces", "states", "events")


@dataclass
class Box:
    """One box: its kind is that of its style; what it reads are names of other boxes. column : from the left."""

    name: str
    kind: str
    words: str
    reads: list[str] = field(default_factory=list)
    column: int = 0
    x: float = 0.0
    y: float = 0.0


def control_diagram(record: Mapping[str, Any]) -> str:
    """SVG of the control of a machine record as JSON; empty without one, or where it is too large to be read."""
    boxes = _boxes(record)
    if not boxes or len(boxes) > LARGEST:
        return ""
    _set_columns(boxes)
    width, height = _place(boxes)
    lines = [line for box in boxes.values() for line in _lines(box, boxes)]
    head = f'<svg class="control-diagram" viewBox="0 0 {width:.0f} {height:.0f}" width="{width:.0f}" role="img" aria-label="block diagram">'
    return "\n".join([head, *lines, *(_drawn(box) for box in boxes.values()), "</svg>"])


def _boxes(record: Mapping[str, Any]) -> dict[str, Box]:
    """Blocks, what they measure, and what they act on, by name."""
    blocks = {str(block["name"]): block for block in record.get("control") or ()}
    boxes: dict[str, Box] = {}
    for name, block in blocks.items():
        period = block.get("sample_time")
        words = f"{block['type']}{f' · {1e3 * period:.4g} ms' if period else ''}"
        boxes[name] = Box(name, "sampled" if period else "continuous", words, _read(block, blocks, own=name))
    measured = {path for box in boxes.values() for path in box.reads if path not in blocks}
    boxes |= {path: Box(path, "measured", "") for path in sorted(measured)}
    for section in ACTING:
        for element in record.get(section) or ():
            used = [path for path in _read(element, blocks) if path in blocks]
            if used:
                name = f"{section}.{element['name']}"
                boxes[name] = Box(str(element["name"]), "acting", str(element.get("type", section[:-1])), used)
    return boxes if blocks else {}


def _read(element: Any, blocks: Mapping[str, Any], own: str = "") -> list[str]:
    """Names of the blocks, and paths of all else, that functions of an element read; not itself."""
    found: dict[str, None] = {}
    for text in _texts(element):
        for name, quantity in _SYMBOL.findall(text):
            if name != own:
                found[name if name in blocks else f"{name}.{quantity}"] = None
    return list(found)


def _texts(value: Any, key: str = "") -> Iterator[str]:
    """All texts of an element that may hold symbols."""
    if isinstance(value, str) and key not in PLAIN:
        yield value
    elif isinstance(value, Mapping):
        for each, inner in value.items():
            yield from _texts(inner, str(each))
    elif isinstance(value, list | tuple):
        for inner in value:
            yield from _texts(inner, key)


def _set_columns(boxes: Mapping[str, Box]) -> None:
    """The column of each box: behind all that it reads, along the longest way; what closes a loop does not count."""

    def depth(name: str, above: tuple[str, ...]) -> int:
        box = boxes[name]
        if not box.column:
            before = [depth(each, (*above, name)) for each in box.reads if each in boxes and each not in (*above, name)]
            box.column = 1 + max(before, default=0)
        return box.column

    for name in boxes:
        depth(name, ())
    last = max(box.column for box in boxes.values())
    for box in boxes.values():
        if box.kind == "acting":
            box.column = last
        elif box.kind == "measured":
            readers = [each.column for each in boxes.values() if box.name in each.reads]
            box.column = max(min(readers, default=2) - 1, 1)


def _place(boxes: Mapping[str, Box]) -> tuple[float, float]:
    """Places of all boxes, each near to those that read it, and the size of the whole."""
    columns: dict[int, list[Box]] = {}
    for box in boxes.values():
        columns.setdefault(box.column, []).append(box)
    row: dict[str, float] = {}
    for column in sorted(columns, reverse=True):
        here = [key for key, box in boxes.items() if box.column == column]
        wished = {
            key: _mean([row[each] for each, box in boxes.items() if key in box.reads and each in row], k)
            for k, key in enumerate(here)
        }
        for k, key in enumerate(sorted(here, key=lambda each: wished[each])):
            row[key] = float(k)
            boxes[key].x, boxes[key].y = MARGIN + (column - 1) * (WIDE + ACROSS), MARGIN + k * (HIGH + DOWN)
    for column in sorted(columns):  # down to the height of what they read, without overlap
        least = MARGIN
        for box in sorted(columns[column], key=lambda box: box.y):
            before = [boxes[each].y for each in box.reads if boxes[each].column < box.column]
            box.y = max(least, _mean(before, least))
            least = box.y + HIGH + DOWN
    lowest = max(box.y for box in boxes.values())
    return 2 * MARGIN + max(columns) * (WIDE + ACROSS) - ACROSS, lowest + HIGH + MARGIN


def _mean(values: Sequence[float], otherwise: float) -> float:
    return sum(values) / len(values) if values else otherwise


def _lines(box: Box, boxes: Mapping[str, Box]) -> Iterator[str]:
    """Arrows from what a box reads; those that go back are dashed."""
    for name in box.reads:
        before = boxes[name]
        x0, y0, x1, y1 = before.x + WIDE, before.y + 0.5 * HIGH, box.x, box.y + 0.5 * HIGH
        reach = max(0.5 * (x1 - x0), 0.5 * ACROSS)
        style = ' class="back"' if x1 <= x0 else ""
        path = f"M{x0:.1f} {y0:.1f} C{x0 + reach:.1f} {y0:.1f} {x1 - reach:.1f} {y1:.1f} {x1 - 5:.1f} {y1:.1f}"
        yield f'<path{style} d="{path}"/><path class="tip" d="M{x1:.1f} {y1:.1f} l-7 -3.5 v7 z"/>'


def _drawn(box: Box) -> str:
    """A box with its name and kind."""
    name = box.name if len(box.name) <= LETTERS else f"{box.name[: LETTERS - 1]}…"
    middle = box.y + 0.5 * HIGH
    first, across = middle - 2.0 if box.words else middle + 4.5, f"{box.x + 0.5 * WIDE:.1f}"
    words = f'<text class="kind" x="{across}" y="{middle + 13:.1f}">{escape(box.words)}</text>'
    return (
        f'<g class="{box.kind}"><title>{escape(box.name)}</title>'
        f'<rect x="{box.x:.1f}" y="{box.y:.1f}" width="{WIDE:.0f}" height="{HIGH:.0f}" rx="6"/>'
        f'<text x="{across}" y="{first:.1f}">{escape(name)}</text>{words if box.words else ""}</g>'
    )


# parts of blocks that stand in the result file only
INNER: Final = re.compile(r"(waiting|queued|guard|x)_?\d+|before|computed|entered|next|slope|.+_\d+")


def control(result: Result) -> Panel | None:
    """Values by unit, and of each block its value with its inputs and parts."""
    blocks: dict[str, list[str]] = {}
    for name in result.variables:
        section, _, rest = name.partition(".")
        block, _, part = rest.partition(".")
        if section == "control" and (not part or not INNER.fullmatch(part)):
            blocks.setdefault(block, []).append(part)
    if not blocks:
        return None
    groups = [*_values(result, blocks), *_each(result, blocks)]
    return Panel("Control", tuple(groups[:GROUPS]), note=left_out(len(groups)))


def _values(result: Result, blocks: dict[str, list[str]]) -> Iterator[Group]:
    by_unit: dict[str, list[str]] = {}
    for block in blocks:
        by_unit.setdefault(result.variables[f"control.{block}"].units or "1", []).append(block)
    for unit, names in by_unit.items():
        curves = tuple(Curve(name, result.array(f"control.{name}"), str(k)) for k, name in enumerate(names[:MOST]))
        label = "values" if unit == "1" else f"values, {unit}"
        yield Group(label, "" if unit == "1" else unit, curves)


def _each(result: Result, blocks: dict[str, list[str]]) -> Iterator[Group]:
    for block, parts in blocks.items():
        names = {part or "value": f"control.{block}.{part}" if part else f"control.{block}" for part in parts}
        if len(names) > 1:
            curves = tuple(Curve(part, result.array(name), str(k)) for k, (part, name) in enumerate(names.items()))
            yield Group(block, "", curves[:MOST])
