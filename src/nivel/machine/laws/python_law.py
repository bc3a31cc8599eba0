"""A Python function as a value that varies. Its text is checked by its syntax tree only: nothing is run here."""

import ast
import warnings
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

from pydantic import ValidationError
from pydantic_core import InitErrorDetails

from nivel.machine.core.record import unknown_word
from nivel.machine.laws.python_source import source_of
from nivel.machine.units import quantity
from nivel.machine.units.tree import TIME, ExpressionError, Parameters, Signal, Time, varies
from nivel.words.arguments import checked_arguments, checked_fields

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
