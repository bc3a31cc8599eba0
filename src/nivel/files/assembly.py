"""An entry of `assemblies:`: a part file that is placed, mirrored, given parameters, and whose elements get a prefix.

Every element of it is turned, moved and mirrored, so that it moves as before, seen from there.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, ValidationError

from nivel.elements.beams.beam import Beam
from nivel.elements.joints import JOINTS
from nivel.elements.joints.couplings import FunctionCoupling, LinearCoupling, Rack
from nivel.elements.joints.drivers import MOTIONS, Driver
from nivel.elements.joints.joint import Joint
from nivel.errors import ModelError
from nivel.files.include import FileName, Sections
from nivel.files.outline import section_of
from nivel.files.placed_forces import placed_ends, placed_force
from nivel.files.placement import AXIAL, AXIAL_Z, POLAR_Z, Placement, Scene, by_rules, triple
from nivel.files.substitution import NotRepresentableError, negative, renamed
from nivel.files.tree import Tree
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.inertia import Inertia
from nivel.machine.bodies.shape import Box, Capsule, Cylinder, Extrusion, Mesh, Shape, Standing, Tube
from nivel.machine.bodies.solids import axes_of, box_size, length, mesh_surface, part_corners
from nivel.machine.bodies.surface import surface_arrays, surface_text
from nivel.machine.core.element import Ends
from nivel.machine.core.orientation import Orientation, matrix_from_euler_parameters
from nivel.machine.core.placement import frame_from_axes, placement
from nivel.machine.core.record import Record, entry, unknown_word
from nivel.machine.given import Field, Maybe, OneRecord
from nivel.machine.laws.time_function import Expression, PythonLaw, Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.parameters import resolve
from nivel.machine.signals.input import State
from nivel.machine.units.quantity import FAULT, Position, fault, shown
from nivel.machine.units.tree import Parameters
from nivel.machine.uses.references import SECTIONS

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


def placed_component(component: Any, scene: Scene) -> Any:
    """`component` in the placed part.

    Raises NotRepresentableError.
    """
    coordinate = getattr(component, "coordinate", None)
    if coordinate is not None and scene.is_opposite(coordinate):
        raise NotRepresentableError(f"`{coordinate}` changes its sign there")
    changes = placed_ends(component, scene, with_axes=False) if isinstance(component, Ends) else {}
    varied = {
        name: scene.varied(value) for name, value in component if isinstance(value, Expression | PythonLaw | Table)
    }
    return component.replace(**changes, **varied) if changes or varied else component


Elements = Mapping[str, Sequence[Record]]


def placed(elements: Elements, placing: Placement) -> dict[str, tuple[Record, ...]]:
    """`elements` by section, with all that is global in them transformed.

    Where a part is mirrored, each joint coordinate has the value that it has in the part; only the displacement of a
    cylindrical or screw joint, whose angle is kept, has the opposite sign, and what refers to it is changed with it.
    Raises NotRepresentableError.
    """
    if not placing.changes:
        return {section: tuple(records) for section, records in elements.items()}
    scene = Scene.of(elements, placing)
    rules: dict[str, Callable[[Any], Record]] = {
        "bodies": lambda body: placed_body(body, placing),
        "beams": lambda beam: placed_beam(beam, placing),
        "markers": scene.marker,
        "joints": lambda joint: placed_joint(joint, scene),
        "couplings": lambda coupling: placed_coupling(coupling, scene),
        "drivers": lambda driver: placed_driver(driver, scene),
        "forces": lambda force: placed_force(force, scene),
        "fluids": lambda fluid: fluid,
        "hydraulics": lambda component: placed_component(component, scene),
        "sensors": lambda sensor: sensor if sensor.value is None else sensor.replace(value=scene.varied(sensor.value)),
        "inputs": lambda each: each,
        "states": lambda state: placed_state(state, scene),
        "control": scene.followed,
        "events": lambda event: event.replace(when=scene.varied(event.when)),
    }
    made = {section: tuple(_by(rules[section], record) for record in elements[section]) for section in elements}
    made["markers"] = (*made["markers"], *scene.extra.values())
    return made


def _by(rule: Callable[[Any], Record], record: Record) -> Record:
    try:
        return rule(record)
    except NotRepresentableError as error:
        raise NotRepresentableError(f"{_words(record)}: {error}") from None
    except ModelError as error:
        raise NotRepresentableError(f"{_words(record)}: {'; '.join(fault.message for fault in error.faults)}") from None


def _words(record: Record) -> str:
    return f"{record.collection}.{entry(record, 'name')}"


def placed_coupling(coupling: Any, scene: Scene) -> Any:
    """`coupling` in the placed part: displacements that count the other way change the sign of their factor."""
    if isinstance(coupling, LinearCoupling):
        signs = [-1.0 if scene.is_opposite(reference) else 1.0 for reference in coupling.coordinates]
        return coupling.replace(factors=[sign * each for sign, each in zip(signs, coupling.factors, strict=True)])
    if isinstance(coupling, FunctionCoupling):
        value = scene.varied(coupling.value)
        return coupling.replace(value=negative(value) if scene.is_opposite(coupling.coordinate) else value)
    if isinstance(coupling, Rack) and scene.is_opposite(coupling.joints[1]):
        return coupling.replace(radius=-coupling.radius)
    return coupling


def placed_driver(driver: Driver, scene: Scene) -> Driver:
    """`driver` in the placed part. What is measured from ground is measured from the part's own frame there.

    Raises NotRepresentableError.
    """
    if driver.coordinate is not None:
        if not scene.is_opposite(driver.coordinate):
            return driver
        given = {name: function for name in MOTIONS if (function := getattr(driver, name)) is not None}
        turned = {name: negative(function) for name, function in given.items()}
        return driver.replace(**turned, start_speed=-driver.start_speed + 0.0)
    if driver.is_pose and scene.placement.mirrored:
        raise NotRepresentableError(
            "the driven pose of a marker has no mirror image: drive the marker of the part as placed"
        )
    kept = POLAR_Z if driver.along == "z" else AXIAL_Z
    reference = driver.reference
    return driver.replace(relative_to=scene.ground_frame(kept) if reference is None else scene.variant(reference, kept))


def placed_state(state: State, scene: Scene) -> State:
    """`state` in the placed part: it has the value that it would have in the part.

    Raises NotRepresentableError.
    """
    name = "rate" if state.rate is not None else "update"
    return state.replace(**{name: scene.varied(getattr(state, name))})


_PREFIX = re.compile(r"([^\W\d_][\w-]*)?")


def _prefix(value: Any) -> Any:
    if not isinstance(value, str) or not _PREFIX.fullmatch(value):
        raise fault(f"the start of a name, such as `left_`, was expected, got {shown(value)}")
    return value


def _values(value: Any) -> Any:
    if not isinstance(value, Mapping):
        raise fault(f"a mapping from parameters to values was expected, got {shown(value)}")
    return dict(value)


class Assembly(Record):
    """A part of a machine that stands in a file of its own, and where it goes."""

    file: FileName
    position: Position = Field("of the part's origin", default=(0.0, 0.0, 0.0))
    orientation: Maybe[OneRecord[Orientation]] = Field("of the part's axes", default=None)
    mirror: Literal["x", "y", "z", "none"] = Field(
        "axis of the part along which it is mirrored, before it is placed", default="none"
    )
    parameters: Annotated[dict[str, Any], BeforeValidator(_values)] = Field(
        "values for parameters of the part, in place of its own", default={}
    )
    prefix: Annotated[str, BeforeValidator(_prefix)] = Field(
        "start of the names of all its elements; default the assembly's name and `_`", default=""
    )
    only: Sections | None = Field("sections that are taken; default all", default=None)


def read_assembly(tree: Tree, name: str, given: Any, parameters: Parameters) -> Assembly | None:
    """The entry `name` of `assemblies:`; None where it has faults, which go to `tree.faults`."""
    path = ("assemblies", name)
    data = {"prefix": f"{name}_", **given} if isinstance(given, dict) else given
    try:
        assembly = Assembly.model_validate(data, context={"parameters": parameters})
    except ValidationError as error:
        for line in error.errors(include_url=False):
            where = path if line["loc"] == ("prefix",) and "prefix" not in given else (*path, *line["loc"])
            if line["type"] == FAULT and not tree.is_broken(path):
                tree.faults.append(tree.fault(where, line["msg"], at_key=bool(line.get("ctx", {}).get("at_key"))))
        return None
    return None if tree.is_broken(path) else assembly


def given_parameters(part: Tree, user: Tree, name: str, assembly: Assembly) -> None:
    """Put the values that `assembly` gives in place of the part's parameters. They may use those of its `user`."""
    own = section_of(part, "parameters")
    outer = section_of(user, "parameters")
    fresh = {key: f"given_{key}" for key in assembly.parameters}
    while any(each in outer for each in fresh.values()):
        fresh = {key: f"{each}_" for key, each in fresh.items()}
    values, faults = resolve({**outer, **{fresh[key]: value for key, value in assembly.parameters.items()}})
    for key, word in fresh.items():
        path, value = ("assemblies", name, "parameters", key), values.get(word)
        if key not in own:
            part.faults.append(user.fault(path, unknown_word(key, list(own), "parameter"), at_key=True))
        elif word in faults:
            part.faults.append(user.fault(path, faults[word]))
        if key not in own or value is None:
            continue
        own[key] = value
        part.graft(user, {path: ("parameters", key)})


def made_by(tree: Tree, name: str, assembly: Assembly, part: MachineRecord) -> dict[str, dict[str, Record]] | None:
    """The elements of `part` as `assembly` makes them, by section and name; None where they cannot be, which is
    reported.
    """
    try:
        elements = elements_of(part, assembly)
    except NotRepresentableError as error:
        tree.report(("assemblies", name), str(error))
        return None
    return {section: {str(entry(each, "name")): each for each in records} for section, records in elements.items()}


def elements_of(part: MachineRecord, assembly: Assembly) -> dict[str, tuple[Record, ...]]:
    """The elements of `part` by section, placed and with the prefix of `assembly`. Raises NotRepresentableError."""
    elements = {section: getattr(part, section) for section in SECTIONS}
    placement = Placement.of(assembly.position, assembly.orientation, assembly.mirror)
    return renamed(placed(elements, placement), assembly.prefix)
