"""The energy–momentum method with flexible bodies: energy and momenta are kept at any step, with order two."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from nivel import Beam, Body, Bushing, Friction, Joint, MachineRecord, Marker, PointForce
from running import reference_run, run
from tree_machines import MACHINES, beam, hinge, machine, write_beams

pytestmark = pytest.mark.covering

METHOD = {"integrator": "energy-momentum", "stabilisation": "none", "coordinates": "absolute"}


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    """Bars of a hundredth of the stiffness of steel, which bend by centimetres."""
    return write_beams(tmp_path_factory.mktemp("limp"), modulus=2)


@pytest.fixture(scope="session")
def steel(tmp_path_factory):
    return write_beams(tmp_path_factory.mktemp("steel"))


def momenta(r):
    """(time, 3) linear and angular momentum about the origin: of flexible bodies from first moment, inertia and coupling of each frame."""
    motion = r.prepared.motion
    record, own = motion.system.record, motion.system.record.flexible
    flexible = {int(b): f for f, b in enumerate(own.body)}
    linear, angular = np.zeros((2, len(r.time), 3))
    for t in range(len(r.time)):
        A = Rotation.from_quat(r.orientation[t], scalar_first=True).as_matrix()
        w = np.einsum("bji,bj->bi", A, r.angular_velocity[t])
        q, v = np.column_stack([r.position[t], r.orientation[t]]), np.column_stack([r.velocity[t], w])
        parts = [q.ravel(), r.modal_coordinate[t], v.ravel(), r.modal_rate[t], np.zeros(len(record.elements.state) + 2)]
        motion.evaluate(0.0, np.concatenate(parts))
        for b in range(len(A)):
            V, m = A[b].T @ r.velocity[t, b], record.bodies.mass[b]
            if b in flexible:
                f = flexible[b]
                first, last = own.mode[f]
                rates, B = r.modal_rate[t, first:last], own.coupling[f][:, : last - first]
                S, J = own.first[f], own.inertia[f]
                p, h = m * V + np.cross(w[b], S) + B[:3] @ rates, np.cross(S, V) + J @ w[b] + B[3:] @ rates
            else:
                S = m * record.bodies.centre_b[b]
                p, h = m * V + np.cross(w[b], S), np.cross(S, V) + record.bodies.inertia_origin_b[b] @ w[b]
            linear[t] += A[b] @ p
            angular[t] += A[b] @ h + np.cross(r.position[t, b], A[b] @ p)
    return linear, angular


def span(values):
    return np.abs(values - values[0]).max() / np.abs(values).max()


def energy_error(r):
    assert r.finished.outcome == "done"
    return np.abs(r.energy_error).max() / r.kinetic_energy.max()


def struck(folder, file, gravity=(0, 0, 0)):
    """A bar that tumbles and is struck in its middle for 50 ms: it bends, and vibrates from then on."""
    blow = PointForce(
        name="blow",
        body="a",
        position=(0.5, 0, 0),
        vector=(0, "8 N*max(0, 1 - time/(50 ms))", "5 N*max(0, 1 - time/(50 ms))"),
    )
    bar = beam(folder, "a", (0, 0, 0), file=file, modes=4, angular_velocity=(0.5, 3.0, 4.0), velocity=(1, 0, 0.5))
    bar = bar.replace(flexible=bar.flexible.replace(damping_ratio=0.0))
    return MachineRecord(name="struck", gravity=gravity, bodies=(bar,), forces=(blow,))


@pytest.mark.parametrize("file", ["soft", "beam"])
@pytest.mark.parametrize("step", [5e-3, 1e-3])
def test_a_free_body_keeps_its_energy_and_its_momenta(folder, file, step):
    """With geometric stiffening too. The longer step is longer than the periods of some of its modes."""
    r = run(struck(folder, file), **METHOD, step=step, duration=1.0, output_interval=0.01)
    assert energy_error(r) < 1e-9
    free = r.time > 0.06
    for values in momenta(r):
        assert span(values[free]) < 1e-9
        assert span(values) > 1e-3
    # it does bend, and gives energy from one to the other
    assert np.ptp(r.potential_energy[free]) > 1e-6 * r.kinetic_energy.max()


def test_inertia_forces_miss_nothing_without_stiffening(folder):
    """Where the mass matrix is quadratic in the modes, the mean force does the work exactly; with stiffening, nearly."""
    missed = {}
    for file in ("soft", "beam"):
        r = run(struck(folder, file), **METHOD, step=5e-3, duration=0.5, output_interval=0.01)
        missed[file] = (
            np.abs(r.prepared.motion.system.record.residual.interval.defect).max() * 5e-3 / r.kinetic_energy.max()
        )
    assert missed["soft"] < 1e-13
    assert 1e-15 < missed["beam"] < 1e-5


def test_in_gravity_a_free_body_falls_and_keeps_its_energy(folder):
    r = run(struck(folder, "beam", (0.0, -9.81, 0.0)), **METHOD, step=5e-3, duration=1.0, output_interval=0.05)
    assert energy_error(r) < 1e-9
    free = r.time > 0.06
    linear, _ = momenta(r)
    mass = r.prepared.motion.system.record.bodies.mass.sum()
    fallen = linear[free] - np.outer(r.time[free], [0.0, -9.81 * mass, 0.0])
    assert np.abs(fallen - fallen[0]).max() < 1e-9 * np.abs(linear).max()


def pair(folder, file, joint):
    """Two bars that tumble on a joint, with a bushing between their middles; nothing touches the ground."""
    bodies = [
        beam(folder, "a", (0, 0, 0), file=file, angular_velocity=(0.5, 9.0, 12.0), velocity=(1, 0, 0.5)),
        beam(folder, "b", (1, 0, 0), file=file, angular_velocity=(0.5, -9.0, 12.0)),
    ]
    bodies = [each.replace(flexible=each.flexible.replace(damping_ratio=0.0)) for each in bodies]
    ends = Marker(body="a", position=(0.5, 0, 0)), Marker(body="b", position=(0.5, 0, 0))
    mount = Bushing(name="mount", markers=ends, stiffness=(4.0, 3.0, 2.0, 0.3, 0.2, 0.1))
    return MachineRecord(name="pair", bodies=tuple(bodies), joints=(joint,), forces=(mount,), gravity=(0, 0, 0))


@pytest.mark.parametrize("file", ["soft", "beam"])
@pytest.mark.parametrize("kind", ["revolute", "translational"])
@pytest.mark.parametrize("step", [5e-3, 1e-3])
def test_two_bodies_on_a_joint_keep_energy_and_momenta(folder, file, kind, step):
    r = run(
        pair(folder, file, hinge("j", "a", "b", 1.0, kind=kind)),
        **METHOD,
        step=step,
        duration=0.4,
        output_interval=0.02,
    )
    assert energy_error(r) < 1e-9
    for values in momenta(r):
        assert span(values) < 1e-9
    assert np.abs(r.constraint_violation).max() < 1e-12
    assert np.ptp(r.potential_energy) > 1e-3 * r.kinetic_energy.max()


def test_other_methods_do_not(folder):
    """The measure of what is shown above."""
    machine = pair(folder, "beam", hinge("j", "a", "b", 1.0))
    r = run(machine, integrator="newmark", step=5e-3, duration=0.4, output_interval=0.02, coordinates="absolute")
    assert energy_error(r) > 1e-5
    assert span(momenta(r)[1]) > 1e-5


@pytest.mark.parametrize("name", MACHINES)
@pytest.mark.parametrize("step", [5e-3, 1e-3])
def test_energy_is_balanced_in_all_machines(folder, name, step):
    """With dampers, loads, drivers and rigid bodies beside, and modes that are damped."""
    r = run(MACHINES[name](folder), **METHOD, step=step, duration=0.2, output_interval=0.01)
    assert energy_error(r) < 1e-9
    assert np.abs(r.constraint_violation).max() < 1e-11


@pytest.mark.parametrize("name", ["flying", "spinning", "chain", "loop"])
def test_order_two(folder, name):
    """Of the motion, where the step follows the modes; velocities are closed in the mean over a step only."""
    common = {"duration": 0.1, "output_interval": 0.02, "coordinates": "absolute"}
    record = MACHINES[name](folder)
    fine = reference_run(record, integrator="dop853", tolerance=1e-11, **common)
    errors = []
    for step in (1e-3, 5e-4, 2.5e-4):
        r = run(record, **METHOD | common, step=step)
        errors.append(
            [np.abs(getattr(r, part) - getattr(fine, part)).max() for part in ("position", "modal_coordinate")]
        )
    slopes = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    np.testing.assert_allclose(slopes, 2.0, atol=0.2)


def test_a_hung_body_keeps_its_momentum_about_the_vertical(folder):
    bar = beam(folder, "a", (0, 0, 0), file="beam", angular_velocity=(0.0, 1.0, 3.0))
    bar = bar.replace(flexible=bar.flexible.replace(damping_ratio=0.0))
    ball = Joint(name="ball", type="spherical", bodies=("ground", "a"), point=(0, 0, 0))
    record = MachineRecord(name="hung", gravity=(0, 0, -9.81), bodies=(bar,), joints=(ball,))
    r = run(record, **METHOD, step=2e-3, duration=0.5, output_interval=0.02)
    assert energy_error(r) < 1e-9
    _, angular = momenta(r)
    assert np.abs(angular[:, 2] - angular[0, 2]).max() < 1e-9 * np.abs(angular).max()
    assert np.ptp(angular[:, 1]) > 0.1 * np.abs(angular).max()


def test_modes_far_above_the_step_keep_their_energy(steel):
    """The fastest period is a fifth of the step."""
    r = run(MACHINES["pendulum"](steel), **METHOD, step=1e-2, duration=2.0, output_interval=0.02)
    highest = np.sqrt(r.prepared.motion.system.record.flexible.stiffness.max())
    assert 1e-2 * highest > 5 * 2 * np.pi
    assert energy_error(r) < 1e-9


def test_friction_is_that_of_an_implicit_method(steel):
    """Loaded by the reaction of the joint, which here is the mean over a step."""
    rub = Friction(
        name="rub", model="coulomb", coordinate="root.angle", coefficient=0.3, radius=0.05, transition_speed=0.01
    )
    record = MACHINES["pendulum"](steel).replace(forces=(rub,))
    common = {"step": 5e-4, "duration": 0.2, "output_interval": 0.02}
    expected = reference_run(record, integrator="generalised-alpha", coordinates="absolute", **common)
    r = run(record, **METHOD, **common)
    assert energy_error(r) < 1e-8
    assert r.dissipated_energy[-1] == pytest.approx(expected.dissipated_energy[-1], rel=1e-3)
    np.testing.assert_allclose(r.position, expected.position, atol=1e-5)


def test_a_stiff_body_moves_like_a_rigid_one(steel):
    """In the middle of a machine of rigid bodies."""
    from nivel.flexible.body.body_file import read_body

    body = read_body(steel / "beam.nc")
    record = machine("stiff", [beam(steel, "a", (0, 0, 0))], [hinge("r", "ground", "a", 0.0)])
    its = {"mass": body.mass, "centre_of_mass": tuple(body.centre_of_mass), "inertia": body.inertia.tolist()}
    rigid = record.replace(bodies=(Body(name="a", **its),))
    common = {"step": 2e-3, "duration": 0.3, "output_interval": 0.02}
    found, expected = (run(each, **METHOD, **common) for each in (record, rigid))
    np.testing.assert_allclose(found.position, expected.position, atol=1e-3)


def test_beams_of_consistent_mass_beside_a_flexible_body_keep_their_energy(folder):
    """A geometrically exact beam between two flexible bars, all flying."""
    section = {
        "type": "general",
        "stiffness": (2e4, 1e4, 1.2e4, 20, 30, 40),
        "mass": 1.0,
        "inertia": (2e-3, 1e-3, 1.2e-3),
    }
    rod = Beam(
        name="rod",
        **{"from": (1, 0, 0), "to": (2, 0, 0)},
        section=section,
        elements=3,
        angular_velocity=(0.3, 2.0, 3.0),
    )
    bars = (
        beam(folder, "a", (0, 0, 0), angular_velocity=(0.3, 2.0, 3.0), velocity=(0, -3.0, 2.0)),
        beam(folder, "b", (2, 0, 0), angular_velocity=(0.3, 2.0, 3.0), velocity=(0, 3.0, -2.0)),
    )
    bars = tuple(bar.replace(flexible=bar.flexible.replace(damping_ratio=0.0)) for bar in bars)
    joints = (hinge("left", "a", "rod.start", 1), hinge("right", "rod.end", "b", 2, axis=(0, 0.8, -0.6)))
    flying = MachineRecord(name="flying", gravity=(0, 0, 0), bodies=bars, beams=(rod,), joints=joints)
    r = run(flying, **METHOD, step=1e-3, duration=0.5, output_interval=0.01)
    assert energy_error(r) < 1e-9
    assert float(r.potential_energy.max()) > 1e-3
