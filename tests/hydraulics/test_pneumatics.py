"""Gas in circuits: choked and subsonic flow, tanks that empty and fill, springs of enclosed gas, energy and mass; and faults in words."""

import math
from functools import cache

import numpy as np
import pytest

from circuits import BAR, PA, circuit, history
from nivel.api import Machine
from nivel.errors import ModelError
from nivel.files import parse_machine
from nivel.files.schema import schema
from simulating import slide

pytestmark = pytest.mark.covering

RHO_N, T_N, KAPPA = 1.185, 293.15, 1.4
R = 1e5 / (RHO_N * T_N)
C, B = 1e-3 / BAR, 0.3
GASES = {"air": {"type": "ideal-gas"}, "calm": {"type": "ideal-gas", "isothermal": True}}
VALVE = {"type": "orifice", "sonic_conductance": C, "critical_ratio": B}
FULL, EMPTY, SUPPLY = 11 * BAR, 1 * BAR, 8 * BAR
VOLUME = 2e-3
RATE = R * T_N * C * RHO_N / VOLUME  # of pressure, over the pressure upstream [1/s], at T_N


@cache
def boxes():
    """For each gas a box that empties into the air and one that is filled: four circuits in one run."""
    hydraulics = {}
    for gas in GASES:
        hydraulics |= {
            f"room_{gas}": {"type": "tank", "fluid": gas},
            f"supply_{gas}": {"type": "tank", "pressure": SUPPLY, "fluid": gas},
            f"full_{gas}": {"type": "volume", "volume": VOLUME, "start": FULL, "fluid": gas},
            f"empty_{gas}": {"type": "volume", "volume": VOLUME, "start": EMPTY, "fluid": gas},
            f"out_{gas}": {**VALVE, "ports": {"A": f"full_{gas}", "B": f"room_{gas}"}},
            f"in_{gas}": {**VALVE, "ports": {"A": f"supply_{gas}", "B": f"empty_{gas}"}},
        }
    return circuit(hydraulics, fluids=GASES).simulate(
        integrator="radau", tolerance=1e-9, duration=4.0, output_interval=0.02
    )


@pytest.mark.parametrize("gas", GASES)
def test_a_choked_tank_empties_by_its_closed_form(gas):
    """ṁ ~ p/√T: p₀ e^(-rt) at constant temperature, p₀ (1 + (κ - 1) r t/2)^(-2κ/(κ - 1)) and T/T₀ = (p/p₀)^((κ - 1)/κ) without heat."""
    result = boxes()
    t, p = np.asarray(result.time), history(result, f"hydraulics.full_{gas}.pressure")
    choked = p > PA / B
    exact = np.exp(-RATE * t)
    if gas == "air":
        exact = (1 + 0.5 * (KAPPA - 1) * RATE * t) ** (-2 * KAPPA / (KAPPA - 1))
    assert 5 < np.sum(choked) < len(t)
    assert p[choked] == pytest.approx(FULL * exact[choked], rel=1e-9)
    temperature = history(result, f"hydraulics.full_{gas}.temperature")
    wanted = (p / FULL) ** ((KAPPA - 1) / KAPPA) if gas == "air" else np.ones(len(t))
    assert temperature == pytest.approx(T_N * wanted, rel=1e-8)


@pytest.mark.parametrize("gas", GASES)
def test_a_tank_fills_by_its_closed_form(gas):
    """p₀ + r t while choked, then p_s (b + (1 - b) sin(r (t - t_c)/(p_s (1 - b)))), with heat or without: r is κ times as large then."""
    result = boxes()
    t, p = np.asarray(result.time), history(result, f"hydraulics.empty_{gas}.pressure")
    rate = RATE * SUPPLY * (KAPPA if gas == "air" else 1.0)
    choked = (B * SUPPLY - EMPTY) / rate
    angle = np.minimum(rate * (t - choked) / (SUPPLY * (1 - B)), 0.5 * np.pi)
    exact = np.where(t < choked, EMPTY + rate * t, SUPPLY * (B + (1 - B) * np.sin(angle)))
    before = angle < 1.4  # x > 0.015; √x is rounded by a quarter of (ε/x)², ε = 1e-3
    assert p[before] == pytest.approx(exact[before], rel=1e-5)
    assert p[-1] == pytest.approx(SUPPLY, rel=1e-6)
    temperature = history(result, f"hydraulics.empty_{gas}.temperature")
    wanted = KAPPA * T_N / (1 + EMPTY / p * (KAPPA - 1)) if gas == "air" else T_N + 0 * p
    assert temperature == pytest.approx(wanted, rel=1e-8)


