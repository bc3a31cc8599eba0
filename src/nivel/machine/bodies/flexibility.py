"""Flexibility of a body: its file of modes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator

from nivel.machine.core.record import Record
from nivel.machine.given import Field, Given
from nivel.machine.units.quantity import Real, Whole, fault, shown

Invariant = Literal["I5", "I8", "I9"]


def _distinct(values: Any) -> Any:
    """A list without repetition; one name stands for a list of it."""
    values = [values] if isinstance(values, str) else values
    if isinstance(values, list | tuple) and len({str(value) for value in values}) < len(values):
        raise fault(f"each name at most once was expected, got {shown(values)}")
    return values


class Flexibility(Record):
    """A body that bends by the modes in a file of `nivel reduce`."""

    file: str = Field(min_length=1, description="file of `nivel reduce`, relative to the machine file")
    modes: Annotated[Whole, Field(ge=1)] | None = Field(default=None, description="how many, lowest first; default all")
    damping_ratio: Annotated[Real, Field(ge=0.0, lt=1.0)] = Field(default=0.0, description="of each mode")
    neglect: Annotated[
        Given[tuple[Invariant, ...], tuple[Invariant, ...], Invariant | Sequence[Invariant]], BeforeValidator(_distinct)
    ] = Field(default=(), description="inertia invariants that the moving body does without: I5, I8, I9")


def _file_or_mapping(value: Any) -> Any:
    if isinstance(value, str):
        return {"file": value}
    if isinstance(value, Mapping | Flexibility):
        return value
    raise fault(f"a file of `nivel reduce`, or a mapping with `file`, was expected, got {shown(value)}")


FlexibleBody = Annotated[
    Given[Flexibility, Flexibility, str | Mapping[str, Any] | Flexibility], BeforeValidator(_file_or_mapping)
]
