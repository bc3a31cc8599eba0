"""Kinks of the equations of motion: states at which a force has one slope on one side and another on the other.

A spring with a gap that just closes, a damper that is stiffer one way, a table, `abs`, `min` or a valve that shuts: linear equations have
one of the two slopes. Slopes are taken exactly on both sides, at two distances from the state. Where the equations are smooth the
difference goes with the distance, at a kink it stays; at a jump the forces themselves stay apart.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.instant import Instant
from nivel.analysis.linearise.reduction import Reduction, velocity_names
from nivel.kernels.elements import friction as columns
from nivel.kernels.record.record import NONE
from nivel.lazy import dataclass
from nivel.system.system import Array

# distances of the sides, in lengths of the machine, radians, and these a second
FAR, NEAR = 1e-5, 1e-8
# a difference of slopes that stays to this share, and is more than this share of the largest slope, is a kink
STAYS, SEEN = 0.5, 1e-6
# or than this share of the steepest slope of that force
ROUND_OFF = 1e-10
# or than this share of the largest of all forces
CANCELLED = 1e-12


@dataclass(frozen=True)
class Kink:
    """What has two slopes when `along` changes, and both, on the lower side and on the upper one [`units`]; where the forces themselves
    differ from side to side, `jumps`."""

    along: str
    of: str
    units: str
    lower: float
    upper: float
    jumps: bool

    def __str__(self) -> str:
        if self.jumps:
            return f"{self.of} jumps where {self.along} passes its present value"
        return f"{self.of} with {self.along} has the slope {self.lower:.6g} {self.units} below and {self.upper:.6g} {self.units} above"


@dataclass(frozen=True)
class _Change:
    """A change of the state by `size` [units] of what has this name: tangent increments (n,), velocities (n,) and states (S,)."""

    name: str
    units: str
    size: float
    direction: tuple[Array, Array, Array]


def kinks(reduction: Reduction) -> list[Kink]:
    """The kinks at the state of the reduction, at most one for each of its places, rates and states of elements."""
    Z, own = reduction.unturned(reduction.Z), reduction.instant
    changes = list(_directions(reduction))
    if not changes:
        return []
    found = [[_side(own, Z, each, share) for share in (-FAR, -NEAR, NEAR, FAR)] for each in changes]
    # what a force is compared with: its slopes in all directions, and the reactions that it is the rest of
    steepest = np.max([np.abs(slope) for sides in found for _, slope in sides], axis=0)
    reactions = _projected(own, np.abs(Z), np.abs(own.along("lam").r) @ np.abs(own.lam))
    # beside the largest of all forces, as energies, what is left of those that cancel is round-off
    lengths = own.length[own.free][reduction.moving]
    known = np.zeros_like(steepest)
    known[: len(lengths)] = (
        CANCELLED * np.max(((steepest + reactions)[: len(lengths)]) * lengths, initial=0.0) / lengths
    )
    out = []
    for each, sides in zip(changes, found, strict=True):
        values, slopes = zip(*sides, strict=True)
        far, near = np.abs(slopes[3] - slopes[0]), np.abs(slopes[2] - slopes[1])
        apart, largest = np.abs(values[2] - values[1]), float(np.max(np.abs(slopes), initial=0.0))
        jump = (apart > STAYS * np.abs(values[3] - values[0])) & (
            apart > np.maximum(4.0 * NEAR * (steepest + reactions), known)
        )
        bend = (near > STAYS * far) & (near > SEEN * largest) & (near > ROUND_OFF * steepest)
        seen = np.flatnonzero(jump | bend)
        if len(seen):
            k = int(seen[np.argmax(np.where(jump, np.inf, near)[seen])])
            lower, upper = slopes[1][k] / each.size, slopes[2][k] / each.size
            out.append(Kink(each.name, *_named(reduction, each.units, k), float(lower), float(upper), bool(jump[k])))
    return out


def _side(own: Instant, Z: Array, change: _Change, share: float) -> tuple[Array, Array]:
    """Generalised forces on the independent velocities and rates of states, and their slopes, on a side."""
    value, slope = own.beside(change.direction, share)
    return _projected(own, Z, value), _projected(own, Z, slope)


def _projected(own: Instant, Z: Array, found: Array) -> Array:
    """found (n,) or, with the rates of states, (n + S,)."""
    return np.concatenate(
        [Z.T @ found[: own.n][own.free], found[own.n :], np.zeros(max(0, own.n + own.state_count - len(found)))]
    )


def _directions(reduction: Reduction) -> Iterator[_Change]:
    """Each place, rate and state of an element."""
    own, names = reduction.instant, velocity_names(reduction.instant.system)
    none, still = np.zeros(own.n), np.zeros(own.state_count)
    for chosen, motions, rate in ((reduction.selected, reduction.Zq, False), (reduction.moving, reduction.Z, True)):
        for k, place in enumerate(own.free[chosen]):
            (name, units), size = names[place], float(own.length[place])
            whole = none.copy()
            whole[own.free] = reduction.unturned(motions)[:, k] * size
            if rate:
                yield _Change(f"{name}.rate", f"{units}/s", size, (none, whole, still))
            else:
                yield _Change(name, units, size, (whole, none, still))
    for k, fact in enumerate(own.system.states):
        change = still.copy()
        change[k] = fact.scale or 1.0
        yield _Change(f"state.{fact.name}", fact.units, fact.scale or 1.0, (none, none, change))


def _named(reduction: Reduction, units: str, k: int) -> tuple[str, str]:
    """What the k-th of the projected equations says, and the unit of its slope."""
    own = reduction.instant
    if k >= len(reduction.moving):
        fact = own.system.states[k - len(reduction.moving)]
        return f"the rate of state.{fact.name}", f"{fact.units}/s per {units}"
    name, of = velocity_names(own.system)[own.free[reduction.moving[k]]]
    effort = {"m": "N", "rad": "N m"}.get(of, "1")
    return f"the effort on {name}", {"m": f"{effort}/m", "m/s": f"{effort} s/m"}.get(units, f"{effort} per {units}")


# An effort is that of sliding to this share of it. tanh of so much is one to the last bit.
EQUAL, SATURATED = 1e-9, 40.0


def let_slide(motion: MotionEquations, t: float, y: Array) -> frozenset[str]:
    """Give frictions that slide in the state y at t [s] the law of sliding, in place of one that may hold. Returns their names."""
    system, record = motion.system, motion.system.record
    friction, out = record.friction, frozenset[str]()
    if not len(friction.columns) or not motion.holds(t, y):
        return out
    for k, (index, n) in enumerate(zip(friction.columns.tolist(), friction.number, strict=True)):
        if index[columns.MODEL] != columns.STICTION or index[columns.ROW] != NONE:
            continue
        rate, outputs = (
            record.coordinates.rate[index[columns.COORDINATE]],
            record.outputs.value[index[columns.OUTPUT] :],
        )
        dry = friction.force[k] + n[columns.VISCOUS] * rate
        if index[columns.WAY] == columns.ONE_WAY:
            if not rate > 0.0 or dry != 0.0:
                continue
            n[columns.KINETIC] = n[columns.STATIC] = 0.0  # it runs ahead
        elif (
            not -dry * np.sign(rate)
            >= (1.0 - EQUAL) * _sliding(n, rate * n[columns.ARM]) * outputs[columns.THIRD] * n[columns.ARM]
        ):
            continue
        friction.columns[k, columns.MODEL], n[columns.TRANSITION] = (
            columns.COULOMB,
            abs(rate) * n[columns.ARM] / SATURATED,
        )
        out |= {system.frictions[k]}
    return out


def _sliding(n: Array, speed: float) -> float:
    """Coefficient of friction of surfaces that slide with a speed."""
    if n[columns.STATIC] == n[columns.KINETIC] or n[columns.STRIBECK] == 0.0:
        return float(n[columns.KINETIC])
    return float(
        n[columns.KINETIC] + (n[columns.STATIC] - n[columns.KINETIC]) * np.exp(-((speed / n[columns.STRIBECK]) ** 2))
    )
