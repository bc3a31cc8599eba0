"""What a run of fixed steps does does not depend on how long it goes on."""

import numpy as np
import pytest

import machines
from nivel.machine import Event
from running import run


@pytest.mark.parametrize("integrator", ["rk4", "newmark"])
def test_the_duration_changes_nothing(integrator):
    stopping = machines.four_bar().replace(events=(Event(name="stop", when="time - 0.3", stop=True),))
    short, long = (
        run(stopping, integrator=integrator, step=1e-3, duration=duration, output_interval=0.01)
        for duration in (20.0, 1e5)
    )
    assert short.finished.outcome == long.finished.outcome == "done"
    np.testing.assert_array_equal(short.frames, long.frames)
