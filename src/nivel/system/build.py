"""From words to numbers: a machine record becomes the arrays of the kernels."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from itertools import pairwise
from typing import Any

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.kernels.record import (
    BOTH,
    FALLING,
    FRICTION,
    HOOKS,
    MEASURE,
    NONE,
    POINTS,
    RAIL,
    RISING,
    SENSE,
    Bodies,
    Control,
    Frames,
    Friction,
    Hooks,
    Joints,
    Markers,
    Outputs,
    Record,
    Saddle,
    Sensors,
    Watched,
)
from nivel.machine.body import Body
from nivel.machine.inertia import mass_properties
from nivel.machine.machine_record import MachineRecord
from nivel.machine.placement import initial_velocity, placement
from nivel.system.beams import add_beam, no_tangent, shared_mass
from nivel.system.draft import Draft
from nivel.system.elimination import plan
from nivel.system.flexible import flexible_mass, no_flexible, no_modal_tree
from nivel.system.forces import FORCES, family_addresses
from nivel.system.gradient_beams import point_inertia
from nivel.system.implicit import no_newton, no_residual
from nivel.system.interfaces import refuse_unknown_interfaces
from nivel.system.layout import frame_layout
from nivel.system.located import located
from nivel.system.partition import no_partition
from nivel.system.rows import RowTable, add_couplings, add_drivers, add_joint, coordinate_units
from nivel.system.sensors import sensor_columns
from nivel.system.states.three_coordinates import no_rotations
from nivel.system.system import Equations, System
from nivel.system.tables import Array, index_array, padded
from nivel.system.tree_tables import empty_tree

# [m] a tenth of a light year: squares and products of longer machines leave the range of numbers
LARGEST = 1e15
DIRECTIONS = {"both": BOTH, "rising": RISING, "falling": FALLING}
# [s] time within which stiction stops a joint, until a run says better
STICK = 1e-3


def build(machine: MachineRecord, equations: Equations, *, measured: bool = False) -> System:
    """Arrays of `machine` for a formulation with these equations; poses and velocities as given, not yet assembled.

    measured : every evaluation measures all joint coordinates, not only those that something needs.
    """
    refuse_unknown_interfaces(machine)
    draft, rows = Draft(machine), RowTable()
    for joint in machine.joints:
        with draft.within(f"joints.{joint.name}"), located(f"joints.{joint.name}"):
            add_joint(draft, rows, joint)
    add_couplings(draft, rows)
    add_drivers(draft, rows)
    for force in machine.forces:
        _add_force(draft, force)
    for beam in machine.beams:
        add_beam(draft, beam)
    for joint in machine.joints:
        for values in (joint.start, joint.start_rates):
            for name in values.given if values is not None else ():
                draft.coordinate(f"{joint.name}.{name}")
    if measured:
        draft.measure_all()
    sensors = sensor_columns(draft)
    watched = _watched(draft)
    names = tuple(body.name for body in machine.bodies)
    row_names, units = [*rows.names], [*rows.units]
    if equations.normalisation:
        row_names += [f"{name}.euler_parameters" for name in names]
        units += ["1"] * len(names)
    poses = np.array([np.concatenate(placement(body)) for body in machine.bodies], dtype=float).reshape(-1, 7)
    markers = draft.markers.arrays()
    size = _machine_size(poses, markers)
    extra = _extra_parts(draft, rows, len(row_names))
    bodies = _bodies(machine, size)
    constraints = rows.arrays([size if unit == "m" else 1.0 for unit in units], len(draft.frictions), len(extra))
    saddle = _saddle(rows, draft, extra, len(names), len(row_names), equations)
    system = System(
        record=Record(
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
            elements=draft.elements.arrays(family_addresses(list(draft.elements.families))),
            friction=_friction(draft, saddle, extra, len(row_names)),
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
            outputs=Outputs(np.zeros(len(draft.outputs.entries)), index_array(rows.reports, 2)),
            hooks=_hooks(draft, bool(sensors)),
            control=_control(len(row_names)),
        ),
        equations=equations,
        layout=frame_layout(
            names,
            [joint.name for joint in machine.joints],
            list(draft.joint_coordinates),
            row_names,
            draft.outputs.entries,
        ),
        bodies=names,
        joints=tuple(joint.name for joint in machine.joints),
        events=tuple(event.name for event in machine.events),
        coupled=tuple(draft.noted),
        frictions=tuple(force.name for force in machine.forces if force.type == "friction"),
        rows=tuple(row_names),
        row_owner=tuple(rows.owner),
        row_units=tuple(units),
        coordinate_units=tuple(coordinate_units(name) for name in draft.joint_coordinates),
        point_masses=np.array([body.point_mass for body in machine.bodies], dtype=bool),
        frame_markers=frozenset(draft.frame_markers),
        marker_owners=tuple(draft.owners),
        as_placed=np.array([given is None for given in rows.given], dtype=bool),
        size=size,
        start=np.zeros(0),
    )
    return replace(system, start=system.state(poses.ravel(), *_velocities(machine.bodies)))


def _add_force(draft: Draft, force: Any) -> None:
    with located(f"forces.{force.name}"), draft.noting_bodies(), draft.within(f"forces.{force.name}"):
        FORCES[force.type].add(draft, force)


def _watched(draft: Draft) -> Watched:
    """Events, and the surfaces of contacts and stops."""
    events = []
    for event in draft.machine.events:
        with located(f"events.{event.name}.when"):
            events.append((draft.function(event.when), DIRECTIONS[event.direction], int(event.stop)))
    surfaces = draft.elements.surfaces()
    return Watched(
        event=index_array(events, 3),
        surface=index_array(surfaces, 2),
        value=np.zeros(len(events) + len(surfaces)),
        rate=np.zeros(len(events) + len(surfaces)),
        followed=np.zeros(1, dtype=np.uint32),
    )


def _hooks(draft: Draft, sensors: bool) -> Hooks:
    """Addresses of the compiled functions that only some machines need."""
    address = np.zeros(HOOKS, dtype=np.uint64)
    if draft.coordinates.what:
        address[MEASURE] = import_module("nivel.kernels.measure").measure.address
    if draft.coordinates.rails:
        address[RAIL] = import_module("nivel.kernels.rail").slide.address
    if any(beam.has_gradients for beam in draft.machine.beams):
        address[POINTS] = import_module("nivel.kernels.point_inertia").resist.address
    if draft.frictions:
        address[FRICTION] = import_module("nivel.kernels.friction").rub.address
    if sensors:
        address[SENSE] = import_module("nivel.kernels.sensor").sense.address
    return Hooks(address)


def _extra_parts(draft: Draft, rows: RowTable, row_count: int) -> list[tuple[int, int, int]]:
    """(row, part, marker) of the parts of the extra rows of friction, behind all others."""
    parts: list[tuple[int, int, int]] = []
    for k, (index, _) in enumerate(draft.frictions):
        for marker in draft.coordinates.markers(index[0]):
            parts.append((row_count + k, len(rows.part_row) + len(parts), marker))
    return parts


def _friction(draft: Draft, saddle: Saddle, extra: list[tuple[int, int, int]], row_count: int) -> Friction:
    count = len(draft.frictions)
    of_row = saddle.block[:, 0]
    first = [
        int(np.searchsorted(of_row[saddle.blocks[0] :], row_count + k) + saddle.blocks[0]) for k in range(count + 1)
    ]
    return Friction(
        columns=padded([index for index, _ in draft.frictions], NONE).astype(np.uint32),
        number=padded([numbers for _, numbers in draft.frictions], 0.0),
        part=index_array([min(part for row, part, _ in extra if row == row_count + k) for k in range(count)], 1),
        block=index_array(list(pairwise(first)), 2),
        force=np.zeros(count),
        mass=np.ones(count),
        S=np.zeros((count, count)),
        response=np.zeros((count, row_count)),
        change=np.zeros((count, *saddle.z.shape)),
        free=np.zeros(count),
        lam=np.zeros(row_count),
        anchor=np.zeros(count),
        jacobian=np.zeros((count, count)),
        work=np.zeros((3, count)),
    )


def _saddle(
    rows: RowTable,
    draft: Draft,
    extra: list[tuple[int, int, int]],
    bodies: int,
    row_count: int,
    equations: Equations,
) -> Saddle:
    """Pattern and work arrays of the saddle-point system. The ground has no blocks; a normalisation block has no part."""
    own = list(zip(rows.part_row, range(len(rows.part_row)), rows.part_marker, strict=True))
    body_of = draft.markers.body
    blocks = [(row, part, marker, body_of[marker]) for row, part, marker in own if body_of[marker] != bodies]
    if equations.normalisation:
        blocks += [(len(rows.names) + body, NONE, 0, body) for body in range(bodies)]
    count = len(blocks)
    blocks += [(row, part, marker, body_of[marker]) for row, part, marker in extra if body_of[marker] != bodies]
    block = index_array(blocks, 4)
    elimination = plan(_groups(rows, row_count), block[:count, 0].tolist(), block[:count, 3].tolist())
    width = equations.velocities
    return Saddle(
        row=np.arange(row_count, dtype=np.uint32),
        block=block,
        blocks=np.array([count], dtype=np.uint32),
        **vars(elimination),
        shift=np.zeros(row_count),
        least=np.zeros(row_count),
        W=np.zeros((len(block), width)),
        G=np.zeros((bodies, width, width)),
        z=np.zeros((bodies, width)),
        S=np.zeros(len(elimination.S_row)),
        L=np.zeros(len(elimination.L_row)),
        Dinv=np.zeros(row_count),
        y=np.zeros(row_count),
        b=np.zeros(row_count),
        dense=np.zeros((0, 0)),
        null=np.zeros((0, 0)),
        pivot=np.zeros(0, dtype=np.uint32),
        target=np.zeros(row_count),
        before=np.zeros(row_count),
    )


def _groups(rows: RowTable, row_count: int) -> list[list[int]]:
    """Rows that are eliminated together: those of a joint; all others one by one."""
    groups = [list(range(a, b)) for a, b in rows.spans if b > a]
    last = rows.spans[-1][1] if rows.spans else 0
    return groups + [[row] for row in range(last, row_count)]


def _control(rows: int) -> Control:
    return Control(
        rank=np.array([rows], dtype=np.uint32),
        iterations=np.array([1, 0, 0], dtype=np.uint32),
        stabilise=np.zeros(4),
        energy=np.zeros(3),
        power=np.zeros(2),
        stored=np.zeros(1),
        stick=np.array([STICK, 0.0]),
        failure=np.zeros(1, dtype=np.uint32),
    )


def _bodies(machine: MachineRecord, size: float) -> Bodies:
    count = len(machine.bodies)
    properties = [mass_properties(body) if body.flexible is None else flexible_mass(body) for body in machine.bodies]
    mass = np.array([p.mass for p in properties], dtype=float)
    centre = np.array([p.centre_of_mass for p in properties], dtype=float).reshape(count, 3)
    inertia = np.array([p.inertia for p in properties], dtype=float).reshape(count, 3, 3)
    for k, body in enumerate(machine.bodies):
        if body.point_mass:
            # nothing turns a point mass and it turns nothing: any inertia will do
            inertia[k] = mass[k] * size**2 * np.eye(3)
    whitener = np.array([np.linalg.inv(np.linalg.cholesky(J)) for J in inertia], dtype=np.float64).reshape(count, 3, 3)
    square = np.einsum("bi,bi->b", centre, centre)
    steiner = square[:, None, None] * np.eye(3) - np.einsum("bi,bj->bij", centre, centre)
    A = np.zeros((count + 1, 3, 3))
    A[:] = np.eye(3)
    theta = np.zeros((count + 1, 4))
    theta[:, 0] = 1.0

    def vectors() -> Array:
        return np.zeros((count + 1, 3))

    return Bodies(
        mass=mass,
        centre_b=centre,
        inertia_b=inertia,
        inertia_origin_b=np.ascontiguousarray(inertia + mass[:, None, None] * steiner),
        whitener_b=whitener,
        inverse_root_mass=1.0 / np.sqrt(mass),
        gravity=np.array(machine.gravity, dtype=float),
        R=vectors(),
        theta=theta,
        A=A,
        Rdot=vectors(),
        omega=vectors(),
        omega_b=vectors(),
        c=vectors(),
        wrench=np.zeros((count + 1, 6)),
        Rddot=vectors(),
        alpha_b=vectors(),
    )


def _velocities(records: tuple[Body, ...]) -> tuple[Array, Array]:
    """Ṙ (B, 3) and ω̄ (B, 3) as given."""
    given = [initial_velocity(body) for body in records]
    velocity = np.array([v for v, _ in given], dtype=float).reshape(-1, 3)
    return velocity, np.array([w for _, w in given], dtype=float).reshape(-1, 3)


def _machine_size(poses: Array, markers: Markers) -> float:
    """Twice the largest distance of a frame from their mean, or the largest of a point from its frame [m]; 1 m where all is at one point.

    It does not depend on how the machine is turned. Raises ModelError above LARGEST.
    """
    with np.errstate(over="ignore"):
        spread = (
            2.0 * float(np.linalg.norm(poses[:, :3] - poses[:, :3].mean(axis=0), axis=1).max()) if len(poses) else 0.0
        )
        reach = float(np.linalg.norm(markers.position_b, axis=1).max(initial=0.0))
    size = max(spread, reach) or 1.0
    if not size <= LARGEST:
        message = (
            f"the machine is {size:.3g} m long, the limit is {LARGEST:.0e} m: look for a slip in a position or a unit"
        )
        raise ModelError(Fault("", 0, 0, "bodies", message))
    return size
