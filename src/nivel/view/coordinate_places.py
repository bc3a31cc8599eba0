"""Places of joint coordinates in the picture: their joint, the bodies and points there, and the axis along or about which it counts."""

from typing import Any

import numpy as np

from nivel.lazy import Struct
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS, Kind, UnknownCoordinateError, find
from nivel.view.records import Joint, Triple


class CoordinatePlace(Struct):
    """A coordinate's joint and word; axis : in the first body's frame; kind : whether it turns about the axis or goes along it."""

    joint: Joint
    word: str
    axis: Triple
    kind: Kind

    @property
    def name(self) -> str:
        """As the result calls it."""
        return f"{self.joint.name}.{self.word}"


def coordinate_place(reference: Any, joints: list[Joint], kind: Kind | None = None) -> CoordinatePlace | None:
    """The place of the coordinate that a machine's record mentions; None where the picture has no such joint."""
    by_name = {joint.name: joint for joint in joints}
    if not isinstance(reference, str):
        return None
    try:
        name, word = find(reference, {joint.name: joint.kind for joint in joints}, kind)
    except UnknownCoordinateError:
        return None
    joint = by_name[name]
    return CoordinatePlace(joint, word, _axis(joint, word), COORDINATE_KINDS[word])


def _axis(joint: Joint, word: str) -> Triple:
    """x and y of planar motions lie across the joint's axis; all else is along or about it."""
    z, x = joint.axes[0], joint.x_axes[0] if joint.x_axes else None
    if x is None or word not in ("x", "y"):
        return z
    return x if word == "x" else (z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0])


def triple(values: Any) -> Triple:
    """Three numbers that JSON can hold: what is not finite becomes 0."""
    x, y, z = (float(value) if np.isfinite(value) else 0.0 for value in values)
    return x, y, z
