"""Temperature of liquids: losses as heat, walls, coolers, reservoirs, and what follows the temperature."""

import math

import numpy as np
import pytest

from circuits import BAR, PA, circuit, history
from hydraulic_zoo import machine_with_warm_oil
from nivel.elements.circuits.fluids import GRADES
from nivel.errors import ModelError

pytestmark = pytest.mark.covering

START, AROUND = 313.15, 293.15
HLP = GRADES["HLP 46"]
DENSITY, CAPACITY = HLP.at(START).density, HLP.at(START).heat_capacity
EXPANSION = HLP.at(START).expansion
WARM = {"oil": {"grade": "HLP 46", "isothermal": False, "air": 0}}
TIGHT = {"integrator": "radau", "tolerance": 1e-10, "verify": False}
OUT = {"type": "orifice", "flow": "300 L/min", "pressure_drop": "0.1 bar"}
PUMP = {"type": "pump", "ports": {"A": "tank", "B": "supply"}, "displacement": "20 cm^3/rev", "speed": "1500 rpm"}


def last(result, name):
    return float(history(result, f"hydraulics.{name}")[-1])


def simple_energy(p, theta):
    """m⁻¹ of c (θ - θ₀) + μ - (p - pa) v of HLP 46 without air, with μ by its own formula."""
    beta, slope = HLP.at(START).bulk_modulus, HLP.at(START).bulk_modulus_slope
    grown = np.exp(EXPANSION * (theta - START)) / DENSITY
    L = 1.0 + slope * (p - PA) / beta
    mu = beta / (slope - 1.0) * (L ** (1.0 - 1.0 / slope) - 1.0) * grown
    return CAPACITY * (theta - START) + mu - (p - PA) * L ** (-1.0 / slope) * grown


def enthalpy(p, theta):
    beta, slope = HLP.at(START).bulk_modulus, HLP.at(START).bulk_modulus_slope
    L = 1.0 + slope * (p - PA) / beta
    grown = np.exp(EXPANSION * (theta - START)) / DENSITY
    return CAPACITY * (theta - START) + beta / (slope - 1.0) * (L ** (1.0 - 1.0 / slope) - 1.0) * grown


def test_a_throttle_heats_oil_by_the_difference_of_pressure_over_density_and_heat_capacity():
    """Pump, throttle, tank: the power of the shaft, D Δp ω, is in ṁ c ΔT behind the throttle: ΔT = Δp/(ρ c)."""
    hydraulics = {
        "tank": {"type": "tank"},
        "supply": {"type": "volume", "volume": "20 cm^3"},
        "back": {"type": "volume", "volume": "20 cm^3"},
        "pump": PUMP,
        "throttle": {
            "type": "orifice",
            "ports": {"A": "supply", "B": "back"},
            "flow": "30 L/min",
            "pressure_drop": "200 bar",
        },
        "out": {**OUT, "ports": {"A": "back", "B": "tank"}},
    }
    result = circuit(hydraulics, fluids=WARM).simulate(duration=2.0, output_interval=0.5, **TIGHT)
    rise = history(result, "state.back.temperature")[-1] - START
    assert rise == pytest.approx((last(result, "supply.pressure") - PA) / (DENSITY * CAPACITY), rel=2e-4)
    omega, back = 1500 * 2 * math.pi / 60, last(result, "back.pressure")
    forward = omega / math.sqrt(
        omega**2 + 1.0
    )  # share of what is taken in that has the density of the tank, as the docs round it
    both = DENSITY, history(result, "state.supply.mass")[-1] / 20e-6
    taken = 0.5 * (both[0] + both[1]) + 0.5 * (both[0] - both[1]) * forward
    work = last(result, "pump.power") / (taken * last(result, "pump.flow"))
    assert enthalpy(back, START + rise) == pytest.approx(work, rel=1e-8)


