"""Contacts of many spheres from one entry: those of pairs, impacts in a row, heaps at rest."""

import numpy as np
import pytest

from nivel.errors import ModelError
from simulating import G, machine, simulate

BALL = {"shape": {"type": "sphere", "radius": 0.05}, "density": 2500}
PAIR = {"stiffness": 2e5, "exponent": 1, "restitution": 0.6}
FLOOR = {"body": "ground", "axis": [0, 0, 1]}


def balls(*places, **more):
    return {f"ball_{k}": {**BALL, "position": list(place), **more} for k, place in enumerate(places)}


@pytest.mark.parametrize("integrator", ["rk4", "dopri5"])
def test_one_entry_is_all_pairs(integrator):
    """Three balls that are thrown at each other on a floor move as with six contacts."""
    bodies = balls([0, 0, 0.0499], [0.11, 0.01, 0.0499], [0.05, 0.12, 0.06])
    bodies["ball_0"]["velocity"], bodies["ball_2"]["velocity"] = [1, 0.2, 0], [0, -1, 0]
    sections = {"gravity": [0, 0, -G], "bodies": bodies, "markers": {"floor": FLOOR}}
    rub = {"friction": 0.3, "friction_transition_speed": 0.1}
    names = list(bodies)
    single = {f"{name}_floor": {"type": "contact", "body": name, "plane": "floor"} for name in names}
    for k, name in enumerate(names):
        single |= {f"{name}_{other}": {"type": "contact", "bodies": [name, other]} for other in names[:k]}
    single = {name: {**each, **PAIR, **rub, "friction_model": "coulomb"} for name, each in single.items()}
    group = {"heap": {"type": "contacts", "between": "all", "planes": ["floor"], **PAIR, **rub}}
    settings = {"integrator": integrator, "step": 2e-5, "duration": 0.2, "output_interval": 0.01}
    if integrator == "dopri5":
        settings["tolerance"] = 1e-9
    first, second = (simulate({**sections, "forces": forces}, **settings) for forces in (single, group))
    for name in names:
        np.testing.assert_allclose(second.array(f"{name}.position"), first.array(f"{name}.position"), atol=1e-8)
    assert second.array("force.heap.count").max() >= 2
    total = sum(first.array(f"force.{name}.normal_force") for name in single)
    np.testing.assert_allclose(second.array("force.heap.normal_force"), total, rtol=1e-5, atol=1e-3)


def test_a_row_of_balls_passes_its_momentum_on():
    """Newton's cradle without loss and with gaps: the last ball leaves with the speed of the first."""
    bodies = balls(*([0.12 * k, 0, 0] for k in range(5)))
    bodies["ball_0"]["velocity"] = [1, 0, 0]
    group = {"heap": {"type": "contacts", "between": list(bodies), **PAIR, "restitution": 1}}
    settings = {"integrator": "dopri5", "tolerance": 1e-9, "duration": 0.3}
    r = simulate({"gravity": [0, 0, 0], "bodies": bodies, "forces": group}, **settings)
    speeds = [r.array(f"ball_{k}.velocity.x")[-1] for k in range(5)]
    np.testing.assert_allclose(speeds, [0, 0, 0, 0, 1], atol=1e-6)
    assert np.abs(r.array("energy_error")).max() < 1e-6


def test_a_heap_presses_on_the_floor_with_its_weight():
    """Four balls in a pit of four walls: at rest the vertical forces of the walls are the weight, whatever the balls do between them."""
    s = np.sqrt(0.5)
    walls = [{"body": "ground", "axis": axis} for axis in ([s, 0, s], [-s, 0, s], [0, s, s], [0, -s, s])]
    bodies = balls([0.06, 0, 0.2], [-0.06, 0.001, 0.2], [0, 0.06, 0.32], [0.002, -0.06, 0.32])
    group = {"heap": {"type": "contacts", "between": "all", "planes": walls, **PAIR, "restitution": 0.2}}
    r = simulate({"gravity": [0, 0, -G], "bodies": bodies, "forces": group}, integrator="rk4", step=1e-4, duration=2.0)
    mass = 4 * 2500 * 4 / 3 * np.pi * 0.05**3
    # momentum: ∫ (walls - weight) dt = change; at rest the whole is still
    assert sum(np.abs(r.array(f"ball_{k}.velocity")[-1]).max() for k in range(4)) < 0.05
    fallen = sum(r.array(f"ball_{k}.position.z")[0] - r.array(f"ball_{k}.position.z")[-1] for k in range(4)) / 4
    assert r.array("dissipated_energy")[-1] == pytest.approx(mass * G * fallen, rel=1e-2)
    assert np.abs(r.array("energy_error")).max() < 1e-3 * mass * G * fallen


