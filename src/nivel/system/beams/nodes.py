"""A machine with the nodes of its beams as bodies: what joints, forces and markers take hold of."""

from __future__ import annotations

from typing import Any

import numpy as np

from nivel.elements.joints.on_beams import on_beams
from nivel.machine.beams.beam import Beam
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.inertia import Inertia
from nivel.machine.core.orientation import Orientation, euler_parameters_from_matrix
from nivel.machine.machine_record import MachineRecord
from nivel.system.beams.elements import masses_of
from nivel.system.beams.gradient_nodes import gradient_nodes
from nivel.system.beams.segments import Segments, segments_of

# how unwilling nodes are to be moved by the assembly, which would stress the beam: bodies beside it are moved instead
HELD = 1e6


def with_nodes(machine: MachineRecord) -> MachineRecord:
    """The machine with one body a node of its beams, behind its own bodies, with the mass lumped there; the same where it has them.

    Joints that slide along a beam get its nodes.
    """
    known = {body.name for body in machine.bodies}
    missing = [beam for beam in machine.beams if beam.node_names[0] not in known]
    if not missing:
        return machine
    given: dict[str, Any] = {name: getattr(machine, name) for name in type(machine).model_fields}
    given["bodies"] = (*machine.bodies, *(node for beam in missing for node in _nodes(beam)))
    given["joints"] = on_beams(machine.joints, missing)
    return type(machine).model_construct(machine.model_fields_set | {"bodies"}, **given)


def lumps_of(beam: Beam) -> Segments:
    """What its nodes weigh by themselves: rigid segments, or the shares of the elements."""
    if beam.model == "segments":
        return segments_of(beam)
    masses = masses_of(beam, shared=beam.shares_mass)
    return Segments(masses.mass, np.tile(beam.properties.mass_centre, (len(masses.mass), 1)), masses.inertia)


def _nodes(beam: Beam) -> list[Body]:
    place, axes = beam.frames(beam.shares)
    speed = np.array(beam.velocity) + np.cross(np.array(beam.angular_velocity), place - place[0])
    masses = _masses(beam)
    return [
        Body.model_construct(
            name=name,
            **masses[k],
            position=tuple(place[k].tolist()),
            orientation=Orientation.model_construct(
                euler_parameters=tuple(euler_parameters_from_matrix(axes[k]).tolist())
            ),
            velocity=tuple(speed[k].tolist()),
            angular_velocity=beam.angular_velocity,
            assembly_weight=HELD,
        )
        for k, name in enumerate(beam.node_names)
    ]


def _masses(beam: Beam) -> list[dict[str, Any]]:
    """What of `Body` says how heavy each node is: its lumped mass, or for gradients what makes it deform."""
    if beam.has_gradients:
        return [{"flexible": each} for each in gradient_nodes(beam)]
    lumps = lumps_of(beam)
    return [
        {"mass": float(mass), "centre_of_mass": tuple(centre.tolist()), "inertia": _inertia(inertia)}
        for mass, centre, inertia in zip(lumps.mass, lumps.centre, lumps.inertia, strict=True)
    ]


def _inertia(J: Any) -> Inertia:
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = J.tolist()
    return Inertia.model_construct(xx=xx, yy=yy, zz=zz, xy=xy, xz=xz, yz=yz)
