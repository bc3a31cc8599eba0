"""Bounds of programs of `nivel.kernels.record.program` on straight ways of their arguments.

Each number of a program is an interval that holds its values on the way (Moore 1966), and one that holds its rates: they are wide where a
symbol comes twice, and become exact as ways shrink. With values a and b at the ends and r ≤ f' ≤ R nothing is above where
the lines a + R s and b - r (1 - s) meet. What that leaves goes with the square of the length, and is nothing where f' keeps its sign. Where
a number may jump its rate has no bounds.
"""

import numpy as np

from nivel.kernels.record import program as code
from nivel.native.entry import entry
from nivel.native.function import leaf, part
from nivel.native.signature import Signature

WIDTH = 4  # of a number: the least and the largest value, the least and the largest rate
UNKNOWN = (-np.inf, np.inf)
SEAM = 1e-9  # pieces of a curve that differ by less of their values where they meet do not jump


@leaf
def product(a, b, c, d):
    """Of intervals (a, b) and (c, d); of zero and infinity zero, as what is multiplied is finite inside."""
    p, q = 0.0 if a == 0.0 or c == 0.0 else a * c, 0.0 if a == 0.0 or d == 0.0 else a * d
    r, s = 0.0 if b == 0.0 or c == 0.0 else b * c, 0.0 if b == 0.0 or d == 0.0 else b * d
    return min(p, q, r, s), max(p, q, r, s)


@leaf
def power(a, b, c, d):
    """Of intervals."""
    p, q, r, s = a**c, a**d, b**c, b**d
    low, high = min(p, q, r, s), max(p, q, r, s)
    whole = c == d and c == np.floor(c)
    if whole and c >= 0.0:
        return 0.0 if c > 0.0 and c % 2.0 == 0.0 and a < 0.0 < b else low, high
    if a <= 0.0 and not (whole and b < 0.0) and not (a == 0.0 and c >= 0.0):
        return UNKNOWN
    return low, high


@leaf
def sine(a, b):
    """Of an interval."""
    turn, low, high = 2.0 * np.pi, np.sin(a), np.sin(b)
    if not b - a < turn:
        return -1.0, 1.0
    top = np.ceil((a - 0.25 * turn) / turn) * turn + 0.25 * turn <= b
    bottom = np.ceil((a + 0.25 * turn) / turn) * turn - 0.25 * turn <= b
    return -1.0 if bottom else min(low, high), 1.0 if top else max(low, high)


@leaf
def polar_angle(a, b, c, d):
    """Of points with y in (a, b) and x in (c, d): bounds, and whether the angle goes on over them."""
    p, q, r, s = np.arctan2(a, c), np.arctan2(a, d), np.arctan2(b, c), np.arctan2(b, d)
    if c > 0.0 or a > 0.0 or b < 0.0:
        return min(p, q, r, s), max(p, q, r, s), True
    return -np.pi, np.pi, False


@leaf
def slope(operation, size):
    """Derivative of a function of one operand where this has the magnitude `size`, on which alone it depends."""
    if operation == code.ATAN:
        return 1.0 / (1.0 + size * size)
    if operation == code.TANH:
        return 1.0 - np.tanh(size) ** 2
    return 1.0 / np.sqrt(1.0 - size * size) if size < 1.0 else np.inf


@leaf
def growing(operation, x):
    """Value and derivative of a function that grows with its one operand; at the ends of what it is defined for it goes on."""
    if operation == code.SQRT:
        root = np.sqrt(max(x, 0.0))
        return root, 0.5 / root if root > 0.0 else np.inf
    if operation == code.EXP:
        return np.exp(x), np.exp(x)
    if operation == code.LOG:
        return (np.log(x), 1.0 / x) if x > 0.0 else (-np.inf, np.inf)
    if operation == code.ATAN:
        return np.arctan(x), 0.0
    if operation == code.TANH:
        return np.tanh(x), 0.0
    return np.arcsin(min(max(x, -1.0), 1.0)), 0.0


