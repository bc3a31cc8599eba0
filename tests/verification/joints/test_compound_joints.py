"""Compound joints against the same machine with a light link in their place: linear convergence in its mass."""

import numpy as np
import pytest

from simulating import G, simulate, solid

P1, P2 = np.array([0.3, 0.1, -0.2]), np.array([0.7, -0.1, 0.3])
SKEW_1, SKEW_2 = [0.2, 1.0, 0.3], [1.0, -0.2, 0.5]
# kind: (keys of the compound joint, the link's joint on the first body, on the second, reaction to compare)
CASES = {
    "distance": ("distance", {}, {}),
    "spherical-spherical": ("spherical-spherical", {}, {}),
    "revolute-spherical": ("revolute-spherical", {"axis": SKEW_1}, {}),
    "revolute-cylindrical-skew": ("revolute-cylindrical", {"axis": SKEW_1}, {"axis": SKEW_2}),
    "revolute-cylindrical-parallel": ("revolute-cylindrical", {"axis": SKEW_1}, {"axis": SKEW_1}),
    "revolute-translational": ("revolute-translational", {"axis": SKEW_1}, {"axis": SKEW_2}),
    "revolute-translational-square": ("revolute-translational", {"axis": [0, 0, 1.0]}, {"axis": [1.0, 0, 0]}),
}
EACH = pytest.mark.parametrize("case", CASES)
DURATION = 0.4


def two_arms():
    """Two bodies that hang on ball joints, let go at rest: the compound joint goes between them."""
    return {
        "gravity": [0, -G, 0],
        "bodies": {
            "a": solid(2.0, (0.05, 0.08, 0.09), position=[0.1, 0.1, 0.1], centre_of_mass=[0.05, 0, 0.02]),
            "b": solid(1.5, (0.07, 0.04, 0.06), position=[0.9, 0, 0.2]),
        },
        "joints": {
            "left": {"type": "spherical", "bodies": ["ground", "a"], "point": [0, 0, 0]},
            "right": {"type": "spherical", "bodies": ["ground", "b"], "point": [1.1, 0.2, 0]},
        },
    }


def with_compound(case):
    kind, first, second = CASES[case]
    machine = two_arms()
    joint = {"type": kind, "bodies": ["a", "b"]}
    if kind == "revolute-translational":
        joint |= {"point": P1, "axes": [first["axis"], second["axis"]]}
    else:
        joint["points"] = [P1, P2]
        if kind == "revolute-spherical":
            joint["axis"] = first["axis"]
        elif kind == "revolute-cylindrical":
            joint["axes"] = [first["axis"], second["axis"]]
    machine["joints"]["link"] = joint
    return machine


def with_link(case, mass):
    """The link is a sphere half way, small enough to be slender: its own inertia falls with its mass."""
    kind, first, second = CASES[case]
    machine = two_arms()
    one = kind == "revolute-translational"
    ends = (P1, P1) if one else (P1, P2)
    types = {
        "distance": ("spherical", "spherical"),
        "spherical-spherical": ("spherical", "spherical"),
        "revolute-spherical": ("revolute", "spherical"),
        "revolute-cylindrical": ("revolute", "cylindrical"),
        "revolute-translational": ("revolute", "translational"),
    }[kind]
    machine["bodies"]["rod"] = solid(mass, 0.02 * mass, position=0.5 * (ends[0] + ends[1]))
    machine["joints"]["link"] = {"type": types[0], "bodies": ["a", "rod"], "point": ends[0], **first}
    machine["joints"]["other"] = {"type": types[1], "bodies": ["rod", "b"], "point": ends[1], **second}
    return machine


def motion(machine, **settings):
    r = simulate(machine, duration=DURATION, step=1e-3, output_interval=0.02, **settings)
    force, torque = r.array("link.force"), r.array("link.torque")
    return r.array("position")[:, :2], r.array("orientation")[:, :2], force, torque


@EACH
def test_light_link_converges_to_the_compound_joint(case):
    """Positions, orientations and reactions differ by a multiple of the link's mass."""
    expected = motion(with_compound(case))
    masses = [1e-2, 1e-3, 1e-4]
    found = {mass: motion(with_link(case, mass)) for mass in [*masses, 1e-6]}
    for k in range(4):
        scale = np.abs(expected[k]).max() + (1.0 if k > 1 else 0.0)
        errors = [np.abs(found[mass][k] - expected[k]).max() / scale for mass in masses]
        # a link in a joint that lets it be (a torque that is zero) makes no difference
        if max(errors) > 1e-9:
            slope = np.polyfit(np.log(masses), np.log(errors), 1)[0]
            assert 0.95 < slope < 1.05, (k, errors)
        assert np.abs(found[1e-6][k] - expected[k]).max() < 1e-5 * scale


@EACH
@pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
def test_energy_closes_with_fourth_order(case, formulation):
    errors = []
    for step in (4e-3, 2e-3):
        r = simulate(with_compound(case), duration=0.8, step=step, formulation=formulation)
        errors.append(np.abs(r.array("energy_error")).max())
        assert np.abs(r.array("constraint_violation")).max() < 1e-12
    assert errors[1] < errors[0] / 2**3.5 or errors[1] < 1e-11, errors


@pytest.mark.parametrize(
    ("case", "freedoms"),
    [("distance", 5), ("revolute-spherical", 4), ("revolute-cylindrical-skew", 3), ("revolute-translational", 2)],
)
def test_compound_joints_leave_the_stated_motions(case, freedoms):
    """Two bodies on ball joints have 6; rows 1, 2, 3 and 4."""
    r = simulate(with_compound(case), duration=0.01, step=1e-3)
    assert r.trust.degrees_of_freedom == freedoms
    assert r.trust.redundant_rows == ()


def test_coordinates_of_revolute_translational_are_those_of_the_two_joints():
    case = "revolute-translational-square"
    settings = {"duration": DURATION, "step": 1e-3, "output_interval": 0.02}
    compound = simulate(with_compound(case), **settings)
    link = simulate(with_link(case, 1e-6), **settings)
    np.testing.assert_allclose(compound.array("link.angle"), link.array("link.angle"), atol=1e-5)
    # of the pin in the slot: the first body's point against the second
    np.testing.assert_allclose(compound.array("link.displacement"), -link.array("other.displacement"), atol=1e-5)
    assert np.ptp(compound.array("link.angle")) > 0.1
    assert np.ptp(compound.array("link.displacement")) > 0.05


def test_angle_of_revolute_spherical_is_that_of_the_revolute():
    settings = {"duration": DURATION, "step": 1e-3, "output_interval": 0.02}
    compound = simulate(with_compound("revolute-spherical"), **settings)
    link = simulate(with_link("revolute-spherical", 1e-6), **settings)
    np.testing.assert_allclose(compound.array("link.angle"), link.array("link.angle"), atol=1e-5)
    assert np.ptp(link.array("link.angle")) > 0.1
