"""Products of 3-vectors and 3×3 matrices, written out so that the compiler keeps them in registers."""

from __future__ import annotations

from nivel.kernels.compile import leaf


@leaf
def dot(a, b):
    """aᵀb of 3-vectors."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@leaf
def cross(a, b):
    """a × b of 3-vectors, as a tuple."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@leaf
def multiply(A, x, out):
    """out = A x; `out` may not be x."""
    for i in range(3):
        out[i] = A[i, 0] * x[0] + A[i, 1] * x[1] + A[i, 2] * x[2]


@leaf
def centripetal(w, u, out):
    """out = ω × (ω × u) = ω (ωᵀu) - u (ωᵀω)."""
    wu = dot(w, u)
    ww = dot(w, w)
    for i in range(3):
        out[i] = w[i] * wu - u[i] * ww
