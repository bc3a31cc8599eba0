"""A hand in words: a spring from a point of a body, of whichever is chosen, to a point in space."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator

from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import NotNegativeNumber
from nivel.machine.core.element import ForceElement
from nivel.machine.given import Field, OneNumber
from nivel.machine.laws.time_function import OneFunction, ThreeFunctions, varying
from nivel.machine.units.quantity import ANY, Quantity, listed

Varied = Annotated[OneFunction, varying(ANY)]
Place = Annotated[OneFunction, varying("length")]
Frequency = Annotated[OneNumber, Quantity("frequency", positive=True)]


class Hand(ForceElement):
    """A force m pull (ω² (towards - p) - 2 ζ ω ṗ) at the point p of the chosen body of mass m, ω = 2π `frequency`: as strong as lets the
    body alone swing with this frequency and damping ratio.

    `nivel live` adds one, by which bodies are picked up with the mouse.
    """

    stiff: ClassVar[bool] = False

    type: Literal["hand"] = "hand"
    pull: Varied = Field(description="1 while it holds, 0 while it does not, and between")
    body_number: Varied = Field(
        description="which body: its number in the order of the file, from 0; none where there is no such one"
    )
    point: Annotated[ThreeFunctions[Place], BeforeValidator(listed)] = Field(description="of the body, in its frame")
    towards: Annotated[ThreeFunctions[Place], BeforeValidator(listed)] = Field(description="in space, global axes")
    frequency: Frequency = Field(default=1.5, description="of the chosen body alone")
    damping_ratio: NotNegativeNumber = Field(default=0.7)

    def problems(self) -> Iterator[Problem]:
        if isinstance(self.pull, int | float) and self.pull == 0:
            yield Problem(
                ("pull",), "a hand that never pulls does nothing; 1 holds, or an expression such as `grip.value`"
            )
