"""Scene of a machine for pictures: shapes, joints, and what acts between points, each point in its own body's frame.

The scene is stored as JSON in the result; the report and the viewer read it. Lengths in metres; a point or direction that belongs to
a body (`ground` among them) is in that body's frame, which `position` and `orientation` of the result place in space.

=================  ====================================================================================================
``bodies``         list of ``name``, ``shape`` (null without one), ``looks`` (further shapes), ``centre_of_mass``, ``points`` (where joints
                   hold it), ``mass``,
                   ``radius_of_gyration`` about the centre of mass, the largest, 0 of a point mass;
                   of a flexible one ``flexible``: ``surface`` packed, ``modes`` (modes, vertices, 3) as packed 32-bit numbers,
                   ``first`` of them among the modal coordinates
``ground_points``  where joints hold the ground
``joints``         list of ``name``, ``type``, ``bodies``, ``points``, ``axes`` (z of the markers), ``x_axes``: first and
                   second; a pin in a slot has ``slot`` too, its direction in the second body
``markers``        named markers: list of ``name``, ``body``, ``position``, ``x_axis``, ``axis`` (x and z of the marker)
``forces``         what acts between two bodies at two points: list of ``name``, ``type``, ``bodies``, ``points``;
                   ``axis`` too where it has one, and ``wheels``, see below
``sweeps``         of machines with beams; one solid drawn through the frames of bodies in a row: list of ``name``,
                   ``bodies`` (names, two or more), ``section`` (corners (y, z), counter-clockwise), and if they are not these:
                   ``hollow`` (corners of a hole; none), ``points`` (of the line, in each body; their origins), ``axes`` (of the line;
                   x), ``across`` (y of the section; y), ``smooth`` (curved between the frames; true)
``belts``          of machines that have any: list of ``name``, ``type``, ``joints`` (two pulleys, about the axes of these), ``radii``,
                   ``crossed``
``surroundings``   of machines that have any; shapes as those of ``looks``, at global places
=================  ====================================================================================================

Of the forces those are here that have two ends: spring-dampers, torsional ones, pair-forces, bushings, contacts, and ropes, which
have a point for every marker; hydraulic cylinders too, as ``cylinder``, with ``sizes``: radii of barrel and rod, length of the barrel.
Tracks have points for both ends of the belt, on the frame, and the sprocket; ``axis`` away from the ground, in the frame; ``sizes``:
radius of the sprocket, width of the belt, thickness of its shoes.
A torsional spring acts about ``axis``, in the first body. A contact is between the centres of two spheres, or between the centre of a
shape and a point of a plane; then ``axis`` is the plane's normal, in the second body, outwards.

Ropes around wheels have ``wheels``: ``axis``, in the frame of the body at the point of number ``carrier``; of each point the signed
``radii`` and, as the bodies are placed, the ``arcs`` [rad]; ``fixed``: directions in the frames of the first and the last body in
which the rope is fixed on a drum.
"""

import base64
import zlib
from collections.abc import Iterator
from typing import Any, Final

import numpy as np

from nivel.elements.joints.joint import Joint
from nivel.files.joint_parts import rotors_of
from nivel.known import (
    Beam,
    Belt,
    BeltDrive,
    Blade,
    Contact,
    Force,
    HydraulicCylinder,
    Rope,
    SoilUnit,
    TelescopicCylinder,
    TorsionalSpringDamper,
    Track,
)
from nivel.lazy import nivel
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.shape import Box, Ellipsoid, Extrusion, Mesh, Shape, Sphere, Tube, digits_of
from nivel.machine.bodies.solids import box_size, length, mesh_surface
from nivel.machine.bodies.surface import surface_text
from nivel.machine.core.element import Between, BetweenMarkers
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import find
from nivel.system.builder import SystemBuilder
from nivel.system.flexible import bending_bodies
from nivel.system.joint_frames import as_placed, axes_as_placed, marker_place, slot_frame
from nivel.system.system import System
from nivel.system.tables import MarkerTable

WALL: Final = 0.2  # of a cylinder, of its inner radius
SHOE: Final = 0.15  # thickness of the shoes of a track, of the radius of its sprocket
BARREL: Final = 0.92  # length of a barrel, of that of the retracted cylinder


