"""Impulse of every function that the steps of a run have missed.

Over each step the integral of the function, and that of its magnitude, are compared with those of what the method takes it for
(`nivel.analysis.curves.path`). What is missed is summed over a twentieth of the run, where
errors of both signs cancel as they do in the motion, and held against the integral of the magnitude. Features narrower than what lies
between samples are found by bounds of the function over intervals, which are halved as long as they allow more than was sampled.
"""

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.curves.functions import Varying, varying
from nivel.analysis.curves.path import Path, Steps, as_seen, cut_at_switches, path_of
from nivel.integrate.facts import IntegratorFacts
from nivel.lazy import Struct, replace
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.tree import TIME
from nivel.results.result import Result

# Parts of a step between samples, and how many parts of the run are judged by themselves.
SAMPLES, WINDOWS = 16, 20
# A part of the run where a function is below this share of its largest mean magnitude counts as if it had that.
QUIET = 1e-2
# Bounds that allow this share of the largest magnitude beyond what was sampled are looked into, by so many halvings; so many looks a step,
# and so many beside: a search takes about as long as the steps have taken.
BEYOND, HALVINGS, LOOKS, MORE_LOOKS = 0.05, 26, 16, 4000
# Shares from which on it is asked whether the signals go straight between two frames.
DOUBTFUL = 1e-3
# Share of the range of a state by which it is moved to find how fast it forgets.
SHIFT = 1e-6
# Below this share of the range of a state it counts as missed no more.
FORGOTTEN = 1e-2
# A found feature is sampled by so many points, which are halved so often where it changes; at most so many are.
FEATURE, SPLITS, MOST_FEATURES = 2048, 20, 32


class Unseen(Struct):
    """name : of a function. share : of the integral of its magnitude, over a twentieth of the run, that was missed. At `time` [s] it
    changes by its whole range within `scale` [s], where steps are `step` [s] long. of : what it depends on, the time or a signal.
    hidden : share of the integral of its magnitude over the whole run that was missed where it has more than the steps look at: no finer
    run need see that either. whole : the search for narrow features came to its end."""

    name: str
    share: float
    time: float
    scale: float
    step: float
    of: str = "time"
    hidden: float = 0.0
    whole: bool = True


def unseen_loads(
    machine: MachineRecord,
    result: Result,
    steps: Steps,
    facts: IntegratorFacts,
    *,
    chosen: bool,
    known: Mapping[str, float] | None = None,
) -> Iterator[Unseen]:
    """What the steps of a run have missed of each function that is looked at in every step and whose signals are known.

    chosen : the steps were chosen, and end at switches. known : of functions by name what they are known to give in a short time, which
    frames need not show: the integral of the magnitude.
    """
    for function in varying(machine):
        if function.of.startswith("events."):  # whose side alone counts
            continue
        path = path_of(function, machine, result)
        if path is not None and len(path.time) > 1:
            its = cut_at_switches(function, path, steps) if chosen else steps
            found = _missed_along(function, path, its, facts, (known or {}).get(function.name, 0.0))
            if found is not None:
                yield found


def _missed_along(function: Varying, path: Path, steps: Steps, facts: IntegratorFacts, known: float) -> Unseen | None:
    """What was missed of one function however its signals go between two frames: the less of what straight lines and splines say.

    The rate of a stiff state, k (f - x), is a small difference of two large terms: with straight lines of x it has bumps between frames,
    k h² x''/8, that no run has.
    """
    found = missed(function, path, steps, facts, known)
    if found is None or not path.can_curve or (found.share < DOUBTFUL and found.hidden == 0.0):
        return found
    other = missed(function, replace(path, curved=True), steps, facts, known)
    if other is None:
        return found
    return replace(min(found, other, key=lambda each: each.share), hidden=min(found.hidden, other.hidden))


def missed(function: Varying, path: Path, steps: Steps, facts: IntegratorFacts, known: float = 0.0) -> Unseen | None:
    """What was missed of one function; None where it has no value anywhere. known : what it gives in a short time."""
    # the samples of one share of all steps stand side by side, as sums over the samples of a step are fast then
    share = np.arange(SAMPLES + 1)[:, None] / SAMPLES
    time = steps.begin + steps.length * share
    values = function.curve.values(path.at(time.ravel())).reshape(time.shape).T
    finite = np.isfinite(values)
    if not finite.any():
        return None
    if not finite.all():
        values = np.where(finite, values, 0.0)
    curve = as_seen(values, steps, facts)
    exact, magnitude = _integrals(values, steps.length)
    seen, curve_magnitude = _integrals(curve, steps.length)
    # what changes its sign once in a step is a kink of the magnitude, not a vibration within the step
    vibrates = (np.diff(np.signbit(values), axis=1)).sum(axis=1) > 1
    seen_magnitude = np.where(vibrates, curve_magnitude, magnitude)
    places = beyond_samples(function, path, steps, values)
    narrow = _put_right(function, path, steps, places, exact, magnitude)
    features = np.union1d(places.step, _beyond_curve(values, curve))
    hidden = float(np.abs(exact - seen)[features].sum()) / max(float(magnitude.sum()), known, 1e-300)
    sums = exact - seen, magnitude - seen_magnitude, magnitude
    judged = replace(_judged(function, steps, sums, values, narrow, hidden, known), whole=places.whole)
    if len(places.step) or (judged.share < DOUBTFUL and hidden == 0.0):
        return judged
    forgotten = _forgotten(function, path, steps, np.abs(values - curve).max(axis=1))
    return replace(judged, share=forgotten, hidden=0.0) if forgotten < min(judged.share, FORGOTTEN) else judged


