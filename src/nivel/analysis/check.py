"""What a machine is, before any run: freedoms, redundancy, assembly, conventions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.dynamics import prepare
from nivel.analysis.settings import RunSettings, complete
from nivel.machine.force import PointForce, Torque
from nivel.machine.machine_record import MachineRecord
from nivel.system.joints import JOINTS
from nivel.system.system import System


@dataclass(frozen=True)
class JointFacts:
    """One joint: kind, first and second body, point and z axis of the first marker (global, assembled), convention in words."""

    name: str
    type: str
    first: str
    second: str
    point: tuple[float, ...]
    axis: tuple[float, ...]
    free: int
    rows: tuple[str, ...]
    coordinates: tuple[tuple[str, float, str], ...]  # name, value, unit
    convention: str


@dataclass(frozen=True)
class BodyFacts:
    """One body: mass [kg], principal inertias about the centre of mass [kg m²], assembled position of its frame [m]."""

    name: str
    mass: float
    principal_inertia: tuple[float, ...]
    position: tuple[float, ...]


@dataclass(frozen=True)
class Check:
    """A machine that was checked and assembled; see `nivel check`."""

    name: str
    gravity: tuple[float, ...]
    bodies: tuple[BodyFacts, ...]
    joints: tuple[JointFacts, ...]
    forces: tuple[tuple[str, str, str], ...]  # name, type, body
    degrees_of_freedom: int
    constraint_rows: int
    redundant_rows: tuple[str, ...]
    non_unique_joints: tuple[str, ...]
    gap: float
    gap_row: str
    moved: tuple[tuple[str, float, float], ...]
    velocity_change: tuple[tuple[str, float, float], ...]
    settings: RunSettings

    def __repr__(self) -> str:
        plural = "degree" if self.degrees_of_freedom == 1 else "degrees"
        extra = f", redundant: {', '.join(self.redundant_rows)}" if self.redundant_rows else ""
        return f"<Check {self.name}: {self.degrees_of_freedom} {plural} of freedom{extra}>"


def check(machine: MachineRecord) -> Check:
    """Check and assemble `machine`. Raises ModelError with what is wrong."""
    settings = complete(machine.simulation)
    prepared = prepare(machine, settings.formulation)
    system = prepared.motion.system
    record, redundancy, assembly = system.record, prepared.redundancy, prepared.assembly
    from nivel.kernels.observe import observe

    prepared.motion.evaluate(0.0, assembly.y)
    frame = np.zeros(system.layout.width)
    observe(prepared.motion.handle.address, assembly.y, frame)
    columns = next(v.columns for v in system.layout.variables if v.name == "joint_coordinate")
    labels = system.layout.coordinates["joint_coordinate"]
    values = dict(zip(labels, zip(frame[columns].tolist(), system.coordinate_units, strict=True), strict=True))
    return Check(
        name=machine.name,
        gravity=tuple(machine.gravity),
        bodies=tuple(
            BodyFacts(
                name,
                float(record.bodies.mass[k]),
                tuple(np.linalg.eigvalsh(record.bodies.inertia_b[k]).tolist()),
                tuple(record.bodies.R[k].tolist()),
            )
            for k, name in enumerate(system.bodies)
        ),
        joints=tuple(_joint(system, k, joint.name, joint.type, values) for k, joint in enumerate(machine.joints)),
        forces=tuple((load.name, load.type, _loaded_body(machine, load)) for load in machine.forces),
        degrees_of_freedom=redundancy.degrees_of_freedom,
        constraint_rows=system.joint_rows,
        redundant_rows=redundancy.redundant_rows,
        non_unique_joints=redundancy.non_unique_joints,
        gap=assembly.gap,
        gap_row=assembly.gap_row,
        moved=assembly.moved,
        velocity_change=assembly.velocity_change,
        settings=settings,
    )


def _loaded_body(machine: MachineRecord, load: PointForce | Torque) -> str:
    if load.body is not None:
        return load.body
    return next(marker.body for marker in machine.markers if marker.name == load.marker)


def _joint(system: System, k: int, name: str, kind: str, values: dict[str, tuple[float, str]]) -> JointFacts:
    record = system.record
    first = int(record.joints.first_marker[k])
    bodies = [*system.bodies, "ground"]
    return JointFacts(
        name=name,
        type=kind,
        first=bodies[int(record.markers.body[first])],
        second=bodies[int(record.markers.body[first + 1])],
        point=tuple(record.markers.r[first].tolist()),
        axis=tuple(record.markers.A[first, :, 2].tolist()),
        free=JOINTS[kind].free,
        rows=tuple(f"{name}.{row}" for row in JOINTS[kind].rows),
        coordinates=tuple((label, *values[label]) for label in values if label.startswith(f"{name}.")),
        convention=JOINTS[kind].convention,
    )
