"""Three-phase motors against closed forms: first-order currents, torque, induced voltage, losses, limits and battery, torque over slip;
and the same equations by Radau of SciPy."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from nivel.api import Machine
from nivel.errors import ModelError
from nivel.files import parse_machine

TEXT = """
format: 1
bodies:
  wheel: {{mass: 5, inertia: [{J}, {J}, {J}], angular_velocity: [0, 0, {omega}]}}
joints:
  axle: {{type: revolute, bodies: [ground, wheel], point: [0, 0, 0], axis: [0, 0, 1]}}
forces:
  drive: {{type: synchronous-motor, coordinate: axle, torque_constant: 0.3 N m/A, pole_pairs: 3, resistance: 20 mohm, inductance: 0.3 mH,
    inductance_d: 0.2 mH, current_limit: 400 A, bandwidth: 200 Hz, {more}}}
simulation: {{duration: {duration}, integrator: radau, tolerance: 1e-9, output_interval: {interval}}}
"""
K, P, R, LQ, LD, ALPHA = 0.3, 3, 0.02, 3e-4, 2e-4, 400 * math.pi
PSI = K / (1.5 * P)
NAMES = (
    "current_d",
    "current_q",
    "torque",
    "voltage",
    "electrical_power",
    "loss",
    "inverter_loss",
    "dc_voltage",
    "speed",
)


def run(more, *, omega=0.0, J=0.5, duration=0.02, interval=2e-4):
    text = TEXT.format(more=more, omega=omega, J=J, duration=duration, interval=interval)
    result = Machine.from_record(parse_machine(text)).simulate(verify=False)
    return result, {name: np.asarray(result[f"force.drive.{name}"]) for name in NAMES}


def test_currents_follow_as_first_order_lags_and_torque_voltage_and_losses_are_theirs():
    """A wheel so heavy that it turns on at 50 rad/s: both poles of the windings are taken away by the controllers."""
    more = "effort: 60 N m, current_d: -50 A, dc_voltage: 600 V, inverter_power: 30 W, inverter_drop: 0.8 V, inverter_resistance: 2 mohm"
    result, found = run(more, omega=50, J=1e9)
    t = np.asarray(result.time)
    wanted = 60 / (1.5 * P * (PSI - (LD - LQ) * 50))
    d, q = -50 * (1 - np.exp(-ALPHA * t)), wanted * (1 - np.exp(-ALPHA * t))
    np.testing.assert_allclose(found["current_d"], d, atol=5e-6 * 50)
    np.testing.assert_allclose(found["current_q"], q, atol=5e-6 * wanted)
    torque = 1.5 * P * (PSI * q + (LD - LQ) * d * q)
    np.testing.assert_allclose(found["torque"], torque, atol=1e-3)
    we, size = P * 50, np.hypot(d[-1], q[-1])
    u = np.hypot(R * d[-1] - we * LQ * q[-1], R * q[-1] + we * (LD * d[-1] + PSI))
    assert found["voltage"][-1] == pytest.approx(u, rel=1e-6)
    inverter = 30 + 6 / math.pi * 0.8 * size + 1.5 * 2e-3 * size**2
    assert found["inverter_loss"][-1] == pytest.approx(inverter, rel=1e-6)
    assert found["loss"][-1] == pytest.approx(inverter + 1.5 * R * size**2, rel=1e-6)
    assert found["electrical_power"][-1] == pytest.approx(torque[-1] * 50 + found["loss"][-1], rel=1e-6)
    assert torque[-1] == pytest.approx(60, rel=1e-6)


def test_induced_voltage_holds_the_speed_that_a_dc_link_allows_and_a_weakened_field_raises_it():
    """No load: the speed ends where ω_e |ψ + L_d i_d| and what the windings drop are U/√3."""
    ends = []
    for direct in (0, -100):
        _, found = run(f"effort: 30 N m, current_d: {direct} A, dc_voltage: 60 V", J=2e-3, duration=0.5, interval=0.01)
        d, q, we = found["current_d"][-1], found["current_q"][-1], P * found["speed"][-1]
        u = np.hypot(R * d - we * LQ * q, R * q + we * (LD * d + PSI))
        assert u == pytest.approx(60 / math.sqrt(3), rel=1e-3)
        assert found["voltage"][-1] == pytest.approx(60 / math.sqrt(3), rel=1e-6)
        ends.append(found["speed"][-1])
    assert ends[0] == pytest.approx(60 / math.sqrt(3) / (P * PSI), rel=0.02)
    assert ends[1] > 1.2 * ends[0]


def test_a_motor_at_its_battery_follows_the_equations_of_the_page():
    """Speed, currents, dc link and charge within 1e-6 of SciPy's Radau, and the energy of the battery is where it went."""
    Q, Rb, C, J = 3600.0, 0.05, 2e-3, 0.05
    battery = (
        "{charges: [0, 1], voltages: [300 V, 400 V], capacity: 1 A*h, resistance: 50 mohm, start: 0.7, dc_link: 2e-3}"
    )
    more = f"effort: {{of: time, times: [0, 0.1, 0.1001, 1], values: [60, 60, -40, -40]}}, inverter_power: 30 W, battery: {battery}"
    result, found = run(more, J=J, duration=0.2, interval=2e-3)

    def rates(t, y, T):
        w, d, q, xd, xq, U, s = y
        we = P * w
        ed, eq = 0 - d, T / (1.5 * P * PSI) - q
        ud, uq = ALPHA * LD * ed + xd - we * LQ * q, ALPHA * LQ * eq + xq + we * (LD * d + PSI)
        cut = min(1.0, U / math.sqrt(3) / math.hypot(ud, uq))
        vd, vq = cut * ud, cut * uq
        taken, current = 1.5 * (vd * d + vq * q) + 30, (300 + 100 * s - U) / Rb
        return [
            1.5 * P * (PSI * q + (LD - LQ) * d * q) / J,
            (vd - R * d + we * LQ * q) / LD, (vq - R * q - we * (LD * d + PSI)) / LQ,
            ALPHA * R * ed + R / LD * (vd - ud), ALPHA * R * eq + R / LQ * (vq - uq),
            (current - taken / U) / C, -current / Q,
        ]  # fmt: skip

    t = np.asarray(result.time)
    y, other = np.array([0, 0, 0, 0, 0, 370, 0.7], float), []
    for a, b, T in (
        (0, 0.1, lambda t: 60.0),
        (0.1, 0.1001, lambda t: 60 - 1e6 * (t - 0.1)),
        (0.1001, 0.2, lambda t: -40.0),
    ):
        inside = t[(t >= a - 1e-9) & (t < b - 1e-9)].clip(a, b)
        end = solve_ivp(
            lambda t, y, T=T: rates(t, y, T(t)), (a, b), y, "Radau", np.union1d(inside, b), rtol=1e-9, atol=1e-10
        )
        other += [*end.y.T[: len(inside)]]
        y = end.y[:, -1]
    other = np.array([*other, y]).T
    states = [
        found["speed"],
        found["current_d"],
        found["current_q"],
        None,
        None,
        found["dc_voltage"],
        result["state.drive.charge"],
    ]
    for k, each in enumerate(states):
        if each is not None and np.ptp(other[k]) > 1e-3 * abs(other[k][0]) + 1e-9:
            assert np.max(np.abs(np.asarray(each) - other[k])) < 2e-6 * np.ptp(other[k]), k
    assert result.trust.energy_error_max < 1e-5 * 0.5 * J * np.max(found["speed"]) ** 2
    assert np.asarray(result["state.drive.charge"])[-1] > np.min(
        np.asarray(result["state.drive.charge"])
    )  # braking charges


