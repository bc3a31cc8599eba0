"""Order, pattern and size of the factors of tangents."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nivel.system.elimination.factor_plan import minimum_degree, plan_factor
from saddle_points import chain, ring

pairs = st.lists(st.tuples(st.integers(0, 9), st.integers(0, 9)), max_size=25)
flags = st.lists(st.booleans(), min_size=10, max_size=10)
counts = st.lists(st.integers(0, 4), min_size=10, max_size=10)


@given(counts, flags, pairs)
def test_constraints_follow_all_that_they_couple_with(sizes, constraint, couples):
    plan = plan_factor(sizes, constraint, couples)
    assert sorted(plan.tables.order.tolist()) == list(range(sum(sizes)))
    place = np.argsort(plan.tables.order)
    first = np.cumsum([0, *sizes])
    for a, b in [*couples, *(pair[::-1] for pair in couples)]:
        if constraint[a] and not constraint[b] and sizes[a] and sizes[b]:
            assert place[first[a] : first[a + 1]].min() > place[first[b] : first[b + 1]].max()


@given(counts, flags, pairs)
def test_pattern_is_that_of_the_groups(sizes, constraint, couples):
    plan = plan_factor(sizes, constraint, couples)
    coupled = np.eye(10, dtype=bool)
    for a, b in couples:
        coupled[a, b] = coupled[b, a] = True
    expected = np.repeat(np.repeat(coupled, sizes, axis=0), sizes, axis=1)
    rows, columns = np.nonzero(expected)  # row by row, ascending
    np.testing.assert_array_equal(plan.row_start, np.concatenate([[0], np.cumsum(expected.sum(axis=1))]))
    np.testing.assert_array_equal(plan.column, columns)
    np.testing.assert_array_equal(plan.entry(rows, columns), np.arange(len(rows)))


@given(counts, flags, pairs)
def test_factors_have_a_place_for_every_number_of_numerical_ones(sizes, constraint, couples):
    """Each entry of A enters at a place of its own, and the count of places covers the fill of a matrix without cancellation."""
    plan = plan_factor(sizes, constraint, couples)
    tables = plan.tables
    for at, size in ((tables.upper_at, plan.U_size), (tables.lower_at, plan.L_size)):
        assert len(np.unique(at)) == len(at)
        assert np.all(at < size)
    taken = np.concatenate([tables.upper_from, tables.lower_from])
    np.testing.assert_array_equal(np.sort(taken), np.arange(len(plan.column)))
    A = np.zeros((plan.size, plan.size))
    A[np.repeat(np.arange(plan.size), np.diff(plan.row_start.astype(int))), plan.column] = 1
    A = A[np.ix_(tables.order, tables.order)] > 0
    for k in range(plan.size):  # elimination of ones that never cancel
        A[k + 1 :, k + 1 :] |= np.outer(A[k + 1 :, k], A[k, k + 1 :])
    assert plan.L_size + plan.U_size >= A.sum()
    assert plan.fill <= 1 + 1e-12


def test_entry_outside_the_pattern_is_refused():
    plan = plan_factor([2, 2], [False, False], [])
    np.testing.assert_array_equal(plan.entry([[2], [3]], [[2, 3]]), [[4, 5], [6, 7]])
    with pytest.raises(KeyError, match=r"no entry \(1, 3\)"):
        plan.entry([0, 1], [1, 3])
    with pytest.raises(KeyError, match=r"no entry \(1, 4\)"):
        plan.entry(1, 4)


def test_the_group_with_the_fewest_unknowns_beside_it_is_first():
    # 0 meets 3 + 1 unknowns, 1 meets 2, 2 meets 2 + 0: ties go to the earlier
    order, beside = minimum_degree([2, 3, 1], [{1, 2}, {0}, {0}], {})
    assert order == [1, 0, 2]
    assert beside == [{2}, {0}, set()]


def test_constraints_that_wait_for_each_other_are_refused():
    with pytest.raises(ValueError, match="wait for each other"):
        minimum_degree([1, 1], [{1}, {0}], {0: [1], 1: [0]})


@pytest.mark.parametrize("machine", [chain, ring])
def test_factors_of_chains_grow_by_the_same_for_every_link(machine):
    sizes = [machine(count).plan() for count in (50, 100, 150)]
    for name in ("L_size", "U_size"):
        short, middle, long = (getattr(plan, name) for plan in sizes)
        assert long - middle == middle - short


def test_fill_is_the_share_of_a_full_matrix():
    assert plan_factor([4, 4], [False, False], [(0, 1)]).fill == 1
    assert plan_factor([4, 4], [False, False], []).fill == 0.5


def test_blocks_join_groups_that_meet_the_same_unknowns():
    """A body and the joint behind it are one block of 11 unknowns; beside them are the 5 of the next joint."""
    tables = chain(30).plan().tables
    assert len(tables.width) == 30
    assert tables.width.max() == 11 + 5
