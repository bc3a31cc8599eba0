"""Pages of analyses of motion: efforts of inverse dynamics; coupler curves and transmission angles."""

import numpy as np

from nivel.report.page import page
from nivel.report.plots import TONES, Line, curves, path_drawing
from nivel.report.story import trusted
from nivel.results.analyses.efforts import Efforts
from nivel.results.analyses.mechanism import Studies


def efforts_html(efforts: Efforts) -> str:
    """The page as text."""
    return page(
        "efforts.html.j2",
        ("reduction.css", "plots.css"),
        efforts=efforts,
        facts=efforts.facts(),
        trusted=trusted(efforts.trust),
        plots=_plots(efforts),
    )


def _plots(efforts: Efforts) -> list[tuple[str, str]]:
    out, shown = [], range(min(len(efforts.actuators), TONES))
    for unit, word in (("N m", "Torques"), ("N", "Forces")):
        own = [k for k in shown if efforts.units[k] == unit]
        lines = [Line(efforts.actuators[k], efforts.time, efforts.effort[:, k]) for k in own]
        if lines:
            out.append((word, curves(lines, "time [s]", f"effort [{unit}]")))
    powers = [Line(efforts.actuators[k], efforts.time, efforts.power[:, k]) for k in shown]
    out.append(("Power", curves(powers, "time [s]", "power [W]")))
    if not efforts.complete:
        missing = Line("", efforts.time, 100.0 * efforts.missing_share)
        out.append(("Missing", curves([missing], "time [s]", "missing [%]")))
    return out


NOTE = "Transmission angles are between the lines from one joint to two others; 90° transmits best."


def mechanism_html(studies: Studies) -> str:
    """The page as text."""
    return page(
        "plots.html.j2",
        ("reduction.css", "plots.css"),
        name=studies.name,
        said=studies.lines(),
        plots=_mechanism_plots(studies),
        note=NOTE,
    )


def _mechanism_plots(studies: Studies) -> list[tuple[str, str]]:
    out = []
    if studies.angles:
        angles = [(what.name, angle["time"].to_numpy(), np.degrees(angle.to_numpy())) for what, angle in studies.angles]
        out.append(("Transmission angles", curves([Line(*each) for each in angles], "time [s]", "angle [°]")))
    for point, curve in studies.curves:
        r, time = curve["position"].to_numpy(), curve["time"].to_numpy()
        # the two axes along which the point moves most
        across, up = sorted(np.argsort(-np.ptp(r, axis=0), kind="stable")[:2])
        drawn = path_drawing(r[:, across], r[:, up], f"{'xyz'[across]} [m]", f"{'xyz'[up]} [m]")
        out.append((f"Path of {point.name}", drawn))
        for title, name, unit in (("Curvature of the path", "curvature", "1/m"), ("Speed", "speed", "m/s")):
            line = Line("", time, curve[name].to_numpy())
            out.append((f"{title} of {point.name}", curves([line], "time [s]", f"{name} [{unit}]")))
    return out
