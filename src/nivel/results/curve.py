"""Curve of a result between its frames, and the doubt about it.

Between two frames a number goes along the cubic with its value and its rate at both (Hermite). Rates are those of the result where it has
them, else of the polynomial through five frames. Each frame is compared with the cubic over its two neighbours, which is off by sixteen
times as much as those of single intervals where the curve is smooth, and by twice as much at a corner: half of what it misses is the doubt.
Where the result has second rates these are compared too: a vibration with whole periods between frames looks like rest to values alone.
A run looks at its numbers at times that are no frames (`nivel.analysis.run.probes`); what these are apart from their curves is doubt too.
"""

import json
from collections.abc import Callable, Mapping
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.known import Result
from nivel.lazy import Struct, replace
from nivel.machine.core.vectors import Array
from nivel.results.frames.contents import derivative, shape_of

STENCIL: Final = 5  # frames through which a polynomial is laid where rates are not known
DOUBT: Final = 0.5  # of what a cubic over two intervals misses at a corner, that over one does
RATES: Final = {
    "position": "velocity",
    "velocity": "acceleration",
    "angular_velocity": "angular_acceleration",
    "joint_coordinate": "joint_rate",
    "modal_coordinate": "modal_rate",
    "modal_rate": "modal_acceleration",
}
INTEGRALS: Final = {rate: name for name, rate in RATES.items()}
TOLD: Final = 1e-3  # of the range of a curve: a doubt about a number made from it that is said
ROUNDED: Final = 1e-9  # of the largest magnitude: a doubt that is round-off
IMPACT: Final = 0.1  # of the largest acceleration of all frames: a mean one between two frames that these do not show
QUARTERS: Final = (0.25, 0.5, 0.75)
PULSE: Final = (
    "pulse_between_frames"  # attribute of a result: in words, what a function does that no frame shows; may be missing
)
PROBED: Final = "between_frames"  # attribute of a result: JSON, by variable what its numbers are apart from their curves between frames


class Curve(Struct):
    """time (n,) [s], never falling; value (n, m), rate (n, m) [1/s]; doubt (n - 1, m) : what the cubic of an interval may be off by; hidden
    (n - 1, m) : how far beyond its frames and cubic it may go. A jump from one frame to the next is a doubt, and hides no extreme."""

    time: Array
    value: Array
    rate: Array
    doubt: Array
    hidden: Array

    @property
    def step(self) -> Array:
        """(n - 1, 1) [s] time between two frames; where it is 0 the curve jumps."""
        return np.diff(self.time)[:, None]

    @property
    def corners(self) -> tuple[Array, Array, Array, Array]:
        """Values and rates (n - 1, m) at both ends of the intervals, as `hermite` takes them."""
        return self.value[:-1], self.value[1:], self.rate[:-1], self.rate[1:]

    @property
    def negative(self) -> "Curve":
        """The curve with the other sign."""
        return replace(self, value=-self.value, rate=-self.rate)

    def is_told(self, doubt: Array) -> NDArray[np.bool_]:
        """(m,) whether doubts about values of the columns are said."""
        if not len(self.value):
            return np.zeros(self.value.shape[1], dtype=bool)
        extent, size = np.ptp(self.value, axis=0), np.max(np.abs(self.value), axis=0)
        return doubt > np.maximum(TOLD * extent, ROUNDED * size)

    def at(self, time: Array) -> Array:
        """(k, m) values at times (k,) [s]; of the first or the last frame outside of the curve."""
        if len(self.time) < 2:
            return self.value[np.zeros(len(time), dtype=np.intp)]
        k, share, step = self._place(time)
        return hermite(share, step, *(each[k] for each in self.corners))

    def doubt_at(self, time: Array) -> Array:
        """(k, m) doubt at times (k,) [s]; none at frames."""
        if len(self.time) < 2:
            return np.zeros((len(time), self.value.shape[1]))
        k, share, _ = self._place(time)
        return np.where((share > 0.0) & (share < 1.0), self.doubt[k], 0.0)

    def _place(self, time: Array) -> tuple[NDArray[np.intp], Array, Array]:
        """Numbers (k,) of the intervals of times, shares and lengths (k, 1) of these."""
        k = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.time) - 2)
        step = np.diff(self.time)[k]
        share = np.divide(time - self.time[k], step, out=np.ones_like(step), where=step > 0.0)
        return k, np.clip(share, 0.0, 1.0)[:, None], step[:, None]

    def within(self, start: float, end: float) -> "Curve":
        """The part from `start` to `end` [s], which lie on it."""
        if len(self.time) < 2:
            return self
        inside = np.flatnonzero((self.time > start) & (self.time < end))
        k, share, step = self._place(np.array([start, end]))
        corners = [each[k] for each in self.corners]
        ends = hermite(share, step, *corners), hermite_rate(share, step, *corners)
        value, rate = (
            np.concatenate([cut[:1], each[inside], cut[1:]])
            for cut, each in zip(ends, (self.value, self.rate), strict=True)
        )
        intervals = np.append(k[0], inside)
        time = np.concatenate([[start], self.time[inside], [end]])
        return Curve(time, value, rate, self.doubt[intervals], self.hidden[intervals])

    def doubted(self, more: Array) -> "Curve":
        """The curve that may be off by `more` (m,) or (n - 1, m) too, wherever it goes."""
        return replace(self, doubt=np.maximum(self.doubt, more), hidden=np.maximum(self.hidden, more))


