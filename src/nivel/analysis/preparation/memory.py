"""Numbers of the records of a prepared machine, all behind each other, to compare and to overwrite them.

Roles of the arrays of records: given by the machine, state of a motion, begun with a run, workspace of evaluations.
| role | content | where it counts |
|---|---|---|
| given | what the machine says: it is the same at all times | follows from parameters |
| state | what a motion remembers; at the start, where the machine begins | follows from parameters, is carried to another machine |
| begun | found as a run begins: first guesses, bounds of pivots, energies; others lead to the same motion | with friction |
| workspace | what an evaluation writes before it reads it | nowhere |

What an evaluation leaves (`work` of `nivel.kernels.core.arrays`) is workspace, and so are matrices and complex numbers, but what stands
in the tables here. Everything else is given.
"""

from collections.abc import Iterator, Mapping
from enum import Enum
from functools import cache, cached_property
from typing import Any, Final, NamedTuple, get_args, get_type_hints

import numpy as np
from numpy.typing import NDArray

from nivel.integrate.loop.run import Run
from nivel.kernels.record.beam_record import BeamTangent
from nivel.kernels.record.circuit_record import CircuitTangent
from nivel.kernels.record.flexible_record import Flexible, ModalTree
from nivel.kernels.record.function import CODE
from nivel.kernels.record.implicit_record import ComplexFactors, Coupled, Newton, RealFactors, Residual, Shifted
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
from nivel.machine.core.vectors import Array


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
    ComplexFactors: "pivot",
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


def arrays_of(record: Any) -> Iterator[NDArray[Any]]:
    """The same without what they are; also of records on dual numbers."""
    for part in record:
        if isinstance(part, tuple):
            yield from arrays_of(part)
        else:
            yield part


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
    values = functions.arguments[:, 0] if on_lanes else functions.arguments
    program = run.dual_address if on_lanes else run.address
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


AGREES: Final = 1e-11  # share of its scale by which numbers of machines that are the same may differ


class UnlikeError(Exception):
    """Machines that differ in more than numbers. name : an array. kind : `count` of its numbers, or `whole` numbers."""

    def __init__(self, name: str, kind: str) -> None:
        super().__init__(name, kind)
        self.name, self.kind = name, kind


