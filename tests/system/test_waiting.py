"""What rows of joints wait for: that they are independent on it is shown where systems are solved (tests/kernels/test_sparse_lu.py)."""

import numpy as np
import pytest

from nivel.system.elimination.elimination_hubs import waiting


def test_joints_of_a_tree_wait_for_their_outer_bodies():
    assert waiting({10: [0], 11: [0, 1], 12: [1, 2], 13: [3, 1]}) == {10: {0}, 11: {1}, 12: {2}, 13: {3}}


def test_joint_that_closes_a_loop_waits_for_the_loop():
    # 0 holds 1 and 2, a joint between these; the loop does not reach body 3, which holds 0
    assert waiting({10: [3], 11: [3, 0], 12: [0, 1], 13: [0, 2], 14: [1, 2]})[14] == {0, 1, 2}


def test_loop_through_the_ground_waits_for_all_bodies_up_to_it():
    assert waiting({10: [0], 11: [0, 1], 12: [1, 2], 13: [2]}) == {10: {0}, 11: {1}, 12: {0, 1, 2}, 13: {2}}


def test_second_joint_between_two_bodies_waits_for_both():
    assert waiting({10: [0], 11: [0, 1], 12: [0, 1]}) == {10: {0}, 11: {1}, 12: {0, 1}}


def test_constraint_on_absolute_motions_waits_for_all_bodies_up_to_the_ground():
    joints = {10: [0], 11: [0, 1], 12: [0, 2], 13: [1, 2]}
    assert waiting(joints)[13] == {0, 1, 2}
    assert waiting({**joints, 14: [5], 15: [5, 6], 16: [1, 6]}, grounded=[13])[13] == {0, 1, 2}
    assert waiting({11: [0, 1], 13: [0, 1]}, grounded=[13]) == {11: {1}, 13: {0, 1}}


def test_constraint_between_machines_that_float_apart_is_a_joint_of_their_tree():
    assert waiting({10: [0, 1], 11: [2, 3], 12: [1, 2]}) == {10: {1}, 12: {2}, 11: {3}}


def test_constraint_of_three_bodies_waits_for_the_ways_between_them():
    assert waiting({10: [0], 11: [0, 1], 12: [1, 2], 13: [1, 3], 14: [3, 2, 1]})[14] == {1, 2, 3}


@pytest.mark.parametrize("seed", range(20))
def test_rows_are_independent_on_what_was_eliminated_before_them(seed):
    """In any order that keeps to the rule, the rows eliminated so far are independent on the bodies eliminated so far."""
    rng = np.random.default_rng(seed)
    count = 8
    joints = {k: [int(rng.integers(0, k)), k] if k else [0] for k in range(count)}
    joints |= {count + k: [int(b) for b in rng.choice(count, 2, replace=False)] for k in range(3)}
    waits = waiting(joints)
    # relative motion, so G_a = -G_p; 3 + 1 + 1 + 1 rows are independent even between the same two bodies
    axes = {g: rng.standard_normal((3 if g < count else 1, 6)) for g in joints}
    G = {g: np.zeros((len(axes[g]), 6 * count)) for g in joints}
    for g, bodies in joints.items():
        for sign, body in zip((1, -1), bodies, strict=False):
            G[g][:, 6 * body : 6 * body + 6] = sign * axes[g]
    done: set[int] = set()
    rows: list[int] = []
    for body in rng.permutation(count):
        done.add(int(body))
        rows += [g for g in joints if g not in rows and waits[g] <= done]
        columns = [6 * b + i for b in sorted(done) for i in range(6)]
        if rows:
            eliminated = np.vstack([G[g][:, columns] for g in rows])
            assert np.linalg.matrix_rank(eliminated) == len(eliminated)
    assert len(rows) == len(joints)
