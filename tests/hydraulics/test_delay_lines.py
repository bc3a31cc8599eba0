"""Lines as delays: exact characteristics, the method of steps by SciPy's Radau, Joukowsky's pressure, mass, and what is refused."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from circuits import BAR, PA, circuit, history
from nivel.elements.circuits.line_friction import RATES, WEIGHTS
from nivel.errors import ModelError

RHO, MODULUS, D = 870.0, 1.5e9, 0.02
C, AREA = math.sqrt(MODULUS / RHO), math.pi * D**2 / 4
Z = RHO * C / AREA
STIFF = {"air": 0, "bulk_modulus_slope": 0, "bulk_modulus": "1.5 GPa", "density": RHO}
NU = 46e-6


def delay(a, b, delay, **more):
    """A line of this travel time [s]."""
    like = {"type": "line", "model": "delay", "mean_pressure": PA, "diameter": D, "length": C * delay}
    return {**like, "ports": {"A": a, "B": b}, **more}


def loss(q, length, nu):
    """Hagen–Poiseuille, then Blasius, which meet at Re 1187."""
    critical = (0.3164 / 64) ** (-4 / 3) * nu * AREA / D
    return 128 * nu * length * RHO / (math.pi * D**4) * q * (1 + (q / critical) ** 6) ** 0.125


@pytest.mark.parametrize(("samples", "period"), [(12, 1e-3), (260, 1e-4)])
@pytest.mark.parametrize("nu", [46e-6, 1e-12])
def test_a_line_between_given_pressures_is_that_of_exact_characteristics(samples, period, nu):
    """Flows at both ends within 1e-9 of their range, from a steady flow on; also where more than 200 samples wait."""
    T, length = samples * period, C * samples * period

    def p_a(t):
        return 60 * BAR + 8 * BAR * math.sin(35 * t)

    def p_b(t):
        return 50 * BAR - 5 * BAR * math.sin(61 * t) ** 2

    hydraulics = {
        "a": {"type": "tank", "pressure": "60 bar + 8 bar*sin(35*time)"},
        "b": {"type": "tank", "pressure": "50 bar - 5 bar*sin(61*time)^2"},
        "line": delay("a", "b", T, sample_time=period, unsteady_friction=False),
    }  # fmt: skip
    end = 5 * T
    built = circuit(hydraulics, fluids={"oil": {**STIFF, "viscosity": nu}})
    result = built.simulate(integrator="rk4", step=period, duration=end, output_interval=period)
    found = [history(result, f"hydraulics.line.flow_{side}") for side in "AB"]
    q = steady_flow(10 * BAR, length, nu)
    a = {
        -1: 60 * BAR + Z * q - loss(q, length, nu)
    }  # waves that left A and B, before the start those of the steady flow
    b = {-1: 50 * BAR - Z * q + loss(q, length, nu)}
    wanted = []
    for k in range(round(end / period) + 1):
        t = k * period
        flows = (p_a(t) - b[max(k - samples, -1)]) / Z, (p_b(t) - a[max(k - samples, -1)]) / Z
        a[k], b[k] = (p + Z * q - loss(q, length, nu) for p, q in zip((p_a(t), p_b(t)), flows, strict=True))
        wanted.append(flows)
    wanted = np.array(wanted).T
    assert np.max(np.abs(np.array(found) - wanted)) < 1e-9 * np.ptp(wanted)


def steady_flow(difference, length, nu):
    from scipy.optimize import brentq

    return brentq(lambda q: loss(q, length, nu) - difference, 0, 1.0, xtol=1e-18)


def hammer(unsteady, sample_time, **settings):
    """A tank of 60 bar, a line of 12 ms and 20 mm, a volume of 20 cm³ whose outflow of 0.2 L/s stops within 5 ms."""
    hydraulics = {
        "tank": {"type": "tank", "pressure": "60 bar"}, "drain": {"type": "tank", "pressure": "1 bar"},
        "end": {"type": "volume", "volume": "20 cm^3"},
        "line": delay("tank", "end", 12.3e-3, unsteady_friction=unsteady, sample_time=sample_time),
        "valve": {"type": "flow-source", "ports": {"A": "end", "B": "drain"}, "flow": "2e-4*(1 - step(time, 0.01, 0, 0.015, 1))"},
    }  # fmt: skip
    built = circuit(hydraulics, fluids={"oil": {**STIFF, "viscosity": NU}})
    return built.simulate(duration=0.06, output_interval=1e-3, verify=False, **settings)


@pytest.mark.parametrize("unsteady", [False, True])
def test_water_hammer_follows_the_equations_by_the_method_of_steps(unsteady):
    """Pressure at the valve within 3e-4 of its range: of T = 61.5 samples, between which a wave is a cubic; and the mass of the fluid."""
    result = hammer(unsteady, 2e-4, integrator="radau", tolerance=1e-8)
    found = history(result, "hydraulics.end.pressure")
    T, length = 12.3e-3, C * 12.3e-3
    kappa = 4 * NU / D**2
    terms = [k for k, rate in enumerate(RATES) if rate * kappa * T < 1] if unsteady else []
    U, n, m = 16 * NU * length / (D**2 * AREA), RATES[terms], WEIGHTS[terms]

    def rising(t):
        s = min(max((t - 0.01) / 0.005, 0), 1)
        return s**3 * (10 + s * (6 * s - 15))

    def wave(p, q, z):
        return p + Z * q - loss(q, length, NU) - U * RHO * float(np.sum(z + m * q))

    start = 60 * BAR
    for _ in range(20):
        q0 = 2e-4 * math.exp((start - PA) / MODULUS)  # the line has the density of its mean pressure
        start = 60 * BAR - loss(q0, length, NU)
    z0 = -m * q0
    from_a = [lambda t: wave(60 * BAR, q0, z0)]
    from_b = [lambda t: wave(start, -q0, -z0)]
    y, t = np.array([start, *z0, *-z0]), np.arange(0, 0.06 + 1e-9, 1e-3)
    other = [start]
    count = len(terms)
    edges = np.unique(np.round([*np.arange(0, 0.06, T / 2), 0.01, 0.015, 0.06], 12))
    pieces = []

    def left(which, t):
        """The wave that left an end at t, from what was solved before."""
        for a, b, solved in pieces:
            if a <= t <= b:
                y = solved(t)
                p = 60 * BAR if which == "a" else y[0]
                q = (p - left("b" if which == "a" else "a", t - T)) / Z
                return wave(p, q, y[1 : 1 + count] if which == "a" else y[1 + count :])
        return (from_a if which == "a" else from_b)[0](t)

    def rates(t, y):
        qa, qb = (60 * BAR - left("b", t - T)) / Z, (y[0] - left("a", t - T)) / Z
        out = 2e-4 * (1 - rising(t))
        density = RHO * math.exp((y[0] - PA) / MODULUS)
        grown = MODULUS / 20e-6 / density * (-RHO * qb - density_between(y[0]) * out)
        za, zb = y[1 : 1 + count], y[1 + count :]
        return [grown, *(-n * kappa * (za + m * qa)), *(-n * kappa * (zb + m * qb))]

    def density_between(p):
        return RHO * math.exp((p - PA) / MODULUS)  # a pump takes the density at its inlet

    y[0] = found[0]
    for a, b in pairwise(edges):
        inside = t[(t > a + 1e-9) & (t < b - 1e-9)]
        solved = solve_ivp(rates, (a, b), y, "Radau", np.union1d(inside, b), rtol=1e-8, atol=1e-3, dense_output=True)
        pieces.append((a, b, solved.sol))
        y = solved.y[:, -1]
        keep = len(inside) + (1 if np.any(np.abs(t - b) < 1e-9) else 0)
        other += [*solved.y[0, :keep]]
    error = np.max(np.abs(found - np.array(other))) / np.ptp(other)
    assert error < 3e-4
    assert np.ptp(found) > 5 * BAR
    assert {item.name: item for item in result.trust.items}["fluid mass"].fraction < 1e-8


def test_waves_are_the_same_in_steps_of_a_millisecond():
    """The default method in real time: within 1 % rms of the range."""
    fine = history(hammer(True, 2e-4, integrator="radau", tolerance=1e-8), "hydraulics.end.pressure")
    coarse = history(hammer(True, 1e-3, step=1e-3, integrator="extrapolated-euler"), "hydraulics.end.pressure")
    assert np.sqrt(np.mean((fine - coarse) ** 2)) < 0.01 * np.ptp(fine)


def test_joukowskys_pressure_and_the_period_of_four_lengths():
    result = hammer(False, 1e-3, integrator="radau", tolerance=1e-8)
    p = history(result, "hydraulics.end.pressure")
    t = np.asarray(result.time)
    rise = np.max(p[(t > 0.017) & (t < 0.033)]) - p[0]
    assert rise == pytest.approx(Z * 2e-4 * math.exp((p[0] - PA) / MODULUS), rel=1e-3)


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ({"sample_time": "9 ms"}, "at least two samples"), ({"sample_time": "10 us"}, "up to 1000 are kept"),
        ({"diameter": "2 mm"}, "model: segments"),
    ],
)  # fmt: skip
def test_what_a_delay_cannot_follow_is_refused(more, told):
    hydraulics = {
        "a": {"type": "tank", "pressure": "60 bar"}, "b": {"type": "tank", "pressure": "50 bar"},
        "line": {**delay("a", "b", 12e-3), **more},
    }  # fmt: skip
    with pytest.raises(ModelError, match=told):
        circuit(hydraulics, fluids={"oil": STIFF}).simulate(duration=0.01)