def _forgotten(function: Varying, path: Path, steps: Steps, off: Array) -> float:
    """Share of its range by which a state is wrong whose rate is `off` (n,) at most within steps; infinite where it does not forget.

    A rate f(x, t) with ∂f/∂x = -s < 0 that is off by ε leaves x off by no more than ε/s: what a stiff state misses decays at once.
    """
    own = [name for name in function.curve.signals if f"state.{name.partition('.')[0]}" == function.of]
    if not own:
        return np.inf
    x = path.signals[own[0]]
    extent = float(np.ptp(x))
    known, shift = path.at(steps.begin), SHIFT * extent
    before, after = (function.curve.values({**known, own[0]: known[own[0]] + sign * shift}) for sign in (-1.0, 1.0))
    decay = (before - after) / max(2.0 * shift, 1e-300)
    if not extent > 0.0 or not np.all(decay > 0.0):
        return np.inf
    return float(np.max(off / decay)) / extent


def _beyond_curve(values: Array, curve: Array) -> NDArray[np.int64]:
    """The steps in which samples go beyond what the method takes the function for."""
    beyond = np.maximum(values.max(axis=1) - curve.max(axis=1), curve.min(axis=1) - values.min(axis=1))
    return np.flatnonzero(beyond > BEYOND * float(np.abs(values).max()))


def _integrals(values: Array, length: Array) -> tuple[Array, Array]:
    """∫F and ∫|F| over the rows of `values` (n, SAMPLES + 1): composite Simpson, the trapezoidal rule for the magnitude where F changes
    its sign."""
    h = length / (values.shape[1] - 1)
    size = np.abs(values)
    changes = (values.min(axis=1) < 0.0) & (values.max(axis=1) > 0.0)
    trapezoidal = h * (size[:, 1:-1].sum(axis=1) + 0.5 * (size[:, 0] + size[:, -1]))
    ends, middles = values[:, 0] + values[:, -1], 4.0 * values[:, 1:-1:2].sum(axis=1)
    exact = h / 3.0 * (ends + middles + 2.0 * values[:, 2:-1:2].sum(axis=1))
    return exact, np.where(changes, trapezoidal, np.abs(exact))


class Places(Struct):
    """Where a function goes beyond what was sampled: numbers of steps (n,), ascending, and times in them (n,) [s]. whole : no place was
    left out because the search would have taken long."""

    step: NDArray[np.int64]
    time: Array
    whole: bool = True

    def within(self, step: int) -> Array:
        """The times in one step [s]."""
        return self.time[np.searchsorted(self.step, step) : np.searchsorted(self.step, step, side="right")]


