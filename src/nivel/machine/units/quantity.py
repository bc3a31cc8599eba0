"""Numbers as people write them: `0.25`, `10 cm`, `30 rpm`, `2*length + 5 mm`. Fields of records hold them as SI floats.

The field types at the end (`Length`, `Mass`, …) are floats to the type checker that reads them. When a record is made they read a
number, which is SI, or a text with units and arithmetic, whose dimension must be the field's. Parameters of a machine
file come in through the validation context: ``{"parameters": {"radius": Number(0.25)}}``.
"""

import numbers
import re
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema, InitErrorDetails, PydanticCustomError, core_schema

from nivel.errors import Fault, ModelError
from nivel.lazy import Struct
from nivel.machine.given import OneNumber, ThreeNumbers
from nivel.machine.units import tree
from nivel.machine.units.arithmetic import LOCAL_SYMBOLS, PLACE, bind, evaluate, given
from nivel.machine.units.grammar import parse
from nivel.machine.units.measure import Reading, measure, refuse_unlike_terms, shared_names_hint
from nivel.machine.units.plain_factors import completed, with_bodies
from nivel.machine.units.slips import in_kelvin, is_time_meant, slip
from nivel.machine.units.unit import KINDS, Dimension, counts_turns, described, is_angular, without_angle
from nivel.words.arguments import plain
from nivel.words.wording import shown

MASSLESS = (
    "; a link without mass is a joint: distance, revolute-spherical, revolute-cylindrical, revolute-translational; springs and dampers in "
    "series are a force, `type: spring-series`, and so is a node without mass where springs meet, `type: spring-node`"
)
FAULT = "nivel"  # type of the validation errors that carry a finished sentence
REPORTED = "nivel_reported"  # type of those that follow from a fault reported elsewhere

Kind = str | tuple[str, ...]  # a key of KINDS, or several of which one must fit
ANY: Kind = ()  # whatever it measures
LARGEST = 1e100  # squares of such numbers, and products of three, can be held


def fault(message: str, *, at_key: bool = False, lacking: "LackingUnitError | None" = None) -> PydanticCustomError:
    """A validation error whose text is `message`, ready for people; `at_key`: not the value is wrong but its key.

    lacking : of an expression, if functions that it calls are at fault
    """
    more = {} if lacking is None else {"lacking": lacking}
    return PydanticCustomError(FAULT, "{message}", {"message": message, "at_key": at_key, **more})


UNREAD = (tree.ExpressionError, tree.FaultyParameterError)  # what reading a text raises


def reported() -> PydanticCustomError:
    """A validation error to be passed over in silence: its cause has been reported."""
    return PydanticCustomError(REPORTED, "follows from another fault")


def parameters_of(info: ValidationInfo) -> tree.Parameters:
    """The parameters of the machine file being read; none where records are made in Python."""
    return (info.context or {}).get("parameters", {})


def bound_tree(text: str, parameters: tree.Parameters, local: Collection[str] = ()) -> tree.Node:
    """The tree of `text` with parameters, constants, units and `local` symbols put in.

    Raises ExpressionError, FaultyParameterError.
    """
    try:
        return bind(parse(text), parameters, local)
    except tree.UnknownNameError as problem:
        if problem.name not in LOCAL_SYMBOLS or problem.name in PLACE:
            raise
        raise tree.ExpressionError(f"{problem} (only the `law` of a spring knows its `{problem.name}`)") from None


def kinds_of(kind: Kind) -> tuple[str, ...]:
    """The keys of KINDS of which one must fit; none where anything does."""
    return (kind,) if isinstance(kind, str) else kind


def expected_kind(kind: Kind) -> str:
    """``a force (N) or a torque (N*m)``."""
    return " or ".join(_with_unit(*KINDS[one][:2]) for one in kinds_of(kind)) or "a number or a quantity"


def _with_unit(article: str, unit: str) -> str:
    return f"{article} ({unit})" if unit != "1" else article


