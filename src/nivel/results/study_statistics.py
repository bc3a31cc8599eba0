"""Statistics of a study: its table, shares within limits, main effects, response surfaces and Sobol indices of its outputs."""

import json
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import Struct, field, xarray
from nivel.machine.core.vectors import Array

ENDED: Final = ("done", "stopped")
CONFIDENCE: Final = 1.959963984540054  # standard deviations of 95 %
RESAMPLES: Final = 200  # of the bootstrap of Sobol indices
WHOLE: Final = 1.0 - 1e-9  # leverage of a variant that alone determines a coefficient
LEAST_LEFT: Final = 2  # variants beyond the coefficients of a response surface
SOBOL: Final = "sobol-indices"


class Table(Struct):
    """A study as a table, a row for each variant. values : (n,) of parameters, and of outputs, by name; words are numbered, and listed in
    `words`. ended : (n,) whether a variant came to its end."""

    parameters: Mapping[str, Array]
    outputs: Mapping[str, Array]
    units: Mapping[str, str]
    limits: Mapping[str, tuple[float | None, float | None]]
    ended: NDArray[np.bool_]
    outcome: tuple[str, ...]
    reason: tuple[str, ...]
    words: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    design: str = ""
    samples: int = 0

    @classmethod
    def of(cls, dataset: "xarray.Dataset") -> "Table":
        """That of the dataset of a study, also of a sweep that had outputs."""
        shape, dims = dataset["outcome"].shape, dataset["outcome"].dims
        names = json.loads(dataset.attrs.get("parameters", "null")) or [
            str(name) for name, each in dataset.coords.items() if set(each.dims) <= set(dims)
        ]
        parameters: dict[str, Array] = {}
        words: dict[str, tuple[str, ...]] = {}
        for name in names:
            values = dataset[name].broadcast_like(dataset["outcome"]).transpose(*dims).values.reshape(-1)
            if values.dtype.kind not in "fiub":
                words[name] = tuple(dict.fromkeys(map(str, values)))
                values = np.array([words[name].index(str(each)) for each in values])
            parameters[name] = values.astype(float)
        listed = json.loads(dataset.attrs.get("outputs", "[]"))
        outputs = {name: dataset[name].values.reshape(-1).astype(float) for name in listed}
        outcome = tuple(map(str, dataset["outcome"].values.reshape(np.prod(shape, dtype=int))))
        return cls(
            parameters,
            outputs,
            {name: str(dataset[name].attrs.get("units", "")) for name in (*parameters, *outputs)},
            {name: _limits(dataset[name].attrs) for name in outputs},
            np.array([each in ENDED for each in outcome]),
            outcome,
            tuple(map(str, dataset["reason"].values.reshape(-1))),
            words,
            str(dataset.attrs.get("design", "")),
            int(dataset.attrs.get("samples", 0)),
        )

    @property
    def limited(self) -> tuple[str, ...]:
        """Outputs that have a limit."""
        return tuple(name for name, limits in self.limits.items() if limits != (None, None))

    def within(self, name: str) -> NDArray[np.bool_]:
        """(n,) whether an output is within its limits; what has no number is not."""
        least, most = self.limits[name]
        values = self.outputs[name]
        inside = self.ended & np.isfinite(values)
        with np.errstate(invalid="ignore"):
            return inside & (least is None or values >= least) & (most is None or values <= most)

    @cached_property
    def accepted(self) -> NDArray[np.bool_]:
        """(n,) whether all limits are kept."""
        return np.logical_and.reduce([self.ended, *(self.within(name) for name in self.limited)])

    @property
    def numeric(self) -> tuple[str, ...]:
        """Parameters that are numbers, of which there are several."""
        return tuple(name for name, each in self.parameters.items() if name not in self.words and np.ptp(each) > 0.0)


def _limits(facts: Mapping[str, Any]) -> tuple[float | None, float | None]:
    least, most = (facts.get(key) for key in ("at_least", "at_most"))
    return None if least is None else float(least), None if most is None else float(most)


