"""Expressions as programs, which one function runs: no expression needs a compiler.

A program stands in a row of numbers, with all that it works on. Its instructions are groups of four numbers: an operation, the place of the
result, the places of the operands (one of no meaning where there is one operand). Constants, intermediate results, arguments and what is
left behind them have places in the same row. An instruction takes one to three nanoseconds, and what sin, exp, … take.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.analytic import absolute, arctan2, maximum, minimum, power, real
from nivel.kernels.hook import law
from nivel.kernels.smooth_step import step, step_acceleration, step_rate
from nivel.native.function import leaf

LENGTH = 4  # of an instruction
# the end, which gives the value at its place; operations of two operands, and of one
END, ADD, SUBTRACT, MULTIPLY, DIVIDE, POWER, ATAN2, MIN, MAX = range(9)
COPY, NEGATIVE, SQUARE, SIN, COS, TAN, ASIN, ACOS, ATAN, SQRT, EXP, LOG, ABS = range(9, 22)
# of an operand and four levels, which stand one behind the other from the place of the second operand on
STEP, STEP_RATE, STEP_ACCELERATION = range(22, 25)


@leaf
def operate(operation, x, y):
    """Value of an operation."""
    if operation == ADD:
        return x + y
    if operation == SUBTRACT:
        return x - y
    if operation == MULTIPLY:
        return x * y
    if operation == DIVIDE:
        return x / y
    if operation == POWER:
        return power(x, y)
    if operation == ATAN2:
        return arctan2(x, y)
    if operation == MIN:
        return minimum(x, y)
    if operation == MAX:
        return maximum(x, y)
    if operation == COPY:
        return x
    if operation == NEGATIVE:
        return -x
    if operation == SQUARE:
        return x * x
    if operation == SIN:
        return np.sin(x)
    if operation == COS:
        return np.cos(x)
    if operation == TAN:
        return np.tan(x)
    if operation == ASIN:
        return np.arcsin(x)
    if operation == ACOS:
        return np.arccos(x)
    if operation == ATAN:
        return np.arctan(x)
    if operation == SQRT:
        return np.sqrt(x)
    if operation == EXP:
        return np.exp(x)
    if operation == LOG:
        return np.log(x)
    return absolute(x)


@leaf
def smooth(operation, x, levels):
    """Value of a smooth step, or of its first or second derivative."""
    x0, y0, x1, y1 = levels[0], levels[1], levels[2], levels[3]
    if operation == STEP:
        return step(x, x0, y0, x1, y1)
    if operation == STEP_RATE:
        return step_rate(x, x0, y0, x1, y1)
    return step_acceleration(x, x0, y0, x1, y1)


@leaf
def place(x):
    """A place of a row, or an operation, that a number of it says."""
    return np.uint64(np.int64(real(x)))


@law
def run(row):
    """Value of the program that the row begins with."""
    at = np.uint64(0)
    while True:
        operation, to = place(row[at]), place(row[at + 1])
        if operation == END:
            return row[to]
        x, second = row[place(row[at + 2])], place(row[at + 3])
        row[to] = (
            operate(operation, x, row[second]) if operation < STEP else smooth(operation, x, row[second : second + 4])
        )
        at += np.uint64(LENGTH)
