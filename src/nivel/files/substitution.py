"""Substitution in functions of a placed part: signals renamed or turned, values of three components mixed.

A signal of the part is a linear combination of signals of the placed part. Expressions can hold any of them; tables
those of one signal; arguments of Python functions only a signal as it is.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

import numpy as np

from nivel.lazy import replace
from nivel.machine.core.record import GROUND, Record, entry
from nivel.machine.laws.time_function import Expression, PythonLaw, Table, TimeFunction
from nivel.machine.units.formula import LinearFunction, times

_SIGNAL: Final = re.compile(r"(?<![\w.])[^\W\d]\w*\.[^\W\d]\w*")  # in an expression, where `-` is a minus sign


class NotRepresentableError(Exception):
    """No record of a machine says what would be needed."""


Signals = Callable[[str], LinearFunction]


def same(path: str) -> LinearFunction:
    """The signal as it is."""
    return LinearFunction(((1.0, path),))


def substituted(function: TimeFunction, signals: Signals, *, local: tuple[str, ...] = ()) -> TimeFunction:
    """`function` with every signal replaced by what `signals` says of it; or instead the `local` symbols.

    Raises NotRepresentableError.
    """
    pattern = re.compile(rf"(?<![\w.])(?:{'|'.join(local)})(?![\w.(])") if local else _SIGNAL

    def is_meant(path: object) -> bool:
        return isinstance(path, str) and (path in local if local else "." in path)

    match function:
        case Expression():
            return Expression(pattern.sub(lambda found: str(signals(found.group())), function.text))
        case Table() if is_meant(function.of):
            return _table_of(function, signals(function.of))
        case PythonLaw():
            arguments = (_argument(each, signals) if is_meant(each) else each for each in function.arguments)
            return replace(function, arguments=tuple(arguments))
    return function


def rewritten(
    value: Any, of_function: Callable[[TimeFunction], TimeFunction], of_record: Callable[[Record], Record]
) -> Any:
    """What a field of a record holds, with other functions and records in place of its own; what is neither stays."""
    match value:
        case Expression() | Table() | PythonLaw():
            return of_function(value)
        case Record():
            return of_record(value)
        case tuple() if any(isinstance(each, Expression | Table | PythonLaw | Record) for each in value):
            return tuple(rewritten(each, of_function, of_record) for each in value)
    return value


def _table_of(table: Table, linear: LinearFunction) -> Table:
    """A table over old = offset + factor · new, as one over new."""
    if len(linear.terms) != 1:
        raise NotRepresentableError(f"a table of `{table.of}` would have to be one of several signals here: {linear}")
    ((factor, path),) = linear.terms
    points = [(point - linear.offset) / factor + 0.0 for point in table.times]
    order = slice(None) if factor > 0 else slice(None, None, -1)
    return replace(table, of=path, times=tuple(points[order]), values=tuple(table.values[order]))


def _argument(argument: str, signals: Signals) -> str:
    linear = signals(argument)
    if linear.offset or len(linear.terms) != 1 or linear.terms[0][0] != 1:
        raise NotRepresentableError(
            f"the argument `{argument}` of a Python function would have to be `{linear}` here; "
            "let the function take what does not depend on where the part is, such as a joint coordinate"
        )
    return linear.terms[0][1]


def mixed(matrix: np.ndarray, components: Sequence[TimeFunction]) -> tuple[TimeFunction, ...]:
    """The components of `matrix` (n, n) · `components`.

    Raises NotRepresentableError.
    """
    return tuple(combination(row, components) for row in matrix)


def combination(factors: Sequence[float] | np.ndarray, functions: Sequence[TimeFunction]) -> TimeFunction:
    """Σ factor · function.

    Raises NotRepresentableError.
    """
    terms = [
        (float(factor), each) for factor, each in zip(factors, functions, strict=True) if factor != 0 and each != 0
    ]
    if not terms:
        return 0.0
    if len(terms) == 1 and terms[0][0] == 1:
        return terms[0][1]
    if all(isinstance(each, float | int | Expression) for _, each in terms):
        return _sum([(factor, each) for factor, each in terms if isinstance(each, float | int | Expression)])
    tables = [(factor, each) for factor, each in terms if isinstance(each, Table)]
    if len(tables) + sum(isinstance(each, float | int) for _, each in terms) == len(terms):
        constant = sum(factor * each for factor, each in terms if isinstance(each, float | int))
        return _sum_of_tables(tables, constant)
    kinds = sorted({"a Python function" if isinstance(each, PythonLaw) else "a table" for _, each in terms})
    raise NotRepresentableError(
        f"{kinds[0]} would have to be {'turned around' if len(terms) == 1 else 'mixed with another component'} here; "
        "write expressions, or give the components in axes of the body"
    )


def negative(function: TimeFunction) -> TimeFunction:
    """-function.

    Raises NotRepresentableError.
    """
    return combination([-1.0], [function])


def _sum(terms: Sequence[tuple[float, float | Expression]]) -> float | Expression:
    if all(isinstance(each, float | int) for _, each in terms):
        return sum(factor * each for factor, each in terms if isinstance(each, float | int)) + 0.0
    return Expression(" + ".join(_product(factor, each) for factor, each in terms))


def _product(factor: float, function: float | Expression) -> str:
    return times(factor, f"({function.text})" if isinstance(function, Expression) else repr(float(function)))


def _sum_of_tables(terms: Sequence[tuple[float, Table]], constant: float) -> Table:
    """Exact: straight lines between all points of both stay straight, and a spline is linear in its values."""
    first = terms[0][1]
    if any((table.of, table.interpolation) != (first.of, first.interpolation) for _, table in terms):
        raise NotRepresentableError(
            "tables of different kinds would have to be added here; give them the same `of` and points"
        )
    if first.interpolation == "monotone" and len(terms) > 1:
        raise NotRepresentableError("monotone tables would have to be added here; take another interpolation")
    times = sorted({time for _, table in terms for time in table.times})
    if first.interpolation != "linear" and any(list(table.times) != times for _, table in terms):
        raise NotRepresentableError("smooth tables would have to be added here; give them the same points")
    values = [constant + sum(factor * table(time) for factor, table in terms) + 0.0 for time in times]
    return replace(first, times=tuple(times), values=tuple(values))


# fields that hold names of elements, `JOINT.COORDINATE`, or lists of them; where they hold numbers these stay
MENTIONS: Final = (
    "body",
    "bodies",
    "marker",
    "markers",
    "relative_to",
    "plane",
    "planes",
    "between",
    "joints",
    "coordinate",
    "against",
    "coupling",
    "coordinates",
    "force",
    "distance",
    "angle",
    "event",
    "ports",
    "valves",
    "wheel",
    "edge",
    "opening",
    "load_at",
    "contact",
    "sprocket",
    "fluid",
)

Elements = Mapping[str, Sequence[Record]]


def renamed(elements: Elements, prefix: str) -> dict[str, tuple[Record, ...]]:
    """`elements` by section, with `prefix` before all their names. `ground` stays `ground`.

    Raises NotRepresentableError where the prefix cannot be written in an expression.
    """
    if not prefix:
        return {section: tuple(records) for section, records in elements.items()}
    return {section: tuple(_element(record, prefix) for record in records) for section, records in elements.items()}


def _element(record: Record, prefix: str) -> Record:
    name = entry(record, "name")
    try:
        return _record(record, prefix, {"name": f"{prefix}{name}"})
    except NotRepresentableError as error:
        raise NotRepresentableError(f"{record.collection}.{name}: {error}") from None


def _record(record: Record, prefix: str, changes: dict[str, Any]) -> Record:
    """`record` with `changes` and with all its mentions renamed."""
    for field in sorted(record.model_fields_set - {"name"}):
        value = getattr(record, field)
        new = _mention(value, prefix) if field in MENTIONS else _value(value, prefix)
        if new is not value:
            changes[field] = new
    return record.replace(**changes) if changes else record


def _mention(value: Any, prefix: str) -> Any:
    if isinstance(value, str):
        return value if value == GROUND else f"{prefix}{value}"
    if isinstance(value, tuple):
        return tuple(_mention(each, prefix) for each in value)
    if isinstance(value, dict):
        return {key: _mention(each, prefix) for key, each in value.items()}
    return _value(value, prefix)


def _value(value: Any, prefix: str) -> Any:
    """What is no mention itself: functions with signals, records with mentions in them."""

    def of_function(function: TimeFunction) -> TimeFunction:
        if isinstance(function, Expression) and function.signals and "-" in prefix:
            raise NotRepresentableError(
                f"names that start with `{prefix}` cannot be used in `{function.text}`, where `-` is a minus sign; "
                "give a `prefix` without it"
            )
        return substituted(function, lambda path: same(f"{prefix}{path}"))

    return rewritten(value, of_function, lambda record: _record(record, prefix, {}))
