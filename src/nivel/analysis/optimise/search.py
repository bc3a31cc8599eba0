"""A search from one start after another, by methods of SciPy and of further libraries, in the unit cube of the parameters.

Methods of further libraries, which search the whole unit cube without slopes.
CMA-ES (Hansen 2016) of pycma, and TPE (Bergstra et al. 2011) of Optuna.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, Final

import numpy as np

from nivel.analysis.optimise.evaluations import Evaluations
from nivel.extras import needed
from nivel.lazy import scipy
from nivel.machine.core.vectors import Array

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
        """Constraints as the method takes them."""
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
