"""Parameters of a machine from measurements: least squares, with the covariance of what was found.

Residuals are differences of results and measurements over the standard deviation of each signal. With their Jacobian J (n, p) at what was
found, the covariance is s² (Jᵀ J)⁻¹; s² = Σ r²/(n - p) where deviations are not known, 1 where they are (Seber and Wild 1989, ch. 2).
"""

import json
from collections.abc import Callable, Mapping, Sequence
from time import perf_counter
from typing import Any, Final

import numpy as np
import xarray
from numpy.typing import NDArray

from nivel.analysis.optimise.evaluations import Box, Computation, Evaluations, Exact, nothing_found, table_of
from nivel.analysis.progress.log import Listener
from nivel.analysis.sweep.outputs import Found, at_times, units_of
from nivel.errors import Fault, ModelError, refuse
from nivel.lazy import Struct, replace, scipy
from nivel.machine.core.vectors import Array
from nivel.machine.study.any_quantity import another_measure
from nivel.machine.study.parameter import SCALAR
from nivel.model import Model
from nivel.results.result import Result

# residual of a variant that has no results, in standard deviations
FAR: Final = 1e3
# singular values of J below this share of the largest say that a combination of parameters changes nothing
FLAT: Final = 1e-7
# shares of the range: where searches begin beside a bound, and how near to one a parameter counts as on it where it would go beyond
INSIDE: Final = 1e-6
NEAR: Final = 1e-4


class Signal(Struct):
    """Measurements of a result: times (n,) [s], values (n,) in SI units, their standard deviation where it is known, and the unit in which
    they were given, where there is one."""

    name: str
    times: Array
    values: Array
    deviation: float | None = None
    units: str = ""


class Identified(Struct):
    """What was found. values, deviations : by path, the latter standard deviations; covariance (p, p) and correlation in their order.

    deviation_of : standard deviation of the residuals of each signal; reached : (starts,) the sum of squares that each came to;
    undetermined : paths of parameters that the measurements do not tell apart; on_bounds : of those that would go on beyond a
    bound, and have no deviation: those of the others hold with these held there; dataset : every variant computed; machine : with
    what was found; residuals : by signal; evaluations : number of variants that were computed.
    """

    values: Mapping[str, float]
    deviations: Mapping[str, float]
    covariance: Array
    correlation: Array
    deviation_of: Mapping[str, float]
    reached: Array
    undetermined: tuple[str, ...]
    on_bounds: tuple[str, ...]
    residuals: Mapping[str, Array]
    dataset: xarray.Dataset
    machine: Any
    evaluations: int


def identify(
    machine: Model,
    box: Box,
    signals: Sequence[Signal],
    *,
    starts: int = 1,
    seed: int = 0,
    most: int = 100,
    tolerance: float = 1e-10,
    with_slopes: Callable[[Mapping[str, float]], Result] | None = None,
    exact_of: Callable[[Sequence[str]], Exact] | None = None,
    computation: Computation | None = None,
    listener: Listener | None = None,
) -> Identified:
    """The parameters with the least squares. with_slopes : the run of a variant with the slopes of its results; exact_of : outputs of
    another analysis with theirs, by their words; None of both: differences. most : iterations of each start. computation : of each
    variant, runs by default; without `exact`, which follows from the slopes.

    Raises ModelError where no start has results, and SolveError where that is because runs fail; its `result` is the table of all variants.
    """
    begin = perf_counter()
    _check_signals(signals, box)
    residuals = _Residuals(box, signals, with_slopes)
    computation = computation or Computation()
    if with_slopes is not None:
        computation = replace(computation, exact=residuals.read_exact)
    elif exact_of is not None:
        computation = replace(computation, exact=residuals.by_words(exact_of))
    evaluations = Evaluations(machine, box, residuals.read, residuals.count, computation)
    fit = _Fit(evaluations, residuals.count)
    ends = []
    for number, z in enumerate(box.starts(starts, seed)):
        evaluations.start = number
        ends.append(fit.from_start(z, most, tolerance))
        if listener is not None and listener.progress is not None:
            listener.progress(float(number + 1))
    reached = np.array([2.0 * each.cost for each in ends])
    attributes = {
        "analysis": "identify",
        "computed": computation.analysis,
        "machine": machine.name,
        "seconds": perf_counter() - begin,
    }
    found = ends[int(np.argmin(reached))]
    if not np.isfinite(evaluations.at(found.x)).all():
        fault = Fault.at("data", "no start has results at all measurements")
        table = _table(evaluations, attributes)
        raise nothing_found(evaluations.made, fault, _when_measured(signals), table)
    z, r, bound = fit.on_bounds(found.x)
    spread = _spread(fit.slopes(z), r, box, bound, of_known=signals[0].deviation is not None)
    left = residuals.by_signal(r)
    values = box.values(z)
    attributes |= {
        "best": json.dumps(values),
        "sum_of_squares": float(r @ r),
        "undetermined": ", ".join(spread.undetermined),
        "on_bounds": ", ".join(spread.on_bounds),
    }
    return Identified(
        values=values,
        deviations=dict(zip(box.paths, spread.deviations.tolist(), strict=True)),
        covariance=spread.covariance,
        correlation=spread.correlation,
        deviation_of={name: float(np.sqrt(np.mean(row**2))) for name, row in left.items()},
        reached=reached,
        undetermined=spread.undetermined,
        on_bounds=spread.on_bounds,
        residuals=left,
        dataset=_with_covariance(_table(evaluations, attributes), box, spread),
        machine=machine.with_values(values),
        evaluations=len(evaluations.made),
    )