def test_a_battery_that_is_emptied_is_not_green():
    """60 N m in a wheel of 0.5 kg m² for 0.5 s take 1800 J and more of a battery of 36 A s at 300 to 400 V."""
    for start, light in ((0.5, "green"), (0.002, "red")):
        battery = (
            f"{{charges: [0, 1], voltages: [300 V, 400 V], capacity: 36 A*s, resistance: 50 mohm, start: {start}}}"
        )
        result, _ = run(f"effort: 60 N m, battery: {battery}", duration=0.5, interval=0.01)
        charge = np.asarray(result["state.drive.charge"])
        assert (charge[-1] < 0.0) == (light == "red")
        items = [item for item in result.trust.items if item.name == "battery"]
        assert [item.verdict for item in items] == ([] if light == "green" else ["red"])
        assert all("charge of drive" in item.text for item in items)


INDUCTION = """
format: 1
bodies:
  wheel: {{mass: 5, inertia: [{J}, {J}, {J}], angular_velocity: [0, 0, {omega}]}}
joints:
  axle: {{type: revolute, bodies: [ground, wheel], point: [0, 0, 0], axis: [0, 0, 1]}}
forces:
  drive: {{type: induction-motor, coordinate: axle, resistance: 0.08 ohm, rotor_resistance: 0.06 ohm, inductance: 20 mH,
    stator_leakage: 0.8 mH, rotor_leakage: 0.9 mH, {more}}}
simulation: {{duration: {duration}, integrator: radau, tolerance: 1e-9, output_interval: {interval}}}
"""
R_S, R_R, L_M, L_S, L_R, PAIRS = 0.08, 0.06, 0.02, 0.0208, 0.0209, 2
FOC = "effort: {effort}, current_d: {direct}, current_limit: 150 A, bandwidth: 200 Hz, {feed}"


