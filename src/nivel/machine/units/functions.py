"""Table of the functions of expressions: for each its value, derivative, units, operation of a program, and corners.

A row is all that is known of a function. Everything that reads expressions reads the table: values at a point (arithmetic.py), derivatives
(derivative.py), units (measure.py, plain_factors.py), programs (system/laws/program.py), corners and jumps (analysis/curves). The page for
users lists the rows.
"""

import math
from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property, lru_cache
from typing import Final, Literal, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import Struct, scipy
from nivel.machine.units import tree
from nivel.machine.units.grammar import parse

# Piecewise polynomials through points: straight lines, splines, and curves that do not overshoot.

Interpolation = Literal["linear", "cubic", "monotone", "quintic", "periodic"]
INTERPOLATIONS: Final = ("linear", "cubic", "monotone", "quintic", "periodic")
PERIODIC: Final = "periodic"
# whose speeds and accelerations jump nowhere, at no end
SMOOTH: Final = ("quintic", PERIODIC)
FEWEST: Final = {"linear": 1, "cubic": 3, "monotone": 2, "quintic": 2, "periodic": 4}  # points
STRAIGHT, CURVED = 4, 6  # coefficients of a piece, up to cubic and of a quintic


def pieces(kind: str, points: Sequence[float], values: Sequence[float]) -> NDArray[np.float64]:
    """The polynomials between the points: value = Σ c[k, i] h^i with h = x - points[k].

    linear: straight lines. cubic: a natural spline, not bent at its ends. monotone: cubic pieces with one slope at a point that neither
    rise nor fall where the values do not (Fritsch & Butland 1984). quintic: a spline with four continuous derivatives, of which the first
    and the second are zero at both ends. periodic: a spline with two continuous derivatives, at the seam too, which goes on without end.

    returns (n - 1, 4), of a quintic (n - 1, 6); SI
    """
    x, y = np.array(points, dtype=float), np.array(values, dtype=float)
    if kind == "linear":
        straight = np.zeros((len(x) - 1, STRAIGHT))
        straight[:, 0] = y[:-1]
        straight[:, 1] = np.diff(y) / np.diff(x)
        return straight
    if kind == "cubic":
        curve = scipy.interpolate.CubicSpline(x, y, bc_type="natural").c
    elif kind == PERIODIC:
        y[-1] = y[0]
        curve = scipy.interpolate.CubicSpline(x, y, bc_type="periodic").c
    elif kind == "monotone":
        curve = scipy.interpolate.PchipInterpolator(x, y).c
    else:
        rest = [(1, 0.0), (2, 0.0)]
        curve = _between(
            x,
            scipy.interpolate.PPoly.from_spline(scipy.interpolate.make_interp_spline(x, y, k=5, bc_type=(rest, rest))),
        )
    return np.ascontiguousarray(curve[::-1].T)


def _between(x: NDArray[np.float64], curve: object) -> NDArray[np.float64]:
    """Coefficients (6, n - 1) of the pieces between the points, highest power first, without the empty ones at the ends of a spline."""
    knots, coefficients = np.asarray(curve.x), np.asarray(curve.c)  # type: ignore[attr-defined]
    return coefficients[:, [int(np.flatnonzero(knots == point)[-1]) for point in x[:-1]]]


def misses_its_period(kind: str, values: Sequence[float]) -> bool:
    """Whether a periodic curve does not end with the value with which it begins."""
    return kind == PERIODIC and abs(values[-1] - values[0]) > 1e-9 * max(map(abs, values))


def differentiated(coefficients: NDArray[np.float64], order: int) -> NDArray[np.float64]:
    """Coefficients (n - 1, 6) of the derivative of this order."""
    out = np.zeros((coefficients.shape[0], CURVED))
    out[:, : coefficients.shape[1]] = coefficients
    for _ in range(order):
        out = np.hstack([out[:, 1:] * np.arange(1, CURVED), np.zeros((len(out), 1))])
    return out


def interpolated(kind: str, points: Sequence[float], values: Sequence[float], x: float, order: int = 0) -> float:
    """Value at x of the curve through the points, or of its derivative; beyond the ends the end values hold, unless it is periodic."""
    if kind == PERIODIC:
        x = points[0] + (x - points[0]) % (points[-1] - points[0])
    if x < points[0]:
        return float(values[0]) if order == 0 else 0.0
    if x >= points[-1]:
        return float(values[-1]) if order == 0 else 0.0
    k = bisect_right(points, x) - 1
    return float(np.polynomial.polynomial.polyval(x - points[k], _curve(kind, tuple(points), tuple(values), order)[k]))


@lru_cache(maxsize=100)
def _curve(kind: str, points: tuple[float, ...], values: tuple[float, ...], order: int) -> NDArray[np.float64]:
    return differentiated(pieces(kind, points, values), order)


Argument = TypeVar("Argument")
Pair = tuple[tree.Node, tree.Node | None]


class Alike(NamedTuple):
    """Arguments at these `places` (all, if empty) measure the same, being what is `done` with them; the value has their unit to a power."""

    exponent: float = 1.0
    places: tuple[int, ...] = ()
    done: str = "compared"

    def of(self, arguments: Sequence[Argument]) -> list[Argument]:
        """Those of the arguments of a call."""
        return [arguments[k] for k in self.places or range(len(arguments))]


