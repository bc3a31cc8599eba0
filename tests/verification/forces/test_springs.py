"""Springs, dampers, bushings and forces between pairs against closed forms and eigenvalues."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh
from scipy.spatial.transform import Rotation

from references.kepler import Orbit
from references.oscillator import Oscillator
from simulating import G, hinge, simulate, slide, slopes, solid, turning_error, wheel

FORMULATIONS = pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
TIGHT = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13}
MASS, STIFFNESS = 1.7, 400.0
# shares of critical damping
DAMPINGS = pytest.mark.parametrize("share", [0.0, 0.2, 1.0, 1.8], ids=["undamped", "under", "critical", "over"])


def block_on_spring(spring, start=0.1, speed=-0.4, gravity=0.0):
    """A block on an X rail; the spring from the ground at x = -0.5 to the block at `start`."""
    return {
        "gravity": [gravity, 0, 0],
        "bodies": {"block": solid(MASS, 0.01, position=[start, 0, 0], velocity=[speed, 0, 0])},
        "joints": {"rail": slide("ground", "block")},
        "forces": {
            "spring": {
                "type": "spring-damper",
                "markers": [{"body": "ground", "position": [-0.5, 0, 0]}, {"body": "block"}],
                **spring,
            }
        },
    }


@FORMULATIONS
@DAMPINGS
def test_block_on_a_spring_and_damper(share, formulation):
    """ω h = 0.015: RK4 is off by (ω h)⁴/120 per radian, 6e-9 of 0.1 m in 30 rad."""
    plain = Oscillator(MASS, STIFFNESS)
    one = Oscillator(MASS, STIFFNESS, share * plain.critical_damping)
    spring = {"stiffness": STIFFNESS, "damping": one.damping, "free_length": 0.5}
    r = simulate(block_on_spring(spring), duration=2.0, step=1e-3, formulation=formulation)
    x, v = one.motion(r.time, 0.1, -0.4)
    np.testing.assert_allclose(r.array("block.position.x"), x, atol=2e-9)
    np.testing.assert_allclose(r.array("block.velocity.x"), v, atol=5e-8)
    np.testing.assert_allclose(r.array("force.spring.length"), 0.5 + x, atol=2e-9)
    np.testing.assert_allclose(r.array("force.spring.rate"), v, atol=5e-8)
    tension = STIFFNESS * x + one.damping * v
    np.testing.assert_allclose(r.array("force.spring.magnitude"), tension, atol=2e-5)
    np.testing.assert_allclose(r.array("force.spring.power"), -tension * v, atol=2e-5)
    # elastic energy is potential, the damper dissipates
    np.testing.assert_allclose(r.array("potential_energy"), 0.5 * STIFFNESS * x**2, atol=1e-6)
    start = 0.5 * MASS * 0.16 + 0.5 * STIFFNESS * 0.01
    loss = start - 0.5 * STIFFNESS * x**2 - 0.5 * MASS * v**2
    np.testing.assert_allclose(r.array("dissipated_energy"), loss, atol=1e-6)


def test_preload_is_a_constant_tension():
    """m ẍ = -k (x - x_rest), x_rest = free - P/k."""
    spring = {"stiffness": STIFFNESS, "free_length": 0.5, "preload": 20.0}
    r = simulate(block_on_spring(spring), duration=1.0, step=1e-3)
    x, _ = Oscillator(MASS, STIFFNESS).motion(r.time, 0.1 + 20 / STIFFNESS, -0.4)
    np.testing.assert_allclose(r.array("block.position.x"), x - 20 / STIFFNESS, atol=3e-9)
    assert np.abs(r.array("energy_error")).max() < 1e-6


# progressive: soft near the free length; beyond the ends the end slopes go on
TABLE = {"deflections": [-0.1, -0.02, 0.02, 0.05], "forces": [-60.0, -4.0, 4.0, 30.0]}


def tabulated(deflection):
    d, f = TABLE["deflections"], TABLE["forces"]
    low, high = (f[1] - f[0]) / (d[1] - d[0]), (f[-1] - f[-2]) / (d[-1] - d[-2])
    return (
        np.interp(deflection, d, f) + low * np.minimum(deflection - d[0], 0) + high * np.maximum(deflection - d[-1], 0)
    )


@FORMULATIONS
def test_table_of_a_spring(formulation):
    """Against the equation of one degree of freedom. The corners of the table leave RK4 an error of second order: each
    crossing is off by about the jump of slope, 700 N/m, times h² v/(4 m) as a speed: 2e-6 m/s, 1e-7 m until the end."""
    r = simulate(
        block_on_spring({"table": TABLE, "free_length": 0.5}, start=0.14),
        duration=2.0,
        step=1e-4,
        output_interval=2e-3,
        formulation=formulation,
    )
    times = r.time
    found = solve_ivp(
        lambda _t, y: [y[1], -tabulated(y[0]) / MASS], (0, 2), [0.14, -0.4], t_eval=times, max_step=1e-3, **TIGHT
    )
    assert found.y[0].max() > 0.06
    assert found.y[0].min() < -0.11
    np.testing.assert_allclose(r.array("block.position.x"), found.y[0], atol=1e-6)
    # the table's integral is its energy
    assert np.abs(r.array("energy_error")).max() < 1e-5


def test_table_may_not_run_against_its_sense():
    """The same table, force asked for at the start: tension positive, at the deflection length - free_length."""
    for start in (-0.15, -0.05, 0.0, 0.03, 0.2):
        r = simulate(block_on_spring({"table": TABLE, "free_length": 0.5}, start, 0.0), duration=1e-3, step=1e-3)
        assert r.array("force.spring.magnitude")[0] == pytest.approx(tabulated(start), abs=1e-12)
        assert r.array("block.acceleration.x")[0] == pytest.approx(-tabulated(start) / MASS, abs=1e-12)


@FORMULATIONS
def test_law_of_length_and_rate(formulation):
    """Cubic tension with damping, in the words of an expression."""
    law = "300*(length - 0.5) + 9000*(length - 0.5)^3 + 4*rate"
    r = simulate(block_on_spring({"law": law}), duration=2.0, step=1e-3, formulation=formulation)
    found = solve_ivp(
        lambda _t, y: [y[1], -(300 * y[0] + 9000 * y[0] ** 3 + 4 * y[1]) / MASS],
        (0, 2),
        [0.1, -0.4],
        t_eval=r.time,
        **TIGHT,
    )
    np.testing.assert_allclose(r.array("block.position.x"), found.y[0], atol=5e-9)
    np.testing.assert_allclose(r.array("energy_error"), 0, atol=1e-7)


def spring_pendulum(**settings):
    """A bob on a spring, swinging: no closed form, but its energy stays."""
    return simulate(
        {
            "gravity": [0, -G, 0],
            "bodies": {"bob": solid(1.0, 0.01, position=[0.5, 0.1, 0.2], velocity=[0, 0, 1])},
            "forces": {
                "spring": {
                    "type": "spring-damper",
                    "bodies": ["ground", "bob"],
                    "points": [[0, 0, 0], [0.5, 0.1, 0.2]],
                    "stiffness": 150.0,
                    "free_length": 0.4,
                }
            },
        },
        duration=2.0,
        **settings,
    )


@FORMULATIONS
def test_energy_of_a_spring_pendulum_is_of_order_four(formulation):
    steps = [8e-3, 4e-3, 2e-3]
    errors = [np.abs(spring_pendulum(step=h, formulation=formulation).array("energy_error")).max() for h in steps]
    assert np.all(slopes(steps, errors) > 3.7), errors


@FORMULATIONS
def test_spring_pendulum_in_its_own_coordinates(formulation):
    """ẍ = g - k/m (1 - L0/|x|) x, DOP853. ω h = 0.012."""
    r = spring_pendulum(step=1e-3, formulation=formulation)

    def slope(_t, y):
        length = np.linalg.norm(y[:3])
        return np.concatenate([y[3:], [0, -G, 0] - 150.0 * (1 - 0.4 / length) * y[:3]])

    found = solve_ivp(slope, (0, 2), [0.5, 0.1, 0.2, 0, 0, 1], t_eval=r.time, **TIGHT)
    np.testing.assert_allclose(r.array("bob.position"), found.y[:3].T, atol=5e-8)


@FORMULATIONS
@pytest.mark.parametrize("particle", [True, False], ids=["point-masses", "rigid"])
def test_two_bodies_on_a_spring_swing_with_their_reduced_mass(particle, formulation):
    m1, m2, k = 1.0, 3.0, 200.0

    def body(mass, x):
        if particle:
            return {"mass": mass, "point_mass": True, "position": [x, 0, 0], "velocity": [0, 0, 0.5]}
        return solid(mass, 0.02, position=[x, 0, 0], velocity=[0, 0, 0.5])

    sections = {
        "bodies": {"a": body(m1, 0.0), "b": body(m2, 0.5)},
        "forces": {
            "spring": {
                "type": "spring-damper",
                "bodies": ["a", "b"],
                "points": [[0, 0, 0], [0.5, 0, 0]],
                "stiffness": k,
                "damping": 1.5,
                "free_length": 0.4,
            }
        },
    }
    r = simulate(sections, duration=1.5, step=1e-3, formulation=formulation)
    stretch, _ = Oscillator(m1 * m2 / (m1 + m2), k, 1.5).motion(r.time, 0.1)
    a, b = r.array("a.position"), r.array("b.position")
    np.testing.assert_allclose(b[:, 0] - a[:, 0] - 0.4, stretch, atol=3e-9)
    centre = (m1 * a + m2 * b) / (m1 + m2)
    np.testing.assert_allclose(centre, np.stack([0 * r.time + 0.375, 0 * r.time, 0.5 * r.time], axis=1), atol=1e-12)


TORSION = {
    "between-markers": {"type": "torsional-spring-damper", "markers": [{"body": "ground"}, {"body": "disk"}]},
    "on-the-joint": {"type": "joint-spring-damper", "coordinate": "hub.angle"},
}


@FORMULATIONS
@pytest.mark.parametrize("kind", TORSION)
@pytest.mark.parametrize("share", [0.0, 0.15])
def test_disk_on_a_torsion_spring_turns_several_times(share, kind, formulation):
    """J φ̈ = -k (φ - φ0) - c φ̇ from 40 rad/s: the angle reaches four turns and counts them."""
    J, k, free = 0.02, 0.05, 0.7
    one = Oscillator(J, k, share * Oscillator(J, k).critical_damping)
    key = "free_angle" if kind == "between-markers" else "free_value"
    sections = {
        "bodies": {"disk": wheel(J, angular_velocity=[0, 0, 40.0])},
        "joints": {"hub": hinge("ground", "disk")},
        "forces": {"spring": {**TORSION[kind], "stiffness": k, "damping": one.damping, key: free}},
    }
    r = simulate(sections, duration=6.0, step=1e-3, formulation=formulation)
    angle, _ = one.motion(r.time, -free, 40.0)
    assert angle.max() > 5 * np.pi
    way = np.abs(np.diff(angle)).sum()
    np.testing.assert_allclose(r.array("hub.angle"), angle + free, atol=turning_error(40.0, 1e-3) * way)
    assert np.abs(r.array("energy_error")).max() < 3e-7


@FORMULATIONS
def test_torsion_spring_between_two_free_shafts(formulation):
    """Both turn on the ground; the difference of their angles swings with the reduced inertia, the mean turns steadily."""
    J1, J2, k = 0.02, 0.05, 3.0
    sections = {
        "bodies": {"one": wheel(J1, angular_velocity=[0, 0, 30]), "two": wheel(J2)},
        "joints": {"a": hinge("ground", "one"), "b": hinge("ground", "two")},
        "forces": {
            "shaft": {
                "type": "torsional-spring-damper",
                "markers": [{"body": "one"}, {"body": "two"}],
                "stiffness": k,
                "damping": 0.01,
            }
        },
    }
    r = simulate(sections, duration=2.0, step=1e-3, formulation=formulation)
    a, b = r.array("a.angle"), r.array("b.angle")
    twist, _ = Oscillator(J1 * J2 / (J1 + J2), k, 0.01).motion(r.time, 0.0, -30.0)
    np.testing.assert_allclose(b - a, twist, atol=1e-7)
    np.testing.assert_allclose(J1 * a + J2 * b, J1 * 30 * r.time, atol=1e-11)
    np.testing.assert_allclose(r.array("force.shaft.angle"), twist, atol=1e-7)


@FORMULATIONS
def test_joint_spring_on_a_displacement(formulation):
    spring = {
        "type": "joint-spring-damper",
        "coordinate": "rail",
        "stiffness": STIFFNESS,
        "damping": 8.0,
        "free_value": 0.02,
        "preload": 4.0,
    }
    sections = block_on_spring({}, start=0.0)
    sections["forces"] = {"spring": spring}
    r = simulate(sections, duration=1.0, step=1e-3, formulation=formulation)
    rest = 0.02 - 4.0 / STIFFNESS
    x, _ = Oscillator(MASS, STIFFNESS, 8.0).motion(r.time, -rest, -0.4)
    np.testing.assert_allclose(r.array("rail.displacement"), x + rest, atol=3e-9)
    np.testing.assert_allclose(r.array("energy_error"), 0, atol=1e-7)


@pytest.mark.parametrize("kind", ["torsional", "joint"])
def test_tables_and_laws_of_angles(kind):
    """A stiffening torsion spring: as a table fine enough to be a curve, as a law; and the equation itself."""
    J = 0.02
    where = TORSION["between-markers" if kind == "torsional" else "on-the-joint"]
    local = "angle" if kind == "torsional" else "value"
    column = "torques" if kind == "torsional" else "efforts"
    grid = np.linspace(-3, 3, 2001)

    def run(**spring):
        sections = {
            "bodies": {"disk": wheel(J, angular_velocity=[0, 0, 10.0])},
            "joints": {"hub": hinge("ground", "disk")},
            "forces": {"spring": {**where, **spring}},
        }
        return simulate(sections, duration=2.0, step=1e-3)

    law = run(law=f"0.4*{local} + 0.3*{local}^3 + 0.01*rate")
    found = solve_ivp(
        lambda _t, y: [y[1], -(0.4 * y[0] + 0.3 * y[0] ** 3 + 0.01 * y[1]) / J],
        (0, 2),
        [0, 10.0],
        t_eval=law.time,
        **TIGHT,
    )
    np.testing.assert_allclose(law.array("hub.angle"), found.y[0], atol=1e-7)
    table = run(table={"deflections": grid, column: 0.4 * grid + 0.3 * grid**3}, damping=0.01)
    # a chord is off by f'' (3 mrad)²/8 ≤ 6e-6 N m of 1 N m
    np.testing.assert_allclose(table.array("hub.angle"), found.y[0], atol=1e-4)


# --- bushings ---
SIZE = 0.1  # m, by which an angle counts as a length


def random_positive(rng, scale):
    """A symmetric positive definite 6×6 with lengths and angles coupled."""
    A = rng.standard_normal((6, 6))
    units = np.diag([1, 1, 1, SIZE, SIZE, SIZE])
    return scale * units @ (A @ A.T + 2 * np.eye(6)) @ units


def bushed_block(stiffness, damping=None, **start):
    """The block's bushing is off its centre of mass, the centre off its frame."""
    element = {
        "type": "bushing",
        "markers": [{"body": "ground"}, {"body": "block"}],
        "stiffness": stiffness,
    }
    if damping is not None:
        element["damping"] = damping
    return {
        "bodies": {
            "block": {
                "mass": 2.0,
                "centre_of_mass": [0.03, -0.02, 0.05],
                "inertia": [[0.02, 0.003, 0], [0.003, 0.03, -0.002], [0, -0.002, 0.025]],
                **start,
            }
        },
        "forces": {"mount": element},
    }


