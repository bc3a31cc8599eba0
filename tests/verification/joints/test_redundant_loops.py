"""Closed loops with rows that joints of the tree already hold, except for round-off: implicit methods keep the rows that say something."""

import numpy as np
import pytest

from nivel import Body, Joint, JointSpringDamper, MachineRecord, SimulationSettings
from running import run

pytestmark = pytest.mark.covering

METHODS = pytest.mark.parametrize("integrator", ["generalised-alpha", "radau"])


def four_bar(turn):
    """Four revolutes, of which three rows repeat others, in a plane turned by `turn` about x, as is gravity."""
    y, z = np.array([0.0, np.cos(turn), np.sin(turn)]), np.array([0.0, -np.sin(turn), np.cos(turn)])
    x = np.array([1.0, 0.0, 0.0])
    a, b, c, d = 0.0 * x, 0.2 * y, 0.5 * x + 0.4 * y, 0.5 * x
    axes = (tuple(x), tuple(y), tuple(z))

    def bar(name, first, second):
        return Body(name=name, mass=1.0, inertia=(0.01, 0.01, 0.01), position=tuple(0.5 * (first + second)))

    def pin(name, bodies, point):
        return Joint(name=name, type="revolute", bodies=bodies, point=tuple(point), axis=axes[2])

    return MachineRecord(
        name="four-bar",
        gravity=tuple(-9.81 * y),
        bodies=(bar("crank", a, b), bar("rod", b, c), bar("rocker", c, d)),
        joints=(
            pin("a", ("ground", "crank"), a).replace(start_rates={"angle": 5.0}),
            pin("b", ("crank", "rod"), b),
            pin("c", ("rod", "rocker"), c),
            pin("d", ("ground", "rocker"), d),
        ),
        simulation=SimulationSettings(duration=0.2, step=1e-3, output_interval=1e-2, coordinates="relative"),
    )


@METHODS
def test_the_plane_of_a_loop_does_not_matter(integrator):
    """But for what the iterations of 200 steps leave."""
    flat = run(four_bar(0.0), integrator=integrator)
    for turn in (0.3, 0.7, 1.9):
        oblique = run(four_bar(turn), integrator=integrator)
        assert oblique.finished.outcome == "done"
        assert np.abs(oblique.joint_coordinate - flat.joint_coordinate).max() < 1e-6


def cylinder(foot):
    """A boom held by an oblique cylinder with a stiff oil column; with a revolute `foot` one row of the loop repeats others."""
    along = (0.6, 0.8, 0.0)
    axes = {"axis": (0, 0, 1)} if foot == "revolute" else {"axes": ((0, 0, 1), (0.8, -0.6, 0.0))}
    return MachineRecord(
        name="boom",
        gravity=(0, -9.81, 0),
        bodies=(
            Body(name="boom", mass=50.0, inertia=(1.0, 20.0, 20.0), position=(1.0, 0.0, 0.0)),
            Body(name="barrel", mass=5.0, inertia=(0.1, 0.1, 0.1), position=(0.45, -0.6, 0.0)),
            Body(name="piston", mass=3.0, inertia=(0.1, 0.1, 0.1), position=(0.75, -0.2, 0.0)),
        ),
        joints=(
            Joint(name="pivot", type="revolute", bodies=("ground", "boom"), point=(0, 0, 0), axis=(0, 0, 1)),
            Joint(name="foot", type=foot, bodies=("ground", "barrel"), point=(0.3, -0.8, 0.0), **axes),
            Joint(name="eye", type="spherical", bodies=("boom", "piston"), point=(0.9, 0.0, 0.0)),
            Joint(name="bore", type="cylindrical", bodies=("barrel", "piston"), point=(0.6, -0.4, 0.0), axis=along),
        ),
        forces=(JointSpringDamper(name="oil", coordinate="bore.displacement", stiffness=1e6, damping=1e4),),
        simulation=SimulationSettings(duration=0.2, step=1e-3, output_interval=1e-2, coordinates="relative"),
    )


@METHODS
def test_a_redundant_row_does_not_change_the_motion(integrator):
    """With a universal foot nothing is redundant."""
    twice, once = run(cylinder("revolute"), integrator=integrator), run(cylinder("universal"), integrator=integrator)
    assert np.abs(twice.position - once.position).max() < 1e-9
    assert np.abs(twice.energy_error).max() < 1.0
