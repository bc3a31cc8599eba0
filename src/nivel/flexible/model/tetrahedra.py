"""Stress, turn and geometric stiffness of solids of tetrahedra with four or ten nodes.

Ten nodes: corners, then the middles of the edges 01, 12, 02, 03, 13, 23 (the order of VTK and Abaqus). Isoparametric:
edges may be curved.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
import scipy.sparse as sp

from nivel.flexible.model.model import Array, Whole
from nivel.flexible.model.sparse import Sparse
from nivel.machine.beams.section import Material

EDGES: Final = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))
FACES: Final = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))  # outwards
_a, _b = (5.0 - np.sqrt(5.0)) / 20.0, (5.0 + 3.0 * np.sqrt(5.0)) / 20.0
GAUSS: Final = np.array([[_a, _a, _a], [_b, _a, _a], [_a, _b, _a], [_a, _a, _b]])  # exact for polynomials of degree 2
CHUNK: Final = 8  # fields at once
ELEMENTS: Final = 1000  # at once, for many fields


def shape_gradients(at: Array, count: int) -> Array:
    """(count, 3) derivatives of the shape functions along the local coordinates, at a local point (3,)."""
    corner = np.array([[-1.0, -1.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    if count == 4:
        return corner
    L = np.array([1.0 - at.sum(), *at])
    out = np.empty((10, 3))
    out[:4] = (4.0 * L - 1.0)[:, None] * corner
    for k, (i, j) in enumerate(EDGES):
        out[4 + k] = 4.0 * (L[i] * corner[j] + L[j] * corner[i])
    return out


def shape_functions(at: Array, count: int) -> Array:
    """(count,) the shape functions at a local point (3,)."""
    L = np.array([1.0 - at.sum(), *at])
    if count == 4:
        return L
    return np.concatenate([L * (2.0 * L - 1.0), [4.0 * L[i] * L[j] for i, j in EDGES]])


def elasticity(material: Material) -> Array:
    """(6, 6) [Pa] stress xx, yy, zz, xy, yz, zx from strain with γ."""
    E, nu = material.youngs_modulus, material.poisson_ratio
    lame, mu = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), material.shear_modulus
    out = np.diag([2.0 * mu] * 3 + [mu] * 3)
    out[:3, :3] += lame
    return out


@dataclass(frozen=True)
class Tetrahedra:
    """Elements of one material: places of nodes (e, 4 or 10), freedoms (n, 3) of the nodes, position (n, 3) [m]."""

    nodes: Whole
    freedoms: Whole
    position: Array
    material: Material

    def station_nodes(self) -> Whole:
        return self.stations

    def station_labels(self) -> tuple[str, ...]:
        """One station at each node."""
        return ()

    @cached_property
    def stations(self) -> Whole:
        """The nodes of the elements."""
        return np.unique(self.nodes)

    @property
    def _gauss(self) -> Array:
        """(g, 3) Gauss points in local coordinates."""
        return GAUSS if self.nodes.shape[1] == 10 else np.full((1, 3), 0.25)

    @cached_property
    def points(self) -> tuple[tuple[Array, Array], ...]:
        """Gradients (e, nodes, 3) [1/m] of the shape functions and volumes (e,) [m³] at each Gauss point."""
        count = self.nodes.shape[1]
        out = []
        for at in self._gauss:
            local = shape_gradients(at, count)
            jacobian = np.einsum("ena,nb->eab", self.position[self.nodes], local)
            inverse = np.linalg.inv(jacobian)
            weight = 1.0 / 24.0 if count == 10 else 1.0 / 6.0
            out.append((np.einsum("nb,eba->ena", local, inverse), weight * np.linalg.det(jacobian)))
        return tuple(out)

    @cached_property
    def volumes(self) -> Array:
        """(e,) [m³]"""
        return sum(volume for _, volume in self.points)  # type: ignore[return-value]

    @cached_property
    def _extrapolation(self) -> Array:
        """(nodes, points) from values at Gauss points, taken as linear, to the nodes."""
        if self.nodes.shape[1] == 4:
            return np.ones((4, 1))
        corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
        places = np.concatenate([corners, [(corners[i] + corners[j]) / 2.0 for i, j in EDGES]])
        return np.hstack([np.ones((10, 1)), places]) @ np.linalg.inv(np.hstack([np.ones((4, 1)), GAUSS]))

    @cached_property
    def _averaging(self) -> Sparse:
        """(stations, e nodes) mean over the elements around a node, by their volumes."""
        count = self.nodes.shape[1]
        rows = np.searchsorted(self.stations, self.nodes.ravel())
        data = np.repeat(self.volumes, count)
        matrix = sp.csr_array((data, (rows, np.arange(len(rows)))), shape=(len(self.stations), len(rows)))
        return sp.csr_array(sp.diags_array(1.0 / np.asarray(matrix.sum(axis=1)).ravel()) @ matrix)

    def gradient(self, displacement: Array) -> Array:
        """(s, 3, 3, n) ∂u_a/∂x_b at the stations, mean over elements."""
        parts = [self._gradient(displacement[:, k : k + CHUNK]) for k in range(0, displacement.shape[1], CHUNK)]
        return np.concatenate(parts, axis=-1) if parts else np.zeros((len(self.stations), 3, 3, 0))

    def _gradient(self, displacement: Array) -> Array:
        u = displacement[self.freedoms[self.nodes]]  # (e, nodes, 3, n)
        at_points = [np.einsum("enb,enak->eabk", gradients, u, optimize=True) for gradients, _ in self.points]
        at_nodes = np.einsum("pg,geabk->epabk", self._extrapolation, np.array(at_points), optimize=True)
        mean = self._averaging @ at_nodes.reshape(self.nodes.size, -1)
        return mean.reshape(len(self.stations), 3, 3, -1)

    def strain(self, displacement: Array) -> Array:
        return _strain(self.gradient(displacement))

    def stress(self, displacement: Array) -> Array:
        return np.einsum("ij,sjk->sik", elasticity(self.material), self.strain(displacement), optimize=True)

    def energy_error(self, displacement: Array) -> Array:
        """(n,) share of the strain energy that finer elements would add, by how far strains at Gauss points are from those averaged at
        nodes (Zienkiewicz, Zhu 1987)."""
        parts = [displacement[:, k : k + CHUNK] for k in range(0, displacement.shape[1], CHUNK)]
        return np.concatenate([self._energy_error(part) for part in parts]) if parts else np.zeros(0)

    def _energy_error(self, displacement: Array) -> Array:
        D, n = elasticity(self.material), displacement.shape[1]
        smooth = self.strain(displacement)[np.searchsorted(self.stations, self.nodes)]
        u = displacement[self.freedoms[self.nodes]]
        off, whole = np.zeros(n), np.zeros(n)
        for at, (gradients, volume) in zip(self._gauss, self.points, strict=True):
            shape = shape_functions(at, self.nodes.shape[1])
            strain = _strain(np.einsum("enb,enak->eabk", gradients, u, optimize=True))
            left = np.einsum("p,epik->eik", shape, smooth, optimize=True) - strain
            off += np.einsum("e,eik,ij,ejk->k", volume, left, D, left, optimize=True)
            whole += np.einsum("e,eik,ij,ejk->k", volume, strain, D, strain, optimize=True)
        return off / np.maximum(whole, 1e-300)

    def turn(self, displacement: Array) -> Array:
        """(n, 3, k) half the curl of the displacement at all nodes, mean over the elements around; NaN where there are none."""
        g = self.gradient(displacement)
        out = np.full((len(self.position), 3, displacement.shape[1]), np.nan)
        out[self.stations] = 0.5 * np.stack(
            [g[:, 2, 1] - g[:, 1, 2], g[:, 0, 2] - g[:, 2, 0], g[:, 1, 0] - g[:, 0, 1]], axis=1
        )
        return out

    def geometric_stiffness(self, displacement: Array, modes: Array) -> Array:
        """Zienkiewicz & Taylor 2000, The Finite Element Method, vol. 2. Summed over Gauss points without a global matrix."""
        D, n, count = elasticity(self.material), modes.shape[1], displacement.shape[1]
        out = np.zeros((count, n, n))
        for first in range(0, len(self.nodes), ELEMENTS):
            part = slice(first, first + ELEMENTS)
            at = self.freedoms[self.nodes[part]]
            for gradients, volume in self.points:
                moved = np.einsum("enb,enak->eabk", gradients[part], displacement[at], optimize=True)
                stress = np.einsum("ij,ejk,e->kie", D, _strain(moved), volume[part], optimize=True)
                slopes = np.einsum("enb,enaj->abej", gradients[part], modes[at], optimize=True)
                slopes = np.ascontiguousarray(slopes)  # [a, b] (e, n): ∂φ_a/∂x_b
                for k in range(count):
                    weight = stress[k][[0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(3, 3, -1)
                    for along in slopes:
                        for b in range(3):
                            pulled = sum(weight[b, c][:, None] * along[c] for c in range(3))
                            out[k] += along[b].T @ pulled
        return 0.5 * (out + out.transpose(0, 2, 1))


def _strain(g: Array) -> Array:
    """(s, 6, n) from displacement gradients (s, 3, 3, n)."""
    shear = [g[:, 0, 1] + g[:, 1, 0], g[:, 1, 2] + g[:, 2, 1], g[:, 2, 0] + g[:, 0, 2]]
    return np.stack([g[:, 0, 0], g[:, 1, 1], g[:, 2, 2], *shear], axis=1)


def surface(nodes: Whole) -> Whole:
    """(t, 3) corner nodes of the faces that belong to one element only, seen from outside counter-clockwise."""
    faces = np.concatenate([nodes[:, face] for face in FACES])
    _, first, counts = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[np.sort(first[counts == 1])]


def inverted(nodes: Whole, position: Array) -> Whole:
    """Numbers of the elements that are turned inside out somewhere: a Jacobian that is not positive at a Gauss point or node."""
    count = nodes.shape[1]
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    bad = np.zeros(len(nodes), dtype=bool)
    for at in np.concatenate([GAUSS, corners]):
        bad |= np.linalg.det(np.einsum("ena,nb->eab", position[nodes], shape_gradients(at, count))) <= 0.0
    return np.flatnonzero(bad)
