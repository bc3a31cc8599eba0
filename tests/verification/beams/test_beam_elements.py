"""Elements of beams: tangents by hand, objectivity, potential, rigid motions, momenta."""

import json

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from beams import disturb, flying, forces, general, hinged, prepared, trust
from nivel.analysis.assembly import implicit
from nivel.elements.beams.beam import Beam
from nivel.elements.beams.exact import masses_of
from nivel.system import beam_tables
from simulating import simulate

pytestmark = pytest.mark.covering

ORDERS = (1, 2, 3)


def tangent(sections, coordinates, monkeypatch, by_hand):
    with monkeypatch.context() as patch:
        if not by_hand:
            patch.setattr(beam_tables, "has_elastic_beams", lambda record: False)
        ready = prepared(sections, coordinates)
    disturb(ready.motion, ready.start, seed=3)
    status, matrix = implicit.find_tangent(ready.motion, 0.0, 0.3, 0.7, 0.5)
    assert status == 0
    return matrix, len(ready.motion.system.record.newton.group_start) - 1


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize("mass", ["consistent", "lumped"])
def test_tangents_by_hand_are_those_of_complex_numbers(order, coordinates, mass, monkeypatch):
    sections = hinged(8)
    for beam in sections["beams"].values():
        beam |= {"order": order, "mass": mass}
    by_hand, few = tangent(sections, coordinates, monkeypatch, True)
    exact, many = tangent(sections, coordinates, monkeypatch, False)
    assert few < many  # most columns come from the elements alone
    scale = np.abs(exact).max(axis=1, keepdims=True)
    assert np.abs(by_hand - exact).max() > 0.0  # they are two computations
    assert_allclose(by_hand / scale, exact / scale, atol=1e-12)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_tangents_of_nodes_with_mass_off_the_line(coordinates, monkeypatch):
    by_hand, _ = tangent(flying(2), coordinates, monkeypatch, True)
    exact, _ = tangent(flying(2), coordinates, monkeypatch, False)
    scale = np.abs(exact).max(axis=1, keepdims=True)
    assert_allclose(by_hand / scale, exact / scale, atol=1e-12)


def moved(motion, y, turn, shift):
    """The state y turned about the origin and shifted as a rigid body."""
    out, count = y.copy(), motion.system.body_count
    for b in range(count):
        place, theta = y[7 * b : 7 * b + 3], y[7 * b + 3 : 7 * b + 7]
        out[7 * b : 7 * b + 3] = turn.apply(place) + shift
        turned = turn * Rotation.from_quat(theta[[1, 2, 3, 0]])
        out[7 * b + 3 : 7 * b + 7] = turned.as_quat()[[3, 0, 1, 2]]
    return out


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("angle", [0.4, 3.1, 6.0, 9.5, 40.0])
def test_rigid_rotations_of_any_size_change_no_strain(order, angle):
    ready = prepared(flying(order))
    motion, rng = ready.motion, np.random.default_rng(5)
    disturb(motion, ready.start, seed=1, size=0.03)
    y = motion.system.record.residual.y.copy()
    axis = rng.standard_normal(3)
    turn = Rotation.from_rotvec(angle * axis / np.linalg.norm(axis))
    energy, wrench = forces(motion, y)
    turned_energy, turned_wrench = forces(motion, moved(motion, y, turn, rng.standard_normal(3)))
    assert energy > 1.0
    assert_allclose(turned_energy, energy, rtol=1e-11)
    expected = np.hstack([turn.apply(wrench[:, :3]), turn.apply(wrench[:, 3:])])
    assert_allclose(turned_wrench, expected, atol=1e-10 * np.abs(wrench).max())


