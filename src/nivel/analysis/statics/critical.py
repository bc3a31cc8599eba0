"""Limit and bifurcation points: where on the path a direction of motion loses its stiffness.

Between two equilibria with different numbers of unstable directions the stiffness of one of them is zero. It is found along the chord
between the two, to whose points the path is projected, by Brent's method on that stiffness. There loads that do work along the direction
make a limit point, where time turns back; loads that do none a bifurcation, where a second path crosses this one.
"""

from collections.abc import Callable
from typing import Final

import numpy as np
from scipy.optimize import brentq

from nivel.analysis.assembly.equations import rotation_between
from nivel.analysis.assembly.named_freedoms import Freedoms
from nivel.analysis.statics.equations import Change, Rest, StateError, StaticEquations, Tangent
from nivel.analysis.statics.frames import FrameWriter
from nivel.analysis.statics.linear import NO_STIFFNESS, PivotError, is_small, lowest, solve, unstable_directions
from nivel.analysis.statics.newton import EquilibriumError, Found, Iteration, equilibrate
from nivel.analysis.statics.path import Point, Steps, by_arc_length
from nivel.kernels.record.record import NONE
from nivel.lazy import Struct, replace
from nivel.system.system import Array

# The loads do no work along a direction if they do less than this share of what they could.
NO_WORK = 1e-4
# Forces left over at a critical point, as a share of the loads.
IMPLICIT_ACCELERATIONS = 1e-13
# A share of the chord between two equilibria, to which critical points are found.
EXACT = 1e-10
# The same where Brent's method fails, next to the point itself, and the parts of what is left at which it is tried to be halved.
NEARLY, PARTS = 1e-8, (0.5, 0.4, 0.6, 0.25, 0.75)


class CriticalPoint(Struct):
    """kind : limit point or bifurcation. t : its time [s], along : its place on the path [s]; direction (f,) that has no stiffness there.

    found : the equilibrium there; None where it could only be told that it is between two equilibria, of the times `between` [s], whose
    middle is t.
    """

    kind: str
    t: float
    along: float
    direction: Array
    found: Found | None
    between: tuple[float, float]


def critical_points(
    equations: StaticEquations, before: Point, after: Point, counts: tuple[int, int], iteration: Iteration
) -> list[CriticalPoint]:
    """The critical points between two neighbouring equilibria of the path, with these numbers of unstable directions, along the path."""
    found = [_locate(equations, before, after, iteration, k) for k in range(min(counts), max(counts))]
    return sorted(found, key=lambda each: each.along)


def _locate(
    equations: StaticEquations, before: Point, after: Point, iteration: Iteration, number: int
) -> CriticalPoint:
    """Where eigenvalue `number` (from 0, ascending) is zero."""
    chord = _difference(equations, before.state, after.state)
    length = float(np.sqrt(chord.q @ chord.q + chord.t**2))
    border = chord * (1.0 / length)
    known = {0.0: before.found, 1.0: after.found}
    signs: dict[float, float] = {}
    iteration = replace(iteration, balanced=IMPLICIT_ACCELERATIONS)

    def stiffness(share: float) -> float:
        if share not in known:
            begin = equations.moved(before.state, chord * share)
            known[share] = equilibrate(equations, begin, iteration, border)
        values, _, hidden = _values(known[share].tangent, number)
        value = float(values[max(0, number - hidden)])
        signs[share] = float(np.sign(value))
        return value

    exact = True
    try:
        share = float(brentq(stiffness, 0.0, 1.0, xtol=EXACT))  # type: ignore[arg-type]
        stiffness(share)
        low = high = share
    except (EquilibriumError, PivotError, ValueError):
        low, high = _halved(stiffness, signs)
        share, exact = (low if low > 0.0 else high), high - low <= NEARLY
    found = known[share]
    times = known[low].state.t, known[high].state.t
    t = found.state.t if exact else 0.5 * (times[0] + times[1])
    along = before.along + 0.5 * (low + high) * (after.along - before.along)
    direction = _nearest(found.tangent, number)
    kind = _kind(found.tangent, direction)
    return CriticalPoint(kind, t, along, direction, found if exact else None, (min(times), max(times)))


def _halved(stiffness: Callable[[float], float], signs: dict[float, float]) -> tuple[float, float]:
    """The two shares of the chord, as near to each other as can be, between which a stiffness changes its sign.

    For where Brent's method failed. signs : of the stiffness at the shares known so far; others are added. Where the ends
    have no two signs, the whole chord.
    """
    if signs.get(0.0, 0.0) * signs.get(1.0, 0.0) >= 0.0:
        return 0.0, 1.0
    low, high = _bracket(signs)
    while high - low > NEARLY:
        for part in PARTS:
            try:
                stiffness(low + part * (high - low))
                break
            except (EquilibriumError, PivotError):
                continue
        else:
            break
        low, high = _bracket(signs)
    return low, high


def _bracket(signs: dict[float, float]) -> tuple[float, float]:
    low = max(share for share, sign in signs.items() if sign == signs[0.0])
    high = min((share for share, sign in signs.items() if sign != signs[0.0] and share > low), default=1.0)
    return low, high


