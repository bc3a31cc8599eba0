"""Arguments of public functions, held against the types that stand in their signatures.

What does not fit, is missing, or is no argument at all is told at once, as faults of a ModelError with the name of the argument.
NumPy scalars stand for the numbers that they are. Numbers out of range, and what is inside of records, are left to those who read them.
"""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import cache, reduce, wraps
from inspect import Parameter, Signature, signature
from numbers import Integral, Real
from operator import or_
from os import PathLike
from sys import float_info
from types import FunctionType, NoneType, UnionType
from typing import Any, Final, Literal, ParamSpec, TypeVar, Union, get_args, get_origin, get_type_hints, is_typeddict

from nivel.errors import Fault, refuse
from nivel.lazy import Struct
from nivel.words.wording import shown, unknown_word

Given = ParamSpec("Given")
Result = TypeVar("Result")

UNNAMED: Final = (Parameter.POSITIONAL_ONLY, Parameter.POSITIONAL_OR_KEYWORD)
NAMED: Final = (Parameter.KEYWORD_ONLY, Parameter.POSITIONAL_OR_KEYWORD)
WORDS: Final[Mapping[object, str]] = {
    bool: "true or false",
    int: "a whole number",
    float: "a number",
    str: "a text",
    PathLike: "the name of a file",
    Mapping: "a mapping with texts as keys",
    Callable: "a function",
    slice: "a slice",
}
PLURALS: Final[Mapping[object, str]] = {int: "whole numbers", float: "numbers", str: "texts"}
TEXTS: Final = (str, bytes, bytearray)


def checked_arguments(function: Callable[Given, Result]) -> Callable[Given, Result]:
    """`function`, called only with arguments that fit its signature. Raises ModelError with a fault for each that does not."""

    @wraps(function)
    def call(*args: Given.args, **kwargs: Given.kwargs) -> Result:
        given, named = tuple(map(plain, args)), {name: plain(value) for name, value in kwargs.items()}
        refuse(_faults(function, given, named))
        return function(*given, **named)  # type: ignore[arg-type]

    if (its := _unpacked(function)) != signature(function):
        call.__signature__ = its  # type: ignore[attr-defined]
    return call


def _unpacked(function: Any) -> Signature:
    """The signature of a function, in which the keys of a mapping stand in place of `**settings: Unpack[…]`, before other keywords.

    Words of settings are any texts: who reads settings tells the nearest word.
    """
    its = signature(function)
    its_own = [each for each in its.parameters.values() if each.kind is not Parameter.VAR_KEYWORD]
    told = next((each.annotation for each in its.parameters.values() if each.kind is Parameter.VAR_KEYWORD), "")
    if isinstance(told, str):  # put off
        keys = function.__globals__.get(told.removeprefix("Unpack[").removesuffix("]"))
    else:
        keys = next(iter(get_args(told)), None)
    if not is_typeddict(keys):
        return its
    settings = [
        Parameter(key, Parameter.KEYWORD_ONLY, default=None, annotation=_any_words(kind))
        for key, kind in get_type_hints(keys).items()
    ]
    first = next((k for k, each in enumerate(its_own) if each.kind is Parameter.KEYWORD_ONLY), len(its_own))
    return its.replace(parameters=[*its_own[:first], *settings, *its_own[first:]])


def _any_words(wanted: Any) -> Any:
    """A type in which every choice of words is any text."""
    if get_origin(wanted) is Literal:
        return str
    kinds = _alternatives(wanted)
    if kinds:
        return reduce(or_, map(_any_words, kinds))
    return Sequence[_any_words(get_args(wanted)[0])] if get_origin(wanted) is Sequence else wanted


def checked_methods(made: type[Result]) -> type[Result]:
    """The class `made`, whose own public methods and `__getitem__` are called only with arguments that fit, as of `checked_arguments`."""
    for name, method in tuple(vars(made).items()):
        function = getattr(method, "__func__", method)
        is_called = isinstance(function, FunctionType) and (not name.startswith("_") or name == "__getitem__")
        if is_called and len(signature(function).parameters) > 1:
            checked = checked_arguments(function)
            setattr(made, name, classmethod(checked) if isinstance(method, classmethod) else checked)
    return made


def checked_fields(made: type[Result]) -> type[Result]:
    """The dataclass `made`, whose fields are held against their types when an object of it is made. Raises ModelError."""
    made.__init__ = checked_arguments(made.__init__)
    return made


def plain(value: Any) -> Any:
    """A NumPy scalar, or an array without axes, as the number or truth that it is; anything else as it is."""
    return value.item() if getattr(value, "shape", None) == () and hasattr(value, "dtype") else value


class _Signature(Struct):
    """What calls of a function are held against.

    types : of its parameters. unnamed : names of those that may be given without one; rest : of the one that takes all further ones.
    known : names that may be given. needed : those without a default. open_ended : whether other names are taken too.
    """

    types: Mapping[str, Any]
    unnamed: Sequence[str]
    rest: str | None
    known: Sequence[str]
    needed: Sequence[str]
    open_ended: bool


