"""Functions of dual numbers against complex step and against derivatives in closed form, for any number of directions."""

import math

import numpy as np
import pytest
from llvmlite import ir
from numba import njit, types
from numba.extending import intrinsic
from numba.np.arrayobj import populate_array

from nivel.native.with_numba.duals import Dual

# smooth functions that NumPy has for complex numbers too
ALIKE = """
def functions(x, y, out):
    out[0] = x + y - x * y / (x + 2.0 * y)
    out[1] = 1.0 / x - 3 * y + 2 - x / 4 + (1.0 - y) * 2.0
    out[2] = np.sin(x) * np.cos(y) + np.tan(0.3 * x)
    out[3] = np.sqrt(x) + np.exp(-y) * np.log(x)
    out[4] = np.arctan(x - y) + np.arcsin(0.4 * y) + np.arccos(0.3 * x)
    out[5] = np.sinh(y) - np.cosh(x) * np.tanh(x * y)
    out[6] = np.arcsinh(x) + np.arccosh(x + 2.0) - np.arctanh(0.3 * y)
    out[7] = x**2 + x**y + 2.0**y + x**-1.5
    out[8] = np.expm1(x) + np.log1p(y) + np.log10(x) + np.square(y)
"""
# (as numbers are, derivatives along x and y) of others, at x = 1.3, y = 0.6
X, Y = 1.3, 0.6
OTHERS = {
    "np.arctan2(x, -y)": (-Y / (X * X + Y * Y), X / (X * X + Y * Y)),
    "math.atan2(-x, y)": (-Y / (X * X + Y * Y), X / (X * X + Y * Y)),
    "math.hypot(x, y) + np.hypot(x, 3.0)": (X / math.hypot(X, Y) + X / math.hypot(X, 3.0), Y / math.hypot(X, Y)),
    "math.copysign(x, -y) + np.copysign(-2.0, y)": (-1.0, 0.0),
    "abs(-x) + np.abs(y) + math.fabs(y - x)": (2.0, 0.0),
    "max(x, y, 1.0) - min(2.0, x, y)": (1.0, -1.0),
    "np.maximum(x, y) + np.minimum(x, 0.5)": (1.0, 0.0),
    "x % y - x % 0.7 + pow(x, 2.0) + math.pow(2.0, y)": (2.0 * X, -2.0 + 2.0**Y * math.log(2.0)),
    "np.floor(x) + np.ceil(y) + np.sign(x) + float(int(x)) + math.floor(x)": (0.0, 0.0),
    "np.interp(x, GRID, HEIGHTS) + np.interp(9.0 * y, GRID, HEIGHTS)": (-3.0, 0.0),
    "np.clip(x, 0.0, y) + float(x)": (1.0, 1.0),
    "math.erf(x)": (2.0 / math.sqrt(math.pi) * math.exp(-X * X), 0.0),
    "math.radians(x) + np.degrees(y)": (math.pi / 180.0, 180.0 / math.pi),
    "x if x > y and not x == y else y": (1.0, 0.0),
    "(x or y) + (2.0 * x if y else 1.0) + x.real": (3.0, 0.0),
    # where a slope is infinite it is told as none, in directions that move and in those that do not
    "np.sqrt(x - 1.3) + (y - 0.6)**0.5 + (x - 1.3)**(y - 0.1) + np.hypot(x - 1.3, 0.0) + 0.0*np.arcsin(x - 0.3)": (
        0.0,
        0.0,
    ),
}


def compiled(text, n):
    """`functions` of this text for dual numbers with n directions: (x, slopes of x, y, slopes of y) -> rows of value and slopes."""
    kind = Dual(n)

    @intrinsic
    def rows_of(typingctx, a):
        """A table of doubles as a row of dual numbers."""
        out = types.Array(kind, 1, "C", aligned=False)

        def generate(context, builder, sig, args):
            given = context.make_array(sig.args[0])(context, builder, args[0])
            made = context.make_array(out)(context, builder)
            word = ir.IntType(64)
            size = ir.Constant(word, 8 * (n + 1))
            count = builder.extract_value(given.shape, 0)
            data = builder.bitcast(given.data, made.data.type)
            populate_array(made, data=data, shape=[count], strides=[size], itemsize=size, meminfo=None)
            return made._getvalue()

        return out(a), generate

    names = {"np": np, "math": math, "GRID": np.array([0.0, 1.0, 2.0]), "HEIGHTS": np.array([2.0, 5.0, 2.0])}
    exec(text, names)
    function = njit(names["functions"])

    @njit
    def run(given, out):
        x, found = rows_of(given), rows_of(out)
        function(x[0], x[1], found)

    return run


def others():
    lines = [f"    out[{k}] = {text}" for k, text in enumerate(OTHERS)]
    return "\n".join(["def functions(x, y, out):", *lines])


@pytest.mark.compiles
@pytest.mark.parametrize("n", [7, pytest.param(3, marks=pytest.mark.full), pytest.param(15, marks=pytest.mark.full)])
def test_slopes_are_those_of_complex_step_and_of_closed_forms(n, rng):
    given = np.concatenate([[[X], [Y]], rng.uniform(-1.0, 1.0, (2, n))], axis=1)
    found = np.zeros((9, n + 1))
    compiled(ALIKE, n)(given, found)
    names = {"np": np}
    exec(ALIKE, names)
    for k in range(n):
        out = np.zeros(9, dtype=complex)
        names["functions"](X + 1e-30j * given[0, 1 + k], Y + 1e-30j * given[1, 1 + k], out)
        np.testing.assert_allclose(found[:, 0], out.real, rtol=1e-15)
        np.testing.assert_allclose(found[:, 1 + k], out.imag / 1e-30, rtol=2e-15, atol=2e-15)
    found = np.zeros((len(OTHERS), n + 1))
    compiled(others(), n)(given, found)
    for (text, slopes), row in zip(OTHERS.items(), found, strict=True):
        value = eval(text, {"np": np, "math": math, "GRID": [0, 1, 2], "HEIGHTS": [2, 5, 2], "x": X, "y": Y})
        assert row[0] == pytest.approx(value, rel=1e-15, abs=1e-15), text
        np.testing.assert_allclose(row[1:], slopes @ given[:, 1:], rtol=1e-14, atol=1e-14, err_msg=text)
