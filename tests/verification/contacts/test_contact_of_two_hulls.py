"""Contact of two convex hulls: its energy is a volume in four dimensions, its force the derivative, its motion that of closed forms."""

import numpy as np
import pytest
from scipy.optimize import brentq, linprog
from scipy.spatial import ConvexHull, HalfspaceIntersection
from scipy.spatial.transform import Rotation

from nivel.errors import ModelError
from nivel.machine.bodies.surface import surface_text
from simulating import G, machine, simulate

pytestmark = pytest.mark.covering

K, LENGTH = 1e8, 0.05  # [N/m³], [m]
OCTAHEDRON = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
EIGHT = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
BRICK, PLATE = [0.04, 0.05, 0.06], [0.2, 0.16, 0.02]


MASS, INERTIA = 0.8, 3e-4  # of every body, whose frame is at its centre of mass


def solid(shape, **more):
    return {**({"shape": shape} if shape else {}), "mass": MASS, "inertia": [INERTIA] * 3, **more}


def box(size, **more):
    return solid({"type": "box", "size": list(size)}, **more)


def prism(**more):
    outline = [[-0.03, -0.02], [0.04, -0.03], [0.03, 0.02], [0.0, 0.05]]
    return solid({"type": "extrusion", "outline": outline, "length": 0.05, "along": "z"}, **more)


def diamond(radius, **more):
    return solid({"type": "mesh", "surface": surface_text(radius * OCTAHEDRON, np.array(EIGHT))}, **more)


def corners(size):
    return 0.5 * np.array(size) * [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]


PRISM = np.array(
    [[x, y, z] for x, y in [[-0.03, -0.02], [0.04, -0.03], [0.03, 0.02], [0.0, 0.05]] for z in (-0.025, 0.025)]
)
# bodies and the corners of their hulls
SHAPES = {
    "brick": (box(BRICK), corners(BRICK)),
    "plate": (box(PLATE), corners(PLATE)),
    "prism": (prism(), PRISM),
    "diamond": (diamond(0.04), 0.04 * OCTAHEDRON),
}


def touching(first, second, **contact):
    law = {"type": "contact", "bodies": ["a", "b"], "foundation_modulus": K, "damping": 0, **contact}
    # a body far away lets the machine be large, so that deep overlaps are taken
    return {"bodies": {"a": first, "b": second, "far": solid(None, position=[9, 0, 0])}, "forces": {"hit": law}}


def halfspaces(points, R, r):
    """Rows (n, -h) of the faces of a hull that is turned and moved."""
    equations = ConvexHull(points @ R.T + r).equations
    return equations[:, :3], -equations[:, 3]


def energy_and_depth(first, second, R, r):
    """2K ∫ d dV of the distance d to the nearest face of either hull, and twice its largest value: the volume under a concave function, by
    a hull of four dimensions, and a linear program."""
    normals, heights = (
        np.concatenate(pair) for pair in zip(halfspaces(first, np.eye(3), 0.0), halfspaces(second, R, r), strict=True)
    )
    found = linprog(
        [0, 0, 0, -1], np.column_stack([normals, np.ones(len(normals))]), heights, bounds=[(None, None)] * 4
    )
    depth = found.x[3]
    if depth <= 0.0:
        return 0.0, 2.0 * depth
    # d in units of its largest value, so that the polytope is round
    below = np.vstack([np.column_stack([normals, np.full(len(normals), depth), -heights]), [0, 0, 0, -1, 0]])
    norm = np.linalg.norm(below[:, :4], axis=1)
    inside = linprog([0, 0, 0, 0, -1], np.column_stack([below[:, :4], norm]), -below[:, 4], bounds=[(None, None)] * 5)
    vertices = HalfspaceIntersection(below, inside.x[:4]).intersections
    return 2.0 * K * ConvexHull(vertices).volume * depth, 2.0 * depth


