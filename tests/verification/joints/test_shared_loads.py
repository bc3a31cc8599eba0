"""Loads of redundant hinges: shared by least norm in all coordinates and analyses."""

import numpy as np
import pytest

from nivel import Body, Driver, Joint, JointSpringDamper, MachineRecord, PointForce, SimulationSettings
from nivel.analysis.plan.plan import plan_run
from nivel.analysis.run.stepping import Simulation
from nivel.analysis.sweep.patched import PatchedRuns, learn, read_values
from nivel.api import Machine
from running import run

# N: iterations leave a share of 1e-9
EXACT = 1e-6
MASS, WIDTH, INERTIA, GRAVITY = 30.0, 0.5, 2.0, 9.81
HEIGHTS = {"two": (-0.8, 0.8), "three": (-0.8, 0.1, 0.7)}


def door(heights, **settings):
    """A door on hinges of one vertical axis, its centre of mass WIDTH beside it and at height zero."""
    return MachineRecord(
        name="door",
        gravity=(0.0, 0.0, -GRAVITY),
        bodies=(Body(name="door", mass=MASS, inertia=(3.0, INERTIA, 1.0), position=(WIDTH, 0.0, 0.0)),),
        joints=tuple(
            Joint(name=f"h{k}", type="revolute", bodies=("ground", "door"), point=(0.0, 0.0, h), axis=(0.0, 0.0, 1.0))
            for k, h in enumerate(heights)
        ),
        simulation=SimulationSettings(**{"duration": 2e-3, "step": 1e-3, "output_interval": 1e-3, **settings}),
    )


def shares(heights, spin=0.0):
    """Forces (n, 3) and torques (n, 3) on the ground in axes of the door: least Σ D λ² with D = C_q M⁻¹ C_qᵀ of each row.

    Vertical forces carry the weight alike. The moment m g a about y is carried by forces F_k at heights h_k, D_k = 1/m + h_k²/J, and by
    torques N, D = 1/J: Σ h_k F_k + n N = m g a and Σ F_k = m a ω², so D_k F_k = α h_k + β and N = α J.
    """
    h, n = np.array(heights), len(heights)
    D = 1.0 / MASS + h**2 / INERTIA
    A = np.array([[np.sum(h * h / D) + n * INERTIA, np.sum(h / D)], [np.sum(h / D), np.sum(1.0 / D)]])
    alpha, beta = np.linalg.solve(A, [MASS * GRAVITY * WIDTH, MASS * WIDTH * spin**2])
    forces, torques = np.zeros((n, 3)), np.zeros((n, 3))
    forces[:, 0], forces[:, 2] = (alpha * h + beta) / D, -MASS * GRAVITY / n
    torques[:, 1] = alpha * INERTIA
    return forces, torques


@pytest.mark.parametrize("integrator", ["rk4", "generalised-alpha"])
@pytest.mark.parametrize("coordinates", ["absolute", "independent", "relative"])
@pytest.mark.parametrize("heights", HEIGHTS.values(), ids=HEIGHTS)
def test_hinges_of_a_door_share_its_weight(heights, coordinates, integrator):
    result = run(door(heights, coordinates=coordinates, integrator=integrator))
    forces, torques = shares(heights)
    for frame in range(len(result.time)):
        np.testing.assert_allclose(result.joint_force[frame], forces, atol=EXACT)
        np.testing.assert_allclose(result.joint_torque[frame], torques, atol=EXACT)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_they_share_it_in_equilibria_and_step_by_step(coordinates):
    heights = HEIGHTS["three"]
    record = door(heights, coordinates=coordinates)
    forces, torques = shares(heights)
    # a spring holds it where it hangs
    spring = JointSpringDamper(name="spring", coordinate="h0.angle", stiffness=10.0)
    rest = Machine.from_record(record.replace(forces=(spring,))).statics(coordinates=coordinates)
    np.testing.assert_allclose(rest.array("joint_force")[-1], forces, atol=EXACT)
    np.testing.assert_allclose(rest.array("joint_torque")[-1], torques, atol=EXACT)
    stepped = record.replace(simulation=record.simulation.replace(integrator="rk4"))
    simulation = Simulation(plan_run(stepped), record=True)
    simulation.step()
    np.testing.assert_allclose(simulation["joint_force"], forces, atol=EXACT)
    np.testing.assert_allclose(simulation.result().array("joint_force")[-1], forces, atol=EXACT)


