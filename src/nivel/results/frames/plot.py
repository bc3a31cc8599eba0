"""Curves of a result with matplotlib, for notebooks and papers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from nivel.extras import require
from nivel.results.frames.csv_table import columns

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from nivel.results.result import Result

QUIET_LINES = 10  # more curves than this get no legend: it would hide them


def plot(result: Result, names: tuple[str, ...], band: bool = False) -> Figure:
    """One pair of axes per unit, one curve per number; without names the joint coordinates, or else the energies.

    band : from each curve less its estimated error to the curve and that, as far as the run was verified.
    """
    require("plots need", "matplotlib")
    from matplotlib import pyplot

    default = "joint_coordinate" if "joint_coordinate" in result.variables else "*energy"
    by_unit: dict[str, list[str]] = {}
    for name in columns(result, names or (default,)):
        by_unit.setdefault(result.units(name), []).append(name)
    figure, axes = pyplot.subplots(
        len(by_unit), 1, sharex=True, squeeze=False, layout="constrained", figsize=(8, 1.2 + 2.4 * len(by_unit))
    )
    for axis, (unit, group) in zip(axes[:, 0], by_unit.items(), strict=True):
        for name in group:
            values = result.array(name)
            (line,) = axis.plot(result.time, values, label=name, linewidth=1.2)
            if band:
                error = result.estimated_error(name)
                axis.fill_between(
                    result.time, values - error, values + error, color=line.get_color(), alpha=0.25, linewidth=0
                )
        axis.set_ylabel(f"[{unit}]" if len(group) > 1 else f"{group[0]} [{unit}]")
        axis.grid(alpha=0.3)
        if 1 < len(group) <= QUIET_LINES:
            axis.legend(loc="best", fontsize="small", frameon=False)
    axes[-1, 0].set_xlabel("time [s]")
    return figure
