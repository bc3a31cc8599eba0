"""Electric drives against the linear equations of windings and gears, their limits, and the energy balance."""

import numpy as np
import pytest
from scipy.linalg import expm

from nivel.api import Machine
from nivel.errors import ModelError
from nivel.files import parse_machine

START = """
format: 1
bodies:
  wheel: {{mass: 5, inertia: [1, 1, 0.8], angular_velocity: [0, 0, {omega}]}}
joints:
  axle: {{type: revolute, bodies: [ground, wheel], point: [0, 0, 0], axis: [0, 0, 1]}}
forces:
  drive: {{coordinate: axle, {drive}}}
simulation: {{duration: {duration}, step: {step}, output_interval: {interval}, tolerance: 1e-9}}
"""
U, R, L, K, GEAR, INERTIA = 24.0, 1.5, 4e-3, 0.06, 20.0, 0.8
DC = f"type: dc-motor, voltage: {U} V, resistance: {R} ohm, torque_constant: {K} N m/A, gear: {GEAR}"


def run(drive, *, omega=0.0, duration=1.0, step=1e-4, interval=1e-3, **settings):
    text = START.format(drive=drive, omega=omega, duration=duration, step=step, interval=interval)
    return Machine.from_record(parse_machine(text)).simulate(**settings)


def linear(A, b, start, times):
    """Solution of ẋ = A x + b."""
    n = len(b)
    whole = np.zeros((n + 1, n + 1))
    whole[:n, :n], whole[:n, n] = A, b
    return np.array([(expm(whole * t) @ [*start, 1.0])[:n] for t in times])


def test_current_and_speed_of_a_dc_motor_are_those_of_its_linear_equations():
    result = run(f"{DC}, inductance: {L} H", omega=3.0, step=4e-5)
    # ω of the wheel, i
    A = np.array([[0.0, GEAR * K / INERTIA], [-K * GEAR / L, -R / L]])
    exact = linear(A, [0.0, U / L], [3.0, 0.0], result.time)
    np.testing.assert_allclose(result["force.drive.current"], exact[:, 1], rtol=0, atol=1e-8)
    np.testing.assert_allclose(result["axle.angle.rate"], exact[:, 0], rtol=0, atol=1e-8)


def test_a_motor_without_inductance_has_its_stall_torque_at_rest_and_its_no_load_speed_in_the_end():
    result = run(DC, duration=10.0, step=1e-3, interval=0.1)
    assert float(result["force.drive.magnitude"][0]) == pytest.approx(GEAR * K * U / R, rel=1e-12)
    assert float(result["axle.angle.rate"][-1]) == pytest.approx(U / (K * GEAR), rel=1e-5)
    rate = (K * GEAR) ** 2 / (R * INERTIA)
    exact = U / (K * GEAR) * (1 - np.exp(-rate * result.time))
    np.testing.assert_allclose(result["axle.angle.rate"], exact, rtol=0, atol=1e-8)


ELASTIC = "rotor_inertia: 2e-4, gear_stiffness: 900 N m/rad, gear_damping: 1.5, viscous: 3e-4"


def test_a_rotor_on_an_elastic_gear_is_the_linear_system_that_it_says():
    J, k, d, v = 2e-4, 900.0, 1.5, 3e-4
    result = run(f"{DC}, inductance: {L} H, {ELASTIC}", omega=2.0)
    # ω of the wheel, twist δ, Ω of the rotor (which begins with that of the wheel), i
    A = np.array(
        [
            [-d / INERTIA, k / INERTIA, d / GEAR / INERTIA, 0],
            [-1, 0, 1 / GEAR, 0],
            [d / GEAR / J, -k / GEAR / J, -(d / GEAR**2 + v) / J, K / J],
            [0, 0, -K / L, -R / L],
        ]
    )
    exact = linear(A, [0, 0, 0, U / L], [2.0, 0, 2.0 * GEAR, 0], result.time)
    for name, column in (
        ("axle.angle.rate", 0),
        ("state.drive.twist", 1),
        ("force.drive.speed", 2),
        ("force.drive.current", 3),
    ):
        np.testing.assert_allclose(result[name], exact[:, column], rtol=0, atol=2e-6 * np.abs(exact[:, column]).max())


