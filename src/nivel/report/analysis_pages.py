"""Pages of analyses. Linearisation: eigenvalues and modes, frequency response, matrices. Motion: efforts of inverse dynamics; coupler
curves and transmission angles."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from nivel.errors import ModelError
from nivel.report.page import page
from nivel.report.plots import TONES, Line, curves, path_drawing, points, unit_circle
from nivel.report.story import trusted
from nivel.results.analyses.efforts import Efforts
from nivel.results.analyses.linear_model import ROUND_OFF, LinearModel
from nivel.results.analyses.linear_sweep import TURN, LinearSweep
from nivel.results.analyses.mechanism import Studies
from nivel.results.analyses.vibration import squared


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


MOST_MODES: Final = 60
MOST_CURVES: Final = 8
MOST_ENTRIES: Final = 12  # rows and columns of a matrix that are shown


def linear_html(model: LinearModel) -> str:
    """The page as text."""
    return page(
        "linear.html.j2",
        ("reduction.css", "plots.css"),
        model=model,
        facts=_facts(model),
        trusted=trusted(model.trust),
        lines=_lines(model),
        beyond=max(0, len(model.modes) - MOST_MODES),
        plane=_plane(model),
        bode=_bode(model),
        random=_random(model),
        sampled=_sampled(model),
        matrices=_matrices(model),
    )


def _facts(model: LinearModel) -> list[str]:
    return [
        f"linear about {model.about}",
        f"{len(model.states)} states in {model.coordinates} coordinates",
        f"{len(model.inputs)} inputs, {len(model.outputs)} outputs",
        "no modes" if not model.steady else "stable" if model.stable else "unstable",
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
        out.append(_pair(sizes, f"magnitude over {name} [{model.input_units[k]}]", turns))
    return out


def _pair(sizes: list[Line], title: str, turns: list[Line]) -> tuple[str, str]:
    over = curves(sizes, "frequency [Hz]", title, log_x=True, log_y=True)
    return over, curves(turns, "frequency [Hz]", "phase [°]", log_x=True)


def _random(model: LinearModel) -> dict[str, Any] | None:
    """Densities of the response to spectra, and root mean squares."""
    found = model.random
    if found is None:
        return None
    f, units = found.frequency.values, dict(zip(model.outputs, model.output_units, strict=True))
    lines = [
        Line(f"{name} [{squared(units[name])}/Hz]", f, found.psd.values[:, j])
        for j, name in enumerate(model.outputs[:MOST_CURVES])
    ]
    given = [Line(str(name), f, found.input_psd.values[:, k]) for k, name in enumerate(found.input.values)]
    rows = [(name, f"{value:.6g}", units[name]) for name, value in zip(model.outputs, found.rms.values, strict=True)]
    titles = ("frequency [Hz]", "power spectral density")
    return {"rows": rows, "plots": [curves(each, *titles, log_x=True, log_y=True) for each in (lines, given)]}


def _sampled(model: LinearModel) -> dict[str, Any] | None:
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
        f, phase = loop.frequency, np.degrees(np.unwrap(np.angle(loop.response)))
        drawn = [Line("|L|", f, np.abs(loop.response)), Line("1", f, np.ones_like(f))]
        turned = [Line("phase of L", f, phase), Line("-180°", f, np.full_like(f, -180.0))]
        loops.append((loop.words, *_pair(drawn, "magnitude of the open loop", turned)))
    return {"words": own.words, "poles": rows, "plane": unit_circle(own.poles, labels), "loops": loops}


def _matrices(model: LinearModel) -> list[tuple[str, list[str], list[tuple[str, list[str]]]]]:
    out = []
    for title in "ABCD":
        values, columns = getattr(model, title), model.states if title in "AC" else model.inputs
        if values.size > 0 and max(values.shape) <= MOST_ENTRIES:
            rows = zip(model.states if title in "AB" else model.outputs, values, strict=True)
            out.append((title, list(columns), [(name, [f"{value:.6g}" for value in row]) for name, row in rows]))
    return out


SWEEP_NOTE = "Modes are followed by their eigenvectors. A vibration meets a multiple of a speed where its line crosses that of the order."


def sweep_html(sweep: LinearSweep, orders: Sequence[float] = ()) -> str:
    """The page as text."""
    said = sweep.statements() + [each.words(sweep.unit) for each in sweep.crossings(orders)]
    return page(
        "plots.html.j2",
        ("reduction.css", "plots.css"),
        name=f"{sweep.models[0].name}: eigenvalues over {sweep.parameter}",
        said=said or ["nothing changes its stability"],
        plots=_sweep_plots(sweep, orders),
        trusted=trusted(sweep.trust),
        note=SWEEP_NOTE,
    )


def _sweep_plots(sweep: LinearSweep, orders: Sequence[float]) -> list[tuple[str, str]]:
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
