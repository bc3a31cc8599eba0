"""Contact that sticks, against closed forms: slopes, stick-slip, rolling with and without slip, spinning, a top that turns over, towers."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.analysis.plan.compilation import run_entries
from nivel.analysis.plan.plan import plan_run
from nivel.errors import ModelError
from nivel.judge.before.unusual import remarks
from preparing import prepare
from references import stick_slip
from simulating import G, machine, simulate, slide, solid

pytestmark = pytest.mark.covering

FAULT = Path(__file__).parents[2] / "faults" / "r02_box_incline.yaml"
METHODS = pytest.mark.parametrize(
    ("integrator", "coordinates", "step"),
    [
        ("rk4", "absolute", 2e-4),
        ("rk4", "relative", 2e-4),
        ("dopri5", "relative", 1e-3),
        ("generalised-alpha", "absolute", 1e-3),
        ("generalised-alpha", "independent", 1e-3),
        ("radau", "absolute", 1e-3),
        ("bdf", "relative", 1e-3),
        ("ros2", "relative", 1e-3),
        ("extrapolated-euler", "absolute", 1e-3),
    ],
)
FEW = pytest.mark.parametrize(
    ("integrator", "coordinates", "step"),
    [("rk4", "absolute", 1e-4), ("generalised-alpha", "absolute", 2.5e-4), ("radau", "relative", 5e-4)],
)
MASS, STIFFNESS = 2.0, 1e6
SIZE = np.array([0.3, 0.2, 0.1])
INERTIA = (
    MASS / 12.0 * np.array([SIZE[1] ** 2 + SIZE[2] ** 2, SIZE[0] ** 2 + SIZE[2] ** 2, SIZE[0] ** 2 + SIZE[1] ** 2])
)


def touching(mu, static=None, restitution=0.2, **more):
    out = {"type": "contact", "stiffness": STIFFNESS, "exponent": 1, "restitution": restitution, "friction": mu, **more}
    return out if static is None else {**out, "static_friction": static}


def box(mu, static=None, slope=0.0, velocity=(0, 0, 0), forces=None, **more):
    """A box that lies on its four corners, X down the slope; it begins with the overlap that carries it."""
    overlap = MASS * G * np.cos(slope) / (4 * STIFFNESS)
    body = {"mass": MASS, "position": [0, 0, SIZE[2] / 2 - overlap], "shape": {"type": "box", "size": SIZE.tolist()}}
    return {
        "gravity": [G * np.sin(slope), 0, -G * np.cos(slope)],
        "bodies": {"box": {**body, "velocity": list(velocity), **more}},
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1], "x_axis": [1, 0, 0]}},
        "forces": {"touch": touching(mu, static, body="box", plane="floor"), **(forces or {})},
    }


# --- rest ---
@METHODS
def test_a_box_on_a_slope_does_not_creep(integrator, coordinates, step):
    """2° and μ = 1: after it has settled it has not moved by a nanometre in 10 s, and friction is what holds it."""
    r = nivel.load(FAULT).simulate(integrator=integrator, coordinates=coordinates, step=step, duration=10)
    settled = r.time >= 1.0
    place = r.array("box.position")[settled]
    assert np.abs(place - place[-1]).max() < 1e-11
    assert np.abs(place[-1, :2]).max() < 1e-5
    np.testing.assert_allclose(r.array("force.c.friction_force")[-1], 5 * 0.342369, rtol=1e-6)
    assert r.array("force.c.slip_speed")[-1] < 1e-12


def test_a_box_on_a_slope_does_not_move_in_an_hour():
    r = nivel.load(FAULT, {"simulation.output_interval": 60}).simulate(duration=3600, verify=False)
    assert r.time[-1] == 3600.0
    place = r.array("box.position")[1:]
    assert np.abs(place - place[0]).max() < 1e-9


@FEW
def test_a_bar_between_two_planes_does_not_creep(integrator, coordinates, step):
    """Pressed by 5 weights from both sides it hangs by friction, which may share the load as it likes."""
    overlap = 5 * MASS * G / (4 * STIFFNESS)
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {"bar": {"mass": MASS, "shape": {"type": "box", "size": [0.1, 0.2, 0.3]}}},
        "markers": {
            "left": {"body": "ground", "position": [-0.05 + overlap, 0, 0], "axis": [1, 0, 0], "x_axis": [0, 1, 0]},
            "right": {"body": "ground", "position": [0.05 - overlap, 0, 0], "axis": [-1, 0, 0], "x_axis": [0, 0, 1]},
        },
        "forces": {side: touching(0.2, restitution=0.8, body="bar", plane=side) for side in ("left", "right")},
    }
    settings = {"integrator": integrator, "coordinates": coordinates, "step": step, "output_interval": 0.1}
    r = simulate(sections, duration=3.0, **settings)
    assert np.abs(r.array("bar.position")).max() < 1e-9
    assert np.abs(r.array("bar.position")[5:] - r.array("bar.position")[-1]).max() < 1e-11


@FEW
def test_a_box_that_was_thrown_up_a_slope_stays(integrator, coordinates, step):
    """tan α between μ_d and μ_s: it rises v0²/(2 g (sin α + μ_d cos α)) and is held there."""
    slope = np.radians(20.0)
    settings = {"integrator": integrator, "coordinates": coordinates, "step": step, "output_interval": 0.1}
    r = simulate(box(0.3, 0.4, slope, (-1, 0, 0)), duration=1.0, **settings)
    rises = 1.0 / (2 * G * (np.sin(slope) + 0.3 * np.cos(slope)))
    place = r.array("box.position.x")
    assert abs(place[-1] + rises) < 1e-4
    assert np.abs(place[5:] - place[-1]).max() < 1e-9


# --- sliding ---
@FEW
def test_a_box_slides_down_a_steep_slope(integrator, coordinates, step):
    """a = g (sin α - μ cos α): friction at the floor tilts it once, within its overlap."""
    slope = np.radians(40.0)
    settings = {"integrator": integrator, "coordinates": coordinates, "step": step, "output_interval": 0.05}
    r = simulate(box(0.3, slope=slope), duration=0.5, **settings)
    a = G * (np.sin(slope) - 0.3 * np.cos(slope))
    np.testing.assert_allclose(r.array("box.velocity.x"), a * r.time, atol=2e-3)
    assert abs(r.array("energy_error")[-1]) < 1e-4 * r.array("dissipated_energy")[-1]


@pytest.mark.parametrize(
    ("integrator", "coordinates", "step"),
    [
        ("rk4", "absolute", 1e-4),
        ("generalised-alpha", "absolute", 2.5e-4),
        ("radau", "relative", 5e-4),
        ("bdf", "relative", 5e-4),
        ("dopri5", "absolute", 5e-4),
    ],
)
def test_stick_slip_of_a_drawn_box(integrator, coordinates, step):
    """A carriage draws it by a spring at V: slips and rests at their closed times, μ_s > μ_d."""
    pull = stick_slip.Drawn(mass=MASS, stiffness=600.0, speed=0.05, load=MASS * G, static=0.4, kinetic=0.25)
    sections = box(pull.kinetic, pull.static)
    sections["bodies"]["carriage"] = solid(1.0, 0.01, position=[0.5, 0, SIZE[2] / 2], velocity=[pull.speed, 0, 0])
    sections["joints"] = {"track": slide("ground", "carriage", point=[0.5, 0, SIZE[2] / 2])}
    sections["drivers"] = {"winch": {"coordinate": "track.displacement", "value": f"{pull.speed}*time"}}
    ends = [{"body": "box"}, {"body": "carriage"}]
    sections["forces"]["rope"] = {
        "type": "spring-damper",
        "markers": ends,
        "stiffness": pull.stiffness,
        "free_length": 0.5,
    }
    settings = {"integrator": integrator, "coordinates": coordinates, "step": step, "output_interval": 0.01}
    r = simulate(sections, duration=1.0, **settings)
    assert pull.first_slip + pull.slip_duration + pull.stick_duration < 1.0
    np.testing.assert_allclose(r.array("box.position.x"), pull.closed_form(r.time), atol=2e-4)


@FEW
def test_a_brick_spins_to_rest(integrator, coordinates, step):
    """Its corners at r = half a diagonal: J ω̇ = -μ m g r. It stops at ω0² J/(2 μ m g r), and stays."""
    mu, speed, reach = 0.3, 6.0, 0.5 * np.hypot(SIZE[0], SIZE[1])
    settings = {"integrator": integrator, "coordinates": coordinates, "step": step, "output_interval": 0.02}
    r = simulate(box(mu, angular_velocity=[0, 0, speed]), duration=0.5, **settings)
    braking = mu * MASS * G * reach / INERTIA[2]
    assert speed / braking < 0.4
    spin = r.array("box.angular_velocity.z")
    np.testing.assert_allclose(spin, np.maximum(speed - braking * r.time, 0.0), atol=braking * 2.5e-3)
    assert np.abs(spin[-3:]).max() < 1e-9
    turned = 2.0 * np.arctan2(r.array("box.orientation")[-1, 3], r.array("box.orientation")[-1, 0])
    assert abs(turned - speed**2 / (2 * braking)) < 2e-3
    lost = 0.5 * INERTIA[2] * speed**2
    assert abs(r.array("dissipated_energy")[-1] - lost) < 2e-3 * lost


# --- rolling ---
RADIUS = 0.05


def ball(mu, slope=0.0, velocity=(0, 0, 0), spin=(0, 0, 0)):
    overlap = MASS * G * np.cos(slope) / STIFFNESS
    return {
        "gravity": [G * np.sin(slope), 0, -G * np.cos(slope)],
        "bodies": {
            "ball": {
                "mass": MASS,
                "position": [0, 0, RADIUS - overlap],
                "shape": {"type": "sphere", "radius": RADIUS},
                "velocity": list(velocity),
                "angular_velocity": list(spin),
            }
        },
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1]}},
        "forces": {"touch": touching(mu, body="ball", plane="floor")},
    }


@FEW
@pytest.mark.parametrize(("degrees", "slips"), [(20, False), (60, True)])
def test_a_ball_rolls_down_a_slope(integrator, coordinates, step, degrees, slips):
    """Below tan α = 7/2 μ it rolls with 5/7 g sin α, above it slips with g (sin α - μ cos α)."""
    mu, slope = 0.3, np.radians(degrees)
    settings = {"integrator": integrator, "coordinates": coordinates, "step": step, "output_interval": 0.05}
    r = simulate(ball(mu, slope), duration=0.5, **settings)
    a = G * (np.sin(slope) - mu * np.cos(slope)) if slips else 5 / 7 * G * np.sin(slope)
    np.testing.assert_allclose(r.array("ball.velocity.x"), a * r.time, atol=2e-3 * a)
    if not slips:
        assert r.array("force.touch.slip_speed").max() < 5e-3 * a * step / 1e-4
        assert r.array("dissipated_energy")[-1] < 2e-3 * r.array("kinetic_energy")[-1]


@FEW
def test_a_billiard_ball_begins_to_roll(integrator, coordinates, step):
    """Pushed without spin it slides until t = 2 v0/(7 μ g), then rolls with 5/7 v0."""
    mu, v = 0.2, 1.0
    settings = {"integrator": integrator, "coordinates": coordinates, "step": step, "output_interval": 0.01}
    r = simulate(ball(mu, velocity=(v, 0, 0)), duration=0.3, **settings)
    begin = 2 * v / (7 * mu * G)
    expected = np.where(r.time < begin, v - mu * G * r.time, 5 / 7 * v)
    np.testing.assert_allclose(r.array("ball.velocity.x"), expected, atol=2e-3)
    assert r.array("force.touch.slip_speed")[r.time > begin + 0.02].max() < 1e-8


@FEW
def test_a_cylinder_rolls_down_a_slope(integrator, coordinates, step):
    """With 2/3 g sin α, on the four points of each rim of which it has two at a time on the floor."""
    slope, radius = np.radians(20.0), 0.05
    overlap = MASS * G * np.cos(slope) / (2 * STIFFNESS)
    shape = {"type": "cylinder", "radius": radius, "length": 0.2, "along": "y"}
    sections = {
        "gravity": [G * np.sin(slope), 0, -G * np.cos(slope)],
        "bodies": {"roll": {"mass": MASS, "position": [0, 0, radius - overlap], "shape": shape}},
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1]}},
        "forces": {"touch": touching(0.3, body="roll", plane="floor")},
    }
    settings = {"integrator": integrator, "coordinates": coordinates, "step": step, "output_interval": 0.05}
    r = simulate(sections, duration=0.5, **settings)
    a = 2 / 3 * G * np.sin(slope)
    np.testing.assert_allclose(r.array("roll.velocity.x"), a * r.time, atol=4e-3 * a)
    assert r.array("dissipated_energy")[-1] < 4e-3 * r.array("kinetic_energy")[-1]


def test_a_top_turns_over_and_keeps_jelletts_number():
    """A sphere with its mass below the middle. Friction acts at the lowest point alone: L · (from the middle of mass to it) is constant,
    while friction lifts the mass above the middle (Jellett 1872). It takes little friction, so that it goes on slipping."""
    mass, radius, low, spin = 0.02, 0.015, 0.004, 150.0
    J = np.array([0.40, 0.40, 0.38]) * mass * radius**2
    stiffness = 2e3
    overlap = mass * G / stiffness
    tilt = 0.15
    axis = np.array([np.sin(tilt), 0.0, np.cos(tilt)])
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {
            "top": {
                "mass": mass,
                "inertia": J.tolist(),
                "centre_of_mass": [0, 0, -low],
                "position": [0, 0, radius - overlap],
                "orientation": {"axis": [0, 1, 0], "angle": tilt},
                "angular_velocity": (spin * axis).tolist(),
                "shape": {"type": "sphere", "radius": radius},
            }
        },
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1]}},
        "forces": {"touch": {**touching(0.02, restitution=0.5, body="top", plane="floor"), "stiffness": stiffness}},
    }
    r = simulate(sections, duration=10.0, integrator="rk4", step=1e-4, output_interval=0.05)
    q, w = r.array("top.orientation"), r.array("top.angular_velocity")
    up = np.stack(
        [
            2 * (q[:, 1] * q[:, 3] + q[:, 0] * q[:, 2]),
            2 * (q[:, 2] * q[:, 3] - q[:, 0] * q[:, 1]),
            1 - 2 * (q[:, 1] ** 2 + q[:, 2] ** 2),
        ],
        axis=1,
    )
    along = np.sum(w * up, axis=1)
    momentum = J[0] * w + (J[2] - J[0]) * along[:, None] * up
    to_floor = low * up
    to_floor[:, 2] -= r.array("top.position.z")
    jellett = np.sum(momentum * to_floor, axis=1)
    np.testing.assert_allclose(jellett, jellett[0], rtol=2e-3)
    assert up[0, 2] > 0.9
    assert up[-1, 2] < -0.3
    assert np.all(np.diff(r.array("kinetic_energy") + r.array("potential_energy")) < 1e-7)


# --- loads that change ---
@FEW
def test_a_box_slips_while_it_is_pressed_less(integrator, coordinates, step):
    """Pulled by T = 0.9 μ m g, it is relieved by m g/4 between 0.2 and 0.3 s: there it slides with (T - 3/4 μ m g)/m, then it brakes with
    (μ m g - T)/m, and rests."""
    mu = 0.4
    pull, relief = 0.9 * mu * MASS * G, 0.25 * MASS * G
    # both rise within 2 ms, and the pull is at the height of the floor: nothing tilts
    lift = f"{relief}*(min(1, max(0, (time - 0.2)/0.002)) - min(1, max(0, (time - 0.3)/0.002)))"
    forces = {
        "pull": {
            "type": "force",
            "body": "box",
            "position": [0, 0, -SIZE[2] / 2],
            "vector": [f"{pull}*min(1, time/0.05)", 0, 0],
        },
        "lift": {"type": "force", "body": "box", "vector": [0, 0, lift]},
    }
    settings = {"integrator": integrator, "coordinates": coordinates, "step": step, "output_interval": 0.01}
    r = simulate(box(mu, forces=forces), duration=1.0, **settings)
    slides, brakes = pull / MASS - 0.75 * mu * G, mu * G - pull / MASS
    speed = slides * 0.1
    way = 0.5 * slides * 0.1**2 + speed**2 / (2 * brakes)
    assert 0.302 + speed / brakes < 0.9
    place = r.array("box.position.x")
    assert np.abs(place[r.time < 0.195]).max() < 2e-6
    assert abs(place[-1] - way) < 0.02 * way
    assert np.abs(place[-5:] - place[-1]).max() < 1e-9


# --- solids on solids ---
BRICK, WIDTH, HEIGHT, COUNT = 1.0, 0.2, 0.08, 5


def tower(mu, push):
    """Five bricks on a table; the uppermost is pushed."""
    modulus, middle = 2e8, 0.0
    bodies = {"table": {"shape": {"type": "box", "size": [1, 1, 0.1]}, "mass": 50, "position": [0, 0, -0.05]}}
    forces = {"push": {"type": "force", "body": f"brick{COUNT}", "vector": [push, 0, 0]}}
    for k in range(1, COUNT + 1):
        middle += HEIGHT - (COUNT + 1 - k) * BRICK * G / (modulus * WIDTH**2)
        shape = {"type": "box", "size": [WIDTH, WIDTH, HEIGHT]}
        bodies[f"brick{k}"] = {"shape": shape, "mass": BRICK, "position": [0, 0, middle - HEIGHT / 2]}
        below = f"brick{k - 1}" if k > 1 else "table"
        touch = {"type": "contact", "bodies": [below, f"brick{k}"], "foundation_modulus": modulus, "damping": 50.0}
        forces[f"joint{k}"] = {**touch, "friction": mu}
    joints = {"held": {"type": "fixed", "bodies": ["ground", "table"], "point": [0, 0, 0]}}
    return {"gravity": [0, 0, -G], "bodies": bodies, "joints": joints, "forces": forces}


@pytest.mark.parametrize(("integrator", "step"), [("generalised-alpha", 5e-4), ("radau", 1e-3)])
def test_a_tower_of_bricks_slips_at_the_top(integrator, step):
    """With 4 N/s, at μ m g; then the uppermost alone slides, m v = (t - t0)² 4/2."""
    mu, rate = 0.3, 4.0
    begin = mu * BRICK * G / rate
    r = simulate(tower(mu, f"{rate}*time"), duration=1.0, integrator=integrator, step=step, output_interval=0.02)
    late = np.maximum(r.time - begin, 0.0)
    np.testing.assert_allclose(r.array("brick5.velocity.x"), 0.5 * rate / BRICK * late**2, atol=2e-3)
    for k in range(1, COUNT):
        assert np.abs(r.array(f"brick{k}.position.x")).max() < 1e-4
    assert np.abs(r.array("force.joint1.slip_speed")).max() < 1e-5


@pytest.mark.parametrize(("push", "tips"), [(10.0, False), (15.0, True)])
def test_a_tower_of_bricks_tips(push, tips):
    """μ m g is more than what tips it as a whole about its foot, 5 m g w/2 over (5 - 1/2) h = 13.6 N; near the edge the solids give way."""
    assert 10.0 < COUNT * BRICK * G * WIDTH / 2 / ((COUNT - 0.5) * HEIGHT) < 15.0
    ramp = f"{push}*min(1, time/0.2)"
    r = simulate(tower(2.0, ramp), duration=0.6, integrator="generalised-alpha", step=5e-4, output_interval=0.02)
    lean = r.array("brick5.position.x")[-1]
    assert (lean > 0.1) if tips else (lean < 1e-3)


# --- cost ---
@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_boxes_apart_have_nothing_to_do_with_each_other(coordinates):
    """Newton's matrix of four boxes that stick to the floor has four times the entries of one box, not sixteen times."""
    entries = []
    for count in (1, 4):
        sections = box(0.3)
        one, touch = sections["bodies"].pop("box"), sections["forces"].pop("touch")
        for k in range(count):
            sections["bodies"][f"box{k}"] = {**one, "position": [0, 0.5 * k, one["position"][2]]}
            sections["forces"][f"touch{k}"] = {**touch, "body": f"box{k}"}
        record = machine(sections | {"simulation": {"integrator": "radau"}}).record
        entries.append(len(prepare(record, "newton-euler", coordinates).motion.system.record.newton.value))
    assert entries[1] <= 4 * entries[0]


