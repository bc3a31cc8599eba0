"""The sparse and the rank-revealing solver against NumPy on random systems."""

import numpy as np
import pytest

from nivel.kernels.algebra.dense import factorise_pivoted, gather, solve_pivoted
from nivel.kernels.algebra.sparse import DEPENDENT, factorise, solve
from nivel.kernels.record.record import Saddle
from nivel.system.elimination.elimination import plan

pytestmark = pytest.mark.plain


def random_rows(rng, bodies, joints, rows_each):
    """Rows C (K, 6 bodies) of random joints: a chain from the ground, then loops between random bodies."""
    blocks, groups = [], []
    row = 0
    for joint in range(joints):
        first, second = (joint - 1, joint) if joint < bodies else rng.choice(bodies, 2, replace=False)
        group = list(range(row, row + rows_each))
        for r in group:
            blocks += [(r, body) for body in (int(first), int(second)) if body >= 0]
        groups.append(group)
        row += rows_each
    C = np.zeros((row, 6 * bodies))
    for r, body in blocks:
        C[r, 6 * body : 6 * body + 6] = rng.standard_normal(6)
    return C, blocks, groups


def saddle_of(C, blocks, groups, redundant=0):
    elimination = plan(groups, [r for r, _ in blocks], [b for _, b in blocks])
    K = len(C)
    empty = np.zeros((0, 0))
    saddle = Saddle(
        block=np.array([(r, 0, 0, b) for r, b in blocks], dtype=np.uint32),
        blocks=np.array([len(blocks)], dtype=np.uint32),
        pair=elimination.pair,
        order=elimination.order,
        S_start=elimination.S_start,
        S_row=elimination.S_row,
        L_start=elimination.L_start,
        L_row=elimination.L_row,
        P_start=elimination.P_start,
        P_column=elimination.P_column,
        P_entry=elimination.P_entry,
        row=np.arange(K, dtype=np.uint32),
        shift=np.zeros(K),
        least=np.zeros(K),
        target=np.zeros(K),
        before=np.zeros(K),
        W=np.array([C[r, 6 * b : 6 * b + 6] for r, b in blocks]),
        G=np.zeros((0, 0, 0)),
        z=empty,
        S=np.zeros(len(elimination.S_row)),
        L=np.zeros(len(elimination.L_row)),
        Dinv=np.zeros(K),
        y=np.zeros(K),
        b=np.zeros(K),
        dense=np.zeros((K, K)) if redundant else empty,
        null=np.zeros((K, redundant)) if redundant else empty,
        pivot=np.zeros(K if redundant else 0, dtype=np.uint32),
    )
    for a, b, entry in saddle.pair:
        saddle.S[entry] += saddle.W[a] @ saddle.W[b]
    return saddle


@pytest.mark.parametrize("seed", range(8))
def test_sparse_factor_solves_random_linkages(seed):
    rng = np.random.default_rng(seed)
    bodies = int(rng.integers(2, 12))
    C, blocks, groups = random_rows(
        rng, bodies, bodies + int(rng.integers(0, max(1, bodies // 4))), int(rng.integers(1, 5))
    )
    saddle = saddle_of(C, blocks, groups)
    right = rng.standard_normal(len(C))
    saddle.b[:] = right
    assert factorise(saddle, DEPENDENT, False) == -1
    solve(saddle)
    expected = np.linalg.solve(C @ C.T, right)
    np.testing.assert_allclose(saddle.b, expected, rtol=1e-8, atol=1e-8 * np.abs(expected).max())


def test_sparse_factor_names_a_dependent_row():
    rng = np.random.default_rng(3)
    C, blocks, groups = random_rows(rng, 2, 2, 3)
    C[5, 6:12] = C[4, 6:12]
    C[5, :6] = C[4, :6]
    saddle = saddle_of(C, blocks, groups)
    failed = factorise(saddle, DEPENDENT, False)
    assert failed >= 0
    assert saddle.order[failed] in (4, 5)


def test_sparse_factor_names_a_row_that_moves_nothing():
    """Its diagonal is round-off and no scale for its pivot; the bound comes from elsewhere."""
    rng = np.random.default_rng(3)
    C, blocks, groups = random_rows(rng, 2, 2, 3)
    C[4] *= 1e-16
    saddle = saddle_of(C, blocks, groups)
    assert factorise(saddle, DEPENDENT, False) == -1
    saddle.least[:] = 1e-22
    assert saddle.order[factorise(saddle, DEPENDENT, False)] == 4


def test_rows_that_are_left_out_get_nothing_and_the_others_hold():
    """Also after they were taken in, which fills their places in the factor."""
    rng = np.random.default_rng(5)
    C, blocks, groups = random_rows(rng, 6, 9, 3)
    saddle = saddle_of(C, blocks, groups)
    out = [2, 7, 11]
    kept = np.setdiff1d(np.arange(len(C)), out)
    assert factorise(saddle, DEPENDENT, True) == -1
    saddle.least[np.isin(saddle.order, out)] = -1.0
    right = rng.standard_normal(len(C))
    saddle.b[:] = right
    assert factorise(saddle, DEPENDENT, False) == -1
    solve(saddle)
    assert not saddle.b[out].any()
    expected = np.linalg.solve(C[kept] @ C[kept].T, right[kept])
    np.testing.assert_allclose(saddle.b[kept], expected, rtol=1e-8, atol=1e-8 * np.abs(expected).max())


@pytest.mark.parametrize("seed", range(5))
def test_pivoted_factor_gives_the_shortest_solution_in_scaled_unknowns(seed):
    rng = np.random.default_rng(seed)
    C, blocks, groups = random_rows(rng, 2, 3, 3)
    # with two bodies the third joint lies between the same bodies as the second: make its rows depend on those
    C[6:9] = rng.standard_normal((3, 3)) @ C[3:6]
    rank = 6
    saddle = saddle_of(C, blocks, groups, redundant=len(C) - rank)
    S = C @ C.T
    right = S @ rng.standard_normal(len(C))
    saddle.b[:] = right
    gather(saddle, np.ones(len(C)))
    assert factorise_pivoted(saddle, np.ones(len(C)), rank) == -1
    solve_pivoted(saddle, rank)
    scale = 1 / np.sqrt(np.diag(S))
    expected = scale * (np.linalg.pinv(scale[:, None] * S * scale, rcond=1e-10) @ (scale * right))
    np.testing.assert_allclose(S @ saddle.b, right, atol=1e-9 * np.abs(right).max())
    np.testing.assert_allclose(saddle.b, expected, atol=1e-8 * np.abs(expected).max())
