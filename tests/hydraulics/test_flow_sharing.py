"""A crane with flow sharing: the circuit against the same equations by SciPy's Radau, and the example as it stands."""

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from circuits import BAR, LITRE_PER_MINUTE, circuit, density, history
from nivel.api import load
from test_characteristics import RATED, K, ramp, root, step

EXAMPLE = Path(__file__).parents[2] / "examples" / "hydraulics" / "harvester-crane.yaml"
END = 0.4
TANK, RELIEF, MARGIN, RANGE, LAG, SIGNAL = 1 * BAR, 200 * BAR, 1 * BAR, 2 * BAR, 5e-3, 10e-3
ROOM, INNER = 0.5e-3, 2e-6
OPEN = {"one": (0.8, 120 * BAR), "two": (0.5, 40 * BAR)}


def wishes(t):
    """Positions of both spools: the second one opens from 0.1 s to 0.15 s."""
    return 0.8, float(np.interp(t, [0, 0.1, 0.15], [0.0, 0.0, 0.5]))


def higher(a, b):
    return 0.5 * (a + b + np.sqrt((a - b) ** 2 + 1e8))


def opening(u):
    return ramp(u - 0.05) / (0.95 - 0.01)


def rates(t, y):
    """Of line, M and C of both sections and LS [bar], then of the positions of both compensators. Trials may be below no pressure."""
    line, m1, c1, m2, c2, ls = np.maximum(y[:6], 0.02) * BAR
    x = y[6:]

    def flow(size, a, b):
        """[kg/s] from the pressure a to b."""
        return 0.5 * (density(a) + density(b)) * size * root(a - b)

    out, taken, loads = [], 0.0, 0.0
    for u, m, c, its, (_, resisting) in zip(wishes(t), (m1, m2), (c1, c2), x, OPEN.values(), strict=True):
        metered = flow(K * opening(u), line, m)
        between = flow(2 * K * its, m, c)
        left = flow(4 * K * opening(u), c, resisting)
        out += [((metered - between), m, INNER), ((between - left), c, INNER)]
        taken += metered
        felt = TANK + step(ramp(u - 0.05) / 0.05) * (resisting - TANK)
        loads = higher(loads, felt)
    pump = density(TANK) * 45 * LITRE_PER_MINUTE
    spilled = flow(K * step((line - TANK - RELIEF) / (10 * BAR)), line, TANK)

    def pressure_rate(mass_flow, p, volume):
        slope = (density(p + 100.0) - density(p - 100.0)) / 200.0
        return mass_flow / (volume * slope) / BAR

    first = pressure_rate(pump - spilled - taken, line, ROOM)
    inner = [pressure_rate(*each) for each in out]
    moved = [(step((m - ls - MARGIN) / RANGE + 0.5) - its) / LAG for m, its in ((m1, x[0]), (m2, x[1]))]
    return [first, *inner, (loads - ls) / SIGNAL / BAR, *moved]


def test_sections_that_share_a_flow_follow_the_same_equations_by_other_means():
    """Within 1e-5 of the range of every pressure and position."""
    ports = {"P": "line", "T": "tank", "B": "tank", "LS": "ls"}
    like = {
        "type": "section", **RATED, "compensation": "post", "margin": MARGIN, "opening_range": RANGE, "lag": LAG,
        "overlap": 0.05,
    }  # fmt: skip
    hydraulics = {
        "tank": {"type": "tank", "pressure": TANK},
        "high": {"type": "tank", "pressure": OPEN["one"][1]},
        "low": {"type": "tank", "pressure": OPEN["two"][1]},
        "line": {"type": "volume", "volume": ROOM},
        "ls": {"type": "load-sensing", "valves": ["one", "two"], "lag": SIGNAL},
        "pump": {"type": "flow-source", "ports": {"A": "tank", "B": "line"}, "flow": "45 L/min"},
        "relief": {
            "type": "relief-valve", "ports": {"P": "line", "T": "tank"}, "opens_at": RELIEF, "opening_range": 10 * BAR,
            **RATED,
        },
        "one": {**like, "command": 0.8, "ports": {**ports, "A": "high"}},
        "two": {**like, "command": {"of": "time", "times": [0, 0.1, 0.15], "values": [0, 0, 0.5]}, "ports": {**ports, "A": "low"}},
    }  # fmt: skip
    built = circuit(hydraulics)
    result = built.simulate(integrator="radau", tolerance=1e-9, duration=END, output_interval=0.01)
    names = [f"{each}.pressure{end}" for each, end in (
        ("line", ""), ("one", "_M"), ("one", "_C"), ("two", "_M"), ("two", "_C"), ("ls", "")
    )]  # fmt: skip
    names += ["one.compensator_position", "two.compensator_position"]
    found = np.array([history(result, f"hydraulics.{name}") for name in names])
    found[:6] /= BAR
    t = np.asarray(result.time)
    wanted = []
    for begin, end in ((0.0, 0.1), (0.1, 0.15), (0.15, END)):  # the command has corners
        inside = t[(t >= begin - 1e-9) & (t <= end + 1e-9)]
        start = found[:, 0] if not wanted else wanted[-1][:, -1]
        solved = solve_ivp(
            rates, (begin, end), start, "Radau", inside.clip(begin, end), rtol=1e-9, atol=1e-8, first_step=1e-7
        )
        wanted.append(solved.y)
    other = np.hstack([wanted[0], *(each[:, 1:] for each in wanted[1:])])
    span = np.ptp(other, axis=1)
    moved = span > 1e-3
    assert np.max(np.abs(found - other)[moved] / span[moved, None]) < 1e-5
    assert moved.sum() >= 6


@pytest.fixture(scope="module")
def crane():
    return load(EXAMPLE).simulate()


def test_the_crane_is_green_from_its_equilibrium(crane):
    assert crane.trust.verdict == "green", [item.text for item in crane.trust.items if item.verdict != "green"]
    assert np.max(np.abs(crane.array("position")[:3, 2] - crane.array("position")[0, 2])) < 1e-6


def test_a_step_of_the_crane_takes_six_evaluations_and_two_factorisations(crane):
    """A whole step and two halves of it, of two stages each, with a matrix for either length; one step in a hundred may be divided."""
    steps, timing = 5400, crane.timing
    assert timing["steps"] == pytest.approx(steps)
    assert 6 * steps <= timing["evaluations"] < 6.06 * steps
    assert 2 * steps <= timing["factorisations"] < 2.02 * steps


def test_the_head_moves_out_and_back_on_a_level_line(crane):
    head = crane.array("position")[:, 2]
    assert np.max(head[:, 0]) - head[0, 0] == pytest.approx(0.45, abs=0.02)
    assert abs(head[-1, 0] - head[0, 0]) < 0.05
    assert np.max(np.abs(head[:, 2] - head[0, 2])) < 0.06


def test_sections_of_the_crane_slow_down_together_where_the_pump_is_at_its_end(crane):
    """Both metering edges have the same difference of pressure, within the range of a compensator and what it takes itself."""
    full = history(crane, "hydraulics.pump.setting") > 0.99
    both = full & (history(crane, "hydraulics.jib_section.position") > 0.3)
    assert both.sum() > 50
    lift, jib = (history(crane, f"hydraulics.{name}_section.pressure_M")[both] for name in ("lift", "jib"))
    assert np.mean(np.abs(lift - jib)) < 4 * BAR
    loads = history(crane, "hydraulics.lift_line.pressure")[both] - history(crane, "hydraulics.reach.pressure_A")[both]
    assert np.max(np.abs(loads)) > 20 * BAR
