"""Static equilibria against closed forms: positions, loads at limit points, buckling loads, frequencies about loaded states."""

import json

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar
from scipy.spatial.transform import Rotation

from nivel.errors import SolveError
from simulating import G, hinge, machine, slide, solid

pytestmark = pytest.mark.covering

BOTH = pytest.mark.parametrize("coordinates", ["absolute", "relative"])
# Newton's iteration ends quadratically below a change of 1e-10; what is left is the round-off of exact tangents
EXACT = 1e-12


def hanging_mass(stiffness=500.0, mass=2.0):
    return {
        "gravity": [0, -G, 0],
        "bodies": {"block": solid(mass, 0.1)},
        "joints": {"guide": slide("ground", "block", (0, 1, 0))},
        "forces": {
            "spring": {
                "type": "joint-spring-damper",
                "coordinate": "guide.displacement",
                "stiffness": stiffness,
                "damping": 3.0,
            }
        },
    }


@BOTH
def test_mass_on_a_spring_hangs_at_its_weight_over_the_stiffness(coordinates):
    result = machine(hanging_mass()).statics(coordinates=coordinates, modes=1)
    assert result.array("guide.displacement")[0] == pytest.approx(-2.0 * G / 500.0, abs=EXACT)
    assert result.trust.verdict == "green"
    # ω² = k/m, decay c/2m: s² + 1.5 s + 250 = 0
    assert result.array("vibration_stiffness")[0, 0] == pytest.approx(250.0, rel=1e-12)
    assert result.array("natural_frequency")[0, 0] == pytest.approx(np.sqrt(250.0) / (2 * np.pi), rel=1e-12)
    assert result.array("decay_rate")[0, 0] == pytest.approx(0.75, rel=1e-10)
    assert result.array("damped_frequency")[0, 0] == pytest.approx(np.sqrt(250 - 0.75**2) / (2 * np.pi), rel=1e-10)
    # the mode moves the block along y alone, by 1/√m
    assert np.abs(result.array("mode_shift")[0, 0, 0]) == pytest.approx([0, 2.0**-0.5, 0], abs=1e-12)


def torsion_pendulum(stiffness, start=0.0, mass=2.0, arm=0.5, inertia=0.1):
    place = [arm * np.cos(start), arm * np.sin(start), 0]
    return {
        "gravity": [0, -G, 0],
        "bodies": {"arm": solid(mass, inertia, position=place)},
        "joints": {"pin": hinge("ground", "arm")},
        "forces": {"coil": {"type": "joint-spring-damper", "coordinate": "pin.angle", "stiffness": stiffness}},
    }


@BOTH
@pytest.mark.parametrize("stiffness", [6.0, 20.0])
def test_pendulum_on_a_torsion_spring(coordinates, stiffness):
    """k φ + m g l cos φ = 0 with φ from the horizontal; ω² = (k - m g l sin φ)/(J + m l²)."""
    result = machine(torsion_pendulum(stiffness)).statics(coordinates=coordinates, modes=1)
    load = 2.0 * G * 0.5
    angle = brentq(lambda a: stiffness * a + load * np.cos(a), -2.0, 0.0, xtol=1e-15)
    assert result.array("pin.angle")[0] == pytest.approx(angle, abs=EXACT)
    omega = np.sqrt((stiffness - load * np.sin(angle)) / (0.1 + 2.0 * 0.25))
    assert 2 * np.pi * result.array("natural_frequency")[0, 0] == pytest.approx(omega, rel=1e-10)
    np.testing.assert_allclose(result.array("joint_force")[0, 0], [0, -2.0 * G, 0], atol=1e-10)


@pytest.mark.parametrize("start", [0.3, 2.0, -2.8])
def test_free_pendulum_settles_at_its_lowest_point_from_anywhere(start):
    result = machine(torsion_pendulum(1e-9, start)).statics()
    np.testing.assert_allclose(result.array("arm.position")[0], [0, -0.5, 0], atol=1e-8)


def test_a_pendulum_settles_from_where_its_first_step_is_singular():
    """Started upwards of level its stiffness is -1 in units of itself, which the first stiffness added, 1, takes away up to round-off."""
    for start in np.linspace(-0.6, -0.4, 9):
        body = solid(1.0, 1e-9, position=[-1, 0, 0])
        joint = {**hinge("ground", "bob"), "start": {"angle": start}}
        sections = {
            "gravity": [0, -G, 0],
            "bodies": {"bob": body},
            "joints": {"hinge": joint},
            "assembly": {"largest_gap": 9},
        }
        r = machine(sections).statics(duration=0.0)
        np.testing.assert_allclose(r.array("bob.position")[-1], [0, -1, 0], atol=1e-9)


