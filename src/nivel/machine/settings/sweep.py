"""Settings of a sweep: how values make variants, what is kept of each, and how many processes run them."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator

from nivel.machine.core.record import Record
from nivel.machine.given import Field
from nivel.machine.settings.values import Names
from nivel.machine.units.quantity import Whole, fault, shown
from nivel.methods import Combination


def _combination(value: Any) -> Any:
    if value not in ("grid", "rows"):
        raise fault(f"`grid` or `rows` was expected, got {shown(value)}")
    return value


def _count(value: Any) -> Any:
    if isinstance(value, int) and value < 1:
        raise fault(f"a whole number of at least 1 was expected, got {shown(value)}")
    return value


Count = Annotated[Whole, BeforeValidator(_count)]


class SweepSettings(Record):
    """Settings of a sweep."""

    combine: Annotated[Combination, BeforeValidator(_combination)] = Field(
        default="grid",
        description="grid, every value with every other; or rows, the first of all lists, the second of all",
    )
    samples: Count | None = Field(
        default=None, description="number of variants of a Latin hypercube between two bounds, or over distributions"
    )
    seed: Whole = Field(default=0, description="seed of the random numbers of samples")
    save: Names = Field(default=(), description="names of results", absent="all joint coordinates and sensors")
    processes: Count | None = Field(
        default=None, description="number of processes", absent="as many as there are processors"
    )
    verify: bool = Field(
        default=False, description="a second run beside each variant, to estimate its error", absent="not verified"
    )
