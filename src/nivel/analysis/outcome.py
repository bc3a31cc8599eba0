"""From a kernel's status to a sentence: when it failed, where by joint and coordinate, and what to try."""

from __future__ import annotations

import numpy as np

from nivel.analysis.equations import MotionEquations
from nivel.kernels.status import BRISTLE_TOO_FAST, FRICTION_DIVERGES, NOT_FINITE, SINGULAR
from nivel.system.system import Array

# Pivots of S below this share of their diagonal are taken for the neighbourhood of a singular position.
NEAR_SINGULAR = 1e-6
# A violation above this share of its scale is not round-off or truncation: the step was too large for the motion.
DRIFTED = 1e-2


def failure(motion: MotionEquations, status: int, time: float, step: float, y: Array) -> tuple[str, str]:
    """(message, advice) for a run that failed in the step from `time` [s], whose last accepted state is y."""
    system, record = motion.system, motion.system.record
    if status == SINGULAR:
        row = system.rows[int(record.control.failure[0])]
        healthy = motion.holds(time, y) and _far_from_singular(motion)
        if healthy or _drifted(motion):
            message = (
                f"stopped at t = {time:.6g} s: a step of {step:.3g} s from here leads to a position that the machine does not have "
                f"({row} depends on the other constraints there); {_worst(motion)}"
            )
            advice = f"The step is too large for this motion: try --step {step / 10:.3g}. If it stops near this time again, the machine"
            return message, f"{advice} comes to a singular position there: look at {_owner(row)}."
        message = f"stopped at t = {time:.6g} s: the constraint {row} depends on the others here, the machine is in a singular position"
        advice = (
            f"Look at {_owner(row)} in this position: two links in line, or a loop folded flat? Start the run elsewhere, "
            f"or move a joint by a small amount so that the machine does not pass through it exactly. "
            f"A body whose inertia is many orders too small for its mass looks the same."
        )
        return message, advice
    if status == FRICTION_DIVERGES:
        name = motion.system.frictions[int(record.control.failure[0])]
        message = (
            f"stopped at t = {time:.6g} s: no friction {name} is consistent with the reactions that it causes: the joint jams, or its "
            f"normal load would grow without bounds"
        )
        advice = (
            f"Look at {name}: a smaller coefficient, a longer bearing_length or a smaller radius; or give its normal_load. "
            f"With Coulomb friction and rigid bodies some positions have no solution (Painlevé)."
        )
        return message, advice
    if status == BRISTLE_TOO_FAST:
        name = motion.system.frictions[int(record.control.failure[0])]
        message = (
            f"stopped at t = {time:.6g} s: at this speed the bristles of {name} relax faster than a step of {step:.3g} s can follow; "
            f"the friction would be wrong from here on"
        )
        advice = f"Try a smaller step, for instance --step {step / 4:.3g}; or a smaller bristle_stiffness of {name}."
        return message, advice
    assert status == NOT_FINITE
    broken = _broken_load(motion, time, step, y)
    if broken:
        name, at = broken
        message = f"stopped at t = {time:.6g} s: the force {name} is not a number at t = {at:.6g} s"
        return (
            message,
            f"Look at the law of {name}: a division by zero, or a root or logarithm of a negative number?",
        )
    motion.evaluate(time, y)
    where = _worst(motion)
    message = f"stopped at t = {time:.6g} s: the state after a step of {step:.3g} s is no longer a number; {where}"
    advice = f"Try a smaller step, for instance --step {step / 10:.3g}; if it stops at the same time, look at the forces near it."
    return message, advice


def _broken_load(motion: MotionEquations, time: float, step: float, y: Array) -> tuple[str, float] | None:
    """The first force that is not a finite number at a time that the step from `time` looks at, and that time."""
    outputs = motion.system.record.outputs.value
    names = [v.name for v in motion.system.layout.variables][-len(outputs) :] if len(outputs) else []
    magnitudes = [(k, name.split(".")[1]) for k, name in enumerate(names) if name.endswith(".magnitude")]
    for at in (time, time + 0.5 * step, time + step):
        motion.evaluate(at, y)
        for k, name in magnitudes:
            if not np.isfinite(outputs[k]):
                return name, at
    return None


def _drifted(motion: MotionEquations) -> bool:
    """Whether the state last evaluated has left its constraints."""
    constraints = motion.system.record.constraints
    return bool(np.max(np.abs(constraints.C) / constraints.scale, initial=0.0) > DRIFTED)


def _far_from_singular(motion: MotionEquations) -> bool:
    """Whether all constraints are well independent in the state last evaluated."""
    saddle = motion.system.record.saddle
    if len(saddle.dense):
        return True
    diagonal = saddle.S[saddle.S_start[1:].astype(int) - 1]
    return bool(np.all(saddle.Dinv * diagonal < 1.0 / NEAR_SINGULAR))


def _owner(row: str) -> str:
    return row.split(".", maxsplit=1)[0]


def _worst(motion: MotionEquations) -> str:
    """The constraint with the largest violation in the state last evaluated; without joints the body with the largest acceleration."""
    system, record = motion.system, motion.system.record
    violation = np.abs(record.constraints.C)
    if len(violation) and np.any(np.isfinite(violation)):
        row = int(np.nanargmax(violation / record.constraints.scale))
        units = {"m": "m", "rad": "rad"}.get(system.row_units[row], "(a cosine)")
        where = f"the largest violation before it is {violation[row]:.3g} {units} at {system.rows[row]}"
        joint = system.rows[row].split(".")[0]
        rates = [name for name in system.layout.coordinates["joint_coordinate"] if name.startswith(f"{joint}.")]
        return f"{where} (joint {joint}, coordinate {', '.join(rates)})" if rates else where
    accelerations = np.nan_to_num(np.linalg.norm(record.bodies.Rddot[: system.body_count], axis=1), nan=np.inf)
    body = int(np.argmax(accelerations))
    return f"the body with the largest acceleration before it is {system.bodies[body]}"