def mass_matrix():
    """6×6 about the frame's origin for (Ṙ, ω) at rest."""
    c = np.array([0.03, -0.02, 0.05])
    J = np.array([[0.02, 0.003, 0], [0.003, 0.03, -0.002], [0, -0.002, 0.025]])
    skew = np.array([[0, -c[2], c[1]], [c[2], 0, -c[0]], [-c[1], c[0], 0]])
    return np.block([[2.0 * np.eye(3), -2.0 * skew], [2.0 * skew, J - 2.0 * skew @ skew]])


@FORMULATIONS
@pytest.mark.parametrize("mode", [0, 3, 5])
def test_small_oscillation_of_a_bushing_is_an_eigenvector(mode, formulation, rng):
    """Displaced by 1e-6 along an eigenvector of (K, M) it swings as a cosine; what is left is of second order, 1e-5 of it."""
    K = random_positive(rng, 5e3)
    squares, vectors = eigh(K, mass_matrix())
    shape = 1e-6 * vectors[:, mode] / np.abs(vectors[:, mode]).max()
    omega = np.sqrt(squares[mode])
    turn = Rotation.from_rotvec(shape[3:]).as_quat(scalar_first=True)
    start = {"position": shape[:3], "orientation": {"euler_parameters": turn}}
    period = 2 * np.pi / omega
    r = simulate(
        bushed_block(K, **start),
        duration=2 * period,
        step=period / 200,
        output_interval=period / 10,
        formulation=formulation,
    )
    found = Rotation.from_quat(r.array("block.orientation"), scalar_first=True).as_rotvec()
    wave = np.cos(omega * r.time)[:, None]
    np.testing.assert_allclose(r.array("block.position"), wave * shape[:3], atol=5e-11)
    np.testing.assert_allclose(found, wave * shape[3:], atol=5e-11)


