"""`nivel check` names every freedom, says what removes an idle one, and which joints an exactly constrained machine would have."""

import re

import pytest

import nivel

BODY = "{mass: 1, inertia: [1, 1, 1], position: [%s]}"


def checked(tmp_path, bodies, joints, more=""):
    text = "format: 1\nbodies:\n" + "".join(f"  {name}: {BODY % at}\n" for name, at in bodies.items())
    text += ("joints:\n" + "".join(f"  {name}: {{{rest}}}\n" for name, rest in joints.items())) if joints else ""
    file = tmp_path / "machine.yaml"
    file.write_text(text + more, encoding="utf-8")
    return nivel.load(file).check()


def words(facts):
    assert sum(freedom.count for freedom in facts.freedoms) == facts.degrees_of_freedom
    return [freedom.words for freedom in facts.freedoms]


def test_a_rod_between_two_balls_turns_about_its_own_axis(tmp_path):
    facts = checked(
        tmp_path,
        {"rod": "1, 0, 0"},
        {
            "left": "type: spherical, bodies: [ground, rod], point: [0, 0, 0]",
            "right": "type: point-on-line, bodies: [ground, rod], point: [2, 0, 0], axis: [1, 0, 0]",
        },
    )
    # the ball holds the place along the line
    assert "rod turns about its own axis, through left and right" in words(facts)
    assert "make left universal" in facts.freedoms[0].remedy


def test_a_universal_joint_in_place_of_the_ball_stops_the_turn(tmp_path):
    facts = checked(
        tmp_path,
        {"rod": "1, 0, 0"},
        {
            "left": "type: universal, bodies: [ground, rod], point: [0, 0, 0], axes: [[0, 1, 0], [0, 0, 1]]",
            "right": "type: point-on-line, bodies: [ground, rod], point: [2, 0, 0], axis: [1, 0, 0]",
        },
    )
    assert facts.degrees_of_freedom == 0
    assert facts.freedoms == ()


def test_bodies_without_joints_are_free_in_space(tmp_path):
    facts = checked(tmp_path, {"stone": "1, 0, 0"}, {}, "  bead: {mass: 1, point_mass: true}\n")
    assert words(facts) == ["stone is free in space", "bead is free in space"]
    assert [freedom.count for freedom in facts.freedoms] == [6, 3]


def test_a_joint_coordinate_is_named_with_the_bodies_that_it_moves(tmp_path):
    facts = checked(
        tmp_path,
        {"upper": "1, 0, 0", "lower": "2, 0, 0"},
        {
            "shoulder": "type: revolute, bodies: [ground, upper], point: [0, 0, 0], axis: [0, 0, 1]",
            "elbow": "type: revolute, bodies: [upper, lower], point: [1.5, 0, 0], axis: [0, 0, 1]",
        },
    )
    assert words(facts) == ["shoulder.angle: upper and lower move", "elbow.angle: lower moves"]


def test_a_ball_joint_leaves_every_turn_about_its_point(tmp_path):
    facts = checked(tmp_path, {"top": "1, 0, 0"}, {"tip": "type: spherical, bodies: [ground, top], point: [0, 0, 0]"})
    assert words(facts) == ["top turns in every direction about tip"]


FOUR_BAR = {
    "a": "type: {}, bodies: [ground, crank], point: [0, 0, 0], axis: [0, 0, 1]",
    "b": "type: {}, bodies: [crank, coupler], point: [0, 1, 0], axis: [0, 0, 1]",
    "c": "type: {}, bodies: [coupler, rocker], point: [3, 2, 0], axis: [0, 0, 1]",
    "d": "type: {}, bodies: [ground, rocker], point: [3, 0, 0], axis: [0, 0, 1]",
}
BARS = {"crank": "0, 0.5, 0", "coupler": "1.5, 1.5, 0", "rocker": "3, 1, 0"}


@pytest.mark.parametrize("count", [1, 3])
def test_the_joints_proposed_for_four_bars_make_them_exactly_constrained(tmp_path, count):
    """Those of each loop are found by themselves: three loops have nine rows too many."""
    bars, joints = several_four_bars(count)
    facts = checked(tmp_path, bars, {name: text.format("revolute") for name, text in joints.items()})
    assert len(facts.redundant_rows) == 3 * count
    proposed = dict(change.split() for change in facts.exact)
    joints = {name: text.format(proposed.get(name, "revolute")) for name, text in joints.items()}
    joints = {
        name: text if "spherical" not in text else text.replace(", axis: [0, 0, 1]", "")
        for name, text in joints.items()
    }
    after = checked(tmp_path, bars, joints)
    assert after.redundant_rows == ()
    assert after.degrees_of_freedom == facts.degrees_of_freedom == count


def several_four_bars(count):
    """Bodies and joints of some four-bars that share nothing but the ground."""
    bars = {f"{name}{k}": at for k in range(count) for name, at in BARS.items()}
    joints = {}
    for k in range(count):
        for name, text in FOUR_BAR.items():
            joints[f"{name}{k}"] = re.sub("crank|coupler|rocker", lambda body, k=k: f"{body[0]}{k}", text)
    return bars, joints


def test_a_door_on_two_hinges_gets_a_ball_and_a_point_on_a_line(tmp_path):
    hinge = "type: revolute, bodies: [ground, door], point: [0, 0, {}], axis: [0, 0, 1]"
    facts = checked(tmp_path, {"door": "1, 0, 0"}, {"top": hinge.format(2), "low": hinge.format(0)})
    assert facts.exact == ("top spherical", "low point-on-line")
    assert words(facts) == ["top.angle: door moves"]


