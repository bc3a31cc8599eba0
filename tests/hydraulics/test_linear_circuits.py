"""Linear equations of circuits: hydraulic springs, valves with cylinders, digital servos, against closed forms and other equations."""

import math
from functools import cache

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.signal import cont2discrete

from circuits import BAR, circuit
from simulating import machine, slide

MASS, BORE, STROKE, SUPPLY, BETA, RHO = 400.0, 0.05, 0.6, 100 * BAR, 1.2e9, 860.0
AREA = 0.25 * math.pi * BORE**2
DEAD = 0.1e-3
HALF = 0.5 * STROKE * AREA + DEAD  # volume of each chamber in the middle [m³]
LEAK = 2e-12  # [m³/s/Pa]
FLOW, DROP, UNDERLAP, ROUNDING = 40e-3 / 60.0, 35 * BAR, 0.05, 0.02
PERIOD = 4e-3
PA = 101325.0
# by 1 + β' (p - pa)/β₀ as β' → 0: bulk modulus β everywhere
OIL = {
    "oil": {"density": RHO, "bulk_modulus": BETA, "bulk_modulus_slope": 1.0 + 1e-9, "air": 0, "vapour_pressure": 1e3}
}


def rail_with(hydraulics, pressure=SUPPLY / 2, **more):
    """A block on a rail, at the middle of the stroke of a cylinder whose areas are equal."""
    ram = {
        "type": "cylinder", "piston": BORE, "stroke": STROKE, "retracted_length": "0.5 m", "dead_volume_A": DEAD,
        "dead_volume_B": DEAD, "bodies": ["ground", "block"], "points": [[0, 0, 0], [0.8, 0, 0]], "start_A": pressure,
        "start_B": pressure, "seal_leakage": LEAK,
    }  # fmt: skip
    block = {"mass": MASS, "inertia": [1, 1, 1], "position": [0.8, 0, 0]}
    joint = slide("ground", "block", point=[0.8, 0, 0])
    circuits = {"ram": ram, **hydraulics}
    return circuit(circuits, fluids=OIL, bodies={"block": block}, joints={"rail": joint}, **more)


def valve(command):
    """A valve with underlap between a supply and a tank."""
    return {
        "supply": {"type": "tank", "pressure": SUPPLY},
        "tank": {"type": "tank", "pressure": 1.0 * BAR},
        "valve": {
            "type": "directional-valve", "ways": "4/3", "ports": {"P": "supply", "T": "tank", "A": "ram.A", "B": "ram.B"},
            "flow": FLOW, "pressure_drop": DROP, "overlap": -UNDERLAP, "rounding": ROUNDING, "transition": 10.0, "command": command,
        },
    }  # fmt: skip


def bulk_modulus(p):
    """-ρ dp/dρ⁻¹ of the liquid at a pressure."""
    return BETA + (1.0 + 1e-9) * (p - PA)


def test_a_symmetric_cylinder_has_the_hydraulic_natural_frequency_damped_by_its_leakage():
    """λ² + (2 β G/V) λ + 2 β A²/(V m) = 0 with V of a chamber, G the leakage: ω² = 4 β A²/(V_t m)."""
    model = rail_with({}).linearise()
    beta = bulk_modulus(SUPPLY / 2)
    wanted = np.roots([1.0, 2.0 * beta * LEAK / HALF, 2.0 * beta * AREA**2 / (HALF * MASS)])
    assert abs(wanted[0]) == pytest.approx(math.sqrt(4.0 * beta * AREA**2 / (2.0 * HALF * MASS)))
    mode = next(each for each in model.modes if each.eigenvalue.imag)
    assert mode.eigenvalue == pytest.approx(max(wanted, key=lambda z: z.imag), rel=1e-9)
    names = dict(mode.participation)
    # half of a vibration is motion; the spring is that of both chambers
    assert names["hydraulics.ram.pressure_A"] == pytest.approx(names["hydraulics.ram.pressure_B"], rel=1e-6)
    assert names["hydraulics.ram.pressure_A"] == pytest.approx(0.25, rel=0.05)
    assert model.stable


def opening(u):
    """x(u) of an edge with underlap."""
    z = u + UNDERLAP
    return (z - 0.5 * ROUNDING) / (1.0 + UNDERLAP - 0.5 * ROUNDING)


def density(p):
    """ρ(p) of the liquid."""
    slope = 1.0 + 1e-9
    return RHO * (1.0 + slope * (p - PA) / BETA) ** (1.0 / slope)


