"""Cost of inertia invariants that flexible bodies move without, told by how far they bend in a run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from nivel.results.scales import Readable, blocks

if TYPE_CHECKING:
    from nivel.flexible.body.invariants import Invariants

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Neglected:
    """A body whose modal coordinates are the columns first to last - 1 of a run, its invariants, and names of those it moves without."""

    body: str
    first: int
    last: int
    invariants: Invariants
    names: tuple[str, ...]

    def errors(self, q: Array) -> Array:
        """(frames,) what its mass matrix lacks, as a share, for modal coordinates q (frames, n).

        I8 and I9 are parts of the inertia, compared with that of the undeformed body; I5 couples turns and modes of unit mass, and is
        compared with the geometric mean of both.
        """
        its, inertia = self.invariants, float(np.abs(self.invariants.I7).max())
        parts = [np.zeros((len(q), 1))]
        if "I5" in self.names:
            parts.append(np.abs(np.einsum("tj,jak->tak", q, its.I5)).reshape(len(q), -1) / np.sqrt(inertia))
        if "I8" in self.names:
            both = its.I8 + its.I8.transpose(0, 2, 1)
            parts.append(np.abs(np.einsum("tj,jab->tab", q, both)).reshape(len(q), -1) / inertia)
        if "I9" in self.names:
            square = np.einsum("tj,tk,jkab->tab", q, q, its.I9, optimize=True)
            parts.append(np.abs(square).reshape(len(q), -1) / inertia)
        return np.concatenate(parts, axis=1).max(axis=1)


@dataclass(frozen=True)
class Cost:
    """The largest share of a mass matrix that was neglected, its body, the names of what was neglected there, and the time [s]."""

    share: float
    body: str
    names: tuple[str, ...]
    time: float


@np.errstate(over="ignore", invalid="ignore")  # a run that grew beyond all bounds is red, not a warning
def cost(result: Readable, neglected: Sequence[Neglected]) -> Cost | None:
    """The largest one of a run; None where nothing is neglected."""
    found: Cost | None = None
    for each in neglected:
        for frames in blocks(result):
            errors = each.errors(result.array("modal_coordinate", frames)[:, each.first : each.last])
            if not len(errors):
                continue
            k = int(np.argmax(errors))
            if found is None or not errors[k] <= found.share:
                found = Cost(float(errors[k]), each.body, each.names, float(result.time[frames.start + k]))
    return found
