"""The energy–momentum method: energy and momenta are kept at any step, with order two, and what it refuses."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import machines
from nivel import Body, Bushing, MachineRecord, Marker, SpringDamper
from nivel.errors import ModelError
from running import reference_run, run
from stiff_machines import elastic_pendulum

pytestmark = pytest.mark.covering

METHOD = {"integrator": "energy-momentum", "stabilisation": "none"}


def momenta(machine, r):
    """Linear (time, 3) and angular momentum (time, 3) about the origin, from what the run stored; inertia about the centres of mass."""
    linear, angular = np.zeros((len(r.time), 3)), np.zeros((len(r.time), 3))
    for k, body in enumerate(machine.bodies):
        A = Rotation.from_quat(r.orientation[:, k], scalar_first=True).as_matrix()
        c = A @ np.array(body.centre_of_mass)
        w = r.angular_velocity[:, k]
        p = body.mass * (r.velocity[:, k] + np.cross(w, c))
        J = r.prepared.motion.system.record.bodies.inertia_b[k]
        linear += p
        angular += np.cross(r.position[:, k] + c, p) + np.einsum("tij,jk,tlk,tl->ti", A, J, A, w)
    return linear, angular


def span(values):
    return np.abs(values - values[0]).max()


def flying(*, gravity=(0.0, 0.0, 0.0), damping=0.0):
    """Three tumbling bodies on joints of every sort of row, with a spring and a bushing between them; nothing touches the ground."""
    rng = np.random.default_rng(7)
    bodies = tuple(machines.random_body(name, rng) for name in "abc")
    joints = (
        machines.joint_at("knee", "universal", "a", "b", rng),
        machines.joint_at("slot", "cylindrical", "b", "c", rng),
    )
    ends = Marker(body="a", position=(0.3, 0.1, -0.2)), Marker(body="c", position=(-0.2, 0.4, 0.1))
    forces = (
        SpringDamper(name="spring", markers=ends, stiffness=300.0, free_length=0.4, damping=damping),
        Bushing(name="mount", markers=ends, stiffness=(40.0, 30.0, 20.0, 3.0, 2.0, 1.0)),
    )
    return MachineRecord(name="flying", bodies=bodies, joints=joints, forces=forces, gravity=gravity)


@pytest.mark.parametrize("step", [1e-3, 2e-2])
def test_a_machine_that_flies_keeps_its_energy_and_its_momenta(step):
    machine = flying()
    r = run(machine, **METHOD, step=step, duration=2.0, output_interval=0.02)
    assert r.finished.outcome == "done"
    linear, angular = momenta(machine, r)
    assert np.abs(r.energy_error).max() < 1e-9 * r.kinetic_energy.max()
    # some 1e-12 of the velocities are left in each of up to 2000 steps
    assert span(linear) < 1e-9 * np.abs(linear).max()
    assert span(angular) < 1e-9 * np.abs(angular).max()
    assert np.abs(r.constraint_violation).max() < 1e-9
    # the machine does move within itself, and its springs do work
    assert np.ptp(r.potential_energy) > 0.1 * r.kinetic_energy.max()


def test_other_methods_do_not():
    """The measure of what is shown above."""
    machine = flying()
    r = run(machine, integrator="newmark", step=2e-2, duration=2.0, output_interval=0.02, coordinates="absolute")
    _, angular = momenta(machine, r)
    assert np.abs(r.energy_error).max() > 1e-4 * r.kinetic_energy.max()
    assert span(angular) > 1e-5 * np.abs(angular).max()


def test_two_point_masses_on_a_spring():
    """They turn about each other; about their line nothing has any inertia."""
    bodies = (
        Body(name="a", mass=1.0, point_mass=True, velocity=(0.0, 1.0, 0.2)),
        Body(name="b", mass=2.0, point_mass=True, position=(0.5, 0.0, 0.0), velocity=(0.3, -0.5, 0.0)),
    )
    ends = Marker(body="a"), Marker(body="b")
    forces = (SpringDamper(name="spring", markers=ends, stiffness=50.0, free_length=0.4),)
    machine = MachineRecord(name="two", bodies=bodies, forces=forces)
    r = run(machine, **METHOD, step=1e-2, duration=5.0, output_interval=0.05)
    assert r.finished.outcome == "done"
    mass = np.array([1.0, 2.0])[:, None]
    angular = np.sum(np.cross(r.position, mass * r.velocity), axis=1)
    assert np.abs(r.energy_error).max() < 1e-9 * r.kinetic_energy.max()
    assert span(angular) < 1e-10 * np.abs(angular).max()
    assert np.all(r.angular_velocity == 0.0)


def test_in_gravity_a_flying_machine_falls_and_keeps_its_energy():
    machine = flying(gravity=(0.0, -9.81, 0.0))
    r = run(machine, **METHOD, step=5e-3, duration=1.0, output_interval=0.05)
    assert r.finished.outcome == "done"
    mass = sum(body.mass for body in machine.bodies)
    linear, _ = momenta(machine, r)
    fallen = linear - linear[0] - np.outer(r.time, [0.0, -9.81 * mass, 0.0])
    assert np.abs(fallen).max() < 1e-10 * np.abs(linear).max()
    assert np.abs(r.energy_error).max() < 1e-9 * r.kinetic_energy.max()


def test_heavy_top_keeps_energy_and_its_momentum_about_the_vertical():
    machine = machines.heavy_top()
    r = run(machine, **METHOD, step=1e-3, duration=1.0, output_interval=0.01)
    assert r.finished.outcome == "done"
    _, angular = momenta(machine, r)
    vertical = int(np.argmax(np.abs(machine.gravity)))
    assert span(angular[:, vertical]) < 1e-9 * np.abs(angular).max()
    assert np.abs(r.energy_error).max() < 1e-9 * r.kinetic_energy.max()


@pytest.mark.parametrize("machine", [machines.slider_crank(), machines.four_bar(), flying(), flying(damping=5.0)])
def test_order_two(machine):
    common = {"duration": 0.4, "output_interval": 0.02, "coordinates": "absolute"}
    fine = reference_run(machine, integrator="dop853", tolerance=1e-11, **common)
    errors, rates = [], []
    for step in (4e-3, 2e-3, 1e-3):
        r = run(machine, **METHOD, step=step, **common)
        errors.append([np.abs(getattr(r, name) - getattr(fine, name)).max() for name in ("position", "velocity")])
        rates.append(np.abs(r.constraint_rate_violation).max())
    slopes = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert np.all(np.abs(slopes - 2.0) < 0.1)
    # velocities are closed in the mean over a step only
    assert abs(np.log2(rates[0] / rates[1]) - 2.0) < 0.1


def test_energy_balance_holds_with_dampers():
    r = run(flying(damping=5.0), **METHOD, step=5e-3, duration=2.0, output_interval=0.05)
    assert r.finished.outcome == "done"
    assert r.dissipated_energy[-1] > 0.01 * r.kinetic_energy.max()
    assert np.abs(r.energy_error).max() < 1e-9 * r.kinetic_energy.max()


def test_a_spring_far_above_the_step_keeps_its_energy():
    """Its period is a sixth of the step."""
    machine = elastic_pendulum(1e6)
    machine = machine.replace(bodies=(machine.bodies[0], machine.bodies[1].replace(position=(1.001, 0, 0))))
    r = run(machine, **METHOD, step=2e-2, duration=2.0, output_interval=2e-2, coordinates="absolute")
    assert r.finished.outcome == "done"
    assert np.abs(r.energy_error).max() < 1e-8 * r.kinetic_energy.max()


def test_constraints_that_are_no_products_keep_the_energy():
    """A screw's turn and way: its row does work at the mean place, which the push gives back."""
    rng = np.random.default_rng(3)
    machine = machines.pair("screw", rng).replace(forces=(), gravity=(0.0, 0.0, 0.0))
    r = run(machine, **METHOD, step=1e-2, duration=2.0, output_interval=0.05)
    assert r.finished.outcome == "done"
    _, angular = momenta(machine, r)
    assert np.abs(r.energy_error).max() < 1e-9 * r.kinetic_energy.max()
    assert span(angular) < 1e-10 * np.abs(angular).max()


