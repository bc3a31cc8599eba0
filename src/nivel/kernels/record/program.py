"""Expressions as programs, which one function runs: no expression needs a compiler.

A program stands in a row of numbers, with all that it works on. Its instructions are groups of four numbers: an operation, the place of the
result, the places of the operands (one of no meaning where there is one operand). Constants, intermediate results, arguments and what is
left behind them have places in the same row. A curve has the place of its numbers as its second operand. An instruction takes one to three
nanoseconds, and what sin, exp, … take.

A switch is a difference whose sign decides about a value: of what is compared, of a limit. Its side is 1 where the difference is greater
than zero, else -1. Where a side is held, it stays what it is while the difference passes zero, so that the value is smooth over a step;
beyond its own side an expression may have no value (a root of what is then negative), and then differences decide at once.
"""

import numpy as np

from nivel.kernels.algebra.analytic import absolute, arctan2, maximum, minimum, real, tanh
from nivel.kernels.core.number import where
from nivel.kernels.record.hook import law
from nivel.native.entry import entry
from nivel.native.function import leaf
from nivel.native.signature import Signature

LENGTH = 4  # of an instruction
# the end, which gives the value at its place; operations of two operands, and of one
END, ADD, SUBTRACT, MULTIPLY, DIVIDE, POWER, ATAN2, MIN, MAX = range(9)
COPY, NEGATIVE, SQUARE, SIN, COS, TAN, ASIN, ACOS, ATAN, SQRT, EXP, LOG, ABS = range(9, 22)
# 1 where the comparison holds, else 0; the first operand where what stands at the place of the result is greater than zero, else the
# second; the whole number below; a curve; the side of a difference, or that of its second operand where it is held
LESS, LESS_EQUAL, CHOOSE, FLOOR, TANH, CURVE, SIDE = range(22, 29)
# numbers of a curve: points, values before the first and behind the last point; points and six coefficients a piece follow
POINTS, BEFORE, BEHIND, FIRST, COEFFICIENTS = 0, 1, 2, 3, 6


@leaf
def operate(operation, x, y, condition):
    """Value of an operation. `condition` is asked by CHOOSE alone."""
    if operation == ADD:
        return x + y
    if operation == SUBTRACT:
        return x - y
    if operation == MULTIPLY:
        return x * y
    if operation == DIVIDE:
        return x / y
    if operation == POWER:
        return x**y
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
    if operation == LESS:
        return truth(x, y, real(x) < real(y))
    if operation == LESS_EQUAL:
        return truth(x, y, real(x) <= real(y))
    if operation == CHOOSE:
        return where(real(condition) > 0.0, x, where(real(condition) <= 0.0, y, condition))
    if operation == FLOOR:
        return 0.0 * x + np.floor(real(x))
    if operation == TANH:
        return tanh(x)
    return absolute(x)


@leaf
def truth(x, y, holds):
    """1 or 0; no number where one of x and y is none."""
    value = 0.0 * x + where(holds, 1.0, 0.0)
    return where(real(x) == real(x), where(real(y) == real(y), value, x + y), x + y)


@leaf
def curve(row, at, x):
    """Value at x of the curve whose numbers begin at a place of the row."""
    count, first, s = np.int64(real(row[at + POINTS])), at + FIRST, real(x)
    if s < real(row[first]):
        return row[at + BEFORE]
    if s >= real(row[first + count - 1]):
        return row[at + BEHIND]
    low, high = np.int64(0), count - 1
    while high - low > 1:
        middle = (low + high) // 2
        if real(row[first + middle]) <= s:
            low = middle
        else:
            high = middle
    c, h = first + count + COEFFICIENTS * low, x - row[first + low]
    return row[c] + h * (row[c + 1] + h * (row[c + 2] + h * (row[c + 3] + h * (row[c + 4] + h * row[c + 5]))))


@leaf
def place(x):
    """A place of a row, or an operation, that a number of it says."""
    return np.uint64(np.int64(real(x)))


@leaf
def side(difference, held):
    """1 or -1; no number where the difference is none."""
    found = truth(difference, 0.0, real(difference) > 0.0)
    return where(real(held) == 0.0, 2.0 * found - 1.0, real(held) + 0.0 * found)


@leaf
def follow(row):
    """Value of the program that the row begins with."""
    at, holds = np.uint64(0), 1.0
    while True:
        operation, to = place(row[at]), place(row[at + 1])
        if operation == END:
            if holds == 0.0 or np.abs(real(row[to])) < np.inf:
                return row[to]
            at, holds = np.uint64(0), 0.0
            continue
        if operation == SIDE:
            row[to] = side(row[place(row[at + 2])], holds * row[place(row[at + 3])])
        elif operation == CURVE:
            row[to] = curve(row, np.int64(real(row[at + 3])), row[place(row[at + 2])])
        else:
            row[to] = operate(operation, row[place(row[at + 2])], row[place(row[at + 3])], row[to])
        at += np.uint64(LENGTH)


@law
def run(row):
    """Value of the program that the row begins with."""
    return follow(row)


@entry(Signature("nothing", ("vector", "vector", "count", "vector")))
def find_values(row, places, count, out):
    """out (n,) := values at n places. row : the program, behind which `count` arguments stand. places : (n, count) these."""
    first = row.shape[0] - count
    for n in range(out.shape[0]):
        for k in range(count):
            row[first + k] = places[count * n + k]
        out[n] = follow(row)
