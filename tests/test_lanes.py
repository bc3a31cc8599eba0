"""Tails of grids: what the default tests leave to the full ones."""

from itertools import product

import pytest

from lanes import tail_of


@pytest.mark.parametrize("sizes", [(1,), (5,), (2, 3), (4, 4), (2, 3, 5), (3, 1, 4)])
@pytest.mark.parametrize("first", [0, 7, 12345])
def test_a_covering_grid_keeps_each_value_of_each_parameter_and_few_more(sizes, first):
    cases = list(product(*map(range, sizes)))
    values = [set(enumerate(case)) for case in cases]
    kept = set(cases) - set(tail_of(cases, values, first))
    assert set().union(*(set(enumerate(case)) for case in kept)) == set().union(*values)
    assert max(sizes) <= len(kept) <= sum(sizes) - len(sizes) + 1
    assert cases[first % len(cases)] in kept


def test_parameters_that_belong_together_stay_together():
    """Of a grid with holes every case that alone has a value stays."""
    cases = [{("a", 0), ("b", 0)}, {("a", 0), ("b", 1)}, {("a", 1), ("b", 0)}]
    assert tail_of(range(3), cases, 0) == []
    assert tail_of(range(3), cases, 1) == [0]
