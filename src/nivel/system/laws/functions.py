"""Functions of time and signals for the kernels: constants, tables and expressions as numbers, laws as compiled code."""

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from nivel.kernels.record.function import CODE, CONSTANT, HELD, LINEAR, NUMBER, TABLE_EXTENDED, TABLE_HELD, TIME
from nivel.kernels.record.program import run
from nivel.kernels.record.record import Functions
from nivel.lazy import dataclass, field
from nivel.machine.control.part import PartFunction, UnitOutput
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.varying_value import Expression, Table
from nivel.machine.units.formula import Formula, LinearFunction, linear_function
from nivel.machine.units.functions import SMOOTH
from nivel.machine.units.tree import TIME as TIME_SYMBOL
from nivel.machine.units.tree import Node
from nivel.system.laws.laws import law_address
from nivel.system.laws.program import (
    Switching,
    curve_motion_program,
    curve_program,
    expression_program,
    motion_program,
    switching_program,
    way_program,
)
from nivel.system.signals.unit import Unit
from nivel.system.signals.units import unit_of
from nivel.system.tables import Array, index_array

Signal = tuple[int, int, int]  # kind, index, component: see `nivel.kernels.record.function`
Find = Callable[[str], Signal]


@dataclass
class FunctionTable:
    """Functions of a machine in numbers. Laws are compiled, or loaded from the cache, when they are added.

    units : of others by their blocks. switches : places in `arguments` of the side of each switch, and of its difference. switching : the
    function of each.
    """

    kind: list[int] = field(default_factory=list)
    value: list[float] = field(default_factory=list)
    address: list[int] = field(default_factory=list)
    table: list[tuple[int, int]] = field(default_factory=list)
    span: list[tuple[int, int, int, int]] = field(default_factory=list)
    knots: list[float] = field(default_factory=list)
    coefficients: list[Sequence[float]] = field(default_factory=list)
    argument: list[tuple[int, int, int, int]] = field(default_factory=list)
    arguments: list[float] = field(default_factory=list)
    switches: list[tuple[int, int]] = field(default_factory=list)
    switching: list[Node] = field(default_factory=list)
    units: dict[str, Unit] = field(default_factory=dict)

    def add(
        self,
        function: PartFunction,
        find: Find,
        *,
        motion: bool = False,
        end: float = math.inf,
        switching: bool = False,
        beyond: bool = True,
    ) -> int:
        """Index of a new function; `find` gives the signal of a path. motion : its derivatives are needed, up to the `end` of the run [s].
        switching : every evaluation of the machine finds its value once, so that its corners with signals can be switches.
        beyond : where it jumps at an instant it has the value beyond it (`nivel.system.laws.program`).

        Raises ModelError where a law cannot be compiled.
        """
        match function:
            case Table() if function.interpolation in SMOOTH:
                make = curve_motion_program if motion else curve_program
                program = make(function.interpolation, function.times, function.values)
                return self._append(CODE, [function.of], find, address=run.address, program=program)
            case Table():
                pieces = function.coefficients()
                last = [float(function.values[-1]), 0.0, 0.0, 0.0]
                times, rows = list(function.times), [*pieces.tolist(), last]
                if motion and function.ends_before(end):
                    # at its end it has the rate of what follows, as at every other point
                    times, rows = [*times, math.inf], [*rows, last]
                return self._append(TABLE_HELD, [function.of], find, table=(times, rows))
            case LinearFunction():
                return self._append_linear(function, find)
            case Expression() if motion:
                return self._append(CODE, [TIME_SYMBOL], find, address=run.address, program=motion_program(function))
            case Expression() if (linear := linear_function(function.tree)) is not None:
                return self._append_linear(linear, find)
            case Expression() | Formula():
                signals = list(dict.fromkeys([TIME_SYMBOL, *function.signals]))
                if switching:
                    program = switching_program(function, signals)
                    self.switching += [function.tree] * len(program.switches)
                    return self._append_switching(program, signals, find)
                program = expression_program(function, signals, beyond=beyond)
                return self._append(CODE, signals, find, address=run.address, program=program)
            case UnitOutput():
                unit = self.units.get(function.facts.block) or unit_of(function.facts)
                self.units[function.facts.block] = unit
                arguments = [float(unit.handle.address), float(function.number), TIME_SYMBOL, *function.inputs]
                return self._append(CODE, arguments, find, address=unit.law.address)
            case PythonLaw():
                address = law_address(function, motion=motion)
                return self._append(CODE, list(function.arguments), find, address=address)
        return self._append(CONSTANT, [], find, value=float(function))

    def _append_linear(self, function: LinearFunction, find: Find) -> int:
        factors, paths = [factor for factor, _ in function.terms], [path for _, path in function.terms]
        return self._append(LINEAR, paths, find, value=function.offset, table=(factors, [[0.0] * 4] * len(factors)))

    def _append_switching(self, program: Switching, signals: list[str], find: Find) -> int:
        start, first = len(self.arguments), len(self.switches)
        self.switches += [(start + side, start + difference) for side, difference in program.switches]
        held: list[Signal] = [(HELD, first + k, 0) for k in range(len(program.switches))]
        return self._append(CODE, [*signals, *held], find, address=run.address, program=program.row)

    def add_table(self, knots: Sequence[float], coefficients: Array) -> int:
        """Index of a new table that goes on beyond its ends; `coefficients` (n, 4) as `Functions.coefficients`."""
        return self._append(TABLE_EXTENDED, [], _nothing, table=(knots, coefficients.tolist()))

    def add_way(self, points: NDArray[np.float64], pieces: NDArray[np.float64]) -> int:
        """Index of a motion given as polynomials (n - 1, 6) of time between points, with its derivatives."""
        return self._append(
            CODE, [TIME_SYMBOL], _nothing, address=run.address, program=way_program(points.tolist(), pieces)
        )

    def add_spline(self, table: Table, order: int, find: Find) -> int:
        """Index of the derivative of this order (0: the value) of a cubic table, which goes on straight beyond its ends: a natural spline
        is not bent there."""
        points, inner = np.array(table.times), table.coefficients()
        h = points[-1] - points[-2]
        begin, end = inner[0, 1], inner[-1] @ [0.0, 1.0, 2.0 * h, 3.0 * h * h]
        before = [table.values[0] - begin, begin, 0.0, 0.0]  # from a knot at a distance of one before the first point
        pieces = np.vstack([before, inner, [table.values[-1], end, 0.0, 0.0]])
        for _ in range(order):
            pieces = np.hstack([pieces[:, 1:] * [1.0, 2.0, 3.0], np.zeros((len(pieces), 1))])
        knots = [points[0] - 1.0, *points]
        return self._append(TABLE_EXTENDED, [table.of], find, table=(knots, pieces.tolist()))

    def _append(
        self,
        kind: int,
        arguments: Sequence[str | float | Signal],
        find: Find,
        *,
        value: float = 0.0,
        address: int = 0,
        program: Sequence[float] = (),
        table: tuple[Sequence[float], Sequence[Sequence[float]]] = ((), ()),
    ) -> int:
        first, start = len(self.argument), len(self.arguments)
        place = start + len(program)
        self.arguments += program
        for n, argument in enumerate(arguments):
            if isinstance(argument, tuple):
                signal, number = argument, 0.0
            elif not isinstance(argument, str):
                signal, number = (NUMBER, 0, 0), float(argument)
            else:
                signal, number = (TIME, 0, 0) if argument == TIME_SYMBOL else find(argument), 0.0
            self.argument.append((*signal, place + n))
            self.arguments.append(number)
        self.arguments += [0.0, 0.0]
        self.span.append((first, len(self.argument), place, start))
        self.kind.append(kind)
        self.value.append(value)
        self.address.append(address)
        self.table.append((len(self.knots), len(self.knots) + len(table[0])))
        self.knots += table[0]
        self.coefficients += table[1]
        return len(self.kind) - 1

    def arrays(self) -> Functions:
        return Functions(
            kind=index_array(self.kind, 1),
            value=np.array(self.value, dtype=float),
            table=index_array(self.table, 2),
            knots=np.array(self.knots, dtype=float),
            coefficients=np.array(self.coefficients, dtype=float).reshape(-1, 4),
            argument=index_array(self.argument, 4),
            span=index_array(self.span, 4),
            arguments=np.array(self.arguments, dtype=float),
            address=np.array(self.address, dtype=np.uint64),
        )


def _nothing(path: str) -> Signal:
    raise KeyError(path)
