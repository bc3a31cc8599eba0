"""Quantiles of the parameters of a study: the value below which a share of the distribution lies."""

from __future__ import annotations

import math
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr, ndtri

from nivel.machine.study.any_quantity import si
from nivel.machine.study.parameter import Normal, Range, Tolerance, Triangular, Uniform, Values

Array = NDArray[np.float64]
SMALLEST = 2.0**-53  # share: that of the next number below 1


class Quantile(Protocol):
    """A distribution of SciPy."""

    def ppf(self, q: Any, /) -> Any:
        """Quantiles."""
        ...


Distribution = Values | Range | Uniform | Normal | Triangular | Tolerance | Quantile


def quantiles(parameter: Distribution, shares: Array) -> list[Any]:
    """Values at the shares (n,) between 0 and 1: SI numbers, or those that `values` lists, each with an equal part of the shares."""
    match parameter:
        case Values():
            count = len(parameter.values)
            return [parameter.values[min(int(share * count), count - 1)] for share in shares]
        case Range(spacing="logarithmic"):
            low, high = parameter.bounds
            return [float(low * (high / low) ** share) for share in shares]
        case Range() | Uniform():
            low, high = parameter.bounds
            return [float(low + (high - low) * share) for share in shares]
        case Triangular():
            low, high = parameter.bounds
            peak = 0.5 * (low + high) if parameter.peak is None else si(parameter.peak)
            return _triangular(low, peak, high, shares)
        case Normal():
            return _normal(si(parameter.mean), si(parameter.deviation), *parameter.bounds, shares)
        case Tolerance():
            low, high = parameter.bounds
            if parameter.distribution == "uniform":
                return [float(low + (high - low) * share) for share in shares]
            if parameter.distribution == "triangular":
                return _triangular(low, si(parameter.nominal), high, shares)
            return _normal(0.5 * (low + high), (high - low) / 6.0, low, high, shares)
    return [float(value) for value in parameter.ppf(shares)]


def _normal(mean: float, deviation: float, low: float, high: float, shares: Array) -> list[float]:
    """Of a normal distribution cut off at bounds: the share between them is that of the whole one."""
    least, most = ndtr((low - mean) / deviation), ndtr((high - mean) / deviation)
    inside = np.clip(least + shares * (most - least), SMALLEST, 1.0 - SMALLEST)
    return [float(value) for value in np.clip(mean + deviation * ndtri(inside), low, high)]


def _triangular(low: float, peak: float, high: float, shares: Array) -> list[float]:
    rising = (peak - low) / (high - low)
    return [
        low + math.sqrt(share * (high - low) * (peak - low))
        if share < rising
        else high - math.sqrt((1.0 - share) * (high - low) * (high - peak))
        for share in map(float, shares)
    ]
