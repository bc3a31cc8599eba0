"""From words to numbers: a machine record becomes the arrays of the kernels."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

import numpy as np

from nivel.kernels.bodies import rail
from nivel.kernels.bodies.measure import measure
from nivel.kernels.elements import friction
from nivel.kernels.record.record import (
    BOTH,
    ENDS_RUN,
    ENDS_STEP,
    FALLING,
    FRICTION,
    HOOKS,
    MEASURE,
    NOTED,
    POINTS,
    RAIL,
    RISING,
    SAMPLE,
    SENSE,
    Control,
    Frames,
    Hooks,
    Joints,
    Outputs,
    Record,
    Sensors,
    Watched,
)
from nivel.kernels.residual import point_inertia as points
from nivel.kernels.signals import sensor
from nivel.kernels.signals.control import apply as compute
from nivel.kernels.signals.input import apply as read_inputs
from nivel.kernels.signals.sampling import sample
from nivel.machine.machine_record import MachineRecord
from nivel.system.beams import add_beam, no_tangent, shared_mass
from nivel.system.bodies import body_tables, given_poses, given_velocities, machine_size
from nivel.system.builder import SystemBuilder
from nivel.system.control import add_control
from nivel.system.driver_rows import add_drivers
from nivel.system.elimination.partition import no_partition
from nivel.system.elimination.tree_tables import empty_tree
from nivel.system.flexible import no_flexible, no_modal_tree
from nivel.system.forces import FORCES
from nivel.system.gradient_beams import point_inertia
from nivel.system.hydraulics.components import ACTING, SENSED, add_circuits, add_components
from nivel.system.implicit import no_newton, no_residual
from nivel.system.inputs import add_inputs
from nivel.system.interfaces import refuse_unknown_interfaces
from nivel.system.layout import first_columns, frame_layout
from nivel.system.located import located
from nivel.system.rows import RowTable, add_couplings, add_joint, coordinate_units
from nivel.system.saddle import friction_parts, friction_tables, saddle_tables
from nivel.system.sensors import sensor_columns
from nivel.system.states.three_coordinates import no_rotations
from nivel.system.system import Equations, System
from nivel.system.tables import index_array
from nivel.system.user_states import add_states, sampled_states

DIRECTIONS = {"both": BOTH, "rising": RISING, "falling": FALLING}
# [s] time within which stiction stops a joint, until a run says better
STICK = 1e-3


# what reads or computes signals, each after what it reads; all other elements follow
ORDER: Final = (read_inputs, *SENSED, compute, *ACTING)


def build(machine: MachineRecord, equations: Equations, *, measured: bool = False) -> System:
    """Arrays of `machine` for a formulation with these equations; poses and velocities as given, not yet assembled.

    measured : every evaluation measures all joint coordinates, not only those that something needs.
    """
    refuse_unknown_interfaces(machine)
    draft, rows = _drafted(machine)
    if measured:
        draft.measure_all()
    names, joints = tuple(body.name for body in machine.bodies), tuple(joint.name for joint in machine.joints)
    row_names, units = [*rows.names], [*rows.units]
    if equations.normalisation:
        row_names += [f"{name}.euler_parameters" for name in names]
        units += ["1"] * len(names)
    record, size = _record(draft, rows, units, equations)
    states = draft.elements.states
    layout = frame_layout(names, joints, list(draft.joint_coordinates), row_names, draft.outputs.entries, states)
    system = System(
        record=record._replace(outputs=record.outputs._replace(column=index_array(first_columns(layout, states), 1))),
        equations=equations,
        layout=layout,
        bodies=names,
        joints=joints,
        events=tuple(event.name for event in machine.events),
        coupled=tuple(draft.noted),
        states=states,
        input_functions=tuple(draft.input_functions),
        nodes=tuple(draft.circuit.nodes.values()),
        frictions=tuple(force.name for force in machine.forces if force.type == "friction"),
        rows=tuple(row_names),
        row_owner=tuple(rows.owner),
        velocity_rows=frozenset(rows.velocity),
        row_units=tuple(units),
        coordinate_units=tuple(coordinate_units(name) for name in draft.joint_coordinates),
        point_masses=np.array([body.point_mass for body in machine.bodies], dtype=bool),
        frame_markers=frozenset(draft.frame_markers),
        marker_owners=tuple(draft.owners),
        as_placed=np.array([given is None for given in rows.given], dtype=bool),
        size=size,
        start=np.zeros(0),
    )
    poses, velocities = given_poses(machine), given_velocities(machine.bodies)
    return replace(system, start=system.state(poses.ravel(), *velocities))


def _drafted(machine: MachineRecord) -> tuple[SystemBuilder, RowTable]:
    """All elements of the machine, in the order in which they are numbered."""
    draft, rows = SystemBuilder(machine), RowTable()
    for joint in machine.joints:
        with draft.within(f"joints.{joint.name}"), located(f"joints.{joint.name}"):
            add_joint(draft, rows, joint)
    add_couplings(draft, rows)
    add_drivers(draft, rows)
    add_inputs(draft)
    add_circuits(draft)
    add_control(draft)
    add_components(draft)
    add_states(draft)
    for force in machine.forces:
        _add_force(draft, force)
    for beam in machine.beams:
        add_beam(draft, beam)
    for joint in machine.joints:
        for values in (joint.start, joint.start_rates):
            for name in values.given if values is not None else ():
                draft.coordinate(f"{joint.name}.{name}")
    draft.elements.order(ORDER)
    return draft, rows


def _record(draft: SystemBuilder, rows: RowTable, units: list[str], equations: Equations) -> tuple[Record, float]:
    """The arrays, for rows with these units, and the size of the machine [m]."""
    machine, count = draft.machine, len(units)
    # these may still add to the draft
    sensors, watched, sampled = sensor_columns(draft), _watched(draft), sampled_states(draft)
    markers = draft.markers.arrays()
    size = machine_size(given_poses(machine), markers)
    extra = friction_parts(draft, rows, count)
    bodies = body_tables(machine, size)
    constraints = rows.arrays([size if unit == "m" else 1.0 for unit in units], len(draft.frictions), len(extra))
    saddle = saddle_tables(rows, draft, extra, len(machine.bodies), count, equations)
    record = Record(
        bodies=bodies,
        rotations=no_rotations(),
        markers=markers,
        coordinates=draft.coordinates.arrays(),
        constraints=constraints,
        joints=Joints(
            first_marker=index_array([pair[0] for pair in rows.first_marker], 1),
            rows=index_array(rows.spans, 2),
            part=index_array(rows.first_part, 1),
            coordinate=index_array(list(draft.joint_coordinates.values()), 1),
        ),
        functions=draft.functions.arrays(),
        elements=draft.elements.arrays(),
        friction=friction_tables(draft, saddle, extra, count),
        circuit=draft.circuit.arrays(),
        saddle=saddle,
        tree=empty_tree(constraints),
        frames=Frames(bodies.R, bodies.theta, bodies.Rdot, bodies.Rddot),
        flexible=no_flexible(),
        modal=no_modal_tree(),
        shared=shared_mass(draft, machine.beams),
        points=point_inertia(draft, machine.beams),
        beams=no_tangent(),
        partition=no_partition(),
        residual=no_residual(),
        newton=no_newton(),
        sensors=Sensors(index_array(sensors, 4)),
        watched=watched,
        sampled=sampled,
        outputs=Outputs(np.zeros(len(draft.outputs.entries)), index_array(rows.reports, 2), index_array([], 1)),
        hooks=_hooks(draft, sensors=bool(sensors), sampled=len(sampled.state) > 0),
        control=_control(count),
    )
    return record, size


def _add_force(draft: SystemBuilder, force: Any) -> None:
    with located(f"forces.{force.name}"), draft.noting(), draft.within(f"forces.{force.name}"):
        FORCES[force.type].add(draft, force)


def _watched(draft: SystemBuilder) -> Watched:
    """Events, the surfaces of contacts and stops, and the switches of all functions."""
    events, taking = [], {state.event for state in draft.machine.states}
    for event in draft.machine.events:
        ends = ENDS_RUN if event.stop else ENDS_STEP if event.name in taking else NOTED
        with located(f"events.{event.name}.when"):
            events.append((draft.function(event.when, switching=False), DIRECTIONS[event.direction], ends))
    surfaces, switches = draft.elements.surfaces(), draft.functions.switches
    count = len(events) + len(surfaces) + len(switches)
    return Watched(
        event=index_array(events, 3),
        surface=index_array(surfaces, 2),
        switch=index_array(switches, 2),
        held=np.zeros(len(switches)),
        value=np.zeros(count),
        rate=np.zeros(count),
        followed=np.zeros(1, dtype=np.uint32),
    )


def _hooks(draft: SystemBuilder, *, sensors: bool, sampled: bool) -> Hooks:
    """Addresses of the optional components of this machine."""
    address = np.zeros(HOOKS, dtype=np.uint64)
    if draft.coordinates.what:
        address[MEASURE] = measure.address
    if draft.coordinates.rails:
        address[RAIL] = rail.apply.address
    if any(beam.has_gradients for beam in draft.machine.beams):
        address[POINTS] = points.apply.address
    if draft.frictions:
        address[FRICTION] = friction.apply.address
    if sampled:
        address[SAMPLE] = sample.address
    if sensors:
        address[SENSE] = sensor.apply.address
    return Hooks(address)


def _control(rows: int) -> Control:
    return Control(
        rank=np.array([rows, 0, 0], dtype=np.uint32),
        iterations=np.array([1, 0, 0], dtype=np.uint32),
        stabilise=np.zeros(4),
        energy=np.zeros(3),
        power=np.zeros(2),
        stored=np.zeros(1),
        stick=np.array([STICK, 0.0]),
        failure=np.zeros(1, dtype=np.uint32),
    )
