"""Vibration: random response of linear models, transmissibility, shock response spectra, waterfall and order analysis of histories.

Power spectral densities are one-sided, in squares of SI units over Hz, so that the mean square is their integral over positive frequencies.
With G(iω) of the model and independent inputs S_y(f) = Σ |G_k|² S_k (Newland 1993, ch. 7). Under white noise of the level S at every
frequency the covariance P of the states solves A P + P Aᵀ + B (S/2) Bᵀ = 0 (Lyapunov).
"""

import re
from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from typing import Any, Final

import numpy as np

from nivel.errors import Fault, ModelError, gathered, refuse
from nivel.files.csv_tables import CsvError, numeric_columns
from nivel.files.measured_file import KINDS
from nivel.files.sources import read_bytes, read_text
from nivel.known import LinearModel, Result
from nivel.lazy import Struct, scipy, xarray
from nivel.machine.core.vectors import Array
from nivel.machine.study.any_quantity import another_measure
from nivel.machine.units.quantity import ANY, read_quantity
from nivel.machine.units.tree import ExpressionError
from nivel.results.curve import TOLD, Curve, curve_of
from nivel.words.wording import shown, unknown_word

Spectra = Mapping[str, Any] | str | PathLike[str]
FREQUENCY: Final = "frequency"
POWER: Final = re.compile(r"([A-Za-z°%]+)(?:\^(\d+))?")
SHOWN: Final = 400  # frequencies of a band at which a density is given
ACCURACY: Final = 1e-10  # of mean squares over a band, as a share
# share of the largest residue below which an input does not move a vibration, or an output does not see it
SEEN: Final = 1e-9
SAMPLES: Final = 50  # of a period of the oscillators of a shock response spectrum
ITERATIONS: Final = 6  # each leaves the share of the interval by which rates change of the error before
OVERLAP: Final = 8  # windows of a waterfall that overlap


class Spectrum(Struct):
    """A power spectral density of an input: levels (n,) at frequencies (n,) [Hz], straight in logarithms between them, nothing beyond;
    without frequencies white noise of one level."""

    frequencies: Array
    levels: Array

    @property
    def is_white(self) -> bool:
        """Whether it has one level at all frequencies."""
        return not len(self.frequencies)

    def at(self, f: Array) -> Array:
        """Levels (k,) at frequencies (k,) [Hz]."""
        if self.is_white:
            return np.full(len(f), self.levels[0])
        inside = (f >= self.frequencies[0]) & (f <= self.frequencies[-1])
        logs = np.interp(np.log(np.maximum(f, 1e-300)), np.log(self.frequencies), np.log(self.levels))
        return np.where(inside, np.exp(logs), 0.0)


def spectra_of(model: LinearModel, given: Spectra) -> dict[str, Spectrum]:
    """Spectra of inputs by name. given : a table (CSV, MAT, Parquet) with a column `frequency` and columns with names of inputs; or by name
    a level, (frequencies, levels), or such a table. Raises ModelError with all that is wrong."""
    if not isinstance(given, Mapping):
        table = _columns(fspath(given))
        frequencies, _ = table.pop(FREQUENCY)
        given = {name: (frequencies, levels, units) for name, (levels, units) in table.items()}
    units, out, faults = dict(zip(model.inputs, model.input_units, strict=True)), dict[str, Spectrum](), list[Fault]()
    for name, each in given.items():
        with gathered(faults, lambda fault, name=name: Fault.at(f"psd.{name}", fault.message)):
            port = port_of(name, model.inputs, "input")
            out[port] = _spectrum(name, each, f"{squared(units[port])}/Hz")
    if not given:
        faults.append(Fault.at("psd", "no input has a spectrum: name one, {'floor': 0.01}"))
    refuse(faults)
    return out


def port_of(name: str, known: Sequence[str], word: str) -> str:
    """The input or output of this name, which may be that of a joint with one coordinate. Raises ModelError."""
    found = [each for each in known if each == name] or [each for each in known if each.rpartition(".")[0] == name]
    if len(found) != 1:
        raise ModelError(unknown_word(name, list(known), word))
    return found[0]


