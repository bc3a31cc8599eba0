"""Drives and controls of pumps: steady characteristics in closed form, and the mass that they move."""

import math

import numpy as np
import pytest

from circuits import BAR, between, circuit, density, history, steady

D = 45e-6 / (2 * math.pi)
SPEED = 200.0
PUMP = {"type": "pump", "displacement": D, "speed": SPEED}
MAP = {
    "speeds": [100, 200, 300],
    "pressures": ["100 bar", "200 bar"],
    "settings": [0.5, 1.0],
    "volumetric": [0.90, 0.95, 0.85, 0.91, 0.92, 0.96, 0.88, 0.93, 0.93, 0.97, 0.90, 0.94],
    "mechanical": [0.85, 0.90, 0.87, 0.92, 0.84, 0.89, 0.86, 0.91, 0.82, 0.87, 0.85, 0.90],
}


def resting(component, *names, duration=3.0, **pressures):
    """Outputs after a run of some seconds, so that actuators have come to rest."""
    return steady(
        between(component, **{port: p * BAR for port, p in pressures.items()}),
        *(f"valve.{name}" for name in names),
        duration=duration,
        step=1e-2,
        integrator="extrapolated-euler",
    )


@pytest.mark.parametrize("p", [80.0, 150.0, 300.0])
def test_a_torque_limit_is_a_hyperbola_of_flow_and_pressure(p):
    pump = {**PUMP, "frequency": "4 Hz", "torque_limit": "90 N*m"}
    flow, torque = resting(pump, "flow", "torque", A=1.0, B=1.0 + p)
    assert flow == pytest.approx(SPEED * min(D, 90 / (p * BAR)), rel=1e-8)
    assert torque == pytest.approx(min(D * p * BAR, 90.0), rel=1e-8)


def test_a_pump_over_centre_is_limited_on_both_sides():
    pump = {**PUMP, "frequency": "4 Hz", "torque_limit": "90 N*m", "setting": -1.0}
    flow, setting = resting(pump, "flow", "setting", A=251.0, B=1.0)
    assert setting == pytest.approx(-90 / (D * 250 * BAR), rel=1e-8)
    assert flow == pytest.approx(setting * D * SPEED, rel=1e-8)
    # with the pressure on the other side it is driven, and no limit holds it
    assert resting(pump, "setting", A=1.0, B=251.0) == pytest.approx([-1.0], rel=1e-8)


def test_two_pumps_share_one_torque_by_their_pilots():
    pump = {**PUMP, "frequency": "4 Hz", "torque_limit": "90 N*m"}
    (setting,) = resting(pump, "setting", A=1.0, B=201.0, X=301.0)
    assert setting == pytest.approx(90 / (D * 250 * BAR), rel=1e-8)


@pytest.mark.parametrize(("p", "share"), [(200.0, 0.8), (265.0, 0.6), (290.0, 0.2), (310.0, 0.0)])
def test_the_setting_falls_along_its_cut_off_curve(p, share):
    curve = {"pressures": ["250 bar", "280 bar", "300 bar"], "settings": [1.0, 0.4, 0.0]}
    pump = {**PUMP, "frequency": "4 Hz", "rate_limit": 20, "cut_off_curve": curve, "setting": 0.8}
    allowed = np.interp(p, [250, 280, 300], [1, 0.4, 0])
    assert resting(pump, "setting", A=1.0, B=1.0 + p) == pytest.approx([min(0.8, allowed)], rel=1e-8, abs=1e-8)
    assert min(0.8, allowed) == pytest.approx(share if p != 265.0 else 0.7)


@pytest.mark.parametrize("frequency", [None, "6 Hz"])
def test_load_sensing_holds_its_margin_until_the_torque_is_at_its_limit(frequency):
    """A pump feeds an orifice: p_LS + margin while D Δp ε is below the limit, then Q Δp = T ω."""
    swash = {} if frequency is None else {"frequency": frequency}
    for load, limited in ((80.0, False), (230.0, True)):
        hydraulics = {
            "tank": {"type": "tank", "pressure": "1 bar"},
            "load": {"type": "tank", "pressure": load * BAR},
            "line": {"type": "volume", "volume": "0.5 L"},
            "pump": {**PUMP, "ports": {"A": "tank", "B": "line", "LS": "load"}, "margin": "20 bar",
                     "torque_limit": "100 N*m", **swash},
            "edge": {"type": "orifice", "ports": {"A": "line", "B": "load"}, "flow": "60 L/min", "pressure_drop": "20 bar"},
        }  # fmt: skip
        names = ["line.pressure", "pump.flow", "pump.setting", "edge.flow"]
        p, flow, setting, through = steady(hydraulics, *names, duration=2.0, integrator="extrapolated-euler")
        mean = 0.5 * (density(p) + density(load * BAR))
        turned, span = (
            SPEED * setting,
            0.5 * (density(BAR) - density(p)),
        )  # the side that it takes from is told apart within 1 rad/s
        taken = 0.5 * (density(BAR) + density(p)) + span * turned / math.hypot(turned, 1.0)
        assert flow * taken == pytest.approx(through * mean, rel=1e-8)
        if limited:
            assert setting * D * (p - BAR) == pytest.approx(100.0, rel=1e-8)
        else:
            assert p == pytest.approx((load + 20.0) * BAR, rel=1e-8)


