"""Orientation of a frame: Euler angles, axis and angle, matrix or Euler parameters, and their common numbers.

A rotation matrix A has the axes of the turned frame as columns, given in the parent frame: v = A v_b.
Euler parameters are (cos φ/2, n sin φ/2), scalar first, for a turn by φ about the unit axis n.
"""

from typing import Annotated, Any, Final

import numpy as np
from pydantic import BeforeValidator, model_validator

from nivel.machine.core.record import Record, unknown_word
from nivel.machine.core.vectors import Array, cross
from nivel.machine.given import Field, FourNumbers, Maybe, ThreeNumbers, ThreeRows
from nivel.machine.units.quantity import Angle, Direction, Scalar, fault, listed, shown

SEQUENCES: Final = ("xyx", "xyz", "xzx", "xzy", "yxy", "yxz", "yzx", "yzy", "zxy", "zxz", "zyx", "zyz")
TOLERANCE: Final = 1e-3  # data printed with three digits are taken, and made exact


def _sequence(value: Any) -> str:
    text = str(value) if isinstance(value, int) and not isinstance(value, bool) else value
    if not isinstance(text, str):
        raise fault(f"a sequence of three axes such as `zxz` was expected, got {shown(value)}")
    axes = text.translate(str.maketrans("123", "xyz"))
    if axes in SEQUENCES:
        return axes
    if axes.lower() in SEQUENCES:
        raise fault(
            f"`{text}`: capital letters mean fixed axes in some programs; here every turn is about the moving axes: "
            f"write `{axes.lower()}`, or for turns about fixed axes `{axes.lower()[::-1]}` with the angles reversed"
        )
    raise fault(unknown_word(text, SEQUENCES, "sequence"))


AxisSequence = Annotated[str, BeforeValidator(_sequence, json_schema_input_type=str | int)]
_Row = Direction
_FORMS = ("euler", "axis", "matrix", "euler_parameters")


class Orientation(Record):
    """One of: `euler` with `sequence` (turns about the moving axes), `axis` with `angle`, `matrix`, `euler_parameters`.

    None of them: not turned.
    """

    euler: Annotated[Maybe[ThreeNumbers[Angle]], BeforeValidator(listed)] = Field(
        "three angles, each about an axis of the frame as turned so far", default=None
    )
    sequence: AxisSequence | None = Field("axes of the three turns; zxz is the classical 3-1-3", default=None)
    axis: Maybe[Direction] = Field("axis of the turn, of any length", default=None)
    angle: Maybe[Angle] = Field("turn about `axis`, right-handed", default=None)
    matrix: Annotated[Maybe[ThreeRows[_Row]], BeforeValidator(listed)] = Field(
        "rows of the rotation matrix; its columns are the axes of the turned frame", default=None
    )
    euler_parameters: Annotated[Maybe[FourNumbers[Scalar]], BeforeValidator(listed)] = Field(
        "four numbers, scalar first", default=None
    )

    @model_validator(mode="after")
    def _one_form(self) -> "Orientation":
        given = [name for name in _FORMS if getattr(self, name) is not None]
        if len(given) > 1:
            raise fault(f"give one of {', '.join(_FORMS)}; got {' and '.join(given)}")
        if (self.euler is None) != (self.sequence is None):
            raise fault("`euler` and `sequence` belong together, e.g. `{euler: [0, 30 deg, 0], sequence: zxz}`")
        if (self.axis is None) != (self.angle is None):
            raise fault("`axis` and `angle` belong together, e.g. `{axis: [1, 0, 0], angle: 30 deg}`")
        if self.axis is not None and not np.any(self.axis):
            raise fault("`axis` has no direction: it is zero")
        if self.matrix is not None:
            _check_matrix(np.array(self.matrix))
        if self.euler_parameters is not None and abs(np.linalg.norm(self.euler_parameters) - 1) > TOLERANCE:
            raise fault(f"`euler_parameters` must have length 1, not {np.linalg.norm(self.euler_parameters):.6g}")
        return self


def _check_matrix(matrix: Array) -> None:
    error = np.abs(matrix.T @ matrix - np.eye(3)).max()
    if error > TOLERANCE:
        raise fault(
            f"`matrix` is no rotation: its columns are not perpendicular unit vectors (they miss by {error:.2g})"
        )
    if np.linalg.det(matrix) < 0:
        raise fault("`matrix` is a reflection, not a rotation: its third column must be the first × the second")


