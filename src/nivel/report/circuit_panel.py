"""The panel of hydraulic circuits: pressures in bar, flows in litres per minute, positions of valves, forces of actuators."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from nivel.report.panel import GROUPS, TOGETHER, Curve, Group, Panel, left_out

if TYPE_CHECKING:
    from nivel.results.result import Result

START = "hydraulics."
MOST = 2 * TOGETHER  # curves in a plot: those after the first TOGETHER are dashed
# how the last word of a name begins → heading, unit shown, SI value of it
KINDS = {
    "pressure": ("pressures", "bar", 1e5),
    "temperature": ("temperatures of gas", "K", 1.0),
    "flow": ("flows", "L/min", 1e-3 / 60.0),
    "position": ("positions", "", 1.0),
    "force": ("forces of actuators", "N", 1.0),
    "torque": ("torques of shafts", "N m", 1.0),
}


def circuits(result: Result) -> Panel | None:
    """All outputs of one kind together; in several plots where they are too many to be told apart."""
    groups = [group for kind in KINDS for group in _groups(result, kind)]
    return Panel("Hydraulics", tuple(groups[:GROUPS]), note=left_out(len(groups))) if groups else None


def _groups(result: Result, kind: str) -> Iterator[Group]:
    words, unit, factor = KINDS[kind]
    by_unit: dict[str, list[str]] = {}
    for name in result.variables:
        if name.startswith(START) and name.rpartition(".")[2].startswith(kind):
            by_unit.setdefault(result.variables[name].units or "1", []).append(name)
    for units, names in by_unit.items():
        shown = unit or units
        parts = [names[k : k + MOST] for k in range(0, len(names), MOST)]
        for k, part in enumerate(parts):
            label = f"{words}, {shown}".removesuffix(", 1")
            label += f" ({k + 1} of {len(parts)})" if len(parts) > 1 else ""
            curves = tuple(
                Curve(name.removeprefix(START), result.array(name) / factor, str(place))
                for place, name in enumerate(part)
            )
            yield Group(label, shown, curves)