class MachineMemory:
    """The arrays of records, and all their real numbers behind each other, n of them."""

    def __init__(self, *records: Any, **named: Any) -> None:
        """named : records whose names their arrays have before their own."""
        given = [*(("", record) for record in records), *named.items()]
        self.leaves: list[Leaf] = [leaf for name, record in given for leaf in leaves(record, name)]
        self.real = [leaf for leaf in self.leaves if leaf.array.dtype == np.float64]
        self._starts = np.cumsum([0, *(leaf.array.size for leaf in self.real)])

    @property
    def numbers(self) -> Array:
        """(n,) all real numbers."""
        return np.concatenate([np.zeros(0), *(leaf.array.ravel() for leaf in self.real)])

    @cached_property
    def workspace(self) -> NDArray[np.bool_]:
        """(n,) whether a number is that."""
        return np.concatenate([np.zeros(0, dtype=bool), *(leaf.workspace.ravel() for leaf in self.real)])

    def has(self, role: Role) -> NDArray[np.bool_]:
        """(n,) whether a number stands in an array with this role."""
        return np.repeat([leaf.role is role for leaf in self.real], [leaf.array.size for leaf in self.real])

    @cached_property
    def left(self) -> NDArray[np.bool_]:
        """(n,) whether a number has no part in what follows from parameters."""
        return self.workspace | self.has(Role.BEGUN)

    @cached_property
    def scales(self) -> Array:
        """(n,) what round-off of each number is measured by: the largest of its row, or itself."""
        out = [np.zeros(0)]
        for leaf in self.real:
            size = np.abs(np.where(np.isfinite(leaf.array), leaf.array, 0.0))
            if leaf.scale is not None:
                size = np.maximum(size, leaf.scale)
            elif leaf.role is Role.STATE and not leaf.mixed:
                size = np.full_like(size, size.max(initial=0.0))
            elif size.ndim > 1 and size.size and not leaf.mixed:
                rows = size.reshape(len(size), -1)
                size = np.broadcast_to(rows.max(axis=1, keepdims=True), rows.shape)
            out.append(size.ravel())
        return np.concatenate(out)

    def name_of(self, place: int) -> str:
        """The array in which a number stands."""
        return self.real[int(np.searchsorted(self._starts, place, side="right")) - 1].name

    def arrays_of(self, numbers: Array) -> list[Array]:
        """Numbers (n,) in the form of the arrays, zeros of those that have none."""
        parts = iter(np.split(numbers, self._starts[1:-1]))
        forms = [leaf.array.shape for leaf in self.leaves]
        is_real = [leaf.array.dtype == np.float64 for leaf in self.leaves]
        return [
            next(parts).reshape(form) if real else np.zeros(form) for form, real in zip(forms, is_real, strict=True)
        ]

    def put(self, places: NDArray[np.intp], values: Array) -> None:
        """Overwrite some numbers."""
        numbers = self.numbers
        numbers[places] = values
        for leaf, part in zip(self.leaves, self.arrays_of(numbers), strict=True):
            if leaf.array.dtype == np.float64:
                leaf.array[...] = part

    @property
    def addresses(self) -> NDArray[np.int64]:
        """(n,) where each number stands."""
        spans = [leaf.array.ctypes.data + 8 * np.arange(leaf.array.size) for leaf in self.real]
        return np.concatenate([np.zeros(0, dtype=np.int64), *spans])

    def refuse_unlike(self, other: "MachineMemory") -> None:
        """Raise UnlikeError where another machine differs in more than real numbers."""
        for mine, theirs in zip(self.leaves, other.leaves, strict=True):
            if mine.array.shape != theirs.array.shape:
                raise UnlikeError(mine.name, "count")
            if mine.array.dtype.kind in "fc" or mine.name.endswith("newton.address"):  # of records
                continue
            if (mine.array != theirs.array)[~mine.workspace].any():
                raise UnlikeError(mine.name, "whole")

    def differences(self, numbers: Array, other: "MachineMemory") -> list[str]:
        """Arrays in which given numbers and states `numbers` (n,) are not those of another machine. Raises UnlikeError."""
        self.refuse_unlike(other)
        wanted, scale = other.numbers, np.maximum(self.scales, other.scales)
        both = np.isfinite(numbers) & np.isfinite(wanted)
        apart = np.abs(np.where(both, numbers, 0.0) - np.where(both, wanted, 0.0)) > AGREES * scale
        same = np.where(both, ~apart, (numbers == wanted) | (np.isnan(numbers) & np.isnan(wanted)))
        return list(dict.fromkeys(self.name_of(int(place)) for place in np.flatnonzero(~same & ~self.left)))


ALIGNED: Final = 64  # bytes: a line of the cache


def in_one_piece(record: Any) -> tuple[Any, NDArray[np.uint8]]:
    """The record with all its arrays but addresses of machine code in one piece of memory, and that piece (bytes). What are the same
    arrays in it stay the same."""
    arrays: dict[int, NDArray[Any]] = {}
    _collect(record, arrays)
    places, size = {}, 0
    for key, array in arrays.items():
        places[key], size = size, size + -(-array.nbytes // ALIGNED) * ALIGNED
    piece = np.zeros(size + ALIGNED, np.uint8)
    piece = piece[-piece.ctypes.data % ALIGNED :][:size]
    own = {}
    for key, array in arrays.items():
        own[key] = piece[places[key] : places[key] + array.nbytes].view(array.dtype).reshape(array.shape)
        own[key][...] = array
    return _with(record, own), piece


def _collect(record: Any, arrays: dict[int, NDArray[Any]]) -> None:
    for field in record:
        if isinstance(field, tuple):
            _collect(field, arrays)
        elif field.size and field.dtype != np.uint64:
            arrays.setdefault(id(field), field)


def _with(record: Any, own: dict[int, NDArray[Any]]) -> Any:
    fields = (_with(field, own) if isinstance(field, tuple) else own.get(id(field), field) for field in record)
    return type(record)(*fields)
