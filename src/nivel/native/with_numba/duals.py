"""Dual numbers as a number type of Numba: a value and n slopes, one vector of n + 1 doubles.

Lane 0 is the value. Comparisons, branches and indices look at it alone, so kernels that are written for real numbers run on dual ones
unchanged. A slope that is infinite, as that of a root at zero, is taken for zero: it would leave no number in directions that do not move.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable
from itertools import product
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.datamodel.models import PrimitiveModel
from numba.core.imputils import lower_builtin, lower_cast
from numba.core.typeconv.castgraph import Conversion
from numba.core.typing import templates
from numba.core.typing.builtins import NumberClassAttribute
from numba.core.typing.templates import AbstractTemplate, AttributeTemplate, infer_getattr, signature
from numba.extending import intrinsic, lower_getattr, overload, register_model

from nivel.native.duals import LANES

_infer_global: Any = templates.infer_global  # its stubs do not know what it returns
_F = types.float64
_I32, _DOUBLE = ir.IntType(32), ir.DoubleType()
ZERO, ONE = ir.Constant(_DOUBLE, 0.0), ir.Constant(_DOUBLE, 1.0)


class Vector(types.Type):
    """Numbers that are `lanes` doubles."""

    def __init__(self, name: str, lanes: int) -> None:
        self.lanes = lanes
        super().__init__(name)

    @property
    def vector(self) -> Any:
        """Its type in LLVM."""
        return ir.VectorType(_DOUBLE, self.lanes)

    def can_convert_from(self, typingctx: Any, other: Any) -> Any:
        """Every real number is one of them."""
        return Conversion.promote if is_real(other) else None

    def unify(self, typingctx: Any, other: Any) -> Any:
        """With real numbers one of them."""
        return self if is_real(other) or other == self else None


class Dual(Vector):
    """A value and its slopes along n directions."""

    def __init__(self, n: int) -> None:
        self.n = n
        super().__init__(f"Dual({n})", n + 1)


DUAL = Dual(LANES)


@register_model(Dual)
class VectorModel(PrimitiveModel):
    """A vector."""

    def __init__(self, manager: Any, kind: Vector) -> None:
        super().__init__(manager, kind, kind.vector)


def is_real(kind: Any) -> bool:
    """Whether it is a type of real numbers, or what is taken for one."""
    return isinstance(kind, types.Float | types.Integer | types.Boolean)


# --- lanes ---


def value_of(b: Any, x: Any) -> Any:
    """Lane 0."""
    return b.extract_element(x, ir.Constant(_I32, 0))


def with_value(b: Any, x: Any, value: Any) -> Any:
    """The slopes of x with another value."""
    return b.insert_element(x, value, ir.Constant(_I32, 0))


def constant(b: Any, value: Any, kind: Dual) -> Any:
    """A real number as a dual one."""
    return with_value(b, ir.Constant(kind.vector, [0.0] * (kind.n + 1)), value)


def spread(b: Any, value: Any, kind: Vector) -> Any:
    """A real number in all lanes."""
    return _lane_0_everywhere(b, with_value(b, ir.Constant(kind.vector, ir.Undefined), value), kind)


def _lane_0_everywhere(b: Any, x: Any, kind: Vector) -> Any:
    nothing, lanes = ir.Constant(kind.vector, ir.Undefined), [0] * kind.lanes
    return b.shuffle_vector(x, nothing, ir.Constant(ir.VectorType(_I32, kind.lanes), lanes))


def _multiply_add(b: Any, x: Any, y: Any, z: Any, kind: Dual) -> Any:
    t = kind.vector
    function = cgutils.get_or_insert_function(b.module, ir.FunctionType(t, [t, t, t]), f"llvm.fmuladd.v{kind.n + 1}f64")
    return b.call(function, [x, y, z])


def _joined(b: Any, of_value: Any, of_slopes: Any, kind: Dual) -> Any:
    """Lane 0 of one, the others of the other."""
    mask = ir.Constant(ir.VectorType(ir.IntType(1), kind.n + 1), [0] + [1] * kind.n)
    return b.select(mask, of_slopes, of_value)


def _scaled(b: Any, x: Any, value: Any, slope: Any, kind: Dual) -> Any:
    """f(x) from f and f' at the value of x."""
    return with_value(b, b.fmul(x, spread(b, slope, kind)), value)


