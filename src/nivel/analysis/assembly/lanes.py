"""Dual numbers in arrays of Python: lanes (…, 1 + LANES), a value and its slopes, in the last axis. Sums are those of the arrays."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from nivel.machine.core import vectors
from nivel.native.duals import LANES

Lanes = NDArray[np.float64]
NOTHING: Lanes = np.zeros(1 + LANES)


def product(subscripts: str, a: Lanes, b: Lanes) -> Lanes:
    """Sums of products of dual numbers, with subscripts as `np.einsum` has them."""
    factors, result = subscripts.split("->")
    first, second = factors.split(",")
    out: Lanes = np.einsum(f"{first}z,{second}->{result}z", a, b[..., 0])
    out[..., 1:] += np.einsum(f"{first},{second}z->{result}z", a[..., 0], b[..., 1:])
    return out


def cross(a: Lanes, b: Lanes) -> Lanes:
    """a × b of vectors (…, 3, 1 + LANES)."""
    a, b = np.moveaxis(a, -1, 0), np.moveaxis(b, -1, 0)
    out = vectors.cross(a, b[:1])
    out[1:] += vectors.cross(a[:1], b[1:])
    return np.moveaxis(out, 0, -1)