@part
def of_one(operation, a, b, da, db):
    """Of an operation of one operand."""
    if operation == code.COPY:
        return a, b, da, db
    if operation == code.NEGATIVE:
        return -b, -a, -db, -da
    if operation == code.SQUARE:
        low, high = power(a, b, 2.0, 2.0)
        return (low, high, *product(2.0 * a, 2.0 * b, da, db))
    if operation == code.ABS:
        if a >= 0.0:
            return a, b, da, db
        if b <= 0.0:
            return -b, -a, -db, -da
        return 0.0, max(-a, b), min(da, -db), max(db, -da)
    if operation == code.FLOOR:
        low, high = np.floor(a), np.floor(b)
        return low, high, 0.0 if low == high else -np.inf, 0.0 if low == high else np.inf
    if operation == code.SIN:
        low, high = sine(a + 0.5 * np.pi, b + 0.5 * np.pi)
        return sine(a, b) + product(low, high, da, db)
    if operation == code.COS:
        low, high = sine(a, b)
        return sine(a + 0.5 * np.pi, b + 0.5 * np.pi) + product(-high, -low, da, db)
    if operation == code.TAN:
        if np.floor(a / np.pi + 0.5) != np.floor(b / np.pi + 0.5):
            return UNKNOWN + UNKNOWN
        low, high = np.tan(a), np.tan(b)
        least, largest = power(low, high, 2.0, 2.0)
        return (low, high, *product(1.0 + least, 1.0 + largest, da, db))
    if operation == code.ACOS:
        low, high, least, largest = _of_growing(code.ASIN, a, b, da, db)
        return 0.5 * np.pi - high, 0.5 * np.pi - low, -largest, -least
    return _of_growing(operation, a, b, da, db)


@leaf
def _of_growing(operation, a, b, da, db):
    (low, first), (high, last) = growing(operation, a), growing(operation, b)
    if operation in (code.ATAN, code.TANH, code.ASIN):
        near = 0.0 if a <= 0.0 <= b else min(abs(a), abs(b))
        first, last = slope(operation, near), slope(operation, max(abs(a), abs(b)))
    return (low, high, *product(min(first, last), max(first, last), da, db))


@part
def of_two(operation, x, y):
    """Of an operation of two operands; x, y : numbers."""
    (a, b, da, db), (c, d, dc, dd) = x, y
    if operation == code.ADD:
        return a + c, b + d, da + dc, db + dd
    if operation == code.SUBTRACT:
        return a - d, b - c, da - dd, db - dc
    if operation == code.MULTIPLY:
        p, q = product(da, db, c, d)
        r, s = product(a, b, dc, dd)
        return (*product(a, b, c, d), p + r, q + s)
    if operation == code.DIVIDE:
        if c <= 0.0 <= d:
            return UNKNOWN + UNKNOWN
        low, high = product(a, b, 1.0 / d, 1.0 / c)
        p, q = product(low, high, dc, dd)
        return (low, high, *product(da - q, db - p, 1.0 / d, 1.0 / c))
    if operation == code.POWER:
        if dc != 0.0 or dd != 0.0 or c != d:
            return power(a, b, c, d) + UNKNOWN
        p, q = power(a, b, c - 1.0, c - 1.0)
        p, q = product(p, q, c, c)
        return power(a, b, c, c) + product(p, q, da, db)
    if operation == code.ATAN2:
        low, high, goes_on = polar_angle(a, b, c, d)
        (p, q), (r, s) = product(c, d, da, db), product(a, b, dc, dd)
        (e, f), (g, h) = power(a, b, 2.0, 2.0), power(c, d, 2.0, 2.0)
        if not goes_on or e + g == 0.0:
            return (low, high, *UNKNOWN)
        return (low, high, *product(p - s, q - r, 1.0 / (f + h), 1.0 / (e + g)))
    if operation == code.MIN:
        if b <= c or d <= a:
            return x if b <= c else y
        return min(a, c), min(b, d), min(da, dc), max(db, dd)
    if operation == code.MAX:
        if b <= c or d <= a:
            return y if b <= c else x
        return max(a, c), max(b, d), min(da, dc), max(db, dd)
    surely = b < c if operation == code.LESS else b <= c
    never = a >= d if operation == code.LESS else a > d
    if surely or never:
        return (1.0, 1.0, 0.0, 0.0) if surely else (0.0, 0.0, 0.0, 0.0)
    return (0.0, 1.0, *UNKNOWN)


@leaf
def chosen(condition, x, y):
    """Of a choice between two numbers."""
    if condition[0] > 0.0:
        return x
    if condition[1] <= 0.0:
        return y
    return (min(x[0], y[0]), max(x[1], y[1]), *UNKNOWN)


@leaf
def polynomial(row, c, e, f):
    """Bounds of a piece of a curve, and of its slope, between e and f behind its begin. c : where its coefficients stand."""
    low, high, least, largest = 0.0, 0.0, 0.0, 0.0
    for i in range(code.COEFFICIENTS - 1, -1, -1):
        p, q = product(least, largest, e, f)
        least, largest = p + low, q + high
        p, q = product(low, high, e, f)
        low, high = p + row[c + i], q + row[c + i]
    return low, high, least, largest


