"""Bodies and joints of a part, placed: turned, moved, mirrored."""

from functools import partial
from typing import Any

import numpy as np

from nivel.elements.beams.beam import Beam
from nivel.elements.joints import JOINTS
from nivel.elements.joints.joint import Joint
from nivel.files.placement import AXIAL, AXIAL_Z, POLAR_Z, Placement, Scene, by_rules, triple
from nivel.files.substitution import NotRepresentableError
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.inertia import Inertia
from nivel.machine.bodies.shape import Box, Capsule, Cylinder, Extrusion, Mesh, Shape, Standing, Tube
from nivel.machine.bodies.solids import axes_of, box_size, length, mesh_surface, part_corners
from nivel.machine.bodies.surface import surface_arrays, surface_text
from nivel.machine.core.orientation import matrix_from_euler_parameters
from nivel.machine.core.placement import frame_from_axes, placement

KEPT = {"arms": AXIAL, "sliding": POLAR_Z, "turning": AXIAL_Z}


def placed_body(body: Body, placing: Placement) -> Body:
    """`body` in the placed part. A shape between two points becomes one in the body frame, which stays its frame.

    Raises NotRepresentableError where the part is mirrored and the body flexible: its modes are in a file.
    """
    if placing.mirrored and body.flexible is not None:
        raise NotRepresentableError("a flexible body cannot be mirrored; reduce a mirrored model and write it out")
    position, parameters = placement(body)
    if not placing.turns:
        return _moved_body(body, placing)
    changes: dict[str, Any] = {"position": placing.point(position)} | by_rules(
        body,
        velocity=placing.direction,
        angular_velocity=placing.turning,
        angular_velocity_body=placing.turning_in_body,
        centre_of_mass=placing.in_body,
        inertia=partial(_mirrored_inertia, placing),
        shape=lambda shape: _placed_shape(shape, placing),
    )
    if body.looks:
        changes["looks"] = tuple(_placed_shape(each, placing) for each in body.looks)
    if not body.point_mass:
        changes["orientation"] = placing.body_frame(matrix_from_euler_parameters(parameters))
    return body.replace(**changes)


def placed_beam(beam: Beam, placing: Placement) -> Beam:
    """`beam` in the placed part; without `up` its sections keep their axes against it.

    Raises NotRepresentableError where the part is mirrored: sections of a mirrored beam have left-handed axes.
    """
    if placing.mirrored:
        raise NotRepresentableError("a beam cannot be mirrored; write it out where it is to be")
    changes = {"through": tuple(map(placing.point, beam.through))} | by_rules(
        beam,
        **dict.fromkeys(("from_", "to", "via"), placing.point),
        velocity=placing.direction,
        angular_velocity=placing.turning,
    )
    if not placing.turns:
        return beam.replace(**changes)
    if beam.up is not None:
        return beam.replace(**changes, up=placing.direction(beam.up))
    # axes that follow from global directions in the part need an `up` that turns with it
    axes = beam.frames(beam.shares)[1]
    for up in ({}, {"up": placing.direction(triple(axes[0, :, 2]))}):
        made = beam.replace(**changes, **up)
        if np.allclose(made.frames(beam.shares)[1], placing.polar @ axes, atol=1e-9):
            return made
    raise NotRepresentableError(
        "a curve in space cannot be turned; give the beam an `up`, from which its sections take their axes"
    )


def _moved_body(body: Body, placing: Placement) -> Body:
    """`body` moved without being turned."""
    shape = body.shape
    if shape is None or isinstance(shape, Standing) or shape.from_ is None or shape.to is None:
        return body.replace(position=placing.point(body.position or (0.0, 0.0, 0.0)))
    return body.replace(shape=shape.replace(from_=placing.point(shape.from_), to=placing.point(shape.to)))


