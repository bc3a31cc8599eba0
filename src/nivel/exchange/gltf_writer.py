"""Animation of a result as a binary glTF 2.0 file: a node for each body, with its shapes and its path.

Bodies are rigid in it: of flexible bodies and beams only what is drawn at their frames moves along. The scene is turned so that up is +Y.
"""

import json
import struct
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.files.target import write_file
from nivel.looks.solids import Ball, colour_of_body, shapes_of, solid
from nivel.looks.viewpoint import upwards
from nivel.results.result import Result

FLOAT: Final = 5126  # componentType
UNSIGNED: Final = 5125
MOST_FRAMES: Final = 20_000
ROUND: Final = 24  # facets of a sphere


def write_gltf(result: Result, path: Path) -> None:
    """Write the motion of a result. Raises ModelError where it has no bodies, or cannot be written."""
    if not result.scene.get("bodies"):
        raise ModelError("the result has no bodies that could be shown")
    write_file(path, "glTF file", gltf(result))


def gltf(result: Result) -> bytes:
    """The whole file."""
    scene, file = result.scene, _File()
    every = max(1, -(-len(result.time) // MOST_FRAMES))
    times = file.accessor(np.asarray(result.time[::every], dtype="<f4"), "SCALAR", bounds=True)
    samplers: list[dict[str, Any]] = []
    channels: list[dict[str, Any]] = []
    nodes: list[dict[str, Any]] = [{"name": result.name, "rotation": _upright(result), "children": []}]
    for k, body in enumerate(scene["bodies"]):
        position = np.asarray(result.array(f"{body['name']}.position")[::every], dtype=float)
        turns = _continuous(np.asarray(result.array(f"{body['name']}.orientation")[::every], dtype=float))
        node: dict[str, Any] = {
            "name": body["name"],
            "translation": position[0].tolist(),
            "rotation": turns[0].tolist(),
        }
        mesh = file.mesh(shapes_of(body), colour_of_body(body, k))
        node |= {} if mesh is None else {"mesh": mesh}
        for track, values, kind in (("translation", position, "VEC3"), ("rotation", turns, "VEC4")):
            channels.append({"sampler": len(samplers), "target": {"node": len(nodes), "path": track}})
            samplers.append(
                {"input": times, "output": file.accessor(values.astype("<f4"), kind), "interpolation": "LINEAR"}
            )
        nodes[0]["children"].append(len(nodes))
        nodes.append(node)
    around = file.mesh(scene.get("surroundings", []), "#a5a7a3")
    if around is not None:
        nodes[0]["children"].append(len(nodes))
        nodes.append({"name": "surroundings", "mesh": around})
    document = {
        "asset": {"version": "2.0", "generator": "nivel"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": nodes,
        "animations": [{"name": "motion", "samplers": samplers, "channels": channels}],
    }
    return file.packed(document)


def _upright(result: Result) -> list[float]:
    """The quaternion, scalar last, that turns the upward direction of the machine to +Y."""
    up = upwards(json.loads(str(result.attributes.get("machine_record", "{}"))).get("gravity"))
    axis, cosine = np.cross(up, [0.0, 1.0, 0.0]), float(up[1])
    if cosine < -1.0 + 1e-9:
        return [1.0, 0.0, 0.0, 0.0]
    turn = np.array([*axis, 1.0 + cosine])
    return (turn / np.linalg.norm(turn)).tolist()


def _continuous(parameters: NDArray[np.float64]) -> NDArray[np.float64]:
    """(T, 4) unit quaternions, scalar last, of Euler parameters, each on the side of the one before it."""
    turns = np.roll(parameters / np.linalg.norm(parameters, axis=1, keepdims=True), -1, axis=1)
    signs = np.where(np.einsum("ij,ij->i", turns[1:], turns[:-1]) < 0.0, -1.0, 1.0)
    return turns * np.concatenate([[1.0], np.cumprod(signs)])[:, None]


class _File:
    """Accessors, meshes and materials of one binary buffer."""

    def __init__(self) -> None:
        self.content = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []
        self.meshes: list[dict[str, Any]] = []
        self.materials: list[dict[str, Any]] = []
        self.colours: dict[str, int] = {}

    def accessor(self, values: NDArray[Any], kind: str, *, bounds: bool = False) -> int:
        """The number of an accessor with these values; bounds : whether their least and greatest are given."""
        data = np.ascontiguousarray(values)
        self.views.append({"buffer": 0, "byteOffset": len(self.content), "byteLength": data.nbytes})
        self.content += data.tobytes()
        component = FLOAT if data.dtype.kind == "f" else UNSIGNED
        made: dict[str, Any] = {"bufferView": len(self.views) - 1, "componentType": component, "type": kind}
        made["count"] = len(data) if kind != "SCALAR" else data.size
        if bounds:
            rows = data.reshape(made["count"], -1)
            made |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        self.accessors.append(made)
        return len(self.accessors) - 1

    def mesh(self, shapes: list[dict[str, Any]], colour: str) -> int | None:
        """The number of a mesh with a primitive for each shape; None where there is no shape."""
        primitives = []
        for shape in shapes:
            points, normals, triangles = _triangles(shape)
            attributes = {
                "POSITION": self.accessor(points.astype("<f4"), "VEC3", bounds=True),
                "NORMAL": self.accessor(normals.astype("<f4"), "VEC3"),
            }
            indices = self.accessor(triangles.astype("<u4").ravel(), "SCALAR")
            primitives.append(
                {"attributes": attributes, "indices": indices, "material": self._material(shape.get("colour", colour))}
            )
        if not primitives:
            return None
        self.meshes.append({"primitives": primitives})
        return len(self.meshes) - 1

    def _material(self, colour: str) -> int:
        if colour not in self.colours:
            shares = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
            linear = [share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4 for share in shares]
            surface = {"baseColorFactor": [*linear, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.7}
            self.colours[colour] = len(self.materials)
            self.materials.append({"pbrMetallicRoughness": surface, "doubleSided": True})
        return self.colours[colour]

    def packed(self, document: dict[str, Any]) -> bytes:
        """The binary file with this document and the buffer."""
        parts = {
            "meshes": self.meshes,
            "materials": self.materials,
            "accessors": self.accessors,
            "bufferViews": self.views,
        }
        document = document | {key: part for key, part in parts.items() if part}
        document["buffers"] = [{"byteLength": len(self.content)}]
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        data = bytes(self.content) + bytes(-len(self.content) % 4)
        size = 12 + 8 + len(text) + 8 + len(data)
        head = struct.pack("<4sII", b"glTF", 2, size)
        return head + struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data


def _triangles(shape: dict[str, Any]) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    """points (n, 3) [m], normals (n, 3) and triangles (m, 3) of a shape, with flat faces."""
    drawn = solid(shape)
    if isinstance(drawn, Ball):
        return _sphere(drawn)
    points, normals, triangles, start = [], [], [], 0
    for face in drawn:
        n = len(face.corners)
        points.append(face.corners)
        normals.append(np.tile(face.normal, (n, 1)))
        triangles += [(start, start + k, start + k + 1) for k in range(1, n - 1)]
        start += n
    return np.concatenate(points), np.concatenate(normals), np.array(triangles)


def _sphere(ball: Ball) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    turn, height = np.meshgrid(
        np.linspace(0.0, 2.0 * np.pi, ROUND + 1), np.linspace(-0.5 * np.pi, 0.5 * np.pi, ROUND // 2 + 1)
    )
    normals = np.stack([np.cos(height) * np.cos(turn), np.cos(height) * np.sin(turn), np.sin(height)], axis=-1).reshape(
        -1, 3
    )
    row = ROUND + 1
    corner = np.array([k * row + i for k in range(ROUND // 2) for i in range(ROUND)])
    lower = np.stack([corner, corner + 1, corner + row + 1], axis=1)
    upper = np.stack([corner, corner + row + 1, corner + row], axis=1)
    return ball.centre + ball.radius * normals, normals, np.concatenate([lower, upper])
