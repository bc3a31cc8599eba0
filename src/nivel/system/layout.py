"""Where each number of an output frame stands, and what it is called. The order is that of `nivel.kernels.observe.observe`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import prod


@dataclass(frozen=True)
class Variable:
    """One result variable and its place in a frame.

    dims : the first is always "time"; the others are keys of `FrameLayout.coordinates`.
    units : SI, e.g. "m"; "1" where the variable has none.
    columns : its columns of a frame, in C order over the dimensions after time.
    """

    name: str
    dims: tuple[str, ...]
    units: str
    long_name: str
    columns: slice


@dataclass(frozen=True)
class FrameLayout:
    """The columns of a frame: a row of `width` float64, column 0 is the time in seconds.

    variables : every variable but the time.
    coordinates : dimension name → the names along it, e.g. "body" → ("crank", "rod").
    """

    width: int
    variables: tuple[Variable, ...]
    coordinates: dict[str, tuple[str, ...]]


XYZ = ("x", "y", "z")
VECTOR = ("time", "body", "xyz")
REACTION = ("time", "joint", "xyz")

# name, dimensions, units, long name
Entry = tuple[str, tuple[str, ...], str, str]

# units of rows and joint coordinates differ and stand in the result's attributes
VARIABLES: tuple[Entry, ...] = (
    ("position", VECTOR, "m", "position of the body frame, global axes"),
    ("orientation", ("time", "body", "euler_parameter"), "1", "Euler parameters of the body frame, scalar first"),
    ("velocity", VECTOR, "m/s", "velocity of the body frame's origin, global axes"),
    ("angular_velocity", VECTOR, "rad/s", "angular velocity, global axes"),
    ("acceleration", VECTOR, "m/s^2", "acceleration of the body frame's origin, global axes"),
    ("angular_acceleration", VECTOR, "rad/s^2", "angular acceleration, global axes"),
    ("joint_force", REACTION, "N", "force on the first body at the first marker, global axes"),
    ("joint_torque", REACTION, "N m", "torque on the first body about the first marker, global axes"),
    ("joint_force_local", REACTION, "N", "force on the first body at the first marker, axes of that marker"),
    ("joint_torque_local", REACTION, "N m", "torque on the first body about the first marker, axes of that marker"),
    ("joint_coordinate", ("time", "joint_coordinate"), "", "joint coordinate"),
    ("joint_rate", ("time", "joint_coordinate"), "", "rate of the joint coordinate"),
    ("constraint_violation", ("time", "constraint"), "", "violation of the constraint, position level"),
    ("constraint_rate_violation", ("time", "constraint"), "", "violation of the constraint, velocity level"),
    ("constraint_force", ("time", "constraint"), "", "Lagrange multiplier of the constraint"),
    ("kinetic_energy", ("time",), "J", "kinetic energy"),
    ("potential_energy", ("time",), "J", "potential energy"),
    ("external_work", ("time",), "J", "work of the external forces since the start"),
    ("dissipated_energy", ("time",), "J", "energy dissipated since the start"),
    ("energy_error", ("time",), "J", "change of kinetic and potential energy less work plus dissipation"),
)


def frame_layout(
    bodies: Sequence[str],
    joints: Sequence[str],
    joint_coordinates: Sequence[str],
    constraints: Sequence[str],
    outputs: Sequence[tuple[str, str, str]],
) -> FrameLayout:
    """Layout of the frames of a machine with these names; `outputs` are (name, units, long name) of single numbers."""
    coordinates = {
        "body": tuple(bodies),
        "joint": tuple(joints),
        "joint_coordinate": tuple(joint_coordinates),
        "constraint": tuple(constraints),
        "xyz": XYZ,
        "euler_parameter": ("0", "1", "2", "3"),
    }
    entries = list(VARIABLES)
    entries += [(name, ("time",), units, long_name) for name, units, long_name in outputs]
    return laid_out(entries, coordinates)


def laid_out(entries: Sequence[Entry], coordinates: dict[str, tuple[str, ...]]) -> FrameLayout:
    """Layout of the frames of these variables, (name, dimensions, units, long name), one after the other behind the time."""
    variables, start = [], 1
    for name, dims, units, long_name in entries:
        stop = start + prod(len(coordinates[dim]) for dim in dims[1:])
        variables.append(Variable(name, dims, units, long_name, slice(start, stop)))
        start = stop
    return FrameLayout(start, tuple(variables), coordinates)


def with_modal_coordinates(layout: FrameLayout, modes: Sequence[str]) -> FrameLayout:
    """The layout with the coordinates and rates of these modes behind all else."""
    count, first = len(modes), layout.width
    named = (
        ("modal_coordinate", "kg^0.5 m", "modal coordinate of a mode of unit modal mass"),
        ("modal_rate", "kg^0.5 m/s", "rate of the modal coordinate"),
    )
    variables = tuple(
        Variable(name, ("time", "mode"), units, text, slice(first + k * count, first + (k + 1) * count))
        for k, (name, units, text) in enumerate(named)
    )
    coordinates = {**layout.coordinates, "mode": tuple(modes)}
    return FrameLayout(first + 2 * count, layout.variables + variables, coordinates)
