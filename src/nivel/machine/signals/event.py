"""An event in words: an expression that passes zero."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, ValidationInfo

from nivel.machine.core.checked import Checked, Problem
from nivel.machine.core.coefficient import Truth
from nivel.machine.core.record import Name
from nivel.machine.given import Field
from nivel.machine.laws.table import Table
from nivel.machine.laws.time_function import Measured
from nivel.machine.units.quantity import fault, of_one_kind, shown

_COMPARISONS = ("<", ">", "=")


def _passing(text: str) -> str:
    """The keys that say what a comparison means; those of an example where there is more than one."""
    sides = re.split(r"[<>]=?|==?", text)
    if len(sides) != 2 or " and " in text or " or " in text:
        return "for `hinge.angle > 2` `when: hinge.angle - 2, direction: rising`"
    left, right = (side.strip() for side in sides)
    right = f"({right})" if re.search(r"[^eE(]\s*[-+]", right) else right
    difference = left if right in ("0", "0.0") else f"{left} - {right}"
    direction = ", direction: rising" if ">" in text else ", direction: falling" if "<" in text else ""
    return f"`when: {difference}{direction}`"


def _passes_zero(value: Any, info: ValidationInfo) -> Any:
    """Refuse comparisons, which people try first, and sums of unlike terms."""
    if isinstance(value, str) and any(sign in value for sign in _COMPARISONS):
        raise fault(
            f"an event is where an expression passes zero, not a comparison as in {shown(value)}: write {_passing(value)}"
        )
    return of_one_kind(value, info)


class Event(Checked):
    """A moment that a run finds and keeps: where the value of an expression changes its sign."""

    collection: ClassVar[str] = "events"

    name: Name
    when: Annotated[Measured, BeforeValidator(_passes_zero)] = Field(
        description="expression of `time` and symbols; the event is where it passes zero"
    )
    direction: Literal["rising", "falling", "both"] = Field(
        default="both", description="of the value where it passes zero"
    )
    stop: Truth = Field(default=False, description="whether the run ends at the event")

    def problems(self) -> Iterator[Problem]:
        when = self.when
        if isinstance(when, float | int):
            yield Problem(("when",), f"{when:.6g} does not vary, so it never passes zero; use `time` or symbols")
        elif isinstance(when, Table) and when.interpolation == "linear" and min(when.values) * max(when.values) >= 0:
            yield Problem(
                ("when",),
                f"the values of the table go from {min(when.values):.6g} to {max(when.values):.6g}, so they never pass zero",
            )