def _placed_shape(shape: Shape, placing: Placement) -> Shape:
    """The shape in the body frame."""
    if isinstance(shape, Mesh):
        return _placed_mesh(shape, placing)
    if isinstance(shape, Extrusion):
        shape = shape.replace(outline=_mirrored_outline(shape, placing))
    if isinstance(shape, Standing) or shape.from_ is None:
        return shape if shape.centre is None else shape.replace(centre=placing.in_body(shape.centre))
    match shape:
        case Box():
            return Box(size=box_size(shape), colour=shape.colour)
        case Cylinder():
            return Cylinder(radius=shape.radius, length=length(shape), colour=shape.colour)
        case Capsule():
            return Capsule(radius=shape.radius, length=length(shape), colour=shape.colour)
        case Tube():
            own = Tube(outer_radius=shape.outer_radius, inner_radius=shape.inner_radius, length=length(shape))
            return own.replace(colour=shape.colour)
        case Extrusion():
            return Extrusion(outline=shape.outline, length=length(shape), colour=shape.colour)


def _mirrored_outline(shape: Extrusion, placing: Placement) -> tuple[tuple[float, float], ...]:
    """The corners in the body frame of the mirror image."""
    _, first, second = axes_of(shape.along)
    a, b = float(placing.reflection[first]), float(placing.reflection[second])
    return tuple((a * x + 0.0, b * y + 0.0) for x, y in shape.outline)


def _placed_mesh(mesh: Mesh, placing: Placement) -> Mesh:
    """The mesh in the body frame of the mirror image; its triangles still go counter-clockwise seen from outside."""
    if not placing.mirrored:
        return mesh
    vertices, triangles = mesh_surface(mesh)
    surface = surface_text(vertices * placing.reflection, triangles[:, ::-1])
    parts = None
    if mesh.parts is not None:
        corners = [part_corners(mesh, k + 1) * placing.reflection for k in range(len(mesh.parts))]
        faces = [surface_arrays(each)[1][:, ::-1] for each in mesh.parts]
        parts = tuple(surface_text(*each) for each in zip(corners, faces, strict=True))
    return Mesh(file=mesh.file, surface=surface, colour=mesh.colour, convex_parts=mesh.convex_parts, parts=parts)


def _mirrored_inertia(placing: Placement, inertia: Inertia) -> Inertia:
    """Products change their sign where one of their axes is mirrored and the other is not."""
    x, y, z = (float(each) for each in placing.reflection)
    return inertia.replace(xy=inertia.xy * x * y + 0.0, xz=inertia.xz * x * z + 0.0, yz=inertia.yz * y * z + 0.0)


def placed_joint(joint: Joint, scene: Scene) -> Joint:
    """`joint` in the placed part. Its coordinates keep their meaning, but for what `Scene.is_opposite` names."""
    placing = scene.placement
    changes = by_rules(joint, point=placing.point, points=lambda both: tuple(map(placing.point, both)))
    if joint.markers is not None:
        first, second = joint.markers
        kept = KEPT[JOINTS[joint.type].mirror]
        changes["markers"] = (scene.end(first, kept), scene.end(second, kept))
    if placing.turns:
        changes |= _placed_axes(joint, placing)
    if placing.mirrored and joint.pitch is not None:
        changes["pitch"] = -joint.pitch
    for field in ("start", "start_rates"):
        values = getattr(joint, field)
        if values is None:
            continue
        opposite = {name: -value for name, value in values.given.items() if scene.is_opposite(f"{joint.name}.{name}")}
        if opposite:
            changes[field] = values.replace(**opposite)
    return joint.replace(**changes)


def _placed_axes(joint: Joint, placing: Placement) -> dict[str, Any]:
    """The axes of a joint; its x axis as well, which would else come from another global axis."""
    changes: dict[str, Any] = {}
    if joint.axis is not None:
        turned = placing.direction if JOINTS[joint.type].mirror == "sliding" else placing.turning
        changes["axis"] = turned(joint.axis)
    if joint.axis is not None and joint.axes is None:
        changes["x_axis"] = placing.direction(triple(frame_from_axes(joint.axis, joint.x_direction)[:, 0]))
    if joint.axes is not None:
        first, second = joint.axes
        slides = joint.type == "revolute-translational"
        turned = placing.direction if slides else placing.turning
        normal = placing.direction if joint.type == "rolling" else placing.turning
        changes["axes"] = (normal(first), turned(second))
        if joint.type == "rolling":
            changes["x_axis"] = placing.direction(triple(frame_from_axes(first, joint.x_axis)[:, 0]))
    return changes