def induction(more, *, omega=0.0, J=0.5, duration=0.02, interval=2e-4):
    text = INDUCTION.format(more=more, omega=omega, J=J, duration=duration, interval=interval)
    result = Machine.from_record(parse_machine(text)).simulate(verify=False)
    return result, {name: np.asarray(result[f"force.drive.{name}"]) for name in (*NAMES, "current", "flux", "slip")}


def equivalent_circuit(slip, voltage=400.0, frequency=50.0):
    """Torque of the T circuit by Thévenin's theorem at a slip (Fitzgerald, Kingsley and Umans, Electric Machinery, 6.33 to 6.36), and
    the amplitude of the current of the stator."""
    w, phase = 2 * math.pi * frequency, voltage / math.sqrt(3)
    stator, magnetising = R_S + 1j * w * (L_S - L_M), 1j * w * L_M
    seen, across = magnetising * stator / (magnetising + stator), phase * magnetising / (magnetising + stator)
    torque = 3 * PAIRS / w * abs(across) ** 2 * R_R / slip / abs(seen + R_R / slip + 1j * w * (L_R - L_M)) ** 2
    rotor = R_R / slip + 1j * w * (L_R - L_M)
    return torque, math.sqrt(2) * phase / abs(stator + magnetising * rotor / (magnetising + rotor))


@pytest.mark.parametrize("slip", [0.01, 0.05, 0.3, -0.03])
def test_an_induction_motor_at_the_grid_has_the_torque_of_its_slip(slip):
    """Past its transients, on a wheel that turns on."""
    omega = 2 * math.pi * 50 / PAIRS * (1 - slip)
    result, found = induction("voltage: 400 V, frequency: 50 Hz", omega=omega, J=1e9, duration=1.2, interval=0.1)
    torque, current = equivalent_circuit(slip)
    assert found["torque"][-1] == pytest.approx(torque, rel=2e-6)
    assert found["current"][-1] == pytest.approx(current, rel=2e-6)
    assert found["slip"][-1] == pytest.approx(slip * 100 * math.pi, rel=1e-6)
    assert found["electrical_power"][-1] == pytest.approx(torque * omega + found["loss"][-1], rel=1e-5)
    assert result.trust.energy_error_max < 1e-5 * np.max(np.abs(found["electrical_power"]))


def test_field_orientation_has_the_torque_that_the_equivalent_circuit_has_at_its_voltage_frequency_and_slip():
    """i_d makes the flux M i_d, i_q the torque that is asked for; the frame turns by R_R i_q/(M i_d) faster than the rotor."""
    more = FOC.format(effort="60 N m", direct="20 A", feed="dc_voltage: 600 V")
    _, found = induction(more, omega=50, J=1e9, duration=3, interval=0.5)
    mutual = L_M**2 / L_R
    assert found["torque"][-1] == pytest.approx(60, rel=1e-6)
    assert found["flux"][-1] == pytest.approx(mutual * 20, rel=1e-6)
    assert found["slip"][-1] == pytest.approx(R_R / L_R * found["current_q"][-1] / 20, rel=1e-6)
    frame = PAIRS * 50 + found["slip"][-1]
    line = found["voltage"][-1] * math.sqrt(3 / 2)
    torque, current = equivalent_circuit(found["slip"][-1] / frame, line, frame / (2 * math.pi))
    assert torque == pytest.approx(60, rel=1e-5)
    assert current == pytest.approx(found["current"][-1], rel=1e-5)


