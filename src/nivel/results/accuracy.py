"""How exact a run is, estimated by running it again with half the step."""

from __future__ import annotations

import numpy as np

from nivel.results.assess import Peak
from nivel.results.scales import Readable, machine_size


def step_halving(result: Readable, finer: Readable) -> Peak:
    """Largest difference of two runs of the same machine at the times of `result`: length [m], body, time.

    finer : the run with half the step; it must have frames at the times of `result` (to 1e-9 of the duration).
    A body's difference is the distance of its origins, or the angle between its orientations times the machine's size,
    whichever is larger: a rotor whose origin rests counts too. For a method of order p the error of `result` is 2ᵖ /
    (2ᵖ - 1) times this, between 1 and 1.33 for order 2 and more; no correction is applied.
    """
    time, finer_time = result.time, finer.time
    if "position" not in result.variables or not len(finer_time):
        return Peak(0.0)
    time = time[time <= finer_time[-1] + 1e-9 * abs(finer_time[-1])]
    nearest = np.clip(
        np.searchsorted(finer_time, time - 1e-9 * max(abs(float(finer_time[-1])), 1e-300)), 0, len(finer_time) - 1
    )
    frames = slice(0, len(time))
    moved = np.linalg.norm(result.array("position", frames) - finer.array("position")[nearest], axis=-1)
    a, b = result.array("orientation", frames), finer.array("orientation")[nearest]
    apart = np.minimum(
        np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1)
    )  # θ and -θ are the same orientation
    difference = np.maximum(moved, 2.0 * apart * machine_size(result))
    k, body = np.unravel_index(int(np.argmax(difference)), difference.shape)
    return Peak(float(difference[k, body]), result.coordinates["body"][body], float(time[k]))
