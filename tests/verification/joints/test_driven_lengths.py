"""Cylinders without bodies, generic and skew universal joints, and position servos, against closed forms."""

from itertools import combinations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import machines
import nivel
from nivel import Joint, MachineRecord
from nivel.analysis.assembly.assemble import assemble
from nivel.analysis.assembly.equations import equations
from nivel.analysis.assembly.redundancy import analyse
from nivel.errors import ModelError
from nivel.files import parse_machine

pytestmark = pytest.mark.covering

BOOM = """\
format: 1
gravity: [0, 0, -9.81]
bodies:
  boom: {mass: 360, inertia: [4, 270, 270], position: [1.5, 0, 0]}
joints:
  foot: {type: revolute, bodies: [ground, boom], point: [0, 0, 0], axis: [0, -1, 0]}
  ram: {type: variable-distance, bodies: [ground, boom], points: [[0.5, 0, -1], [1.5, 0, 0]]}
drivers:
  lift: {coordinate: ram.distance, from_start: true, value: "step(time, 0.2, 0.3, 1.2, 0.7)"}
simulation: {duration: 1.5, step: 1 ms, output_interval: 1 ms}
"""


def simulated(text, tmp_path, **settings):
    file = tmp_path / "machine.yaml"
    file.write_text(text, encoding="utf-8")
    return nivel.load(file).simulate(**settings)


def test_a_driven_length_moves_from_where_it_is_placed_by_the_change_of_its_value(tmp_path):
    result = simulated(BOOM, tmp_path)
    s = np.clip((result.time - 0.2) / 1.0, 0, 1)
    way = 0.4 * (10 * s**3 - 15 * s**4 + 6 * s**5)
    np.testing.assert_allclose(result.array("ram.distance"), np.sqrt(2.0) + way, atol=1e-10)


def test_the_work_of_a_driven_length_is_what_the_boom_gains(tmp_path):
    """At rest again, the work of the cylinder is m g Δh."""
    result = simulated(BOOM, tmp_path)
    height = result.array("boom.position")[-1, 2] - result.array("boom.position")[0, 2]
    assert height > 0.3
    assert result.array("external_work")[-1] == pytest.approx(360 * 9.81 * height, rel=1e-6)


def test_the_effort_of_a_held_length_is_that_of_the_lever(tmp_path):
    """The cylinder stands at 45 degrees under the centre of mass: F sin 45° = m g."""
    text = BOOM.replace('value: "step(time, 0.2, 0.3, 1.2, 0.7)"', "value: 0")
    result = simulated(text, tmp_path, duration=0.01)
    np.testing.assert_allclose(result.array("driver.lift.effort"), 360 * 9.81 * np.sqrt(2.0), rtol=1e-9)


def test_a_motor_on_a_length_is_a_force_between_its_points(tmp_path):
    motor = "forces:\n  push: {type: motor, coordinate: ram.distance, effort: 3000}\nsimulation"
    text = BOOM[: BOOM.index("drivers:")] + BOOM[BOOM.index("simulation") :].replace("simulation", motor, 1)
    pair = text.replace(
        "{type: motor, coordinate: ram.distance, effort: 3000}",
        "{type: pair-force, bodies: [ground, boom], points: [[0.5, 0, -1], [1.5, 0, 0]], magnitude: 3000}",
    )
    first, second = (simulated(each, tmp_path, duration=0.5).array("foot.angle") for each in (text, pair))
    assert np.abs(first).max() > 0.01
    np.testing.assert_allclose(first, second, atol=1e-9)


def test_a_distance_that_a_joint_holds_cannot_be_driven():
    with pytest.raises(ModelError, match="one that changes is of `type: variable-distance`"):
        parse_machine(BOOM.replace("variable-distance", "distance"))


MOTIONS = ("x", "y", "z", "rx", "ry", "rz")
SUBSETS = [each for n in range(1, 7) for each in combinations(MOTIONS, n)]


@pytest.mark.parametrize("locked", SUBSETS, ids="-".join)
def test_a_generic_joint_locks_as_many_motions_as_it_names(locked, rng):
    bodies = (machines.random_body("a", rng), machines.random_body("b", rng))
    joint = Joint(
        name="j", type="generic", bodies=("a", "b"), point=(0.1, 0.2, 0.3), axis=(1, 2, 3), locked=tuple(locked)
    )
    machine = MachineRecord(name="m", bodies=bodies, joints=(joint,))
    motion = equations(machine)
    redundancy = analyse(motion, 0.0, assemble(machine, motion).y)
    assert redundancy.degrees_of_freedom == 12 - len(locked)
    assert redundancy.redundant_rows == ()


EQUALS = {
    "revolute": ("x", "y", "z", "rx", "ry"),
    "translational": ("x", "y", "rx", "ry", "rz"),
    "cylindrical": ("x", "y", "rx", "ry"),
    "planar": ("z", "rx", "ry"),
    "point-on-plane": ("z",),
}


