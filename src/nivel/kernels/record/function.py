"""Functions of time and of other signals: a constant, a table, or code reached through its address: a Python law, or
the program of an expression."""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.record.record import record_at
from nivel.native.function import caller, leaf, stage
from nivel.native.signature import LAW

# A table is past a knot where its argument comes within this share of it: times of steps are products and sums.
NEAR = 16.0 * 2.220446049250313e-16
# kinds of functions; a held table keeps its end values outside, an extended one its end pieces
CONSTANT, TABLE_HELD, TABLE_EXTENDED, CODE, LINEAR = 0, 1, 2, 3, 4
# kinds of signals: index and component say of what; HELD is the side that a switch keeps
NUMBER, TIME, COORDINATE, RATE, POSITION, VELOCITY, ANGULAR_VELOCITY, STATE, OUTPUT, HELD = 0, 1, 2, 3, 4, 5, 6, 7, 8, 9


# call_law(address, arguments): the value of a law or an expression; about 3 ns
call_law = caller(LAW)


@leaf
def knot_before(functions, k, x):
    """The knot of table k whose polynomial holds at x: the last one at or before it, the first where there is none. The last knot of all
    belongs to the polynomial before it, which is what a run that ends there ends with."""
    low, last = np.int64(functions.table[k, 0]), np.int64(functions.table[k, 1]) - 1
    knots, x = functions.knots, real(x)
    near = NEAR * np.abs(x)
    if x > knots[last] + near:
        return last
    high = last
    while high - low > 1:
        middle = (low + high) // 2
        if knots[middle] <= x + near:
            low = middle
        else:
            high = middle
    return low


@leaf
def table_value(functions, k, x):
    """(f, f', f'') of table k at x."""
    knot = knot_before(functions, k, x)
    c = functions.coefficients[knot]
    s = x - functions.knots[knot]
    if real(s) < -NEAR * np.abs(real(x)) and functions.kind[k] == TABLE_HELD:
        return c[0], 0.0, 0.0
    value = c[0] + s * (c[1] + s * (c[2] + s * c[3]))
    return value, c[1] + s * (2.0 * c[2] + 3.0 * s * c[3]), 2.0 * c[2] + 6.0 * s * c[3]


@stage
def read_arguments(machine, k, t):
    """Put the signals that function k depends on into its places of `arguments`."""
    record = record_at(machine)
    functions = record.functions
    for a in range(functions.span[k, 0], functions.span[k, 1]):
        kind, index, component = functions.argument[a, 0], functions.argument[a, 1], functions.argument[a, 2]
        place = functions.argument[a, 3]
        if kind == TIME:
            functions.arguments[place] = t
        elif kind == COORDINATE:
            functions.arguments[place] = record.coordinates.value[index]
        elif kind == RATE:
            functions.arguments[place] = record.coordinates.rate[index]
        elif kind == POSITION:
            functions.arguments[place] = record.markers.r[index, component]
        elif kind == VELOCITY:
            functions.arguments[place] = record.markers.rdot[index, component]
        elif kind == ANGULAR_VELOCITY:
            functions.arguments[place] = record.bodies.omega[record.markers.body[index], component]
        elif kind == STATE:
            functions.arguments[place] = record.elements.state[index]
        elif kind == OUTPUT:
            functions.arguments[place] = record.outputs.value[index]
        elif kind == HELD:
            functions.arguments[place] = record.watched.held[index]


@leaf
def linear_value(functions, k):
    """value + Σ factor argument of function k, whose factors stand where tables have their knots."""
    first, factor = np.int64(functions.span[k, 2]), np.int64(functions.table[k, 0])
    value = functions.value[k] + 0.0 * functions.arguments[first]
    for j in range(np.int64(functions.table[k, 1]) - factor):
        value += functions.knots[factor + j] * functions.arguments[first + j]
    return value


@stage
def evaluate_function(machine, k, t):
    """Value of function k at time t [s] in the state whose signals are in the record."""
    record = record_at(machine)
    functions = record.functions
    kind = functions.kind[k]
    if kind == CONSTANT:
        return functions.value[k]
    read_arguments(machine, k, t)
    first = np.int64(functions.span[k, 2])
    if kind == CODE:
        return call_law(functions.address[k], functions.arguments[np.int64(functions.span[k, 3]) :])
    if kind == LINEAR:
        return linear_value(functions, k)
    value, _, _ = table_value(functions, k, functions.arguments[first])
    return value


@stage
def evaluate_motion(machine, k, t):
    """(f, f', f'') of function k, a motion: one of time alone. Code leaves f', f'' behind their arguments."""
    record = record_at(machine)
    functions = record.functions
    kind = functions.kind[k]
    if kind == CONSTANT:
        return functions.value[k], 0.0, 0.0
    read_arguments(machine, k, t)
    first = np.int64(functions.span[k, 2])
    if kind == CODE:
        value = call_law(functions.address[k], functions.arguments[np.int64(functions.span[k, 3]) :])
        behind = first + np.int64(functions.span[k, 1]) - np.int64(functions.span[k, 0])
        return value, functions.arguments[behind], functions.arguments[behind + 1]
    return table_value(functions, k, functions.arguments[first])
