"""What a run of fixed steps does does not depend on how long it goes on; what was computed before a failure is kept."""

import numpy as np
import pytest

import machines
from nivel import Event, PointForce
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


@pytest.mark.parametrize("integrator", ["rk4", "radau", "generalised-alpha"])
def test_the_last_state_before_a_failure_is_kept(integrator):
    """A force that is no number beyond 0.2345 s; frames are a tenth of a second apart."""
    machine = machines.four_bar()
    push = PointForce(name="push", body=machine.bodies[1].name, vector=("sqrt(0.2345 - time)", 0, 0))
    r = run(
        machine.replace(forces=(*machine.forces, push)),
        integrator=integrator, step=1e-3, duration=1.0, output_interval=0.1,
    )  # fmt: skip
    assert r.finished.outcome == "failed"
    assert 0.2 < r.time[-1] <= 0.2345
    assert r.time[-1] == r.finished.failure[2]
    assert np.isfinite(r.frames).all()
    assert np.abs(r.constraint_violation[-1]).max() < 1e-8
