"""Faults that inputs switch while a machine runs: each of the example changes what its formula says, and nothing else."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

from nivel.api import Machine
from nivel.files import parse_machine

EXAMPLE = Path(__file__).parents[2] / "examples" / "hydraulics" / "faults.yaml"
BAR, AIR = 1e5, 101325.0
FLOW = 20e-6 * 25  # m³/s of the pump
PISTON = np.pi / 4 * 0.063**2


def smooth(x):
    """S, from 0 to 1."""
    x = np.clip(x, 0.0, 1.0)
    return 3 * x**2 - 2 * x**3


def root(p, over=0.5 * BAR):
    """√p, rounded below the transition."""
    return p / (p * p + over * over) ** 0.25


@cache
def run(fault, begin=1.0, duration=3.0):
    """The example with a fault that comes within 10 ms."""
    line = f"  {fault}: {{range: [0, 1]"
    text = EXAMPLE.read_text(encoding="utf-8")
    assert line in text
    course = f"signal: {{of: time, times: [0, {begin}, {begin + 0.01}], values: [0, 0, 1]}}"
    machine = Machine.from_record(parse_machine(text.replace(line, f"{line}, {course}")))
    return machine.simulate(duration=duration)


def relieved(setting):
    """Pressure of the supply at which the relief valve passes all of the pump [Pa]."""
    size = 1e-3 / np.sqrt(180 * BAR)
    return AIR + brentq(
        lambda p: size * smooth((p - setting) / (18 * BAR)) * root(p) - FLOW, setting, setting + 36 * BAR
    )


@pytest.mark.parametrize(("fault", "setting"), [("dead_sensor", 180 * BAR), ("broken_spring", 36 * BAR)])
def test_a_relief_valve_holds_what_its_spring_has_left(fault, setting):
    result = run(fault)
    pressure = result.array("hydraulics.supply.pressure")[-1]
    passed = 1e-3 / np.sqrt(180 * BAR) * smooth((pressure - AIR - setting) / (18 * BAR)) * root(pressure - AIR)
    assert result.array("hydraulics.relief.flow")[-1] == pytest.approx(passed, rel=1e-9)
    assert pressure == pytest.approx(relieved(setting), rel=3e-3)  # of oil that is not compressed


@pytest.mark.parametrize(("fault", "left"), [("dead_sensor", 1.0), ("clogged_filter", 0.05)])
def test_a_filter_passes_through_what_is_open(fault, left):
    result = run(fault)
    late = result.array("time") > 1.05
    drop = result.array("hydraulics.back.pressure")[late] - AIR
    flow = result.array("hydraulics.filter.flow")[late]
    assert np.ptp(flow) > 1e-4
    np.testing.assert_allclose(flow, left * 1e-3 / np.sqrt(0.5 * BAR) * root(drop), atol=1e-9)


def test_a_burst_hose_drops_the_load_through_its_hole():
    result = run("burst_hose")
    late = result.array("time") > 1.05
    pressure = result.array("hydraulics.hose.pressure")[late] - AIR
    size = 0.65 * np.pi / 4 * 0.008**2 * np.sqrt(2 / 870)
    flow = result.array("hydraulics.burst.flow")[late]
    np.testing.assert_allclose(flow, size * root(pressure), rtol=4e-3, atol=1e-7)  # of the mean density of both sides
    assert result.array("joint_coordinate")[-1, 0] < -0.19  # on its stop


def test_a_worn_seal_lets_a_load_sink_behind_a_closed_valve():
    """The leak passes from below the piston to above it until the load stands on what is shut in there: the closed valve holds both."""
    result, whole = run("worn_seal", 2.2), run("dead_sensor")
    hose, above = (result.array(f"hydraulics.{name}")[-1] for name in ("hose.pressure", "lift.pressure_B"))
    assert result.array("joint_coordinate")[-1, 0] < whole.array("joint_coordinate")[-1, 0] - 1e-4
    assert abs(hose - above) < 0.5 * abs(
        whole.array("hydraulics.hose.pressure")[-1] - whole.array("hydraulics.lift.pressure_B")[-1]
    )


def test_air_in_a_hose_takes_the_oil_that_its_gas_gives_way_to():
    """Behind a closed valve the load sinks by the oil that the pocket takes: V (1 - (p₀/p)^(1/n)), over the area of the piston."""
    result, begin = run("air", 2.3, 5.0), 2.3
    time, place = result.array("time"), result.array("joint_coordinate")[:, 0]
    pressure = result.array("hydraulics.pocket.pressure")[-1]
    taken = 2e-4 * (1 - (1.1 * BAR / pressure) ** (1 / 1.3))
    sunk = place[np.searchsorted(time, begin)] - place[-1]
    assert sunk == pytest.approx(taken / PISTON, rel=0.1)  # and the oil in hose and cylinder expands


def test_a_stuck_spool_stays_where_it_was():
    result = run("stuck_spool")
    np.testing.assert_allclose(result.array("hydraulics.valve.position")[result.array("time") > 1.2], 0.6, atol=1e-6)


def test_a_dead_sensor_says_what_it_said():
    result = run("dead_sensor")
    late = result.array("time") > 1.006
    said, true = result.array("control.pressure")[late], result.array("hydraulics.hose.pressure")[late]
    assert np.ptp(said) == 0.0
    assert np.ptp(true) > BAR
