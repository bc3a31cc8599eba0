"""Every component between given pressures has the flow of its closed form; powers balance and masses are kept."""

import math

import numpy as np
import pytest

from circuits import BAR, LITRE_PER_MINUTE, PA, between, circuit, density, enthalpy, history, steady

RATED = {"flow": "40 L/min", "pressure_drop": "7 bar"}
K = 40 * LITRE_PER_MINUTE / math.sqrt(7 * BAR)
CORNER = 0.5 * BAR


def root(difference):
    return difference * (difference**2 + CORNER**2) ** -0.25


def step(t):
    return 0.0 if t <= 0.0 else 1.0 if t >= 1.0 else t * t * (3.0 - 2.0 * t)


def ramp(z, w=0.02):
    return 0.0 if z <= 0.0 else z - 0.5 * w if z >= w else z**3 / w**2 - 0.5 * z**4 / w**3


@pytest.mark.parametrize(("a", "b"), [(10, 3), (3, 10), (5, 5), (200, 1)])
def test_an_orifice_has_the_flow_of_its_rating(a, b):
    (flow,) = steady(between({"type": "orifice", **RATED, "leakage": 1e-12}, A=a * BAR, B=b * BAR), "valve.flow")
    assert flow == pytest.approx(K * root((a - b) * BAR) + 1e-12 * (a - b) * BAR, rel=1e-12, abs=1e-18)


def test_an_orifice_by_its_diameter_follows_bernoulli():
    (flow,) = steady(between({"type": "orifice", "diameter": "3 mm"}, A=101 * BAR, B=1 * BAR), "valve.flow")
    assert flow == pytest.approx(0.65 * 0.25 * math.pi * 0.003**2 * math.sqrt(2 * 100 * BAR / 870), rel=3e-3)


@pytest.mark.parametrize("reynolds", [500.0, 8e3, 2e4])
def test_a_pipe_follows_poiseuille_and_blasius(reynolds):
    d, length, nu = 0.016, 12.0, 46e-6
    area = 0.25 * math.pi * d**2
    speed = reynolds * nu / d
    rho = density(150 * BAR)
    friction = 64 / reynolds if reynolds < 1187 else 0.3164 * reynolds**-0.25
    drop = friction * length / d * 0.5 * rho * speed**2
    pipe = {"type": "pipe", "diameter": d, "length": length}
    (flow,) = steady(between(pipe, A=150 * BAR + 0.5 * drop, B=150 * BAR - 0.5 * drop), "valve.flow")
    assert flow == pytest.approx(area * speed, rel=2e-3)


@pytest.mark.parametrize("difference", [-10.0, 0.3, 1.0, 2.0, 3.5, 8.0])
def test_a_check_valve_opens_over_its_range(difference):
    (flow,) = steady(between({"type": "check-valve", **RATED}, A=(20 + difference) * BAR, B=20 * BAR), "valve.flow")
    opening = step((difference - 0.5) / 3.0)
    assert flow == pytest.approx(K * opening * root(difference * BAR), rel=1e-9, abs=1e-18)


@pytest.mark.parametrize(("pilot", "opens"), [(20.0, False), (36.0, True)])
def test_a_pilot_opens_a_check_valve_the_other_way(pilot, opens):
    """p_A - p_B + k (p_X - pa) > p_c: with p_B - p_A = 90 bar and k = 3 from p_X - pa = 30.2 bar on."""
    valve = {"type": "check-valve", **RATED, "pilot_ratio": 3.0}
    (flow,) = steady(between(valve, A=10 * BAR, B=100 * BAR, X=pilot * BAR), "valve.flow")
    opening = step((-90.0 + 3.0 * (pilot - PA / BAR) - 0.5) / 3.0)
    assert (opening > 0.0) == opens
    assert flow == pytest.approx(-K * opening * root(90 * BAR), rel=1e-9, abs=1e-18)


@pytest.mark.parametrize("p", [150.0, 205.0, 215.0, 240.0])
def test_a_relief_valve_opens_above_its_setting(p):
    relief = {"type": "relief-valve", **RATED, "opens_at": "200 bar", "opening_range": "20 bar"}
    (flow,) = steady(between(relief, P=p * BAR, T=2 * BAR), "valve.flow")
    assert flow == pytest.approx(K * step((p - 202) / 20) * root((p - 2) * BAR), rel=1e-9, abs=1e-18)


