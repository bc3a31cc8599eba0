"""Forces of a part, placed: what is global is turned, what counts the other way in a mirror image changes its sign."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from nivel.elements.contacts.contact import Contact
from nivel.elements.forces.actuators import Motor, Servo, Stop
from nivel.elements.forces.bushing import Bushing
from nivel.elements.forces.drive_lines import Brake, Freewheel, TransmissionLoss
from nivel.elements.forces.friction import Friction
from nivel.elements.forces.loads import PairForce, PointForce, Torque
from nivel.elements.forces.shafts import BeltDrive, DriveLine, Shaft
from nivel.elements.forces.spring_series import SpringSeries
from nivel.elements.forces.springs import JointSpringDamper, SpringDamper, ThreeAxisSpring, TorsionalSpringDamper
from nivel.elements.forces.terramechanics import Track
from nivel.elements.forces.tyre import Tyre
from nivel.files.placement import AXIAL_Z, POLAR_Z, Scene, by_rules
from nivel.files.substitution import NotRepresentableError, mixed, negative, substituted
from nivel.machine.core.element import Between, BetweenMany, Ends, ForceElement
from nivel.machine.core.record import Record
from nivel.machine.laws.time_function import Expression, PythonLaw, Table, TimeFunction
from nivel.machine.units.formula import LinearFunction

Changes = dict[str, Any]
_FUNCTIONS = (Expression, PythonLaw)
ROUND_OFF = 1e-12


def placed_force(force: Any, scene: Scene) -> Any:
    """`force` in the placed part, by the rule of its kind, or of what its kind is made of.

    Raises NotRepresentableError.
    """
    rule = next(_RULES[kind] for kind in type(force).__mro__ if kind in _RULES)
    return force.replace(**rule(force, scene))


def _any_force(force: ForceElement, scene: Scene) -> Changes:
    """Functions of signals follow the part, and so do points between which it acts; what else would turn needs a rule of the kind."""
    coordinate = getattr(force, "coordinate", None)
    if coordinate is not None and scene.is_opposite(coordinate):
        raise NotRepresentableError(
            f"a {force.type} on a coordinate whose sign is reversed by the placement is not supported"
        )
    if coordinate is None and not isinstance(force, Between) and scene.placement.turns:
        raise NotRepresentableError(f"a {force.type} in a rotated part is not supported")
    if any(isinstance(value, tuple) and any(isinstance(each, _FUNCTIONS) for each in value) for _, value in force):
        raise NotRepresentableError(f"a {force.type} with several functions is not supported in a placed part")
    changes = placed_ends(force, scene, with_axes=True) if isinstance(force, Between) else {}
    return changes | {name: scene.varied(value) for name, value in force if isinstance(value, _FUNCTIONS)}


def _point_force(force: PointForce, scene: Scene) -> Changes:
    placing = scene.placement
    matrix = placing.polar if force.axes == "global" else np.diag(placing.reflection)
    changes: Changes = {"vector": _vector(force.vector, matrix, scene)}
    if force.position is not None:
        changes["position"] = placing.in_body(force.position)
    return changes


def _torque(force: Torque, scene: Scene) -> Changes:
    placing = scene.placement
    matrix = placing.axial if force.axes == "global" else placing.handedness * np.diag(placing.reflection)
    return {"vector": _vector(force.vector, matrix, scene)}


def _vector(vector: tuple[TimeFunction, ...], matrix: np.ndarray, scene: Scene) -> tuple[TimeFunction, ...]:
    return mixed(matrix, [scene.varied(each) for each in vector])


def placed_ends(force: Ends, scene: Scene, *, with_axes: bool) -> Changes:
    """Where a force between two bodies acts. With axes, points become markers, since theirs are global as placed."""
    if force.markers is not None:
        first, second = force.markers
        return {"markers": (scene.end(first), scene.end(second))}
    if force.bodies is None or force.points is None:
        raise ValueError("two ends are needed, and there are none")
    if not with_axes or not scene.placement.turns:
        return {"points": tuple(scene.placement.point(point) for point in force.points)}
    markers = tuple(
        scene.marker(scene.point_on(body, point)) for body, point in zip(force.bodies, force.points, strict=True)
    )
    return {"bodies": None, "points": None, "markers": markers}


def _spring_damper(force: SpringDamper, scene: Scene) -> Changes:
    return {**placed_ends(force, scene, with_axes=False), **_varied(force, scene, "law")}


def _torsional_spring_damper(force: TorsionalSpringDamper, scene: Scene) -> Changes:
    first, second = force.markers
    return {"markers": (scene.end(first), scene.end(second)), **_varied(force, scene, "law")}


def _pair_force(force: PairForce, scene: Scene) -> Changes:
    changes = {**placed_ends(force, scene, with_axes=force.axes == "first"), **_varied(force, scene, "magnitude")}
    if force.vector is not None:
        in_marker = np.diag(AXIAL_Z if scene.placement.mirrored else np.ones(3))
        changes["vector"] = _vector(force.vector, scene.placement.polar if force.axes == "global" else in_marker, scene)
    return changes


def _bushing(force: Bushing, scene: Scene) -> Changes:
    changes = placed_ends(force, scene, with_axes=True)
    if scene.placement.mirrored:
        signs = np.array([*AXIAL_Z, *(-each for each in AXIAL_Z)])  # of displacements, and of turns, which are axial
        for field in ("stiffness", "damping"):
            if isinstance(getattr(force, field)[0], tuple):
                matrix = getattr(force, f"{field}_matrix") * np.outer(signs, signs) + 0.0
                changes[field] = tuple(tuple(float(each) for each in row) for row in matrix)
    return changes


def _three_axis_spring(force: ThreeAxisSpring, scene: Scene) -> Changes:
    """Its axes stay the global ones, so a part that is turned has it only where its axes become global ones again."""
    matrix = scene.placement.polar
    changes = placed_ends(force, scene, with_axes=False)
    for name in ("stiffness", "damping"):
        turned = matrix @ np.diag(getattr(force, name)) @ matrix.T
        along = np.diagonal(turned)
        if np.abs(turned - np.diag(along)).max() > ROUND_OFF * np.abs(along).max():
            raise NotRepresentableError(f"its `{name}` would be along other axes than the global ones; take a bushing")
        changes[name] = tuple(float(each) for each in along)
    for name in ("free_displacement", "preload"):
        changes[name] = tuple(float(each) for each in matrix @ np.array(getattr(force, name)) + 0.0)
    return changes


def _contact(force: Contact, scene: Scene) -> Changes:
    if force.heights is not None and scene.placement.mirrored:
        raise NotRepresentableError("ground with `heights` cannot be mirrored; write the mirrored heights out")
    return {} if force.plane is None else {"plane": scene.end(force.plane, POLAR_Z)}


def _on_ground(force: Tyre | Track, scene: Scene) -> Changes:
    if force.heights is not None and scene.placement.mirrored:
        raise NotRepresentableError("ground with `heights` cannot be mirrored; write the mirrored heights out")
    if isinstance(force.grip, _FUNCTIONS) and scene.placement.turns:
        raise NotRepresentableError(f"a {force.type} whose `grip` is a function in a rotated part is not supported")
    plane = scene.end(force.plane, POLAR_Z)
    if isinstance(force, Tyre):
        return {"wheel": scene.end(force.wheel), "plane": plane}
    contact = tuple(scene.end(each, POLAR_Z) for each in force.contact)
    return {"contact": contact, "sprocket": scene.end(force.sprocket), "plane": plane}


def _many_ends(force: BetweenMany, scene: Scene) -> Changes:
    """Its `node` is a point like its ends, and around its `axis` a rope keeps the sense in which it runs."""
    placing = scene.placement
    changes: Changes = {name: scene.varied(value) for name, value in force if isinstance(value, (Table, *_FUNCTIONS))}
    changes |= by_rules(force, axis=placing.turning, node=placing.point)
    if force.markers is not None:
        return {"markers": tuple(scene.end(each) for each in force.markers), **changes}
    return {"points": tuple(placing.point(point) for point in force.points or ()), **changes}


def _on_coordinate(force: JointSpringDamper | Motor | Servo | Stop | Friction, scene: Scene) -> Changes:
    """What acts on a joint coordinate keeps its numbers, unless the coordinate counts the other way."""
    fields = {"JointSpringDamper": ("law",), "Motor": ("effort", "speed"), "Servo": ("target",)}.get(
        type(force).__name__, ()
    )
    changes = _varied(force, scene, *fields)
    if not scene.is_opposite(force.coordinate):
        return changes
    match force:
        case JointSpringDamper():
            changes |= {"free_value": -force.free_value + 0.0, "preload": -force.preload + 0.0}
            if force.table is not None:
                deflections, efforts = ([-each + 0.0 for each in reversed(column)] for column in force.table.points)
                changes["table"] = force.table.replace(deflections=deflections, efforts=efforts)
            if force.law is not None:
                turned = substituted(
                    changes["law"], lambda path: LinearFunction(((-1.0, path),)), local=("value", "rate")
                )
                changes = {"law": negative(turned)}
        case Stop():
            changes |= {
                "lower": None if force.upper is None else -force.upper + 0.0,
                "upper": None if force.lower is None else -force.lower + 0.0,
            }
        case Motor() | Servo():
            changes |= {field: negative(changes[field]) for field in fields if field in changes}
    return changes


def _of_drive_line(force: DriveLine, scene: Scene) -> Changes:
    """What acts between two coordinates: where one of them counts the other way, its ratio does too."""
    changes = {name: scene.varied(value) for name, value in force if isinstance(value, _FUNCTIONS)}
    turned = scene.is_opposite(force.coordinate)
    if force.against is not None and scene.is_opposite(force.against) != turned:
        changes["ratio"] = -force.ratio
    if turned and isinstance(force, Freewheel):
        raise NotRepresentableError(
            "a freewheel on a coordinate whose sign is reversed by the placement is not supported"
        )
    if turned and isinstance(force, Shaft):
        changes["free_value"] = -force.free_value + 0.0
    return changes


def _of_belt(force: BeltDrive, scene: Scene) -> Changes:
    if scene.is_opposite(force.coordinate) == scene.is_opposite(force.against):
        return {}
    return {"crossed": not force.crossed}


def _of_brake(force: Brake | TransmissionLoss, scene: Scene) -> Changes:
    """Friction acts alike both ways."""
    return {name: scene.varied(value) for name, value in force if isinstance(value, _FUNCTIONS)}


def _varied(force: Record, scene: Scene, *fields: str) -> Changes:
    """The functions of a force with the signals of the placed part."""
    return by_rules(force, **dict.fromkeys(fields, scene.varied))


_RULES: dict[type[Record], Callable[[Any, Scene], Changes]] = {
    ForceElement: _any_force,
    PointForce: _point_force,
    Torque: _torque,
    SpringDamper: _spring_damper,
    TorsionalSpringDamper: _torsional_spring_damper,
    JointSpringDamper: _on_coordinate,
    Motor: _on_coordinate,
    Servo: _on_coordinate,
    Stop: _on_coordinate,
    Friction: _on_coordinate,
    PairForce: _pair_force,
    Bushing: _bushing,
    ThreeAxisSpring: _three_axis_spring,
    Contact: _contact,
    BetweenMany: _many_ends,
    Tyre: _on_ground,
    Track: _on_ground,
    SpringSeries: partial(placed_ends, with_axes=False),
    DriveLine: _of_drive_line,
    BeltDrive: _of_belt,
    Brake: _of_brake,
    TransmissionLoss: _of_brake,
}
