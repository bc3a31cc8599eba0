"""What components do in time, against closed forms: cushions, stops, water hammer, cut-off, slow spools and poppets, elastic walls."""

import math
from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from circuits import ALPHA, BAR, BETA, LITRE_PER_MINUTE, PA, SLOPE, N, circuit, density, history, steady
from simulating import slide

pytestmark = pytest.mark.covering

RATED = {"flow": "40 L/min", "pressure_drop": "7 bar"}
K = 40 * LITRE_PER_MINUTE / math.sqrt(7 * BAR)
CORNER = 0.5 * BAR


def modulus(p):
    """β = ρ dp/dρ = -v/v' of the default fluid."""
    liquid = (1.0 - ALPHA) * (1.0 + SLOPE * (p - PA) / BETA) ** (-1.0 / SLOPE)
    air = ALPHA * (PA / p) ** (1.0 / N)
    return (liquid + air) / (liquid / (BETA + SLOPE * (p - PA)) + air / (N * p))


def test_water_hammer_is_that_of_joukowsky():
    """A line of 20 pieces, closed at its end: ρ a Δv above the pressure before, once the front has come; a = √(β/ρ)."""
    pieces, length, area = 20, 10.0, 0.25 * math.pi * 0.02**2
    fluids = {"oil": {"viscosity": 1e-8, "air": 1e-4}}
    hydraulics = {"far": {"type": "tank", "pressure": "101 bar"}}
    before = "far"
    for k in range(pieces):
        hydraulics[f"v{k}"] = {"type": "volume", "volume": area * length / pieces, "start": "101 bar"}
        pipe = {"type": "pipe", "diameter": "20 mm", "length": length / pieces, "inertia": True}
        hydraulics[f"p{k}"] = {**pipe, "ports": {"A": before, "B": f"v{k}"}}
        before = f"v{k}"
    # what flows out begins at once: a change of speed at the end of a line at rest
    flow = {"type": "flow-source", "ports": {"A": before, "B": "far"}, "flow": 0.5 * area}
    hydraulics["out"] = flow
    result = circuit(hydraulics, fluids=fluids).simulate(
        integrator="rk4", step=5e-5, duration=14e-3, output_interval=1e-4
    )
    p = history(result, f"hydraulics.{before}.pressure")
    t = np.asarray(result.time)
    rho, beta = 870.0 * 1.0065, 1.5e9 + 10 * 100e5
    speed = math.sqrt(beta / rho)
    plateau = (t > 3e-3) & (t < 1.6 * length / speed)  # behind the ripples of the front, before it returns
    assert np.mean(101 * BAR - p[plateau]) == pytest.approx(rho * speed * 0.5, rel=1e-2)


def test_the_inertia_of_a_pipe_accelerates_its_flow():
    """(L/A) dṁ/dt = Δp between two tanks, before friction grows: a jump of 10 bar over 4 m."""
    pipe = {"type": "pipe", "diameter": "20 mm", "length": 4, "inertia": True, "ports": {"A": "high", "B": "low"}}
    jump = {"of": "time", "times": [0, 1e-9], "values": [10e5, 20e5]}
    tanks = {"high": {"type": "tank", "pressure": jump}, "low": {"type": "tank", "pressure": "10 bar"}}
    result = circuit({**tanks, "pipe": pipe}, fluids={"oil": {"viscosity": 1e-8}}).simulate(
        duration=1e-3, step=1e-4, integrator="rk4"
    )
    wanted = 10 * BAR * 0.25 * math.pi * 0.02**2 / 4 * (1e-3 - 1e-4 / 6)  # the first of four stages has no jump yet
    assert history(result, "state.pipe.mass_flow")[-1] == pytest.approx(wanted, rel=1e-3)


def block_on_a_piston(place, speed, mass=200.0, **ram):
    """A block on a slide with a cylinder of 0.4 m, from 0.5 m on, that ends at 0.9 m."""
    cylinder = {
        "type": "cylinder", "piston": "80 mm", "rod": "40 mm", "stroke": 0.4, "retracted_length": 0.5, "bodies": ["ground", "block"],
        "points": [[0, 0, 0], [place, 0, 0]], **ram,
    }  # fmt: skip
    block = {"mass": mass, "inertia": [1, 1, 1], "position": [place, 0, 0], "velocity": [speed, 0, 0]}
    return {"block": block}, {"rail": slide("ground", "block", point=[place, 0, 0])}, cylinder