@part
def of_curve(row, at, x):
    """Of a curve whose numbers begin at a place of the row."""
    count, first, (a, b, da, db) = np.int64(row[at + code.POINTS]), at + code.FIRST, x
    low, high, least, largest, jumps = np.inf, -np.inf, np.inf, -np.inf, False
    end, size = row[at + code.BEFORE], abs(row[at + code.BEFORE])  # what holds up to the next point
    for k in range(count):
        point, is_last = row[first + k], k == count - 1
        c = first + count + code.COEFFICIENTS * k
        value = row[at + code.BEHIND] if is_last else row[c]
        jumps = jumps or (a < point <= b and abs(value - end) > SEAM * (abs(value) + size))
        if k == 0 and a < point:
            low, high, least, largest = end, end, 0.0, 0.0
        if is_last:
            if b >= point:
                low, high, least, largest = min(low, value), max(high, value), min(least, 0.0), max(largest, 0.0)
            continue
        length = row[first + k + 1] - point
        end, _, _, _ = polynomial(row, c, length, length)
        size = abs(row[c]) + abs(end)
        for i in range(1, code.COEFFICIENTS):
            size += abs(row[c + i]) * length**i
        if a <= point + length and b >= point:
            p, q, r, s = polynomial(row, c, max(a - point, 0.0), min(b - point, length))
            low, high, least, largest = min(low, p), max(high, q), min(least, r), max(largest, s)
    if jumps:
        return (low, high, *UNKNOWN)
    return (low, high, *product(least, largest, da, db))


@leaf
def number_at(work, place):
    """The number at a place."""
    at = WIDTH * place
    return work[at], work[at + 1], work[at + 2], work[at + 3]


@leaf
def set_number(work, place, x):
    """The number at a place := x; what is no number has no bounds."""
    at = WIDTH * place
    for k in range(WIDTH):
        work[at + k] = (-np.inf if k % 2 == 0 else np.inf) if x[k] != x[k] else x[k]


@part
def follow(row, work):
    """Bounds of all numbers of the program; returns the place of its value."""
    at = np.int64(0)
    while True:
        operation, to = np.int64(row[at]), np.int64(row[at + 1])
        if operation == code.END:
            return to
        x, second = number_at(work, np.int64(row[at + 2])), np.int64(row[at + 3])
        if operation == code.CURVE:
            set_number(work, to, of_curve(row, second, x))
        elif operation == code.CHOOSE:
            set_number(work, to, chosen(number_at(work, to), x, number_at(work, second)))
        elif operation <= code.MAX or operation in (code.LESS, code.LESS_EQUAL):
            set_number(work, to, of_two(operation, x, number_at(work, second)))
        else:
            set_number(work, to, of_one(operation, x[0], x[1], x[2], x[3]))
        at += code.LENGTH


@entry(Signature("nothing", ("vector", "vector", "vector", "count", "vector")))
def find_bounds(row, ways, work, count, out):
    """out (n, 2) := bounds on n ways. row : the program, behind which `count` arguments stand. ways : (n, count, 2) arguments at both ends
    of each. work : WIDTH numbers for each one of the row."""
    first = row.shape[0] - count
    for k in range(row.shape[0]):
        set_number(work, k, (row[k], row[k], 0.0, 0.0))
    for n in range(out.shape[0] // 2):
        here = 2 * count * n
        for k in range(count):
            set_number(work, first + k, (ways[here + 2 * k], ways[here + 2 * k], 0.0, 0.0))
        a, b, _, _ = number_at(work, follow(row, work))
        for k in range(count):
            set_number(work, first + k, (ways[here + 2 * k + 1], ways[here + 2 * k + 1], 0.0, 0.0))
        c, d, _, _ = number_at(work, follow(row, work))
        for k in range(count):
            e, f = ways[here + 2 * k], ways[here + 2 * k + 1]
            set_number(work, first + k, (min(e, f), max(e, f), f - e, f - e))
        low, high, falling, rising = number_at(work, follow(row, work))
        falling, rising = min(falling, 0.0), max(rising, 0.0)
        if rising - falling < np.inf:
            steep = rising - falling
            high = min(high, b + rising * (d - b - falling) / steep if steep > 0.0 else max(b, d))
            low = max(low, a + falling * (rising - c + a) / steep if steep > 0.0 else min(a, c))
        out[2 * n], out[2 * n + 1] = low, high
