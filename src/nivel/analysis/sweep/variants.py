"""The variants of a study: which values each has, and how they are laid out along the dimensions of the results."""

import math
from collections.abc import Mapping, Sequence
from itertools import product
from math import prod
from typing import Any, Final, Protocol

import numpy as np
from scipy.special import ndtr, ndtri

from nivel.errors import Fault, ModelError, gathered, refuse
from nivel.extras import needed
from nivel.lazy import Struct, scipy
from nivel.machine.core.vectors import Array
from nivel.machine.settings.values import settings_of
from nivel.machine.study.any_quantity import si, si_or_text
from nivel.machine.study.parameter import Between, Normal, Range, Tolerance, Triangular, Uniform, Values
from nivel.machine.study.study_record import DRAWN, PLANNED, SOBOL_INDICES
from nivel.words.arguments import plain
from nivel.words.wording import shown

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


ROW: Final = "variant"
RESOLUTION: Final = 4
MOST: Final = 1_000_000

Parameters = Mapping[str, Distribution]


class Variants(Struct):
    """values : of every variant, by path. shape : numbers of variants along the `dimensions`, in C order.

    coordinates : by name, the dimension along which they stand and the values there, in SI units where they are numbers.
    """

    values: tuple[Mapping[str, Any], ...]
    dimensions: tuple[str, ...]
    shape: tuple[int, ...]
    coordinates: Mapping[str, tuple[str, tuple[Any, ...]]]


def draw(parameters: Parameters, design: str, samples: int | None, seed: int) -> Variants:
    """The variants of a design. parameters : by path, nominal values put in; of a grid and of rows those with values one by one.

    Raises ModelError where nothing varies, or there are more than MOST variants.
    """
    if not parameters:
        raise ModelError(Fault.at("parameters", "nothing varies: give values by path, {'bodies.rod.mass': [1, 2, 3]}"))
    count = _count(parameters, design, samples)
    if count > MOST:
        message = f"this design has {count} variants; at most {MOST} are run"
        raise ModelError(Fault.at("parameters", message))
    if design in DRAWN:
        shares = _shares(design, samples or 1, len(parameters), seed)
        return _rows({path: quantiles(each, shares[:, k]) for k, (path, each) in enumerate(parameters.items())})
    if design in PLANNED:
        shares = 0.5 + 0.5 * _levels(design, len(parameters))
        return _rows({path: _between(path, each, shares[:, k]) for k, (path, each) in enumerate(parameters.items())})
    lists = {path: _listed(each) for path, each in parameters.items()}
    if design == "rows":
        return _rows(lists)
    rows = tuple(dict(zip(lists, each, strict=True)) for each in product(*lists.values()))
    shape = tuple(len(each) for each in lists.values())
    return Variants(rows, tuple(lists), shape, {path: (path, _si(each)) for path, each in lists.items()})


def _count(parameters: Parameters, design: str, samples: int | None) -> int:
    if design == SOBOL_INDICES:
        return (samples or 1) * (len(parameters) + 2)
    if design in DRAWN:
        return samples or 1
    if design in PLANNED:
        return len(_levels(design, len(parameters)))
    lengths = [_length(each) for each in parameters.values()]
    return max(lengths) if design == "rows" else prod(lengths)


def _levels(design: str, count: int) -> np.ndarray[Any, Any]:
    """(variants, count) from -1, the lower bound, to 1, the upper one.

    A fraction of all corners of resolution IV: main effects are clear of effects of pairs (Box, Hunter & Hunter 2005, ch. 6); of up to
    three parameters all corners. Box & Behnken 1960: three levels, from three parameters on. Central composite: corners, a star and the
    middle, with five levels, rotatable, its star on the bounds (Box & Wilson 1951).
    """
    plans = needed("pyDOE3", f"`design: {design}` needs")
    if design == "fractional-factorial":
        if count <= RESOLUTION:  # of four the last is the product of the others
            return plans.ff2n(count) if count < RESOLUTION else plans.fracfact("a b c abc")
        return plans.fracfact_by_res(count, RESOLUTION)
    least = 3 if design == "box-behnken" else 2
    if count < least:
        raise ModelError(
            Fault.at("parameters", f"`design: {design}` needs {least} parameters at least; there are {count}")
        )
    if design == "box-behnken":
        return plans.bbdesign(count, center=1)
    return plans.ccdesign(count, center=(0, 1), alpha="rotatable", face="inscribed")


def _between(path: str, parameter: Distribution, shares: np.ndarray[Any, Any]) -> list[Any]:
    """Values from the lower bound (0) to the upper one (1), of a list those that it has. Raises ModelError without bounds."""
    if isinstance(parameter, Values | Range):
        return quantiles(parameter, shares)
    low, high = parameter.bounds if isinstance(parameter, Between) else (-np.inf, np.inf)
    if not np.isfinite([low, high]).all():
        raise ModelError(Fault.at(path, "two bounds were expected, (1, 3), between which levels are planned"))
    return [float(low + (high - low) * share) for share in shares]