def test_a_swash_answers_a_step_as_its_actuator():
    step = {"of": "time", "times": [0, 1e-9], "values": [0, 0.5]}
    pump = {**PUMP, "frequency": "4 Hz", "damping_ratio": 0.7, "setting": step}
    result = circuit(between(pump, A=1 * BAR, B=100 * BAR)).simulate(
        integrator="radau", tolerance=1e-9, duration=0.2, output_interval=0.02
    )
    omega, zeta, t = 8 * math.pi, 0.7, np.asarray(result.time)
    damped = omega * math.sqrt(1 - zeta**2)
    wave = np.cos(damped * t) + zeta * omega / damped * np.sin(damped * t)
    assert history(result, "hydraulics.valve.setting") == pytest.approx(
        0.5 * (1 - np.exp(-zeta * omega * t) * wave), abs=1e-6
    )


@pytest.mark.parametrize(("i", "j", "k"), [(0, 0, 0), (1, 1, 1), (2, 0, 1)])
def test_a_map_holds_at_its_points(i, j, k):
    speed, p, setting = MAP["speeds"][i], (100.0, 200.0)[j], MAP["settings"][k]
    pump = {**PUMP, "speed": speed, "efficiency": MAP, "setting": setting}
    flow, torque = resting(pump, "flow", "torque", duration=1e-2, A=1.0, B=1.0 + p)
    at = (i * 2 + j) * 2 + k
    assert flow == pytest.approx(MAP["volumetric"][at] * D * setting * speed, rel=1e-5)
    assert torque == pytest.approx(D * setting * p * BAR / MAP["mechanical"][at], rel=1e-5)


def test_a_map_is_trilinear_between_its_points():
    """Losses Q = C Δp and T = c D Δp: C and c are linear in speed, pressure and setting."""
    pump = {**PUMP, "speed": 150.0, "efficiency": MAP, "setting": 0.75}
    flow, torque = resting(pump, "flow", "torque", duration=1e-2, A=1.0, B=151.0)
    leak, dry = [], []
    for i, speed in enumerate(MAP["speeds"][:2]):
        for j, p in enumerate((100.0, 200.0)):
            for k, setting in enumerate(MAP["settings"]):
                at = (i * 2 + j) * 2 + k
                leak.append((1 - MAP["volumetric"][at]) * D * setting * speed / (p * BAR))
                dry.append(setting * (1 / MAP["mechanical"][at] - 1))
    assert flow == pytest.approx(D * 0.75 * 150 - np.mean(leak) * 150 * BAR, rel=1e-5)
    assert torque == pytest.approx(D * 150 * BAR * (0.75 + np.mean(dry)), rel=1e-5)


def test_the_case_drain_takes_what_leaks_from_both_sides():
    pump = {**PUMP, "case_leakage": 2e-13}
    case, low = resting(pump, "case_flow", "case_flow_A", duration=1e-2, A=20.0, B=220.0, L=2.0)
    assert case == pytest.approx(2e-13 * 218 * BAR, rel=1e-8)
    assert low == pytest.approx(2e-13 * 18 * BAR, rel=1e-8)


@pytest.mark.parametrize("p", [60.0, 200.0])
def test_an_engine_falls_along_its_droop_and_then_its_torque_curve(p):
    """k (ω₀ - ω) = D Δp, k = T_max/(δ ω₀); beyond the full load the speed falls to where both torques meet."""
    peak, droop, asked = 200.0, 0.08, 220.0
    hydraulics = between(
        {"type": "pump", "displacement": D, "engine": "diesel", "ratio": 1.25}, A=1 * BAR, B=(1 + p) * BAR
    )
    curve = {"speeds": [100, 150, 250], "torques": [150, peak, 100]}
    hydraulics["diesel"] = {
        "type": "engine",
        "speed": asked,
        "torque_curve": curve,
        "inertia": 0.5,
        "droop": droop,
        "load": 5,
    }
    speed, torque, flow = steady(
        hydraulics,
        "diesel.speed",
        "diesel.torque",
        "valve.flow",
        duration=2.0,
        step=1e-2,
        integrator="extrapolated-euler",
    )
    load = 5 + 1.25 * D * p * BAR
    governed = asked - load * droop * asked / peak
    full = 150 + (peak - load) / (peak - 100) * 100
    assert torque == pytest.approx(load, rel=1e-8)
    assert speed == pytest.approx(min(governed, full), rel=1e-8)
    assert flow == pytest.approx(1.25 * D * speed, rel=1e-8)