# --- the trust report ---
def test_creep_is_amber_and_stiction_is_not():
    """With the smooth law the box creeps at v_t tan(2°): v_t atanh(…) in all 3.5e-4 m/s for 5 s."""
    smooth = nivel.load(FAULT, {"forces.c.friction_model": "coulomb"}).simulate()
    line = next(item for item in smooth.trust.items if item.name == "creep")
    assert line.verdict == "amber"
    assert smooth.trust.found["creep"][0]["way"] == pytest.approx(
        0.01 * np.arctanh(np.tan(np.radians(2.0))) * 5, rel=0.02
    )
    assert not any(item.name == "creep" for item in nivel.load(FAULT).simulate().trust.items)


@pytest.mark.parametrize("kind", ["contacts", "pair"])
def test_creep_is_told_of_many_spheres_and_of_pairs(kind):
    """Balls that roll down 5° slip by v_t atanh(2/7 tan(5°)/μ) all the time: friction of 2/7 m g sin(5°) needs that much."""
    slope, mu, v_t, radius, duration = np.radians(5.0), 0.5, 0.02, 0.1, 1.0
    friction = {"stiffness": 1e5, "exponent": 1, "restitution": 0.5, "friction": mu, "friction_transition_speed": v_t}
    overlap = 1.0 * G * np.cos(slope) / 1e5
    ball = {"mass": 1.0, "shape": {"type": "sphere", "radius": radius}}
    sections = {
        "gravity": [G * np.sin(slope), 0, -G * np.cos(slope)],
        "bodies": {name: {**ball, "position": [0, y, radius - overlap]} for name, y in (("a", 0.0), ("b", 0.5))},
        "forces": {
            "it": {
                "type": "contacts",
                "between": ["a", "b"],
                "planes": [{"body": "ground", "axis": [0, 0, 1]}],
                **friction,
            }
        },
    }
    if kind == "pair":
        del sections["bodies"]["b"]
        sections["bodies"]["table"] = {
            "position": [0, 0, -0.1],
            "shape": {"type": "box", "size": [9, 2, 0.2]},
            "density": 700,
        }
        sections["joints"] = {"held": {"type": "fixed", "bodies": ["ground", "table"], "point": [0, 0, 0]}}
        sections["forces"] = {
            "it": {"type": "contact", "bodies": ["a", "table"], "friction_model": "coulomb", **friction}
        }
    result = simulate(sections, integrator="radau", duration=duration, output_interval=0.01)
    slip = v_t * np.arctanh(2.0 / 7.0 * np.tan(slope) / mu)
    (line,) = [item for item in result.trust.items if item.name == "creep"]
    assert line.verdict == "amber"
    assert result.trust.found["creep"][0]["way"] == pytest.approx(slip * duration, rel=0.05)


