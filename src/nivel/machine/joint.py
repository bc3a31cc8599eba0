"""A joint in words: which two bodies, where, and what motion stays free."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, Final, Literal

from pydantic import BeforeValidator, Field, model_validator

from nivel.machine.axes import check_axis_pair, check_direction
from nivel.machine.marker import Marker
from nivel.machine.placement import angle_between
from nivel.machine.quantity import Direction, Position, fault, shown
from nivel.machine.record import Name, Record

JointType = Literal["spherical", "universal", "revolute", "cylindrical", "translational", "fixed"]

WITH_AXIS: Final = ("revolute", "cylindrical", "translational")
PERPENDICULAR: Final = 1e-3  # [rad] by which the two axes of a universal joint may miss the right angle


def _name_or_marker(value: Any) -> Any:
    if isinstance(value, str | Marker | dict):
        return value
    raise fault(f"the name of a marker, or a marker {{body: …, position: …}}, was expected, got {shown(value)}")


_MarkerPlace = Annotated[Name | Marker, BeforeValidator(_name_or_marker)]


class Joint(Record):
    """Two bodies that can move against each other only in the way of the `type`.

    Placed by `bodies` and a global `point` (and `axis` or `axes`) at the bodies' given positions, or by two
    `markers`, whose z axes are the joint's axis. The first body comes first in both.
    """

    collection: ClassVar[str] = "joints"

    name: Name
    type: JointType
    bodies: tuple[Name, Name] | None = Field(default=None, description="first and second body; one may be `ground`")
    markers: tuple[_MarkerPlace, _MarkerPlace] | None = Field(
        default=None, description="on the first and second body: names or markers"
    )
    point: Position | None = Field(default=None, description="of the joint, global")
    axis: Direction | None = Field(
        default=None, description="of revolute, cylindrical, translational; global, of any length"
    )
    axes: tuple[Direction, Direction] | None = Field(
        default=None,
        description="cross of a universal joint: arm on the first body, arm on the second; global, perpendicular",
    )
    x_axis: Direction | None = Field(
        default=None, description="where the joint's x axis points, made perpendicular to `axis`; global"
    )

    @model_validator(mode="after")
    def _makes_sense(self) -> Joint:
        if self.markers is not None:
            for name in ("bodies", "point", "axis", "axes", "x_axis"):
                if getattr(self, name) is not None:
                    raise fault(f"`{name}` must not be given with `markers`, which say where the joint is")
            return self
        if self.bodies is None or self.point is None:
            raise fault("a joint needs `bodies` and a `point`, or two `markers`")
        if self.bodies[0] == self.bodies[1]:
            raise fault(f"`bodies`: a joint needs two different bodies, got `{self.bodies[0]}` twice")
        self._check_axes()
        return self

    def _check_axes(self) -> None:
        if self.type in WITH_AXIS and self.axis is None:
            raise fault(f"`axis` is missing: a {self.type} joint at a point needs one")
        if self.type == "universal" and self.axes is None:
            raise fault("`axes` is missing: a universal joint at a point needs two, e.g. [[0, 1, 0], [0, 0, 1]]")
        if self.type not in WITH_AXIS and (self.axis is not None or self.x_axis is not None):
            word = "axis" if self.axis is not None else "x_axis"
            hint = "; its two arms are `axes`" if self.type == "universal" else ""
            raise fault(f"a {self.type} joint has no `{word}`{hint}")
        if self.type != "universal" and self.axes is not None:
            raise fault(f"a {self.type} joint has no `axes`{'; write `axis`' if self.type in WITH_AXIS else ''}")
        check_axis_pair(self.axis, self.x_axis)
        if self.axes is not None:
            for axis in self.axes:
                check_direction("axes", axis)
            angle = angle_between(*self.axes)
            if abs(angle - math.pi / 2) > PERPENDICULAR:
                raise fault(
                    f"`axes` of a universal joint are perpendicular; these are {math.degrees(angle):.4g} deg apart"
                )
