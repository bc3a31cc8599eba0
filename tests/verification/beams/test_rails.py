"""Joints that slide along beams: derivatives, closed forms at rest and in motion, nodes passed without a blow."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

import beams
from assembled import random_states
from nivel.analysis.assembly.equations import equations, moved
from nivel.errors import ModelError, SolveError
from nivel.system.beam_nodes import with_nodes
from simulating import machine, simulate, solid
from unknowns import Unknowns, at_state

pytestmark = pytest.mark.covering

KINDS = ("point-on-beam", "keyed-on-beam", "cylindrical-on-beam", "translational-on-beam")
COORDINATES = pytest.mark.parametrize("coordinates", ["absolute", "relative"])


def bead(kind, *, point=(0.186123, 0.184575, 0.147351), **simulation):
    """A body on an arc that is clamped at its start and bends."""
    rail = {"from": [0, 0, 0], "via": [0.5, 0.3, 0.2], "to": [1.0, 0.2, 0.0], "elements": 5, "mass": "lumped"}
    return {
        "gravity": [1.0, 2.0, -9.81],
        "bodies": {"bead": solid(2.0, 0.05, position=list(point), centre_of_mass=[0.03, 0.02, 0.05])},
        "beams": {"rail": {**rail, "section": beams.general(1e5, 1e5, 500.0, 500.0, 2.0, (0.01, 0.01, 0.01))}},
        "joints": {
            "root": {"type": "fixed", "bodies": ["ground", "rail.start"], "point": [0, 0, 0]},
            "pad": {"type": kind, "bodies": ["bead", "rail"], "point": list(point)},
        },
        "simulation": {"duration": 0.2, "step": 0.001, "integrator": "generalised-alpha", **simulation},
    }


def test_rates_are_those_of_the_values_off_the_line_as_well(rng):
    """All bodies in uniform motion and turning: values, rates and second derivatives against differences of order four."""
    motion = equations(with_nodes(machine(bead("translational-on-beam")).record), "newton-euler", measured=True)
    system, coordinates = motion.system, motion.system.record.coordinates
    count = system.body_count
    q = moved(system.start[: 7 * count], 0.02 * rng.standard_normal(6 * count)).reshape(-1, 7)
    v, w = rng.standard_normal((2, count, 3))

    def measured(t):
        turn = Rotation.from_rotvec(t * w) * Rotation.from_quat(q[:, 3:], scalar_first=True)
        places = np.hstack([q[:, :3] + t * v, turn.as_quat(scalar_first=True)])
        speeds = np.hstack([v, turn.inv().apply(w)])
        status, _ = motion.evaluate(0.0, np.concatenate([places.ravel(), speeds.ravel(), [0.0, 0.0]]))
        assert status == 0
        return np.array([coordinates.value, coordinates.rate, coordinates.bias])

    h = 1e-3
    there = {k: measured(k * h) for k in (-2, -1, 1, 2)}
    slope = (8.0 * (there[1] - there[-1]) - (there[2] - there[-2])) / (12.0 * h)
    here = measured(0.0)
    assert len(coordinates.value) == 6
    assert np.abs(here[0]).min() > 1e-3  # off the line, leaning and twisted
    assert_allclose(here[1], slope[0], rtol=0, atol=3e-6)
    assert_allclose(here[2], slope[1], rtol=0, atol=2e-3)
    # the parts are the gradient of the rate
    markers = system.record.markers
    for k in range(6):
        parts = np.arange(*coordinates.start[k : k + 2])
        ends = coordinates.part_marker[parts]
        turning = np.vstack([w, np.zeros(3)])[markers.body[ends]]
        along = np.sum(coordinates.J[parts] * np.hstack([markers.rdot[ends], turning]))
        assert along == pytest.approx(here[1, k], abs=1e-12)


@COORDINATES
@pytest.mark.parametrize("kind", KINDS)
def test_matrix_is_the_derivative_of_the_residual(kind, coordinates, rng):
    record, prepared = with_nodes(machine(bead(kind)).record), beams.prepared(bead(kind), coordinates)
    (y,) = random_states(prepared, rng, 1, size=0.02)
    here = at_state(record, prepared, coordinates, y, rng)
    unknowns = Unknowns(here, rng.uniform(-0.1, 0.1, here.n))
    assert unknowns.error() < 1e-10


def spinning(elements, step):
    """A bead on a straight bar that turns about Z with 3 rad/s, stiff enough to be straight."""
    section = beams.general(1e9, 1e9, 1e8, 1e8, 1.0, (0.1, 0.1, 0.1))
    bar = {"from": [0, 0, 0], "to": [4, 0, 0], "elements": elements, "mass": "lumped", "section": section}
    return {
        "bodies": {"bead": solid(0.5, 0.01, position=[0.3, 0, 0], velocity=[0, 0.9, 0], angular_velocity=[0, 0, 3])},
        "beams": {"bar": {**bar, "angular_velocity": [0, 0, 3]}},
        "joints": {
            "hub": {"type": "revolute", "bodies": ["ground", "bar.start"], "point": [0, 0, 0], "axis": [0, 0, 1]},
            "pad": {"type": "translational-on-beam", "bodies": ["bead", "bar"], "point": [0.3, 0, 0]},
        },
        "drivers": {"motor": {"coordinate": "hub.angle", "value": "3*time"}},
        "simulation": {"duration": 1.0, "step": step, "integrator": "generalised-alpha", "output_interval": 0.1},
    }


@pytest.mark.parametrize("elements", [1, 7])
def test_a_bead_is_flung_out_along_a_turning_bar(elements):
    """r = r₀ cosh ωt, however many nodes it passes; order two."""
    errors = []
    for step in (4e-3, 2e-3):
        result = simulate(spinning(elements, step))
        place = result.array("joint_coordinate")[:, -1]
        errors.append(np.abs(place - 0.3 * np.cosh(3.0 * result.time)).max())
    assert errors[1] < 1e-3
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.15)


EI, LENGTH, LOAD = 100.0, 4.0, 1e-3


def loaded(place, elements):
    """A cantilever under a small load on a slider, which is held at a place that need not be a node."""
    section = beams.general(1e6, 1e9, EI, EI, 1.0, (0.1, 0.1, 0.1))
    bar = {"from": [0, 0, 0], "to": [LENGTH, 0, 0], "elements": elements, "order": 2, "section": section}
    return {
        "bodies": {"bead": solid(0.1, 0.1, position=[place, 0, 0])},
        "beams": {"bar": bar},
        "joints": {
            "wall": {"type": "fixed", "bodies": ["ground", "bar.start"], "point": [0, 0, 0]},
            "pad": {"type": "translational-on-beam", "bodies": ["bead", "bar"], "point": [place, 0, 0]},
        },
        "drivers": {"hold": {"coordinate": "pad.displacement", "value": str(place)}},
        "forces": {"load": {"type": "force", "body": "bead", "vector": [0, 0, -LOAD]}},
    }


def deflection(force, at, x):
    """Of a cantilever at x under a force across it (Euler, Bernoulli)."""
    a, b = min(x, at), max(x, at)
    return force * a**2 * (3.0 * b - a) / (6.0 * EI)


@COORDINATES
@pytest.mark.parametrize("place", [2.0, 2.61])
def test_a_load_between_nodes_bends_a_cantilever(place, coordinates):
    errors = []
    for elements in (4, 8, 16):
        result = machine(loaded(place, elements)).statics(coordinates=coordinates)
        bent = result.dataset["position"].sel(body="bead").values[0, 2]
        errors.append(abs(bent / -deflection(LOAD, place, place) - 1.0))
    assert errors[-1] < 1e-4
    assert errors[-1] < 0.3 * errors[0] or errors[0] < 1e-6  # at a node it is exact at once


def test_pads_of_a_telescope_carry_its_load():
    """Two sections, the inner one between a pad at its start and one at the outer's end: deflections of Euler's beams, added up."""
    a, outer, inner, tip = 1.5, 4.0, 3.5, 5.0
    section = beams.general(1e6, 1e9, EI, EI, 1.0, (0.1, 0.1, 0.1))
    more = {"elements": 10, "order": 2, "section": section}
    c, b = outer - a, inner - (outer - a)
    sections = {
        "beams": {
            "outer": {"from": [0, 0, 0], "to": [outer, 0, 0], **more},
            "inner": {"from": [a, 0, 0], "to": [tip, 0, 0], **more},
        },
        "joints": {
            "wall": {"type": "fixed", "bodies": ["ground", "outer.start"], "point": [0, 0, 0]},
            "rear": {"type": "keyed-on-beam", "bodies": ["inner.start", "outer"], "point": [a, 0, 0]},
            "front": {"type": "point-on-beam", "bodies": ["outer.end", "inner"], "point": [outer, 0, 0]},
        },
        "drivers": {"ram": {"coordinate": "rear.displacement", "value": str(a)}},
        "forces": {"load": {"type": "force", "body": "inner.end", "vector": [0, 0, -LOAD]}},
    }
    result = machine(sections).statics()
    front, rear = LOAD * inner / c, LOAD * b / c  # on the outer: down at its end, up at the rear pad
    force = dict(zip(result.dataset["joint"].values, result.array("joint_force")[0], strict=True))
    # across the beam, which leans by 1e-4
    assert_allclose(force["front"], [0, 0, -front], atol=2e-4 * front)
    assert_allclose(force["rear"], [0, 0, -rear], atol=2e-4 * rear)  # on the inner
    assert_allclose([force["front"][2], force["rear"][2]], [-front, -rear], rtol=1e-6)
    at_rear = -deflection(front, outer, a) + deflection(rear, a, a)
    at_front = -deflection(front, outer, outer) + deflection(rear, a, outer)
    line = at_front + (at_front - at_rear) * b / c
    expected = line - LOAD * b**2 * (c + b) / (3.0 * EI)
    found = result.dataset["position"].sel(body="inner.end").values[0, 2]
    assert found == pytest.approx(expected, rel=1e-3)


def moving_load(elements, step):
    """A light carriage under a force runs over a beam between two bearings, once in a period of its lowest vibration."""
    section = {"type": "rectangle", "width": 0.02, "height": 0.02}
    steel = {"youngs_modulus": 210e9, "poisson_ratio": 0.3, "density": 7800}
    beam = {"from": [0, 0, 0], "to": [2, 0, 0], "elements": elements, "order": 2, "section": section, "material": steel}
    speed = 2.0 / PERIOD
    return {
        "bodies": {"cart": solid(1e-5, 1e-6, position=[0, 0, 0], velocity=[speed, 0, 0])},
        "beams": {"bridge": {**beam, "stations": {"middle": 0.5}}},
        "joints": {
            "left": {"type": "revolute", "bodies": ["ground", "bridge.start"], "point": [0, 0, 0], "axis": [0, 1, 0]},
            "right": {
                "type": "point-on-line",
                "bodies": ["ground", "bridge.end"],
                "point": [2, 0, 0],
                "axis": [1, 0, 0],
            },
            "wheel": {"type": "translational-on-beam", "bodies": ["cart", "bridge"], "point": [0, 0, 0]},
        },
        "drivers": {"run": {"coordinate": "wheel.displacement", "value": f"{speed}*time"}},
        "forces": {"weight": {"type": "force", "body": "cart", "vector": [0, 0, -1]}},
        "simulation": {"duration": PERIOD, "step": step, "integrator": "newmark", "output_interval": PERIOD / 20},
    }


SQUARE = 210e9 * 0.02**4 / 12 / (7800 * 0.02**2)  # EI over the mass of a length [m⁴/s²]
PERIOD = 2 * np.pi / ((np.pi / 2) ** 2 * np.sqrt(SQUARE))


def test_a_load_crosses_a_bridge():
    """w(L/2, t) = (2 P/m L) Σ sin(n π/2) (sin Ω_n t - (Ω_n/ω_n) sin ω_n t)/(ω_n² - Ω_n²), Ω_n = n π v/L (Timoshenko 1922; Frýba 1972)."""
    result = simulate(moving_load(12, PERIOD / 400))
    n = np.arange(1, 40)
    own, passing = (n * np.pi / 2) ** 2 * np.sqrt(SQUARE), n * np.pi / PERIOD
    t = result.time[:, None]
    terms = np.sin(n * np.pi / 2) * (np.sin(passing * t) - passing / own * np.sin(own * t)) / (own**2 - passing**2)
    expected = -2.0 / (7800 * 0.02**2 * 2.0) * terms.sum(axis=1)
    found = result.dataset["position"].sel(body="bridge.middle").values[:, 2]
    assert_allclose(found, expected, atol=5e-3 * np.abs(expected).max())


@COORDINATES
def test_energy_is_kept_where_nodes_are_passed(coordinates):
    """What an undamped method misses falls with the square of the step, on the way over several nodes of a rail that swings."""
    errors = []
    for step in (2e-3, 5e-4):
        settings = {"step": step, "duration": 0.25, "integrator": "newmark", "coordinates": coordinates}
        sections = bead("translational-on-beam", **settings)
        sections["gravity"] = [20, 2, -9.81]
        result = simulate(sections)
        place = result.array("joint_coordinate")[:, -1]
        assert np.ptp(place) > 0.15  # more than half an element
        errors.append(np.abs(result.array("energy_error")).max())
    assert errors[1] < 0.12 * errors[0]


@pytest.mark.parametrize(
    ("kind", "turns"),
    [
        ("point-on-beam", ["turn_x", "turn_y", "turn_z"]),
        ("keyed-on-beam", ["turn_1", "turn_2"]),
        ("cylindrical-on-beam", ["turn"]),
    ],
)
def test_states_of_a_linear_model_are_the_place_along_the_beam_and_turns(kind, turns):
    """The output of the displacement is the state of that name, and nothing else; so is its rate."""
    shown = ["pad.displacement", "pad.displacement.rate"]
    model = machine(bead(kind)).linearise(coordinates="relative", outputs=shown)
    states = [name.removeprefix("pad.") for name in model.states if name.startswith("pad.")]
    assert states[: len(states) // 2] == ["displacement", *turns]
    wanted = [[float(state == output) for state in model.states] for output in shown]
    assert_allclose(model.C, wanted, atol=1e-9)


def test_eliminated_and_kept_joints_have_the_same_accelerations():
    loads = {
        "push": {"type": "force", "body": "bead", "vector": [3, -5, 20]},
        "twist": {"type": "torque", "body": "bead", "vector": [2, 1, -1]},
    }
    first = [
        simulate({**bead("cylindrical-on-beam", coordinates=each, duration=0.002), "forces": loads}).dataset.isel(
            time=0
        )
        for each in ("absolute", "relative")
    ]
    for name in ("acceleration", "joint_force", "joint_torque"):
        one, other = (each[name].values for each in first)
        assert_allclose(one, other, rtol=1e-9, atol=1e-9 * np.abs(one).max(), err_msg=name)


def test_a_slider_that_leaves_its_beam_ends_the_run_and_a_stop_holds_it():
    sections = spinning(4, 2e-3)
    sections["simulation"] |= {"duration": 1.5}
    with pytest.raises(SolveError, match=r"pad\.displacement leaves its beam at the end") as caught:
        simulate(sections)
    assert caught.value.result.array("joint_coordinate")[-1, -1] > 3.5  # kept until then
    sections["forces"] = {
        "buffer": {"type": "stop", "coordinate": "pad.displacement", "upper": 3.8, "stiffness": 1e5, "restitution": 0.3}
    }
    held = simulate(sections)
    assert held.outcome == "done"
    assert 3.75 < held.array("joint_coordinate")[-1, -1] < 3.9


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (
            {"bodies": ["bead", "rail.end"]},
            "`rail.end` is not a beam, along which this joint slides; write `rail`, the whole beam",
        ),
        ({"bodies": ["bead", "bead"]}, "`bead` is not a beam, along which this joint slides; there are `rail`"),
        ({"bodies": ["rail", "bead"]}, "`rail` is a beam; what slides comes first, the beam second"),
        ({"bodies": ["rail.end", "rail"]}, "`rail.end` is on the beam `rail` itself, and cannot slide along it"),
        ({"bodies": ["bed", "rail"]}, "there is no body `bed`; did you mean `bead`?"),
        ({"axis": [1, 0, 0]}, "a point-on-beam joint has no `axis`"),
        ({"point": None}, "a point-on-beam joint needs `bodies` and a `point`"),
    ],
)
def test_what_a_joint_on_a_beam_needs(change, said):
    sections = bead("point-on-beam")
    pad = {**sections["joints"]["pad"], **change}
    sections["joints"]["pad"] = {key: value for key, value in pad.items() if value is not None}
    with pytest.raises(ModelError) as caught:
        machine(sections)
    assert any(said in fault.message for fault in caught.value.faults)


def test_a_point_beside_the_beam_is_told_with_the_nearest_one():
    sections = bead("point-on-beam", point=(0.2, 0.2, 0.1))
    with pytest.raises(ModelError, match="beside the line of the beam `rail`; the nearest point on it is"):
        machine(sections).simulate()


def girder(**simulation):
    """A trolley of 500 kg on a girder between two bearings, pushed by 200 N against friction."""
    steel = {"youngs_modulus": 210e9, "poisson_ratio": 0.3, "density": 7850}
    section = {"type": "box", "width": 0.15, "height": 0.25, "wall": 0.005}
    beam = {"from": [0, 0, 0], "to": [8, 0, 0], "elements": 6, "order": 2, "section": section, "material": steel}
    return {
        "gravity": [0, 0, -9.81],
        "beams": {"girder": {**beam, "damping": 2e-4}},
        "bodies": {"trolley": solid(500.0, 10.0, position=[1, 0, 0])},
        "joints": {
            "left": {"type": "revolute", "bodies": ["ground", "girder.start"], "point": [0, 0, 0], "axis": [0, 1, 0]},
            "right": {
                "type": "point-on-line",
                "bodies": ["ground", "girder.end"],
                "point": [8, 0, 0],
                "axis": [1, 0, 0],
            },
            "wheels": {"type": "translational-on-beam", "bodies": ["trolley", "girder"], "point": [1, 0, 0]},
        },
        "forces": {
            "push": {"type": "motor", "coordinate": "wheels.displacement", "effort": 200},
            "rub": {
                "type": "friction",
                "coordinate": "wheels.displacement",
                "model": "coulomb",
                "coefficient": 0.02,
                "transition_speed": 0.005,
            },
        },
        "simulation": {"duration": 0.5, "step": 1e-3, "integrator": "generalised-alpha", **simulation},
    }


def test_friction_on_a_beam_is_reported_with_the_load_that_presses():
    """The load is the joint's reaction across the beam, in every frame; the effort its share, once the trolley slides."""
    result = simulate(girder())
    (wheels,) = np.flatnonzero(result.dataset["joint"].values == "wheels")
    across = np.linalg.norm(result.array("joint_force_local")[:, wheels, :2], axis=1)
    load, effort = result.array("force.rub.normal_load"), result.array("force.rub.magnitude")
    assert across.max() > 4000.0
    assert_allclose(load, across, rtol=1e-6, atol=1e-3)
    speed = result.array("joint_rate")[:, -1]
    assert_allclose(effort, -0.02 * np.tanh(speed / 0.005) * load, rtol=1e-6, atol=1e-3)