def squared(units: str) -> str:
    """The square of a unit of results, as quantities are written: `m^2/s^4` of `m/s^2`."""
    return POWER.sub(lambda found: f"{found[1]}^{2 * int(found[2] or 1)}", units) or "1"


def _columns(file: str) -> dict[str, tuple[list[float], str]]:
    try:
        columns = numeric_columns(read_bytes(file) if file.lower().endswith(KINDS) else read_text(file), file)
    except CsvError as problem:
        raise ModelError(Fault(file, problem.line, 1 if problem.line else 0, "", str(problem))) from None
    if FREQUENCY not in columns or len(columns) < 2:
        message = f"a column `frequency [Hz]` and columns of levels were expected; there are {', '.join(columns)}"
        raise ModelError(Fault(file, 1, 1, "", message))
    return columns


def _spectrum(name: str, given: Any, measure: str) -> Spectrum:
    """Raises ModelError."""
    if isinstance(given, str | PathLike) and not _is_quantity(given):
        table = _columns(fspath(given))
        column = name if name in table else next(each for each in table if each != FREQUENCY)
        given = (table[FREQUENCY][0], *table[column])
    if isinstance(given, str | int | float):
        if wrong := another_measure(given, measure):
            raise ModelError(wrong)
        levels: Any = [read_quantity(given, ANY, {})]
        frequencies: Any = []
    else:
        rows: Any = given
        frequencies, levels, *unit = rows
        if unit and unit[0] and (wrong := another_measure(f"1 {unit[0]}", measure)):
            raise ModelError(wrong)
    f, s = np.asarray(frequencies, dtype=float), np.asarray(levels, dtype=float)
    if len(f) and (len(f) != len(s) or len(f) < 2 or not (np.diff(f) > 0.0).all() or not f[0] > 0.0):
        raise ModelError(f"frequencies above zero in ascending order were expected, a level for each, got {shown(f)}")
    if not np.isfinite(s).all() or not (s > 0.0).all():
        raise ModelError(f"levels above zero were expected, got {shown(s)}")
    return Spectrum(f, s)


def _is_quantity(text: Any) -> bool:
    try:
        read_quantity(text, ANY, {})
    except (ExpressionError, TypeError):
        return False
    return True


def random_response(model: LinearModel, given: Spectra, frequencies: Sequence[float] | Array | None) -> xarray.Dataset:
    """Density and root mean square of all outputs: `LinearModel.random_response`."""
    spectra = spectra_of(model, given)
    _refuse_without_end(model, spectra)
    bands = [each.frequencies for each in spectra.values() if not each.is_white]
    if frequencies is None:
        own = model.frequencies() if len(bands) < len(spectra) else np.zeros(0)
        ends = [np.geomspace(each[0], each[-1], SHOWN) for each in bands]
        natural = np.abs(model.eigenvalues) / (2.0 * np.pi)
        every = np.unique(np.concatenate([own, *ends, *bands, natural[natural > 0.0]]))
        limits = np.concatenate([own, *bands])
        frequencies = every[(every >= limits.min()) & (every <= limits.max())]
    f = np.asarray(frequencies, dtype=float)
    squares = np.zeros(len(model.outputs))
    for name, each in spectra.items():
        squares += _white(model, name, each) if each.is_white else _over_band(model, name, each)
    levels = np.array([each.at(f) for each in spectra.values()])
    columns = [model.inputs.index(name) for name in spectra]
    gains = np.abs(model.frequency_response(f).to_numpy()[:, :, columns]) ** 2
    said = {"long_name": "one-sided power spectral density", "units": "squares of units over Hz"}
    data = {
        "psd": (("frequency", "output"), np.einsum("foi,if->fo", gains, levels), said),
        "input_psd": (("frequency", "input"), levels.T, said),
        "rms": (("output",), np.sqrt(squares), {"long_name": "root mean square"}),
    }
    coords: dict[str, Any] = {"frequency": ("frequency", f, {"units": "Hz"}), "output": list(model.outputs)}
    coords |= {"input": list(spectra), "unit": ("output", list(model.output_units))}
    return xarray.Dataset(data, coords=coords, attrs={"machine": model.name, "about": model.about})