def rates(state, u):
    """ẋ of (place from the middle, speed, p_A, p_B): the same equations, complex."""
    s, v, a, b = state
    low = 1.0 * BAR

    def edge(x, high, lower):
        drop = high - lower
        return FLOW / math.sqrt(DROP) * x * np.sqrt(drop) * 0.5 * (density(high) + density(lower))

    leak = LEAK * (a - b) * 0.5 * (density(a) + density(b))
    into_a = edge(opening(u), SUPPLY, a) - edge(opening(-u), a, low) - leak
    into_b = edge(opening(-u), SUPPLY, b) - edge(opening(u), b, low) + leak
    rate_a = bulk_modulus(a) / (HALF + AREA * s) * (into_a / density(a) - AREA * v)
    rate_b = bulk_modulus(b) / (HALF - AREA * s) * (into_b / density(b) + AREA * v)
    return np.array([v, AREA * (a - b) / MASS, rate_a, rate_b])


@cache
def reference():
    """(A, B) of these equations where they rest, by complex steps."""
    p = _resting_pressure()
    state = np.array([0.0, 0.0, p, p], dtype=complex)
    A = np.zeros((4, 4))
    for k in range(4):
        moved = state.copy()
        moved[k] += 1e-30j
        A[:, k] = rates(moved, 0.0 + 0.0j).imag / 1e-30
    return A, rates(state, 1e-30j).imag[:, None] / 1e-30


def _resting_pressure():
    """At which as much comes in from the supply as leaves to the tank."""
    from scipy.optimize import brentq

    return brentq(lambda p: float(np.real(rates(np.array([0.0, 0.0, p, p]), 0.0)[2])), 20 * BAR, 80 * BAR, xtol=1e-9)


@cache
def driven(command="0"):
    """The linear model of valve and cylinder."""
    outputs = ["rail.displacement", "rail.displacement.rate", "ram.pressure_A", "valve.flow_PA"]
    return rail_with(valve(command), _resting_pressure()).linearise(outputs=outputs)


def test_valve_and_cylinder_have_the_matrices_of_their_own_equations():
    model, (A, B) = driven(), reference()
    wanted = ("rail.displacement", "rail.displacement.rate", "hydraulics.ram.pressure_A", "hydraulics.ram.pressure_B")
    place = [model.states.index(name) for name in wanted]
    size = np.array([0.1, 1.0, 1e5, 1e5])
    found = model.A[np.ix_(place, place)] * size / size[:, None]
    scaled = A * size / size[:, None]
    np.testing.assert_allclose(found, scaled, rtol=0, atol=2e-8 * np.abs(scaled).max())
    assert model.inputs == ("valve.command",)
    np.testing.assert_allclose(model.B[place], B, rtol=1e-7, atol=1e-7 * abs(B).max())


def test_the_speed_follows_the_spool_as_the_transfer_function_of_the_books():
    """v/u = (A/m) (4 β K √Δp x'/V)/(s² + (β/V) (K x₀/√Δp + 2 G) s + 2 β A²/(V m)), Merritt 1967, without compression in the edges."""
    drop = (SUPPLY - 1.0 * BAR) / 2
    K, beta = FLOW / math.sqrt(DROP), bulk_modulus(SUPPLY / 2)
    slope = 1.0 / (1.0 + UNDERLAP - 0.5 * ROUNDING)
    gain = 4.0 * beta * K * math.sqrt(drop) * slope / HALF * AREA / MASS
    damping = beta / HALF * (K * opening(0.0) / math.sqrt(drop) + 2.0 * LEAK)
    f = np.array([0.1, 3.0, 10.0, 30.0])
    s = 2j * np.pi * f
    wanted = gain / (s * s + damping * s + 2.0 * beta * AREA**2 / (HALF * MASS))
    found = driven().frequency_response(f).to_numpy()
    np.testing.assert_allclose(found[:, 1, 0], wanted, rtol=1e-2)
    # force balance: the pressures follow from the speed, m s v = A (p_A - p_B), p_A = -p_B in the changes
    np.testing.assert_allclose(found[:, 2, 0], 0.5 * MASS * s * found[:, 1, 0] / AREA, rtol=1e-2)


def servo(gain):
    """A digital position servo."""
    law = {"servo": {"type": "gain", "input": "0.02 - rail.displacement", "gain": gain, "sample_time": PERIOD}}
    return rail_with(valve("servo - 0"), control=law)


@cache
def discrete():
    """(Φ, Γ) of the equations of their own over a period with a constant command."""
    A, B = reference()
    found = cont2discrete((A, B, np.array([[1.0, 0, 0, 0]]), np.zeros((1, 1))), PERIOD)
    return found[0], found[1]


