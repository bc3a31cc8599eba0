"""LU with exchanges of rows against the definition of a solution."""

import numpy as np
import pytest

from nivel.kernels.algebra.lu import factorise_lu, solve_lu

pytestmark = pytest.mark.covering


def solved(matrix, b):
    factors, pivot, x = matrix.copy(), np.zeros(len(b), dtype=np.uint32), b.copy()
    assert factorise_lu(factors, pivot)
    solve_lu(factors, pivot, x)
    return x


@pytest.mark.parametrize("imaginary", [0, 1j, 1e-20j])
@pytest.mark.parametrize("n", [1, 2, 5, 41])
def test_solution_satisfies_its_equations(n, imaginary, rng):
    matrix, b = (rng.standard_normal(shape) + imaginary * rng.standard_normal(shape) for shape in ((n, n), n))
    x = solved(matrix, b)
    # backward stable: the residual is round-off of |A| |x|
    assert np.abs(matrix @ x - b).max() < 1e-13 * n * np.abs(matrix).max() * np.abs(x).max()


def test_zeros_and_small_numbers_on_the_diagonal_are_exchanged_away():
    matrix = np.array([[0.0, 2.0, 0.0], [1.0, 1e-20, 3.0], [4.0, 0.0, 1e-20]])
    np.testing.assert_allclose(solved(matrix, matrix @ [1.0, 2.0, 3.0]), [1, 2, 3], rtol=1e-15)


def test_permutations_are_solved_exactly(rng):
    for _ in range(20):
        order = rng.permutation(6)
        b = rng.standard_normal(6)
        assert np.array_equal(solved(np.eye(6)[order], b[order]), b)


def test_complex_step_gives_the_derivative_of_the_solution(rng):
    """x = A⁻¹ b, so dx = -A⁻¹ dA x; the imaginary part is as exact as the real one."""
    matrix, change, b = rng.standard_normal((7, 7)), rng.standard_normal((7, 7)), rng.standard_normal(7)
    x = solved(matrix + 1e-30j * change, b.astype(complex))
    expected = -np.linalg.solve(matrix, change @ np.linalg.solve(matrix, b))
    np.testing.assert_allclose(x.imag / 1e-30, expected, rtol=1e-11, atol=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize("dtype", [float, complex])
@pytest.mark.parametrize("matrix", [np.zeros((2, 2)), np.array([[1.0, 2.0], [2.0, 4.0]]), np.full((2, 2), np.nan)])
def test_matrix_without_an_inverse_is_refused(matrix, dtype):
    assert not factorise_lu(matrix.astype(dtype), np.zeros(2, dtype=np.uint32))
