"""Deviation and station of a vehicle on a course of few points, against the nearest place of the spline through these and its length."""

import numpy as np
import pytest
import scipy.interpolate

from simulating import machine

RADIUS = 20.0


@pytest.mark.parametrize("count", [6, 9])
@pytest.mark.parametrize(("turned", "left"), [(0.15, 1.5), (0.3, -2.0), (0.8, 3.0)])
def test_the_distance_from_a_coarse_course_is_that_from_its_spline(count, turned, left):
    """Half a circle. The vehicle stands still, and the station comes to the foot of the perpendicular in some time constants of 0.2 s."""
    angle = np.linspace(0.0, np.pi, count)
    points = RADIUS * np.stack([np.sin(angle), 1.0 - np.cos(angle)], axis=-1)
    x, y = (RADIUS - left) * np.sin(turned), RADIUS - (RADIUS - left) * np.cos(turned)
    chord = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    spline = scipy.interpolate.CubicSpline(chord, points, bc_type="natural")
    places = spline(np.linspace(0.0, chord[-1], 100001))
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(places, axis=0).T))])
    away = np.hypot(*(places - [x, y]).T)
    foot = int(np.argmin(away))

    driver = {
        "type": "vehicle-driver",
        "speed": 0,
        "x": "b.position.x",
        "y": "b.position.y",
        "heading": "j.angle",
        "wheelbase": 2,
    }
    run = machine(
        {
            "gravity": [0, 0, 0],
            "bodies": {"b": {"mass": 1, "inertia": [1, 1, 1], "position": [x, y, 0]}},
            "joints": {"j": {"type": "planar", "bodies": ["ground", "b"], "point": [x, y, 0], "axis": [0, 0, 1]}},
            "control": {"d": {**driver, "course": points.tolist()}},
        }
    ).simulate(verify=False, duration=20.0, output_interval=1.0)
    assert run.array("control.d.deviation")[-1] == pytest.approx(np.sign(left) * away[foot], abs=1e-5)
    assert run.array("control.d.station")[-1] == pytest.approx(length[foot], abs=1e-3)
