"""Uses of a point mass: it has a place but no turn, so only what acts at its origin makes sense."""

from collections.abc import Iterator
from typing import Any, Final

import numpy as np

from nivel.elements.forces import FORCES
from nivel.elements.joints import JOINTS
from nivel.known import MachineRecord, PointForce
from nivel.machine.core.element import Between, BetweenMany, Marker
from nivel.machine.core.index import Index, Place, as_list, elements
from nivel.machine.core.record import Problem, entry

Faults = Iterator[tuple[Place, str]]
Triple = tuple[float, float, float]

NEAR: Final = 1e-9  # by which a point may miss the origin, relative to where the point mass is and to 1 m

_TURN: Final = "a point mass does not turn"


def point_mass_faults(machine: Any, index: Index) -> Faults:
    """Uses of point masses by joints, drivers, forces and sensors that turn."""
    if not index.point_masses:
        return
    for at, joint in enumerate(elements(machine, "joints")):
        yield from _of_joint(joint, index, ("joints", at))
    for at, force in enumerate(elements(machine, "forces")):
        kind = FORCES.get(str(entry(force, "type")))
        if kind is not None and kind.record.turns:
            for place, body in _bodies(force, index):
                if body in index.point_masses:
                    yield ("forces", at, *place), f"`{body}`: {_TURN}; a {entry(force, 'type')} cannot act on it"
        yield from _not_on_one(entry(force, "plane"), index, ("forces", at, "plane"))
        yield from _no_axes_of_one(force, index, ("forces", at, "axes"))
    for at, driver in enumerate(elements(machine, "drivers")):
        if entry(driver, "about") is not None or entry(driver, "orientation") is not None:
            yield from _not_on_one(entry(driver, "marker"), index, ("drivers", at, "marker"))
    for at, sensor in enumerate(elements(machine, "sensors")):
        if str(entry(sensor, "quantity")).startswith("angular"):
            yield from _not_on_one(entry(sensor, "marker"), index, ("sensors", at, "marker"))
        for end, marker in enumerate(as_list(entry(sensor, "angle"))):
            yield from _not_on_one(marker, index, ("sensors", at, "angle", end))


def _of_joint(joint: Any, index: Index, place: Place) -> Faults:
    type_ = entry(joint, "type")
    may = _may(type_)
    for where, body in _bodies(joint, index):
        if body not in index.point_masses or may == "either":
            continue
        if not may:
            held = "; `type: spherical` holds it" if type_ == "fixed" else ""
            others = ", ".join(sorted(filter(_may, JOINTS), key=_may))
            yield (*place, *where), f"`{body}`: {_TURN}; it can be in the joints {others}{held}"
        elif where[-1] == 0:
            yield (*place, *where), f"`{body}`: {_TURN}; in a {type_} joint it can only be the second body"


def _may(type_: object) -> str:
    """Which body of a joint of this type may be a point mass; empty: none."""
    return JOINTS[type_].point_mass if isinstance(type_, str) and type_ in JOINTS else ""


def _bodies(element: Any, index: Index) -> Iterator[tuple[Place, str]]:
    """Places and names of the bodies that a joint or force acts on."""
    body = entry(element, "body")
    if isinstance(body, str):
        yield ("body",), body
    for at, each in enumerate(as_list(entry(element, "bodies"))):
        if isinstance(each, str):
            yield ("bodies", at), each
    ends = [(("markers", at), end) for at, end in enumerate(as_list(entry(element, "markers")))]
    for place, end in (*ends, (("wheel",), entry(element, "wheel"))):
        on = index.body_of(end)
        if on is not None:
            yield place, on


def _no_axes_of_one(force: Any, index: Index, place: Place) -> Faults:
    """Vectors in the axes of a point mass."""
    axes = entry(force, "axes")
    on = [body for _, body in _bodies(force, index)] or [index.body_of(entry(force, "marker"))]
    if axes in ("body", "first") and on[0] in index.point_masses:
        yield place, f"`{on[0]}`: {_TURN} and has no axes of its own; write `axes: global`"


def _not_on_one(marker: Any, index: Index, place: Place) -> Faults:
    body = index.body_of(marker)
    if body in index.point_masses:
        yield place, f"the marker is on `{body}`: {_TURN}"


def problems_of_points(machine: MachineRecord) -> Iterator[Problem]:
    """Points of joints, markers and forces on point masses that are not at their origin."""
    origins = {body.name: body.position or (0.0, 0.0, 0.0) for body in machine.bodies if body.point_mass}
    if not origins:
        return
    for at, marker in enumerate(machine.markers):
        yield from _off(marker.body, marker.position, origins, ("markers", at, "position"))
    for at, joint in enumerate(machine.joints):
        yield from _off_points(
            joint.markers, joint.bodies, joint.points or _twice(joint.point), origins, ("joints", at)
        )
    for at, force in enumerate(machine.forces):
        if isinstance(force, PointForce) and force.body is not None:
            yield from _off(force.body, force.position or (0.0, 0.0, 0.0), origins, ("forces", at, "position"))
        if isinstance(force, Between | BetweenMany):
            yield from _off_points(force.markers, force.bodies, force.points, origins, ("forces", at))
    for at, sensor in enumerate(machine.sensors):
        for form in ("distance", "angle"):
            for end, marker in enumerate(getattr(sensor, form) or ()):
                if isinstance(marker, Marker):
                    yield from _off(marker.body, marker.position, origins, ("sensors", at, form, end, "position"))


def _twice(point: Triple | None) -> tuple[Triple, Triple] | None:
    return None if point is None else (point, point)


def _off_points(
    markers: Any, bodies: tuple[str, ...] | None, points: tuple[Triple, ...] | None, origins: Any, place: Place
) -> Iterator[Problem]:
    for at, marker in enumerate(markers or ()):
        if isinstance(marker, Marker):
            yield from _off(marker.body, marker.position, origins, (*place, "markers", at, "position"))
    for at, (body, point) in enumerate(zip(bodies or (), points or (), strict=False)):
        if body not in origins:
            continue
        missed = float(np.linalg.norm(np.subtract(point, origins[body])))
        if missed > NEAR * max(1.0, float(np.abs(origins[body]).max())):
            message = f"the point is {missed:.3g} m from the point mass `{body}`; it can only be where the mass is"
            yield Problem((*place, "bodies", at), message)


def _off(body: str, position: Triple, origins: Any, place: Place) -> Iterator[Problem]:
    if body in origins and any(position):
        yield Problem(place, f"`{body}` is a point mass: only its origin is on it")
