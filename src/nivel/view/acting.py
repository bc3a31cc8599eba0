"""Forces on a machine, as the page draws them: forces between bodies, loads on one, and what works on joints, drivers among it."""

from typing import Any, Final

import numpy as np

from nivel.lazy import Struct
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS, Kind, UnknownCoordinateError, find
from nivel.view.records import Body, Force, ForceLook, Joint, Triple, Winding


class CoordinatePlace(Struct):
    """A coordinate's joint and word; axis : in the first body's frame; kind : whether it turns about the axis or goes along it."""

    joint: Joint
    word: str
    axis: Triple
    kind: Kind

    @property
    def name(self) -> str:
        """As the result calls it."""
        return f"{self.joint.name}.{self.word}"


def coordinate_place(reference: Any, joints: list[Joint], kind: Kind | None = None) -> CoordinatePlace | None:
    """The place of the coordinate that a machine's record mentions; None where the picture has no such joint."""
    by_name = {joint.name: joint for joint in joints}
    if not isinstance(reference, str):
        return None
    try:
        name, word = find(reference, {joint.name: joint.kind for joint in joints}, kind)
    except UnknownCoordinateError:
        return None
    joint = by_name[name]
    return CoordinatePlace(joint, word, _axis(joint, word), COORDINATE_KINDS[word])


def _axis(joint: Joint, word: str) -> Triple:
    """x and y of planar motions lie across the joint's axis; all else is along or about it."""
    z, x = joint.axes[0], joint.x_axes[0] if joint.x_axes else None
    if x is None or word not in ("x", "y"):
        return z
    return x if word == "x" else (z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0])


def triple(values: Any) -> Triple:
    """Three numbers that JSON can hold: what is not finite becomes 0."""
    x, y, z = (float(value) if np.isfinite(value) else 0.0 for value in values)
    return x, y, z


# what is drawn at the joint of an angle, and of a length
AT_JOINT: Final[dict[str, tuple[ForceLook, ForceLook]]] = {
    "joint-spring-damper": ("coil", "slide"),
    "motor": ("turn", "slide"),
    "dc-motor": ("turn", "slide"),
    "servo-motor": ("turn", "slide"),
    "servo": ("turn", "slide"),
    "driver": ("turn", "slide"),
}
HELD: Final[tuple[ForceLook, ForceLook]] = ("ring", "slide")  # of friction, stops and whatever else works there


class Acted(Struct):
    """What forces act on: bodies and joints of a machine. record : of the machine, which may be empty. `places` : bodies, -1 the ground."""

    scene: dict[str, Any]
    record: dict[str, Any]
    bodies: list[Body]
    joints: list[Joint]
    places: dict[str, int]

    def all_forces(self) -> list[Force]:
        """All force elements, in the order of the machine."""
        drawn = {force["name"]: force for force in self.scene.get("forces", [])}
        records = {force["name"]: force for force in self.record.get("forces", [])}
        out = []
        for name in {**records, **drawn}:
            known = records.get(name, {})
            if name in drawn:
                out.append(_between(drawn[name], known, self.places))
            else:
                out.append(self._elsewhere(name, str(known.get("type", "force")), known))
        return out

    def all_drivers(self) -> list[Force]:
        """The drivers, each at its joint or marker."""
        return [self._elsewhere(each["name"], "driver", each) for each in self.record.get("drivers", [])]

    def place_of(self, known: dict[str, Any]) -> tuple[int, Triple] | None:
        """Body and point of what stands at a marker, or at a body: a torque at the centre of mass; None on the ground."""
        marker = known.get("marker") or known.get("wheel")
        if isinstance(marker, str):
            marker = next((each for each in self.record.get("markers", []) if each.get("name") == marker), None)
        named = marker if isinstance(marker, dict) else known
        body = self.places.get(str(named.get("body")), -1)
        if body < 0:
            return None
        at_centre = known.get("type") == "torque"
        return body, triple(self.bodies[body].centre_of_mass if at_centre else named.get("position") or (0, 0, 0))

    def _elsewhere(self, name: str, kind: str, known: dict[str, Any]) -> Force:
        """What acts on one body, or on a joint coordinate; without a place where that is not known."""
        words = ("body", "marker", "wheel", "plane", "coordinate")
        facts = [("type", kind), *((word, str(known[word])) for word in words if isinstance(known.get(word), str))]
        at = coordinate_place(known.get("coordinate"), self.joints)
        if at is not None:
            look = AT_JOINT.get(kind, HELD)[at.kind == "length"]
            return Force(name, kind, list(at.joint.bodies), list(at.joint.points), at.axis, look, facts)
        place = self.place_of(known)
        if place is None:
            return Force(name, kind, [], facts=facts)
        return Force(name, kind, [place[0]], [place[1]], None, "dot", facts)


def _between(force: dict[str, Any], known: dict[str, Any], places: dict[str, int]) -> Force:
    """A force with two ends."""
    kind, ends = str(force["type"]), [str(body) for body in force["bodies"]]
    facts = [("type", kind), ("first body", ends[0]), ("second body", ends[1])]
    axis = triple(force["axis"]) if "axis" in force else None
    points = [triple(point) for point in force["points"]]
    sizes = [float(each) for each in force.get("sizes", ())]
    look, winding = _look(force, known), _winding(force["wheels"]) if "wheels" in force else None
    return Force(force["name"], kind, [places[body] for body in ends], points, axis, look, facts, sizes, winding)


def _winding(wheels: dict[str, Any]) -> Winding:
    """How a rope runs around wheels."""
    first, last = wheels["fixed"]
    radii, arcs = ([float(each) for each in wheels[key]] for key in ("radii", "arcs"))
    return Winding(triple(wheels["axis"]), int(wheels["carrier"]), radii, arcs, (triple(first), triple(last)))


def _look(force: dict[str, Any], record: dict[str, Any]) -> ForceLook:
    """What is drawn between the ends of a force."""
    match force["type"]:
        case "spring-damper":
            damped = any(record.get(word) for word in ("damping", "damping_table", "damping_law"))
            sprung = any(record.get(word) for word in ("stiffness", "table", "law", "preload")) or not damped
            return "spring-damper" if damped and sprung else "damper" if damped else "spring"
        case "spring-series":
            return "spring-damper" if any(record.get("damping") or ()) else "spring"
        case "torsional-spring-damper":
            return "coil"
        case "pair-force" | "cylinder":
            return "cylinder"
        case "rope" | "track" as same:
            return same
        case "bushing" | "three-axis-spring":
            return "bushing"
        case "contact":
            return "plane" if "axis" in force else "nothing"
    return "nothing"
