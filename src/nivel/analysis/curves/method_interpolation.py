"""Interpolation of a function by a method within a step: a curve through the places where it looks.

Runge–Kutta methods look inside a step: here at places evenly spaced, as many as have the integral of the order of the method. Methods
of several steps look at the ends of steps, and their curve passes through those of earlier steps too: a cubic spline has about the same
integral, where the function has a corner a straight line.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.curves.path import Steps
from nivel.integrate.facts import IntegratorFacts

Array = NDArray[np.float64]
# steps that a spline needs
LEAST_STEPS = 4
ENDS, SIMPSON, BOOLE = 2, 3, 5


def as_seen(values: Array, steps: Steps, facts: IntegratorFacts) -> Array:
    """Values (n, samples) of a function at places evenly spaced over each step, begin and end among them; returns what the method takes
    them for (n, samples). The number of samples less one is a multiple of four."""
    if facts.order <= 2:
        return _through(values, ENDS)
    if facts.multistep:
        return _over_steps(values, steps)
    return _through(values, SIMPSON if facts.order <= 4 else BOOLE)


def _through(values: Array, count: int) -> Array:
    """The polynomial through `count` of the samples, evenly spaced."""
    share = np.linspace(0.0, 1.0, values.shape[1])
    at = np.linspace(0.0, 1.0, count)
    places = np.linspace(0, values.shape[1] - 1, count).astype(int)
    weights = np.ones((count, len(share)))
    for j in range(count):
        for k in range(count):
            if k != j:
                weights[j] *= (share - at[k]) / (at[j] - at[k])
    return (weights.T @ values[:, places].T).T  # in the order of `values`, whose columns stand side by side


def _over_steps(values: Array, steps: Steps) -> Array:
    """A spline through the ends of all steps, straight lines where these miss less of the integral."""
    from scipy.interpolate import CubicSpline  # takes a quarter of a second to import

    straight = _through(values, ENDS)
    follow = np.allclose(steps.begin[1:], steps.begin[:-1] + steps.length[:-1], rtol=1e-9, atol=0.0)
    if len(steps.begin) < LEAST_STEPS or not follow:
        return straight
    ends = np.append(steps.begin, steps.begin[-1] + steps.length[-1])
    share = np.linspace(0.0, 1.0, values.shape[1])
    curve = CubicSpline(ends, np.append(values[:, 0], values[-1, -1]))
    smooth = curve(steps.begin[:, None] + steps.length[:, None] * share)
    closer = np.abs((values - smooth).mean(axis=1)) < np.abs((values - straight).mean(axis=1))
    return np.where(closer[:, None], smooth, straight)