def _refuse_without_end(model: LinearModel, spectra: Mapping[str, Spectrum]) -> None:
    """Raise ModelError where vibrations grow, or what nothing damps, or holds, is excited for ever."""
    if not model.stable:
        raise ModelError(model.no_modes or "a model that is not stable has no steady response to a spectrum")
    observed = np.abs(model.C @ model.right).max(axis=0, initial=0.0)
    residue = observed * np.abs(model.left.conj().T @ model.B).max(axis=1, initial=0.0)
    seen = residue > SEEN * residue.max(initial=0.0)
    for mode in model.modes:
        k = int(np.argmin(np.abs(model.eigenvalues - mode.eigenvalue)))
        f = mode.natural_frequency
        excited = any(each.is_white or each.frequencies[0] <= f <= each.frequencies[-1] for each in spectra.values())
        if not mode.structural and mode.kind == "undamped vibration" and excited and seen[k]:
            endless = "so its response to a spectrum has no end: give it damping"
            raise ModelError(f"nothing damps the vibration at {f:.6g} Hz, {endless}")
    if model.structural.any() and any(each.is_white for each in spectra.values()):
        advice = "give the spectrum of a band, frequencies and levels"
        raise ModelError(f"white noise moves what has no stiffness without end: {advice}")


def _white(model: LinearModel, name: str, spectrum: Spectrum) -> Array:
    """Mean squares (outputs,) by Lyapunov's equation; infinite where the input passes through at once."""
    b = model.B[:, [model.inputs.index(name)]]
    covariance = scipy.linalg.solve_continuous_lyapunov(model.A, -0.5 * spectrum.levels[0] * b @ b.T)
    squares = np.maximum(np.einsum("oi,ij,oj->o", model.C, covariance, model.C), 0.0)
    return np.where(model.D[:, model.inputs.index(name)] != 0.0, np.inf, squares)


def _over_band(model: LinearModel, name: str, spectrum: Spectrum) -> Array:
    """Mean squares (outputs,) over the band: adaptive quadrature over ln f, which knows of the resonances and the corners."""
    k = model.inputs.index(name)
    unit, b, d = np.eye(len(model.A)), model.B[:, k], model.D[:, k]

    def density(x: float) -> Array:
        f = np.exp(x)
        gain = model.C @ np.linalg.solve(2j * np.pi * f * unit - model.A, b) + d
        return np.abs(gain) ** 2 * spectrum.at(np.array([f]))[0] * f

    peaks = np.abs(model.eigenvalues.imag) / (2.0 * np.pi)
    corners = np.unique(np.concatenate([spectrum.frequencies, peaks]))
    low, high = spectrum.frequencies[0], spectrum.frequencies[-1]
    inside = np.log(corners[(corners > low) & (corners < high)])
    found: Any = scipy.integrate.quad_vec(
        density, np.log(low), np.log(high), points=inside, epsabs=0.0, epsrel=ACCURACY, norm="max", limit=10_000
    )
    return np.asarray(found[0], dtype=np.float64)


def transmissibility(
    model: LinearModel, reference: str, source: str, frequencies: Sequence[float] | Array | None
) -> xarray.DataArray:
    """Responses of all outputs over that of the reference: `LinearModel.transmissibility`."""
    response = model.frequency_response(frequencies)
    first, *others = model.inputs
    if not source and others:
        raise ModelError(Fault.at("input", f"there are several inputs: name one of {', '.join(model.inputs)}"))
    own = response.sel(input=port_of(source or first, model.inputs, "input"), drop=True)
    with np.errstate(divide="ignore", invalid="ignore"):
        found = own / own.sel(output=port_of(reference, model.outputs, "output"), drop=True)
    found.name = "transmissibility"
    return found