@pytest.mark.parametrize("vented", [False, True])
@pytest.mark.parametrize("pilot", [15.0, 30.0, 60.0])
def test_a_counterbalance_valve_opens_by_load_and_pilot(pilot, vented):
    valve = {"type": "counterbalance-valve", **RATED, "opens_at": "180 bar", "lag": 0, "vented": vented}
    flow, back = steady(between(valve, L=100 * BAR, V=5 * BAR, X=pilot * BAR), "valve.flow", "valve.check_flow")
    behind = PA / BAR if vented else 5.0
    control = 100.0 + 3.0 * pilot - 4.0 * behind - 180.0
    assert flow == pytest.approx(K * step(control / 80.0) * root(95 * BAR), rel=1e-9, abs=1e-18)
    assert back == 0.0


def test_a_counterbalance_valve_lets_fluid_to_the_load():
    valve = {"type": "counterbalance-valve", **RATED, "opens_at": "180 bar", "lag": 0}
    flow, back = steady(between(valve, L=50 * BAR, V=58 * BAR, X=2 * BAR), "valve.flow", "valve.check_flow")
    assert flow == 0.0
    assert back == pytest.approx(K * root(8 * BAR), rel=1e-12)


@pytest.mark.parametrize("p", [70.0, 77.0, 81.0, 84.0])
def test_a_reducing_valve_closes_at_its_setting_and_relieves_above(p):
    valve = {"type": "reducing-valve", **RATED, "pressure": "80 bar"}
    flow, back = steady(between(valve, P=200 * BAR, A=p * BAR, T=2 * BAR), "valve.flow", "valve.relief_flow")
    assert flow == pytest.approx(K * step((80 - p) / 5) * root((200 - p) * BAR), rel=1e-9, abs=1e-18)
    assert back == pytest.approx(K * step((p - 80) / 5) * root((p - 2) * BAR), rel=1e-9, abs=1e-18)


@pytest.mark.parametrize("drop", [3.0, 6.0, 7.0, 9.0, 12.0])
def test_a_compensator_closes_as_the_drop_behind_it_grows(drop):
    valve = {"type": "compensator", **RATED, "margin": "7 bar", "opening_range": "6 bar", "lag": 0}
    (flow,) = steady(between(valve, P=200 * BAR, A=(100 + drop) * BAR, LS=100 * BAR), "valve.flow")
    opening = step(0.5 - (drop - 7.0) / 6.0)
    assert flow == pytest.approx(K * opening * root((100 - drop) * BAR), rel=1e-9, abs=1e-18)


@pytest.mark.parametrize("u", [-1.0, -0.4, 0.0, 0.1, 0.6, 1.0])
@pytest.mark.parametrize("centre", ["closed", "tandem", "open", "float"])
def test_edges_of_a_4_3_valve_open_beyond_their_overlap(u, centre):
    valve = {"type": "directional-valve", "ways": "4/3", "overlap": 0.1, "centre": centre, "command": u, **RATED}
    hydraulics = between(valve, P=100 * BAR, T=2 * BAR, A=60 * BAR, B=30 * BAR)
    edges = ["flow_PA", "flow_BT", "flow_PB", "flow_AT"]
    pa, bt, pb, at = steady(hydraulics, *(f"valve.{edge}" for edge in edges))
    read, full = u, 0.9 - 0.01
    forward, back = ramp(read - 0.1) / full, ramp(-read - 0.1) / full
    assert pa == pytest.approx(K * forward * root(40 * BAR), rel=1e-9, abs=1e-18)
    assert bt == pytest.approx(K * forward * root(28 * BAR), rel=1e-9, abs=1e-18)
    assert pb == pytest.approx(K * back * root(70 * BAR), rel=1e-9, abs=1e-18)
    assert at == pytest.approx(K * back * root(58 * BAR), rel=1e-9, abs=1e-18)
    middle = {
        "closed": {},
        "tandem": {"flow_PT": 98},
        "open": {"flow_PT": 98, "centre_flow_AT": 58},
        "float": {"centre_flow_BT": 28},
    }
    for name, difference in middle[centre].items():
        (flow,) = steady(hydraulics, f"valve.{name}")
        assert flow == pytest.approx(K * (1.0 - step(abs(read) / 0.1)) * root(difference * BAR), rel=1e-4, abs=1e-18)