def test_whole_steps_refuse_contact_that_sticks():
    settings = {"integrator": "energy-momentum", "coordinates": "absolute", "stabilisation": "none", "step": 1e-3}
    with pytest.raises(ModelError, match=r"friction_model: 'stiction' does not go with .*`friction_model: coulomb`"):
        simulate(box(0.3), duration=0.1, **settings)


def test_equilibria_have_no_friction_of_contacts():
    """As documented: the box slides to no equilibrium that friction would hold, and `linearise` asks for a smooth law."""
    with pytest.raises(ModelError, match="friction of a contact that sticks has no derivative"):
        machine(box(0.3)).linearise()


def test_a_run_starts_from_equilibrium_on_a_contact_that_sticks():
    """A box on a rail that a spring holds: it starts where the spring is free, with the overlap m g/4 K, and stays."""
    sections = box(0.3, 0.4) | {
        "joints": {"guide": {"type": "planar", "bodies": ["ground", "box"], "point": [0, 0, 0], "axis": [0, 1, 0]}}
    }
    sections["forces"]["spring"] = {
        "type": "spring-damper", "bodies": ["ground", "box"], "points": [[-1, 0, 0], [0, 0, 0]], "stiffness": 100, "free_length": 0.9
    }  # fmt: skip
    result = simulate(sections, start="equilibrium", integrator="radau", duration=0.1)
    at = result.array("box.position")
    assert at[0] == pytest.approx([-0.1, 0.0, SIZE[2] / 2 - MASS * G / (4 * STIFFNESS)], abs=2e-8)
    assert at[-1] == pytest.approx(at[0], abs=1e-9)


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_friction_leaves_alone_what_a_joint_holds(coordinates):
    """A ball on a slope rolls in a plane joint that is oblique to the tangents of its contact: 2/7 m g sin α along it, nothing across."""
    slope, turn = 0.2, 0.5
    along, across = np.array([np.cos(turn), np.sin(turn), 0.0]), [-np.sin(turn), np.cos(turn), 0.0]
    sections = box(0.5) | {
        "gravity": (G * np.sin(slope) * along - [0, 0, G * np.cos(slope)]).tolist(),
        "bodies": {"ball": {"mass": MASS, "position": [0, 0, 0.1], "shape": {"type": "sphere", "radius": 0.1}}},
        "joints": {"plane": {"type": "planar", "bodies": ["ground", "ball"], "point": [0, 0, 0.1], "axis": across}},
        "forces": {"touch": touching(0.5, body="ball", plane="floor")},
    }
    result = simulate(sections, integrator="rk4", coordinates=coordinates, step=1e-4, duration=0.1)
    friction = np.array([result.array(f"force.touch.friction_{axis}") for axis in "xyz"]).T
    assert np.abs(friction @ across).max() < 1e-5
    assert friction[-1] @ along == pytest.approx(-2.0 / 7.0 * MASS * G * np.sin(slope), rel=1e-3)