@FORMULATIONS
def test_damped_bushing_decays_with_its_complex_eigenvalues(formulation, rng):
    """[M 0; 0 1] of (v, x): the linear system integrated by its matrix exponential."""
    from scipy.linalg import expm

    K, D = random_positive(rng, 5e3), random_positive(rng, 20.0)
    inverse = np.linalg.inv(mass_matrix())
    system = np.block([[np.zeros((6, 6)), np.eye(6)], [-inverse @ K, -inverse @ D]])
    start = np.zeros(12)
    start[:6] = 1e-6 * np.array([1, -0.5, 0.3, 0.8, 0.2, -1])
    turn = Rotation.from_rotvec(start[3:6]).as_quat(scalar_first=True)
    sections = bushed_block(K, D, position=start[:3], orientation={"euler_parameters": turn})
    r = simulate(sections, duration=0.2, step=2e-4, output_interval=0.02, formulation=formulation)
    expected = np.array([expm(system * t) @ start for t in r.time])
    found = Rotation.from_quat(r.array("block.orientation"), scalar_first=True).as_rotvec()
    np.testing.assert_allclose(r.array("block.position"), expected[:, :3], atol=5e-11)
    np.testing.assert_allclose(found, expected[:, 3:6], atol=5e-11)


@FORMULATIONS
def test_bushing_keeps_energy_and_momenta_at_large_rotations(formulation, rng):
    """Two free bodies, turned against each other by more than a right angle: linear and angular momentum stay, and so
    does the kinetic energy plus ½ xᵀK x of order four."""
    K = random_positive(rng, 8.0)
    m, J = (1.0, 2.0), (np.array([0.02, 0.03, 0.04]), np.array([0.05, 0.03, 0.04]))
    sections = {
        "bodies": {
            "a": solid(m[0], J[0], angular_velocity=[3, -2, 1], velocity=[0.2, 0, 0.1]),
            "b": solid(m[1], J[1], position=[0.2, 0.1, 0], angular_velocity=[-6, 5, 4]),
        },
        "forces": {
            "mount": {
                "type": "bushing",
                "markers": [{"body": "a", "position": [0.1, 0, 0]}, {"body": "b", "position": [-0.1, -0.1, 0]}],
                "stiffness": K,
            }
        },
    }
    errors, turned = [], 0.0
    steps = [4e-3, 2e-3, 1e-3]
    for step in steps:
        r = simulate(sections, duration=2.0, step=step, output_interval=0.04, formulation=formulation)
        errors.append(np.abs(r.array("energy_error")).max())
        R, v, w = r.array("position"), r.array("velocity"), r.array("angular_velocity")
        A = (
            Rotation.from_quat(r.array("orientation").reshape(-1, 4), scalar_first=True)
            .as_matrix()
            .reshape(-1, 2, 3, 3)
        )
        np.testing.assert_allclose(m[0] * v[:, 0] + m[1] * v[:, 1], np.tile([0.2, 0, 0.1], (len(v), 1)), atol=1e-11)
        spin = np.einsum("nbij,bj,nbkj,nbk->nbi", A, np.array(J), A, w).sum(axis=1)
        angular = spin + sum(m[b] * np.cross(R[:, b], v[:, b]) for b in (0, 1))
        drift = np.abs(angular - angular[0]).max()
        relative = Rotation.from_matrix(np.swapaxes(A[:, 0], 1, 2) @ A[:, 1]).magnitude()
        turned = max(turned, relative.max())
    assert turned > np.pi / 2
    assert drift < 1e-6
    assert errors[-1] < 1e-5
    assert np.all(slopes(steps, errors) > 3.7), errors


