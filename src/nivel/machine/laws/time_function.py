"""Functions of time and signals: a number, a table, an expression of `time` and signals, or a law in Python.

Components of forces and motions of drivers are of this type. Once in a record, everything is SI: numbers, tables, the
numbers in the text of an expression and those that a law is called with.
"""

from collections.abc import Collection, Mapping, Sequence
from typing import Annotated, Any, Final

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema, core_schema

from nivel.lazy import Struct
from nivel.machine.given import Given, Validated
from nivel.machine.laws.python_law import PythonLaw, read_python_law
from nivel.machine.laws.varying_value import Expression, Table, read_table
from nivel.machine.units import quantity
from nivel.machine.units.arithmetic import fold, render
from nivel.machine.units.derivative import derivative
from nivel.machine.units.functions import INTERPOLATIONS
from nivel.machine.units.measure import measure, readings
from nivel.machine.units.slips import is_tonne_compared
from nivel.machine.units.tree import ExpressionError, Node, Parameters, varies

TimeFunction = float | Table | Expression | PythonLaw
SomeFunction = float | str | Mapping[str, Any] | Table | Expression | PythonLaw  # what is read as one

OneFunction = Given[TimeFunction, TimeFunction, SomeFunction]
ThreeFunctions = Given[
    tuple[Validated, Validated, Validated], tuple[TimeFunction, TimeFunction, TimeFunction], Sequence[SomeFunction]
]
FourFunctions = Given[
    tuple[Validated, Validated, Validated, Validated],
    tuple[TimeFunction, TimeFunction, TimeFunction, TimeFunction],
    Sequence[SomeFunction] | Mapping[str, Any],
]
ManyFunctions = Given[tuple[Validated, ...], tuple[TimeFunction, ...], Sequence[SomeFunction]]

MOTION_RESULTS: Final = 3  # what a law that drives returns: value, rate, acceleration
_RATES: Final = {"length": "velocity", "angle": "angular velocity"}


def read_time_function(
    value: object, kind: quantity.Kind, parameters: Parameters, local: Collection[str] = (), *, smooth: bool = False
) -> TimeFunction:
    """`value` as something that varies, of a quantity of `kind`, in SI.

    local : symbols that have a meaning in this field, of LOCAL_SYMBOLS
    smooth : a motion of a driver is asked for: a function of time only, with two derivatives between its corners

    Raises ExpressionError, FaultyParameterError; for a table or a law a ValidationError with the places of its faults.
    """
    if isinstance(value, Expression):
        value = value.text
    if isinstance(value, str):
        function = _read_text(value, kind, parameters, local)
    elif isinstance(value, PythonLaw) or (isinstance(value, Mapping) and _is_law(value)):
        function = read_python_law(value, parameters, local, results=MOTION_RESULTS if smooth else 1)
    elif isinstance(value, Table | Mapping):
        function = read_table(value, kind, parameters, local)
    else:
        function = quantity.read_quantity(value, kind, parameters)
    if smooth:
        check_smooth(function)
    return function


def _is_law(given: Mapping[Any, object]) -> bool:
    return any(word in given for word in ("python", "source", "function", "arguments"))


def _read_text(text: str, kind: quantity.Kind, parameters: Parameters, local: Collection[str]) -> float | Expression:
    quantity.refuse_celsius(text, kind)
    if is_tonne_compared(text, (*parameters, *local)):
        raise ExpressionError("a mass is compared with a number")
    tree = quantity.bound_tree(text, parameters, local)
    if not varies(tree):
        return _read_constant(text, kind, parameters)
    check_varying(tree, text.strip(), kind, parameters, local)
    return Expression(render(fold(tree)))


def check_varying(tree: Node, text: str, kind: quantity.Kind, parameters: Parameters, local: Collection[str]) -> None:
    """Refuse an expression `text` of variables, read as `tree`, that is not of `kind`.

    Raises ExpressionError, with the line to write where plain numbers lack units.
    """
    try:
        _check_kind_of_varying(tree, text, kind)
    except ExpressionError as problem:

        def accepts(other: str, parameters: Parameters) -> None:
            _check_kind_of_varying(quantity.bound_tree(other, parameters, local), other, kind)

        raise quantity.lacking_unit(problem, text, kind, parameters, local, accepts) from None


def _read_constant(text: str, kind: quantity.Kind, parameters: Parameters) -> float:
    """A quantity of `kind`. Raises ExpressionError, with the line to write where the speed is given in place of the way."""
    try:
        return quantity.read_quantity(text, kind, parameters)
    except ExpressionError as problem:
        rates = tuple(_RATES[each] for each in quantity.kinds_of(kind) if each in _RATES)
        if rates and _reads(text, rates, parameters):
            raise ExpressionError(f"{problem}; with this speed write `({text.strip()})*time`") from None
        raise


def _reads(text: str, kind: quantity.Kind, parameters: Parameters) -> bool:
    """Whether `text` is a quantity of `kind`."""
    try:
        quantity.read_quantity(text, kind, parameters)
    except ExpressionError:
        return False
    return True


