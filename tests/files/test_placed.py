"""Parts that are turned, moved and mirrored: what they are is the image of what they were."""

import numpy as np
import pytest

from nivel import Body, Joint, Marker, PointForce
from nivel.elements.joints import JOINTS
from nivel.files import parse_machine
from nivel.files.assembly import placed
from nivel.files.placement import Placement, Scene
from nivel.files.substitution import NotRepresentableError
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.core.orientation import Orientation, matrix_from_euler_parameters, rotation_matrix
from nivel.machine.core.placement import frame_from_axes, initial_velocity, marker_frame, placement
from nivel.machine.core.record import GROUND
from nivel.machine.uses.references import SECTIONS

pytestmark = pytest.mark.covering

TURNED = Orientation(euler=(0.3, 0.7, -1.0), sequence="zxz")
PLACEMENTS = {
    "moved": Placement.of((0.5, -0.3, 0.2), None, "none"),
    "turned": Placement.of((0.5, -0.3, 0.2), TURNED, "none"),
    "x": Placement.of((0, 0, 0), None, "x"),
    "y": Placement.of((0.5, 0, 0), None, "y"),
    "z": Placement.of((0, 0, 0), None, "z"),
    "y turned": Placement.of((0.5, -0.3, 0.2), TURNED, "y"),
}
every_placement = pytest.mark.parametrize("placing", PLACEMENTS.values(), ids=PLACEMENTS.keys())

INERTIA = {"xx": 0.02, "yy": 0.03, "zz": 0.025, "xy": 0.003, "xz": 0.001, "yz": -0.002}
BODIES = (
    Body(
        name="a",
        mass=2,
        position=(0.3, 0.1, -0.2),
        orientation=Orientation(euler=(0.3, 0.5, -0.2), sequence="zxz"),
        centre_of_mass=(0.05, -0.02, 0.03),
        inertia=INERTIA,
        velocity=(1, 2, 3),
        angular_velocity=(1, -2, 0.5),
    ),
    Body(name="b", mass=1, centre_of_mass=(0.1, 0, 0), inertia=INERTIA, inertia_about="origin", angular_velocity_body=(1, 2, 3)),
    Body(name="bar", density=1000, shape={"type": "box", "from": (0, 0, 0), "to": (1, 2, 1), "width": 0.1, "height": 0.2}),
    Body(name="pipe", density=1000, shape={"type": "tube", "from": (0, 0, 0), "to": (0, 0, 1), "outer_radius": 0.1, "inner_radius": 0.05}),
    Body(name="rod", mass=20, shape={"type": "cylinder", "length": 1, "radius": 0.1, "along": "z", "centre": (0.1, 0.2, 0.3)}),
    Body(name="point", mass=1, position=(1, 2, 3), velocity=(0, 1, 0), point_mass=True),
)  # fmt: skip


def elements(**sections):
    return {section: sections.get(section, ()) for section in SECTIONS}


def axes_of(body):
    return matrix_from_euler_parameters(placement(body)[1])


@every_placement
@pytest.mark.parametrize("body", BODIES, ids=lambda body: body.name)
def test_bodies_are_images(body, placing):
    (image,) = placed(elements(bodies=(body,)), placing)["bodies"]
    position, axes = placement(body)[0], axes_of(body)
    assert np.allclose(placement(image)[0], placing.point(position), atol=1e-14)
    if body.point_mass:
        assert np.allclose(image.velocity, placing.direction(body.velocity))
        return
    its_axes = axes_of(image)
    assert np.allclose(its_axes, placing.polar @ axes * placing.reflection, atol=1e-14)
    properties, of_image = mass_properties(body), mass_properties(image)
    centre = position + axes @ properties.centre_of_mass
    assert np.allclose(placement(image)[0] + its_axes @ of_image.centre_of_mass, placing.point(centre), atol=1e-14)
    tensor = axes @ properties.inertia @ axes.T
    assert np.allclose(its_axes @ of_image.inertia @ its_axes.T, placing.polar @ tensor @ placing.polar.T, atol=1e-14)
    (velocity, turning), (of_v, of_w) = initial_velocity(body), initial_velocity(image)
    assert np.allclose(of_v, placing.direction(velocity), atol=1e-14)
    assert np.allclose(its_axes @ of_w, placing.turning(axes @ turning), atol=1e-14)


NO_AXES = (
    "spherical",
    "fixed",
    "distance",
    "spherical-spherical",
    "variable-distance",
)  # where they are placed by points
WITH_AXES = [
    (kind, by)
    for kind in JOINTS
    for by in ("points", "markers")
    if not JOINTS[kind].rail and (by == "markers" or kind not in NO_AXES)
]


