"""Entries that take arrays apart in all the ways in which kernels do."""

from typing import NamedTuple

from nivel.kernels.core.arrays import F3
from nivel.kernels.core.handle import reader
from nivel.native.entry import entry
from nivel.native.function import leaf
from nivel.native.signature import Signature

ROWS = Signature("number", ("vector", "count", "count"))


@leaf
def weighted(row, first):
    s = 0.0
    for k in range(row.shape[0]):
        s += (first + k) * row[k]
    return s


@leaf
def ends(row):
    return row[0], row[-1]


class Boxes(NamedTuple):
    """A record of one array."""

    value: F3


boxes_at = reader(Boxes)


@leaf
def of_boxes(a, m, n):
    s = 0.0
    for i in range(2):
        box = a[i]
        for j in range(-3, 0):
            s = 1.5 * s + 10.0 * i * box[j, 1] + a[-1 - i, j, m] + a[i, 2, -1]
        box[1, n] += s
        a[-1, m + 1, m] = box[n, -2]
    return s + a.shape[1] * a.size + weighted(a[1, n], m)


@entry(Signature("number", ("machine", "count", "count")))
def boxes(record, m, n):
    return of_boxes(boxes_at(record).value, m, n)


@entry(ROWS)
def slices(x, m, n):
    s = weighted(x[m:n], 1) + 100.0 * weighted(x[n:], 2) + 1e4 * weighted(x[:m], 3)
    s += 1e6 * weighted(x[m:n:2], 1) + 1e8 * weighted(x[n:m:-1], 1) + weighted(x[-3:], m)
    x[m:n] = 0.5
    x[-1] += x[m % 3]
    return s


@entry(ROWS)
def branches(x, m, n):
    part, s, found = x[m:], 0.0, (0.0, 1.0)
    if n > 2:
        part = x[:n]
        found = ends(part)
    elif n == 2:
        found = (x[n], s)
    last = part.shape[0] - 1
    while last > 0:
        for k, value in enumerate(part):
            if k == last:
                break
            s += value * found[0] - found[1] * part[last]
        last -= 2
        if last == m:
            part = x[last:]
            last = min(part.shape[0], last) - 1
    return s + found[1]
