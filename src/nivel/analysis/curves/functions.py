"""The functions of a machine as curves: their values at many places at once, and bounds of them over intervals."""

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from nivel.kernels.record.program_bounds import WIDTH, find_bounds
from nivel.known import FunctionCoupling
from nivel.lazy import Struct
from nivel.machine.core.vectors import Array
from nivel.machine.laws.functions import Sampling
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.varying_value import Expression, Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.arithmetic import LOCAL_SYMBOLS
from nivel.machine.units.formula import linear_function
from nivel.machine.units.tree import TIME
from nivel.native.signature import LAW
from nivel.system.laws.laws import law_address
from nivel.system.laws.program import PlacedProgram

# straight pieces that stand for one of a smooth table
PIECES = 16
# what results call a part of a section, where it is another word
OF = {"drivers": "driver", "forces": "force", "states": "state"}


class Curve(Protocol):
    """A function of the time and of signals."""

    @property
    def signals(self) -> tuple[str, ...]:
        """What it depends on beside the time."""
        ...

    def values(self, known: Mapping[str, Array]) -> Array:
        """At n places; known : the time and all signals there."""
        ...

    def bounds(self, first: Mapping[str, Array], last: Mapping[str, Array]) -> tuple[Array, Array] | None:
        """On n straight ways from what is known at the one end to that at the other; None where they are not known."""
        ...


class Varying(Struct):
    """A function of a part of a machine.

    name : as users know it, `push.vector.x`. of : name of the part in results, `force.push`. sampling, motion : as of
    `MachineFunction`.
    """

    name: str
    of: str
    curve: Curve
    sampling: Sampling | None = None
    motion: bool = False


class ExpressionCurve(Struct):
    """An expression of a machine file."""

    expression: Expression

    @property
    def signals(self) -> tuple[str, ...]:
        return self.expression.signals

    def values(self, known: Mapping[str, Array]) -> Array:
        return self._program.values(known)

    def bounds(self, first: Mapping[str, Array], last: Mapping[str, Array]) -> tuple[Array, Array] | None:
        row, paths = self._program.row, self._program.paths
        ways = np.stack([(first[path], last[path]) for path in paths]).transpose(2, 0, 1)
        out = np.empty((len(ways), 2))
        find_bounds(row, ways.ravel(), np.empty(WIDTH * len(row)), len(paths), out.reshape(-1))
        return out[:, 0], out[:, 1]

    @cached_property
    def _program(self) -> PlacedProgram:
        return PlacedProgram.of(self.expression.tree)


class TableCurve(Struct):
    """A table as straight lines between `points`, those of a smooth one close together."""

    table: Table

    @property
    def signals(self) -> tuple[str, ...]:
        return self.table.signals

    @cached_property
    def points(self) -> tuple[Array, Array]:
        """Places (n,), ascending, and values (n,)."""
        at, values = np.array(self.table.times, dtype=float), np.array(self.table.values, dtype=float)
        if self.table.interpolation == "linear" or len(at) < 2:
            return at, values
        share = np.arange(PIECES) / PIECES
        h = share * np.diff(at)[:, None]
        c = self.table.coefficients()[:, :, None]
        between = c[:, 0] + h * (c[:, 1] + h * (c[:, 2] + h * c[:, 3]))
        return np.append((at[:-1, None] + h).ravel(), at[-1]), np.append(between.ravel(), values[-1])

    def values(self, known: Mapping[str, Array]) -> Array:
        return np.interp(known[self.table.of], *self.points)

    def bounds(self, first: Mapping[str, Array], last: Mapping[str, Array]) -> tuple[Array, Array] | None:
        """At the ends of a way and at the points between them."""
        (at, values), both = self.points, (first[self.table.of], last[self.table.of])
        ends = np.interp(both[0], at, values), np.interp(both[1], at, values)
        least, largest = np.minimum(*ends), np.maximum(*ends)
        low, high = np.searchsorted(at, np.minimum(*both)), np.searchsorted(at, np.maximum(*both), side="right")
        inside = np.flatnonzero(high > low)
        if len(inside):
            # reduceat takes pairs of places; the value behind the last one belongs to no pair
            pairs = np.column_stack([low[inside], high[inside]]).ravel()
            padded = np.append(values, values[-1])
            least[inside] = np.minimum(least[inside], np.minimum.reduceat(padded, pairs)[::2])
            largest[inside] = np.maximum(largest[inside], np.maximum.reduceat(padded, pairs)[::2])
        return least, largest