def elementary_rotation(axis: int, angle: float) -> Array:
    """(3, 3) turn by `angle` about axis 0, 1 or 2 (x, y, z)."""
    c, s = np.cos(angle), np.sin(angle)
    matrix = np.eye(3)
    j, k = (axis + 1) % 3, (axis + 2) % 3
    matrix[j, j] = matrix[k, k] = c
    matrix[k, j], matrix[j, k] = s, -s
    return matrix


def rotation_matrix(orientation: Orientation | None) -> Array:
    """(3, 3): columns are the axes of the turned frame in the parent frame. None: not turned."""
    if orientation is None:
        return np.eye(3)
    if orientation.matrix is not None:
        left, _, right = np.linalg.svd(np.array(orientation.matrix))
        return left @ right  # the nearest rotation
    if orientation.euler is not None and orientation.sequence is not None:
        first, second, third = (
            elementary_rotation("xyz".index(axis), angle)
            for axis, angle in zip(orientation.sequence, orientation.euler, strict=True)
        )
        return first @ second @ third  # each turn about the axes as turned so far
    return matrix_from_euler_parameters(euler_parameters(orientation))


def euler_parameters(orientation: Orientation | None) -> Array:
    """(4,) of unit length, scalar first and not negative."""
    if orientation is None:
        return np.array([1.0, 0.0, 0.0, 0.0])
    if orientation.euler_parameters is not None:
        return _normalised(np.array(orientation.euler_parameters))
    if orientation.axis is not None and orientation.angle is not None:
        axis = np.array(orientation.axis)
        axis = axis / np.abs(axis).max()  # no overflow in the norm
        half = orientation.angle / 2
        return _normalised(np.concatenate([[np.cos(half)], np.sin(half) * axis / np.linalg.norm(axis)]))
    if orientation.matrix is None and orientation.euler is None:
        return np.array([1.0, 0.0, 0.0, 0.0])
    return euler_parameters_from_matrix(rotation_matrix(orientation))


def _normalised(parameters: Array) -> Array:
    """Unit length and the sign that makes the scalar part not negative."""
    return parameters / np.linalg.norm(parameters) * (-1.0 if parameters[0] < 0 else 1.0)


def matrix_from_euler_parameters(parameters: Array) -> Array:
    """(3, 3) rotation matrix of unit Euler parameters (4,)."""
    e0, e = parameters[0], parameters[1:]
    tilde = np.array([[0.0, -e[2], e[1]], [e[2], 0.0, -e[0]], [-e[1], e[0], 0.0]])
    return (e0**2 - e @ e) * np.eye(3) + 2 * np.outer(e, e) + 2 * e0 * tilde


def euler_parameters_from_matrix(matrix: Array) -> Array:
    """(4,) of a rotation matrix, scalar part not negative.

    4 θ θᵀ is linear in the matrix; the row with the largest diagonal is the best conditioned multiple of θ.
    """
    (a, b, c), (d, e, f), (g, h, i) = matrix.tolist()
    trace = a + e + i
    rows = (
        (1 + trace, h - f, c - g, d - b),
        (h - f, a + a + (1 - trace), b + d, c + g),
        (c - g, d + b, e + e + (1 - trace), f + h),
        (d - b, g + c, h + f, i + i + (1 - trace)),
    )
    return _normalised(np.array(rows[int(np.argmax([rows[k][k] for k in range(4)]))]))


def product(first: Array, second: Array) -> Array:
    """Euler parameters (…, 4) of A(first) A(second)."""
    if first.ndim == second.ndim == 1:  # the same numbers, at a tenth of the time
        (a0, a1, a2, a3), (b0, b1, b2, b3) = first.tolist(), second.tolist()
        scalar = a0 * b0 - (a1 * b1 + a2 * b2 + a3 * b3)
        x, y, z = a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1
        return np.array([scalar, a0 * b1 + b0 * a1 + x, a0 * b2 + b0 * a2 + y, a0 * b3 + b0 * a3 + z])
    a0, a, b0, b = first[..., :1], first[..., 1:], second[..., :1], second[..., 1:]
    scalar = a0 * b0 - np.sum(a * b, axis=-1, keepdims=True)
    return np.concatenate([scalar, a0 * b + b0 * a + cross(a, b)], axis=-1)


def conjugate(theta: Array) -> Array:
    """Euler parameters (…, 4) of Aᵀ."""
    return theta * np.array([1.0, -1.0, -1.0, -1.0])
