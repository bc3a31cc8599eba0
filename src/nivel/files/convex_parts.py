"""Meshes divided into convex parts, and contacts of such meshes as contacts of all their parts.

The parts are those of CoACD (Wei and others 2022). They are kept in the user cache under a digest of the surface.
"""

import json
from hashlib import sha256
from itertools import combinations
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.elements.contacts.contact import ALL, MOST_PAIRS
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
                tree.report((section, name, "shape", KEY), error.faults[0].message, breaks=(section, name))
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
                what = "is the name of a contact of a convex part of"
                tree.report(("forces", part), f"`{part}` {what} `{name}`; take another one")
            forces[part] = {**force, PARTS: [k // second + 1, k % second + 1]}
            tree.copy_places(("forces", name), ("forces", part))
    if forces:
        tree.data["forces"] = forces


TYPE: Final = "contacts"
# keys that single contacts have too
KEPT: Final = ("stiffness", "exponent", "restitution", "friction", "static_friction", "friction_work")


def divide_heaps(tree: Tree) -> None:
    """Put single contacts in place of `contacts` whose friction sticks: NAME_A_B of two bodies, NAME_A_1 of a body and the first
    plane. Those with faults stay, and are reported where the record is made. Faults go to `tree.faults`."""
    given = section_of(tree, "forces")
    forces: dict[str, Any] = {}
    for name, force in given.items():
        names = _spheres(tree, force)
        if names is None:
            forces[name] = force
            continue
        planes = force.get("planes", [])
        planes = planes if isinstance(planes, list) else [planes]
        count = len(names) * (len(names) - 1) // 2 + len(names) * len(planes)
        if count > MOST_PAIRS:
            message = f"`{name}` has {count} pairs, and friction that sticks can be found for {MOST_PAIRS}"
            message += "; with a `friction_transition_speed` they creep"
            tree.report(("forces", name), message)
            continue
        kept = {key: force[key] for key in KEPT if key in force}
        pairs: dict[str, dict[str, Any]] = {
            f"{name}_{first}_{second}": {"bodies": [first, second]} for first, second in combinations(names, 2)
        }
        pairs |= {
            f"{name}_{body}_{k + 1}": {"body": body, "plane": plane} for body in names for k, plane in enumerate(planes)
        }
        for pair, ends in pairs.items():
            if pair in given or pair in forces:
                tree.report(("forces", pair), f"`{pair}` is the name of a contact of `{name}`; take another one")
            forces[pair] = {"type": "contact", **ends, **kept}
            tree.copy_places(("forces", name), ("forces", pair))
    if forces:
        tree.data["forces"] = forces


def _spheres(tree: Tree, force: Any) -> list[str] | None:
    """The bodies of `contacts` that stick; None of all else, and where anything is wrong."""
    if not isinstance(force, dict) or force.get("type") != TYPE or not force.get("friction"):
        return None
    model = force.get("friction_model") or ("coulomb" if "friction_transition_speed" in force else "stiction")
    if model != "stiction" or set(force) - {*KEPT, "type", "name", "friction_model", "between", "planes"}:
        return None
    if not {"stiffness", "restitution"} <= set(force):
        return None
    bodies = section_of(tree, "bodies")
    balls = [
        name
        for name, body in bodies.items()
        if isinstance(body, dict) and isinstance(body.get("shape"), dict) and body["shape"].get("type") == "sphere"
    ]
    names = balls if force.get("between") == ALL else force.get("between")
    if not isinstance(names, list) or len(names) < 2 or len(set(map(str, names))) < len(names):
        return None
    return names if all(name in balls for name in names) else None
