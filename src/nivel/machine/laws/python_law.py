"""A Python function as a value that varies. Its text is checked by its syntax tree only: nothing is run here."""

import ast
import builtins
import inspect
import sys
import textwrap
import warnings
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from numbers import Real
from types import FunctionType, ModuleType
from typing import Any, Final

from pydantic import ValidationError
from pydantic_core import InitErrorDetails

from nivel.errors import ModelError
from nivel.machine.core.record import unknown_word
from nivel.machine.units import quantity
from nivel.machine.units.tree import TIME, ExpressionError, Parameters, Signal, Time, varies
from nivel.words.arguments import checked_arguments, checked_fields

# The text of a Python function together with what it uses, so that it can be compiled elsewhere.

# Modules that a law may import by name; functions of all other modules come along as text.
_LIBRARIES: Final = frozenset({"numpy", "scipy", "numba", *sys.stdlib_module_names} - {"__main__"})


def source_of(function: Callable[..., Any]) -> str:
    """The text of a Python file that defines `function`: imports, numbers, the functions it uses, itself.

    Raises ModelError where there is no text, or where the function uses something that cannot be written down.
    """
    head: dict[str, str] = {}
    bodies: dict[str, str] = {}
    _collect(function, head, bodies)
    numbers = [line for line in head.values() if " = " in line]
    imports = ["from __future__ import annotations", *(line for line in head.values() if line not in numbers)]
    return "\n\n".join(["\n".join([*imports, *numbers]), *bodies.values()])


def _collect(function: Callable[..., Any], head: dict[str, str], bodies: dict[str, str]) -> None:
    """Put the text of `function` into `bodies`, after that of what it uses."""
    plain = inspect.unwrap(function)
    name = getattr(plain, "__name__", str(plain))
    if not isinstance(plain, FunctionType) or name == "<lambda>":
        raise ModelError(f"`{name}` is not a function made with `def`; a law in Python must be one")
    if plain.__code__.co_freevars:
        outer = plain.__code__.co_freevars[0]
        raise ModelError(f"the law `{name}` uses `{outer}` of the function around it; hand it over as an argument")
    try:
        text = textwrap.dedent(inspect.getsource(plain)).rstrip() + "\n"
    except (OSError, TypeError):
        message = f"the text of `{name}` cannot be found; keep it in a file, or write `PythonLaw(source=…, function=…)`"
        raise ModelError(message) from None
    bodies[name] = ""  # a function that uses itself is not collected again
    for used in sorted(_global_names(text, plain)):
        _collect_used(used, plain, head, bodies)
    del bodies[name]
    bodies[name] = text


def _global_names(text: str, function: FunctionType) -> set[str]:
    """Names in the text of `function` that it finds outside of itself; those in annotations do not count."""
    loaded, own = set[str](), set[str]()
    for node in ast.walk(_without_annotations(ast.parse(text))):
        match node:
            case ast.Name(name, ast.Load()):
                loaded.add(name)
            case ast.Name(name, _) | ast.arg(name):
                own.add(name)
    return {name for name in loaded - own if name in function.__globals__}


def _without_annotations(tree: ast.Module) -> ast.Module:
    for node in ast.walk(tree):
        match node:
            case ast.arg():
                node.annotation = None
            case ast.FunctionDef():
                node.returns = None
            case ast.AnnAssign():
                node.annotation = ast.Constant(None)
    return tree


def _collect_used(name: str, user: FunctionType, head: dict[str, str], bodies: dict[str, str]) -> None:
    """Put what `name` means to `user` into `head` or `bodies`."""
    value = user.__globals__[name]
    if name in bodies or value is getattr(builtins, name, None):
        return
    plain = inspect.unwrap(value) if callable(value) else value
    module = str(getattr(plain, "__module__", "") or "")
    if isinstance(value, ModuleType) and _is_library(value.__name__):
        line = f"import {value.__name__} as {name}" if name != value.__name__ else f"import {name}"
    elif _is_number(value) or (isinstance(value, tuple) and value and all(map(_is_number, value))):
        line = f"{name} = {_literal(value)}"
    elif isinstance(plain, FunctionType) and not _is_library(module):
        if plain.__name__ != name:
            raise ModelError(f"the law uses the function `{plain.__name__}` as `{name}`; use it by its own name")
        _collect(plain, head, bodies)
        return
    elif callable(value) and _is_library(_home(name, value)):
        line = f"from {_home(name, value)} import {value.__name__}"
        line += f" as {name}" if name != value.__name__ else ""
    else:
        raise ModelError(
            f"the law `{user.__name__}` uses `{name}`, which stands outside of it; hand it over as an argument"
        )
    if head.setdefault(name, line) != line:
        raise ModelError(f"`{name}` means different things to the functions that the law uses; rename one")


