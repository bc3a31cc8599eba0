"""Inverse dynamics against Lagrange's equation, the forward multipliers, runs fed with its efforts, and identities of the matrices."""

import numpy as np
import pytest

import nivel
from references import one_dof, slider_crank

EXAMPLES = "examples"


@pytest.fixture(scope="module")
def crank():
    return nivel.load(f"{EXAMPLES}/mechanisms/slider-crank.yaml")


@pytest.fixture(scope="module")
def turn(crank):
    return crank.kinematics(drive="hinge", duration=2, positions=201)


def test_efforts_are_those_of_the_driver(crank, turn):
    """The forward multipliers: -λ of the driver's row."""
    wanted = turn.array("driver.drive.effort")
    found = crank.inverse(actuators="hinge", motion=turn)
    np.testing.assert_allclose(found.effort[:, 0], wanted, atol=1e-9 * np.abs(wanted).max())
    assert found.complete
    assert found.unique
    assert found.freedoms == 1


def test_power_is_the_change_of_energy(crank, turn):
    """Efforts do the work that energy and the machine's own load ask for: over a whole turn only that of the load."""
    found = crank.inverse(actuators="hinge", motion=turn)
    (facts,) = found.facts()
    assert facts["work_done"] + facts["work_taken"] == pytest.approx(50.0 * 2.0 * np.pi, rel=1e-3)


def test_efforts_fed_back_reproduce_the_motion():
    """A motor with the efforts of half a turn, as a cubic table, takes the place of the driver."""
    record = nivel.load(f"{EXAMPLES}/mechanisms/slider-crank.yaml").record
    driver = nivel.Driver(name="turn", coordinate="hinge", value="0.5*time^2")
    machine = nivel.Machine.from_record(record.replace(drivers=(driver,)))
    motion = machine.kinematics(duration=2, positions=801)
    efforts = machine.inverse(actuators="hinge", motion=motion)
    table = nivel.Table(times=tuple(efforts.time), values=tuple(efforts.effort[:, 0]), interpolation="cubic")
    motor = nivel.Motor(name="motor", coordinate="hinge", effort=table)
    run = nivel.Machine.from_record(record.replace(forces=(*record.forces, motor))).simulate(
        duration=2, step="1 ms", output_interval="0.1 s"
    )
    np.testing.assert_allclose(run.array("hinge.angle"), 0.5 * run.time**2, atol=1e-6)


def test_more_actuators_than_needed_share_the_load_by_least_weighted_norm(crank, turn):
    """τ = W⁻² aᵀ (a W⁻² aᵀ)⁻¹ b with a = (1, dx/dφ); the sum of powers is that of one actuator."""
    single = crank.inverse(actuators="hinge", motion=turn)
    both = crank.inverse(actuators=["hinge", "slide"], motion=turn, weights={"hinge": 1.0, "slide": 2.0})
    slope = both.rate[:, 1] / both.rate[:, 0]
    a = np.column_stack([np.ones_like(slope), slope])
    share = (a / [1.0, 4.0]) / np.sum(a**2 / [1.0, 4.0], axis=1, keepdims=True)
    np.testing.assert_allclose(both.effort, share * single.effort, atol=1e-8 * np.abs(single.effort).max())
    assert not both.unique


def test_limits_are_kept_and_the_others_help(crank, turn):
    free = crank.inverse(actuators=["hinge", "slide"], motion=turn)
    limit = float(0.5 * np.abs(free.effort[:, 1]).max())
    kept = crank.inverse(
        actuators=["hinge", "slide"], motion=turn, limits={"slide": f"{limit!r} N"}, weights={"slide": 1.0}
    )
    assert np.abs(kept.effort[:, 1]).max() <= limit * (1.0 + 1e-12)
    assert kept.complete
    np.testing.assert_allclose(kept.power.sum(axis=1), free.power.sum(axis=1), atol=1e-8 * np.abs(free.power).max())


def test_what_no_actuator_gives_is_told(crank, turn):
    weak = crank.inverse(actuators="hinge", motion=turn, limits={"hinge": "100 N m"})
    assert not weak.complete
    assert weak.limited
    assert "limits hold the actuators back" in weak.statements()[0]
    short = np.abs(crank.inverse(actuators="hinge", motion=turn).effort[:, 0]).max() - 100.0
    assert np.abs(weak.missing).max() == pytest.approx(short, rel=1e-6)
    assert weak.missing_at == "hinge.angle"