@pytest.fixture(scope="module")
def loop():
    """A pump that leaks and rubs, a pipe, a cooler, a reservoir and walls; heat and work as states of their own."""
    hydraulics = {
        "tank": {"type": "reservoir", "volume": "4 L", "oil": "3 L", "height": 0.2, "heat_conductance": 20},
        "supply": {"type": "volume", "volume": "0.3 L"},
        "cold": {"type": "volume", "volume": "0.2 L"},
        "pump": {
            **PUMP, "volumetric_efficiency": 0.92, "mechanical_efficiency": 0.88, "nominal_pressure": "200 bar",
            "nominal_speed": "1500 rpm",
        },
        "relief": {
            "type": "relief-valve", "ports": {"P": "supply", "T": "cold"}, "opens_at": "150 bar", "opening_range": "20 bar",
            "flow": "60 L/min", "pressure_drop": "200 bar",
        },
        "pipe": {"type": "pipe", "ports": {"A": "supply", "B": "cold"}, "diameter": "6 mm", "length": 20, "inertia": True},
        "cooler": {
            "type": "cooler", "ports": {"A": "cold", "B": "tank"}, "flow": "100 L/min", "pressure_drop": "2 bar",
            "heat_conductance": 200, "coolant_temperature": 283.15,
        },
    }  # fmt: skip
    states = {
        "work": {"rate": "pump.power"},
        "taken": {"rate": "cooler.heat"},
        "through": {"rate": f"20*(tank.temperature - {AROUND})"},
    }
    return circuit(hydraulics, fluids=WARM, states=states)


@pytest.fixture(scope="module")
def looped(loop):
    return loop.simulate(duration=3.0, output_interval=0.25, **TIGHT)


def test_the_first_law_holds_to_1e_minus_8(looped):
    """Work of the shaft = change of Σ m u + flow energy + heat through walls and cooler, with u of the formulas above."""
    energy = 0.0
    for name in ("tank", "supply", "cold"):
        mass, theta = history(looped, f"state.{name}.mass"), history(looped, f"state.{name}.temperature")
        energy = energy + mass * simple_energy(history(looped, f"hydraulics.{name}.pressure"), theta)
    moving = history(looped, "state.pipe.mass_flow")
    area = 0.25 * math.pi * 6e-3**2
    energy = energy + 0.5 * moving**2 * 20.0 / (area * DENSITY)
    work, taken, through = (history(looped, f"state.{name}") for name in ("work", "taken", "through"))
    assert energy - energy[0] == pytest.approx(work - taken - through, abs=1e-8 * work[-1])
    assert taken[-1] > 0.05 * work[-1]
    assert through[-1] > 0.01 * work[-1]


def test_mechanical_energy_of_warm_oil_is_balanced_too(looped):
    items = {item.name: item for item in looped.trust.items}
    assert items["hydraulics"].fraction < 1e-8
    assert items["energy"].fraction < 1e-8


def test_default_steps_follow_the_heat(loop, looped):
    result = loop.simulate(duration=3.0, step=1e-3, output_interval=0.25)
    for name in ("tank", "supply", "cold"):
        found, known = (history(each, f"hydraulics.{name}.temperature") for each in (result, looped))
        assert found[1:] == pytest.approx(known[1:], abs=2e-3)


def test_oil_in_a_tank_cools_as_an_exponential():
    """m c dT/dt = -H (T - T₀) at the pressure of the air."""
    tank = {"type": "reservoir", "volume": "2 L", "oil": "1 L", "heat_conductance": 20}
    result = circuit({"tank": tank}, fluids=WARM).simulate(duration=100.0, output_interval=10.0, **TIGHT)
    expected = AROUND + (START - AROUND) * np.exp(-20 * np.asarray(result.time) / (DENSITY * 1e-3 * CAPACITY))
    assert history(result, "hydraulics.tank.temperature") == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("flow", [1e-4, 5e-4])
def test_a_cooler_takes_heat_by_its_number_of_transfer_units(flow):
    """(T_out - T_c)/(T_in - T_c) = exp(-H/(ṁ c)), beside what its own loss warms, Δp/(ρ c)."""
    hydraulics = {
        "hot": {"type": "tank", "temperature": 333.15},
        "in": {"type": "volume", "volume": "5 cm^3"},
        "out": {"type": "tank"},
        "behind": {"type": "volume", "volume": "5 cm^3"},
        "source": {"type": "flow-source", "ports": {"A": "hot", "B": "in"}, "flow": flow},
        "cooler": {
            "type": "cooler", "ports": {"A": "in", "B": "behind"}, "flow": "600 L/min", "pressure_drop": "1 mbar",
            "heat_conductance": 400, "coolant_temperature": 283.15,
        },
        "end": {"type": "orifice", "ports": {"A": "behind", "B": "out"}, "flow": "600 L/min", "pressure_drop": "1 mbar"},
    }  # fmt: skip
    result = circuit(hydraulics, fluids=WARM).simulate(duration=2.0, output_interval=1.0, **TIGHT)
    mass_flow = DENSITY * math.exp(-EXPANSION * 20.0) * flow
    expected = 283.15 + 50.0 * math.exp(-400 / (mass_flow * CAPACITY))
    assert last(result, "behind.temperature") == pytest.approx(expected, abs=1e-3)
    assert last(result, "cooler.heat") == pytest.approx(mass_flow * CAPACITY * (333.15 - expected), rel=1e-4)


