"""The panel of a control: the values of all blocks, then each block with what it takes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from nivel.report.panel import GROUPS, TOGETHER, Curve, Group, Panel, left_out

if TYPE_CHECKING:
    from nivel.results.result import Result

MOST: Final = 2 * TOGETHER
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
