"""XML documents for other programs, and the geometry of bodies in them: primitives in the frame of a body, and meshes."""

from collections.abc import Iterable, Iterator
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from nivel.exchange.mechanism import Array, Frame
from nivel.exchange.translation import Notes
from nivel.files.mesh_file import stl_content
from nivel.lazy import Struct
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.shape import Box, Capsule, Cylinder, Mesh, Shape, Sphere, Tube, digits_of
from nivel.machine.bodies.solids import axes_of, box_size, length, mesh_surface


class Lines:
    """Lines of a document, indented by the elements that are open."""

    def __init__(self) -> None:
        self._lines: list[str] = ['<?xml version="1.0"?>']
        self._open: list[str] = []

    def comment(self, lines: Iterable[str]) -> None:
        """A comment of several lines, before the first element."""
        text = "\n     ".join(each.replace("--", "- -") for each in lines)
        self._lines.insert(1, f"<!-- {text}\n-->")

    def add(self, inner: "Lines") -> None:
        """The elements of another document, inside of the one that is open."""
        self._lines += [f"{self._indent}{line}" for line in inner._lines[1:]]

    def element(self, tag: str, **attributes: object) -> None:
        """An element without content; attributes that are None are left out."""
        self._lines.append(f"{self._indent}<{tag}{_attributes(attributes)}/>")

    def start(self, tag: str, **attributes: object) -> None:
        """The beginning of an element."""
        self._lines.append(f"{self._indent}<{tag}{_attributes(attributes)}>")
        self._open.append(tag)

    def end(self) -> None:
        """The end of the element that is open."""
        tag = self._open.pop()
        self._lines.append(f"{self._indent}</{tag}>")

    def text(self) -> str:
        """The document."""
        return "\n".join(self._lines) + "\n"

    @property
    def _indent(self) -> str:
        return "  " * len(self._open)


def words(values: Iterable[float]) -> str:
    """Numbers with all their digits, separated by spaces."""
    return " ".join(repr(float(each)).removesuffix(".0") for each in values)


def _attributes(attributes: dict[str, object]) -> str:
    given = ((name.rstrip("_"), value) for name, value in attributes.items() if value is not None)
    return "".join(f" {name}={quoteattr(_shown(value))}" for name, value in given)


def _shown(value: object) -> str:
    return repr(value).removesuffix(".0") if isinstance(value, float) else escape(str(value))


class Geometry(Struct):
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