class Units(NamedTuple):
    """The unit of a value is the product of those of the groups of alike arguments.

    taken : what each argument must be; is_angle : the value is an angle
    """

    alike: tuple[Alike, ...] = ()
    taken: Literal["", "an angle", "a pure number"] = ""
    is_angle: bool = False


PURE: Final = Units()
SAME: Final = Units((Alike(),))
OF_ANGLE: Final = Units(taken="an angle")
OF_NUMBER: Final = Units(taken="a pure number")
ANGLE_OF: Final = Units(taken="a pure number", is_angle=True)


def _between_points(order: int) -> Units:
    """Units of a derivative of this order of heights y0, y1 along x between x0 and x1."""
    return Units((Alike(-float(order), (0, 1, 3)), Alike(1.0, (2, 4), "joined")))


def _sign_decides(counts: Callable[..., bool], x: tree.Node, *_: tree.Node) -> Iterator[Pair]:
    if counts(x):
        yield x, None


def _order_decides(counts: Callable[..., bool], *arguments: tree.Node) -> Iterator[Pair]:
    pairs = ((first, second) for k, first in enumerate(arguments) for second in arguments[:k])
    yield from (pair for pair in pairs if counts(*pair))


def _ends_decide(counts: Callable[..., bool], *arguments: tree.Node) -> Iterator[Pair]:
    if counts(*arguments):
        yield from ((arguments[0], arguments[k]) for k in (1, 3))