def test_a_motion_of_another_machine_is_noticed(crank, turn):
    """The same names, a longer rod: its joints are open in the motion of the shorter one."""
    other = nivel.load(f"{EXAMPLES}/mechanisms/slider-crank.yaml", {"parameters.rod_length": 1.9})
    found = other.inverse(actuators="hinge", motion=turn)
    assert "joints open by" in found.statements()[0]
    assert not crank.inverse(actuators="hinge", motion=turn).statements()


def test_a_double_pendulum_with_one_motor_lacks_the_other():
    a, b = (
        nivel.Body(name=n, mass=1.0, inertia=(0.1, 0.1, 0.1), position=(x, 0, 0)) for n, x in (("a", 0.5), ("b", 1.5))
    )
    joints = [
        nivel.Joint(name="p", type="revolute", bodies=("ground", "a"), point=(0, 0, 0), axis=(0, 0, 1)),
        nivel.Joint(name="q", type="revolute", bodies=("a", "b"), point=(1, 0, 0), axis=(0, 0, 1)),
    ]
    drivers = [nivel.Driver(name=f"hold_{n}", coordinate=n, value="0*time") for n in ("p", "q")]
    machine = nivel.Machine("two", bodies=[a, b], joints=joints, drivers=drivers, gravity=(0, -9.81, 0))
    both = machine.inverse(positions=3)
    np.testing.assert_allclose(both.effort, np.tile([2.0 * 9.81, 0.5 * 9.81], (3, 1)), rtol=1e-9)
    alone = machine.inverse(actuators="p", positions=3)
    assert not alone.complete
    assert alone.missing_at == "q.angle"


def test_trajectories_of_a_table_are_followed(tmp_path, crank):
    time = np.linspace(0.0, 1.0, 41)
    lines = ["time,hinge.angle", *(f"{t},{0.3 * (1.0 - np.cos(np.pi * t))}" for t in time)]
    path = tmp_path / "way.csv"
    path.write_text("\n".join(lines), encoding="utf-8")
    found = crank.inverse(actuators="hinge", trajectory=path, positions=21)
    angle = 0.3 * (1.0 - np.cos(np.pi * found.time))
    rate, bend = 0.3 * np.pi * np.sin(np.pi * found.time), 0.3 * np.pi**2 * np.cos(np.pi * found.time)
    m, slope, force = one_dof.scalar_equation(slider_crank.LINKAGE, angle)
    wanted = m * bend + 0.5 * slope * rate**2 - force
    # the natural spline of 41 points errs by h² of the second derivative at its ends, by 1e-3 of it inside
    np.testing.assert_allclose(found.effort[3:-3, 0], wanted[3:-3], atol=2e-3 * np.abs(wanted).max())


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({}, "no motors and no drivers"),
        ({"actuators": "henge"}, "did you mean `hinge`"),
        ({"actuators": "hinge", "limits": {"slide": "4 N"}}, "there is no actuator `slide`"),
        ({"actuators": "hinge", "limits": {"hinge": "4 N"}}, "torque"),
        ({"actuators": "hinge", "limits": {"hinge": "-4 N m"}}, "greater than zero"),
        ({"actuators": "hinge", "hold": "cam"}, "no driver `cam`"),
        ({"actuators": "hinge"}, "is not driven"),
        ({"actuators": "hinge", "motion": 3}, "a result or the name of its file"),
        ({"actuators": "hinge", "trajectory": "nowhere.csv"}, "cannot be read"),
    ],
)
def test_bad_options_are_explained(crank, given, said):
    with pytest.raises(nivel.ModelError, match=said):
        crank.inverse(**given)


def rubbing(value="0.3*sin(4*time)"):
    """A block of 2 kg on a rail at 30 degrees, rubbed with μ = 0.2, and a motor of its own that must not act besides."""
    slope = np.radians(30.0)
    along = (np.cos(slope), np.sin(slope), 0.0)
    block = nivel.Body(name="block", mass=2.0, inertia=(0.1, 0.1, 0.1))
    rail = nivel.Joint(name="rail", type="translational", bodies=("ground", "block"), point=(0, 0, 0), axis=along)
    forces = [
        nivel.Friction(name="sole", coordinate="rail", model="coulomb", coefficient=0.2, transition_speed=1e-3),
        nivel.Motor(name="pull", coordinate="rail", effort=1000.0),
    ]
    driver = nivel.Driver(name="way", coordinate="rail", value=value)
    machine = {"joints": [rail], "forces": forces, "drivers": [driver], "gravity": (0, -9.81, 0)}
    return nivel.Machine("rubbing", bodies=[block], simulation={"duration": 1.5}, **machine)


