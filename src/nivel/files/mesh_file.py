"""`file:` of a mesh: STL (text or binary), OBJ, COLLADA (.dae) and glTF (.gltf, .glb) as vertices and triangles."""

import base64
import json
import struct
from collections.abc import Callable, Iterator
from pathlib import Path as FilePath
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.files.outline import section_of
from nivel.files.sources import Sources, beside, read_bytes
from nivel.files.tree import Path, Tree
from nivel.lazy import nivel
from nivel.machine.bodies.shape import Mesh
from nivel.machine.bodies.surface import MOST_TRIANGLES, Triangles, joined, surface_text
from nivel.machine.core.orientation import matrix_from_euler_parameters
from nivel.machine.core.vectors import Array

KINDS: Final = (".stl", ".obj", ".dae", ".gltf", ".glb")
STL_HEAD: Final = 84  # bytes before the triangles of a binary STL file
STL_TRIANGLE: Final = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
NUMBERS: Final = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}  # componentType of glTF
TRIANGLES: Final = 4  # mode of a glTF primitive
DEEPEST: Final = 64  # nodes of glTF inside each other


# what reading a file raises whose parts are not what they should be
DAMAGE: Final = (
    *(AttributeError, ValueError, KeyError, IndexError, TypeError, OverflowError, RecursionError, MemoryError),
    struct.error,
)


class NotReadError(Exception):
    """Why a file is no mesh, in words."""


def read_meshes(tree: Tree, sources: Sources) -> None:
    """Put the surface of the file of each mesh into its shape, as `surface`. Faults go to `tree.faults`."""
    for place, shape in _shapes(tree):
        if isinstance(shape, dict) and _is_step(shape) and "surface" not in shape:
            _read_part(tree, place, shape)
            continue
        if not isinstance(shape, dict) or shape.get("type") != "mesh" or "file" not in shape or "surface" in shape:
            continue
        path = (*place, "file")
        found = sources.content(tree, path, shape["file"], breaks=path[:2])
        if found is None:
            continue
        content, file = found
        try:
            shape["surface"] = surface_text(*parse(content, file))
        except NotReadError as problem:
            tree.report(path, f"`{file}`: {problem}", breaks=path[:2])


def _is_step(shape: dict[str, Any]) -> bool:
    is_mesh, name = shape.get("type", "mesh") == "mesh", str(shape.get("file", "")).lower()
    return is_mesh and name.endswith(nivel.files.step_file.KINDS)


def _read_part(tree: Tree, place: Path, shape: dict[str, Any]) -> None:
    """The part of a STEP file: its surface, and with a density of its body the exact mass, centre of mass and inertia."""
    file = beside(tree.file_of(place), str(shape["file"]))
    part, body = shape.pop("part", None), tree.data["bodies"][place[1]] if place[0] == "bodies" else {}
    try:
        solids = {each.name: each for each in nivel.files.step_file.step_solids(file)}
    except ModelError as error:
        tree.report((*place, "file"), error.faults[0].message, breaks=place[:2])
        return
    if part is None and len(solids) == 1:
        part = next(iter(solids))
    if part not in solids:
        what = "`part` is missing" if part is None else f"there is no part `{part}`"
        tree.report((*place, "file"), f"{what}; `{file}` has {', '.join(solids)}", breaks=place[:2])
        return
    solid = solids[str(part)]
    shape["type"], shape["surface"] = "mesh", surface_text(*solid.surface)
    if place[-1] != "shape" or "density" not in body or {"position", "orientation", "unit"} & set(shape):
        return
    density, i = body.pop("density"), solid.moments
    tensor = {"xx": i[0, 0], "yy": i[1, 1], "zz": i[2, 2], "xy": i[0, 1], "xz": i[0, 2], "yz": i[1, 2]}
    body["mass"] = _times(density, solid.volume, "m^3")
    body["centre_of_mass"] = solid.centre.tolist()
    body["inertia"] = {key: _times(density, float(each), "m^5") for key, each in tensor.items()}


def _times(density: object, factor: float, unit: str) -> float | str:
    """A density as it is written times a number with a unit."""
    return density * factor if isinstance(density, int | float) else f"({density})*{factor!r} {unit}"


def _shapes(tree: Tree) -> Iterator[tuple[Path, Any]]:
    """Everything that may be a mesh, and its place: the shape and the looks of each body, shapes of markers, and the surroundings."""
    for name, body in section_of(tree, "bodies").items():
        if isinstance(body, dict):
            yield ("bodies", name, "shape"), body.get("shape")
            looks = body.get("looks")
            for k, each in enumerate(looks if isinstance(looks, list) else ()):
                yield ("bodies", name, "looks", k), each
    for name, marker in section_of(tree, "markers").items():
        if isinstance(marker, dict):
            yield ("markers", name, "shape"), marker.get("shape")
    around = tree.data.get("surroundings") if isinstance(tree.data, dict) else None
    for k, each in enumerate(around if isinstance(around, list) else ()):
        yield ("surroundings", k), each


