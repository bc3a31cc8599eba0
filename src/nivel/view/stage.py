"""Stage: what is drawn of a machine, from the scene of its result and the machine's record; forces on it among that: between bodies, loads
on one, and what works on joints, as drivers do."""

import base64
import zlib
from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from nivel.elements.joints import drawn
from nivel.known import TerrainHistory
from nivel.lazy import Struct, nivel, replace
from nivel.looks.solids import colour_of, colour_of_body, held_points, link_ends, shapes_of
from nivel.looks.viewpoint import slides_on_beam, stands_at_second
from nivel.machine.bodies.surface import surface_arrays
from nivel.machine.core.vectors import Array
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS, Kind, UnknownCoordinateError, find
from nivel.view.package import Block
from nivel.view.package import Kind as NumberKind
from nivel.view.records import (
    Body,
    Flexible,
    Force,
    ForceLook,
    Joint,
    Load,
    Marker,
    Part,
    Sweep,
    Terrain,
    Triple,
    Winding,
)


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
    kind, ends = str(force["type"]), [str(body) for body in force["bodies"]]
    facts = [("type", kind), ("first body", ends[0]), ("second body", ends[1])]
    axis = triple(force["axis"]) if "axis" in force else None
    points = [triple(point) for point in force["points"]]
    sizes = [float(each) for each in force.get("sizes", ())]
    look, winding = _look(force, known), _winding(force["wheels"]) if "wheels" in force else None
    return Force(force["name"], kind, [places[body] for body in ends], points, axis, look, facts, sizes, winding)


def _winding(wheels: dict[str, Any]) -> Winding:
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


def _sweep(sweep: dict[str, Any], places: dict[str, int]) -> Sweep:
    bodies = [places[name] for name in sweep["bodies"]]
    count = len(bodies)
    return Sweep(
        name=sweep["name"],
        colour=colour_of(bodies[0]),
        bodies=bodies,
        points=[triple(point) for point in sweep.get("points") or [(0, 0, 0)] * count],
        axes=[triple(axis) for axis in sweep.get("axes") or [(1, 0, 0)] * count],
        across=[triple(axis) for axis in sweep.get("across") or [(0, 1, 0)] * count],
        section=[(float(y), float(z)) for y, z in sweep["section"]],
        hollow=[(float(y), float(z)) for y, z in sweep.get("hollow") or []],
        smooth=bool(sweep.get("smooth", True)),
    )


COURSE: Final[dict[str, NumberKind]] = {
    "time": "f8",
    "ends": "u4",
    "nodes": "u4",
    "moves": "u2",
    "carried": "f4",
}  # of terrains
MOMENTS: Final = 100  # that are looked at for the largest displacement


class Cast(Acted):
    """A machine's elements as the page draws them, and where they are found by name."""

    forces: list[Force]
    drivers: list[Force]
    markers: list[Marker]
    sweeps: list[Sweep]
    surroundings: list[Part]
    terrains: list[Terrain]

    @property
    def lists(self) -> dict[str, Any]:
        """All elements, by the names that a `Stage` has for them."""
        return {name: each for name, each in vars(self).items() if isinstance(each, list)}


def cast(
    scene: dict[str, Any], record: dict[str, Any], block: Block, past: Mapping[str, TerrainHistory] | None = None
) -> Cast:
    """The elements of a machine. scene : as in a result; record : its machine record as JSON, which may be empty. past : of soils."""
    bodies, around = scene.get("bodies", []), scene.get("surroundings", [])
    places = {body["name"]: k for k, body in enumerate(bodies)} | {"ground": -1}
    chains = {body: each for each in scene.get("sweeps", []) for body in each["bodies"]}
    drawn = [
        _part_of(chains[body["name"]], scene, body, places, block)
        if body["name"] in chains
        else _body(scene, body, colour_of_body(body, k), block, automatic=not body.get("flexible"))
        for k, body in enumerate(bodies)
    ]
    acted = Acted(scene, record, drawn, [_joint(joint, places) for joint in scene.get("joints", [])], places)
    return Cast(
        **vars(acted),
        forces=acted.all_forces(),
        drivers=acted.all_drivers(),
        markers=[_marker(each, places) for each in scene.get("markers", []) if each["body"] != "ground"],
        sweeps=[_sweep(each, places) for each in scene.get("sweeps", [])],
        surroundings=[part(each, block) for each in around if "soil" not in each],
        terrains=[
            _terrain(each, places, block, (past or {}).get(each["soil"]["name"])) for each in around if "soil" in each
        ],
    )


def _terrain(ground: dict[str, Any], places: dict[str, int], block: Block, past: TerrainHistory | None) -> Terrain:
    """Ground with soil, and how it changes where that is known."""
    soil, (vertices, _) = ground["soil"], surface_arrays(ground["surface"])
    corner, along, across = (triple(soil[key]) for key in ("corner", "along", "across"))
    cell = float(np.linalg.norm(along))
    heights = (vertices - corner) @ (np.cross(along, across) / cell**2)
    loads = [
        Load(each["slot"], places[each["body"]], triple(each["point"]), triple(each["half"])) for each in soil["loads"]
    ]
    return Terrain(
        soil["name"], corner, along, across, cell / nivel.results.terrain.STEPS, loads,
        block.add(heights.reshape(-1, soil["columns"])),
        **{name: block.add(np.zeros(0) if past is None else getattr(past, name), kind) for name, kind in COURSE.items()},
    )  # fmt: skip


