"""Rigid wheels that sink into soil (`nivel.elements.contacts.on_soil`)."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Literal

from nivel.elements.contacts.on_soil import WheelRow, apply
from nivel.elements.contacts.soil import CHANGES_OUT, ON_SOIL, OnSoil, add_soil
from nivel.elements.kind import Kind
from nivel.elements.output import Output, add_outputs, of_force
from nivel.machine.core.marker import MarkerPlace
from nivel.machine.given import Field
from nivel.machine.units.quantity import PositiveLength

if TYPE_CHECKING:
    from nivel.system.builder import SystemBuilder


class SoilWheel(OnSoil):
    """A rigid wheel, or a tyre that is hard beside the soil: pressure by sinkage, and shear, cell by cell."""

    outputs: ClassVar[tuple[str, ...]] = (
        *of_force("load across the plane"),
        Output("longitudinal", "N", "force on the wheel in the direction in which it points"),
        Output("lateral", "N", "force on the wheel to the side to which its marker's z axis points"),
        Output("moment", "N m", "moment on the wheel about its axle"),
        Output("sinkage", "m", "greatest, below the soil as it was laid"),
        *ON_SOIL,
    )
    turns: ClassVar[bool] = True

    type: Literal["soil-wheel"] = "soil-wheel"
    wheel: MarkerPlace = Field(description="marker on the wheel: its point is the centre, its z axis the axle")
    radius: PositiveLength
    width: PositiveLength


def add(builder: SystemBuilder, force: SoilWheel) -> None:
    """A wheel."""
    first = add_outputs(builder, force)
    own = add_soil(builder, force, first + CHANGES_OUT)
    builder.add(
        apply, WheelRow(output=first, wheel=builder.end(force.wheel), radius=force.radius, width=force.width, **own)
    )


KINDS = (Kind(SoilWheel, add, (apply,)),)