def read_mesh(file: str | FilePath, **given: Any) -> Mesh:
    """The mesh in a file, for machines written in Python; `given` : `unit`, `position`, `orientation`, `convex_parts`.

    Raises ModelError.
    """
    try:
        surface = surface_text(*parse(read_bytes(file), str(file)))
        if given.get("convex_parts", 1) > 1:
            given["parts"] = nivel.files.convex_parts.convex_parts(surface, given["convex_parts"])
        return Mesh(file=str(file), surface=surface, **given)
    except NotReadError as problem:
        raise ModelError(f"{file}: {problem}") from None


def parse(content: bytes, file: str) -> tuple[Array, Triangles]:
    """vertices (n, 3) and triangles (m, 3) of a file with this content. Raises NotReadError."""
    kind = FilePath(file).suffix.lower()
    readers: dict[str, Callable[[], tuple[Any, Any]]] = {
        ".stl": lambda: _stl(content),
        ".obj": lambda: _obj(content),
        ".dae": lambda: nivel.files.collada_file.collada_surface(content),
        ".gltf": lambda: _gltf(_json(content), {}, file),
        ".glb": lambda: _glb(content, file),
    }
    if kind not in readers:
        raise NotReadError(f"a mesh in {', '.join(KINDS)} was expected")
    try:
        vertices, triangles = readers[kind]()
        vertices = np.asarray(vertices, dtype=np.float64).reshape(-1, 3)
        triangles = np.asarray(triangles, dtype=np.int64).reshape(-1, 3)
    except nivel.files.collada_file.ColladaError as problem:
        raise NotReadError(str(problem)) from None
    except DAMAGE:
        raise NotReadError("the file is damaged, or not what its name says") from None
    if not len(triangles):
        raise NotReadError("there are no triangles in it")
    if len(triangles) > MOST_TRIANGLES:
        raise NotReadError(f"it has {len(triangles)} triangles, more than {MOST_TRIANGLES}; make it coarser")
    if triangles.min() < 0 or triangles.max() >= len(vertices):
        raise NotReadError("a triangle refers to a corner that does not exist")
    if not np.all(np.isfinite(vertices)):
        raise NotReadError("it has coordinates that are not finite")
    return vertices, triangles.astype(np.uint32)


def stl_content(vertices: Array, triangles: NDArray[Any]) -> bytes:
    """A binary STL file of vertices (n, 3) and triangles (m, 3)."""
    rows = np.zeros(len(triangles), STL_TRIANGLE)
    corners = np.asarray(vertices, dtype=np.float64)[np.asarray(triangles, dtype=np.int64)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    rows["normal"] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0.0)
    rows["corners"] = corners
    return bytes(STL_HEAD - 4) + struct.pack("<I", len(rows)) + rows.tobytes()


def _stl(content: bytes) -> tuple[Array, Any]:
    if len(content) >= STL_HEAD:
        (count,) = struct.unpack_from("<I", content, STL_HEAD - 4)
        if len(content) == STL_HEAD + STL_TRIANGLE.itemsize * count:
            corners = np.frombuffer(content, STL_TRIANGLE, count, STL_HEAD)["corners"]
            return _merged(corners.astype(np.float64).reshape(-1, 3))
    if not content.lstrip()[:5].lower() == b"solid":
        raise NotReadError("this is no STL file, or it is cut short")
    words = content.decode("utf-8", errors="replace").lower().split()
    places = [k for k, word in enumerate(words) if word == "vertex"]
    corners = np.array([[float(value) for value in words[k + 1 : k + 4]] for k in places], dtype=np.float64)
    return _merged(corners.reshape(-1, 3))


def _merged(corners: Array) -> tuple[Array, Any]:
    """Corners (3 m, 3) of triangles as vertices, each once, and triangles."""
    if len(corners) % 3:
        raise NotReadError("a triangle has fewer than three corners")
    if not len(corners):
        return corners, np.zeros((0, 3), dtype=np.int64)
    vertices, place = np.unique(corners, axis=0, return_inverse=True)
    return vertices, place.reshape(-1, 3)


def _obj(content: bytes) -> tuple[Any, Any]:
    vertices: list[list[float]] = []
    triangles: list[tuple[int, int, int]] = []
    for line in content.decode("utf-8", errors="replace").replace("\\\n", " ").splitlines():
        word, *rest = line.split() or [""]
        if word == "v":
            vertices.append([float(value) for value in rest[:3]])
        elif word == "f":
            corners = [int(each.split("/")[0]) for each in rest]
            # from 1, or backwards from the last
            corners = [k - 1 if k > 0 else len(vertices) + k for k in corners]
            triangles += [(corners[0], corners[k], corners[k + 1]) for k in range(1, len(corners) - 1)]
    return vertices, triangles


# --- glTF 2.0 ---


