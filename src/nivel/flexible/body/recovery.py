"""Displacement, strain and stress of a flexible body from the history of its modal coordinates.

stress(t) = Σ modal stress_j q_j(t), at the stations of `body.stress`: nodes of solids, fibres at the ends of beam elements.
Histories q are (t, n) in the order of the modes; results have the time first.
"""

from collections.abc import Iterator
from itertools import pairwise
from typing import Final

import numpy as np

from nivel.errors import ModelError
from nivel.flexible.body.body import ReducedBody, StressModes
from nivel.lazy import Struct
from nivel.machine.core.vectors import Array, Whole

BLOCK: Final = 4_000_000  # numbers of stress at once: 32 MB


class HotSpot(Struct):
    """A place of great stress: its `station`, the number of its node, the fibre if there are several, its place (3,) [m].

    value : [Pa] the largest von Mises stress there; index : of the moment in the history; signed : [Pa] the principal
    stress of largest magnitude at that moment, with its sign.
    """

    station: int
    node_id: int
    label: str
    position: Array
    value: float
    index: int
    signed: float


class Envelope(Struct):
    """The largest von Mises stress (s,) [Pa] at each station over a history, and at which of its moments (s,) it was."""

    value: Array
    index: Whole

    @property
    def worst(self) -> int:
        """The moment at which the largest stress of all stations was."""
        return int(self.index[int(np.argmax(self.value))])


def stress_modes(body: ReducedBody) -> StressModes:
    """The modal stresses. Raises ModelError where the body has none."""
    if body.stress is None:
        raise ModelError(
            f"the body {body.name} knows no stress: reduce it with `recovery: {{stress: true}}` from a model with elements of known "
            "elasticity; the page of its reduction says why it is not known"
        )
    return body.stress


def stations_at(body: ReducedBody, node_id: int) -> Whole:
    """The stations at a node. Raises ModelError where there are none."""
    stress = stress_modes(body)
    found = np.flatnonzero(body.node_ids[stress.station_node] == node_id)
    if not len(found):
        known = np.unique(body.node_ids[stress.station_node])
        raise ModelError(
            f"stress is not known at node {node_id}; it is at {len(known)} nodes from {known.min()} to {known.max()}"
        )
    return found


def displacement(body: ReducedBody, q: Array) -> Array:
    """(t, nodes, 3) [m] in the body frame."""
    return np.einsum("naj,tj->tna", body.modes[:, :3], np.atleast_2d(q), optimize=True)


def stress(body: ReducedBody, q: Array, stations: Whole | None = None) -> Array:
    """(t, s, 6) [Pa] xx, yy, zz, xy, yz, zx at the `stations`, default all."""
    modes = stress_modes(body).modes
    return np.einsum("saj,tj->tsa", modes if stations is None else modes[stations], np.atleast_2d(q), optimize=True)


def strain(body: ReducedBody, q: Array, stations: Whole | None = None) -> Array:
    """(t, s, 6) in the same order, shear as γ. Raises ModelError where the body has no modal strains."""
    modes = stress_modes(body).strain
    if modes is None:
        raise ModelError(f"the body {body.name} knows no strain: reduce it with `recovery: {{strain: true}}`")
    return np.einsum("saj,tj->tsa", modes if stations is None else modes[stations], np.atleast_2d(q), optimize=True)


def von_mises(stress: Array) -> Array:
    """(…,) [Pa] of stresses (…, 6)."""
    xx, yy, zz, xy, yz, zx = np.moveaxis(stress, -1, 0)
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.sqrt(0.5 * normal + 3.0 * (xy**2 + yz**2 + zx**2))


