"""The variants of a sweep: which values each has, and how they are laid out along the dimensions of the results."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.machine.units.quantity import ANY, read_quantity
from nivel.machine.units.tree import ExpressionError
from nivel.words.arguments import plain
from nivel.words.wording import shown

ROW = "variant"
MOST = 1_000_000


@dataclass(frozen=True)
class Variants:
    """values : of every variant, by path. shape : numbers of variants along the `dimensions`, in C order.

    coordinates : by name, the dimension along which they stand and the values there, in SI units where they are numbers.
    """

    values: tuple[Mapping[str, Any], ...]
    dimensions: tuple[str, ...]
    shape: tuple[int, ...]
    coordinates: Mapping[str, tuple[str, tuple[Any, ...]]]


def lay_out(values: Mapping[str, Any], combine: str, samples: int | None, seed: int) -> Variants:
    """The variants of `machine.sweep`. Raises ModelError with everything that is wrong with the values."""
    if not values:
        raise ModelError(
            Fault("", 0, 0, "values", "nothing varies: give values by path, {'bodies.rod.mass': [1, 2, 3]}")
        )
    if samples is not None:
        return _rows(_sampled(values, samples, seed))
    lists = _lists(values)
    if combine == "rows":
        return _rows(lists)
    count = int(np.prod([len(each) for each in lists.values()]))
    if count > MOST:
        raise ModelError(Fault("", 0, 0, "values", f"this grid has {count} variants; at most {MOST} are run"))
    rows = tuple(dict(zip(lists, each, strict=True)) for each in product(*lists.values()))
    shape = tuple(len(each) for each in lists.values())
    return Variants(rows, tuple(lists), shape, {path: (path, _si(each)) for path, each in lists.items()})


def _lists(values: Mapping[str, Any]) -> dict[str, list[Any]]:
    lists, faults = {}, []
    for path, given in values.items():
        each = given.tolist() if getattr(given, "ndim", 0) == 1 else given
        if isinstance(each, str) or not isinstance(each, Sequence) or not len(each):
            got = "an empty list" if isinstance(each, Sequence) and not len(each) else shown(given)
            faults.append(Fault("", 0, 0, path, f"a list of values was expected, got {got}"))
        else:
            lists[path] = [plain(value) for value in each]
    if faults:
        raise ModelError(faults)
    return lists


def _rows(lists: Mapping[str, list[Any]]) -> Variants:
    """Variants that take the first of all lists, the second of all, and so on."""
    lengths = {path: len(each) for path, each in lists.items()}
    if len(set(lengths.values())) > 1:
        listed = ", ".join(f"{count} of `{path}`" for path, count in lengths.items())
        raise ModelError(Fault("", 0, 0, "values", f"combine='rows' needs lists of one length; there are {listed}"))
    (count,) = set(lengths.values())
    rows = tuple({path: each[k] for path, each in lists.items()} for k in range(count))
    return Variants(rows, (ROW,), (count,), {path: (ROW, _si(each)) for path, each in lists.items()})


def _si(values: Sequence[Any]) -> tuple[Any, ...]:
    """Values as coordinates: numbers in SI units where all of them can be read as such, else texts."""
    try:
        return tuple(read_quantity(value, ANY, {}) for value in values)
    except (ExpressionError, TypeError):
        return tuple(str(value) for value in values)


def _sampled(values: Mapping[str, Any], samples: int, seed: int) -> dict[str, list[Any]]:
    """A Latin hypercube (McKay, Beckman & Conover 1979) between two bounds, or over distributions that have `ppf`, as those of SciPy."""
    from scipy.stats import qmc

    shares = qmc.LatinHypercube(len(values), rng=np.random.default_rng(seed)).random(samples)
    return {path: _at(path, given, shares[:, k]) for k, (path, given) in enumerate(values.items())}


def _at(path: str, given: Any, shares: Any) -> list[float]:
    if callable(getattr(given, "ppf", None)):
        return [float(value) for value in given.ppf(shares)]
    try:
        low, high = (read_quantity(value, ANY, {}) for value in given)
    except (ExpressionError, TypeError, ValueError):
        message = f"with `samples`, two bounds (1, 3) or a distribution of SciPy were expected, got {shown(given)}"
        raise ModelError(Fault("", 0, 0, path, message)) from None
    return [float(value) for value in low + (high - low) * shares]
