"""Fields of records for the type checker: what one reads there, and what may be given for it.

A mass reads as a number and may be given as a number or a text with a unit: ``Given[Mass, float, float | str]``. The type
checker sees a descriptor with these two types, from which it knows the arguments of the record. When the program runs,
such an annotation is the first of the three types, by which pydantic reads the value. A field that may be absent is
``Maybe[…]`` of what it holds else.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final, Generic, TypeVar, dataclass_transform, get_args

import pydantic
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from nivel.lazy import Struct

Validated = TypeVar("Validated")
Read_co = TypeVar("Read_co", covariant=True)
Written_contra = TypeVar("Written_contra", contravariant=True)


class Usual(Struct):
    """What a quantity of real machines is between: `least` and `most`, in `unit`, and an `example` as it is written in a file."""

    least: float
    most: float
    unit: str
    example: str = ""


class Shown(Struct):
    """What is known of a field besides its schema: its option of the command line, what holds where it is absent, and what is usual."""

    option: str = ""
    absent: str = ""
    usual: Usual | None = None

    def __call__(self, schema: dict[str, Any]) -> None:
        """Nothing of this stands in the schema."""


def usual_of(field: FieldInfo) -> Usual | None:
    """What is usual of a field: told of itself, or of its type."""
    its, told = field.json_schema_extra, [*field.metadata]
    for kind in get_args(field.annotation):  # of what may be absent
        told += getattr(kind, "__metadata__", ())
    return getattr(its, "usual", None) or next((each for each in told if isinstance(each, Usual)), None)


if TYPE_CHECKING:
    from numpy.typing import NDArray
    from pydantic._internal._model_construction import ModelMetaclass

    MYPY = False  # which mypy takes to be true

    class Given(Generic[Validated, Read_co, Written_contra]):
        """A field that pydantic reads as `Validated`: of type `Read_co` in the record, made from a `Written_contra`."""

        def __get__(self, record: object, owner: Any) -> Read_co: ...
        def __set__(self, record: object, value: Written_contra) -> None: ...

    Its = TypeVar("Its")
    Made = TypeVar("Made")
    AnyGiven = TypeVar("AnyGiven", bound=Given[Any, Any, Any])

    class Maybe(Generic[AnyGiven]):
        """The field `AnyGiven`, or None."""

        def __get__(self: Maybe[Given[Any, Its, Any]], record: object, owner: Any) -> Its | None: ...

        if MYPY:  # it cannot tell `Made` in the arguments of a record

            def __set__(self, record: object, value: Any) -> None: ...  # pyright: ignore[reportRedeclaration]

        else:

            def __set__(self: Maybe[Given[Any, Any, Made]], record: object, value: Made | None) -> None: ...

    OneRecord = Given[Validated, Validated, Validated | Mapping[str, Any]]
    SomeNumbers = Sequence[float | str] | NDArray[Any]
    SomeRows = Sequence[SomeNumbers] | NDArray[Any]

    def Field(
        description: str | None = None,
        *,
        default: Any = ...,
        key: str | None = None,
        discriminator: str | None = None,
        ge: float | None = None,
        gt: float | None = None,
        le: float | None = None,
        lt: float | None = None,
        min_length: int | None = None,
        max_length: int | None = None,
        strict: bool | None = None,
        optional: bool = False,
        option: str = "",
        absent: str = "",
        usual: Usual | None = None,
    ) -> Any:
        """Meaning and default of a field.

        key : by which a machine file has it, where that is no name in Python. optional : its word in the schema need not be given.
        option : of the command line, where it is not what name and type say: `--from VALUE`. absent : what holds where it is None.
        usual : range beyond which `nivel check` and the trust report remark on the value.
        """

else:

    class Given:
        def __class_getitem__(cls, types):
            return types[0]

    class _Itself:
        def __class_getitem__(cls, kind):
            return kind

    class Maybe:
        def __class_getitem__(cls, kind):
            return kind | None

    OneRecord = _Itself
    SomeNumbers = SomeRows = Any
    ModelMetaclass = type(BaseModel)

    def Field(description=None, *, key=None, optional=False, option="", absent="", usual=None, **words):
        if absent:
            description += f"; default: {absent}"
        extra = {"optional": True} if optional else Shown(option, absent, usual)
        words |= {} if key is None else {"alias": key}
        return pydantic.Field(json_schema_extra=extra, description=description, **words)


OneNumber = Given[float, float, float | str]
TwoNumbers = Given[tuple[Validated, Validated], tuple[float, float], SomeNumbers]
ThreeNumbers = Given[tuple[Validated, Validated, Validated], tuple[float, float, float], SomeNumbers]
FourNumbers = Given[tuple[Validated, Validated, Validated, Validated], tuple[float, float, float, float], SomeNumbers]
ManyNumbers = Given[tuple[Validated, ...], tuple[float, ...], SomeNumbers]
TwoPlaces = Given[tuple[Validated, Validated], tuple[tuple[float, float, float], tuple[float, float, float]], SomeRows]
ThreeRows = Given[
    tuple[Validated, Validated, Validated],
    tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]],
    SomeRows,
]
ManyPlaces = Given[tuple[Validated, ...], tuple[tuple[float, float, float], ...], SomeRows]
ManyCorners = Given[tuple[Validated, ...], tuple[tuple[float, float], ...], SomeRows]
ManyRows = Given[tuple[Validated, ...], tuple[tuple[float, ...], ...], SomeRows]
TwoNames = Given[tuple[Validated, Validated], tuple[str, str], Sequence[str]]
ManyNames = Given[tuple[Validated, ...], tuple[str, ...], Sequence[str]]
ManyRecords = Given[tuple[Validated, ...], tuple[Validated, ...], Sequence[Validated | Mapping[str, Any]]]
TwoRecords = Given[tuple[Validated, Validated], tuple[Validated, Validated], Sequence[Validated | Mapping[str, Any]]]


@dataclass_transform(kw_only_default=True, frozen_default=True, field_specifiers=(Field, pydantic.PrivateAttr))
class RecordClass(ModelMetaclass):
    """The class of classes of records: tells the type checker that their fields are keywords, and never change."""


DENSITY: Final = Usual(1.0, 23000.0, "kg/m^3", "7850 kg/m^3")
SPEED: Final = Usual(0.0, 12e3, "m/s", "2 m/s")  # of what is launched; orbits are slower
ANGULAR_SPEED: Final = Usual(0.0, 1e6, "rpm", "1500 rpm")  # of the fastest centrifuges
SLIDING_SPEED: Final = Usual(0.0, 1000.0, "m/s")
SIZE: Final = Usual(1e-6, 1e5, "m", "2 m")
SOLID: Final = Usual(1e-7, 1e4, "m", "50 mm")
POWER: Final = Usual(0.0, 1000.0, "MW")
GRAVITY: Final = Usual(0.0, 300.0, "m/s^2", "[0, 0, -9.81]")