def beyond_samples(function: Varying, path: Path, steps: Steps, values: Array, largest: float = 0.0) -> Places:
    """Where the function goes beyond its `values` (n, samples) over steps, by bounds of it over intervals. An interval is halved until its
    middle shows what the bounds allow, or these allow nothing any more. largest : the largest magnitude known beside."""
    low, high = values.min(axis=1), values.max(axis=1)
    begin, width = steps.begin, steps.length
    of = np.arange(len(begin))
    largest = max(largest, float(np.abs(values).max()))
    numbers, times = [np.zeros(0, dtype=np.int64)], [np.zeros(0)]
    left, whole = LOOKS * len(begin) + MORE_LOOKS, True
    for _ in range(HALVINGS):
        left -= len(begin)
        bounds = function.curve.bounds(path.at(begin), path.at(begin + width))
        if bounds is None:
            break
        least, most = bounds
        beyond = np.maximum(np.maximum(most - high, low - least), 0.0)
        floor = max(BEYOND * largest, 1e-6 * float(np.max(beyond, initial=0.0, where=np.isfinite(beyond))))
        keep = np.flatnonzero(beyond > floor)
        if 2 * len(keep) > left:
            whole, keep = False, keep[np.argsort(-beyond[keep], kind="stable")[: max(0, left // 2)]]
        if not len(keep):
            break
        begin, width, of, low, high = begin[keep], width[keep], of[keep], low[keep], high[keep]
        middle = begin + 0.5 * width
        inside = np.nan_to_num(function.curve.values(path.at(middle)))
        is_feature = np.maximum(inside - high, low - inside) > floor
        largest = max(largest, float(np.abs(inside).max()))
        numbers.append(of[is_feature])
        times.append(middle[is_feature])
        # what is found in an interval is known in both halves of it, and in no other
        low, high = np.tile(np.minimum(low, inside), 2), np.tile(np.maximum(high, inside), 2)
        begin, width, of = np.concatenate([begin, middle]), np.tile(0.5 * width, 2), np.tile(of, 2)
    number, time = np.concatenate(numbers), np.concatenate(times)
    order = np.lexsort((time, number))
    return Places(number[order], time[order], whole)


def _put_right(
    function: Varying, path: Path, steps: Steps, places: Places, exact: Array, magnitude: Array
) -> float | None:
    """The integrals over the steps that have `places`, of many over MOST_FEATURES of them, which then stand for the others; the shortest
    time [s] in which the function changes by its range there, None where there is none."""
    found = np.unique(places.step)
    if not len(found):
        return None
    chosen = found[np.unique(np.linspace(0, len(found) - 1, min(len(found), MOST_FEATURES)).astype(int))]
    refined = np.array(
        [_refined(function, path, float(steps.begin[k]), float(steps.length[k]), places.within(k)) for k in chosen]
    )
    mean = refined[:, :2].sum(axis=0) / steps.length[chosen].sum()
    exact[found], magnitude[found] = mean[0] * steps.length[found], mean[1] * steps.length[found]
    exact[chosen], magnitude[chosen] = refined[:, 0], refined[:, 1]
    return float(refined[:, 2].min())


def _refined(function: Varying, path: Path, begin: float, length: float, places: Array) -> tuple[float, float, float]:
    """∫F and ∫|F| over one step, with a sample wherever the function may have a feature, and the time [s] in which it changes by its
    range."""
    time, values = sampled_densely(function, path, begin, length, places)
    slope = float(np.max(np.abs(np.diff(values)) / np.maximum(np.diff(time), 1e-300)))
    scale = float(np.ptp(values)) / slope if slope > 0.0 else length
    return float(np.trapezoid(values, time)), float(np.trapezoid(np.abs(values), time)), scale


def sampled_densely(function: Varying, path: Path, begin: float, length: float, places: Array) -> tuple[Array, Array]:
    """Times (n,) [s] in one step, `places` among them, close together where the function changes, and its values (n,)."""
    time = np.union1d(begin + length * np.linspace(0.0, 1.0, FEATURE + 1), places[:FEATURE])
    values = np.nan_to_num(function.curve.values(path.at(time)))
    for _ in range(SPLITS):
        jump = np.abs(np.diff(values))
        split = np.flatnonzero(jump > 0.02 * max(float(np.abs(values).max()), 1e-300))
        if not len(split) or len(time) > 4 * FEATURE:
            break
        middle = 0.5 * (time[split] + time[split + 1])
        time = np.insert(time, split + 1, middle)
        values = np.insert(values, split + 1, np.nan_to_num(function.curve.values(path.at(middle))))
    return time, values


def _judged(
    function: Varying,
    steps: Steps,
    sums: tuple[Array, Array, Array],
    values: Array,
    narrow: float | None,
    hidden: float,
    known: float,
) -> Unseen:
    """The part of the run in which most is missed."""
    end = float(steps.begin[-1] + steps.length[-1])
    window = np.minimum((steps.begin / end * WINDOWS).astype(int), WINDOWS - 1)
    off, off_magnitude, magnitude = (np.bincount(window, each, WINDOWS) for each in sums)
    scale = np.maximum(magnitude, max(QUIET * float(magnitude.max()), known, 1e-300))
    share = np.maximum(np.abs(off), np.abs(off_magnitude)) / scale
    worst = int(np.argmax(share))
    inside = np.flatnonzero(window == worst)
    if not len(inside):
        return Unseen(function.name, 0.0, 0.0, 0.0, 0.0)
    k = int(inside[np.argmax(np.abs(sums[0][inside]) + np.abs(sums[1][inside]))])
    slope = float(np.abs(np.diff(values[k])).max()) * SAMPLES / float(steps.length[k])
    scale_of_time = float(np.ptp(values)) / slope if slope > 0.0 else float(steps.length[k])
    return Unseen(
        function.name,
        float(share[worst]),
        float(steps.begin[k]),
        min(scale_of_time, narrow if narrow is not None else np.inf),
        float(steps.length[k]),
        TIME if not function.curve.signals else function.curve.signals[0],
        hidden,
    )
