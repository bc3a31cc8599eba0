"""Mass, centre of mass and inertia tensor of a body: as given, or from its shape.

Tensors are about the stated point in body axes with tensor components: I_xx = ∫(y² + z²) dm, I_xy = -∫ x y dm.
"""

import re
from collections.abc import Mapping
from typing import Annotated, Any, Final

import numpy as np
from pydantic import BeforeValidator, ValidationInfo

from nivel.known import Body
from nivel.lazy import Struct
from nivel.machine.bodies.solids import centroid, squared_gyration, volume
from nivel.machine.core.record import Record
from nivel.machine.core.vectors import Array
from nivel.machine.given import Field, Given, SomeNumbers, SomeRows
from nivel.machine.units.quantity import InertiaComponent, fault, listed, parameters_of, read_quantity, reported, shown
from nivel.machine.units.tree import ExpressionError, FaultyParameterError

# Moments of a thin plate obey I_z = I_x + I_y exactly; printed with three digits they may break it by half a percent.
TRIANGLE_TOLERANCE: Final = 5e-3
SYMMETRY_TOLERANCE: Final = 1e-6
_ORDER: Final = ("xx", "yy", "zz", "xy", "xz", "yz")  # of six numbers
_NUMBER: Final = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"


class Inertia(Record):
    """Inertia tensor in body axes. xy is the tensor component -∫ x y dm."""

    xx: InertiaComponent
    yy: InertiaComponent
    zz: InertiaComponent
    xy: InertiaComponent = Field(default=0.0)
    xz: InertiaComponent = Field(default=0.0)
    yz: InertiaComponent = Field(default=0.0)


def _components(value: Any, info: ValidationInfo) -> Any:
    """Three principal moments, or a symmetric 3×3 matrix, as a mapping of components."""
    value = listed(value)
    if isinstance(value, Inertia | Mapping):
        return value
    if not isinstance(value, list | tuple) or len(value) != 3:
        raise fault(
            "three moments [xx, yy, zz], a mapping {xx: …, yy: …, zz: …, xy: …, xz: …, yz: …} or a 3×3 matrix "
            f"was expected, got {f'a list of {len(value)}' if isinstance(value, list | tuple) else shown(value)}{_line(value)}"
        )
    if not any(isinstance(row, list | tuple) for row in map(listed, value)):
        return dict(zip(("xx", "yy", "zz"), value, strict=True))
    return _from_matrix([listed(row) for row in value], info)


def _line(value: Any) -> str:
    """What to write where one moment is given, or three or six in another form."""
    if isinstance(value, list | tuple) and len(value) == 6:
        return (
            "; write `inertia: {" + ", ".join(f"{key}: {each}" for key, each in zip(_ORDER, value, strict=True)) + "}`"
        )
    if isinstance(value, list | tuple) and len(value) == 1:
        value = value[0]
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        return ""
    found = re.findall(_NUMBER, str(value))
    if len(found) == 3:
        return f"; write `inertia: [{', '.join(found)}]`"
    if not re.match(_NUMBER, str(value)):
        return ""
    return f"; write `inertia: [{value}, {value}, {value}]`, or give a `shape` instead"