def test_inverted_pendulum_stays_where_it_is_drawn_and_is_told_unstable():
    """ω² = (k - m g l)/(m l² + J), negative for a weak spring."""
    for stiffness, unstable in ((5.0, 1), (15.0, 0)):
        result = machine(torsion_pendulum(stiffness, np.pi / 2)).statics(modes=1)
        np.testing.assert_allclose(result.array("arm.position")[0], [0, 0.5, 0], atol=EXACT)
        assert result.array("unstable_directions")[0] == unstable
        expected = (stiffness - 2.0 * G * 0.5) / (0.1 + 2.0 * 0.25)
        assert result.array("vibration_stiffness")[0, 0] == pytest.approx(expected, rel=1e-9)
    assert "stable" in next(item.text for item in result.trust.items if item.name == "stability")


# --- snap-through: von Mises truss ---

A, H, K = 1.0, 0.3, 1000.0
L0 = np.hypot(A, H)


def truss_load(y):
    """Downward load in equilibrium with the apex at the height y."""
    return 2 * K * (L0 / np.hypot(A, y) - 1) * y


# dP/dy = 0 where l³ = l₀ a²
LIMIT_HEIGHT = np.sqrt((L0 * A * A) ** (2 / 3) - A * A)


def truss(load="-100*time", size=1.0, force=1.0, **more):
    """The truss; size : of a metre in its unit of length, force : of a newton in its own."""

    def spring(x):
        return {
            "type": "spring-damper",
            "bodies": ["ground", "apex"],
            "points": [[x * size, 0, 0], [0, H * size, 0]],
            "stiffness": K * force / size,
            "free_length": L0 * size,
        }

    forces = {"left": spring(-A), "right": spring(A)}
    forces["load"] = {"type": "force", "body": "apex", "vector": [0, load, 0]}
    return {
        "bodies": {"apex": solid(force, 0.1 * force * size**2, position=[0, H * size, 0])},
        "joints": {"guide": slide("ground", "apex", (0, 1, 0), point=[0, H * size, 0])},
        "forces": forces,
        **more,
    }


@BOTH
def test_arc_length_passes_both_limit_points_of_the_truss(coordinates):
    result = machine(truss()).statics(duration=1, step=0.02, arc_length=True, coordinates=coordinates)
    y = result.array("apex.position")[:, 1]
    np.testing.assert_allclose(truss_load(y), 100 * result.time, atol=1e-9)
    assert [event.name for event in result.events] == ["limit point", "limit point"]
    limit = truss_load(LIMIT_HEIGHT) / 100
    np.testing.assert_allclose([event.time for event in result.events], [limit, -limit], rtol=1e-9)
    assert result.time[-1] == 1.0
    assert y[-1] < -H
    assert np.all(np.diff(y) < 0)
    assert np.all(np.diff(result.array("path")) > 0)
    # unstable between the limit points, and nowhere else
    inside = np.abs(y) < LIMIT_HEIGHT - 1e-6
    np.testing.assert_array_equal(result.array("unstable_directions")[inside], 1)
    np.testing.assert_array_equal(result.array("unstable_directions")[np.abs(y) > LIMIT_HEIGHT + 1e-6], 0)


def test_load_steps_end_at_the_limit_point_and_say_so():
    with pytest.raises(SolveError, match=r"limit point at t = 0\.0994991696 s") as caught:
        machine(truss()).statics(duration=1, step=0.05)
    assert "--arc-length" in caught.value.advice
    states = caught.value.result
    limit = truss_load(LIMIT_HEIGHT) / 100
    assert limit - 1e-4 < states.time[-1] < limit
    np.testing.assert_allclose(truss_load(states.array("apex.position")[:, 1]), 100 * states.time, atol=1e-9)
    assert states.outcome == "failed"