def _finite(b: Any, slope: Any) -> Any:
    """The slope, 0 where it is none."""
    f = cgutils.get_or_insert_function(b.module, ir.FunctionType(_DOUBLE, [_DOUBLE]), "llvm.fabs.f64")
    return b.select(b.fcmp_ordered("<", b.call(f, [slope]), ir.Constant(_DOUBLE, math.inf)), slope, ZERO)


def _cast(context: Any, b: Any, given: Any, wanted: Dual, value: Any) -> Any:
    return constant(b, context.cast(b, value, given, _F), wanted)


for _kind in (types.Float, types.Integer, types.Boolean):
    lower_cast(_kind, Dual)(_cast)


# --- operations of two ---


class Operand:
    """One of two operands. is_dual : else it is a double. value : of it."""

    def __init__(self, b: Any, given: Any, kind: Any, wanted: Dual) -> None:
        self.given, self.is_dual, self._b, self._wanted = given, isinstance(kind, Dual), b, wanted
        self.value = value_of(b, given) if self.is_dual else given

    @property
    def dual(self) -> Any:
        """It as a dual number."""
        return self.given if self.is_dual else constant(self._b, self.given, self._wanted)

    @property
    def factor(self) -> Any:
        """Itself, or the double in all lanes."""
        return self.given if self.is_dual else spread(self._b, self.given, self._wanted)


Emit = Callable[[Any, Any, Operand, Operand, Dual], Any]
# functions of two numbers and of one that kernels call, with the types of their results, None: that of the numbers
OF_TWO: dict[Any, Any] = {}
OF_ONE: dict[Any, Any] = {}


def define(vector: type[Vector], function: Any, counts: Iterable[int], emit: Callable[..., Any], result: Any) -> None:
    """emit(context, builder, arguments, their types, type): the code for this function of so many numbers, one of which at least is of a
    type of vectors; the others are doubles. result : its type, None: that of the vectors."""
    counts = tuple(counts)

    def among(kinds: Any) -> Any:
        found = next((each for each in kinds if isinstance(each, vector)), None)
        return found if all(each == found or is_real(each) for each in kinds) else None

    @_infer_global(function)
    class Template(AbstractTemplate):
        def generic(self, args: Any, kws: Any) -> Any:
            kind = among(args)
            if len(args) not in counts or kws or kind is None:
                return None
            return signature(result or kind, *(each if each == kind else _F for each in args))

    def low(context: Any, b: Any, sig: Any, args: Any) -> Any:
        return emit(context, b, args, sig.args, among(sig.args))

    for count in counts:
        for kinds in product((vector, types.Float), repeat=count):
            if vector in kinds:
                lower_builtin(function, *kinds)(low)


def _operands(b: Any, args: Any, kinds: Any, kind: Dual) -> list[Operand]:
    return [Operand(b, each, given, kind) for each, given in zip(args, kinds, strict=True)]


def _binary(functions: Iterable[Any], emit: Emit, result: Any = None) -> None:
    """emit(context, builder, x, y, type): the code for these functions of two numbers, one of which is dual at least."""

    def of_two(context: Any, b: Any, args: Any, kinds: Any, kind: Dual) -> Any:
        x, y = _operands(b, args, kinds, kind)
        return emit(context, b, x, y, kind)

    for function in functions:
        OF_TWO[function] = result
        define(Dual, function, [2], of_two, result)


def _add(context: Any, b: Any, x: Operand, y: Operand, kind: Dual) -> Any:
    return b.fadd(x.dual, y.dual)


def _subtract(context: Any, b: Any, x: Operand, y: Operand, kind: Dual) -> Any:
    return b.fsub(x.dual, y.dual)


def _multiply(context: Any, b: Any, x: Operand, y: Operand, kind: Dual) -> Any:
    if not (x.is_dual and y.is_dual):
        return b.fmul(x.factor, y.factor)
    product = b.fmul(x.given, _lane_0_everywhere(b, y.given, kind))
    slopes = _multiply_add(b, _lane_0_everywhere(b, x.given, kind), y.given, product, kind)
    return _joined(b, product, slopes, kind)


