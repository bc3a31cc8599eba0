"""What the elements of beams are too long for: curvatures that change within an element, which linear elements take for constant.

What they miss is estimated by neighbours, as by a mesh of half the elements (Zienkiewicz, Zhu 1987): within an element of the length L a
curvature changes by half of what it differs by between the elements on both sides, c L, and ½ C c² L³/12 of bending energy is not there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.results.trust.scales import Readable, largest_mechanical_energy

Array = NDArray[np.float64]
FRAMES = 200  # that are looked at, at most
LEAST_ELEMENTS = 2  # that have neighbours


@dataclass(frozen=True)
class BeamMesh:
    """A beam of linear elements: nodes, their names from start to end; length (n,) [m] of the elements; stiffness (3,) [N m²] for twist and
    both curvatures; unstressed (n, 3) rotation vectors of each node against the one before."""

    name: str
    nodes: tuple[str, ...]
    length: Array
    stiffness: Array
    unstressed: Array


@dataclass(frozen=True)
class Coarse:
    """A beam whose elements miss the share `share` of the largest energy of the machine, or of their own where that is larger, most at
    `time` [s]."""

    beam: str
    share: float
    time: float
    elements: int


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def coarsest(result: Readable, beams: Sequence[BeamMesh]) -> Coarse | None:
    """The beam whose elements miss most."""
    found, energy = None, largest_mechanical_energy(result)
    stride = max(1, len(result.time) // FRAMES)
    names = result.coordinates.get("body", ())
    for beam in beams:
        if len(beam.length) < LEAST_ELEMENTS:
            continue
        theta = result.array("orientation")[::stride, [names.index(each) for each in beam.nodes]]
        curvature = (turns(theta) - beam.unstressed) / beam.length[:, None]
        middle = np.cumsum(beam.length) - 0.5 * beam.length
        change = np.gradient(curvature, middle, axis=1)
        missed = np.nan_to_num(0.5 * (change**2 * beam.stiffness).sum(axis=2) @ beam.length**3 / 12.0)
        own = np.nan_to_num(0.5 * (curvature**2 * beam.stiffness).sum(axis=2) @ beam.length)
        k = int(np.argmax(missed))
        share = float(missed[k]) / max(energy, float(own.max()), 1e-300)
        if found is None or share > found.share:
            found = Coarse(beam.name, share, float(result.time[k * stride]), len(beam.length))
    return found


def turns(theta: Array) -> Array:
    """(…, n - 1, 3) [rad] rotation vectors of frames with Euler parameters (…, n, 4) against the one before each, in its axes."""
    a, b = theta[..., :-1, :], theta[..., 1:, :]
    s = np.sum(a * b, axis=-1, keepdims=True)
    v = a[..., :1] * b[..., 1:] - b[..., :1] * a[..., 1:] - np.cross(a[..., 1:], b[..., 1:])
    v = np.where(s < 0.0, -v, v)
    sine = np.linalg.norm(v, axis=-1, keepdims=True)
    return v * np.where(sine > 1e-12, 2.0 * np.arctan2(sine, np.abs(s)) / np.maximum(sine, 1e-300), 2.0)
