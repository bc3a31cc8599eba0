"""Saddle-point systems [M Gᵀ; G 0] of random machines, in groups of unknowns."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse

from nivel.kernels.algebra.sparse_lu import factorise_sparse_lu, solve_sparse_lu
from nivel.system.elimination.factor_plan import plan_factor


@dataclass(frozen=True)
class Linkage:
    """Groups: bodies (6 unknowns), joints (their rows), and pairs of bodies with a spring between them."""

    sizes: list[int]
    joints: dict[int, tuple[int, ...]]  # bodies of each group of constraints
    springs: list[tuple[int, int]]

    @property
    def couples(self):
        return [(g, body) for g, bodies in self.joints.items() for body in bodies] + self.springs

    @property
    def constraint(self):
        return [g in self.joints for g in range(len(self.sizes))]

    def plan(self):
        return plan_factor(self.sizes, self.constraint, self.couples)


def linkage(joints, rows, springs=()):
    """Bodies as far as `joints` (tuples of one or two bodies) name them, each followed by the next joint while there is one."""
    bodies = 1 + max(body for joint in joints for body in joint)
    sizes, body_group, joint_group = [], [], []
    for k in range(max(bodies, len(joints))):
        if k < bodies:
            body_group.append(len(sizes))
            sizes.append(6)
        if k < len(joints):
            joint_group.append(len(sizes))
            sizes.append(rows[k])
    of = {g: tuple(body_group[body] for body in joint) for g, joint in zip(joint_group, joints, strict=True)}
    return Linkage(sizes, of, [(body_group[a], body_group[b]) for a, b in springs])


def chain(count):
    return linkage([(0,), *((k - 1, k) for k in range(1, count))], [5] * count)


def ring(count):
    """Bodies in a circle that closes by a ball."""
    return linkage([*((k - 1, k) for k in range(1, count)), (count - 1, 0)], [5] * (count - 1) + [3])


def star(count):
    """Bodies around one hub, which a joint holds to the ground."""
    return linkage([(0,), *((0, k) for k in range(1, count + 1))], [5] * (count + 1))


def random_linkage(rng):
    """A random tree, up to two loops of one row each (independent even between the same two bodies), and springs."""
    bodies = int(rng.integers(1, 15))
    tree = [(0,)] + [(int(rng.integers(0, k)), k) for k in range(1, bodies)]
    loops = [tuple({int(b) for b in rng.integers(0, bodies, 2)}) for _ in range(int(rng.integers(0, 3)))]
    springs = [tuple(int(b) for b in rng.choice(bodies, 2, replace=False)) for _ in range(2)] if bodies > 2 else []
    rows = [int(n) for n in rng.integers(0, 5, bodies)] + [1] * len(loops)
    return linkage(tree + loops, rows, springs)


def matrix(linkage, rng, dtype=float):
    """A full matrix: M with a positive definite symmetric part; G, of relative motion, so G_a T_a = -G_p T_p; multiples of Gᵀ."""
    start = np.concatenate([[0], np.cumsum(linkage.sizes)])
    span = [slice(start[g], start[g + 1]) for g in range(len(linkage.sizes))]
    A = np.zeros((start[-1], start[-1]), dtype=dtype)

    def spread(shape):
        real = rng.standard_normal(shape)
        return real + 1j * rng.standard_normal(shape) if dtype is complex else real

    for g, size in enumerate(linkage.sizes):
        if g not in linkage.joints:
            B = rng.standard_normal((size, size))
            A[span[g], span[g]] = B @ B.T / size + np.eye(size) + 0.1 * spread((size, size))
    for a, b in linkage.springs:
        A[span[a], span[b]] = 0.05 * spread((6, 6))
        A[span[b], span[a]] = 0.05 * spread((6, 6))
    turn = {g: np.linalg.qr(rng.standard_normal((6, 6)))[0] for g in range(len(linkage.sizes))}
    for g, bodies in linkage.joints.items():
        axes = np.linalg.qr(rng.standard_normal((6, 6)))[0][: linkage.sizes[g]]
        for sign, body in zip((1, -1), bodies, strict=False):
            block = sign * axes @ turn[body]
            A[span[g], span[body]] = block
            A[span[body], span[g]] = block.T * rng.uniform(0.5, 2)
    return A


def entries(plan, A):
    """A in the order of the plan's pattern; nothing of it may lie outside."""
    rows = np.repeat(np.arange(plan.size), np.diff(plan.row_start.astype(int)))
    value = np.ascontiguousarray(A[rows, plan.column])
    assert np.count_nonzero(value) == np.count_nonzero(A)
    return value


def sparse(plan, value):
    return scipy.sparse.csr_matrix((value, plan.column.astype(int), plan.row_start.astype(int)), shape=(plan.size,) * 2)


def solved(plan, value, b):
    """Solution, or the unknown whose pivot failed."""
    L, U, Dinv, work = plan.workspace(value.dtype)
    for unset in (L, U, Dinv, work):
        unset[:] = np.nan  # what is read before it is written shows
    failed = factorise_sparse_lu(plan.tables, value, L, U, Dinv, work)
    if failed >= 0:
        return failed
    x = b.astype(value.dtype)
    solve_sparse_lu(plan.tables, L, U, Dinv, x, work)
    return x