def test_they_share_the_centripetal_force_of_a_door_that_is_driven():
    """Kinematics, in relative coordinates, from a position over a whole turn: rows, whose length is least, have axes of the ground."""
    heights, spin = HEIGHTS["three"], 4.0 * np.pi
    record = door(heights).replace(drivers=(Driver(name="motor", coordinate="h0.angle", speed=spin),))
    result = Machine.from_record(record).kinematics(duration=0.5, positions=5)
    forces, torques = shares(heights, spin)
    for frame in (0, -1):
        np.testing.assert_allclose(result.array("joint_force")[frame], forces, atol=1e-9 * MASS * spin**2)
        np.testing.assert_allclose(result.array("joint_torque")[frame], torques, atol=1e-9 * MASS * spin**2)


def test_variants_of_a_batch_share_them():
    """Variants whose numbers are patched have the loads of runs that are prepared one by one."""
    machine = Machine.from_record(door(HEIGHTS["three"], coordinates="relative", integrator="rk4"))
    runs = PatchedRuns(learn(machine, [{"bodies.door.mass": 20.0}, {"bodies.door.mass": 40.0}]))
    for mass in (25.0, 35.0):
        values = {"bodies.door.mass": mass}
        frames = runs.run(read_values(values))
        assert frames is not None
        alone = machine.with_values(values).simulate(verify=False)
        np.testing.assert_allclose(runs.result(frames).array("joint_force"), alone.array("joint_force"), atol=EXACT)
        assert alone.array("joint_force")[-1, 0, 2] == pytest.approx(-mass * GRAVITY / 3.0, rel=1e-8)


def test_a_linkage_that_moves_shares_side_loads_alike_in_all_coordinates():
    """A four-bar linkage with four hinges and a force across its plane falls: loads are those of its place, not of where the run began."""
    ends = {"crank": ((0.0, 0.0), (0.1, 0.2)), "rod": ((0.1, 0.2), (0.6, 0.4)), "rocker": ((0.6, 0.4), (0.5, 0.0))}
    bodies = [
        Body(name=name, mass=1.0, inertia=(0.02, 0.03, 0.01), position=((p[0] + q[0]) / 2, 0.0, (p[1] + q[1]) / 2))
        for name, (p, q) in ends.items()
    ]
    links = ("ground", *ends, "ground")
    joints = [
        Joint(name=f"h{k}", type="revolute", bodies=links[k : k + 2], point=(x, 0.0, z), axis=(0.0, 1.0, 0.0))
        for k, (x, z) in enumerate([*(p for p, _ in ends.values()), (0.5, 0.0)])
    ]
    record = MachineRecord(
        name="linkage",
        gravity=(0.0, 0.0, -GRAVITY),
        bodies=tuple(bodies),
        joints=tuple(joints),
        forces=(PointForce(name="side", body="rod", vector=(0.0, 30.0, 0.0), position=(0.1, 0.0, 0.0)),),
        simulation=SimulationSettings(duration=0.2, step=1e-3, output_interval=0.05, integrator="rk4"),
    )
    runs = [
        run(record.replace(simulation=record.simulation.replace(coordinates=coordinates)))
        for coordinates in ("absolute", "independent", "relative")
    ]
    assert np.ptp(runs[0].joint_coordinate[:, 0]) > 0.1
    for other in runs[1:]:
        np.testing.assert_allclose(other.joint_force, runs[0].joint_force, atol=1e-5)
        np.testing.assert_allclose(other.joint_torque, runs[0].joint_torque, atol=1e-5)