def test_limits_of_voltage_and_current_are_kept():
    result = run(
        f"{DC}, inductance: {L} H, current_limit: 5 A, voltage_limit: 18 V", duration=8, step=1e-3, interval=1e-2
    )
    current = np.asarray(result["force.drive.current"])
    assert np.max(np.abs(current)) == 5.0
    assert float(result["axle.angle.rate"][-1]) == pytest.approx(18 / (K * GEAR), rel=1e-3)


@pytest.mark.parametrize(
    "drive",
    [
        f"{DC}, inductance: {L} H, {ELASTIC}, friction_torque: 0.02",
        f"type: servo-motor, effort: 20*sin(5*time), gear: {GEAR}, torque_constant: 0.5, resistance: 2, {ELASTIC}",
        "type: servo-motor, effort: 20*cos(5*time), time_constant: 0, friction_torque: 0.1",
    ],
)
def test_electrical_energy_is_work_losses_and_what_is_stored(drive):
    result = run(drive, omega=1.0, integrator="dop853", tolerance=1e-11, interval=1e-2)
    work = np.asarray(result["external_work"])
    assert np.max(np.abs(result["energy_error"])) < 1e-7 * np.max(np.abs(work))
    assert np.min(result["force.drive.loss"]) >= 0.0
    assert float(result["dissipated_energy"][-1]) > 1e-3 * np.max(np.abs(work))


def test_the_torque_of_a_servo_motor_follows_its_command_with_its_time_constant():
    result = run(f"type: servo-motor, effort: 30, gear: {GEAR}, time_constant: 20 ms", duration=0.2)
    np.testing.assert_allclose(
        result["force.drive.torque"], 30 / GEAR * (1 - np.exp(-result.time / 0.02)), rtol=0, atol=1e-8
    )


def test_the_torque_of_a_servo_motor_is_limited_over_its_speed():
    """Full torque up to 50 rad/s, less beyond, nothing from 100 rad/s on: the speed comes near that and stays below."""
    curve = "torque_speed: {speeds: [0, 50, 100], torques: [2, 2, 0]}"
    result = run(f"type: servo-motor, effort: 1000, gear: {GEAR}, time_constant: 0, {curve}", duration=4)
    speed = np.asarray(result["force.drive.speed"])
    np.testing.assert_allclose(result["force.drive.torque"], np.interp(speed, [0, 50, 100], [2, 2, 0]), atol=1e-9)
    assert 99 < speed[-1] < 100 * (1 + 1e-9)


ACTUATOR = """
format: 1
gravity: [0, -9.81, 0]
bodies:
  boom: {position: [0, 1, 0], mass: 300, centre_of_mass: [2, 0, 0], inertia: [20, 400, 400]}
joints:
  hinge: {type: revolute, bodies: [ground, boom], point: [0, 1, 0], axis: [0, 0, 1]}
  screw: {type: variable-distance, bodies: [ground, boom], points: [[0.6, 0.2, 0], [0.6, 1, 0]]}
control:
  hold: {type: pid, reference: 0.8, measured: screw.distance, kp: 1e6, ki: 1e6, kd: 1e5}
forces:
  drive: {type: servo-motor, coordinate: screw.distance, effort: hold, gear: 1256 rad/m}
simulation: {duration: 0.1, step: 1 ms, integrator: radau, tolerance: 1e-8, start: equilibrium}
"""


def test_a_drive_between_two_points_carries_the_moment_of_a_load():
    """Force m g 2.0/0.6 m, upright under the boom, and torque at the screw by the gear."""
    result = Machine.from_record(parse_machine(ACTUATOR)).simulate()
    force = 300 * 9.81 * 2.0 / 0.6
    assert np.asarray(result["force.drive.magnitude"]) == pytest.approx(force, rel=1e-6)
    assert np.asarray(result["force.drive.torque"]) == pytest.approx(force / 1256, rel=1e-6)
    assert np.ptp(np.asarray(result["hinge.angle"])) < 1e-9


