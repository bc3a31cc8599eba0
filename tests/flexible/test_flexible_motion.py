"""Flexible bodies in motion: against the NumPy reference, closed forms, conservation, rigid bodies, and a published problem."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import flexible_reference as reference
from models import bar, reduced
from nivel import (
    Body,
    Driver,
    Friction,
    Joint,
    MachineRecord,
    Marker,
    PointForce,
    Sensor,
    SimulationSettings,
    SpringDamper,
)
from nivel.analysis.assembly.implicit import evaluate_residual, find_tangent
from nivel.errors import ModelError
from nivel.flexible.body.body_file import write_body
from nivel.system.flexible import bending_bodies
from preparing import prepare
from running import reference_run, run

pytestmark = pytest.mark.covering

GRAVITY = (0.0, -9.81, 0.0)
FORCE = (1.0, 2.0, -3.0)


@pytest.fixture(scope="session")
def files(tmp_path_factory):
    """A folder with bars: `slender` (2 m × 10 mm, with geometric stiffening), `clamped` (its frame fixed to the root), `stout`."""
    folder = tmp_path_factory.mktemp("bodies")
    made = {
        "slender": bar(width=0.01, height=0.01, elements=64, reduction="modes: 10, stiffening: true"),
        "plain": bar(width=0.01, height=0.01, elements=64, reduction="modes: 10"),
        "clamped": bar(reduction="modes: 6, reference: root, stiffening: true"),
        "stout": bar(length=1.0, width=0.04, height=0.05, elements=8, reduction="modes: 4, stiffening: true"),
    }
    bodies = {}
    for name, text in made.items():
        # the bar of the pendulum below is of another steel
        pendulum = name in ("slender", "plain")
        bodies[name], _ = reduced(text.replace("210 GPa", "207 GPa").replace("7850", "7801") if pendulum else text)
        write_body(bodies[name], folder / f"{name}.nc")
    return folder, bodies


def flexible(files, name, **more):
    return {"file": str(files[0] / f"{name}.nc"), **more}


def tumbling(files, name, forces=(), gravity=GRAVITY):
    turn = Rotation.from_rotvec([0.3, -0.8, 0.5]).as_quat(scalar_first=True).tolist()
    body = Body(
        name="bar",
        flexible=flexible(files, name, damping_ratio=0.02),
        position=(0.1, 0.2, 0.3),
        orientation={"euler_parameters": turn},
        velocity=(1.0, 2.0, 3.0),
        angular_velocity_body=(1.0, -2.0, 0.5),
    )
    return MachineRecord(name="tumbling", gravity=gravity, bodies=(body,), forces=forces)


def bent(prepared, rng, size=1e-3):
    """A state with modal coordinates and rates, which moves."""
    y, positions = prepared.start.copy(), prepared.motion.system.positions
    modes = len(prepared.motion.system.modes)
    rates = len(y) - modes - 2
    y[positions - modes : positions] = size * rng.standard_normal(modes)
    y[rates : rates + modes] = 0.3 * rng.standard_normal(modes)
    return y


def test_accelerations_are_those_of_the_reference(files):
    """Mass matrix, quadratic velocity, weight, elastic and damping forces, and a force at an interface."""
    push = PointForce(name="push", body="bar", position=(2.0, 0.0, 0.0), vector=FORCE)
    prepared = prepare(tumbling(files, "plain", (push,)))
    reduced_body = files[1]["plain"]
    y = bent(prepared, np.random.default_rng(1))
    status, rate = prepared.motion.evaluate(0.0, y)
    assert status == 0
    n = len(reduced_body.eigenvalues)
    A = Rotation.from_quat(y[3:7], scalar_first=True).as_matrix()
    q, w, qdot = y[7 : 7 + n], y[10 + n : 13 + n], y[13 + n : 13 + 2 * n]
    tip, inv = reduced_body.interface("tip"), reduced_body.invariants
    total = (
        reference.quadratic_velocity(inv, A, w, q, qdot)
        + reference.gravity_force(inv, A, q, np.array(GRAVITY))
        + reference.elastic_force(reduced_body.eigenvalues, q)
        + reference.damping_force(2 * 0.02 * np.sqrt(reduced_body.eigenvalues), qdot)
        + reference.point_force(A, tip.position, tip.phi, tip.psi, q, np.array(FORCE), np.zeros(3))
    )
    expected = np.linalg.solve(reference.mass_matrix(inv, A, q), total)
    np.testing.assert_allclose(rate[7 + n : 13 + 2 * n], expected, rtol=0, atol=1e-11 * np.abs(expected).max())


def test_stiffening_is_that_of_the_reference(files):
    """K_g q of the accelerations that the body has, within the second order in q that the reference leaves out."""
    machine = tumbling(files, "slender")
    body, prepared = files[1]["slender"], prepare(machine)
    rng, defects = np.random.default_rng(2), []
    base = bent(prepared, rng, 1.0)
    n = len(body.eigenvalues)
    for size in (1e-4, 5e-5):
        y = base.copy()
        y[7 : 7 + n] *= size
        y[13 + n : 13 + 2 * n] = 0.0
        _, rate = prepared.motion.evaluate(0.0, y)
        A = Rotation.from_quat(y[3:7], scalar_first=True).as_matrix()
        q, w = y[7 : 7 + n], y[10 + n : 13 + n]
        acceleration = rate[7 + n : 13 + 2 * n]
        K = reference.stiffening(body.stiffening, A.T @ (acceleration[:3] - GRAVITY), acceleration[3:6], w)
        M = reference.mass_matrix(body.invariants, A, q)
        forces = (
            reference.quadratic_velocity(body.invariants, A, w, q, np.zeros(n))
            + reference.gravity_force(body.invariants, A, q, np.array(GRAVITY))
            + reference.elastic_force(body.eigenvalues, q)
        )
        stiffening = np.concatenate([np.zeros(6), K @ q])
        defects.append(np.abs((M @ acceleration - forces + stiffening)[6:]).max())
        assert np.abs(stiffening).max() > 10.0 * defects[-1]
    assert defects[1] < 0.6 * defects[0]


def angular_momentum(body, r):
    """(time, 3) about the origin, from what the run stored."""
    out = []
    for k in range(len(r.time)):
        A = Rotation.from_quat(r.orientation[k, 0], scalar_first=True).as_matrix()
        v = np.concatenate([r.velocity[k, 0], A.T @ r.angular_velocity[k, 0], r.modal_rate[k]])
        p = reference.mass_matrix(body.invariants, A, r.modal_coordinate[k]) @ v
        out.append(A @ p[3:6] + np.cross(r.position[k, 0], p[:3]))
    return np.array(out)


def test_bodies_that_fly_keep_their_energy(files):
    """Two bars on a hinge, tumbling, which bend each other: what is left falls with the fourth power of the step."""
    bodies = (
        Body(name="a", flexible=flexible(files, "slender", modes=6), angular_velocity=(0.0, 3.0, 4.0)),
        Body(name="b", flexible=flexible(files, "slender", modes=6), position=(2.0, 0.0, 0.0)),
    )
    hinge = Joint(name="hinge", type="revolute", bodies=("a", "b"), point=(2.0, 0.0, 0.0), axis=(0.0, 0.6, 0.8))
    machine = MachineRecord(name="flying", bodies=bodies, joints=(hinge,))
    errors = []
    for step in (1e-3, 5e-4):
        r = run(machine, integrator="rk4", step=step, duration=1.0, output_interval=0.01)
        errors.append(np.abs(r.energy_error).max() / r.kinetic_energy.max())
        # they do bend
        assert np.ptp(r.potential_energy) > 1e-4 * r.kinetic_energy.max()
    assert errors[1] < 1e-6
    assert errors[0] / errors[1] > 12.0


def test_free_body_keeps_its_angular_momentum(files):
    """Without stiffening, whose part of the momentum is not in the reference."""
    machine = tumbling(files, "plain", gravity=(0.0, 0.0, 0.0))
    machine = machine.replace(bodies=(machine.bodies[0].replace(flexible=flexible(files, "plain", modes=4)),))
    r = run(machine, integrator="dop853", tolerance=1e-11, duration=0.5, output_interval=0.05)
    momentum = angular_momentum(bending_bodies(machine)[0].reduced, r)
    assert np.abs(momentum - momentum[0]).max() < 1e-9 * np.abs(momentum).max()


def pendulum(files, name, **more):
    return MachineRecord(
        name="pendulum",
        gravity=GRAVITY,
        bodies=(Body(name="bar", flexible=flexible(files, name, **more)),),
        joints=(Joint(name="hinge", type="revolute", bodies=("ground", "bar"), point=(0, 0, 0), axis=(0, 0, 1)),),
        markers=(Marker(name="tip", body="bar", position=(2.0, 0.0, 0.0)),),
        sensors=(Sensor(name="tip", marker="tip", quantity="position"),),
        simulation=SimulationSettings(duration=2.0, output_interval=0.005),
    )


def tip_of(r):
    return np.column_stack([getattr(r, f"sensor.tip.{axis}") for axis in "xyz"])


# m, of 16 cable elements in absolute nodal coordinates at 0.125 ms, confirmed by refinement
PENDULUM = {
    0.25: (1.948097, -0.452638),
    0.5: (1.253915, -1.558090),
    1.0: (-1.764028, -0.942432),
    1.5: (-1.995952, -0.127006),
    2.0: (-0.384017, -1.962786),
}


def test_pendulum_follows_the_reference(files):
    """A steel bar of 2 m × 10 mm × 10 mm released at the horizontal; largest deflection from the tangent at its root 17.5 mm."""
    r = run(pendulum(files, "slender", modes=10), step=5e-4)
    tip = tip_of(r)
    for time, place in PENDULUM.items():
        assert np.linalg.norm(tip[round(time / 0.005), :2] - place) < 0.5e-3
    angle = r.joint_coordinate[:, 0]
    deflection = -np.sin(angle) * tip[:, 0] + np.cos(angle) * tip[:, 1]
    assert abs(np.abs(deflection).max() - 17.5e-3) < 0.7e-3
    assert np.abs(r.constraint_violation).max() < 1e-10
    assert np.abs(r.constraint_rate_violation).max() < 1e-9


@pytest.mark.parametrize(
    ("integrator", "settings"),
    [
        ("generalised-alpha", {"step": 1e-3}),
        ("generalised-alpha", {"step": 1e-3, "stabilisation": "none"}),
        ("newmark", {"step": 1e-3, "stabilisation": "geometric"}),
        ("bdf", {"tolerance": 1e-5}),
        ("radau", {"tolerance": 1e-5}),
    ],
)
def test_implicit_methods_agree(files, integrator, settings):
    machine = pendulum(files, "plain", modes=6)
    expected = tip_of(run(machine, step=2.5e-4, duration=1.0))
    r = run(machine, integrator=integrator, duration=1.0, **settings)
    assert r.finished.outcome == "done"
    assert np.abs(tip_of(r) - expected).max() < 1e-3
    assert np.abs(r.energy_error).max() < 1e-4 * r.kinetic_energy.max()


def test_order_of_convergence_with_two_flexible_bodies(files):
    """Joints at interfaces of both, one turned by a driver, and a spring between them: every velocity term counts for order four."""
    bodies = (
        Body(name="arm", flexible=flexible(files, "stout", modes=4)),
        Body(name="fore", flexible=flexible(files, "stout", modes=4), position=(1.0, 0.0, 0.0)),
    )
    machine = MachineRecord(
        name="arms",
        gravity=GRAVITY,
        bodies=bodies,
        joints=(
            Joint(
                name="shoulder",
                type="universal",
                bodies=("ground", "arm"),
                point=(0, 0, 0),
                axes=((0, 0, 1), (0, 1, 0)),
            ),
            Joint(name="elbow", type="revolute", bodies=("arm", "fore"), point=(1, 0, 0), axis=(0, 0.6, 0.8)),
        ),
        drivers=(Driver(name="motor", coordinate="elbow", value="0.5*sin(6*time)"),),
        forces=(
            SpringDamper(
                name="rope", bodies=("ground", "fore"), points=((0, 1, 1), (2, 0, 0)), stiffness=50, free_length=1
            ),
        ),
    )
    common = {"duration": 0.1, "output_interval": 0.01}
    fine = reference_run(machine, integrator="dop853", tolerance=1e-12, **common)
    errors = []
    for step in (1e-4, 5e-5, 2.5e-5):
        r = run(machine, integrator="rk4", stabilisation="none", step=step, **common)
        errors.append(np.abs(r.position - fine.position).max())
    slopes = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert np.all(np.abs(slopes - 4.0) < 0.3)
    assert np.abs(fine.constraint_violation).max() < 1e-9


def test_tangents_against_differences(files):
    """Central differences of order eight of the residual along positions, velocities and accelerations at once."""
    machine = pendulum(files, "slender", modes=6)
    machine = machine.replace(simulation=SimulationSettings(integrator="generalised-alpha", coordinates="absolute"))
    prepared = prepare(machine)
    motion, residual, newton = (
        prepared.motion,
        prepared.motion.system.record.residual,
        prepared.motion.system.record.newton,
    )
    rng = np.random.default_rng(4)
    y = bent(prepared, rng)
    n, positions = len(residual.vdot), motion.system.positions
    residual.y[:], residual.vdot[:] = y, rng.standard_normal(n)
    residual.lam[:] = rng.standard_normal(len(residual.lam))
    newton.change[:] = 0.0
    _, matrix = find_tangent(motion, 0.0, 1.0, 1.0, 1.0)
    vdot = residual.vdot.copy()
    weights = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
    modes = len(motion.system.modes)
    for k in range(6, 6 + modes):
        h, slope = 1e-4, np.zeros(n)
        for far, weight in weights.items():
            for sign in (1.0, -1.0):
                residual.y[:], residual.vdot[:] = y, vdot
                residual.y[7 + k - 6] += sign * far * h
                residual.y[positions + k] += sign * far * h
                residual.vdot[k] += sign * far * h
                evaluate_residual(motion, 0.0)
                slope += sign * weight / h * residual.value[:n]
        residual.y[:], residual.vdot[:] = y, vdot
        np.testing.assert_allclose(matrix[:n, k], slope, rtol=0, atol=1e-8 * np.abs(slope).max())


def test_stiffer_bodies_move_like_rigid_ones(files, tmp_path):
    """The difference falls with one over the stiffness."""
    differences = []
    for modulus in (70, 210):
        text = bar(length=2.0, width=0.03, height=0.03, elements=8, reduction="modes: 2")
        body, _ = reduced(text.replace("210 GPa", f"{modulus} GPa"))
        write_body(body, tmp_path / "bar.nc")
        soft = pendulum((tmp_path, {}), "bar", modes=4, damping_ratio=0.5)
        rigid = soft.replace(
            bodies=(
                Body(
                    name="bar", mass=body.mass, centre_of_mass=tuple(body.centre_of_mass), inertia=body.inertia.tolist(),
                ),
            )
        )  # fmt: skip
        common = {"duration": 0.5, "output_interval": 0.05}
        expected = reference_run(rigid, step=1e-4, coordinates="absolute", **common)
        r = run(soft, integrator="radau", tolerance=1e-9, **common)
        differences.append(np.abs(tip_of(r) - tip_of(expected)).max())
    assert differences[1] == pytest.approx(differences[0] / 3.0, rel=0.1)


def test_cantilever_settles_at_the_deflection_of_the_closed_form(files):
    """ρ A g L⁴/(8 E I) under its own weight, along y where its side is 20 mm."""
    machine = pendulum(files, "clamped", damping_ratio=0.7)
    machine = machine.replace(
        joints=(Joint(name="wall", type="fixed", bodies=("ground", "bar"), point=(0, 0, 0)),),
        gravity=(0.0, -0.1, 0.0),
    )
    r = run(machine, integrator="generalised-alpha", step=1e-3, duration=2.0)
    expected = 7850 * 0.1 * 2.0**4 / (8 * 210e9 * 0.02**2 / 12)
    assert tip_of(r)[-1, 1] == pytest.approx(-expected, rel=5e-3)
    # the wall carries the weight and its moment
    weight = 7850 * 0.02 * 0.03 * 2.0 * 0.1
    assert r.joint_force[-1, 0, 1] == pytest.approx(-weight, rel=1e-4)
    assert r.joint_torque[-1, 0, 2] == pytest.approx(-weight, rel=1e-4)


def test_markers_away_from_interfaces_and_too_many_modes_are_named(files):
    machine = pendulum(files, "plain")
    away = machine.replace(markers=(Marker(name="tip", body="bar", position=(1.9, 0.0, 0.0)),))
    with pytest.raises(ModelError, match=r"at \(1.9, 0, 0\) m .* no interface.*tip at \(2, 0, 0\)"):
        run(away)
    with pytest.raises(ModelError, match="80 modes are asked for"):
        run(pendulum(files, "plain", modes=80))
    with pytest.raises(ModelError, match="no body file"):
        run(pendulum(files, "missing"))


def rubbing(files, **law):
    """(bar of a stiff flexible body on a hinge that rubs, the same bar as a rigid body)."""
    body = files[1]["stout"]
    machine = MachineRecord(
        name="rubbing",
        gravity=GRAVITY,
        bodies=(Body(name="bar", flexible=flexible(files, "stout", modes=2, damping_ratio=0.3)),),
        joints=(Joint(name="hinge", type="revolute", bodies=("ground", "bar"), point=(0, 0, 0), axis=(0, 0, 1)),),
        forces=(Friction(name="rub", coordinate="hinge.angle", **law),),
        markers=(Marker(name="tip", body="bar", position=(1.0, 0.0, 0.0)),),
        sensors=(Sensor(name="tip", marker="tip", quantity="position"),),
    )
    inertia = body.inertia.tolist()
    solid = Body(name="bar", mass=body.mass, centre_of_mass=tuple(body.centre_of_mass), inertia=inertia)
    return machine, machine.replace(bodies=(solid,))


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_friction_in_the_joint_of_a_stiff_body_is_that_of_a_rigid_one(files, coordinates):
    """Loaded by the joint's own reaction; in explicit and implicit methods."""
    machine, solid = rubbing(files, model="coulomb", coefficient=0.3, radius=0.05, transition_speed=0.01)
    common = {"duration": 0.5, "output_interval": 0.05, "coordinates": "absolute"}
    rigid = run(solid, step=1e-4, **common)
    assert rigid.dissipated_energy[-1] > 0.05 * rigid.kinetic_energy.max()
    for integrator in ("rk4", "generalised-alpha"):
        r = run(machine, integrator=integrator, step=1e-4, **common | {"coordinates": coordinates})
        assert r.finished.outcome == "done"
        assert np.abs(tip_of(r) - tip_of(rigid)).max() < 1e-4
        assert r.dissipated_energy[-1] == pytest.approx(rigid.dissipated_energy[-1], rel=1e-3)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_stiction_in_the_joint_of_a_flexible_body_is_that_of_an_explicit_method(files, coordinates):
    """A thick pin, on which the bar turns back; of order two against rk4 with a tenth of the step."""
    machine, _ = rubbing(files, model="stiction", coefficient=0.6, radius=0.3)
    common = {"duration": 1.5, "output_interval": 0.05}
    expected = reference_run(machine, integrator="rk4", coordinates="absolute", step=1e-4, **common)
    errors = []
    for step in (1e-3, 5e-4):
        r = run(machine, integrator="generalised-alpha", coordinates=coordinates, step=step, **common)
        assert r.finished.outcome == "done"
        errors.append(np.abs(tip_of(r) - tip_of(expected)).max())
    assert errors[1] < errors[0] / 3 < 1e-3
    assert r.dissipated_energy[-1] == pytest.approx(expected.dissipated_energy[-1], rel=1e-3)


@pytest.mark.parametrize(
    ("coordinates", "tolerance"), [("absolute", 1e-4), ("absolute", 1e-6), ("absolute", 3e-6), ("relative", 3e-6)]
)
def test_modes_that_leave_no_mass_to_the_frame_are_told(files, tmp_path, coordinates, tolerance):
    """A frame fixed to the root, all modes, and their shortening; whether the last step ends there or right before it."""
    body, _ = reduced(
        bar(width=0.01, height=0.01, elements=32, reduction="modes: 20, reference: root, stiffening: true")
    )
    write_body(body, tmp_path / "bar.nc")
    r = run(pendulum((tmp_path, {}), "bar"), integrator="radau", tolerance=tolerance, coordinates=coordinates)
    assert r.finished.outcome == "failed"
    message, advice, _ = r.finished.failure
    assert "the modes of bar take up all the mass" in message
    assert "mean-axis" in advice


def test_a_flexible_body_has_a_mode(files):
    with pytest.raises(ModelError, match="at least 1"):
        pendulum(files, "plain", modes=0)
