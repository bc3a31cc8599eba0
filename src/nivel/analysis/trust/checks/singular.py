"""Positions passed in a run where constraints depend on each other that do not elsewhere: there freedoms split, and a motion may go on
either way.

The smallest singular value of the constraint rows (beside those of rows that are redundant everywhere) falls to zero there. It is looked
at in frames of the run, and between those around each of its minima on a parabola through three frames.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.redundancy import scaled_jacobian
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.trust.check import SECOND_RUN, Check
from nivel.analysis.trust.subject import Run
from nivel.results.scales import Readable
from nivel.results.trust import Item
from nivel.system.system import Array

# Machines of more rows are not looked at: a decomposition of each frame takes its third power.
MOST_ROWS, FRAMES = 80, 300
# A minimum below the first share of the middle value is looked at closely, and below the second a passage.
LOW, SINGULAR = 0.3, 2e-4
# Rows with this share of the largest part in what is lost name their joints.
PART = 0.3
SHOWN = 5  # times in a sentence
BLIND = "at t = {time} s the motion may continue in more than one way"


@dataclass(frozen=True)
class Passage:
    """A position passed at `time` [s] in which rows of `joints` depend on each other; left : of their independence, as a share."""

    time: float
    joints: tuple[str, ...]
    left: float


@dataclass(frozen=True)
class Passages:
    """All passages of a run, in the order of time."""

    every: tuple[Passage, ...]


def look(run: Run) -> Passages | None:
    """The singular positions that the run passed."""
    found = tuple(passages(run.prepared, run.result))
    return Passages(found) if found else None


def say(found: Passages) -> Item:
    """When, and which constraints depend on each other then."""
    every = found.every
    times = ", ".join(f"{each.time:.6g}" for each in every[:SHOWN]) + (" …" if len(every) > SHOWN else "")
    joints = ", ".join(dict.fromkeys(name for each in every for name in each.joints))
    text = (
        f"Singular: at t = {times} s the machine passes a position where its motion branches (constraints of {joints} depend on each "
        f"other); the computed motion continues by inertia, but a real machine may take another branch; reactions near this position are "
        f"not reliable (green if none, amber otherwise)"
    )
    return Item("singular", "amber", text, row=joints, time=every[0].time)


def passages(prepared: Prepared, result: Readable) -> Iterator[Passage]:
    """The passages of a run, in the order of time."""
    motion, rank = prepared.absolute, prepared.redundancy.rank
    rows = motion.system.machine_rows
    bodies = result.coordinates.get("body", ())
    if not 0 < rows <= MOST_ROWS or len(result.time) < 3 or len(bodies) != motion.system.body_count:
        return
    if "mode" in result.coordinates or rank < 1:
        return
    position, orientation = result.array("position"), _continuous(result.array("orientation"))

    def poses(at: float) -> tuple[float, Array]:
        """Time and positions on the parabola through the three frames next to `at`."""
        middle = int(np.clip(round(at), 1, len(result.time) - 2))
        s = at - middle
        weights = np.array([0.5 * s * (s - 1.0), 1.0 - s * s, 0.5 * s * (s + 1.0)])
        near = slice(middle - 1, middle + 2)
        theta = np.einsum("k,kbi->bi", weights, orientation[near])
        theta /= np.linalg.norm(theta, axis=1, keepdims=True)
        place = np.einsum("k,kbi->bi", weights, position[near])
        return float(weights @ result.time[near]), np.concatenate([place, theta], axis=1).ravel()

    y = prepared.assembly.y.copy()

    def decomposed(at: float) -> tuple[Array, Array]:
        time, q = poses(at)
        y[: len(q)] = q
        motion.evaluate(time, y)
        U, sizes, _ = np.linalg.svd(scaled_jacobian(motion))
        return U[:, rank - 1], sizes[rank - 1 : rank]

    stride = max(1, len(result.time) // FRAMES)
    places = np.arange(0, len(result.time), stride, dtype=float)
    for at, least in _minima(places, lambda at: float(decomposed(at)[1][0])):
        part = np.abs(decomposed(at)[0])
        owners = dict.fromkeys(motion.system.row_owner[k] for k in np.flatnonzero(part > PART * part.max()))
        yield Passage(float(poses(at)[0]), tuple(owners), least)


def _minima(places: NDArray[np.float64], value: Callable[[float], float]) -> Iterator[tuple[float, float]]:
    """Places of the minima of a function that are as good as zero against its middle value, and that share."""
    found = np.array([value(at) for at in places])
    middle = float(np.median(found))
    for k in range(1, len(found) - 1):
        if not (found[k] <= found[k - 1] and found[k] < found[k + 1] and found[k] < LOW * middle):
            continue
        at, least = _least(value, (places[k - 1], places[k + 1]))
        if least < SINGULAR * middle:
            yield at, least / middle


def _least(value: Callable[[float], float], bounds: tuple[float, float]) -> tuple[float, float]:
    """The place between the bounds where a function with a cusp is least, and its value there."""
    from scipy.optimize import minimize_scalar  # takes a fifth of a second to import

    found = minimize_scalar(value, bounds=bounds, method="bounded", options={"xatol": 1e-6})
    return float(found.x), float(found.fun)


def _continuous(theta: Array) -> Array:
    """Euler parameters (n, B, 4) with signs such that each is near the one before."""
    turned = np.sum(theta[1:] * theta[:-1], axis=2) < 0.0
    sign = np.cumprod(np.where(turned, -1.0, 1.0), axis=0)
    out = theta.copy()
    out[1:] *= sign[:, :, None]
    return out


CHECKS = (Check("singular", Run, look, say, 250, (SECOND_RUN,), "Singular position", blind=BLIND),)