@pytest.mark.parametrize("fluids", [WARM, {"oil": {"grade": "HLP 46", "air": 0}}])
def test_the_level_of_a_reservoir_is_the_integral_of_flows(fluids):
    hydraulics = {
        "tank": {"type": "reservoir", "volume": "8 L", "oil": "6 L", "height": 0.4},
        "sink": {"type": "tank"},
        "source": {"type": "flow-source", "ports": {"A": "tank", "B": "sink"}, "flow": "1e-3*sin(2*time)"},
    }
    result = circuit(hydraulics, fluids=fluids).simulate(duration=1.5, output_interval=0.25, **TIGHT)
    t = np.asarray(result.time)
    expected = (6e-3 - 0.5e-3 * (1.0 - np.cos(2.0 * t))) / (8e-3 / 0.4)
    assert history(result, "hydraulics.tank.level") == pytest.approx(expected, rel=1e-8)
    assert history(result, "hydraulics.tank.pressure") == pytest.approx(PA, abs=0.01)
    assert history(result, "hydraulics.tank.temperature") == pytest.approx(START, rel=1e-6)


def test_air_that_is_closed_in_follows_its_polytrope():
    hydraulics = {
        "tank": {
            "type": "reservoir",
            "volume": "8 L",
            "oil": "6 L",
            "closed": True,
            "start": "1.5 bar",
            "gas_exponent": 1.2,
        },
        "sink": {"type": "tank"},
        "source": {"type": "flow-source", "ports": {"A": "tank", "B": "sink"}, "flow": 1e-3},
    }
    result = circuit(hydraulics).simulate(duration=1.0, output_interval=0.25, **TIGHT)
    air = 8e-3 - history(result, "hydraulics.tank.oil")
    assert air[0] == pytest.approx(2e-3, rel=1e-8)
    assert air[-1] > 2.9e-3
    assert history(result, "hydraulics.tank.pressure") == pytest.approx(1.5 * BAR * (2e-3 / air) ** 1.2, rel=1e-8)


def test_leaks_follow_the_viscosity_of_the_temperature():
    """Laminar: the flow is that of the constants, at 40 °C, times ν(40 °C)/ν(T)."""
    hydraulics = {
        "hot": {"type": "tank", "pressure": "50 bar", "temperature": 353.15},
        "cold": {"type": "tank", "pressure": "40 bar", "temperature": 353.15},
        "leak": {"type": "orifice", "ports": {"A": "hot", "B": "cold"}, "leakage": 1e-12},
        "pipe": {"type": "pipe", "ports": {"A": "hot", "B": "cold"}, "diameter": "1 mm", "length": 2},
    }
    fluids = {"oil": {**WARM["oil"], "pressure_viscosity": 0}}
    result = circuit(hydraulics, fluids=fluids).simulate(duration=1e-3, step=1e-3, integrator="rk4")
    warmer = 353.15 * (1.0 + EXPANSION / CAPACITY * enthalpy(45 * BAR, 353.15) - EXPANSION * (353.15 - START))
    thinner = HLP.viscosity(START) / HLP.viscosity(warmer)
    assert last(result, "leak.flow") == pytest.approx(1e-12 * 10 * BAR * thinner, rel=1e-4)
    density = DENSITY * math.exp(-EXPANSION * 40.0)
    poiseuille = math.pi * 1e-12 * 10 * BAR / (128 * HLP.viscosity(warmer) * density * 2.0)
    assert last(result, "pipe.flow") == pytest.approx(poiseuille, rel=5e-3)


