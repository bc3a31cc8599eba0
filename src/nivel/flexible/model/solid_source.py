"""Solids as model files say them: parts added and cut, or a STEP file; meshed by gmsh, assembled with scikit-fem."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

import numpy as np
import scipy.sparse as sp
from scipy.spatial import KDTree

from nivel.elements.beams.sections import Material
from nivel.errors import ModelError, retold
from nivel.extras import needed, require
from nivel.files.apart import apart
from nivel.files.step_file import gmsh_session
from nivel.flexible.model.model import Array, FiniteElementModel, PointMass, Sparse, Whole, at_nodes
from nivel.flexible.model.model_file import Located
from nivel.flexible.model.records import BoxPart, ConePart, CylinderPart, Part, Solid, SpherePart
from nivel.flexible.model.selection import NodeSets
from nivel.flexible.model.solid_elements import SolidBlock, SolidElements, elasticity, surface
from nivel.flexible.model.solid_shapes import TETRAHEDRON_10
from nivel.lazy import Struct, meshio, skfem

GMSH_TYPE: Final = 11  # gmsh's number of quadratic tetrahedra
TO_VTK: Final = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]  # gmsh has the edges 23 and 13 the other way round
MOST: Final = 2e6  # elements: more would fill the memory
LONGEST: Final = 7200.0  # [s] of meshing
AROUND: Final = 12  # elements around a circle at least


class SolidMesh(Struct):
    """Tetrahedra (e, 10) of nodes at (n, 3) [m], and the exact volume of the shape [m³]."""

    nodes: Whole
    position: Array
    volume: float


def meshed(solid: Solid, step_file: Path | None) -> SolidMesh:
    """The mesh of a solid: quadratic tetrahedra of about `element_size`, finer around curves.

    Raises ModelError where the shape cannot be made or meshed.
    """
    require(NEEDS, "gmsh")
    what = "the solid" if step_file is None else f"the solid of `{step_file}`"
    return apart(meshed_here, solid, step_file, failed=f"{what} cannot be meshed", longest=LONGEST)


def meshed_here(solid: Solid, step_file: Path | None) -> SolidMesh:
    """The same in this process, which a damaged file may end."""
    with gmsh_session(NEEDS) as gmsh:
        try:
            volumes = _from_step(gmsh, step_file) if step_file is not None else _from_parts(gmsh, solid.parts)
        except ModelError:
            raise
        except Exception as error:  # gmsh raises the bare class
            what = f"the STEP file `{step_file}`" if step_file is not None else "the shape"
            raise ModelError(f"{what} cannot be made: {error}") from None
        if len(volumes) != 1:
            what = f"falls into {len(volumes)} pieces" if volumes else "has no volume"
            raise ModelError(
                f"the solid {what}; one connected solid was expected. Let the parts overlap or touch in a face"
            )
        volume = float(gmsh.model.occ.getMass(3, volumes[0][1]))
        count = 8.0 * volume / solid.element_size**3  # tetrahedra of this edge in so much space
        if count > MOST:
            raise ModelError(
                f"a volume of {volume:.3g} m^3 and elements of {solid.element_size:.3g} m would make {count:.2g} elements; "
                "give a larger `element_size`, or look for a slip of a unit"
            )
        return SolidMesh(*_meshed(gmsh, solid.element_size), volume)


def _from_step(gmsh: Any, path: Path) -> list[tuple[int, int]]:
    if not path.is_file():
        raise ModelError(f"there is no file `{path}`")
    shapes = gmsh.model.occ.importShapes(str(path), highestDimOnly=True)
    volumes = [shape for shape in shapes if shape[0] == 3]
    if len(volumes) > 1:
        volumes = gmsh.model.occ.fuse(volumes[:1], volumes[1:])[0]
    gmsh.model.occ.synchronize()
    return [shape for shape in volumes if shape[0] == 3]


def _from_parts(gmsh: Any, parts: tuple[Part, ...]) -> list[tuple[int, int]]:
    present: list[tuple[int, int]] = []
    for part in parts:
        shape = [(3, _part(gmsh.model.occ, part))]
        if not present:
            present = shape
        elif part.cut:
            present = gmsh.model.occ.cut(present, shape)[0]
        else:
            present = gmsh.model.occ.fuse(present, shape)[0]
    gmsh.model.occ.synchronize()
    return [shape for shape in present if shape[0] == 3]


def _part(occ: Any, part: Part) -> int:
    match part:
        case BoxPart():
            low, high = np.minimum(part.from_, part.to), np.maximum(part.from_, part.to)
            return occ.addBox(*low, *(high - low))
        case CylinderPart():
            return occ.addCylinder(*part.from_, *np.subtract(part.to, part.from_), part.radius)
        case ConePart():
            return occ.addCone(*part.from_, *np.subtract(part.to, part.from_), part.radius, part.end_radius)
        case SpherePart():
            return occ.addSphere(*part.centre, part.radius)


def _meshed(gmsh: Any, size: float) -> tuple[Whole, Array]:
    options = {
        "Mesh.MeshSizeMax": size,
        "Mesh.MeshSizeMin": 0.2 * size,
        "Mesh.MeshSizeFromCurvature": AROUND,
        "Mesh.ElementOrder": 2,
        "Mesh.HighOrderOptimize": 1,
        "General.NumThreads": 1,
    }
    for name, value in options.items():
        gmsh.option.setNumber(name, value)
    try:
        gmsh.model.mesh.generate(3)
    except Exception as error:
        raise ModelError(f"the solid cannot be meshed: {error}; try another `element_size`") from None
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    _, nodes = gmsh.model.mesh.getElementsByType(GMSH_TYPE)
    if not len(nodes):
        raise ModelError("the solid cannot be meshed: gmsh gave no tetrahedra; try another `element_size`")
    place = np.zeros(int(tags.max()) + 1, dtype=np.int64)
    place[tags] = np.arange(len(tags))
    elements = place[nodes].reshape(-1, 10)[:, TO_VTK]
    used, renumbered = np.unique(elements, return_inverse=True)
    return renumbered.reshape(elements.shape), coordinates.reshape(-1, 3)[used]


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
    place = ("solid",) if solid.file is None else ("solid", "file")
    with retold(lambda fault: located.fault(place, fault.message, at_key=solid.file is None)):
        mesh = meshed(solid, None if solid.file is None else located.beside(solid.file))
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
