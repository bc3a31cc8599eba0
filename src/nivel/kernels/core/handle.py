"""Views of a record: kernels hold the address of its block (`nivel.kernels.core.block`) and read just the arrays that they name."""

from __future__ import annotations

from typing import Any

from nivel.native.function import Intrinsic


def reader(record_class: type) -> Intrinsic:
    """What gives kernels a view of the record of this class at an address, or of its twin at the address of one."""

    def make() -> Any:
        from nivel.native.with_numba.views import reader

        return reader(record_class)

    return Intrinsic(make)