def test_an_engine_keeps_the_balance_of_energy():
    """It is braked by a pump from one speed to another, and the work of its torque goes into the shaft and the pump."""
    hydraulics = between({"type": "pump", "displacement": D, "engine": "diesel"}, A=1 * BAR, B=201 * BAR)
    asked = {"of": "time", "times": [0, 0.2, 0.4], "values": [220, 220, 120]}
    curve = {"speeds": [100, 250], "torques": [200, 200]}
    hydraulics["diesel"] = {"type": "engine", "speed": asked, "torque_curve": curve, "inertia": 0.5, "drag": 20}
    result = circuit(hydraulics).simulate(integrator="radau", tolerance=1e-8, duration=0.6, output_interval=0.01)
    power = history(result, "hydraulics.diesel.power")
    assert abs(history(result, "energy_error")[-1]) < 1e-5 * np.max(power)
    assert history(result, "hydraulics.diesel.speed")[-1] < 150.0


def test_what_is_missing_is_said():
    from nivel.errors import ModelError

    with pytest.raises(ModelError) as said:
        circuit(between({**PUMP, "torque_limit": "90 N*m"}, A=1e5, B=2e5))
    assert "`frequency` is missing" in str(said.value)
    with pytest.raises(ModelError) as said:
        circuit(between({"type": "pump", "displacement": D, "engine": "disel"}, A=1e5, B=2e5))
    assert "disel" in str(said.value)


def test_an_engine_refuses_a_ninth_pump():
    from nivel.errors import ModelError

    tanks = {"a": {"type": "tank"}, "b": {"type": "tank", "pressure": "9 bar"}}
    pump = {"type": "pump", "displacement": D, "engine": "diesel", "ports": {"A": "a", "B": "b"}}
    curve = {"speeds": [100, 250], "torques": [200, 200]}
    diesel = {"type": "engine", "speed": 200, "torque_curve": curve, "inertia": 0.5}
    pumps = {f"pump{k}": pump for k in range(9)}
    circuit({**tanks, "diesel": diesel, **{name: pumps[name] for name in list(pumps)[:8]}})
    with pytest.raises(ModelError, match="up to 8 pumps") as said:
        circuit({**tanks, "diesel": diesel, **pumps})
    assert "pump8" in str(said.value)
    assert "pump7" not in str(said.value)


@pytest.mark.parametrize(
    ("words", "pressure", "said"),
    [({}, 601, "more torque at t = 0 than the `torque_curve` has"), ({"load": -100, "drag": 40}, 2, "than its `drag`")],
)
def test_an_engine_without_a_steady_speed_is_refused(words, pressure, said):
    """D Δp is 430 N m for a curve up to 320; and without Δp a load of -100 N m turns an engine that brakes with 40."""
    from nivel.errors import ModelError

    curve = {"speeds": [80, 150, 210], "torques": [250, 320, 260]}
    hydraulics = between({"type": "pump", "displacement": D, "engine": "diesel"}, A=1 * BAR, B=pressure * BAR)
    hydraulics["diesel"] = {"type": "engine", "speed": 210, "torque_curve": curve, "inertia": 0.9, **words}
    with pytest.raises(ModelError, match=said):
        circuit(hydraulics).simulate(duration=1e-2, step=1e-2, verify=False)


def test_an_engine_that_stalls_is_told():
    """D Δp grows to 430 N m, more than the curve has: 0.9 ω̇ = 250 - 430 from some time on, so it turns backwards within two seconds."""
    curve = {"speeds": [80, 210], "torques": [250, 260]}
    hydraulics = between({"type": "pump", "displacement": D, "engine": "diesel"}, A=1 * BAR, B=101 * BAR)
    hydraulics["at_B"]["pressure"] = {"of": "time", "times": [0, 0.1, 0.2], "values": [101 * BAR, 101 * BAR, 601 * BAR]}
    hydraulics["diesel"] = {"type": "engine", "speed": 210, "torque_curve": curve, "inertia": 0.9}
    built = circuit(hydraulics)
    result = built.simulate(duration=2.0, step=1e-2, verify=False)
    speed = history(result, "hydraulics.diesel.speed")
    (line,) = [item for item in result.trust.items if item.name == "stall"]
    assert line.verdict == "amber"
    assert line.time == pytest.approx(result.time[np.argmax(speed < 0)], abs=0.02)
    assert np.diff(speed[-2:]) / np.diff(result.time[-2:]) == pytest.approx((250 - D * 600 * BAR) / 0.9, rel=1e-6)
    resting = built.simulate(duration=0.1, step=1e-2, verify=False)
    assert not [item for item in resting.trust.items if item.name == "stall"]
