"""Solids meshed by gmsh: parts added and cut, or a STEP file."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

import numpy as np

from nivel.errors import ModelError
from nivel.extras import needed, require
from nivel.files.apart import apart
from nivel.flexible.model.model import Array, Whole
from nivel.flexible.model.solid_records import BoxPart, ConePart, CylinderPart, Part, Solid, SpherePart
from nivel.lazy import dataclass

TETRAHEDRON_10: Final = 11  # gmsh's number of the element type
TO_VTK: Final = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]  # gmsh has the edges 23 and 13 the other way round
MOST: Final = 2e6  # elements: more would fill the memory
LONGEST: Final = 7200.0  # [s] of meshing
NEEDS: Final = "a `solid` needs"
AROUND: Final = 12  # elements around a circle at least


@dataclass(frozen=True)
class SolidMesh:
    """Tetrahedra (e, 10) of nodes at (n, 3) [m], and the exact volume of the shape [m³]."""

    nodes: Whole
    position: Array
    volume: float


@contextmanager
def _session() -> Iterator[Any]:
    gmsh = needed("gmsh", NEEDS)
    started = not gmsh.isInitialized()
    if started:
        gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.model.add("nivel")
    try:
        yield gmsh
    finally:
        gmsh.model.remove()
        if started:
            gmsh.finalize()


def meshed(solid: Solid, step_file: Path | None) -> SolidMesh:
    """The mesh of a solid: quadratic tetrahedra of about `element_size`, finer around curves.

    Raises ModelError where the shape cannot be made or meshed.
    """
    require(NEEDS, "gmsh")
    what = "the solid" if step_file is None else f"the solid of `{step_file}`"
    return apart(meshed_here, solid, step_file, failed=f"{what} cannot be meshed", longest=LONGEST)


def meshed_here(solid: Solid, step_file: Path | None) -> SolidMesh:
    """The same in this process, which a damaged file may end."""
    with _session() as gmsh:
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
    gmsh.option.setString("Geometry.OCCTargetUnit", "M")
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
    _, nodes = gmsh.model.mesh.getElementsByType(TETRAHEDRON_10)
    if not len(nodes):
        raise ModelError("the solid cannot be meshed: gmsh gave no tetrahedra; try another `element_size`")
    place = np.zeros(int(tags.max()) + 1, dtype=np.int64)
    place[tags] = np.arange(len(tags))
    elements = place[nodes].reshape(-1, 10)[:, TO_VTK]
    used, renumbered = np.unique(elements, return_inverse=True)
    return renumbered.reshape(elements.shape), coordinates.reshape(-1, 3)[used]