# what grew beyond all bounds has doubt that is no number, and is no warning
@np.errstate(over="ignore", invalid="ignore")
def curve(time: Array, value: Array, rate: Array | None = None, second: Array | None = None) -> Curve:
    """The curve of values (n,) or (n, m). rate, second : derivatives where they are known.

    Of g pieces of one length, which have no jumps: times (n, g) and values (n, g, m), and all else in these shapes.
    """
    value = value.reshape(*time.shape, -1)
    rate, second = (None if each is None else each.reshape(value.shape) for each in (rate, second))
    slope, h = rates(time, value) if rate is None else rate, np.diff(time, axis=0)[..., None]
    if len(time) < STENCIL:
        few = np.zeros((max(len(time) - 1, 0), *value.shape[1:]))
        few += np.ptp(value, axis=0) if len(few) else 0.0
        few += 0.0 if rate is None else h * np.maximum(np.abs(slope[:-1]), np.abs(slope[1:]))
        return Curve(time, value, slope, few, few)
    missed = _missed(time, value, _rates_of_others(time, value) if rate is None else rate)
    doubt = DOUBT * np.where(h > 0.0, np.maximum(missed[:-1], missed[1:]), 0.0)
    out = Curve(time, value, slope, doubt, np.minimum(doubt, _beyond(value)))
    if second is None:
        return out
    bends = second[:-1], second[1:]
    off = [quintic(share, h, out.corners, bends) - hermite(share, h, *out.corners) for share in QUARTERS]
    return out.doubted(np.where(h > 0.0, np.max(np.abs(off), axis=0), 0.0))


def _beyond(value: Array) -> Array:
    """(n - 1, m) by how much the two frames of an interval are beyond the next one on either side; the first and the last as their
    neighbours."""
    low, high = (reduce(value[:-1], value[1:]) for reduce in (np.minimum, np.maximum))
    of_inner = np.maximum(high[1:-1] - np.maximum(value[:-3], value[3:]), np.minimum(value[:-3], value[3:]) - low[1:-1])
    inner = np.maximum(of_inner, 0.0)
    return np.concatenate([inner[:1], inner, inner[-1:]])


def curve_of(result: Result, name: str) -> Curve:
    """The curve of a name of a result, with all rates that the result has. Raises ModelError where there is no such name."""
    value, found = result.array(name), result.selection(name)
    out = _curve_of_part(result, found.variable, found.where[1:], value)
    off = probed(result.attributes).get(found.variable)
    if off is None:
        return out
    variable = result.variables[found.variable]
    shaped = np.asarray(off, dtype=float).reshape(shape_of(variable, result.coordinates))
    return out.doubted(shaped[found.where[1:]].reshape(-1))


def unseen_between_frames(result: Result) -> list[str]:
    """What forces, sensors and reactions do between frames that these show nothing of, in words."""
    pulse = str(result.attributes.get(PULSE, ""))
    return [*filter(None, [pulse, _impact(result)])]


def _impact(result: Result) -> str:
    """In words, the fastest change of velocities between two frames that accelerations at these do not show; empty where there is none.

    Δv - ½ h (a + b), over h: where it is above IMPACT of the largest acceleration, forces and reactions go beyond what frames show of them.
    """
    frames = result.time
    if result.is_statics or len(frames) < 2:
        return ""
    h = np.diff(frames)[:, None, None]
    for name, rate in (("velocity", "acceleration"), ("angular_velocity", "angular_acceleration")):
        if not {name, rate} <= set(result.variables):
            continue
        value, slope = result.array(name), result.array(rate)
        missed = np.abs(np.diff(value, axis=0) - 0.5 * h * (slope[1:] + slope[:-1]))
        by_time = np.divide(missed, h, out=np.zeros_like(missed), where=h > 0.0)
        by_time[missed < TOLD * np.max(np.abs(value), initial=0.0)] = 0.0
        if by_time.size and (most := np.nanmax(by_time)) > IMPACT * np.nanmax(np.abs(slope)):
            k, body, _ = np.unravel_index(np.nanargmax(by_time), by_time.shape)
            where = f"{result.coordinates['body'][body]} at t = {frames[k]:.6g} s"
            return f"an impact between frames, on {where}, of {most:.3g} {result.units(rate)} or more, which frames do not show"
    return ""


