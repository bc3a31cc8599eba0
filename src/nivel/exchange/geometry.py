"""Geometry of bodies for files of other programs: primitives in the frame of a body, and meshes in files beside it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from nivel.exchange.mechanism import Array, Frame
from nivel.exchange.notes import Notes
from nivel.files.mesh_file import stl_content
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.colour import digits_of
from nivel.machine.bodies.shape import Box, Capsule, Cylinder, Mesh, Shape, Sphere, Tube
from nivel.machine.bodies.solids import axes_of, box_size, length, mesh_surface


@dataclass(frozen=True)
class Geometry:
    """kind : box, cylinder, capsule, sphere or mesh. place : of its middle, round ones along z. sizes : lengths; radius, length; radius.

    file : of a mesh. colour : red, green, blue from 0 to 1, or None.
    """

    kind: str
    place: Frame
    sizes: tuple[float, ...] = ()
    file: str = ""
    colour: tuple[float, float, float] | None = None


def geometries(body: Body, folder: str, meshes: dict[str, bytes], notes: Notes) -> Iterator[Geometry]:
    """What is drawn of a body; files of meshes go to `meshes`."""
    for shape in (*((body.shape,) if body.shape is not None else ()), *body.looks):
        drawn = _geometry(shape, body.name, folder, meshes)
        if drawn is None:
            notes.leave(f"looks: shapes of type {shape.type}", body.name)
        else:
            yield drawn


def _geometry(shape: Shape, name: str, folder: str, meshes: dict[str, bytes]) -> Geometry | None:
    colour = None
    if shape.colour is not None:
        digits = digits_of(shape.colour).removeprefix("#")
        colour = (int(digits[0:2], 16) / 255, int(digits[2:4], 16) / 255, int(digits[4:6], 16) / 255)
    match shape:
        case Mesh():
            file, count = f"{folder}/{name}.stl", 2
            while file in meshes:
                file, count = f"{folder}/{name}_{count}.stl", count + 1
            meshes[file] = stl_content(*mesh_surface(shape))
            return Geometry("mesh", Frame(), file=file, colour=colour)
        case Sphere():
            return Geometry("sphere", _at(shape.centre), (shape.radius,), colour=colour)
        case Box():
            return Geometry("box", _at(shape.centre), tuple(map(float, box_size(shape))), colour=colour)
        case Cylinder() | Capsule() | Tube():
            radius = shape.outer_radius if isinstance(shape, Tube) else shape.radius
            along, next_one, last = axes_of(shape.along)
            place = Frame(np.eye(3)[:, [next_one, last, along]], _at(shape.centre).origin)
            kind = "capsule" if isinstance(shape, Capsule) else "cylinder"
            return Geometry(kind, place, (radius, float(length(shape))), colour=colour)
    return None


def _at(centre: tuple[float, float, float] | None) -> Frame:
    origin: Array = np.array(centre or (0.0, 0.0, 0.0))
    return Frame(origin=origin)
