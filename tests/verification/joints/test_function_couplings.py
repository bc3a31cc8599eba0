"""Couplings by any function of joint coordinates, against the reduced equations of the same machines."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from simulating import G, hinge, machine, simulate, slide, solid, wheel

COS_30, ELLIPSE = np.cos(np.pi / 6), 1.4 / 0.6
M1, M3, ARM, J = 1.0, 3.0, 0.2, 0.05


def knee(value, start=0.6):
    """A leg on a slider that follows the angle of the leg."""
    return {
        "gravity": [0, 0, -G],
        "bodies": {"slider": solid(M1, 0.01), "leg": {**solid(M3, J), "centre_of_mass": [0, 0, -ARM]}},
        "joints": {
            "s": slide("ground", "slider", (1, 0, 0)),
            "k": {"type": "revolute", "bodies": ["slider", "leg"], "point": [0, 0, 0], "axis": [0, 1, 0]}
            | {"start": {"angle": start}},
        },
        "couplings": {"knee": {"type": "function", "coordinate": "s.displacement", "value": value}},
    }


def angle_of_knee(times, f1, f2, start=0.6):
    """The angle where f1 and f2 are the slopes of the slider's way, by Lagrange's equation of one freedom: M q̈ + M' q̇²/2 = -m g l sin q."""

    def rates(_, state):
        q, speed = state
        a, da = f1(q) - ARM * np.cos(q), f2(q) + ARM * np.sin(q)
        b, db = ARM * np.sin(q), ARM * np.cos(q)
        mass = M1 * f1(q) ** 2 + M3 * (a * a + b * b) + J
        slope = 2.0 * (M1 * f1(q) * f2(q) + M3 * (a * da + b * db))
        return speed, (-M3 * G * ARM * np.sin(q) - 0.5 * slope * speed**2) / mass

    found = solve_ivp(rates, (0.0, times[-1]), (start, 0.0), "DOP853", times, rtol=1e-12, atol=1e-13)
    return found.y[0]


@pytest.mark.parametrize(
    ("methods", "error"),
    [
        ({"coordinates": "relative"}, 1e-9),
        ({"coordinates": "absolute"}, 1e-9),
        ({"coordinates": "absolute", "formulation": "lagrange"}, 1e-9),
        ({"integrator": "radau"}, 1e-7),
        ({"integrator": "generalised-alpha"}, 3e-5),
    ],
)
def test_a_knee_that_slides_as_it_bends(methods, error):
    """s = 0.02 q + 0.03 q², by methods with and without tangents."""
    r = simulate(knee("0.02*k.angle + 0.03*k.angle**2"), duration=1.0, step=1e-3, **methods)
    q = r.array("k.angle")
    expected = angle_of_knee(r.time, lambda q: 0.02 + 0.06 * q, lambda q: 0.06)
    np.testing.assert_allclose(q, expected, atol=error)
    np.testing.assert_allclose(r.array("s.displacement"), 0.02 * q + 0.03 * q**2, atol=1e-12)
    rate = (0.02 + 0.06 * q) * r.array("k.angle.rate")
    np.testing.assert_allclose(r.array("s.displacement.rate"), rate, atol=1e-10)
    if error < 1e-6:
        assert np.abs(r.array("energy_error")).max() < 1e-6


def test_it_is_green():
    sections = knee("0.02*k.angle + 0.03*k.angle**2") | {"simulation": {"duration": 0.5}}
    assert machine(sections).simulate(verify=True).trust.verdict == "green"


@pytest.mark.parametrize("start", [0.6, 2.0])
def test_a_cubic_table_goes_on_straight_beyond_its_ends(start):
    """The natural spline of the points, straight outside; the leg that starts at 2 rad swings through both ends."""
    points, values = [-1.0, -0.3, 0.4, 1.2], [0.01, 0.03, 0.0, 0.05]
    spline = CubicSpline(points, values, bc_type="natural")

    def slope(q):
        return spline(np.clip(q, points[0], points[-1]), 1)

    def bend(q):
        return spline(q, 2) if points[0] < q < points[-1] else 0.0

    table = {"of": "k.angle", "points": points, "values": values, "interpolation": "cubic"}
    r = simulate(knee(table, start), duration=1.0, step=1e-3)
    expected = angle_of_knee(r.time, slope, bend, start)
    assert start < 1.2 or expected.min() < points[0]
    # where a piece of the spline ends the third derivative jumps, which costs a method of order four one order
    np.testing.assert_allclose(r.array("k.angle"), expected, atol=2e-6)