def joint_of(kind, by):
    """A joint of a kind between a and b, by points or by markers."""
    size = {"screw": {"pitch": 0.01}, "generic": {"locked": ("rx", "ry")}, "rolling": {"radius": 0.5}}.get(kind, {})
    if by == "markers":
        first = Marker(body="a", position=(0.1, 0.2, 0.3), axis=(1, 2, 0.5), x_axis=(0.3, 0, 1))
        second = Marker(body="b", position=(-0.1, 0.2, 0), orientation=Orientation(euler=(1, 2, 3), sequence="xyz"))
        return Joint(name="j", type=kind, markers=(first, second), **size)
    axes = ((0, 1, 0.2), (1, 0, 0)) if JOINTS[kind].axes == "perpendicular" else ((0, 1, 0.2), (1, 0.3, 0))
    if kind == "translational-universal":
        axes = ((0.3, 0, -0.2), (0.2, 1, 0.3))  # the first across the way
    given = {"point": (0.4, 0, 0.1), "points": ((0.4, 0, 0.1), (1, 2, 0)), "axis": (0.2, 1, 0.3), "axes": axes}
    return Joint(name="j", type=kind, bodies=("a", "b"), **{key: given[key] for key in JOINTS[kind].place}, **size)


def ends(joint):
    """Points and axes of the joint in the frames of its two bodies as the documentation says."""
    if joint.markers is not None:
        return [marker_frame(marker) for marker in joint.markers]
    points = joint.points or (joint.point, joint.point)
    if joint.axes is not None:
        first, second = joint.axes
        frames = [frame_from_axes(first, joint.x_axis if joint.type == "rolling" else second)] * 2
        if joint.axis is not None:
            frames[0] = frame_from_axes(joint.axis, first)
        if joint.type != "revolute-translational":
            frames[1] = frame_from_axes(second, first)
    else:
        frames = [np.eye(3) if joint.axis is None else frame_from_axes(joint.axis, joint.x_direction)] * 2
    return list(zip(map(np.array, points), frames, strict=True))


def in_body(end, body):
    axes = axes_of(body)
    return axes.T @ (end[0] - placement(body)[0]), axes.T @ end[1]


def coordinates(joint, bodies, poses):
    """Joint coordinates and sizes of rows with the bodies at `poses` (position, axes)."""
    local = ends(joint) if joint.markers is not None else map(in_body, ends(joint), bodies)
    (p1, c1), (p2, c2) = ((r + axes @ p, axes @ c) for (p, c), (r, axes) in zip(local, poses, strict=True))
    between = c1.T @ (p2 - p1)
    slide = (c2.T @ (p2 - p1))[0] if joint.type == "revolute-translational" else between[2]
    turn = c1.T @ c2
    of_link = joint.type == "revolute-spherical"
    return {
        "angle": np.arctan2(between[1], between[0]) if of_link else np.arctan2(turn[1, 0], turn[0, 0]),
        "displacement": slide,
        "x": between[0],
        "y": between[1],
        "angle_1": np.arctan2(turn[1, 2], turn[0, 2]),
        "angle_2": np.arctan2(turn[2, 1], turn[2, 0]),
        "distance": np.linalg.norm(between),
    }, np.abs(np.concatenate([between, turn.ravel()]))


@every_placement
@pytest.mark.parametrize(("kind", "by"), WITH_AXES)
def test_joints_keep_the_meaning_of_their_coordinates(kind, by, placing, rng):
    joint, bodies = joint_of(kind, by), BODIES[:2]
    made = placed(elements(bodies=bodies, joints=(joint,)), placing)
    poses = [
        (rng.normal(size=3), rotation_matrix(Orientation(euler=tuple(rng.normal(size=3)), sequence="zxz")))
        for _ in bodies
    ]
    images = [(np.array(placing.point(r)), placing.polar @ axes * placing.reflection) for r, axes in poses]
    values, rows = coordinates(joint, bodies, poses)
    of_image, its_rows = coordinates(made["joints"][0], made["bodies"], images)
    for name in JOINTS[kind].coordinates:
        opposite = placing.mirrored and kind in ("cylindrical", "screw", "generic") and name == "displacement"
        opposite |= placing.mirrored and kind == "rolling" and name == "y"
        assert of_image[name] == pytest.approx(-values[name] if opposite else values[name], abs=1e-12), name
    if joint.axes is None:
        assert its_rows == pytest.approx(rows, abs=1e-12)
    if kind == "screw":
        assert made["joints"][0].pitch == (-0.01 if placing.mirrored else 0.01)