def test_energy_and_mass_of_gas_balance():
    items = {item.name: item for item in boxes().trust.items}
    assert items["hydraulics"].fraction < 1e-8
    assert items["fluid mass"].fraction < 1e-9
    assert "cavitation" not in items


def test_the_mass_of_gas_in_closed_volumes_stays():
    hydraulics = {
        "one": {"type": "volume", "volume": "1 L", "start": "9 bar", "fluid": "air"},
        "two": {"type": "volume", "volume": "3 L", "start": "20 kPa", "heat_conductance": 2, "fluid": "air"},
        "gap": {**VALVE, "ports": {"A": "one", "B": "two"}},
    }
    result = circuit(hydraulics, fluids={"air": GASES["air"]}).simulate(duration=0.5, step=1e-3)
    mass = [history(result, f"state.{name}.mass") for name in ("one", "two")]
    assert np.ptp(mass[0]) > 1e-3
    assert np.ptp(mass[0] + mass[1]) < 1e-13 * mass[0][0]


RATIOS = [0.0, 0.2, 0.3, 0.5, 0.8, 0.99, 1.0, 1.02, 2.0]


@cache
def steady_flows():
    """Flows from 6 bar to these ratios of it, through a valve and through a nozzle of 2 mm: pairs of tanks in one run."""
    hydraulics = {}
    nozzle = {"type": "orifice", "diameter": "2 mm", "discharge_coefficient": 0.9}
    for k, ratio in enumerate(RATIOS):
        hydraulics |= {
            f"high_{k}": {"type": "tank", "pressure": "6 bar"},
            f"low_{k}": {"type": "tank", "pressure": max(6 * ratio, 1e-3) * BAR},
            f"valve_{k}": {**VALVE, "ports": {"A": f"high_{k}", "B": f"low_{k}"}},
            f"nozzle_{k}": {**nozzle, "ports": {"A": f"high_{k}", "B": f"low_{k}"}},
        }
    fluids = {"air": GASES["air"]}
    return circuit(hydraulics, fluids=fluids).simulate(duration=1e-3, step=1e-3, integrator="rk4")


@pytest.mark.parametrize(("k", "ratio"), list(enumerate(RATIOS)))
def test_a_valve_has_the_flow_of_iso_6358(k, ratio):
    high, low = max(6.0, 6.0 * ratio), min(6.0, 6.0 * ratio)
    x = min((1 - low / high) / (1 - B), 1.0)
    flow = math.copysign(C * high * BAR * math.sqrt(x * (2 - x)), 1 - ratio)
    # √x is rounded by a quarter of (ε/x)²
    assert history(steady_flows(), f"hydraulics.valve_{k}.flow")[-1] == pytest.approx(flow, rel=2e-3, abs=1e-12)


def test_a_nozzle_is_choked_at_the_flow_of_saint_venant():
    area = 0.9 * 0.25 * math.pi * 0.002**2
    mass_flow = area * 6 * BAR * math.sqrt(KAPPA / (R * T_N)) * (2 / (KAPPA + 1)) ** (0.5 * (KAPPA + 1) / (KAPPA - 1))
    for k in (0, 1, 2, 3):
        assert history(steady_flows(), f"hydraulics.nozzle_{k}.flow")[-1] * RHO_N == pytest.approx(mass_flow, rel=1e-9)


@pytest.mark.parametrize("gas", GASES)
def test_gas_in_a_closed_cylinder_is_a_spring(gas):
    """ω² = κ p (A²/V_A + A²/V_B)/m without heat, and with κ = 1 at constant temperature."""
    ram = {
        "type": "cylinder", "piston": "80 mm", "stroke": "0.4 m", "retracted_length": "0.5 m", "dead_volume_A": "0.1 L",
        "dead_volume_B": "0.1 L", "bodies": ["ground", "block"], "points": [[0, 0, 0], [0.7, 0, 0]], "start_A": "6 bar",
        "start_B": "6 bar", "fluid": "gas",
    }  # fmt: skip
    block = {"mass": 20.0, "inertia": [1, 1, 1], "position": [0.7, 0, 0], "velocity": [1e-3, 0, 0]}
    joint = slide("ground", "block", point=[0.7, 0, 0])
    machine = circuit({"ram": ram}, fluids={"gas": GASES[gas]}, bodies={"block": block}, joints={"rail": joint})
    area = 0.25 * math.pi * 0.08**2
    ratio = KAPPA if gas == "air" else 1.0
    omega = math.sqrt(ratio * 6 * BAR * area**2 * 2 / (0.1e-3 + 0.2 * area) / 20.0)
    result = machine.simulate(integrator="dopri5", tolerance=1e-10, duration=0.4, output_interval=0.01)
    t = np.asarray(result.time)
    moved = np.asarray(result.array("position"))[:, 0, 0] - 0.7
    assert moved == pytest.approx(1e-3 / omega * np.sin(omega * t), abs=2e-6 / omega)
    assert next(item.fraction for item in result.trust.items if item.name == "energy") < 1e-6


