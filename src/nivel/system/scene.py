"""What a picture of a machine needs: shapes, joint points and axes, each in its own body's frame."""

from __future__ import annotations

from typing import Any

from nivel.machine.body import Body
from nivel.machine.inertia import box_size, length
from nivel.machine.machine_record import MachineRecord
from nivel.machine.shape import Box, Sphere, Tube
from nivel.system.system import System


def scene(machine: MachineRecord, system: System) -> dict[str, Any]:
    """Scene of a result: ``bodies`` (name, shape, centre_of_mass, joint points), ``ground_points`` and ``joints``."""
    markers = system.record.markers
    ground = system.body_count
    points: list[list[list[float]]] = [[] for _ in range(ground + 1)]
    joints = []
    for k, joint in enumerate(machine.joints):
        first = int(system.record.joints.first_marker[k])
        pair = (first, first + 1)
        bodies = [int(markers.body[m]) for m in pair]
        for m, body in zip(pair, bodies, strict=True):
            points[body].append(markers.position_b[m].tolist())
        joints.append(
            {
                "name": joint.name,
                "type": joint.type,
                "bodies": ["ground" if body == ground else system.bodies[body] for body in bodies],
                "points": [markers.position_b[m].tolist() for m in pair],
                "axes": [markers.frame_b[m, :, 2].tolist() for m in pair],
            }
        )
    bodies = [
        {
            "name": body.name,
            "shape": _shape(body),
            "centre_of_mass": system.record.bodies.centre_b[k].tolist(),
            "points": points[k],
        }
        for k, body in enumerate(machine.bodies)
    ]
    return {"bodies": bodies, "ground_points": points[ground], "joints": joints}


def _shape(body: Body) -> dict[str, Any] | None:
    """The shape in body axes: a shape between two points lies along x about the origin, as long as they are apart."""
    shape = body.shape
    if shape is None:
        return None
    out: dict[str, Any] = {"type": shape.type, "centre": list(shape.centre or (0.0, 0.0, 0.0))}
    match shape:
        case Sphere():
            return out | {"radius": shape.radius}
        case Box():
            return out | {"size": list(box_size(shape))}
        case Tube():
            out |= {"outer_radius": shape.outer_radius, "inner_radius": shape.inner_radius}
        case _:
            out["radius"] = shape.radius
    return out | {"length": length(shape), "along": shape.along or "x"}
