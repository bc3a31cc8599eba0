"""Motion of one simulation carried over to another of a machine with the same structure and other numbers.

What is carried is what the motion remembers: time, state, turns of angles, memories of forces and friction, samples and inputs. Masses,
lengths and laws stay those of the machine that takes it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.plan.plan import Plan
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.preparation.roles import Role, leaves
from nivel.errors import ModelError
from nivel.integrate.loop.run import ALL_STEPS, BUDGET, END, EVERY, FRAMES, LAST_FRAME, OPEN_LIMIT, TOLERANCE, Run

Structure = Mapping[str, tuple[str, ...]]

# entries of clocks and counters that belong to a simulation, not to its motion
OWN_CLOCKS, OWN_COUNTERS = (END, TOLERANCE, OPEN_LIMIT), (ALL_STEPS, EVERY, FRAMES, LAST_FRAME, BUDGET)


def structure_of(plan: Plan, prepared: Prepared) -> Structure:
    """Names of all that a state is made of, and how it is stepped."""
    system, settings = prepared.motion.system, plan.settings
    layout, machine = system.layout, plan.machine
    return {
        "integrator": (settings.integrator,),
        "step": (f"{settings.step:.17g} s",),
        "coordinates": (prepared.path.module.rpartition(".")[2],),
        "formulation": (plan.methods.formulation,),
        "body": system.bodies,
        "joint": system.joints,
        "joint coordinate": tuple(layout.coordinates["joint_coordinate"]),
        "constraint row": system.rows,
        "force": tuple(f"{force.name} ({force.type})" for force in machine.forces),
        "state": tuple(fact.name for fact in system.states),
        "mode": system.modes,
        "event": system.events,
        "input": tuple(each.name for each in machine.inputs),
        "coordinate of the tree": system.tree_names,
        "number of the state": (str(len(prepared.start)),),
    }


def refuse_other_structure(mine: Structure, given: Structure) -> None:
    """Raise ModelError with what a state of another structure has in place of this one's."""
    for kind, names in mine.items():
        other = tuple(given.get(kind, ()))
        if names == other:
            continue
        more, less = ([name for name in a if name not in b] for a, b in ((other, names), (names, other)))
        if len(names) == len(other) == 1 or not (more or less):
            said = f"its {kind} is {', '.join(other) or 'not known'}, not {', '.join(names)}"
        else:
            parts = [f"it has the {kind} `{more[0]}`, which is not here"] if more else []
            said = "; ".join([*parts, *([f"it lacks the {kind} `{less[0]}`"] if less else [])])
        raise ModelError(f"the state is of another machine: {said}")


def carry_over(kept: Sequence[NDArray[Any]], given: Sequence[NDArray[Any]], prepared: Prepared, run: Run) -> None:
    """Put what a state remembers of a motion into `prepared` and `run`, whose memory is `kept`. given : arrays of the state."""
    for mine, theirs in _pairs(kept, given, prepared, run):
        if mine is run.clock or mine is run.counter:
            own = list(OWN_CLOCKS if mine is run.clock else OWN_COUNTERS)
            values = mine[own].copy()
            mine[...] = theirs
            mine[own] = values
        else:
            mine[...] = theirs


def _pairs(
    kept: Sequence[NDArray[Any]], given: Sequence[NDArray[Any]], prepared: Prepared, run: Run
) -> Iterator[tuple[NDArray[Any], NDArray[Any]]]:
    """Arrays that are carried, and what the state has for them."""
    record, functions = prepared.motion.system.record, prepared.motion.system.record.functions
    for leaf in (*leaves(run), *leaves(record)):
        is_carried = leaf.role is Role.STATE or (leaf.role is Role.BEGUN and leaf.name.startswith("friction."))
        if is_carried and leaf.array.size:
            yield leaf.array, _found(leaf.array, kept, given)
    inputs = list(prepared.motion.system.input_functions)
    for array in (functions.kind, functions.value):
        if inputs:
            theirs, all_of_it = _found(array, kept, given), array.copy()
            all_of_it[inputs] = theirs[inputs]
            yield array, all_of_it


def _found(array: NDArray[Any], kept: Sequence[NDArray[Any]], given: Sequence[NDArray[Any]]) -> NDArray[Any]:
    """What a state has for an array, which is one of those kept or lies in one of them."""
    begin, size = array.ctypes.data, array.nbytes
    for mine, theirs in zip(kept, given, strict=True):
        first = mine.ctypes.data
        if first <= begin and begin + size <= first + mine.nbytes:
            part = np.ascontiguousarray(theirs).reshape(-1).view(np.uint8)[begin - first : begin - first + size]
            return part.view(array.dtype).reshape(array.shape)
    raise ModelError("the state is of another machine, or of other settings of the simulation")
