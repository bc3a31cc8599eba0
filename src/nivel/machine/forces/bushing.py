"""A bushing: an elastic and damped mounting in all six directions."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Final, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, PlainSerializer, PlainValidator, ValidationError, ValidationInfo, WithJsonSchema
from pydantic_core import InitErrorDetails

from nivel.machine.arithmetic import ExpressionError, FaultyParameterError
from nivel.machine.checked import Problem
from nivel.machine.forces.between import Between
from nivel.machine.forces.element import OUTPUTS
from nivel.machine.quantity import expression_fault, fault, listed, parameters_of, read_quantity, reported, shown

Array = NDArray[np.float64]
Diagonal = tuple[float, ...]
Matrix = tuple[tuple[float, ...], ...]

TOLERANCE: Final = 1e-9  # by which a matrix may miss symmetry, and an eigenvalue zero, relative to the largest entry

# kinds of the blocks: force by way, force by angle (and torque by way), torque by angle
_STIFFNESS: Final = ("stiffness", ("force per angle", "force"), "torsional stiffness")
_DAMPING: Final = ("damping", ("force per angular velocity", "impulse"), "torsional damping")


def _six(kinds: tuple[Any, Any, Any], value: Any, info: ValidationInfo) -> Diagonal | Matrix:
    """Six numbers, or 6×6 in rows, of these `kinds`."""
    value = listed(value)
    if not isinstance(value, list | tuple) or len(value) != 6:
        raise fault(f"six numbers, or six rows of six, were expected, got {_count(value)}")
    rows = [listed(row) for row in value]
    if not any(isinstance(row, list | tuple) for row in rows):
        return _read({(i,): (each, kinds[0 if i < 3 else 2]) for i, each in enumerate(rows)}, info)
    for at, row in enumerate(rows):
        if not isinstance(row, list | tuple) or len(row) != 6:
            raise _at((at,), fault(f"a row of six numbers was expected, got {_count(row)}"))
    entries = {(i, j): (each, kinds[(i > 2) + (j > 2)]) for i, row in enumerate(rows) for j, each in enumerate(row)}
    numbers = _read(entries, info)
    return tuple(numbers[6 * i : 6 * i + 6] for i in range(6))


def _read(entries: dict[tuple[int, ...], tuple[Any, Any]], info: ValidationInfo) -> tuple[float, ...]:
    """The numbers at these places, each of its kind; all faults at once."""
    numbers, lines = [], []
    for place, (value, kind) in entries.items():
        try:
            numbers.append(read_quantity(value, kind, parameters_of(info)))
        except FaultyParameterError:
            lines.append(InitErrorDetails(type=reported(), loc=place, input=None))
        except ExpressionError as problem:
            lines.append(InitErrorDetails(type=expression_fault(problem, value), loc=place, input=None))
    if lines:
        raise ValidationError.from_exception_data("Bushing", lines)
    return tuple(numbers)


def _at(place: tuple[int, ...], message: Any) -> ValidationError:
    return ValidationError.from_exception_data("Bushing", [InitErrorDetails(type=message, loc=place, input=None)])


def _count(value: Any) -> str:
    return f"a list of {len(value)}" if isinstance(value, list | tuple) else shown(value)


def _stiffness(value: Any, info: ValidationInfo) -> Diagonal | Matrix:
    return _six(_STIFFNESS, value, info)


def _damping(value: Any, info: ValidationInfo) -> Diagonal | Matrix:
    return _six(_DAMPING, value, info)


def _lists(value: Diagonal | Matrix) -> list[Any]:
    return [list(row) if isinstance(row, tuple) else row for row in value]


_LISTS: Final = PlainSerializer(_lists)
_NUMBER: Final = {"anyOf": [{"type": "number"}, {"type": "string"}]}
_ROW: Final = {"type": "array", "items": _NUMBER, "minItems": 6, "maxItems": 6}
_SCHEMA: Final = WithJsonSchema({"anyOf": [_ROW, {"type": "array", "items": _ROW, "minItems": 6, "maxItems": 6}]})


class Bushing(Between):
    """Forces and torques that resist the displacement and the turn of the second marker in the axes of the first."""

    outputs: ClassVar[tuple[str, ...]] = (
        *OUTPUTS,
        *(f"force_{axis}" for axis in "xyz"),
        *(f"torque_{axis}" for axis in "xyz"),
    )

    type: Literal["bushing"] = "bushing"
    stiffness: Annotated[Diagonal | Matrix, PlainValidator(_stiffness), _LISTS, _SCHEMA] = Field(
        description="three in N/m, three in N*m/rad, along and about x, y, z of the first marker; or 6×6"
    )
    damping: Annotated[Diagonal | Matrix, PlainValidator(_damping), _LISTS, _SCHEMA] = Field(
        default=(0.0,) * 6, description="three in N*s/m, three in N*m*s/rad; or 6×6"
    )

    @property
    def stiffness_matrix(self) -> Array:
        """(6, 6) [N/m, N/rad; N, N m/rad], axes of the first marker."""
        return _matrix(self.stiffness)

    @property
    def damping_matrix(self) -> Array:
        """(6, 6) [N s/m, N s/rad; N s, N m s/rad], axes of the first marker."""
        return _matrix(self.damping)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        for name, matrix in (("stiffness", self.stiffness_matrix), ("damping", self.damping_matrix)):
            largest = np.abs(matrix).max()
            if np.abs(matrix - matrix.T).max() > TOLERANCE * largest:
                row, column = np.unravel_index(np.abs(matrix - matrix.T).argmax(), (6, 6))
                message = f"`{name}` is symmetric; {matrix[row, column]:g} and {matrix[column, row]:g} differ"
                yield Problem((name,), message)
            elif _lowest(matrix) < -TOLERANCE:
                what = "stores" if name == "stiffness" else "loses"
                yield Problem((name,), f"`{name}`: some motion {what} negative energy; no eigenvalue may be negative")


def _matrix(values: Diagonal | Matrix) -> Array:
    array = np.array(values, dtype=float)
    return np.diag(array) if array.ndim == 1 else array


def _lowest(matrix: Array) -> float:
    """The lowest eigenvalue of a symmetric matrix scaled to a unit diagonal, in which lengths and angles are alike."""
    scale = np.sqrt(np.abs(np.diag(matrix)))
    scale[scale == 0] = np.sqrt(np.abs(matrix).max()) or 1.0
    return float(np.linalg.eigvalsh(matrix / np.outer(scale, scale))[0])
