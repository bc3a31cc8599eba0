"""The page of a linearisation: eigenvalues and modes, frequency response, matrices, in one HTML file with everything in it."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

import numpy as np

from nivel import __version__
from nivel.errors import ModelError
from nivel.report.plots import Line, curves, points, unit_circle
from nivel.report.story import trusted
from nivel.results.analyses.linear_model import ROUND_OFF, LinearModel

HERE = Path(__file__).parent
MOST_MODES: Final = 60
MOST_CURVES: Final = 8
MOST_ENTRIES: Final = 12  # rows and columns of a matrix that are shown


def linear_html(model: LinearModel) -> str:
    """The page as text."""
    from jinja2 import Environment, FileSystemLoader

    environment = Environment(loader=FileSystemLoader(HERE), autoescape=True, trim_blocks=True, lstrip_blocks=True)
    return environment.get_template("linear.html.j2").render(
        model=model,
        facts=_facts(model),
        trusted=trusted(model.trust),
        lines=_lines(model),
        beyond=max(0, len(model.modes) - MOST_MODES),
        plane=_plane(model),
        bode=_bode(model),
        sampled=_sampled(model),
        matrices=_matrices(model),
        version=__version__,
        page_style=(HERE / "page.css").read_text(encoding="utf-8"),
        style=(HERE / "reduction.css").read_text(encoding="utf-8") + (HERE / "plots.css").read_text(encoding="utf-8"),
    )


def _facts(model: LinearModel) -> list[str]:
    said = "no modes"
    if model.steady:
        said = "stable" if model.stable else "unstable"
    return [
        f"linear about {model.about}",
        f"{len(model.states)} states in {model.coordinates} coordinates",
        f"{len(model.inputs)} inputs, {len(model.outputs)} outputs",
        said,
    ]


def _lines(model: LinearModel) -> list[tuple[str, ...]]:
    out = []
    for mode in model.modes[:MOST_MODES] if model.steady else ():
        value = mode.eigenvalue
        frequency = f"{mode.natural_frequency:.6g}" if value.imag else ""
        ratio = f"{mode.damping_ratio:.4g}" if value.imag and mode.kind != "undamped vibration" else ""
        taking = ", ".join(f"{name} {100 * share:.0f} %" for name, share in mode.participation)
        sure = model.trust.verified and not mode.unresolved
        decays = sure and mode.kind.startswith(("damped", "decays"))
        tone = "red" if mode.kind.endswith("grows") else "green" if decays else ""
        kind = f"{mode.kind}, {mode.unresolved}" if mode.unresolved else mode.kind
        out.append((str(mode.number), mode.number_in_words, frequency, ratio, kind, taking, tone))
    return out


def _plane(model: LinearModel) -> str:
    values = model.eigenvalues
    if not model.steady or not len(values):
        return ""
    labels = [f"{value.real:.5g} {value.imag:+.5g}i 1/s" for value in values]
    real = np.where(np.abs(values.real) > ROUND_OFF * np.abs(values), values.real, 0.0)
    return points(real, values.imag, labels, "real part [1/s]", "imaginary part [1/s]")


def _bode(model: LinearModel) -> list[tuple[str, str]]:
    """(magnitude, phase) of the responses, one pair of plots for each input."""
    try:
        response = model.frequency_response()
    except ModelError:
        return []
    f, out = response["frequency"].to_numpy(), []
    for k, name in enumerate(model.inputs[:MOST_CURVES]):
        found = [(label, response.to_numpy()[:, j, k]) for j, label in enumerate(model.outputs[:MOST_CURVES])]
        found = [(label, values) for label, values in found if np.any(np.abs(values) > 0.0)]
        if not found:
            continue
        sizes = [Line(label, f, np.abs(values)) for label, values in found]
        turns = [Line(label, f, np.degrees(np.unwrap(np.angle(values)))) for label, values in found]
        unit = f"{name} [{model.input_units[k]}]"
        out.append(
            (
                curves(sizes, "frequency [Hz]", f"magnitude over {unit}", log_x=True, log_y=True),
                curves(turns, "frequency [Hz]", "phase [°]", log_x=True),
            )
        )
    return out


def _sampled(model: LinearModel) -> dict[str, Any] | None:
    """Poles and loops of sampled controllers."""
    own = model.sampled
    if own is None:
        return None
    rows = []
    for pole in own.modes[:MOST_MODES]:
        known = not np.isnan(pole.natural_frequency)
        numbers = (f"{pole.natural_frequency:.6g}", f"{pole.damping_ratio:.4g}") if known else ("", "")
        taking = ", ".join(f"{name} {100 * share:.0f} %" for name, share in pole.participation)
        rows.append((str(pole.number), pole.number_in_words, f"{abs(pole.z):.6g}", *numbers, taking))
    labels = [f"{z.real:.5g} {z.imag:+.5g}i" for z in own.poles]
    loops = []
    for loop in own.loops:
        f, size = loop.frequency, np.abs(loop.response)
        phase = np.degrees(np.unwrap(np.angle(loop.response)))
        drawn = [Line("|L|", f, size), Line("1", f, np.ones_like(f))]
        turned = [Line("phase of L", f, phase), Line("-180°", f, np.full_like(f, -180.0))]
        loops.append(
            (
                loop.words,
                curves(drawn, "frequency [Hz]", "magnitude of the open loop", log_x=True, log_y=True),
                curves(turned, "frequency [Hz]", "phase [°]", log_x=True),
            )
        )
    return {"words": own.words, "poles": rows, "plane": unit_circle(own.poles, labels), "loops": loops}


def _matrices(model: LinearModel) -> list[tuple[str, list[str], list[tuple[str, list[str]]]]]:
    wanted = (
        ("A", model.A, model.states, model.states),
        ("B", model.B, model.states, model.inputs),
        ("C", model.C, model.outputs, model.states),
        ("D", model.D, model.outputs, model.inputs),
    )
    return [
        (
            title,
            list(columns),
            [(name, [f"{value:.6g}" for value in row]) for name, row in zip(rows, values, strict=True)],
        )
        for title, values, rows, columns in wanted
        if values.size > 0 and max(values.shape) <= MOST_ENTRIES
    ]
