"""Drawn solids of links: those along axes of their bodies as they are, other ones and scaled meshes as surfaces.

A mesh is read from folders that are allowed only: that of the model, packages beside it, and those that the user names.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final
from urllib.parse import unquote

import numpy as np

from nivel.errors import ModelError
from nivel.exchange.mechanism import Array, Frame, Link, Look
from nivel.exchange.translation import Notes, number, triple, turn
from nivel.files.mesh_file import KINDS, NotReadError, parse
from nivel.files.sources import read_bytes
from nivel.files.xml_source import Document, Element
from nivel.lazy import Struct, field
from nivel.machine.bodies.surface import Triangles
from nivel.machine.core.placement import frame_from_axes

ALONG: Final = 1e-9  # by which an axis may miss that of the body
PARENTS: Final = 4  # folders above that of the model which may be a package
MOST_MESHES: Final = 1000
ROUND: Final = 24  # facets of round solids that lie askew


class NotFoundError(Exception):
    """Why a mesh is not drawn, in words."""


def look_of(given: Element, at: Frame, colour: str, document: Document, default: float) -> Look | str:
    """The solid of a <visual> or <collision> of URDF or SDF, or the word for one that is not read. default : of sizes that are missing."""
    geometry = given.first("geometry")
    solid = geometry.children[0] if geometry is not None and geometry.children else None
    if solid is None:
        return ""

    def size(key: str, *usual: float) -> tuple[float, ...]:
        """Numbers of an attribute, or of an element of this name."""
        inner = solid.first(key)
        return document.numbers(solid if inner is None else inner, key if inner is None else "", usual)

    common: dict[str, Any] = {"place": at, "colour": colour, "line": given.line}
    match solid.tag:
        case "box":
            return Look("box", sizes=size("size", default, default, default), **common)
        case "cylinder" | "capsule":
            kind: Any = solid.tag
            return Look(kind, sizes=(*size("radius", 0.5 * default), *size("length", default)), **common)
        case "sphere":
            return Look("sphere", sizes=size("radius", 0.5 * default), **common)
        case "ellipsoid":
            return Look("ellipsoid", sizes=size("radii", default, default, default), **common)
        case "mesh":
            x, y, z = size("scale", 1.0, 1.0, 1.0)
            uri = solid.first("uri")
            file = solid.get("filename") if uri is None else uri.text.strip()
            return Look("mesh", file=file, scale=(x, y, z), **common)
        case "plane":
            normal = frame_from_axes(np.array(size("normal", 0.0, 0.0, 1.0)))
            return Look("plane", at @ Frame(normal), colour=colour, line=given.line)
    return solid.tag


class Drawing(Struct, frozen=False):
    """Meshes of a model. file : the model. packages : folders of packages. target : folder of the machine file, to which names of meshes
    are relative. made : surfaces of meshes that have to be written, by file name."""

    file: Path
    packages: Sequence[Path]
    target: Path
    prefix: str = "meshes"
    made: dict[str, tuple[Array, Triangles]] = field(default_factory=dict)
    parsed: dict[Path, tuple[Array, Triangles]] = field(default_factory=dict)

    def shapes(self, link: Link, into: Frame, notes: Notes) -> list[dict[str, Any]]:
        """Shapes of a link in the frame of a body; `into` is the frame of the link there."""
        out = []
        for look in link.looks:
            try:
                shape = self._shape(look, into @ look.place, link.name)
            except NotFoundError as problem:
                notes.leave(f"looks: {problem}", link.name, look.line)
                continue
            out.append(shape | ({"colour": look.colour} if look.colour else {}))
        return out

    def _shape(self, look: Look, at: Frame, name: str) -> dict[str, Any]:
        if look.kind == "mesh":
            return self._mesh(look, at)
        if look.kind == "plane":
            raise NotFoundError("a plane without ends")
        if look.surface is not None:
            return self.surface(name, look.surface, at)
        if not all(0.0 < size < 1e6 for size in look.sizes):
            raise NotFoundError(f"a {look.kind} without size")
        centre = {"centre": triple(at.origin)} if np.any(at.origin) else {}
        if look.kind == "sphere":
            return {"type": "sphere", "radius": number(look.sizes[0]), **centre}
        key = {"box": "size", "ellipsoid": "semi_axes"}.get(look.kind)
        order = np.argmax(np.abs(at.axes), axis=0).tolist()
        straight = np.abs(at.axes).max(axis=0) > 1.0 - ALONG
        if not (straight.all() if key else straight[2]):
            return self.surface(name, _solid(look), at)
        if key:
            sizes = dict(zip(order, map(number, look.sizes), strict=True))
            return {"type": look.kind, key: [sizes[k] for k in range(3)], **centre}
        radius, length = map(number, look.sizes)
        return {"type": look.kind, "radius": radius, "length": length, "along": "xyz"[order[2]], **centre}

    def surface(self, name: str, surface: tuple[Array, Triangles], at: Frame) -> dict[str, Any]:
        """A mesh that has to be written; its points are in the frame of the body."""
        vertices, triangles = surface
        plain = "".join(each if each.isalnum() or each in "-_" else "_" for each in name)
        file, count = f"{self.prefix}/{plain}.stl", 2
        while file in self.made:
            file, count = f"{self.prefix}/{plain}_{count}.stl", count + 1
        if len(self.made) >= MOST_MESHES:
            raise NotFoundError(f"more than {MOST_MESHES} meshes would have to be written")
        self.made[file] = (vertices @ at.axes.T + at.origin, triangles)
        return {"type": "mesh", "file": file}

    def vertices(self, look: Look) -> Array:
        """(n, 3) [m] vertices of a mesh in its file, scaled. Raises NotFoundError."""
        return np.asarray(self._parsed(look)[1][0] * look.scale)

    def _parsed(self, look: Look) -> tuple[Path, tuple[Array, Triangles]]:
        path = self.found(look.file)
        if path not in self.parsed:
            try:
                self.parsed[path] = parse(read_bytes(path), str(path))
            except NotReadError as problem:
                raise NotFoundError(f"`{look.file}`: {problem}") from None
            except ModelError as problem:
                raise NotFoundError(f"`{look.file}`: {problem.faults[0].message}") from None
        return path, self.parsed[path]

    def _mesh(self, look: Look, at: Frame) -> dict[str, Any]:
        path, _ = self._parsed(look)
        x, y, z = look.scale
        if not (x == y == z and x > 0.0):
            if not x or not y or not z:
                raise NotFoundError(f"`{look.file}`: a scale of zero")
            vertices, triangles = self.parsed[path]
            triangles = triangles if x * y * z > 0.0 else triangles[:, ::-1]
            return self.surface(Path(look.file).stem, (vertices * look.scale, triangles), at)
        out: dict[str, Any] = {"type": "mesh", "file": _relative(path, self.target)}
        out |= {"unit": x} if x != 1.0 else {}
        out |= {"position": triple(at.origin)} if np.any(at.origin) else {}
        return out | turn(at.axes)

    def found(self, address: str) -> Path:
        """The file of a mesh. Raises NotFoundError where it is not there, or outside of the folders that are allowed."""
        if Path(address).suffix.lower() not in KINDS:
            raise NotFoundError(f"`{address}` is no mesh in {', '.join(KINDS)}")
        allowed, candidates = self._candidates(unquote(address))
        for candidate in candidates:
            try:
                path = candidate.resolve()
                there = path.is_file()
            except (OSError, ValueError, RuntimeError):
                continue
            if there and not any(path.is_relative_to(folder.resolve()) for folder in allowed):
                raise NotFoundError(
                    f"`{address}` leaves the folder of the model and is not read; `--package-path {path.parent}` allows it"
                )
            if there:
                return path
        raise NotFoundError(f"there is no file `{address}`; `--package-path FOLDER` says where packages are")

    def _candidates(self, address: str) -> tuple[list[Path], list[Path]]:
        """Folders that are allowed, and places where the file may be."""
        folder = self.file.parent.resolve()
        allowed = [folder, *self.packages]
        scheme, mark, rest = address.partition("://")
        if not mark:
            return allowed, [folder / address, *(each / address for each in self.packages)]
        if scheme == "file":
            return allowed, [Path(rest)]
        if scheme not in ("package", "model"):
            raise NotFoundError(f"`{address}` is an address that is not read")
        package, _, inside = rest.partition("/")
        roots = [each / package for each in self.packages] + [each for each in self.packages if each.name == package]
        above = [folder, *folder.parents][: PARENTS + 1]
        roots += [each for each in above if each.name == package] + [each / package for each in above[:2]]
        places = [root / inside for root in roots] + [folder / inside]
        return [*allowed, *roots], places


def _relative(path: Path, folder: Path) -> str:
    import os

    try:
        return Path(os.path.relpath(path, folder.resolve())).as_posix()
    except ValueError:  # on another drive
        return path.as_posix()


def _solid(look: Look) -> tuple[Array, Triangles]:
    """The surface of a box, or of a cylinder or capsule along z, about its middle."""
    if look.kind == "box":
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * 0.5 * np.array(look.sizes)
        quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        return corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))], dtype=np.uint32)
    if look.kind == "ellipsoid":
        angles = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 13)
        points, triangles = _lathe([(float(np.cos(a)), float(np.sin(a))) for a in angles])
        return points * look.sizes, triangles
    radius, length = look.sizes
    rings = [(0.0, -0.5 * length), (radius, -0.5 * length), (radius, 0.5 * length), (0.0, 0.5 * length)]
    if look.kind == "capsule":
        angles = np.linspace(0.0, 0.5 * np.pi, 7)
        upper = [(float(radius * np.cos(a)), float(0.5 * length + radius * np.sin(a))) for a in angles]
        rings = [(r, -z) for r, z in reversed(upper)] + upper
    return _lathe(rings)


def _lathe(rings: list[tuple[float, float]]) -> tuple[Array, Triangles]:
    """Surface of revolution about z through rings (radius, height), from below."""
    turn = 2.0 * np.pi * np.arange(ROUND) / ROUND
    points = np.array([[r * np.cos(a), r * np.sin(a), z] for r, z in rings for a in turn])
    a = np.arange((len(rings) - 1) * ROUND)
    b = a - a % ROUND + (a + 1) % ROUND
    c, d = a + ROUND, b + ROUND
    return points, np.stack([a, b, d, a, d, c], axis=1).reshape(-1, 3).astype(np.uint32)
