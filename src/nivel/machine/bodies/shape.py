"""Homogeneous solids: box, cylinder, capsule, tube, sphere, ellipsoid, extrusion, mesh. They give a body its looks and, with a density or
mass, its inertia.

A shape stands in the body frame with its centre at `centre`, a mesh with the origin of its file at `position`. All but spheres, ellipsoids
and meshes may instead be laid between two global points `from:` and `to:`; then they define the body frame too (placement.py) and the
centre is its origin.
"""

from __future__ import annotations

import re
from abc import abstractmethod
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal

import numpy as np
from pydantic import BeforeValidator, WithJsonSchema, model_validator

from nivel.lazy import Struct
from nivel.machine.bodies.surface import surface_arrays
from nivel.machine.core.orientation import Orientation
from nivel.machine.core.record import Record
from nivel.machine.core.vectors import Array
from nivel.machine.given import SOLID, Field, ManyCorners, Maybe, OneRecord, ThreeNumbers, TwoNumbers
from nivel.machine.units.quantity import Length, Position, PositiveLength, Whole, fault, listed, shown

# Polygons in a plane: whether they are sound, and area, centroid and second moments from their corners (Green's theorem).

NEAR = 1e-12  # of the size of a polygon: corners and areas below it are nothing


class Section(Struct):
    """area [m²], centroid (2,) [m], and second = ∫ x xᵀ dA about the centroid (2, 2) [m⁴] of a polygon."""

    area: float
    centroid: Array
    second: Array


def section(corners: Array) -> Section:
    """Of the polygon with these corners (n, 2), in either order.

    With cross products w of neighbours: A = Σ w / 2, A c = Σ w (a + b)/6, ∫ x xᵀ dA = Σ w (s sᵀ + a aᵀ + b bᵀ)/24, s = a + b.
    """
    middle = corners.mean(axis=0)
    a = corners - middle
    b = np.roll(a, -1, axis=0)
    w = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    area = 0.5 * float(w.sum())
    s = a + b
    centroid = w @ s / (6.0 * area)
    second = sum(np.einsum("n,ni,nj->ij", w, each, each) for each in (s, a, b)) / 24.0
    second = second - area * np.outer(centroid, centroid)
    return Section(abs(area), middle + centroid, np.sign(area) * second)


def bad_outline(corners: Array) -> str:
    """Why the corners (n, 2) are no polygon with an inside, or an empty text."""
    if len(corners) < 3:
        return f"at least three corners were expected, got {len(corners)}"
    size = float(np.ptp(corners, axis=0).max())
    following = np.roll(corners, -1, axis=0)
    short = np.flatnonzero(np.abs(following - corners).max(axis=1) <= NEAR * size)
    if len(short):
        return f"corner {short[0] + 1} stands twice in a row; the outline closes by itself"
    crossing = _crossing(corners, following)
    if crossing is not None:
        return f"the side from corner {crossing[0] + 1} crosses or touches the side from corner {crossing[1] + 1}"
    w = corners[:, 0] * following[:, 1] - corners[:, 1] * following[:, 0]
    return "" if abs(w.sum()) > NEAR * size**2 else "its corners lie on a line"


def _crossing(a: Array, b: Array) -> tuple[int, int] | None:
    """Two sides, from a to b each (n, 2), that are not neighbours and have a point in common."""
    n = len(a)
    for i in range(n - 1):
        others = np.arange(i + 2, n - (i == 0))
        if not len(others):
            continue
        p, q, u, v = a[i], b[i], a[others], b[others]
        sides = (_side(p, q, u) * _side(p, q, v) <= 0.0) & (_side(u, v, p) * _side(u, v, q) <= 0.0)
        near = (np.minimum(p, q) <= np.maximum(u, v)).all(axis=1) & (np.minimum(u, v) <= np.maximum(p, q)).all(axis=1)
        found = others[sides & near]
        if len(found):
            return i, int(found[0])
    return None