class _Residuals:
    """Differences of results and measurements, over the deviation of each signal."""

    def __init__(
        self, box: Box, signals: Sequence[Signal], with_slopes: Callable[[Mapping[str, float]], Result] | None
    ) -> None:
        self._box, self._signals, self._with_slopes = box, signals, with_slopes
        self._units = [_unit(each) for each in signals]
        self.count = sum(len(each.values) for each in signals)

    def read(self, result: Found) -> Array:
        """(n,) of a result. Raises ModelError where measurements have another unit."""
        _check_units(self._signals, result)
        rows = [
            (at_times(result, each.name, each.times) - each.values) / unit
            for each, unit in zip(self._signals, self._units, strict=True)
        ]
        return np.concatenate(rows)

    def read_exact(self, values: Mapping[str, float]) -> tuple[Array, Array]:
        """The same with slopes (n, p), from one run."""
        assert self._with_slopes is not None
        result = self._with_slopes(values)
        columns = [
            np.concatenate(
                [
                    at_times(result, f"d({each.name})/d({path})", each.times) / unit
                    for each, unit in zip(self._signals, self._units, strict=True)
                ]
            )
            for path in self._box.paths
        ]
        return self.read(result), np.array(columns).T

    def by_words(self, exact_of: Callable[[Sequence[str]], Exact]) -> Exact:
        """What finds residuals and slopes of an analysis, of which each measurement is an output in words."""
        words = [
            each.name if SCALAR.fullmatch(each.name) else f"{each.name} at {float(t)!r} s"
            for each in self._signals
            for t in each.times
        ]
        exact, measured = exact_of(words), np.concatenate([each.values for each in self._signals])
        unit = np.repeat(self._units, [len(each.values) for each in self._signals])

        def found(values: Mapping[str, float]) -> tuple[Array, Array]:
            outputs, slopes = exact(values)
            return (outputs - measured) / unit, slopes / unit[:, None]

        return found

    def by_signal(self, r: Array) -> dict[str, Array]:
        """Residuals in SI units by signal."""
        rows = np.split(r, np.cumsum([len(each.values) for each in self._signals])[:-1])
        return {each.name: row * unit for each, row, unit in zip(self._signals, rows, self._units, strict=True)}


