"""Machines moved by hand: joints stay closed, coordinates take the values that are wished, what is free is found."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.analysis.posing import Posing

EXAMPLES = Path(__file__).parent.parent.parent / "examples"
OPEN = 1e-9
CLOSED_LOOPS = ("slider-crank", "four-bar", "andrews-squeezer", "rssr", "watt-six-bar", "cam", "gear-train")


def posed(name) -> Posing:
    return nivel.load(EXAMPLES / f"{name}.yaml", allow_code=True).posed()


def gaps(machine: Posing) -> float:
    """Largest violation of a joint, coupling or driver in the present position, by its scale."""
    system = machine._motion.system
    rows = slice(0, system.machine_rows)
    return float(np.max(np.abs(system.record.constraints.C[rows]) / system.record.constraints.scale[rows], initial=0.0))


@pytest.mark.parametrize("name", CLOSED_LOOPS)
def test_every_movement_within_its_range_keeps_all_joints_closed(name):
    machine = posed(name)
    moving = [each for each in machine.movements if each.free]
    assert moving
    for each in moving:
        machine.reset()
        for value in np.linspace(each.low, each.high, 9):
            problem = machine.move(each.name, float(value))
            assert gaps(machine) < OPEN
            at = [m.name for m in machine.movements].index(each.name)
            if not problem:
                assert machine.values()[at] == pytest.approx(value, abs=1e-8)


def test_a_crank_goes_all_round_and_its_rocker_does_not():
    by_name = {each.name: each for each in posed("four-bar").movements}
    crank, rocker = by_name["crank_pivot.angle"], by_name["rocker_pivot.angle"]
    assert crank.high - crank.low == pytest.approx(2 * np.pi)
    # crank 0.4, coupler 1.0, rocker 0.8, ground 0.9 or whatever the file says: less than half a turn by Grashof
    assert 0.1 < rocker.high - rocker.low < np.pi


def test_other_freedoms_of_an_open_chain_stay():
    import runpy

    machine = runpy.run_path(str(EXAMPLES / "double_pendulum.py"))["machine"].posed()
    machine.move("elbow.angle", 0.4)
    machine.move("shoulder.angle", -0.9)
    values = dict(zip([each.name for each in machine.movements], machine.values(), strict=True))
    assert values == pytest.approx({"shoulder.angle": -0.9, "elbow.angle": 0.4}, abs=1e-9)


def test_what_cannot_be_reached_leaves_the_machine_as_it_was():
    machine = posed("four-bar")
    before = machine.pose()
    assert "cannot go there" in machine.move("rocker_pivot.angle", 100.0)
    assert "no coordinate" in machine.move("nothing.angle", 0.0)
    np.testing.assert_array_equal(machine.pose()[0], before[0])


def test_driven_machines_move_with_the_time():
    machine = posed("rssr")
    (time,) = [each for each in machine.movements if each.free]
    assert time.name == "time"
    assert machine.move("time", 0.5 * time.high) == ""
    assert gaps(machine) < OPEN
    machine.reset()
    assert machine.values()[-1] == 0.0


def test_a_machine_without_joints_is_shown_as_well():
    ball = nivel.Machine("ball", bodies=[nivel.Body(name="ball", mass=1, inertia=(1, 1, 1), position=(1, 2, 3))])
    machine = ball.posed()
    assert machine.movements == ()
    np.testing.assert_array_equal(machine.pose()[0], [[1, 2, 3]])
