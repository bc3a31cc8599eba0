"""The block behind a handle is read back as the arrays it was made of."""

from typing import NamedTuple

import numpy as np
import pytest

from nivel.kernels.core.arrays import A1, F1, F2, F3, I1, U1, U2
from nivel.kernels.core.block import Handle
from nivel.kernels.core.handle import reader
from nivel.native.function import leaf


class Inner(NamedTuple):
    vector: F1
    index: U2


class Outer(NamedTuple):
    matrix: F2
    inner: Inner
    cube: F3
    small: U1
    count: I1
    address: A1


read = reader(Outer)


@leaf
def double_and_sum(address):
    record = read(address)
    record.matrix[1, 2] *= 2.0
    record.inner.index[0, 1] += 5
    total = 0.0
    for i in range(record.cube.shape[0]):
        for j in range(record.cube.shape[1]):
            for k in range(record.cube.shape[2]):
                total += record.cube[i, j, k] * (1 + i + 10 * j + 100 * k)
    return total + record.small[2] + record.count[0] + record.address[0] + record.inner.vector.shape[0]


def make():
    return Outer(
        np.arange(6.0).reshape(2, 3),
        Inner(np.zeros(7), np.zeros((1, 2), dtype=np.uint32)),
        np.arange(24.0).reshape(2, 3, 4),
        np.array([1, 2, 3], dtype=np.uint32),
        np.array([-50], dtype=np.int64),
        np.array([1000], dtype=np.uint64),
    )


def test_kernel_reads_and_writes_the_arrays_of_the_record():
    record = make()
    i, j, k = np.indices((2, 3, 4))
    expected = np.sum(record.cube * (1 + i + 10 * j + 100 * k)) + 3 - 50 + 1000 + 7
    assert double_and_sum(Handle(record).address) == expected
    assert record.matrix[1, 2] == 10.0
    assert record.inner.index[0, 1] == 5


def test_array_that_is_not_contiguous_is_refused():
    record = make()._replace(matrix=np.zeros((3, 2)).T)
    with pytest.raises(TypeError, match="contiguous"):
        Handle(record)
