"""A machine with the nodes of its beams as bodies: what joints, forces and markers take hold of.

Nodes of beams in absolute nodal coordinates are flexible bodies: frames turn with the gradients, modes stretch and shear them.
The frame of a node has its section for y and z axes: gradients across the beam stretch along these and shear in their plane. The gradient
along the beam is any vector in this frame; of a cable, which has no other, it is the x axis and stretches. So no motion is lost or counted
twice, and what turns the node turns its section: were the frame to go half-way with the gradient along the beam, a couple would shear
the element by more the shorter it is. The tips of the gradients are interfaces.
"""

from dataclasses import replace
from typing import Any

import numpy as np
from pydantic import InstanceOf

from nivel.flexible.body.invariants import of_points
from nivel.known import Beam, ReducedBody, Segments
from nivel.lazy import nivel
from nivel.machine.bodies.body import Body, Flexibility
from nivel.machine.bodies.inertia import Inertia
from nivel.machine.core.orientation import Orientation, euler_parameters_from_matrix
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord

MOST_VECTORS = 8  # of an element with gradients
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
    given["joints"] = nivel.elements.joints.on_beams.on_beams(machine.joints, missing)
    return type(machine).model_construct(machine.model_fields_set | {"bodies"}, **given)


def lumps_of(beam: Beam) -> Segments:
    """What its nodes weigh by themselves: rigid segments, or the shares of the elements."""
    if beam.model == "segments":
        return nivel.elements.beams.segments.segments_of(beam)
    masses = nivel.elements.beams.exact.masses_of(beam, shared=beam.shares_mass)
    return nivel.elements.beams.segments.Segments(
        masses.mass, np.tile(beam.properties.mass_centre, (len(masses.mass), 1)), masses.inertia
    )


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


# modes: axes along which they move the tip of the gradient along each axis, together
STRETCHES = (((0, 0),),)
ALL = (((0, 0),), ((0, 1),), ((0, 2),), ((1, 1),), ((2, 2),), ((1, 2), (2, 1)))
TIPS = ("x", "y", "z")


class GradientNode(Flexibility):
    """What makes a node deform, in place of a file: the body made for it. beam : name of its beam."""

    reduced: InstanceOf[ReducedBody]
    beam: str


def gradient_nodes(beam: Beam) -> list[GradientNode]:
    """What makes the nodes of a beam deform."""
    gradients = nivel.elements.beams.gradients
    width, lengths, reach = gradients.vectors_of_node(beam), gradients.lengths_of(beam), gradients.reach_of(beam)
    W = np.zeros((len(lengths) + 1, width, width))
    roll = np.zeros(len(lengths) + 1)
    for e, length in enumerate(lengths.tolist()):
        W[e : e + 2] += gradients.lumped_mass(beam, length)
        roll[e : e + 2] += 0.5 * length * beam.properties.inertia[0, 0]
    if beam.model != "ancf-cable":
        roll[:] = 0.0  # it is in the gradients across the beam
    return [
        GradientNode.model_construct(file="", reduced=_node(name, each, turning, reach), beam=beam.name)
        for name, each, turning in zip(beam.node_names, W, roll.tolist(), strict=True)
    ]


def modes_in_gradients(beam: Beam, node: ReducedBody) -> Array:
    """(k, 3, m) what the modal coordinates of a node change its gradients by, in its axes."""
    tips = node.interfaces
    return np.stack([tip.phi / nivel.elements.beams.gradients.reach_of(beam) for tip in tips])


def _node(name: str, W: Array, roll: float, reach: float) -> ReducedBody:
    """A node whose vectors have the mass matrix W, and roll [kg m²] about the beam beside it."""
    width = len(W)
    shapes = STRETCHES if width == 2 else ALL
    position = np.zeros((width, 3))
    position[1:] = reach * np.eye(3)[: width - 1]
    displacement = np.zeros((width, 3, len(shapes)))
    for j, moves in enumerate(shapes):
        for tip, axis in moves:
            displacement[1 + tip, axis, j] = reach
    T = nivel.elements.beams.gradients.as_points(width, reach)
    raw = of_points(position, displacement, T.T @ W @ T)
    change = np.asarray(np.linalg.inv(np.linalg.cholesky(raw.I6)).T, dtype=float)
    its = raw.of_modes(change)
    phi = displacement @ change
    modes = np.zeros((width, 6, len(shapes)))
    modes[:, :3] = phi
    return nivel.flexible.body.body.ReducedBody(
        name=name,
        eigenvalues=np.zeros(len(shapes)),
        invariants=replace(its, I7=its.I7 + np.diag([roll, 0.0, 0.0])),
        interfaces=tuple(
            nivel.flexible.body.body.Interface(
                TIPS[k], k + 1, position[k + 1], phi[k + 1], np.zeros((3, len(shapes))), False
            )
            for k in range(width - 1)
        ),
        node_ids=np.arange(width),
        position=position,
        modes=modes,
        reference="fixed",
    )