def test_forces_of_a_twisted_bushing_are_the_gradient_of_its_energy(rng):
    """½ xᵀK x with x = (A1ᵀ d, rotation vector of A1ᵀ A2): accelerations at the start by finite differences of it."""
    K = random_positive(rng, 100.0)
    position, turn = np.array([0.05, -0.08, 0.03]), Rotation.from_rotvec([1.2, -0.9, 1.0])
    # frame in the centre of mass, principal axes: M v̇ is immediate
    sections = {
        "bodies": {
            "block": solid(
                2.0,
                (0.02, 0.03, 0.04),
                position=position,
                orientation={"euler_parameters": turn.as_quat(scalar_first=True)},
            )
        },
        "forces": {"mount": {"type": "bushing", "markers": [{"body": "ground"}, {"body": "block"}], "stiffness": K}},
    }
    r = simulate(sections, duration=1e-3, step=1e-3)

    def energy(move, rotate):
        x = np.concatenate([position + move, (Rotation.from_rotvec(rotate) * turn).as_rotvec()])
        return 0.5 * x @ K @ x

    h, zero = 1e-6, np.zeros(3)
    force = [-(energy(h * e, zero) - energy(-h * e, zero)) / (2 * h) for e in np.eye(3)]
    torque = [-(energy(zero, h * e) - energy(zero, -h * e)) / (2 * h) for e in np.eye(3)]
    np.testing.assert_allclose(2.0 * r.array("block.acceleration")[0], force, rtol=1e-6, atol=1e-7)
    A = turn.as_matrix()
    J = A @ np.diag([0.02, 0.03, 0.04]) @ A.T
    np.testing.assert_allclose(J @ r.array("block.angular_acceleration")[0], torque, rtol=1e-6, atol=1e-7)


