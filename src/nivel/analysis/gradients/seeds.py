"""Seeds of gradients: slopes of all numbers of a record along parameters of the machine, by differences of machines built beside it.

Every number that follows from a parameter moves with it, those that are derived too: the assembled start, the frames of bodies,
factors of inertias. A record is smooth in the numbers of a file, and known to round-off.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from nivel.analysis.gradients.parameters import Parameter
from nivel.analysis.gradients.whole_loop import WholeLoop, leaves
from nivel.analysis.run.dynamics import Loop
from nivel.errors import Fault, ModelError
from nivel.native.duals import DUAL

# parameters of the machines beside are away from their own values by this share of their scales
ASIDE = 1e-5


def seed(
    whole: WholeLoop, loop: Loop, parameters: Sequence[Parameter], beside: Callable[[Parameter, float], Loop]
) -> None:
    """Give the numbers of both records their slopes along LANES parameters at most, for a change of each by its scale.

    beside(parameter, value) : the loop of the machine with another value, built in the same way. Raises ModelError with every parameter
    with which the machine changes otherwise than in numbers.
    """
    faults = []
    for lane, parameter in enumerate(parameters):
        step = ASIDE * parameter.scale
        try:
            low, high = (beside(parameter, parameter.value + sign * step) for sign in (-1.0, 1.0))
            for own, twin, pair in (
                (loop.machine.record, whole.machine, (low.machine.record, high.machine.record)),
                (loop.history.record, whole.run, (low.history.record, high.history.record)),
            ):
                _seed_record(own, twin, pair, lane)
        except ModelError as error:
            faults += [
                Fault("", 0, 0, parameter.path, f"there is no gradient: {each.message}") for each in error.faults
            ]
    if faults:
        raise ModelError(faults)


def _seed_record(own: Any, twin: Any, pair: tuple[Any, Any], lane: int) -> None:
    for (name, base), (_, dual), (_, low), (_, high) in zip(*map(leaves, (own, twin, *pair)), strict=True):
        if not base.shape == low.shape == high.shape:
            raise ModelError(_other_machine(name))
        if dual.dtype == DUAL:
            with np.errstate(invalid="ignore"):  # of what is infinite
                difference = (high - low) / (2.0 * ASIDE)
            dual["slopes"][..., lane] = np.where(np.isfinite(difference), difference, 0.0)
        elif _is_structure(name, base) and not np.array_equal(low, high):
            raise ModelError(_other_machine(name))


def _is_structure(name: str, array: Any) -> bool:
    """Whether whole numbers of a record say what there is, and not where something stands in memory."""
    return array.dtype != np.uint64 or name == "functions.address"


def _other_machine(name: str) -> Fault:
    what = "its Python laws" if name == "functions.address" else f"the structure of its equations ({name})"
    return Fault("", 0, 0, "", f"a small change of it changes {what}, not only numbers")
