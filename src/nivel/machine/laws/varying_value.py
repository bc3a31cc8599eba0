"""Values that vary: at points, with straight lines or a smooth curve between them, or by arithmetic of `time` and signals."""

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from pydantic import ValidationError
from pydantic_core import InitErrorDetails

from nivel.machine.core.record import unknown_word
from nivel.machine.units.arithmetic import LOCAL_SYMBOLS, evaluate, render
from nivel.machine.units.derivative import derivative
from nivel.machine.units.functions import (
    FEWEST,
    INTERPOLATIONS,
    SMOOTH,
    Interpolation,
    interpolated,
    misses_its_period,
    pieces,
)
from nivel.machine.units.measure import signal_dimensions
from nivel.machine.units.quantity import (
    ANY,
    UNREAD,
    Kind,
    bound_tree,
    fault,
    line_of,
    listed,
    read_quantity,
    shown,
    unread,
)
from nivel.machine.units.tree import TIME, Node, Parameters, signals
from nivel.machine.units.unit import KINDS
from nivel.words.arguments import checked_arguments, checked_fields
from nivel.words.wording import in_expressions

SIGNAL_PATH: Final = re.compile(r"[^\W\d_][\w-]*(\.[^\W\d]\w*){1,2}")


@checked_fields
@dataclass(frozen=True)
class Table:
    """`values` at `times` [s], which increase strictly; before the first and after the last the end values hold.

    interpolation : straight lines; a natural cubic spline (twice differentiable, not bent at its ends); monotone, which never overshoots;
    or a quintic spline (four times differentiable, at rest at its ends)
    of : what the table depends on, by its path if it is not time; `times` are then values of that

    Entries may be texts with units until the table stands in a record, which turns them into SI numbers.
    """

    times: tuple[Any, ...]
    values: tuple[Any, ...]
    interpolation: Interpolation = "linear"
    of: str = TIME

    def __post_init__(self) -> None:
        object.__setattr__(self, "times", tuple(listed(self.times)))
        object.__setattr__(self, "values", tuple(listed(self.values)))

    @checked_arguments
    def __call__(self, at: float) -> float:
        """The value at the time [s] `at`, or where the variable `of` has the value `at`."""
        if self.interpolation == "linear":
            return float(np.interp(at, self.times, self.values))
        return interpolated(self.interpolation, self.times, self.values, at)

    def coefficients(self) -> np.ndarray:
        """The polynomials between the points: value = Σ c[k, i] h^i with h = t - times[k].

        returns (n - 1, 4), of a quintic (n - 1, 6), SI; a table of one point has none
        """
        return self._pieces.copy()

    @cached_property
    def _pieces(self) -> np.ndarray:
        return pieces(self.interpolation, self.times, self.values)

    @property
    def signals(self) -> tuple[str, ...]:
        """The path of the signal that the table depends on; none where it depends on time."""
        return () if self.of == TIME else (self.of,)

    def ends_before(self, time: float) -> bool:
        """Whether the last point lies before `time` [s], by more than round-off, and what follows has another rate."""
        return self.interpolation not in SMOOTH and self.times[-1] < time * (1.0 - 1e-12)

    def written(self) -> dict[str, Any]:
        """The table as a mapping of a machine file."""
        of = {} if self.of == TIME else {"of": self.of}
        interpolation = {} if self.interpolation == "linear" else {"interpolation": self.interpolation}
        return {**of, first_column(self.of): list(self.times), "values": list(self.values), **interpolation}


def first_column(of: object) -> str:
    """The key of the first column of a table that depends on `of`."""
    return "times" if of == TIME else "points"


def read_table(
    given: Table | Mapping[str, object], kind: Kind, parameters: Parameters, local: Collection[str] = ()
) -> Table:
    """`given` as a table of a quantity of `kind`, in SI.

    Raises ValidationError with all faults and their places.
    """
    if isinstance(given, Table):
        columns = {first_column(given.of): given.times, "values": given.values}
        given = {**columns, "interpolation": given.interpolation, "of": given.of}
    of = given.get("of", TIME)
    of = in_expressions(of) if isinstance(of, str) else of
    first = first_column(of)
    lines = _faults_of_words(given, first, local)
    points = _read_column(first, given.get(first), _kind_of(of), parameters, lines)
    values = _read_column("values", given.get("values"), kind, parameters, lines)
    interpolation: Any = given.get("interpolation", "linear")
    if not lines:
        lines = _faults_of_columns(first, points, values, interpolation)
    if lines:
        raise ValidationError.from_exception_data("Table", lines)
    return Table(tuple(points), tuple(values), interpolation, str(of))