# --- forces between pairs ---


@FORMULATIONS
@pytest.mark.parametrize("particle", [True, False], ids=["point-masses", "rigid"])
def test_attraction_by_the_inverse_square_makes_keplers_orbit(particle, formulation):
    """Eccentricity 0.5; one period in 4000 steps. The centre of mass moves uniformly."""
    m1, m2, k = 1.5, 1.0, 3.0
    orbit = Orbit(strength=k, reduced_mass=m1 * m2 / (m1 + m2), semi_axis=1.4, eccentricity=0.5)

    def body(mass, share):
        place = {
            "position": [share * orbit.pericentre, 0, 0],
            "velocity": [0, share * orbit.speed_at_pericentre, 0.3],
        }
        return {"point_mass": True, "mass": mass, **place} if particle else solid(mass, 0.01, **place)

    sections = {
        "bodies": {"a": body(m1, -m2 / (m1 + m2)), "b": body(m2, m1 / (m1 + m2))},
        "forces": {
            "pull": {
                "type": "pair-force",
                "markers": [{"body": "a"}, {"body": "b"}],
                "magnitude": f"-{k}/length^2",
            }
        },
    }
    r = simulate(
        sections,
        duration=orbit.period,
        step=orbit.period / 4000,
        output_interval=orbit.period / 40,
        formulation=formulation,
    )
    apart = r.array("b.position") - r.array("a.position")
    np.testing.assert_allclose(apart[:, :2], orbit.position(r.time), atol=1e-7)
    np.testing.assert_allclose(apart[-1], apart[0], atol=1e-7)  # closed after the period
    momentum = m1 * r.array("a.velocity") + m2 * r.array("b.velocity")
    np.testing.assert_allclose(momentum, np.tile([0, 0, 0.3 * (m1 + m2)], (len(r.time), 1)), atol=1e-12)