def test_friction_is_overcome_by_the_efforts():
    """m s̈ + m g sin 30° + μ m g cos 30° tanh(ṡ/v)."""
    found = rubbing().inverse(positions=61)
    t = found.time
    rate, slope = 1.2 * np.cos(4 * t), np.radians(30.0)
    weight = 2.0 * 9.81
    wanted = -2.0 * 4.8 * np.sin(4 * t) + weight * np.sin(slope)
    wanted += 0.2 * weight * np.cos(slope) * np.tanh(rate / 1e-3)
    np.testing.assert_allclose(found.effort[:, 0], wanted, rtol=1e-9)
    np.testing.assert_allclose(found.rate[:, 0], rate, atol=1e-12)
    assert found.actuators == ("pull",)
    assert found.complete
    assert found.unique


def test_friction_is_refused_where_its_load_is_not_known():
    with pytest.raises(nivel.ModelError, match=r"depend on the efforts.*with a recorded motion they are not found"):
        rubbing().inverse(motion=rubbing().kinematics(positions=5))
    with pytest.raises(nivel.ModelError, match="with limits they are not found"):
        rubbing().inverse(limits={"pull": "5 N"})


# --- matrices ---


@pytest.mark.parametrize("angle", [0.0, 0.5, 2.0])
def test_a_loop_has_the_mass_and_bias_of_its_single_equation(crank, angle):
    mechanics = crank.mechanics(coordinates="relative")
    assert mechanics.names == ("hinge.angle",)
    q = mechanics.start.copy()
    q[mechanics.position_names.index("hinge.angle")] += angle
    m, slope, force = (float(each[0]) for each in one_dof.scalar_equation(slider_crank.LINKAGE, np.array([angle])))
    assert mechanics.mass_matrix(q)[0, 0] == pytest.approx(m, rel=1e-11)
    assert mechanics.bias(q, [3.0])[0] == pytest.approx(0.5 * slope * 9.0 - force, rel=1e-10)
    assert mechanics.inverse_dynamics(q, [3.0], [2.0])[0] == pytest.approx(
        2.0 * m + 0.5 * slope * 9.0 - force, rel=1e-10
    )


def tree(rng):
    """A branching tree of four bodies with random inertia, revolute, translational and universal joints."""
    names = ["a", "b", "c", "d"]
    bodies = [
        nivel.Body(
            name=n, mass=rng.uniform(1, 3), inertia=tuple(rng.uniform(1, 1.4, 3)), position=tuple(rng.normal(size=3))
        )
        for n in names
    ]
    kinds = [("ground", "a", "revolute"), ("a", "b", "translational"), ("a", "c", "revolute"), ("c", "d", "revolute")]
    joints = [
        nivel.Joint(
            name=f"j{k}", type=kind, bodies=(i, j), point=tuple(rng.normal(size=3)), axis=tuple(rng.normal(size=3))
        )
        for k, (i, j, kind) in enumerate(kinds)
    ]
    return nivel.Machine("tree", bodies=bodies, joints=joints, gravity=(1.0, 2.0, -9.81))


def test_matrices_of_a_tree_keep_the_identities_of_mechanics(rng):
    """M symmetric and positive; ∂τ/∂a = M; vᵀ(Ṁ v - 2 (h - h₀)) = 0, Ṁ by central differences; forward undoes inverse."""
    mechanics = tree(rng).mechanics(coordinates="relative")
    q, v, a = mechanics.start + rng.normal(size=4), rng.normal(size=4), rng.normal(size=4)
    M, h = mechanics.mass_matrix(q), mechanics.bias(q, v)
    np.testing.assert_allclose(M, M.T, atol=1e-12)
    assert np.linalg.eigvalsh(M).min() > 0.0
    tau = mechanics.inverse_dynamics(q, v, a)
    np.testing.assert_allclose(tau, M @ a + h, atol=1e-11)
    np.testing.assert_allclose(mechanics.forward_dynamics(q, v, tau), a, atol=1e-11)
    size = 1e-5
    rate = (mechanics.mass_matrix(q + size * v) - mechanics.mass_matrix(q - size * v)) / (2.0 * size)
    still = mechanics.bias(q, np.zeros(4))
    assert v @ rate @ v == pytest.approx(2.0 * v @ (h - still), rel=1e-7)


