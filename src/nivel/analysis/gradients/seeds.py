"""Seeds of gradients: slopes of all numbers of a record along parameters of the machine, by differences of machines built beside it.

Every number that follows from a parameter moves with it, those that are derived too: the assembled start, the frames of bodies,
factors of inertias. A record is smooth in the numbers of a file, and known to round-off, or to what the assembly and an equilibrium are
closed to. Differences of order four over a wide step leave little of that. Where the machine cannot be built so far away, or is not smooth
there, the step is narrow.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from nivel.analysis.gradients.outputs import Array
from nivel.analysis.gradients.parameters import Parameter
from nivel.analysis.gradients.whole_loop import WholeLoop, leaves
from nivel.analysis.run.dynamics import Loop
from nivel.errors import Fault, ModelError, refuse
from nivel.kernels.core.arrays import dual_twin
from nivel.native.duals import DUAL

# parameters of the machines beside are away from their own values by these shares of their scales, and twice as far: wide, narrow
WIDE, NARROW = 1e-3, 1e-5
# Differences over a step and over two are the same but for this share of the largest where a record is smooth; and what is round-off of
# them, as a share of the numbers.
SMOOTH, ROUND_OFF = 1e-2, 1e-6
# parts of a record that evaluations and solutions overwrite
OVERWRITTEN = ("saddle", "tree", "newton", "residual", "frames", "control")


# slopes of all arrays of both records of a loop, that of the machine and that of the run
Seeds = list[list[Array]]


def seeds_of(loop: Loop, parameters: Sequence[Parameter], beside: Callable[[Parameter, float], Loop]) -> list[Seeds]:
    """Slopes of the numbers of both records along each parameter, for a change by its scale.

    beside(parameter, value) : the loop of the machine with another value, built in the same way. Raises ModelError with every parameter
    with which the machine changes otherwise than in numbers.
    """
    faults, out = [], []
    for parameter in parameters:
        try:
            out.append(_slopes_beside(_records(loop), parameter, beside))
        except ModelError as error:
            faults += [Fault.at(parameter.path, f"there is no gradient: {each.message}") for each in error.faults]
    refuse(faults)
    return out


def seed(whole: WholeLoop, seeds: Sequence[Seeds]) -> None:
    """Give the numbers of both records their slopes, a lane for each of LANES seeds at most."""
    for lane, slopes in enumerate(seeds):
        for twin, of_record in zip((whole.machine, whole.run), slopes, strict=True):
            for (_, dual), slope in zip(leaves(twin), of_record, strict=True):
                if dual.dtype == DUAL:
                    dual["slopes"][..., lane] = slope


def _slopes_beside(records: Sequence[Any], parameter: Parameter, beside: Callable[[Parameter, float], Loop]) -> Seeds:
    """Slopes of all arrays of both records for a change of the parameter by its scale."""
    try:
        near, far = (_differences(records, parameter, beside, factor * WIDE) for factor in (1.0, 2.0))
    except ModelError:
        near = far = None
    if near is not None and far is not None and all(map(_is_smooth, records, near, far)):
        return [[(4.0 * a - b) / 3.0 for a, b in zip(*each, strict=True)] for each in zip(near, far, strict=True)]
    return _differences(records, parameter, beside, NARROW)


def _differences(
    records: Sequence[Any], parameter: Parameter, beside: Callable[[Parameter, float], Loop], aside: float
) -> Seeds:
    """Central differences of all arrays of both records over steps of this share. Raises ModelError where more than numbers changes."""
    low, high = (beside(parameter, parameter.value + sign * aside * parameter.scale) for sign in (-1.0, 1.0))
    return [
        [
            _difference(name, base, before, after, aside)
            for (name, base), (_, before), (_, after) in zip(*map(leaves, three), strict=True)
        ]
        for three in zip(records, _records(low), _records(high), strict=True)
    ]


def _records(loop: Loop) -> tuple[Any, Any]:
    return loop.machine.record, loop.history.record


def _difference(name: str, base: Any, low: Any, high: Any, aside: float) -> Array:
    if not base.shape == low.shape == high.shape:
        raise ModelError(_other_machine(name))
    if base.dtype == np.float64:
        with np.errstate(invalid="ignore"):  # of what is infinite
            difference = (high - low) / (2.0 * aside)
        return np.where(np.isfinite(difference), difference, 0.0)
    if _is_structure(name, base) and not np.array_equal(low, high):
        raise ModelError(_other_machine(name))
    return np.zeros(base.shape)


def _is_smooth(record: Any, near: Sequence[Array], far: Sequence[Array]) -> bool:
    """Whether differences over a step and over two are nearly the same, of numbers that no evaluation overwrites."""
    for (name, base), (_, twin), a, b in zip(leaves(record), leaves(dual_twin(record)), near, far, strict=True):
        if base.dtype != np.float64 or twin.dtype == DUAL or not base.size or name.startswith(OVERWRITTEN):
            continue
        largest = np.max(np.abs(base[np.isfinite(base)]), initial=0.0)
        if not np.max(np.abs(a - b)) <= SMOOTH * np.max(np.abs(a)) + ROUND_OFF * largest:
            return False
    return True


def _is_structure(name: str, array: Any) -> bool:
    """Whether whole numbers of a record say what there is, and not where something stands in memory."""
    return array.dtype != np.uint64 or name == "functions.address"


def _other_machine(name: str) -> Fault:
    what = "its Python laws" if name == "functions.address" else f"the structure of its equations ({name})"
    return Fault.at("", f"a small change of it changes {what}, not only numbers")