@pytest.mark.parametrize(("overlap", "rounding"), [(0.0, 0.02), (0.1, 0.02), (0.3, 0.1), (-0.2, 0.02)])
@pytest.mark.parametrize("u", [0.11, 0.35, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("ways", ["4/3", "2/2", "3/2"])
def test_an_edge_opens_as_its_page_says(ways, u, overlap, rounding):
    """x = R(z)/R(1 - overlap), which is 1 at a full stroke: there the flow is that of the rating, whatever the overlap is."""
    valve = {"type": "directional-valve", "ways": ways, "overlap": overlap, "rounding": rounding, "command": u, **RATED}
    ports = {
        "4/3": {"P": 100, "T": 2, "A": 60, "B": 30},
        "2/2": {"P": 100, "A": 60},
        "3/2": {"P": 100, "T": 2, "A": 60},
    }[ways]
    (flow,) = steady(between(valve, **{port: p * BAR for port, p in ports.items()}), "valve.flow_PA")
    z = 2 * u - 1 - overlap if ways == "3/2" else u - overlap
    opening = ramp(z, rounding) / ramp(1 - overlap, rounding)
    assert flow == pytest.approx(K * opening * root(40 * BAR), rel=1e-9, abs=1e-18)
    if u == 1.0:
        assert flow == pytest.approx(K * root(40 * BAR), rel=1e-12)


@pytest.mark.parametrize(("ways", "u", "open_edges"), [
    ("2/2", 0.0, ()), ("2/2", 1.0, ("PA",)),
    ("3/2", 0.0, ("AT",)), ("3/2", 1.0, ("PA",)),
    ("4/2", 0.0, ("PB", "AT")), ("4/2", 1.0, ("PA", "BT")),
])  # fmt: skip
def test_valves_of_two_positions_join_what_their_symbol_says(ways, u, open_edges):
    valve = {"type": "directional-valve", "ways": ways, "command": u, **RATED}
    ports = {"2/2": "PA", "3/2": "PTA", "4/2": "PTAB", "4/3": "PTAB"}[ways]
    pressures = {"P": 100 * BAR, "T": 2 * BAR, "A": 60 * BAR, "B": 30 * BAR}
    hydraulics = between(valve, **{port: pressures[port] for port in ports})
    edges = {"2/2": ["PA"], "3/2": ["PA", "AT"], "4/2": ["PA", "BT", "PB", "AT"]}[ways]
    for edge in edges:
        (flow,) = steady(hydraulics, f"valve.flow_{edge}")
        full = K * root(pressures[edge[0]] - pressures[edge[1]])
        assert flow == pytest.approx(full if edge in open_edges else 0.0, rel=1e-9, abs=1e-18)


def test_a_spool_answers_a_step_as_a_second_order_lag():
    valve = {"type": "directional-valve", "ways": "4/3", "command": 0.5, "frequency": "8 Hz", **RATED}
    hydraulics = between(valve, P=100 * BAR, T=2 * BAR, A=60 * BAR, B=30 * BAR)
    hydraulics["valve"]["command"] = {"of": "time", "times": [0, 1e-9], "values": [0, 0.5]}
    result = circuit(hydraulics).simulate(integrator="radau", tolerance=1e-9, duration=0.1, output_interval=0.01)
    omega, zeta = 2 * math.pi * 8, 0.8
    damped = omega * math.sqrt(1 - zeta**2)
    t = np.asarray(result.time)
    wave = np.cos(damped * t) + zeta / math.sqrt(1 - zeta**2) * np.sin(damped * t)
    assert history(result, "state.valve.spool") == pytest.approx(0.5 * (1 - np.exp(-zeta * omega * t) * wave), abs=1e-6)


# --- machines ---
PUMP = {
    "type": "pump",
    "displacement": "28 cm^3/rev",
    "volumetric_efficiency": 0.95,
    "mechanical_efficiency": 0.92,
    "nominal_pressure": "200 bar",
    "nominal_speed": "1500 rpm",
}
D, SPEED = 28e-6 / (2 * math.pi), 50 * math.pi


def test_a_pump_has_its_efficiencies_at_the_nominal_point():
    pump = {**PUMP, "speed": SPEED}
    flow, torque = steady(between(pump, A=1 * BAR, B=201 * BAR), "valve.flow", "valve.torque")
    assert flow == pytest.approx(0.95 * D * SPEED, rel=1e-4)
    assert torque == pytest.approx(D * 200 * BAR / 0.92, rel=1e-4)  # ISO 4409: D Δp over the torque


@pytest.mark.parametrize("speed", [-SPEED, -1.0, 0.0, 1.0, SPEED])
@pytest.mark.parametrize("rise", [-200.0, -1.0, 0.0, 1.0, 200.0])
def test_pumps_lose_power_in_all_quadrants(speed, rise):
    result = circuit(between({**PUMP, "speed": speed}, A=210 * BAR, B=(210 + rise) * BAR)).simulate(
        duration=1e-3, step=1e-3
    )
    supplied, lost = (history(result, f"state.hydraulics.{name}")[-1] for name in ("supplied", "lost"))
    assert lost >= 0.0
    assert supplied == pytest.approx(lost, rel=1e-9, abs=1e-9)  # shaft and both tanks: nothing is stored


def test_a_flow_source_does_the_work_of_an_ideal_pump():
    flow, power = steady(
        between({"type": "flow-source", "flow": "30 L/min"}, A=2 * BAR, B=150 * BAR), "valve.flow", "valve.power"
    )
    assert flow == pytest.approx(30 * LITRE_PER_MINUTE, rel=1e-12)
    assert power == pytest.approx(flow * density(2 * BAR) * (enthalpy(150 * BAR) - enthalpy(2 * BAR)), rel=1e-10)


def test_the_ripple_of_nine_pistons_is_one_and_a_half_percent():
    pump = {"type": "pump", "displacement": "28 cm^3/rev", "speed": "10 rpm", "pistons": 9}
    result = circuit(between(pump, A=2 * BAR, B=100 * BAR)).simulate(duration=0.7, step=1e-3)
    flow = history(result, "hydraulics.valve.flow")
    assert np.ptp(flow) / (D * math.pi / 3) == pytest.approx(math.pi / 18 * math.tan(math.pi / 36), rel=1e-3)


def test_a_motor_turns_its_joint_with_the_torque_of_its_pressures():
    wheel = {"mass": 1.0, "inertia": [5, 5, 5]}
    hydraulics = {
        "high": {"type": "tank", "pressure": "101 bar"},
        "low": {"type": "tank", "pressure": "1 bar"},
        "motor": {
            "type": "hydraulic-motor",
            "ports": {"A": "high", "B": "low"},
            "displacement": "20 cm^3/rev",
            "coordinate": "axle.angle",
            "ratio": 4,
        },
    }
    axle = {"type": "revolute", "bodies": ["ground", "block"], "point": [0, 0, 0], "axis": [0, 0, 1]}
    result = circuit(hydraulics, bodies={"block": wheel}, joints={"axle": axle}).simulate(
        duration=0.5, step=1e-3, integrator="rk4"
    )
    swing = 20e-6 / (2 * math.pi)
    torque = 4 * swing * 100 * BAR
    assert history(result, "joint_rate")[-1] == pytest.approx(torque / 5 * 0.5, rel=1e-9)
    assert abs(history(result, "energy_error")[-1]) < 1e-6


def test_a_motor_has_its_efficiencies_at_the_nominal_point():
    """Q = D ω/η_v and T = η_hm D Δp, of a motor that its joint turns at the nominal speed."""
    hydraulics = {
        "high": {"type": "tank", "pressure": "201 bar"},
        "low": {"type": "tank", "pressure": "1 bar"},
        "motor": {**PUMP, "type": "hydraulic-motor", "ports": {"A": "high", "B": "low"}, "coordinate": "axle.angle"},
    }
    axle = {"type": "revolute", "bodies": ["ground", "block"], "point": [0, 0, 0], "axis": [0, 0, 1]}
    turned = {"shaft": {"coordinate": "axle.angle", "value": f"{SPEED}*time"}}
    block = {"block": {"mass": 1.0, "inertia": [1, 1, 1]}}
    built = circuit(hydraulics, bodies=block, joints={"axle": axle}, drivers=turned)
    result = built.simulate(duration=1e-3, step=1e-3, integrator="rk4")
    assert history(result, "hydraulics.motor.flow")[-1] == pytest.approx(D * SPEED / 0.95, rel=1e-4)
    assert -history(result, "hydraulics.motor.torque")[-1] == pytest.approx(0.92 * D * 200 * BAR, rel=1e-4)
