"""Symmetric 6×6 matrices of stiffness or damping as people write them: six numbers of the diagonal, or six rows of six."""

from collections.abc import Iterator
from typing import Annotated, Any, Final

import numpy as np
from pydantic import PlainSerializer, PlainValidator, ValidationError, ValidationInfo, WithJsonSchema

from nivel.machine.core.vectors import Array
from nivel.machine.units import quantity

Diagonal = tuple[float, ...]
Matrix = tuple[tuple[float, ...], ...]
Kinds = tuple[quantity.Kind, quantity.Kind, quantity.Kind]

TOLERANCE: Final = 1e-9  # by which a matrix may miss symmetry, and an eigenvalue zero, relative to the largest entry
_NUMBER: Final = {"anyOf": [{"type": "number"}, {"type": "string"}]}
_ROW: Final = {"type": "array", "items": _NUMBER, "minItems": 6, "maxItems": 6}
_SCHEMA: Final = WithJsonSchema({"anyOf": [_ROW, {"type": "array", "items": _ROW, "minItems": 6, "maxItems": 6}]})


def six_by_six(kinds: Kinds) -> Any:
    """Type of a field: six numbers, or 6×6 in rows. kinds : of the first block of three, of the mixed ones, of the second."""

    def read(value: Any, info: ValidationInfo) -> Diagonal | Matrix:
        return _six(kinds, value, info)

    return Annotated[Diagonal | Matrix, PlainValidator(read), PlainSerializer(_lists), _SCHEMA]


def full_matrix(values: Diagonal | Matrix) -> Array:
    """(6, 6)"""
    array = np.array(values, dtype=float)
    return np.diag(array) if array.ndim == 1 else array


def asymmetry(matrix: Array) -> tuple[float, float] | None:
    """Two entries that should be equal and are not."""
    if np.abs(matrix - matrix.T).max() <= TOLERANCE * np.abs(matrix).max():
        return None
    row, column = np.unravel_index(np.abs(matrix - matrix.T).argmax(), matrix.shape)
    return float(matrix[row, column]), float(matrix[column, row])


def lowest_eigenvalue(matrix: Array) -> float:
    """The lowest eigenvalue of a symmetric matrix scaled to a unit diagonal, in which lengths and angles are alike."""
    scale = np.sqrt(np.abs(np.diag(matrix)))
    scale[scale == 0] = np.sqrt(np.abs(matrix).max()) or 1.0
    return float(np.linalg.eigvalsh(matrix / np.outer(scale, scale))[0])


def _six(kinds: Kinds, value: Any, info: ValidationInfo) -> Diagonal | Matrix:
    value = quantity.listed(value)
    if not isinstance(value, list | tuple) or len(value) != 6:
        raise quantity.fault(f"six numbers, or six rows of six, were expected, got {_count(value)}")
    rows = [quantity.listed(row) for row in value]
    if not any(isinstance(row, list | tuple) for row in rows):
        return tuple(_read({(i,): (each, kinds[0 if i < 3 else 2]) for i, each in enumerate(rows)}, info))
    for at, row in enumerate(rows):
        if not isinstance(row, list | tuple) or len(row) != 6:
            raise _at((at,), quantity.fault(f"a row of six numbers was expected, got {_count(row)}"))
    entries = {(i, j): (each, kinds[(i > 2) + (j > 2)]) for i, row in enumerate(rows) for j, each in enumerate(row)}
    numbers = _read(entries, info)
    return tuple(tuple(numbers[6 * i : 6 * i + 6]) for i in range(6))


def _read(entries: dict[tuple[int, ...], tuple[Any, quantity.Kind]], info: ValidationInfo) -> list[float]:
    """The numbers at these places, each of its kind; all faults at once."""
    numbers, lines = [], []
    for place, (value, kind) in entries.items():
        try:
            numbers.append(quantity.read_quantity(value, kind, quantity.parameters_of(info)))
        except quantity.UNREAD as problem:
            lines.append(quantity.line_of(place, quantity.unread(problem, value, quantity.parameters_of(info))))
    if lines:
        raise ValidationError.from_exception_data("matrix", lines)
    return numbers


def _at(place: tuple[int, ...], message: Any) -> ValidationError:
    return ValidationError.from_exception_data("matrix", [quantity.line_of(place, message)])


def _count(value: Any) -> str:
    return f"a list of {len(value)}" if isinstance(value, list | tuple) else quantity.shown(value)


def _lists(value: Diagonal | Matrix) -> list[Any]:
    return [list(row) if isinstance(row, tuple) else row for row in value]


def symmetry_and_sign(name: str, matrix: Array, what: str) -> Iterator[str]:
    """Sentences about a matrix that is not symmetric, or has a negative eigenvalue; `what` it does to energy."""
    pair = asymmetry(matrix)
    if pair is not None:
        yield f"`{name}` is symmetric; {pair[0]:g} and {pair[1]:g} differ"
    elif lowest_eigenvalue(matrix) < -TOLERANCE:
        yield f"`{name}`: some motion {what} negative energy; no eigenvalue may be negative"
