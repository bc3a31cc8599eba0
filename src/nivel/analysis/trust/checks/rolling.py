"""Wheels of a run: whether the plane would have to pull, and how much friction rolling without slip takes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.trust.check import FRAMES, Check
from nivel.analysis.trust.subject import Motion
from nivel.results.scales import Readable
from nivel.results.trust import Item, number

NORMAL = ".normal_force"
# a wheel that is pulled by less than this share of the largest normal force is not: that is round-off
PULLED = 1e-9


@dataclass(frozen=True)
class Wheel:
    """The least normal force [N] on a wheel and its time [s]; lifts : from when on the plane would have to pull [s], None: never. The
    largest ratio of friction and normal force, and its time [s]."""

    name: str
    least: float
    time: float
    lifts: float | None
    ratio: float
    ratio_time: float


def look(run: Motion) -> list[Wheel]:
    """All wheels."""
    names = [name for name in run.result.variables if name.startswith("joint.") and name.endswith(NORMAL)]
    return [_wheel(run.result, name.removesuffix(NORMAL)) for name in names]


def say(found: Wheel) -> Item:
    """Whether a wheel stays on the plane, and does not slip."""
    if found.lifts is not None:
        said = (
            f"the plane would have to pull {found.name} with {number(-found.least)} N at t = {found.time:.6g} s: a real wheel "
            f"lifts off, from t = {found.lifts:.6g} s on; use a contact there"
        )
        return Item("rolling", "amber", f"Rolling: {said}", row=found.name, time=found.time)
    said = f"the plane presses on {found.name} with {number(found.least)} N or more"
    slips = f"it does not slip where the coefficient of friction is {found.ratio:.3g} or more (t = {found.ratio_time:.6g} s)"
    return Item("rolling", "green", f"Rolling: {said}, and {slips} (green if it never pulls)", row=found.name)


def _wheel(result: Readable, wheel: str) -> Wheel:
    time, normal = result.time, result.array(f"{wheel}{NORMAL}")
    friction = np.hypot(result.array(f"{wheel}.friction_x"), result.array(f"{wheel}.friction_y"))
    least, largest = int(np.argmin(normal)), float(np.max(np.abs(normal)))
    pulled, pressed = normal < -PULLED * largest, normal > PULLED * largest
    ratio = np.divide(friction, normal, out=np.zeros_like(friction), where=pressed)
    worst = int(np.argmax(ratio))
    return Wheel(
        wheel.removeprefix("joint."),
        float(normal[least]),
        float(time[least]),
        float(time[int(np.argmax(pulled))]) if pulled.any() else None,
        float(ratio[worst]),
        float(time[worst]),
    )


CHECKS = (Check("rolling", Motion, look, say, 420, (FRAMES,), "Rolling"),)