def pyramid(slope=0.0, **contact):
    """Four balls, three on a floor and one in the hollow between them; on a slope along X a wall is below the first."""
    gap, radius = 0.0999, 0.05
    corners = [(gap / np.sqrt(3) * np.cos(a), gap / np.sqrt(3) * np.sin(a)) for a in np.radians([0, 120, 240])]
    bodies = balls(*([x, y, radius - 1e-5] for x, y in corners), [0, 0, radius + gap * np.sqrt(2 / 3)])
    wall = {"body": "ground", "position": [gap / np.sqrt(3) + radius, 0, 0], "axis": [-1, 0, 0]}
    planes = ["floor", wall] if slope else ["floor"]
    group = {
        "type": "contacts",
        "between": "all",
        "planes": planes,
        **PAIR,
        "restitution": 0.2,
        "friction": 0.7,
        **contact,
    }
    return {
        "gravity": [G * np.sin(slope), 0, -G * np.cos(slope)],
        "bodies": bodies,
        "markers": {"floor": FLOOR},
        "forces": {"heap": {**group, "friction_model": "stiction"}},
    }


@pytest.mark.parametrize(
    ("integrator", "step", "duration"),
    [
        pytest.param("rk4", 2e-4, 4.0, marks=pytest.mark.full),
        ("generalised-alpha", 1e-3, 12.0),
        ("extrapolated-euler", 1e-3, 4.0),
    ],
)
def test_a_heap_that_sticks_does_not_creep(integrator, step, duration):
    """A pyramid of balls on a slope of 5°, against a wall: it comes to rest and moves by less than a nanometre, one method for 10 s.
    Floor and wall carry its weight."""
    slope = np.radians(5.0)
    r = simulate(pyramid(slope), integrator=integrator, step=step, duration=duration, output_interval=0.5)
    settled = r.time >= 2.0
    for k in range(4):
        place = r.array(f"ball_{k}.position")[settled]
        assert np.abs(place - place[-1]).max() < 1e-9
    weight = 4 * 2500 * 4 / 3 * np.pi * 0.05**3 * G
    touches = [f"force.heap_ball_{k}_{plane}" for k in range(4) for plane in (1, 2)]
    carried = [
        sum(
            (
                r.array(f"{touch}.normal_force") * r.array(f"{touch}.normal_{axis}")
                + r.array(f"{touch}.friction_{axis}")
            )[-1]
            for touch in touches
        )
        for axis in "xyz"
    ]
    np.testing.assert_allclose(carried, [-weight * np.sin(slope), 0, weight * np.cos(slope)], atol=1e-6 * weight)
    assert r.array("ball_3.position.z")[-1] > 0.13


def test_a_pyramid_of_balls_stands_by_friction_alone():
    """The line of two centres is at θ from the vertical, sin θ = 1/√3: the forces on a ball below meet on the floor, so each friction
    needs μ ≥ tan(θ/2) = 0.318. With less the upper ball comes down to the floor."""
    least = np.tan(0.5 * np.arcsin(np.sqrt(1 / 3)))
    settings = {"integrator": "generalised-alpha", "step": 1e-3, "duration": 1.0, "output_interval": 0.1}
    stands, falls = (simulate(pyramid(friction=mu * least), **settings) for mu in (1.1, 0.9))
    assert stands.array("ball_3.position.z")[-1] > 0.13
    assert falls.array("ball_3.position.z")[-1] < 0.051


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"friction_model": "stiction"}, "`friction` is missing"),
        ({"friction_model": "stiction", "friction": 0.3, "friction_transition_speed": 0.1}, "belongs to"),
        ({"static_friction": 0.4, "friction": 0.3, "friction_transition_speed": 0.1}, "belongs to"),
        ({"friction_model": "stiction", "friction": 0.3, "between": ["ball_0", "box"]}, "sphere"),
        ({"between": ["ball_0"]}, "at least two"),
        ({"between": ["ball_0", "box"]}, "sphere"),
        ({"between": ["ball_0", "ball_0"]}, "twice"),
        ({"friction": 0.3, "friction_model": "coulomb"}, "friction_transition_speed"),
        ({"planes": ["flor"]}, "flor"),
    ],
)
def test_what_cannot_be_a_heap_is_refused(changes, said):
    bodies = {**balls([0, 0, 0], [1, 0, 0]), "box": {"mass": 1, "shape": {"type": "box", "size": [1, 1, 1]}}}
    forces = {"heap": {"type": "contacts", "between": ["ball_0", "ball_1"], **PAIR, **changes}}
    with pytest.raises(ModelError, match=said):
        simulate({"bodies": bodies, "markers": {"floor": FLOOR}, "forces": forces}, duration=0.1)


