"""Redundant machines: found, named, and run knowingly."""

import numpy as np
import pytest

import machines
from nivel.analysis.assembly.equations import equations
from nivel.analysis.assembly.redundancy import dependent_rows, row_lengths
from preparing import prepare
from running import run


def test_report_machines_have_one_freedom_and_no_redundant_row():
    for machine in (machines.slider_crank(), machines.four_bar()):
        redundancy = prepare(machine, "newton-euler").redundancy
        assert redundancy.degrees_of_freedom == 1
        assert redundancy.redundant_rows == ()
        assert redundancy.non_unique_joints == ()


def test_four_revolutes_in_a_plane_are_three_rows_too_many():
    machine = machines.four_bar(second="revolute", third="revolute")
    redundancy = prepare(machine, "newton-euler").redundancy
    assert redundancy.degrees_of_freedom == 1
    assert len(redundancy.redundant_rows) == 3
    # the planar loop over-determines translation along Z and tilting, never a row in the plane
    assert not any(row.endswith(("s.x", "s.y")) for row in redundancy.redundant_rows)
    assert set(redundancy.non_unique_joints) == {"hinge", "pin", "sleeve", "pivot"}


@pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
@pytest.mark.parametrize("stabilisation", ["none", "direct"])
def test_redundant_four_bar_moves_like_the_determinate_one(formulation, stabilisation):
    settings = {
        "duration": 1.0,
        "step": 1e-3,
        "output_interval": 0.05,
        "formulation": formulation,
        "stabilisation": stabilisation,
    }
    plain = run(machines.four_bar(), **settings)
    redundant = run(machines.four_bar(second="revolute", third="revolute"), **settings)
    assert redundant.finished.outcome == "done"
    np.testing.assert_allclose(redundant.position, plain.position, atol=1e-9)
    # in-plane reactions are unique
    scale = np.abs(plain.joint_force).max()
    np.testing.assert_allclose(redundant.joint_force[:, :, :2], plain.joint_force[:, :, :2], atol=1e-7 * scale)
    # of the others the shortest is taken: nothing pushes out of the plane
    np.testing.assert_allclose(redundant.joint_force[:, :, 2], 0, atol=1e-7 * scale)
    assert np.abs(redundant.constraint_violation).max() < (1e-4 if stabilisation == "none" else 1e-10)


@pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
def test_overconstrained_spatial_linkage_moves_and_keeps_its_energy(formulation):
    machine = machines.bennett()
    redundancy = prepare(machine, formulation).redundancy
    assert redundancy.degrees_of_freedom == 1
    assert len(redundancy.redundant_rows) == 3
    result = run(machine, duration=1.0, step=1e-3, output_interval=0.02, formulation=formulation)
    assert result.finished.outcome == "done"
    assert np.ptp(result.joint_coordinate[:, 0]) > 0.5
    assert np.abs(result.constraint_violation).max() < 1e-9
    assert np.abs(result.energy_error).max() < 1e-7 * result.kinetic_energy.max()


@pytest.mark.parametrize(("rows", "columns"), [(30, 40), (40, 30), (12, 4)])
def test_multipliers_without_effect_are_told_from_those_of_little_effect(rows, columns):
    """Singular values of 1e-6 are none of redundant rows, those of 1e-11 are; by a matrix that is made of its singular values."""
    rng = np.random.default_rng(rows)
    rank = min(rows, columns)
    sizes = np.ones(rank)
    sizes[-1], sizes[-2] = 1e-11, 1e-6
    left, _ = np.linalg.qr(rng.standard_normal((rows, rows)))
    right, _ = np.linalg.qr(rng.standard_normal((columns, columns)))
    J = left[:, :rank] @ np.diag(sizes) @ right[:, :rank].T
    dependent, N = dependent_rows(J)
    assert len(dependent) == N.shape[1] == rows - rank + 1
    assert np.abs(N.T @ J).max() < 1e-9
    assert np.abs(N.T @ N - np.eye(N.shape[1])).max() < 1e-12
    assert np.linalg.matrix_rank(np.delete(J, dependent, axis=0), tol=1e-8) == rank - 1


@pytest.mark.parametrize("name", ["slider_crank", "four_bar", "bennett"])
def test_lengths_of_rows_are_those_of_the_whole_jacobian(name):
    motion = equations(getattr(machines, name)())
    system = motion.system
    motion.evaluate(0.0, system.start)
    J = motion.jacobian().reshape(system.machine_rows, system.body_count, 6) * np.repeat([system.size, 1.0], 3)
    np.testing.assert_allclose(row_lengths(motion), np.sqrt((J**2).sum(axis=(1, 2))), rtol=1e-13)