def placed(pair, k):
    """The rotation of the second hull, and its place along a random direction where the two overlap by some millimetres."""
    random = np.random.default_rng(k)
    R = Rotation.random(random_state=k).as_matrix()
    direction = random.normal(size=3)
    direction /= np.linalg.norm(direction)
    wanted, near, far = 10.0 ** random.uniform(-3.5, -2.0), 0.0, 0.3
    for _ in range(25):
        middle = 0.5 * (near + far)
        deep = energy_and_depth(*pair, R, middle * direction)[1] > wanted
        near, far = (middle, far) if deep else (near, middle)
    return R, near * direction


def orientation(R):
    x, y, z, w = Rotation.from_matrix(R).as_quat()
    return {"euler_parameters": [w, x, y, z]}


PAIRS = [
    ("brick", "plate"),
    ("prism", "brick"),
    ("diamond", "diamond"),
    ("plate", "diamond"),
    ("prism", "prism"),
    ("brick", "brick"),
]


@pytest.mark.parametrize("seed", [0, *(pytest.param(k, marks=pytest.mark.full) for k in range(1, 12))])
@pytest.mark.parametrize("names", PAIRS)
def test_the_force_is_the_derivative_of_the_energy_of_the_overlap(names, seed):
    """Against volumes in four dimensions, and their differences along all six motions of the second body (fourth order)."""
    (first, p), (second, q) = SHAPES[names[0]], SHAPES[names[1]]
    R, r = placed((p, q), 7 * seed + len(names[0]))
    second = {**second, "position": r.tolist(), "orientation": orientation(R)}
    result = simulate(touching(first, second), duration=1e-6, step=1e-6)
    energy, depth = energy_and_depth(p, q, R, r)
    assert result.array("potential_energy")[0] == pytest.approx(energy, rel=1e-7)
    assert result.array("force.hit.depth")[0] == pytest.approx(depth, rel=1e-8)
    force, h = np.zeros(6), 1e-3 * depth
    for i in range(6):
        e, values = np.eye(3)[i % 3], []
        for times in (-2, -1, 1, 2):
            turn = np.eye(3) if i < 3 else Rotation.from_rotvec(times * h / LENGTH * e).as_matrix()
            values.append(energy_and_depth(p, q, turn @ R, turn @ (r + (times * h * e if i < 3 else 0.0)))[0])
        slope = (values[0] - 8 * values[1] + 8 * values[2] - values[3]) / 12
        force[i] = -slope / (h if i < 3 else h / LENGTH)
    for name, sign in (("b", 1.0), ("a", -1.0)):
        pushed = MASS * result.array(f"{name}.acceleration")[0]
        torque = INERTIA * result.array(f"{name}.angular_acceleration")[0] + np.cross(
            result.array(f"{name}.position")[0], pushed
        )
        np.testing.assert_allclose(sign * pushed, force[:3], atol=1e-6 * np.abs(force[:3]).max())
        np.testing.assert_allclose(sign * torque, force[3:], atol=1e-6 * LENGTH * np.abs(force[:3]).max())


@pytest.mark.parametrize("turn", [(1.2e-5, -9e-3), (0.0, 1e-6), (3e-4, 1e-17), (1e-2, 1e-8)])
def test_a_box_that_is_hardly_tilted_touches_with_its_edge_and_corner(turn):
    """A tenth of a micrometre deep: what overlaps is long and thin, and round-off of heights reaches far along the slope."""
    R, plate, brick = Rotation.from_rotvec([*turn, 0]).as_matrix(), SHAPES["plate"][1], SHAPES["brick"][1]
    r = np.array([0.013, 0.007, 0.01 - (brick @ R.T)[:, 2].min() - 1e-7])
    upper = box(BRICK, position=r.tolist(), orientation=orientation(R))
    result = simulate(touching(box(PLATE), upper), duration=1e-6, step=1e-6)
    energy, depth = energy_and_depth(plate, brick, R, r)
    assert result.array("force.hit.depth")[0] == pytest.approx(depth, rel=1e-5)
    assert result.array("potential_energy")[0] == pytest.approx(energy, rel=1e-4)