def probed(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """By variable what its numbers were apart from their curves at times between frames; without those that were not."""
    return json.loads(str(attributes.get(PROBED, "{}")))


def _curve_of_part(result: Result, variable: str, where: tuple[slice | int, ...], value: Array) -> Curve:
    """The curve of a part of a variable. A number whose integral goes otherwise by some doubt, between two frames, may be off by that over
    their time."""

    def part(name: str) -> Array | None:
        return result.array(name)[(slice(None), *where)] if name in result.variables else None

    known = {} if result.is_statics else RATES
    rate, whole = _beside(variable, known), _beside(variable, INTEGRALS if known else {})
    out = curve(result.time, value, part(rate), part(_beside(rate, known)))
    values, h = part(whole), out.step
    if values is None or not len(h):
        return out
    doubt = _curve_of_part(result, whole, where, values).doubt
    return out.doubted(np.divide(doubt, h, out=np.zeros_like(doubt), where=h > 0.0))


def _beside(variable: str, names: Mapping[str, str]) -> str:
    """The variable that `names` has for another one, also for the slopes of that along a parameter; empty where it has none."""
    if (parts := derivative(variable)) is None:
        return names.get(variable, "")
    return f"d({names[parts[0]]})/d({parts[1]})" if parts[0] in names else ""


def hermite(share: Any, h: Array, a: Array, b: Array, slope_a: Array, slope_b: Array) -> Array:
    """The cubic with values a, b and rates at both ends, at a share of the interval h."""
    c = b - a
    second, third = 3.0 * c - h * (2.0 * slope_a + slope_b), h * (slope_a + slope_b) - 2.0 * c
    return a + share * (h * slope_a + share * (second + share * third))


def hermite_rate(share: Any, h: Array, a: Array, b: Array, slope_a: Array, slope_b: Array) -> Array:
    """Its rate; 0 where it jumps."""
    c = b - a
    second, third = 3.0 * c - h * (2.0 * slope_a + slope_b), h * (slope_a + slope_b) - 2.0 * c
    change = h * slope_a + share * (2.0 * second + 3.0 * share * third)
    return np.divide(change, h, out=np.zeros_like(change), where=h > 0.0)


def quintic(share: float, h: Array, corners: tuple[Array, Array, Array, Array], bends: tuple[Array, Array]) -> Array:
    """The polynomial of degree five with values, rates and second rates, `bends`, at both ends."""
    (a, b, slope_a, slope_b), (bend_a, bend_b) = corners, bends
    rest = b - a - h * slope_a - 0.5 * h * h * bend_a
    turn, bend = h * (slope_b - slope_a) - h * h * bend_a, h * h * (bend_b - bend_a)
    third = 10.0 * rest - 4.0 * turn + 0.5 * bend
    fourth, fifth = -15.0 * rest + 7.0 * turn - bend, 6.0 * rest - 3.0 * turn + 0.5 * bend
    return a + share * (
        h * slope_a + share * (0.5 * h * h * bend_a + share * (third + share * (fourth + share * fifth)))
    )


def rates(time: Array, value: Array) -> Array:
    """Rates (n, m) of the polynomials through STENCIL frames about each, which do not go over jumps."""
    out = np.zeros_like(value)
    jumps = (np.flatnonzero(np.diff(time) <= 0.0) + 1).tolist() if time.ndim == 1 else []
    for first, last in zip([0, *jumps], [*jumps, len(time)], strict=True):
        n = last - first
        width = min(STENCIL, n)
        if width > 1:
            begin = np.clip(np.arange(n) - width // 2, 0, n - width)
            place = first + begin[:, None] + np.arange(width)
            weights = _weights(time[place] - time[first:last, None], np.arange(n) - begin)
            out[first:last] = np.einsum("kj...,kj...m->k...m", weights, value[place])
    return out


def _weights(x: Array, at: NDArray[np.intp]) -> Array:
    """Weights (n, k) of values at places x (n, k) in the derivative of the polynomial through them at the place `at` of each row; (n, k, g)
    of g pieces."""
    out, rows = np.zeros_like(x), np.arange(len(x))
    is_at = np.arange(x.shape[1])[:, None] == at
    is_at = is_at if x.ndim == 2 else is_at[..., None]
    for j in range(x.shape[1]):
        factors = np.ones_like(x[:, j])
        for i in range(x.shape[1]):
            if i != j:
                factors *= np.where(is_at[i], 1.0, -x[:, i]) / (x[:, j] - x[:, i])
        out[:, j] = np.where(is_at[j], 0.0, factors)
    out[rows, at] = -out.sum(axis=1)
    return out


def _rates_of_others(time: Array, value: Array) -> Array:
    """Rates at each frame by every other frame about it."""
    out = np.empty_like(value)
    for k in (0, 1):
        out[k::2] = rates(time[k::2], value[k::2])
    return out


def _missed(time: Array, value: Array, rate: Array) -> Array:
    """(n, m) by how much each frame is apart from the cubic over its neighbours; the first and the last frame as theirs."""
    h = (time[2:] - time[:-2])[..., None]
    share = np.divide((time[1:-1] - time[:-2])[..., None], h, out=np.zeros_like(h), where=h > 0.0)
    inner = np.abs(value[1:-1] - hermite(share, h, value[:-2], value[2:], rate[:-2], rate[2:]))
    return np.concatenate([inner[:1], inner, inner[-1:]])


# Reductions of curves to numbers: extremes, means and integrals of the cubics between frames, each with its doubt.

_PLACES, _WEIGHTS = np.polynomial.legendre.leggauss(4)
GAUSS: Final = tuple(zip(0.5 + 0.5 * _PLACES, 0.5 * _WEIGHTS, strict=True))  # exact for products of two cubics
CROSSING: Final = np.linspace(0.0, 1.0, 17)  # places in an interval in which the magnitude of a number has a corner


class Number(NamedTuple):
    """A number of each column of a curve, its doubt in the same units, and the time [s] at which it is an extreme; arrays (m,)."""

    value: Array
    doubt: Array
    time: Array


def largest(of: Curve) -> Number:
    """The largest value, and when. Where a cubic goes beyond its two frames by no more than its doubt, the larger frame counts: polynomials
    swing beside a jump."""
    if len(of.time) < 2:
        value = of.value[0] if len(of.time) else np.full(of.value.shape[1], np.nan)
        return Number(value, np.zeros_like(value), np.full_like(value, of.time[0] if len(of.time) else np.nan))
    h, corners, doubt = of.step, of.corners, of.hidden
    higher = corners[1] > corners[0]
    share, top = np.where(higher, 1.0, 0.0), np.maximum(*corners[:2])
    ends = top
    for root in _turns(h, *corners):
        value = hermite(root, h, *corners)
        beyond = value - ends
        counts = (value > top) & (beyond > of.doubt)
        doubt = np.where((value > top) & ~counts & (doubt > 0.0), np.maximum(doubt, beyond), doubt)
        share, top = np.where(counts, root, share), np.where(counts, value, top)
    known = np.where(np.isfinite(top), top, -np.inf)
    k, column = np.argmax(known, axis=0), np.arange(top.shape[1])
    value = np.where(np.isnan(of.value).any(axis=0), np.nan, top[k, column])
    most = np.max(np.where(np.isfinite(top), top + doubt, -np.inf), axis=0)
    return Number(value, np.where(np.isfinite(value), most - value, 0.0), of.time[k] + share[k, column] * h[k, 0])


def _turns(h: Array, a: Array, b: Array, slope_a: Array, slope_b: Array) -> tuple[Array, Array]:
    """Shares of intervals where cubics turn; 0 where they do not."""
    first = h * slope_a
    second, third = 3.0 * (b - a) - h * (2.0 * slope_a + slope_b), h * (slope_a + slope_b) - 2.0 * (b - a)
    with np.errstate(divide="ignore", invalid="ignore"):
        q = -(second + np.copysign(np.sqrt(second * second - 3.0 * third * first), second))
        roots = q / (3.0 * third), first / q
    before, after = (np.where((each > 0.0) & (each < 1.0), each, 0.0) for each in roots)
    return before, after


def turning_values(of: Curve) -> Array:
    """(k,) values at the frames and where the cubics turn between them, beyond the doubt, of a curve of one column."""
    if len(of.time) < 2:
        return of.value[:, 0]
    h, corners = of.step, of.corners
    roots = np.sort(np.stack(_turns(h, *corners)), axis=0)
    inside = np.stack([hermite(root, h, *corners) for root in roots])
    low, high = np.minimum(*corners[:2]), np.maximum(*corners[:2])
    is_turn = (roots > 0.0) & (np.maximum(inside - high, low - inside) > of.doubt)
    every = np.concatenate([corners[0][None], np.where(is_turn, inside, np.nan)])[:, :, 0].T.ravel()
    every = np.append(every, of.value[-1, 0])
    return every[~np.isnan(every)]


def smallest(of: Curve) -> Number:
    """The smallest value, and when."""
    found = largest(of.negative)
    return found._replace(value=-found.value)


def extreme(of: Curve) -> Number:
    """The value of largest magnitude, with its sign, and when."""
    high, low = largest(of), smallest(of)
    up = high.value >= -low.value
    most = np.maximum(high.value + high.doubt, low.doubt - low.value)
    doubt = most - np.maximum(high.value, -low.value)
    return Number(np.where(up, high.value, low.value), doubt, np.where(up, high.time, low.time))


def peak(of: Curve) -> Number:
    """The largest magnitude, and when."""
    found = extreme(of)
    return found._replace(value=np.abs(found.value))


def integral(of: Curve) -> Number:
    """The integral over time."""
    h, (a, b, slope_a, slope_b) = of.step, of.corners
    return _summed(of, 0.5 * h * (a + b) + h * h * (slope_a - slope_b) / 12.0, h * of.doubt)


def integral_of_product(a: Curve, b: Curve) -> Number:
    """The integral of the product of two curves with the same times."""
    h, total, doubt = a.step, np.zeros_like(a.doubt), np.zeros_like(a.doubt)
    for share, weight in GAUSS:
        first, second = hermite(share, h, *a.corners), hermite(share, h, *b.corners)
        total += weight * h * first * second
        doubt += weight * h * (np.abs(first) * b.doubt + np.abs(second) * a.doubt + a.doubt * b.doubt)
    return _summed(a, total, doubt)


def integral_of_magnitude(of: Curve) -> Number:
    """The integral of the magnitude over time."""
    h, corners = of.step, of.corners
    parts = np.abs(0.5 * h * (corners[0] + corners[1]) + h * h * (corners[2] - corners[3]) / 12.0)
    low, high = smallest_and_largest(of)
    crosses = np.flatnonzero(((low < 0.0) & (high > 0.0)).any(axis=1))
    if len(crosses):
        fine = np.abs([hermite(share, h[crosses], *(each[crosses] for each in corners)) for share in CROSSING])
        parts[crosses] = h[crosses] * np.mean(0.5 * (fine[1:] + fine[:-1]), axis=0)
    return _summed(of, parts, h * of.doubt)


def smallest_and_largest(of: Curve) -> tuple[Array, Array]:
    """Bounds (n - 1, m) of the cubics of all intervals."""
    h, corners = of.step, of.corners
    values = [*corners[:2], *(hermite(root, h, *corners) for root in _turns(h, *corners))]
    return np.min(values, axis=0), np.max(values, axis=0)


def _summed(of: Curve, parts: Array, doubts: Array) -> Number:
    end = np.full(of.value.shape[1], of.time[-1] if len(of.time) else np.nan)
    return Number(parts.sum(axis=0), doubts.sum(axis=0), end)


def mean(of: Curve) -> Number:
    """The integral over the time, as a share of that; of one frame its value."""
    span = _span(of)
    if not span > 0.0:
        return largest(of)
    found = integral(of)
    return found._replace(value=found.value / span, doubt=found.doubt / span)


def rms(of: Curve) -> Number:
    """The root of the mean square."""
    span = _span(of)
    if not span > 0.0:
        return peak(of)
    found = integral_of_product(of, of)
    value = np.sqrt(found.value / span)
    return found._replace(value=value, doubt=np.sqrt((found.value + found.doubt) / span) - value)


def mean_of_magnitude(of: Curve) -> Number:
    """The integral of the magnitude over the time, as a share of that."""
    found, span = integral_of_magnitude(of), _span(of) or 1.0
    return found._replace(value=found.value / span, doubt=found.doubt / span)


def _span(of: Curve) -> float:
    return float(of.time[-1] - of.time[0]) if len(of.time) > 1 else 0.0


REDUCTIONS: Final[Mapping[str, Callable[[Curve], Number]]] = {
    "max": largest,
    "min": smallest,
    "peak": peak,
    "mean": mean,
    "rms": rms,
    "integral": integral,
}
# what a number over time is beside: a pulse of short duration makes a small one beside the range of its curve
SIZES: Final[Mapping[str, Callable[[Curve], Number]]] = {
    "mean": mean_of_magnitude,
    "rms": rms,
    "integral": integral_of_magnitude,
}