def test_displacement_control_passes_the_limit_points():
    """A driver moves the apex: its effort is the load, and its speed, which is not zero, does not enter."""
    sections = truss(load=0.0)
    sections["drivers"] = {"push": {"coordinate": "guide.displacement", "value": "-0.7*time"}}
    result = machine(sections).statics(duration=1, step=0.05)
    y = H - 0.7 * result.time
    np.testing.assert_allclose(result.array("apex.position")[:, 1], y, atol=EXACT)
    np.testing.assert_allclose(result.array("driver.push.effort"), -truss_load(y), atol=1e-9)
    assert len(result.time) == 21


def test_units_do_not_matter():
    """The truss in millimetres and kilonewtons, in numbers: the same iterations, the same load factors."""
    plain = machine(truss()).statics(duration=1, step=0.02, arc_length=True)
    scaled = machine(truss(load="-0.1*time", size=1e3, force=1e-3)).statics(duration=1, step=0.02, arc_length=True)
    assert plain.timing["iterations"] == scaled.timing["iterations"]
    np.testing.assert_allclose(scaled.time, plain.time, rtol=1e-9, atol=1e-11)
    np.testing.assert_allclose(scaled.array("apex.position") / 1e3, plain.array("apex.position"), atol=1e-10)


# --- buckling: Euler's column of rigid links and torsion springs ---


def column(links, stiffness=2.0, length=1.0, load="-20*time", offset=0.0):
    """A column along y, pinned below, guided on the y axis above, with springs between its links."""
    each = length / links
    bodies = {f"b{k}": solid(0.1, 0.01, position=[0, (k + 0.5) * each, 0]) for k in range(links)}
    joints = {"foot": hinge("ground", "b0")}
    forces = {}
    for k in range(1, links):
        joints[f"j{k}"] = hinge(f"b{k - 1}", f"b{k}", (0, k * each, 0))
        forces[f"s{k}"] = {"type": "joint-spring-damper", "coordinate": f"j{k}.angle", "stiffness": stiffness}
    joints["head"] = {
        "type": "point-on-line",
        "bodies": ["ground", f"b{links - 1}"],
        "point": [0, length, 0],
        "axis": [0, 1, 0],
    }
    point = [offset, 0.5 * each, 0]
    forces["load"] = {"type": "force", "body": f"b{links - 1}", "position": point, "vector": [0, load, 0]}
    return {"bodies": bodies, "joints": joints, "forces": forces}


def discrete_euler(links, stiffness, length, mode=1):
    """Links of length a with springs k between them: P = (4 k/a) sin²(m π/2n)."""
    return 4 * stiffness * links / length * np.sin(mode * np.pi / (2 * links)) ** 2


@pytest.mark.parametrize("links", [2, 3, 6])
@BOTH
def test_column_buckles_at_the_discrete_euler_load(links, coordinates):
    P = discrete_euler(links, 2.0, 1.0)
    load = f"-{0.6 * P}*time"
    result = machine(column(links, load=load)).statics(duration=0.5, step=0.25, buckling=1, coordinates=coordinates)
    found = json.loads(result.attributes["buckling"])
    assert found[0]["time"] == pytest.approx(1 / 0.6, rel=1e-9)
    # and exactly, on the path of the straight column
    passed = machine(column(links, load=f"-{1.3 * P}*time")).statics(duration=1, step=0.3, coordinates=coordinates)
    assert [event.name for event in passed.events] == ["bifurcation"]
    assert passed.events[0].time == pytest.approx(1 / 1.3, rel=1e-8)
    assert passed.array("unstable_directions")[-1] == 1


def test_several_buckling_loads():
    result = machine(column(6, load="-1*time")).statics(duration=1, step=1, buckling=3)
    found = [each["time"] for each in json.loads(result.attributes["buckling"])]
    np.testing.assert_allclose(found, [discrete_euler(6, 2.0, 1.0, mode) for mode in (1, 2, 3)], rtol=1e-9)


# --- a chain of many links ---


def chain(links, span=0.8, length=1.0, mass=1.0):
    """Links between two points of one height, drawn as a V."""
    each = length / links
    depth = 0.5 * np.sqrt(length**2 - span**2)
    ends = np.array([[span * k / links, -depth * (1 - abs(2 * k / links - 1)), 0] for k in range(links + 1)])
    bodies, joints = {}, {}
    for k in range(links):
        along = ends[k + 1] - ends[k]
        bodies[f"b{k}"] = solid(
            mass / links,
            0.01 * each**2 * mass,
            position=(0.5 * (ends[k] + ends[k + 1])).tolist(),
            orientation={"axis": [0, 0, 1], "angle": float(np.arctan2(along[1], along[0]))},
        )
        joints[f"j{k}"] = hinge("ground" if k == 0 else f"b{k - 1}", f"b{k}", tuple(ends[k]))
    joints["end"] = {
        "type": "point-on-line",
        "bodies": ["ground", f"b{links - 1}"],
        "point": ends[-1].tolist(),
        "axis": [0, 0, 1],
    }
    return {"gravity": [0, -G, 0], "bodies": bodies, "joints": joints}