PORTS = {"A": 4 * BAR, "B": 3 * BAR, "P": 7 * BAR, "R": PA, "S": PA}


@pytest.mark.parametrize(
    ("ways", "u", "open_edges"), [("5/2", 0, "PB AR"), ("5/2", 1, "PA BS"), ("5/3", 0, "AR BS"), ("5/3", -1, "PB AR")]
)
def test_valves_with_five_ports_join_what_their_symbol_says(ways, u, open_edges):
    valve = {"type": "directional-valve", "ways": ways, "command": u, "sonic_conductance": C}
    if ways == "5/3":
        valve["centre"] = "float"
    tanks = {f"at_{port}": {"type": "tank", "pressure": p} for port, p in PORTS.items()}
    valve["ports"] = {port: f"at_{port}" for port in PORTS}
    result = circuit({**tanks, "valve": valve}, fluids={"air": GASES["air"]}).simulate(duration=1e-3, step=1e-3)
    flowing = set()
    for name in result.variables:
        if name.startswith("hydraulics.valve.") and "flow" in name and history(result, name)[-1] > 0.0:
            flowing.add(name[-2:])
    assert flowing == set(open_edges.split())


GOOD = """format: 1
bodies: {block: {mass: 1, inertia: [1, 1, 1]}}
fluids: {air: {type: ideal-gas}, oil: {}}
hydraulics:
  supply: {type: tank, pressure: 7 bar, fluid: air}
  box: {type: volume, volume: 1 L, fluid: air}
  valve: {type: check-valve, ports: {A: supply, B: box}, sonic_conductance: 1 dm^3/(s*bar)}
simulation: {duration: 1 ms, step: 1 ms}
"""
FAULTS = {
    "two fluids": ("1 L, fluid: air", "1 L, fluid: oil", "one component carries one fluid; its nodes are supply of air, box of oil"),
    "a rating of liquids": ("sonic_conductance: 1 dm^3/(s*bar)", "flow: 1 L/min, pressure_drop: 1 bar", "gases have `sonic_conductance`"),
    "no rating": (", sonic_conductance: 1 dm^3/(s*bar)", "", "`flow` and `pressure_drop` are missing"),
    "both": ("1 dm^3/(s*bar)", "1 dm^3/(s*bar), flow: 1 L/min", "is of liquids, and `sonic_conductance` of gases"),
    "a component of liquids": ("type: check-valve", "type: pipe", "a pipe is for liquids; circuits of gas know `check-valve`, `cylinder`"),
    "another one of liquids": ("type: check-valve", "type: unloading-valve", "an unloading-valve is for liquids"),
    "an elastic wall": ("1 L, fluid", "1 L, wall_modulus: 1 GPa, fluid", "`wall_modulus` belongs to liquids"),
    "an unknown kind of fluid": ("type: ideal-gas", "type: gas", "the type `gas` is not known; did you mean `ideal-gas`?"),
    "a ratio of one": ("{type: ideal-gas}", "{type: ideal-gas, heat_capacity_ratio: 1}", "a ratio above 1 and up to 5/3"),
    "degrees Celsius": ("{type: ideal-gas}", "{type: ideal-gas, temperature: -20}", "greater than zero"),
}  # fmt: skip


@pytest.mark.parametrize("case", FAULTS)
def test_a_fault_of_a_gas_says_what_would_be_right(case):
    old, new, message = FAULTS[case]
    assert old in GOOD
    with pytest.raises(ModelError) as caught:
        parse_machine(GOOD.replace(old, new, 1))
    assert message in str(caught.value)


def test_a_good_circuit_of_gas_runs():
    assert Machine.from_record(parse_machine(GOOD)).simulate().outcome == "done"


def test_editors_take_a_liquid_without_its_type_and_a_gas_with_it():
    definitions = schema()["$defs"]
    assert "type" not in definitions["Fluid"]["required"]
    assert "type" in definitions["Gas"]["required"]