class LawCurve(Struct):
    """A Python function, which can only be called."""

    law: PythonLaw
    motion: bool

    @property
    def signals(self) -> tuple[str, ...]:
        return self.law.signals

    @cached_property
    def _function(self) -> Any:
        return LAW.function_at(law_address(self.law, motion=self.motion))

    def values(self, known: Mapping[str, Array]) -> Array:
        count = len(known[TIME])
        columns = [known[each] if isinstance(each, str) else np.full(count, float(each)) for each in self.law.arguments]
        rows = np.ascontiguousarray(np.column_stack([*columns, np.zeros((count, 2))]))
        return np.array([self._function(row) for row in rows])

    def bounds(self, first: Mapping[str, Array], last: Mapping[str, Array]) -> tuple[Array, Array] | None:
        return None


class TurningCurve(Struct):
    """The angle of a coupling by inverse tangents, which goes on over turns along the time. It has no bounds: those of an inverse
    tangent are half a turn wide wherever a tangent has a pole."""

    curve: ExpressionCurve

    @property
    def signals(self) -> tuple[str, ...]:
        return self.curve.signals

    def values(self, known: Mapping[str, Array]) -> Array:
        """Without jumps of whole turns from one time to the next."""
        values, order = np.nan_to_num(self.curve.values(known)), np.argsort(known[TIME], kind="stable")
        values[order] = np.unwrap(values[order])
        return values

    def bounds(self, first: Mapping[str, Array], last: Mapping[str, Array]) -> tuple[Array, Array] | None:
        return None


class SideOf(Struct):
    """The sign of a curve, as an event has it."""

    curve: Curve

    @property
    def signals(self) -> tuple[str, ...]:
        return self.curve.signals

    def values(self, known: Mapping[str, Array]) -> Array:
        """Signs, zero also where there is no value."""
        return np.sign(np.nan_to_num(self.curve.values(known)))

    def bounds(self, first: Mapping[str, Array], last: Mapping[str, Array]) -> tuple[Array, Array] | None:
        """The signs of its bounds."""
        found = self.curve.bounds(first, last)
        return None if found is None else (np.sign(found[0]), np.sign(found[1]))


def varying(machine: MachineRecord, *, sampled: bool = False) -> Iterator[Varying]:
    """The functions of a machine that may do something by themselves: what is linear only passes on what it depends on.

    sampled : those that are looked at in samples only, or those that are looked at in every step.
    """
    turning = {each.name for each in machine.couplings if isinstance(each, FunctionCoupling) and each.counts_turns}
    for each in machine.functions:
        function = each.function
        if (each.sampling is not None) == sampled and not (
            isinstance(function, Expression) and linear_function(function.tree) is not None
        ):
            turns = each.section == "couplings" and each.part in turning
            yield Varying(
                each.name,
                f"{OF.get(each.section, each.section)}.{each.part}",
                TurningCurve(ExpressionCurve(function))
                if turns and isinstance(function, Expression)
                else _curve(function, each.motion),
                each.sampling,
                each.motion,
            )


def _curve(function: Expression | Table | PythonLaw, motion: bool) -> Curve:
    match function:
        case Expression():
            return ExpressionCurve(function)
        case Table():
            return TableCurve(function)
        case PythonLaw():
            return LawCurve(function, motion)


def is_local(symbol: str) -> bool:
    """Whether a symbol is what the force itself measures."""
    return symbol in LOCAL_SYMBOLS
