"""Rows of numbers, copied, cleared and added: of two that are not of one length the shorter one counts."""

from nivel.native.function import leaf


@leaf
def copy(x, out):
    """out = x."""
    for i in range(min(x.shape[0], out.shape[0])):
        out[i] = x[i]


@leaf
def clear(out):
    """out = 0."""
    for i in range(out.shape[0]):
        out[i] = 0.0


@leaf
def add(x, out):
    """out += x."""
    for i in range(min(x.shape[0], out.shape[0])):
        out[i] += x[i]


@leaf
def subtract(x, out):
    """out -= x."""
    for i in range(min(x.shape[0], out.shape[0])):
        out[i] -= x[i]


@leaf
def add_times(s, x, out):
    """out += s x."""
    for i in range(min(x.shape[0], out.shape[0])):
        out[i] += s * x[i]


@leaf
def advance(x, s, rate, out):
    """out = x + s rate."""
    for i in range(min(x.shape[0], rate.shape[0], out.shape[0])):
        out[i] = x[i] + s * rate[i]
