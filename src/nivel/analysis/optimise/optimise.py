"""Minimisation over parameters of a machine, with bounds and constraints on outputs, from several starts."""

import json
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from numbers import Real
from time import perf_counter
from typing import Any, Final

import numpy as np
import xarray

from nivel.analysis.optimise.evaluations import Box, Computation, Evaluations, UnreadError, nothing_found, table_of
from nivel.analysis.plan.settings import with_usual_frames
from nivel.analysis.progress.log import Listener
from nivel.analysis.sweep.outputs import Found, OutputFailedError, Said, event_of, said_number
from nivel.errors import Fault, ModelError, refuse
from nivel.extras import needed, require
from nivel.lazy import Struct, scipy
from nivel.machine.core.vectors import Array
from nivel.machine.study.study_record import SEARCH_METHODS
from nivel.model import Model
from nivel.words.wording import shown, unknown_word

# A search from one start after another, by methods of SciPy and of further libraries, in the unit cube of the parameters.
#
# Methods of further libraries, which search the whole unit cube without slopes.
# CMA-ES (Hansen 2016) of pycma, and TPE (Bergstra et al. 2011) of Optuna.

Objectives = Callable[[Sequence[Array]], list[float]]  # of several places at once
Method = Callable[[Objectives, Array, int, float, int], tuple[Array, str]]

# the module of each method
LIBRARIES_OF: Final = {"CMA-ES": "cma", "TPE": "optuna"}
SPREAD: Final = 0.25  # first standard deviation of CMA-ES, in the unit cube
BATCH: Final = 8  # trials of TPE that are computed beside each other


def by_cma(objectives: Objectives, start: Array, most: int, tolerance: float, seed: int) -> tuple[Array, str]:
    """The best place of `most` generations, and why they ended. Raises ModelError where the library is missing."""
    cma: Any = needed("cma", "the method `CMA-ES` needs")
    given = {"bounds": [0.0, 1.0], "maxiter": most, "tolfun": tolerance, "seed": seed + 1, "verbose": -9}
    if len(start) == 1:  # which knows no single parameters: one that changes nothing goes beside it
        best, said = _by_cma(cma, lambda places: objectives([z[:1] for z in places]), np.append(start, 0.5), given)
        return best[:1], said
    return _by_cma(cma, objectives, start, given)


def _by_cma(cma: Any, objectives: Objectives, start: Array, given: dict[str, Any]) -> tuple[Array, str]:
    strategy = cma.CMAEvolutionStrategy(np.clip(start, 0.0, 1.0), SPREAD, given)
    best, least = start, objectives([start])[0]
    while not strategy.stop():
        places = [np.clip(np.asarray(each), 0.0, 1.0) for each in strategy.ask()]
        values = objectives(places)
        strategy.tell(places, values)
        if min(values) < least:
            least, best = min(values), places[int(np.argmin(values))]
    said = ", ".join(strategy.stop())
    return best, f"CMA-ES ended after {strategy.countiter} generations ({said})"


def by_tpe(objectives: Objectives, start: Array, most: int, _: float, seed: int) -> tuple[Array, str]:
    """The best place of `most` times eight trials. Raises ModelError where the library is missing."""
    optuna: Any = needed("optuna", "the method `TPE` needs")
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    names = [f"z{k}" for k in range(len(start))]
    study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=seed, multivariate=len(start) > 1))
    study.enqueue_trial(dict(zip(names, map(float, start), strict=True)))
    for _ in range(most):
        trials = [study.ask() for _ in range(BATCH)]
        places = [np.array([each.suggest_float(name, 0.0, 1.0) for name in names]) for each in trials]
        for trial, value in zip(trials, objectives(places), strict=True):
            study.tell(trial, value)
    best = np.array([study.best_params[name] for name in names])
    return best, f"TPE: the best of {most * BATCH} trials"


OF_LIBRARIES: Final[dict[str, Method]] = {"CMA-ES": by_cma, "TPE": by_tpe}


Row = tuple[int, float, float]  # output, sign, limit