class Share(Struct):
    """A share of variants, with its confidence interval of 95 % (Wilson 1927)."""

    count: int
    of: int

    @property
    def value(self) -> float:
        """Between 0 and 1; not a number of none."""
        return self.count / self.of if self.of else np.nan

    @property
    def interval(self) -> tuple[float, float]:
        """Lower and upper bound."""
        if not self.of:
            return np.nan, np.nan
        z, n, p = CONFIDENCE, self.of, self.value
        middle = (p + z * z / (2 * n)) / (1 + z * z / n)
        half = z / (1 + z * z / n) * np.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
        return (middle - half if self.count else 0.0), (middle + half if self.count < n else 1.0)


def share_within(table: Table, name: str | None = None) -> Share:
    """Variants within the limits of one output, or of all."""
    inside = table.accepted if name is None else table.within(name)
    return Share(int(inside.sum()), len(inside))


def capability(table: Table, name: str) -> float:
    """Process capability Cpk of an output: the distance of its mean from the nearer limit, in three standard deviations."""
    least, most = table.limits[name]
    values = table.outputs[name][table.ended & np.isfinite(table.outputs[name])]
    if len(values) < 2 or not (deviation := float(np.std(values, ddof=1))) > 0.0:
        return np.nan
    mean = float(np.mean(values))
    distances = [mean - least] if least is not None else []
    distances += [most - mean] if most is not None else []
    return min(distances) / (3.0 * deviation) if distances else np.nan


class Surface(Struct):
    """A response surface: a polynomial of the parameters, each from -1 at its least to 1 at its greatest value, fitted by least squares.

    powers (k, p) : exponents of the terms. coefficients (k,). predicted : coefficient of determination of values that were left out one by
    one (Q²), from the residuals over 1 - leverage (PRESS, Allen 1974), of those that can be left out.
    """

    parameters: tuple[str, ...]
    low: Array
    high: Array
    powers: NDArray[np.int_]
    coefficients: Array
    determined: float
    predicted: float

    def at(self, scaled: Array) -> Array:
        """(n,) values at (n, p) scaled parameters."""
        return _terms(scaled, self.powers) @ self.coefficients


def surface(table: Table, output: str) -> Surface | None:
    """Quadratic where there are enough variants, else linear; None where there are fewer still, or nothing varies."""
    names = table.numeric
    known = table.ended & np.isfinite(table.outputs[output])
    if not names or not known.any():
        return None
    x = np.stack([table.parameters[name] for name in names], axis=1)[known]
    y = table.outputs[output][known]
    low, high = x.min(axis=0), x.max(axis=0)
    if not (high > low).all():
        return None
    scaled = 2.0 * (x - low) / (high - low) - 1.0
    levels = [len(np.unique(each)) for each in scaled.T]
    for powers in (_quadratic(levels), np.concatenate([np.zeros((1, len(names)), int), np.eye(len(names), dtype=int)])):
        terms = _terms(scaled, powers)
        if len(y) >= len(powers) + LEAST_LEFT and np.linalg.matrix_rank(terms) == len(powers):
            return _fitted(names, low, high, powers, terms, y)
    return None


def _quadratic(levels: Sequence[int]) -> NDArray[np.int_]:
    """Exponents of a quadratic polynomial; no squares of parameters with two values."""
    count = len(levels)
    rows = [np.zeros(count, int), *np.eye(count, dtype=int)]
    for i in range(count):
        for j in range(i, count):
            if i != j or levels[i] > 2:
                row = np.zeros(count, int)
                row[i] += 1
                row[j] += 1
                rows.append(row)
    return np.array(rows)


def _terms(scaled: Array, powers: NDArray[np.int_]) -> Array:
    return np.prod(scaled[:, None, :] ** powers[None, :, :], axis=2)


