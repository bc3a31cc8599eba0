"""Homogeneous solids: box, cylinder, sphere, tube. They give a body its looks and, with a density or mass, its inertia.

A shape stands in the body frame with its centre at `centre`. Box, cylinder and tube may instead be laid between two
global points `from:` and `to:`; then they define the body frame too (placement.py) and the centre is its origin.
"""

from __future__ import annotations

from typing import Annotated, Final, Literal

import numpy as np
from pydantic import Field, model_validator

from nivel.machine.quantity import Position, PositiveLength, fault
from nivel.machine.record import Record

Along = Literal["x", "y", "z"]
_NEAR: Final = 1e-9  # [m] two end points closer than this have no direction

_FROM = Field(
    default=None, alias="from", description="global point where the body x axis starts; then the body needs no position"
)
_TO = Field(default=None, description="global point to which the body x axis points")
_CENTRE = Field(default=None, description="centre of the shape in the body frame; default the origin")


class _Between(Record):
    """A shape that may be laid between two points."""

    from_: Position | None = _FROM
    to: Position | None = _TO
    centre: Position | None = _CENTRE

    @model_validator(mode="after")
    def _whole(self) -> _Between:
        if (self.from_ is None) != (self.to is None):
            raise fault("`from` and `to` belong together")
        extent = self._extent()
        if self.from_ is None or self.to is None:
            missing = [name for name, value in extent.items() if value is None]
            if missing:
                raise fault(f"{' and '.join(f'`{name}`' for name in missing)} or `from` and `to` must be given")
            return self
        given = [name for name, value in {**extent, "centre": self.centre}.items() if value is not None]
        if given:
            raise fault(f"`{given[0]}` follows from `from` and `to` and must not be given")
        if np.linalg.norm(np.subtract(self.to, self.from_)) < _NEAR:
            raise fault("`from` and `to` are the same point")
        return self

    def _extent(self) -> dict[str, object]:
        """The fields that say how long the shape is when no two points do."""
        raise NotImplementedError


class Box(_Between):
    """A block: `size` along the body x, y, z axes; or `from`, `to`, `width` (along y) and `height` (along z)."""

    type: Literal["box"] = "box"
    size: tuple[PositiveLength, PositiveLength, PositiveLength] | None = None
    width: PositiveLength | None = None
    height: PositiveLength | None = None

    def _extent(self) -> dict[str, object]:
        return {"size": self.size}

    @model_validator(mode="after")
    def _cross_section(self) -> Box:
        for name in ("width", "height"):
            given = getattr(self, name) is not None
            if given and self.from_ is None:
                raise fault(f"`{name}` belongs to a box between `from` and `to`; this one has a `size`")
            if not given and self.from_ is not None:
                raise fault(f"`{name}` is missing")
        return self


class Cylinder(_Between):
    """A round bar: `radius`, `length` and the body axis it lies `along` (default x); or `radius`, `from` and `to`."""

    type: Literal["cylinder"] = "cylinder"
    radius: PositiveLength
    length: PositiveLength | None = None
    along: Along | None = Field(default=None, description="body axis; default x")

    def _extent(self) -> dict[str, object]:
        return {"length": self.length}

    @model_validator(mode="after")
    def _along_x(self) -> Cylinder:
        _refuse_along(self)
        return self


class Tube(_Between):
    """A hollow round bar: `outer_radius`, `inner_radius`, `length` and `along` (default x); or the radii, `from` and
    `to`.
    """

    type: Literal["tube"] = "tube"
    outer_radius: PositiveLength
    inner_radius: PositiveLength
    length: PositiveLength | None = None
    along: Along | None = Field(default=None, description="body axis; default x")

    def _extent(self) -> dict[str, object]:
        return {"length": self.length}

    @model_validator(mode="after")
    def _hollow(self) -> Tube:
        if self.inner_radius >= self.outer_radius:
            raise fault(
                f"`inner_radius` {self.inner_radius:g} m must be smaller than `outer_radius` {self.outer_radius:g} m"
            )
        _refuse_along(self)
        return self


class Sphere(Record):
    """A solid ball: `radius`."""

    type: Literal["sphere"] = "sphere"
    radius: PositiveLength
    centre: Position | None = _CENTRE


Shape = Annotated[Box | Cylinder | Sphere | Tube, Field(discriminator="type")]


def _refuse_along(shape: Cylinder | Tube) -> None:
    if shape.along is not None and shape.from_ is not None:
        raise fault("`along` must not be given: between `from` and `to` the shape lies along the body x axis")
