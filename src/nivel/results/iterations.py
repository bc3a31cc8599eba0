"""Iterations of a run: how often implicit methods and the augmented Lagrangian iterated in the steps of each part of its duration."""

from __future__ import annotations

import json

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import dataclass

Array = NDArray[np.float64]
ATTRIBUTE = "iterations"  # of results


@dataclass(frozen=True)
class Iterations:
    """Of each of the parts of the duration (at most 1024, all of one length) in which steps ended.

    time : (n,) [s] at its end. begin : (n,) [s] at its begin. steps : (n,) that ended in it. total : (n,) iterations of these.
    most : (n,) of one of them.
    """

    begin: Array
    time: Array
    steps: Array
    total: Array
    most: Array

    @property
    def mean(self) -> Array:
        """(n,) iterations a step."""
        return self.total / self.steps

    @classmethod
    def from_json(cls, text: str) -> Iterations | None:
        """That of an attribute of a result; None where nothing was iterated."""
        stored = json.loads(text or "null")
        if stored is None:
            return None
        part, length = np.array(stored["part"], dtype=float), float(stored["length"])
        steps, total, most = (np.array(stored[name], dtype=float) for name in ("steps", "total", "most"))
        return cls(part * length, (part + 1.0) * length, steps, total, most)

    def at(self, time: Array) -> tuple[Array, Array]:
        """(mean, most) a step since the time before, for ascending times (m,) [s]; where no step ended since then, of the last ones."""
        last = np.searchsorted(self.begin, time, side="right")
        mean, most = np.full(len(time), np.nan), np.full(len(time), np.nan)
        first = 0
        for k, end in enumerate(last.tolist()):
            if end > first:
                mean[k] = self.total[first:end].sum() / self.steps[first:end].sum()
                most[k] = self.most[first:end].max()
                first = end
            elif k > 0:
                mean[k], most[k] = mean[k - 1], most[k - 1]
        return mean, most


def iterations_in_json(steps: Array, total: Array, most: Array, duration: float) -> str:
    """What `Iterations.from_json` reads, of all parts of a duration [s]; empty where nothing was iterated."""
    if not total.any():
        return ""
    found = np.flatnonzero(steps > 0.0)
    numbers = {"steps": steps, "total": total, "most": most}
    stored = {name: values[found].astype(int).tolist() for name, values in numbers.items()}
    return json.dumps({"length": duration / len(steps), "part": found.tolist(), **stored})
