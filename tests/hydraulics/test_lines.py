"""Long lines: water hammer, friction that depends on the frequency, hoses by their curves."""

import math

import numpy as np
import pytest

from circuits import BAR, PA, circuit, history, steady
from nivel.elements.circuits.line_friction import RATES, WEIGHTS

pytestmark = pytest.mark.covering

STIFF = {"air": 0, "bulk_modulus_slope": 0, "bulk_modulus": "1.5 GPa", "density": 870}
FAST = {"integrator": "radau", "tolerance": 1e-7}


def closing(segments, duration, **line):
    """A line of 20 m and 20 mm from a tank, whose flow of 1 m/s at B is stopped within a tenth of 4 L/c. Returns the run and 4 L/c."""
    c = math.sqrt(1.5e9 / 870)
    period, area = 80 / c, math.pi * 1e-4
    times = np.linspace(0.0, 0.1 * period, 41)
    speed = area * 0.5 * (1 + np.cos(np.pi * times / times[-1]))
    hydraulics = {
        "tank": {"type": "tank", "pressure": "60 bar"},
        "drain": {"type": "tank", "pressure": "1 bar"},
        "end": {"type": "volume", "volume": "1 cm^3"},
        "line": {"type": "line", "ports": {"A": "tank", "B": "end"}, "diameter": "20 mm", "length": 20, "segments": segments, **line},
        "valve": {"type": "flow-source", "ports": {"A": "end", "B": "drain"},
                  "flow": {"of": "time", "times": [0.5, *(0.5 + times[1:])], "values": list(speed), "interpolation": "monotone"}},
    }  # fmt: skip
    fluids = {"oil": {**STIFF, "viscosity": "0.1 mm^2/s"}}
    built = circuit(hydraulics, fluids=fluids)
    return built.simulate(duration=0.5 + duration * period, output_interval=period / 400, **FAST), period


@pytest.fixture(scope="module")
def hammer():
    return closing(40, 2.2, unsteady_friction=False)


def test_water_hammer_rises_by_joukowskys_pressure(hammer):
    """Δp = ρ c v, with the density and the velocity of the flow that is stopped: the mean of the plateau within 0.5 %."""
    result, period = hammer
    t, p = np.asarray(result.time), history(result, "hydraulics.end.pressure")
    before = p[np.searchsorted(t, 0.5) - 1]
    plateau = p[(t > 0.5 + 0.18 * period) & (t < 0.5 + 0.42 * period)]
    rho = 870 * math.exp(60e5 / 1.5e9)
    c = math.sqrt(1.5e9 / rho)
    assert np.mean(plateau) - before == pytest.approx(rho * c * 1.0, rel=5e-3)


def test_water_hammer_has_the_period_of_four_lengths(hammer):
    """From the passage through the pressure of the tank to the same one period later."""
    result, _ = hammer
    t, p = np.asarray(result.time), history(result, "hydraulics.end.pressure") - 60 * BAR
    late = t > 0.5
    rising = np.flatnonzero((p[:-1] < 0) & (p[1:] >= 0) & late[1:])
    at = [t[k] - p[k] * (t[k + 1] - t[k]) / (p[k + 1] - p[k]) for k in rising]
    rho = 870 * math.exp(60e5 / 1.5e9)
    assert at[-1] - at[-2] == pytest.approx(80 / math.sqrt(1.5e9 / rho), rel=5e-3)


def test_the_flow_starts_as_szymanski_says():
    """Laminar start of a flow in a tube under a constant pressure: Q/Q∞ = 1 - 32 Σ exp(-α² ν t/R²)/α⁴, α the zeros of J0."""
    alpha = np.array([2.404826, 5.520078, 8.653728, 11.791534, 14.930918, 18.071064, 21.211637])
    d, length, nu, drop = 0.01, 2.0, 46e-6, 2e4
    hydraulics = {
        "a": {"type": "tank", "pressure": {"of": "time", "times": [0, 1e-9], "values": [10 * BAR, 10 * BAR + drop]}},
        "b": {"type": "tank", "pressure": "10 bar"},
        "line": {
            "type": "line",
            "ports": {"A": "a", "B": "b"},
            "diameter": d,
            "length": length,
            "segments": 1,
            "start": "10 bar",
        },
    }
    fluids = {"oil": {"air": 0, "bulk_modulus": "25 GPa", "viscosity": nu}}
    result = circuit(hydraulics, fluids=fluids).simulate(
        duration=0.8, output_interval=0.02, integrator="radau", tolerance=1e-8
    )
    t, flow = np.asarray(result.time)[2:], history(result, "hydraulics.line.flow_B")[2:]
    settled = math.pi * d**4 * drop / (128 * nu * 870 * length)
    exact = settled * (1 - 32 * np.sum(np.exp(-np.outer(t, alpha**2) * nu * 4 / d**2) / alpha**4, axis=1))
    assert flow == pytest.approx(exact, abs=0.01 * settled)


