"""The page of inverse dynamics: efforts and power of actuators over the motion."""

from __future__ import annotations

from pathlib import Path

from nivel import __version__
from nivel.report.plots import TONES, Line, curves
from nivel.report.story import trusted
from nivel.results.analyses.efforts import Efforts

HERE = Path(__file__).parent


def efforts_html(efforts: Efforts) -> str:
    """The page as text."""
    from jinja2 import Environment, FileSystemLoader

    environment = Environment(loader=FileSystemLoader(HERE), autoescape=True, trim_blocks=True, lstrip_blocks=True)
    return environment.get_template("efforts.html.j2").render(
        efforts=efforts,
        facts=efforts.facts(),
        trusted=trusted(efforts.trust),
        plots=_plots(efforts),
        version=__version__,
        page_style=(HERE / "page.css").read_text(encoding="utf-8"),
        style=(HERE / "reduction.css").read_text(encoding="utf-8") + (HERE / "plots.css").read_text(encoding="utf-8"),
    )


def _plots(efforts: Efforts) -> list[tuple[str, str]]:
    out, shown = [], range(min(len(efforts.actuators), TONES))
    for unit, word in (("N m", "Torques"), ("N", "Forces")):
        lines = [
            Line(efforts.actuators[k], efforts.time, efforts.effort[:, k]) for k in shown if efforts.units[k] == unit
        ]
        if lines:
            out.append((word, curves(lines, "time [s]", f"effort [{unit}]")))
    powers = [Line(efforts.actuators[k], efforts.time, efforts.power[:, k]) for k in shown]
    out.append(("Power", curves(powers, "time [s]", "power [W]")))
    if not efforts.complete:
        out.append(
            ("Missing", curves([Line("", efforts.time, 100.0 * efforts.missing_share)], "time [s]", "missing [%]"))
        )
    return out
