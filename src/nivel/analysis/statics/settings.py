"""Settings of `nivel statics`, checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from nivel.errors import Fault, ModelError
from nivel.machine.settings.run import SHORTEST
from nivel.machine.units.quantity import expression_fault, read_quantity, shown
from nivel.machine.units.tree import ExpressionError

MOST_STEPS = 1_000_000
MOST_MODES = 1000
STEPS = 20


@dataclass(frozen=True)
class StaticsSettings:
    """Settings of a statics run.

    duration, step : of time, on which loads and drivers depend [s]; duration 0: the equilibrium at t = 0 alone. arc_length : follow the
    path through limit points. tolerance : of the last change, in lengths of the machine and radians. most_iterations : of Newton's
    method. line_search : shorten steps that come no nearer. modes : vibrations of every state. buckling : linearised buckling loads.
    coordinates : absolute or relative.
    """

    duration: float
    step: float
    arc_length: bool = False
    tolerance: float = 1e-10
    most_iterations: int = 25
    line_search: bool = True
    modes: int = 0
    buckling: int = 0
    coordinates: str = "auto"

    def as_dict(self) -> dict[str, object]:
        """For the result's `settings`."""
        return {"analysis": "statics", **asdict(self)}


def statics_settings(given: Mapping[str, Any], coordinates: str) -> StaticsSettings:
    """Settings from options; None stands for what was not given. coordinates : those of the machine file, or auto.

    Raises ModelError with everything that is wrong.
    """
    faults: list[Fault] = []

    def time(name: str, default: float) -> float:
        value = given.get(name)
        if value is None:
            return default
        try:
            seconds = read_quantity(value, "time", {})
        except ExpressionError as problem:
            faults.append(_fault(name, expression_fault(problem, value).message()))
            return default
        if seconds < 0.0 or (seconds == 0.0 and name != "duration"):
            faults.append(_fault(name, f"a time greater than zero was expected, got {shown(value)}"))
            return default
        return seconds

    def whole(name: str, default: int, low: int, high: int) -> int:
        value = given.get(name)
        if value is None:
            return default
        number = _whole(value)
        if number is None or not low <= number <= high:
            faults.append(_fault(name, f"a whole number from {low} to {high} was expected, got {shown(value)}"))
            return default
        return number

    duration = time("duration", 1.0)
    step = time("step", duration / STEPS if duration else 1.0)
    if 0.0 < duration < SHORTEST:
        faults.append(
            _fault(
                "duration", f"{duration:g} s is shorter than {SHORTEST:g} s; use 0 for the equilibrium at t = 0 alone"
            )
        )
    if duration and step > duration:
        faults.append(_fault("step", f"{step:g} s is longer than the duration of {duration:g} s"))
    if duration and duration / step > MOST_STEPS:
        faults.append(
            _fault("step", f"{step:g} s makes more than {MOST_STEPS} steps in {duration:g} s; use a larger one")
        )
    tolerance = _number(given.get("tolerance"), 1e-10)
    if tolerance is None or not 1e-14 <= tolerance <= 1e-2:
        faults.append(_fault("tolerance", f"a number from 1e-14 to 1e-2 was expected, got {shown(given['tolerance'])}"))
    chosen = coordinates if given.get("coordinates") is None else given["coordinates"]
    if chosen not in ("auto", "absolute", "relative"):
        if given.get("coordinates") is not None:
            faults.append(_fault("coordinates", f"'{chosen}' is not one of auto, absolute, relative"))
        chosen = "auto"
    buckling = whole("buckling", 0, 0, MOST_MODES)
    if buckling and not duration:
        faults.append(_fault("buckling", "needs loads that grow with time: a duration above zero"))
    if given.get("arc_length") and not duration:
        faults.append(_fault("arc_length", "needs loads that grow with time: a duration above zero"))
    settings = StaticsSettings(
        duration=duration,
        step=step,
        arc_length=bool(given.get("arc_length")),
        tolerance=tolerance or 1e-10,
        most_iterations=whole("most_iterations", 25, 2, 1000),
        line_search=given.get("line_search") is not False,
        modes=whole("modes", 0, 0, MOST_MODES),
        buckling=buckling,
        coordinates=str(chosen),
    )
    if faults:
        raise ModelError(faults)
    return settings


def _whole(value: int | str) -> int | None:
    try:
        return int(value)
    except ValueError:
        return None


def _number(value: float | str | None, default: float) -> float | None:
    if value is None:
        return default
    try:
        return float(value)
    except ValueError:
        return None


def _fault(field: str, message: str) -> Fault:
    return Fault("", 0, 0, f"statics.{field}", message)
