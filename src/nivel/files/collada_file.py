"""Surfaces of COLLADA files (.dae, version 1.4 and 1.5): triangles and polygons of all geometries that the scene places."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.files.xml_source import Document, Element
from nivel.machine.bodies.surface import joined
from nivel.machine.core.orientation import Orientation, rotation_matrix
from nivel.machine.core.vectors import Array

Corners = NDArray[np.int64]

DEEPEST: Final = 64  # nodes inside each other
MOST_PARTS: Final = 10_000  # placed geometries


class ColladaError(ValueError):
    """Why a COLLADA file gives no surface, in words."""


def collada_surface(content: bytes) -> tuple[Array, Corners]:
    """vertices (n, 3) and triangles (m, 3) of a file, in metres by the unit that it gives, in its own axes.

    As programs of robotics do, `up_axis` is not used. Raises ColladaError, ValueError, KeyError or IndexError.
    """
    try:
        root = Document(content, "").root
    except ModelError as error:
        raise ColladaError(error.faults[0].message) from None
    named: dict[str, Element] = {}
    for element in root.every():
        element.tag = element.tag.rpartition(":")[2]  # without the prefix of its XML namespace
        if "id" in element.attributes:
            named[element.get("id")] = element
    unit = next((float(each.get("meter", "1")) for each in _below(root, "unit")), 1.0)
    parts: list[tuple[Array, Corners]] = []
    scenes = _below(root, "visual_scene")
    wanted = next((each.get("url") for each in _below(root, "instance_visual_scene")), "")
    scene = named.get(wanted.removeprefix("#")) or (scenes[0] if scenes else None)
    if scene is not None:
        for node in scene.all("node"):
            _place(node, np.diag([unit, unit, unit, 1.0]), named, parts, 0)
    else:
        parts = [(points * unit, corners) for each in _below(root, "geometry") for points, corners in _geometry(each)]
    return joined(parts)


def _below(root: Element, tag: str) -> list[Element]:
    """All elements of a tag below `root`, in their order."""
    return [element for element in root.every() if element.tag == tag]


def _place(
    node: Element, around: Array, named: dict[str, Element], parts: list[tuple[Array, Corners]], depth: int
) -> None:
    if depth > DEEPEST or len(parts) > MOST_PARTS:
        raise ColladaError("its nodes lead back to themselves, or place too many parts")
    at = around.copy()
    for child in node.children:
        at = at @ _transform(child)
    for child in node.children:
        target = named.get(child.get("url").removeprefix("#"))
        if child.tag == "node":
            _place(child, at, named, parts, depth + 1)
        elif child.tag == "instance_node" and target is not None:
            _place(target, at, named, parts, depth + 1)
        elif child.tag == "instance_geometry" and target is not None:
            turned = np.linalg.det(at[:3, :3]) < 0.0
            for points, corners in _geometry(target):
                parts.append((points @ at[:3, :3].T + at[:3, 3], corners[:, ::-1] if turned else corners))


def _transform(element: Element) -> Array:
    """(4, 4) of a child of a node; of what places nothing the unit matrix."""
    out = np.eye(4)
    if element.tag not in ("matrix", "translate", "rotate", "scale"):
        return out
    values = np.array(element.text.split(), dtype=np.float64)
    if element.tag == "matrix":
        return values.reshape(4, 4)
    if element.tag == "translate":
        out[:3, 3] = values
    elif element.tag == "scale":
        out[:3, :3] = np.diag(values)
    elif np.any(values[:3]):
        x, y, z, degrees = values.tolist()
        out[:3, :3] = rotation_matrix(Orientation(axis=(x, y, z), angle=float(np.deg2rad(degrees))))
    return out


def _geometry(geometry: Element) -> list[tuple[Array, Corners]]:
    mesh = geometry.first("mesh")
    if mesh is None:
        return []
    sources: dict[str, Array] = {}
    for source in mesh.all("source"):
        values = source.first("float_array")
        if values is not None:
            sources[source.get("id")] = _rows(source, np.array(values.text.split(), dtype=np.float64))
    for vertices in mesh.all("vertices"):
        given = next((each for each in vertices.all("input") if each.get("semantic") == "POSITION"), None)
        if given is not None and given.get("source").removeprefix("#") in sources:
            sources[vertices.get("id")] = sources[given.get("source").removeprefix("#")]
    found = []
    for primitive in mesh.children:
        if primitive.tag in ("triangles", "polylist", "polygons"):
            inputs = list(primitive.all("input"))
            vertex = next((each for each in inputs if each.get("semantic") == "VERTEX"), None)
            if vertex is None:
                continue
            stride = 1 + max(int(each.get("offset", "0")) for each in inputs)
            corners = _corners(primitive, int(vertex.get("offset", "0")), stride)
            if len(corners):
                found.append((sources[vertex.get("source").removeprefix("#")], corners))
    return found


def _rows(source: Element, values: Array) -> Array:
    accessors = _below(source, "accessor")
    stride = int(accessors[0].get("stride", "3")) if accessors else 3
    return values[: len(values) // stride * stride].reshape(-1, stride)[:, :3]


def _corners(primitive: Element, offset: int, stride: int) -> Corners:
    """(m, 3) triangles of a primitive; polygons are cut into fans."""
    lists = [np.array(each.text.split(), dtype=np.int64)[offset::stride] for each in primitive.all("p")]
    if not lists:
        return np.zeros((0, 3), dtype=np.int64)
    if primitive.tag == "triangles":
        return np.concatenate(lists).reshape(-1, 3)
    if primitive.tag == "polylist":
        counts = primitive.first("vcount")
        sizes = np.array(counts.text.split() if counts is not None else [], dtype=np.int64)
        lists = np.split(lists[0], np.cumsum(sizes)[:-1]) if len(sizes) else []
    fans = [[(face[0], face[k], face[k + 1]) for k in range(1, len(face) - 1)] for face in lists]
    return np.array([each for fan in fans for each in fan], dtype=np.int64).reshape(-1, 3)