@pytest.mark.parametrize(
    ("given", "sticks"),
    [
        ({}, True),
        ({"friction_transition_speed": 0.05}, False),
        ({"friction_model": "stiction"}, True),
        ({"friction_model": "coulomb", "friction_transition_speed": 0.05}, False),
    ],
)
@pytest.mark.parametrize("kind", ["contact", "contacts"])
def test_one_default_of_friction_for_one_word(kind, given, sticks):
    """A given transition speed makes friction smooth, as in files from before contacts could stick; without one, contacts stick."""
    ends = {"body": "ball_0", "plane": "floor"} if kind == "contact" else {"between": "all", "planes": ["floor"]}
    forces = {"it": {"type": kind, **ends, **PAIR, "friction": 0.3, **given}}
    record = machine({"bodies": balls([0, 0, 0], [1, 0, 0]), "markers": {"floor": FLOOR}, "forces": forces}).record
    kinds = {force.type for force in record.forces}
    assert kinds == ({"contact"} if kind == "contact" or sticks else {"contacts"})
    assert all(force.sticks == sticks for force in record.forces if force.type == "contact")


def test_what_cells_find_is_what_all_pairs_give(monkeypatch):
    """A cloud of sixty spheres of two sizes that collide: the same motion, touches and forces, to the round-off of sums."""
    rng = np.random.default_rng(3)
    grid = [(x, y, z) for x in range(4) for y in range(5) for z in range(3)]
    bodies = {
        f"ball_{k}": {
            "shape": {"type": "sphere", "radius": 0.05 if k % 3 else 0.02},
            "density": 2500,
            "position": (0.11 * np.array(place) - 0.2 + rng.uniform(-5e-3, 5e-3, 3)).tolist(),
            "velocity": rng.uniform(-1, 1, 3).tolist(),
        }
        for k, place in enumerate(grid)
    }
    rub = {"friction": 0.3, "friction_transition_speed": 0.1}
    group = {
        "heap": {"type": "contacts", "between": "all", "planes": [{**FLOOR, "position": [0, 0, -0.3]}], **PAIR, **rub}
    }
    sections = {"gravity": [0, 0, -G], "bodies": bodies, "forces": group}
    settings = {"integrator": "rk4", "step": 5e-5, "duration": 0.1, "output_interval": 0.01}
    monkeypatch.setattr("nivel.elements.contacts.heap.MANY", 10)
    cells = simulate(sections, **settings)
    monkeypatch.setattr("nivel.elements.contacts.heap.MANY", 1000)
    pairs = simulate(sections, **settings)
    assert pairs.array("force.heap.count").sum() > 15
    np.testing.assert_array_equal(cells.array("force.heap.count"), pairs.array("force.heap.count"))
    for name in bodies:
        np.testing.assert_allclose(cells.array(f"{name}.position"), pairs.array(f"{name}.position"), atol=1e-9)
    touching = pairs.array("force.heap.depth") > 0
    np.testing.assert_allclose(
        cells.array("force.heap.depth")[touching], pairs.array("force.heap.depth")[touching], atol=1e-8
    )
    assert np.all(cells.array("force.heap.depth")[~touching] < 0)


def test_a_heap_of_many_cannot_stick():
    """Sixteen balls have 120 pairs, seventeen have 136."""
    group = {"heap": {"type": "contacts", "between": "all", **PAIR, "friction": 0.3, "friction_model": "stiction"}}
    with pytest.raises(ModelError, match="136 pairs"):
        machine({"bodies": balls(*([0.2 * k, 0, 0] for k in range(17))), "forces": group})
    held = machine({"bodies": balls(*([0.2 * k, 0, 0] for k in range(16))), "forces": group})
    assert len(held.record.forces) == 120


def test_check_says_that_a_heap_creeps_and_what_holds_it():
    rub = {"friction": 0.3, "friction_transition_speed": 0.1}
    group = {"heap": {"type": "contacts", "between": "all", "planes": [FLOOR], **PAIR, **rub}}
    text = str(machine({"bodies": balls([0, 0, 0.1], [1, 0, 0.1]), "forces": group}).check())
    assert "2 spheres and 1 plane; bodies at rest creep, `friction_model: stiction` holds up to 15 of them" in text


def test_a_heap_that_creeps_is_amber():
    """Two balls, one on the other and leaning on it, sink apart where friction would hold them."""
    rub = {"friction": 0.3, "friction_transition_speed": 0.1}
    group = {"heap": {"type": "contacts", "between": "all", "planes": [FLOOR], **PAIR, **rub}}
    sections = {"gravity": [0.1 * G, 0, -G], "bodies": balls([0, 0, 0.0499], [0, 0, 0.1497]), "forces": group}
    r = simulate(sections, integrator="rk4", step=2e-4, duration=0.2, output_interval=5e-3)
    (line,) = [item for item in r.trust.items if item.name == "creep"]
    assert line.verdict == "amber"
    assert "stiction" in line.text
