"""A frame on a body in words."""

from __future__ import annotations

from typing import ClassVar

from pydantic import Field, model_validator

from nivel.machine.axes import check_axis_pair
from nivel.machine.orientation import Orientation
from nivel.machine.quantity import Direction, Position, fault
from nivel.machine.record import Name, Record


class Marker(Record):
    """A point and axes fixed in a body. Joints act along the marker's z axis.

    Its axes are turned by `orientation`, or have z along `axis` and x along `x_axis` made perpendicular; default the
    body's axes.
    """

    collection: ClassVar[str] = "markers"

    name: Name | None = Field(default=None, description="not needed where the marker stands inside a joint")
    body: Name = Field(description="a body, or `ground`")
    position: Position = Field(default=(0.0, 0.0, 0.0), description="in the body frame")
    orientation: Orientation | None = Field(default=None, description="of the marker in the body frame")
    axis: Direction | None = Field(default=None, description="z axis of the marker in the body frame, of any length")
    x_axis: Direction | None = Field(default=None, description="x axis, made perpendicular to `axis`")

    @model_validator(mode="after")
    def _one_way(self) -> Marker:
        if self.orientation is not None and (self.axis is not None or self.x_axis is not None):
            raise fault("give `orientation` or `axis`, not both")
        check_axis_pair(self.axis, self.x_axis)
        return self