def discrete_catenary(links, span, length, mass):
    """Angles of the links: tan φ_k = (V - (k + ½) w)/(-H), with the horizontal pull that closes the span; by symmetry V = W/2."""
    weights = mass * G * (np.arange(links) + 0.5) / links - 0.5 * mass * G

    def gap(pull):
        return np.sum(np.cos(np.arctan2(weights, pull))) * length / links - span

    pull = brentq(gap, 1e-6, 1e4, xtol=1e-14, rtol=1e-14)
    return np.arctan2(weights, pull), pull


@pytest.mark.parametrize(
    ("links", "coordinates"), [(8, "relative"), (8, "absolute"), (40, "relative"), (100, "absolute")]
)
def test_chain_hangs_in_the_discrete_catenary(links, coordinates):
    result = machine(chain(links)).statics(coordinates=coordinates)
    angles, pull = discrete_catenary(links, 0.8, 1.0, 1.0)
    each = 1.0 / links
    x = np.cumsum(each * np.cos(angles)) - 0.5 * each * np.cos(angles)
    y = np.cumsum(each * np.sin(angles)) - 0.5 * each * np.sin(angles)
    np.testing.assert_allclose(result.array("position")[0, :, :2], np.column_stack([x, y]), atol=1e-9)
    np.testing.assert_allclose(np.abs(result.array("j0.force")[0, 0]), pull, rtol=1e-8)
    assert result.array("unstable_directions")[0] == 0


# --- frequencies ---


@BOTH
def test_frequencies_of_a_chain_of_masses_and_springs(coordinates):
    """n equal masses between springs, fixed at both ends: ω_k = 2 √(k/m) sin(k π/(2 (n + 1)))."""
    n, k, m = 5, 700.0, 0.4
    bodies = {f"m{i}": solid(m, 0.01, position=[float(i + 1), 0, 0]) for i in range(n)}
    joints = {f"g{i}": slide("ground", f"m{i}", point=[float(i + 1), 0, 0]) for i in range(n)}
    names = ["ground", *bodies, "ground"]
    forces = {
        f"k{i}": {
            "type": "spring-damper",
            "bodies": [names[i], names[i + 1]],
            "points": [[float(i), 0, 0], [float(i + 1), 0, 0]],
            "stiffness": k,
            "free_length": 1.0,
        }
        for i in range(n + 1)
    }
    result = machine({"bodies": bodies, "joints": joints, "forces": forces}).statics(coordinates=coordinates, modes=n)
    expected = 2 * np.sqrt(k / m) * np.sin(np.arange(1, n + 1) * np.pi / (2 * (n + 1)))
    np.testing.assert_allclose(2 * np.pi * result.array("natural_frequency")[0], expected, rtol=1e-10)


def test_tension_stiffens_a_string_of_masses():
    """n masses on a string under the pull T, spaced by a: ω_k = 2 √(T/(m a)) sin(k π/(2 (n + 1))), across it, twice each."""
    n, a, m, pull = 4, 0.25, 0.2, 30.0
    bodies = {f"m{i}": {"point_mass": True, "mass": m, "position": [a * (i + 1), 0, 0]} for i in range(n)}
    names = ["ground", *bodies, "ground"]
    forces = {
        f"k{i}": {
            "type": "spring-damper",
            "bodies": [names[i], names[i + 1]],
            "points": [[a * i, 0, 0], [a * (i + 1), 0, 0]],
            "stiffness": 1e5,
            "free_length": a - pull / 1e5,
        }
        for i in range(n + 1)
    }
    result = machine({"bodies": bodies, "forces": forces}).statics(modes=2 * n)
    across = 2 * np.sqrt(pull / (m * a)) * np.sin(np.arange(1, n + 1) * np.pi / (2 * (n + 1)))
    np.testing.assert_allclose(2 * np.pi * result.array("natural_frequency")[0], np.repeat(across, 2), rtol=1e-9)