def _square(b: Any, x: Any, kind: Dual) -> Any:
    return _multiply(None, b, Operand(b, x, kind, kind), Operand(b, x, kind, kind), kind)


def _divide(context: Any, b: Any, x: Operand, y: Operand, kind: Dual) -> Any:
    value, share = b.fdiv(x.value, y.value), b.fdiv(ONE, y.value)
    if not y.is_dual:
        return _scaled(b, x.given, value, share, kind)
    if not x.is_dual:
        return _scaled(b, y.given, value, b.fneg(b.fmul(value, share)), kind)
    slopes = _multiply_add(b, spread(b, b.fneg(value), kind), y.given, x.given, kind)
    return _scaled(b, slopes, value, share, kind)


def _by_slopes(rule: Callable[..., tuple[Any, Any, Any]]) -> Emit:
    """rule(call, b, x, y) -> (value, slope along x, slope along y); call(function, ...) is that of doubles."""

    def emit(context: Any, b: Any, x: Operand, y: Operand, kind: Dual) -> Any:
        value, *slopes = rule(_call(context, b), b, x.value, y.value)
        total = ir.Constant(kind.vector, [0.0] * (kind.n + 1))
        for operand, slope in zip((x, y), slopes, strict=True):
            if operand.is_dual:
                total = _multiply_add(b, operand.given, spread(b, slope, kind), total, kind)
        return with_value(b, total, value)

    return emit


def _call(context: Any, b: Any) -> Any:
    def call(function: Any, *values: Any) -> Any:
        return context.get_function(function, signature(_F, *(_F for _ in values)))(b, values)

    return call


def _power(context: Any, b: Any, x: Operand, y: Operand, kind: Dual) -> Any:
    """y x^(y - 1) along x, log x x^y along y. A real exponent is known to the compiler mostly, another one's power is not found twice."""
    call = _call(context, b)
    value = call(operator.pow, x.value, y.value)
    total = ir.Constant(kind.vector, [0.0] * (kind.n + 1))
    if x.is_dual:
        along = b.fdiv(value, x.value) if y.is_dual else call(operator.pow, x.value, b.fsub(y.value, ONE))
        along = b.fmul(y.value, along)
        if y.is_dual:
            at_zero = b.select(b.fcmp_ordered("==", y.value, ONE), ONE, ZERO)
            along = b.select(b.fcmp_ordered("==", x.value, ZERO), at_zero, along)
        total = b.fmul(x.given, spread(b, _finite(b, along), kind))
    if y.is_dual:
        along = _finite(b, b.fmul(value, call(math.log, x.value)))
        total = _multiply_add(b, y.given, spread(b, along, kind), total, kind)
    return with_value(b, total, value)


def _polar_angle(call: Any, b: Any, y: Any, x: Any) -> tuple[Any, Any, Any]:
    square = b.fadd(b.fmul(x, x), b.fmul(y, y))
    return call(math.atan2, y, x), _finite(b, b.fdiv(x, square)), _finite(b, b.fneg(b.fdiv(y, square)))


def _hypotenuse(call: Any, b: Any, x: Any, y: Any) -> tuple[Any, Any, Any]:
    value = call(math.hypot, x, y)
    return value, _finite(b, b.fdiv(x, value)), _finite(b, b.fdiv(y, value))


def _copy_sign(call: Any, b: Any, x: Any, y: Any) -> tuple[Any, Any, Any]:
    return call(math.copysign, x, y), call(math.copysign, call(math.copysign, ONE, x), b.fmul(x, y)), ZERO


def _remainder(call: Any, b: Any, x: Any, y: Any) -> tuple[Any, Any, Any]:
    return call(operator.mod, x, y), ONE, b.fneg(call(np.floor, b.fdiv(x, y)))


def _comparison(symbol: str) -> Emit:
    def emit(context: Any, b: Any, x: Operand, y: Operand, kind: Dual) -> Any:
        return (b.fcmp_unordered if symbol == "!=" else b.fcmp_ordered)(symbol, x.value, y.value)

    return emit


