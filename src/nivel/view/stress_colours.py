"""Modal stresses of flexible bodies at the vertices that are drawn, for the colours of the page."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.flexible.body.body import ReducedBody
from nivel.flexible.body.picture import moving_surface
from nivel.flexible.body.recovery import stress, von_mises
from nivel.results.result import Result
from nivel.results.stress import ATTRIBUTE, RecoveredBody
from nivel.view.package import Block
from nivel.view.records import Flexible, Stress

Array = NDArray[np.float64]
Whole = NDArray[np.int64]
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
