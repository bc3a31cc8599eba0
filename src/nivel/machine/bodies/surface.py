"""Surfaces of triangles: as text in a record, and the mass properties of what a closed one encloses.

The solid is the sum of tetrahedra between the origin and each triangle (a, b, c), with signed volumes V = a · (b × c)/6, which is what
the divergence theorem leaves of volume integrals over polynomials. Of a tetrahedron with one corner in the origin
∫ x dV = V (a + b + c)/4 and ∫ x xᵀ dV = V (s sᵀ + a aᵀ + b bᵀ + c cᵀ)/20 with s = a + b + c (Tonon 2004).
"""

import base64
import struct
import zlib
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import Struct
from nivel.machine.core.vectors import Array, Triangles

HEAD: Final = struct.Struct("<II")  # numbers of vertices and of triangles
MOST_TRIANGLES: Final = 2_000_000


def surface_text(vertices: Array, triangles: Triangles) -> str:
    """vertices (n, 3) [m] and triangles (m, 3) as one compressed text."""
    content = vertices.astype("<f8").tobytes() + triangles.astype("<u4").tobytes()
    return base64.b64encode(zlib.compress(HEAD.pack(len(vertices), len(triangles)) + content)).decode()


def joined(parts: Sequence[tuple[Array, NDArray[Any]]]) -> tuple[Array, NDArray[Any]]:
    """Vertices (n, 3) and triangles (m, 3) of several surfaces as those of one."""
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in parts)])
    triangles = [each + start for (_, each), start in zip(parts, starts, strict=False)]
    none = np.zeros((0, 3))
    return np.concatenate([none, *(each for each, _ in parts)]), np.concatenate([none.astype(np.int64), *triangles])


def surface_arrays(text: str) -> tuple[Array, Triangles]:
    """vertices (n, 3) [m] and triangles (m, 3) of a text; ValueError where it is not such a text."""
    try:
        inflate = zlib.decompressobj()
        content = inflate.decompress(base64.b64decode(text, validate=True), HEAD.size + 48 * 3 * MOST_TRIANGLES)
        n, m = HEAD.unpack_from(content)
    except (ValueError, zlib.error, struct.error):
        raise ValueError("not a packed surface") from None
    if not n or not m or len(content) != HEAD.size + 24 * n + 12 * m:
        raise ValueError("not a packed surface")
    vertices = np.frombuffer(content, "<f8", 3 * n, HEAD.size).reshape(n, 3)
    triangles = np.frombuffer(content, "<u4", 3 * m, HEAD.size + 24 * n).reshape(m, 3)
    if triangles.max() >= n or not np.all(np.isfinite(vertices)):
        raise ValueError("not a packed surface")
    return vertices.astype(np.float64), triangles.astype(np.uint32)


class Enclosed(Struct):
    """volume [m³], centre (3,) [m], and ∫ (|r|² 1 - r rᵀ) dV about the centre (3, 3) [m⁵] of what a surface encloses."""

    volume: float
    centre: Array
    moments: Array


@np.errstate(divide="ignore", invalid="ignore")  # what encloses nothing has no centre
def enclosed(vertices: Array, triangles: Triangles) -> Enclosed:
    """What the closed surface encloses; its triangles go counter-clockwise seen from outside, or all the other way."""
    middle = 0.5 * (vertices.min(axis=0) + vertices.max(axis=0))  # digits are lost far from the origin
    a, b, c = np.moveaxis((vertices - middle)[triangles], 1, 0)
    volumes = np.einsum("ni,ni->n", a, np.cross(b, c)) / 6.0
    volume = float(volumes.sum())
    s = a + b + c
    centre = volumes @ s / (4.0 * volume)
    second = sum(np.einsum("n,ni,nj->ij", volumes, each, each) for each in (s, a, b, c)) / 20.0
    second = second - volume * np.outer(centre, centre)
    sign = np.sign(volume)
    moments = sign * (np.trace(second) * np.eye(3) - second)
    return Enclosed(abs(volume), middle + centre, moments)


def why_open(triangles: Triangles) -> str:
    """Why the surface encloses nothing certain, or an empty text: every edge belongs to two triangles, once in each direction."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).astype(np.int64)
    n = int(triangles.max()) + 1
    forth, times = np.unique(edges[:, 0] * n + edges[:, 1], return_counts=True)
    back = np.unique(edges[:, 1] * n + edges[:, 0])
    if not np.array_equal(forth, back):
        alone = len(np.setdiff1d(forth, back, assume_unique=True))
        return f"the surface is not closed: {alone} edge{'s' * (alone != 1)} belong{'s' * (alone == 1)} to one triangle only"
    if times.max() > 1:
        return "the surface is not a solid: several triangles run along the same edge in the same direction"
    return ""


def welded(vertices: Array, triangles: Triangles) -> tuple[Array, Triangles]:
    """Vertices at the same place made one, triangles without area left out."""
    scale = float(np.ptp(vertices, axis=0).max()) or 1.0
    keys = np.round((vertices - vertices.min(axis=0)) / (1e-7 * scale)).astype(np.int64)
    _, first, place = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    joined = place.reshape(-1)[triangles.astype(np.int64)]
    whole = (joined[:, 0] != joined[:, 1]) & (joined[:, 1] != joined[:, 2]) & (joined[:, 2] != joined[:, 0])
    return vertices[first], joined[whole].astype(np.uint32)
