"""Wheels of a run: whether the plane would have to pull, and how much friction rolling without slip takes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from nivel.results.scales import Readable
from nivel.results.trust.verdicts import Item, number

NORMAL = ".normal_force"
# a wheel that is pulled by less than this share of the largest normal force is not: that is round-off
PULLED = 1e-9


def rolling_items(result: Readable) -> Iterator[Item]:
    """A statement about each wheel; none where there are none."""
    for name in result.variables:
        if name.startswith("joint.") and name.endswith(NORMAL) and len(result.time):
            yield _wheel_item(result, name.removesuffix(NORMAL))


def _wheel_item(result: Readable, wheel: str) -> Item:
    name, time = wheel.removeprefix("joint."), result.time
    normal = result.array(f"{wheel}{NORMAL}")
    friction = np.hypot(result.array(f"{wheel}.friction_x"), result.array(f"{wheel}.friction_y"))
    least, largest = int(np.argmin(normal)), float(np.max(np.abs(normal)))
    if normal[least] < -PULLED * largest:
        said = (
            f"the plane would have to pull {name} with {number(-float(normal[least]))} N at t = {time[least]:.6g} s: a real wheel "
            f"lifts off, from t = {time[int(np.argmax(normal < -PULLED * largest))]:.6g} s on; use a contact there"
        )
        return Item("rolling", "amber", f"Rolling: {said}", row=name, time=float(time[least]))
    pressed = normal > PULLED * largest
    ratio = np.divide(friction, normal, out=np.zeros_like(friction), where=pressed)
    worst = int(np.argmax(ratio))
    said = f"the plane presses on {name} with {number(float(normal[least]))} N or more"
    needs = (
        f"it does not slip where the coefficient of friction is {ratio[worst]:.3g} or more (t = {time[worst]:.6g} s)"
    )
    return Item("rolling", "green", f"Rolling: {said}, and {needs} (green if it never pulls)", row=name)
