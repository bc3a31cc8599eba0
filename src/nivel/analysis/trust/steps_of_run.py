"""Steps of a run up to its last frame, as the checks look at them."""

from __future__ import annotations

from nivel.analysis.curves.corners import corners
from nivel.analysis.curves.path import Steps, steps_between, steps_of
from nivel.analysis.trust.subject import Run


def steps_of_run(run: Run) -> Steps | None:
    """The steps of a run; None where it has not left its start. Those that were chosen are known where the run has looked at them."""
    end, ends = float(run.result.time[-1]), run.finished.ends
    if not end > 0.0:
        return None
    if ends is not None and len(ends) > 1:
        return steps_between(ends).until(end)
    settings = run.plan.settings
    step = settings.step if settings.steps else None
    met = corners(run.machine) if step is None or run.prepared.integrator.knows_corners else ()
    return steps_of(run.pace, settings.duration, step, met).until(end)
