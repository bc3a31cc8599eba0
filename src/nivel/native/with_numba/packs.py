"""Packs as a number type of Numba: a vector of doubles, one lane for each machine; see `nivel.native.packs`.

A comparison gives a truth for each lane. Where a branch asks for one truth, or an index for one whole number, that of most lanes is taken,
and the others leave.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.datamodel.models import PrimitiveModel
from numba.core.imputils import lower_builtin, lower_cast
from numba.core.typeconv.castgraph import Conversion
from numba.core.typing import templates
from numba.core.typing.templates import AbstractTemplate, AttributeTemplate, infer_getattr, signature
from numba.extending import lower_getattr, register_model

from nivel.native.packs import KEY
from nivel.native.processor import lane_count
from nivel.native.with_numba import duals

LANES = lane_count()
_infer_global: Any = templates.infer_global  # its stubs do not know what it returns
_F = types.float64
_BIT, _I32, _WORD, _DOUBLE = ir.IntType(1), ir.IntType(32), ir.IntType(64), ir.DoubleType()
_NUMBERS, _TRUTHS, _WHOLES = (ir.VectorType(each, LANES) for each in (_DOUBLE, _BIT, _WORD))


class Pack(duals.Vector):
    """A number in each lane."""

    def __init__(self) -> None:
        super().__init__(f"Pack({LANES})", LANES)


class Truths(types.Type):
    """A truth in each lane."""

    def __init__(self) -> None:
        super().__init__(f"Truths({LANES})")

    def can_convert_from(self, typingctx: Any, other: Any) -> Any:
        """A truth is the same in all lanes."""
        return Conversion.promote if isinstance(other, types.Boolean) else None

    def can_convert_to(self, typingctx: Any, other: Any) -> Any:
        """That of most lanes is one truth."""
        return Conversion.safe if isinstance(other, types.Boolean | types.Integer) else None

    def unify(self, typingctx: Any, other: Any) -> Any:
        """With a truth of all lanes it is one of each."""
        return self if isinstance(other, types.Boolean) else None


PACK, TRUTHS = Pack(), Truths()


register_model(Pack)(duals.VectorModel)


@register_model(Truths)
class TruthsModel(PrimitiveModel):
    """A vector."""

    def __init__(self, manager: Any, kind: Truths) -> None:
        super().__init__(manager, kind, _TRUTHS)


# --- lanes ---


def _lanes_of(b: Any, x: Any) -> list[Any]:
    return [b.extract_element(x, ir.Constant(_I32, k)) for k in range(LANES)]


def _together(b: Any, kind: Any, values: Iterable[Any]) -> Any:
    out = ir.Constant(kind, ir.Undefined)
    for k, value in enumerate(values):
        out = b.insert_element(out, value, ir.Constant(_I32, k))
    return out


def _intrinsic(b: Any, name: str, *given: Any) -> Any:
    kind = given[0].type
    function = ir.FunctionType(kind, [kind] * len(given))
    return b.call(cgutils.get_or_insert_function(b.module, function, f"llvm.{name}.v{LANES}f64"), given)


def _bits(b: Any, truths: Any) -> Any:
    """Truths as bits of a word, the first lane lowest."""
    return b.zext(b.bitcast(truths, ir.IntType(LANES)), _WORD)


def _same(b: Any, wholes: Any, first: Any) -> Any:
    """Bits of the lanes that have this whole number."""
    return _bits(b, _together(b, _TRUTHS, (b.icmp_signed("==", each, first) for each in _lanes_of(b, wholes))))


def _settled(module: Any, name: str, kind: Any, choose: Callable[[Any, Any, Any], tuple[Any, Any]]) -> Any:
    """A function of its own, seldom called. choose(builder, argument, lanes left) -> (what is settled on, lanes that agree)."""
    if name in module.globals:
        return module.globals[name]
    function = ir.Function(module, ir.FunctionType(_BIT if kind == _TRUTHS else _WORD, [kind]), name)
    function.linkage = "linkonce_odr"
    function.attributes.add("noinline")
    b = ir.IRBuilder(function.append_basic_block())
    key = module.globals.get(KEY) or ir.GlobalVariable(module, _I32, KEY)
    pointer = ir.FunctionType(ir.IntType(8).as_pointer(), [_I32])
    place = b.call(cgutils.get_or_insert_function(module, pointer, "pthread_getspecific"), [b.load(key)])
    place = b.bitcast(place, _WORD.as_pointer())
    found, agree = choose(b, function.args[0], left := b.load(place))
    b.store(b.and_(left, agree), place)
    b.ret(found)
    return function


def _by_most(b: Any, truths: Any, left: Any) -> tuple[Any, Any]:
    yes = _bits(b, truths)
    no = b.not_(yes)
    more = b.icmp_unsigned(">=", b.ctpop(b.and_(yes, left)), b.ctpop(b.and_(no, left)))
    return more, b.select(more, yes, no)


def _by_first(b: Any, wholes: Any, left: Any) -> tuple[Any, Any]:
    first = b.extract_element(wholes, b.trunc(b.cttz(left, _BIT(1)), _I32))
    return first, _same(b, wholes, first)


def _by_any(b: Any, truths: Any, left: Any) -> tuple[Any, Any]:
    return b.icmp_unsigned("!=", b.and_(_bits(b, truths), left), _WORD(0)), left


def _agreed(b: Any, same: Any, usual: Any, function: Any, given: Any) -> Any:
    """The usual one where all lanes have it, else what the function settles on."""
    before = b.block
    with b.if_then(b.not_(same), likely=False):
        other = b.call(function, [given])
        aside = b.block
    out = b.phi(usual.type)
    out.add_incoming(usual, before)
    out.add_incoming(other, aside)
    return out


def one_truth(b: Any, truths: Any) -> Any:
    """That of most lanes; those that do not agree leave."""
    return _truth(b, truths, _settled(b.module, "nivel_one_truth", _TRUTHS, _by_most))


def some_truth(b: Any, truths: Any) -> Any:
    """Whether it holds in a lane that has not left."""
    return _truth(b, truths, _settled(b.module, "nivel_some_truth", _TRUTHS, _by_any))


def _truth(b: Any, truths: Any, function: Any) -> Any:
    narrow = b.bitcast(truths, ir.IntType(LANES))
    none, every = (b.icmp_unsigned("==", narrow, ir.Constant(narrow.type, each)) for each in (0, -1))
    return _agreed(b, b.or_(none, every), every, function, truths)


def one_whole(b: Any, x: Any) -> Any:
    """The whole part of the first lane that has not left; those that do not agree leave."""
    wholes = b.fptosi(x, _WHOLES)
    first = b.extract_element(wholes, ir.Constant(_I32, 0))
    same = b.icmp_unsigned("==", _same(b, wholes, first), _WORD((1 << LANES) - 1))
    return _agreed(b, same, first, _settled(b.module, "nivel_one_whole", _WHOLES, _by_first), wholes)


def _to_pack(context: Any, b: Any, given: Any, wanted: Any, value: Any) -> Any:
    return value if given == PACK else duals.spread(b, context.cast(b, value, given, _F), PACK)


def _to_one(context: Any, b: Any, given: Any, wanted: Any, value: Any) -> Any:
    return context.cast(b, one_truth(b, value), types.boolean, wanted)


for _kind in (types.Float, types.Integer, types.Boolean):
    lower_cast(_kind, Pack)(_to_pack)
for _kind in (types.Boolean, types.Integer):
    lower_cast(Truths, _kind)(_to_one)
lower_cast(types.Boolean, Truths)(lambda context, b, given, wanted, x: _together(b, _TRUTHS, [x] * LANES))


# --- functions ---

Emit = Callable[..., Any]  # (context, builder, one pack for each argument) -> pack, truths, or a whole number


def _function(function: Any, counts: Iterable[int], emit: Emit, result: Any = None) -> None:
    """emit : the code of this function of packs, and doubles, one of which is a pack at least."""

    def of_packs(context: Any, b: Any, args: Any, kinds: Any, kind: Any) -> Any:
        return emit(context, b, *(_to_pack(context, b, given, kind, x) for given, x in zip(kinds, args, strict=True)))

    duals.define(Pack, function, counts, of_packs, TRUTHS if result == types.boolean else result)


def _lane_by_lane(function: Any, result: Any) -> Emit:
    """The function of doubles in each lane."""

    def emit(context: Any, b: Any, *given: Any) -> Any:
        of_doubles = context.get_function(function, signature(result or _F, *(_F for _ in given)))
        lanes = zip(*(_lanes_of(b, each) for each in given), strict=True)
        return _together(b, _TRUTHS if result else _NUMBERS, (of_doubles(b, each) for each in lanes))

    return emit


def _plain(name: str) -> Emit:
    return lambda context, b, *given: getattr(b, name)(*given)


def _vector(name: str) -> Emit:
    return lambda context, b, *given: _intrinsic(b, name, *given)


def _compared(symbol: str) -> Emit:
    return lambda context, b, x, y: (b.fcmp_unordered if symbol == "!=" else b.fcmp_ordered)(symbol, x, y)


def _of_many(symbol: str) -> Emit:
    def emit(context: Any, b: Any, found: Any, *others: Any) -> Any:
        for each in others:
            found = b.select(b.fcmp_ordered(symbol, each, found), each, found)
        return found

    return emit


_OWN: dict[Any, Emit] = {
    **dict.fromkeys((operator.add, operator.iadd), _plain("fadd")),
    **dict.fromkeys((operator.sub, operator.isub), _plain("fsub")),
    **dict.fromkeys((operator.mul, operator.imul), _plain("fmul")),
    **dict.fromkeys((operator.truediv, operator.itruediv), _plain("fdiv")),
    **dict.fromkeys((operator.pow, operator.ipow, pow, math.pow, np.power), _vector("pow")),
    **dict.fromkeys((np.sqrt, math.sqrt), _vector("sqrt")),
    **dict.fromkeys((np.abs, abs, math.fabs), _vector("fabs")),
    np.floor: _vector("floor"),
    **{getattr(operator, name): _compared(symbol) for name, symbol in duals.SYMBOLS.items()},
    operator.neg: _plain("fneg"),
    **dict.fromkeys((operator.pos, float, np.real), lambda context, b, x: x),
    np.imag: lambda context, b, x: ir.Constant(_NUMBERS, [0.0] * LANES),
    np.square: lambda context, b, x: b.fmul(x, x),
    bool: lambda context, b, x: b.fcmp_unordered("!=", x, ir.Constant(_NUMBERS, [0.0] * LANES)),
    operator.not_: lambda context, b, x: b.fcmp_ordered("==", x, ir.Constant(_NUMBERS, [0.0] * LANES)),
    **dict.fromkeys((int, math.trunc), lambda context, b, x: one_whole(b, x)),
    math.floor: lambda context, b, x: one_whole(b, _intrinsic(b, "floor", x)),
    math.ceil: lambda context, b, x: one_whole(b, _intrinsic(b, "ceil", x)),
}
for _count, _table in ((1, duals.OF_ONE), (2, duals.OF_TWO)):
    for _each, _result in _table.items():
        _result = None if _result == _F else _result
        _function(_each, [_count], _OWN.get(_each) or _lane_by_lane(_each, _result), _result)
_function(max, range(2, duals.MOST + 1), _of_many(">"))
_function(min, range(2, duals.MOST + 1), _of_many("<"))


def _of_truths(function: Any, emit: Callable[[Any, Any], Any], result: Any) -> None:
    @_infer_global(function)
    class Template(AbstractTemplate):
        def generic(self, args: Any, kws: Any) -> Any:
            return signature(result, TRUTHS) if args == (TRUTHS,) and not kws else None

    lower_builtin(function, Truths)(lambda context, b, sig, args: emit(b, args[0]))


_of_truths(bool, one_truth, types.boolean)
_of_truths(operator.not_, lambda b, x: b.not_(x), TRUTHS)
_of_truths(int, lambda b, x: b.zext(one_truth(b, x), _WORD), types.int64)


duals.HAVE_WHOLE_PARTS.extend((Pack, Truths))


lower_builtin(types.NumberClass, Pack)(lambda context, b, sig, args: one_whole(b, args[0]))
lower_builtin(types.NumberClass, Truths)(lambda context, b, sig, args: b.zext(one_truth(b, args[0]), _WORD))


@infer_getattr
class PackAttributes(AttributeTemplate):
    """The real part is the pack itself."""

    key = Pack

    def resolve_real(self, kind: Pack) -> Any:
        """Type of `x.real`."""
        return kind


lower_getattr(Pack, "real")(lambda context, b, kind, x: x)