def test_a_box_on_a_larger_one_presses_by_closed_form():
    """At the depth s of a surface inside both, a footprint (a - 2s)(b - 2s) is left: F = K ∫₀^δ (a - t)(b - t) dt."""
    a, b, _ = BRICK
    delta = 3e-3
    lower, upper = box(PLATE), box(BRICK, position=[0.01, 0.02, 0.01 + 0.03 - delta])
    result = simulate(touching(lower, upper), duration=1e-6, step=1e-6)
    force = K * (a * b * delta - (a + b) * delta**2 / 2 + delta**3 / 3)
    assert result.array("force.hit.normal_force")[0] == pytest.approx(force, rel=1e-9)
    assert result.array("force.hit.depth")[0] == pytest.approx(delta, rel=1e-9)
    np.testing.assert_allclose(result.array("b.acceleration")[0], [0, 0, force / MASS], atol=1e-9 * force / MASS)


def test_boxes_in_line_with_each_other_press_as_one_box():
    """Four faces of one lie in the planes of four of the other: the nearest face is in doubt everywhere, and the force is not."""
    a, b, _ = BRICK
    delta = 1e-3
    result = simulate(touching(box(BRICK), box(BRICK, position=[0, 0, 0.06 - delta])), duration=1e-6, step=1e-6)
    force = K * (a * b * delta - (a + b) * delta**2 / 2 + delta**3 / 3)
    assert result.array("force.hit.normal_force")[0] == pytest.approx(force, rel=1e-9)
    np.testing.assert_allclose(result.array("b.acceleration")[0, :2], 0.0, atol=1e-3 * force / MASS * delta / a)


THROWN = touching(
    box(BRICK, velocity=[0, 0, 1], angular_velocity=[1, 2, 0.5]),
    box([0.06, 0.03, 0.05], position=[0.01, 0.005, 0.075], angular_velocity=[-3, 1, 0]),
)


@pytest.mark.parametrize(
    "settings",
    [
        {"step": 2e-5},
        *({"integrator": name, "tolerance": 1e-8} for name in ("dopri5", "dop853", "adams", "radau", "bdf")),
    ],
    ids=lambda settings: settings.get("integrator", "rk4"),
)
def test_boxes_that_bounce_off_centre_keep_energy_and_momentum(settings):
    """Corners, edges and faces meet while both bodies turn."""
    result = simulate(THROWN, duration=0.1, output_interval=1e-3, **settings)
    assert result.array("force.hit.depth").max() > 1e-3
    energy = result.array("kinetic_energy") + result.array("potential_energy")
    np.testing.assert_allclose(energy, energy[0], rtol=1e-7)
    v, w, x = (result.array(name) for name in ("velocity", "angular_velocity", "position"))
    np.testing.assert_allclose(MASS * v.sum(axis=1), np.tile([0, 0, MASS], (len(v), 1)), atol=1e-10)
    spin = (INERTIA * w + MASS * np.cross(x, v)).sum(axis=1)  # the far one is at rest
    np.testing.assert_allclose(spin, np.tile(spin[0], (len(v), 1)), atol=1e-9)
    assert abs(w[-1] - w[0]).max() > 1.0


