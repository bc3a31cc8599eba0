"""A page of eigenvalues over a parameter: frequencies, damping, and their paths in the complex plane."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from nivel import __version__
from nivel.report.plots import Line, curves
from nivel.report.story import trusted
from nivel.results.analyses.linear_model import ROUND_OFF
from nivel.results.analyses.linear_sweep import TURN, LinearSweep

HERE = Path(__file__).parent
NOTE = "Modes are followed by their eigenvectors. A vibration meets a multiple of a speed where its line crosses that of the order."


def sweep_html(sweep: LinearSweep, orders: Sequence[float] = ()) -> str:
    """The page as text."""
    from jinja2 import Environment, FileSystemLoader

    environment = Environment(loader=FileSystemLoader(HERE), autoescape=True, trim_blocks=True, lstrip_blocks=True)
    said = sweep.statements() + [each.words(sweep.unit) for each in sweep.crossings(orders)]
    return environment.get_template("plots.html.j2").render(
        name=f"{sweep.models[0].name}: eigenvalues over {sweep.parameter}",
        said=said or ["nothing changes its stability"],
        plots=_plots(sweep, orders),
        trusted=trusted(sweep.trust),
        note=NOTE,
        version=__version__,
        page_style=(HERE / "page.css").read_text(encoding="utf-8"),
        style=(HERE / "reduction.css").read_text(encoding="utf-8") + (HERE / "plots.css").read_text(encoding="utf-8"),
    )


def _plots(sweep: LinearSweep, orders: Sequence[float]) -> list[tuple[str, str]]:
    found: Any = sweep.eigenvalues
    values = sweep.values
    title = f"{sweep.parameter} [{sweep.unit}]" if sweep.unit else sweep.parameter
    found = np.where(np.abs(found.real) > ROUND_OFF * np.abs(found), found, 1j * found.imag)
    upper = [k for k in range(found.shape[1]) if np.nanmax(found[:, k].imag, initial=0.0) > 0.0]
    # of a pair one is enough
    shown: Any = np.where(np.nan_to_num(found.imag) >= 0.0, found, np.nan)
    some = [k for k in range(shown.shape[1]) if np.any(np.isfinite(shown[:, k]))]
    frequencies = [Line(f"mode {k + 1}", values, found[:, k].imag / TURN) for k in upper]
    frequencies += [Line(f"{order:g} × speed", values, order * np.abs(sweep.speeds) / TURN) for order in orders]
    rates = [Line(f"mode {k + 1}", values, shown[:, k].real) for k in some]
    out = []
    if upper:
        out.append(("Frequencies", curves(frequencies, title, "frequency [Hz]")))
        with np.errstate(invalid="ignore", divide="ignore"):
            ratios = [Line(f"mode {k + 1}", values, -found[:, k].real / np.abs(found[:, k])) for k in upper]
        out.append(("Damping ratios", curves(ratios, title, "damping ratio")))
    out.append(("Real parts", curves(rates, title, "real part [1/s]")))
    paths = [Line(f"mode {k + 1}", shown[:, k].real, shown[:, k].imag) for k in some]
    out.append(("Paths in the complex plane", curves(paths, "real part [1/s]", "imaginary part [1/s]")))
    return out
