"""A page of coupler curves and transmission angles."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from nivel import __version__
from nivel.report.plots import Line, curves, path_drawing
from nivel.results.analyses.mechanism import Studies

HERE = Path(__file__).parent
NOTE = "Transmission angles are between the lines from one joint to two others; 90° transmits best."


def mechanism_html(studies: Studies) -> str:
    """The page as text."""
    from jinja2 import Environment, FileSystemLoader

    environment = Environment(loader=FileSystemLoader(HERE), autoescape=True, trim_blocks=True, lstrip_blocks=True)
    return environment.get_template("plots.html.j2").render(
        name=studies.name,
        said=studies.lines(),
        plots=_plots(studies),
        note=NOTE,
        version=__version__,
        page_style=(HERE / "page.css").read_text(encoding="utf-8"),
        style=(HERE / "reduction.css").read_text(encoding="utf-8") + (HERE / "plots.css").read_text(encoding="utf-8"),
    )


def _plots(studies: Studies) -> list[tuple[str, str]]:
    out = []
    if studies.angles:
        lines = [
            Line(what.name, angle["time"].to_numpy(), np.degrees(angle.to_numpy())) for what, angle in studies.angles
        ]
        out.append(("Transmission angles", curves(lines, "time [s]", "angle [°]")))
    for point, curve in studies.curves:
        r, time = curve["position"].to_numpy(), curve["time"].to_numpy()
        # the two axes along which the point moves most
        across, up = sorted(np.argsort(-np.ptp(r, axis=0), kind="stable")[:2])
        out.append(
            (f"Path of {point.name}", path_drawing(r[:, across], r[:, up], f"{'xyz'[across]} [m]", f"{'xyz'[up]} [m]"))
        )
        out.append(
            (
                f"Curvature of the path of {point.name}",
                curves([Line("", time, curve["curvature"].to_numpy())], "time [s]", "curvature [1/m]"),
            )
        )
        out.append(
            (f"Speed of {point.name}", curves([Line("", time, curve["speed"].to_numpy())], "time [s]", "speed [m/s]"))
        )
    return out
