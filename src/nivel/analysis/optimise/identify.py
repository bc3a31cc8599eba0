"""Parameters of a machine from measurements: least squares, with the covariance of what was found.

Residuals are differences of results and measurements over the standard deviation of each signal. With their Jacobian J (n, p) at what was
found, the covariance is s² (Jᵀ J)⁻¹; s² = Σ r²/(n - p) where deviations are not known, 1 where they are (Seber and Wild 1989, ch. 2).
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from time import perf_counter
from typing import Any, Final

import numpy as np
import xarray
from numpy.typing import NDArray

from nivel.analysis.optimise.evaluations import Box, Evaluations, nothing_found
from nivel.analysis.optimise.optimise import dataset_of
from nivel.analysis.optimise.spoken_outputs import at_times
from nivel.analysis.progress.listener import Listener
from nivel.analysis.sweep.outputs import another_measure
from nivel.errors import Fault, ModelError
from nivel.model import Model
from nivel.results.result import Result

Array = NDArray[np.float64]

# residual of a variant that has no results, in standard deviations
FAR: Final = 1e3
# singular values of J below this share of the largest say that a combination of parameters changes nothing
FLAT: Final = 1e-7


@dataclass(frozen=True)
class Signal:
    """Measurements of a result: times (n,) [s], values (n,) in SI units, their standard deviation where it is known, and the unit in which
    they were given, where there is one."""

    name: str
    times: Array
    values: Array
    deviation: float | None = None
    units: str = ""


@dataclass(frozen=True)
class Identified:
    """What was found. values, deviations : by path, the latter standard deviations; covariance (p, p) and correlation in their order.

    deviation_of : standard deviation of the residuals of each signal; reached : (starts,) the sum of squares that each came to;
    undetermined : paths of parameters that the measurements do not tell apart; dataset : every variant computed; machine : with what was
    found; residuals : by signal; evaluations : number of runs.
    """

    values: Mapping[str, float]
    deviations: Mapping[str, float]
    covariance: Array
    correlation: Array
    deviation_of: Mapping[str, float]
    reached: Array
    undetermined: tuple[str, ...]
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
    threads: int = 1,
    with_slopes: Callable[[Mapping[str, float]], Result] | None = None,
    listener: Listener | None = None,
) -> Identified:
    """The parameters with the least squares. with_slopes : the run of a variant with the slopes of its results; None: differences. most :
    iterations of each start. Raises ModelError where no start has results."""
    from scipy.optimize import least_squares

    known = [each.deviation for each in signals]
    if any(each is None for each in known) and any(each is not None for each in known):
        raise ModelError(Fault("", 0, 0, "deviations", "give the standard deviation of all signals, or of none"))
    units = [_unit(each) for each in signals]
    count = sum(len(each.values) for each in signals)
    if count <= len(box.paths):
        message = f"{count} measurements do not determine {len(box.paths)} parameters"
        raise ModelError(Fault("", 0, 0, "data", message))

    def read(result: Result) -> Array:
        _check_units(signals, result)
        rows = [
            (at_times(result, each.name, each.times) - each.values) / unit
            for each, unit in zip(signals, units, strict=True)
        ]
        return np.concatenate(rows)

    def read_exact(values: Mapping[str, float]) -> tuple[Array, Array]:
        assert with_slopes is not None
        result = with_slopes(values)
        columns = [
            np.concatenate(
                [
                    at_times(result, f"d({each.name})/d({path})", each.times) / unit
                    for each, unit in zip(signals, units, strict=True)
                ]
            )
            for path in box.paths
        ]
        return read(result), np.array(columns).T

    begin, exact = perf_counter(), None if with_slopes is None else read_exact
    evaluations = Evaluations(machine, box, read, count, threads=threads, exact=exact)

    def residuals(z: Array) -> Array:
        found = evaluations.at(z)
        return found if np.isfinite(found).all() else np.full(count, FAR)

    def slopes(z: Array) -> Array:
        found = evaluations.slopes(z)
        return np.where(np.isfinite(found), found, 0.0)

    ends = []
    for number, z in enumerate(box.starts(starts, seed)):
        evaluations.start = number
        inside = np.clip(z, 1e-6, 1.0 - 1e-6)
        ends.append(
            least_squares(
                residuals,
                inside,
                jac=slopes,  # type: ignore[arg-type]
                bounds=(0.0, 1.0),
                xtol=tolerance,
                ftol=tolerance,
                gtol=1e-12,
                max_nfev=most,
            )
        )
        if listener is not None and listener.progress is not None:
            listener.progress(float(number + 1))
    reached = np.array([2.0 * each.cost for each in ends])
    best = ends[int(np.argmin(reached))]
    if not np.isfinite(evaluations.at(best.x)).all():
        first, last = min(each.times.min() for each in signals), max(each.times.max() for each in signals)
        otherwise = (
            f"the run ends before the measurements do, or begins after them: they last from {first:g} to {last:g} s"
        )
        raise nothing_found(evaluations.made, "data", "no start has results at all measurements", otherwise)
    span = box.high - box.low
    scaled, undetermined = _covariance(slopes(best.x), best.fun, box, of_known=known[0] is not None)
    covariance = scaled * np.outer(span, span)
    deviations = np.sqrt(np.diagonal(covariance))
    values = box.values(best.x)
    rows = np.split(best.fun, np.cumsum([len(each.values) for each in signals])[:-1])
    left = {each.name: row * unit for each, row, unit in zip(signals, rows, units, strict=True)}
    sizes = np.where(np.isfinite(deviations) & (deviations > 0.0), deviations, 1.0)
    correlation = np.where(np.isfinite(covariance), covariance, 1.0) / np.outer(sizes, sizes)
    attributes = {
        "analysis": "identify",
        "machine": machine.name,
        "seconds": perf_counter() - begin,
        "best": json.dumps(values),
        "sum_of_squares": float(reached.min()),
        "undetermined": ", ".join(undetermined),
        "prepared_because": evaluations.prepared_because,
    }
    return Identified(
        values=values,
        deviations=dict(zip(box.paths, deviations.tolist(), strict=True)),
        covariance=covariance,
        correlation=correlation,
        deviation_of={name: float(np.sqrt(np.mean(row**2))) for name, row in left.items()},
        reached=reached,
        undetermined=undetermined,
        residuals=left,
        dataset=_with_covariance(_table(evaluations, attributes), box, deviations, covariance),
        machine=machine.with_values(values),
        evaluations=len(evaluations.made),
    )


def _check_units(signals: Sequence[Signal], result: Result) -> None:
    """Raise ModelError where measurements are given in a unit that the result does not have."""
    faults = [
        Fault("", 0, 0, f"data.{each.name}", wrong)
        for each in signals
        if each.units and (wrong := another_measure(f"1 {each.units}", result.units(each.name)))
    ]
    if faults:
        raise ModelError(faults)


def _unit(signal: Signal) -> float:
    """What residuals of a signal are measured by: its deviation, or how much it varies."""
    if signal.deviation is not None:
        return signal.deviation
    return float(np.std(signal.values)) or float(np.abs(signal.values).max()) or 1.0


def _covariance(J: Array, r: Array, box: Box, *, of_known: bool) -> tuple[Array, tuple[str, ...]]:
    """(p, p) in the unit cube, infinite along what changes nothing; and the parameters that take part in that."""
    _, sizes, rows = np.linalg.svd(J, full_matrices=False)
    flat = sizes <= FLAT * sizes.max(initial=0.0)
    variance = 1.0 if of_known else float(r @ r) / max(len(r) - len(box.paths), 1)
    inverse = np.where(flat, 0.0, 1.0 / np.where(flat, 1.0, sizes) ** 2)
    out = variance * (rows.T * inverse) @ rows
    loose = np.abs(rows[flat]).max(axis=0, initial=0.0) > 0.1
    out[loose, loose] = np.inf
    return out, tuple(path for path, each in zip(box.paths, loose, strict=True) if each)


def _table(evaluations: Evaluations, attributes: Mapping[str, Any]) -> xarray.Dataset:
    """All variants with their sums of squares."""
    from dataclasses import replace

    evaluations.made = [
        replace(each, outputs=np.array([float(each.outputs @ each.outputs)])) for each in evaluations.made
    ]
    return dataset_of(evaluations, ("sum_of_squares",), attributes)


def _with_covariance(table: xarray.Dataset, box: Box, deviations: Array, covariance: Array) -> xarray.Dataset:
    names = list(box.paths)
    return table.assign_coords(parameter=names, other_parameter=names).assign(
        standard_deviation=("parameter", deviations),
        covariance=(("parameter", "other_parameter"), covariance),
    )
