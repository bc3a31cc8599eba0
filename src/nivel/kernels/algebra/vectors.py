"""Sums of 3-vectors, and products of a 3×3 matrix with one, as tuples: beside `dot` and `cross` what kernels of elements are made of."""

from nivel.native.function import leaf


@leaf
def plus(x, y):
    """x + y."""
    return x[0] + y[0], x[1] + y[1], x[2] + y[2]


@leaf
def minus(x, y):
    """x - y."""
    return x[0] - y[0], x[1] - y[1], x[2] - y[2]


@leaf
def plus_cross(x, y, z):
    """x + y × z."""
    return x[0] + y[1] * z[2] - y[2] * z[1], x[1] + y[2] * z[0] - y[0] * z[2], x[2] + y[0] * z[1] - y[1] * z[0]


@leaf
def moment(J, u):
    """n + u × f: moment about the frame's origin of the part J = (f, n) of a row, whose marker is at u."""
    return plus_cross((J[3], J[4], J[5]), u, J)


@leaf
def times(s, x):
    """s x."""
    return s * x[0], s * x[1], s * x[2]


@leaf
def combined(a, x, b, y):
    """a x + b y."""
    return a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]


@leaf
def opposite(x):
    """-x."""
    return -x[0], -x[1], -x[2]


@leaf
def axis(A, k):
    """Column k."""
    return A[0, k], A[1, k], A[2, k]


@leaf
def turned(A, x):
    """A x."""
    return (
        A[0, 0] * x[0] + A[0, 1] * x[1] + A[0, 2] * x[2],
        A[1, 0] * x[0] + A[1, 1] * x[1] + A[1, 2] * x[2],
        A[2, 0] * x[0] + A[2, 1] * x[1] + A[2, 2] * x[2],
    )


@leaf
def seen(A, x):
    """Aᵀ x."""
    return (
        A[0, 0] * x[0] + A[1, 0] * x[1] + A[2, 0] * x[2],
        A[0, 1] * x[0] + A[1, 1] * x[1] + A[2, 1] * x[2],
        A[0, 2] * x[0] + A[1, 2] * x[1] + A[2, 2] * x[2],
    )


@leaf
def turned_flat(B, x):
    """B x of a matrix (9,) by rows."""
    return (
        B[0] * x[0] + B[1] * x[1] + B[2] * x[2],
        B[3] * x[0] + B[4] * x[1] + B[5] * x[2],
        B[6] * x[0] + B[7] * x[1] + B[8] * x[2],
    )


@leaf
def seen_flat(B, x):
    """Bᵀ x of a matrix (9,) by rows."""
    return (
        B[0] * x[0] + B[3] * x[1] + B[6] * x[2],
        B[1] * x[0] + B[4] * x[1] + B[7] * x[2],
        B[2] * x[0] + B[5] * x[1] + B[8] * x[2],
    )


@leaf
def put(out, at, x):
    """out[at : at + 3] = x."""
    out[at], out[at + 1], out[at + 2] = x[0], x[1], x[2]
