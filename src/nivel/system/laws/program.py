"""Expressions as programs of `nivel.kernels.record.program`.

What jumps at an instant, by a comparison of time, has two values there: `time > a` and `time >= a` differ at that instant alone, on which
no motion depends. Methods whose steps end there ask for the value before it a little earlier, and for the value beyond it at the instant
(`nivel.integrate.loop.corners`). So a program of what acts in motion takes the time for later by its round-off. Then it has the value
beyond, whichever comparison is written, and wherever the round-off of a step leaves the instant. Tables pass their points in the same way.
At the time 0 nothing is later: a machine is in equilibrium, and starts, with what is written.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from nivel.kernels.record import program as kernel
from nivel.kernels.record.function import NEAR
from nivel.lazy import Struct
from nivel.machine.laws.varying_value import Expression
from nivel.machine.units.formula import Formula
from nivel.machine.units.functions import FUNCTIONS, PERIODIC, differentiated, is_truth, pieces
from nivel.machine.units.sides import is_of_time_alone, jumps
from nivel.machine.units.tree import TIME, Call, Lookup, Negative, Node, Number, Operation, Signal, Time, signals

OPERATIONS = {
    "+": kernel.ADD,
    "-": kernel.SUBTRACT,
    "*": kernel.MULTIPLY,
    "/": kernel.DIVIDE,
    "**": kernel.POWER,
    "<": kernel.LESS,
    "<=": kernel.LESS_EQUAL,
}
TWO, ZERO = Number(2.0), Number(0.0)


def expression_program(
    expression: Expression | Formula, signals: Sequence[str], *, beyond: bool = False
) -> list[float]:
    """The program of an expression of `signals`, of which the first is the time. The arguments are expected behind it.

    beyond : where it jumps at an instant it has the value beyond it
    """
    program = _Program(signals, beyond=beyond and jumps(expression.tree, is_of_time_alone))
    program.end(program.place_of(expression.tree))
    return program.row()


class PlacedProgram(Struct):
    """The row of a program with places for its arguments, and what these are: the time first, then signals by their paths."""

    row: NDArray[np.float64]
    paths: tuple[str, ...]

    @classmethod
    def of(cls, tree: Node) -> PlacedProgram:
        """Of a tree of the time and of signals."""
        program, paths = _Program((TIME, *signals(tree))), (TIME, *signals(tree))
        program.end(program.place_of(tree))
        return cls(np.array([*program.row(), *(0.0 for _ in paths)]), paths)

    def values(self, known: Mapping[str, NDArray[np.float64]]) -> NDArray[np.float64]:
        """Values (n,); known : values (n,) of the time and of each signal. Not a number where there is none."""
        places = np.column_stack([known[path] for path in self.paths])
        out = np.empty(len(places))
        kernel.find_values(self.row, places.ravel(), len(self.paths), out)
        return out


def _in_period(argument: Node, points: Sequence[float]) -> Node:
    """The argument of a periodic curve less whole periods, so that it is between its points."""
    begin, period = Number(points[0]), Number(points[-1] - points[0])
    whole = Call("floor", (Operation("/", Operation("-", argument, begin), period),))
    return Operation("-", argument, Operation("*", period, whole))


class Switching(Struct):
    """A program with switches. Behind it are expected its arguments, then the side that each switch keeps.

    switches : places of the side of each, and of its difference.
    """

    row: list[float]
    switches: list[tuple[int, int]]


def switching_program(expression: Expression | Formula, paths: Sequence[str]) -> Switching:
    """The program of an expression of signals, of which the first is the time, whose corners and jumps with other signals are switches.
    Where it jumps at an instant it has the value beyond it."""
    program = _Program(paths, switching=True, beyond=jumps(expression.tree, is_of_time_alone))
    program.end(program.place_of(expression.tree))
    return Switching(program.row(), program.switches())


def curve_program(kind: str, points: Sequence[float], values: Sequence[float]) -> list[float]:
    """The program of a curve over its one argument."""
    program, argument = _Program([TIME]), Time()
    program.end(program.place_of(Lookup(argument, kind, tuple(points), tuple(values))))
    return program.row()


def curve_motion_program(kind: str, points: Sequence[float], values: Sequence[float]) -> list[float]:
    """The program of a curve over time, with its two derivatives as in `motion_program`."""
    program, argument = _Program([TIME]), Time()
    curves = [Lookup(argument, kind, tuple(points), tuple(values), order) for order in range(3)]
    return program.motion(*map(program.place_of, curves))


def way_program(points: Sequence[float], pieces: NDArray[np.float64]) -> list[float]:
    """The program of polynomials (n - 1, 6) of time between points, with two derivatives as in `motion_program`."""
    program = _Program([TIME])
    time = program.place_of(Time())
    return program.motion(*(program.place_of_pieces(time, points, differentiated(pieces, order)) for order in range(3)))


def motion_program(expression: Expression) -> list[float]:
    """The program of an expression of time alone. Behind it are expected the time, and places for the two derivatives."""
    program, rate = _Program([TIME]), expression.derivative
    return program.motion(*(program.place_of(each.tree) for each in (expression, rate, rate.derivative)))


class _Program:
    """Instructions, and numbers that stand behind them. Places are known when all is there: until then they count from the arguments
    back, from the last number with -1."""

    def __init__(self, paths: Sequence[str], *, switching: bool = False, beyond: bool = False) -> None:
        self._instructions: list[tuple[int, int, int, int]] = []
        self._numbers: list[float] = []
        self._arguments, self._switching = len(paths), switching
        self._sides: dict[Node, tuple[int, int]] = {}
        self._places: dict[Node, int] = {
            Time() if path == TIME else Signal(path): place for place, path in enumerate(paths)
        }
        if beyond:
            self._places[Time()] = self._operation(kernel.MULTIPLY, self._cell(1.0 + NEAR), self._places[Time()])

    def place_of(self, node: Node) -> int:
        """Place of the value of `node`, which is found once however often it stands there."""
        if node not in self._places:
            self._places[node] = self._find(node)
        return self._places[node]

    def _find(self, node: Node) -> int:
        if self._switching and (place := self._find_switching(node)) is not None:
            return place
        match node:
            case Number(value, _):
                return self._cell(value)
            case Negative(operand):
                return self._operation(kernel.NEGATIVE, self.place_of(operand))
            case Operation("**", left, right) if right == TWO:
                return self._operation(kernel.SQUARE, self.place_of(left))
            case Operation(">" | ">=" as symbol, left, right):
                return self.place_of(Operation("<" if symbol == ">" else "<=", right, left))
            case Operation("and" | "or" as symbol, left, right):
                function = "min" if symbol == "and" else "max"
                return self.place_of(Operation("<", ZERO, Call(function, (left, right))))
            case Operation(symbol, left, right):
                return self._operation(OPERATIONS[symbol], self.place_of(left), self.place_of(right))
            case Lookup(argument, kind, points):
                within = _in_period(argument, points) if kind == PERIODIC else argument
                return self._operation(kernel.CURVE, self.place_of(within), self._curve(node))
            case Call("if", (condition, yes, no)):
                return self._choice(self.place_of(condition), self.place_of(yes), self.place_of(no))
            case Call(function, (first, *others)):
                kind = FUNCTIONS[function]
                if kind.form:
                    return self.place_of(kind.written(kind.form, node.arguments))
                operation, place = getattr(kernel, kind.operation), self.place_of(first)
                if not others:
                    return self._operation(operation, place)
                for other in others:  # `min` and `max` of many are those of two, again and again
                    place = self._operation(operation, place, self.place_of(other))
                return place
        raise ValueError(f"{node} is not bound")

    def _find_switching(self, node: Node) -> int | None:
        """Place of the value of a node that has corners or jumps where a difference of signals changes its sign; None of others."""
        match node:
            case Operation("<" | ">" as symbol, left, right) if signals(node):
                low, high = (left, right) if symbol == "<" else (right, left)
                return self._operation(kernel.LESS, self.place_of(ZERO), self._side(high, low))
            case Operation("<=" | ">=" as symbol, left, right) if signals(node):
                low, high = (left, right) if symbol == "<=" else (right, left)
                return self._operation(kernel.LESS, self._side(low, high), self.place_of(ZERO))
            case Operation("and" | "or" as symbol, left, right):
                place = self._operation(
                    kernel.MIN if symbol == "and" else kernel.MAX, self._condition(left), self._condition(right)
                )
                return self._operation(kernel.LESS, self.place_of(ZERO), place)
            case Call("not", (x,)):
                return self._operation(kernel.LESS_EQUAL, self._condition(x), self.place_of(ZERO))
            case Call("if", (condition, yes, no)):
                return self._choice(self._condition(condition), self.place_of(yes), self.place_of(no))
            case Call(function, (first, second, _, *_)) if FUNCTIONS[function].more:
                return self.place_of(Call(function, (Call(function, (first, second)), *node.arguments[2:])))
            case Call(function, arguments) if FUNCTIONS[function].choice and signals(node):
                return self.place_of(FUNCTIONS[function].written(FUNCTIONS[function].choice, arguments))
        return None

    def _condition(self, node: Node) -> int:
        """Place of a number that is greater than zero where a condition holds, and that changes its sign with switches alone."""
        if is_truth(node) or not signals(node):
            return self.place_of(node)
        match node:
            case Operation("-", first, second):
                return self._side(first, second)
        return self._side(node, ZERO)

    def _side(self, first: Node, second: Node) -> int:
        """Place of the side of first - second, whose sign does not depend on how it is written."""
        difference = first if second == ZERO else Negative(second) if first == ZERO else Operation("-", first, second)
        if difference not in self._sides:
            place = self.place_of(difference)
            held = self._arguments + len(self._sides)  # `difference` may have switches of its own
            self._sides[difference] = self._operation(kernel.SIDE, place, held), place
        return self._sides[difference][0]

    def _choice(self, condition: int, yes: int, no: int) -> int:
        place = self._operation(kernel.COPY, condition)
        self._instructions.append((kernel.CHOOSE, place, yes, no))
        return place

    def _curve(self, curve: Lookup) -> int:
        """The place where the numbers of a curve begin."""
        points, values = curve.points, curve.values
        coefficients = differentiated(pieces(curve.kind, points, values), curve.order)
        before, behind = (values[0], values[-1]) if curve.order == 0 else (0.0, 0.0)
        if curve.kind == PERIODIC:
            before = behind = coefficients[0, 0]
        numbers = np.concatenate([[len(points), before, behind], points, coefficients.ravel()])
        self._numbers += numbers[::-1].tolist()  # numbers stand in the row backwards
        return -len(self._numbers)

    def place_of_pieces(self, argument: int, points: Sequence[float], pieces: NDArray[np.float64]) -> int:
        """Place of the value of polynomials between points."""
        numbers = np.concatenate([[len(points), pieces[0, 0], 0.0], points, pieces.ravel()])
        self._numbers += numbers[::-1].tolist()
        return self._operation(kernel.CURVE, argument, -len(self._numbers))

    def _operation(self, operation: int, first: int, second: int | None = None) -> int:
        place = self._cell(0.0)
        self._instructions.append((operation, place, first, first if second is None else second))
        return place

    def _cell(self, value: float) -> int:
        self._numbers.append(value)
        return -len(self._numbers)

    def motion(self, value: int, first: int, second: int) -> list[float]:
        """The row of a program that ends with the value at a place, and leaves its derivatives behind the argument."""
        self._instructions += [(kernel.COPY, 1, first, first), (kernel.COPY, 2, second, second)]
        self.end(value)
        return self.row()

    def end(self, place: int) -> None:
        """The value of the program is what stands at this place."""
        self._instructions.append((kernel.END, place, place, place))

    def switches(self) -> list[tuple[int, int]]:
        """Places in the row of the side of each switch, and of its difference."""
        behind = self._behind()
        return [(behind + side, behind + difference) for side, difference in self._sides.values()]

    def _behind(self) -> int:
        """Where the arguments stand."""
        return kernel.LENGTH * len(self._instructions) + len(self._numbers)

    def row(self) -> list[float]:
        """All numbers of the program."""
        behind = self._behind()
        code = [[operation, *(behind + place for place in places)] for operation, *places in self._instructions]
        return [*(float(part) for line in code for part in line), *reversed(self._numbers)]
