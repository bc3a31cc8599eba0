"""Stress of flexible bodies at the vertices that are drawn, and forces in the sections of beams, for the colours of the page."""

import json
from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from nivel.elements.beams.beam import Beam
from nivel.errors import ModelError
from nivel.flexible.body.body import ReducedBody, moving_surface
from nivel.flexible.body.recovery import stress, von_mises
from nivel.machine.core.vectors import Array, Whole
from nivel.machine.machine_record import MachineRecord
from nivel.results.beams import felt, modes_of_nodes
from nivel.results.result import Result
from nivel.results.stress import ATTRIBUTE, RecoveredBody
from nivel.view.package import Block
from nivel.view.records import Felt, Flexible, Quantity, Sections, Stress

WORK: Final = 2e9  # products that the largest stress is found with: of a long run of a large body in some of the frames
AT_ONCE: Final = 1_000_000  # stresses


def with_stress(result: Result, bodies: list[Flexible], block: Block, budget: int) -> tuple[list[Flexible], list[str]]:
    """The flexible bodies of a result with their stress, where it is known and has room within `budget` bytes; in sentences which have not.

    Bodies whose reduction knows no stress say nothing.
    """
    out, missing = [], []
    for each in bodies:
        if not _is_kept(result, each.name):
            out.append(each)
            continue
        try:
            recovered = RecoveredBody(result, each.name)
            found = _stress(recovered, each, block, budget)
        except ModelError as error:
            found, text = None, str(error)
            missing.append(f"{each.name} has no colours by stress: {text}")
        except _NoRoomError as error:
            found = None
            missing.append(
                f"{each.name} has no colours by stress: its modal stresses take {error.size / 1e6:.1f} MB, "
                "more than there is room for here; `nivel view` with the result has more"
            )
        if found:
            budget -= found.modes.numbers.shape[0] * 12 * found.modes.numbers.shape[2]
        out.append(replace(each, stress=found))
    return out, missing


class _NoRoomError(Exception):
    """Modal stresses of `size` bytes."""

    def __init__(self, size: int) -> None:
        super().__init__(size)
        self.size = size


def _is_kept(result: Result, name: str) -> bool:
    """Whether the result says where the body came from; motions of vibrations do not."""
    kept = json.loads(str(result.attributes.get(ATTRIBUTE, "[]")))
    return any(each["name"] == name for each in kept)


def _stress(recovered: RecoveredBody, looks: Flexible, block: Block, budget: int) -> Stress | None:
    """Raises _NoRoomError."""
    body, q = recovered.body, recovered.q
    surface = moving_surface(body)
    if body.stress is None or surface is None or len(surface.vertices) != looks.vertices.shape[0]:
        return None
    stations, ranges = _stations(body.stress.station_node, surface.nodes)
    if not len(stations):
        return None
    size = 12 * len(stations) * q.shape[1]
    if size > budget:
        raise _NoRoomError(size)
    modes = body.stress.modes[stations].transpose(2, 1, 0)
    return Stress(block.add_steps(modes), block.add(ranges, "u4"), _largest(body, q, stations))


def _stations(station_node: Whole, nodes: Whole) -> tuple[Whole, Whole]:
    """Stations at the nodes of vertices (n,), in the order of their nodes; of each vertex (n, 2) the first, and the one after the last."""
    stations = np.flatnonzero(np.isin(station_node, nodes))
    stations = stations[np.argsort(station_node[stations], kind="stable")]
    ordered = station_node[stations]
    ends = [np.searchsorted(ordered, nodes, side) for side in ("left", "right")]
    return stations, np.stack(ends, axis=1)


def _largest(body: ReducedBody, q: Array, stations: Whole) -> float:
    """[Pa] the largest von Mises stress in the motion."""
    q = q[np.all(np.isfinite(q), axis=1)]
    most = max(int(WORK // (6 * len(stations) * max(q.shape[1], 1))), 1)
    q = q[np.unique(np.linspace(0, len(q) - 1, min(len(q), most)).astype(int))] if len(q) else q
    rows = max(AT_ONCE // (6 * len(stations)), 1)
    parts = (von_mises(stress(body, q[k : k + rows], stations)).max(initial=0.0) for k in range(0, len(q), rows))
    return float(max(parts, default=0.0))


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
