"""Minimisation over parameters of a machine, with bounds and constraints on outputs, from several starts."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from numbers import Real
from time import perf_counter
from typing import Any, Final

import numpy as np
import xarray
from numpy.typing import NDArray

from nivel.analysis.optimise.evaluations import Box, Evaluations, nothing_found
from nivel.analysis.optimise.spoken_outputs import event_of, spoken_output
from nivel.analysis.progress.listener import Listener
from nivel.errors import Fault, ModelError
from nivel.model import Model
from nivel.results.result import Result
from nivel.words.wording import shown, unknown_word

Array = NDArray[np.float64]
Said = str | Callable[[Result], float]
Row = tuple[int, float, float]  # output, sign, limit
Limits = Mapping[str, tuple[float | None, float | None]]

WITH_SLOPES: Final = ("SLSQP", "trust-constr", "L-BFGS-B")
WITHOUT: Final = ("Nelder-Mead", "COBYLA", "differential-evolution")
METHODS: Final = (*WITH_SLOPES, *WITHOUT)
CONSTRAINED: Final = ("SLSQP", "trust-constr", "COBYLA")
# what a variant without outputs counts as: so many times the largest magnitude of the objective
FAR: Final = 1e3
# constraints are kept to this share of their limits
KEPT: Final = 1e-6
# weight of broken constraints for methods that know none
WEIGHT: Final = 1e3
PENALISED: Final = 1e6


@dataclass(frozen=True)
class Optimum:
    """What was found. values : by path; objective : there; outputs : by name; kept : whether all constraints hold there.

    reached : (starts,) the objective that each start came to; dataset : every variant that was computed; machine : the best one;
    message : what the method says of its end; evaluations : number of runs.
    """

    values: Mapping[str, float]
    objective: float
    outputs: Mapping[str, float]
    kept: bool
    reached: Array
    dataset: xarray.Dataset
    machine: Any
    message: str
    evaluations: int


@dataclass(frozen=True)
class Aim:
    """objective : an output, in words or a function of the result; maximise : whether it is to be large. outputs : others by name; limits :
    (least, greatest) of outputs by name."""

    objective: Said
    maximise: bool = False
    outputs: Mapping[str, Said] | None = None
    limits: Limits | None = None


def optimise(
    machine: Model,
    box: Box,
    aim: Aim,
    *,
    method: str = "SLSQP",
    starts: int = 1,
    seed: int = 0,
    most: int = 200,
    tolerance: float = 1e-8,
    threads: int = 1,
    exact: Any = None,
    listener: Listener | None = None,
) -> Optimum:
    """The machine with the least objective. most : iterations of each start; tolerance : of the objective, as a share.

    Raises ModelError where words are not known, or no start has an objective, and SolveError where that is because runs fail.
    """
    if method not in METHODS:
        raise ModelError(Fault("", 0, 0, "method", unknown_word(method, METHODS, "method")))
    said = {"objective": aim.objective, **(aim.outputs or {})}
    limits = _checked_limits(aim.limits or {}, said, method)
    _check_events(machine, said)
    readers = {name: spoken_output(each) for name, each in said.items()}
    names, sign = tuple(said), -1.0 if aim.maximise else 1.0

    def read(result: Result) -> Array:
        return np.array([reader(result) for reader in readers.values()])

    begin = perf_counter()
    evaluations = Evaluations(machine, box, read, len(names), threads=threads, exact=exact)
    search = _Search(evaluations, names, limits, sign, method, most, tolerance, seed)
    found, messages = [], []
    for number, begun in enumerate(box.starts(starts, seed)):
        evaluations.start = number
        z, message = search.from_start(begun)
        found.append(z)
        messages.append(message)
        if listener is not None and listener.progress is not None:
            listener.progress(float(number + 1))
    values = [search.judged(z) for z in found]
    best = int(np.argmin(values))
    if not np.isfinite(values[best]):
        otherwise = "it is no number: its time is outside the run, or its event does not come"
        raise nothing_found(evaluations.made, "objective", "no start has one", otherwise)
    outputs = dict(zip(names, map(float, evaluations.at(found[best])), strict=True))
    chosen = box.values(found[best])
    attributes = {
        "analysis": "optimise",
        "machine": machine.name,
        "method": method,
        "seconds": perf_counter() - begin,
        "best": json.dumps(chosen),
        "objective": outputs["objective"],
        "message": messages[best],
        "prepared_because": evaluations.prepared_because,
    }
    return Optimum(
        values=chosen,
        objective=outputs["objective"],
        outputs=outputs,
        kept=search.worst_break(evaluations.at(found[best])) <= KEPT,
        reached=np.array([float(evaluations.at(z)[0]) for z in found]),
        dataset=dataset_of(evaluations, names, attributes),
        machine=machine.with_values(chosen),
        message=messages[best],
        evaluations=len(evaluations.made),
    )


def _check_events(machine: Model, said: Mapping[str, Said]) -> None:
    """Raise ModelError where the time of an event is asked for that the machine does not have."""
    known = [each.name for each in machine.record.events]
    faults = [
        Fault("", 0, 0, name, unknown_word(event, known, "event"))
        for name, each in said.items()
        if (event := event_of(each)) and event not in known
    ]
    if faults:
        raise ModelError(faults)


def _checked_limits(limits: Limits, said: Mapping[str, Said], method: str) -> dict[str, tuple[float, float]]:
    out, faults = {}, []
    for name, given in limits.items():
        if name not in said:
            faults.append(Fault("", 0, 0, "limits", unknown_word(name, list(said), "output")))
            continue
        if not isinstance(given, tuple | list) or len(given) != 2 or given[0] is given[1] is None:
            message = f"the least and the greatest value were expected, (None, 5.0), got {shown(given)}"
            faults.append(Fault("", 0, 0, f"limits.{name}", message))
            continue
        low, high = (-np.inf if given[0] is None else given[0], np.inf if given[1] is None else given[1])
        if not all(isinstance(each, Real) and not isinstance(each, bool) for each in (low, high)):
            message = f"numbers in SI units were expected, (None, 5.0), got {shown(given)}"
            faults.append(Fault("", 0, 0, f"limits.{name}", message))
        elif not low <= high:
            message = f"a least value below the greatest was expected, got {low:g} and {high:g}"
            faults.append(Fault("", 0, 0, f"limits.{name}", message))
        else:
            out[name] = (float(low), float(high))
    if out and method == "L-BFGS-B":
        message = f"`{method}` knows no limits of outputs; {', '.join(CONSTRAINED)} do"
        faults.append(Fault("", 0, 0, "method", message))
    if faults:
        raise ModelError(faults)
    return out


class _Search:
    """One method from one start after another, in the unit cube, with objectives of the order of one."""

    def __init__(
        self,
        evaluations: Evaluations,
        names: tuple[str, ...],
        limits: Mapping[str, tuple[float, float]],
        sign: float,
        method: str,
        most: int,
        tolerance: float,
        seed: int,
    ) -> None:
        self._evaluations, self._method, self._most, self._tolerance = evaluations, method, most, tolerance
        self._sign, self._seed = sign, seed
        # rows g >= 0: output, sign, limit
        self._rows = [
            (names.index(name), side, limit)
            for name, (low, high) in limits.items()
            for side, limit in ((1.0, low), (-1.0, high))
            if np.isfinite(limit) and low < high
        ]
        # rows g = 0, of limits that leave one value
        self._equal = [(names.index(name), 1.0, low) for name, (low, high) in limits.items() if low == high]
        self._size = 1.0

    def from_start(self, z: Array) -> tuple[Array, str]:
        """The place that was reached, and what the method says."""
        first = self._evaluations.at(z)[0]
        self._size = abs(float(first)) or 1.0 if np.isfinite(first) else 1.0
        from scipy import optimize

        bounds = [(0.0, 1.0)] * len(z)
        if self._method == "differential-evolution":
            found = optimize.differential_evolution(
                self._with_penalty, bounds, maxiter=self._most, rng=self._seed, tol=self._tolerance, x0=z, polish=False
            )
            return found.x, str(found.message)
        given: dict[str, Any] = {"bounds": bounds, "method": self._method, "options": {"maxiter": self._most}}
        if self._method in WITH_SLOPES:
            given["jac"] = self._slope
        if self._method in ("SLSQP", "L-BFGS-B"):
            given["options"]["ftol"] = self._tolerance
        objective = self._objective
        if (self._rows or self._equal) and self._method in CONSTRAINED:
            given["constraints"] = self._constraints()
        elif self._rows or self._equal:
            objective = self._with_penalty
        found = optimize.minimize(objective, z, **given)
        return np.clip(found.x, 0.0, 1.0), str(found.message)

    def _objective(self, z: Array) -> float:
        value = float(self._evaluations.at(np.clip(z, 0.0, 1.0))[0])
        return self._sign * value / self._size if np.isfinite(value) else FAR

    def _slope(self, z: Array) -> Array:
        slope = self._sign * self._evaluations.slopes(np.clip(z, 0.0, 1.0))[0] / self._size
        return np.where(np.isfinite(slope), slope, 0.0)

    def _constraints(self) -> list[Any]:
        """Constraints as the method takes them."""
        from scipy import optimize

        out: list[Any] = []
        for kind, rows, most in (("ineq", self._rows, np.inf), ("eq", self._equal, 0.0)):
            if not rows:
                continue
            room, slope = partial(self._room, rows), partial(self._room_slope, rows)
            if self._method == "trust-constr":
                out.append(optimize.NonlinearConstraint(room, 0.0, most, jac=slope))  # type: ignore[arg-type]
            else:
                out.append({"type": kind, "fun": room, "jac": slope})
        return out

    def _room(self, rows: Sequence[Row], z: Array) -> Array:
        outputs = self._evaluations.at(np.clip(z, 0.0, 1.0))
        return np.array([self._scaled_room(outputs, row) for row in rows])

    def _scaled_room(self, outputs: Array, row: Row) -> float:
        k, side, limit = row
        room = side * (float(outputs[k]) - limit) / (abs(limit) or 1.0)
        return room if np.isfinite(room) else -FAR

    def _room_slope(self, rows: Sequence[Row], z: Array) -> Array:
        slopes = self._evaluations.slopes(np.clip(z, 0.0, 1.0))
        out = np.array([side * slopes[k] / (abs(limit) or 1.0) for k, side, limit in rows])
        return np.where(np.isfinite(out), out, 0.0)

    def worst_break(self, outputs: Array) -> float:
        """By how much the worst constraint is broken, as a share of its limit."""
        broken = [-self._scaled_room(outputs, row) for row in self._rows]
        return max([0.0, *broken, *(abs(self._scaled_room(outputs, row)) for row in self._equal)])

    def _with_penalty(self, z: Array) -> float:
        outputs = self._evaluations.at(np.clip(z, 0.0, 1.0))
        return self._objective(z) + WEIGHT * self.worst_break(outputs)

    def judged(self, z: Array) -> float:
        """What places are compared by: the objective, far larger where constraints are broken."""
        outputs = self._evaluations.at(z)
        if not np.isfinite(outputs[0]):
            return np.inf
        broken = self.worst_break(outputs)
        return self._sign * float(outputs[0]) + (PENALISED * (1.0 + broken) * self._size if broken > KEPT else 0.0)


def dataset_of(evaluations: Evaluations, names: tuple[str, ...], attributes: Mapping[str, Any]) -> xarray.Dataset:
    """All variants that were computed, along the dimension `variant`, as those of a study."""
    made, box = evaluations.made, evaluations.box
    x = np.array([[*box.values(each.z).values()] for each in made])
    coords = {path: ("variant", x[:, k], {"long_name": f"value of {path}"}) for k, path in enumerate(box.paths)}
    data: dict[str, Any] = {
        "outcome": ("variant", np.array([each.outcome for each in made])),
        "reason": ("variant", np.array([each.reason for each in made])),
        "start": ("variant", np.array([each.start for each in made]), {"long_name": "number of the start"}),
    }
    for k, name in enumerate(names):
        data[name] = ("variant", np.array([each.outputs[k] for each in made]))
    return xarray.Dataset(data, coords=coords, attrs=dict(attributes))