def _marker(marker: dict[str, Any], places: dict[str, int]) -> Marker:
    x_axis, axis = triple(marker.get("x_axis", (1, 0, 0))), triple(marker.get("axis", (0, 0, 1)))
    return Marker(marker["name"], places[marker["body"]], triple(marker["position"]), x_axis, axis)


def flexible(scene: dict[str, Any], block: Block, modal: Array | None) -> list[Flexible]:
    """The bodies that deform. modal : (frames, modes) of the motion; the colours end at the largest displacement in it."""
    out = []
    for k, body in enumerate(scene.get("bodies", [])):
        looks = body.get("flexible")
        if not looks:
            continue
        vertices, triangles = surface_arrays(looks["surface"])
        packed = zlib.decompress(base64.b64decode(looks["modes"]))
        modes = np.frombuffer(packed, "<f4").reshape(-1, len(vertices), 3)
        first = int(looks["first"])
        high = 0.0 if modal is None else _largest(modes, modal[:, first : first + len(modes)])
        arrays = block.add(vertices, "f4"), block.add(triangles, "u4"), block.add(modes, "f4")
        out.append(Flexible(k, body["name"], *arrays, first, 0.0, high, "m", "displacement"))
    return out


def _largest(modes: Array, modal: Array) -> float:
    """Largest displacement of a vertex in some of the moments."""
    some = modal[:: max(len(modal) // MOMENTS, 1)]
    some = some[np.all(np.isfinite(some), axis=1)]
    return max((float(np.linalg.norm(np.tensordot(q, modes, 1), axis=1).max(initial=0.0)) for q in some), default=0.0)


def _body(scene: dict[str, Any], body: dict[str, Any], colour: str, block: Block, *, automatic: bool) -> Body:
    held = held_points(scene, body)
    return Body(
        body["name"],
        colour,
        triple(body["centre_of_mass"]),
        [part(shape, block) for shape in shapes_of(body)],
        [triple(point) for point in _apart(link_ends(body, held))] if automatic else [],
        [triple(point) for point in held],
        automatic,
        [("mass", f"{body['mass']:.5g} kg")] if "mass" in body else [],
    )


def _part_of(
    chain: dict[str, Any], scene: dict[str, Any], body: dict[str, Any], places: dict[str, int], block: Block
) -> Body:
    """A body of a chain that is drawn as one solid: arms lead from it to what holds it beside the solid."""
    drawn = _body(scene, body, colour_of(places[chain["bodies"][0]]), block, automatic=False)
    section = np.reshape(np.asarray(chain["section"], dtype=float), (-1, 2))
    beside = 1.01 * float(np.linalg.norm(section, axis=1).max(initial=0.0))
    passed = [
        triple(joint["points"][1])
        for joint in scene.get("joints", [])
        if slides_on_beam(joint) and joint["bodies"][1] == body["name"]
    ]
    held = np.reshape(np.array([point for point in drawn.held if point not in passed]), (-1, 3))
    far = held[np.linalg.norm(held - np.array(drawn.centre_of_mass), axis=1) > beside]
    return replace(drawn, links=[triple(point) for point in _apart(far)])


def _apart(points: Array) -> Array:
    """Points (n, 3), each once."""
    return np.unique(points, axis=0) if len(points) else points


def part(shape: dict[str, Any], block: Block) -> Part:
    """A shape of the scene as a part."""
    drawn = _uncoloured(shape, block)
    return replace(drawn, colour=shape["colour"]) if "colour" in shape else drawn


def _uncoloured(shape: dict[str, Any], block: Block) -> Part:
    centre, along = triple(shape.get("centre") or (0.0, 0.0, 0.0)), shape.get("along") or "x"
    match shape["type"]:
        case "box":
            return Part("box", centre, [float(each) for each in shape["size"]])
        case "sphere":
            return Part("sphere", centre, [float(shape["radius"])])
        case "ellipsoid":
            return Part("ellipsoid", centre, [float(each) for each in shape["semi_axes"]])
        case "cylinder" | "capsule":
            return Part(shape["type"], centre, [float(shape["radius"]), float(shape["length"])], along)
        case "tube":
            radii = [float(shape["outer_radius"]), float(shape["inner_radius"])]
            return Part("tube", centre, [*radii, float(shape["length"])], along)
        case "extrusion":
            outline = [(float(a), float(b)) for a, b in shape["outline"]]
            return Part("extrusion", centre, [float(shape["length"])], along, outline)
        case "mesh":
            vertices, triangles = surface_arrays(shape["surface"])
            return Part("mesh", centre, [], vertices=block.add(vertices, "f4"), triangles=block.add(triangles, "u4"))
        case other:
            raise ValueError(f"no picture of the shape {other}")


def _joint(joint: dict[str, Any], places: dict[str, int]) -> Joint:
    first, second = joint["bodies"]
    axes, x_axes = joint["axes"], joint.get("x_axes")
    return Joint(
        joint["name"],
        joint["type"],
        (places[first], places[second]),
        (triple(joint["points"][0]), triple(joint["points"][1])),
        (triple(axes[0]), triple(axes[1])),
        (triple(x_axes[0]), triple(x_axes[1])) if x_axes else None,
        triple(joint["slot"]) if "slot" in joint else None,
        1 if stands_at_second(joint) else 0,
        drawn(joint["type"]).looks.ends is not None,
        facts=[("type", joint["type"]), ("first body", first), ("second body", second)],
    )
