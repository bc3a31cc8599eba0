"""The touching parts of a contact: the shape of a body, or of a marker on one, and where it is in the body."""

from typing import Final

import numpy as np

from nivel.known import Body, Marker, Shape
from nivel.lazy import Struct, field
from nivel.machine.core.placement import marker_frame
from nivel.machine.core.vectors import Array

HULLS: Final = ("box", "cylinder", "extrusion", "mesh")  # that touch each other, with their convex hulls
ROUND: Final = ("sphere", "capsule", "ellipsoid")  # that touch everything at the nearest points
SHAPES_ON_PLANE: Final = (*ROUND, *HULLS)


class Touching(Struct):
    """name : of the body or marker whose `shape` touches. body : on which it is. position (3,) [m], axes (3, 3) : of the frame of the
    shape in that of the body."""

    name: str
    body: str
    shape: Shape | None
    position: Array = field(default_factory=lambda: np.zeros(3))
    axes: Array = field(default_factory=lambda: np.eye(3))

    @classmethod
    def of_body(cls, body: Body) -> "Touching":
        """The shape of a body."""
        return cls(body.name, body.name, body.shape)

    @classmethod
    def of_marker(cls, marker: Marker) -> "Touching":
        """The shape of a marker."""
        return cls(marker.name or "", marker.body, marker.shape, *marker_frame(marker))

    @property
    def place(self) -> str:
        """Where the shape stands in the machine."""
        return f"{'bodies' if self.name == self.body else 'markers'}.{self.name}.shape"

    def at(self, point: Array, axes: Array) -> tuple[str, Array, Array]:
        """Body, point and axes in it, of a point and axes in the frame of the shape."""
        return self.body, self.position + self.axes @ point, self.axes @ axes
