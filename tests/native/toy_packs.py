"""Entries whose code on packs is tested."""

import math

import numpy as np

from nivel.kernels.algebra.analytic import absolute, arctan2, maximum, minimum
from nivel.kernels.algebra.trigonometry import cosine_and_sine
from nivel.kernels.core.number import share_of_lanes, some, where
from nivel.native.entry import entry
from nivel.native.signature import Signature

RESULTS, MIXED = 16, 4


@entry(Signature("nothing", ("vector", "vector")))
def functions(x, out):
    """What kernels compute with, of x[0] and x[1]."""
    a, b = x[0], x[1]
    out[0] = a + b - a * b / (a + 2.0 * b) + 3 * a - 1.0 / b
    out[1] = a**2 + abs(a) ** b + 2.0**b
    out[2] = np.sqrt(np.abs(a)) + np.exp(b) - np.log(math.fabs(a))
    out[3] = np.sin(a) * np.cos(b) + np.tan(a) - math.atan2(a, b)
    out[4], out[5] = cosine_and_sine(3.0 * a)
    out[6] = arctan2(a, b)
    out[7] = maximum(a, b) - minimum(a, 0.5) + absolute(b)
    out[8] = max(a, b, 0.1) * min(a, b) + np.maximum(a, 0.2) - np.minimum(b, a)
    out[9] = np.floor(a) + np.ceil(b) + np.sign(a) + a % 0.7 + math.copysign(a, -b)
    out[10] = where(a > b, a, where(b > 0.0, 7.0, b))
    out[11] = np.tanh(a) + np.arctan(b) + math.hypot(a, b) + np.square(a)
    out[12] = share_of_lanes(a > 0.0) if some(a > 0.0) else 2.0
    out[13] = a.real + np.real(b) + np.imag(a)
    out[14] = np.radians(b) + float(a)
    out[15] = where(np.isnan(a / (b - b)), 1.0, 2.0)


@entry(Signature("status", ("vector", "vector")))
def branches(x, out):
    """A branch by what differs, and an index."""
    for k in range(out.shape[0]):
        out[k] = 0.0
    if x[0] > 0.0:
        out[0] = 1.0
    else:
        out[0] = -1.0
    out[np.int64(x[1])] += 10.0
    return int(x[0] > 0.0) + 2 * int(x[2] != x[2])
