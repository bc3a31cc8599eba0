"""Fixed steps of second runs: they meet samples and frames of the first run, and are finer without halving its steps."""

from types import SimpleNamespace

import pytest

from nivel.analysis.run.attempt import subdivision


@pytest.mark.parametrize("integrator", ["rk4", "extrapolated-euler", "ab4"])
@pytest.mark.parametrize("samples", range(2, 13))
def test_steps_of_second_runs_meet_samples_and_frames(samples, integrator):
    """With one frame in so many steps: so many steps of the first run are so many of the second, at a frame of both."""
    for every in range(1, 25):
        coarse, fine = subdivision(SimpleNamespace(every=every, integrator=integrator, steps=10**6), samples)
        assert fine > coarse
        assert coarse % every == 0
        assert samples * fine % coarse == 0
        if samples % 2 == 0 and integrator != "ab4":  # every frame, or every second one
            assert coarse // every <= 2


def test_frames_that_are_not_multiples_of_samples_are_compared_every_second_time():
    """Samples of 10 steps and frames of 7 were compared in one frame of five: 35 steps of the first run."""
    settings = SimpleNamespace(every=7, integrator="extrapolated-euler", steps=6200)
    assert subdivision(settings, 10) == (14, 21)