def _choice(symbol: str) -> Emit:
    """The second where it compares so with the first, or is no number."""

    def emit(context: Any, b: Any, x: Operand, y: Operand, kind: Dual) -> Any:
        second = b.or_(b.fcmp_ordered(symbol, y.value, x.value), b.fcmp_unordered("uno", y.value, y.value))
        return b.select(second, y.dual, x.dual)

    return emit


_binary((operator.add, operator.iadd), _add)
_binary((operator.sub, operator.isub), _subtract)
_binary((operator.mul, operator.imul), _multiply)
_binary((operator.truediv, operator.itruediv), _divide)
_binary((operator.pow, operator.ipow, pow, math.pow, np.power), _power)
_binary((operator.mod, operator.imod, np.remainder), _by_slopes(_remainder))
_binary((math.atan2, np.arctan2), _by_slopes(_polar_angle))
_binary((math.hypot, np.hypot), _by_slopes(_hypotenuse))
_binary((math.copysign, np.copysign), _by_slopes(_copy_sign))
_binary((np.maximum,), _choice(">"))
_binary((np.minimum,), _choice("<"))
SYMBOLS = {"lt": "<", "le": "<=", "gt": ">", "ge": ">=", "eq": "==", "ne": "!="}
for _name, _symbol in SYMBOLS.items():
    _binary((getattr(operator, _name),), _comparison(_symbol), types.boolean)


# numbers that `max` and `min` take at most; more than two are compared one after the other
MOST = 5


def _of_many(function: Any, symbol: str) -> None:
    def emit(context: Any, b: Any, args: Any, kinds: Any, kind: Dual) -> Any:
        found, *others = _operands(b, args, kinds, kind)
        for each in others:
            further = b.fcmp_ordered(symbol, each.value, found.value)
            found = Operand(b, b.select(further, each.dual, found.dual), kind, kind)
        return found.given

    define(Dual, function, range(2, MOST + 1), emit, None)


_of_many(max, ">")
_of_many(min, "<")


# --- functions of one ---


def _unary(functions: Iterable[Any], emit: Callable[[Any, Any, Any, Dual], Any], result: Any = None) -> None:
    """emit(context, builder, x, type): the code for these functions of a dual number."""
    for function in functions:
        OF_ONE[function] = result
        define(Dual, function, [1], lambda context, b, args, kinds, kind: emit(context, b, args[0], kind), result)


def _smooth(functions: Iterable[Any], rule: Callable[..., tuple[Any, Any]]) -> None:
    """rule(call, b, x) -> (value, slope)."""

    def emit(context: Any, b: Any, x: Any, kind: Dual) -> Any:
        return _scaled(b, x, *rule(_call(context, b), b, value_of(b, x)), kind)

    _unary(functions, emit)


def _stepped(functions: Iterable[Any]) -> None:
    """Functions that are constant between their steps."""
    for function in functions:

        def emit(context: Any, b: Any, x: Any, kind: Dual, function: Any = function) -> Any:
            return constant(b, _call(context, b)(function, value_of(b, x)), kind)

        _unary((function,), emit)


def _sine(call: Any, b: Any, x: Any) -> tuple[Any, Any]:
    return call(math.sin, x), call(math.cos, x)


def _cosine(call: Any, b: Any, x: Any) -> tuple[Any, Any]:
    return call(math.cos, x), b.fneg(call(math.sin, x))


def _tangent(call: Any, b: Any, x: Any) -> tuple[Any, Any]:
    value = call(math.tan, x)
    return value, b.fadd(ONE, b.fmul(value, value))


def _root(call: Any, b: Any, x: Any) -> tuple[Any, Any]:
    value = call(math.sqrt, x)
    return value, _finite(b, b.fdiv(ir.Constant(_DOUBLE, 0.5), value))


def _exponential(call: Any, b: Any, x: Any) -> tuple[Any, Any]:
    value = call(math.exp, x)
    return value, value


def _logarithm(function: Any, base: float) -> Any:
    factor = ir.Constant(_DOUBLE, 1.0 / math.log(base))
    return lambda call, b, x: (call(function, x), _finite(b, b.fdiv(factor, x)))


