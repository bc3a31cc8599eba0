"""Every kind of joint has its own sign; rods, springs and planes are drawn where they are."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from nivel.elements.joints import JOINTS, UNKNOWN
from nivel.looks.viewpoint import sliding_axes, turning_axes
from nivel.report.force_drawing import planes
from nivel.report.picture import machine_picture
from nivel.report.strokes import joint_icon, joint_sign

LINKS = {type_: kind.looks.ends for type_, kind in JOINTS.items() if kind.looks.ends is not None}
AT_REST = np.array([[1.0, 0, 0, 0]])
SVG = "{http://www.w3.org/2000/svg}"
ICON_WIDTH, ICON_HEIGHT = 36.0, 20.0


def machine(joints=(), forces=(), shape=None, bodies=("arm",)):
    """Bodies whose frames are the global one, the centre of mass of the k-th at x = 1 + k."""
    held = {name: [] for name in (*bodies, "ground")}
    for each in joints:
        for body, point in zip(each["bodies"], each["points"], strict=True):
            held[body].append([*point])
    return {
        "bodies": [
            {"name": name, "shape": shape, "centre_of_mass": [1.0 + k, 0, 0], "points": held[name]}
            for k, name in enumerate(bodies)
        ],
        "ground_points": held["ground"],
        "joints": list(joints),
        "forces": list(forces),
    }


def joint(kind, points=((0, 0, 0), (0, 0, 0)), **more):
    axes = [[0, 0, 1], [0, 0, 1]]
    return {"name": "j", "type": kind, "bodies": ["ground", "arm"], "points": [*points], "axes": axes, **more}


def force(kind, points=((0, 1, 0), (1, 0, 0)), **more):
    return {"name": "f", "type": kind, "bodies": ["ground", "arm"], "points": [*points], **more}


def drawn(scene, up=(0, 0, 1)):
    count = len(scene["bodies"])
    return machine_picture(scene, np.zeros((count, 3)), np.tile(AT_REST, (count, 1)), up)


def titles(svg):
    return {element.text for element in ET.fromstring(svg).iter(f"{SVG}title")}


def classes(svg):
    return [element.get("class") or "" for element in ET.fromstring(svg).iter()]


def test_every_kind_of_joint_has_a_sign():
    assert all(kind.symbol is not UNKNOWN.symbol for kind in JOINTS.values())
    assert {end for ends in LINKS.values() for end in ends} <= set(JOINTS)


@pytest.mark.parametrize("axis", [(1.0, 0.0), (0.0, 0.0)], ids=["seen", "end-on"])
def test_signs_of_kinds_that_differ_differ(axis):
    signs = {kind: joint_sign(kind, 0.0, 0.0, axis) for kind in JOINTS}
    assert signs.pop("distance") == signs["spherical-spherical"]  # two words for one joint
    assert len(set(signs.values())) == len(signs)
    assert joint_sign("unheard-of", 0.0, 0.0, axis) not in signs.values()


@pytest.mark.parametrize("kind", sorted(JOINTS))
def test_every_joint_has_an_icon_that_fits(kind):
    root = ET.fromstring(str(joint_icon(kind)))
    assert len(list(root.iter())) > 2
    for circle in root.iter("circle"):
        assert float(circle.get("r")) < ICON_HEIGHT / 2
    for rect in root.iter("rect"):
        assert float(rect.get("width")) <= ICON_WIDTH


@pytest.mark.parametrize("kind", sorted(JOINTS))
@pytest.mark.parametrize("ground_first", [True, False])
def test_every_joint_is_drawn_named_and_grounded(kind, ground_first):
    made = joint(kind, ((0, 0, 0), (0.5, 0.5, 0)), slot=[1, 0, 0]) if kind == "revolute-translational" else None
    made = made or joint(kind, ((0, 0, 0), (0.5, 0.5, 0)))
    if not ground_first:
        made["bodies"].reverse()
    svg = drawn(machine([made]))
    assert "j: " + kind + (", ground – arm" if ground_first else ", arm – ground") in titles(svg)
    assert ">j</text>" in svg
    assert any("ground" in each for each in classes(svg))
    assert classes(svg).count("joint") == (2 if kind in LINKS else 1)


@pytest.mark.parametrize("kind", sorted(LINKS))
def test_a_joint_between_two_points_is_a_rod_between_them(kind):
    svg = drawn(machine([joint(kind, ((0, 0, 0), (0, 2, 0)))]))
    places = re.findall(r'translate\(([-\d.]+) ([-\d.]+)\) rotate\([-\d.]+\) scale\([\d.]+\)" class="joint"', svg)
    first, second = (np.array(place, dtype=float) for place in places)
    assert np.linalg.norm(first - second) > 50.0
    (rod,) = re.findall(r'd="M([-\d.]+) ([-\d.]+)L([-\d.]+) ([-\d.]+)" class="rod"', svg)
    np.testing.assert_allclose(np.array(rod, dtype=float), [*first, *second], atol=0.11)


def test_one_point_joints_have_no_rod():
    assert not any("rod" in each for each in classes(drawn(machine([joint("revolute")]))))


def test_a_spring_is_a_zigzag_from_point_to_point():
    svg = drawn(machine([joint("revolute")], [force("spring-damper", ((0, 1, 0), (1, 1, 0)))]))
    assert titles(svg) >= {"f: spring-damper, ground – arm"}
    ((x, y, angle),) = re.findall(r'translate\(([-\d.]+) ([-\d.]+)\) rotate\(([-\d.]+)\)" class="spring"', svg)
    path = re.search(r'class="spring"><path d="M0 0H([-\d.]+)(L.*?)H([-\d.]+)"', svg)
    tips = np.array(re.findall(r"L([-\d.]+) ([-\d.]+)", path[2]), dtype=float)
    length, sides = float(path[3]), np.sign(tips[:-1, 1])
    assert np.all(np.diff(tips[:, 0]) > 0.0)
    assert np.all(sides[1:] == -sides[:-1])  # from side to side
    assert len(sides) >= 3
    centre = re.search(r'translate\(([-\d.]+) ([-\d.]+)\) scale\([\d.]+\)" class="mass"', svg)
    hinge = re.search(r'translate\(([-\d.]+) ([-\d.]+)\) rotate\([-\d.]+\) scale\([\d.]+\)" class="joint"', svg)
    metre = float(centre[1]) - float(hinge[1])
    assert float(angle) == pytest.approx(0.0, abs=0.1)
    assert length == pytest.approx(metre, abs=0.2)
    assert (float(x), float(y)) == pytest.approx((float(hinge[1]), float(hinge[2]) - metre), abs=0.2)
    assert ">f</text>" in svg


@pytest.mark.parametrize("kind", ["pair-force", "bushing"])
def test_other_forces_between_points_are_dashed(kind):
    apart = drawn(machine([joint("revolute")], [force(kind)]))
    (line,) = [each for each in ET.fromstring(apart).iter() if each.get("class") == "pair-force"]
    assert line.tag == f"{SVG}path"
    together = drawn(machine([joint("revolute")], [force(kind, ((1, 0, 0), (1, 0, 0)))]))
    (ring,) = [each for each in ET.fromstring(together).iter() if each.get("class") == "pair-force"]
    assert ring.tag == f"{SVG}circle"
    assert "stroke-dasharray" in apart


def test_a_torsional_spring_is_a_spiral_at_its_first_point():
    svg = drawn(machine([joint("revolute")], [force("torsional-spring-damper", ((0, 0, 0), (0, 0, 0)))]))
    hinge = re.search(r'translate\(([-\d.]+) ([-\d.]+)\) rotate\([-\d.]+\) scale\([\d.]+\)" class="joint"', svg)
    coil = re.search(r'translate\(([-\d.]+) ([-\d.]+)\) scale\([\d.]+\)" class="spring"', svg)
    assert coil.groups() == hinge.groups()


def test_everything_that_holds_is_inside_the_picture():
    far = force("spring-damper", ((-30, 0, 0), (1, 0, 0)))
    svg = drawn(machine([joint("revolute")], [far]))
    _, _, width, height = (float(v) for v in ET.fromstring(svg).get("viewBox").split())
    x, y = re.search(r'translate\(([-\d.]+) ([-\d.]+)\) rotate\([-\d.]+\)" class="spring"', svg).groups()
    assert 0 < float(x) < width
    assert 0 < float(y) < height


PLANE = {"axis": [0, 0, 1]}


def test_a_plane_is_a_hatched_line_under_what_touches_it():
    scene = machine(forces=[force("contact", ((1, 0, 0), (9, 9, -2)), bodies=["arm", "ground"], **PLANE)])
    svg = drawn(scene)
    x, y, angle = re.search(r'translate\(([-\d.]+) ([-\d.]+)\) rotate\(([-\d.]+)\)" class="ground plane"', svg).groups()
    centre = re.search(r'translate\(([-\d.]+) ([-\d.]+)\) scale\([\d.]+\)" class="mass"', svg)
    assert float(angle) == pytest.approx(0.0)
    assert float(x) == pytest.approx(float(centre[1]), abs=0.2)  # under the body, not where its marker is
    assert float(y) > float(centre[2]) + 50.0


def test_bodies_on_one_plane_share_its_line():
    touching = [
        force("contact", ((1.0 + k, 0, 0), (0, 0, -1)), bodies=[name, "ground"], **PLANE)
        for k, name in enumerate(("arm", "leg"))
    ]
    assert drawn(machine(forces=touching, bodies=("arm", "leg"))).count("ground plane") == 1
    touching[1]["points"][1] = [0, 0, -1.5]
    assert drawn(machine(forces=touching, bodies=("arm", "leg"))).count("ground plane") == 2


def test_a_plane_seen_from_above_is_not_drawn():
    flat = [joint("revolute", ((0, 0, 0), (0, 0, 0)))]  # seen along Z
    resting = force("contact", ((1, 0, 0), (0, 0, 0)), bodies=["arm", "ground"], **PLANE)
    assert "ground plane" not in drawn(machine(flat, [resting]))


def test_a_plane_far_away_does_not_shrink_the_machine():
    poses = {"ground": (np.zeros(3), np.eye(3)), "arm": (np.zeros(3), np.eye(3))}
    cloud = np.array([[0, 0, 0], [1.0, 0, 0]])
    for depth, count in ((-1.0, 1), (-1000.0, 0)):
        contact = force("contact", ((1, 0, 0), (0, 0, depth)), bodies=["arm", "ground"], **PLANE)
        assert len(planes(machine(forces=[contact]), poses, cloud)) == count


def test_contacts_of_two_spheres_have_no_plane():
    scene = machine(forces=[force("contact", ((1, 0, 0), (2, 0, 0)), bodies=["arm", "leg"])], bodies=("arm", "leg"))
    assert "ground plane" not in drawn(scene)


def test_names_of_forces_are_text_not_markup():
    svg = drawn(machine([joint("revolute")], [{**force("spring-damper"), "name": "<b>&"}]))
    ET.fromstring(svg)
    assert "<b>" not in svg


def test_scenes_of_older_results_have_no_forces():
    scene = machine([joint("revolute")])
    del scene["forces"]
    assert drawn(scene)


@pytest.mark.parametrize(
    ("kind", "turning", "sliding"),
    [
        ("planar", 1, 0),
        ("screw", 0, 1),
        ("revolute-cylindrical", 2, 0),
        ("revolute-translational", 1, 1),
        ("fixed", 0, 0),
    ],
)
def test_axes_say_what_is_planar(kind, turning, sliding):
    poses = {"ground": (np.zeros(3), np.eye(3)), "arm": (np.zeros(3), np.eye(3))}
    scene = machine([joint(kind, slot=[1, 0, 0])])
    assert len(turning_axes(scene, poses)) == turning
    assert len(sliding_axes(scene, poses)) == sliding
    if kind == "revolute-translational":
        np.testing.assert_array_equal(sliding_axes(scene, poses), [[1, 0, 0]])


def test_the_scale_keeps_clear_of_the_machine():
    """Where bodies fill every corner, the picture grows."""
    corners = [[x, y, 0] for x in (-1, 1) for y in (-0.7, 0.7)]
    scene = machine([{**joint("revolute", (c, c)), "name": f"j{k}"} for k, c in enumerate(corners)])
    svg = drawn(scene)
    (bar,) = re.findall(r'class="aid-line" d="M[-\d.]+ [-\d.]+V([-\d.]+)H', svg)
    lowest = max(float(y) for y in re.findall(r"translate\([-\d.]+ ([-\d.]+)\) rotate\([-\d.]+\) scale", svg))
    assert float(bar) > lowest + 20.0