def _check_kind_of_varying(tree: Node, text: str, kind: quantity.Kind) -> None:
    """`time` may count as a plain number of seconds (`sin(2*pi*time)`) or as a quantity (`5 N/s * time`), and signals
    likewise: for some choice everything must make sense.

    Raises ExpressionError, about the choice in which they all are plain numbers.
    """
    clash = None
    for reading in readings(tree):
        try:
            quantity.check_kind(text, measure(tree, reading), kind)
        except ExpressionError as problem:
            clash = clash or problem
        else:
            return
    if clash is not None:
        raise clash


def check_smooth(function: TimeFunction) -> None:
    """Refuse what cannot drive: what depends on more than time, or is an expression with corners.

    Raises ExpressionError.
    """
    match function:
        case Expression():
            derivative(derivative(function.tree))
        case Table() | PythonLaw() if function.signals:
            raise ExpressionError(f"a driver depends on `time` alone, not on `{function.signals[0]}`")


def signals_of(function: TimeFunction) -> tuple[str, ...]:
    """The paths of the signals that `function` depends on, local symbols among them; `time` is none."""
    return () if isinstance(function, float | int) else function.signals


def written(value: TimeFunction) -> float | str | dict[str, Any]:
    """`value` as it stands in a file: a number, a text, or a mapping."""
    match value:
        case Table() | PythonLaw():
            return value.written()
        case Expression(text):
            return text
    return value


class Varying(Struct):
    """Annotation of a field that is a TimeFunction of a quantity of `kind`; see `varying`."""

    kind: quantity.Kind
    local: tuple[str, ...] = ()
    smooth: bool = False

    def read(self, value: Any, info: ValidationInfo) -> TimeFunction:
        parameters = quantity.parameters_of(info)
        with quantity.told(value, parameters):
            return read_time_function(value, self.kind, parameters, self.local, smooth=self.smooth)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        serialization = core_schema.plain_serializer_function_ser_schema(written)
        return core_schema.with_info_plain_validator_function(self.read, serialization=serialization)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        symbols = "`time`" if self.smooth else ", ".join(("`time`", *(f"`{word}`" for word in self.local), "signals"))
        return {
            "anyOf": [*_QUANTITY["anyOf"], *_table_schemas(self.smooth), _LAW],
            "description": f"{quantity.expected_kind(self.kind)}: number, quantity, expression of {symbols}, table, or law in Python",
        }


def varying(kind: quantity.Kind, local: Collection[str] = (), *, smooth: bool = False) -> Varying:
    """The annotation of a field that may vary: ``Annotated[OneFunction, varying("force", local=("length", "rate"))]``.

    kind : a key of KINDS, or several of which one must fit, or ANY
    local : symbols that have a meaning in this field, of LOCAL_SYMBOLS
    smooth : a motion of a driver: a function of time only, with two derivatives between its corners
    """
    return Varying(kind, tuple(local), smooth)


_QUANTITY: Final = {"anyOf": [{"type": "number"}, {"type": "string"}]}
_COLUMN: Final = {"type": "array", "items": _QUANTITY}
_TEXT: Final = {"type": "string"}
_LAW: Final = {
    "type": "object",
    "properties": {
        "python": {**_TEXT, "description": "file of the function, beside the machine file"},
        "source": {**_TEXT, "description": "text of such a file, in place of `python`"},
        "function": _TEXT,
        "arguments": {**_COLUMN, "description": "`time`, signals, or numbers"},
        "file": {**_TEXT, "description": "name of the file that `source` came from"},
    },
    "required": ["function"],
    "anyOf": [{"required": ["python"]}, {"required": ["source"]}],
    "additionalProperties": False,
}


_COLUMNS: Final = {"type": "array", "items": {"anyOf": [*_QUANTITY["anyOf"], _COLUMN]}}
# of a named function that is a curve, or with `across` a map of two arguments
CURVE: Final = {
    "type": "object",
    "properties": {
        "points": _COLUMN,
        "values": _COLUMNS,
        "across": _COLUMN,
        "interpolation": {"enum": list(INTERPOLATIONS)},
    },
    "required": ["points", "values"],
    "additionalProperties": False,
}


def _table_schemas(motion: bool) -> list[dict[str, Any]]:
    """The forms of a table: of time, and where that is allowed of a signal."""
    interpolation = {"enum": list(INTERPOLATIONS)}
    of_time = {"of": {"const": "time"}, "times": _COLUMN}, ["times", "values"]
    of_signal = {"of": _TEXT, "points": _COLUMN}, ["of", "points", "values"]
    return [
        {
            "type": "object",
            "properties": {**columns, "values": _COLUMN, "interpolation": interpolation},
            "required": required,
            "additionalProperties": False,
        }
        for columns, required in ([of_time] if motion else [of_time, of_signal])
    ]


ForceComponent = Annotated[OneFunction, varying("force")]
TorqueComponent = Annotated[OneFunction, varying("torque")]
Measured = Annotated[OneFunction, varying(quantity.ANY)]

# Laws of springs: what the spring measures has a name of its own.
SpringForce = Annotated[OneFunction, varying("force", local=("length", "rate"))]
SpringTorque = Annotated[OneFunction, varying("torque", local=("angle", "rate"))]
# Laws of contacts: overlap and its rate at each point that touches.
ContactForce = Annotated[OneFunction, varying("force", local=("depth", "rate"))]
# Surfaces that move over their bodies.
SurfaceVelocity = Annotated[OneFunction, varying("velocity")]
SurfaceSpin = Annotated[OneFunction, varying("angular velocity")]