def _root_of_square(function: Any, sign: float, *, plus: bool, less: bool = False) -> Any:
    """±1/√(1 - x²), 1/√(x² + 1) or 1/√(x² - 1)."""

    def rule(call: Any, b: Any, x: Any) -> tuple[Any, Any]:
        square = b.fmul(x, x)
        under = b.fadd(square, ONE) if plus else (b.fsub(square, ONE) if less else b.fsub(ONE, square))
        return call(function, x), _finite(b, b.fdiv(ir.Constant(_DOUBLE, sign), call(math.sqrt, under)))

    return rule


def _share_of_square(function: Any, *, plus: bool) -> Any:
    """1/(1 ± x²)."""

    def rule(call: Any, b: Any, x: Any) -> tuple[Any, Any]:
        square = b.fmul(x, x)
        return call(function, x), _finite(b, b.fdiv(ONE, b.fadd(ONE, square) if plus else b.fsub(ONE, square)))

    return rule


def _hyperbolic_tangent(call: Any, b: Any, x: Any) -> tuple[Any, Any]:
    value = call(math.tanh, x)
    return value, b.fsub(ONE, b.fmul(value, value))


def _error_function(call: Any, b: Any, x: Any) -> tuple[Any, Any]:
    height = ir.Constant(_DOUBLE, 2.0 / math.sqrt(math.pi))
    return call(math.erf, x), b.fmul(height, call(math.exp, b.fneg(b.fmul(x, x))))


def _proportional(function: Any, factor: float) -> Any:
    return lambda call, b, x: (call(function, x), ir.Constant(_DOUBLE, factor))


_smooth((np.sin, math.sin), _sine)
_smooth((np.cos, math.cos), _cosine)
_smooth((np.tan, math.tan), _tangent)
_smooth((np.sqrt, math.sqrt), _root)
_smooth((np.exp, math.exp), _exponential)
_smooth((np.expm1, math.expm1), lambda call, b, x: (call(math.expm1, x), call(math.exp, x)))
_smooth((np.log, math.log), _logarithm(math.log, math.e))
_smooth((np.log10, math.log10), _logarithm(math.log10, 10.0))
_smooth((np.log2,), _logarithm(np.log2, 2.0))
_smooth((np.log1p, math.log1p), lambda call, b, x: (call(math.log1p, x), _finite(b, b.fdiv(ONE, b.fadd(ONE, x)))))
_smooth((np.arcsin, math.asin), _root_of_square(math.asin, 1.0, plus=False))
_smooth((np.arccos, math.acos), _root_of_square(math.acos, -1.0, plus=False))
_smooth((np.arctan, math.atan), _share_of_square(math.atan, plus=True))
_smooth((np.sinh, math.sinh), lambda call, b, x: (call(math.sinh, x), call(math.cosh, x)))
_smooth((np.cosh, math.cosh), lambda call, b, x: (call(math.cosh, x), call(math.sinh, x)))
_smooth((np.tanh, math.tanh), _hyperbolic_tangent)
_smooth((np.arcsinh, math.asinh), _root_of_square(math.asinh, 1.0, plus=True))
_smooth((np.arccosh, math.acosh), _root_of_square(math.acosh, 1.0, plus=False, less=True))
_smooth((np.arctanh, math.atanh), _share_of_square(math.atanh, plus=False))
_smooth((math.erf,), _error_function)
_smooth((np.radians, np.deg2rad, math.radians), _proportional(math.radians, math.pi / 180.0))
_smooth((np.degrees, np.rad2deg, math.degrees), _proportional(math.degrees, 180.0 / math.pi))
_stepped((np.sign, np.floor, np.ceil, np.trunc))
_unary((operator.neg,), lambda context, b, x, kind: b.fneg(x))
_unary((operator.pos, float), lambda context, b, x, kind: x)
_unary((np.square,), lambda context, b, x, kind: _square(b, x, kind))
_unary((np.real,), lambda context, b, x, kind: value_of(b, x), _F)
_unary((np.imag,), lambda context, b, x, kind: ZERO, _F)
_unary((int,), lambda context, b, x, kind: context.cast(b, value_of(b, x), _F, types.int64), types.int64)
_unary((bool,), lambda context, b, x, kind: b.fcmp_unordered("!=", value_of(b, x), ZERO), types.boolean)
_unary((operator.not_,), lambda context, b, x, kind: b.fcmp_ordered("==", value_of(b, x), ZERO), types.boolean)