class _Fit:
    """Least squares in the unit cube."""

    def __init__(self, evaluations: Evaluations, count: int) -> None:
        self._evaluations, self._count = evaluations, count

    def residuals(self, z: Array) -> Array:
        found = self._evaluations.at(z)
        return found if np.isfinite(found).all() else np.full(self._count, FAR)

    def slopes(self, z: Array) -> Array:
        found = self._evaluations.slopes(z)
        return np.where(np.isfinite(found), found, 0.0)

    def from_start(self, z: Array, most: int, tolerance: float) -> Any:
        """What SciPy found from one start."""
        return scipy.optimize.least_squares(
            self.residuals,
            np.clip(z, INSIDE, 1.0 - INSIDE),
            jac=self.slopes,  # type: ignore[arg-type]
            bounds=(0.0, 1.0),
            xtol=tolerance,
            ftol=tolerance,
            gtol=1e-12,
            max_nfev=most,
        )

    def on_bounds(self, z: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
        """What was found, put on the bounds that it would go beyond; residuals there; and which parameters (p,) these are.

        The method stays a little inside: there the sum of squares falls towards the bound, and is no larger on it.
        """
        r = self.residuals(z)
        down = self.slopes(z).T @ r
        bound = ((z < NEAR) & (down > 0.0)) | ((z > 1.0 - NEAR) & (down < 0.0))
        there = np.where(bound, np.round(z), z)
        on = self.residuals(there)
        if not bound.any() or on @ on > r @ r:
            return z, r, np.zeros(len(z), dtype=bool)
        return there, on, bound


class _Spread(Struct):
    """How certain parameters are: (p, p) covariance and correlation, (p,) standard deviations; paths of those that are undetermined, and of
    those on bounds, which have none."""

    covariance: Array
    correlation: Array
    deviations: Array
    undetermined: tuple[str, ...]
    on_bounds: tuple[str, ...]


def _spread(J: Array, r: Array, box: Box, bound: NDArray[np.bool_], *, of_known: bool) -> _Spread:
    """Those of parameters within their bounds, the others held there."""
    free, span = np.flatnonzero(~bound), box.high - box.low
    covariance = np.full((len(span), len(span)), np.nan)
    variance = 1.0 if of_known else float(r @ r) / max(len(r) - len(free), 1)
    own, loose = _covariance(J[:, free], variance)
    covariance[np.ix_(free, free)] = own * np.outer(span[free], span[free])
    deviations = np.sqrt(np.diagonal(covariance))
    sizes = np.where(np.isfinite(deviations) & (deviations > 0.0), deviations, 1.0)
    correlation = np.where(np.isinf(covariance), 1.0, covariance) / np.outer(sizes, sizes)
    undetermined = tuple(box.paths[k] for k in free[loose])
    return _Spread(
        covariance, correlation, deviations, undetermined, tuple(box.paths[k] for k in np.flatnonzero(bound))
    )


def _check_signals(signals: Sequence[Signal], box: Box) -> None:
    """Raise ModelError where deviations are known of some signals, or there are too few measurements."""
    known = [each.deviation is not None for each in signals]
    if any(known) and not all(known):
        raise ModelError(Fault.at("deviations", "give the standard deviation of all signals, or of none"))
    count = sum(len(each.values) for each in signals)
    if count <= len(box.paths):
        message = f"{count} measurements do not determine {len(box.paths)} parameters"
        raise ModelError(Fault.at("data", message))


def _when_measured(signals: Sequence[Signal]) -> str:
    first, last = min(each.times.min() for each in signals), max(each.times.max() for each in signals)
    return f"the run ends before the measurements do, or begins after them: they last from {first:g} to {last:g} s"


def _check_units(signals: Sequence[Signal], result: Found) -> None:
    """Raise ModelError where measurements are given in a unit that the result does not have."""
    faults = [
        Fault.at(f"data.{each.name}", wrong)
        for each in signals
        if each.units and (wrong := another_measure(f"1 {each.units}", units_of(result, each.name)))
    ]
    refuse(faults)


def _unit(signal: Signal) -> float:
    """What residuals of a signal are measured by: its deviation, or how much it varies."""
    if signal.deviation is not None:
        return signal.deviation
    return float(np.std(signal.values)) or float(np.abs(signal.values).max()) or 1.0


def _covariance(J: Array, variance: float) -> tuple[Array, NDArray[np.bool_]]:
    """(p, p) in the unit cube, infinite along what changes nothing; and which parameters (p,) take part in that."""
    _, sizes, rows = np.linalg.svd(J, full_matrices=False)
    flat = sizes <= FLAT * sizes.max(initial=0.0)
    inverse = np.where(flat, 0.0, 1.0 / np.where(flat, 1.0, sizes) ** 2)
    out = variance * (rows.T * inverse) @ rows
    loose = np.abs(rows[flat]).max(axis=0, initial=0.0) > 0.1
    out[loose, loose] = np.inf
    return out, loose


def _table(evaluations: Evaluations, attributes: Mapping[str, Any]) -> xarray.Dataset:
    evaluations.made = [
        replace(each, outputs=np.array([float(each.outputs @ each.outputs)])) for each in evaluations.made
    ]
    return table_of(evaluations, ("sum_of_squares",), attributes)


def _with_covariance(table: xarray.Dataset, box: Box, spread: _Spread) -> xarray.Dataset:
    names = list(box.paths)
    return table.assign_coords(parameter=names, other_parameter=names).assign(
        standard_deviation=("parameter", spread.deviations),
        covariance=(("parameter", "other_parameter"), spread.covariance),
    )