def test_the_jacobian_is_the_derivative_of_the_place_and_its_bias_that_of_the_velocity(rng):
    machine = tree(rng)
    mechanics = machine.mechanics(coordinates="relative")
    q, v = mechanics.start + rng.normal(size=4), rng.normal(size=4)
    place = {name: k for k, name in enumerate(mechanics.names)}
    J = mechanics.jacobian("d", q)
    joints = []
    for joint in machine.record.joints:
        name = "angle" if joint.type == "revolute" else "displacement"
        k = place[f"{joint.name}.{name}"]
        joints.append(joint.replace(start={name: float(q[k])}, start_rates={name: float(v[k])}))
    moving = nivel.Machine.from_record(machine.record.replace(joints=tuple(joints)))
    run = moving.simulate(duration="1 us", step="1 us")
    wanted = np.concatenate([run.array("d.velocity")[0], run.array("d.angular_velocity")[0]])
    np.testing.assert_allclose(J @ v, wanted, atol=1e-9)
    size = 1e-5
    forward, back = (mechanics.jacobian("d", q + s * size * v) @ v for s in (1.0, -1.0))
    np.testing.assert_allclose(mechanics.jacobian_bias("d", q, v), (forward - back) / (2.0 * size), atol=1e-6)


def test_positions_that_cannot_be_closed_are_told(crank):
    mechanics = crank.mechanics(coordinates="relative")
    with pytest.raises(nivel.ModelError, match=r"4 numbers, one for each of hinge\.angle"):
        mechanics.mass_matrix([0.0])
    with pytest.raises(nivel.ModelError, match="no marker or body `sliderr`"):
        mechanics.jacobian("sliderr")


# --- whole turns ---


def wound(sign):
    """A bar on a hinge with springs of 2 and 5 N m/rad: on the coordinate, slack at 1 rad, and between two markers; in its second turn."""
    bodies = ("ground", "bar") if sign > 0 else ("bar", "ground")
    bar = nivel.Body(name="bar", mass=2.0, inertia=(0.1, 0.1, 0.1))
    hinge = nivel.Joint(
        name="hinge", type="revolute", bodies=bodies, point=(0, 0, 0), axis=(0, 0, 1), start={"angle": "370 deg"}
    )
    base = nivel.Marker(name="base", body=bodies[0], axis=(0, 0, 1))
    end = nivel.Marker(name="end", body=bodies[1], axis=(0, 0, 1))
    springs = [
        nivel.JointSpringDamper(name="coil", coordinate="hinge", stiffness=2.0, free_value=1.0),
        nivel.TorsionalSpringDamper(name="band", markers=("base", "end"), stiffness=5.0),
    ]
    return nivel.Machine(
        "wound", bodies=[bar], joints=[hinge], markers=[base, end], forces=springs[: 2 if sign > 0 else 1]
    )


@pytest.mark.parametrize("sign", [1, -1])
def test_bias_counts_whole_turns(sign):
    mechanics = wound(sign).mechanics()
    np.testing.assert_allclose(mechanics.start, [np.radians(370)], rtol=1e-12)
    if sign < 0:
        for angle in (*mechanics.start, 0.3, 4.0, -9.0):
            np.testing.assert_allclose(mechanics.bias([angle]), [2.0 * (angle - 1.0)], rtol=1e-11, atol=1e-11)


def test_efforts_count_whole_turns():
    machine = wound(1)
    motion = machine.kinematics(drive="hinge", start="1 rev", end="-2 rev", positions=61)
    found = machine.inverse(actuators="hinge", motion=motion)
    angle = motion["hinge.angle"].to_numpy()
    near = 5.0 * (angle - 2.0 * np.pi)  # the band is slack as the machine is placed, in the turn of the file
    assert np.ptp(found.effort[:, 0] - 2.0 * (angle - 1.0) - near) < 1e-9
    np.testing.assert_allclose(found.effort[:, 0], motion["driver.drive.effort"], atol=1e-10)