def test_a_free_body_at_any_step():
    """No joint, no force: two axes of its motion are kept at half a turn a step."""
    body = Body(
        name="b", mass=2.0, inertia=(0.1, 0.2, 0.25), angular_velocity=(0.3, 5.0, 0.2), centre_of_mass=(0.1, 0, 0)
    )
    machine = MachineRecord(name="free", bodies=(body,))
    r = run(machine, **METHOD, step=0.4, duration=40.0, output_interval=0.4)
    assert r.finished.outcome == "done"
    _, angular = momenta(machine, r)
    assert np.abs(r.energy_error).max() < 1e-10 * r.kinetic_energy.max()
    assert span(angular) < 1e-10 * np.abs(angular).max()


@pytest.mark.parametrize(
    ("settings", "field"),
    [
        ({"stabilisation": "direct"}, "simulation.stabilisation"),
        ({"coordinates": "relative"}, "simulation.coordinates"),
        ({"formulation": "lagrange"}, "simulation.formulation"),
        ({"corrector": {"iteration": "functional"}}, "simulation.corrector.iteration"),
        ({"step_control": "error"}, "simulation.step_control"),
    ],
)
def test_what_does_not_go_with_it_is_refused(settings, field):
    with pytest.raises(ModelError) as caught:
        run(machines.four_bar(), **{**METHOD, **settings})
    assert [fault.path for fault in caught.value.faults] == [field]
