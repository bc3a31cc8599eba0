"""Stresses in the sections of beams, for the colours of the page."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from nivel.machine.beams.beam import Beam
from nivel.machine.machine_record import MachineRecord
from nivel.results.beams import felt, modes_of_nodes
from nivel.results.result import Result
from nivel.view.package import Block
from nivel.view.records import Felt, Quantity, Sections

Array = NDArray[np.float64]
MOST: Final = 2000  # frames: colours between them are mixed
LEAST: Final = 20  # frames: fewer say too little
NUMBERS: Final = 6  # of a point at a frame, with 2 bytes each
# name, unit, rows among strains, curvatures, forces and moments
OFFERED: Final[Sequence[tuple[str, str, list[int]]]] = (
    ("axial force", "N", [6]),
    ("shear force", "N", [7, 8]),
    ("shear force y", "N", [7]),
    ("shear force z", "N", [8]),
    ("torque", "N m", [9]),
    ("bending moment", "N m", [10, 11]),
    ("bending moment y", "N m", [10]),
    ("bending moment z", "N m", [11]),
    ("stretch", "1", [0]),
    ("shear strain", "1", [1, 2]),
    ("twist", "1/m", [3]),
    ("curvature", "1/m", [4, 5]),
)


def sections(result: Result, frames: slice, block: Block, budget: int) -> tuple[Sections | None, list[str]]:
    """Of the beams of a result that are drawn, within `budget` bytes; and in sentences what is left out. frames : those of the package."""
    drawn = [each["name"] for each in result.scene.get("sweeps", [])]
    beams = [(drawn.index(beam.name), beam) for beam in _beams(result) if beam.name in drawn] if drawn else []
    if not beams:
        return None, []
    numbers = np.arange(len(result.time))[frames]
    points = sum(beam.elements * beam.order for _, beam in beams)
    room = min(budget // (2 * NUMBERS * points), MOST)
    if room < min(LEAST, len(numbers)):
        return None, ["Colours of beams by their forces have no room here; `nivel view` with the result has them."]
    taken = np.unique(np.linspace(0, len(numbers) - 1, min(room, len(numbers))).astype(int))
    taken = numbers[taken]
    out, seen = [], []
    for number, beam in beams:
        strain, stress, places = _felt(result, beam, taken)
        seen.append(np.concatenate([strain, stress], axis=2).reshape(-1, 12))
        steps = block.add_steps(np.moveaxis(strain, 2, 0))
        out.append(Felt(number, places.tolist(), steps, beam.properties.stiffness.tolist()))
    values = np.concatenate(seen)
    return Sections(block.add(result.abscissa[taken], "f8"), _quantities(values), out), []


def _beams(result: Result) -> list[Beam]:
    """Those of the machine; none where its record cannot be read, or where the motion is a vibration, made large enough to be seen."""
    if "vibration" in json.loads(str(result.attributes.get("settings", "{}"))):
        return []
    try:
        return list(MachineRecord.model_validate_json(str(result.attributes.get("machine_record", ""))).beams)
    except ValidationError:
        return []


def _felt(result: Result, beam: Beam, taken: NDArray[np.int64]) -> tuple[Array, Array, Array]:
    """Strain and stress (t, p, 6), not finite where a node is nowhere, and places of the points in numbers of nodes."""
    known = {name: k for k, name in enumerate(result.coordinates["body"])}
    nodes = [known[name] for name in beam.node_names]
    place = result.array("position")[taken][:, nodes]
    theta = result.array("orientation")[taken][:, nodes]
    fit = np.all(np.isfinite(place), axis=(1, 2)) & np.all(np.linalg.norm(theta, axis=2) > 0.0, axis=1)
    of = felt(beam, place[fit], theta[fit], modes_of_nodes(result, beam)[taken][fit])
    both = np.full((2, len(taken), *of.strain.shape[1:]), np.nan)
    both[0, fit], both[1, fit] = of.strain, of.stress
    if beam.model == "ancf-cable":
        # the page takes forces from strains: the shear strain that goes with the shear force, though a cable itself has none
        both[0, fit] = of.stress @ np.linalg.inv(beam.properties.stiffness)
    return both[0], both[1], np.interp(of.share, beam.shares, np.arange(len(nodes)))


def _quantities(values: Array) -> list[Quantity]:
    """What is offered, with its ends over values (n, 12)."""
    values = values[np.all(np.isfinite(values), axis=1)]
    out = []
    for name, unit, rows in OFFERED:
        one = values[:, rows[0]] if len(rows) == 1 else np.linalg.norm(values[:, rows], axis=1)
        low = 0.0 if len(rows) > 1 or not len(one) else float(one.min())
        out.append(Quantity(name, unit, rows, low, float(one.max()) if len(one) else 0.0))
    return out