@pytest.mark.parametrize(("slope", "deeper", "count"), [(0.25, 0.0, 1), (0.15, 0.0, 0), (0.35, 0.0, 0), (0.25, 1.0, 0)])
def test_a_box_that_just_touches_a_slope_is_remarked_on(slope, deeper, count):
    """With tan 0.25 = 0.255 between 0.2 and 0.3 it would slide; with the depth that the remark gives it rests."""
    sections = box(0.2, 0.3, slope)
    depth = MASS * G * np.cos(slope) / (4 * STIFFNESS)
    sections["bodies"]["box"]["position"] = [0, 0, SIZE[2] / 2 - deeper * depth]
    found = [each.text for each in remarks(machine(sections).record) if each.place == "forces.touch"]
    assert len(found) == count
    assert all(f"place it {depth:.2g} m deeper" in each for each in found)


def test_compilation_ahead_knows_what_sticks():
    """The friction of a contact is among what a run of the machine compiles, and of one with the smooth law it is not."""
    smooth = box(0.3)
    smooth["forces"]["touch"] |= {"friction_model": "coulomb", "friction_transition_speed": 1e-3}
    entries = [{each.name for each in run_entries(plan_run(machine(each).record, ()))} for each in (box(0.3), smooth)]
    name = "nivel.kernels.elements.friction:apply.code"
    assert name in entries[0]
    assert name not in entries[1]


