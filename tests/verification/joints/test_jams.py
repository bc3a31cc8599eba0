"""Machines driven beyond the last position in which their joints can be closed fail there, and say so, whatever the methods."""

import re
from math import acos, cos, pi, sin, sqrt

import numpy as np
import pytest

from nivel.analysis.run import dynamics
from nivel.errors import SolveError
from nivel.results.result import Result
from simulating import hinge, simulate, slide, solid

CRANK, ROD, SPEED = 0.5, 0.7, 0.15
STEP = 1e-3


def distance_rod():
    """A crank pulls at a slider by a massless rod; the slider is driven outwards, to x = CRANK + ROD at most."""
    x, y = CRANK * cos(pi / 6), CRANK * sin(pi / 6)
    start = x + sqrt(ROD**2 - y**2)
    turned = {"axis": [0, 0, 1], "angle": pi / 6}
    machine = {
        "gravity": [0, -9.81, 0],
        "bodies": {
            "crank": solid(1.0, 0.01, position=[x / 2, y / 2, 0], orientation=turned),
            "block": solid(1.0, 0.01, position=[start, 0, 0]),
        },
        "joints": {
            "main": hinge("ground", "crank"),
            "rod": {"type": "distance", "bodies": ["crank", "block"], "points": [[x, y, 0], [start, 0, 0]]},
            "rail": slide("ground", "block", point=[start, 0, 0]),
        },
        "drivers": {"pull": {"coordinate": "rail", "value": f"{SPEED}*time"}},
    }
    return machine, (CRANK + ROD - start) / SPEED


def crank_that_cannot_turn():
    """A four-bar of hinges alone, three rows of which repeat others: its crank turns until coupler and rocker lie in line."""
    a, b, c, ground, begin, speed = 0.8, 0.7, 0.7, 1.2, 0.6, 1.5
    near, far = np.array([a * cos(begin), a * sin(begin), 0]), np.array([ground, 0, 0])
    gap = far - near
    across = np.array([-gap[1], gap[0], 0]) / np.linalg.norm(gap)
    knee = (near + far) / 2 + sqrt(b**2 - gap @ gap / 4) * across
    machine = {
        "gravity": [0, -9.81, 0],
        "bodies": {
            "crank": solid(1.0, 0.01, position=near / 2),
            "coupler": solid(1.0, 0.01, position=(near + knee) / 2),
            "rocker": solid(1.0, 0.01, position=(far + knee) / 2),
        },
        "joints": {
            "left": hinge("ground", "crank"),
            "near": hinge("crank", "coupler", point=tuple(near)),
            "far": hinge("coupler", "rocker", point=tuple(knee)),
            "right": hinge("ground", "rocker", point=tuple(far)),
        },
        "drivers": {"turn": {"coordinate": "left.angle", "value": f"{speed}*time"}},
    }
    last = acos((a**2 + ground**2 - (b + c) ** 2) / (2 * a * ground))
    return machine, (last - begin) / speed


ABSOLUTE, RELATIVE, INDEPENDENT = ({"coordinates": name} for name in ("absolute", "relative", "independent"))
BAUMGARTE = {"stabilisation": "baumgarte", "baumgarte": {"alpha": 20, "beta": 20}}
METHODS = [
    *({"integrator": "rk4", **each} for each in (ABSOLUTE, RELATIVE, INDEPENDENT)),
    *({"integrator": "rk4", **each, "stabilisation": "none"} for each in (ABSOLUTE, RELATIVE)),
    *({"integrator": "rk4", **each, **BAUMGARTE} for each in (ABSOLUTE, RELATIVE)),
    {"integrator": "abm4", **ABSOLUTE},
    {"integrator": "dopri5", **ABSOLUTE},
    *({"integrator": "ros2", **each} for each in (ABSOLUTE, RELATIVE)),
    {"integrator": "ros2", **RELATIVE, "stabilisation": "none"},
    {"integrator": "radau", **ABSOLUTE},
    *({"integrator": name, **ABSOLUTE} for name in ("newmark", "hht", "generalised-alpha")),
    {"integrator": "hht", **ABSOLUTE, "step_control": "error", "tolerance": 1e-4},
    {"integrator": "rk4", **ABSOLUTE, "formulation": "lagrange"},
    {"integrator": "rk4", **ABSOLUTE, "formulation": "penalty"},
    {"integrator": "ros2", **ABSOLUTE, "formulation": "augmented-lagrangian"},
]
# the dearest of the crank are for the full tests
CASES = [
    *((distance_rod, methods) for methods in METHODS),
    *((crank_that_cannot_turn, methods) for methods in METHODS[:3]),
    *(pytest.param(crank_that_cannot_turn, methods, marks=pytest.mark.full) for methods in METHODS[3:]),
]


