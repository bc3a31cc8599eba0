"""Redundant machines: found, named, and run knowingly."""

import numpy as np
import pytest

import machines
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
