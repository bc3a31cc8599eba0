"""Blocks that are C functions, of a shared library or of a C file that is compiled."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import ClassVar, Literal

from nivel.machine.control.block import Numbers
from nivel.machine.control.unit import UnitBlock
from nivel.machine.control.unit_output import CFacts
from nivel.machine.core.checked import Problem
from nivel.machine.given import Field


class CBlock(UnitBlock):
    """A C function that is called at each sample: ``int f(double time, const double *inputs, double *state, double *outputs)``.

    Inputs and outputs are in the order of the block. What it returns besides zero ends the run. The first output is the value of the
    block, others have names.
    """

    what: ClassVar[str] = "a C function"

    type: Literal["c"] = "c"
    function: str = Field(description="name of the function in the file")
    state: Numbers = Field(default=(), description="memory of the function: its values at the start")

    @property
    def facts(self) -> CFacts:
        return CFacts(*self.used, function=self.function, state=self.state)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if not re.fullmatch(r"[A-Za-z_]\w*", self.function, flags=re.ASCII):
            yield Problem(("function",), f"the name of a C function was expected, got `{self.function}`")
