"""Settings of a sweep: how values make variants, what is kept of each, and how many processes run them."""

from collections.abc import Collection, Mapping
from typing import Annotated, Any, ClassVar, TypeVar, get_args

from pydantic import BeforeValidator

from nivel import methods
from nivel.machine.core.record import Record
from nivel.machine.given import Field, Given, Maybe
from nivel.machine.settings.run import Tolerance
from nivel.machine.settings.values import Count, Names
from nivel.machine.study.parameter import Output
from nivel.machine.units.quantity import Duration, Whole, fault, listed
from nivel.methods import Analysis, Combination, Drawn
from nivel.words.arguments import plain
from nivel.words.wording import unknown_word


def _combination(value: Any) -> Any:
    if value not in get_args(Combination):
        raise fault(unknown_word(str(value), get_args(Combination), "combination"))
    return value


class SweepSettings(Record):
    """Settings of a sweep."""

    tagged: ClassVar[Mapping[str, int]] = {"outputs": 2}

    combine: Annotated[Combination, BeforeValidator(_combination)] = Field(
        "grid, every value with every other; rows, the first of all lists, the second of all; or a design between two bounds",
        default="grid",
    )
    samples: Count | None = Field(
        "number of variants of a Latin hypercube between two bounds, or over distributions", default=None
    )
    seed: Whole = Field("seed of the random numbers of samples", default=0)
    save: Names = Field("names of results", default=(), absent="all joint coordinates and sensors")
    design: Drawn = Field("how samples are drawn", default="latin-hypercube")
    analysis: Analysis = Field("what is computed of each variant", default="run")
    analysis_settings: Mapping[str, Any] = Field("settings of an analysis other than a run", default={})
    outputs: Mapping[str, Output] = Field("numbers of each variant, by name", default={})
    time_limit: Maybe[Duration] = Field("longest computing time of a variant", default=None, absent="none")
    scheduler: str = Field("address of the scheduler of a Dask cluster that computes", default="", absent="none")
    processes: Count | None = Field("number of processes", default=None, absent="as many as there are processors")
    verify: bool = Field(
        "a second run beside each variant, to estimate its error", default=False, absent="not verified"
    )


# Settings of a comparison of methods: the words, steps and tolerances of which all combinations are run.

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

    integrators: Several[methods.Integrator] = Field("time integration method", default=None)
    formulations: Several[methods.Formulation] = Field("equations of motion", default=None)
    coordinates: Several[methods.Coordinates] = Field("coordinates of the equations", default=None)
    rotations: Several[methods.Rotations] = Field("rotation coordinates of lagrange", default=None)
    stabilisations: Several[methods.Stabilisation] = Field("constraint stabilisation", default=None)
    steps: Given[Several[Duration], Several[float], Any] = Field(
        "steps of integrators with a fixed step, e.g. 1ms,2ms", default=None
    )
    tolerances: Several[Tolerance] = Field("tolerances of integrators that choose their steps", default=None)