def scene(machine: MachineRecord, system: System) -> dict[str, Any]:
    """Scene of a result."""
    names = (*system.bodies, "ground")
    joints = [_joint(machine, names, system, k) for k in range(len(machine.joints))]
    rotors = rotors_of(machine)
    held: dict[str, list[list[float]]] = {name: [] for name in names}
    for joint in joints:
        for body, point in zip(joint["bodies"], joint["points"], strict=True):
            if joint["name"] not in rotors:
                held[body].append(point)
    bodies = [
        {
            "name": body.name,
            "shape": None if body.shape is None else _shape(body.shape),
            "centre_of_mass": system.record.bodies.centre_b[k].tolist(),
            "points": held[body.name],
            # a rotor is no part: it has no weight, and no size with which others are compared
            "mass": 0.0 if body.name in rotors else float(system.record.bodies.mass[k]),
            "radius_of_gyration": 0.0 if body.name in rotors else _gyration(body, system, k),
        }
        for k, body in enumerate(machine.bodies)
    ]
    for drawn, body in zip(bodies, machine.bodies, strict=True):
        if body.looks:
            drawn["looks"] = [_shape(each) for each in body.looks]
    for body, looks in _flexible(machine):
        bodies[body]["flexible"] = looks
    markers = [
        {
            "name": m.name,
            "body": m.body,
            "position": position.tolist(),
            "x_axis": axes[:, 0].tolist(),
            "axis": axes[:, 2].tolist(),
        }
        for m in machine.markers
        if m.name
        for _, position, axes in [marker_place(machine, m)]
    ]
    sweeps = [_sweep(beam) for beam in machine.beams]
    around = [_shape(each) for each in machine.surroundings]
    for name, ground in _grounds(machine, system):
        if name == "ground":
            around.append(ground)
        else:
            next(each for each in bodies if each["name"] == name).setdefault("looks", []).append(ground)
    return {
        "bodies": bodies,
        "ground_points": held["ground"],
        "joints": joints,
        "forces": list(_forces(machine)),
        "markers": markers,
    } | {
        name: drawn
        for name, drawn in (("sweeps", sweeps), ("surroundings", around), ("belts", list(_belts(machine))))
        if drawn
    }


def _belts(machine: MachineRecord) -> Iterator[dict[str, Any]]:
    """Belts and chains around two pulleys, which turn about joints."""
    types = {joint.name: joint.type for joint in machine.joints}
    known = [(each, each.joints) for each in machine.couplings if isinstance(each, Belt)]
    elastic = [(each, (each.coordinate, each.against)) for each in machine.forces if isinstance(each, BeltDrive)]
    for belt, coordinates in (*known, *elastic):
        yield {
            "name": belt.name,
            "type": belt.type,
            "joints": [find(each, types, "angle")[0] for each in coordinates],
            "radii": list(belt.radii),
            "crossed": belt.crossed,
        }


def _grounds(machine: MachineRecord, system: System) -> Iterator[tuple[str, dict[str, Any]]]:
    """Ground whose height varies, as a mesh, and the body that it belongs to; the same ground of several contacts once."""
    contacts = [each for each in machine.forces if getattr(each, "heights", None) is not None]
    if not contacts:
        return
    drawn: list[tuple[object, object]] = []
    builder = SystemBuilder(machine)
    names = [*(body.name for body in machine.bodies), "ground"]
    for force in contacts:
        plane, heights = getattr(force, "plane", None), getattr(force, "heights", None)
        if heights is not None and plane is not None and (plane, heights) not in drawn:
            drawn.append((plane, heights))
            m, markers = builder.end(plane), builder.markers
            vertices, triangles = nivel.elements.contacts.height_field.ground_surface(heights)
            surface = surface_text(vertices @ markers.frame[m].T + markers.position[m], triangles)
            ground: dict[str, Any] = {"type": "mesh", "centre": [0.0, 0.0, 0.0], "surface": surface}
            for unit in system.units:
                if isinstance(unit, SoilUnit) and (unit.above[0].plane, unit.above[0].heights) == (plane, heights):
                    ground["soil"] = _soil(unit, builder, m, names)
            yield names[markers.body[m]], ground


