"""Frames of beams: from nodes, sections and materials to a finite-element model."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from itertools import pairwise

import numpy as np
import scipy.sparse as sp

from nivel.elements.beams.sections import section_of
from nivel.errors import refuse
from nivel.flexible.model.beam import Beam, end_stress, geometric_stiffness, mass_points, stiffness
from nivel.flexible.model.model import Array, FiniteElementModel, PointMass, Sparse, Whole, numbered
from nivel.flexible.model.model_file import Located
from nivel.lazy import dataclass, field


@dataclass
class Mesh:
    """Beams between nodes while the frame is put together. axes : (3, 3) rows are the local axes of a beam."""

    position: list[Array] = field(default_factory=list)
    ends: list[tuple[int, int]] = field(default_factory=list)
    beams: list[Beam] = field(default_factory=list)
    axes: list[Array] = field(default_factory=list)
    names: list[str] = field(default_factory=list)

    def node(self, position: Array) -> int:
        """Add a node; its number."""
        self.position.append(np.asarray(position, dtype=float))
        return len(self.position) - 1


def local_axes(along: Array, up: Array | None) -> Array:
    """(3, 3) rows x, y, z of a beam along (3,): z is as near to `up` as it can be; default z, for vertical beams x."""
    x = along / np.linalg.norm(along)
    if up is None:
        up = np.array([0.0, 0.0, 1.0]) if abs(x[2]) < 0.999 else np.array([1.0, 0.0, 0.0])
    z = up - (up @ x) * x
    z = z / np.linalg.norm(z)
    return np.array([x, np.cross(z, x), z])


def assembled(
    name: str, mesh: Mesh, names: Mapping[str, int], point_masses: Mapping[int, float], *, lumped: bool
) -> FiniteElementModel:
    """The model of the beams of `mesh` and of `point_masses` [kg] at nodes."""
    position = np.array(mesh.position)
    freedoms = numbered(np.ones((len(position), 6), dtype=bool))
    elements = BeamElements(freedoms, tuple(mesh.ends), tuple(mesh.beams), np.array(mesh.axes), tuple(mesh.names))
    K = elements.summed([stiffness(beam) for beam in mesh.beams])
    return FiniteElementModel(
        name=name,
        node_ids=np.arange(1, len(position) + 1),
        position=position,
        freedoms=freedoms,
        stiffness=sp.csc_array(K),
        mass=_mass(position, freedoms, elements, point_masses, lumped),
        expansion=sp.csr_array(sp.eye_array(freedoms.size)),
        names=dict(names),
        elements=elements,
        lines=np.array(mesh.ends),
        volume=float(sum(beam.section.area * beam.length for beam in mesh.beams)),
    )


def _mass(
    position: Array, freedoms: Whole, elements: BeamElements, point_masses: Mapping[int, float], lumped: bool
) -> PointMass:
    masses, places, rows, columns, values = [], [], [], [], []
    count = 0
    for e, beam in enumerate(elements.beams):
        mass, place, shape = mass_points(beam, lumped=lumped)
        R, T = elements.axes[e], elements.turning(e)
        at_global = np.einsum("ba,pbj->paj", R, shape @ T)
        masses.append(mass)
        places.append(position[elements.ends[e][0]] + place @ R)
        p, a, j = np.nonzero(at_global)
        rows.append(3 * (count + p) + a)
        columns.append(elements.columns[e][j])
        values.append(at_global[p, a, j])
        count += len(mass)
    for node, mass in point_masses.items():
        masses.append(np.array([mass]))
        places.append(position[[node]])
        rows.append(3 * count + np.arange(3))
        columns.append(freedoms[node, :3])
        values.append(np.ones(3))
        count += 1
    shape = sp.csr_array(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(3 * count, freedoms.size)
    )
    return PointMass(np.concatenate(places), shape, sp.csr_array(sp.diags_array(np.concatenate(masses))))


@dataclass(frozen=True)
class BeamElements:
    """The beams of a frame: stress at the fibres of both ends.

    ends : nodes of each beam; axes : (e, 3, 3) local axes as rows; names : of the beams in the model file.
    Stress is in local axes; where beams meet every one has its own stations.
    """

    freedoms: Whole
    ends: tuple[tuple[int, int], ...]
    beams: tuple[Beam, ...]
    axes: Array
    names: tuple[str, ...]

    @cached_property
    def columns(self) -> list[Whole]:
        """(12,) freedoms of the nodes of each beam."""
        return [np.concatenate([self.freedoms[i], self.freedoms[j]]) for i, j in self.ends]

    def turning(self, e: int) -> Array:
        """(12, 12) local from global freedoms."""
        return np.kron(np.eye(4), self.axes[e])

    def summed(self, local: list[Array]) -> Sparse:
        """(F, F) sum of local (12, 12) matrices."""
        blocks = np.array([T.T @ block @ T for block, T in ((b, self.turning(e)) for e, b in enumerate(local))])
        columns = np.array(self.columns)
        rows = np.repeat(columns, 12, axis=1).ravel()
        count = int(self.freedoms.max()) + 1
        return sp.csr_array((blocks.ravel(), (rows, np.tile(columns, (1, 12)).ravel())), shape=(count, count))

    def station_nodes(self) -> Whole:
        return np.array(
            [
                node
                for e, beam in enumerate(self.beams)
                for node in self.ends[e]
                for _ in range(len(beam.section.fibres))
            ]
        )

    def station_labels(self) -> tuple[str, ...]:
        """``main, y 0.05 z 0.1``: the beam and the fibre."""
        return tuple(
            f"{self.names[e]}, y {y:.4g} z {z:.4g}"
            for e, beam in enumerate(self.beams)
            for _ in range(2)
            for y, z in beam.section.fibres
        )

    def stress(self, displacement: Array) -> Array:
        parts = []
        for e, beam in enumerate(self.beams):
            local = self.turning(e) @ displacement[self.columns[e]]
            parts.append((end_stress(beam) @ local).reshape(-1, 6, displacement.shape[1]))
        return np.concatenate(parts)

    def strain(self, displacement: Array) -> Array:
        parts = []
        stress = self.stress(displacement)
        at = 0
        for beam in self.beams:
            count = 2 * len(beam.section.fibres)
            part, material = stress[at : at + count], beam.material
            strain = part / material.shear_modulus
            strain[:, 0] = part[:, 0] / material.youngs_modulus
            strain[:, 1] = strain[:, 2] = -material.poisson_ratio * strain[:, 0]
            parts.append(strain)
            at += count
        return np.concatenate(parts)

    def geometric_stiffness(self, displacement: Array, modes: Array) -> Array:
        """Of the tension of each beam; its bending moments and torque are left out."""
        out = np.zeros((displacement.shape[1], modes.shape[1], modes.shape[1]))
        for e, beam in enumerate(self.beams):
            u, phi = (self.turning(e) @ each[self.columns[e]] for each in (displacement, modes))
            tension = beam.material.youngs_modulus * beam.section.area * (u[6] - u[0]) / beam.length
            out += tension[:, None, None] * (phi.T @ geometric_stiffness(beam) @ phi)
        return 0.5 * (out + out.transpose(0, 2, 1))


def frame_model(located: Located) -> FiniteElementModel:
    """The finite-element model of the `frame` of a model file. Every node of a frame has six freedoms.

    Raises ModelError.
    """
    record, frame = located.record, located.record.frame
    assert frame is not None
    mesh = Mesh()
    names = {name: mesh.node(np.array(position)) for name, position in frame.nodes.items()}
    faults = []
    used: set[str] = set()
    for name, beam in frame.beams.items():
        used.update(beam.nodes)
        first, last = (names[node] for node in beam.nodes)
        start, span = mesh.position[first], mesh.position[last] - mesh.position[first]
        up = None if beam.up is None else np.array(beam.up)
        if up is not None and np.linalg.norm(np.cross(up, span)) < 1e-9 * np.linalg.norm(span) * max(
            np.linalg.norm(up), 1e-300
        ):
            faults.append(located.fault(("frame", "beams", name, "up"), "`up` must not be along the beam, nor zero"))
            continue
        material = record.materials[beam.material]
        section = section_of(record.sections[beam.section], material.poisson_ratio)
        between = [mesh.node(start + k / beam.elements * span) for k in range(1, beam.elements)]
        chain = [first, *between, last]
        length = float(np.linalg.norm(span)) / beam.elements
        for i, j in pairwise(chain):
            mesh.ends.append((i, j))
            mesh.beams.append(Beam(length, section, material, frame.theory == "timoshenko"))
            mesh.axes.append(local_axes(span, up))
            mesh.names.append(name)
    lost = "no beam ends at this node: remove it, or join it"
    faults += [located.fault(("frame", "nodes", name), lost) for name in frame.nodes if name not in used]
    refuse(faults)
    masses: dict[int, float] = {}
    for mass in frame.masses.values():
        masses[names[mass.node]] = masses.get(names[mass.node], 0.0) + mass.mass
    return assembled(record.name, mesh, names, masses, lumped=record.reduction.mass == "lumped")