def limit_gain():
    """The gain at which a pole of Φ - k Γ c reaches the unit circle."""
    from scipy.optimize import brentq

    Phi, Gamma = discrete()

    def outside(k):
        return np.abs(np.linalg.eigvals(Phi - k * Gamma @ [[1.0, 0, 0, 0]])).max() - 1.0

    return brentq(lambda k: outside(k) - 1e-12, 0.5, 200.0, xtol=1e-10)


@cache
def digital():
    """The sampled model with a gain of five."""
    return servo(5.0).linearise(about="equilibrium")


def test_a_digital_servo_has_the_poles_of_the_exact_discretisation():
    model = digital()
    # it rests at another place, whose chambers are not equal
    assert model.sampled.period == pytest.approx(PERIOD, rel=1e-15)
    state = np.array([0.02, 0.0, _resting_pressure(), _resting_pressure()])
    at = np.zeros((4, 5))
    for k in range(4):
        moved = state.astype(complex)
        moved[k] += 1e-30j
        at[:, k] = rates(moved, 0.0 + 0.0j).imag / 1e-30
    at[:, 4] = rates(state.astype(complex), 1e-30j).imag / 1e-30
    Phi, Gamma, *_ = cont2discrete((at[:, :4], at[:, 4:], np.eye(4), np.zeros((4, 1))), PERIOD)
    wanted = np.linalg.eigvals(Phi - 5.0 * Gamma @ [[1.0, 0, 0, 0]])
    found = model.sampled.poles[np.abs(model.sampled.poles) > 1e-9]
    np.testing.assert_allclose(np.sort_complex(found), np.sort_complex(wanted), atol=1e-7)
    assert np.sum(np.abs(model.sampled.poles) <= 1e-9) == len(model.sampled.poles) - 4


def test_the_margins_of_a_digital_servo_are_those_at_which_it_becomes_unstable():
    (loop,) = digital().sampled.loops
    assert loop.name == "control.servo"
    at_limit = servo(5.0 * loop.gain_margin).linearise(about="equilibrium").sampled
    assert np.abs(at_limit.poles).max() == pytest.approx(1.0, abs=1e-8)
    assert servo(5.0 * loop.gain_margin * 1.02).linearise(about="equilibrium").stable is False
    assert digital().stable
    # at the middle of the stroke, by equations of their own; the place of rest changes it by its chambers alone
    assert 5.0 * loop.gain_margin == pytest.approx(limit_gain(), rel=0.02)
    # at the phase margin |L| is one
    z = np.exp(2j * np.pi * loop.phase_frequency * PERIOD)
    Phi, Gamma = discrete()
    L = 5.0 * np.linalg.solve(z * np.eye(4) - Phi, Gamma)[0, 0]
    assert abs(L) == pytest.approx(1.0, rel=1e-2)
    assert loop.phase_margin == pytest.approx(math.degrees(np.angle(-L)), abs=1.0)


@pytest.mark.parametrize(("volume", "stable"), [(1e-3, False), (50e-3, True)])
def test_a_pump_on_its_cut_off_curve_alone_on_a_volume_has_the_poles_of_its_cubic(volume, stable):
    """(s + g) (s² + 2 ζ ω s + ω²) + k ω² = 0, k = β Q/(V range), g that of the leak: it grows where k > 2 ζ ω, about."""
    full, width, leak, ratio, omega = 1e-3, 10 * BAR, 2e-11, 0.8, 12 * math.pi
    hydraulics = {
        "tank": {"type": "tank", "pressure": 1.0 * BAR},
        "line": {"type": "volume", "volume": volume},
        "pump": {
            "type": "pump", "ports": {"A": "tank", "B": "line"}, "displacement": full / 150, "speed": 150, "frequency": "6 Hz",
            "leakage": leak, "cut_off_curve": {"pressures": [200 * BAR, 200 * BAR + width], "settings": [1, 0]},
        },
    }  # fmt: skip
    model = machine({"hydraulics": hydraulics, "fluids": OIL}).linearise()
    p = BAR + brentq(lambda d: full * (1 - (d - 200 * BAR) / width) - leak * d, 200 * BAR, 200 * BAR + width)
    k, g = bulk_modulus(p) / volume * full / width, bulk_modulus(p) / volume * leak
    wanted = np.roots([1, 2 * ratio * omega + g, omega**2 + 2 * ratio * omega * g, omega**2 * (g + k)])
    # oil that the pump takes in is less dense by 2 %
    assert np.sort_complex(model.eigenvalues) == pytest.approx(np.sort_complex(wanted), rel=0.02)
    assert model.stable == stable == (k < 2 * ratio * omega)