def _absolute(context: Any, b: Any, x: Any, kind: Dual) -> Any:
    return b.select(b.fcmp_ordered("<", value_of(b, x), ZERO), b.fneg(x), x)


_unary((np.abs, abs, math.fabs), _absolute)


def _of_value(functions: Iterable[Any], result: Any) -> None:
    """Functions of the value alone."""
    for function in functions:

        def emit(context: Any, b: Any, x: Any, kind: Dual, function: Any = function) -> Any:
            return context.get_function(function, signature(result, _F))(b, [value_of(b, x)])

        _unary((function,), emit, result)


_of_value((np.isnan, math.isnan, np.isfinite, math.isfinite, np.isinf, math.isinf), types.boolean)
_of_value((math.floor, math.ceil, math.trunc), types.int64)


# types that `np.int64` takes besides those of Numba
HAVE_WHOLE_PARTS: list[type] = [Dual]


@infer_getattr
class Int64Calls(AttributeTemplate):
    """`np.int64(x)` is the whole part of the value; of other numbers it is what Numba takes it for."""

    key = types.NumberClass(types.int64)

    def resolve___call__(self, kind: Any) -> Any:
        """What `np.int64` is called with, and gives."""
        known: Any = NumberClassAttribute(self.context)
        usual = known.resolve___call__(kind)

        class Template(AbstractTemplate):
            key = kind

            def generic(self, args: Any, kws: Any) -> Any:
                if len(args) == 1 and isinstance(args[0], tuple(HAVE_WHOLE_PARTS)):
                    return signature(types.int64, args[0])
                return usual.get_call_type(self.context, args, kws)

        return types.Function(Template)


lower_builtin(types.NumberClass, Dual)(
    lambda context, b, sig, args: context.cast(b, value_of(b, args[0]), _F, types.int64)
)


@infer_getattr
class DualAttributes(AttributeTemplate):
    """The real part is the value."""

    key = Dual

    def resolve_real(self, kind: Dual) -> Any:
        """Type of `x.real`."""
        return _F


@lower_getattr(Dual, "real")
def _real_part(context: Any, b: Any, kind: Dual, x: Any) -> Any:
    return value_of(b, x)


# --- what laws call besides ---


@overload(np.interp)
def _interp(x: Any, xp: Any, fp: Any) -> Any:
    if not isinstance(x, Dual):
        return None

    def by_pieces(x: Any, xp: Any, fp: Any) -> Any:
        last = len(xp) - 1
        if x.real <= xp[0]:
            return 0.0 * x + fp[0]
        if x.real >= xp[last]:
            return 0.0 * x + fp[last]
        k = np.searchsorted(xp, x.real, side="right") - 1
        return fp[k] + (fp[k + 1] - fp[k]) / (xp[k + 1] - xp[k]) * (x - xp[k])

    return by_pieces


@overload(np.clip)
def _clip(x: Any, least: Any, most: Any) -> Any:
    if not any(isinstance(each, Dual) for each in (x, least, most)):
        return None

    def between(x: Any, least: Any, most: Any) -> Any:
        return min(max(x, least), most)

    return between


# --- for kernels, see `nivel.kernels.core.lanes` ---


def _lane(b: Any, k: Any) -> Any:
    place = b.trunc(k, _I32) if k.type.width > 32 else k
    return b.add(place, ir.Constant(_I32, 1))


@intrinsic
def unit(typingctx: Any, k: Any, size: Any) -> Any:
    """0 with the slope `size` along direction k."""

    def generate(context: Any, b: Any, sig: Any, args: Any) -> Any:
        return b.insert_element(ir.Constant(DUAL.vector, [0.0] * (DUAL.n + 1)), args[1], _lane(b, args[0]))

    return DUAL(k, _F), generate


@intrinsic
def slope(typingctx: Any, x: Any, k: Any) -> Any:
    """The slope of x along direction k; of a real number none."""
    if not isinstance(x, Dual):
        return _F(x, k), lambda context, b, sig, args: ZERO
    return _F(x, k), lambda context, b, sig, args: b.extract_element(args[0], _lane(b, args[1]))
