"""The balance of energy of each part of a machine that nothing joins to the others, against its own energy: a flywheel hides no pendulum.

Parts are judged on which weight alone acts. Of others frames do not tell the work: a vibration may be in the same phase in all of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.machine.core.vectors import cross
from nivel.results.scales import Readable, largest_mechanical_energy, rotated

Array = NDArray[np.float64]
LEAST = 1e-14  # of the largest energy of the machine: round-off
FRAMES = 20_000  # that are looked at, at most
BACK = np.array([1.0, -1.0, -1.0, -1.0])


@dataclass(frozen=True)
class Part:
    """Rigid bodies that joints and forces join to each other, and to no others but the ground: mass (b,) [kg], centre (b, 3) [m] and
    inertia (b, 3, 3) [kg m²] about it, body axes; gravity (3,) [m/s²]."""

    bodies: tuple[str, ...]
    mass: Array
    centre: Array
    inertia: Array
    gravity: Array


@dataclass(frozen=True)
class PartError:
    """A part whose energy is wrong by `error` [J] at `time` [s], and its own energy [J]."""

    body: str
    error: float
    energy: float
    time: float

    @property
    def share(self) -> float:
        return self.error / self.energy


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def worst_part(result: Readable, parts: Sequence[Part], slowest: float) -> PartError | None:
    """The part with the largest share; those slower than `slowest` [m/s] are at rest. Parts with most of the energy are judged by that of
    the whole machine."""
    if not len(result.time):
        return None
    whole = largest_mechanical_energy(result)
    found = [_error(result, part, slowest, whole) for part in parts]
    return max((each for each in found if each is not None), key=lambda each: each.share, default=None)


def _error(result: Readable, part: Part, slowest: float, whole: float) -> PartError | None:
    frames = slice(None, None, max(1, len(result.time) // FRAMES))
    kinetic, potential = _energies(result, part, frames)
    error = np.abs(kinetic + potential - (kinetic + potential)[0])
    own = float(max(kinetic.max(), np.abs(potential - potential[0]).max()))
    if not np.isfinite(own) or own >= 0.5 * whole or own <= max(0.5 * part.mass.sum() * slowest**2, LEAST * whole):
        return None
    k = int(np.argmax(error))
    return PartError(part.bodies[0], float(error[k]), own, float(result.time[frames][k]))


def _energies(result: Readable, part: Part, frames: slice) -> tuple[Array, Array]:
    """Kinetic energy and that of weight (t,) [J]."""
    places = [result.coordinates["body"].index(name) for name in part.bodies]
    position, theta, velocity, omega = (
        result.array(name, frames)[:, places] for name in ("position", "orientation", "velocity", "angular_velocity")
    )
    arm = rotated(theta, part.centre)
    speed, spin = velocity + cross(omega, arm), rotated(theta * BACK, omega)
    turning = np.einsum("tbi,bij,tbj->t", spin, part.inertia, spin, optimize=True)
    kinetic = 0.5 * np.einsum("b,tbi,tbi->t", part.mass, speed, speed, optimize=True) + 0.5 * turning
    return kinetic, -np.einsum(
        "b,tbi,i->t", part.mass, position + arm - (position + arm)[0], part.gravity, optimize=True
    )