@pytest.mark.parametrize("fed", ["inverter", "grid"])
def test_an_induction_motor_follows_the_equations_of_the_page(fed):
    """Speed, currents and flux within 1e-6 of SciPy's DOP853: with a flux that is weakened, a torque that is not reached, and a start at
    the grid."""
    J, alpha, least = 0.05, 400 * math.pi, 0.01 * 150
    mutual, rotor = L_M**2 / L_R, (L_M / L_R) ** 2 * R_R
    inductance = L_S - mutual
    if fed == "inverter":
        more = FOC.format(effort="120 N m", direct='"40/(1 + 20*time)"', feed="dc_voltage: 200 V")
    else:
        more = 'voltage: "200 + 400*time", frequency: "25 + 50*time"'
    result, found = induction(more, J=J, duration=0.1, interval=2e-3)

    def rates(t, y):
        w, d, q, m_d, m_q, x_d, x_q = y
        turning, x = PAIRS * w, (0.0, 0.0)
        if fed == "grid":
            frame, u_d, u_q = 2 * math.pi * (25 + 50 * t), math.sqrt(2 / 3) * (200 + 400 * t), 0.0
        else:
            frame = turning + rotor * q / (mutual * max(m_d, least))
        e_d = rotor * (d - m_d) - turning * mutual * m_q
        e_q = rotor * (q - m_q) + turning * mutual * m_d
        if fed == "inverter":
            direct = 40 / (1 + 20 * t)
            wanted = min(120 / (1.5 * PAIRS * mutual * max(m_d, least)), math.sqrt(150**2 * (1 + 1e-12) - direct**2))
            a_d = alpha * inductance * (direct - d) + x_d - frame * inductance * q + e_d
            a_q = alpha * inductance * (wanted - q) + x_q + frame * inductance * d + e_q
            cut = min(1.0, 200 / math.sqrt(3) / math.hypot(a_d, a_q))
            u_d, u_q = cut * a_d, cut * a_q
            x = (
                alpha * R_S * (direct - d) + R_S / inductance * (u_d - a_d),
                alpha * R_S * (wanted - q) + R_S / inductance * (u_q - a_q),
            )
        return [
            1.5 * PAIRS * mutual * (m_d * q - m_q * d) / J,
            (u_d - R_S * d + frame * inductance * q - e_d) / inductance,
            (u_q - R_S * q - frame * inductance * d - e_q) / inductance,
            rotor * (d - m_d) / mutual + (frame - turning) * m_q, rotor * (q - m_q) / mutual - (frame - turning) * m_d, *x,
        ]  # fmt: skip

    start = [0, 0, 0, 40 if fed == "inverter" else 0, 0, 0, 0]
    t = np.asarray(result.time)
    other = solve_ivp(rates, (0, t[-1]), start, "DOP853", t, rtol=1e-10, atol=1e-9).y
    flux = mutual * np.hypot(other[3], other[4])
    for name, each in zip(("speed", "current_d", "current_q", "flux"), (*other[:3], flux), strict=True):
        assert np.max(np.abs(found[name] - each)) < 1e-6 * np.ptp(each), name
    assert np.ptp(found["speed"]) > 20
    assert result.trust.energy_error_max < 1e-5 * 0.5 * J * np.max(found["speed"]) ** 2


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ("current_d: 20 A", "an `effort`, asked of its inverter, or the `voltage` of a grid"),
        ("voltage: 400 V", "`frequency` is missing: it goes with `voltage`"),
        ("voltage: 400 V, frequency: 50 Hz, current_d: 20 A", "`current_d` belongs to an `effort`"),
        ("effort: 1, dc_voltage: 600 V, current_limit: 9", "`current_d` is missing"),
        ("effort: 1, dc_voltage: 600 V, current_limit: 9, current_d: 2, frequency: 50 Hz", "belongs to a `voltage`"),
    ],
)
def test_what_an_induction_motor_needs_is_told(more, told):
    with pytest.raises(ModelError, match=told):
        parse_machine(INDUCTION.format(more=more, omega=0, J=1, duration=1, interval=1))


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ("effort: 1 N m", "`dc_voltage`, or a `battery`"),
        ("effort: 1 N m, dc_voltage: 48 V, resistance: 0", "`resistance` is missing"),
        (
            "effort: 1 N m, battery: {charges: [0, 100], voltages: [300, 400], capacity: 1 A*h, resistance: 1}",
            "shares from 0 to 1",
        ),
    ],
)
def test_what_a_synchronous_motor_needs_is_told(more, told):
    text = TEXT.format(more=more, omega=0, J=1, duration=1, interval=1)
    if "resistance" in more:
        text = text.replace("resistance: 20 mohm, ", "", 1)
    with pytest.raises(ModelError, match=told):
        parse_machine(text)
