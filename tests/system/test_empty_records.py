"""Records without numbers: their arrays have the types and dimensions that the record says, however NumPy writes these."""

from collections import namedtuple
from types import GenericAlias
from typing import Annotated

import numpy as np
import pytest
from numpy.typing import NDArray

from nivel.system.tables import empty


class Alias:
    """`Alias[number]` has the number as its only argument, as `numpy.typing.NDArray` from NumPy 2.5 on."""

    __class_getitem__ = classmethod(GenericAlias)


@pytest.mark.parametrize("array", [NDArray, Alias])
def test_arrays_have_their_types_and_dimensions(array):
    kind = namedtuple("Kind", ["values", "index"])
    kind.__annotations__ = {
        "values": Annotated[array[np.float64], 2, "real"], "index": Annotated[array[np.uint32], 1, "index"],
    }  # fmt: skip
    made = empty(kind)
    assert (made.values.shape, made.values.dtype) == ((0, 0), np.float64)
    assert (made.index.shape, made.index.dtype) == ((0,), np.uint32)