@pytest.mark.parametrize("order", ORDERS)
def test_forces_are_those_of_the_energy(order):
    """Energy around a closed path: no dependence on the path; and slope of the energy along it is the work of the forces."""
    ready = prepared(flying(order))
    motion = ready.motion
    disturb(motion, ready.start, seed=2, size=0.03)
    y = motion.system.record.residual.y.copy()
    count = motion.system.body_count
    rng = np.random.default_rng(7)
    direction = rng.standard_normal((count, 6))

    def at(share):
        out = y.copy()
        for b in range(count):
            out[7 * b : 7 * b + 3] += share * direction[b, :3]
            turn = Rotation.from_rotvec(share * direction[b, 3:])
            theta = (turn * Rotation.from_quat(y[7 * b + 3 : 7 * b + 7][[1, 2, 3, 0]])).as_quat()
            out[7 * b + 3 : 7 * b + 7] = theta[[3, 0, 1, 2]]
        return out

    work = np.sum(forces(motion, y)[1] * direction)
    h = 1e-3
    slopes = [(forces(motion, at(k * h))[0] - forces(motion, at(-k * h))[0]) / (2 * k * h) for k in (1, 2, 3)]
    sixth = (15 * slopes[0] - 6 * slopes[1] + slopes[2]) / 10
    assert_allclose(-work, sixth, rtol=1e-8)


@pytest.mark.parametrize("order", ORDERS)
def test_unstressed_beams_feel_nothing(order):
    ready = prepared(flying(order))
    energy, wrench = forces(ready.motion, ready.start)
    assert energy < 1e-24
    assert np.abs(wrench).max() < 1e-9


def rod(**more):
    section = general(mass=2.0, inertia=(3e-3, 1e-3, 2.5e-3), mass_centre=[0.02, 0.01])
    return Beam(
        **{
            "name": "rod",
            "from": (0.0, 0.0, 0.0),
            "to": (1.0, 0.0, 0.0),
            "via": (0.5, 0.3, 0.0),
            "section": section,
            "elements": 3,
            **more,
        }
    )


