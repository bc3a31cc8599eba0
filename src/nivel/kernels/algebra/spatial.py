"""Products of 3-vectors and 3×3 matrices, written out so that the compiler keeps them in registers."""

from nivel.native.function import leaf


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


@leaf
def solve(A, b, x):
    """x of A x = b for a regular 3×3 matrix, by Cramer's rule; `x` may be b."""
    # rows of the adjugate: cross products of the columns
    p0, p1, p2 = cross(A[:, 1], A[:, 2])
    q0, q1, q2 = cross(A[:, 2], A[:, 0])
    r0, r1, r2 = cross(A[:, 0], A[:, 1])
    determinant = A[0, 0] * p0 + A[1, 0] * p1 + A[2, 0] * p2
    b0, b1, b2 = b[0], b[1], b[2]
    x[0] = (p0 * b0 + p1 * b1 + p2 * b2) / determinant
    x[1] = (q0 * b0 + q1 * b1 + q2 * b2) / determinant
    x[2] = (r0 * b0 + r1 * b1 + r2 * b2) / determinant
