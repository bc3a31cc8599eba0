"""The reduced body: all that a moving flexible body needs to know."""

from collections.abc import Mapping
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.flexible.body.invariants import Invariants
from nivel.lazy import Struct, field, replace
from nivel.machine.core.vectors import Array, Triangles, Whole


class LeftOut(Struct):
    """k modes Z of unit modal mass that are not among the n of the body.

    eigenvalues : (k,) [1/s²]. phi : (i, 6, k) displacement and turn of the interfaces. mass : (k, n) Zᵀ M Φ, stiffness : (k, n) [1/s²]
    Zᵀ K Φ. I3 (3, k), I4 (3, k), I8 (k, 3, 3) : inertia invariants of Z.
    """

    eigenvalues: Array
    phi: Array
    mass: Array
    stiffness: Array
    I3: Array
    I4: Array
    I8: Array

    def beside(self, kept: Whole) -> "LeftOut":
        """The same modes for a body with these of its modes only."""
        return LeftOut(
            self.eigenvalues, self.phi, self.mass[:, kept], self.stiffness[:, kept], self.I3, self.I4, self.I8
        )

    def __add__(self, other: "LeftOut") -> "LeftOut":
        """All modes of both, for the same body."""
        return LeftOut(
            np.concatenate([self.eigenvalues, other.eigenvalues]),
            np.concatenate([self.phi, other.phi], axis=2),
            np.vstack([self.mass, other.mass]),
            np.vstack([self.stiffness, other.stiffness]),
            np.hstack([self.I3, other.I3]),
            np.hstack([self.I4, other.I4]),
            np.concatenate([self.I8, other.I8]),
        )


def own_modes(left: Whole, kept: Whole, eigenvalues: Array, phi: Array, its: Invariants) -> LeftOut:
    """Modes `left` of a body as seen from those `kept`; phi (i, 6, n) of its interfaces, `its` invariants of all modes."""
    none = np.zeros((len(left), len(kept)))
    return LeftOut(eigenvalues[left], phi[:, :, left], none, none, its.I3[:, left], its.I4[:, left], its.I8[left])


class Interface(Struct):
    """A node by name: where markers, joints and forces attach.

    node : its place among the nodes; position : (3,) [m] undeformed, body frame.
    phi : (3, n) its displacement by the modes, psi : (3, n) its small turn by the modes; zero where it has no turn.
    turns : whether the model knows its turn.
    """

    name: str
    node: int
    position: Array
    phi: Array
    psi: Array
    turns: bool


class StressModes(Struct):
    """Modal stress: stress = Σ modes[:, :, j] q_j.

    station_node : (s,) place of the node of each station; labels : (s,) what tells stations at one node apart, or empty.
    modes : (s, 6, n) [Pa] xx, yy, zz, xy, yz, zx: body axes for solids, local axes for beams.
    strain : (s, 6, n) in the same order, shear as γ.
    """

    station_node: Whole
    labels: tuple[str, ...]
    modes: Array
    strain: Array | None = None


class MeshError(Struct):
    """share : (n,) by which the energy of each mode of the body is wrong. dynamic : only where the mode accelerates, as it does when it
    vibrates freely; else wherever it is bent."""

    share: Array
    dynamic: bool