def _json(content: bytes) -> dict[str, Any]:
    data = json.loads(content.decode("utf-8"))
    if not isinstance(data, dict):
        raise NotReadError("this is no glTF file")
    return data


def _glb(content: bytes, file: str) -> tuple[Any, Any]:
    magic, version, _ = struct.unpack_from("<4sII", content)
    if magic != b"glTF" or version != 2:
        raise NotReadError("this is no binary glTF 2 file")
    chunks: dict[bytes, bytes] = {}
    at = 12
    while at < len(content):
        length, kind = struct.unpack_from("<I4s", content, at)
        chunks.setdefault(kind, content[at + 8 : at + 8 + length])
        at += 8 + length
    return _gltf(_json(chunks[b"JSON"]), {0: chunks.get(b"BIN\0", b"")}, file)


def _gltf(data: dict[str, Any], buffers: dict[int, bytes], file: str) -> tuple[Any, Any]:
    """All triangles of the scene, placed by its nodes."""
    for k, buffer in enumerate(data.get("buffers", [])):
        if "uri" in buffer:
            buffers[k] = _buffer(str(buffer["uri"]), file)
    scenes = data.get("scenes") or [{"nodes": list(range(len(data.get("nodes", []))))}]
    nodes, seen = scenes[data.get("scene", 0)].get("nodes", []), set[int]()
    return joined([part for node in nodes for part in _placed(data, buffers, node, np.eye(4), 0, seen)])


def _placed(
    data: dict[str, Any], buffers: dict[int, bytes], number: int, around: Array, depth: int, seen: set[int]
) -> Iterator[tuple[Array, NDArray[Any]]]:
    """Vertices and triangles of a node and of all below it. seen : nodes that were placed: none has two parents (glTF 2.0, §3.5.2), or
    there may be two to the power of their number."""
    if depth > DEEPEST or number in seen:
        raise NotReadError("its nodes lead back to themselves, or one has two parents")
    seen.add(number)
    node = data["nodes"][number]
    placed = around @ _transform(node)
    if "mesh" in node:
        for primitive in data["meshes"][node["mesh"]]["primitives"]:
            if primitive.get("mode", TRIANGLES) != TRIANGLES:
                continue
            points = _accessor(data, buffers, primitive["attributes"]["POSITION"]).reshape(-1, 3).astype(np.float64)
            corners = np.arange(len(points))
            if "indices" in primitive:
                corners = _accessor(data, buffers, primitive["indices"]).astype(np.int64)
            corners = corners.reshape(-1, 3)
            outwards = np.linalg.det(placed[:3, :3]) > 0.0
            yield points @ placed[:3, :3].T + placed[:3, 3], corners if outwards else corners[:, ::-1]
    for child in node.get("children", []):
        yield from _placed(data, buffers, child, placed, depth + 1, seen)


def _transform(node: dict[str, Any]) -> Array:
    """(4, 4) of a node: its matrix (column by column), or translation, rotation (scalar last) and scale."""
    if "matrix" in node:
        return np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
    out = np.eye(4)
    x, y, z, w = node.get("rotation", (0.0, 0.0, 0.0, 1.0))
    turn = np.array([w, x, y, z], dtype=np.float64)
    out[:3, :3] = matrix_from_euler_parameters(turn / np.linalg.norm(turn)) * np.array(
        node.get("scale", (1.0, 1.0, 1.0))
    )
    out[:3, 3] = node.get("translation", (0.0, 0.0, 0.0))
    return out


def _buffer(uri: str, file: str) -> bytes:
    if uri.startswith("data:"):
        return base64.b64decode(uri.partition(",")[2])
    if "://" in uri or FilePath(uri).is_absolute() or ".." in FilePath(uri).parts:
        raise NotReadError(f"it refers to `{uri}`, and only files beside it are read")
    try:
        return (FilePath(file).parent / uri).read_bytes()
    except OSError:
        raise NotReadError(f"its file `{uri}` cannot be read") from None


def _accessor(data: dict[str, Any], buffers: dict[int, bytes], number: int) -> NDArray[Any]:
    accessor = data["accessors"][number]
    if "sparse" in accessor or "bufferView" not in accessor:
        raise NotReadError("it has packed (sparse or compressed) parts, which are not read")
    view = data["bufferViews"][accessor["bufferView"]]
    if "extensions" in view:
        raise NotReadError("it has compressed parts, which are not read")
    width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
    kind = np.dtype((NUMBERS[accessor["componentType"]], (width,)))
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    stride = view.get("byteStride") or kind.itemsize
    content, count = buffers[view["buffer"]], accessor["count"]
    if not 0 < count <= len(content) or start + stride * (count - 1) + kind.itemsize > len(content):
        raise NotReadError("it is cut short")
    rows = np.ndarray((count, width), kind.base, content, start, (stride, kind.base.itemsize))
    return np.array(rows) if width > 1 else np.array(rows)[:, 0]
