"""Implicit methods that choose their steps keep what the tolerance promises on all machines with known motions, in all coordinates."""

from itertools import product

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import machines
from lanes import FULL, tail
from references import four_bar, pendulum, slider_crank
from running import run
from test_tolerance import closing_angle, loop_angles, machine_size, squeezed, squeezer, swinging, top_rotation

pytestmark = pytest.mark.covering

SECOND_ORDER = ["newmark", "hht", "generalised-alpha"]


def error_of_slider_crank(**settings):
    """2 s, through its first top dead centre: frames inside steps too."""
    result = run(machines.slider_crank(), duration=2.0, output_interval=0.013, **settings)
    return np.abs(result.position - slider_crank.solve(result.time).position).max() / machine_size(result)


def error_of_four_bar(**settings):
    result = run(machines.four_bar(), output_interval=0.05, **settings)
    expected = four_bar.solve(result.time, crank_angle=closing_angle())
    return np.abs(result.position - expected.position).max() / machine_size(result)


def error_of_heavy_top(**settings):
    """48 turns."""
    result = run(machines.heavy_top(), duration=2.0, output_interval=0.1, **settings)
    found = Rotation.from_quat(result.orientation[:, 0], scalar_first=True).as_matrix()
    return np.abs(found - top_rotation(tuple(result.time))).max()


def error_of_squeezer(**settings):
    result = run(squeezer(), step=1e-4, output_interval=1e-4, **settings)
    return np.abs(loop_angles(result) - squeezed()).max()


def error_of_pendulum(**settings):
    result = run(swinging(), **settings)
    expected = pendulum.solve(result.time, pendulum.Pendulum(inertia=0.02))
    return np.abs(result.position[:, 0] - expected.position).max()


MACHINES = {
    "slider-crank": error_of_slider_crank,
    "four-bar": error_of_four_bar,
    "heavy top": error_of_heavy_top,
    "squeezer": error_of_squeezer,
    "pendulum": error_of_pendulum,
}
OF_ALL = pytest.mark.parametrize("name", MACHINES)


def rests(name, coordinates, integrator):
    """One machine is enough of hht and newmark, which are generalised-alpha with other numbers, and of independent coordinates; the others
    meet absolute and relative ones in turn."""
    turn = ("relative", "absolute")[list(MACHINES).index(name) % 2]
    return name != "slider-crank" and (integrator != "generalised-alpha" or coordinates != turn)


@pytest.mark.parametrize(
    ("name", "coordinates", "integrator"),
    [
        pytest.param(*case, marks=[pytest.mark.full] if rests(*case) else [])
        for case in product(MACHINES, ("absolute", "relative", "independent"), SECOND_ORDER)
    ],
)
def test_second_order(name, coordinates, integrator):
    settings = {"integrator": integrator, "step_control": "error", "coordinates": coordinates}
    for tolerance in (1e-2, 1e-4):
        assert MACHINES[name](tolerance=tolerance, **settings) < 10 * tolerance


@OF_ALL
@pytest.mark.parametrize("coordinates", tail(["absolute", "relative", "independent"], ["relative"]))
@pytest.mark.parametrize("integrator", ["radau", "bdf"])
def test_high_order(name, coordinates, integrator):
    for tolerance in (1e-2, 1e-4, 1e-6, 1e-8) if FULL else (1e-3, 1e-6):
        assert MACHINES[name](tolerance=tolerance, integrator=integrator, coordinates=coordinates) < 10 * tolerance


def test_bdf_after_many_turns():
    """It damps and delays each of them: its steps have to be wrong by less the more of them there are."""
    assert error_of_heavy_top(tolerance=1e-10, integrator="bdf") < 10 * 1e-10