def _difference(equations: StaticEquations, a: Rest, b: Rest) -> Change:
    psi = np.zeros(equations.n)
    place = equations.place
    plain = place[:, 1] == NONE
    psi[plain] = b.y[place[plain, 0]] - a.y[place[plain, 0]]
    first = np.flatnonzero(place[:, 1] == 0)
    if len(first):
        at = place[first, 0][:, None] + np.arange(4)
        psi[(first[:, None] + np.arange(3)).ravel()] = rotation_between(a.y[at], b.y[at]).ravel()
    free = equations.free
    lam = (b.lam - a.lam) * equations.row_scale / equations.energy
    return Change((psi / equations.length)[free], lam, (b.t - a.t) / equations.duration)


def _values(tangent: Tangent, number: int) -> tuple[Array, Array, int]:
    """Eigenvalues next to zero with their directions, and how many negative ones are not among them."""
    values, vectors = lowest(tangent, number + 3, tangent.M, nearest=True)
    return values, vectors, max(0, unstable_directions(tangent) - int(np.sum(values < 0.0)))


def _nearest(tangent: Tangent, number: int) -> Array:
    """The direction of eigenvalue `number`; where the tangent is singular to round-off, that next to it."""
    try:
        values, vectors, hidden = _values(tangent, number)
        return vectors[:, min(max(0, number - hidden), len(values) - 1)]
    except PivotError:
        return np.zeros(tangent.K.shape[0])


def _kind(tangent: Tangent, direction: Array) -> str:
    """What the loads, and the forces μ of the constraints that the direction asks for, do along it as time goes on: φᵀ ∂r/∂t + μᵀ ∂C/∂t."""
    size, rows = len(direction), tangent.C.shape[0]
    mu = solve(tangent.rigid(), -(tangent.K @ direction), np.zeros(rows), 1.0).lam if rows and size else np.zeros(rows)
    work = abs(float(direction @ tangent.slope + mu @ tangent.opening))
    could = float(np.linalg.norm(direction) * np.linalg.norm(tangent.slope))
    could += float(np.linalg.norm(mu) * np.linalg.norm(tangent.opening))
    return "limit point" if work > NO_WORK * could else "bifurcation"


# A path that ends is followed on by so many steps, this share of a step long.
LOOKED, SHORT = 40, 0.05


class Softest(Struct):
    """The stiffness next to zero as a share of the largest, and its direction (f,)."""

    share: float
    direction: Array


def softest(tangent: Tangent) -> Softest | None:
    """The direction with the least stiffness of those that all constraints allow; None where nothing can move."""
    size = tangent.K.shape[0]
    if not size:
        return None
    largest = float(np.abs(tangent.K).max())
    try:
        values, vectors = lowest(tangent, 1, tangent.M, nearest=True)
    except PivotError:
        return Softest(0.0, np.zeros(size))
    if not len(values):
        return None
    direction = vectors[:, 0]
    stiffness = abs(float(direction @ (tangent.K @ direction))) / float(direction @ direction)
    return Softest(stiffness / largest if largest > 0.0 else 0.0, direction)


def is_mechanism(found: Softest | None) -> bool:
    """Whether it moves without any resistance."""
    return found is not None and found.share < NO_STIFFNESS


def limit_ahead(equations: StaticEquations, last: Point, steps: Steps) -> CriticalPoint | None:
    """The limit point at which a path that could not be followed by load steps turns back; None where none is near."""
    short = Steps(steps.duration, SHORT * steps.step, steps.iteration, LOOKED)
    before, count = last, unstable_directions(last.found.tangent)
    try:
        for after in by_arc_length(equations, last, short):
            own = unstable_directions(after.found.tangent)
            if own != count:
                return next(iter(critical_points(equations, before, after, (count, own), steps.iteration)), None)
            before = after
    except (EquilibriumError, PivotError):
        pass
    return None


LOOSE: Final = 1e-12  # stiffness below this share of the largest counts as none
STILL: Final = 1e-6  # rate of a coordinate in a motion of unit size below which it rests


def loose_coordinates(equations: StaticEquations, state: Rest) -> tuple[str, ...]:
    """Those that, held, leave no motion of this equilibrium without stiffness that a joint coordinate shows. None of large machines."""
    try:
        tangent = equations.tangent(state)
        if not is_small(tangent):
            return ()
        Z = tangent.free_directions
        stiffness = Z.T @ (tangent.K @ Z)
        size = float(np.abs(tangent.K).max()) if tangent.K.nnz else 0.0
        values, vectors = np.linalg.eigh(0.5 * (stiffness + stiffness.T))
        loose = (Z @ vectors[:, np.abs(values) <= LOOSE * size]).T
        rates = FrameWriter(equations, 0).rates(state, loose)
    except (StateError, PivotError, np.linalg.LinAlgError):
        return ()
    return _independent(rates, equations.system.layout.coordinates["joint_coordinate"])


def _independent(rates: Array, labels: tuple[str, ...]) -> tuple[str, ...]:
    """rates (k, n) : of n joint coordinates in k motions."""
    rates = np.where(np.abs(rates) > STILL, rates, 0.0)
    return tuple(labels[k] for k in Freedoms(np.eye(len(rates))).independent(rates.T))
