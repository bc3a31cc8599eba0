"""Methods of further libraries, which search the whole unit cube without slopes.

CMA-ES (Hansen 2016) of pycma, and TPE (Bergstra et al. 2011) of Optuna.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.extras import needed

Array = NDArray[np.float64]
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
