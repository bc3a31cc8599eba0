"""Which components of reactions follow from the equations where constraints repeat each other, and which do not.

Any u with C_qᵀ u = 0 may be added to the multipliers. A component of a joint's reaction is unique where none of these changes it
(Wojtyra 2005).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from nivel.analysis.equations import MotionEquations
from nivel.analysis.freedoms import LARGEST
from nivel.analysis.redundancy import dependent_rows, row_lengths, scaled_jacobian
from nivel.system.system import Array

# a component that changes by less than this share of the largest change does not: shares are 0.1 and more, or round-off
UNCHANGED: Final = 1e-6
COMPONENTS: Final = ("force x", "force y", "force z", "moment x", "moment y", "moment z")


@dataclass(frozen=True)
class ReactionFacts:
    """Reaction of a joint along the axes of its first marker: components that are unique, and the others that it transmits."""

    joint: str
    unique: tuple[str, ...]
    others: tuple[str, ...]

    def __str__(self) -> str:
        said = ", ".join(self.unique) if self.unique else "nothing"
        return f"{self.joint}: unique {'is' if len(self.unique) < 2 else 'are'} {said}; not {', '.join(self.others)}"


def unique_reactions(motion: MotionEquations) -> tuple[ReactionFacts, ...]:
    """The joints whose reactions are not unique as a whole, in the position last evaluated; none of large machines."""
    system = motion.system
    if system.machine_rows * 6 * system.body_count > LARGEST:
        return ()
    free = _free_multipliers(motion)
    if not free.shape[1]:
        return ()
    wrenches = [_wrenches(motion, k) for k in range(len(system.joints))]
    changes = [np.linalg.norm(own @ free[slice(*rows)], axis=1) for own, rows in wrenches]
    least = UNCHANGED * max(float(change.max(initial=0.0)) for change in changes)
    found = []
    for name, (own, _), change in zip(system.joints, wrenches, changes, strict=True):
        carried = np.linalg.norm(own, axis=1) > UNCHANGED * np.linalg.norm(own)
        unique = tuple(
            word for word, moves, has in zip(COMPONENTS, change > least, carried, strict=True) if has and not moves
        )
        others = tuple(word for word, moves in zip(COMPONENTS, change > least, strict=True) if moves)
        if others:
            found.append(ReactionFacts(name, unique, others))
    return tuple(found)


def _free_multipliers(motion: MotionEquations) -> Array:
    """(K, k) multipliers without any effect, lengths and moments in units of the machine's length."""
    _, N = dependent_rows(scaled_jacobian(motion))
    return N / row_lengths(motion)[:, None]


def _wrenches(motion: MotionEquations, k: int) -> tuple[Array, tuple[int, int]]:
    """(6, n) reaction of joint k for a unit of each of its multipliers, moments over the machine's length; its rows."""
    record = motion.system.record
    first, last = record.joints.rows[k].tolist()
    parts = record.constraints.J[record.joints.part[first:last].astype(int)]
    A = record.markers.A[int(record.joints.first_marker[k])]
    forces, moments = A.T @ parts[:, :3].T, A.T @ parts[:, 3:].T
    return np.vstack([forces, moments / motion.system.size]), (first, last)