@pytest.mark.parametrize(
    ("made", "methods"),
    CASES,
    ids=lambda each: (
        "-".join(str(value) for value in each.values() if not isinstance(value, dict))
        if isinstance(each, dict)
        else each.__name__
    ),
)
def test_a_jam_is_named_with_its_time_its_joints_and_its_driver(made, methods):
    """The time follows from the triangle whose sides lie in line; the run keeps what it found up to there, and nothing after."""
    machine, jam = made()
    with pytest.raises(SolveError) as caught:
        simulate(machine, duration=jam + 0.4, step=STEP, **methods)
    message, result = caught.value.message, caught.value.result
    assert isinstance(result, Result)
    said = re.search(r"the machine jams at t = ([\d.]+) s", message)
    assert said is not None, message
    assert float(said[1]) == pytest.approx(jam, abs=1e-6)
    assert (
        "pull is held by main and rod." if made is distance_rod else "turn is held by left, near, far and right."
    ) in message
    assert re.search(r"\S+\.\S+ (\(joint \S+, coordinate [^)]+\) )?would be open by \S+ (m|rad|\(a cosine\))$", message)
    assert "let it stop or turn back before" in caught.value.advice
    assert abs(caught.value.time - jam) < 4 * STEP
    assert result.outcome == "failed"
    assert jam - 4 * STEP < result.time[-1] < jam + 4 * STEP
    assert np.max(np.abs(result.array("constraint_violation"))) < 2e-3


@pytest.mark.parametrize("over", [1e-3, 1e-5])
def test_a_jam_is_named_also_where_the_driver_soon_turns_back(over):
    """Ten times a second the slider is to go beyond its reach by this and back, which takes milliseconds; chosen steps stop before it."""
    machine, jam = distance_rod()
    reach, once = SPEED * jam, 0.1
    machine["drivers"]["pull"]["value"] = f"{0.5 * (reach + over)}*(1 - cos({2 * pi / once}*time))"
    with pytest.raises(SolveError, match="pull is held by main and rod") as caught:
        simulate(machine, duration=1.0, step=STEP, integrator="dopri5", coordinates="absolute")
    said = re.search(r"the machine jams at t = ([\d.]+) s", caught.value.message)
    assert said is not None
    assert float(said[1]) == pytest.approx(once / (2 * pi) * acos(1 - 2 * reach / (reach + over)), abs=1e-6)


def test_a_driver_that_turns_back_before_the_jam_runs():
    """To half a millimetre before the reach and back: the cosine of the crank's angle follows from the triangle."""
    machine, jam = distance_rod()
    start = CRANK + ROD - SPEED * jam
    machine["drivers"]["pull"]["value"] = f"{0.5 * (SPEED * jam - 5e-4)}*(1 - cos(2*pi*time))"
    r = simulate(machine, duration=1.0, step=STEP, integrator="rk4", coordinates="absolute")
    x = start + r.array("rail.displacement")
    angle = r.array("main.angle") + pi / 6
    np.testing.assert_allclose(np.cos(angle), (CRANK**2 + x**2 - ROD**2) / (2 * CRANK * x), atol=1e-9)
    assert r.outcome == "done"


def loose_linkage():
    """A double pendulum: nothing can jam, and with Euler's method joints drift far."""
    return {
        "gravity": [0, -9.81, 0],
        "bodies": {"arm": solid(1.0, 0.1, position=[0.5, 0, 0]), "bob": solid(1.0, 0.1, position=[1.5, 0, 0])},
        "joints": {"pin": hinge("ground", "arm"), "knee": hinge("arm", "bob", point=(1, 0, 0))},
    }


@pytest.mark.parametrize("cut", [{}, {"cut": ["knee"]}])
def test_drift_is_no_jam_and_asking_changes_nothing(cut, monkeypatch):
    """Joints that drift by centimetres can still be closed: the run goes on, to the last digit as one that is never asked."""
    methods = {"integrator": "euler", "stabilisation": "none", "duration": 2.0, "step": 4e-3, "output_interval": 4e-3}
    methods |= cut or {"coordinates": "absolute"}
    asked = []
    find = dynamics.find_jam
    monkeypatch.setattr(dynamics, "find_jam", lambda *given: asked.append(given[1]) or find(*given))
    drifted = simulate(loose_linkage(), **methods)
    assert drifted.outcome == "done"
    assert asked
    monkeypatch.setattr(dynamics, "find_jam", lambda *_: None)
    never = simulate(loose_linkage(), **methods)
    for name in ("position", "orientation", "joint_coordinate", "constraint_violation", "constraint_force"):
        np.testing.assert_array_equal(drifted.array(name), never.array(name))


@pytest.mark.parametrize("coordinates", [{"coordinates": "absolute"}, {"cut": ["knee"]}])
def test_positions_are_closed_also_after_steps_that_are_far_too_long(coordinates):
    """The first step turns the arm by a radian, which leaves pin and knee open by decimetres: too far for three passes of Newton's method,
    whose error falls as ε², ε⁴, ε⁸ from ε of one half or so."""
    machine = loose_linkage()
    machine["joints"]["pin"]["start_rates"] = {"angle": 10.0}
    r = simulate(machine, integrator="euler", duration=0.2, step=0.1, **coordinates)
    assert np.max(np.abs(r.array("constraint_violation"))) < 1e-6
