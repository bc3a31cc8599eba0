"""Numbers of several machines in the lanes of a vector: each is what the function gives alone, and leaves where it would go elsewhere."""

import ctypes

import numpy as np
import pytest
import toy_packs

from nivel.native.packs import LanesWatched
from nivel.native.processor import lane_count

pytestmark = pytest.mark.compiles
LANES = lane_count()


def called(entry, x, count):
    """What an entry leaves (count, lanes) for x (·, lanes), its status, and the lanes that stay."""
    out, row = np.full((count, LANES), np.nan), (ctypes.c_void_p, ctypes.c_int64)
    function = ctypes.CFUNCTYPE(ctypes.c_int64, *row, *row)(entry.packed.address)
    x = np.ascontiguousarray(x)
    with LanesWatched() as left:
        status = function(x.ctypes.data, len(x), out.ctypes.data, count)
        return out, status, [bool(left.value >> lane & 1) for lane in range(LANES)]


def alone(entry, x, count):
    out = np.full(count, np.nan)
    return out, entry(np.ascontiguousarray(x), out)


def test_each_lane_is_what_the_function_gives_alone(rng):
    for _ in range(20):
        x = rng.uniform(-3.0, 3.0, (2, LANES))
        out, _, stays = called(toy_packs.functions, x, toy_packs.RESULTS)
        assert all(stays)
        wanted = np.array([alone(toy_packs.functions, x[:, k], toy_packs.RESULTS)[0] for k in range(LANES)]).T
        wanted[12] = np.where(x[0] > 0.0, 1.0, 0.0) if (x[0] > 0.0).any() else 2.0
        np.testing.assert_allclose(out, wanted, rtol=4e-16, atol=1e-15)


def test_where_lanes_branch_apart_the_fewer_leave():
    x = np.array([np.ones(LANES), np.full(LANES, 2.0), np.zeros(LANES)])
    out, status, stays = called(toy_packs.branches, x, 4)
    assert all(stays)
    assert status == 1
    np.testing.assert_array_equal(out, np.repeat([[1.0], [0.0], [10.0], [0.0]], LANES, axis=1))
    x[0, 0], x[1, 2] = -1.0, 3.0  # by the branch, then by the index; the first of those that are left settles that
    out, status, stays = called(toy_packs.branches, x, 4)
    assert stays == [lane not in (0, 2) for lane in range(LANES)]
    assert status == 1
    np.testing.assert_array_equal(out[:, 1], alone(toy_packs.branches, x[:, 1], 4)[0])


def test_what_is_no_number_in_one_lane_leaves_alone():
    x = np.array([np.ones(LANES), np.zeros(LANES), np.zeros(LANES)])
    x[2, 1] = np.nan
    _, status, stays = called(toy_packs.branches, x, 4)
    assert stays == [lane != 1 for lane in range(LANES)]
    assert status == 1


def test_threads_know_of_their_own_lanes_alone():
    with LanesWatched() as mine:
        _, _, stays = called(toy_packs.branches, np.array([np.arange(LANES) - 0.5, *np.zeros((2, LANES))]), 4)
        assert not all(stays)
        assert mine.value == (1 << LANES) - 1
