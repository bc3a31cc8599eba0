"""Loads of a result: peak and RMS reactions, power and work of actuators, cycles of any signal."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from nivel.errors import Fault, ModelError, refuse
from nivel.flexible.body.recovery import Cycle, rainflow
from nivel.known import Result
from nivel.lazy import xarray
from nivel.machine.core.record import Checked
from nivel.machine.core.vectors import Array
from nivel.machine.settings.values import settings_of
from nivel.machine.study.any_quantity import AnyQuantity, another_measure, si
from nivel.machine.units.quantity import asked
from nivel.results import curve as curves


def reactions(result: Result) -> "xarray.Dataset":
    """Largest magnitude, its time and RMS over time of the force [N] and torque [N m] of every joint, between frames too.

    The attributes have the trust report of the result; what the frames leave open is not verified. Raises ModelError for a result
    without reactions.
    """
    if "joint_force" not in result.variables or not len(result.time):
        raise ModelError("the result has no reactions of joints")
    values, lacks = {}, []
    for word, unit in (("force", "N"), ("torque", "N m")):
        parts = result.array(f"joint_{word}")
        sizes = with_probes(result, f"joint_{word}", curves.curve(result.time, np.linalg.norm(parts, axis=2)))
        highest = curves.largest(sizes)
        square = curves.mean(curves.curve(result.time, np.sum(parts**2, axis=2)))
        lacks += open_numbers(sizes, highest, f"peak {word} of {{}}", result.coordinates["joint"], unit)
        values[f"peak_{word}"] = (("joint",), highest.value, {"units": unit})
        values[f"peak_{word}_time"] = (("joint",), highest.time, {"units": "s"})
        values[f"rms_{word}"] = (("joint",), np.sqrt(np.maximum(square.value, 0.0)), {"units": unit})
    attributes = result.trust.of_derived(*_open(result, lacks)).attributes()
    return xarray.Dataset(values, coords={"joint": list(result.coordinates["joint"])}, attrs=attributes)


def with_probes(result: Result, variable: str, of: curves.Curve) -> curves.Curve:
    """A curve made of all numbers of a variable, a column for each of its elements, with what was seen of these between frames."""
    off = curves.probed(result.attributes).get(variable)
    if off is None:
        return of
    return of.doubted(np.linalg.norm(np.asarray(off, dtype=float).reshape(of.value.shape[1], -1), axis=1))


def open_numbers(of: curves.Curve, found: curves.Number, words: str, names: Sequence[str], units: str) -> list[str]:
    """What is open of numbers of the columns of a curve, in words: the worst of them."""
    share = found.doubt / max(float(np.max(np.abs(of.value), initial=0.0)), 1e-300)
    if not len(share) or not (open_ones := of.is_told(found.doubt) & (share > curves.TOLD)).any():
        return []
    k = int(np.argmax(np.where(open_ones, share, 0.0)))
    return [f"{words.format(names[k])} between frames, which may be off by {found.doubt[k]:.2g} {units}"]


def powers(result: Result, period: float | str | None = None) -> "xarray.Dataset":
    """Of every driver, coupling and force that reports its power: the largest magnitude [W], the work done and the work taken back [J].

    period : [s] of a cycle; then also the work of the last whole one [J], and its mean power [W]. Raises ModelError for a result without
    any power, or shorter than the period.
    """
    names = [name for name in result.variables if name.endswith(".power")]
    if not names or not len(result.time):
        raise ModelError("the result has no power of drivers or forces")
    seen = curves.probed(result.attributes)
    history = curves.curve(result.time, np.column_stack([result.array(name) for name in names]))
    history = history.doubted(np.array([seen[name][0] if name in seen else 0.0 for name in names]))
    dims, elements = ("element",), [name.removesuffix(".power") for name in names]
    highest, net, both = curves.peak(history), curves.integral(history), curves.integral_of_magnitude(history)
    done = curves.Number(0.5 * (both.value + net.value), both.doubt, both.time)
    values = {
        "peak_power": (dims, highest.value, {"units": "W"}),
        "work_done": (dims, done.value, {"units": "J"}),
        "work_taken": (dims, 0.5 * (net.value - both.value), {"units": "J"}),
    }
    lacks = open_numbers(history, highest, "peak power of {}", elements, "W")
    lacks += _open_work(done, both, elements)
    if period is not None:
        period = asked("loads.period", period, "time")
        work = _of_cycle(history, period)
        lacks += _open_work(work, both, elements)
        values["work_per_cycle"] = (dims, work.value, {"units": "J"})
        values["mean_power"] = (dims, work.value / period, {"units": "W"})
    return xarray.Dataset(
        values, coords={"element": elements}, attrs=result.trust.of_derived(*_open(result, lacks)).attributes()
    )


def _open(result: Result, lacks: list[str]) -> list[str]:
    """What is open of loads, with impacts and pulses that frames do not show."""
    return [*lacks, *curves.unseen_between_frames(result)]


def _open_work(work: curves.Number, both: curves.Number, names: Sequence[str]) -> list[str]:
    """What is open of works, beside all work done and taken back."""
    share = work.doubt / max(float(np.max(both.value, initial=0.0)), 1e-300)
    k = int(np.argmax(share))
    said = f"work of {names[k]} between frames, which may be off by {work.doubt[k]:.2g} J"
    return [said] if share[k] > curves.TOLD else []


def _of_cycle(power: curves.Curve, period: float) -> curves.Number:
    """Work [J] from the end of the result back over one period."""
    first, last = float(power.time[0]), float(power.time[-1])
    if not 0.0 < period <= (last - first) * (1.0 + 1e-9):
        wanted = f"a period above zero and up to the {last - first:.6g} s of the result"
        raise ModelError(f"{wanted} was expected, got {period:.6g} s")
    return curves.integral(power.within(max(last - period, first), last))


class FatigueCurve(Checked):
    """S–N curve: the amplitude `strength` is borne `knee` times, a larger one N = knee (strength/S)^slope times (Basquin 1910), a smaller
    one likewise with `slope_below`, without which it does no damage.

    ultimate : tensile strength R, for amplitudes S/(1 - mean/R) about a tensile mean (Goodman); without one a mean has no effect.
    """

    strength: AnyQuantity
    knee: AnyQuantity
    slope: AnyQuantity
    slope_below: AnyQuantity | None = None
    ultimate: AnyQuantity | None = None

    @classmethod
    def of(cls, given: Mapping[str, Any], units: str) -> "FatigueCurve":
        """Of numbers, or texts with units, by name; units : of strengths. Raises ModelError with everything that is wrong."""
        curve, faults = settings_of(cls, "fatigue", given), list[Fault]()
        values = {name: value for name, value in curve.model_dump().items() if value is not None}
        for name, value in values.items():
            wrong = another_measure(value, units if name in ("strength", "ultimate") else "1")
            if wrong or not si(value) > 0.0:
                faults.append(Fault.at(f"fatigue.{name}", wrong or f"a number above zero was expected, got {value}"))
        refuse(faults)
        return curve.replace(**{name: si(value) for name, value in values.items()})

    def damages(self, cycles: Sequence[Cycle]) -> Array:
        """(n,) count/N of each; infinite where the mean reaches the ultimate strength. Their sum is the damage (Palmgren, Miner 1945)."""
        ranges, means, counts = np.array([[each.range, each.mean, each.count] for each in cycles]).reshape(-1, 3).T
        left = 1.0 - np.maximum(means, 0.0) / (self.ultimate or np.inf)
        with np.errstate(divide="ignore"):
            share = np.where(left > 0.0, 0.5 * ranges / left, np.inf) / self.strength
        return counts * np.where(share >= 1.0, share**self.slope, share ** (self.slope_below or np.inf)) / self.knee


def cycles(
    result: Result, name: str, *, repeating: bool = False, fatigue: Mapping[str, Any] | None = None
) -> "xarray.Dataset":
    """Rainflow cycles (ASTM E1049, section 5.4.4) of a signal by its name, a number at a time: range, mean and count, ranges ascending.
    It turns back between frames too.

    repeating : the history goes on as it began, so that it starts at its largest peak and has no half cycles (section 5.4.5).
    fatigue : numbers of a `FatigueCurve`, by which each has a `damage`, and the attribute `damage` is their sum.
    Raises ModelError for names that the result does not have, and for vectors: take a component.
    """
    values = result.array(name)
    if values.ndim != 1:
        raise ModelError(f"`{name}` has several numbers at a time; take one of them, e.g. `{name}.x`")
    if not np.isfinite(values).all():
        raise ModelError(f"`{name}` is not a number at every time")
    of = curves.curve_of(result, name)
    turns = curves.turning_values(of)
    if repeating and len(turns):
        start = int(np.argmax(np.abs(turns - values.mean())))
        turns = np.append(np.roll(turns, -start), turns[start])
    found = sorted(rainflow(turns))
    if repeating:
        found = _whole(found)
    columns = np.array([[each.range, each.mean, each.count] for each in found]).reshape(-1, 3)
    unit = result[name].attrs.get("units", "")
    units = {"units": unit}
    data = {
        "range": (("cycle",), columns[:, 0], units),
        "mean": (("cycle",), columns[:, 1], units),
        "count": (("cycle",), columns[:, 2], {"units": "1"}),
    }
    attributes: dict[str, Any] = {"signal": name}
    if fatigue is not None:
        each = FatigueCurve.of(fatigue, unit).damages(found)
        data["damage"] = (("cycle",), each, {"units": "1"})
        attributes["damage"] = float(each.sum())
    is_open = of.is_told(np.max(of.doubt, axis=0, initial=0.0))[0]
    lacks = [f"{name} between frames, where cycles may be larger"] * int(is_open)
    return xarray.Dataset(data, attrs={**attributes, **result.trust.of_derived(*_open(result, lacks)).attributes()})


def _whole(found: list[Cycle]) -> list[Cycle]:
    """Pairs of halves of one range as whole cycles."""
    halves = [each for each in found if each.count < 1.0]
    whole = [each for each in found if each.count == 1.0]
    whole += [Cycle(a.range, 0.5 * (a.mean + b.mean), 1.0) for a, b in zip(halves[::2], halves[1::2], strict=True)]
    return sorted(whole)
