"""Dual numbers of plain Python, as compiled kernels have them: see `nivel.native.duals`."""

import math
import operator
from types import SimpleNamespace

import numpy as np

from nivel.native.duals import LANES

# slopes that are known to be null: they need no arithmetic
NONE = np.zeros(LANES)
NONE.flags.writeable = False


class Dual:
    """A value and its slopes. Comparisons look at the value."""

    __slots__ = ("real", "slopes")

    def __init__(self, value, slopes=NONE):
        self.real, self.slopes = value, slopes

    def __array_ufunc__(self, ufunc, method, *operands):
        """NumPy's functions of numbers."""
        return FUNCTIONS[ufunc](*operands) if method == "__call__" and ufunc in FUNCTIONS else NotImplemented

    def __bool__(self):
        return self.real != 0.0

    def __int__(self):
        return int(self.real)


def value(x):
    return x.real if type(x) is Dual else x


def parts(x):
    return (x.real, x.slopes) if type(x) is Dual else (x, NONE)


def finite(along):
    return along if math.isfinite(along) else 0.0


def of(function, *slopes):
    """`function` of dual numbers, its slopes along each as functions of the values; infinite ones are none."""

    def on_duals(*operands):
        values = [value(x) for x in operands]
        total = NONE
        for x, slope in zip(operands, slopes, strict=True):
            if type(x) is Dual and x.slopes is not NONE:
                total = total + finite(slope(*values)) * x.slopes
        return Dual(function(*values), total)

    return on_duals


def sum_of(x, y):
    (a, p), (b, q) = parts(x), parts(y)
    return Dual(a + b, q if p is NONE else p if q is NONE else p + q)


def difference(x, y):
    (a, p), (b, q) = parts(x), parts(y)
    return Dual(a - b, p if q is NONE else p - q)


def product(x, y):
    (a, p), (b, q) = parts(x), parts(y)
    if q is NONE:
        return Dual(a * b, NONE if p is NONE else finite(b) * p)
    return Dual(a * b, finite(a) * q if p is NONE else finite(b) * p + finite(a) * q)


def chosen(further):
    """The second where it lies further, or is no number."""

    def choose(x, y):
        a, b = value(x), value(y)
        return y if further(b, a) or np.isnan(b) else x

    return choose


def compared(function):
    return lambda *operands: function(*(value(x) for x in operands))


def stepped(ufunc):
    return lambda x: Dual(ufunc(x.real))


FUNCTIONS = {
    np.add: sum_of,
    np.subtract: difference,
    np.multiply: product,
    np.true_divide: of(np.true_divide, lambda x, y: 1.0 / y, lambda x, y: -x / y / y),
    np.power: of(
        np.float_power, lambda x, y: y * np.float_power(x, y - 1.0), lambda x, y: np.log(x) * np.float_power(x, y)
    ),
    np.remainder: of(np.remainder, lambda x, y: 1.0, lambda x, y: -np.floor(x / y)),
    np.arctan2: of(np.arctan2, lambda y, x: x / (x * x + y * y), lambda y, x: -y / (x * x + y * y)),
    np.hypot: of(np.hypot, lambda x, y: x / np.hypot(x, y), lambda x, y: y / np.hypot(x, y)),
    np.copysign: of(np.copysign, lambda x, y: np.copysign(np.copysign(1.0, x), x * y), lambda x, y: 0.0),
    np.negative: lambda x: Dual(-x.real, -x.slopes),
    np.positive: lambda x: x,
    np.absolute: lambda x: Dual(-x.real, -x.slopes) if x.real < 0.0 else x,
    np.maximum: chosen(lambda b, a: b > a),
    np.minimum: chosen(lambda b, a: b < a),
    np.sqrt: of(np.sqrt, lambda x: 0.5 / np.sqrt(x)),
    np.exp: of(np.exp, np.exp),
    np.log: of(np.log, lambda x: 1.0 / x),
    np.sin: of(np.sin, np.cos),
    np.cos: of(np.cos, lambda x: -np.sin(x)),
    np.tan: of(np.tan, lambda x: 1.0 + np.tan(x) ** 2),
    np.arcsin: of(np.arcsin, lambda x: 1.0 / np.sqrt(1.0 - x * x)),
    np.arccos: of(np.arccos, lambda x: -1.0 / np.sqrt(1.0 - x * x)),
    np.arctan: of(np.arctan, lambda x: 1.0 / (1.0 + x * x)),
    np.tanh: of(np.tanh, lambda x: 1.0 - np.tanh(x) ** 2),
    **{each: stepped(each) for each in (np.floor, np.ceil, np.sign)},
    np.less: compared(operator.lt),
    np.less_equal: compared(operator.le),
    np.equal: compared(operator.eq),
    np.greater: compared(operator.gt),
    np.greater_equal: compared(operator.ge),
    np.not_equal: compared(operator.ne),
    **{each: compared(each) for each in (np.isnan, np.isfinite)},
}
OPERATORS = {
    "add": np.add, "sub": np.subtract, "mul": np.multiply, "truediv": np.true_divide, "pow": np.power, "mod": np.remainder,
    "lt": np.less, "le": np.less_equal, "gt": np.greater, "ge": np.greater_equal, "eq": np.equal, "ne": np.not_equal,
    "neg": np.negative, "pos": np.positive, "abs": np.absolute,
}  # fmt: skip
for _name, _ufunc in OPERATORS.items():
    _function = FUNCTIONS[_ufunc]
    setattr(Dual, f"__{_name}__", lambda *operands, function=_function: function(*operands))
    if _name in ("add", "sub", "mul", "truediv", "pow", "mod"):
        setattr(Dual, f"__r{_name}__", lambda y, x, function=_function: function(x, y))


def unit(k, size):
    """As `nivel.kernels.core.lanes` has it."""
    slopes = np.zeros(LANES)
    slopes[k] = size
    return Dual(0.0, slopes)


def slope(x, k):
    """The same."""
    return x.slopes[k]


def _either(name, ufunc):
    plain = getattr(math, name)
    return lambda *operands: ufunc(*operands) if any(isinstance(x, Dual) for x in operands) else plain(*operands)


# what laws know as `math`
MATH = SimpleNamespace(**vars(math))
_ALIKE = ("hypot", "copysign", "sin", "cos", "tan", "exp", "log", "sqrt", "tanh", "floor")
_OTHERS = {
    "atan2": np.arctan2,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "fabs": np.absolute,
    "pow": np.power,
}
for _name, _ufunc in {**{each: getattr(np, each) for each in _ALIKE}, **_OTHERS}.items():
    setattr(MATH, _name, _either(_name, _ufunc))