@every_placement
def test_signals_of_the_part_are_found_in_the_placed_part(placing, rng):
    scene = Scene.of(elements(bodies=BODIES), placing)
    point, velocity, turning = rng.normal(size=(3, 3))
    seen = {
        f"a.{kind}{axis}": value
        for kind, vector in (
            ("", placing.point(point)),
            ("v", placing.direction(velocity)),
            ("w", placing.turning(turning)),
        )
        for axis, value in zip("xyz", vector, strict=True)
    }
    for kind, vector in (("", point), ("v", velocity), ("w", turning)):
        for axis, value in zip("xyz", vector, strict=True):
            linear = scene.signal(f"a.{kind}{axis}")
            assert linear.offset + sum(factor * seen[path] for factor, path in linear.terms) == pytest.approx(value)
    assert str(scene.signal("unknown.length")) == "unknown.length"


@every_placement
def test_markers_on_ground_and_on_bodies(placing):
    part = elements(
        bodies=BODIES,
        markers=(
            Marker(name="on", body="a", position=(0.1, 0.2, 0.3), axis=(1, 2, 3)),
            Marker(name="there", body=GROUND, position=(1, 2, 3), axis=(1, 2, 3)),
        ),
    )
    made = placed(part, placing)
    on, there = made["markers"]
    p, axes = marker_frame(part["markers"][1])
    q, its_axes = marker_frame(there)
    assert np.allclose(q, placing.point(p))
    assert np.allclose(its_axes[:, 2], placing.turning(axes[:, 2]))
    assert np.allclose(its_axes[:, 0], placing.direction(axes[:, 0]))
    body, image = part["bodies"][0], made["bodies"][0]
    p, axes = marker_frame(part["markers"][0])
    q, its_axes = marker_frame(on)
    where = placement(body)[0] + axes_of(body) @ p
    assert np.allclose(placement(image)[0] + axes_of(image) @ q, placing.point(where))
    assert np.allclose(axes_of(image) @ its_axes[:, 2], placing.turning(axes_of(body) @ axes[:, 2]))


def vector(text):
    body = "bodies: {a: {mass: 1, inertia: [1, 1, 1]}}"
    return parse_machine(f"format: 1\n{body}\nforces: {{f: {{type: force, body: a, vector: {text}}}}}").forces[0]


@pytest.mark.parametrize(
    "text",
    [
        "[1, 2, 3]",
        "[time, 2 + time, sin(time)]",
        "[{times: [0, 1], values: [0, 2]}, 3, {times: [0.5, 2], values: [1, 5]}]",
    ],
)
@every_placement
def test_forces_that_vary_are_turned(text, placing):
    force = vector(text)
    (image,) = placed(elements(forces=(force,), bodies=BODIES), placing)["forces"]
    for time in (0, 0.3, 0.7, 1.5, 3):
        was, now = (
            [each if isinstance(each, float | int) else each(time) for each in record.vector]
            for record in (force, image)
        )
        assert np.allclose(now, placing.direction(was))


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("[time, {times: [0, 1], values: [0, 2]}, 0]", "a table would have to be mixed with another component"),
        (
            "[{times: [0, 1, 2], values: [0, 2, 0], interpolation: cubic}, {times: [0, 1, 3], values: [0, 2, 0], interpolation: cubic}, 0]",
            "smooth tables would have to be added",
        ),
    ],
)
def test_what_no_file_can_say_is_refused(text, why):
    with pytest.raises(NotRepresentableError, match=f"forces.f: {why}"):
        placed(elements(forces=(vector(text),), bodies=BODIES), PLACEMENTS["turned"])
    made = placed(elements(forces=(vector(text),), bodies=BODIES), Placement.of((0, 0, 0), None, "z"))
    assert isinstance(made["forces"][0], PointForce)


MIRRORED = """\
format: 1
bodies:
  a: {mass: 1, inertia: [1, 1, 1]}
  b: {mass: 1, inertia: [1, 1, 1]}
markers: {m: {body: b}, n: {body: a}}
joints:
  c: {type: cylindrical, bodies: [a, b], point: [0, 0, 0], axis: [0, 0, 1], start_rates: {angle: 1, displacement: 2}}
  e: {type: screw, bodies: [ground, a], point: [0, 0, 0], axis: [0, 0, 1], pitch: 2}
couplings:
  l: {type: linear, coordinates: [c.angle, c.displacement], factors: [1, 2]}
  r: {type: rack, joints: [c.angle, c.displacement], radius: 0.3}
drivers:
  d: {coordinate: e.displacement, value: 0.1*time}
  z: {marker: m, along: z, relative_to: n, value: 1}
  x: {marker: m, along: x, value: 1}
forces:
  s: {type: joint-spring-damper, coordinate: c.displacement, table: {deflections: [-1, 2], efforts: [-3, 4]}, free_value: 1, preload: 5}
  w: {type: joint-spring-damper, coordinate: c.displacement, law: 3*value + value*rate}
  e: {type: stop, coordinate: c.displacement, lower: -1, upper: 2, stiffness: 1e5, restitution: 0.5}
  m: {type: motor, coordinate: c.displacement, effort: 5 - c.displacement_rate}
  t: {type: motor, coordinate: c.angle, effort: {of: c.displacement, points: [0, 1], values: [2, 3]}}
  b:
    type: bushing
    bodies: [a, b]
    points: [[0, 0, 0], [0, 0, 0]]
    stiffness:
      [[2, 1, 1, 0, 0, 0], [1, 2, 1, 0, 0, 0], [1, 1, 2, 0, 0, 0], [0, 0, 0, 2, 1, 1], [0, 0, 0, 1, 2, 1], [0, 0, 0, 1, 1, 2]]
sensors:
  q: {value: c.displacement*m.x}
events:
  o: {when: c.displacement - 2, direction: rising}
"""


