"""Sparse LU without exchanges of rows against NumPy on saddle-point systems of random machines."""

import numpy as np
import pytest
from numba import njit, types

from lanes import tail
from nivel.kernels.algebra.sparse_lu import SparseLU, factorise_sparse_lu, solve_sparse_lu
from nivel.native.function import OPTIONS
from nivel.native.with_numba import functions  # noqa: F401  (kernels call kernels)
from nivel.native.with_numba.kinds import record_type
from nivel.system.elimination.factor_plan import plan_factor
from saddle_points import chain, entries, linkage, matrix, random_linkage, ring, solved, sparse, star

pytestmark = pytest.mark.plain

DTYPES = [float, complex]


def assert_solves(A, x, b):
    """Residual at round-off: backward stable (Higham 2002, §7.1) with a little room for growth, as no rows are exchanged."""
    scale = abs(A).sum(axis=1).max() * np.abs(x).max() + np.abs(b).max()
    assert np.abs(A @ x - b).max() < 1e-13 * scale


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("seed", tail(range(25), range(8)))
def test_random_machines_are_solved(seed, dtype):
    rng = np.random.default_rng(seed)
    machine = random_linkage(rng)
    A, plan = matrix(machine, rng, dtype), machine.plan()
    b = rng.standard_normal(plan.size)
    x = solved(plan, entries(plan, A), b)
    assert_solves(A, x, b)
    expected = np.linalg.solve(A, b)
    assert np.abs(x - expected).max() < 1e-13 * np.linalg.cond(A) * np.abs(expected).max()


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("machine", [chain(60), ring(60), star(30)], ids=["chain", "ring", "star"])
def test_large_machines_are_solved(machine, dtype, rng):
    plan = machine.plan()
    value = entries(plan, matrix(machine, rng, dtype))
    b = rng.standard_normal(plan.size)
    assert_solves(sparse(plan, value), solved(plan, value, b), b)


def test_matrix_without_zeros_is_solved(rng):
    plan = plan_factor([3, 4, 1], [False] * 3, [(0, 1), (1, 2), (0, 2)])
    A = rng.standard_normal((8, 8)) + 8 * np.eye(8)
    b = rng.standard_normal(8)
    np.testing.assert_allclose(solved(plan, entries(plan, A), b), np.linalg.solve(A, b), rtol=1e-12)


def test_no_unknowns_are_solved():
    plan = plan_factor([], [], [])
    assert solved(plan, np.zeros(0), np.zeros(0)).size == 0


def test_factors_do_not_depend_on_what_was_factorised_before(rng):
    machine = random_linkage(np.random.default_rng(4))
    plan = machine.plan()
    values = [entries(plan, matrix(machine, rng)) for _ in range(2)]
    L, U, Dinv, work = plan.workspace()
    kept = []
    for value in (values[0], values[1], values[0]):
        assert factorise_sparse_lu(plan.tables, value, L, U, Dinv, work) == -1
        kept.append([array.copy() for array in (L, U, Dinv)])
    for first, third in zip(kept[0], kept[2], strict=True):
        np.testing.assert_array_equal(first, third)


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("units", [1.0, 1e9, 1e-9])
def test_dependent_constraint_is_named_in_any_units(units, dtype, rng):
    """Two joints between the same two bodies, with one row in common; multipliers in any unit, rows of constraints in any other."""
    machine = linkage([(0,), (0, 1), (0, 1)], [3, 2, 2])
    plan = machine.plan()
    A = matrix(machine, rng, dtype)
    group = np.repeat(np.arange(5), machine.sizes)
    (first, *_), (second, *_) = np.flatnonzero(group == 3), np.flatnonzero(group == 4)
    A[second], A[:, second] = A[first], A[:, first]
    rows = np.isin(group, list(machine.joints))
    A[rows] *= units
    A[:, rows] *= units**0.5
    assert solved(plan, entries(plan, A), np.zeros(plan.size)) in (first, second)


def test_units_of_rows_and_columns_do_not_matter(rng):
    machine = random_linkage(np.random.default_rng(7))
    plan = machine.plan()
    A = matrix(machine, rng)
    rows, columns = (10.0 ** rng.integers(-12, 12, plan.size) for _ in range(2))
    b = rng.standard_normal(plan.size)
    x = solved(plan, entries(plan, rows[:, None] * A * columns), rows * b)
    assert_solves(A, columns * x, b)


def test_complex_step_gives_the_derivative_of_the_solution(rng):
    machine = random_linkage(np.random.default_rng(11))
    plan = machine.plan()
    A, b = matrix(machine, rng), rng.standard_normal(plan.size)
    change = A * rng.standard_normal(A.shape)
    x = solved(plan, entries(plan, A + 1e-30j * change), b)
    expected = -np.linalg.solve(A, change @ np.linalg.solve(A, b))  # dx = -A⁻¹ dA x
    np.testing.assert_allclose(x.imag / 1e-30, expected, atol=1e-11 * np.abs(expected).max())


@pytest.mark.parametrize("wrong", [0.0, np.nan, np.inf])
def test_pivot_that_is_none_is_named(wrong, rng):
    """An unknown alone in its row and column."""
    plan = plan_factor([2, 1, 2], [False] * 3, [(0, 2)])
    A = rng.standard_normal((5, 5)) + 8 * np.eye(5)
    A[2], A[:, 2] = 0.0, 0.0
    A[2, 2] = wrong
    rows = np.repeat(np.arange(5), np.diff(plan.row_start.astype(int)))
    assert solved(plan, np.ascontiguousarray(A[rows, plan.column]), np.zeros(5)) == 2


def test_more_rows_than_motions_are_refused(rng):
    machine = linkage([(0,), (0,)], [4, 3])
    plan = machine.plan()
    assert plan.size == 13
    failed = solved(plan, entries(plan, matrix(machine, rng)), np.zeros(13))
    assert 6 <= failed < 13


@pytest.mark.compiles
@pytest.mark.parametrize("number", tail([types.float64, types.complex128], [types.float64]), ids=str)
def test_kernels_compile_for_part_of_a_record(number):
    array = types.Array(number, 1, "C")
    for function, result in ((factorise_sparse_lu, types.int64), (solve_sparse_lu, types.void)):
        assert njit(result(record_type(SparseLU), *[array] * 5), **OPTIONS)(function.py_func).signatures
