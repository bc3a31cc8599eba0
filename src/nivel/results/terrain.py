"""Terrain: heights of soil in the course of a run, kept as moves of the nodes that changed from one moment to the next.

A height is kept in whole steps of a 128th of the side of a cell, from where it was at the start; so moves can be taken back exactly.
"""

import base64
import json
from collections.abc import Iterable, Mapping
from io import BytesIO
from typing import Any, Final
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from nivel.integrate.loop.run import HORIZON, TIME, Run
from nivel.known import SoilUnit
from nivel.lazy import Struct, replace
from nivel.machine.core.vectors import Array

ATTRIBUTE: Final = "terrain"  # of results
STEPS: Final = 128  # of a height, in the side of a cell
MOST: Final = 32767  # of these, up and down
INTERVAL: Final = 1.0 / 60.0  # [s] between two moments, at least
EARLY: Final = 1e-12  # share of the time by which a moment may be before it is due


class Tracker:
    """Says which heights of a soil have moved since it was asked last. step [m] : of moves."""

    def __init__(self, start: Array, cell: float) -> None:
        """start (n, m) [m] : heights before the run, along x and along y. cell [m] : its side."""
        self._start, self._known, self.step = start.flatten(), start.copy(), cell / STEPS
        self._steps = np.zeros(start.size, np.int16)

    def moves(self, heights: Array) -> tuple[NDArray[Any], NDArray[Any]]:
        """Nodes in rows along x, and by how many steps each has moved to these heights (n, m) [m]."""
        changed = np.flatnonzero(heights != self._known)
        now = self._known.ravel()[changed] = heights.ravel()[changed]
        steps = np.rint(np.nan_to_num((now - self._start[changed]) / self.step)).clip(-MOST, MOST).astype(np.int16)
        by = steps - self._steps[changed]
        self._steps[changed] = steps
        i, j = np.divmod(changed, heights.shape[1])
        nodes = j * len(heights) + i
        order = np.argsort(nodes)
        order = order[by[order] != 0]
        return nodes[order], by[order]


class TerrainLog:
    """Accompanies a run from chunk to chunk, with its leader, and keeps moments, the same however long chunks are."""

    def __init__(self, soils: Iterable[SoilUnit], interval: float, leader: Any = None) -> None:
        """interval [s] : between moments. leader : a `nivel.analysis.progress.pacing.Pacing`."""
        self._leader, self._interval, self._time = leader, max(interval, INTERVAL), list[float]()
        self._soils = [(each, each.record.h.copy(), Tracker(each.record.h, each.cell)) for each in soils]
        self._kept = [list[tuple[NDArray[Any], NDArray[Any], Array]]() for _ in self._soils]

    @property
    def _next(self) -> float:
        return len(self._time) * self._interval * (1.0 - EARLY)

    def before(self, run: Run) -> bool:
        """Steps end at the next moment."""
        run.clock[HORIZON] = self._next
        return self._leader.before(run)

    def after(self, run: Run) -> None:
        """Keep a moment that is due."""
        self._leader.after(run)
        if run.clock[TIME] >= self._next:
            self.keep(float(run.clock[TIME]))

    def keep(self, time: float) -> None:
        """Keep a moment [s]."""
        self._time.append(time)
        for kept, (soil, _, tracker) in zip(self._kept, self._soils, strict=True):
            kept.append((*tracker.moves(soil.record.h), soil.record.volume.copy()))

    @property
    def attribute(self) -> str:
        """All that was kept, as a result has it: by name of the soil arrays of `TerrainHistory` in NumPy's form."""
        out = {}
        for kept, (soil, start, tracker) in zip(self._kept, self._soils, strict=True):
            nodes, moves, carried = ([each[k] for each in kept] for k in range(3))
            history = TerrainHistory(
                step=np.array(tracker.step),
                start=start.T.astype(np.float32),
                time=np.array(self._time),
                ends=np.cumsum([*map(len, nodes)]),
                nodes=np.diff(np.concatenate(nodes), prepend=0).astype(np.int32),
                moves=np.concatenate(moves),
                carried=np.array(carried, dtype=np.float32),
            )
            np.savez_compressed(content := BytesIO(), **vars(history))
            out[soil.name] = base64.b64encode(content.getvalue()).decode()
        return json.dumps(out)


class TerrainHistory(Struct):
    """Heights of a soil during a run. start (rows along y, nodes along x) [m]. step [m] : of moves. time (k,) [s]. ends (k,) : numbers of
    moves up to each time. nodes (n,) : of `start` in rows, as what is added to the one before. moves (n,) : by so many steps. carried
    (k, forces) [m³] : by forces on the soil."""

    step: NDArray[Any]
    start: NDArray[Any]
    time: NDArray[Any]
    ends: NDArray[Any]
    nodes: NDArray[Any]
    moves: NDArray[Any]
    carried: NDArray[Any]

    def at(self, time: float) -> Array:
        """Heights at a time [s], as those of `start`."""
        end = int(np.append(0, self.ends)[np.searchsorted(self.time, time, side="right")])
        moved = np.bincount(np.cumsum(self.nodes[:end]), self.moves[:end], self.start.size)
        return np.asarray(self.start + self.step * moved.reshape(self.start.shape), dtype=float)

    def thinned(self, most: int) -> "TerrainHistory":
        """The same at fewer times, so that there are at most so many moves where two times have room for no more."""
        if len(self.nodes) <= most or len(self.time) < 3:
            return self
        kept = np.arange(len(self.time) - 1, -1, -2)[::-1]
        moment = np.searchsorted(kept, np.repeat(np.arange(len(self.time)), np.diff(self.ends, prepend=0)))
        key, place = np.unique(moment * self.start.size + np.cumsum(self.nodes), return_inverse=True)
        moves = np.bincount(place, self.moves)
        moment, nodes = np.divmod(key[moves != 0.0], self.start.size)
        ends = np.searchsorted(moment, np.arange(len(kept)), side="right")
        own = {"time": self.time[kept], "ends": ends, "nodes": np.diff(nodes, prepend=0), "moves": moves[moves != 0.0]}
        return replace(self, **own, carried=self.carried[kept]).thinned(most)


def terrains(attributes: Mapping[str, Any]) -> dict[str, TerrainHistory]:
    """By name those of a result with these attributes. Raises ValueError where they are damaged."""
    texts: dict[str, str] = json.loads(str(attributes[ATTRIBUTE]))
    out = {}
    for name, text in texts.items():
        try:
            with np.load(BytesIO(base64.b64decode(text))) as arrays:
                out[name] = TerrainHistory(**arrays)
        except (BadZipFile, OSError, EOFError) as error:
            raise ValueError(str(error)) from None
    return out