def _soil(unit: SoilUnit, builder: SystemBuilder, plane: int, names: list[str]) -> dict[str, Any]:
    """Name of a soil, nodes along a row of its mesh, where its heights stand, and which buckets carry it, about which points."""
    markers, loads = builder.markers, []
    for slot, each in enumerate(unit.above):
        if isinstance(each, Blade) and each.load_at is not None:
            m, left, right = map(builder.end, (each.load_at, *each.edge))
            half, place = 0.5 * (markers.position[left] - markers.position[right]), markers.position[m].tolist()
            loads.append({"slot": slot, "body": names[markers.body[m]], "point": place, "half": half.tolist()})
    (along, across), columns = unit.cell * markers.frame[plane].T[:2], len(unit.record.h)
    corner = markers.position[plane] - 0.5 * ((columns - 1) * along + (unit.record.h.shape[1] - 1) * across)
    frame = {"corner": corner.tolist(), "along": along.tolist(), "across": across.tolist()}
    return {"name": unit.name, "columns": columns, "loads": loads} | frame


def _gyration(body: Body, system: System, k: int) -> float:
    """The largest radius of gyration of body k about its centre of mass [m]."""
    if body.point_mass:
        return 0.0
    bodies = system.record.bodies
    return float(np.sqrt(np.linalg.eigvalsh(bodies.inertia_b[k])[-1] / bodies.mass[k]))


def _sweep(beam: Beam) -> dict[str, Any]:
    """A beam, whose nodes are bodies with the axes of its sections."""
    outside, hole = nivel.system.section_outline.outline(beam)
    return {"name": beam.name, "bodies": list(beam.node_names), "section": outside, "hollow": hole}


def _flexible(machine: MachineRecord) -> Iterator[tuple[int, dict[str, Any]]]:
    """Numbers of flexible bodies that have a surface to draw, and how they look."""
    first = 0
    for each in bending_bodies(machine):
        surface = nivel.flexible.body.body.moving_surface(each.reduced)
        if surface is not None:
            yield (
                each.body,
                {
                    "surface": surface_text(surface.vertices, surface.triangles),
                    "modes": base64.b64encode(zlib.compress(surface.modes.astype("<f4").tobytes())).decode(),
                    "first": first,
                },
            )
        first += len(each.reduced.eigenvalues)


def _joint(machine: MachineRecord, names: tuple[str, ...], system: System, k: int) -> dict[str, Any]:
    joint: Joint = machine.joints[k]
    markers = system.record.markers
    first = int(system.record.joints.first_marker[k])
    pair = (first, first + 1)
    out: dict[str, Any] = {
        "name": joint.name,
        "type": joint.type,
        "bodies": [names[int(markers.body[m])] for m in pair],
        "points": [markers.position_b[m].tolist() for m in pair],
        "axes": [markers.frame_b[m, :, 2].tolist() for m in pair],
        "x_axes": [markers.frame_b[m, :, 0].tolist() for m in pair],
    }
    if joint.type == "revolute-translational":
        out["slot"] = slot_frame(machine, joint)[2][:, 2].tolist()
    return out


def _forces(machine: MachineRecord) -> Iterator[dict[str, Any]]:
    builder = SystemBuilder(machine)  # knows where the ends of forces are
    names = [*(body.name for body in machine.bodies), "ground"]
    for force in machine.forces:
        ends = _ends(builder, force)
        if ends is None:
            continue
        first, second = ends[0], ends[1]
        markers, out = builder.markers, _acting(names, builder.markers, force.name, force.type, ends)
        match force:
            case TorsionalSpringDamper():
                out["axis"] = markers.frame[first][:, 2].tolist()
            case Rope() if force.radii is not None:
                out["wheels"] = _wheels(machine, force, force.radii)
            case Contact() if force.plane is not None and force.heights is None:
                out["axis"] = markers.frame[second][:, 2].tolist()
            case Track():
                out |= {
                    "axis": markers.frame[first][:, 2].tolist(),
                    "sizes": [force.radius, force.width, SHOE * force.radius],
                }
        yield out
    for cylinder in machine.hydraulics:
        kinds = nivel.elements.circuits.actuators
        if isinstance(cylinder, kinds.HydraulicCylinder | kinds.TelescopicCylinder):
            yield {
                **_acting(names, builder.markers, cylinder.name, "cylinder", builder.ends(cylinder.ends)),
                "sizes": _sizes(cylinder),
            }