def flung(kind, integrator):
    """A bead on a bar that stretches, so that the curvature of its line jumps at nodes, under steps that are chosen."""
    sections = spinning(3, 2e-3)
    sections["joints"]["pad"]["type"] = kind
    sections["beams"]["bar"]["section"] = beams.general(1e4, 1e4, 1e5, 1e5, 1.0, (0.1, 0.1, 0.1))
    sections["simulation"] |= {"integrator": integrator, "step_control": "error", "tolerance": 1e-4, "duration": 0.8}
    del sections["simulation"]["step"]
    return sections


@pytest.mark.parametrize(
    ("kind", "integrator"),
    [
        ("keyed-on-beam", "newmark"),
        ("keyed-on-beam", "generalised-alpha"),
        ("translational-on-beam", "newmark"),
        ("cylindrical-on-beam", "hht"),
        ("translational-on-beam", "radau"),
        ("translational-on-beam", "bdf"),
    ],
)
@COORDINATES
def test_steps_that_are_chosen_pass_nodes(kind, integrator, coordinates):
    result = simulate(flung(kind, integrator), coordinates=coordinates)
    assert result.outcome == "done"
    assert result.array("joint_coordinate")[-1, -1] > 4 / 3


def test_friction_on_a_beam_counts_moments_about_the_slider():
    """2 |M|/length with a bearing of that length: the trolley hangs from the girder by a lever across it."""
    sections = girder(duration=0.1)
    sections["bodies"]["trolley"]["centre_of_mass"] = [0.2, 0.0, -0.3]
    sections["forces"]["rub"]["bearing_length"] = 0.4
    result = simulate(sections)
    (wheels,) = np.flatnonzero(result.dataset["joint"].values == "wheels")
    force, torque = (result.array(f"joint_{each}_local")[:, wheels, :2] for each in ("force", "torque"))
    turning = 2.0 * np.linalg.norm(torque, axis=1) / 0.4
    assert turning.max() > 1000.0
    load = result.array("force.rub.normal_load")
    assert_allclose(load, np.linalg.norm(force, axis=1) + turning, rtol=1e-6, atol=1e-3)


def test_a_start_displacement_moves_the_slider_and_leaves_the_beam():
    sections = girder()
    sections["joints"]["wheels"]["start"] = {"displacement": 3.0}
    result = simulate(sections, duration=0.01)
    assert result.array("joint_coordinate")[0, -1] == pytest.approx(3.0, abs=1e-9)
    assert_allclose(result.dataset["position"].sel(body="trolley").values[0], [3.0, 0.0, 0.0], atol=1e-8)
