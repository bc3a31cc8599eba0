"""Numbers as a record has them: number_of(machine, x) is the dual number x where all numbers of the record are dual, else its value."""

from __future__ import annotations

from typing import Any

from nivel.native.function import Intrinsic


def _number_of() -> Any:
    from nivel.native.with_numba.numbers import number_of

    return number_of


number_of = Intrinsic(_number_of)