def test_a_coordinate_that_follows_two_others():
    """z = 0.1 cos(b) a + a², from both second derivatives and the mixed one: (D + m ∇f ∇fᵀ) q̈ = -m ∇f (q̇ᵀ H q̇ + g)."""
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {"cart": solid(2.0, 0.1), "wheel": wheel(J), "lift": solid(0.5, 0.1)},
        "joints": {
            "a": slide("ground", "cart", (1, 0, 0))
            | {"start": {"displacement": 0.3}, "start_rates": {"displacement": 1}},
            "b": hinge("ground", "wheel") | {"start_rates": {"angle": 5}},
            "c": slide("ground", "lift", (0, 0, 1)),
        },
        "couplings": {
            "cam": {
                "type": "function",
                "coordinate": "c.displacement",
                "value": "0.1*cos(b.angle)*a.displacement + a.displacement**2",
            }
        },
    }
    r = simulate(sections, duration=1.0, step=1e-3)

    def rates(_, state):
        a, b, *speed = state
        slope = np.array([0.1 * np.cos(b) + 2 * a, -0.1 * np.sin(b) * a])
        bend = np.array([[2.0, -0.1 * np.sin(b)], [-0.1 * np.sin(b), -0.1 * np.cos(b) * a]])
        mass = np.diag([2.0, J]) + 0.5 * np.outer(slope, slope)
        return *speed, *np.linalg.solve(mass, -0.5 * slope * (np.array(speed) @ bend @ speed + G))

    found = solve_ivp(rates, (0.0, 1.0), (0.3, 0.0, 1.0, 5.0), "DOP853", r.time, rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(r.array("a.displacement"), found.y[0], atol=1e-8)
    np.testing.assert_allclose(r.array("b.angle"), found.y[1], atol=1e-7)


def test_the_frequency_at_rest():
    """At q = 0 with s = q²/2 the slider is at rest, and its weight hangs on the leg alone: ω² = m g l/(J + m l²)."""
    model = machine(knee("0.5*k.angle**2", 0.0)).linearise()
    omega = np.sqrt(M3 * G * ARM / (J + M3 * ARM**2))
    np.testing.assert_allclose(sorted(model.eigenvalues.imag), [-omega, omega], rtol=1e-9)


def test_a_weight_on_a_curve_swings_by_its_bend():
    """A weight on a vertical rail that follows z = c a²/2 of a cart: the cart swings with ω² = m g c/M, from the bend alone."""
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {"cart": solid(2.0, 0.1), "lift": solid(0.5, 0.1)},
        "joints": {"a": slide("ground", "cart", (1, 0, 0)), "c": slide("ground", "lift", (0, 0, 1))},
        "couplings": {"cam": {"type": "function", "coordinate": "c", "value": "2*a.displacement**2"}},
    }
    for coordinates in ("relative", "absolute"):
        model = machine(sections).linearise(coordinates=coordinates)
        omega = np.sqrt(0.5 * G * 4.0 / 2.0)
        np.testing.assert_allclose(sorted(model.eigenvalues.imag), [-omega, omega], rtol=1e-9)


def test_from_start_the_difference_as_placed_is_kept():
    sections = knee("0.25 + 0.1*k.angle", 0.5)
    sections["couplings"]["knee"]["from_start"] = True
    r = simulate(sections, duration=0.01, step=1e-3)
    np.testing.assert_allclose(r.array("s.displacement"), 0.1 * r.array("k.angle"), atol=1e-12)


@pytest.mark.parametrize(
    "methods",
    [{"coordinates": "relative"}, {"coordinates": "absolute"}, {"integrator": "radau"}],
    ids=lambda m: next(iter(m.values())),
)
@pytest.mark.parametrize(
    ("value", "slope"),
    [
        # the angle behind a universal joint at 30°; a pair of elliptic gears of eccentricity 0.4
        (
            "atan2(cos(30 deg)*sin(a.angle), cos(a.angle))",
            lambda a: COS_30 / (np.cos(a) ** 2 + (COS_30 * np.sin(a)) ** 2),
        ),
        (
            "-2*atan(1.4/0.6*tan(a.angle/2))",
            lambda a: -ELLIPSE / (np.cos(a / 2) ** 2 + (ELLIPSE * np.sin(a / 2)) ** 2),
        ),
    ],
    ids=["universal", "elliptic"],
)
def test_inverse_tangents_go_on_over_turns(methods, value, slope):
    """ω (J₁ + J₂ b'²)^½ is constant, and b grows by b' ω. Where the inverse tangent came back, energy was lost, or the run stopped."""
    sections = {
        "gravity": [0, 0, 0],
        "bodies": {"one": wheel(0.02), "two": wheel(0.05)},
        "joints": {"a": hinge("ground", "one", start_rates={"angle": 6}), "b": hinge("ground", "two")},
        "couplings": {"pair": {"type": "function", "coordinate": "b", "value": value}},
    }
    r = simulate(sections, duration=3, step=1e-3, output_interval=5e-3, tolerance=1e-9, **methods)
    a, w = r.array("a.angle"), r.array("a.angle.rate")
    assert a[-1] > 4.0 * np.pi
    np.testing.assert_allclose(r.array("b.angle.rate"), slope(a) * w, rtol=1e-8)
    np.testing.assert_allclose((0.02 + 0.05 * slope(a) ** 2) * w**2, (0.02 + 0.05 * slope(0.0) ** 2) * 36.0, rtol=1e-6)
    assert np.abs(np.diff(r.array("b.angle"))).max() < 0.2


def test_an_inverse_tangent_that_turns_on_is_green():
    """Where it comes back by a turn, steps missed 0.03 of a value that the coupling does not have."""
    sections = {
        "bodies": {"one": wheel(0.02), "two": wheel(0.05)},
        "joints": {"a": hinge("ground", "one", start_rates={"angle": 6}), "b": hinge("ground", "two")},
        "couplings": {"pair": {"type": "function", "coordinate": "b", "value": "-2*atan(1.4/0.6*tan(a.angle/2))"}},
    }
    trust = machine(sections).simulate(duration=2, verify=True).trust
    assert trust.verdict == "green", str(trust)
