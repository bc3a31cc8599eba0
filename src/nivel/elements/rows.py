"""Rows of a family: what its kernel reads of each element, declared by name once for the kernel and for what fills it.

    class SpringRow(Row):
        output: int
        at: int
        law: int = NONE
        stiffness: float
        parts: Sequence[float] = several(3)

Whole numbers are columns, indices of other things; the others are numbers. A kernel reads `columns[k, SpringRow.AT]` and
`number[k, SpringRow.STIFFNESS]`. `SpringRow(output=…, at=…, stiffness=…)` is a row with everything that it needs, or an error, and
`SpringRow.of(force, output=…, at=…)` takes the rest from a record, by the same names.

A kernel that does the same with every row is the law of one of them:

    @element
    def stretch(machine, index, n, t): ...
"""

from collections.abc import Callable
from functools import update_wrapper
from inspect import get_annotations, signature
from types import ModuleType
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, Self, dataclass_transform

from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import Family, family
from nivel.kernels.record.record import record_at
from nivel.native.function import stage

_MISSING: Any = object()


def element(law: Callable[..., Any]) -> Family:
    """Decorator: `law(machine, index, n, t)` of one element, of its columns and numbers, as the family of all of them; or
    `law(machine, k, index, n, t)` of one that has more than these, such as a memory: k is its number."""
    of_one = stage(law)

    def of_all(machine, number, t):
        elements = record_at(machine).elements
        for k in range(elements.span[number, 0], elements.span[number, 1]):
            of_one(machine, elements.columns[k], elements.number[k], t)
        return OK

    def of_all_numbered(machine, number, t):
        elements = record_at(machine).elements
        for k in range(elements.span[number, 0], elements.span[number, 1]):
            of_one(machine, k, elements.columns[k], elements.number[k], t)
        return OK

    made = of_all_numbered if "k" in signature(law).parameters else of_all
    update_wrapper(made, law)
    vars(made).pop("__wrapped__")  # whose arguments Numba would take for its own
    return family(made)


class Filled(NamedTuple):
    """A row of an element: its columns and its numbers."""

    columns: list[int]
    numbers: list[float]


class Several(NamedTuple):
    """A field with several places, or with as many as are given, at the end of a row, where their number is None."""

    places: int | None
    default: Any


class Layout(ModuleType):
    """A class of rows: the places of its fields, in capitals, and a call that fills one. As a module its names are constants for Numba."""

    def __init__(self, declared: type) -> None:
        name = declared.__name__
        super().__init__(name, declared.__doc__)
        self._fields: dict[str, tuple[bool, Several | None, Any]] = {}
        places: dict[bool, int | None] = {True: 0, False: 0}
        for field, annotation in get_annotations(declared).items():
            kind = getattr(annotation, "__name__", annotation) if isinstance(annotation, type) else str(annotation)
            kind = kind.rpartition("[")[2].removesuffix("]")
            if kind not in ("int", "float"):
                raise TypeError(
                    f"{name}.{field} is a column, `int`, or a number, `float`, or several; got `{annotation}`"
                )
            default = vars(declared).get(field, _MISSING)
            several = default if isinstance(default, Several) else None
            place = places[kind == "int"]
            if place is None:
                raise TypeError(f"{name}.{field} stands behind a field of any length")
            setattr(self, field.upper(), place)
            places[kind == "int"] = place + 1 if several is None else several.places and place + several.places
            self._fields[field] = kind == "int", several, default if several is None else several.default
        self.row_length = places[False]
        self.several = {
            field: several.places for field, (_, several, _) in self._fields.items() if several and several.places
        }

    def __call__(self, **values: Any) -> Filled:
        if unknown := values.keys() - self._fields.keys():
            raise TypeError(f"{self.__name__} has no {', '.join(sorted(unknown))}")
        row = Filled([], [])
        for field, (is_column, several, default) in self._fields.items():
            value = values.get(field, default)
            if value is _MISSING:
                raise TypeError(f"{self.__name__} needs {field}")
            entries = [value] if several is None else [*value]
            if several is not None and several.places not in (None, len(entries)):
                raise TypeError(f"{self.__name__} needs {several.places} of {field}, got {len(entries)}")
            (row.columns if is_column else row.numbers).extend(entries)
        return row

    def of(self, record: object, **values: Any) -> Filled:
        """The same, in which what is not given is what a record has under the name of the field."""
        names = [name for name in self._fields if name not in values and getattr(record, name, None) is not None]
        return self(**values, **{name: getattr(record, name) for name in names})


def several(places: int | None = None, *, default: Any = _MISSING) -> Any:
    """A field with several places; with as many as are given, at the end of a row, where their number is not told."""
    return Several(places, default)


if TYPE_CHECKING:

    @dataclass_transform(kw_only_default=True, field_specifiers=(several,))
    class RowClass(type):
        def __getattr__(cls, name: str) -> int: ...

    class Row(metaclass=RowClass):
        """Base of what declares a row."""

        columns: ClassVar[list[int]]
        numbers: ClassVar[list[float]]
        several: ClassVar[dict[str, int]]  # how many places a field has
        row_length: ClassVar[int]  # of numbers

        @classmethod
        def of(cls, record: object, **values: Any) -> Self: ...

else:

    class RowClass(type):
        """Makes a layout of every class of rows."""

        def __new__(cls, name, bases, space):
            made = super().__new__(cls, name, (), space)
            return Layout(made) if bases else made

    class Row(metaclass=RowClass):
        """Base of what declares a row."""