class ReducedBody(Struct):
    """A flexible body in the floating frame of reference.

    **Frame.** The body frame is that of the finite-element model: same origin, same axes. At rest and undeformed the node
    at x in the model's file is at x in the body frame. A node is at r = R + A (x + φ q).

    **Reference conditions** say how the frame moves with the deforming body. `mean-axis`: modes are M-orthogonal to rigid
    motions, so I3 = 0 and the momentum of the deformation vanishes; I4 = 0 likewise. `fixed`: the freedoms in
    `held` have zero displacement in every mode; I3 and I4 are then full.

    **Normalisation.** Modes have unit modal mass: Φᵀ M Φ = I6 = 1 (to round-off) and Φᵀ K Φ = diag(stiffness); modal
    coordinates q are in kg^½ m, modes in kg^-½ (turns kg^-½/m). Elastic force of mode j: -stiffness_j q_j.

    **Turn of nodes.** A triad at a node turns with it: A (1 + (ψ q)~), ψ from the turn freedoms of beams and reference
    nodes, first order in q like the displacement. Nodes of solids have no turn freedoms: their turn is the mean of
    half the curl of the displacement of the elements around, where `modes` has it; else NaN.

    **Mass.** `invariants` from the same mass as the modes, `mass_kind` consistent or lumped.

    **Stiffening.** `stiffening` maps `acceleration` (3, n, n), `angular_acceleration` (3, n, n), `centrifugal` (6, n, n)
    and `interface.NAME` (6, n, n) to geometric stiffness per unit: see `stiffening.py`; empty where it was not asked for.

    **Left out.** `left_out` has the next modes, which a run is judged by; None where they are not known.

    **Loads.** `loads` (n, 6, n_modes) has K Φ at the nodes of the model without ties of surfaces [N, N m per kg^½ m]: what bends it as the
    modes do; None where they were not asked for.

    **Mesh.** `mesh_error` estimates how far the mesh is from its limit; None where it is not known.

    eigenvalues : (n,) [1/s²] stiffness of the modes.
    node_ids : (n,); position : (n, 3) [m]; modes : (n, 6, n_modes) displacement and turn of nodes, NaN where unknown.
    triangles, lines, solids : places of nodes, for pictures and export.
    """

    name: str
    eigenvalues: Array
    invariants: Invariants
    interfaces: tuple[Interface, ...]
    node_ids: Whole
    position: Array
    modes: Array
    reference: str = "mean-axis"
    held: tuple[str, ...] = ()
    mass_kind: str = "consistent"
    mode_names: tuple[str, ...] = ()
    stress: StressModes | None = None
    stiffening: Mapping[str, Array] = field(default_factory=dict)
    triangles: Whole = field(default_factory=lambda: np.zeros((0, 3), dtype=np.int64))
    lines: Whole = field(default_factory=lambda: np.zeros((0, 2), dtype=np.int64))
    solids: Whole = field(default_factory=lambda: np.zeros((0, 4), dtype=np.int64))
    source: str = ""
    left_out: LeftOut | None = None
    mesh_error: MeshError | None = None
    loads: Array | None = None

    @property
    def frequencies(self) -> Array:
        """(n,) [Hz]"""
        return np.sqrt(np.maximum(self.eigenvalues, 0.0)) / (2.0 * np.pi)

    @property
    def mass(self) -> float:
        """[kg]"""
        return self.invariants.I1

    @property
    def centre_of_mass(self) -> Array:
        """(3,) [m] of the undeformed body, body frame."""
        return self.invariants.I2 / self.invariants.I1

    @property
    def inertia(self) -> Array:
        """(3, 3) [kg m²] of the undeformed body about its centre of mass, body axes."""
        c = self.centre_of_mass
        return self.invariants.I7 - self.mass * ((c @ c) * np.eye(3) - np.outer(c, c))

    def keeping(self, modes: Whole) -> "ReducedBody":
        """The body with these of its modes only, places from 0."""
        take = np.asarray(modes, dtype=np.int64)
        change = np.eye(len(self.eigenvalues))[:, take]
        stress = self.stress
        if stress is not None:
            strain = None if stress.strain is None else stress.strain[:, :, take]
            stress = replace(stress, modes=stress.modes[:, :, take], strain=strain)
        return replace(
            self,
            eigenvalues=self.eigenvalues[take],
            invariants=self.invariants.of_modes(change),
            interfaces=tuple(replace(each, phi=each.phi[:, take], psi=each.psi[:, take]) for each in self.interfaces),
            modes=self.modes[:, :, take],
            mode_names=tuple(self.mode_names[k] for k in take) if self.mode_names else (),
            stress=stress,
            stiffening={name: each[:, take][:, :, take] for name, each in self.stiffening.items()},
            left_out=self._left_out_of(take),
            mesh_error=None if self.mesh_error is None else replace(self.mesh_error, share=self.mesh_error.share[take]),
            loads=None if self.loads is None else self.loads[:, :, take],
        )

    def _left_out_of(self, kept: Whole) -> LeftOut | None:
        """What the body leaves out with these of its modes only: the others, and what it left out before."""
        if self.left_out is None:
            return None
        left = np.setdiff1d(np.arange(len(self.eigenvalues)), kept)
        phi = np.array([np.vstack([each.phi, each.psi]) for each in self.interfaces]).reshape(
            len(self.interfaces), 6, len(self.eigenvalues)
        )
        own = own_modes(left, kept, self.eigenvalues, phi, self.invariants)
        return own + self.left_out.beside(kept)

    def interface(self, name: str) -> Interface:
        """The interface of this name. Raises KeyError."""
        for each in self.interfaces:
            if each.name == name:
                return each
        raise KeyError(name)