def _uniform(of: Curve, step: float) -> Array:
    """Values (n,) of a curve of one column at steps [s] from its first to its last time."""
    count = int(np.floor((of.time[-1] - of.time[0]) / step * (1.0 + 1e-12))) + 1
    return of.at(of.time[0] + step * np.arange(count))[:, 0]


def _one(result: Result, name: str) -> Curve:
    """Raises ModelError where it is not one number at each time, or there is one time alone."""
    found = curve_of(result, name)
    if (count := found.value.shape[1]) != 1 or len(found.time) < 2:
        raise ModelError(Fault.at(name, f"one number over time was expected; it has {count}: name one of them"))
    return found


def shock_response_spectrum(
    result: Result, name: str, frequencies: Sequence[float] | Array, damping: float
) -> xarray.DataArray:
    """Largest absolute accelerations of oscillators on a base with this history: `Result.shock_response_spectrum`.

    Each passes the history, straight between samples, through its exact response (ramp-invariant filter, Smallwood 1981), and one period
    more, in which it vibrates freely. `doubt` of each is what the curve between frames leaves open, passed through the magnitude of the
    response to an impulse.
    """
    of, out, doubts = _one(result, name), [], []
    for f in np.asarray(frequencies, dtype=float):
        omega = 2.0 * np.pi * f
        frame = float(np.min(of.step[of.step > 0.0]))
        step = min(frame, 1.0 / (SAMPLES * f))
        states = np.array([[0.0, 1.0], [-(omega**2), -2.0 * damping * omega]])
        oscillator = (states, np.array([[0.0], [1.0]]), np.array([[omega**2, 2.0 * damping * omega]]), np.zeros((1, 1)))
        discrete: Any = scipy.signal.cont2discrete(oscillator, step, method="foh")
        numerator, denominator = scipy.signal.ss2tf(*discrete[:4])
        base = np.append(_uniform(of, step), np.zeros(int(np.ceil(1.0 / (f * step))) + 1))
        # at rest on a base that moves evenly before
        start = scipy.signal.lfilter_zi(numerator.ravel(), denominator) * base[0]
        response = np.abs(scipy.signal.lfilter(numerator.ravel(), denominator, base, zi=start)[0])
        out.append(_top(response))
        open_ones = of.doubt_at(of.time[0] + step * (np.arange(len(base)) + 0.5))[:, 0]
        impulse = np.abs(scipy.signal.lfilter(numerator.ravel(), denominator, np.eye(1, len(base))[0]))
        doubts.append(float(np.max(scipy.signal.fftconvolve(impulse, open_ones))))
    share = np.divide(doubts, np.maximum(out, 1e-300))
    k, units = int(np.argmax(share)), result.units(name)
    said = (
        f"the response at {frequencies[k]:g} Hz to {name} between frames, which may be off by {doubts[k]:.2g} {units}"
    )
    values: dict[str, Any] = {"frequency": np.asarray(frequencies, dtype=float), "doubt": np.array(doubts)}
    coords = {
        each: ("frequency", values[each], {"units": of_it}) for each, of_it in (("frequency", "Hz"), ("doubt", units))
    }
    facts = {"units": units, "long_name": f"shock response spectrum of {name}", "damping_ratio": damping}
    facts |= result.trust.of_derived(*[said] * int(share[k] > TOLD)).attributes()
    return xarray.DataArray(np.array(out), coords=coords, dims=("frequency",), attrs=facts)


def _top(values: Array) -> float:
    """The largest value, by the parabola through the largest sample and its neighbours."""
    k = int(np.argmax(values))
    if not 0 < k < len(values) - 1:
        return float(values[k])
    a, b, c = (float(each) for each in values[k - 1 : k + 2])
    bend = a - 2.0 * b + c
    return b - (a - c) ** 2 / (8.0 * bend) if bend < 0.0 else b


def _facts(result: Result, name: str, of: Curve, words: str) -> dict[str, Any]:
    """Attributes of amplitudes of a history, which are not verified where its frames leave more than vibrations of theirs open."""
    is_open = of.is_told(np.max(of.doubt, axis=0, initial=0.0))[0]
    lacks = [f"{name} between frames, where it may vibrate faster"] * int(is_open)
    return {"units": result.units(name), "long_name": words, **result.trust.of_derived(*lacks).attributes()}


