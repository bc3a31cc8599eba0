"""Stress, turn and geometric stiffness of solids: meshes of isoparametric elements of one or several shapes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
import scipy.sparse as sp

from nivel.flexible.model.model import Array, Whole
from nivel.flexible.model.solid_shapes import SolidShape
from nivel.flexible.model.sparse import Sparse
from nivel.machine.beams.section import Material

CHUNK: Final = 8  # fields at once
ELEMENTS: Final = 1000  # at once, for many fields
HOURGLASSES: Final = 8  # nodes of hexahedra that may move like an hourglass: without strain in the middle


def elasticity(material: Material) -> Array:
    """(6, 6) [Pa] stress xx, yy, zz, xy, yz, zx from strain with γ."""
    E, nu = material.youngs_modulus, material.poisson_ratio
    lame, mu = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), material.shear_modulus
    out = np.diag([2.0 * mu] * 3 + [mu] * 3)
    out[:3, :3] += lame
    return out


@dataclass(frozen=True)
class SolidBlock:
    """Elements of one shape: places of nodes (e, n) at `position` (…, 3) [m].

    incompatible : hexahedra of eight nodes that bend by incompatible modes.
    """

    shape: SolidShape
    nodes: Whole
    position: Array
    incompatible: bool = False

    @cached_property
    def points(self) -> tuple[tuple[Array, Array], ...]:
        """Gradients (e, n, 3) [1/m] of the shape functions and volumes (e,) [m³] at each point."""
        out = []
        for at, weight in zip(self.shape.points, self.shape.weights, strict=True):
            local = self.shape.gradients(at)
            jacobian = np.einsum("ena,nb->eab", self.position[self.nodes], local)
            inverse = np.linalg.inv(jacobian)
            out.append((np.einsum("nb,eba->ena", local, inverse), weight * np.linalg.det(jacobian)))
        return tuple(out)

    @cached_property
    def volumes(self) -> Array:
        """(e,) [m³]"""
        return sum(volume for _, volume in self.points)  # type: ignore[return-value]

    def inverted(self) -> Whole:
        """Numbers of the elements that are turned inside out: a Jacobian that is not positive at a corner or where strain is evaluated."""
        bad = np.zeros(len(self.nodes), dtype=bool)
        for at in np.concatenate([self.shape.points, self.shape.corners]):
            jacobian = np.einsum("ena,nb->eab", self.position[self.nodes], self.shape.gradients(at))
            bad |= np.linalg.det(jacobian) <= 0.0
        return np.flatnonzero(bad)

    def at_points(self, moved: Array, D: Array) -> list[Array]:
        """(e, 3, 3, k) ∂u_a/∂x_b at each point, of displacements (e, n, 3, k) of the nodes; D : (6, 6) [Pa] elasticity."""
        plain = [np.einsum("enb,enak->eabk", gradients, moved, optimize=True) for gradients, _ in self.points]
        return self._with_incompatible(plain, D) if self.incompatible else plain

    def _with_incompatible(self, plain: list[Array], D: Array) -> list[Array]:
        """With the modes 1 - ξ², 1 - η², 1 - ζ² of Wilson, whose slopes are those at the middle (Taylor, Beresford, Wilson 1976).

        Nothing acts on them, so they follow from the nodes: ∫ Bᵀ σ dV = 0 over the element.
        """
        middle = np.einsum("ena,nb->eab", self.position[self.nodes], self.shape.gradients(np.zeros(3)))
        inverse, size = np.linalg.inv(middle), np.linalg.det(middle)
        slopes = []
        for at, (_, volume) in zip(self.shape.points, self.points, strict=True):
            slopes.append(np.einsum("m,emb->emb", -2.0 * at, inverse) * (size / volume)[:, None, None])
        stiffness = np.zeros((len(self.nodes), 9, 9))
        force = np.zeros((len(self.nodes), 9, plain[0].shape[-1]))
        for each, slope, (_, volume) in zip(plain, slopes, self.points, strict=True):
            B = _strain(np.einsum("emb,ac->eabmc", slope, np.eye(3)).reshape(-1, 3, 3, 9))
            stiffness += np.einsum("eim,ij,ejn,e->emn", B, D, B, volume, optimize=True)
            force += np.einsum("eim,ij,ejk,e->emk", B, D, _strain(each), volume, optimize=True)
        inner = -np.linalg.solve(stiffness, force).reshape(len(self.nodes), 3, 3, -1)  # [mode, direction]
        return [
            each + np.einsum("emb,emak->eabk", slope, inner, optimize=True)
            for each, slope in zip(plain, slopes, strict=True)
        ]


@dataclass(frozen=True)
class SolidElements:
    """Elements of one material: blocks of elements of a shape each, freedoms (n, 3) of the nodes, position (n, 3) [m]."""

    blocks: tuple[SolidBlock, ...]
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
        return np.unique(np.concatenate([block.nodes.ravel() for block in self.blocks]))

    @property
    def volume(self) -> float:
        """[m³]"""
        return float(sum(block.volumes.sum() for block in self.blocks))

    @cached_property
    def _averaging(self) -> tuple[Sparse, ...]:
        """(stations, e n) for each block: mean over the elements around a node, by their volumes."""
        matrices = []
        for block in self.blocks:
            rows = np.searchsorted(self.stations, block.nodes.ravel())
            data = np.repeat(block.volumes, block.nodes.shape[1])
            matrices.append(sp.csr_array((data, (rows, np.arange(len(rows)))), shape=(len(self.stations), len(rows))))
        whole = sp.diags_array(1.0 / sum(np.asarray(each.sum(axis=1)).ravel() for each in matrices))
        return tuple(sp.csr_array(whole @ each) for each in matrices)

    def gradient(self, displacement: Array) -> Array:
        """(s, 3, 3, n) ∂u_a/∂x_b at the stations, mean over elements."""
        parts = [self._gradient(displacement[:, k : k + CHUNK]) for k in range(0, displacement.shape[1], CHUNK)]
        return np.concatenate(parts, axis=-1) if parts else np.zeros((len(self.stations), 3, 3, 0))

    def _gradient(self, displacement: Array) -> Array:
        mean = 0.0
        for block, averaging in zip(self.blocks, self._averaging, strict=True):
            at_points = np.array(block.at_points(displacement[self.freedoms[block.nodes]], elasticity(self.material)))
            at_nodes = np.einsum("pg,geabk->epabk", block.shape.extrapolation, at_points, optimize=True)
            mean = mean + averaging @ at_nodes.reshape(block.nodes.size, -1)
        return np.asarray(mean).reshape(len(self.stations), 3, 3, -1)

    def strain(self, displacement: Array) -> Array:
        return _strain(self.gradient(displacement))

    def stress(self, displacement: Array) -> Array:
        return np.einsum("ij,sjk->sik", elasticity(self.material), self.strain(displacement), optimize=True)

    @property
    def has_one_point(self) -> bool:
        """Whether hexahedra know strain at their middle alone: bent, they have none there, but for what an hourglass control adds."""
        return any(len(block.points) == 1 and block.nodes.shape[1] == HOURGLASSES for block in self.blocks)

    def strain_energy(self, displacement: Array) -> Array:
        """(n,) [J] of the strains at the points of the elements, for displacements (…, n)."""
        D, energy = elasticity(self.material), np.zeros(displacement.shape[1])
        for block in self.blocks:
            gradients = block.at_points(displacement[self.freedoms[block.nodes]], D)
            for each, (_, volume) in zip(gradients, block.points, strict=True):
                strain = _strain(each)
                energy += 0.5 * np.einsum("e,eik,ij,ejk->k", volume, strain, D, strain, optimize=True)
        return energy

    def energy_error(self, displacement: Array) -> Array:
        """(n,) share of the strain energy that finer elements would add, by how far strains at Gauss points are from those averaged at
        nodes (Zienkiewicz, Zhu 1987)."""
        parts = [displacement[:, k : k + CHUNK] for k in range(0, displacement.shape[1], CHUNK)]
        return np.concatenate([self._energy_error(part) for part in parts]) if parts else np.zeros(0)

    def _energy_error(self, displacement: Array) -> Array:
        D, n = elasticity(self.material), displacement.shape[1]
        nodal = self.strain(displacement)
        off, whole = np.zeros(n), np.zeros(n)
        for block in self.blocks:
            smooth = nodal[np.searchsorted(self.stations, block.nodes)]
            gradients = block.at_points(displacement[self.freedoms[block.nodes]], D)
            for at, each, (_, volume) in zip(block.shape.points, gradients, block.points, strict=True):
                strain = _strain(each)
                left = np.einsum("p,epik->eik", block.shape.functions(at), smooth, optimize=True) - strain
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
        out = np.zeros((displacement.shape[1], modes.shape[1], modes.shape[1]))
        for block in self.blocks:
            for first in range(0, len(block.nodes), ELEMENTS):
                part = SolidBlock(block.shape, block.nodes[first : first + ELEMENTS], self.position, block.incompatible)
                self._add_geometric_stiffness(part, displacement, modes, out)
        return 0.5 * (out + out.transpose(0, 2, 1))

    def _add_geometric_stiffness(self, block: SolidBlock, displacement: Array, modes: Array, out: Array) -> None:
        D, at = elasticity(self.material), self.freedoms[block.nodes]
        all_moved = block.at_points(displacement[at], D)
        all_slopes = block.at_points(modes[at], D)
        for moved, slopes, (_, volume) in zip(all_moved, all_slopes, block.points, strict=True):
            stress = np.einsum("ij,ejk,e->kie", D, _strain(moved), volume, optimize=True)
            slopes = np.ascontiguousarray(np.moveaxis(slopes, 0, 2))  # noqa: PLW2901 [a, b] (e, n): ∂φ_a/∂x_b
            for k in range(len(out)):
                weight = stress[k][[0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(3, 3, -1)
                for along in slopes:
                    for b in range(3):
                        pulled = sum(weight[b, c][:, None] * along[c] for c in range(3))
                        out[k] += along[b].T @ pulled


def _strain(g: Array) -> Array:
    """(s, 6, n) from displacement gradients (s, 3, 3, n)."""
    shear = [g[:, 0, 1] + g[:, 1, 0], g[:, 1, 2] + g[:, 2, 1], g[:, 2, 0] + g[:, 0, 2]]
    return np.stack([g[:, 0, 0], g[:, 1, 1], g[:, 2, 2], *shear], axis=1)


def surface(blocks: Iterable[SolidBlock]) -> Whole:
    """(t, 3) corner nodes of the faces that belong to one element only, seen from outside counter-clockwise.

    Faces of four corners are two triangles.
    """
    faces = []
    for block in blocks:
        for face in block.shape.faces:
            corners = np.full((len(block.nodes), 4), -1, dtype=np.int64)
            corners[:, : len(face)] = block.nodes[:, face]
            faces.append(corners)
    every = np.concatenate(faces)
    _, first, counts = np.unique(np.sort(every, axis=1), axis=0, return_index=True, return_counts=True)
    outer = every[np.sort(first[counts == 1])]
    four = outer[outer[:, 3] >= 0]
    return np.concatenate([outer[:, :3], four[:, [0, 2, 3]]])
