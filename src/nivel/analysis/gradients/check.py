"""Check of a gradient: its part along one direction of all parameters against differences of runs without dual numbers.

What a branch, a contact, an event or a search by secants cuts off a slope, is missing in the gradient and there in the difference.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from nivel.analysis.gradients.outputs import Array
from nivel.analysis.gradients.parameters import Parameter

# Parameters are moved by these shares of their scales; where steps are chosen by a tolerance, by the cube root of that.
STEP = 1e-4
# A gradient agrees where it is apart from the differences by this share of its scale, or by what these are apart from each other; from the
# second share on it is wrong.
AGREES, WRONG = 1e-5, 1e-2
# Runs of the same machine repeat a value but for this share of it.
REPEATED = 1e-13
SEED = 7
LIGHTS = ("green", "amber", "red")


@dataclass(frozen=True)
class Checked:
    """How far one output's gradient and differences are apart. apart : entry by entry, in the units of the output for a change of the
    parameters along the direction; weights : by how much each moves in that. light : green, amber or red."""

    apart: Array
    weights: Array
    light: str

    def errors(self) -> Array:
        """Estimated errors of the slopes, parameters first."""
        return np.array([self.apart / weight for weight in self.weights])


def direction(count: int) -> Array:
    """Shares of their scales by which the parameters move: of either sign, none much larger than another."""
    random = np.random.default_rng(SEED)
    return random.choice([-1.0, 1.0], count) * random.uniform(0.5, 1.0, count)


def check(
    slopes: Sequence[Array],
    parameters: Sequence[Parameter],
    run: Callable[[Array], Sequence[Array]],
    tolerance: float | None,
) -> tuple[Checked, ...]:
    """slopes : of each output, parameters first. run(values) : the outputs with these values of all parameters. tolerance : of steps that
    are chosen, or None."""
    scale, d = np.array([each.scale for each in parameters]), direction(len(parameters))
    base = np.array([each.value for each in parameters])
    step = STEP if tolerance is None else max(STEP, tolerance ** (1.0 / 3.0))
    near, far = (_difference(run, base, scale * d, factor * step) for factor in (1.0, 2.0))
    return tuple(_judge(each, scale * d, *pair) for each, *pair in zip(slopes, near, far, strict=True))


class _Difference(NamedTuple):
    """Of an output, and what of it is round-off."""

    value: Array
    round_off: float


def _difference(run: Callable[[Array], Sequence[Array]], base: Array, along: Array, step: float) -> list[_Difference]:
    return [
        _Difference((up - down) / (2.0 * step), REPEATED * float(np.max(np.abs(up), initial=0.0)) / step)
        if np.shape(up) == np.shape(down)
        else _Difference(np.full(np.shape(up), np.nan), 0.0)
        for up, down in zip(run(base + step * along), run(base - step * along), strict=True)
    ]


def _judge(slope: Array, along: Array, of_near: _Difference, of_far: _Difference) -> Checked:
    """Differences over a step and over two; what they say together is of order four."""
    near, far, round_off = of_near.value, of_far.value, of_near.round_off
    part = np.tensordot(along, slope, axes=(0, 0))
    if np.shape(near) != np.shape(part) or np.shape(far) != np.shape(part):
        return Checked(np.full(np.shape(part), np.nan), np.abs(along), "amber")
    apart = np.abs((4.0 * near - far) / 3.0 - part)
    size = float(np.max(np.tensordot(np.abs(along), np.abs(slope), axes=(0, 0)), initial=0.0))
    size = max(size, float(np.max(np.abs(near), initial=0.0)))
    doubt = float(np.max(np.abs(near - far), initial=0.0))
    worst = float(np.max(apart, initial=0.0)) if np.isfinite(apart).all() and np.isfinite(doubt) else np.inf
    if worst <= max(AGREES * size, round_off) or (worst <= doubt <= WRONG * size):
        light = "green"
    else:
        light = "amber" if worst <= WRONG * size or not np.isfinite(worst) or worst <= doubt else "red"
    return Checked(apart, np.abs(along), light)
