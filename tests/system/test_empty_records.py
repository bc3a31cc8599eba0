"""Records without numbers: their arrays have the types and dimensions that the record says, however NumPy writes these."""

from collections import namedtuple
from typing import Annotated, Any, TypeVar

import numpy as np
import pytest
from numpy.typing import NDArray
from typing_extensions import TypeAliasType

from nivel.system.tables import empty

Number = TypeVar("Number", bound=np.generic)
# as `numpy.typing.NDArray` is from NumPy 2.5 on
Alias = TypeAliasType("Alias", np.ndarray[tuple[Any, ...], np.dtype[Number]], type_params=(Number,))


@pytest.mark.parametrize("array", [NDArray, Alias])
def test_arrays_have_their_types_and_dimensions(array):
    kind = namedtuple("Kind", ["values", "index"])
    kind.__annotations__ = {
        "values": Annotated[array[np.float64], 2, "real"], "index": Annotated[array[np.uint32], 1, "index"],
    }  # fmt: skip
    made = empty(kind)
    assert (made.values.shape, made.values.dtype) == ((0, 0), np.float64)
    assert (made.index.shape, made.index.dtype) == ((0,), np.uint32)
