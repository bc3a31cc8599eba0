"""Minimisation over parameters of a machine, with bounds and constraints on outputs, from several starts."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from numbers import Real
from time import perf_counter
from typing import Any

import numpy as np
import xarray

from nivel.analysis.optimise.evaluations import Box, Computation, Evaluations, UnreadError, nothing_found, table_of
from nivel.analysis.optimise.search import CONSTRAINED, KEPT, LIBRARIES_OF, Search
from nivel.analysis.plan.settings import with_usual_frames
from nivel.analysis.progress.log import Listener
from nivel.analysis.sweep.outputs import Found, OutputFailedError, Said, event_of, said_number
from nivel.errors import Fault, ModelError, refuse
from nivel.extras import require
from nivel.lazy import dataclass
from nivel.machine.core.vectors import Array
from nivel.machine.study.study_record import SEARCH_METHODS
from nivel.model import Model
from nivel.words.wording import shown, unknown_word

Limits = Mapping[str, Sequence[float | None]]


@dataclass(frozen=True)
class Optimum:
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