def check_kind(text: str, its: Dimension | None, kind: Kind) -> None:
    """Refuse a quantity of dimension `its`, written as `text`, that is not of `kind`. A bare number always is.

    Raises ExpressionError.
    """
    clashes = [_clash(its, KINDS[one][2]) for one in kinds_of(kind)]
    if "" in clashes or not clashes:
        return
    if "turns" in clashes:
        raise tree.ExpressionError(
            f"`{text}` counts turns; {expected_kind(kind)} was expected: write `rev/s`, `rpm` or `rad/s`"
        )
    raise tree.ExpressionError(f"`{text}` is {described(its)}; {expected_kind(kind)} was expected")


def _clash(its: Dimension | None, wanted: Dimension) -> Literal["", "other", "turns"]:
    """How `its` clashes with what is `wanted`.

    Angles vanish where SI lets them (rad/s × m = m/s), but where one is asked for, another power of it is a mistake.
    """
    if its is None:
        return ""
    if without_angle(its) != without_angle(wanted) or (is_angular(its) and is_angular(wanted) and its != wanted):
        return "other"
    return "turns" if is_angular(wanted) and counts_turns(its) else ""


class FunctionFault(Struct):
    """What is wrong with the function that is written as `head`, in the words of a message, and its text as it would be right."""

    head: str
    message: str
    body: str

    @property
    def line(self) -> str:
        """The line to write."""
        return f"{self.head}: {self.body}"


class LackingUnitError(tree.ExpressionError):
    """Plain numbers of an expression, or of functions that it calls, lack units; the message has the line to write.

    functions : those that have to change, by name
    """

    def __init__(self, message: str, functions: Mapping[str, FunctionFault]) -> None:
        super().__init__(message)
        self.functions = functions


def lacking_unit(
    problem: tree.ExpressionError,
    text: str,
    kind: Kind,
    parameters: tree.Parameters,
    local: Collection[str],
    accepts: Callable[[str, tree.Parameters], None],
    *,
    constant: bool = False,
) -> tree.ExpressionError:
    """`problem` of the expression `text`, with the line to write where it is that plain numbers lack units.

    accepts : raises ExpressionError for a text that is still wrong
    """
    if is_time_meant(text, (*parameters, *local)):
        return problem
    wanted = tuple(KINDS[one][2] for one in kinds_of(kind))
    answer = completed(text, parameters, tuple(local), wanted, accepts, constant=constant)
    if answer is None:
        return problem
    why = _why(text, kind, parameters, local, answer.reading) or str(problem)
    faults: dict[str, FunctionFault] = {}
    for name, body in answer.bodies.items():
        function = parameters[name]
        assert isinstance(function, tree.Function)
        message = f"{why}, where it is called: {_lacking(answer.lacking[name])}"
        faults[name] = FunctionFault(function.head, message, body)
    if "" in answer.lacking:
        after = _why(text, kind, with_bodies(parameters, answer.bodies), local, answer.reading) or str(problem)
        message = f"{after}: {_lacking(answer.lacking[''])}; write `{answer.text}`"
    else:
        message = f"{why}; write {' and '.join(f'`{each.line}`' for each in faults.values())}"
    return LackingUnitError(message, faults)


def _why(text: str, kind: Kind, parameters: tree.Parameters, local: Collection[str], reading: Reading) -> str:
    """Why `text` does not fit with its variables taken as in `reading`."""
    try:
        its = measure(bound_tree(text, parameters, local), reading)
        check_kind(text, its, kind)
    except tree.ExpressionError as problem:
        start = f"`{text}` is "
        return f"this is {str(problem).removeprefix(start)}" if str(problem).startswith(start) else str(problem)
    return ""


def _lacking(factors: tuple[tuple[str, str], ...]) -> str:
    """That factors lack units, in a clause: each as it is written, with its unit."""
    (name, unit), *others = factors
    return " and ".join([f"`{name}` lacks the unit {unit}", *(f"`{each}` the unit {its}" for each, its in others)])


def read_quantity(value: object, kind: Kind, parameters: tree.Parameters) -> float:
    """`value` as a finite SI number of `kind`, of no more than LARGEST but for times and lengths, of which others judge.

    Raises ExpressionError, FaultyParameterError.
    """
    number = _read_number(value, kind, parameters)
    if abs(number) > LARGEST and kind != ANY and not {"time", "length"} & set(kinds_of(kind)):
        raise tree.ExpressionError(
            f"{number:.3g} is more than the limit of {LARGEST:.0e}, in SI units: a slip of a unit?"
        )
    return number


