"""Linear equations about states in which something slides: the effort of sliding has a derivative, that of holding has none."""

import numpy as np
import pytest

import nivel
from simulating import G, hinge, machine, slide, solid

J, K = 0.5, 8.0  # [kg m²], [N m/rad]
FAST, CAPACITY, RATIO, STRIBECK = 100.0, 40.0, 1.5, 80.0


def shafts(slip, **more):
    """Two shafts, the second one on a spring, with a clutch between them that slips."""
    clutch = {"type": "clutch", "coordinate": "first", "against": "second", "capacity": CAPACITY, **more}
    spring = {"type": "joint-spring-damper", "coordinate": "second", "stiffness": K, "damping": 0.0}
    return machine(
        {
            "bodies": {name: solid(1.0, J) for name in ("a", "b")},
            "joints": {
                "first": {**hinge("ground", "a"), "start_rates": {"angle": slip}},
                "second": hinge("ground", "b"),
            },
            "forces": {"clutch": clutch, "spring": spring},
        }
    )


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_a_clutch_that_slips_is_a_constant_torque(coordinates):
    found = shafts(FAST).linearise(coordinates=coordinates)
    np.testing.assert_allclose(np.sort(found.eigenvalues.imag)[-1], np.sqrt(K / J), rtol=1e-9)
    assert sum(mode.structural for mode in found.modes) == 2
    assert found.stable


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_the_slope_of_stribecks_curve_is_in_the_equations(way):
    """M = c (1 + (r - 1) exp(-(v/v_s)²)) falls with the slip v = ω₁ - ω₂: J ω̇₁ = -M' v, J ω̇₂ = M' v - k φ₂."""
    found = shafts(way * FAST, static_ratio=RATIO, stribeck_rate=STRIBECK).linearise()
    slope = -2.0 * FAST / STRIBECK**2 * CAPACITY * (RATIO - 1.0) * np.exp(-((FAST / STRIBECK) ** 2))
    A = np.array([[0, 0, 1, 0], [0, 0, 0, 1], [0, 0, -slope / J, slope / J], [0, -K / J, slope / J, -slope / J]])
    assert found.states == ("first.angle", "second.angle", "first.angle.rate", "second.angle.rate")
    np.testing.assert_allclose(found.A, A, atol=1e-9)
    assert not found.steady  # A changes with the slip


def test_a_moment_of_a_run_decides():
    """It slips for FAST/(2 c/J), without the spring's few newton metres: then it holds."""
    until = FAST * J / (2.0 * CAPACITY)
    assert len(shafts(FAST).linearise(about=0.5 * until).modes) > 0
    with pytest.raises(nivel.ModelError, match="a clutch has no derivative where it holds"):
        shafts(FAST).linearise(about=3.0 * until)
    with pytest.raises(nivel.ModelError, match="a clutch has no derivative where it holds"):
        shafts(0.0).linearise()


@pytest.mark.parametrize(("rate", "runs"), [(5.0, True), (0.0, False)])
def test_a_freewheel_that_runs_ahead_does_nothing(rate, runs):
    sections = {
        "bodies": {name: solid(1.0, J) for name in ("a", "b")},
        "joints": {"first": {**hinge("ground", "a"), "start_rates": {"angle": rate}}, "second": hinge("ground", "b")},
        "forces": {
            "wheel": {"type": "freewheel", "coordinate": "first", "against": "second"},
            "spring": {"type": "joint-spring-damper", "coordinate": "first", "stiffness": K, "damping": 0.1},
        },
    }
    if not runs:
        with pytest.raises(nivel.ModelError, match="a freewheel has no derivative where it holds"):
            machine(sections).linearise()
        return
    found = machine(sections).linearise().eigenvalues
    assert np.min(np.abs(found - np.roots([J, 0.1, K])[0])) < 1e-9


def test_a_slide_under_its_own_load_is_slowed_by_a_constant_force():
    """Friction μ N with the weight as load; a damper d beside it: λ = -d/m."""
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {"block": solid(2.0)},
        "joints": {"rail": slide("ground", "block", start_rates={"displacement": 0.0})},
        "forces": {
            "rub": {"type": "friction", "coordinate": "rail", "model": "stiction", "coefficient": 0.3},
            "oil": {"type": "joint-spring-damper", "coordinate": "rail", "stiffness": 0.0, "damping": 5.0},
        },
    }
    with pytest.raises(nivel.ModelError, match="has no derivative where it sticks"):
        machine(sections).linearise()
    sections["joints"]["rail"]["start_rates"] = {"displacement": 1.0}
    model = machine(sections).linearise()
    np.testing.assert_allclose(model.A[-1, -1], -2.5, rtol=1e-9)