@BOTH
def test_free_machines_have_rigid_vibrations_that_are_counted(coordinates):
    """Two masses with a spring between them, free on a rail: ω² = 0 and k (1/m + 1/M)."""
    sections = {
        "bodies": {"a": solid(2.0, 0.1), "b": solid(3.0, 0.1, position=[1, 0, 0])},
        "joints": {"ra": slide("ground", "a"), "rb": slide("ground", "b", point=[1, 0, 0])},
        "forces": {
            "s": {
                "type": "spring-damper",
                "bodies": ["a", "b"],
                "points": [[0, 0, 0], [1, 0, 0]],
                "stiffness": 600.0,
                "free_length": 1.0,
            }
        },
    }
    result = machine(sections).statics(coordinates=coordinates, modes=2)
    np.testing.assert_allclose(result.array("vibration_stiffness")[0], [0, 600 / 2 + 600 / 3], atol=1e-10)
    assert "1 with frequency zero" in next(item.text for item in result.trust.items if item.name == "vibrations")
    with pytest.raises(SolveError, match="no stiffness"):
        machine(sections).statics(coordinates=coordinates)


# --- closed loops ---


def four_bar(q=0.9):
    """Ground 1.2, crank 0.5, coupler 1.0, rocker 0.8; a spring on the crank and one across; gravity."""
    g, c = 1.2, 0.5
    P = np.array([c * np.cos(q), c * np.sin(q)])
    R = loop(q)
    far = np.array([g, 0.0])

    def bar(p, s, mass):
        middle = 0.5 * (p + s)
        return solid(mass, 0.05, position=[*middle.tolist(), 0.0])

    bodies = {"crank": bar(np.zeros(2), P, 1.0), "coupler": bar(P, R, 2.0), "rocker": bar(R, far, 1.5)}
    joints = {
        "foot": hinge("ground", "crank"),
        "pin": {"type": "spherical", "bodies": ["crank", "coupler"], "point": [*P.tolist(), 0]},
        "knee": {"type": "cylindrical", "bodies": ["coupler", "rocker"], "point": [*R.tolist(), 0], "axis": [0, 0, 1]},
        "pivot": hinge("ground", "rocker", (g, 0, 0)),
    }
    forces = {
        "across": {
            "type": "spring-damper",
            "bodies": ["crank", "rocker"],
            "points": [[*P.tolist(), 0], [*far.tolist(), 0]],
            "stiffness": 200.0,
            "free_length": 1.1,
        }
    }
    return {"gravity": [0, -G, 0], "bodies": bodies, "joints": joints, "forces": forces}


def loop(q):
    """Place of the knee for the crank's angle: the upper one."""
    g, c, b, r = 1.2, 0.5, 1.0, 0.8
    P, far = np.array([c * np.cos(q), c * np.sin(q)]), np.array([g, 0.0])
    d = far - P
    length = np.linalg.norm(d)
    along = (length**2 + b**2 - r**2) / (2 * length)
    return P + along * d / length + np.sqrt(b**2 - along**2) * np.array([-d[1], d[0]]) / length


def loop_energy(q):
    P, far = 0.5 * np.array([np.cos(q), np.sin(q)]), np.array([1.2, 0.0])
    R = loop(q)
    height = 1.0 * P[1] / 2 + 2.0 * (P[1] + R[1]) / 2 + 1.5 * R[1] / 2
    return G * height + 0.5 * 200.0 * (np.linalg.norm(P - far) - 1.1) ** 2


@BOTH
def test_four_bar_rests_where_its_potential_energy_is_least(coordinates):
    result = machine(four_bar()).statics(coordinates=coordinates)
    x, y = 2 * result.array("crank.position")[0, :2]
    angle = np.arctan2(y, x)
    least = minimize_scalar(loop_energy, bracket=(angle - 0.3, angle + 0.3), tol=1e-12).x
    # the least value of a function is known to the root of round-off; its slope to more
    exact = brentq(lambda a: loop_energy(a + 1e-4) - loop_energy(a - 1e-4), least - 1e-3, least + 1e-3, xtol=1e-14)
    assert angle == pytest.approx(exact, abs=1e-7)
    assert result.array("unstable_directions")[0] == 0