def _kind_of(of: object) -> Kind:
    """What the first column measures."""
    if of == TIME:
        return "time"
    dimensions = signal_dimensions(of) if isinstance(of, str) else ()
    return tuple(kind for kind, (_, _, its) in KINDS.items() if its in dimensions) or ANY


def _faults_of_words(given: Mapping[str, object], first: str, local: Collection[str]) -> list[InitErrorDetails]:
    """Of everything but the columns' entries."""
    lines = []
    keys = ("of", first, "values", "interpolation")
    for word in given:
        if word in ("times", "points") and word != first:
            what = "`times` belong to a table of `time`" if word == "times" else "a table of `time` has `times`"
            lines.append(line_of((word,), fault(f"{what}; write `{first}`", at_key=True)))
        elif word not in keys:
            lines.append(line_of((str(word),), fault(unknown_word(str(word), keys, "key"), at_key=True)))
    of = given.get("of", TIME)
    if not isinstance(of, str) or not (of == TIME or of in local or SIGNAL_PATH.fullmatch(of)):
        symbols = "".join(f", `{symbol}`" for symbol in local)
        expected = f"`time`{symbols} or a symbol such as `hinge.angle`"
        lines.append(line_of(("of",), fault(f"{expected} was expected, got {shown(of)}")))
    interpolation = given.get("interpolation", "linear")
    if interpolation not in INTERPOLATIONS:
        message = unknown_word(shown(interpolation).strip("`"), INTERPOLATIONS, "interpolation")
        lines.append(line_of(("interpolation",), fault(message)))
    return lines


def _read_column(
    word: str, given: object, kind: Kind, parameters: Parameters, lines: list[InitErrorDetails]
) -> list[float]:
    given = listed(given)
    if not isinstance(given, Sequence) or isinstance(given, str):
        message = f"`{word}` is missing" if given is None else f"a list was expected, got {shown(given)}"
        lines.append(line_of((word,), fault(message)))
        return []
    column = []
    for at, entry in enumerate(given):
        try:
            column.append(read_quantity(entry, kind, parameters))
        except UNREAD as problem:
            lines.append(line_of((word, at), unread(problem, entry, parameters)))
    return column


def _faults_of_columns(
    first: str, points: list[float], values: list[float], interpolation: str
) -> list[InitErrorDetails]:
    if len(points) != len(values):
        counts = f"got {len(values)} and {len(points)}"
        return [line_of(("values",), fault(f"a table needs as many values as {first}; {counts}"))]
    if not points:
        return [line_of((first,), fault(f"a table needs at least one {first.removesuffix('s')}"))]
    unit = " s" if first == "times" else ""
    for at in range(1, len(points)):
        if points[at] <= points[at - 1]:
            order = f"{points[at]:g}{unit} does not come after {points[at - 1]:g}{unit}"
            if points[at] == points[at - 1]:
                order += "; for a jump place them close together"
            return [line_of((first, at), fault(f"{first} increase; {order}"))]
    fewest = FEWEST[interpolation]
    if len(points) < fewest:
        wanted = {2: "two", 3: "three", 4: "four"}[fewest]
        return [line_of((first,), fault(f"a {interpolation} table needs at least {wanted} {first}, got {len(points)}"))]
    if misses_its_period(interpolation, values):
        ends = f"got {values[0]:g} and {values[-1]:g}"
        return [line_of(("values",), fault(f"a periodic table ends with the value with which it begins; {ends}"))]
    return []


@checked_fields
@dataclass(frozen=True)
class Expression:
    """Arithmetic of `time` [s] and signals, e.g. ``10 + 3*sin(2*pi*time)`` or ``-20*hinge.angle_rate``.

    Once in a record, the text has SI numbers only, in Python's syntax except for the dots in names of signals.
    """

    text: str

    @checked_arguments
    def __call__(self, time: float, values: Mapping[str, float] | None = None) -> float:
        """The value at `time` [s], SI. `values` are those of the signals by their paths.

        Raises ExpressionError where there is none.
        """
        return evaluate(self.tree, time, values)

    @cached_property
    def tree(self) -> Node:
        """The text as a tree without unbound names; `length`, `angle`, `value` and `rate` are local symbols."""
        return bound_tree(self.text, {}, LOCAL_SYMBOLS)

    @property
    def signals(self) -> tuple[str, ...]:
        """The paths of the signals, in the order in which they stand in the text; `time` is not a signal."""
        return signals(self.tree)

    @cached_property
    def derivative(self) -> "Expression":
        """The exact derivative with respect to time.

        Raises ExpressionError where there is none: corners, signals.
        """
        return expression_of(derivative(self.tree))


def expression_of(tree: Node) -> Expression:
    """The expression that `tree` is; its text may be longer than what is read from files."""
    expression = Expression(render(tree))
    vars(expression)["tree"] = tree  # as if computed already: cached_property keeps it there
    return expression