@pytest.mark.parametrize(
    "settings",
    [{"integrator": "rk4", "step": 1e-5}, {"integrator": "dopri5", "tolerance": 1e-9}],
    ids=["rk4", "dopri5"],
)
@pytest.mark.parametrize("shape", ["corner", "face", "edges"])
def test_a_central_impact_leaves_with_the_given_share_of_its_speed(shape, settings):
    """Whatever meets: m v dv = -F (1 + a v) dδ, so e v with ln((1 + x)/(1 - e x)) = x (1 + e), x = a v (integrate); and no turning."""
    e, speed = 0.6, 0.7
    x = brentq(lambda x: np.log((1 + x) / (1 - e * x)) - x * (1 + e), 0.1, 0.99 / e)
    quarter = {"axis": [0, 0, 1], "angle": np.pi / 2}
    tilted = {"axis": [1, 0, 0], "angle": np.pi / 4}
    lower, upper, place = {
        "corner": (box(PLATE), diamond(0.04), 0.01 + 0.04),
        "face": (box(PLATE), box(BRICK), 0.01 + 0.03),
        "edges": (
            box([0.2, 0.04, 0.04], orientation=tilted),
            box([0.2, 0.04, 0.04], orientation={"axis": [0, 1, 0], "angle": np.pi / 4}),
            0.0,
        ),
    }[shape]
    if shape == "edges":  # two square bars that lie across each other, on edge
        upper = solid(
            {"type": "extrusion", "outline": [[-0.03, 0], [0, -0.03], [0.03, 0], [0, 0.03]], "length": 0.2},
            orientation=quarter,
        )
        lower = solid({"type": "extrusion", "outline": [[-0.03, 0], [0, -0.03], [0.03, 0], [0, 0.03]], "length": 0.2})
        place = 0.06
    upper |= {"position": [0, 0, place + 1e-4], "velocity": [0.3, 0.2, -speed]}
    lower |= {"velocity": [0.3, 0.2, 0]}
    modulus = 1e8 if shape == "face" else 1e10  # corners and edges are soft where they begin to touch
    contact = touching(lower, upper, damping=x / speed, foundation_modulus=modulus)
    result = simulate(contact, duration=0.04, **settings)
    v = result.array("velocity")[-1]
    np.testing.assert_allclose(v[1] - v[0], [0, 0, e * speed], atol=1e-6)
    np.testing.assert_allclose(result.array("angular_velocity")[-1], 0.0, atol=1e-6)


def on_slope(angle, **contact):
    """A brick on a slope that rises along x, at rest in its depth."""
    R = Rotation.from_rotvec([0, -angle, 0])
    slope = {"axis": [0, -1, 0], "angle": angle}
    load = MASS * G * np.cos(angle)
    a, b, c = BRICK
    delta = load / (K * a * b)
    for _ in range(20):
        delta -= (K * (a * b * delta - (a + b) * delta**2 / 2 + delta**3 / 3) - load) / (K * (a - delta) * (b - delta))
    up = R.apply([0.05, 0, 0.01 + c / 2 - delta])
    sections = touching(
        box([0.6, 0.2, 0.02], orientation=slope), box(BRICK, orientation=slope, position=up.tolist()), **contact
    )
    sections["joints"] = {"held": {"type": "fixed", "bodies": ["ground", "a"], "point": [0, 0, 0]}}
    return {**sections, "gravity": [0, 0, -G]}, R


def test_a_brick_slides_down_a_slope_against_the_friction_of_its_weight():
    """g (sin α - μ cos α) with a sliding speed far above the transition; pressure is larger in front, the sum is not."""
    angle, mu = 0.5, 0.2
    sections, R = on_slope(angle, friction=mu, friction_model="coulomb", friction_transition_speed=1e-4, damping=500)
    sections["bodies"]["b"]["velocity"] = R.apply([-0.2, 0, 0]).tolist()
    result = simulate(sections, duration=0.1, step=2e-5, output_interval=1e-2)
    speed = -R.inv().apply(result.array("b.velocity"))[:, 0]
    expected = 0.2 + G * (np.sin(angle) - mu * np.cos(angle)) * np.array(result.time)
    np.testing.assert_allclose(speed, expected, rtol=3e-4)


def test_a_spinning_brick_is_braked_by_the_friction_of_all_its_points():
    """μ p ∫ r dA over a rectangle a by b: the mean distance from its middle, √(a² + b²)/6 + …, here by a grid of points."""
    mu = 0.2
    sections, _ = on_slope(0.0, friction=mu, friction_model="coulomb", friction_transition_speed=1e-4, damping=500)
    sections["bodies"]["b"] |= {
        "angular_velocity": [0, 0, 50],
        "position": [0, 0, sections["bodies"]["b"]["position"][2]],
    }
    result = simulate(sections, duration=1e-3, step=1e-5)
    a, b, _ = BRICK
    x, y = np.meshgrid((np.arange(400) + 0.5) / 400 - 0.5, (np.arange(400) + 0.5) / 400 - 0.5)
    torque = mu * MASS * G * np.hypot(a * x, b * y).mean()
    assert -INERTIA * result.array("b.angular_acceleration")[0, 2] == pytest.approx(torque, rel=0.01)


