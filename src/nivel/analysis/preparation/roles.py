"""Roles of the arrays of records: given by the machine, state of a motion, begun with a run, workspace of evaluations.

| role | content | where it counts |
|---|---|---|
| given | what the machine says: it is the same at all times | follows from parameters |
| state | what a motion remembers; at the start, where the machine begins | follows from parameters, is carried to another machine |
| begun | found as a run begins: first guesses, bounds of pivots, energies; others lead to the same motion | with friction |
| workspace | what an evaluation writes before it reads it | nowhere |

What an evaluation leaves (`work` of `nivel.kernels.core.arrays`) is workspace, and so are matrices and complex numbers, but what stands
in the tables here. Everything else is given.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from enum import Enum
from functools import cache
from typing import Any, Final, NamedTuple, get_args, get_type_hints

import numpy as np
from numpy.typing import NDArray

from nivel.integrate.loop.run import Run
from nivel.kernels.record.beam_record import BeamTangent
from nivel.kernels.record.circuit_record import CircuitTangent
from nivel.kernels.record.flexible_record import Flexible, ModalTree
from nivel.kernels.record.function import CODE
from nivel.kernels.record.implicit_record import Coupled, Newton, RealFactors, Residual, Shifted
from nivel.kernels.record.program import END, LENGTH, run
from nivel.kernels.record.record import (
    Circuit,
    Control,
    Coordinates,
    Elements,
    Frames,
    Friction,
    Functions,
    Outputs,
    Partition,
    Saddle,
    Sampled,
    Tree,
    Watched,
)


class Role(Enum):
    """What an array of a record is."""

    GIVEN = "given"
    STATE = "state"
    BEGUN = "begun"
    WORKSPACE = "workspace"


GIVEN: Final[Mapping[type, str]] = {Elements: "number", Functions: "arguments", Tree: "first"}
STATE: Final[Mapping[type, str]] = {
    Coordinates: "reference",
    Elements: "memory proposal",
    Watched: "followed held",
    Sampled: "came due",
    Tree: "element state",
    Run: "clock counter y previous samples",
}
BEGUN: Final[Mapping[type, str]] = {
    Coordinates: "value J",
    Friction: "force anchor work",
    Circuit: "known",
    Saddle: "least",
    Outputs: "value",
    Residual: "vdot lam",
    Control: "settled energy",
}
WORKSPACE: Final[Mapping[type, str]] = {
    Friction: "mass S response change free lam jacobian",
    Circuit: "kept",
    CircuitTangent: "by_mass by_stroke effort slopes direction response compliance matrix b load travel",
    Watched: "value rate",
    Sampled: "value",
    Saddle: "W G z S L Dinv y b dense null pivot target before",
    Frames: "R theta Rdot Rddot",
    Tree: "before inertia U Dinv root wrench delta change moved small",
    Partition: "scale weight E null B MB H u D Q v p b",
    Flexible: "root",
    ModalTree: "coupling factor push",
    BeamTangent: "wrench S B k P twist change local psi",
    Residual: "limit rate",
    Newton: "base turn speed state correction rate change value L U Dinv work pivot b last moved before moved_before",
    RealFactors: "value L U Dinv work pivot b moved r",
    Coupled: "M D K state r moved reach spin pivot work",
    Shifted: "M D K",
    Control: "failure",
    Run: "rate scratch trial",
}
# arrays of which each number has a size of its own; rows of others share a unit, and round-off is measured by the largest of a row
MIXED: Final[Mapping[type, str]] = {
    Elements: "number memory",
    Friction: "number",
    Functions: "coefficients arguments",
    Circuit: "fluid room",
    Tree: "number turn",
}


class Leaf(NamedTuple):
    """An array of a record. name : with its parts, as `bodies.mass`. workspace : (of its shape) its entries that are.

    mixed : each of its numbers has a size of its own. scale : (of its shape) what errors of it are measured by, where that is known.
    """

    name: str
    array: NDArray[Any]
    role: Role
    workspace: NDArray[np.bool_]
    mixed: bool
    scale: NDArray[np.float64] | None


def leaves(record: Any, name: str = "") -> Iterator[Leaf]:
    """The arrays of a record, in its order."""
    for field, part in zip(record._fields, record, strict=True):
        whole = f"{name}.{field}" if name else field
        if isinstance(part, tuple):
            yield from leaves(part, whole)
            continue
        role = _roles(type(record))[field]
        workspace = np.full(part.shape, role is Role.WORKSPACE)
        if isinstance(record, Functions) and field == "arguments":
            workspace[_computed(record)] = True
        scale = record.scale if isinstance(record, Run) and field in ("y", "previous") else None
        yield Leaf(whole, part, role, workspace, field in MIXED.get(type(record), "").split(), scale)


@cache
def _roles(record_class: Any) -> Mapping[str, Role]:
    """Roles of the arrays of a record by their fields."""
    hints = get_type_hints(record_class, include_extras=True)
    out = {}
    for field in record_class._fields:
        kind = (*get_args(hints[field]), None, None, None)[2]
        out[field] = Role.WORKSPACE if kind in ("work", "plain", "complex") else Role.GIVEN
    for role, fields in ((Role.GIVEN, GIVEN), (Role.STATE, STATE), (Role.BEGUN, BEGUN), (Role.WORKSPACE, WORKSPACE)):
        out |= dict.fromkeys(fields.get(record_class, "").split(), role)
    return out


def _computed(functions: Functions) -> NDArray[np.bool_]:
    """Which entries of `arguments` are arguments, results of instructions, or derivatives, and not numbers of a program."""
    on_lanes = functions.arguments.ndim == 2
    values, program = (
        functions.arguments[:, 0] if on_lanes else functions.arguments,
        run.dual_address if on_lanes else run.address,
    )
    out = np.zeros(len(values), dtype=bool)
    out[functions.argument[:, 3]] = True
    for kind, address, (first, end, behind, at) in zip(
        functions.kind, functions.address, functions.span.astype(np.int64), strict=True
    ):
        out[behind + end - first :][:2] = True
        if kind == CODE and address == program:
            instructions = at
            while values[instructions] != END:
                out[at + int(values[instructions + 1])] = True
                instructions += LENGTH
    return out
