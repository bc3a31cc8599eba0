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