def test_what_counts_the_other_way_in_the_image():
    machine = parse_machine(MIRRORED)
    made = placed({section: getattr(machine, section) for section in SECTIONS}, Placement.of((0, 0, 1), None, "z"))
    one = {section: {each.name: each for each in made[section]} for section in SECTIONS}
    assert one["joints"]["c"].start_rates.given == {"angle": 1, "displacement": -2}
    assert one["joints"]["c"].axis == (0, 0, 1)  # an axis of turning along z is its own mirror image
    assert one["joints"]["e"].pitch == -2
    assert one["couplings"]["l"].factors == (1, -2)
    assert one["couplings"]["r"].radius == -0.3
    assert one["drivers"]["d"].value(2) == pytest.approx(-0.2)
    spring = one["forces"]["s"]
    assert (spring.free_value, spring.preload, spring.table.points) == (-1, -5, ((-2, 1), (-4, 3)))
    law = machine.forces[1].law
    assert one["forces"]["w"].law(0, {"value": 2, "rate": 3}) == pytest.approx(-law(0, {"value": -2, "rate": -3}))
    assert (one["forces"]["e"].lower, one["forces"]["e"].upper) == (-2, 1)
    assert one["forces"]["m"].effort(0, {"c.displacement_rate": 2}) == pytest.approx(-(5 + 2))
    assert one["forces"]["t"].effort.times == (-1, 0)
    assert one["forces"]["t"].effort.values == (3, 2)
    assert one["sensors"]["q"].value(0, {"c.displacement": 2, "m.x": 3}) == -6
    assert one["events"]["o"].when(0, {"c.displacement": -3}) == 1
    assert one["events"]["o"].direction == "rising"
    assert one["drivers"]["z"].relative_to == "n_mirrored"
    assert np.allclose(marker_frame(one["markers"]["n_mirrored"])[1][:, 2], (0, 0, -1))
    frame = one["markers"][one["drivers"]["x"].relative_to]
    assert (frame.body, frame.position) == (GROUND, (0, 0, 1))
    matrix = one["forces"]["b"].stiffness_matrix
    assert matrix[0, 1] == 1
    assert matrix[0, 2] == matrix[1, 2] == -1
    assert matrix[3, 4] == 1
    assert matrix[3, 5] == matrix[4, 5] == -1


def test_a_part_that_is_not_placed_stays_as_it_is():
    machine = parse_machine(MIRRORED)
    part = {section: getattr(machine, section) for section in SECTIONS}
    assert placed(part, Placement.of((0, 0, 0), None, "none")) == part


def test_the_looks_of_a_mirrored_body_are_mirrored():
    """A point of a solid beside the body frame, and of an outline, is where the mirror image has it."""
    corners = ((0.0, 0.0), (1.0, 0.0), (0.0, 2.0))
    body = Body(
        name="a",
        mass=1,
        inertia=INERTIA,
        position=(0.3, 0.1, -0.2),
        looks=(
            {"type": "sphere", "radius": 0.1, "centre": (0.1, 0.2, 0.3), "colour": "red"},
            {"type": "extrusion", "outline": corners, "length": 1, "along": "z"},
        ),
    )
    placing = PLACEMENTS["y turned"]
    (image,) = placed(elements(bodies=(body,)), placing)["bodies"]
    position, parameters = placement(image)
    A = matrix_from_euler_parameters(parameters)
    for k, corner in enumerate(corners):
        point = np.array([*image.looks[1].outline[k], 0.0])
        np.testing.assert_allclose(
            position + A @ point, placing.point((0.3 + corner[0], 0.1 + corner[1], -0.2)), atol=1e-12
        )
    np.testing.assert_allclose(position + A @ image.looks[0].centre, placing.point((0.4, 0.3, 0.1)), atol=1e-12)
    assert image.looks[0].colour == "red"