def test_freedoms_of_a_machine_with_beams_are_not_named(tmp_path):
    file = tmp_path / "machine.yaml"
    file.write_text(
        "format: 1\nbeams:\n  rod: {from: [0, 0, 0], to: [1, 0, 0], section: {type: circle, radius: 6 mm}, "
        "material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850}, elements: 2}\n",
        encoding="utf-8",
    )
    assert nivel.load(file).check().freedoms == ()


CYLINDER = {
    "foot": "type: revolute, bodies: [ground, boom], point: [0, 0, 0], axis: [0, 1, 0]",
    "base": "type: spherical, bodies: [ground, barrel], point: [1, 0, -1]",
    "slide": "type: %s, bodies: [barrel, rod], point: [1.5, 0, -0.5], axis: [1, 0, 1]",
    "eye": "type: spherical, bodies: [rod, boom], point: [2, 0, 0]",
}
LIFTED = {"boom": "1.5, 0, 0", "barrel": "1.2, 0, -0.8", "rod": "1.8, 0, -0.2"}


def cylinder(tmp_path, slide, **changes):
    joints = {name: changes.get(name, text) for name, text in CYLINDER.items()}
    return checked(tmp_path, LIFTED, joints | {"slide": joints["slide"] % slide})


def test_barrel_and_rod_of_a_cylinder_turn_idly_and_the_proposed_joints_stop_them(tmp_path):
    facts = cylinder(tmp_path, "cylindrical")
    idle = words(facts)[:2]
    assert idle == [
        "barrel turns about its own axis, through base and slide",
        "rod turns about its own axis, through slide and eye",
    ]
    changes = {}
    for freedom in facts.freedoms[:2]:
        name, line = re.fullmatch(r"make (\w+) universal, with `(axes: .*)`", freedom.remedy).groups()
        changes[name] = CYLINDER[name].replace("spherical", "universal") + f", {line}"
    after = cylinder(tmp_path, "cylindrical", **changes)
    assert after.degrees_of_freedom == facts.degrees_of_freedom - 2
    assert after.redundant_rows == ()


def test_bodies_that_turn_as_one_are_named_together(tmp_path):
    facts = cylinder(tmp_path, "translational")
    together = [freedom for freedom in facts.freedoms if "together" in freedom.words]
    assert [each.words for each in together] == [
        "barrel and rod turn together about their axis, through base and slide"
    ]
    assert together[0].remedy.startswith("make base universal, with `axes: ")


def test_a_piston_is_kept_from_turning_by_its_bore(tmp_path):
    facts = checked(
        tmp_path,
        {"rod": "1, 0, 0", "piston": "2, 0, 0"},
        {
            "pin": "type: universal, bodies: [ground, rod], point: [0, 0.5, 0], axes: [[0, 1, 0], [0, 0, 1]]",
            "wrist": "type: spherical, bodies: [rod, piston], point: [2, 0, 0]",
            "bore": "type: cylindrical, bodies: [ground, piston], point: [2, 0, 0], axis: [1, 0, 0]",
        },
    )
    turn = facts.freedoms[0]
    assert turn.words == "piston turns about its own axis, through wrist and bore"
    assert turn.remedy == "make bore translational"


def test_a_driven_angle_of_a_cylindrical_joint_is_no_idle_turn(tmp_path):
    facts = checked(
        tmp_path,
        {"drill": "1, 0, 0"},
        {
            "sleeve": "type: cylindrical, bodies: [ground, drill], point: [0, 0, 0], axis: [1, 0, 0]",
            "tip": "type: point-on-line, bodies: [ground, drill], point: [2, 0, 0], axis: [1, 0, 0]",
        },
        "forces:\n  motor: {type: motor, coordinate: sleeve.angle, effort: 1}\n",
    )
    assert "sleeve.angle: drill moves" in words(facts)


def test_a_body_that_no_joint_holds_is_named_with_what_it_carries(tmp_path):
    facts = checked(
        tmp_path,
        {"car": "1, 0, 0", "wheel": "2, 0, 0"},
        {"axle": "type: revolute, bodies: [car, wheel], point: [2, 0, 0], axis: [0, 1, 0]"},
    )
    assert words(facts) == ["axle.angle: wheel moves", "car is free in space: car and wheel move"]


HINGES = {
    name: f"type: revolute, bodies: [ground, door], point: [0, 0, {z}], axis: [0, 0, 1]"
    for name, z in {"top": 2, "low": 0, "mid": 1}.items()
}
GEAR = "couplings:\n  gear: {type: gear, joints: [a, b], ratio: 2}\n"
WHEELS = {
    name: f"type: revolute, bodies: [ground, {body}], point: [{x}, 0, 0], axis: [0, 0, 1]"
    for name, body, x in (("a", "first", 0), ("b", "second", 1))
}


@pytest.mark.parametrize(
    ("bodies", "joints", "more", "exact"),
    [
        ({"door": "1, 0, 0"}, HINGES, "", ("top spherical", "low point-on-line", "leave out mid")),
        (
            {"first": "0, 0, 0", "second": "1, 0, 0"},
            WHEELS,
            GEAR + GEAR[11:].replace("gear:", "same:"),
            ("leave out same",),
        ),
        (
            {"first": "0, 0, 0", "second": "1, 0, 0"},
            WHEELS,
            GEAR + "drivers:\n  one: {coordinate: a, value: time}\n  two: {coordinate: b, value: -time/2}\n",
            ("leave out two",),
        ),
    ],
)
def test_where_freer_joints_do_not_suffice_something_is_left_out(tmp_path, bodies, joints, more, exact):
    """A third hinge; a second gear between the same wheels; a second driver of the same motion."""
    assert checked(tmp_path, bodies, joints, more).exact == exact