def test_a_stack_of_bricks_comes_to_rest_under_its_weight():
    """Each contact carries what is above it, in planes that are common to two bodies and off centre."""
    bodies = {"table": box([0.4, 0.4, 0.02]), "one": box(BRICK, position=[0, 0, 0.04])}
    bodies["two"] = box(BRICK, position=[0.004, 0, 0.1])
    law = {"type": "contact", "foundation_modulus": K, "damping": 200}
    law |= {"friction": 0.5, "friction_model": "coulomb", "friction_transition_speed": 5e-3}
    pairs = {"lower": ["table", "one"], "upper": ["one", "two"]}
    sections = {
        "gravity": [0, 0, -G],
        "bodies": bodies,
        "joints": {"held": {"type": "fixed", "bodies": ["ground", "table"], "point": [0, 0, 0]}},
        "forces": {name: {**law, "bodies": pair} for name, pair in pairs.items()},
    }
    result = simulate(sections, duration=0.2, step=2.5e-5, output_interval=1e-2)
    for name, above in (("lower", 2), ("upper", 1)):
        assert result.array(f"force.{name}.normal_force")[-1] == pytest.approx(above * MASS * G, rel=1e-3)


def test_what_two_hulls_are_not_is_told():
    ball = solid({"type": "sphere", "radius": 0.1}, position=[1, 0, 0])
    cases = [
        (
            touching(box(BRICK), ball),
            r"is for two of box, cylinder, extrusion, mesh; what touches a sphere, capsule or ellipsoid takes a `stiffness`",
        ),
        (
            touching(box(BRICK), box(PLATE), stiffness=1e5),
            "`stiffness` is not for two of box, cylinder, extrusion, mesh: give `foundation_modulus",
        ),
        (
            touching(ball, {**ball}, foundation_modulus=1e9),
            "is for two of box, cylinder, extrusion, mesh; what touches a sphere, capsule or ellipsoid takes a `stiffness`",
        ),
        (touching(box(BRICK), box(PLATE), foundation_modulus="3 N/m"), r"a foundation modulus .N/m\^3. was expected"),
    ]
    for sections, said in cases:
        with pytest.raises(ModelError, match=said):
            machine(sections)
    without = touching(box(BRICK), box(PLATE))
    del without["forces"]["hit"]["foundation_modulus"]
    with pytest.raises(ModelError, match="two boxes, cylinders, extrusions or meshes need a `foundation_modulus`"):
        machine(without)


def test_a_hull_of_too_many_faces_or_none_is_refused():
    random = np.random.default_rng(1)
    points = random.normal(size=(200, 3))
    points *= 0.05 / np.linalg.norm(points, axis=1)[:, None]
    many = surface_text(points, ConvexHull(points).simplices)
    with pytest.raises(ModelError, match="a hull of 396 faces, and at most 200 can touch another body"):
        simulate(touching(box(BRICK), solid({"type": "mesh", "surface": many})), duration=1e-3, step=1e-3)
    flat = surface_text(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]]))
    with pytest.raises(ModelError, match="is flat, and a contact of two bodies needs two solids"):
        simulate(touching(box(BRICK), solid({"type": "mesh", "surface": flat})), duration=1e-3, step=1e-3)


@pytest.mark.parametrize("step", [1e-3, 2e-6])
def test_a_brick_that_steps_carry_through_a_plate_is_told(step):
    """40 cm a step through 2 cm of plate, red in place of green; shorter steps throw it back."""
    brick = box(BRICK, position=[0, 0, 0.25], velocity=[1.0, 0, -400.0], angular_velocity=[0, 3, 0])
    sections = touching(box(PLATE), brick, foundation_modulus=1e12)
    trust = (
        machine({**sections, "simulation": {"duration": 2e-3, "step": step, "integrator": "rk4"}})
        .simulate(verify=True)
        .trust
    )
    told = [each for each in trust.items if each.name == "contact"]
    if step == 1e-3:
        assert trust.verdict == "red"
        assert told[0].verdict == "red"
        assert "a and b pass through each other" in told[0].text
        assert 0.21 / 400 < told[0].time < 0.29 / 400
    else:
        assert not told
