"""A cylinder lifts a boom: the example of a circuit with mechanics, against the same equations written anew and solved by SciPy."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import nivel

FILE = Path(__file__).parents[2] / "examples" / "hydraulics" / "cylinder-boom.yaml"
PA = 101325.0
ALPHA, BETA, SLOPE, N = 0.005, 1.5e9, 10.0, 1.4
RHO_0 = 0.995 * 870.0 + 0.005 * 1.2
AREA_A, AREA_B = 0.25 * np.pi * 0.1**2, 0.25 * np.pi * (0.1**2 - 0.056**2)
STROKE, RETRACTED = 0.55, 0.82
FOOT, EYE = np.array([0.26, -1.04]), np.array([0.304, -0.1])  # from the hinge; the eye in the boom
MASS, CENTRE, INERTIA = 620.0, np.array([2.2, 0.05]), 900.0
END = 4.0


def density(p):
    """ρ(p) of the fluid."""
    liquid = (1.0 + SLOPE * (p - PA) / BETA) ** (-1.0 / SLOPE)
    return RHO_0 / ((1.0 - ALPHA) * liquid + ALPHA * (PA / p) ** (1.0 / N))


def pressure(mass, volume):
    """The pressure at which a volume holds a mass: Newton's method on ρ(p) V = m, in steps that keep p positive."""
    p, wanted = 1e7, mass / volume
    for _ in range(100):
        L = 1.0 + SLOPE * (p - PA) / BETA
        liquid, air = (1.0 - ALPHA) * L ** (-1.0 / SLOPE), ALPHA * (PA / p) ** (1.0 / N)
        v = liquid + air
        slope = RHO_0 / v**2 * (liquid / (BETA * L) + air / (N * p))
        change = max((wanted - RHO_0 / v) / slope, -0.9 * p)
        p += change
        if abs(change) < 1e-10 * p:
            return p
    raise AssertionError("no pressure was found")


def step(t):
    return 0.0 if t <= 0.0 else 1.0 if t >= 1.0 else t * t * (3.0 - 2.0 * t)


def ramp(z, w=0.02):
    return 0.0 if z <= 0.0 else z - 0.5 * w if z >= w else z**3 / w**2 - 0.5 * z**4 / w**3


def flow(conductance, a, b):
    """Mass flow from pressure a to b."""
    root = (a - b) * ((a - b) ** 2 + (0.5e5) ** 2) ** -0.25
    return 0.5 * (density(a) + density(b)) * conductance * root


def geometry(angle):
    """Length of the cylinder, its lever, height of the centre of mass from the hinge and its lever."""
    c, s = np.cos(angle), np.sin(angle)
    eye = np.array([c * EYE[0] - s * EYE[1], s * EYE[0] + c * EYE[1]])
    along = eye - FOOT
    length = np.hypot(*along)
    lever = (eye[0] * along[1] - eye[1] * along[0]) / length
    return length, lever, c * CENTRE[0] - s * CENTRE[1]


TIMES = [0, 0.2, 0.5, 1.5, 1.8, 2.2, 2.5, 3.5, 3.8]
COMMANDS = [0, 0, 0.4, 0.4, 0, 0, -0.3, -0.3, 0]
K_VALVE, K_RELIEF = 40e-3 / 60.0 / np.sqrt(7e5), 60e-3 / 60.0 / np.sqrt(200e5)
TANK, PUMP = 2e5, 28e-6 * 25.0
OMEGA, ZETA = 2.0 * np.pi * 8.0, 0.8


def volumes(s):
    return 0.1e-3 + AREA_A * s, 0.3e-3 + AREA_B * (STROKE - s)


def rates(t, y):
    angle, speed, m_p, m_a, m_b, u, w = y
    length, lever, arm = geometry(angle)
    s, v = length - RETRACTED, lever * speed
    v_a, v_b = volumes(s)
    p_p, p_a, p_b = pressure(m_p, 1e-3), pressure(m_a, v_a), pressure(m_b, v_b)
    sliding = 800.0 + 0.01 * AREA_A * np.sqrt((p_a - p_b) ** 2 + 1e10)
    friction = sliding * np.tanh(v / 0.01) + 2e4 * v
    force = (p_a - PA) * AREA_A - (p_b - PA) * AREA_B - friction
    full = 1.0 - 0.01
    forward, back = ramp(u) / full * K_VALVE, ramp(-u) / full * K_VALVE
    pa, bt, pb, at = flow(forward, p_p, p_a), flow(forward, p_b, TANK), flow(back, p_p, p_b), flow(back, p_a, TANK)
    relief = flow(K_RELIEF * step((p_p - TANK - 200e5) / 20e5), p_p, TANK)
    command = np.interp(t, TIMES, COMMANDS)
    turning = (force * lever - MASS * 9.81 * arm) / (INERTIA + MASS * CENTRE @ CENTRE)
    in_p = density(TANK) * PUMP - relief - pa - pb
    return [speed, turning, in_p, pa - at, pb - bt, w, OMEGA**2 * (command - u) - 2.0 * ZETA * OMEGA * w]