@cache
def _signature(function: FunctionType) -> _Signature:
    """That of a function. The type of its result may be known to type checkers only."""
    bare = FunctionType(function.__code__, function.__globals__, closure=function.__closure__)
    bare.__annotations__ = {name: each for name, each in function.__annotations__.items() if name != "return"}
    types, parameters = get_type_hints(bare), _unpacked(function).parameters.values()
    settings = [each for each in parameters if each.name not in types and each.annotation is not Parameter.empty]
    types |= {each.name: each.annotation for each in settings}
    return _Signature(
        types,
        [each.name for each in parameters if each.kind in UNNAMED],
        next((each.name for each in parameters if each.kind is Parameter.VAR_POSITIONAL), None),
        [each.name for each in parameters if each.kind in NAMED and each.name in types],
        [each.name for each in parameters if each.default is Parameter.empty and each.kind in (*UNNAMED, *NAMED)],
        any(each.kind is Parameter.VAR_KEYWORD for each in parameters),
    )


def _faults(function: Any, given: tuple[Any, ...], named: dict[str, Any]) -> Iterator[Fault]:
    its = _signature(function)
    types, unnamed = its.types, its.unnamed
    pairs = [*zip(unnamed, given, strict=False), *named.items()]
    if its.rest is not None:
        pairs += [(its.rest, value) for value in given[len(unnamed) :]]
    elif len(given) > len(unnamed):
        few = [name for name in unnamed if name in types]
        taken = f"takes only {' and '.join(few)} without a name" if few else "takes its arguments by name"
        rest = ", ".join(map(shown, given[len(unnamed) :]))
        yield Fault.at("", f"{_title(function, given)} {taken}, got {rest} besides")
    for name, value in pairs:
        if name in types and not _fits(value, types[name]):
            yield Fault.at(name, f"{_expected(types[name])} was expected, got {shown(value)}")
    for name in named:
        if name not in its.known and not its.open_ended:
            yield Fault.at("", f"{_title(function, given)}: {unknown_word(name, its.known, 'argument')}")
        elif name in unnamed[: len(given)]:
            yield Fault.at(name, f"{_title(function, given)} is given this twice, with its name and without")
    there = {name for name, _ in pairs}
    for name in its.needed:
        if name not in there:
            yield Fault.at(name, f"{_title(function, given)} needs this: {_expected(types.get(name, Any))}")


def _title(function: Any, given: tuple[Any, ...]) -> str:
    """The name by which a function is called: that of the class of what it makes, where it makes an object."""
    return type(given[0]).__name__ if function.__name__ == "__init__" else function.__name__


def _fits(value: object, wanted: Any) -> bool:
    """Whether `value` is of the type `wanted`."""
    alternatives = _alternatives(wanted)
    if alternatives:
        return any(_fits(value, each) for each in alternatives)
    kind = get_origin(wanted) or wanted
    if wanted is Any:
        return True
    if kind is Literal:
        return isinstance(value, str) and value in get_args(wanted)
    if kind is int:
        return isinstance(value, Integral) and not isinstance(value, bool)
    if kind is float:
        too_large = isinstance(value, Integral) and abs(int(value)) > float_info.max
        return isinstance(value, Real) and not isinstance(value, bool) and not too_large
    if _is_list(kind):
        return _fits_entries(value, get_args(wanted))
    return isinstance(value, kind) and (not isinstance(value, Mapping) or _fits_entries([*value], get_args(wanted)))


def _is_list(kind: type) -> bool:
    return issubclass(kind, Collection) and not issubclass(kind, (str, Mapping))


def _fits_entries(value: Any, wanted: tuple[Any, ...]) -> bool:
    """Whether `value` is a list, or an array with axes, of numbers or texts where the first of the types `wanted` are such.

    Entries of other types have readers who tell more about each.
    """
    if getattr(value, "ndim", 0):
        value = value.tolist()
    if not isinstance(value, Sequence) or isinstance(value, TEXTS):
        return False
    return not _plurals(wanted) or all(_fits(plain(each), wanted[0]) for each in value)


def _plurals(wanted: tuple[Any, ...]) -> str:
    """Numbers, texts, or both in words, where the first of the types `wanted` are such; else nothing."""
    kinds = _alternatives(*wanted[:1]) or wanted[:1]
    return " or ".join(PLURALS[kind] for kind in kinds) if all(kind in PLURALS for kind in kinds) else ""


def _alternatives(wanted: Any) -> tuple[Any, ...]:
    """The types of which one must fit, where there are several."""
    return get_args(wanted) if get_origin(wanted) in (Union, UnionType) else ()


def _expected(wanted: Any) -> str:
    """The type `wanted` in words: ``a number or a text``."""
    kinds = [each for each in _alternatives(wanted) or (wanted,) if each not in (None, NoneType)]
    if any((get_origin(each) or each) is PathLike for each in kinds):
        kinds = [each for each in kinds if each is not str]  # as which a name is written
    words = sorted(dict.fromkeys(map(_word, kinds)), key=lambda word: word.startswith("a list"))
    return " or ".join(filter(None, [", ".join(words[:-1]), words[-1]]))


def _word(wanted: Any) -> str:
    kind = get_origin(wanted) or wanted
    if kind in WORDS:
        return WORDS[kind]
    if kind is Literal:
        return " or ".join(f"`{word}`" for word in get_args(wanted))
    if isinstance(kind, type) and _is_list(kind):
        return f"a list of {plurals}" if (plurals := _plurals(get_args(wanted))) else "a list"
    name = getattr(kind, "__name__", "")
    return f"{'an' if name[:1] in 'AEIOU' else 'a'} {name}" if name and wanted is not Any else "a value"
