"""Which components of reactions are unique where constraints repeat each other."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.analysis.assembly.unique_reactions import COMPONENTS

FOUR_BAR = Path(__file__).parents[2] / "examples" / "mechanisms" / "four-bar-revolutes.yaml"


@pytest.fixture(scope="module")
def redundant():
    return nivel.load(FOUR_BAR)


def test_a_planar_loop_of_revolutes_has_unique_forces_in_its_plane_alone(redundant):
    """Forces along the axes and moments across them may be locked in."""
    found = redundant.check().reactions
    assert [each.joint for each in found] == ["crank_pivot", "crank_pin", "rocker_pin", "rocker_pivot"]
    for each in found:
        assert each.unique == ("force x", "force y")
        assert each.others == ("force z", "moment x", "moment y")
    assert "crank_pin: unique are force x, force y; not force z" in str(redundant.check())


def test_unique_components_are_those_of_the_exactly_constrained_machine(redundant):
    """The same machine, its joints changed as `nivel check` proposes, carries the same unique components."""
    record = redundant.record
    ball = {"type": "spherical", "axis": None}
    changed = {"crank_pin": ball, "rocker_pin": {"type": "cylindrical"}}
    joints = tuple(joint.replace(**changed.get(joint.name, {})) for joint in record.joints)
    exact = nivel.Machine.from_record(record.replace(joints=joints))
    settings = {"duration": 0.2, "output_interval": 0.05, "coordinates": "absolute"}
    runs = [redundant.simulate(**settings), exact.simulate(**settings)]
    assert runs[1].trust.redundant_rows == ()
    for each in redundant.check().reactions:
        k = runs[0].coordinates["joint"].index(each.joint)
        force, other = (
            np.hstack([r.array("joint_force_local")[:, k], r.array("joint_torque_local")[:, k]]) for r in runs
        )
        places = [COMPONENTS.index(name) for name in each.unique]
        if each.joint != "crank_pin":  # a spherical joint placed by a point has the global axes
            np.testing.assert_allclose(force[:, places], other[:, places], atol=1e-6 * np.abs(force).max())
        else:
            np.testing.assert_allclose(
                np.linalg.norm(force[:, :2], axis=1), np.linalg.norm(other[:, :2], axis=1), rtol=1e-6
            )


def test_ranges_of_a_door_are_those_of_one_hinge_or_the_other():
    """A door of weight W, its centre of mass b from hinges 2 a apart: one hinge alone carries W and W b, or both the couple W b/2a."""
    weight, b, a = 100.0, 0.5, 1.0
    door = nivel.Body(name="door", mass=weight / 10.0, inertia=(1, 2, 1), position=(b, 0, 0))
    hinges = [
        nivel.Joint(name=name, type="revolute", bodies=("ground", "door"), point=(0, 0, z), axis=(0, 0, 1))
        for name, z in (("low", -a), ("high", a))
    ]
    machine = nivel.Machine("door", bodies=[door], joints=hinges, gravity=(0, 0, -10))
    couple = weight * b / (2.0 * a)
    for each, side in zip(machine.check().reactions, (-1.0, 1.0), strict=True):
        x = (-couple, 0.0) if side < 0.0 else (0.0, couple)
        assert each.others == ("force x", "force y", "force z", "moment x", "moment y")
        wanted = [x, (0, 0), (-weight, 0), (0, 0), (0, weight * b)]
        np.testing.assert_allclose(each.ranges, wanted, atol=1e-9)
    # what a run shows lies between
    run = machine.simulate(duration=0.01, coordinates="absolute")
    shown = run.array("joint_force_local")[0]
    assert np.all(np.abs(shown[:, 2] + 0.5 * weight) <= 0.5 * weight)
    # the least norm: equal hinges carry half of the weight and of the couple each, by forces and by moments
    np.testing.assert_allclose(shown[:, 2], -0.5 * weight, rtol=1e-9)
    np.testing.assert_allclose(shown[0, 0], -shown[1, 0], rtol=1e-9)
    moments = run.array("joint_torque_local")[0, :, 1]
    np.testing.assert_allclose(moments[0], moments[1], rtol=1e-9)
    assert 2.0 * a * shown[1, 0] + moments.sum() == pytest.approx(weight * b, rel=1e-9)
    other = machine.simulate(duration=0.01, coordinates="independent").array("joint_force_local")[0]
    np.testing.assert_allclose(other, shown, atol=1e-9 * weight)
    assert "force z (-100 to 0 N)" in str(machine.check())


def test_a_planar_loop_carries_nothing_out_of_its_plane_without_preload(redundant):
    for each in redundant.check().reactions:
        np.testing.assert_allclose(each.ranges, np.zeros((3, 2)), atol=1e-9)