def test_exact_tangents_of_drives():
    drive = f"{DC}, inductance: 20 uH, {ELASTIC}, friction_torque: 0.02, current_limit: 12 A"
    plain = run(drive, omega=1.0, integrator="dop853", interval=1e-2)
    stiff = run(drive, omega=1.0, integrator="radau", interval=1e-2)
    np.testing.assert_allclose(stiff["axle.angle.rate"], plain["axle.angle.rate"], rtol=0, atol=1e-6)


FAULTS = [
    ("type: dc-motor, voltage: 24 V, torque_constant: 0.1", "forces.drive: `resistance` is missing"),
    (f"{DC}, rotor_inertia: 1", "forces.drive: `gear_stiffness` is missing"),
    (f"{DC}, gear_damping: 1", "forces.drive.gear_damping: `gear_damping` belongs to an elastic gear"),
    (f"{DC.replace('gear: 20.0', 'gear: 3 m')}", "forces.drive.gear: `3 m` is a length (m); a number was expected"),
    (
        "type: dc-motor, voltage: 24 A, torque_constant: 0.1, resistance: 1",
        "forces.drive.voltage: `24 A` is a current (A)",
    ),
    (
        "type: servo-motor, effort: 1, torque_speed: {speeds: [0, 10], torques: [1]}",
        "forces.drive.torque_speed.torques: a limit needs as many torques as speeds",
    ),
    (
        "type: servo-motor, effort: 1, torque_limit: 3, torque_speed: {speeds: [0, 10], torques: [1, 1]}",
        "forces.drive.torque_limit: `torque_limit` stands in `torque_speed`",
    ),
    ("type: servo-motor, effort: 1, resistance: 3", "forces.drive: `torque_constant` is missing"),
]


@pytest.mark.parametrize(("drive", "fault"), FAULTS, ids=[fault for _, fault in FAULTS])
def test_faults_of_drives_name_the_key(drive, fault):
    with pytest.raises(ModelError) as caught:
        run(drive)
    assert any(
        fault in str(each).replace(":8:", ":") for each in [f"{one.path}: {one.message}" for one in caught.value.faults]
    )


def test_a_gear_with_backlash_turns_the_joint_when_half_the_play_is_used_up():
    """Rotor alone: ω = T t/J until T t²/(2 J n) is half the play; then two inertias on a spring and damper."""
    J, k, d, torque, play = 2e-3, 900.0, 1.5, 0.5, 0.04
    drive = f"type: servo-motor, time_constant: 0, effort: {torque * GEAR}, gear: {GEAR}, rotor_inertia: {J}"
    result = run(
        f"{drive}, gear_stiffness: {k}, gear_damping: {d}, backlash: {play}", duration=0.1, integrator="dopri5"
    )
    shaft, wheel = result.array("force.drive.speed"), result.array("axle.angle.rate")
    first = np.sqrt(play * J * GEAR / torque)
    free, after = result.time < first, result.time > first
    np.testing.assert_allclose(wheel[free], 0.0, atol=1e-12)
    np.testing.assert_allclose(shaft[free], torque / J * result.time[free], rtol=1e-7)
    np.testing.assert_allclose(GEAR * J * shaft + INERTIA * wheel, GEAR * torque * result.time, rtol=1e-6, atol=1e-7)
    # depth, shaft, wheel; as long as the flank presses
    A = np.array([[0, 1 / GEAR, -1], [-k / (J * GEAR), -d / (J * GEAR**2), d / (J * GEAR)], [k, d / GEAR, -d]])
    A[2] /= INERTIA
    exact = linear(A, [0.0, torque / J, 0.0], [0.0, torque / J * first, 0.0], result.time[after] - first)
    pressing = np.minimum.accumulate(A[2] @ exact.T) > 0
    assert pressing.sum() > 5
    np.testing.assert_allclose(wheel[after][pressing], exact[pressing, 2], atol=1e-5)
    assert result.trust.verdict != "red"
    with pytest.raises(ModelError, match="belongs to an elastic gear"):
        run(f"{drive.replace(f', rotor_inertia: {J}', '')}, backlash: {play}")
