"""Plots with matplotlib: curves of a result, and stress at nodes over time."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from nivel.errors import ModelError
from nivel.extras import require
from nivel.files.target import written
from nivel.lazy import matplotlib
from nivel.results.frames.csv_table import columns

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from nivel.results.result import Result
    from nivel.results.stress import RecoveredBody


def plot_stress(body: RecoveredBody, nodes: Sequence[int | str]) -> Figure:
    """A pair of axes per node: signed principal and von Mises stress at the station where the latter is largest."""
    require("plots need", "matplotlib")
    figure = matplotlib.figure.Figure(layout="constrained", figsize=(8, 1.2 + 2.4 * len(nodes)))
    axes = figure.subplots(len(nodes), 1, sharex=True, squeeze=False)
    for axis, node in zip(axes[:, 0], nodes, strict=True):
        size, signed = body.von_mises(node), body.signed_principal(node)
        station = int(np.argmax(size.max(axis=0)))
        axis.plot(body.time, signed[:, station] / 1e6, label="signed principal", linewidth=1.2)
        axis.plot(body.time, size[:, station] / 1e6, label="von Mises", linewidth=1.0, linestyle="--")
        axis.set_ylabel("stress [MPa]")
        axis.set_title(f"{body.name}, node {body.node(node)} {body.labels(node)[station]}".strip(), fontsize="medium")
        axis.grid(alpha=0.3)
        axis.legend(loc="best", fontsize="small", frameon=False)
    axes[-1, 0].set_xlabel("time [s]")
    return figure


def save_plot(path: Path, body: RecoveredBody, nodes: Sequence[int | str]) -> Path:
    """Draw `plot_stress` into a file; the ending of its name says in which format. Raises ModelError where that is unknown."""
    figure = plot_stress(body, nodes)
    known = figure.canvas.get_supported_filetypes()
    kind = path.suffix.removeprefix(".").lower()
    if kind not in known:
        raise ModelError(f"{path}: a picture ends with .png, .svg or .pdf, not with `{path.suffix}`")
    with written(path, "plot") as draft:
        figure.savefig(draft, format=kind)
    return path


QUIET_LINES = 10  # more curves than this get no legend: it would hide them


def plot(result: Result, names: tuple[str, ...], band: bool = False) -> Figure:
    """One pair of axes per unit, one curve per number; without names the joint coordinates, or else the energies.

    band : from each curve less its estimated error to the curve and that, as far as the run was verified.
    """
    require("plots need", "matplotlib")
    default = "joint_coordinate" if "joint_coordinate" in result.variables else "*energy"
    by_unit: dict[str, list[str]] = {}
    for name in columns(result, names or (default,)):
        by_unit.setdefault(result.units(name), []).append(name)
    figure, axes = matplotlib.pyplot.subplots(
        len(by_unit), 1, sharex=True, squeeze=False, layout="constrained", figsize=(8, 1.2 + 2.4 * len(by_unit))
    )
    for axis, (unit, group) in zip(axes[:, 0], by_unit.items(), strict=True):
        for name in group:
            values = result.array(name)
            (line,) = axis.plot(result.time, values, label=name, linewidth=1.2)
            if band:
                error, style = result.estimated_error(name), {"color": line.get_color(), "alpha": 0.25, "linewidth": 0}
                axis.fill_between(result.time, values - error, values + error, **style)
        axis.set_ylabel(f"[{unit}]" if len(group) > 1 else f"{group[0]} [{unit}]")
        axis.grid(alpha=0.3)
        if 1 < len(group) <= QUIET_LINES:
            axis.legend(loc="best", fontsize="small", frameon=False)
    axes[-1, 0].set_xlabel("time [s]")
    return figure
