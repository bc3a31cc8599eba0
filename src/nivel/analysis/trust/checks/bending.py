"""Limits of modes in a run: fast turns without geometric stiffness, bending that is not small."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.trust.check import FRAMES as STATES
from nivel.analysis.trust.check import STEPS, Check
from nivel.analysis.trust.flexible_bodies import Bent, ModalBody, modal_bodies
from nivel.analysis.trust.subject import Equilibria, Run
from nivel.results.scales import Readable
from nivel.results.trust import Item, Threshold, number

Array = NDArray[np.float64]
FRAMES = 500  # that bending is looked at in, at most
STIFFENING = Threshold(
    1e-2,
    1e-1,
    "Centrifugal forces increase the stiffness of a slender body by about this share. Stiffness is known to about a hundredth; a tenth "
    "is visible.",
)
BENDING = Threshold(
    5e-2,
    2e-1,
    "A body that bends by the share x of its length becomes shorter by about x²/2 of its length: 1e-3 for x = 0.05, a fiftieth for "
    "x = 0.2. Linear modes do not include this.",
)


def say_stiffening(found: Bent) -> Item:
    """How fast a body turns that has no geometric stiffness."""
    said = (
        f"Stiffening: {found.body} has no geometric stiffness; at t = {found.time:.6g} s the square of its rotational speed is "
        f"{number(found.value)} of that of its lowest frequency; reduce it with `stiffening: true`"
    )
    return STIFFENING.item("stiffening", said, found.value, found.time, found.body)


def say_bending(found: Bent) -> Item:
    """How far a body bends."""
    said = (
        f"Bending: {found.body} bends by {number(found.value)} of its size at t = {found.time:.6g} s, but modes describe small "
        f"displacements: use a beam in its place, or several bodies"
    )
    return BENDING.item("bending", said, found.value, found.time, found.body)


def look_for_stiffening(run: Run) -> Bent | None:
    """The largest (Ω/ω₁)² of bodies without geometric stiffness: Ω is the angular velocity across the body's length, ω₁ its lowest
    frequency.

    Centrifugal forces stiffen a body that is long across its spin by about that share (Southwell, Gough 1921).
    """
    found, result = None, run.result
    names = result.coordinates.get("body", ())
    for each in modal_bodies(run.machine):
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


def look_for_bending(subject: Run | Equilibria) -> Bent | None:
    """The largest displacement of a node against the extent of its body."""
    found = [most_bent(subject.result, each) for each in modal_bodies(subject.machine)]
    return max(found, key=lambda each: each.value, default=None)


def most_bent(result: Readable, body: ModalBody) -> Bent:
    """The largest displacement of a node of a body."""
    stride = max(1, len(result.time) // FRAMES)
    q = result.array("modal_coordinate")[::stride, body.first : body.last]
    moved = np.linalg.norm(np.einsum("aij,tj->tai", body.modes, q, optimize=True), axis=2).max(axis=1)
    frame = int(np.argmax(np.nan_to_num(moved)))
    return Bent(body.name, float(moved[frame]) / max(body.extent, 1e-300), float(result.time[frame * stride]))


def _turned(theta: Array, axis: Array) -> Array:
    """(n, 3) a direction of the body in global axes, for Euler parameters (n, 4)."""
    e0, e = theta[:, :1], theta[:, 1:]
    t = 2.0 * np.cross(e, axis)
    return axis + e0 * t + np.cross(e, t)


CHECKS = (
    Check("stiffening", Run, look_for_stiffening, say_stiffening, 260, (STEPS,), "Stiffening", STIFFENING, quiet=True),
    Check("bending", (Run, Equilibria), look_for_bending, say_bending, 270, (STATES,), "Bending", BENDING, quiet=True),
)
