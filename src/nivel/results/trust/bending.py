"""Limits of modes in a run: fast turns without geometric stiffness, bending that is not small."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.results.scales import Readable

Array = NDArray[np.float64]
FRAMES = 500  # that bending is looked at in, at most


@dataclass(frozen=True)
class ModalBody:
    """A body that bends: its modal coordinates are the columns first to last - 1 of a run. eigenvalues (n,) [1/s²]; position (N, 3) [m] and
    modes (N, 3, n) of its nodes; stiffened : whether it has geometric stiffness."""

    name: str
    first: int
    last: int
    eigenvalues: Array
    position: Array
    modes: Array
    stiffened: bool

    @property
    def extent(self) -> float:
        """The diagonal of the box around its nodes [m]."""
        return float(np.linalg.norm(np.ptp(self.position, axis=0)))

    @property
    def axis(self) -> Array:
        """(3,) the direction in which it is longest."""
        return np.linalg.svd(self.position - self.position.mean(axis=0), full_matrices=False)[2][0]


@dataclass(frozen=True)
class Bent:
    """What was found of a body, its largest value, and when [s]."""

    body: str
    value: float
    time: float


@np.errstate(over="ignore", invalid="ignore")
def fastest_unstiffened(result: Readable, bodies: Sequence[ModalBody]) -> Bent | None:
    """The largest (Ω/ω₁)² of bodies without geometric stiffness: Ω is the angular velocity across the body's length, ω₁ its lowest
    frequency.

    Centrifugal forces stiffen a body that is long across its spin by about that share (Southwell, Gough 1921).
    """
    found = None
    names = result.coordinates.get("body", ())
    for each in bodies:
        elastic = each.eigenvalues[each.eigenvalues > 1e-9 * max(float(each.eigenvalues.max()), 1e-300)]
        if each.stiffened or not len(elastic):
            continue
        k = names.index(each.name)
        theta = result.array("orientation")[:, k]
        along = _turned(theta, each.axis)
        across = np.linalg.norm(np.cross(result.array("angular_velocity")[:, k], along), axis=1)
        frame = int(np.argmax(np.nan_to_num(across)))
        value = float(across[frame] ** 2 / elastic.min())
        if found is None or value > found.value:
            found = Bent(each.name, value, float(result.time[frame]))
    return found


@np.errstate(over="ignore", invalid="ignore")
def most_bent(result: Readable, bodies: Sequence[ModalBody]) -> Bent | None:
    """The largest displacement of a node against the extent of its body."""
    found = None
    stride = max(1, len(result.time) // FRAMES)
    for each in bodies:
        q = result.array("modal_coordinate")[::stride, each.first : each.last]
        moved = np.linalg.norm(np.einsum("aij,tj->tai", each.modes, q, optimize=True), axis=2).max(axis=1)
        frame = int(np.argmax(np.nan_to_num(moved)))
        value = float(moved[frame]) / max(each.extent, 1e-300)
        if found is None or value > found.value:
            found = Bent(each.name, value, float(result.time[frame * stride]))
    return found


def _turned(theta: Array, axis: Array) -> Array:
    """(n, 3) a direction of the body in global axes, for Euler parameters (n, 4)."""
    e0, e = theta[:, :1], theta[:, 1:]
    t = 2.0 * np.cross(e, axis)
    return axis + e0 * t + np.cross(e, t)
