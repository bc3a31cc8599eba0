"""Fluid in volumes: the law of density, closed forms of emptying, accumulators and closed cylinders, masses that stay."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from circuits import BAR, PA, circuit, density, history
from nivel.elements.circuits.density import density_and_modulus, fluid_constants, specific_volume
from nivel.elements.circuits.fluids import OIL
from simulating import hinge, machine, slide

pytestmark = pytest.mark.covering

LAW = fluid_constants(OIL)
# Published with the law: p [bar], β [MPa], ρ [kg/m³]
TABLE = [
    (0.1, 0.5, 847.683),
    (1.01325, 27.8, 865.656),
    (5, 338.3, 868.841),
    (10, 734.6, 869.674),
    (20, 1147.7, 870.581),
    (50, 1449.6, 872.535),
    (100, 1565.3, 875.417),
    (200, 1687.2, 880.808),
]


@pytest.mark.parametrize(("p", "modulus", "rho"), TABLE)
def test_density_and_bulk_modulus_are_those_of_the_table(p, modulus, rho):
    found = density_and_modulus(LAW, p * BAR)
    assert found[0] == pytest.approx(rho, abs=6e-4)
    assert found[1] / 1e6 == pytest.approx(modulus, abs=0.06)


def test_the_enthalpy_is_that_of_the_table():
    assert specific_volume.py_func(LAW, 200 * BAR)[2] / LAW[4] == pytest.approx(22734.3035, rel=1e-8)
    assert specific_volume.py_func(LAW, 10 * BAR)[2] / LAW[4] == pytest.approx(1034.53543, rel=1e-8)


@pytest.mark.parametrize("p", [1e3, 1e4, PA, 1e6, 1e7, 6e7])
def test_the_bulk_modulus_is_the_derivative_of_the_density(p):
    h = 1e-4 * p
    slope = (density(p + h) - density(p - h)) / (2 * h)
    rho, modulus = density_and_modulus(LAW, p)
    assert rho == pytest.approx(density(p), rel=1e-14)
    assert modulus == pytest.approx(rho / slope, rel=1e-6)


def two_volumes(**settings):
    """Two volumes that empty into each other through an orifice, of which the second one cavitates at the start."""
    hydraulics = {
        "one": {"type": "volume", "volume": "1 L", "start": "200 bar"},
        "two": {"type": "volume", "volume": "3 L", "start": "2 kPa"},
        "gap": {"type": "orifice", "ports": {"A": "one", "B": "two"}, "flow": "1 L/min", "pressure_drop": "100 bar"},
    }
    return circuit(hydraulics).simulate(duration=0.2, **settings)


@pytest.mark.parametrize(
    "settings",
    [
        {"integrator": "rk4", "step": 1e-4},
        {"integrator": "ab3", "step": 1e-4},
        {"integrator": "dopri5"},
        {"integrator": "dop853"},
        {"integrator": "bdf"},
        {"integrator": "radau"},
        {"integrator": "generalised-alpha", "step": 1e-4},
        {"integrator": "extrapolated-euler", "step": 1e-3},
    ],
    ids=lambda each: each["integrator"],
)
def test_the_mass_of_a_closed_circuit_stays(settings):
    result = two_volumes(**settings)
    one, two = (history(result, f"state.{name}.mass") for name in ("one", "two"))
    assert np.ptp(one) > 1e-3
    assert np.max(np.abs(one + two - one[0] - two[0])) < 1e-12 * (one[0] + two[0])


def test_a_volume_empties_into_the_air_as_the_root_of_its_pressure_falls():
    """Constant β, c → 0: V/β ṗ = -K √p, so √p falls at the rate β K/2V; with a law of little air and slope, within its corrections."""
    conductance, volume = 1e-4 / math.sqrt(100 * BAR), 1e-3
    hydraulics = {
        "box": {"type": "volume", "volume": volume, "start": 200 * BAR + PA},
        "air": {"type": "tank", "pressure": PA},
        "gap": {
            "type": "orifice",
            "ports": {"A": "box", "B": "air"},
            "flow": 1e-4,
            "pressure_drop": 100 * BAR,
            "transition": "1 Pa",
        },
    }
    fluids = {"stiff": {"air": 1e-4, "bulk_modulus_slope": 0, "bulk_modulus": "30 GPa"}}
    time = 2e-3
    result = circuit(hydraulics, fluids=fluids).simulate(integrator="dopri5", tolerance=1e-9, duration=time)
    p = history(result, "hydraulics.box.pressure")[-1] - PA
    expected = math.sqrt(200 * BAR) - 30e9 * conductance * time / (2 * volume)
    assert math.sqrt(p) == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("exponent", [1.0, 1.3])
def test_an_accumulator_takes_up_oil_by_the_law_of_its_gas(exponent):
    hydraulics = {
        "from": {"type": "tank"},
        "line": {"type": "volume", "volume": "0.1 L", "start": "80 bar"},
        "source": {"type": "flow-source", "ports": {"A": "from", "B": "line"}, "flow": "20 L/min"},
        "store": {
            "type": "accumulator",
            "ports": {"A": "line"},
            "volume": "1 L",
            "precharge": "60 bar",
            "gas_exponent": exponent,
            "flow": "100 L/min",
            "pressure_drop": "1 bar",
            "start": "80 bar",
        },
        "safety": {
            "type": "relief-valve",
            "ports": {"P": "line", "T": "from"},
            "opens_at": "300 bar",
            "opening_range": "10 bar",
            "flow": "60 L/min",
            "pressure_drop": "300 bar",
        },
    }
    result = circuit(hydraulics).simulate(integrator="radau", tolerance=1e-8, duration=1.0)
    p, mass = history(result, "hydraulics.store.pressure"), history(result, "state.store.mass")
    # m/ρ is the oil: what is constant, 2 % of the gas, and what the gas left
    gas = 1.02e-3 - mass / density(p)
    assert p * gas**exponent == pytest.approx(60 * BAR * 1e-3**exponent, rel=1e-9)
    assert p[-1] > 100 * BAR
    assert result.trust.verdict == "green"


@pytest.mark.parametrize(
    "settings", [{"integrator": "radau", "tolerance": 1e-8}, {"integrator": "extrapolated-euler", "step": 1e-3}]
)
@pytest.mark.parametrize("exponent", [1.0, 1.3])
def test_an_accumulator_that_fills_and_empties_follows_its_law_without_losses(exponent, settings):
    """From empty through its precharge to 90 bar and back: p Vⁿ above; below, the gas rests on its inlet over half of the 20 cm³."""
    flow = {"of": "time", "times": [0, 0.1, 0.7, 0.8, 1.6], "values": [0, 4e-4, 4e-4, -4e-4, -4e-4]}
    hydraulics = {
        "from": {"type": "tank"},
        "line": {"type": "volume", "volume": "1 L", "start": "40 bar"},
        "source": {"type": "flow-source", "ports": {"A": "from", "B": "line"}, "flow": flow},
        "store": {
            "type": "accumulator", "ports": {"A": "line"}, "volume": "1 L", "precharge": "60 bar", "gas_exponent": exponent,
            "flow": "100 L/min", "pressure_drop": "1 bar", "start": "40 bar",
        },
        "safety": {
            "type": "relief-valve", "ports": {"P": "line", "T": "from"}, "opens_at": "250 bar", "opening_range": "10 bar",
            "flow": "60 L/min", "pressure_drop": "250 bar",
        },
    }  # fmt: skip
    result = circuit(hydraulics).simulate(duration=1.43, output_interval=2e-3, **settings)
    p, mass = history(result, "hydraulics.store.pressure"), history(result, "state.store.mass")
    oil = mass / density(p)
    full = p > 60 * BAR
    empty = p < 0.97 * 60 * BAR
    assert np.count_nonzero(empty) > 5
    assert not empty[350]
    assert np.max(p) > 75 * BAR
    assert p[full] * (1.02e-3 - oil[full]) ** exponent == pytest.approx(60 * BAR * 1e-3**exponent, rel=1e-9)
    assert oil[empty] == pytest.approx(0.01e-3, rel=1e-8)
    items = {item.name: item for item in result.trust.items}
    assert items["hydraulics"].fraction < 1e-4
    # no step in the energy where the gas begins to give way
    error = history(result, "energy_error")
    assert np.max(np.abs(np.diff(error))) < 1e-4 * np.ptp(history(result, "potential_energy"))


CYLINDER = {
    "type": "cylinder",
    "piston": "80 mm",
    "rod": "40 mm",
    "stroke": "0.5 m",
    "retracted_length": "0.7 m",
    "dead_volume_A": "0.1 L",
    "dead_volume_B": "0.1 L",
    "bodies": ["ground", "block"],
    "points": [[0, 0, 0], [0.95, 0, 0]],
}


def closed_cylinder(speed):
    """A block on a slide, between two closed chambers at about 100 bar."""
    tank = {"type": "tank"}
    leaks = {
        f"valve_{port}": {
            "type": "orifice",
            "ports": {"A": f"ram.{port}", "B": "tank"},
            "diameter": "1 mm",
            "opening": 0,
        }
        for port in "AB"
    }
    ram = {**CYLINDER, "start_A": "75 bar"}
    block = {"mass": 2000.0, "inertia": [1, 1, 1], "position": [0.95, 0, 0], "velocity": [speed, 0, 0]}
    joint = slide("ground", "block", point=[0.95, 0, 0])
    return circuit({"ram": ram, "tank": tank, **leaks}, bodies={"block": block}, joints={"rail": joint})


def test_a_closed_cylinder_vibrates_at_its_closed_form():
    """ω² = (β_A A_A²/V_A + β_B A_B²/V_B)/m, each chamber with the modulus at its own pressure."""
    area_a, area_b = 0.25 * math.pi * 0.08**2, 0.25 * math.pi * (0.08**2 - 0.04**2)
    volume_a, volume_b = 0.1e-3 + area_a * 0.25, 0.1e-3 + area_b * 0.25
    p_a = 75 * BAR
    p_b = PA + (p_a - PA) * area_a / area_b
    stiffness = density_and_modulus(LAW, p_a)[1] * area_a**2 / volume_a
    stiffness += density_and_modulus(LAW, p_b)[1] * area_b**2 / volume_b
    period = 2 * math.pi / math.sqrt(stiffness / 2000.0)
    result = closed_cylinder(1e-4).simulate(
        integrator="radau", tolerance=1e-10, duration=10.2 * period, output_interval=period / 2000
    )
    v = np.asarray(result.array("velocity"))[:, 0, 0]
    t = np.asarray(result.time)
    k = np.flatnonzero((v[:-1] < 0) & (v[1:] >= 0))
    zeros = t[k] - v[k] * (t[k + 1] - t[k]) / (v[k + 1] - v[k])
    assert np.mean(np.diff(zeros)) == pytest.approx(period, rel=1e-5)


def test_the_frequency_falls_once_a_chamber_cavitates():
    def first_return(speed):
        result = closed_cylinder(speed).simulate(integrator="radau", duration=0.2, output_interval=1e-4)
        v = np.asarray(result.array("velocity"))[1:, 0, 0]
        return int(np.flatnonzero((v[:-1] < 0) & (v[1:] >= 0))[0]), result

    small, calm = first_return(0.01)
    large, wild = first_return(1.5)
    assert large > 1.05 * small
    names = [item.name for item in wild.trust.items]
    assert "cavitation" in names
    assert "cavitation" not in [item.name for item in calm.trust.items]
    assert next(item.fraction for item in wild.trust.items if item.name == "hydraulics") < 1e-5


def test_a_telescope_pushes_with_the_stage_that_moves():
    """A slow telescope under constant pressure: force (p - pa) A of the stage, through both of them."""
    ram = {
        "type": "telescopic-cylinder",
        "stages": ["100 mm", "70 mm"],
        "strokes": ["0.2 m", "0.2 m"],
        "retracted_length": "0.5 m",
        "bodies": ["ground", "block"],
        "points": [[0, 0, 0], [0.6, 0, 0]],
        "start_A": "20 bar",
    }
    feed = {"type": "orifice", "ports": {"A": "high", "B": "ram.A"}, "flow": "60 L/min", "pressure_drop": "10 bar"}
    for place, area in ((0.6, 0.1), (0.85, 0.07)):
        block = {"mass": 1000.0, "inertia": [1, 1, 1], "position": [place, 0, 0]}
        own = {**ram, "points": [[0, 0, 0], [place, 0, 0]]}
        hydraulics = {"high": {"type": "tank", "pressure": "20 bar"}, "ram": own, "feed": feed}
        joint = slide("ground", "block", point=[place, 0, 0])
        result = circuit(hydraulics, bodies={"block": block}, joints={"rail": joint}).simulate(duration=1e-3, step=1e-4)
        force = history(result, "hydraulics.ram.force")[0]
        assert force == pytest.approx((20 * BAR - PA) * 0.25 * math.pi * area**2, rel=1e-9)


def test_a_load_sensing_pump_holds_its_margin_above_the_highest_load():
    valve = {"type": "directional-valve", "ways": "4/3", "flow": "20 L/min", "pressure_drop": "10 bar", "overlap": 0.05}
    hydraulics = {
        "tank": {"type": "tank", "pressure": "2 bar"},
        "high": {"type": "tank", "pressure": "120 bar"},
        "low": {"type": "tank", "pressure": "60 bar"},
        "supply": {"type": "volume", "volume": "1 L"},
        "ls": {"type": "load-sensing", "valves": ["first", "second", "closed"]},
        "pump": {
            "type": "pump",
            "ports": {"A": "tank", "B": "supply", "LS": "ls"},
            "displacement": "60 cm^3/rev",
            "speed": "1500 rpm",
            "margin": "20 bar",
        },
        "first": {**valve, "ports": {"P": "supply", "T": "tank", "A": "low", "B": "tank"}, "command": 0.4},
        "second": {**valve, "ports": {"P": "supply", "T": "tank", "A": "tank", "B": "high"}, "command": -0.3},
        "closed": {**valve, "ports": {"P": "supply", "T": "tank", "A": "high", "B": "low"}, "command": 0},
    }
    hydraulics["second"]["ports"] = {"P": "supply", "T": "low", "A": "tank", "B": "high"}
    result = circuit(hydraulics).simulate(integrator="radau", duration=0.1)
    signal = history(result, "hydraulics.ls.pressure")
    assert signal[0] == pytest.approx(120 * BAR, rel=1e-4)
    assert np.ptp(signal) < 10.0  # the circuit starts at rest
    assert history(result, "hydraulics.supply.pressure")[-1] == pytest.approx(140 * BAR, rel=1e-4)


def test_leakage_alone_moves_a_loaded_cylinder():
    """ṡ = G Δp/A where the leak goes from the loaded chamber into the air; β makes no difference to a creep."""
    ram = {**CYLINDER, "acting": "single", "points": [[0, 0, 0], [0, 0, 0.95]]}
    del ram["dead_volume_B"]
    hydraulics = {
        "tank": {"type": "tank", "pressure": PA},
        "ram": ram,
        "leak": {"type": "orifice", "ports": {"A": "ram.A", "B": "tank"}, "leakage": "1e-12 m^3/(s*Pa)"},
    }
    block = {"mass": 2000.0, "inertia": [1, 1, 1], "position": [0, 0, 0.95]}
    sections = {
        "gravity": [0, 0, -9.81],
        "bodies": {"block": block},
        "joints": {"rail": slide("ground", "block", (0, 0, 1), point=[0, 0, 0.95])},
        "hydraulics": hydraulics,
    }
    result = machine(sections).simulate(integrator="radau", tolerance=1e-8, duration=2.0)
    area = 0.25 * math.pi * 0.08**2
    over = 2000 * 9.81 / area
    fallen = 0.95 - np.asarray(result.array("position"))[-1, 0, 2]
    ratio = density(0.5 * (over + PA) + 0.5 * PA) / density(over + PA)
    assert fallen == pytest.approx(2.0 * 1e-12 * over / area * ratio, rel=1e-2)


def test_a_rotary_actuator_turns_its_joint():
    wheel = {"mass": 10.0, "inertia": [2, 2, 2]}
    hydraulics = {
        "high": {"type": "tank", "pressure": "100 bar"},
        "tank": {"type": "tank", "pressure": "2 bar"},
        "swing": {
            "type": "rotary-actuator",
            "coordinate": "axle.angle",
            "displacement": "200 cm^3/rad",
            "lower": "-90 deg",
            "upper": "90 deg",
            "start_A": "50 bar",
            "start_B": "20 bar",
        },
        "in": {
            "type": "orifice",
            "ports": {"A": "high", "B": "swing.A"},
            "flow": "10 L/min",
            "pressure_drop": "50 bar",
        },
        "out": {
            "type": "orifice",
            "ports": {"A": "swing.B", "B": "tank"},
            "flow": "10 L/min",
            "pressure_drop": "50 bar",
        },
    }
    result = circuit(hydraulics, bodies={"block": wheel}, joints={"axle": hinge("ground", "block")}).simulate(
        integrator="radau", duration=1.0
    )
    assert history(result, "hydraulics.swing.force")[0] == pytest.approx(30 * BAR * 200e-6, rel=1e-9)
    assert history(result, "joint_coordinate")[-1] > 0.5
    assert result.trust.verdict == "green"


def test_the_steady_speed_of_a_cylinder_follows_from_its_valve():
    """p_A = p_P - (A_A v/K o)², p_B = p_T + (A_B v/K o)² and p_A A_A = p_B A_B for gauge pressures, without friction."""
    valve = {
        "type": "directional-valve",
        "ways": "4/3",
        "ports": {"P": "high", "T": "low", "A": "ram.A", "B": "ram.B"},
        "flow": "40 L/min",
        "pressure_drop": "7 bar",
        "command": 0.5,
        "transition": "10 Pa",
    }
    hydraulics = {
        "high": {"type": "tank", "pressure": "100 bar"},
        "low": {"type": "tank", "pressure": PA},
        "ram": {**CYLINDER, "points": [[0, 0, 0], [0.75, 0, 0]], "start_A": "40 bar", "start_B": "50 bar"},
        "valve": valve,
    }
    block = {"mass": 20.0, "inertia": [1, 1, 1], "position": [0.75, 0, 0]}
    joint = slide("ground", "block", point=[0.75, 0, 0])
    result = circuit(hydraulics, bodies={"block": block}, joints={"rail": joint}).simulate(
        integrator="radau", tolerance=1e-9, duration=0.25
    )
    a, b = 0.25 * math.pi * 0.08**2, 0.25 * math.pi * (0.08**2 - 0.04**2)
    opening = (0.5 - 0.01) / 0.99
    k = 40e-3 / 60 / math.sqrt(7 * BAR) * opening

    def unbalanced(v):
        return (100 * BAR - PA - (a * v / k) ** 2) * a - (b * v / k) ** 2 * b

    speed = brentq(unbalanced, 0.0, 2.0)
    found = history(result, "hydraulics.ram.speed")[-1]
    # catalogue flows are those at the mean density on both sides: 0.3 % of compression
    assert found == pytest.approx(speed, rel=5e-3)