def test_statics_says_that_friction_of_contacts_is_none():
    sections = box(0.3) | {"joints": {"guide": slide("ground", "box", (0, 0, 1))}}
    result = machine(sections).statics()
    assert any("friction of contacts exerts no force at rest (touch)" in item.text for item in result.trust.items)


# --- moments ---
ARM, ROLLER = 2e-3, 0.1


def rolling_ball(slope=0.0, speed=0.0, spin=0.0, **more):
    """A ball that rolls without slip down the slope along X."""
    overlap = MASS * G * np.cos(slope) / STIFFNESS
    body = {"mass": MASS, "inertia": [0.4 * MASS * ROLLER**2] * 3, "shape": {"type": "sphere", "radius": ROLLER}}
    motion = {"velocity": [speed, 0, 0], "angular_velocity": [0, speed / (ROLLER - overlap), spin]}
    return {
        "gravity": [G * np.sin(slope), 0, -G * np.cos(slope)],
        "bodies": {"ball": {**body, "position": [0, 0, ROLLER - overlap], **motion}},
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1]}},
        "forces": {"touch": touching(0.8, body="ball", plane="floor", friction_work=True, **more)},
    }


@pytest.mark.parametrize(("integrator", "coordinates"), [("dopri5", "absolute"), ("generalised-alpha", "relative")])
def test_a_ball_with_rolling_resistance_stops_after_its_way(integrator, coordinates):
    """7/5 m a = b N/R: v²/(2 a) with a = 5/7 g b/R; all of 7/10 m v² is heat. The overlap makes R smaller by 2e-4 of it."""
    speed, a = 0.4, 5 / 7 * G * ARM / ROLLER
    r = simulate(
        rolling_ball(speed=speed, rolling_resistance=ARM),
        integrator=integrator,
        coordinates=coordinates,
        step=1e-3,
        duration=3.5,
    )
    place = r.array("ball.position")[:, 0]
    rolls = r.time < 0.99 * speed / a
    np.testing.assert_allclose(place[rolls], speed * r.time[rolls] - 0.5 * a * r.time[rolls] ** 2, rtol=1e-3)
    assert place[-1] == pytest.approx(speed**2 / (2 * a), rel=2e-3)
    assert np.ptp(place[r.time > 1.1 * speed / a]) < 1e-6
    assert r["force.touch.friction_work"][-1] == pytest.approx(0.7 * MASS * speed**2, rel=1e-3)
    assert r.trust.verdict == "green"


