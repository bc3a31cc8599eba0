"""What may change with time: a number, a table, or an expression of `time`.

Components of forces and torques are of this type. Once in a record, numbers and tables are SI, and the text of an
expression is arithmetic of `time` and SI numbers only, in Python's syntax, with the functions of
arithmetic.FUNCTIONS.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any

from pydantic import PlainSerializer, PlainValidator, ValidationError, ValidationInfo, WithJsonSchema
from pydantic_core import InitErrorDetails, PydanticCustomError

from nivel.machine.arithmetic import (
    ExpressionError,
    FaultyParameterError,
    Node,
    Parameters,
    evaluate,
    fold,
    render,
    uses_time,
)
from nivel.machine.dimension import KINDS, Dimension
from nivel.machine.grammar import parse
from nivel.machine.measure import measure
from nivel.machine.quantity import (
    bound_tree,
    check_kind,
    expression_fault,
    fault,
    listed,
    parameters_of,
    read_quantity,
    reported,
    shown,
)
from nivel.machine.record import unknown_word


@dataclass(frozen=True)
class Table:
    """Straight lines between points. `times` [s] increase strictly; before the first and after the last the end
    values hold.

    Entries may be texts with units until the table stands in a force, which turns them into SI numbers.
    """

    times: tuple[Any, ...]
    values: tuple[Any, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "times", tuple(listed(self.times)))
        object.__setattr__(self, "values", tuple(listed(self.values)))

    def __call__(self, time: float) -> float:
        import numpy as np

        return float(np.interp(time, self.times, self.values))


@dataclass(frozen=True)
class Expression:
    """Arithmetic of `time` [s], e.g. ``10 + 3*sin(2*pi*time)``."""

    text: str

    def __call__(self, time: float) -> float:
        return evaluate(self._tree, time)

    @cached_property
    def _tree(self) -> Node:
        return bound_tree(self.text, {})


TimeFunction = float | Table | Expression


def read_time_function(value: object, kind: str, parameters: Parameters) -> TimeFunction:
    """`value` as a number, table or expression of a quantity of `kind`, in SI.

    Raises ExpressionError, FaultyParameterError; for the entries of a table a ValidationError with their places.
    """
    if isinstance(value, Expression):
        value = value.text
    if isinstance(value, str) and uses_time(parse(value)):
        bound = bound_tree(value, parameters)
        _check_kind_in_time(bound, value.strip(), kind)
        return Expression(render(fold(bound)))
    if isinstance(value, Table):
        value = {"times": value.times, "values": value.values}
    if isinstance(value, Mapping):
        return _read_table(value, kind, parameters)
    return read_quantity(value, kind, parameters)


def _check_kind_in_time(tree: Node, text: str, kind: str) -> None:
    """`time` may count as a plain number of seconds (`sin(2*pi*time)`) or as a quantity (`5 N/s * time`): one of the two
    readings must make sense throughout.

    Raises ExpressionError, about the first reading.
    """
    seconds: Dimension = KINDS["time"][2]
    try:
        check_kind(text, measure(tree), kind)
    except ExpressionError as clash:
        try:
            check_kind(text, measure(tree, time=seconds), kind)
        except ExpressionError:
            raise clash from None


def _read_table(given: Mapping[str, object], kind: str, parameters: Parameters) -> Table:
    keys = ("times", "values")
    unknown = [str(word) for word in given if word not in keys]
    lines = [_line((word,), fault(unknown_word(word, keys, "key"), at_key=True)) for word in unknown]
    columns: dict[str, list[float]] = {}
    for word, its_kind in (("times", "time"), ("values", kind)):
        columns[word] = _read_column(word, given.get(word), its_kind, parameters, lines)
    if not lines:
        lines += _faults_of_columns(columns["times"], columns["values"])
    if lines:
        raise ValidationError.from_exception_data("Table", lines)
    return Table(tuple(columns["times"]), tuple(columns["values"]))


def _read_column(
    word: str, given: object, kind: str, parameters: Parameters, lines: list[InitErrorDetails]
) -> list[float]:
    given = listed(given)
    if not isinstance(given, Sequence) or isinstance(given, str):
        message = f"`{word}` is missing" if given is None else f"a list was expected, got {shown(given)}"
        lines.append(_line((word,), fault(message)))
        return []
    column = []
    for at, entry in enumerate(given):
        try:
            column.append(read_quantity(entry, kind, parameters))
        except FaultyParameterError:
            lines.append(_line((word, at), reported()))
        except ExpressionError as problem:
            lines.append(_line((word, at), expression_fault(problem, entry)))
    return column


def _faults_of_columns(times: list[float], values: list[float]) -> list[InitErrorDetails]:
    if len(times) != len(values):
        return [_line(("values",), fault(f"a table needs as many values as times; got {len(values)} and {len(times)}"))]
    if not times:
        return [_line(("times",), fault("a table needs at least one time"))]
    for at in range(1, len(times)):
        if times[at] <= times[at - 1]:
            return [
                _line(("times", at), fault(f"times increase; {times[at]:g} s does not come after {times[at - 1]:g} s"))
            ]
    return []


def _line(place: tuple[str | int, ...], message: PydanticCustomError) -> InitErrorDetails:
    return InitErrorDetails(type=message, loc=place, input=None)


def written(value: TimeFunction) -> float | str | dict[str, list[float]]:
    """`value` as it stands in a file: a number, a text, or a mapping."""
    match value:
        case Table(times, values):
            return {"times": list(times), "values": list(values)}
        case Expression(text):
            return text
    return value


_QUANTITY_SCHEMA = {"anyOf": [{"type": "number"}, {"type": "string"}]}


def _time_function(kind: str) -> Any:
    """The annotation of a field that is a TimeFunction of a quantity of `kind`."""

    def read(value: Any, info: ValidationInfo) -> TimeFunction:
        try:
            return read_time_function(value, kind, parameters_of(info))
        except FaultyParameterError:
            raise reported() from None
        except ExpressionError as problem:
            raise expression_fault(problem, value) from None

    column = {"type": "array", "items": _QUANTITY_SCHEMA}
    table = {
        "type": "object",
        "properties": {"times": column, "values": column},
        "required": ["times", "values"],
        "additionalProperties": False,
    }
    schema = {
        "anyOf": [*_QUANTITY_SCHEMA["anyOf"], table],
        "description": f"a {kind}: number, quantity, expression of `time`, or table",
    }
    return PlainValidator(read), PlainSerializer(written), WithJsonSchema(schema)


_force, _torque = _time_function("force"), _time_function("torque")
ForceComponent = Annotated[TimeFunction, _force[0], _force[1], _force[2]]
TorqueComponent = Annotated[TimeFunction, _torque[0], _torque[1], _torque[2]]
