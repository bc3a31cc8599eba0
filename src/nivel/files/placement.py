"""Placement of a part in an assembly: mirrored in the part's own axes, turned, moved.

x' = t + R P x for points of the part, P = diag(±1) the reflection (1 where nothing is mirrored), R the rotation.
Directions, velocities and forces follow R P; angular velocities, torques and axes that something turns about are
axial vectors and follow det(P) R P.

A body frame A becomes A' = R P A P, which is right-handed, so that coordinates in the body frame become s' = P s, those
of axial vectors det(P) P s, and inertia tensors P I P. An axis system C fixed in a body (a marker) becomes R P C F.
Where P mirrors, F turns one axis around (or all three), since the mere image R P C is left-handed:

    AXIAL_Z   x and y are images, z is the axial image: what turned about z by an angle still does
    POLAR_Z   x and z are images: what moved along z by a displacement still does
    AXIAL     all three are axial images
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nivel.machine.core.orientation import Orientation, euler_parameters_from_matrix, rotation_matrix

Array = NDArray[np.float64]
Triple = tuple[float, float, float]

AXIAL_Z: Final = (1.0, 1.0, -1.0)
POLAR_Z: Final = (1.0, -1.0, 1.0)
AXIAL: Final = (-1.0, -1.0, -1.0)
_ROUND: Final = 1e-14  # quarter turns are exact


@dataclass(frozen=True)
class Placement:
    """translation (3,) [m]; rotation (3, 3); reflection (3,) of ±1, in the part's axes."""

    translation: Array
    rotation: Array
    reflection: Array

    @classmethod
    def of(cls, position: Triple, orientation: Orientation | None, mirror: str) -> Placement:
        """As an assembly gives it; `mirror` is x, y, z or none."""
        rotation = rotation_matrix(orientation)
        nearest = np.round(rotation)
        rotation = np.where(np.abs(rotation - nearest) < _ROUND, nearest + 0.0, rotation)
        reflection = np.array([-1.0 if axis == mirror else 1.0 for axis in "xyz"])
        return cls(np.array(position, dtype=float), rotation, reflection)

    @cached_property
    def mirrored(self) -> bool:
        """Whether the part is mirrored."""
        return bool(np.any(self.reflection < 0))

    @cached_property
    def turns(self) -> bool:
        """Whether directions change."""
        return self.mirrored or not np.array_equal(self.rotation, np.eye(3))

    @cached_property
    def changes(self) -> bool:
        """Whether anything changes."""
        return self.turns or bool(np.any(self.translation))

    @cached_property
    def handedness(self) -> float:
        """det P: -1 where mirrored."""
        return float(np.prod(self.reflection))

    @cached_property
    def polar(self) -> Array:
        """(3, 3) R P, for directions."""
        return self.rotation * self.reflection

    @cached_property
    def axial(self) -> Array:
        """(3, 3) det(P) R P, for what something turns about."""
        return self.handedness * self.polar

    def point(self, point: ArrayLike) -> Triple:
        """A global point of the part."""
        return triple(self.translation + self.polar @ np.asarray(point, dtype=float))

    def direction(self, direction: ArrayLike) -> Triple:
        """A direction, velocity or force in global axes."""
        return triple(self.polar @ np.asarray(direction, dtype=float))

    def turning(self, vector: ArrayLike) -> Triple:
        """An axis of turning, angular velocity or torque in global axes."""
        return triple(self.axial @ np.asarray(vector, dtype=float))

    def in_body(self, vector: ArrayLike) -> Triple:
        """A point or direction in the frame of a body that moves."""
        return triple(self.reflection * np.asarray(vector, dtype=float))

    def turning_in_body(self, vector: ArrayLike) -> Triple:
        """An angular velocity or torque in the frame of a body that moves."""
        return triple(self.handedness * self.reflection * np.asarray(vector, dtype=float))

    def body_frame(self, axes: Array) -> Orientation:
        """The frame of a body, from its axes (3, 3)."""
        return orientation_of(self.polar @ axes * self.reflection)

    def axes(self, axes: Array, kept: Triple = AXIAL_Z, *, on_ground: bool) -> Orientation:
        """Axes (3, 3), columns in the frame of their body, which for `ground` is global."""
        flip = np.array(kept) if self.mirrored else np.ones(3)
        image = (self.polar if on_ground else np.diag(self.reflection)) @ axes
        return orientation_of(image * flip)


def orientation_of(axes: Array) -> Orientation:
    """A rotation matrix (3, 3) as a record."""
    w, x, y, z = (float(each) for each in euler_parameters_from_matrix(axes))
    return Orientation(euler_parameters=(w, x, y, z))


def triple(vector: Sequence[float] | Array) -> Triple:
    """Three numbers as a record holds them, without negative zeros."""
    x, y, z = (float(each) + 0.0 for each in vector)
    return x, y, z
