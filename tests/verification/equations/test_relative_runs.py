"""Runs in relative coordinates: what is conserved, what is at round-off, and that no choice of tree or method shows in the motion."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import linked
import machines
from nivel.system.states.relative import tree_of
from running import run
from simulating import G, hinge, simulate, wheel

pytestmark = pytest.mark.covering

MOTION = ("position", "orientation", "velocity", "angular_velocity", "acceleration", "angular_acceleration")


def same_motion(a, b, tolerance, variables=MOTION):
    for name in variables:
        x, y = getattr(a, name), getattr(b, name)
        np.testing.assert_allclose(y, x, atol=tolerance * (1 + np.abs(x).max(initial=0)), err_msg=name)


def momenta(r):
    """Linear momentum and angular momentum about the origin (time, 3) of all bodies."""
    linear, angular = np.zeros((len(r.time), 3)), np.zeros((len(r.time), 3))
    bodies = r.prepared.absolute.system.record.bodies
    for b in range(len(bodies.mass)):
        A = Rotation.from_quat(r.orientation[:, b], scalar_first=True).as_matrix()
        omega, c = r.angular_velocity[:, b], A @ bodies.centre_b[b]
        p = bodies.mass[b] * (r.velocity[:, b] + np.cross(omega, c))
        linear += p
        angular += np.cross(r.position[:, b] + c, p)
        angular += np.einsum("tij,jk,tlk,tl->ti", A, bodies.inertia_b[b], A, omega)
    return linear, angular


FREE = {
    "tree": lambda: linked.marked_tree(np.random.default_rng(11), free=True, branches=1),
    "ring": lambda: linked.record(linked.free_ring()),
}


@pytest.mark.parametrize("name", FREE)
def test_momentum_and_energy_of_free_machines_stay(name):
    """No gravity, inner joints only: what is left is the error of RK4, of order four."""
    errors = []
    for step in (4e-3, 2e-3):
        machine = FREE[name]().replace(gravity=(0, 0, 0))
        r = run(machine, duration=0.4, step=step, output_interval=0.04, coordinates="relative")
        scales = 1.0 + np.abs(momenta(r)[1]).max()
        change = max(np.abs(value - value[0]).max() for value in momenta(r)) / scales
        errors.append(max(change, np.abs(r.energy_error).max() / r.kinetic_energy.max()))
    assert errors[1] < 1e-6
    assert errors[0] / errors[1] > 2**3.3


LOOPED = {
    "slider-crank": (machines.slider_crank, 1e-3),
    "four-bar": (machines.four_bar, 1e-3),
    "loops": (lambda: linked.record(linked.loops()), 5e-4),
    "free ring": (lambda: linked.record(linked.free_ring()), 5e-4),
}


@pytest.mark.parametrize("name", LOOPED)
def test_every_joint_may_be_cut(name):
    """The motion and the reactions are those of absolute coordinates whatever joint opens the loop, and whatever number of them."""
    make, step = LOOPED[name]
    machine = make()
    settings = {"duration": 0.2, "step": step, "output_interval": 0.02}
    expected = run(machine, coordinates="absolute", **settings)
    names = [joint.name for joint in machine.joints]
    for cut in ((), *((name,) for name in names), tuple(names), tuple(names[::2])):
        r = run(machine, coordinates="relative", cut=cut, **settings)
        assert set(cut) <= {names[k] for k in tree_of(machine, machine.simulation.replace(cut=cut)).cut}
        same_motion(expected, r, 1e-8, (*MOTION, "joint_force", "joint_torque", "joint_coordinate", "joint_rate"))


@pytest.mark.parametrize("name", ["four-bar of revolutes", "bennett"])
def test_every_joint_of_a_redundant_loop_may_be_cut(name):
    """Rows too many: the loop loses three (planar) or three (Bennett, 1903) wherever it is cut, the motion does not show it."""
    machine = machines.four_bar("revolute", "revolute") if name != "bennett" else machines.bennett()
    settings = {"duration": 0.2, "step": 1e-3, "output_interval": 0.02}
    expected = run(machine, coordinates="absolute", **settings)
    assert len(expected.prepared.redundancy.redundant_rows) == 3
    for joint in machine.joints:
        r = run(machine, coordinates="relative", cut=(joint.name,), **settings)
        system = r.prepared.motion.system
        assert len(system.record.saddle.row) == 5
        assert system.record.control.rank[0] == 2
        same_motion(expected, r, 1e-8)


@pytest.mark.parametrize("formulation", ["newton-euler", "penalty", "augmented-lagrangian"])
@pytest.mark.parametrize("stabilisation", ["none", "baumgarte", "direct", "geometric"])
@pytest.mark.parametrize("redundant", [False, True])
def test_all_methods_make_the_same_motion(formulation, stabilisation, redundant):
    if stabilisation == "baumgarte" and formulation != "newton-euler":
        pytest.skip("refused: penalties feed violations back themselves")
    machine = machines.four_bar("revolute", "revolute") if redundant else machines.slider_crank()
    settings = {"duration": 0.3, "step": 5e-4, "output_interval": 0.03}
    expected = run(machine, coordinates="absolute", **settings)
    if stabilisation == "baumgarte":
        # with coefficients of the order of 1/step stages off the constraints disturb the motion: order one
        settings["baumgarte"] = {"alpha": 50.0, "beta": 50.0}
    r = run(machine, coordinates="relative", formulation=formulation, stabilisation=stabilisation, **settings)
    assert r.finished.outcome == "done"
    same_motion(expected, r, 1e-5 if formulation == "penalty" else 1e-7)


@pytest.mark.parametrize("name", ["slider-crank", "heavy-top", "loops"])
def test_rk4_converges_with_order_four(name):
    make, step = {
        "slider-crank": (machines.slider_crank, 8e-3),
        "heavy-top": (machines.heavy_top, 1e-3),
        "loops": (lambda: linked.record(linked.loops()), 4e-3),
    }[name]

    def end(step):
        r = run(make(), duration=0.2, step=step, coordinates="relative", stabilisation="none")
        return np.concatenate([r.position[-1], r.orientation[-1], r.velocity[-1], r.angular_velocity[-1]], axis=None)

    values = [end(step / 2**halvings) for halvings in range(4)]
    differences = [np.abs(a - b).max() for a, b in pairwise(values)]
    slopes = np.log2(np.array(differences[:-1]) / differences[1:])
    assert np.all(slopes > 3.7)


@pytest.mark.parametrize("stabilisation", ["none", "direct", "geometric"])
def test_joints_that_carry_stay_closed_to_round_off(stabilisation):
    machine = linked.record(linked.loops())
    r = run(machine, duration=0.5, step=1e-3, coordinates="relative", stabilisation=stabilisation)
    system = r.prepared.motion.system
    left = set(system.record.saddle.row.tolist())
    carried = [row for row in range(len(system.rows)) if row not in left]
    assert carried
    assert left
    scale = system.record.constraints.scale
    assert np.all(np.abs(r.constraint_violation[:, carried]) <= 1e-13 * scale[carried])
    speed = max(1.0, np.abs(r.velocity).max(), np.abs(r.angular_velocity).max())
    assert np.all(np.abs(r.constraint_rate_violation[:, carried]) <= 1e-12 * speed * scale[carried])
    if stabilisation != "none":
        assert np.all(np.abs(r.constraint_violation) <= 1e-11 * scale)


@pytest.mark.parametrize("kind", ["revolute", "cylindrical", "screw", "planar", "universal"])
def test_angles_are_counted_over_many_turns(kind):
    """A wheel that turns at a constant rate: no angle is lost, and the advance of a screw is its pitch a turn."""
    rate = 40.0
    if kind == "universal":
        # the cross of a universal joint turns about its arm on the ground with the body, of equal moments
        joint = {"type": kind, "bodies": ["ground", "w"], "point": [0, 0, 0], "axes": [[0, 0, 1], [1, 0, 0]],
                 "start_rates": {"angle_1": rate, "angle_2": 0.0}}  # fmt: skip
    else:
        joint = {
            "type": kind,
            "bodies": ["ground", "w"],
            "point": [0, 0, 0],
            "axis": [0, 0, 1],
            "start_rates": {"angle": rate},
        }
    if kind == "screw":
        joint["pitch"] = 0.01
    sections = {"bodies": {"w": wheel(0.2)}, "joints": {"j": joint}}
    r = simulate(sections, duration=20.0, step=0.01, output_interval=0.05, coordinates="relative")
    turned = r.array("j.angle_1" if kind == "universal" else "j.angle")
    np.testing.assert_allclose(turned, turned[0] + rate * r.time, atol=1e-8)
    if kind == "screw":
        np.testing.assert_allclose(r.array("j.displacement"), 0.01 * (turned - turned[0]) / (2 * np.pi), atol=1e-12)


def test_result_is_bit_identical_for_every_chunk_length():
    machine = linked.record(linked.every_element())
    settings = {"duration": 0.05, "step": 2e-4, "coordinates": "relative"}
    frames = [run(machine, chunk_steps=k, **settings).frames for k in (1, 7, None)]
    np.testing.assert_array_equal(frames[0], frames[1])
    np.testing.assert_array_equal(frames[0], frames[2])


@pytest.mark.parametrize("model", ["coulomb", "stiction", "lugre"])
def test_machine_with_every_element_runs_as_in_absolute_coordinates(model):
    machine = linked.record(linked.every_element(model))
    settings = {"duration": 0.1, "step": 1e-4, "output_interval": 0.01}
    a, b = (run(machine, coordinates=c, **settings) for c in ("absolute", "relative"))
    assert a.finished.outcome == b.finished.outcome == "done"
    same_motion(
        a, b, 1e-7, (*MOTION, "joint_force", "external_work", "dissipated_energy", "potential_energy", "energy_error")
    )


def test_a_pendulum_of_200_links_is_the_one_of_absolute_coordinates():
    bodies, joints, _ = linked.chain(200, ("revolute", "universal"))
    machine = linked.record({"gravity": [0, -G, 0], "bodies": bodies, "joints": joints})
    a, b = (run(machine, coordinates=c, duration=0.01, step=5e-4) for c in ("absolute", "relative"))
    same_motion(a, b, 1e-7)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_the_energy_constraint_leaves_a_machine_at_rest_alone(coordinates):
    """No energy is missing, and no factor of the velocities is known: not 0/0."""
    still = {"bodies": {"arm": wheel(0.2, position=[1, 0, 0])}, "joints": {"pin": hinge("ground", "arm")}}
    settings = {"coordinates": coordinates, "stabilisation": "geometric", "duration": 0.01, "step": 1e-3}
    r = simulate({"name": "still", "gravity": [0, 0, 0], **still}, **settings)
    assert np.all(r.array("position") == [1.0, 0.0, 0.0])
    assert r.timing["unconserved"] == 0