@pytest.mark.parametrize("order", ORDERS)
def test_rigid_motions_have_the_energy_of_the_interpolated_body(order):
    """The rigid inertia of a beam, from places and axes between the nodes, apart from the tables of the kernels."""
    beam = rod(order=order)
    place, axes = beam.frames(beam.shares)
    masses = masses_of(beam)
    centre = place + np.einsum("nij,j->ni", axes, beam.properties.mass_centre)
    rng = np.random.default_rng(4)
    v, w = rng.standard_normal(3), rng.standard_normal(3)
    speed = v + np.cross(w, centre)
    own = np.einsum("nji,j->ni", axes, w)
    lumped = 0.5 * np.sum(masses.mass * np.sum(speed**2, axis=1)) + 0.5 * np.einsum(
        "ni,nij,nj", own, masses.inertia, own
    )
    a, b = masses.pairs.T
    apart = np.sum((speed[b] - speed[a]) ** 2, axis=1)
    h = np.einsum("mij,mj->mi", masses.moment, own[b] - np.einsum("mij,mj->mi", masses.turn, own[a]))
    assert np.abs(h).max() < 1e-15  # a rigid motion of the unstressed beam leaves no angular momentum to share
    consistent = lumped - 0.5 * np.sum(masses.shared * apart)
    # directly: points of a fine rule with interpolated mass centres and exact turning of the sections
    from nivel.elements.beams.exact import gauss, lagrange, relative_turns, rotation

    p, total = order, 0.0
    xi, weight = gauss(8)
    N, D = lagrange(p, xi)
    for first in range(0, len(place) - 1, p):
        nodes = slice(first, first + p + 1)
        length = np.linalg.norm(D @ place[nodes], axis=1)
        moving = N @ speed[nodes]
        psi = N @ relative_turns(axes[None, nodes], p // 2)[0]
        R = axes[first + p // 2] @ rotation(psi)
        turning = np.einsum("gji,j->gi", R, w)
        total += np.sum(weight * length * (beam.properties.mass * np.sum(moving**2, axis=1))) / 2
        total += np.sum(weight * length * np.einsum("gi,ij,gj->g", turning, beam.properties.inertia, turning)) / 2
    assert_allclose(consistent, total, rtol=5e-3 if order == 1 else 1e-4)
    assert_allclose(masses.mass.sum(), beam.properties.mass * beam.line.length, rtol=0.03 if order == 1 else 3e-3)


@pytest.mark.parametrize(("mass", "order"), [("lumped", 1), ("consistent", 1), ("consistent", 2), ("consistent", 3)])
def test_free_flight_keeps_energy_to_the_order_of_the_integrator(mass, order):
    """Semi-discrete equations of a potential and a metric on the nodes conserve energy: what is left is RK4's."""
    errors = []
    for step in (8e-5, 4e-5):
        simulation = {
            "duration": 0.04,
            "step": step,
            "integrator": "rk4",
            "coordinates": "absolute",
            "output_interval": 0.04,
        }
        result = simulate({**flying(order, mass), "simulation": simulation})
        errors.append(trust(result)["energy_error_max"])
        assert json.loads(result.dataset.attrs["timing"])["steps"] > 100
    kinetic = float(result.dataset["kinetic_energy"][0])
    assert float(result.dataset["potential_energy"].max()) > 1e-3 * kinetic
    assert errors[1] < 1e-9 * kinetic
    assert errors[1] < errors[0] / 12 or errors[0] < 1e-12 * kinetic


def momenta(result, masses, section):
    """(p (t, 3), L (t, 3) about the origin) of a beam `rod` from its result."""
    data = result.dataset
    names = [str(name) for name in data["body"].values]
    assert names[0] == "rod.start"
    x, v, w = (data[name].values for name in ("position", "velocity", "angular_velocity"))
    theta = data["orientation"].values
    steps, nodes = x.shape[:2]
    A = Rotation.from_quat(theta.reshape(-1, 4)[:, [1, 2, 3, 0]]).as_matrix().reshape(steps, nodes, 3, 3)
    arm = np.einsum("tnij,j->tni", A, section.mass_centre)
    centre, speed = x + arm, v + np.cross(w, arm)
    own = np.einsum("tnji,tnj->tni", A, w)
    p = masses.mass[:, None] * speed
    h = np.einsum("nij,tnj->tni", masses.inertia, own)
    for (a, b), m, J, Q in zip(masses.pairs, masses.shared, masses.moment, masses.turn, strict=True):
        p[:, a] += m * (speed[:, b] - speed[:, a])
        p[:, b] += m * (speed[:, a] - speed[:, b])
        h[:, a] += (own[:, b] - own[:, a] @ Q.T) @ J.T
        h[:, b] += (own[:, a] - own[:, b] @ Q) @ J
    L = np.cross(centre, p) + np.einsum("tnij,tnj->tni", A, h)
    return p.sum(axis=1), L.sum(axis=1)


@pytest.mark.parametrize("order", ORDERS)
def test_momenta_of_free_flight_are_kept(order):
    simulation = {
        "duration": 0.05,
        "step": 4e-5,
        "integrator": "rk4",
        "coordinates": "absolute",
        "output_interval": 0.01,
    }
    sections = {**flying(order), "simulation": simulation}
    result = simulate(sections)
    words = {"name": "rod", **sections["beams"]["rod"]}
    beam = Beam(**words)
    p, L = momenta(result, masses_of(beam), beam.properties)
    assert_allclose(p, np.broadcast_to(p[0], p.shape), atol=1e-10 * np.abs(p).max())
    assert_allclose(L, np.broadcast_to(L[0], L.shape), atol=1e-9 * np.abs(L).max())
    # and the beam does bend
    assert float(result.dataset["potential_energy"].max()) > 1e-3


CONSERVING = {"integrator": "energy-momentum", "coordinates": "absolute", "stabilisation": "none"}


@pytest.mark.parametrize("mass", ["consistent", "lumped"])
def test_energy_momentum_keeps_the_energy_of_a_flying_beam(mass):
    simulation = {"duration": 10.0, "step": 1e-3, "output_interval": 0.1, **CONSERVING}
    result = simulate({**flying(1, mass), "simulation": simulation})
    assert result.dataset.attrs["outcome"] == "done"
    assert trust(result)["energy_error_max"] < 1e-8 * float(result.dataset["kinetic_energy"][0])


@pytest.mark.parametrize("order", ORDERS)
def test_energy_momentum_keeps_the_momenta_of_consistent_masses(order):
    sections = {**flying(order), "simulation": {"duration": 0.3, "step": 1e-3, "output_interval": 0.02, **CONSERVING}}
    result = simulate(sections)
    beam = Beam(name="rod", **sections["beams"]["rod"])
    p, L = momenta(result, masses_of(beam), beam.properties)
    assert_allclose(p, np.broadcast_to(p[0], p.shape), atol=1e-11 * np.abs(p).max())
    assert_allclose(L, np.broadcast_to(L[0], L.shape), atol=1e-8 * np.abs(L).max())
    assert trust(result)["energy_error_max"] < 1e-8 * float(result.dataset["kinetic_energy"][0])
    assert float(result.dataset["potential_energy"].max()) > 1e-3


def test_energy_momentum_with_consistent_masses_has_order_two():
    """Against generalised-alpha, which solves other equations, extrapolated from two steps."""

    def end(step, **method):
        base = {"duration": 0.05, "coordinates": "absolute", "output_interval": 0.05, "step": step}
        return simulate({**flying(2), "simulation": {**base, **method}}).dataset["position"].values[-1]

    other = {"integrator": "generalised-alpha"}
    fine = end(1.25e-5, **other)
    exact = fine + (fine - end(2.5e-5, **other)) / 3.0
    errors = [np.abs(end(step, **CONSERVING) - exact).max() for step in (1e-4, 5e-5, 2.5e-5)]
    assert errors[-1] < 1e-6
    assert_allclose(np.log2(np.array(errors[:-1]) / errors[1:]), 2.0, atol=0.2)


def test_total_interpolation_of_rotations_loses_objectivity_with_the_square_of_the_element():
    """A curved beam turned rigidly: relative interpolation feels nothing, total interpolation strains that fall with h²."""
    curvatures = []
    for elements in (2, 4, 8, 16):
        words = {"elements": elements, "interpolation": "total", "via": [0.5, 0.3, 0.1]}
        ready = prepared(flying(1, **words))
        turn = Rotation.from_rotvec([1.1, -0.7, 0.9])
        energy, _ = forces(ready.motion, moved(ready.motion, ready.start, turn, np.zeros(3)))
        curvatures.append(np.sqrt(energy))  # strain, as energy is its square
    slopes = np.log2(np.array(curvatures[:-1]) / curvatures[1:])
    assert curvatures[0] > 1e-3
    assert_allclose(slopes[1:], 2.0, atol=0.15)


@pytest.mark.parametrize("turns", [0.9, 1.0, 1.5, 2.5])
def test_total_interpolation_changes_charts(turns):
    """Turned by whole turns and parts of them, through angles at which rotation vectors have no limit."""
    ready = prepared(flying(1, interpolation="total", elements=16))
    axis = np.array([0.2, 0.5, 0.8]) / np.linalg.norm([0.2, 0.5, 0.8])
    worst = max(
        forces(
            ready.motion,
            moved(ready.motion, ready.start, Rotation.from_rotvec((2 * np.pi * turns + small) * axis), np.zeros(3)),
        )[0]
        for small in np.linspace(-0.3, 0.3, 13)
    )
    once = forces(ready.motion, moved(ready.motion, ready.start, Rotation.from_rotvec(2.0 * axis), np.zeros(3)))[0]
    assert worst < 20 * once
