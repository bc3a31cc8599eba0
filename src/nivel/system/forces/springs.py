"""Springs and dampers in numbers: between points, between markers, on joint coordinates."""

from __future__ import annotations

import numpy as np

from nivel.kernels.bodies.coordinate import DISTANCE, ROTATION
from nivel.kernels.forces.spring import apply as spring
from nivel.kernels.forces.three_axis_spring import apply as three_axis_spring
from nivel.kernels.record.function import COORDINATE, RATE
from nivel.kernels.record.record import NONE
from nivel.machine.forces import Characteristic, JointSpringDamper, SpringDamper, ThreeAxisSpring, TorsionalSpringDamper
from nivel.system.builder import SystemBuilder
from nivel.system.forces.kind import ForceKind
from nivel.system.forces.outputs import effort_and_power, force_outputs, is_angle, magnitude_and_power


def add_spring_damper(builder: SystemBuilder, force: SpringDamper) -> None:
    """A spring and damper between two points."""
    coordinate = builder.coordinates.use(builder.coordinates.add(DISTANCE, *builder.ends(force.ends)))
    _add_spring(builder, force, coordinate, "length", force.free_length or 0.0)


def add_torsional_spring_damper(builder: SystemBuilder, force: TorsionalSpringDamper) -> None:
    """A torsional spring and damper between two markers."""
    coordinate = builder.coordinates.use(builder.coordinates.add(ROTATION, *builder.ends(force.ends)))
    _add_spring(builder, force, coordinate, "angle", force.free_angle)


def add_joint_spring_damper(builder: SystemBuilder, force: JointSpringDamper) -> None:
    """A spring and damper on a joint coordinate."""
    _add_spring(builder, force, builder.coordinate(force.coordinate), "value", force.free_value)


def _add_spring(
    builder: SystemBuilder,
    force: SpringDamper | TorsionalSpringDamper | JointSpringDamper,
    coordinate: int,
    symbol: str,
    free: float,
) -> None:
    angle = is_angle(builder, coordinate)
    first = force_outputs(
        builder,
        force.name,
        *effort_and_power(angle, "effort that resists the coordinate"),
        (symbol, "rad" if angle else "m", symbol),
        ("rate", "rad/s" if angle else "m/s", f"rate of the {symbol}"),
    )
    table, energy, law = NONE, NONE, NONE
    if force.table is not None:
        table, energy = _characteristic(builder, force.table)
    if force.law is not None:
        law = builder.function(force.law, {symbol: (COORDINATE, coordinate, 0), "rate": (RATE, coordinate, 0)})
    numbers = [force.stiffness or 0.0, force.damping, free, force.preload]
    builder.elements.add(spring, [first, coordinate, table, energy, law], numbers)


def _characteristic(builder: SystemBuilder, table: Characteristic) -> tuple[int, int]:
    """Tables of the effort over the deflection, and of the energy stored since zero deflection."""
    x, effort = (np.array(column, dtype=float) for column in table.points)
    slope = np.diff(effort) / np.diff(x)
    slope = np.append(slope, slope[-1])
    nothing = np.zeros(len(x))
    energy = np.concatenate([[0.0], np.cumsum(0.5 * (effort[1:] + effort[:-1]) * np.diff(x))])
    # the piece that holds zero, or the end piece that goes on to it
    at = int(np.clip(np.searchsorted(x, 0.0, side="right") - 1, 0, len(x) - 1))
    energy -= energy[at] - effort[at] * x[at] + 0.5 * slope[at] * x[at] ** 2
    force = builder.functions.add_table(x.tolist(), np.column_stack([effort, slope, nothing, nothing]))
    stored = builder.functions.add_table(x.tolist(), np.column_stack([energy, effort, 0.5 * slope, nothing]))
    return force, stored


def add_three_axis_spring(builder: SystemBuilder, force: ThreeAxisSpring) -> None:
    """Springs and dampers along the global axes."""
    components = ((f"force_{axis}", "N", f"force on the second body along global {axis}") for axis in "xyz")
    first = force_outputs(builder, force.name, *magnitude_and_power("N"), *components)
    numbers = [*force.stiffness, *force.damping, *force.free_displacement, *force.preload]
    builder.elements.add(three_axis_spring, [first, *builder.ends(force.ends)], numbers)


KINDS = (
    ForceKind(SpringDamper, add_spring_damper, (spring,)),
    ForceKind(TorsionalSpringDamper, add_torsional_spring_damper, (spring,)),
    ForceKind(JointSpringDamper, add_joint_spring_damper, (spring,)),
    ForceKind(ThreeAxisSpring, add_three_axis_spring, (three_axis_spring,)),
)
