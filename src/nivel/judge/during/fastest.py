"""The fastest rate of a machine in a state, and the part that it is of: what an explicit step of fixed size has to be short for.

Rates are the eigenvalues λ of A = ∂ẏ/∂y, by differences. With right and left vectors v and w, entry k takes part in the fastest one by
|w_k v_k|, whatever its units (Pérez-Arriaga, Verghese and Schweppe 1982): where states of volumes, blocks or forces take the larger part,
the owner of most of it is named. Otherwise it is a motion, in which the work of each force per second has a part of the second order,
which is the work of that motion itself: the force, or the cylinder, with the largest one is named.
"""

from __future__ import annotations

from typing import cast

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.preparation.preparation import Prepared
from nivel.integrate.catalogue import INTEGRATORS
from nivel.kernels.core.status import OK
from nivel.kernels.output.observe import observe
from nivel.lazy import dataclass
from nivel.system.system import Array

Vectors = NDArray[np.complex128]
# States with more entries are not looked at; increments as shares of the scales of y.
MOST_ENTRIES, SHARE, TINY = 300, 1e-6, 1e-12
# Shares of the increments that work is found with.
PART = 1e-2


@dataclass(frozen=True)
class Fastest:
    """rate [1/s] of the state at `time` [s], and the name of the force, component or block that it is of; empty where none works in it."""

    rate: float
    part: str
    time: float


def held_step(integrator: str, rate: float) -> float:
    """The longest step [s] with which an explicit method holds this rate [1/s]."""
    return INTEGRATORS[integrator].held / rate if rate > 0.0 else np.inf


def fastest_beyond(prepared: Prepared, integrator: str, step: float, time: float, last: Array) -> Fastest | None:
    """The fastest rate at the start, or at time [s] in the `last` state, where a step [s] does not hold it; None where both are held."""
    for t, y in ((0.0, prepared.start), (time, last)):
        found = fastest(prepared.motion, t, y)
        if found is not None and step > held_step(integrator, found.rate):
            return found
    return None


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # of a state that may be beyond all bounds
def fastest(motion: MotionEquations, t: float, y: Array) -> Fastest | None:
    """In this state; None where it has no rates, nothing changes, or it has too many entries."""
    count = len(y) - 2  # energies follow from the others
    if not 0 < count <= MOST_ENTRIES or not np.isfinite(y).all():
        return None
    steps = increments(motion, y)
    A = np.zeros((count, count))
    for k in range(count):
        ends = [_rate(motion, t, y, k, side * steps[k]) for side in (1.0, -1.0)]
        if ends[0] is None or ends[1] is None:
            return None
        A[:, k] = (ends[0] - ends[1])[:count] / (2.0 * steps[k])
    if not np.isfinite(A).all():
        return None
    rates, right = cast(tuple[Vectors, Vectors], np.linalg.eig(A))
    k = int(np.argmax(np.abs(rates)))
    if not np.abs(rates[k]) > 0.0:
        return None
    # left vectors of A are right ones of its transpose
    its, left = cast(tuple[Vectors, Vectors], np.linalg.eig(A.T))
    j = int(np.argmin(np.abs(its - rates[k])))
    # a phase at which positions and speeds of a vibration are both there
    shape = np.real(right[:, k] * np.exp(0.25j * np.pi))
    owner = _taking_part(motion, np.abs(left[:, j] * right[:, k]))
    return Fastest(float(np.abs(rates[k])), owner or _working(motion, t, y, shape), t)


def increments(motion: MotionEquations, y: Array) -> Array:
    """(n,) of the entries of y without its energies, for differences."""
    count = len(y) - 2
    return SHARE * np.maximum(np.abs(y[:count]), _scales(motion, count))


def _scales(motion: MotionEquations, count: int) -> Array:
    """What increments of the entries of y are measured by, at least."""
    facts = motion.system.states
    scales = np.full(count, motion.system.size)
    scales[count - len(facts) :] = [fact.scale if fact.relative else 0.0 for fact in facts]
    return np.maximum(scales, TINY)


def _taking_part(motion: MotionEquations, parts: Array) -> str:
    """The owner of states with the largest part, where it is larger than that of all positions and speeds."""
    facts = motion.system.states
    first = len(parts) - len(facts)
    shares: dict[str, float] = {}
    for fact, part in zip(facts, parts[first:], strict=True):
        owner = fact.variable.removeprefix("control.") if fact.variable.startswith("control.") else fact.name
        name = owner.split(".")[0]
        shares[name] = shares.get(name, 0.0) + float(part)
    largest = max(shares, key=lambda name: shares[name], default="")
    return largest if largest and shares[largest] > float(parts[:first].sum()) else ""


def _rate(motion: MotionEquations, t: float, y: Array, k: int, by: float) -> Array | None:
    moved = y.copy()
    moved[k] += by
    status, rate = motion.evaluate(t, moved)
    return rate if status == OK else None


def _working(motion: MotionEquations, t: float, y: Array, shape: Array) -> str:
    """The force or cylinder whose work in the motion `shape` is largest."""
    scale = PART * motion.system.size / max(float(np.abs(shape).max()), 1e-300)
    shape = shape.copy()
    shape[len(shape) - len(motion.system.states) :] = 0.0  # what springs and dampers do, not what is fed
    powers = [_powers(motion, t, y, side * scale * shape) for side in (1.0, 0.0, -1.0)]
    work = {name: abs(powers[0][name] - 2.0 * powers[1][name] + powers[2][name]) for name in powers[1]}
    finite = {name: value for name, value in work.items() if np.isfinite(value) and value > 0.0}
    return max(finite, key=lambda name: finite[name], default="")


def _powers(motion: MotionEquations, t: float, y: Array, change: Array) -> dict[str, float]:
    """The power [W] of each force and cylinder in a state aside."""
    aside, layout = y.copy(), motion.system.layout
    aside[: len(change)] += change
    motion.evaluate(t, aside)
    frame = np.zeros(layout.width)
    observe(motion.handle.address, t, aside, frame)
    return {
        each.name.split(".")[1]: float(frame[each.columns][0])
        for each in layout.variables
        if each.name.startswith(("force.", "hydraulics."))
        and each.name.endswith(".power")
        and each.name.count(".") == 2
    }