def _side(p: Array, q: Array, x: Array) -> Array:
    """Sign of the side of the line from p to q on which x lies."""
    return np.sign(
        (q[..., 0] - p[..., 0]) * (x[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (x[..., 0] - p[..., 0])
    )


COLOURS: Final = {
    "yellow": "#e3b02b",
    "orange": "#d9772f",
    "red": "#b8473c",
    "blue": "#3f6ea6",
    "green": "#5d8f62",
    "white": "#e6e9ec",
    "silver": "#b7bec6",
    "grey": "#858e98",
    "dark": "#3d444c",
    "brown": "#8a6a4c",
}
_DIGITS: Final = re.compile(r"#[0-9a-fA-F]{6}")


def _colour(value: Any) -> str:
    if isinstance(value, str) and (value in COLOURS or _DIGITS.fullmatch(value)):
        return value.lower()
    raise fault(f"a colour was expected, one of {', '.join(COLOURS)} or a text such as '#e3b02b'; got {shown(value)}")


Colour = Annotated[str, BeforeValidator(_colour), WithJsonSchema({"type": "string"})]


def digits_of(colour: str) -> str:
    """The colour as `#rrggbb`."""
    return COLOURS.get(colour, colour)


Along = Literal["x", "y", "z"]
MOST_PARTS: Final = 64  # convex parts of a mesh
_NEAR: Final = 1e-9  # [m] two end points closer than this have no direction

_FROM = Field("global point where the body x axis starts; then the body needs no position", default=None, key="from")
_TO = Field("global point to which the body x axis points", default=None)
_CENTRE = Field("centre of the shape in the body frame; default the origin", default=None)


class _Coloured(Record):
    """What is drawn."""

    colour: Colour | None = Field("a name or '#rrggbb'; default follows from the body's number", default=None)


class _Between(_Coloured):
    """A shape that may be laid between two points."""

    from_: Maybe[Position] = _FROM
    to: Maybe[Position] = _TO
    centre: Maybe[Position] = _CENTRE

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

    @abstractmethod
    def _extent(self) -> dict[str, object]:
        """The fields that say how long the shape is when no two points do."""


class Box(_Between):
    """A block: `size` along the body x, y, z axes; or `from`, `to`, `width` (along y) and `height` (along z)."""

    type: Literal["box"] = "box"
    size: Maybe[ThreeNumbers[PositiveLength]] = Field(default=None, usual=SOLID)
    width: Maybe[PositiveLength] = Field(default=None, usual=SOLID)
    height: Maybe[PositiveLength] = Field(default=None, usual=SOLID)

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


class _Long(_Between):
    """A shape with a length along one of the body's axes."""

    if TYPE_CHECKING:
        length: Any
        along: Along | None

    def _extent(self) -> dict[str, object]:
        return {"length": self.length}

    @model_validator(mode="after")
    def _along_x(self) -> _Long:
        if self.along is not None and self.from_ is not None:
            raise fault("`along` must not be given: between `from` and `to` the shape lies along the body x axis")
        return self


class Cylinder(_Long):
    """A round bar: `radius`, `length` and the body axis it lies `along` (default x); or `radius`, `from` and `to`."""

    type: Literal["cylinder"] = "cylinder"
    radius: PositiveLength = Field(usual=SOLID)
    length: Maybe[PositiveLength] = Field(default=None, usual=SOLID)
    along: Along | None = Field("body axis; default x", default=None)


class Tube(_Long):
    """A hollow round bar: `outer_radius`, `inner_radius`, `length` and `along` (default x); or the radii, `from` and
    `to`.
    """

    type: Literal["tube"] = "tube"
    outer_radius: PositiveLength = Field(usual=SOLID)
    inner_radius: PositiveLength
    length: Maybe[PositiveLength] = Field(default=None, usual=SOLID)
    along: Along | None = Field("body axis; default x", default=None)

    @model_validator(mode="after")
    def _hollow(self) -> Tube:
        if self.inner_radius >= self.outer_radius:
            raise fault(
                f"`inner_radius` {self.inner_radius:g} m must be smaller than `outer_radius` {self.outer_radius:g} m"
            )
        return self


class Capsule(_Long):
    """A round bar with hemispheres at its ends: `radius`, `length` of the straight part and `along` (default x); or `radius`,
    `from` and `to`, the centres of the balls.
    """

    type: Literal["capsule"] = "capsule"
    radius: PositiveLength = Field(usual=SOLID)
    length: Maybe[PositiveLength] = Field(
        "of the straight part, between the centres of the balls", default=None, usual=SOLID
    )
    along: Along | None = Field("body axis; default x", default=None)


Corner = Annotated[TwoNumbers[Length], BeforeValidator(listed)]


class Extrusion(_Long):
    """A prism: an `outline`, drawn along `length` to both sides of it, and `along` (default x); or the outline, `from` and `to`.

    The outline's corners are given in the two body axes that follow `along`: y and z for x, z and x for y, x and y for z.
    """

    type: Literal["extrusion"] = "extrusion"
    outline: Annotated[ManyCorners[Corner], BeforeValidator(listed)] = Field(
        "corners in their order, at least three; lines between them do not cross"
    )
    length: Maybe[PositiveLength] = Field(default=None, usual=SOLID)
    along: Along | None = Field("body axis; default x", default=None)

    @model_validator(mode="after")
    def _sound(self) -> Extrusion:
        why = bad_outline(np.array(self.outline, dtype=float).reshape(-1, 2))
        if why:
            raise fault(f"`outline`: {why}")
        return self


class Mesh(_Coloured):
    """A surface of triangles from a `file`: STL, OBJ or glTF. With a density or mass it must be closed.

    `surface` holds the triangles (surface.py) in the axes and the unit of the file; it is filled when the machine file is read, in
    Python by `nivel.files.read_mesh`.
    """

    type: Literal["mesh"] = "mesh"
    file: str = Field("STL, OBJ or glTF file, relative to the folder of the machine file", default="")
    unit: PositiveLength = Field("length of one unit of the file", default=1.0)
    position: Maybe[Position] = Field("of the file's origin in the body frame; default the origin", default=None)
    orientation: Maybe[OneRecord[Orientation]] = Field(
        "of the file's axes in the body frame; default not turned", default=None
    )
    convex_parts: Whole = Field(
        "at most so many convex parts touch other bodies, in place of the hull", default=1, ge=1, le=MOST_PARTS
    )
    surface: str | None = Field("the triangles, filled when the file is read", default=None)
    parts: tuple[str, ...] | None = Field("the convex parts, filled when the file is read", default=None)

    @model_validator(mode="after")
    def _readable(self) -> Mesh:
        if self.surface is None and not self.file:
            raise fault("a mesh needs the name of a `file`")
        if self.surface is None:
            raise fault(f"the file `{self.file}` was not read; in Python use nivel.files.read_mesh")
        if self.convex_parts > 1 and not self.parts:
            raise fault("`convex_parts` are found when a file is read; in Python use nivel.files.read_mesh")
        try:
            for each in (self.surface, *(self.parts or ())):
                surface_arrays(each)
        except ValueError:
            raise fault("`surface` holds no triangles; leave it out, it is filled when `file` is read") from None
        return self

    def __repr_args__(self) -> Any:
        return [(name, value) for name, value in super().__repr_args__() if name not in ("surface", "parts")]


class Sphere(_Coloured):
    """A solid ball: `radius`."""

    type: Literal["sphere"] = "sphere"
    radius: PositiveLength = Field(usual=SOLID)
    centre: Maybe[Position] = _CENTRE


class Ellipsoid(_Coloured):
    """A solid with three semi-axes: `semi_axes` along the body x, y and z axes."""

    type: Literal["ellipsoid"] = "ellipsoid"
    semi_axes: ThreeNumbers[PositiveLength] = Field("along the body x, y and z axes", usual=SOLID)
    centre: Maybe[Position] = _CENTRE


Shape = Annotated[Box | Cylinder | Capsule | Tube | Sphere | Ellipsoid | Extrusion | Mesh, Field(discriminator="type")]
Long = Box | Cylinder | Capsule | Tube | Extrusion  # those that may be laid between two points
Standing = Sphere | Ellipsoid | Mesh  # those that may not