class FunctionKind(Struct):
    """What is known of one function of expressions. Texts are expressions of its arguments.

    arguments : their names. more : further arguments may follow, of which the value is that of the first two, and so on
    meaning : one line for the page on numbers
    form : the value in terms of other functions. What the row does not say follows from it
    value : of floats, as the math module has it
    derivative : with respect to time, where dx is the rate of an argument x; arguments without a rate in it must be constant.
        There is none of a function with sides or jumps of its own. smooth : text of what is smooth instead
    operation : of `nivel.kernels.record.program`
    sides : pairs of expressions, or one and zero, whose order decides about the value, of those that count
    choice : the value as a choice, whose condition is a switch
    jumps : the value jumps where its first argument passes a value. is_truth : it is 1 or 0
    """

    arguments: str
    meaning: str
    units: Units
    operation: str = ""
    value: Callable[..., float] | None = None
    form: str = ""
    derivative: str = ""
    smooth: str = ""
    sides: Callable[..., Iterator[Pair]] | None = None
    choice: str = ""
    jumps: bool = False
    is_truth: bool = False
    more: bool = False

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of the arguments."""
        return tuple(self.arguments.split())

    @property
    def most(self) -> int:
        """The largest number of arguments."""
        return 99 if self.more else len(self.names)

    @property
    def body(self) -> tree.Node:
        """The tree of the form, in which the arguments stand as signals."""
        return read(self.form, self.names)

    def written(self, text: str, arguments: tuple[tree.Node, ...]) -> tree.Node:
        """One of the texts with these arguments in it."""
        return tree.substituted(read(text, self.names), dict(zip(self.names, arguments, strict=True)))

    @property
    def is_form_alone(self) -> bool:
        """Whether corners and jumps are those of the form."""
        return bool(self.form) and not self.jumps and self.sides is None


@lru_cache(maxsize=256)
def read(text: str, names: tuple[str, ...]) -> tree.Node:
    """The tree of a text of the table, in which the `names` stand as signals."""
    constants = {name: tree.Number(value) for name, value in tree.CONSTANTS.items()}
    return tree.substituted(parse(text), constants | {name: tree.Signal(name) for name in names})


def inner_parts(node: tree.Node) -> tuple[tree.Node, ...]:
    """The parts of `node` in which corners and jumps of other functions can be."""
    match node:
        case tree.Call(function, arguments) if (kind := FUNCTIONS[function]).is_form_alone:
            return (kind.written(kind.form, arguments),)
    return tree.parts(node)


def is_truth(node: tree.Node) -> bool:
    """Whether a node is a condition, 1 or 0, whose own sides say where it changes."""
    match node:
        case tree.Operation(symbol):
            return symbol in (*tree.COMPARISONS, *tree.LOGICAL)
        case tree.Call(function):
            return FUNCTIONS[function].is_truth
    return False


def _step(x: float, x0: float, y0: float, x1: float, y1: float) -> float:
    s = min(max((x - x0) / (x1 - x0), 0.0), 1.0)
    return y0 + (y1 - y0) * s**3 * (10.0 + s * (-15.0 + s * 6.0))


def _step_rate(x: float, x0: float, y0: float, x1: float, y1: float) -> float:
    s = min(max((x - x0) / (x1 - x0), 0.0), 1.0)
    return (y1 - y0) / (x1 - x0) * 30.0 * s**2 * (1.0 - s) ** 2


def _step_acceleration(x: float, x0: float, y0: float, x1: float, y1: float) -> float:
    s = min(max((x - x0) / (x1 - x0), 0.0), 1.0)
    return (y1 - y0) / (x1 - x0) ** 2 * 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s)


_POINTS: Final = "x x0 y0 x1 y1"
_SHARE: Final = "min(max((x - x0)/(x1 - x0), 0), 1)"
_SMOOTH: Final = "step(time, t0, a, t1, b)"

# fmt: off
FUNCTIONS: Final[dict[str, FunctionKind]] = {
    "sin": FunctionKind("x", "sine", OF_ANGLE, "SIN", math.sin, derivative="cos(x)*dx"),
    "cos": FunctionKind("x", "cosine", OF_ANGLE, "COS", math.cos, derivative="-sin(x)*dx"),
    "tan": FunctionKind("x", "tangent", OF_ANGLE, "TAN", math.tan, derivative="(1 + tan(x)^2)*dx"),
    "asin": FunctionKind("x", "angle with this sine, -π/2 to π/2", ANGLE_OF, "ASIN", math.asin, derivative="1/sqrt(1 - x*x)*dx"),
    "acos": FunctionKind("x", "angle with this cosine, 0 to π", ANGLE_OF, "ACOS", math.acos, derivative="-(1/sqrt(1 - x*x))*dx"),
    "atan": FunctionKind("x", "angle with this tangent, -π/2 to π/2", ANGLE_OF, "ATAN", math.atan, derivative="1/(1 + x*x)*dx"),
    "atan2": FunctionKind(
        "y x", "angle of the point (x, y), -π to π", Units((Alike(0.0),), is_angle=True), "ATAN2", math.atan2,
        derivative="(x*dy - y*dx)/(x*x + y*y)",
    ),
    "sqrt": FunctionKind("x", "square root", Units((Alike(0.5),)), "SQRT", math.sqrt, derivative="1/(2*sqrt(x))*dx"),
    "exp": FunctionKind("x", "exponential function", OF_NUMBER, "EXP", math.exp, derivative="exp(x)*dx"),
    "log": FunctionKind("x", "natural logarithm", OF_NUMBER, "LOG", math.log, derivative="1/x*dx"),
    "abs": FunctionKind("x", "absolute value", SAME, "ABS", math.fabs, sides=_sign_decides, choice="if(-x, -x, x)"),
    "min": FunctionKind(
        "x y", "the smallest of two or more values", SAME, "MIN", min,
        more=True, sides=_order_decides, choice="if(x - y, y, x)",
    ),
    "max": FunctionKind(
        "x y", "the largest of two or more values", SAME, "MAX", max,
        more=True, sides=_order_decides, choice="if(y - x, y, x)",
    ),
    "step": FunctionKind(
        _POINTS, "`y0` up to `x0`, `y1` from `x1` on; a quintic between them, with continuous second derivative",
        _between_points(0), value=_step, form=f"y0 + (y1 - y0)*({_SHARE}^2*{_SHARE}*(10 + {_SHARE}*(6*{_SHARE} - 15)))",
        derivative="step_rate(x, x0, y0, x1, y1)*dx", sides=_ends_decide,
    ),
    "step_rate": FunctionKind(
        _POINTS, "first derivative of the `step` with the same arguments",
        _between_points(1), value=_step_rate, form=f"(y1 - y0)/(x1 - x0)*(30*({_SHARE}*(1 - {_SHARE}))^2)",
        derivative="step_acceleration(x, x0, y0, x1, y1)*dx", sides=_ends_decide,
    ),
    "step_acceleration": FunctionKind(
        _POINTS, "second derivative of the `step` with the same arguments", _between_points(2), value=_step_acceleration,
        form=f"(y1 - y0)/(x1 - x0)^2*(60*({_SHARE}*(1 - {_SHARE}))*(1 + {_SHARE}*(-2)))", sides=_ends_decide,
    ),
    "ramp": FunctionKind(
        _POINTS, "as `step`, with a straight line in place of the quintic",
        _between_points(0), form=f"y0 + (y1 - y0)*{_SHARE}", smooth=_SMOOTH, sides=_ends_decide,
    ),
    "if": FunctionKind(
        "condition a b", "`a` if the condition is true, else `b`", Units((Alike(1.0, (1, 2), "values of one `if`"),)), "CHOOSE",
        smooth=_SMOOTH, sides=_sign_decides, jumps=True,
    ),
    "not": FunctionKind("x", "1 if x is false, else 0", PURE, form="x <= 0", sides=_sign_decides, jumps=True, is_truth=True),
    "sign": FunctionKind("x", "-1, 0 or 1", PURE, form="(0 < x) - (x < 0)", sides=_sign_decides, jumps=True),
    "floor": FunctionKind("x", "the largest integer ≤ x", PURE, "FLOOR", math.floor, jumps=True),
    "mod": FunctionKind("x y", "the remainder of x divided by y", SAME, form="x - y*floor(x/y)", jumps=True),
    "tanh": FunctionKind("x", "hyperbolic tangent", OF_NUMBER, "TANH", math.tanh, derivative="(1 - tanh(x)^2)*dx"),
}
# fmt: on
