"""Settings of a sweep: how values make variants, what is kept of each, and how many processes run them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, get_args

from pydantic import BeforeValidator

from nivel.machine.core.record import Record
from nivel.machine.given import Field, Maybe
from nivel.machine.settings.values import Count, Names
from nivel.machine.study.output import Output
from nivel.machine.units.quantity import Duration, Whole, fault
from nivel.methods import Analysis, Combination, Drawn
from nivel.words.wording import unknown_word


def _combination(value: Any) -> Any:
    if value not in get_args(Combination):
        raise fault(unknown_word(str(value), get_args(Combination), "combination"))
    return value


class SweepSettings(Record):
    """Settings of a sweep."""

    tagged: ClassVar[Mapping[str, int]] = {"outputs": 2}

    combine: Annotated[Combination, BeforeValidator(_combination)] = Field(
        default="grid",
        description="grid, every value with every other; rows, the first of all lists, the second of all; or a design between two bounds",
    )
    samples: Count | None = Field(
        default=None, description="number of variants of a Latin hypercube between two bounds, or over distributions"
    )
    seed: Whole = Field(default=0, description="seed of the random numbers of samples")
    save: Names = Field(default=(), description="names of results", absent="all joint coordinates and sensors")
    design: Drawn = Field(default="latin-hypercube", description="how samples are drawn")
    analysis: Analysis = Field(default="run", description="what is computed of each variant")
    analysis_settings: Mapping[str, Any] = Field(default={}, description="settings of an analysis other than a run")
    outputs: Mapping[str, Output] = Field(default={}, description="numbers of each variant, by name")
    time_limit: Maybe[Duration] = Field(default=None, description="longest computing time of a variant", absent="none")
    scheduler: str = Field(
        default="", description="address of the scheduler of a Dask cluster that computes", absent="none"
    )
    processes: Count | None = Field(
        default=None, description="number of processes", absent="as many as there are processors"
    )
    verify: bool = Field(
        default=False, description="a second run beside each variant, to estimate its error", absent="not verified"
    )