def _length(parameter: Distribution) -> int:
    """Number of the values of a parameter, which are not made for that."""
    return len(parameter.values) if isinstance(parameter, Values) else getattr(parameter, "count", None) or 1


def _listed(parameter: Distribution) -> list[Any]:
    if isinstance(parameter, Values):
        return list(parameter.values)
    assert isinstance(parameter, Range)  # others are refused by the record
    return quantiles(parameter, np.linspace(0.0, 1.0, parameter.count or 1))


def _shares(design: str, samples: int, count: int, seed: int) -> np.ndarray[Any, Any]:
    """(variants, count) between 0 and 1.

    For Sobol indices the samples A, then B, then for each parameter A with the column of B (Saltelli et al. 2010).
    """
    if design == "random":
        return np.random.default_rng(seed).random((samples, count))
    if design == "latin-hypercube":
        return scipy.stats.qmc.LatinHypercube(count, rng=np.random.default_rng(seed)).random(samples)
    if design == "sobol":
        return scipy.stats.qmc.Sobol(count, rng=np.random.default_rng(seed)).random(samples)
    both = scipy.stats.qmc.Sobol(2 * count, rng=np.random.default_rng(seed)).random(samples)
    first, second = both[:, :count], both[:, count:]
    mixed = [np.where(np.arange(count) == k, second, first) for k in range(count)]
    return np.concatenate([first, second, *mixed])


def lay_out(
    values: Mapping[str, Any], combine: str, samples: int | None, seed: int, design: str = "latin-hypercube"
) -> Variants:
    """The variants of `machine.sweep`. Raises ModelError with everything that is wrong with the values."""
    if samples is None and combine in PLANNED:
        return draw(_distributions(values), combine, None, seed)
    if samples is None:
        return draw(_lists(values, combine), combine, None, seed)
    return draw(_distributions(values), design, samples, seed)


def _read_lists(values: Mapping[str, Any]) -> tuple[dict[str, list[Any]], list[Fault]]:
    """Lists by path, and what is none."""
    lists: dict[str, list[Any]] = {}
    faults: list[Fault] = []
    for path, given in values.items():
        each = given.tolist() if getattr(given, "ndim", 0) == 1 else given
        if isinstance(each, str) or not isinstance(each, Sequence) or not len(each):
            got = "an empty list" if isinstance(each, Sequence) and not len(each) else shown(given)
            faults.append(Fault.at(path, f"a list of values was expected, got {got}"))
        else:
            lists[path] = [plain(value) for value in each]
    return lists, faults


def _lists(values: Mapping[str, Any], combine: str) -> Parameters:
    given, faults = _read_lists(values)
    refuse(faults)
    lists: dict[str, Distribution] = {path: Values.model_construct(values=tuple(each)) for path, each in given.items()}
    lengths = {path: len(_listed(each)) for path, each in lists.items()}
    if combine == "rows" and len(set(lengths.values())) > 1:
        listed = ", ".join(f"{count} of `{path}`" for path, count in lengths.items())
        raise ModelError(Fault.at("values", f"combine='rows' needs lists of one length; there are {listed}"))
    return lists


def _distributions(values: Mapping[str, Any]) -> Parameters:
    """Two bounds, or a distribution of SciPy."""
    found: dict[str, Distribution] = {}
    faults: list[Fault] = []
    for path, given in values.items():
        if callable(getattr(given, "ppf", None)):
            found[path] = given
            continue
        try:
            low, high = given
        except (TypeError, ValueError):
            message = f"with `samples`, two bounds (1, 3) or a distribution of SciPy were expected, got {shown(given)}"
            faults.append(Fault.at(path, message))
            continue
        with gathered(faults):
            found[path] = settings_of(Uniform, path, {"type": "uniform", "low": low, "high": high})
    refuse(faults)
    return found


def _rows(lists: Mapping[str, Sequence[Any]]) -> Variants:
    """Variants that take the first of all lists, the second of all, and so on."""
    count = len(next(iter(lists.values())))
    rows = tuple({path: each[k] for path, each in lists.items()} for k in range(count))
    return Variants(rows, (ROW,), (count,), {path: (ROW, _si(each)) for path, each in lists.items()})


def _si(values: Sequence[Any]) -> tuple[Any, ...]:
    """Values as coordinates: numbers in SI units where all of them can be read as such, else texts."""
    found = tuple(si_or_text(value) for value in values)
    return found if not any(isinstance(each, str) for each in found) else tuple(str(value) for value in values)


def rows_of(values: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Values by path of each variant. Raises ModelError where lists are none, empty, or of several lengths."""
    if not values:
        raise ModelError(Fault.at("values", "nothing varies: give lists by path, {'bodies.rod.mass': [1, 2, 3]}"))
    lists, faults = _read_lists(values)
    if not faults and len({len(each) for each in lists.values()}) > 1:
        listed = ", ".join(f"{len(each)} of `{path}`" for path, each in lists.items())
        faults.append(Fault.at("values", f"lists of one length are needed; there are {listed}"))
    refuse(faults)
    return [dict(zip(lists, row, strict=True)) for row in zip(*lists.values(), strict=True)]