def test_a_ball_rests_on_a_slope_up_to_the_arm_by_the_radius():
    steep, flat = (
        simulate(rolling_ball(slope=x * ARM / ROLLER, rolling_resistance=ARM), integrator="dopri5", duration=1)
        for x in (2.0, 0.9)
    )
    assert abs(flat.array("ball.position")[-1, 0]) < 1e-6
    fall = 5 / 7 * G * (np.sin(2 * ARM / ROLLER) - ARM / ROLLER * np.cos(2 * ARM / ROLLER))
    assert steep.array("ball.position")[-1, 0] == pytest.approx(0.5 * fall, rel=1e-3)


def test_a_patch_radius_brakes_spin_as_an_evenly_pressed_disc_does():
    """M = 2/3 R μ N: a ball from ω rests after J ω/M. A cylinder on its end has this by itself: ω R/(4/3 μ g) = 1.274 s."""
    r = simulate(rolling_ball(spin=20.0, patch_radius=0.03), integrator="dopri5", step=1e-3, duration=1.0)
    moment, inertia = 2 / 3 * 0.03 * 0.8 * MASS * G, 0.4 * MASS * ROLLER**2
    rates = r.array("ball.angular_velocity")[:, 2]
    early = r.time < 0.99 * inertia * 20.0 / moment
    np.testing.assert_allclose(rates[early], 20.0 - moment / inertia * r.time[early], atol=2e-4)
    assert abs(rates[-1]) < 1e-9
    shape = {"type": "cylinder", "radius": 0.1, "length": 0.02, "along": "z"}
    body = {
        "mass": MASS,
        "position": [0, 0, 0.01 - MASS * G / (4 * STIFFNESS)],
        "shape": shape,
        "angular_velocity": [0, 0, 50],
    }
    disc = {**box(0.3), "bodies": {"box": body}}
    rates = (r := simulate(disc, integrator="dopri5", step=1e-3, duration=1.35)).array("box.angular_velocity")[:, 2]
    end = 50 * 0.1 / (4 / 3 * 0.3 * G)
    assert end == pytest.approx(1.274, abs=5e-4)
    np.testing.assert_allclose(
        rates[r.time < 0.99 * end], 50 * (1 - r.time[r.time < 0.99 * end] / end), rtol=1e-3, atol=1e-2
    )
    assert abs(rates[-1]) < 1e-9


