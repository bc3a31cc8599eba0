"""Check of a gradient: each slope against differences of runs without dual numbers, in which its parameter alone moves, and against the
slope of a run with finer steps.

What a branch, a contact, an event or a search by secants cuts off a slope, is missing in the slope and there in the difference; where steps
of fixed size contain the change, only if the parameter moves it over some of them.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.gradients.outputs import Array
from nivel.lazy import Struct

# Parameters are moved by this share of their scales and by twice as much; where steps are chosen by a tolerance, by the cube root of that.
STEP = 1e-4
# They are moved so far, too, that the motion comes so many steps, or samples, earlier or later: by these shares at least and at most.
STEPS, LEAST, MOST = 3.0, 4.0, 0.1
# A slope agrees where it is apart from the differences by this share of its scale, or by what these are apart from each other; from the
# second share on it is wrong.
AGREES, WRONG = 1e-5, 1e-2
# Over a long way differences bend, by the square of it: by what two short ones show, so many times, and by this share of the scale.
BENDS, FLAT = 2.0, 1e-3
# The scale of a slope is its size, or this share of the range of its output.
LITTLE = 1e-4
# Runs of the same machine repeat a value but for this share of it.
REPEATED = 1e-13
LIGHTS = ("green", "amber", "red")

# Outputs of the run in which one parameter, by its number, is moved by a share of its scale; None where there is no such run.
Moved = Callable[[int, float], Sequence[Array] | None]


class Slope(NamedTuple):
    """The slopes of one output along all parameters, which are the first axis, for a change of each by its scale. step_error : what the
    steps make of them, at most. range : of the output during the run."""

    value: Array
    step_error: Array
    range: float


class Checked(Struct):
    """How far the slopes of one output along all parameters can be trusted. errors : estimated, for a change of each by its scale. lights :
    green, amber or red."""

    errors: Array
    lights: tuple[str, ...]

    @property
    def light(self) -> str:
        """The worst."""
        return worst(self.lights)


def worst(lights: Sequence[str]) -> str:
    """The worst of some lights; `not checked` where there are none."""
    return max((each for each in lights if each in LIGHTS), key=LIGHTS.index, default="not checked")


def check(slopes: Sequence[Slope], moved: Moved, tolerance: float | None, far: Sequence[float]) -> tuple[Checked, ...]:
    """tolerance : of steps that are chosen, or None. far : shares by which the parameters have to be moved for the motion to come STEPS
    steps earlier or later."""
    step = STEP if tolerance is None else max(STEP, tolerance ** (1.0 / 3.0))
    rows = [
        _differences(moved, k, (step, 2.0 * step, float(np.clip(share, LEAST * step, max(LEAST * step, MOST)))))
        for k, share in enumerate(far)
    ]
    return tuple(_checked(slope, [row[number] for row in rows]) for number, slope in enumerate(slopes))


class _Difference(NamedTuple):
    """Of an output, per change of the parameter by its scale; the share by which it was moved, and what of it is round-off."""

    value: Array
    step: float
    round_off: float


def _differences(moved: Moved, k: int, steps: Sequence[float]) -> list[list[_Difference]]:
    """Central differences along parameter k over these steps, of each output. Over the last one no run may be possible: then over less."""
    by_step = [_difference(moved, k, step) for step in steps]
    if by_step[-1] is None:
        by_step[-1] = _difference(moved, k, max(LEAST * steps[0], 0.25 * steps[-1]))
    return [
        [each[number] for each in by_step if each is not None]
        for number in range(max(len(each or ()) for each in by_step))
    ]


def _difference(moved: Moved, k: int, step: float) -> list[_Difference] | None:
    ahead = moved(k, step)
    behind = None if ahead is None else moved(k, -step)
    if ahead is None or behind is None:
        return None
    return [
        _Difference((up - down) / (2.0 * step), step, REPEATED * float(np.max(np.abs(up), initial=0.0)) / step)
        if np.shape(up) == np.shape(down)
        else _Difference(np.full(np.shape(up), np.nan), step, 0.0)
        for up, down in zip(ahead, behind, strict=True)
    ]


def _checked(slope: Slope, differences: Sequence[Sequence[_Difference]]) -> Checked:
    judged = [
        _judge(value, error, LITTLE * slope.range, own)
        for value, error, own in zip(slope.value, slope.step_error, differences, strict=True)
    ]
    return Checked(np.array([error for error, _ in judged]), tuple(light for _, light in judged))


def _judge(slope: Array, step_error: Array, least: float, differences: Sequence[_Difference]) -> tuple[Array, str]:
    """The error of a slope and its light. Differences over a step and over two together are of order four."""
    nothing = np.full(np.shape(slope), np.nan)
    if len(differences) < 3 or any(np.shape(each.value) != np.shape(slope) for each in differences):
        return nothing, "amber"
    (near, step, round_off), (twice, _, _), (far, way, _) = differences
    apart = np.abs((4.0 * near - twice) / 3.0 - slope)
    size = max(_largest(slope), _largest(near), least)
    doubt, bent = _largest(near - twice), np.abs(twice - near) / (3.0 * step**2) * way**2
    light = _light(_largest(apart), doubt, round_off, size)
    beyond = np.maximum(np.abs(far - slope) - BENDS * bent - round_off * (way / step) ** 2, 0.0)
    error = np.maximum(apart, np.where(beyond > FLAT * size, beyond, 0.0)) + step_error
    if light == "green" and not (_largest(beyond) <= FLAT * size and _largest(error) <= WRONG * size):
        light = "amber"
    return error, light


def _light(apart: float, doubt: float, round_off: float, size: float) -> str:
    """What short differences say of a slope from which they are `apart`."""
    if not (np.isfinite(apart) and np.isfinite(doubt)):
        return "amber"
    if apart <= max(AGREES * size, round_off) or (apart <= doubt <= WRONG * size):
        return "green"
    return "amber" if apart <= WRONG * size or apart <= doubt else "red"


def _largest(values: Array | NDArray[np.float64]) -> float:
    """The largest magnitude; infinite where one is no number."""
    found = float(np.max(np.abs(values), initial=0.0))
    return found if np.isfinite(found) else np.inf
