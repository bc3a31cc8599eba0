"""Expressions as programs of `nivel.kernels.record.program`."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nivel.kernels.record import program as kernel
from nivel.machine.units.arithmetic import TIME, Call, Lookup, Negative, Node, Number, Operation, Signal, Time
from nivel.machine.units.elementary import COMPOUND, elementary
from nivel.machine.units.expression import Expression
from nivel.machine.units.formula import Formula
from nivel.machine.units.interpolation import differentiated, pieces

OPERATIONS = {
    "+": kernel.ADD,
    "-": kernel.SUBTRACT,
    "*": kernel.MULTIPLY,
    "/": kernel.DIVIDE,
    "**": kernel.POWER,
    **{name: getattr(kernel, name.upper()) for name in ("atan2", "min", "max")},
    **{name: getattr(kernel, name.upper()) for name in ("sin", "cos", "tan", "asin", "acos", "atan")},
    **{name: getattr(kernel, name.upper()) for name in ("sqrt", "exp", "log", "abs", "floor", "tanh")},
    "<": kernel.LESS,
    "<=": kernel.LESS_EQUAL,
}
TWO, ZERO = Number(2.0), Number(0.0)


def expression_program(expression: Expression | Formula, signals: Sequence[str]) -> list[float]:
    """The program of an expression of `signals`, of which the first is the time. The arguments are expected behind it."""
    program = _Program(signals)
    program.end(program.place_of(expression.tree))
    return program.row()


def curve_program(kind: str, points: Sequence[float], values: Sequence[float]) -> list[float]:
    """The program of a curve over its one argument."""
    program, argument = _Program([TIME]), Time()
    program.end(program.place_of(Lookup(argument, kind, tuple(points), tuple(values))))
    return program.row()


def curve_motion_program(kind: str, points: Sequence[float], values: Sequence[float]) -> list[float]:
    """The program of a curve over time, with its two derivatives as in `motion_program`."""
    program, argument = _Program([TIME]), Time()
    curves = [Lookup(argument, kind, tuple(points), tuple(values), order) for order in range(3)]
    value, first, second = (program.place_of(curve) for curve in curves)
    program.leave(1, first)
    program.leave(2, second)
    program.end(value)
    return program.row()


def motion_program(expression: Expression) -> list[float]:
    """The program of an expression of time alone. Behind it are expected the time, and places for the two derivatives."""
    program, rate = _Program([TIME]), expression.derivative
    value, first, second = (program.place_of(each.tree) for each in (expression, rate, rate.derivative))
    program.leave(1, first)
    program.leave(2, second)
    program.end(value)
    return program.row()


class _Program:
    """Instructions, and numbers that stand behind them. Places are known when all is there: until then they count from the arguments
    back, from the last number with -1."""

    def __init__(self, signals: Sequence[str]) -> None:
        self._instructions: list[tuple[int, int, int, int]] = []
        self._numbers: list[float] = []
        self._places: dict[Node, int] = {
            Time() if path == TIME else Signal(path): place for place, path in enumerate(signals)
        }

    def place_of(self, node: Node) -> int:
        """Place of the value of `node`, which is found once however often it stands there."""
        if node not in self._places:
            self._places[node] = self._find(node)
        return self._places[node]

    def _find(self, node: Node) -> int:
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
            case Lookup(argument):
                return self._operation(kernel.CURVE, self.place_of(argument), self._curve(node))
            case Call(function, _) if function in COMPOUND:
                return self.place_of(elementary(node))
            case Call("if", (condition, yes, no)):
                return self._choice(self.place_of(condition), self.place_of(yes), self.place_of(no))
            case Call(function, (first, *others)):
                place = self.place_of(first)
                if not others:
                    return self._operation(OPERATIONS[function], place)
                for other in others:  # `min` and `max` of many are those of two, again and again
                    place = self._operation(OPERATIONS[function], place, self.place_of(other))
                return place
        raise ValueError(f"{node} is not bound")

    def _choice(self, condition: int, yes: int, no: int) -> int:
        place = self._operation(kernel.COPY, condition)
        self._instructions.append((kernel.CHOOSE, place, yes, no))
        return place

    def _curve(self, curve: Lookup) -> int:
        """The place where the numbers of a curve begin."""
        points, values = curve.points, curve.values
        coefficients = differentiated(pieces(curve.kind, points, values), curve.order)
        before, behind = (values[0], values[-1]) if curve.order == 0 else (0.0, 0.0)
        numbers = np.concatenate([[len(points), before, behind], points, coefficients.ravel()])
        self._numbers += numbers[::-1].tolist()  # numbers stand in the row backwards
        return -len(self._numbers)

    def _operation(self, operation: int, first: int, second: int | None = None) -> int:
        place = self._cell(0.0)
        self._instructions.append((operation, place, first, first if second is None else second))
        return place

    def _cell(self, value: float) -> int:
        self._numbers.append(value)
        return -len(self._numbers)

    def leave(self, place: int, value: int) -> None:
        """Copy what stands at `value`."""
        self._instructions.append((kernel.COPY, place, value, value))

    def end(self, place: int) -> None:
        """The value of the program is what stands at this place."""
        self._instructions.append((kernel.END, place, place, place))

    def row(self) -> list[float]:
        """All numbers of the program."""
        behind = kernel.LENGTH * len(self._instructions) + len(self._numbers)
        code = [[operation, *(behind + place for place in places)] for operation, *places in self._instructions]
        return [*(float(part) for line in code for part in line), *reversed(self._numbers)]