def test_a_small_patch_holds_a_large_ring_against_a_torque_without_creep():
    """Torque below 2/3 R μ N: at rest the rate is zero, however much less the spin yields to r M than the slip yields to F, r²/J ≪ 1/m."""
    mass, radius, torque = 0.2, 0.03, 0.01
    assert torque < 2 / 3 * radius * 0.8 * mass * G
    load = {"type": "torque", "body": "ring", "vector": [0, 0, torque]}
    model = rolling_ball(patch_radius=radius)
    model["bodies"] = {"ring": {"mass": mass, "inertia": [0.5, 0.5, 1.0], "position": [0, 0, -mass * G / STIFFNESS]}}
    model["markers"]["tip"] = {"body": "ring", "position": [0, 0, 2.0], "shape": {"type": "sphere", "radius": 2.0}}
    model["forces"]["touch"] = touching(0.8, body="tip", plane="floor", patch_radius=radius)
    model["forces"]["load"] = load
    r = simulate(model, integrator="dopri5", step=1e-3, duration=0.2)
    assert np.abs(r.array("ring.angular_velocity")[r.time > 0.1]).max() < 1e-10
    assert r["force.touch.sticks"][-1] == 1.0


def test_moments_of_contact_need_friction_that_sticks():
    for more in ({"rolling_resistance": 0.01}, {"patch_radius": 0.01}):
        with pytest.raises(ModelError, match="belongs to `friction` with `friction_model: stiction`"):
            machine(
                {
                    **box(0.3),
                    "forces": {
                        "touch": touching(0.3, body="box", plane="floor", friction_transition_speed=1e-3, **more)
                    },
                }
            )