def _home(name: str, value: Any) -> str:
    """The module that a function is imported from; numpy's compiled functions do not know theirs."""
    module = str(getattr(value, "__module__", "") or "")
    return "numpy" if not module and type(value).__module__ == "numpy" else module


def _is_library(module: str) -> bool:
    return module.partition(".")[0] in _LIBRARIES


def _is_number(value: object) -> bool:
    return isinstance(value, Real)


def _literal(value: Any) -> str:
    """Python's spelling of a number or of a tuple of numbers, whatever type they have."""
    if isinstance(value, tuple):
        return f"({', '.join(map(_literal, value))},)"
    return repr(value) if isinstance(value, int) else repr(float(value))


KEYS: Final = ("source", "function", "arguments", "file")


@checked_fields
@dataclass(frozen=True)
class PythonLaw:
    """The value that a Python function returns, SI.

    source : text of the Python file, compiled before the run; it may import math and numpy
    function : name of the function, defined at the top level of `source`
    arguments : what it is called with: ``"time"`` [s], the path of a signal (``"hinge.angle_rate"``) or a number, SI.
        They may be texts with units until the law stands in a record.
    file : name of the file that `source` came from, for messages

    A law that drives a coordinate returns three numbers: the value, its rate and its acceleration.
    """

    source: str
    function: str
    arguments: tuple[Any, ...] = ()
    file: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "arguments", tuple(quantity.listed(self.arguments)))

    @classmethod
    @checked_arguments
    def of(cls, function: Callable[..., Any], arguments: Sequence[object] = ()) -> "PythonLaw":
        """The law that a function of this program is. Modules, numbers and functions that it uses go with it.

        Raises ModelError where its text cannot be had, or where it uses something else that stands outside of it.
        """
        return cls(source_of(function), function.__name__, arguments)  # type: ignore[arg-type]

    @property
    def signals(self) -> tuple[str, ...]:
        """The paths of the signals among the arguments, each once."""
        return tuple(dict.fromkeys(entry for entry in self.arguments if isinstance(entry, str) and entry != TIME))

    def written(self) -> dict[str, Any]:
        """The law as a mapping of a machine file that holds the text itself."""
        return {"source": self.source, "function": self.function, "arguments": list(self.arguments), "file": self.file}


def read_python_law(
    given: PythonLaw | Mapping[str, object],
    parameters: Parameters,
    local: Collection[str] = (),
    *,
    results: int | None = 1,
) -> PythonLaw:
    """`given` as a law, its arguments in SI. `results` is the count of numbers that it has to return, if that is known.

    Raises ValidationError with all faults and their places.
    """
    if isinstance(given, PythonLaw):
        given = given.written()
    lines = [_line((word,), text, at_key=True) for word, text in _faults_of_keys(given)]
    arguments = _read_arguments(quantity.listed(given.get("arguments", ())), parameters, local, lines)
    source, function, file = given.get("source"), given.get("function"), given.get("file", "")
    for word, value in (("function", function), ("file", file)):
        if not isinstance(value, str):
            message = f"`{word}` is missing" if value is None else f"a text was expected, got {quantity.shown(value)}"
            lines.append(_line((word,), message))
    if "source" in given and not isinstance(source, str):
        lines.append(_line(("source",), f"the text of a Python file was expected, got {quantity.shown(source)}"))
    if isinstance(source, str) and isinstance(function, str) and isinstance(file, str):
        lines += [_line((word,), text) for word, text in _faults_of_text(source, function, file, arguments, results)]
    if lines:
        raise ValidationError.from_exception_data("PythonLaw", lines)
    return PythonLaw(str(source), str(function), tuple(arguments), str(file))


def _faults_of_keys(given: Mapping[str, object]) -> Iterator[tuple[str, str]]:
    for word in given:
        if word == "python" and "source" not in given:
            yield (
                "python",
                "a law in Python needs its text, which is read together with a machine file;"
                " in a program write `PythonLaw.of(function, arguments=[…])` or give `source`",
            )
        elif word not in KEYS:
            yield str(word), unknown_word(str(word), KEYS, "key")
    if "source" not in given and "python" not in given:
        yield "source", "`source` is missing"


def _read_arguments(
    given: object, parameters: Parameters, local: Collection[str], lines: list[InitErrorDetails]
) -> list[str | float]:
    if not isinstance(given, Sequence) or isinstance(given, str):
        lines.append(_line(("arguments",), f"a list was expected, got {quantity.shown(given)}"))
        return []
    arguments: list[str | float] = []
    for at, entry in enumerate(given):
        try:
            arguments.append(_read_argument(entry, parameters, local))
        except quantity.UNREAD as problem:
            lines.append(quantity.line_of(("arguments", at), quantity.unread(problem, entry, parameters)))
            arguments.append(0.0)
    return arguments