@pytest.mark.parametrize("kind", EQUALS)
def test_a_generic_joint_moves_as_the_joint_that_locks_the_same(kind, tmp_path):
    text = """\
format: 1
gravity: [1, 2, -9.81]
bodies:
  a: {{mass: 2, inertia: [0.3, 0.4, 0.5], position: [0.3, 0.2, -0.1], angular_velocity: [0, 0, 2]}}
joints:
  j: {{type: {}, bodies: [ground, a], point: [0, 0, 0], axis: [0, 0, 1]}}
"""
    locked = f"generic, locked: [{', '.join(EQUALS[kind])}]"
    first = simulated(text.format(kind), tmp_path, duration=0.5).array("a.position")
    second = simulated(text.format(locked), tmp_path, duration=0.5).array("a.position")
    np.testing.assert_allclose(first, second, atol=1e-8)


@pytest.mark.parametrize(
    ("locked", "answer"),
    [
        ("[]", "nothing is locked"),
        ("[x, x]", "stands here more than once"),
        ("[x, q]", "is not known"),
        ("3", "a list"),
    ],
)
def test_what_is_no_list_of_motions_is_refused(locked, answer):
    text = BOOM.replace("type: revolute", f"type: generic, locked: {locked}")
    with pytest.raises(ModelError, match=answer):
        parse_machine(text)


def test_a_locked_coordinate_cannot_be_driven():
    text = BOOM.replace("type: revolute", "type: generic, locked: [x, y, z, rx]").replace("ram.distance", "foot.x")
    with pytest.raises(ModelError, match=r"the joint locks it \(`locked: \[x, y, z, rx\]`\)"):
        parse_machine(text)
    with pytest.raises(ModelError, match="an angle about z needs `rx` and `ry` locked"):
        parse_machine(text.replace("foot.x", "foot.angle"))


def test_the_arms_of_a_skew_universal_joint_keep_their_angle(tmp_path):
    result = simulated(
        """\
format: 1
gravity: [0, 0, -9.81]
bodies:
  a: {mass: 2, inertia: [0.3, 0.4, 0.5], position: [0.3, 0.2, -0.1], angular_velocity: [3, 1, 2]}
joints:
  j: {type: skew-universal, bodies: [ground, a], point: [0, 0, 0], axes: [[0, 0, 1], [1, 0, 1]]}
""",
        tmp_path,
    )
    w, x, y, z = result.array("a.orientation").T
    third = np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
    first = np.array([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)])
    arm = (first + third) / np.sqrt(2)
    np.testing.assert_allclose(arm[2], np.sqrt(0.5), atol=1e-7)
    assert np.ptp(arm[0]) > 0.1


SERVO = """\
format: 1
bodies:
  arm: {mass: 3, inertia: [1, 1, 2]}
joints:
  hinge: {type: revolute, bodies: [ground, arm], point: [0, 0, 0], axis: [0, 0, 1]}
forces:
  load: {type: torque, body: arm, vector: [0, 0, -5]}
  drive: {type: servo, coordinate: hinge.angle, target: TARGET, stiffness: 50, damping: 8, integral: 20, limit: 30}
simulation: {duration: 4, step: 1 ms, output_interval: 10 ms}
"""


@pytest.mark.parametrize(
    ("target", "value", "rate"),
    [
        ("1.5", lambda t: 1.5, lambda t: 0.0),
        ('"sin(2*time)"', lambda t: np.sin(2 * t), lambda t: 2 * np.cos(2 * t)),
        ('"ramp(time, 0, 0, 1, 1)"', lambda t: min(t, 1.0), lambda t: 0.0),  # corners: no rate of the target
    ],
)
def test_a_servo_is_a_pid_with_a_limit(target, value, rate, tmp_path):
    """Against J φ̈ = sat(k e + d ė + i ∫e) - 5 by SciPy, where ∫e stands still at the limit."""

    def motion(t, y):
        error = value(t) - y[0]
        wanted = 50 * error + 8 * (rate(t) - y[1]) + 20 * y[2]
        effort = np.clip(wanted, -30, 30)
        return [y[1], (effort - 5) / 2, 0.0 if wanted * error > 0 and effort != wanted else error]

    result = simulated(SERVO.replace("TARGET", target), tmp_path)
    expected = solve_ivp(motion, (0, 4), [0, 0, 0], t_eval=result.time, rtol=1e-10, atol=1e-12, max_step=0.01)
    np.testing.assert_allclose(result.array("hinge.angle"), expected.y[0], atol=2e-4)
    assert np.abs(result.array("force.drive.magnitude")).max() <= 30 + 1e-12
    assert abs(result.array("force.drive.error")[-1]) < (0.02 if target == "1.5" else 0.2)


def test_a_machine_with_drivers_from_the_start_reads_back_as_written(tmp_path):
    machine = parse_machine(BOOM)
    file = tmp_path / "written.yaml"
    nivel.Machine.from_record(machine).save(file)
    assert nivel.load(file).record.drivers == machine.drivers
