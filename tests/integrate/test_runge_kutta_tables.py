"""Order conditions of the embedded Runge–Kutta methods: Σ b_i Φ_i(τ) = 1/γ(τ) for every rooted tree τ up to the order (Butcher 1963;
Hairer, Nørsett, Wanner 1993, §II.2), and θ^|τ|/γ(τ) for the weights b_i(θ) of a dense output."""

from functools import cache
from itertools import combinations_with_replacement

import numpy as np
import pytest

from nivel.integrate.explicit import dop853 as eight
from nivel.integrate.explicit import dormand_prince as five


@cache
def trees(order):
    """Rooted trees with `order` nodes: a tree is the sorted tuple of the trees that its root carries."""
    return () if order < 1 else tuple(tuple(sorted(forest)) for forest in forests(order - 1))


@cache
def forests(nodes):
    """Multisets of trees with so many nodes in all."""
    if nodes == 0:
        return ((),)
    found = set()
    for largest in range(1, nodes + 1):
        for count in range(1, nodes // largest + 1):
            for chosen in combinations_with_replacement(trees(largest), count):
                rest = nodes - largest * count
                for others in forests(rest):
                    if all(size(tree) < largest for tree in others):
                        found.add(tuple(sorted(chosen + others)))
    return tuple(sorted(found))


def size(tree):
    return 1 + sum(size(each) for each in tree)


def density(tree):
    """γ."""
    return size(tree) * np.prod([density(each) for each in tree], dtype=float)


def weights(tree, A):
    """Φ_i: for every stage the product of Σ_j a_ij Φ_j over the branches."""
    out = np.ones(len(A))
    for each in tree:
        out = out * (A @ weights(each, A))
    return out


def square(A):
    """The table with as many columns as stages."""
    return np.hstack([A, np.zeros((len(A), len(A) - A.shape[1]))])


def worst(A, b, order, left=1.0):
    """Largest defect of the conditions up to `order` at θ = left."""
    all_trees = [tree for n in range(1, order + 1) for tree in trees(n)]
    return max(abs(b @ weights(tree, A) - left ** size(tree) / density(tree)) for tree in all_trees)


def test_trees_are_as_many_as_known():
    """OEIS A000081."""
    assert [len(trees(n)) for n in range(1, 9)] == [1, 1, 2, 4, 9, 20, 48, 115]


def test_the_weights_of_dormand_prince_are_of_orders_five_and_four():
    A = square(five.A)
    np.testing.assert_allclose(A.sum(axis=1), five.C, atol=1e-15)
    b = A[6]
    assert worst(A, b, 5) < 1e-14
    assert worst(A, b, 6) > 1e-4
    assert worst(A, b - five.E, 4) < 1e-14
    assert worst(A, b - five.E, 5) > 1e-4


def test_the_weights_of_dop853_are_of_orders_eight_five_and_three():
    A = eight.A
    np.testing.assert_allclose(A.sum(axis=1), eight.C, atol=1e-14)
    b = A[12]
    assert worst(A, b, 8) < 1e-14
    assert worst(A, b, 9) > 1e-8
    pad = np.zeros(len(A) - eight.STAGES)
    fifth, third = b - np.concatenate([eight.E5, pad]), b - np.concatenate([eight.E3, pad])
    assert worst(A, fifth, 5) < 1e-14
    assert worst(A, fifth, 6) > 1e-6
    assert worst(A, third, 3) < 1e-14
    assert worst(A, third, 4) > 1e-4


@pytest.mark.parametrize("theta", [0.1, 0.5, 0.8, 1.0])
def test_dense_outputs_are_of_orders_four_and_seven(theta):
    for A, D, new, order in ((square(five.A), five.D[None, :], 6, 4), (eight.A, eight.D, 12, 7)):
        first, last = np.eye(len(A))[0], np.eye(len(A))[new]
        change = A[new]
        rows = [change, first - change, 2 * change - last - first, *D]
        b = np.zeros(len(A))
        for k in reversed(range(len(rows))):
            b = (theta if k % 2 == 0 else 1 - theta) * (rows[k] + b)
        assert worst(A, b, order, theta) < 1e-13