WITH_SLOPES: Final = ("SLSQP", "trust-constr", "L-BFGS-B")
CONSTRAINED: Final = ("SLSQP", "trust-constr", "COBYLA")
# what a variant without outputs counts as: so many times the largest magnitude of the objective
FAR: Final = 1e3
# constraints are kept to this share of their limits
KEPT: Final = 1e-6
# trust radii of COBYLA in the unit cube: with its own first one, 1, it may end in a corner after three runs
FIRST_RADIUS: Final = 0.25
LAST_RADIUS: Final = 1e-6
# weight of broken constraints for methods that know none
WEIGHT: Final = 1e3
PENALISED: Final = 1e6


class Search:
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
        bounds = [(0.0, 1.0)] * len(z)
        if self._method == "differential-evolution":
            found = scipy.optimize.differential_evolution(
                self._with_penalty, bounds, maxiter=self._most, rng=self._seed, tol=self._tolerance, x0=z, polish=False
            )
            return found.x, str(found.message)
        if self._method in OF_LIBRARIES:
            return OF_LIBRARIES[self._method](self._penalised, z, self._most, self._tolerance, self._seed)
        given: dict[str, Any] = {"bounds": bounds, "method": self._method, "options": {"maxiter": self._most}}
        if self._method in WITH_SLOPES:
            given["jac"] = self._slope
        if self._method in ("SLSQP", "L-BFGS-B"):
            given["options"]["ftol"] = self._tolerance
        if self._method == "COBYLA":
            given["options"] |= {"rhobeg": FIRST_RADIUS, "tol": LAST_RADIUS}
        objective = self._objective
        if (self._rows or self._equal) and self._method in CONSTRAINED:
            given["constraints"] = self._constraints()
        elif self._rows or self._equal:
            objective = self._with_penalty
        found = scipy.optimize.minimize(objective, z, **given)
        return np.clip(found.x, 0.0, 1.0), str(found.message)

    def _objective(self, z: Array) -> float:
        value = float(self._evaluations.at(np.clip(z, 0.0, 1.0))[0])
        return self._sign * value / self._size if np.isfinite(value) else FAR

    def _slope(self, z: Array) -> Array:
        slope = self._sign * self._evaluations.slopes(np.clip(z, 0.0, 1.0))[0] / self._size
        return np.where(np.isfinite(slope), slope, 0.0)

    def _constraints(self) -> list[Any]:
        out: list[Any] = []
        for kind, rows, most in (("ineq", self._rows, np.inf), ("eq", self._equal, 0.0)):
            if not rows:
                continue
            room, slope = partial(self._room, rows), partial(self._room_slope, rows)
            if self._method == "trust-constr":
                out.append(scipy.optimize.NonlinearConstraint(room, 0.0, most, jac=slope))  # type: ignore[arg-type]
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

    def _penalised(self, places: Sequence[Array]) -> list[float]:
        """The same of several places, computed beside each other."""
        self._evaluations.each(places)
        return [self._with_penalty(z) for z in places]

    def judged(self, z: Array) -> float:
        """What places are compared by: the objective, far larger where constraints are broken."""
        outputs = self._evaluations.at(z)
        if not np.isfinite(outputs[0]):
            return np.inf
        broken = self.worst_break(outputs)
        return self._sign * float(outputs[0]) + (PENALISED * (1.0 + broken) * self._size if broken > KEPT else 0.0)


Limits = Mapping[str, Sequence[float | None]]


