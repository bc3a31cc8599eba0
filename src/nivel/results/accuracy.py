"""How exact a run is, estimated by running it again with half the step."""

from __future__ import annotations

import numpy as np

from nivel.results.motion import Motion, distance
from nivel.results.scales import Readable, machine_size
from nivel.results.trust import Peak


@np.errstate(over="ignore", invalid="ignore")  # a run that grew beyond all bounds is red, not a warning
def step_halving(result: Readable, finer: Readable, order: int) -> Peak:
    """Estimated largest error of the positions of `result` [m], with its body and time.

    finer : the run with half the step; it has frames at the times of `result`, as far as it got.
    order : p of the integrator: the difference of the two runs is 1 - 2⁻ᵖ of the error of the coarser one.
    A body is off by the distance of its two origins, or by the angle between its two orientations times the machine's
    size, whichever is larger: a rotor whose origin rests counts too.
    """
    size = machine_size(result)[0]
    apart = distance(Motion.of(result), Motion.of(finer), size)
    return Peak(apart.value * size / (1.0 - 0.5**order), apart.row, apart.time)