def _read_argument(entry: object, parameters: Parameters, local: Collection[str]) -> str | float:
    if isinstance(entry, str):
        tree = quantity.bound_tree(entry, parameters, local)
        match tree:
            case Time():
                return TIME
            case Signal(path):
                return path
        if varies(tree):
            raise ExpressionError("an argument is `time`, one symbol or a number; compute with them in the function")
    return quantity.read_quantity(entry, quantity.ANY, parameters)


def _faults_of_text(
    source: str, function: str, file: str, arguments: Sequence[object], results: int | None
) -> Iterator[tuple[str, str]]:
    """What is wrong with the text or with the call: (key, message)."""
    place = f"`{file}`" if file else "the Python text"
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            module = ast.parse(source)
    except SyntaxError as problem:
        yield "source", f"{place}, line {problem.lineno}: this is not Python: {problem.msg}"
        return
    except (ValueError, RecursionError, MemoryError) as problem:
        yield "source", f"{place} is not Python: {problem}"
        return
    defined = {part.name: part for part in module.body if isinstance(part, ast.FunctionDef)}
    if function not in defined:
        hint = unknown_word(function, list(defined), "function").partition("; ")[2]
        yield "function", f"{place} does not define a function `{function}` at its top level; {hint}"
        return
    for part in ast.walk(module):
        if isinstance(part, ast.Raise | ast.Assert | ast.Try):
            word = {ast.Raise: "raise", ast.Assert: "assert", ast.Try: "try"}[type(part)]
            message = f"{place}, line {part.lineno}: compiled code knows no `{word}`; return `math.nan` to stop the run"
            yield "source", message
    yield from _faults_of_call(defined[function], len(arguments))
    if results is not None:
        yield from _faults_of_results(defined[function], results)


def _faults_of_call(function: ast.FunctionDef, count: int) -> Iterator[tuple[str, str]]:
    """The function must take `count` arguments by position, no fewer and no more."""
    parameters = function.args
    names = [one.arg for one in (*parameters.posonlyargs, *parameters.args)]
    for more, star in ((parameters.vararg, "*"), (parameters.kwarg, "**")):
        if more is not None:
            yield "function", f"`{function.name}` takes `{star}{more.arg}`; a law has a fixed number of arguments"
            return
    if parameters.kwonlyargs:
        word = parameters.kwonlyargs[0].arg
        yield "function", f"`{function.name}` takes `{word}` by keyword only; the arguments of a law have no names"
        return
    if len(names) != count:
        takes = f"{len(names)} argument{'s' if len(names) != 1 else ''}"
        listing = f" ({', '.join(names)})" if names else ""
        yield "arguments", f"`{function.name}` takes {takes}{listing}; `arguments` has {count}"


def _faults_of_results(function: ast.FunctionDef, count: int) -> Iterator[tuple[str, str]]:
    """What can be seen of the results without running the function: none at all, or lists of another length."""
    wanted = "one number" if count == 1 else "three numbers, (value, rate, acceleration),"
    results = [found.value for found in _returns(function) if found.value is not None]
    if not results:
        yield "function", f"`{function.name}` returns nothing; {wanted} must be returned"
    for result in results:
        got = _count(result)
        if got not in (None, count):
            returned = f"{got} number{'s' if got != 1 else ''} in line {result.lineno}"
            yield "function", f"`{function.name}` returns {returned}; {wanted} must be returned"
            return


def returned_count(law: PythonLaw) -> int | None:
    """How many numbers a law returns, where that can be seen in its text."""
    for part in ast.parse(law.source).body:
        if isinstance(part, ast.FunctionDef) and part.name == law.function:
            counts = [_count(found.value) for found in _returns(part) if found.value is not None]
            return next((count for count in counts if count is not None), None)
    return None


def _count(result: ast.expr) -> int | None:
    """How many numbers an expression is, where that can be seen."""
    match result:
        case ast.Tuple(entries) | ast.List(entries):
            return None if any(isinstance(entry, ast.Starred) for entry in entries) else len(entries)
        case ast.Constant() | ast.BinOp() | ast.UnaryOp():
            return 1
    return None


def _returns(node: ast.AST) -> Iterator[ast.Return]:
    """The `return`s of a function, not those of functions in it."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.Return):
            yield child
        elif not isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda | ast.ClassDef):
            yield from _returns(child)


def _line(place: tuple[str | int, ...], message: str, *, at_key: bool = False) -> InitErrorDetails:
    return quantity.line_of(place, quantity.fault(message, at_key=at_key))
