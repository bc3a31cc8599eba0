"""Solids as model files say them: meshed, assembled with scikit-fem."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import scipy.sparse as sp
from scipy.spatial import KDTree

from nivel.errors import ModelError
from nivel.extras import needed, require
from nivel.flexible.model.mesher import SolidMesh, meshed
from nivel.flexible.model.model import Array, FiniteElementModel, PointMass, Sparse, Whole, at_nodes
from nivel.flexible.model.model_file import Located
from nivel.flexible.model.selection import NodeSets
from nivel.flexible.model.solid_elements import SolidBlock, SolidElements, elasticity, surface
from nivel.flexible.model.solid_shapes import TETRAHEDRON_10
from nivel.lazy import meshio, skfem
from nivel.machine.beams.section import Material

# degree of the polynomials that are integrated exactly: products of two shape functions, and of their derivatives
MASS_DEGREE, STIFFNESS_DEGREE = 4, 2
AXES = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))
NEEDS, SOLID_LIBRARIES = "a `solid` needs", ("gmsh", "skfem", "meshio")


def solid_model(located: Located, say: Callable[[str, float], None]) -> tuple[FiniteElementModel, NodeSets]:
    """The finite-element model of the `solid` of a model file; it has no node sets.

    Raises ModelError.
    """
    solid = located.record.solid
    assert solid is not None
    require(NEEDS, *SOLID_LIBRARIES)
    for library in SOLID_LIBRARIES:
        needed(library, NEEDS)
    say("meshing the solid", 0.0)
    try:
        mesh = meshed(solid, None if solid.file is None else located.beside(solid.file))
    except ModelError as error:
        place = ("solid", "file") if solid.file is not None else ("solid",)
        raise ModelError(
            [located.fault(place, each.message, at_key=place == ("solid",)) for each in error.faults]
        ) from None
    say(f"assembling {len(mesh.nodes)} tetrahedra", 0.4)
    return assembled(located.record.name, mesh, located.record.materials[solid.material]), {}


def assembled(name: str, mesh: SolidMesh, material: Material) -> FiniteElementModel:
    """The model of a mesh. Raises ModelError where an element is turned inside out."""
    block = SolidBlock(TETRAHEDRON_10, mesh.nodes, mesh.position, elasticity=elasticity(material)[None, None])
    bad = block.inverted()
    if len(bad):
        raise ModelError(
            f"{len(bad)} of {len(mesh.nodes)} elements are turned inside out: {_numbers(bad)}; mesh finer around curves"
        )
    stiffness, mass = matrices(mesh, material)
    exact = material.density * mesh.volume
    note = f"The mesh weighs {mass.sum():.6g} kg, the shape itself {exact:.6g} kg ({100 * (mass.sum() / exact - 1):+.2g} %)."
    freedoms = np.arange(3 * len(mesh.position)).reshape(-1, 3)
    has_turns = np.full((len(mesh.position), 3), -1)
    all_freedoms = np.hstack([freedoms, has_turns])
    return FiniteElementModel(
        name=name,
        node_ids=np.arange(1, len(mesh.position) + 1),
        position=mesh.position,
        freedoms=all_freedoms,
        stiffness=stiffness,
        mass=PointMass(mesh.position, at_nodes(all_freedoms, freedoms.size), mass),
        expansion=sp.csr_array(sp.eye_array(freedoms.size)),
        elements=SolidElements((block,), freedoms, mesh.position),
        triangles=surface([block]),
        solids=mesh.nodes,
        volume=mesh.volume,
        notes=(note,),
    )


def _numbers(elements: Whole) -> str:
    shown = ", ".join(str(each + 1) for each in elements[:6])
    return shown if len(elements) <= 6 else f"{shown}, …"


def matrices(mesh: SolidMesh, material: Material) -> tuple[Sparse, sp.csr_array]:
    """Stiffness (3 n, 3 n) [N/m], node by node x, y, z, and scalar mass (n, n) [kg], by scikit-fem.

    The stiffness between two nodes is λ G + μ (Gᵀ + tr G), of G_ab = ∫ ∂_a N_i ∂_b N_j dV: nine scalar forms, which need a ninth of the
    memory that the form of vectors does.
    """
    grid = skfem.io.meshio.from_meshio(meshio.Mesh(mesh.position, [("tetra10", mesh.nodes)]))
    basis: Any = skfem.Basis(grid, skfem.ElementTetP2(), intorder=MASS_DEGREE)
    node = np.argsort(_nodes_of(basis.doflocs.T, mesh.position))
    mass = _reordered(skfem.models.poisson.mass.assemble(basis) * material.density, node)
    basis = skfem.Basis(grid, skfem.ElementTetP2(), intorder=STIFFNESS_DEGREE)
    products: dict[tuple[int, int], Any] = {}
    slope: Any = skfem.helpers.grad
    for a, b in AXES:
        form: Any = skfem.BilinearForm(lambda u, v, _, a=a, b=b: slope(v)[a] * slope(u)[b])
        products[a, b] = _reordered(form.assemble(basis), node)
        products[b, a] = sp.csr_array(products[a, b].T)
    return _stiffness(
        products, *skfem.models.elasticity.lame_parameters(material.youngs_modulus, material.poisson_ratio)
    ), mass


def _reordered(matrix: Any, order: Whole) -> sp.csr_array:
    rows: Any = sp.csr_array(matrix)
    return sp.csr_array(rows[order][:, order])


def _stiffness(products: dict[tuple[int, int], Any], lame: float, shear: float) -> Sparse:
    """(3 n, 3 n) from the products of slopes G_ab (n, n) [m]."""
    trace = products[0, 0] + products[1, 1] + products[2, 2]
    rows, columns, values = [], [], []
    for (a, b), product in products.items():
        block = lame * product + shear * products[b, a]
        block = sp.coo_array(block + shear * trace if a == b else block)
        rows.append(3 * block.coords[0] + a)
        columns.append(3 * block.coords[1] + b)
        values.append(block.data)
    count = 3 * trace.shape[0]
    places = (np.concatenate(rows), np.concatenate(columns))
    return sp.csc_array((np.concatenate(values), places), shape=(count, count))


def _nodes_of(places: Array, position: Array) -> Whole:
    """(n,) the node at each place."""
    found: Any = KDTree(position).query(places)
    distance, node = found
    if distance.max() > 1e-6 * np.ptp(position, axis=0).max() or len(np.unique(node)) != len(node):
        raise ModelError("the mesh has nodes that coincide, or elements whose edges are not shared: merge them first")
    return node
