"""Beams in every implicit method, and starts that would strike or strain them."""

from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from beams import flying, hinged, prepared
from lanes import tail
from nivel.errors import ModelError
from nivel.kernels.core.status import OK
from simulating import simulate

pytestmark = pytest.mark.covering

STEEL = {"youngs_modulus": "210 GPa", "poisson_ratio": 0.3, "density": "7850 kg/m^3"}


def cantilever(**simulation):
    bar = {"from": [0, 0, 0], "to": [1, 0, 0], "section": {"type": "rectangle", "width": "3 cm", "height": "3 mm"}}
    return {
        "gravity": [0, 0, -9.81],
        "beams": {"b": {**bar, "material": STEEL, "elements": 4}},
        "joints": {"wall": {"type": "fixed", "bodies": ["ground", "b.start"], "point": [0, 0, 0]}},
        "simulation": {"duration": 0.02, "output_interval": 0.002, **simulation},
    }


@cache
def exact_positions():
    return simulate(cantilever(integrator="radau", tolerance=1e-9)).dataset["position"].values


@pytest.mark.parametrize(
    ("method", "within"),
    [
        ({"integrator": "ros2", "step": 5e-5}, 1e-3),
        ({"integrator": "bdf", "tolerance": 1e-5}, 1e-2),
        pytest.param({"integrator": "bdf", "tolerance": 1e-7}, 1e-4, marks=pytest.mark.full),
        ({"integrator": "generalised-alpha", "step": 5e-5}, 1e-3),
        pytest.param({"integrator": "hht", "step": 5e-5}, 1e-3, marks=pytest.mark.full),
        pytest.param({"integrator": "newmark", "step": 5e-5}, 1e-3, marks=pytest.mark.full),
    ],
    ids=lambda each: each["integrator"] if isinstance(each, dict) else "",
)
@pytest.mark.parametrize("coordinates", tail(["absolute", "relative"], ["relative"]))
def test_all_methods_find_the_motion_of_radau(method, within, coordinates):
    expected = exact_positions()
    found = simulate(cantilever(coordinates=coordinates, **method)).dataset["position"].values
    sag = np.abs(expected - expected[0]).max()
    assert sag > 1e-3
    assert_allclose(found, expected, atol=within * sag)


@pytest.mark.parametrize("rotations", ["euler-parameters", "euler-angles", "rotation-vector"])
@pytest.mark.parametrize(
    ("method", "within"),
    [
        ({"integrator": "radau", "tolerance": 1e-6}, 1e-5),
        ({"integrator": "generalised-alpha", "step": 1e-3}, 1e-5),
        ({"integrator": "ros2", "step": 1e-4}, 1e-6),
    ],
    ids=lambda each: each["integrator"] if isinstance(each, dict) else "",
)
def test_rotation_coordinates_of_nodes_give_the_motion_of_angular_velocities(method, within, rotations):
    """Whose tangents are found by hand. A beam of lumped masses that flies, turns and vibrates; errors of order two in the step."""
    base = {"duration": 0.1, "output_interval": 0.02, "coordinates": "absolute", **method}
    ways = ({}, {"formulation": "lagrange", "rotations": rotations})
    one, other = (simulate({**flying(1, "lumped"), "simulation": {**base, **way}}) for way in ways)
    assert other.outcome == "done"
    assert np.abs(one.array("angular_velocity")).max() > 3.0
    assert_allclose(other.array("position"), one.array("position"), atol=within)


@pytest.mark.parametrize("spin", [(0, 0, 5), (0, 1, 5), (2, 1, 5)])
@pytest.mark.parametrize("integrator", ["generalised-alpha", "newmark"])
def test_a_straight_round_beam_starts_to_fly(spin, integrator):
    """About some axes nothing accelerates its turn: what is found there is round-off."""
    section = {"type": "circle", "radius": "5 mm"}
    beam = {
        "from": [0, 0, 0],
        "to": [1, 0, 0],
        "section": section,
        "material": STEEL,
        "elements": 4,
        "angular_velocity": list(spin),
    }
    simulation = {"integrator": integrator, "step": 1e-4, "duration": 0.01, "output_interval": 0.005}
    result = simulate({"beams": {"b": beam}, "simulation": simulation})
    assert result.outcome == "done"
    assert_allclose(result.dataset["angular_velocity"].values[0], np.broadcast_to(spin, (5, 3)), atol=1e-12)


def test_velocities_that_would_strike_one_node_are_refused():
    sections = hinged(4)
    del sections["drivers"]
    sections["joints"]["root"]["start_rates"] = {"angle": 2.0}
    with pytest.raises(ModelError, match=r"inner\.start alone by .* an impact"):
        simulate(sections)


def test_joints_that_do_not_fit_are_refused():
    sections = hinged(4)
    hinge = sections["joints"]["hinge"]
    sections["joints"]["hinge"] = {"type": hinge["type"], "markers": [{"body": "inner.end"}, {"body": "outer.start"}]}
    sections["beams"]["outer"]["from"] = [5.001, 0, 0]
    with pytest.raises(ModelError, match="its joints do not fit"):
        simulate(sections)


def test_methods_that_need_masses_of_single_bodies_say_so():
    with pytest.raises(ModelError, match="consistent mass of rod"):
        simulate({**flying(1), "simulation": {"coordinates": "independent", "integrator": "rk4"}})


def test_stiction_beside_consistent_mass_is_refused():
    sections = hinged(4)
    rub = {"type": "friction", "coordinate": "hinge.angle", "model": "stiction", "coefficient": 0.1, "radius": 0.1}
    with pytest.raises(
        ModelError, match="'stiction' does not go with the consistent mass of inner, outer: take lugre or coulomb"
    ):
        simulate({**sections, "forces": {"rub": rub}, "simulation": {"integrator": "generalised-alpha"}})


def test_baumgarte_feeds_violations_back_where_masses_are_shared(rng):
    """C_q v̇ = γ - 2α Ċ - β² C of a state whose velocities are open."""
    cantilevered = prepared(cantilever(), "absolute")
    motion, y = cantilevered.motion, cantilevered.start.copy()
    record, first, count = motion.system.record, motion.system.positions, 6 * motion.system.body_count
    y[first : first + count] += 1e-3 * rng.standard_normal(count)
    record.control.stabilise[:2] = 30.0, 200.0
    status, rate = motion.evaluate(0.0, y)
    assert status == OK
    C, Cdot, gamma = (
        record.constraints.C,
        record.constraints.Cdot,
        record.constraints.gamma[: len(record.constraints.C)],
    )
    assert np.abs(Cdot).max() > 1e-4
    found = motion.jacobian() @ rate[first : first + count]
    assert_allclose(found, gamma - 30.0 * Cdot - 200.0 * C, atol=1e-9 * (1.0 + np.abs(rate).max()))
