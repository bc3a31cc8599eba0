"""Stress, turn and geometric stiffness of solids: meshes of isoparametric elements of one or several shapes."""

from collections.abc import Callable, Iterable
from functools import cached_property
from typing import Final

import numpy as np
import scipy.sparse as sp

from nivel.elements.beams.sections import Material
from nivel.flexible.model.model import Array, Sparse, Whole
from nivel.flexible.model.solid_shapes import SolidShape
from nivel.lazy import Struct, replace

CHUNK: Final = 8  # fields at once
ELEMENTS: Final = 1000  # at once, for many fields
SHEARS: Final = ((0, 1), (1, 2), (2, 0))
HOURGLASSES: Final = 8  # nodes of hexahedra that may move like an hourglass: without strain in the middle


def elasticity(material: Material) -> Array:
    """(6, 6) [Pa] stress xx, yy, zz, xy, yz, zx from strain with γ."""
    return isotropic(np.array(material.youngs_modulus), np.array(material.poisson_ratio))


def isotropic(E: Array, nu: Array) -> Array:
    """(…, 6, 6) stress xx, yy, zz, xy, yz, zx from strain with γ, of moduli and ratios of Poisson (…)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        lame, mu = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), 0.5 * E / (1.0 + nu)
    out = mu[..., None, None] * np.diag([2.0, 2.0, 2.0, 1.0, 1.0, 1.0])
    out[..., :3, :3] += lame[..., None, None]
    return out


class SolidBlock(Struct):
    """Elements of one shape and material: places of nodes (e, n) at `position` (…, 3) [m].

    incompatible : hexahedra of eight nodes that bend by incompatible modes; inner : (e, 3, 3) their freedoms [mode, direction], or None
    where they have none of their own; patched : whether the slopes of these modes are scaled, so that constant stress is exact in any
    element. elasticity : [Pa] stress from strain at each point of each element, (e or 1, points or 1, 6, 6); None where it is not known.
    material : its name.
    """

    shape: SolidShape
    nodes: Whole
    position: Array
    incompatible: bool = False
    inner: Whole | None = None
    patched: bool = True
    elasticity: Array | None = None
    material: str = ""

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

    def stress(self, point: int, strain: Array) -> Array:
        """(e, 6, k) [Pa] of strains (e, 6, k) at the point."""
        assert self.elasticity is not None
        return self.elasticity[:, min(point, self.elasticity.shape[1] - 1)] @ strain

    def energy(self, strains: Iterable[Array]) -> Array:
        """(k,) [J] of strains (e, 6, k) at each point."""
        terms = [
            np.einsum("e,eik,eik->k", volume, strain, self.stress(point, strain), optimize=True)
            for point, (strain, (_, volume)) in enumerate(zip(strains, self.points, strict=True))
        ]
        return 0.5 * np.sum(terms, axis=0)

    def part(self, chosen: slice | list[int]) -> "SolidBlock":
        """Some of the elements."""
        D, inner = self.elasticity, self.inner
        D = D if D is None or len(D) == 1 else D[chosen]
        return replace(self, nodes=self.nodes[chosen], elasticity=D, inner=inner if inner is None else inner[chosen])

    def at_points(self, moved: Array, inner: Array | None = None) -> list[Array]:
        """(e, 3, 3, k) ∂u_a/∂x_b at each point, of displacements (e, n, 3, k) of the nodes.

        inner : (e, 3, 3, k) of the incompatible modes; None: they follow from the nodes.
        """
        plain = [np.einsum("enb,enak->eabk", gradients, moved, optimize=True) for gradients, _ in self.points]
        return self._with_incompatible(plain, inner) if self.incompatible else plain

    def _with_incompatible(self, plain: list[Array], inner: Array | None) -> list[Array]:
        """With the modes 1 - ξ², 1 - η², 1 - ζ² of Wilson, whose slopes are those at the middle (Taylor, Beresford, Wilson 1976)."""
        middle = np.einsum("ena,nb->eab", self.position[self.nodes], self.shape.gradients(np.zeros(3)))
        inverse, size = np.linalg.inv(middle), np.linalg.det(middle)
        slopes = []
        for at, (_, volume) in zip(self.shape.points, self.points, strict=True):
            scale = size / volume if self.patched else np.ones_like(size)
            slopes.append(np.einsum("m,emb,e->emb", -2.0 * at, inverse, scale))
        inner = self._condensed(plain, slopes) if inner is None else inner
        return [
            each + np.einsum("emb,emak->eabk", slope, inner, optimize=True)
            for each, slope in zip(plain, slopes, strict=True)
        ]

    def _condensed(self, plain: list[Array], slopes: list[Array]) -> Array:
        """(e, 3, 3, k) the incompatible modes that follow from the nodes, as nothing acts on them: ∫ Bᵀ σ dV = 0 over the element."""
        stiffness = np.zeros((len(self.nodes), 9, 9))
        force = np.zeros((len(self.nodes), 9, plain[0].shape[-1]))
        for point, (each, slope, (_, volume)) in enumerate(zip(plain, slopes, self.points, strict=True)):
            B = _strain(np.einsum("emb,ac->eabmc", slope, np.eye(3)).reshape(-1, 3, 3, 9))
            stiffness += np.einsum("eim,ein,e->emn", B, self.stress(point, B), volume, optimize=True)
            force += np.einsum("eim,eik,e->emk", B, self.stress(point, _strain(each)), volume, optimize=True)
        return np.asarray(-np.linalg.solve(stiffness, force), dtype=np.float64).reshape(len(self.nodes), 3, 3, -1)


class SolidElements(Struct):
    """Solids of known elasticity: blocks of elements of a shape and a material each, freedoms (n, 3) of the nodes, position (n, 3) [m]."""

    blocks: tuple[SolidBlock, ...]
    freedoms: Whole
    position: Array

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
    def by_material(self) -> "tuple[SolidElements, ...]":
        """The elements of each material alone: between them strain and stress have steps."""
        names = dict.fromkeys(block.material for block in self.blocks)
        if len(names) == 1:
            return (self,)
        return tuple(replace(self, blocks=tuple(b for b in self.blocks if b.material == name)) for name in names)

    @cached_property
    def _averaging(self) -> tuple[Sparse, ...]:
        """(stations, e n) for each block: mean over the elements around a node."""
        size = len(self.stations)
        rows = [np.searchsorted(self.stations, block.nodes.ravel()) for block in self.blocks]
        share = 1.0 / np.bincount(np.concatenate(rows), minlength=size)
        return tuple(
            sp.csr_array((share[each], (each, np.arange(len(each)))), shape=(size, len(each))) for each in rows
        )

    def _at_points(self, block: SolidBlock, displacement: Array) -> list[Array]:
        """The displacement gradients of a block, of displacements (F, k)."""
        inner = None if block.inner is None else displacement[block.inner]
        return block.at_points(displacement[self.freedoms[block.nodes]], inner)

    def _nodal(
        self, displacement: Array, of: Callable[[SolidBlock, int, Array], Array], shape: tuple[int, ...]
    ) -> Array:
        """(s, …, n) values at the stations, mean over elements. `of` : their values (e, …, n) from displacement gradients at a point."""
        parts = [np.zeros((len(self.stations), *shape, 0))]
        for k in range(0, displacement.shape[1], CHUNK):
            moved, mean = displacement[:, k : k + CHUNK], 0.0
            for block, averaging in zip(self.blocks, self._averaging, strict=True):
                gradients = self._at_points(block, moved)
                at_points = np.array([of(block, point, each) for point, each in enumerate(gradients)])
                at_nodes = np.einsum("pg,ge...->ep...", block.shape.extrapolation, at_points, optimize=True)
                mean = mean + averaging @ at_nodes.reshape(block.nodes.size, -1)
            parts.append(np.asarray(mean).reshape(len(self.stations), *shape, -1))
        return np.concatenate(parts, axis=-1)

    def gradient(self, displacement: Array) -> Array:
        """(s, 3, 3, n) ∂u_a/∂x_b at the stations, mean over elements."""
        return self._nodal(displacement, lambda _block, _point, g: g, (3, 3))

    def strain(self, displacement: Array) -> Array:
        return _strain(self.gradient(displacement))

    def stress(self, displacement: Array) -> Array:
        return self._nodal(displacement, lambda block, point, g: block.stress(point, _strain(g)), (6,))

    @property
    def has_one_point(self) -> bool:
        """Whether hexahedra know strain at their middle alone: bent, they have none there, but for what an hourglass control adds."""
        return any(len(block.points) == 1 and block.nodes.shape[1] == HOURGLASSES for block in self.blocks)

    def strain_energy(self, displacement: Array) -> Array:
        """(n,) [J] of the strains at the points of the elements, for displacements (…, n)."""
        parts = [np.zeros(0)]
        for k in range(0, displacement.shape[1], CHUNK):
            moved = displacement[:, k : k + CHUNK]
            parts.append(np.sum([b.energy(map(_strain, self._at_points(b, moved))) for b in self.blocks], axis=0))
        return np.concatenate(parts)

    def energy_error(self, displacement: Array) -> Array:
        """(n,) share of the strain energy that finer elements would add, by how far strains at Gauss points are from those averaged at
        nodes, in each material (Zienkiewicz, Zhu 1987)."""
        parts = [displacement[:, k : k + CHUNK] for k in range(0, displacement.shape[1], CHUNK)]
        off = [sum(each.smoothing_energy(part) for each in self.by_material) for part in parts]
        return np.concatenate([np.zeros(0), *off]) / np.maximum(self.strain_energy(displacement), 1e-300)

    def smoothing_energy(self, displacement: Array) -> Array:
        """(n,) [J] of what the strains at the points differ by from those averaged at nodes."""
        nodal, off = self.strain(displacement), np.zeros(displacement.shape[1])
        for block in self.blocks:
            smooth = nodal[np.searchsorted(self.stations, block.nodes)]
            gradients = self._at_points(block, displacement)
            off += block.energy(
                np.einsum("p,epik->eik", block.shape.functions(at), smooth, optimize=True) - _strain(each)
                for at, each in zip(block.shape.points, gradients, strict=True)
            )
        return off

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
                part = block.part(slice(first, first + ELEMENTS))
                self._add_geometric_stiffness(part, displacement, modes, out)
        return 0.5 * (out + out.transpose(0, 2, 1))

    def _add_geometric_stiffness(self, block: SolidBlock, displacement: Array, modes: Array, out: Array) -> None:
        all_moved, all_slopes = self._at_points(block, displacement), self._at_points(block, modes)
        for point, (moved, slopes, (_, volume)) in enumerate(zip(all_moved, all_slopes, block.points, strict=True)):
            stress = np.einsum("eik,e->kie", block.stress(point, _strain(moved)), volume)
            slopes = np.ascontiguousarray(np.moveaxis(slopes, 0, 2))  # noqa: PLW2901 [a, b] (e, n): ∂φ_a/∂x_b
            for k in range(len(out)):
                weight = stress[k][[0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(3, 3, -1)
                for along in slopes:
                    for b in range(3):
                        pulled = sum(weight[b, c][:, None] * along[c] for c in range(3))
                        out[k] += along[b].T @ pulled


def _strain(g: Array) -> Array:
    """(s, 6, n) from displacement gradients (s, 3, 3, n)."""
    shear = [g[:, a, b] + g[:, b, a] for a, b in SHEARS]
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
