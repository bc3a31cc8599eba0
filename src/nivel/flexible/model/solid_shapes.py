"""Shapes of solid elements: nodes, shape functions, points at which strain is evaluated, faces.

Tetrahedra, wedges and hexahedra with nodes at corners alone or also in the middle of edges. Nodes are in the order of Abaqus and CalculiX;
that of tetrahedra is VTK's too. Strain is evaluated where CalculiX integrates, but of C3D20 where it is most accurate (Barlow 1976), not
at all 27 points of integration.
"""

from functools import cached_property
from itertools import product
from typing import Final

import numpy as np

from nivel.flexible.model.model import Array, Whole
from nivel.lazy import Struct

Edges = tuple[tuple[int, int], ...]


class SolidShape(Struct, eq=False):
    """An element shape in local coordinates.

    nodes : (n, 3); powers : (n, 3) of the monomials that its shape functions are made of.
    points : (g, 3) where strain is evaluated, with `weights` (g,); carried : (up to g, 3) powers of the polynomial through their
    values, or nearest to them.
    faces : nodes at the corners of each face, counter-clockwise seen from outside.
    """

    nodes: Array
    powers: Whole
    points: Array
    weights: Array
    carried: Whole
    faces: tuple[tuple[int, ...], ...]

    def functions(self, at: Array) -> Array:
        """(n,) the shape functions at a local point (3,)."""
        return _monomials(at[None], self.powers)[0] @ self._coefficients

    def gradients(self, at: Array) -> Array:
        """(n, 3) derivatives of the shape functions along the local coordinates."""
        out = []
        for axis in range(3):
            lower = self.powers.copy()
            lower[:, axis] = np.maximum(lower[:, axis] - 1, 0)
            out.append((self.powers[:, axis] * _monomials(at[None], lower)[0]) @ self._coefficients)
        return np.stack(out, axis=1)

    @cached_property
    def _coefficients(self) -> Array:
        return np.linalg.inv(_monomials(self.nodes, self.powers)).astype(np.float64)

    @cached_property
    def extrapolation(self) -> Array:
        """(n, g) values at the nodes from those at the points: of the polynomial through them, or nearest to them."""
        inverse: Array = np.linalg.pinv(_monomials(self.points, self.carried)).astype(np.float64)
        return _monomials(self.nodes, self.carried) @ inverse

    @property
    def corners(self) -> Array:
        """(c, 3) the nodes at corners."""
        return self.nodes[: 1 + max(max(face) for face in self.faces)]


def _monomials(at: Array, powers: Whole) -> Array:
    """(points, monomials)"""
    return np.prod(at[:, None, :] ** powers[None], axis=-1)


def _with_middles(corners: Array, edges: Edges) -> Array:
    return np.concatenate([corners, [(corners[i] + corners[j]) / 2.0 for i, j in edges]])


def _powers(allowed) -> Whole:
    return np.array([each for each in product(range(3), repeat=3) if allowed(*each)])


EDGES: Final = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))
_TETRAHEDRON = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
_TETRAHEDRON_FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))
_a, _b = (5.0 - np.sqrt(5.0)) / 20.0, (5.0 + 3.0 * np.sqrt(5.0)) / 20.0
_CONSTANT = np.zeros((1, 3), dtype=int)
_LINEAR = _powers(lambda a, b, c: a + b + c <= 1)
TETRAHEDRON_4: Final = SolidShape(
    _TETRAHEDRON, _LINEAR, np.full((1, 3), 0.25), np.array([1.0 / 6.0]), _CONSTANT, _TETRAHEDRON_FACES
)
TETRAHEDRON_10: Final = SolidShape(
    _with_middles(_TETRAHEDRON, EDGES),
    _powers(lambda a, b, c: a + b + c <= 2),
    np.array([[_a, _a, _a], [_b, _a, _a], [_a, _b, _a], [_a, _a, _b]]),
    np.full(4, 1.0 / 24.0),
    _LINEAR,
    _TETRAHEDRON_FACES,
)

_SQUARE = ((-1, -1), (1, -1), (1, 1), (-1, 1))
_HEXAHEDRON = np.array([(x, y, z) for z in (-1, 1) for x, y in _SQUARE], dtype=float)
_HEXAHEDRON_EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
_HEXAHEDRON_FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
_TRILINEAR = _powers(lambda a, b, c: max(a, b, c) <= 1)
_EIGHT = _HEXAHEDRON / np.sqrt(3.0)
HEXAHEDRON_8: Final = SolidShape(_HEXAHEDRON, _TRILINEAR, _EIGHT, np.ones(8), _TRILINEAR, _HEXAHEDRON_FACES)
HEXAHEDRON_8_CENTRE: Final = SolidShape(
    _HEXAHEDRON, _TRILINEAR, np.zeros((1, 3)), np.array([8.0]), _CONSTANT, _HEXAHEDRON_FACES
)
HEXAHEDRON_20: Final = SolidShape(
    _with_middles(_HEXAHEDRON, _HEXAHEDRON_EDGES),
    _powers(lambda *powers: sum(power for power in powers if power > 1) <= 2),
    _EIGHT,
    np.ones(8),
    _TRILINEAR,
    _HEXAHEDRON_FACES,
)

_TRIANGLE = ((0, 0), (1, 0), (0, 1))
_WEDGE = np.array([(x, y, z) for z in (-1, 1) for x, y in _TRIANGLE], dtype=float)
_WEDGE_EDGES = ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5))
_WEDGE_FACES = ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5))
_TWO, _GAUSS = 1.0 / np.sqrt(3.0), np.sqrt(0.6)
_THREE = ((1 / 6, 1 / 6), (2 / 3, 1 / 6), (1 / 6, 2 / 3))
_LINEAR_WEDGE = _powers(lambda a, b, c: a + b <= 1 and c <= 1)
WEDGE_6: Final = SolidShape(
    _WEDGE,
    _LINEAR_WEDGE,
    np.array([(1 / 3, 1 / 3, -_TWO), (1 / 3, 1 / 3, _TWO)]),
    np.full(2, 0.5),
    np.array([(0, 0, 0), (0, 0, 1)]),
    _WEDGE_FACES,
)
WEDGE_15: Final = SolidShape(
    _with_middles(_WEDGE, _WEDGE_EDGES),
    _powers(lambda a, b, c: a + b <= 2 - (c == 2)),
    np.array([(x, y, z) for z in (-_GAUSS, 0.0, _GAUSS) for x, y in _THREE]),
    np.repeat([5.0, 8.0, 5.0], 3) / 54.0,
    _LINEAR_WEDGE,
    _WEDGE_FACES,
)