def principal(stress: Array) -> Array:
    """(…, 3) [Pa] principal stresses of stresses (…, 6), ascending."""
    full = stress[..., [0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(*stress.shape[:-1], 3, 3)
    return np.linalg.eigvalsh(full).astype(np.float64)


def signed_principal(stress: Array) -> Array:
    """(…,) [Pa] the principal stress of largest magnitude, with its sign."""
    three = principal(stress)
    return np.where(-three[..., 0] > three[..., 2], three[..., 0], three[..., 2])


def envelope(body: ReducedBody, q: Array) -> Envelope:
    """The largest von Mises stress of each station over the history q (t, n)."""
    count = len(stress_modes(body).station_node)
    value, index = np.zeros(count), np.zeros(count, dtype=np.int64)
    for start, part in _blocks(q, count):
        size = von_mises(stress(body, part))
        at = np.argmax(size, axis=0)
        largest = size[at, np.arange(count)]
        above = largest > value
        value[above], index[above] = largest[above], start + at[above]
    return Envelope(value, index)


def _blocks(q: Array, count: int) -> Iterator[tuple[int, Array]]:
    """Parts of the history whose stresses fit in memory, with the moment where each begins."""
    q = np.atleast_2d(q)
    rows = max(1, BLOCK // (6 * max(count, 1)))
    for start in range(0, len(q), rows):
        yield start, q[start : start + rows]


def hot_spots(body: ReducedBody, q: Array, *, count: int = 5, apart: float = 0.05) -> list[HotSpot]:
    """The `count` places of largest von Mises stress over the history, greatest first.

    apart : a place nearer than this share of the size of the body to a greater one is left out, so that neighbouring
    nodes of one notch count once.
    """
    modes, found = stress_modes(body), envelope(body, q)
    place = body.position[modes.station_node]
    reach = apart * float(np.linalg.norm(np.ptp(body.position, axis=0)))
    open_ = np.ones(len(place), dtype=bool)
    spots: list[HotSpot] = []
    for station in np.argsort(found.value)[::-1]:
        if len(spots) >= count:
            break
        if not open_[station]:
            continue
        open_ &= np.linalg.norm(place - place[station], axis=1) > reach
        at = int(found.index[station])
        now = stress(body, np.atleast_2d(q)[at], np.array([station]))[0, 0]
        spots.append(
            HotSpot(
                station=int(station),
                node_id=int(body.node_ids[modes.station_node[station]]),
                label=modes.labels[station] if modes.labels else "",
                position=place[station],
                value=float(found.value[station]),
                index=at,
                signed=float(signed_principal(now)),
            )
        )
    return spots


class Cycle(Struct, order=True):
    """A counted cycle: its `range` and `mean` in the unit of the history, and `count`, 1 or ½."""

    range: float
    mean: float
    count: float


def reversals(history: Array) -> Array:
    """The values where the history turns, its first and last included."""
    values = np.asarray(history, dtype=float)
    if len(values) == 0:
        return values
    values = values[np.concatenate([[True], np.diff(values) != 0.0])]
    if len(values) < 3:
        return values
    slope = np.diff(values)
    turns = np.concatenate([[True], slope[:-1] * slope[1:] < 0.0, [True]])
    return values[turns]


def rainflow(history: Array) -> list[Cycle]:
    """Cycles of a history, in the order in which they are found; what is left at the end counts as halves."""
    cycles: list[Cycle] = []
    points: list[float] = []
    for value in reversals(history):
        points.append(float(value))
        while len(points) >= 3:
            last, before = abs(points[-1] - points[-2]), abs(points[-2] - points[-3])
            if last < before:
                break
            if len(points) == 3:  # `before` holds the start of the history
                cycles.append(_cycle(points[0], points[1], 0.5))
                points.pop(0)
            else:
                cycles.append(_cycle(points[-3], points[-2], 1.0))
                del points[-3:-1]
    cycles += [_cycle(a, b, 0.5) for a, b in pairwise(points)]
    return cycles


def _cycle(first: float, second: float, count: float) -> Cycle:
    return Cycle(abs(second - first), 0.5 * (first + second), count)


def counted(cycles: list[Cycle]) -> dict[float, float]:
    """Number of cycles by their range, ascending."""
    out: dict[float, float] = {}
    for each in sorted(cycles):
        out[each.range] = out.get(each.range, 0.0) + each.count
    return out