def _read_number(value: object, kind: Kind, parameters: tree.Parameters) -> float:
    value = plain(value)
    if isinstance(value, str):
        refuse_celsius(value, kind)
        root = constant_tree(value, parameters)
        try:
            its = measure(root)
            number = evaluate(root)
            check_kind(value.strip(), its, kind)
        except tree.ExpressionError as problem:
            accepts = partial(_check_constant, kind)
            raise lacking_unit(problem, value.strip(), kind, parameters, (), accepts, constant=True) from None
        return number
    if isinstance(value, numbers.Real) and not isinstance(value, bool):
        return given(value)
    raise tree.ExpressionError(f"{expected_kind(kind)} was expected, got {shown(value)}")


def refuse_celsius(text: str, kind: Kind) -> None:
    """Raises ExpressionError where a temperature is not absolute."""
    if "temperature" in kinds_of(kind) and (meant := in_kelvin(text)):
        raise tree.ExpressionError(f"temperatures are absolute: in place of `{text.strip()}` write `{meant}`")


def _check_constant(kind: Kind, text: str, parameters: tree.Parameters) -> None:
    """Raises ExpressionError where `text` is no quantity of `kind`."""
    root = constant_tree(text, parameters)
    check_kind(text, measure(root), kind)
    evaluate(root)


def constant_tree(text: str, parameters: tree.Parameters) -> tree.Node:
    """The tree of `text`, in which nothing may vary.

    Raises ExpressionError, FaultyParameterError.
    """
    root = bound_tree(text, parameters)
    if tree.signals(root):
        raise tree.ExpressionError(
            f"`{tree.signals(root)[0]}` may only be used where a value may vary: in forces, couplings of `type: function`, states, "
            "sensors and events"
        )
    if tree.varies(root):
        raise tree.ExpressionError(
            "`time` may only be used where a value may vary: in forces, drivers, states, sensors and events"
        )
    return root


class PlainVolume(float):
    """A volume per angle that was given as a volume, as `28 cm^3` where `28 cm^3/rev` may be meant: it counts as per radian."""


def _is_plain_volume(value: object, parameters: tree.Parameters) -> bool:
    """Whether a volume per angle is given in units of a volume, by a round number; 28/(2*pi) of them is one that was converted."""
    if not isinstance(value, str):
        return isinstance(value, PlainVolume)
    its, size = measure(constant_tree(value, parameters)), 1e6 * read_quantity(value, ANY, parameters)
    return its == KINDS["volume"][2] and abs(size - float(f"{size:.4g}")) <= 1e-9 * abs(size)


class Quantity(Struct):
    """Annotation of a float field: it is a quantity of `kind`, and possibly bounded below by zero."""

    kind: Kind
    positive: bool = False

    def read(self, value: Any, info: ValidationInfo) -> float:
        with told(value, parameters_of(info)):
            number = read_quantity(value, self.kind, parameters_of(info))
        if self.positive and number <= 0:
            instead = MASSLESS if self.kind == "mass" and number == 0 else ""
            article = KINDS[self.kind][0] if isinstance(self.kind, str) else "a number"
            raise fault(f"{article} greater than zero was expected, got {shown(value)}{instead}")
        if self.positive and number > LARGEST and self.kind == "length":  # a size, of which areas and volumes are made
            raise fault(f"{shown(value)}: {number:.3g} m is more than the limit of {LARGEST:.0e}: a slip of a unit?")
        if self.kind == "displacement" and _is_plain_volume(value, parameters_of(info)):
            return PlainVolume(number)
        return number

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        article, unit, _ = KINDS[self.kind] if isinstance(self.kind, str) else ("a quantity in SI units", "", None)
        meaning = article if unit == "1" else f"{article}{f' in {unit}' if unit else ''}, or with a unit"
        number: dict[str, Any] = {"type": "number"}
        if self.positive:
            number["exclusiveMinimum"] = 0
        return {"anyOf": [number, {"type": "string"}], "description": meaning, "takes": meaning}


def asked(name: str, value: object, kind: Kind) -> float:
    """A quantity that is given by this name, not in a file. Raises ModelError."""
    try:
        return read_quantity(value, kind, {})
    except tree.ExpressionError as problem:
        raise ModelError(Fault.at(name, expression_fault(problem, value).message())) from None


