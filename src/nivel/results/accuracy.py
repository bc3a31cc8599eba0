"""How exact a run is, estimated by running it again with half the step."""

from __future__ import annotations

import numpy as np

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
    if "position" not in result.variables or not len(finer.time) or not len(result.time):
        return Peak(0.0)
    tolerance = 1e-9 * max(abs(float(finer.time[-1])), abs(float(result.time[-1])))
    time = result.time[result.time <= finer.time[-1] + tolerance]
    nearest = np.searchsorted(finer.time, time - tolerance)
    frames = slice(0, len(time))
    moved = np.linalg.norm(result.array("position", frames) - finer.array("position")[nearest], axis=-1)
    a, b = result.array("orientation", frames), finer.array("orientation")[nearest]
    apart = np.minimum(
        np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1)
    )  # θ and -θ are the same orientation
    difference = np.maximum(moved, 2.0 * apart * machine_size(result)[0])
    k, body = np.unravel_index(int(np.argmax(difference)), difference.shape)
    error = float(difference[k, body]) / (1.0 - 0.5**order)
    return Peak(error, result.coordinates["body"][body], float(time[k]))