# --- shares ---
BALL = {"type": "sphere", "radius": 0.05}


@pytest.mark.parametrize(("integrator", "coordinates"), [("dopri5", "absolute"), ("rk4", "relative")])
def test_feet_on_a_plane_share_lateral_loads_by_least_norm(integrator, coordinates):
    """Feet at ρ from their centre under a force F and a moment M about it: each has -F/n - M ẑ × ρ/Σρ²; that this is a choice is said."""
    feet, push, turn = np.array([(0.3, 0.2), (0.3, -0.2), (-0.3, 0.2), (-0.3, -0.1)]), np.array([10.0, 4.0]), 3.0
    shapes = {f"foot_{k}": {"body": "table", "position": [*foot, -0.45], "shape": BALL} for k, foot in enumerate(feet)}
    # the normal forces carry the weight and the moment that friction at the floor has about the centre of mass
    height, weight, rows = 0.5, 8.0 * G, np.column_stack([np.ones(4), feet])
    load = np.linalg.lstsq(rows.T, [weight, 0.0, 0.0], rcond=None)[0]
    down = np.linalg.lstsq(rows, load / STIFFNESS, rcond=None)[0]
    tilt = {"axis": [down[2], -down[1], 0.0], "angle": float(np.hypot(down[1], down[2]))}
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {
            "table": {"mass": 8, "inertia": [0.3, 0.4, 0.5], "position": [0, 0, height - down[0]], "orientation": tilt}
        },
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1]}, **shapes},
        "forces": {
            **{f"touch_{k}": touching(0.8, body=f"foot_{k}", plane="floor") for k in range(4)},
            "push": {"type": "force", "body": "table", "position": [0, 0, -height], "vector": [*push, 0]},
            "turn": {"type": "torque", "body": "table", "vector": [0, 0, turn]},
        },
    }
    r = simulate(sections, integrator=integrator, coordinates=coordinates, step=5e-4, duration=0.3)
    centre = feet.mean(axis=0)
    arms, moment = feet - centre, turn - centre[0] * push[1] + centre[1] * push[0]
    expected = -push / 4 - moment * np.column_stack([-arms[:, 1], arms[:, 0]]) / np.sum(arms**2)
    found = [[r.array(f"force.touch_{k}.friction_{axis}")[-1] for axis in "xy"] for k in range(4)]
    np.testing.assert_allclose(found, expected, atol=2e-4)
    assert "touch_0, contact touch_1, contact touch_2 and contact touch_3 hold slip at rest together" in str(r.trust)
