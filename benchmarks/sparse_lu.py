"""Time of the sparse LU of chains, by links: plan, factorisation and solution, real and complex.

Each link is a body (6 unknowns) and its joint to the one before (5 rows). Median of repeated calls, from a compiled loop.

    python benchmarks/sparse_lu.py
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from nivel.kernels.algebra.sparse_lu import factorise_sparse_lu, solve_sparse_lu
from nivel.native.function import leaf
from nivel.system.elimination.factor_plan import FactorPlan, plan_factor

LINKS = (1, 8, 64, 256, 2000)


@leaf
def factorise(tables, value, L, U, Dinv, work, repeat):
    failed = 0
    for _ in range(repeat):
        failed += factorise_sparse_lu(tables, value, L, U, Dinv, work)
    return failed


@leaf
def solve(tables, L, U, Dinv, b, work, repeat):
    for _ in range(repeat):
        solve_sparse_lu(tables, L, U, Dinv, b, work)


def chain(links: int) -> FactorPlan:
    """Groups 2 k: bodies; 2 k + 1: joints."""
    joints = {2 * k + 1: [2 * k - 2, 2 * k] if k else [0] for k in range(links)}
    couples = [(joint, body) for joint, bodies in joints.items() for body in bodies]
    return plan_factor([6, 5] * links, [False, True] * links, couples)


def values(plan: FactorPlan, rng: np.random.Generator, dtype: type) -> np.ndarray:
    """Bars of length 2, revolutes about z at their ends; to the mass matrices some numbers that a tangent without symmetry adds."""
    links = plan.size // 11
    value = np.zeros(plan.column.size, dtype)
    reach = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])  # velocity of the end x = 1: v + reach ω
    outer = np.block([[np.eye(3), -reach], [np.zeros((2, 3)), np.eye(2, 3)]])
    inner = -np.block([[np.eye(3), reach], [np.zeros((2, 3)), np.eye(2, 3)]])
    for k in range(links):
        body, joint = 11 * k + np.arange(6), 11 * k + 6 + np.arange(5)
        added = rng.standard_normal((6, 6)) + (1j * rng.standard_normal((6, 6)) if dtype is complex else 0.0)
        value[plan.entry(body[:, None], body)] = np.diag([1.0, 1, 1, 0.3, 0.3, 0.3]) + 0.01 * added
        for block, at in ((outer, body), (inner, body - 11)):
            if at[0] >= 0:
                value[plan.entry(joint[:, None], at)] = block
                value[plan.entry(at[:, None], joint)] = block.T
    return value


def seconds(call: Callable[[int], object]) -> float:
    """Median time of one call in repetitions of some milliseconds."""
    call(1)
    begin = time.perf_counter()
    call(1)
    repeat = max(1, int(5e-3 / (time.perf_counter() - begin)))
    times = []
    for _ in range(30):
        begin = time.perf_counter()
        call(repeat)
        times.append((time.perf_counter() - begin) / repeat)
    return float(np.median(times))


def main() -> None:
    rng = np.random.default_rng(0)
    print("links  dtype       plan [ms]  factorise [µs/link]  solve [µs/link]  nonzeros/link  residual")
    for links in LINKS:
        begin = time.perf_counter()
        plan = chain(links)
        planned = time.perf_counter() - begin
        for dtype in (float, complex):
            value = values(plan, rng, dtype)
            L, U, Dinv, work = plan.workspace(dtype)
            b = rng.standard_normal(plan.size).astype(dtype)
            x = b.copy()
            if factorise(plan.tables, value, L, U, Dinv, work, 1) != -1:
                raise RuntimeError("a pivot failed")
            solve(plan.tables, L, U, Dinv, x, work, 1)
            row = np.repeat(np.arange(plan.size), np.diff(plan.row_start.astype(np.int64)))
            product = np.zeros(plan.size, dtype)
            np.add.at(product, row, value * x[plan.column])
            residual = np.abs(product - b).max() / np.abs(x).max()
            factorised = seconds(lambda n: factorise(plan.tables, value, L, U, Dinv, work, n))  # noqa: B023
            solved = seconds(lambda n: solve(plan.tables, L, U, Dinv, np.zeros_like(b), work, n))  # noqa: B023
            print(
                f"{links:5d}  {dtype.__name__:10s}  {planned * 1e3:9.1f}"
                f"  {factorised / links * 1e6:19.3f}  {solved / links * 1e6:15.3f}"
                f"  {(plan.L_size + plan.U_size) / links:13.0f}  {residual:8.1e}"
            )


if __name__ == "__main__":
    main()
