"""Stress at nodes over time with matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from nivel.errors import ModelError
from nivel.extras import require
from nivel.files.target import written
from nivel.results.stress.recovered import RecoveredBody

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def plot_stress(body: RecoveredBody, nodes: Sequence[int | str]) -> Figure:
    """A pair of axes per node: signed principal and von Mises stress at the station where the latter is largest."""
    require("plots need", "matplotlib")
    from matplotlib.figure import Figure

    figure = Figure(layout="constrained", figsize=(8, 1.2 + 2.4 * len(nodes)))
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