@contextmanager
def told(value: object, parameters: tree.Parameters | None = None) -> Iterator[None]:
    """Faults of a text `value` that is read inside are told as those of a field. parameters : as of `expression_fault`"""
    try:
        yield
    except UNREAD as problem:
        raise unread(problem, value, parameters) from None


def unread(problem: Exception, value: object, parameters: tree.Parameters | None = None) -> PydanticCustomError:
    """`problem`, of UNREAD, with the text `value` that it is in; to be passed over where a parameter is at fault."""
    return expression_fault(problem, value, parameters) if isinstance(problem, tree.ExpressionError) else reported()


def line_of(place: tuple[str | int, ...], problem: PydanticCustomError) -> InitErrorDetails:
    """A fault at a place of a record."""
    return InitErrorDetails(type=problem, loc=place, input=None)


def expression_fault(
    problem: tree.ExpressionError, value: object, parameters: tree.Parameters | None = None
) -> PydanticCustomError:
    """`problem` with the text that it is in, unless the message shows it already. parameters : that the text may name"""
    message = str(problem)
    if isinstance(value, str) and f"`{value.strip()}`" not in message:
        message = f"{shown(value.strip())}: {message}"
    lacking = isinstance(problem, LackingUnitError)
    if isinstance(value, str) and not lacking and (answer := slip(value, parameters or ())):
        message = re.sub(r"; did you mean `[^`]*`\?$", "", message) + answer
    if isinstance(value, str):
        message += shared_names_hint(value, parameters or {})
    return fault(message, lacking=problem if isinstance(problem, LackingUnitError) else None)


def of_one_kind(value: Any, info: ValidationInfo) -> Any:
    """`value` as it is, unless it is an expression that adds or compares unlike things, as `1 m - boom.angle` does: a fault."""
    if isinstance(value, str):
        try:
            root = bound_tree(value, parameters_of(info))
        except (tree.ExpressionError, tree.FaultyParameterError):
            return value  # reported where the text is read
        try:
            refuse_unlike_terms(root)
        except tree.ExpressionError as problem:
            raise expression_fault(problem, value, parameters_of(info)) from None
    return value


def listed(value: Any) -> Any:
    """NumPy arrays as lists, so that they may stand for vectors and matrices."""
    return value.tolist() if hasattr(value, "tolist") and getattr(value, "ndim", 0) > 0 else value


def _no_truth(value: Any) -> Any:
    """NumPy scalars as numbers; true and false are none."""
    if isinstance(value := plain(value), bool):
        raise fault(f"a number was expected, got {shown(value)}")
    return value


Real = Annotated[float, BeforeValidator(_no_truth)]  # without units
Whole = Annotated[int, BeforeValidator(_no_truth)]
Scalar = Annotated[OneNumber, Quantity("number")]
Length = Annotated[OneNumber, Quantity("length")]
PositiveLength = Annotated[OneNumber, Quantity("length", positive=True)]
Mass = Annotated[OneNumber, Quantity("mass", positive=True)]
Density = Annotated[OneNumber, Quantity("density", positive=True)]
Duration = Annotated[OneNumber, Quantity("time", positive=True)]
Angle = Annotated[OneNumber, Quantity("angle")]
Velocity = Annotated[OneNumber, Quantity("velocity")]
AngularVelocity = Annotated[OneNumber, Quantity("angular velocity")]
Acceleration = Annotated[OneNumber, Quantity("acceleration")]
InertiaComponent = Annotated[OneNumber, Quantity("inertia")]
Rate = Annotated[OneNumber, Quantity("rate", positive=True)]

Direction = Annotated[ThreeNumbers[Scalar], BeforeValidator(listed)]
Position = Annotated[ThreeNumbers[Length], BeforeValidator(listed)]
VelocityVector = Annotated[ThreeNumbers[Velocity], BeforeValidator(listed)]
AngularVelocityVector = Annotated[ThreeNumbers[AngularVelocity], BeforeValidator(listed)]
AccelerationVector = Annotated[ThreeNumbers[Acceleration], BeforeValidator(listed)]
