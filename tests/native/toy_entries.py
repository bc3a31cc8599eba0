"""Entries of a module that is not of the package."""

import numpy as np

from nivel.kernels.core.lanes import slope
from nivel.native.entry import Entry, entry
from nivel.native.function import caller, leaf, shared
from nivel.native.signature import Signature

SUM = Signature("number", ("vector", "count"))
call_sum = caller(SUM)


@leaf
def square(x):
    return x * x


def powers(n):
    @leaf
    def power(x):
        out = 1.0
        for _ in range(n):
            out *= x
        return out

    return power


second, third = powers(2), powers(3)


@shared
def total(part, x, first):
    s = 0.0
    for k in range(first, x.shape[0]):
        s += part(x[k])
    return s


@entry(SUM)
def squares(x, first):
    return total(square, x, first)


@entry(Signature("number", ("entry", "vector")))
def twice(function, x):
    return 2.0 * call_sum(function, x, 1)


@entry(SUM)
def made(x, first):
    return total(third, x, first) + 1000.0 * total(second, x, first)


@entry(Signature("status", ("vector", "duals", "complex", "dual")))
def scale(x, z, factor, share):
    for k in range(x.shape[0]):
        x[k] *= factor.real
        z[k] = z[k] * share + factor.imag
    return x.shape[0]


SHARE = Signature("number", ("vector",))
call_share = caller(SHARE)
share_of_duals = Entry(lambda x: x[0] / x[1], SHARE.on("twin"), "toy_entries:share_of_duals")


@entry(Signature("number", ("entry", "duals")))
def slope_of_share(function, x):
    """Of what code on dual numbers returns, which goes through memory."""
    return slope(call_share(function, x), 2)


@entry(Signature("nothing", ("vector",)))
def fill(x):
    x[:] = 7.0


@entry(Signature("status", ("count",)))
def careful(n):
    if n < 0:
        raise ValueError("kernels do not raise")
    return n


@entry(Signature("number", ("vector",)))
def sine(x):
    return np.sin(x[0])


@entry(Signature("status", ("count",)))
def wrong(n):
    return n + missing  # noqa: F821
