"""What makes a body flexible, in words: its file of modes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import BeforeValidator, Field

from nivel.machine.quantity import fault, shown
from nivel.machine.record import Record


class Flexibility(Record):
    """A body that bends by the modes in a file of `nivel reduce`."""

    file: str = Field(min_length=1, description="of `nivel reduce`, seen from the machine file")
    modes: Annotated[int, Field(ge=1)] | None = Field(default=None, description="how many, lowest first; default all")
    damping_ratio: Annotated[float, Field(ge=0.0, lt=1.0)] = Field(default=0.0, description="of each mode")


def _file_or_mapping(value: Any) -> Any:
    if isinstance(value, str):
        return {"file": value}
    if isinstance(value, Mapping | Flexibility):
        return value
    raise fault(f"a file of `nivel reduce`, or a mapping with `file`, was expected, got {shown(value)}")


FlexibleBody = Annotated[Flexibility, BeforeValidator(_file_or_mapping)]