class Optimum(Struct):
    """What was found. values : by path; objective : there; outputs : by name; kept : whether all constraints hold there.

    reached : (starts,) the objective that each start came to; dataset : every variant that was computed; machine : the best one;
    message : what the method says of its end; evaluations : number of variants that were computed.
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


class Aim(Struct):
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
    computation: Computation | None = None,
    listener: Listener | None = None,
) -> Optimum:
    """The machine with the least objective. most : iterations of each start; tolerance : of the objective, as a share. computation : of
    each variant, runs by default.

    Raises ModelError where words are not known, or no start has an objective, and SolveError where that is because runs fail; its
    `result` is the table of all variants.
    """
    if method not in SEARCH_METHODS:
        raise ModelError(Fault.at("method", unknown_word(method, SEARCH_METHODS, "method")))
    said = {"objective": aim.objective, **(aim.outputs or {})}
    if method in LIBRARIES_OF:
        require(f"the method `{method}` needs", LIBRARIES_OF[method])
    limits = _checked_limits(aim.limits or {}, said, method)
    computation = computation or Computation()
    if computation.analysis == "run":
        _check_events(machine, said)
    readers = {name: said_number(each) for name, each in said.items()}
    names, sign = tuple(said), -1.0 if aim.maximise else 1.0

    def read(result: Found) -> Array:
        return _read(result, readers, first=not evaluations.made)

    begin = perf_counter()
    seen = any(callable(each) for each in said.values())  # frames, by functions of the user
    runs = machine if seen or computation.analysis != "run" else with_usual_frames(machine)
    evaluations = Evaluations(runs, box, read, len(names), computation)
    search = Search(evaluations, names, limits, sign, method, most, tolerance, seed)
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
    attributes = {
        "analysis": "optimise",
        "computed": computation.analysis,
        "machine": machine.name,
        "method": method,
        "maximise": int(aim.maximise),
        "seconds": perf_counter() - begin,
    }
    if not np.isfinite(values[best]):
        otherwise = "it is no number: its time is outside the run, or its event does not come"
        fault = Fault.at("objective", "no start has one")
        raise nothing_found(evaluations.made, fault, otherwise, table_of(evaluations, names, attributes))
    outputs = dict(zip(names, map(float, evaluations.at(found[best])), strict=True))
    chosen = box.values(found[best])
    attributes |= {"best": json.dumps(chosen), "objective": outputs["objective"], "message": messages[best]}
    return Optimum(
        values=chosen,
        objective=outputs["objective"],
        outputs=outputs,
        kept=search.worst_break(evaluations.at(found[best])) <= KEPT,
        reached=np.array([float(evaluations.at(z)[0]) for z in found]),
        dataset=table_of(evaluations, names, attributes),
        machine=machine.with_values(chosen),
        message=messages[best],
        evaluations=len(evaluations.made),
    )


def _read(result: Found, readers: Mapping[str, Callable[[Found], float]], *, first: bool) -> Array:
    """The outputs of a result. Raises UnreadError where a function of the user fails, and ModelError for words that do not fit the `first`
    result: of later ones the table would be lost with it."""
    values, failed = np.full(len(readers), np.nan), list[str]()
    for k, (name, reader) in enumerate(readers.items()):
        try:
            values[k] = reader(result)
        except OutputFailedError as error:
            failed.append(str(error))
        except Exception as error:  # whatever the function of the user does
            if first and isinstance(error, ModelError):
                raise
            failed.append(f"{name}: {type(error).__name__}: {error}")
    if failed:
        raise UnreadError(values, "; ".join(failed))
    return values


def _check_events(machine: Model, said: Mapping[str, Said]) -> None:
    """Raise ModelError where the time of an event is asked for that the machine does not have."""
    known = [each.name for each in machine.record.events]
    faults = [
        Fault.at(name, unknown_word(event, known, "event"))
        for name, each in said.items()
        if (event := event_of(each)) and event not in known
    ]
    refuse(faults)


def _checked_limits(limits: Limits, said: Mapping[str, Said], method: str) -> dict[str, tuple[float, float]]:
    out, faults = {}, []
    for name, each in limits.items():
        given = (each[0], each[1]) if len(each) == 2 else each
        if name not in said:
            faults.append(Fault.at("limits", unknown_word(name, list(said), "output")))
            continue
        if not isinstance(given, tuple | list) or len(given) != 2 or given[0] is given[1] is None:
            message = f"the least and the greatest value were expected, (None, 5.0), got {shown(given)}"
            faults.append(Fault.at(f"limits.{name}", message))
            continue
        low, high = (-np.inf if given[0] is None else given[0], np.inf if given[1] is None else given[1])
        if not all(isinstance(each, Real) and not isinstance(each, bool) for each in (low, high)):
            message = f"numbers in SI units were expected, (None, 5.0), got {shown(given)}"
            faults.append(Fault.at(f"limits.{name}", message))
        elif not low <= high:
            message = f"a least value below the greatest was expected, got {low:g} and {high:g}"
            faults.append(Fault.at(f"limits.{name}", message))
        else:
            out[name] = (float(low), float(high))
    if out and method == "L-BFGS-B":
        message = f"`{method}` knows no limits of outputs; {', '.join(CONSTRAINED)} do"
        faults.append(Fault.at("method", message))
    refuse(faults)
    return out
