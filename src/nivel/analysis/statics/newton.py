"""Newton's iteration for a state of equilibrium, with exact tangents: at a given time, or on the way through limit points.

Full steps are taken. Parts that are stiff along and soft across, as slender beams, need that: their first steps lead away, the next ones
back. Where full steps find nothing, the iteration is begun again with a line search: a step is halved until the next change that the same
tangent asks for is smaller than the step itself (natural monotonicity test; Deuflhard 2004, section 3.3). Changes have no units, so neither
do the test and the tolerance.
"""

from typing import Any

import numpy as np

from nivel.analysis.statics.equations import Change, Rest, StateError, StaticEquations, Tangent
from nivel.analysis.statics.linear import PivotError, bordered, saddle_factors, solve_bordered
from nivel.analysis.statics.rigid_motions import with_tie
from nivel.lazy import Struct
from nivel.system.system import Array

# The least share of a step that is tried.
LEAST_SHARE = 1.0 / 64.0
# The longest change of one iteration, in lengths of the machine and radians.
LONGEST = 0.5
# What the iteration may add to what a tangent promised: a share of it, or this in lengths and radians. More is another path.
BESIDE, JUMP = 2.0, 0.02
# Full steps that are still as long as this after so many iterations lead nowhere.
PATIENCE, LONG = 10, 0.05
# Changes that no longer contract are round-off where they are as small as this.
STALLED, ROUND_OFF = 0.3, 1e-7


class Iteration(Struct):
    """How Newton's iteration goes: tolerance of the last change, in lengths of the machine and radians; most iterations; line search.

    balanced : unbalanced forces of this share of the loads end it as well: next to a critical point changes are no measure.
    """

    tolerance: float = 1e-10
    most: int = 25
    search: bool = True
    balanced: float = 0.0


class Found(Struct):
    """A state of equilibrium, its tangent, the iterations that it took, the whole change of its positions, and all changes in turn."""

    state: Rest
    tangent: Tangent
    iterations: int
    moved: Array
    sizes: tuple[float, ...]


class EquilibriumError(Exception):
    """No state of equilibrium was found from where the iteration began. state : the last one; sizes : of all changes in turn."""

    def __init__(self, reason: str, state: Rest, sizes: tuple[float, ...] = ()) -> None:
        super().__init__(reason)
        self.reason, self.state, self.sizes = reason, state, sizes


def equilibrate(equations: StaticEquations, state: Rest, iteration: Iteration, border: Change | None = None) -> Found:
    """The equilibrium next to `state`, at its time; with a border at the time where the changes are perpendicular to the border.

    (Riks 1979, Wempner 1971: corrections perpendicular to the tangent of the path.)
    Raises EquilibriumError.
    """
    try:
        return _iterate(equations, state, iteration, border, shortened=False)
    except EquilibriumError:
        if not iteration.search:
            raise
    return _iterate(equations, state, iteration, border, shortened=True)


def step_to(equations: StaticEquations, state: Rest, ahead: Change, iteration: Iteration) -> Found:
    """The equilibrium at the time of `state`, next to where the change `ahead` along a tangent leads.

    Raises EquilibriumError, also where it is on another path.
    """
    promised = float(np.max(np.abs(ahead.q), initial=0.0))
    share = min(1.0, LONGEST / promised) if promised > 0.0 else 1.0
    found = equilibrate(equations, equations.moved(state, ahead * share), iteration)
    if float(np.max(np.abs(found.moved), initial=0.0)) > max(BESIDE * promised, JUMP):
        raise EquilibriumError("the next equilibrium is far away", state, found.sizes)
    return found


def _iterate(
    equations: StaticEquations, state: Rest, iteration: Iteration, border: Change | None, *, shortened: bool
) -> Found:
    """The same with full steps, or with shortened ones."""
    sizes: list[float] = []
    moved = np.zeros(len(equations.free))
    for number in range(1, iteration.most + 1):
        try:
            tangent = equations.tangent(state)
            r, C = equations.evaluate(state)
            if iteration.balanced and _is_balanced(equations, state, r, C, iteration.balanced):
                return Found(state, tangent, number, moved, tuple(sizes))
            tangent = with_tie(equations, state, tangent, r)
            found: Any = saddle_factors(tangent) if border is None and len(r) + len(C) else None
            found = bordered(tangent, border) if border is not None else found
            change = _change(found, r, C, border)
        except StateError:
            raise EquilibriumError("a force, or the state, is not a number", state, tuple(sizes)) from None
        except PivotError:
            raise EquilibriumError("nothing resists a motion", state, tuple(sizes)) from None
        size = max(float(np.max(np.abs(change.q), initial=0.0)), abs(change.t))
        if not np.isfinite(size):
            raise EquilibriumError("nothing resists a motion", state, tuple(sizes))
        share = min(1.0, LONGEST / size) if size > 0.0 else 1.0
        nearer = _nearer(equations, state, found, change, share, border) if shortened else share
        if nearer is None:
            raise EquilibriumError("no step comes nearer to equilibrium", state, (*sizes, size))
        share = nearer
        state = equations.moved(state, change * share)
        moved += share * change.q
        sizes.append(size)
        stalled = len(sizes) > 1 and size > STALLED * sizes[-2] and size <= ROUND_OFF
        if share == 1.0 and (size <= iteration.tolerance or stalled):
            return Found(state, tangent, number, moved, tuple(sizes))
        if not shortened and number > PATIENCE and size > LONG:
            break
    raise EquilibriumError(f"{len(sizes)} iterations are not enough", state, tuple(sizes))


def _is_balanced(equations: StaticEquations, state: Rest, r: Array, C: Array, share: float) -> bool:
    left = float(np.max(np.abs(r), initial=0.0)) * equations.energy
    return float(np.max(np.abs(C), initial=0.0)) <= share and left <= share * equations.loads(state)


def _change(found: Any, r: Array, C: Array, border: Change | None) -> Change:
    if border is not None:
        return solve_bordered(found, -r, -C, 0.0)
    x = found.solve(-np.concatenate([r, C])) if found is not None else np.zeros(0)
    return Change(x[: len(r)], x[len(r) :])


def _nearer(
    equations: StaticEquations, state: Rest, found: Any, change: Change, share: float, border: Change | None
) -> float | None:
    """The share of a change that comes nearer; None where none does."""
    size = _norm(change)
    if size <= ROUND_OFF:
        return share
    while share >= LEAST_SHARE:
        try:
            r, C = equations.evaluate(equations.moved(state, change * share))
            left = _norm(_change(found, r, C, border))
            if left <= (1.0 - 0.25 * share) * size:
                return share
        except StateError:
            pass
        share *= 0.5
    return None


def _norm(change: Change) -> float:
    return float(np.sqrt(np.sum(change.q**2) + change.t**2))