def test_a_piston_rebounds_from_its_stop_with_its_restitution():
    """A block meets the end of the stroke at 0.1 m/s, in the air: its speed after is that times the restitution, and the depth that of
    the spring with this energy."""
    bodies, joints, ram = block_on_a_piston(0.899, 0.1, acting="single", stop_restitution=0.5, stop_stiffness=1e8)
    ram |= {"rod": 0, "start_A": PA, "dead_volume_A": 0.1}
    result = circuit({"ram": ram}, bodies=bodies, joints=joints).simulate(
        integrator="dopri5", tolerance=1e-8, duration=0.03, output_interval=1e-4
    )
    speed = history(result, "hydraulics.ram.speed")
    assert speed[-1] / speed[0] == pytest.approx(-0.5, rel=0.02)
    depth = np.max(history(result, "hydraulics.ram.position")) - 0.4
    assert 0.5 * 0.1 * math.sqrt(200 / 1e8) < depth < 0.1 * math.sqrt(200 / 1e8)


CUSHION = {"length": "40 mm", "least_opening": 0.03, "port_volume": "50 cm^3", **RATED}


@cache
def into_the_cushion():
    """A block that moves into a cushion, its chambers open to tanks through wide orifices."""
    bodies, joints, ram = block_on_a_piston(0.84, 0.6, cushion_B=CUSHION, dead_volume_B="50 cm^3", start_A="20 bar")
    wide = {"type": "orifice", "diameter": "30 mm"}
    hydraulics = {
        "tank": {"type": "tank", "pressure": "20 bar"},
        "ram": {**ram, "start_B": "20 bar"},
        "a": {**wide, "ports": {"A": "tank", "B": "ram.A"}},
        "b": {**wide, "ports": {"A": "ram.B", "B": "tank"}},
    }
    return circuit(hydraulics, bodies=bodies, joints=joints).simulate(
        integrator="radau", tolerance=1e-7, duration=0.15, output_interval=1e-3
    )


def test_a_cushion_throttles_by_what_is_left_of_its_length():
    """Q = K (x₀ + (1 - x₀) S(distance/length)) √Δp, the check valve beside it closed."""
    result = into_the_cushion()
    s, flow = history(result, "hydraulics.ram.position"), history(result, "hydraulics.ram.cushion_flow_B")
    inner, outer = (history(result, f"hydraulics.ram.pressure{end}") for end in ("_B", "_port_B"))
    t = np.clip((0.4 - s) / 0.04, 0, 1)
    opening = 0.03 + 0.97 * t * t * (3 - 2 * t)
    root = (inner - outer) * ((inner - outer) ** 2 + CORNER**2) ** -0.25
    assert flow == pytest.approx(K * opening * root, rel=1e-6, abs=1e-9)
    assert np.max(inner) > 60 * BAR
    assert np.max(np.abs(history(result, "hydraulics.ram.check_flow_B"))) == 0.0


def test_a_cushion_brakes_a_block_as_its_equation_says():
    """m v v' = A_B (Δp of the cushion) - …: quasi-steady, v falls with s; SciPy on incompressible oil is within 5 %."""
    result = into_the_cushion()
    a, b = 0.25 * math.pi * 0.08**2, 0.25 * math.pi * (0.08**2 - 0.04**2)

    def rates(_, y):
        s, v = y
        x = min(max((0.4 - s) / 0.04, 0), 1)
        opening = 0.03 + 0.97 * x * x * (3 - 2 * x)
        drop = (b * v / (K * opening)) ** 2
        return [v, ((20 * BAR - PA) * a - (20 * BAR - PA + drop) * b) / 200.0]

    exact = solve_ivp(rates, (0, 0.1), [0.34, 0.6], rtol=1e-8, max_step=1e-3)
    k = int(np.searchsorted(np.asarray(result.time), 0.08))
    s = history(result, "hydraulics.ram.position")[k]
    assert s == pytest.approx(np.interp(0.08, exact.t, exact.y[0]), rel=0.02)
    assert history(result, "hydraulics.ram.speed")[k] < 0.35


def test_a_pump_destrokes_at_its_cut_off():
    """The load is above the cut-off, behind a check valve: the pump holds its own greatest pressure against a leak."""
    valve = {"type": "directional-valve", "ways": "4/3", "command": 0.5, **RATED}
    hydraulics = {
        "tank": {"type": "tank", "pressure": "2 bar"},
        "high": {"type": "tank", "pressure": "260 bar"},
        "supply": {"type": "volume", "volume": "1 L", "start": "150 bar"},
        "gap": {"type": "volume", "volume": "0.1 L", "start": "260 bar"},
        "check": {"type": "check-valve", "ports": {"A": "supply", "B": "gap"}, **RATED},
        "ls": {"type": "load-sensing", "valves": ["valve"]},
        "valve": {**valve, "ports": {"P": "gap", "T": "tank", "A": "high", "B": "tank"}},
        "leak": {"type": "orifice", "ports": {"A": "supply", "B": "tank"}, "leakage": "1e-12 m^3/(s*Pa)"},
        "pump": {
            "type": "pump", "ports": {"A": "tank", "B": "supply", "LS": "ls"}, "displacement": "60 cm^3/rev",
            "speed": "1500 rpm", "margin": "20 bar", "cut_off": "200 bar",
        },
    }  # fmt: skip
    result = circuit(hydraulics).simulate(integrator="radau", duration=1.5, output_interval=0.01)
    assert history(result, "hydraulics.ls.pressure")[-1] == pytest.approx(260 * BAR, rel=1e-3)
    assert history(result, "hydraulics.supply.pressure")[-1] == pytest.approx(200 * BAR, rel=5e-3)
    leak = 1e-12 * 198 * BAR * density(200 * BAR)
    setting = leak / (density(2 * BAR) * 60e-6 * 25)
    assert history(result, "hydraulics.pump.setting")[-1] == pytest.approx(setting, rel=0.1)