def _fitted(
    names: tuple[str, ...], low: Array, high: Array, powers: NDArray[np.int_], terms: Array, y: Array
) -> Surface:
    basis, triangle = np.linalg.qr(terms)
    coefficients = np.asarray(np.linalg.solve(triangle, basis.T @ y), dtype=np.float64)
    residuals = y - terms @ coefficients
    leverage = np.sum(basis**2, axis=1)
    total = float(np.sum((y - y.mean()) ** 2))
    # what no other variant tells of, such as the only one in the middle of a plan, cannot be left out
    others = leverage < WHOLE
    with np.errstate(invalid="ignore", divide="ignore"):
        left_out = residuals[others] / (1.0 - leverage[others])
        determined = 1.0 - float(np.sum(residuals**2)) / total
        predicted = 1.0 - float(np.sum(left_out**2)) / float(np.sum((y[others] - y.mean()) ** 2))
    if total <= (1e-12 * max(float(np.abs(y).max()), 1e-300)) ** 2:
        determined = predicted = 1.0
    return Surface(names, low, high, powers, coefficients, determined, predicted)


class Effect(Struct):
    """What an output is at the 5 % and the 95 % quantile of a parameter on the response surface, the others at their medians."""

    parameter: str
    low: float
    high: float
    at_low: float
    at_high: float

    @property
    def size(self) -> float:
        """Magnitude of the change."""
        return abs(self.at_high - self.at_low)


def effects(table: Table, output: str, found: Surface | None = None) -> list[Effect]:
    """Those of all parameters, the largest first; none without a response surface."""
    found = found or surface(table, output)
    if found is None:
        return []
    values = np.stack([table.parameters[name] for name in found.parameters], axis=1)[table.ended]
    middle = _scaled(np.median(values, axis=0), found)
    out = []
    for k, name in enumerate(found.parameters):
        ends = np.quantile(values[:, k], [0.05, 0.95])
        points = np.tile(middle, (2, 1))
        points[:, k] = (2.0 * (ends - found.low[k]) / (found.high[k] - found.low[k])) - 1.0
        at_low, at_high = found.at(points)
        out.append(Effect(name, float(ends[0]), float(ends[1]), float(at_low), float(at_high)))
    return sorted(out, key=lambda each: -each.size)


def _scaled(values: Array, found: Surface) -> Array:
    return 2.0 * (values - found.low) / (found.high - found.low) - 1.0


class SobolIndices(Struct):
    """Shares of the variance of an output: `first` by a parameter alone, `total` with all its interactions, each (p,), with standard errors
    of a bootstrap. used : base samples that came to their end in all blocks, of `samples`."""

    parameters: tuple[str, ...]
    first: Array
    total: Array
    first_error: Array
    total_error: Array
    used: int
    samples: int


def sobol_indices(table: Table, output: str) -> SobolIndices | None:
    """By the estimators of Saltelli et al. (2010) and Jansen (1999); None for another design, or an output that does not vary."""
    names = tuple(table.parameters)
    values = table.outputs[output]
    if table.design != SOBOL or len(values) != table.samples * (len(names) + 2):
        return None
    blocks = np.where(table.ended, values, np.nan).reshape(len(names) + 2, table.samples)
    blocks = blocks[:, np.isfinite(blocks).all(axis=0)]
    used = blocks.shape[1]
    if used < 2 or not np.ptp(blocks) > 0.0:
        return None
    first, total = _indices(blocks)
    random = np.random.default_rng(0)
    resampled = [_indices(blocks[:, random.integers(used, size=used)]) for _ in range(RESAMPLES)]
    errors = np.nanstd(np.array(resampled), axis=0)
    return SobolIndices(names, first, total, errors[0], errors[1], used, table.samples)


def _indices(blocks: Array) -> tuple[Array, Array]:
    """blocks (p + 2, n) : outputs of the samples A, B, and A with the column of B for each parameter."""
    centred = blocks - blocks[:2].mean()
    a, b, mixed = centred[0], centred[1], centred[2:]
    variance = np.var(centred[:2])
    with np.errstate(invalid="ignore", divide="ignore"):
        first = np.mean(b * (mixed - a), axis=1) / variance
        total = 0.5 * np.mean((a - mixed) ** 2, axis=1) / variance
    return first, total
