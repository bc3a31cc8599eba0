"""Solids of STEP files, read by gmsh (OpenCASCADE): names, exact volumes, centres and moments, and surfaces to draw."""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path as FilePath
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.extras import needed, require
from nivel.files.apart import apart
from nivel.lazy import Struct
from nivel.machine.bodies.surface import Triangles, joined
from nivel.machine.core.vectors import Array

KINDS: Final = (".step", ".stp")
FACETS: Final = 24.0  # of a full turn of curved surfaces
MOST_SOLIDS: Final = 5000
STEEL: Final = 7850.0  # [kg/m³], where no density is given


class Solid(Struct):
    """name : of the part, unique in the file. volume [m³], centre (3,) [m] and moments (3, 3) [m⁵] about it, in the axes of the file.

    surface : vertices (n, 3) [m] and triangles (m, 3), to be drawn. colour : `#rrggbb`, or empty.
    """

    name: str
    volume: float
    centre: Array
    moments: Array
    surface: tuple[Array, Triangles]
    colour: str = ""


def step_solids(file: str) -> tuple[Solid, ...]:
    """All solids of a STEP file, as they are placed in its assembly. Raises ModelError."""
    path = FilePath(file)
    try:
        changed = path.stat().st_mtime_ns
    except OSError as error:
        raise ModelError(f"{file} cannot be read: {(error.strerror or str(error)).lower()}") from None
    return _read(str(path.resolve()), changed)


@lru_cache(maxsize=4)
def _read(file: str, _changed: int) -> tuple[Solid, ...]:
    require("STEP files need", "gmsh")
    return apart(solids_here, file, failed=f"{file} cannot be read")


def solids_here(file: str) -> tuple[Solid, ...]:
    """The same in this process, which a damaged file may end."""
    with gmsh_session("STEP files need") as gmsh:
        gmsh.option.setNumber("Geometry.OCCImportLabels", 1)
        try:
            found = gmsh.model.occ.importShapes(file, highestDimOnly=True)
            gmsh.model.occ.synchronize()
        except Exception as error:  # gmsh raises this and nothing more precise
            raise ModelError(f"{file} is no STEP file that can be read: {' '.join(str(error).split())}") from None
        tags = [tag for dimension, tag in found if dimension == 3]
        if not tags:
            raise ModelError(f"{file} has no solids; surfaces and curves have no mass")
        if len(tags) > MOST_SOLIDS:
            raise ModelError(f"{file} has {len(tags)} solids; up to {MOST_SOLIDS} are read")
        gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", FACETS)
        gmsh.model.mesh.generate(2)
        names = _unique([_name(gmsh.model.getEntityName(3, tag), tag) for tag in tags])
        return tuple(_solid(gmsh, tag, name) for tag, name in zip(tags, names, strict=True))


@contextmanager
def gmsh_session(needs: str) -> Iterator[Any]:
    """gmsh with a model of its own, lengths in metres. needs : what needs it, for messages."""
    gmsh = needed("gmsh", needs)
    own = not gmsh.isInitialized()
    if own:
        gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setString("Geometry.OCCTargetUnit", "M")
    gmsh.model.add("nivel")
    try:
        yield gmsh
    finally:
        gmsh.model.remove()
        if own:
            gmsh.finalize()


def _name(path: str, tag: int) -> str:
    """The name of a part in its path `Shapes/crane/arm_left/arm/…`: that of the instance, which the shared shape follows."""
    steps = [step for step in path.split("/") if step]
    if not steps or steps == ["Shapes"]:
        return f"solid_{tag}"
    instance = steps[-2] if len(steps) > 3 else ""
    return steps[-1] if not instance or instance.isdecimal() else instance


def _unique(names: list[str]) -> list[str]:
    counts: dict[str, int] = {}
    out = []
    for name in names:
        counts[name] = counts.get(name, 0) + 1
        out.append(name if counts[name] == 1 else f"{name}_{counts[name]}")
    return out


def _solid(gmsh: Any, tag: int, name: str) -> Solid:
    volume = float(gmsh.model.occ.getMass(3, tag))
    centre = np.array(gmsh.model.occ.getCenterOfMass(3, tag))
    moments = np.array(gmsh.model.occ.getMatrixOfInertia(3, tag)).reshape(3, 3)
    parts: list[tuple[Array, NDArray[Any]]] = []
    size = volume ** (1.0 / 3.0)
    for dimension, face in gmsh.model.getBoundary([(3, tag)], oriented=False):
        numbers, corners, _ = gmsh.model.mesh.getNodes(dimension, face, includeBoundary=True)
        kinds, _, nodes = gmsh.model.mesh.getElements(dimension, face)
        at = np.array(corners).reshape(-1, 3)
        place = {int(number): k for k, number in enumerate(numbers)}
        for kind, each in zip(kinds, nodes, strict=True):
            if kind == 2:
                rows = np.array([place[int(node)] for node in each]).reshape(-1, 3)
                outwards = _is_outwards(gmsh, tag, at[rows], size)
                parts.append((at, rows if outwards else rows[:, ::-1]))
    red, green, blue, alpha = gmsh.model.getColor(3, tag)
    colour = f"#{red:02x}{green:02x}{blue:02x}" if alpha and (red, green, blue) != (0, 0, 255) else ""
    vertices, triangles = joined(parts)
    surface = vertices, triangles.astype(np.uint32)
    return Solid(name, volume, centre, 0.5 * (moments + moments.T), surface, colour)


def _is_outwards(gmsh: Any, tag: int, corners: Array, size: float) -> bool:
    """Whether the triangles (n, 3, 3) of a face are counter-clockwise seen from outside of the solid: by the largest of them."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    k = int(np.argmax(areas))
    depth = max(2e-2 * np.sqrt(areas[k]), 1e-6 * size)  # more than the chord of a curved face is off it
    middle, normal = corners[k].mean(axis=0), normals[k] / areas[k]
    inner = gmsh.model.isInside(3, tag, (middle - depth * normal).tolist())
    outer = gmsh.model.isInside(3, tag, (middle + depth * normal).tolist())
    return bool(inner) or not outer