def test_the_exponentials_are_the_weight_of_zielke():
    """W(τ) = Σ exp(-n τ) with n = 26.3744, 70.8493, … for τ > 0.02, and 0.282095/√τ - 1.25 + 1.057855 √τ + … below."""
    for tau in (0.05, 0.1):
        exact = sum(math.exp(-n * tau) for n in (26.3744, 70.8493, 135.0198, 218.9216, 322.5544))
        assert np.sum(WEIGHTS * np.exp(-RATES * tau)) == pytest.approx(exact, rel=0.03)
    for tau in (1e-4, 1e-3, 1e-2):
        root = math.sqrt(tau)
        series = 0.282095 / root - 1.25 + 1.057855 * root + 0.9375 * tau + 0.396696 * tau * root - 0.351563 * tau * tau
        assert np.sum(WEIGHTS * np.exp(-RATES * tau)) == pytest.approx(series, rel=0.03)


def test_bends_and_the_steady_loss_add_up():
    """A line between two tanks, steady: Δp = 128 μ L Q/(π d⁴) + ζ ρ v²/2."""
    line = {"type": "line", "diameter": "20 mm", "length": 4, "segments": 3, "bends": 5.0, "start": "10 bar"}
    tanks = {"at_A": {"type": "tank", "pressure": 10.3 * BAR}, "at_B": {"type": "tank", "pressure": 9.7 * BAR}}
    hydraulics = {**tanks, "valve": {**line, "ports": {"A": "at_A", "B": "at_B"}}}
    a, b = steady(hydraulics, "valve.flow_A", "valve.flow_B", duration=3.0, step=1e-3, integrator="extrapolated-euler")
    assert a == pytest.approx(b, rel=1e-3)
    rho, area, flow = 866.0, math.pi * 1e-4, b
    speed = flow / area
    reynolds = speed * 0.02 / 46e-6
    drop = (
        64 / reynolds * (1 + (reynolds / 1187.4) ** 6) ** 0.125 * 4 / 0.02 * 0.5 * rho * speed**2 + 2.5 * rho * speed**2
    )
    assert drop == pytest.approx(0.6 * BAR, rel=0.01)


def test_the_trust_report_takes_no_mass_flow_of_a_line_for_a_mass():
    """A valve behind a line closes: the fluid that tanks gave is that in the volumes, and the mass flows [kg/s] are none of it."""
    closes = {"of": "time", "times": [0, 0.01, 0.02], "values": [1, 1, 0]}
    hydraulics = {
        "tank": {"type": "tank", "pressure": "60 bar"},
        "drain": {"type": "tank", "pressure": "1 bar"},
        "end": {"type": "volume", "volume": "20 cm^3"},
        "line": {"type": "line", "ports": {"A": "tank", "B": "end"}, "diameter": "20 mm", "length": 10, "segments": 4},
        "valve": {"type": "orifice", "ports": {"A": "end", "B": "drain"}, "diameter": "3 mm", "opening": closes},
    }
    result = circuit(hydraulics).simulate(duration=0.03, step=1e-4, verify=False)
    assert np.ptp(history(result, "state.line.mass_flow_1")) > 0.1
    assert next(item for item in result.trust.items if item.name.startswith("fluid")).verdict == "green"


def test_mass_is_kept_to_round_off():
    result, _ = closing(4, 0.5)
    gained = sum(history(result, f"state.line.mass_{k}") for k in range(1, 5)) + history(result, "state.end.mass")
    taken = history(result, "state.hydraulics.taken_in")
    assert gained - gained[0] == pytest.approx(taken - taken[0], abs=1e-10)
    assert abs(history(result, "energy_error")[-1]) < 1e-4 * max(1.0, abs(history(result, "dissipated_energy")[-1]))


@pytest.mark.parametrize(("p", "grown"), [(50.0, 5.0), (100.0, 10.0), (150.0, 12.0), (250.0, 16.0)])
def test_a_hose_grows_along_its_curve(p, grown):
    """The mass at a pressure above the air is that of the density times the volume of the curve."""
    from nivel.elements.circuits.curves import VolumeExpansion, hose_points
    from nivel.elements.circuits.volumes import filled_room, hose_room

    curve = VolumeExpansion(pressures=("100 bar", "200 bar"), volumes=("10 cm^3", "14 cm^3"))
    law = getattr(hose_room, "py_func", hose_room)
    row = filled_room((1e-3, 0.0, 0.0, 1.0, 1.0, *hose_points(curve, 1.0)))
    volume, slope, stored = law(row, PA + p * BAR)
    assert volume == pytest.approx(grown * 1e-6, rel=1e-12)
    points = np.linspace(0.0, p * BAR, 20001)
    room = np.array([law(row, PA + each)[0] for each in points])
    assert stored == pytest.approx(np.trapezoid(points, room), rel=1e-6)
    assert slope == pytest.approx((law(row, PA + p * BAR)[0] - law(row, PA + p * BAR - 1.0)[0]), rel=1e-6)