# Bars without a surface of their own are drawn this thick, as a share of the extent of the body.
THICKNESS: Final = 0.012
# More numbers than these in the modes of a surface would make a result too large.
MOST: Final = 3_000_000


class MovingSurface(Struct):
    """vertices (n, 3) [m] undeformed, body frame; triangles (m, 3); modes (k, n, 3) displacement of each vertex by each mode.

    nodes : (n,) place of the node of the body that each vertex is at, or moves with.
    """

    vertices: Array
    triangles: Triangles
    modes: Array
    nodes: NDArray[np.int64]


def moving_surface(body: ReducedBody) -> MovingSurface | None:
    """The surface of a solid, or square bars along lines; None where there is none, or where it has more than MOST numbers."""
    if len(body.triangles):
        used, triangles = np.unique(body.triangles, return_inverse=True)
        displacement = np.nan_to_num(body.modes[used, :3]).transpose(2, 0, 1)
        surface = MovingSurface(body.position[used], triangles.reshape(-1, 3).astype(np.uint32), displacement, used)
    elif len(body.lines):
        surface = _bars(body)
    else:
        return None
    return surface if surface.modes.size <= MOST else None


def _bars(body: ReducedBody) -> MovingSurface:
    """Four vertices at each end of each line; they turn with its nodes."""
    half = 0.5 * THICKNESS * float(np.ptp(body.position, axis=0).max())
    ends = body.position[body.lines[:, :2]]
    along = ends[:, 1] - ends[:, 0]
    across = np.cross(along, np.eye(3)[np.argmin(np.abs(along), axis=1)])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    other = np.cross(along, across)
    other /= np.linalg.norm(other, axis=1, keepdims=True)
    corners = half * np.stack([across + other, -across + other, -across - other, across - other], axis=1)
    vertices = (ends[:, :, None] + corners[:, None]).reshape(-1, 3)
    modes = np.nan_to_num(body.modes[body.lines[:, :2]])  # (lines, 2, 6, k)
    turns = np.cross(modes[:, :, None, 3:], corners[:, None, :, :, None], axis=3)
    displacement = (modes[:, :, None, :3] + turns).reshape(-1, 3, modes.shape[-1]).transpose(2, 0, 1)
    sides = [(k, (k + 1) % 4, 4 + k) for k in range(4)] + [((k + 1) % 4, 4 + (k + 1) % 4, 4 + k) for k in range(4)]
    caps = [(0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7)]
    first = 8 * np.arange(len(ends))[:, None, None]
    triangles = (first + np.array([*sides, *caps])).reshape(-1, 3).astype(np.uint32)
    return MovingSurface(vertices, triangles, displacement, np.repeat(body.lines[:, :2], 4).astype(np.int64))
