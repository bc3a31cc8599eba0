"""Numbers as a record has them: number_of(machine, x) is the dual number x where all numbers of the record are dual, else its value;
without_slopes(x) is the value of a dual number, and any other number itself.
"""

from __future__ import annotations

from typing import Any

from nivel.native.function import Intrinsic


def _number_of() -> Any:
    from nivel.native.with_numba.numbers import number_of

    return number_of


def _without_slopes() -> Any:
    from nivel.native.with_numba.numbers import without_slopes

    return without_slopes


number_of, without_slopes = Intrinsic(_number_of), Intrinsic(_without_slopes)