def _from_matrix(rows: list[Any], info: ValidationInfo) -> dict[str, float]:
    if not all(isinstance(row, list | tuple) and len(row) == 3 for row in rows):
        raise fault("an inertia matrix has three rows of three")
    try:
        matrix = np.array([[read_quantity(each, "inertia", parameters_of(info)) for each in row] for row in rows])
    except FaultyParameterError:
        raise reported() from None
    except ExpressionError as problem:
        raise fault(str(problem)) from None
    if np.abs(matrix - matrix.T).max() > SYMMETRY_TOLERANCE * np.abs(matrix).max():
        raise fault("an inertia matrix is symmetric; this one is not")
    matrix = (matrix + matrix.T) / 2
    places = {"xx": (0, 0), "yy": (1, 1), "zz": (2, 2), "xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}
    return {name: float(matrix[place]) for name, place in places.items()}


_MOMENTS_OR_MATRIX: Final = list[float | str] | list[list[float | str]]
InertiaTensor = Annotated[
    Given[Inertia, Inertia, Inertia | Mapping[str, float | str] | SomeNumbers | SomeRows],
    BeforeValidator(_components, json_schema_input_type=Inertia | _MOMENTS_OR_MATRIX),
]


class MassProperties(Struct):
    """mass [kg]; centre_of_mass (3,) [m] in the body frame; inertia (3, 3) [kg m²] about the centre of mass, body
    axes.
    """

    mass: float
    centre_of_mass: Array
    inertia: Array


def mass_properties(body: Body) -> MassProperties:
    """As given, or those of the homogeneous shape; of a point mass the mass alone."""
    if body.point_mass:
        return MassProperties(float(body.mass or 0.0), np.zeros(3), np.zeros((3, 3)))
    if body.inertia is None:
        return _of_homogeneous_shape(body)
    mass = float(body.mass or 0.0)
    centre = np.array(body.centre_of_mass or (0.0, 0.0, 0.0))
    inertia = tensor(body.inertia)
    if body.inertia_about == "origin":
        inertia = inertia - point_mass_inertia(mass, centre)
    return MassProperties(mass, centre, inertia)


def mass_of(body: Body) -> float:
    """[kg] as given, or of its shape by its density; 0 of a flexible body, whose mass is in its modes."""
    if body.mass is None and body.density is not None and body.shape is not None:
        return body.density * volume(body.shape)
    return body.mass or 0.0


def _of_homogeneous_shape(body: Body) -> MassProperties:
    shape = body.shape
    if shape is None:
        raise ValueError(f"body {body.name} has neither inertia nor shape")
    mass = mass_of(body)
    return MassProperties(mass, centroid(shape), mass * squared_gyration(shape))


def tensor(inertia: Inertia) -> Array:
    """(3, 3) symmetric."""
    i = inertia
    return np.array([[i.xx, i.xy, i.xz], [i.xy, i.yy, i.yz], [i.xz, i.yz, i.zz]])


def point_mass_inertia(mass: float, position: Array) -> Array:
    """(3, 3) of a point mass at `position` (3,) about the origin: m (|r|² 1 - r rᵀ). The term of the parallel-axis
    theorem.
    """
    return mass * (position @ position * np.eye(3) - np.outer(position, position))


def impossible(inertia: Array) -> str:
    """Why no mass distribution has this tensor (3, 3) about its centre of mass, or an empty text.

    All principal moments are positive, and none exceeds the sum of the other two.
    """
    moments, directions = np.linalg.eigh(inertia)
    scale = np.abs(moments).max()
    if moments[0] <= 1e-12 * scale:
        where = _axis(directions[:, 0])
        return f"the moment of inertia about {where}, {_round(moments[0])} kg*m^2, must be greater than zero"
    excess = moments[2] - moments[0] - moments[1]
    if excess > TRIANGLE_TOLERANCE * scale:
        return (
            f"the moment of inertia about {_axis(directions[:, 2])}, {_round(moments[2])} kg*m^2, "
            f"exceeds the sum of the other two, {_round(moments[0])} + {_round(moments[1])} kg*m^2: impossible"
        )
    return ""


def _axis(direction: Array) -> str:
    """The body axis along `direction` (3,), or the direction itself."""
    nearest = int(np.argmax(np.abs(direction)))
    if abs(direction[nearest]) > 1 - 1e-9:
        return "the body " + "xyz"[nearest] + " axis"
    direction = direction * np.sign(direction[nearest])
    return f"the principal axis ({', '.join(f'{part:.3g}' for part in direction)})"


def _round(value: float) -> str:
    return f"{value:.6g}"
