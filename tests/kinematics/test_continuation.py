"""Positions past the turning points of a driver, against the closed forms of linkages."""

import numpy as np
import pytest

import nivel

EXAMPLES = "examples"
TURN = 2.0 * np.pi


def bar(name, first, last):
    length = float(np.linalg.norm(np.subtract(last, first)))
    middle = tuple(0.5 * np.add(first, last))
    turn = {"axis": (0, 0, 1), "angle": float(np.arctan2(last[1] - first[1], last[0] - first[0]))}
    return nivel.Body(name=name, mass=1.0, inertia=(0.1, length, length), position=middle, orientation=turn)


def linkage(points):
    """Three bars between four points in the plane: revolutes at the ends, ball and sleeve between, so that nothing is redundant."""
    a, b, c, d = (tuple(map(float, point)) for point in points)
    bodies = [bar("crank", a, b), bar("coupler", b, c), bar("rocker", d, c)]
    kinds = {"left": ("revolute", "ground", "crank", a), "near": ("spherical", "crank", "coupler", b)}
    kinds |= {"far": ("cylindrical", "coupler", "rocker", c), "right": ("revolute", "ground", "rocker", d)}
    joints = [
        nivel.Joint(
            name=name,
            type=kind,
            bodies=(first, second),
            point=point,
            **({} if kind == "spherical" else {"axis": (0, 0, 1)}),
        )
        for name, (kind, first, second, point) in kinds.items()
    ]
    return nivel.Machine("linkage", bodies=bodies, joints=joints)


def test_a_rocker_turns_back_where_crank_and_coupler_are_in_line():
    """Dead centres: the pin is at a + b and at b - a from the crank's pivot; on the whole way the crank goes round once."""
    a, b, c, d = 1.0, 3.0, 2.5, 3.2
    start = np.array([1.0, 0.0, 0.0])
    far = d - start[0]
    x = start[0] + (b * b - c * c + far * far) / (2.0 * far)
    pin = np.array([x, np.sqrt(b * b - (x - start[0]) ** 2), 0.0])
    found = linkage([(0, 0, 0), start, pin, (d, 0, 0)]).configuration_curve("right")
    assert found.closed
    angles = [np.arccos((c * c + d * d - reach * reach) / (2.0 * c * d)) for reach in (a + b, b - a)]
    now = np.arccos((c * c + d * d - pin @ pin) / (2.0 * c * d))
    np.testing.assert_allclose(
        sorted(each.value for each in found.turning), sorted(now - each for each in angles), atol=1e-9
    )
    crank = found.values[:, found.names.index("left.angle")]
    np.testing.assert_allclose(abs(crank[-1] - crank[0]), TURN, atol=1e-9)
    assert found.crossed == ()
    assert set(found.turning[0].joints) <= {"left", "near", "far", "right"}
    assert found.trust.light == found.summary()["light"] == "green"
    assert found.to_xarray().attrs["headline"] == "verified by the closed joints at every position"


def test_a_double_rocker_goes_through_both_ways_of_assembly():
    """Crank and rocker of 2 on a base of 3 with a coupler of 1.5: the crank turns back twice, at the same distance from the base line."""
    a, b, c, d = 2.0, 1.5, 2.0, 3.0
    top = np.sqrt(a * a - 0.75**2)
    found = linkage([(0, 0, 0), (0.75, top, 0), (2.25, top, 0), (d, 0, 0)]).configuration_curve("left")
    assert found.closed
    limit = np.arccos((a * a + d * d - (b + c) ** 2) / (2.0 * a * d))
    begin = np.arctan2(top, 0.75)
    np.testing.assert_allclose(sorted(each.value for each in found.turning), [-limit - begin, limit - begin], atol=1e-9)


def test_a_parallelogram_crosses_the_antiparallelogram_where_it_is_flat():
    found = linkage([(0, 0, 0), (0, 1, 0), (2, 1, 0), (2, 0, 0)]).configuration_curve("left")
    assert found.closed
    assert found.turning == ()
    crank = np.interp(found.crossed, found.arc, found.values[:, found.names.index("left.angle")])
    np.testing.assert_allclose(sorted(np.abs(np.sin(crank + 0.5 * np.pi))), [0.0, 0.0], atol=0.05)
    assert "one of several" in str(found)
    assert found.trust.light == "amber"


def test_the_curve_of_positions_is_that_of_the_driven_machine():
    machine = nivel.load(f"{EXAMPLES}/mechanisms/slider-crank.yaml")
    found = machine.configuration_curve("slide").to_xarray()
    driven = machine.kinematics(drive="hinge", end=float(found["hinge.angle"][-1]), positions=181)
    order = np.argsort(found["hinge.angle"].to_numpy())
    wanted = np.interp(
        driven["hinge.angle"], found["hinge.angle"].to_numpy()[order], found["slide.displacement"].to_numpy()[order]
    )
    assert np.abs(driven["slide.displacement"] - wanted).max() < 1e-3  # straight lines between neighbours 0.05 apart


def test_machines_with_other_than_one_free_motion_are_refused():
    with pytest.raises(nivel.ModelError, match="one free motion, here are 0"):
        nivel.load(f"{EXAMPLES}/mechanisms/scissor-lift.yaml").configuration_curve("base")
    with pytest.raises(nivel.ModelError, match="one free motion, here are 6"):
        nivel.load(f"{EXAMPLES}/control/robot-arm.yaml").configuration_curve("j1")
