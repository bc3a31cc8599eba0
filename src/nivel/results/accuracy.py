"""How exact a run is, estimated by running it again with half the step, or with a tenth of the tolerance."""

from __future__ import annotations

import numpy as np

from nivel.results.motion import Motion, distance
from nivel.results.scales import Readable, machine_size
from nivel.results.trust import Peak


def step_halving(result: Readable, finer: Readable, order: int) -> Peak:
    """As `error_from_finer`, for a run with half the step and an integrator of order p: 2⁻ᵖ of the error is left."""
    return error_from_finer(result, finer, 0.5**order)


@np.errstate(over="ignore", invalid="ignore")  # a run that grew beyond all bounds is red, not a warning
def error_from_finer(result: Readable, finer: Readable, left: float) -> Peak:
    """Estimated largest error of the positions of `result` [m], with its body and time.

    finer : a run whose error is the share `left` of that of `result`, so that their difference is 1 - left of it; it has frames at the
    times of `result`, as far as it got.
    A body is off by the distance of its two origins, or by the angle between its two orientations times the machine's
    size, whichever is larger: a rotor whose origin rests counts too.
    """
    size = machine_size(result)[0]
    apart = distance(Motion.of(result), Motion.of(finer), size)
    return Peak(apart.value * size / (1.0 - left), apart.row, apart.time)
