"""Meshes divided into convex parts, and contacts of such meshes as contacts of all their parts.

The parts are those of CoACD (Wei and others 2022). They are kept in the user cache under a digest of the surface.
"""

from __future__ import annotations

import json
from hashlib import sha256
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.extras import needed, require
from nivel.files.apart import apart
from nivel.files.outline import section_of
from nivel.files.tree import Tree
from nivel.machine.bodies.shape import MOST_PARTS
from nivel.machine.bodies.surface import surface_arrays, surface_text
from nivel.native.store import folder, whole

PARTS: Final = "parts"
KEY: Final = "convex_parts"
FAILED: Final = "the mesh cannot be divided into convex parts"
VERSION: Final = b"1"  # of what stands in the cache


def divide_meshes(tree: Tree) -> None:
    """Put the convex parts of each mesh with `convex_parts` into its shape, and contacts of the parts in place of those of the mesh. Faults
    go to `tree.faults`."""
    counts: dict[str, int] = {}
    for section, name, body in _elements(tree):
        shape = body.get("shape") if isinstance(body, dict) else None
        if not isinstance(shape, dict) or "surface" not in shape:
            continue
        most = shape.get(KEY, 1)
        if isinstance(most, bool) or not isinstance(most, int) or not 1 < most <= MOST_PARTS:
            continue  # reported where the record is made
        if PARTS not in shape:
            try:
                shape[PARTS] = convex_parts(str(shape["surface"]), most)
            except ModelError as error:
                tree.report((section, name, "shape", KEY), error.faults[0].message)
                tree.broken.add((section, name))
                continue
        counts[name] = len(shape[PARTS])
    if counts:
        _divide_contacts(tree, counts)


def _elements(tree: Tree) -> list[tuple[str, str, Any]]:
    """Section, name and data of everything that may have a shape that touches."""
    return [(section, *each) for section in ("bodies", "markers") for each in section_of(tree, section).items()]


def convex_parts(surface: str, most: int) -> list[str]:
    """Surfaces of at most `most` convex parts of a surface. Raises ModelError."""
    file = folder().parent / "convex-parts" / f"{sha256(VERSION + bytes([most]) + surface.encode()).hexdigest()}.json"
    try:
        return [str(each) for each in json.loads(file.read_text(encoding="utf-8"))]
    except (OSError, ValueError):
        pass
    texts = _divided(surface, most)
    try:
        file.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        with whole(file) as draft:
            draft.write_text(json.dumps(texts), encoding="utf-8")
    except OSError:
        pass  # the next run divides it again
    return texts


def _divided(surface: str, most: int) -> list[str]:
    """The parts, from a process of its own: gmsh cannot be initialised in one that has loaded the library."""
    require("`convex_parts` of a mesh need", "coacd")
    parts = apart(parts_here, *surface_arrays(surface), most, failed=FAILED)
    if not parts:
        raise ModelError(f"{FAILED}; is it closed?")
    return [surface_text(np.array(points, float), np.array(faces, np.uint32)) for points, faces in parts]


def parts_here(vertices: NDArray[Any], triangles: NDArray[Any], most: int) -> list[tuple[NDArray[Any], NDArray[Any]]]:
    """Vertices and triangles of at most `most` parts, in this process. Raises ModelError."""
    coacd = needed("coacd", "`convex_parts` of a mesh need")
    coacd.set_log_level("off")
    mesh = coacd.Mesh(np.array(vertices), np.array(triangles, np.int32))
    try:
        found = coacd.run_coacd(mesh, max_convex_hull=most, seed=0)
    except (RuntimeError, ValueError) as error:
        raise ModelError(f"{FAILED}: {error}") from None
    return [(np.asarray(points), np.asarray(faces)) for points, faces in found]


def _divide_contacts(tree: Tree, counts: dict[str, int]) -> None:
    """A contact of two bodies becomes one for each pair of their parts: NAME_1, NAME_2, …"""
    forces: dict[str, Any] = {}
    for name, force in section_of(tree, "forces").items():
        pair = force.get("bodies") if isinstance(force, dict) and force.get("type") == "contact" else None
        if not isinstance(pair, list) or len(pair) != 2 or PARTS in force:
            forces[name] = force
            continue
        first, second = (counts.get(each, 1) if isinstance(each, str) else 1 for each in pair)
        if first * second == 1:
            forces[name] = force
            continue
        for k in range(first * second):
            part = f"{name}_{k + 1}"
            if part in tree.data["forces"]:
                tree.report(
                    ("forces", part),
                    f"`{part}` is the name of a contact of a convex part of `{name}`; take another one",
                )
                tree.broken.add(("forces", part))
            forces[part] = {**force, PARTS: [k // second + 1, k % second + 1]}
            for places in (tree.places, tree.keys):
                for path in [path for path in places if path[:2] == ("forces", name)]:
                    places["forces", part, *path[2:]] = places[path]
    if forces:
        tree.data["forces"] = forces
