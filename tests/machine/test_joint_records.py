"""Joints: what each type is placed by, its coordinates and their start."""

import pytest
from refusals import refused

from nivel import Joint
from nivel.elements.joints import JOINTS
from nivel.elements.joints.joint import CoordinateRates, CoordinateValues
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS

PAIR = {"bodies": ("crank", "rod")}
MARKERS = {"markers": ({"body": "crank"}, {"body": "rod"})}
KEYS = {
    "point": (0, 0, 0),
    "points": ((0, 0, 0), (1, 0, 0)),
    "axis": (0, 0, 1),
    "axes": ((0, 1, 0), (0, 0, 1)),
    "locked": ("x", "ry"),
    "pitch": "5 mm",
    "distance": 2,
    "radius": 0.5,
    "rim_radius": 0.1,
    "x_axis": (1, 0, 0),
}
TYPES = tuple(JOINTS)
BETWEEN_BODIES = [type_ for type_ in TYPES if not JOINTS[type_].rail]


def by_points(type_):
    kind = JOINTS[type_]
    return {**PAIR, **{key: KEYS[key] for key in (*kind.place, *kind.size)}}


def test_facts_are_those_of_all_types():
    assert {name for kind in JOINTS.values() for name in kind.coordinates} == set(COORDINATE_KINDS)
    free = {name for kind in JOINTS.values() for name in kind.coordinates if name not in kind.held}
    assert set(CoordinateValues.model_fields) == set(CoordinateRates.model_fields) == free


@pytest.mark.parametrize("type_", BETWEEN_BODIES)
def test_every_joint_can_be_placed_by_markers_and_by_points(type_):
    kind = JOINTS[type_]
    assert Joint(name="j", type=type_, **MARKERS, **{key: KEYS[key] for key in kind.size})
    assert Joint(name="j", type=type_, **by_points(type_))
    more = {key: KEYS[key] for key in (*kind.may, *kind.may_size)}
    assert Joint(name="j", type=type_, **by_points(type_), **more).coordinates == JOINTS[type_].coordinates


@pytest.mark.parametrize("type_", TYPES)
def test_what_a_joint_needs_must_be_given_and_what_it_has_not_is_refused(type_):
    kind = JOINTS[type_]
    given = by_points(type_)
    for key in given:
        rest = {name: value for name, value in given.items() if name != key}
        assert f"`{key}`" in refused(Joint, name="j", type=type_, **rest)
    for key in set(KEYS) - {*kind.place, *kind.may, *kind.size, *kind.may_size}:
        text = refused(Joint, name="j", type=type_, **given, **{key: KEYS[key]})
        assert text.startswith(f"joints.j.{key}: ")


@pytest.mark.parametrize("key", ["bodies", "point", "points", "axis", "axes", "x_axis"])
def test_markers_say_where_a_joint_is(key):
    given = {**PAIR, **KEYS}[key]
    assert f"joints.j.{key}: `{key}` must not be given with `markers`" in refused(
        Joint, name="j", type="planar", **MARKERS, **{key: given}
    )


@pytest.mark.parametrize(
    ("given", "part"),
    [
        (
            {"type": "distance", **PAIR, "points": ((0, 0, 0), (0, 0, 0))},
            "joints.j.points: the two `points` are the same",
        ),
        ({"type": "revolute-spherical", **PAIR, "points": ((0, 0, 0),) * 2, "axis": (0, 0, 1)}, "are the same"),
        ({"type": "distance", **PAIR, "point": (0, 0, 0)}, "has no `point`; write `points`"),
        (
            {"type": "screw", **PAIR, "point": (0, 0, 0), "axis": (0, 0, 1), "pitch": 0},
            "joints.j.pitch: `pitch` is zero",
        ),
        ({"type": "screw", **MARKERS}, "`pitch` is missing: a screw joint needs one: the advance per turn, e.g. 5 mm"),
        ({"type": "screw", **MARKERS, "pitch": "5 deg"}, "a length (m) was expected"),
        (
            {"type": "spherical", **MARKERS, "distance": 1},
            "joints.j.distance: `distance` does not belong to a spherical",
        ),
        ({"type": "distance", **MARKERS, "distance": 0}, "a length greater than zero was expected"),
        (
            {"type": "revolute-translational", **PAIR, "point": (0, 0, 0), "axes": ((0, 0, 1), (0, 0, -2))},
            "joints.j.axes: `axes` of a revolute-translational joint are not parallel; these are",
        ),
        ({"type": "planar", **PAIR, "point": (0, 0, 0), "axes": ((0, 0, 1), (0, 1, 0))}, "has no `axes`; write `axis`"),
    ],
)
def test_refused(given, part):
    assert part in refused(Joint, name="j", **given)


def test_points_may_be_the_same_where_the_distance_is_given():
    assert Joint(name="j", type="distance", **PAIR, points=((0, 0, 0), (0, 0, 0)), distance="2 cm").distance == 0.02
    assert Joint(name="j", type="revolute-cylindrical", **PAIR, points=((0, 0, 0),) * 2, axes=KEYS["axes"])


def test_all_faults_of_a_joint_come_at_once():
    text = refused(Joint, name="j", type="revolute", bodies=("rod", "rod"), points=KEYS["points"], pitch=1)
    for part in ("j: a revolute joint needs", "j.bodies: ", "`axis` is missing", "j.points: ", "j.pitch: "):
        assert part in text


def test_start_values_are_of_the_coordinates_of_the_joint():
    joint = Joint(
        name="j",
        type="cylindrical",
        **MARKERS,
        start={"angle": "30 deg", "displacement": "1 cm"},
        start_rates={"angle": 2},
    )
    assert joint.start.given == {"angle": pytest.approx(0.5235987755982988), "displacement": 0.01}
    assert joint.start_rates.given == {"angle": 2.0}
    assert CoordinateValues(x=0).given == {"x": 0.0}


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({"start": {"displacement": 1}}, "joints.j.start.displacement: for a revolute joint the coordinate"),
        (
            {"start_rates": {"x": 1}},
            "joints.j.start_rates.x: for a revolute joint the coordinate `x` is not known; there is",
        ),
        ({"start": {"angl": 1}}, "joints.j.start.angl: the key `angl` is not known; did you mean `angle`?"),
        ({"start": {"angle": "1 m"}}, "joints.j.start.angle: `1 m` is a length (m); an angle (rad) was expected"),
        ({"start_rates": {"angle": "3 rad"}}, "an angular velocity (rad/s) was expected"),
    ],
)
def test_start_values_refused(given, part):
    assert part in refused(Joint, name="j", type="revolute", **MARKERS, **given)
