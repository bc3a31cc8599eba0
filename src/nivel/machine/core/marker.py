"""A frame on a body in words."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, ClassVar

from pydantic import BeforeValidator

from nivel.machine.bodies.shape import Shape, Standing
from nivel.machine.core.orientation import Orientation
from nivel.machine.core.placement import bad_axis_pair
from nivel.machine.core.record import GROUND, BodyName, Checked, Name, Problem
from nivel.machine.given import Field, Given, Maybe, OneRecord
from nivel.machine.units.quantity import Direction, Position, fault, shown


class Marker(Checked):
    """A point and axes fixed in a body. Joints act along the marker's z axis.

    Its axes are turned by `orientation`, or have z along `axis` and x along `x_axis` made perpendicular; default the
    body's axes.
    """

    collection: ClassVar[str] = "markers"
    tagged = {"shape": 1}  # noqa: RUF012

    name: Name | None = Field("not needed where the marker stands inside an element", default=None)
    body: BodyName = Field("a body, a station of a beam `BEAM.STATION`, or `ground`")
    position: Position = Field("in the body frame", default=(0.0, 0.0, 0.0))
    interface: Name | None = Field("of a flexible body, by name, instead of `position`", default=None)
    orientation: Maybe[OneRecord[Orientation]] = Field("of the marker in the body frame", default=None)
    axis: Maybe[Direction] = Field("z axis of the marker in the body frame, of any length", default=None)
    x_axis: Maybe[Direction] = Field("x axis, made perpendicular to `axis`", default=None)
    shape: Maybe[OneRecord[Shape]] = Field(
        "a solid in the frame of the marker, which contacts that name the marker touch with; not drawn", default=None
    )

    def problems(self) -> Iterator[Problem]:
        if self.name == GROUND:
            yield Problem(("name",), f"`{GROUND}` is the fixed world and cannot be a marker")
        if self.interface is not None and any(self.position):
            yield Problem(("position",), "give `position` or `interface`, not both", at_key=True)
        if self.shape is not None and self.interface is not None:
            yield Problem(
                ("shape",), "of a flexible body its own `shape` touches, about a `centre` that is at an interface"
            )
        if self.shape is not None and not isinstance(self.shape, Standing) and self.shape.from_ is not None:
            yield Problem(
                ("shape",), "the shape stands in the frame of the marker, at its `centre`: `from` and `to` are global"
            )
        if self.orientation is not None and (self.axis is not None or self.x_axis is not None):
            yield Problem(("orientation",), "give `orientation` or `axis`, not both")
            return
        yield from bad_axis_pair(self.axis, self.x_axis)


def _name_or_marker(value: Any) -> Any:
    if isinstance(value, str | Marker | dict):
        return value
    raise fault(f"the name of a marker, or a marker {{body: …, position: …}}, was expected, got {shown(value)}")


MarkerPlace = Annotated[
    Given[Name | Marker, str | Marker, str | Marker | Mapping[str, Any]], BeforeValidator(_name_or_marker)
]
ManyMarkers = Given[tuple[MarkerPlace, ...], tuple[str | Marker, ...], Sequence[str | Marker | Mapping[str, Any]]]
TwoMarkers = Given[
    tuple[MarkerPlace, MarkerPlace], tuple[str | Marker, str | Marker], Sequence[str | Marker | Mapping[str, Any]]
]
