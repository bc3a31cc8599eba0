"""Order and pattern of the elimination."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from nivel.system.elimination.elimination import plan
from nivel.system.elimination.factor_plan import minimum_degree


@given(
    st.lists(st.tuples(st.integers(0, 7), st.integers(0, 7)).filter(lambda p: p[0] != p[1]), min_size=1, max_size=14)
)
def test_pattern_of_the_factor_holds_every_entry_of_a_numerical_one(joints):
    rows = [[2 * k, 2 * k + 1] for k in range(len(joints))]
    blocks = [(row, body) for pair, group in zip(joints, rows, strict=True) for row in group for body in pair]
    e = plan(rows, [r for r, _ in blocks], [b for _, b in blocks])
    K = 2 * len(joints)
    assert sorted(e.order.tolist()) == list(range(K))
    rng = np.random.default_rng(0)
    C = np.zeros((K, 8))
    for row, body in blocks:
        C[row, body] = rng.standard_normal()
    S = (C @ C.T)[np.ix_(e.order, e.order)] + 10 * np.eye(K)
    L = np.linalg.cholesky(S)
    pattern = np.eye(K, dtype=bool)
    for k in range(K):
        columns = e.P_column[e.P_start[k] : e.P_start[k + 1]]
        pattern[k, columns] = True
        for column, entry in zip(columns, e.P_entry[e.P_start[k] : e.P_start[k + 1]], strict=True):
            assert e.L_row[entry] == k
            assert e.L_start[column] <= entry < e.L_start[column + 1]
    assert not np.any((np.abs(L) > 1e-12) & ~pattern)


def test_a_chain_makes_no_fill():
    count = 50
    neighbours = [{k for k in (i - 1, i + 1) if 0 <= k < count} for i in range(count)]
    order, _ = minimum_degree([5] * count, neighbours, {})
    position = {group: k for k, group in enumerate(order)}
    for k, group in enumerate(order):
        later = [n for n in neighbours[group] if position[n] > k]
        assert len(later) <= 1
