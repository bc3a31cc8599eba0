"""Solids of a STEP file as bodies of a machine, where the assembly places them."""

from __future__ import annotations

from typing import Any, Final

from nivel.exchange.names import Names
from nivel.exchange.notes import Notes
from nivel.exchange.numbers import triple
from nivel.exchange.translation import Translation
from nivel.files.step_file import step_solids

STEEL: Final = 7850.0  # [kg/m³]


def read_step(file: str, name: str, folder: str, density: float | None) -> Translation:
    """Bodies with the exact mass, centre and inertia of each solid; meshes to draw them. folder : of the meshes. Raises ModelError."""
    notes, names = Notes(), Names()
    rho = STEEL if density is None else density
    bodies: dict[str, Any] = {}
    meshes = {}
    for solid in step_solids(file):
        body = names.name("body", solid.name)
        meshes[f"{folder}/{body}.stl"] = (solid.surface[0] - solid.centre, solid.surface[1])
        i = rho * solid.moments
        tensor = {"xx": i[0, 0], "yy": i[1, 1], "zz": i[2, 2], "xy": i[0, 1], "xz": i[0, 2], "yz": i[1, 2]}
        look = {"type": "mesh", "file": f"{folder}/{body}.stl"} | ({"colour": solid.colour} if solid.colour else {})
        bodies[body] = {
            "position": triple(solid.centre),
            "mass": rho * solid.volume,
            "inertia": {key: float(value) for key, value in tensor.items()},
            "looks": [look],
        }
    changed = names.changed(("body",))
    if changed:
        notes.change("names that nivel does not take were changed", "; ".join(changed))
    if density is None:
        notes.change("a STEP file has no densities: 7850 kg/m³ is used; `--density` gives another one")
    notes.change(f"all {len(bodies)} solids are bodies of their own, with the origin in the centre of mass")
    notes.leave("joints: a STEP file has none; write them under `joints:`")
    notes.leave("gravity: write `gravity: [0, 0, -9.81]`")
    description = {"description": f"Names in STEP: {'; '.join(changed)}."} if changed else {}
    title = name.rpartition(".")[0] or name
    return Translation(name, "STEP", {"name": title, **description, "bodies": bodies}, notes, meshes)
