"""Seeds of gradients: slopes of all numbers of a record along parameters of the machine, from machines built beside it.

Every number that follows from a parameter moves with it, those that are derived too: the assembled start, the frames of bodies,
factors of inertias. Most follow laws, whose slopes are exact. A start that is assembled is smooth in the numbers of a file, and known to
round-off, or to what the assembly and an equilibrium are closed to: differences of order four over a wide step leave little of that. Where
the machine cannot be built so far away, or is not smooth there, the step is narrow.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from nivel.analysis.gradients.outputs import Array
from nivel.analysis.gradients.parameters import Parameter
from nivel.analysis.gradients.whole_loop import WholeLoop, leaves
from nivel.analysis.preparation.memory import MachineMemory, UnlikeError
from nivel.analysis.preparation.parameters import Sample, Unfit, UnfitError, numbers_of
from nivel.analysis.run.dynamics import Loop
from nivel.errors import Fault, ModelError, refuse
from nivel.native.duals import DUAL

# parameters of the machines beside are away from their own values by these shares of their scales, and twice as far: wide, narrow
WIDE, NARROW = 1e-3, 1e-5
# Differences over a step and over two are the same but for this share of the largest where a record is smooth; and what is round-off of
# them, as a share of the numbers.
SMOOTH, ROUND_OFF = 1e-2, 1e-6
TURNS = ((WIDE, ((-1.0, 1.0), (-2.0, 2.0))), (NARROW, ((-1.0, 1.0),)))

# slopes of all arrays of both records of a loop, that of the machine and that of the run, in their order
Seeds = list[Array]


def seeds_of(loop: Loop, parameters: Sequence[Parameter], beside: Callable[[Parameter, float], Loop]) -> list[Seeds]:
    """Slopes of the numbers of both records along each parameter, for a change by its scale.

    beside(parameter, value) : the loop of the machine with another value, built in the same way. Raises ModelError with every parameter
    with which the machine changes otherwise than in numbers.
    """
    memory, faults, out = _memory(loop), list[Fault](), list[Seeds]()
    for each in parameters:
        values = [
            [[each.value + side * aside * each.scale for side in turn] for turn in turns] for aside, turns in TURNS
        ]
        x = np.array([each.value])
        try:
            numbers = numbers_of(
                memory,
                x,
                [values],
                lambda _, value, each=each: _memory(beside(each, value)),
                partial(_is_smooth, memory),
            )
        except UnfitError as error:
            faults += _faults(error.args[0], each)
            continue
        slopes = np.zeros(len(memory.numbers))
        slopes[numbers.places] = numbers.slopes(x)[:, 0] * each.scale
        out.append(memory.arrays_of(np.where(np.isfinite(slopes), slopes, 0.0)))
    refuse(faults)
    return out


def seed(whole: WholeLoop, seeds: Sequence[Seeds]) -> None:
    """Give the numbers of both records their slopes, a lane for each of LANES seeds at most."""
    twins = [*leaves(whole.machine), *leaves(whole.run)]
    for lane, slopes in enumerate(seeds):
        for (_, dual), slope in zip(twins, slopes, strict=True):
            if dual.dtype == DUAL:
                dual["slopes"][..., lane] = slope


def _memory(loop: Loop) -> MachineMemory:
    return MachineMemory(loop.machine.record, loop.history.record)


def _is_smooth(memory: MachineMemory, sample: Sample) -> bool:
    """Whether differences over a step and over two are nearly the same, of numbers that no evaluation overwrites."""
    low, high, below, above, own = sample.numbers
    with np.errstate(invalid="ignore"):
        near, far = np.nan_to_num(high - low), np.nan_to_num(0.5 * (above - below))
    kept = np.where(memory.workspace, 0.0, 1.0)
    return all(
        np.max(np.abs(a - b), initial=0.0)
        <= SMOOTH * np.max(np.abs(a), initial=0.0)
        + ROUND_OFF * 2.0 * WIDE * np.max(np.abs(base[np.isfinite(base)]), initial=0.0)
        for a, b, base in zip(*(memory.arrays_of(each) for each in (kept * near, kept * far, own)), strict=True)
    )


def _faults(unfit: Unfit, parameter: Parameter) -> list[Fault]:
    match unfit.reason:
        case ModelError() as error:
            messages = [fault.message for fault in error.faults]
        case UnlikeError(name=name):
            what = "its Python laws" if name == "functions.address" else f"the structure of its equations ({name})"
            messages = [f"a small change of it changes {what}, not only numbers"]
        case str(name):
            messages = [f"`{name}` is not smooth"]
    return [Fault.at(parameter.path, f"there is no gradient: {message}") for message in messages]
