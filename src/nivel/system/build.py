"""From words to numbers: a machine record becomes the arrays of the kernels."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from nivel.errors import Fault, ModelError
from nivel.kernels.load import BODY_AXES, FORCE, GLOBAL_AXES, TORQUE
from nivel.kernels.record import Bodies, Constraints, Control, Functions, Joints, Loads, Markers, Record, Saddle
from nivel.machine.body import Body
from nivel.machine.force import PointForce, Torque
from nivel.machine.inertia import mass_properties
from nivel.machine.machine_record import MachineRecord
from nivel.machine.marker import Marker
from nivel.machine.placement import initial_velocity, placement
from nivel.system.elimination import plan
from nivel.system.functions import function_table
from nivel.system.joint_frames import joint_frames
from nivel.system.joints import JOINTS
from nivel.system.layout import frame_layout
from nivel.system.system import Array, Equations, System

GROUND = "ground"
NORMALISATION_SIDE = 2
# [m] a tenth of a light year: squares and products of longer machines leave the range of numbers
LARGEST = 1e15


@dataclass
class MarkerTable:
    """Markers collected while joints and loads are built."""

    body: list[int] = field(default_factory=list)
    position: list[Array] = field(default_factory=list)
    frame: list[Array] = field(default_factory=list)

    def add(self, body: int, position: Array, frame: Array) -> int:
        """Index of a new marker at `position` (3,) with axes `frame` (3, 3), both in body axes."""
        self.body.append(body)
        self.position.append(position)
        self.frame.append(frame)
        return len(self.body) - 1


@dataclass
class JointTables:
    """What the joints of a machine come to."""

    names: list[str] = field(default_factory=list)  # of rows
    units: list[str] = field(default_factory=list)
    owner: list[int] = field(default_factory=list)  # joint of each row
    pairs: list[tuple[int, int]] = field(default_factory=list)  # markers of each row
    spans: list[tuple[int, int]] = field(default_factory=list)  # rows of each joint
    first_and_second: list[tuple[int, int]] = field(default_factory=list)  # markers of each joint
    tables: dict[str, list[tuple[int, ...]]] = field(default_factory=lambda: {"s": [], "d1": [], "d2": []})
    coordinates: list[tuple[int, int, int]] = field(default_factory=list)
    coordinate_names: list[str] = field(default_factory=list)
    coordinate_units: list[str] = field(default_factory=list)


def build(machine: MachineRecord, equations: Equations) -> System:
    """Arrays of `machine` for a formulation with these equations; poses and velocities as given, not yet assembled."""
    names = tuple(body.name for body in machine.bodies)
    index = {name: k for k, name in enumerate((*names, GROUND))}
    markers = MarkerTable()
    joints = _joints(machine, index, markers)
    loads, functions = _loads(machine, index, markers)
    rows, units = [*joints.names], [*joints.units]
    if equations.normalisation:
        rows += [f"{name}.euler_parameters" for name in names]
        units += ["1"] * len(names)
    marker_arrays = _marker_arrays(markers)
    poses = np.array([np.concatenate(placement(body)) for body in machine.bodies], dtype=float).reshape(-1, 7)
    size = _machine_size(poses, marker_arrays)
    record = Record(
        bodies=_bodies(machine),
        markers=marker_arrays,
        constraints=_constraint_arrays(joints, [size if unit == "m" else 1.0 for unit in units]),
        joints=Joints(
            first_marker=_index([pair[0] for pair in joints.first_and_second], 1),
            rows=_index(joints.spans, 2),
            coordinate=_index(joints.coordinates, 3),
            turn=np.zeros((len(joints.coordinates), 3)),
        ),
        functions=functions,
        loads=loads,
        saddle=_saddle(joints, markers, len(names), len(rows), equations),
        control=_control(len(rows)),
    )
    system = System(
        record=record,
        equations=equations,
        layout=frame_layout(
            names,
            [joint.name for joint in machine.joints],
            joints.coordinate_names,
            rows,
            [(load.name, "N" if load.type == "force" else "N m") for load in machine.forces],
        ),
        bodies=names,
        joints=tuple(joint.name for joint in machine.joints),
        rows=tuple(rows),
        row_joint=np.array(joints.owner, dtype=np.int64),
        row_units=tuple(units),
        coordinate_units=tuple(joints.coordinate_units),
        size=size,
        start=np.zeros(0),
    )
    return replace(system, start=system.state(poses.ravel(), *_velocities(machine.bodies)))


def _saddle(joints: JointTables, markers: MarkerTable, bodies: int, rows: int, equations: Equations) -> Saddle:
    """Pattern and work arrays of the saddle-point system."""
    block = _blocks(joints.pairs, markers, bodies, equations, len(joints.names))
    groups = [list(range(a, b)) for a, b in joints.spans] + [[row] for row in range(len(joints.names), rows)]
    elimination = plan(groups, block[:, 0].tolist(), block[:, 3].tolist())
    width = equations.velocities
    return Saddle(
        block=block,
        **vars(elimination),
        W=np.zeros((len(block), width)),
        G=np.zeros((bodies, width, width)),
        z=np.zeros((bodies, width)),
        S=np.zeros(len(elimination.S_row)),
        L=np.zeros(len(elimination.L_row)),
        Dinv=np.zeros(rows),
        y=np.zeros(rows),
        b=np.zeros(rows),
        dense=np.zeros((0, 0)),
        null=np.zeros((0, 0)),
        pivot=np.zeros(0, dtype=np.uint32),
    )


def _control(rows: int) -> Control:
    return Control(
        rank=np.array([rows], dtype=np.uint32),
        stabilise=np.zeros(4),
        energy=np.zeros(3),
        power=np.zeros(2),
        failure=np.zeros(1, dtype=np.uint32),
    )


def _joints(machine: MachineRecord, index: dict[str, int], markers: MarkerTable) -> JointTables:
    out = JointTables()
    for number, joint in enumerate(machine.joints):
        first, second = (markers.add(index[body], r, A) for body, r, A in joint_frames(machine, joint))
        kind = JOINTS[joint.type]
        begin = len(out.names)
        for basic in kind.constraints:
            row = len(out.names)
            out.tables[basic.table].append(basic.entries(first, second, row))
            out.names += [f"{joint.name}.{name}" for name in basic.rows]
            out.units += ["1" if basic.table == "d1" else "m"] * len(basic.rows)
        rows = len(out.names) - begin
        out.owner += [number] * rows
        out.pairs += [(first, second)] * rows
        out.spans.append((begin, begin + rows))
        out.first_and_second.append((first, second))
        for coordinate in kind.coordinates:
            out.coordinates.append((coordinate.kind, first, second))
            out.coordinate_names.append(f"{joint.name}.{coordinate.name}")
            out.coordinate_units.append(coordinate.units)
    return out


def _loads(machine: MachineRecord, index: dict[str, int], markers: MarkerTable) -> tuple[Loads, Functions]:
    by_name = {marker.name: marker for marker in machine.markers if marker.name is not None}
    what, components = [], []
    for load in machine.forces:
        body, position = _point_of(load, by_name)
        marker = markers.add(index[body], position, np.eye(3))
        kind = FORCE if load.type == "force" else TORQUE
        what.append((kind, marker, BODY_AXES if load.axes == "body" else GLOBAL_AXES))
        components += list(load.vector)
    functions = function_table(components)
    count = len(what)
    table = Loads(
        what=_index(what, 3),
        functions=np.arange(3 * count, dtype=np.uint32).reshape(count, 3),
        magnitude=np.zeros(count),
        power=np.zeros(count),
    )
    return table, functions


def _point_of(load: PointForce | Torque, markers: dict[str, Marker]) -> tuple[str, Array]:
    """Body and point (3,) in body axes where a load acts; a torque acts on the body, its point does not matter."""
    if isinstance(load, PointForce):
        if load.marker is not None:
            marker = markers[load.marker]
            return marker.body, np.array(marker.position, dtype=float)
        assert load.body is not None  # the record was checked
        return load.body, np.array(load.position or (0.0, 0.0, 0.0), dtype=float)
    return load.body, np.zeros(3)


def _bodies(machine: MachineRecord) -> Bodies:
    count = len(machine.bodies)
    properties = [mass_properties(body) for body in machine.bodies]
    mass = np.array([p.mass for p in properties], dtype=float)
    centre = np.array([p.centre_of_mass for p in properties], dtype=float).reshape(count, 3)
    inertia = np.array([p.inertia for p in properties], dtype=float).reshape(count, 3, 3)
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


def _marker_arrays(markers: MarkerTable) -> Markers:
    count = len(markers.body)

    def vectors() -> Array:
        return np.zeros((count, 3))

    return Markers(
        body=_index(markers.body, 1),
        position_b=np.array(markers.position, dtype=float).reshape(count, 3),
        frame_b=np.array(markers.frame, dtype=float).reshape(count, 3, 3),
        u=vectors(),
        r=vectors(),
        A=np.zeros((count, 3, 3)),
        rdot=vectors(),
        bias=vectors(),
    )


def _constraint_arrays(joints: JointTables, scale: list[float]) -> Constraints:
    rows = len(scale)
    J = np.zeros((len(joints.names), 12))
    for _, _, row in joints.tables["s"]:
        for axis in range(3):
            J[row + axis, axis] = -1.0
            J[row + axis, 6 + axis] = 1.0
    return Constraints(
        s=_index(joints.tables["s"], 3),
        d1=_index(joints.tables["d1"], 5),
        d2=_index(joints.tables["d2"], 4),
        scale=np.array(scale, dtype=float),
        C=np.zeros(rows),
        Cdot=np.zeros(rows),
        gamma=np.zeros(rows),
        J=J,
        lam=np.zeros(rows),
    )


def _blocks(
    pairs: list[tuple[int, int]], markers: MarkerTable, ground: int, equations: Equations, joint_rows: int
) -> NDArray[np.uint32]:
    """Blocks (row, side, marker, body) of C_q; the ground has none. A normalisation block names no marker."""
    blocks = [
        (row, side, marker, markers.body[marker])
        for row, pair in enumerate(pairs)
        for side, marker in enumerate(pair)
        if markers.body[marker] != ground
    ]
    if equations.normalisation:
        blocks += [(joint_rows + body, NORMALISATION_SIDE, 0, body) for body in range(ground)]
    return _index(blocks, 4)


def _velocities(records: tuple[Body, ...]) -> tuple[Array, Array]:
    """Ṙ (B, 3) and ω̄ (B, 3) as given."""
    given = [initial_velocity(body) for body in records]
    velocity = np.array([v for v, _ in given], dtype=float).reshape(-1, 3)
    return velocity, np.array([w for _, w in given], dtype=float).reshape(-1, 3)


def _machine_size(poses: Array, markers: Markers) -> float:
    """Largest extent of the frames or of the points on a body along an axis [m]; 1 m where all is at one point.

    Raises ModelError above LARGEST.
    """
    spread = float(np.ptp(poses[:, :3], axis=0).max()) if len(poses) else 0.0
    reach = float(np.abs(markers.position_b).max(initial=0.0))
    size = max(spread, reach) or 1.0
    if not size <= LARGEST:
        message = (
            f"the machine is {size:.3g} m long, the limit is {LARGEST:.0e} m: look for a slip in a position or a unit"
        )
        raise ModelError(Fault("", 0, 0, "bodies", message))
    return size


def _index(values: object, columns: int) -> NDArray[np.uint32]:
    """uint32 array of `values`: (n, columns), or (n,) for one column."""
    array = np.array(values, dtype=np.uint32)
    return array.reshape(-1) if columns == 1 else array.reshape(-1, columns)