@cache
def reference():
    """Angle, and pressures in P, A and B, at the end."""
    length, lever, arm = geometry(0.0)
    v_a, v_b = volumes(length - RETRACTED)
    p_a = PA + (MASS * 9.81 * arm / lever + (TANK - PA) * AREA_B) / AREA_A
    p_p = brentq(
        lambda p: density(TANK) * PUMP - flow(K_RELIEF * step((p - TANK - 200e5) / 20e5), p, TANK), 201e5, 230e5
    )
    y = [0.0, 0.0, density(p_p) * 1e-3, density(p_a) * v_a, density(TANK) * v_b, 0.0, 0.0]
    for first, last in zip([0.0, *TIMES[1:]], [*TIMES[1:], END], strict=True):
        if last > first:
            y = solve_ivp(rates, (first, last), y, method="Radau", rtol=1e-8, atol=1e-10).y[:, -1]
    v_a, v_b = volumes(geometry(y[0])[0] - RETRACTED)
    return np.array([y[0], pressure(y[2], 1e-3), pressure(y[3], v_a), pressure(y[4], v_b)])


def ends(result):
    names = (
        "joint_coordinate",
        "hydraulics.supply.pressure",
        "hydraulics.lift.pressure_A",
        "hydraulics.lift.pressure_B",
    )
    return np.array([float(np.ravel(result.array(name))[-1]) for name in names])


@pytest.mark.parametrize(
    "settings",
    [
        {"integrator": "radau", "tolerance": 1e-8},
        {"integrator": "bdf", "tolerance": 1e-8},
        {"integrator": "dopri5", "tolerance": 1e-8},
        {"integrator": "rk4", "step": 1e-4 / 4},
        {"integrator": "radau", "tolerance": 1e-8, "coordinates": "absolute"},
        {"integrator": "radau", "tolerance": 1e-8, "coordinates": "independent"},
    ],
    ids=lambda each: "-".join(str(value) for value in each.values()),
)
def test_a_boom_ends_where_the_equations_written_anew_end(settings):
    found = ends(nivel.load(FILE).simulate(**settings))
    assert found == pytest.approx(reference(), rel=1e-5)


def test_energies_of_the_circuit_and_its_mass_balance():
    result = nivel.load(FILE).simulate(integrator="radau", tolerance=1e-8)
    items = {item.name: item for item in result.trust.items}
    assert items["hydraulics"].fraction < 1e-9
    assert items["fluid mass"].fraction < 1e-9
    assert result.trust.verdict == "green"


def test_fast_steps_keep_the_mass_to_round_off():
    """Those of `nivel.integrate.rosenbrock.extrapolated_euler`: tanks give by the rule by which volumes take."""
    result = nivel.load(FILE).simulate(integrator="extrapolated-euler", duration=0.3)
    gave = result.array("state.hydraulics.taken_in")
    assert np.ptp(gave) > 1e-3
    assert next(item.fraction for item in result.trust.items if item.name == "fluid mass") < 1e-12


def test_the_error_of_the_ledger_falls_with_the_order_of_the_method():
    def error(h):
        result = nivel.load(FILE).simulate(integrator="heun", step=h, duration=1.0)
        return next(item.fraction for item in result.trust.items if item.name == "hydraulics")

    coarse, fine = error(4e-4), error(2e-4)
    assert 1.7 < np.log2(coarse / fine) < 2.5


def test_a_loaded_boom_stands_still_at_the_start():
    result = nivel.load(FILE).simulate(duration=0.19)
    assert np.max(np.abs(result.array("velocity"))) < 1e-9


def test_a_run_from_equilibrium_stays_where_statics_finds_it():
    """Mechanics and circuit together, the fluid in the closed chambers as it is."""
    machine = nivel.load(FILE)
    rest = machine.statics()
    assert rest.outcome == "done"
    settings = machine.record.simulation.replace(start="equilibrium")
    started = nivel.Machine.from_record(machine.record.replace(simulation=settings)).simulate(duration=0.19)
    angle = np.ravel(started.array("joint_coordinate"))
    assert np.ptp(angle) < 1e-9
    assert angle[0] == pytest.approx(float(np.ravel(rest.array("joint_coordinate"))[-1]), abs=1e-9)
