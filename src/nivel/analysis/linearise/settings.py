"""Settings of `nivel linearise`, checked."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass

from nivel.errors import Fault, ModelError
from nivel.machine.units.quantity import expression_fault, read_quantity, shown
from nivel.machine.units.tree import ExpressionError

START, EQUILIBRIUM = "start", "equilibrium"
COORDINATES = ("auto", "absolute", "relative")


@dataclass(frozen=True)
class LineariseSettings:
    """about : start or equilibrium; time : of a run [s] in place of it. inputs, outputs : names; None: those of the machine.
    coordinates : auto, absolute or relative."""

    about: str
    time: float
    inputs: tuple[str, ...] | None
    outputs: tuple[str, ...] | None
    coordinates: str

    def as_dict(self) -> dict[str, object]:
        """For the `settings` of results."""
        return {"analysis": "linearise", **asdict(self)}

    @property
    def words(self) -> str:
        """The state in words."""
        at_run = f"t = {self.time:.6g} s of its run"
        return {START: "its start", EQUILIBRIUM: "its equilibrium at t = 0"}.get(self.about, at_run)


def linearise_settings(
    about: float | str | None,
    inputs: Sequence[str] | str | None,
    outputs: Sequence[str] | str | None,
    coordinates: str,
    start: str,
) -> LineariseSettings:
    """Settings from options; None stands for what was not given. coordinates, start : those of the machine.

    Raises ModelError with everything that is wrong.
    """
    faults: list[Fault] = []
    word, time = (EQUILIBRIUM if start == EQUILIBRIUM else START) if about is None else str(about).strip(), 0.0
    if word not in (START, EQUILIBRIUM):
        try:
            time = read_quantity(about, "time", {})
            word = "time"
            if time < 0.0:
                faults.append(_fault("about", f"a time of zero or more was expected, got {shown(about)}"))
        except ExpressionError as problem:
            said = expression_fault(problem, about).message()
            faults.append(_fault("about", f"`start`, `equilibrium` or a time was expected: {said}"))
    if coordinates not in COORDINATES:
        faults.append(_fault("coordinates", f"'{coordinates}' is not one of {', '.join(COORDINATES)}"))
    if faults:
        raise ModelError(faults)
    return LineariseSettings(word, time, _names(inputs), _names(outputs), coordinates)


def _names(given: Sequence[str] | str | None) -> tuple[str, ...] | None:
    if given is None:
        return None
    return tuple(each.strip() for each in given.split(",")) if isinstance(given, str) else tuple(given)


def _fault(field: str, message: str) -> Fault:
    return Fault("", 0, 0, f"linearise.{field}", message)
