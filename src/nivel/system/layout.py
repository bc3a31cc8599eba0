"""Layout of an output frame: place and name of each number; `nivel.kernels.output.observe` fills it."""

from collections.abc import Sequence
from math import prod

from nivel.elements.facts import StateFact
from nivel.lazy import Struct


class Variable(Struct):
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


class FrameLayout(Struct):
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
# behind what elements report
OF_MODES: tuple[Entry, ...] = (
    ("modal_coordinate", ("time", "mode"), "kg^0.5 m", "modal coordinate of a mode of unit modal mass"),
    ("modal_rate", ("time", "mode"), "kg^0.5 m/s", "rate of the modal coordinate"),
    ("modal_acceleration", ("time", "mode"), "kg^0.5 m/s^2", "second derivative of the modal coordinate"),
)


def frame_layout(
    bodies: Sequence[str],
    joints: Sequence[str],
    joint_coordinates: Sequence[str],
    constraints: Sequence[str],
    outputs: Sequence[tuple[str, str, str]],
    states: Sequence[StateFact] = (),
) -> FrameLayout:
    """Layout of the frames of a machine with these names.

    outputs : (name, units, long name) of single numbers. states : first-order states of elements.
    """
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
    entries += [(fact.result, ("time",), fact.units, fact.long_name) for fact in states]
    return laid_out(entries, coordinates)


def laid_out(entries: Sequence[Entry], coordinates: dict[str, tuple[str, ...]], start: int = 1) -> FrameLayout:
    """Layout of the frames of these variables, (name, dimensions, units, long name), one after the other from column `start` on."""
    variables = []
    for name, dims, units, long_name in entries:
        stop = start + prod(len(coordinates[dim]) for dim in dims[1:])
        variables.append(Variable(name, dims, units, long_name, slice(start, stop)))
        start = stop
    return FrameLayout(start, tuple(variables), coordinates)


def with_modal_coordinates(layout: FrameLayout, modes: Sequence[str]) -> FrameLayout:
    """The layout with the coordinates of these modes and their derivatives behind all else."""
    added = laid_out(OF_MODES, {**layout.coordinates, "mode": tuple(modes)}, layout.width)
    return FrameLayout(added.width, layout.variables + added.variables, added.coordinates)


def first_columns(layout: FrameLayout, states: Sequence[StateFact]) -> list[int]:
    """First columns of what elements report, their states, VARIABLES and OF_MODES, as `nivel.kernels.output.observe` numbers them."""
    start = {variable.name: variable.columns.start for variable in layout.variables}
    reports = layout.variables[len(VARIABLES) - 1].columns.stop
    of_states = start[states[0].result] if states else layout.width
    return [reports, of_states, *(start.get(name, layout.width) for name, *_ in (*VARIABLES, *OF_MODES))]


def reported(layout: FrameLayout, count: int) -> tuple[Variable, ...]:
    """The variables that elements report, `count` single numbers in the order of `Outputs.value`."""
    return layout.variables[len(VARIABLES) : len(VARIABLES) + count]
