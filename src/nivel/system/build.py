"""From words to numbers: a machine record becomes the arrays of the kernels."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import islice

import numpy as np

from nivel.elements.forces import FORCES
from nivel.errors import located
from nivel.kernels.bodies import rail
from nivel.kernels.bodies.measure import measure
from nivel.kernels.elements import friction
from nivel.kernels.record import record
from nivel.kernels.record.function import OUTPUT
from nivel.kernels.residual import point_inertia as points
from nivel.kernels.signals import sensor
from nivel.kernels.signals.functions import compute, read_inputs, sample
from nivel.kernels.signals.watch import MARK
from nivel.kernels.solve.saddle import SETTLED
from nivel.lazy import nivel
from nivel.machine.laws.varying_value import Expression, Table, expression_of
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.sides import marks
from nivel.system.bodies import body_tables, given_poses, given_velocities, machine_size
from nivel.system.builder import SystemBuilder
from nivel.system.elimination.partition import no_partition
from nivel.system.elimination.topology import empty_tree
from nivel.system.flexible import no_flexible, no_modal_tree
from nivel.system.implicit import no_newton, no_residual
from nivel.system.joint_frames import refuse_unknown_interfaces
from nivel.system.joint_rows import RowTable, add_joint, coordinate_units
from nivel.system.layout import first_columns, frame_layout
from nivel.system.saddle import friction_parts, friction_tables, moved_masses, saddle_tables
from nivel.system.signals.control import add_control, add_states, sampled_states
from nivel.system.signals.sensors import sensor_columns
from nivel.system.system import Equations, System
from nivel.system.tables import empty, index_array, zeros


def add_inputs(builder: SystemBuilder) -> None:
    """All inputs. Their functions are numbers `builder.inputs` of the functions, in the order of the machine."""
    for each in builder.machine.inputs:
        with located(f"inputs.{each.name}"), builder.noting():
            course = each.course
            function = builder.function(course if isinstance(course, Table) else float(course))
            output = builder.outputs.add((f"{each.name}.value", each.units or "1", f"input {each.name}"))
            builder.elements.add(read_inputs, [output, function])
            builder.inputs[each.name] = (OUTPUT, output, 0)
            builder.input_functions.append(function)


RUBBING = "nivel.elements.forces.friction:rub_off"
DIRECTIONS = {"both": record.BOTH, "rising": record.RISING, "falling": record.FALLING}
# [s] time within which stiction stops a joint, until a run says better
STICK = 1e-3
# marks of an event that are watched, at most
MOST_MARKS = 200


def build(machine: MachineRecord, equations: Equations, *, measured: bool = False) -> System:
    """Arrays of `machine` for a formulation with these equations; poses and velocities as given, not yet assembled.

    measured : every evaluation measures all joint coordinates, not only those that something needs.
    """
    refuse_unknown_interfaces(machine)
    builder, rows = _drafted(machine)
    if measured:
        builder.measure_all()
    names, joints = tuple(body.name for body in machine.bodies), tuple(joint.name for joint in machine.joints)
    row_names, units = [*rows.names], [*rows.units]
    if equations.normalisation:
        row_names += [f"{name}.euler_parameters" for name in names]
        units += ["1"] * len(names)
    whole, size = _record(builder, rows, units, equations)
    states = builder.elements.states
    layout = frame_layout(names, joints, list(builder.joint_coordinates), row_names, builder.outputs.entries, states)
    system = System(
        record=whole._replace(outputs=whole.outputs._replace(column=index_array(first_columns(layout, states), 1))),
        equations=equations,
        layout=layout,
        bodies=names,
        joints=joints,
        events=tuple(event.name for event in machine.events),
        coupled=tuple(builder.noted),
        states=states,
        input_functions=tuple(builder.input_functions),
        nodes=tuple(builder.circuit.nodes.values()),
        frictions=tuple(builder.friction_names),
        friction_loads=builder.friction_loads,
        rows=tuple(row_names),
        row_owner=tuple(rows.owner),
        velocity_rows=frozenset(rows.velocity),
        row_units=tuple(units),
        coordinate_units=tuple(coordinate_units(name) for name in builder.joint_coordinates),
        point_masses=np.array([body.point_mass for body in machine.bodies], dtype=bool),
        frame_markers=frozenset(builder.frame_markers),
        marker_owners=tuple(builder.owners),
        as_placed=np.array([given is None for given in rows.given], dtype=bool),
        size=size,
        start=np.zeros(0),
        units=tuple(builder.functions.units.values()),
        switching=tuple(builder.functions.switching),
    )
    poses, velocities = given_poses(machine), given_velocities(machine.bodies)
    return replace(system, start=system.state(poses.ravel(), *velocities))


def _drafted(machine: MachineRecord) -> tuple[SystemBuilder, RowTable]:
    """All elements of the machine, in the order in which they are numbered."""
    builder, rows = SystemBuilder(machine), RowTable()
    for joint in machine.joints:
        with builder.within(f"joints.{joint.name}"), located(f"joints.{joint.name}"):
            add_joint(builder, rows, joint)
    if machine.couplings:
        nivel.elements.joints.couplings.add_couplings(builder, rows)
    if machine.drivers:
        nivel.elements.joints.drivers.add_drivers(builder, rows)
    add_inputs(builder)
    if machine.hydraulics:
        nivel.system.circuit_elements.add_circuits(builder)
    add_control(builder)
    if machine.hydraulics:
        nivel.system.circuit_elements.add_components(builder)
    add_states(builder)
    for force in machine.forces:
        owner = f"forces.{force.name}"
        with located(owner), builder.noting(), builder.within(owner):
            FORCES[force.type].add(builder, force)
    for beam in machine.beams:
        nivel.elements.beams.models.add_beam(builder, beam)
    if machine.hydraulics:
        nivel.system.circuit_elements.add_ledger(builder)
    for joint in machine.joints:
        for values in (joint.start, joint.start_rates):
            for name in values.given if values is not None else ():
                builder.coordinate(f"{joint.name}.{name}")
    sensed, acting = nivel.system.circuit_elements.sensed_and_acting(machine) if machine.hydraulics else ([], [])
    # what reads or computes signals, each after what it reads; all other elements follow, last what reads their outputs
    builder.elements.order((read_inputs, *sensed, compute, *acting), RUBBING)
    return builder, rows


def _record(
    builder: SystemBuilder, rows: RowTable, units: list[str], equations: Equations
) -> tuple[record.Record, float]:
    """The arrays, for rows with these units, and the size of the machine [m]."""
    machine, count = builder.machine, len(units)
    # these may still add to the builder
    sensors, watched, sampled = sensor_columns(builder), _watched(builder), sampled_states(builder)
    markers = builder.markers.arrays()
    size = machine_size(given_poses(machine), markers)
    extra = friction_parts(builder, rows, count)
    bodies = body_tables(machine, size)
    constraints = rows.arrays([size if unit == "m" else 1.0 for unit in units], len(builder.frictions), len(extra))
    saddle = saddle_tables(rows, builder, extra, len(machine.bodies), count, equations)
    whole = record.Record(
        bodies=bodies,
        rotations=empty(record.Rotations),
        markers=markers,
        coordinates=builder.coordinates.arrays(),
        constraints=constraints,
        joints=record.Joints(
            first_marker=index_array([pair[0] for pair in rows.first_marker], 1),
            rows=index_array(rows.spans, 2),
            part=index_array(rows.first_part, 1),
            coordinate=index_array(list(builder.joint_coordinates.values()), 1),
        ),
        functions=builder.functions.arrays(),
        elements=builder.elements.arrays(),
        friction=friction_tables(builder, saddle, extra, count)._replace(mass=moved_masses(builder, bodies.mass)),
        circuit=builder.circuit.arrays(),
        saddle=saddle,
        tree=empty_tree(constraints),
        frames=record.Frames(bodies.R, bodies.theta, bodies.Rdot, bodies.Rddot),
        flexible=no_flexible(),
        modal=no_modal_tree(),
        shared=nivel.system.beam_tables.shared_mass(builder, machine.beams),
        points=nivel.system.beam_tables.point_inertia(builder, machine.beams),
        beams=nivel.system.beam_tables.no_tangent(),
        partition=no_partition(),
        residual=no_residual(),
        newton=no_newton(),
        sensors=record.Sensors(index_array(sensors, 4)),
        watched=watched,
        sampled=sampled,
        outputs=record.Outputs(
            np.zeros(len(builder.outputs.entries)), index_array(rows.reports, 2), index_array([], 1)
        ),
        hooks=_hooks(builder, sensors=bool(sensors), sampled=len(sampled.state) > 0),
        control=_control(count),
    )
    return whole, size


def _watched(builder: SystemBuilder) -> record.Watched:
    """Events, the surfaces of contacts and stops, and the switches of all functions."""
    events, marked, taking = [], [], {state.event for state in builder.machine.states}
    for event in builder.machine.events:
        ends = record.ENDS_RUN if event.stop else record.ENDS_STEP if event.name in taking else record.NOTED
        with located(f"events.{event.name}.when"):
            events.append((builder.function(event.when, sampled=True), DIRECTIONS[event.direction], ends))
            marked += [(builder.function(mark, sampled=True), record.BOTH, MARK) for mark in _marks_of(event.when)]
    events += marked
    surfaces, switches = builder.elements.surfaces(), builder.functions.switches
    count = len(events) + len(surfaces) + len(switches)
    return record.Watched(
        event=index_array(events, 3),
        surface=index_array(surfaces, 2),
        switch=index_array(switches, 2),
        held=np.zeros(len(switches)),
        **zeros("value rate", count),
        followed=np.zeros(5, dtype=np.uint32),
    )


def _marks_of(when: object) -> Iterator[Expression]:
    """What decides within the function of an event; of functions with more of that than a run can watch at no cost, nothing."""
    found = list(islice(marks(when), MOST_MARKS + 1)) if isinstance(when, Expression | Table) else []
    if len(found) <= MOST_MARKS:
        yield from map(expression_of, found)


def _hooks(builder: SystemBuilder, *, sensors: bool, sampled: bool) -> record.Hooks:
    """Addresses of the optional components of this machine."""
    address = np.zeros(record.HOOKS, dtype=np.uint64)
    if builder.coordinates.what:
        address[record.MEASURE] = measure.address
    if builder.coordinates.rails:
        address[record.RAIL] = rail.apply.address
    if any(beam.has_gradients for beam in builder.machine.beams):
        address[record.POINTS] = points.apply.address
    if builder.frictions:
        address[record.FRICTION] = friction.apply.address
    if sampled:
        address[record.SAMPLE] = sample.address
    if sensors:
        address[record.SENSE] = sensor.apply.address
    return record.Hooks(address)


def _control(rows: int) -> record.Control:
    return record.Control(
        rank=np.array([rows, 0, 0], dtype=np.uint32),
        iterations=np.array([1, 0, 0], dtype=np.uint32),
        stabilise=np.zeros(4),
        feedback=np.ones((rows, 2)),
        settled=np.array([SETTLED, 0.0]),
        energy=np.zeros(3),
        power=np.zeros(2),
        stored=np.zeros(1),
        stick=np.array([STICK, 0.0]),
        failure=np.zeros(1, dtype=np.uint32),
    )
