"""Fluids by name, without air, with dissolved air and vapour."""

import math
import re

import numpy as np
import pytest

from circuits import BAR, PA, circuit, history
from nivel.elements.circuits.density import fluid_constants, specific_volume
from nivel.elements.circuits.fluids import GRADES, Fluid, GradeName
from nivel.errors import ModelError

LAW = getattr(specific_volume, "py_func", specific_volume)


def volume(p, **words):
    """(v, v', ρ₀ h) of a fluid at p."""
    return LAW(fluid_constants(Fluid(name="oil", **words)), p)


def test_every_name_has_a_grade():
    assert set(GRADES) == set(GradeName.__args__)


@pytest.mark.parametrize("name", GRADES)
def test_a_grade_has_the_viscosity_of_its_class_and_of_astm_d341(name):
    grade = GRADES[name]
    assert 1e6 * grade.viscosity(313.15) == pytest.approx(float(name.split()[1]), rel=1e-12)
    assert 1e6 * grade.viscosity(373.15) == pytest.approx(grade.at_100, rel=1e-12)
    double = [math.log10(math.log10(1e6 * grade.viscosity(10**x) + 0.7)) for x in (2.45, 2.50, 2.55)]
    assert double[0] - 2 * double[1] + double[2] == pytest.approx(0.0, abs=1e-12)  # straight over lg T


def test_a_mineral_oil_has_haywards_bulk_modulus_and_falls_in_density():
    """HLP 46: ν at 20 °C by ASTM D341, K_s = (1.57 + 0.15 lg ν) 10^(0.0024 (20 - t)) GPa, ρ = 879 (1 - 7e-4 (t - 15))."""
    oil = Fluid(name="oil", grade="HLP 46", temperature=333.15)
    a, b = (math.log10(math.log10(nu + 0.7)) for nu in (46.0, 6.8))
    slope = (a - b) / math.log10(373.15 / 313.15)
    cold = 10**10 ** (a - slope * math.log10(293.15 / 313.15)) - 0.7
    assert oil.liquid.bulk_modulus == pytest.approx(1e9 * (1.57 + 0.15 * math.log10(cold)) * 10 ** (-0.096), rel=1e-12)
    assert oil.liquid.density == pytest.approx(879 * (1 - 7e-4 * 45), rel=1e-12)
    assert Fluid(name="oil", grade="HLP 46", density=860.0).liquid.density == 860.0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            {"grade": "HLP 46", "temperature": 20.0},
            "from 223.15 to 423.15 K was expected, got 20 K; 20 °C are 293.15 K",
        ),
        ({"temperature": 293.15}, "`temperature` belongs to a `grade`"),
    ],
)
def test_a_temperature_without_effect_or_sense_is_refused(words, said):
    with pytest.raises(ModelError, match=re.escape(said)):
        Fluid(name="oil", **words)


def test_without_air_the_bulk_modulus_is_constant():
    for p in (2e5, 1e7, 4e7):
        v, slope, _ = volume(p, air=0.0, bulk_modulus=1.4e9, bulk_modulus_slope=0.0)
        assert v == pytest.approx(math.exp(-(p - PA) / 1.4e9), rel=1e-12)
        assert -v / slope == pytest.approx(1.4e9, rel=1e-12)


@pytest.mark.parametrize("words", [
    {"air": 0.0, "vapour_pressure": 2e3},
    {"air": 0.002, "dissolved_air": 0.09},
    {"air": 0.0, "dissolved_air": 0.09, "saturation_pressure": 3e5, "gas_exponent": 1.0},
])  # fmt: skip
@pytest.mark.parametrize("p", [1.9e3, 5e3, 6e4, 2e5, 2e7])
def test_bulk_modulus_and_energy_follow_from_the_law_of_density(words, p):
    h = 1e-4 * p
    values = [volume(p + k * h, **words) for k in (-1, 0, 1)]
    assert (values[2][0] - values[0][0]) / (2 * h) == pytest.approx(values[1][1], rel=1e-5)
    assert (values[2][2] - values[0][2]) / (2 * h) == pytest.approx(values[1][0], rel=1e-5)


def test_dissolved_air_comes_out_as_henry_says():
    """At half the saturation pressure half of it is free, and fills twice its volume at that pressure."""
    dry, wet = (volume(0.5 * PA, air=0.0, dissolved_air=share, gas_exponent=1.0)[0] for share in (0.0, 0.08))
    assert wet - dry == pytest.approx(0.08 * 0.5 * 2.0, rel=1e-9)
    dry, wet = (volume(2 * PA, air=0.0, dissolved_air=share)[0] for share in (0.0, 0.08))
    assert wet == dry


def test_a_volume_that_is_emptied_boils_at_the_vapour_pressure():
    fluids = {"oil": {"air": 0, "vapour_pressure": "30 mbar"}}
    hydraulics = {
        "tank": {"type": "tank"},
        "line": {"type": "volume", "volume": "1 L", "start": "5 bar"},
        "pump": {"type": "flow-source", "ports": {"A": "line", "B": "tank"}, "flow": "1 L/min"},
    }
    result = circuit(hydraulics, fluids=fluids).simulate(duration=1.0, step=1e-3, integrator="extrapolated-euler")
    p = history(result, "hydraulics.line.pressure")
    assert 0.6 * 3e3 < p[-1] < 1.3 * 3e3
    mass = history(result, "state.line.mass")
    taken = 1e-3 / 60 * np.trapezoid(_density(p), result.time)
    assert mass[0] - mass[-1] == pytest.approx(taken, rel=1e-3)


def _density(p):
    constants = fluid_constants(Fluid(name="oil", air=0.0, vapour_pressure=3e3))
    return np.array([constants[4] / LAW(constants, each)[0] for each in p])


def test_a_leak_over_a_grade_follows_its_density():
    """An orifice by its diameter: the flow is that of the density of the grade at its temperature."""
    hydraulics = {
        "a": {"type": "tank", "pressure": 101 * BAR},
        "b": {"type": "tank", "pressure": 1 * BAR},
        "valve": {"type": "orifice", "ports": {"A": "a", "B": "b"}, "diameter": "3 mm"},
    }
    result = circuit(hydraulics, fluids={"oil": {"grade": "HFC 46", "temperature": "323.15 K", "air": 0}})
    flow = history(result.simulate(duration=1e-3, step=1e-3, integrator="rk4"), "hydraulics.valve.flow")[-1]
    density = 1085 * (1 - 6e-4 * 35)
    assert flow == pytest.approx(0.65 * 0.25 * math.pi * 0.003**2 * math.sqrt(2 * 100 * BAR / density), rel=1e-5)