def test_oil_that_is_locked_in_and_warmed_presses():
    """dp = β α dθ at a constant volume, with β = -V dp/dV = β₀ + β' (p - pa)."""
    hydraulics = {
        "pot": {"type": "volume", "volume": "1 L", "heat_conductance": 20, "start": "10 bar"},
        "tank": {"type": "tank"},
        "seat": {"type": "orifice", "ports": {"A": "pot", "B": "tank"}, "leakage": 1e-30},
    }
    fluids = {"oil": {**WARM["oil"], "surroundings": 323.15}}
    result = circuit(hydraulics, fluids=fluids).simulate(duration=200.0, output_interval=50.0, **TIGHT)
    liquid = HLP.at(START)
    slope, modulus = liquid.bulk_modulus_slope, liquid.bulk_modulus
    warmer = history(result, "state.pot.temperature")[-1] - START
    L = (1.0 + slope * (10 * BAR - PA) / modulus) * math.exp(slope * EXPANSION * warmer)
    assert warmer > 2.0
    assert last(result, "pot.pressure") == pytest.approx(PA + modulus / slope * (L - 1.0), rel=1e-7)


@pytest.mark.parametrize(("fluid", "component", "told"), [
    ({"isothermal": False}, {}, "grade: HLP 46"),
    ({"heat_capacity": 2000}, {}, "isothermal: false"),
    ({}, {"heat_conductance": 3}, "isothermal: false"),
])  # fmt: skip
def test_what_belongs_to_warm_oil_is_refused_elsewhere(fluid, component, told):
    with pytest.raises(ModelError, match=told):
        circuit({"pot": {"type": "volume", "volume": "1 L", **component}}, fluids={"oil": fluid})


@pytest.mark.parametrize("written", ["20 degC", "20 °C", "68 degF"])
def test_a_temperature_in_degrees_gets_the_line_to_write(written):
    with pytest.raises(ModelError, match=r"write `293\.15 K`"):
        circuit(
            {"pot": {"type": "volume", "volume": "1 L"}}, fluids={"oil": {"grade": "HLP 46", "temperature": written}}
        )


def test_a_cooler_of_isothermal_oil_is_refused():
    cooler = {
        "type": "cooler",
        "ports": {"A": "a", "B": "b"},
        "flow": 1e-3,
        "pressure_drop": 1e5,
        "heat_conductance": 10,
    }
    with pytest.raises(ModelError, match="temperature is a state"):
        circuit({"a": {"type": "tank"}, "b": {"type": "tank"}, "cooler": cooler})


def test_a_pump_that_delivers_into_the_reservoir_is_reversed():
    reservoir = {"type": "reservoir", "volume": "8 L", "oil": "6 L"}
    reverse = {**PUMP, "ports": {"A": "supply", "B": "tank"}}
    built = circuit({"tank": reservoir, "supply": {"type": "volume", "volume": "1 L"}, "pump": reverse})
    assert any("the pump is reversed" in str(each) for each in built.remarks)


@pytest.mark.parametrize(("key", "value", "told"), [
    ("oil", "9 L", "above the liquid is air"), ("start", "2 bar", "closed: true"),
])  # fmt: skip
def test_faulty_reservoirs_are_refused(key, value, told):
    with pytest.raises(ModelError, match=told):
        circuit({"tank": {"type": "reservoir", "volume": "8 L", "oil": "6 L", key: value}})


def test_errors_of_pressures_that_the_report_states_at_1_ms_are_the_true_ones_within_a_factor_of_three():
    """Warm oil pushes a block through a hose in two segments: the largest error of all pressures, and the mean of the worst one."""
    built = machine_with_warm_oil()
    settings = {"duration": 0.1, "output_interval": 1e-3}
    exact = built.simulate(integrator="radau", tolerance=1e-9, **settings)
    result = built.simulate(integrator="extrapolated-euler", step=1e-3, verify=True, **settings)
    (line,) = [each for each in result.trust.items if each.name == "quantities" and ": pressures " in each.text]
    off = {
        name: np.abs(history(result, name) - history(exact, name))
        for name in result.variables
        if name.startswith("hydraulics.") and ".pressure" in name
    }
    largest = max(map(np.max, off.values())) / BAR
    assert largest > 5
    stated = float(line.text.partition("within ")[2].split(" bar")[0])
    assert largest / 3 < stated < 3 * largest
    spans = {name: np.ptp(history(exact, name)) for name in off}
    means = {name: np.mean(off[name]) / span for name, span in spans.items() if span > 1e-3 * BAR}
    assert means[line.row] / 3 < line.fraction < 3 * means[line.row]
    assert line.fraction > max(means.values()) / 3