def test_coordinates_do_not_matter():
    found = [machine(four_bar()).statics(coordinates=each, modes=1) for each in ("absolute", "relative")]
    np.testing.assert_allclose(found[0].array("position"), found[1].array("position"), atol=1e-10)
    np.testing.assert_allclose(found[0].array("joint_force"), found[1].array("joint_force"), atol=1e-8)
    np.testing.assert_allclose(found[0].array("natural_frequency"), found[1].array("natural_frequency"), rtol=1e-9)
    np.testing.assert_allclose(found[0].array("potential_energy"), found[1].array("potential_energy"), rtol=1e-12)


# --- large rotations ---


def clamped_chain(links, stiffness, joined, tip):
    """Links of 1/links m along x from a clamp; each turns against the one before about z with `stiffness`; `tip` loads the last."""
    each = 1.0 / links
    bodies = {f"b{k}": solid(0.01, 1e-5, position=[(k + 0.5) * each, 0, 0]) for k in range(links)}
    joints, forces = {}, {"tip": {"body": f"b{links - 1}", **tip}}
    for k in range(links):
        pair, point = ["ground" if k == 0 else f"b{k - 1}", f"b{k}"], [k * each, 0, 0]
        if joined == "hinges":
            joints[f"j{k}"] = hinge(*pair, tuple(point))
            forces[f"s{k}"] = {"type": "joint-spring-damper", "coordinate": f"j{k}.angle", "stiffness": stiffness}
        else:
            forces[f"s{k}"] = {
                "type": "bushing",
                "bodies": pair,
                "points": [point, point],
                "stiffness": [1e6 * stiffness] * 3 + [stiffness] * 3,
            }
    return {"bodies": bodies, "joints": joints, "forces": forces}


@pytest.mark.parametrize(
    ("joined", "coordinates"), [("hinges", "relative"), ("hinges", "absolute"), ("bushings", "absolute")]
)
def test_chain_is_rolled_up_to_two_full_circles_by_a_moment(joined, coordinates):
    """Every angle is M/k; at M = 4 π k/n the chain of n links has turned by 4 π."""
    links, stiffness = 16, 3.0
    full = 4 * np.pi * stiffness / links
    torque = {"type": "torque", "vector": [0, 0, f"{full}*time"]}
    result = machine(clamped_chain(links, stiffness, joined, torque)).statics(
        duration=1, step=0.05, coordinates=coordinates
    )
    assert len(result.time) == 21
    angle = np.outer(result.time, 4 * np.pi / links * np.arange(1, links + 1))
    ends = np.cumsum(np.exp(1j * angle), axis=1) / links
    centres = ends - 0.5 * np.exp(1j * angle) / links
    np.testing.assert_allclose(result.array("position")[:, :, 0], centres.real, atol=1e-9)
    np.testing.assert_allclose(result.array("position")[:, :, 1], centres.imag, atol=1e-9)
    assert np.all(result.array("unstable_directions") == 0)


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_follower_load_bends_a_chain_as_the_shooting_method_says(coordinates):
    """A force that follows the last link, across it: moments from the tip inwards, where the frame of the last link is fixed."""
    links, stiffness, each = 12, 4.0, 1.0 / 12
    force = {"type": "force", "vector": [0, "25*time", 0], "axes": "body", "position": [0.5 / 12, 0, 0]}
    result = machine(clamped_chain(links, stiffness, "hinges", force)).statics(
        duration=1, step=0.1, coordinates=coordinates
    )
    # in the axes of the last link: moment about each joint gives its angle, which places the joint before it
    angles, joint, direction = [], -each + 0j, 1.0 + 0j
    for _ in range(links):
        moment = (joint.conjugate() * -1).real * 25.0  # (tip - joint) × (0, 25)
        angles.append(moment / stiffness)
        direction *= np.exp(-1j * angles[-1])
        joint -= each * direction
    total = sum(angles)
    A = Rotation.from_quat(result.array("orientation")[-1, -1], scalar_first=True)
    turns = result.array("joint_coordinate")[-1]
    np.testing.assert_allclose(turns, angles[::-1], atol=1e-9)
    np.testing.assert_allclose(A.as_matrix()[:2, 0], [np.cos(total), np.sin(total)], atol=1e-9)
    stability = next(item for item in result.trust.items if item.text.startswith("Stability"))
    assert stability.verdict == "amber"  # no stiffness tells of flutter
    assert "flutter" in stability.text