def test_vector_between_two_bodies_acts_on_both_at_their_points():
    """A sideways force: on the second at its point, the opposite on the first at its own; the couple is not balanced."""
    sections = {
        "bodies": {"a": solid(2.0, 0.1), "b": solid(1.0, 0.2, position=[1, 0, 0])},
        "forces": {
            "push": {
                "type": "pair-force",
                "bodies": ["a", "b"],
                "points": [[0, 0, 0], [1, 0.5, 0]],
                "vector": [3, 4, 0],
            }
        },
    }
    r = simulate(sections, duration=1e-3, step=1e-3)
    np.testing.assert_allclose(r.array("acceleration")[0], [[-1.5, -2, 0], [3, 4, 0]], atol=1e-12)
    # (0, 0.5, 0) × (3, 4, 0) = -1.5 Z
    np.testing.assert_allclose(r.array("angular_acceleration")[0], [[0, 0, 0], [0, 0, -1.5 / 0.2]], atol=1e-12)


def test_vector_in_the_axes_of_the_first_turns_with_it():
    omega = 2.0
    sections = {
        "bodies": {"a": wheel(1.0, angular_velocity=[0, 0, omega]), "b": solid(1.0, 0.2)},
        "joints": {"hub": hinge("ground", "a")},
        "forces": {
            "push": {
                "type": "pair-force",
                "markers": [{"body": "a"}, {"body": "b"}],
                "vector": [3, 0, 0],
                "axes": "first",
            }
        },
    }
    # the force acts on `a` at the hub, so it turns steadily; b ̈ = 3 (cos ωt, sin ωt)
    r = simulate(sections, duration=2.0, step=1e-3)
    t = r.time
    expected = 3 * np.stack([(1 - np.cos(omega * t)) / omega**2, t / omega - np.sin(omega * t) / omega**2], axis=1)
    np.testing.assert_allclose(r.array("b.position")[:, :2], expected, atol=1e-10)