def _acting(names: list[str], markers: MarkerTable, name: str, type_: str, ends: tuple[int, ...]) -> dict[str, Any]:
    """What acts between markers, on bodies of these names."""
    return {
        "name": name,
        "type": type_,
        "bodies": [names[markers.body[m]] for m in ends],
        "points": [markers.position[m].tolist() for m in ends],
    }


def _sizes(cylinder: HydraulicCylinder | TelescopicCylinder) -> list[float]:
    """Radii of barrel and rod, and length of the barrel [m], as they are drawn."""
    diameters = cylinder.stages if cylinder.type == "telescopic-cylinder" else (cylinder.piston, cylinder.rod)
    thin = diameters[-1] if 0.0 < diameters[-1] < diameters[0] else 0.5 * diameters[0]
    return [0.5 * (1.0 + WALL) * diameters[0], 0.5 * thin, BARREL * cylinder.retracted_length]


def _wheels(machine: MachineRecord, rope: Rope, radii: tuple[float, ...]) -> dict[str, Any]:
    way = nivel.elements.forces.ropes.way_around(rope, radii, [as_placed(machine, end) for end in rope.ends])
    turns = [axes_as_placed(machine, body) for body, _ in way.places]
    carrier = nivel.elements.forces.ropes.first_wheel(radii)
    fixed = [turns[k].T @ way.axes @ [np.cos(way.fixed[k]), np.sin(way.fixed[k]), 0.0] for k in (0, -1)]
    return {
        "axis": (turns[carrier].T @ way.axes[:, 2]).tolist(),
        "carrier": carrier,
        "radii": list(radii),
        "arcs": list(way.arcs),
        "fixed": [each.tolist() for each in fixed],
    }


def _ends(builder: SystemBuilder, force: Force) -> tuple[int, ...] | None:
    """Markers between which a force acts; None where it acts elsewhere."""
    match force:
        case Between() | BetweenMarkers():
            return builder.ends(force.ends)
        case Rope():
            return tuple(builder.end(end) for end in force.ends)
        case Track():
            return tuple(builder.end(end) for end in (*force.contact, force.sprocket))
        case Contact(body=str(body), plane=plane) if plane is not None:
            return _centre(builder, body), builder.end(plane)
        case Contact(bodies=(first, second)):
            return _centre(builder, first), _centre(builder, second)
    return None


def _centre(builder: SystemBuilder, name: str) -> int:
    touching = builder.machine.touching[name]
    shape = touching.shape
    centre = None if shape is None or isinstance(shape, Mesh) else shape.centre
    return builder.place(touching.at(np.array(centre or (0.0, 0.0, 0.0)), np.eye(3)))


def _shape(shape: Shape) -> dict[str, Any]:
    """The shape in body axes: a shape between two points lies along x about the origin, as long as they are apart.

    type, `centre` and sizes by their words in the machine file, `colour` as `#rrggbb` where one is given; of a mesh its `surface`, in the
    body's frame (`machine.surface`).
    """
    centre = [0.0, 0.0, 0.0] if isinstance(shape, Mesh) else list(shape.centre or (0.0, 0.0, 0.0))
    out: dict[str, Any] = {"type": shape.type, "centre": centre}
    if shape.colour is not None:
        out["colour"] = digits_of(shape.colour)
    match shape:
        case Mesh():
            return out | {"surface": surface_text(*mesh_surface(shape))}
        case Sphere():
            return out | {"radius": shape.radius}
        case Ellipsoid():
            return out | {"semi_axes": list(shape.semi_axes)}
        case Box():
            return out | {"size": list(box_size(shape))}
        case Tube():
            out |= {"outer_radius": shape.outer_radius, "inner_radius": shape.inner_radius}
        case Extrusion():
            out["outline"] = [list(corner) for corner in shape.outline]
        case _:
            out["radius"] = shape.radius
    return out | {"length": length(shape), "along": shape.along or "x"}