TANKS = {"high": {"type": "tank", "pressure": "100 bar"}, "low": {"type": "tank", "pressure": "2 bar"}}
JUMP = {"of": "time", "times": [0, 1e-9], "values": [0, 1]}


def test_a_spool_with_a_rate_limit_follows_its_closed_form():
    """u̇ = r tanh(ω (u_c - u)/r): sinh(ω (1 - u)/r) = sinh(ω/r) e^(-ωt)."""
    valve = {
        "type": "directional-valve",
        "ways": "2/2",
        "frequency": "10 Hz",
        "rate_limit": 8,
        "command": JUMP,
        **RATED,
    }
    result = circuit({**TANKS, "valve": {**valve, "ports": {"P": "high", "A": "low"}}}).simulate(
        integrator="radau", tolerance=1e-9, duration=0.2, output_interval=0.01
    )
    omega = 2 * math.pi * 10
    exact = 1 - 8 / omega * np.arcsinh(np.sinh(omega / 8) * np.exp(-omega * np.asarray(result.time)))
    assert history(result, "state.valve.spool") == pytest.approx(exact, abs=1e-6)


def test_a_poppet_opens_with_its_time_constant():
    pressure = {"of": "time", "times": [0, 1e-9], "values": [100e5, 300e5]}
    relief = {"type": "relief-valve", "opens_at": "150 bar", "opening_range": "20 bar", "lag": "8 ms", **RATED}
    tanks = {"line": {"type": "tank", "pressure": pressure}, "low": TANKS["low"]}
    result = circuit({**tanks, "relief": {**relief, "ports": {"P": "line", "T": "low"}}}).simulate(
        integrator="radau", tolerance=1e-9, duration=0.04, output_interval=2e-3
    )
    x = history(result, "hydraulics.relief.position")
    assert x[1:] == pytest.approx(1 - np.exp(-np.asarray(result.time)[1:] / 8e-3), abs=1e-6)


def test_an_elastic_wall_takes_its_share_of_the_oil():
    """1/β_eff = 1/β + 1/β_wall: ∫ρ(1/β + …) dp; a hose that is filled by a known volume of oil."""
    hydraulics = {
        "tank": {"type": "tank"},
        "hose": {"type": "volume", "volume": "1 L", "wall_modulus": "0.8 GPa", "start": "1.01325 bar"},
        "fill": {"type": "flow-source", "ports": {"A": "tank", "B": "hose"}, "flow": "2 L/min"},
        "safety": {"type": "relief-valve", "ports": {"P": "hose", "T": "tank"}, "opens_at": "400 bar", "opening_range": "9 bar", **RATED},
    }  # fmt: skip
    result = circuit(hydraulics).simulate(integrator="radau", tolerance=1e-9, duration=0.8)
    p = history(result, "hydraulics.hose.pressure")[-1]
    filled = 2 * LITRE_PER_MINUTE * 0.8 * density(PA)

    def slope(x):
        return density(x) * 1e-3 * ((1 + (x - PA) / 0.8e9) / modulus(x) + 1 / 0.8e9)

    assert quad(slope, PA, p, epsabs=0, epsrel=1e-10)[0] == pytest.approx(filled, rel=1e-7)
    assert p > 50 * BAR


@pytest.mark.parametrize("p", [PA, 1e3, 2 * PA])
def test_flows_at_awkward_pressures_are_finite(p):
    """Nothing flows where both sides are at the air's pressure, or nearly empty."""
    tanks = {"a": {"type": "tank", "pressure": p}, "b": {"type": "tank", "pressure": p}}
    parts = {
        "orifice": {"type": "orifice", **RATED},
        "pipe": {"type": "pipe", "diameter": "10 mm", "length": 1},
        "check": {"type": "check-valve", **RATED},
    }
    hydraulics = tanks | {name: {**part, "ports": {"A": "a", "B": "b"}} for name, part in parts.items()}
    assert steady(hydraulics, *(f"{name}.flow" for name in parts)) == [0.0, 0.0, 0.0]