def waterfall(result: Result, name: str, resolution: float) -> xarray.DataArray:
    """Amplitudes over time and frequency: `Result.waterfall`."""
    of = _one(result, name)
    step = float(np.median(of.step[of.step > 0.0]))
    place, f, values = _short_time(_uniform(of, step), step, 1.0 / resolution)
    facts = _facts(result, name, of, f"amplitude of {name}")
    time = {"time": ("time", of.time[0] + place, {"units": "s"})}
    coords: dict[str, Any] = {**time, "frequency": ("frequency", f, {"units": "Hz"})}
    return xarray.DataArray(values, coords=coords, dims=("time", "frequency"), attrs=facts)


def orders(result: Result, name: str, angle: str, resolution: float, most: float) -> xarray.DataArray:
    """Amplitudes over revolutions and orders: `Result.orders`. The history is sampled anew at equal angles, by its cubics."""
    of, turn = _one(result, name), _one(result, angle)
    revolutions = (turn.value[:, 0] - turn.value[0, 0]) / (2.0 * np.pi)
    revolutions *= np.sign(revolutions[-1]) or 1.0
    if not (np.diff(revolutions) > 0.0).all():
        raise ModelError(Fault.at(angle, "an angle that always grows, or always falls, was expected for orders"))
    step = 1.0 / (4.0 * most)  # twice what Nyquist asks for
    places: Array = np.arange(int(revolutions[-1] / step) + 1) * np.float64(step)
    time = _times_of(turn, revolutions, places)
    place, order, values = _short_time(of.at(time)[:, 0], step, 1.0 / resolution)
    speed = np.interp(np.interp(place, places, time), turn.time, turn.rate[:, 0])
    facts = _facts(result, name, of, f"amplitude of {name} by orders of {angle}")
    coords: dict[str, Any] = {"revolution": place, "order": order, "speed": ("revolution", speed, {"units": "rad/s"})}
    return xarray.DataArray(values, coords=coords, dims=("revolution", "order"), attrs=facts)[:, order <= most]


def _times_of(turn: Curve, revolutions: Array, places: Array) -> Array:
    """Times [s] at which an angle comes to these revolutions: its cubics solved from straight lines, with the rates at frames as slopes."""
    sign = np.sign(turn.value[-1, 0] - turn.value[0, 0])
    time = np.interp(places, revolutions, turn.time)
    for _ in range(ITERATIONS):
        there = sign * (turn.at(time)[:, 0] - turn.value[0, 0]) / (2.0 * np.pi)
        rate = sign * np.interp(time, turn.time, turn.rate[:, 0]) / (2.0 * np.pi)
        change = np.divide(places - there, rate, out=np.zeros_like(time), where=rate > 0.0)
        time = np.clip(time + change, turn.time[0], turn.time[-1])
    return time


def _short_time(values: Array, step: float, length: float) -> tuple[Array, Array, Array]:
    """Middles of windows, frequencies, amplitudes (windows, frequencies) of a sampled history. length : of Hann's window, which a vibration
    of one frequency fills with its amplitude. Raises ModelError where the history is shorter."""
    count = round(length / step)
    if count < 2 * OVERLAP or count > len(values):
        message = f"a window of 1/resolution = {length:g} has {count} of {len(values)} samples: take another resolution"
        raise ModelError(Fault.at("resolution", message))
    window = np.asarray(scipy.signal.get_window("hann", count), dtype=np.float64)
    found = scipy.signal.ShortTimeFFT(window, max(count // OVERLAP, 1), 1.0 / step, scale_to="magnitude")
    first, last = found.lower_border_end[1], found.upper_border_begin(len(values))[1]
    seen = np.abs(found.stft(values, p0=first, p1=last)).T
    seen[:, 1:] *= 2.0  # of both signs of a frequency
    return found.t(len(values), p0=first, p1=last), found.f, seen
