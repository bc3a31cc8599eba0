"""Gas of accumulators that takes the temperature around it; leaks past pistons; plungers; pneumatic valves."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from circuits import BAR, PA, between, circuit, history, steady
from nivel.elements.circuits.nitrogen import gas_state
from nivel.elements.circuits.volumes import density_at
from nivel.errors import ModelError
from simulating import slide, solid

STIFF = {"oil": {"air": 0, "bulk_modulus": "25 GPa", "bulk_modulus_slope": 0}}
STORE = {
    "type": "accumulator",
    "volume": "10 L",
    "precharge": "80 bar",
    "thermal_time": "4 s",
    "temperature": "300 K",
    "dead_volume": "1 cm^3",
    "flow": "500 L/min",
    "pressure_drop": "1 bar",
}


def filling(**store):
    """2 L go into the gas within 0.05 s, at first at 100 bar, and then it rests."""
    flow = {"of": "time", "times": [0, 0.001, 0.049, 0.05], "values": [0, "-2e-3/0.049", "-2e-3/0.049", 0]}
    hydraulics = {
        "tank": {"type": "tank"},
        "line": {"type": "volume", "volume": "1 cm^3"},
        "source": {"type": "flow-source", "ports": {"A": "line", "B": "tank"}, "flow": flow},
        "store": {**STORE, "ports": {"A": "line"}, "start": "100 bar", **store},
    }
    return circuit(hydraulics, fluids=STIFF)


def assert_gas_cools(result):
    """V = p₀ V₀/100 bar less 2 L; p₁ = 100 bar (V/V₁)^γ, and (T - T₀) falls as exp(-t/τ) at a constant volume."""
    t = np.asarray(result.time)
    volume = 10e-3 * 80 / 100
    warm = 300 * (volume / (volume - 2e-3)) ** 0.4
    expected = 300 + (warm - 300) * np.exp(-(t - 0.025) / 4.0)
    found = history(result, "hydraulics.store.temperature")
    late = t > 0.1
    assert found[late] == pytest.approx(expected[late], abs=0.01 * (warm - 300))
    p = history(result, "hydraulics.store.pressure")
    assert p[-1] == pytest.approx(100 * BAR * volume / (volume - 2e-3) * found[-1] / 300, rel=2e-3)


@pytest.fixture(scope="module")
def filled():
    return filling().simulate(duration=3.0, integrator="radau", tolerance=1e-8, output_interval=0.05)


def test_gas_begins_at_the_temperature_around_it(filled):
    assert history(filled, "hydraulics.store.temperature")[0] == pytest.approx(300.0, rel=1e-6)


def test_gas_is_compressed_without_heat_and_then_cools_exponentially(filled):
    assert_gas_cools(filled)


def test_heat_of_the_gas_stands_in_the_balance_of_energy(filled):
    assert abs(history(filled, "energy_error")[-1]) < 1e-5 * np.max(history(filled, "dissipated_energy"))


def test_steps_of_the_default_method_follow_the_gas():
    assert_gas_cools(filling().simulate(duration=3.0, step=1e-3, output_interval=0.05))


def test_a_piston_leaks_from_one_chamber_to_the_other():
    """Pistons held by a heavy body: the flow past them is G (p_A - p_B)."""
    ram = {
        "type": "cylinder", "bodies": ["ground", "block"], "points": [[0, 0, 0], [0.6, 0, 0]], "piston": "50 mm", "rod": "30 mm",
        "stroke": 0.4, "retracted_length": 0.4, "seal_leakage": 2e-13, "start_A": "120 bar", "start_B": "30 bar",
    }  # fmt: skip
    hydraulics = {
        "tank": {"type": "tank"},
        "leak": {"type": "orifice", "ports": {"A": "ram.B", "B": "tank"}, "leakage": 1e-16},
        "ram": ram,
    }
    axis = {"rail": slide("ground", "block", point=[0.6, 0, 0])}
    built = circuit(hydraulics, bodies={"block": solid(1e9, 2.0, position=[0.6, 0, 0])}, joints=axis)
    result = built.simulate(duration=0.01, step=1e-3, integrator="extrapolated-euler")
    a, b = (history(result, f"hydraulics.ram.pressure_{each}") for each in "AB")
    assert history(result, "hydraulics.ram.seal_flow") == pytest.approx(2e-13 * (a - b), rel=1e-12)
    mass = history(result, "state.ram.mass_A")
    assert mass[-1] < mass[0]


def test_a_plunger_pushes_by_its_own_area():
    ram = {
        "type": "cylinder", "bodies": ["ground", "block"], "points": [[0, 0, 0], [0.6, 0, 0]], "piston": "50 mm",
        "stroke": 0.4, "retracted_length": 0.4, "acting": "plunger", "start_A": "60 bar",
    }  # fmt: skip
    hydraulics = {
        "tank": {"type": "tank"},
        "leak": {"type": "orifice", "ports": {"A": "ram.A", "B": "tank"}, "leakage": 1e-16},
    }
    axis = {"rail": slide("ground", "block", point=[0.6, 0, 0])}
    bodies = {"block": solid(1e3, 2.0, position=[0.6, 0, 0])}
    built = circuit({**hydraulics, "ram": ram}, bodies=bodies, joints=axis)
    result = built.simulate(duration=1e-3, step=1e-3)
    area = 0.25 * math.pi * 0.05**2
    assert history(result, "hydraulics.ram.force")[0] == pytest.approx((60 * BAR - PA) * area, rel=1e-9)
    with pytest.raises(ModelError, match="as thick as"):
        circuit({**hydraulics, "ram": {**ram, "rod": "30 mm"}}, bodies=bodies, joints=axis)


AIR = {"air": {"type": "ideal-gas", "isothermal": True}}


def choked(conductance, p, opening=1.0):
    """Flow at the reference of ISO 8778 [m³/s] of C [m³/(s Pa)] from an absolute pressure, choked, at 20 °C."""
    return conductance * p * opening


@pytest.mark.parametrize(("inlet", "port", "expected"), [
    (7.0, 3.0, (1.0, 0.0)), (1.0, 6.0, (0.0, 1.0)),
])  # fmt: skip
def test_a_quick_exhaust_lets_air_in_and_out_another_way(inlet, port, expected):
    valve = {"type": "quick-exhaust", "sonic_conductance": "4 dm^3/(s*bar)", "critical_ratio": 0.45}
    tanks = between(valve, P=inlet * BAR, A=port * BAR, R=1.0 * BAR)
    built = circuit(tanks, fluids=AIR)
    result = built.simulate(duration=1e-3, step=1e-3, integrator="rk4")
    filling, leaving = (history(result, f"hydraulics.valve.flow_{each}")[-1] for each in ("PA", "AR"))
    assert filling == pytest.approx(expected[0] * choked(4e-8, inlet * BAR), rel=1e-6, abs=1e-12)
    assert leaving == pytest.approx(expected[1] * choked(4e-8, port * BAR), rel=1e-6, abs=1e-12)


@pytest.mark.parametrize(("port", "opening"), [(2.0, 0.05), (4.2, 1.0)])
def test_a_soft_start_opens_at_half_the_pressure(port, opening):
    valve = {"type": "soft-start", "sonic_conductance": "4 dm^3/(s*bar)", "critical_ratio": 0.65, "lag": 0}
    result = circuit(between(valve, P=7 * BAR, A=port * BAR), fluids=AIR).simulate(
        duration=1e-3, step=1e-3, integrator="rk4"
    )
    flow = sum(history(result, f"hydraulics.valve.{each}")[-1] for each in ("flow", "throttled_flow"))
    assert flow == pytest.approx(choked(4e-8, 7 * BAR, opening), rel=1e-6)


def test_the_mean_of_liquids_passes_a_quick_exhaust_too():
    valve = {"type": "quick-exhaust", "flow": "40 L/min", "pressure_drop": "7 bar"}
    filling, leaving = steady(between(valve, P=20 * BAR, A=10 * BAR, R=1 * BAR), "valve.flow_PA", "valve.flow_AR")
    size = 40e-3 / 60 / math.sqrt(7 * BAR)
    assert filling == pytest.approx(size * 10 * BAR * ((10 * BAR) ** 2 + (0.5 * BAR) ** 2) ** -0.25, rel=1e-9)
    assert leaving == 0.0


# p [bar] at T [K] and ρ [kg/m³] of the reference equation of Span, Lemmon, Jacobsen, Wagner and Yokozeki (2000), as NIST and CoolProp 8.0
# compute it
NITROGEN = {
    (273.15, 60): 47.9047,
    (273.15, 120): 95.7433,
    (273.15, 220): 182.0747,
    (273.15, 300): 265.9531,
    (293.15, 60): 51.8910,
    (293.15, 120): 104.6269,
    (293.15, 220): 201.5485,
    (293.15, 300): 296.7200,
    (323.15, 60): 57.8525,
    (323.15, 120): 117.8887,
    (323.15, 220): 230.5715,
    (373.15, 60): 67.7500,
    (373.15, 120): 139.8527,
    (373.15, 220): 278.5035,
}
KILOMOLE = 28.0134  # kg/kmol


@pytest.mark.parametrize(("T", "rho"), NITROGEN)
def test_nitrogen_is_within_one_per_cent_of_the_reference_equation(T, rho):
    p = gas_state.py_func(rho / KILOMOLE, T)[0]
    assert p == pytest.approx(NITROGEN[T, rho] * BAR, rel=0.01)


def test_entropy_energy_and_heat_of_nitrogen_belong_to_its_pressure():
    """∂u/∂ρ = (p - T ∂p/∂T)/ρ², ∂s/∂ρ = -∂p/∂T/ρ², ∂s/∂T = c_v/T, ∂u/∂T = c_v."""
    rho, T, d = 8.0, 310.0, 1e-5
    state = gas_state.py_func
    p, by_density, by_heat, _, heat, _ = state(rho, T)
    with_density = [
        (a - b) / (2 * d * rho) for a, b in zip(state(rho * (1 + d), T), state(rho * (1 - d), T), strict=True)
    ]
    with_heat = [(a - b) / (2 * d * T) for a, b in zip(state(rho, T * (1 + d)), state(rho, T * (1 - d)), strict=True)]
    assert by_density == pytest.approx(with_density[0], rel=1e-8)
    assert by_heat == pytest.approx(with_heat[0], rel=1e-8)
    assert with_density[5] == pytest.approx((p - T * by_heat) / rho**2, rel=1e-6)
    assert with_density[3] == pytest.approx(-by_heat / rho**2, rel=1e-7)
    assert with_heat[3] == pytest.approx(heat / T, rel=1e-7)
    assert with_heat[5] == pytest.approx(heat, rel=1e-7)


@pytest.fixture(scope="module")
def nitrogen():
    return filling(gas="nitrogen").simulate(duration=3.0, integrator="radau", tolerance=1e-8, output_interval=0.05)


def test_nitrogen_is_compressed_and_cools_as_its_equation_says(nitrogen):
    """dT/dt = (T₀ - T)/τ - T ∂p/∂T dv/dt/c_v (Otis and Pourmovahed 1985), by SciPy; 2 L go in within 0.05 s."""
    state = gas_state.py_func
    first = density_at(80 * BAR, 300.0)  # in 10 L
    volume = 10e-3 * first / density_at(100 * BAR, 300.0)

    def flow(t):
        return float(np.interp(t, [0, 0.001, 0.049, 0.05], [0, 2e-3 / 0.049, 2e-3 / 0.049, 0]))

    def rates(t, y):
        rho = 10e-3 * first / y[0]
        _, _, by_heat, _, heat, _ = state(rho, y[1])
        return [-flow(t), (300 - y[1]) / 4.0 + y[1] * by_heat / heat * flow(t) / (10e-3 * first)]

    t = np.asarray(nitrogen.time)
    found = solve_ivp(rates, (0, 3.0), [volume, 300.0], method="Radau", t_eval=t, rtol=1e-9, atol=1e-9, max_step=0.01).y
    assert history(nitrogen, "hydraulics.store.temperature") == pytest.approx(found[1], abs=0.01 * np.ptp(found[1]))
    p = np.array([state(10e-3 * first / v, T)[0] for v, T in found.T])
    assert history(nitrogen, "hydraulics.store.pressure")[2:] == pytest.approx(p[2:], rel=3e-3)
    late = t > 0.1
    falling = np.log(history(nitrogen, "hydraulics.store.temperature")[late] - 300.0)
    assert np.diff(falling) == pytest.approx(-0.05 / 4.0, rel=2e-2)


def test_the_energy_of_nitrogen_is_balanced(nitrogen):
    assert abs(history(nitrogen, "energy_error")[-1]) < 1e-5 * np.max(history(nitrogen, "dissipated_energy"))


def test_default_steps_follow_nitrogen(nitrogen):
    result = filling(gas="nitrogen").simulate(duration=3.0, step=1e-3, output_interval=0.05)
    known = history(nitrogen, "hydraulics.store.temperature")
    assert history(result, "hydraulics.store.temperature") == pytest.approx(known, abs=0.01 * np.ptp(known))


def test_a_piston_between_oil_and_gas_rubs():
    """Slowly filled and emptied, the line is F above and below the gas."""
    flow = {"of": "time", "times": [0, 0.9, 1.1, 2], "values": ["-1 L/min", "-1 L/min", "1 L/min", "1 L/min"]}
    hydraulics = {
        "tank": {"type": "tank"},
        "line": {"type": "volume", "volume": "50 cm^3"},
        "source": {"type": "flow-source", "ports": {"A": "line", "B": "tank"}, "flow": flow},
        "store": {**STORE, "ports": {"A": "line"}, "start": "100 bar", "piston_friction": "2 bar"},
    }
    result = circuit(hydraulics, fluids=STIFF).simulate(duration=2.0, step=1e-3, output_interval=0.1)
    over = history(result, "hydraulics.line.pressure") - history(result, "hydraulics.store.pressure")
    # F, and up to the width within which it is rounded, a tenth of F: the inlet itself takes less than 1 kPa
    assert over[8] == pytest.approx(2.1 * BAR, abs=0.1 * BAR)
    assert over[-1] == pytest.approx(-2.1 * BAR, abs=0.1 * BAR)


@pytest.mark.parametrize(("change", "told"), [
    ({"thermal_time": None}, "thermal_time: 20 s"), ({"gas_exponent": 1.4}, "own equation"), ({"precharge": "500 bar"}, "400 bar"),
])  # fmt: skip
def test_nitrogen_that_does_not_fit_is_refused(change, told):
    with pytest.raises(ModelError, match=told):
        filling(gas="nitrogen", **change)
