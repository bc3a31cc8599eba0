"""Outputs in words: one number of a run, as `max(crank.angle)`, `slider.position.x at 0.5 s` or `time(lift)`."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.machine.units.quantity import ANY, read_quantity
from nivel.machine.units.tree import ExpressionError
from nivel.results.curve import Curve, curve_of
from nivel.results.reductions import REDUCTIONS
from nivel.results.result import Result
from nivel.words.wording import shown, unknown_word

Spoken = Callable[[Result], float]
Numbers = np.ndarray[Any, np.dtype[np.float64]]


CALL = re.compile(r"(\w+)\((.*)\)")


def spoken_output(said: str | Callable[[Result], float]) -> Spoken:
    """A function of a result for what was said; a function as it is.

    Said: the name of a result, which is its value at the end; `max`, `min`, `peak` (largest magnitude), `mean`, `rms` or `integral` of it;
    its value `at` a time; `time` of the first event of a name. Raises ModelError for other words.
    """
    if callable(said):
        return lambda result: float(said(result))
    words = str(said).strip()
    if found := CALL.fullmatch(words):
        word, inner = found[1], found[2].strip()
        if word == "time":
            return lambda result: _event_time(result, inner)
        if word not in REDUCTIONS:
            raise ModelError(Fault.at(words, unknown_word(word, [*REDUCTIONS, "time"], "reduction")))
        reduce = REDUCTIONS[word]
        return lambda result: float(reduce(history(result, inner)).value[0])
    name, at, moment = words.rpartition(" at ")
    if not at:
        return lambda result: float(history(result, words).value[-1, 0])
    try:
        time = float(read_quantity(moment, ANY, {}))
    except (ExpressionError, TypeError, ValueError):
        raise ModelError(Fault.at(words, f"a time was expected after `at`, got {shown(moment)}")) from None
    return lambda result: at_times(result, name.strip(), np.array([time]))[0]


def event_of(said: str | Callable[[Result], float]) -> str:
    """The event whose time was said; empty for other outputs."""
    found = None if callable(said) else CALL.fullmatch(str(said).strip())
    return found[2].strip() if found and found[1] == "time" else ""


def history(result: Result, name: str) -> Curve:
    """The curve of a result that is one number at each time. Raises ModelError where it is several, or none."""
    values = result.array(name)
    if values.ndim != 1:
        raise ModelError(Fault.at(name, f"one number was expected; it has {values.shape[1:]}: name one of them"))
    return curve_of(result, name)


def at_times(result: Result, name: str, times: Numbers) -> Numbers:
    """Values at times, between two frames by cubics; not numbers before the start and after the end of the run."""
    t = result.time
    out = history(result, name).at(times)[:, 0]
    slack = 1e-9 * abs(t[-1])
    out[(times < t[0] - slack) | (times > t[-1] + slack)] = np.nan
    return out


def _event_time(result: Result, name: str) -> float:
    return next((float(each.time) for each in result.events if each.name == name), np.nan)
