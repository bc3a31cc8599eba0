"""Settings of a comparison of methods: the words, steps and tolerances of which all combinations are run."""

from __future__ import annotations

from collections.abc import Collection
from typing import Annotated, Any, TypeVar

from pydantic import BeforeValidator

from nivel import methods
from nivel.machine.core.record import Record
from nivel.machine.given import Field, Given
from nivel.machine.settings.run import Tolerance
from nivel.machine.units.quantity import Duration, fault, listed
from nivel.words.arguments import plain

COMMON = ("duration", "output_interval", "largest_step", "cut")  # settings of a run that all runs of a comparison share


def _listed(value: Any) -> Any:
    """A single value as a list of one; a list of none, and one with an empty text, is refused."""
    if value is None:
        return None
    value = listed(plain(value))
    if isinstance(value, str | float | int):
        value = (value,)
    if isinstance(value, Collection):
        if len(value) == 0:
            raise fault("a value is missing; leave it out for the machine's own setting, or give one value at least")
        empty = [str(k + 1) for k, each in enumerate(value) if isinstance(each, str) and not each.strip()]
        if empty and len(value) == 1:
            raise fault("a value is missing; leave it out for the machine's own setting, or give a value")
        if empty:
            places = f"at place {empty[0]}" if len(empty) == 1 else f"at the places {', '.join(empty)}"
            raise fault(f"a value is missing {places} of {len(value)}; give a value, or take a comma away")
    return value


Word = TypeVar("Word")
Several = Annotated[tuple[Word, ...] | None, BeforeValidator(_listed)]


class Axes(Record):
    """The words, steps [s] and tolerances of a grid. Where an axis is None, the machine's own setting is taken."""

    integrators: Several[methods.Integrator] = Field(default=None, description="time integration method")
    formulations: Several[methods.Formulation] = Field(default=None, description="equations of motion")
    coordinates: Several[methods.Coordinates] = Field(default=None, description="coordinates of the equations")
    rotations: Several[methods.Rotations] = Field(default=None, description="rotation coordinates of lagrange")
    stabilisations: Several[methods.Stabilisation] = Field(default=None, description="constraint stabilisation")
    steps: Given[Several[Duration], Several[float], Any] = Field(
        default=None, description="steps of integrators with a fixed step, e.g. 1ms,2ms"
    )
    tolerances: Several[Tolerance] = Field(
        default=None, description="tolerances of integrators that choose their steps"
    )
