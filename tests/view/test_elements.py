"""Everything that a machine has is in the list and in the picture: forces at joints, drivers, gears, belts, racks; and beams."""

import json
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import nivel
import synthetic_run as pendulum
from browsing import drawn, served, until, watched
from many_bodies import ARC, NODES, RADIUS, arc, beam
from nivel.api import Machine
from nivel.files.reader import parse_machine
from nivel.looks import sweeps
from nivel.looks.solids import colour_of
from nivel.looks.viewpoint import rotation
from nivel.report.picture import machine_picture
from nivel.results import Memory
from nivel.view.package import Block
from nivel.view.page import write_scene
from nivel.view.playback import ALONE, _owner, playback
from packages import Live, from_bytes

EXAMPLES = Path(__file__).parent.parent.parent / "examples"
MACHINE = """
format: 1
gravity: [0, -9.81, 0]
bodies:
  a: {shape: {type: cylinder, radius: 10 cm, length: 4 cm, along: z}, density: 7800}
  b: {position: [30 cm, 0, 0], shape: {type: cylinder, radius: 20 cm, length: 4 cm, along: z}, density: 7800}
  c: {position: [80 cm, 10 cm, 0], shape: {type: cylinder, radius: 6 cm, length: 4 cm, along: z}, density: 7800}
  ram: {position: [30 cm, -24 cm, 0], shape: {type: box, size: [40 cm, 4 cm, 4 cm]}, mass: 1}
  block: {position: [0, 40 cm, 0], shape: {type: box, size: [10 cm, 10 cm, 10 cm]}, mass: 1}
markers:
  corner: {body: block, position: [5 cm, 5 cm, 5 cm]}
joints:
  ja: {type: revolute, bodies: [ground, a], point: [0, 0, 0], axis: [0, 0, 1]}
  jb: {type: revolute, bodies: [ground, b], point: [30 cm, 0, 0], axis: [0, 0, 1]}
  jc: {type: revolute, bodies: [ground, c], point: [80 cm, 10 cm, 0], axis: [0, 0, 1]}
  way: {type: translational, bodies: [ground, ram], point: [30 cm, -24 cm, 0], axis: [1, 0, 0]}
  rail: {type: translational, bodies: [ground, block], point: [0, 40 cm, 0], axis: [1, 0, 0]}
couplings:
  mesh: {type: gear, joints: [ja, jb], teeth: [20, 40]}
  rope: {type: belt, joints: [jb, jc], radii: [15 cm, 6 cm]}
  rack: {type: rack, joints: [jb, way], radius: 20 cm}
drivers:
  shake: {coordinate: rail, value: 2 cm*sin(4*time)}
forces:
  drive: {type: motor, coordinate: ja, speed: "2", gain: 5 N m s/rad, limit: 12 N m}
  bearing: {type: joint-spring-damper, coordinate: jc, damping: 0.05 N m s/rad}
  push: {type: force, marker: corner, vector: [0, -2, 0]}
simulation: {duration: 0.2, step: 1 ms, output_interval: 10 ms}
"""


@pytest.fixture(scope="module")
def result(tmp_path_factory):
    path = tmp_path_factory.mktemp("elements") / "elements.yaml"
    path.write_text(MACHINE, encoding="utf-8")
    return nivel.load(path).simulate()


@pytest.fixture(scope="module")
def stage(result):
    return from_bytes(playback([result], ALONE))[0]["stages"][0]


def named(records):
    return {record["name"]: record for record in records}


def test_what_works_on_a_joint_stands_there(stage):
    forces, (driver,) = named(stage["forces"]), stage["drivers"]
    places = [each["name"] for each in stage["bodies"]]
    assert (forces["drive"]["look"], forces["bearing"]["look"], driver["look"]) == ("turn", "coil", "slide")
    assert forces["drive"]["bodies"] == [-1, places.index("a")]
    assert forces["drive"]["axis"] == pytest.approx([0, 0, 1])
    assert driver["axis"] == pytest.approx([1, 0, 0])
    assert forces["push"]["bodies"] == [places.index("block")]
    assert forces["push"]["points"] == [pytest.approx([0.05, 0.05, 0.05])]


def test_a_motor_named_by_its_joint_alone_has_an_arrow(stage):
    assert {each["owner"] for each in stage["arrows"]} >= {"drive", "bearing", "shake", "push"}


def test_pitch_circles_touch_and_are_as_their_teeth(stage):
    couplings = named(stage["couplings"])
    one, two = couplings["mesh"]["wheels"]
    assert one["radius"] + two["radius"] == pytest.approx(0.3)
    assert two["radius"] / one["radius"] == pytest.approx(2.0)
    assert [each["radius"] for each in couplings["rope"]["wheels"]] == pytest.approx([0.15, 0.06])
    assert couplings["rope"]["belt"] == "open"


def test_an_internal_gear_is_as_much_larger_as_its_axes_are_apart():
    ring = nivel.load(EXAMPLES / "mechanisms" / "gear-train.yaml").viewer_source()
    couplings = named(from_bytes(ring.package())[0]["stages"][0]["couplings"])
    planet, wheel = couplings["ring_1"]["wheels"]
    arm = 2e-3 * (24 + 21) / 2
    assert wheel["radius"] - planet["radius"] == pytest.approx(arm)
    assert wheel["radius"] == pytest.approx(2e-3 * 66 / 2)
    assert wheel["body"] == -1  # the ring is the ground, the carrier holds both


def test_the_line_of_a_rack_touches_its_pinion(stage):
    rack = named(stage["couplings"])["rack"]
    (wheel,), (track,) = rack["wheels"], rack["tracks"]
    assert wheel["radius"] == pytest.approx(0.2)
    # on the ram, whose frame is 24 cm below the pinion's
    np.testing.assert_allclose(track["point"], [0.0, 0.04, 0.0], atol=1e-12)
    np.testing.assert_allclose(np.abs(track["along"]), [1, 0, 0], atol=1e-12)


def test_variables_of_couplings_belong_to_them(stage):
    owners = {column["name"]: column["owner"] for column in stage["columns"]}
    assert owners["coupling.mesh.effort"] == "mesh"


def test_variables_of_nodes_of_beams_belong_to_them():
    elements = {"boom.1", "boom.2", "hinge", "drive"}
    for name, owner in (
        ("boom.1.position.x", "boom.1"),
        ("hinge.angle", "hinge"),
        ("hinge.s.x", "hinge"),
        ("force.drive.power", "drive"),
        ("kinetic_energy", ""),
        ("nothing.angle", ""),
    ):
        assert _owner(name, elements) == owner


def test_everything_is_in_the_list_and_lights_up(browser, result, tmp_path):
    file = write_scene([result], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        for section in ("Bodies", "Joints", "Forces", "Drivers", "Couplings"):
            assert page.locator(".branch h3", has_text=section).count() == 1
        for kind, name in (
            ("force", "drive"),
            ("force", "push"),
            ("driver", "shake"),
            ("coupling", "mesh"),
            ("coupling", "rope"),
        ):
            page.evaluate(f"nivel.app.choose({{ kind: '{kind}', name: '{name}' }})")
            assert page.evaluate("nivel.app.actor.marked.length") > 0, name
            assert page.locator(".chosen h2").inner_text() == name
        page.evaluate("nivel.app.name('force', true)")
        drawn(page)
        shown = page.locator(".label.force:visible").all_inner_texts()
        assert {"drive", "push", "shake"} <= set(shown)


def test_belts_run_along_tangents(browser, result, tmp_path):
    file = write_scene([result], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        ends = page.evaluate(
            "() => nivel.app.actor.stretching.map((each) => each.object).filter((o) => o.type === 'Object3D').map((o) => {"
            "const v = o.position.clone().set(0, o.scale.y, 0).applyQuaternion(o.quaternion);"
            "return [o.position.toArray(), v.add(o.position).toArray()] })"
        )
    centres, radii = np.array([[0.3, 0, 0], [0.8, 0.1, 0]]), (0.15, 0.06)
    assert len(ends) == 2
    for run in np.array(ends):
        along = run[1] - run[0]
        for end, centre, radius in zip(run, centres, radii, strict=True):
            assert np.linalg.norm(end - centre) == pytest.approx(radius, rel=1e-6)
            assert (end - centre) @ along == pytest.approx(0.0, abs=1e-7)  # poses come as 32-bit numbers


# --- one solid through the frames of bodies ---


@pytest.fixture(scope="module")
def shown(browser):
    """Vertices (n, 3) and normals of the beam as the page draws it, smooth or not."""
    return cache(lambda smooth: sweep_of_page(browser, smooth))


def sweep_of_page(browser, smooth):
    block = Block()
    live = Live(beam(smooth=smooth), block)
    live.show(0.0, *arc())
    with served(live) as viewing, watched(browser) as seen:
        page = seen.open(viewing.address.url)
        until(page, "nivel.app.actor.swept[0].mesh.geometry.attributes.position.array.some((x) => x !== 0)")
        read = "(name) => Array.from(nivel.app.actor.swept[0].mesh.geometry.attributes[name].array)"
        vertices, normals = (np.reshape(page.evaluate(read, name), (-1, 3)) for name in ("position", "normal"))
        page.keyboard.press("s")  # a page of live operation begins without the list of parts
        assert not page.get_by_role(
            "button", name="boom.2", exact=True
        ).is_visible()  # one thing, with its parts inside
        page.evaluate("nivel.app.choose({ kind: 'body', name: 'boom.2' })")
        assert page.get_by_role("button", name="boom.2", exact=True).is_visible()
        assert page.evaluate("nivel.app.actor.marked.length") == 1
    return vertices, normals


def rings(vertices):
    """(rings, 16, 3): four edges outside and four inside, two corners each; without the caps."""
    return vertices[: len(vertices) - 2 * 8].reshape(-1, 16, 3)


def test_a_swept_section_goes_through_its_frames_and_bends_between_them(shown):
    vertices, normals = shown(True)
    shape = rings(vertices)
    steps = (len(shape) - 1) // (NODES - 1)
    assert steps >= 4
    middle = shape[:, :8].mean(axis=1)
    position, _ = arc()
    np.testing.assert_allclose(middle[::steps], position[:NODES], atol=1e-6)
    # halfway between frames θ apart the cubic lies at R (cos θ/2 + sin² θ/2 / 2) from the centre of the arc
    half = 0.5 * ARC / (NODES - 1)
    from_centre = np.linalg.norm(middle - [0, 0, RADIUS], axis=1)
    assert steps % 2 == 0
    expected = RADIUS * (np.cos(half) + 0.5 * np.sin(half) ** 2)
    np.testing.assert_allclose(from_centre[steps // 2 :: steps], expected, rtol=1e-6)
    np.testing.assert_allclose(from_centre, RADIUS, rtol=3e-4)
    # the section keeps its size and stands square to the line
    np.testing.assert_allclose(np.linalg.norm(shape[:, 0] - shape[:, 1], axis=1), 0.2, rtol=1e-5)
    tangent = np.gradient(middle, axis=0)[1:-1]
    across = (shape[:, 0] - shape[:, 3])[1:-1]
    cosine = np.sum(tangent * across, axis=1) / np.linalg.norm(tangent, axis=1) / np.linalg.norm(across, axis=1)
    assert np.abs(cosine).max() < 1e-2
    # normals point outwards from the solid: away from the middle outside, towards it in the hole
    away = np.sum((shape - middle[:, None]) * rings(normals), axis=2)
    assert (away[:, :8] > 0).all()
    assert (away[:, 8:] < 0).all()


def test_a_straight_sweep_has_its_corners_at_the_frames(shown):
    shape = rings(shown(False)[0])
    assert len(shape) == NODES
    np.testing.assert_allclose(shape[:, :8].mean(axis=1), arc()[0][:NODES], atol=1e-6)


@pytest.mark.parametrize("smooth", [True, False])
def test_the_report_draws_the_same_sweep_as_the_page(shown, smooth):
    """Two programs in two languages; the page's rings are finer by a factor, or the same where nothing bends."""
    shape = rings(shown(smooth)[0])
    (record,) = beam(smooth=smooth).sweeps
    names = [f"boom.{k + 1}" for k in range(NODES)]
    position, orientation = arc()
    poses = {
        name: (r, rotation(theta)) for name, r, theta in zip(names, position[:NODES], orientation[:NODES], strict=True)
    }
    sweep = {"name": "boom", "bodies": names, "section": record.section, "smooth": smooth}
    drawn = sweeps.rings(sweep, poses, record.section)
    here, there = (len(each) - 1 for each in (drawn, shape))
    shared = np.gcd(here, there)
    np.testing.assert_allclose(drawn[:: here // shared], shape[:: there // shared, 0:8:2], atol=1e-6)


def test_faces_of_a_sweep_close_it_and_look_outwards():
    (record,) = beam().sweeps
    names = [f"boom.{k + 1}" for k in range(NODES)]
    poses = {name: (r, rotation(theta)) for name, r, theta in zip(names, *arc(), strict=False)}
    faces = sweeps.sweep_faces({"name": "boom", "bodies": names, "section": record.section}, poses)
    # divergence theorem: three times the volume, which by Pappus is area times length of the arc
    volume = 0.0
    for face in faces:
        fan = [(face.corners[0], b, c) for b, c in zip(face.corners[1:], face.corners[2:], strict=False)]
        volume += sum(np.dot(a, np.cross(b, c)) for a, b, c in fan) / 6.0
        assert all(np.dot(np.cross(b - a, c - a), face.normal) > 0 for a, b, c in fan)
    assert volume == pytest.approx(0.2 * 0.1 * RADIUS * ARC, rel=2e-3)


def test_the_report_has_a_picture_of_a_sweep():
    scene = pendulum.scene()
    name = scene["bodies"][0]["name"]
    scene["bodies"].append(dict(scene["bodies"][0], name="tip"))
    scene["sweeps"] = [{"name": "boom", "bodies": [name, "tip"], "section": [[-0.1, -0.1], [0.1, -0.1], [0, 0.1]]}]
    text = machine_picture(scene, np.array([[0.0, 0, 0], [1.0, 0, 0]]), np.array([[1.0, 0, 0, 0]] * 2))
    assert ">boom<" in text
    assert f">{name}<" not in text


def test_a_scene_may_have_sweeps_and_their_bodies_are_drawn_by_nothing_else():
    scene = pendulum.scene()
    name = scene["bodies"][0]["name"]
    scene["sweeps"] = [{"name": "boom", "bodies": [name, name], "section": [[-1, -1], [1, -1], [0, 1]]}]
    memory = Memory()
    memory.begin(pendulum.header(scene=json.dumps(scene)))
    memory.take(pendulum.frames(np.linspace(0.0, 1.0, 11)))
    stage = from_bytes(playback([memory.close({"outcome": "done"})], ALONE))[0]["stages"][0]
    (sweep,) = stage["sweeps"]
    assert sweep["bodies"] == [0, 0]
    assert sweep["axes"] == [[1, 0, 0]] * 2
    assert sweep["smooth"] is True
    assert stage["bodies"][0]["links"] == []
    assert stage["bodies"][0]["automatic"] is False


BEAM = """
format: 1
beams:
  boom:
    from: [0, 0, 0]
    to: [1, 0, 0]
    section: SECTION
    material: {youngs_modulus: 70 GPa, poisson_ratio: 0.3, density: 2700 kg/m^3}
    elements: 4
joints:
  hinge: {type: revolute, bodies: [ground, boom.start], point: [0, 0, 0], axis: [0, 1, 0]}
"""


@pytest.mark.parametrize(
    ("section", "area", "height"),
    [
        ("{type: circle, radius: 2 cm}", np.pi * 4e-4, 0.04),
        ("{type: tube, outer_radius: 2 cm, inner_radius: 1 cm}", np.pi * 3e-4, 0.04),
        ("{type: rectangle, width: 2 cm, height: 4 cm}", 8e-4, 0.04),
        ("{type: box, width: 2 cm, height: 4 cm, wall: 2 mm}", 8e-4 - 1.6e-2 * 3.6e-2, 0.04),
        ("{type: i, width: 4 cm, height: 6 cm, flange: 5 mm, web: 4 mm}", 2 * 4e-2 * 5e-3 + 5e-2 * 4e-3, 0.06),
        # a rectangle of 2 cm by 6 cm: I_y = b h³/12, I_z = h b³/12
        (
            "{type: values, area: 12 cm^2, iy: 36 cm^4, iz: 4 cm^4, torsion: 10 cm^4, shear_area_y: 10 cm^2, shear_area_z: 10 cm^2}",
            12e-4,
            0.06,
        ),
    ],
)
def test_a_beam_is_drawn_with_its_section(section, area, height, tmp_path):
    (tmp_path / "beam.yaml").write_text(BEAM.replace("SECTION", section), encoding="utf-8")
    shown = nivel.load(tmp_path / "beam.yaml").viewer_source()
    stage = from_bytes(shown.package())[0]["stages"][0]
    (sweep,) = stage["sweeps"]
    assert [stage["bodies"][k]["name"] for k in sweep["bodies"]] == [
        "boom.start",
        "boom.1",
        "boom.2",
        "boom.3",
        "boom.end",
    ]
    assert not any(stage["bodies"][k]["automatic"] for k in sweep["bodies"])

    def enclosed(corners):
        y, z = np.array(corners).T
        return 0.5 * np.sum(y * np.roll(z, -1) - np.roll(y, -1) * z)

    found = enclosed(sweep["section"]) - (enclosed(sweep["hollow"]) if sweep["hollow"] else 0.0)
    # of round ones a polygon of 24 corners: its area is 24/(2π) sin(2π/24) of the circle's
    assert found == pytest.approx(area, rel=0.012)
    assert np.ptp(np.array(sweep["section"])[:, 1]) == pytest.approx(height)


def test_links_have_the_colour_of_what_is_painted_and_surroundings_stand_on_the_ground():
    """A body that is painted shows no colour of its number; nothing of the surroundings is a body, and none is in the first view."""
    text = """
format: 1
name: painted
surroundings:
  - {type: box, size: [9, 9, 1], centre: [40, 0, -2], colour: silver}
bodies:
  post: {mass: 1, shape: {type: box, size: [1, 1, 1], colour: red}}
  arm: {mass: 1, inertia: [1, 1, 1], position: [2, 0, 0], looks: [{type: sphere, radius: 0.1, colour: blue}]}
  bare: {mass: 1, inertia: [1, 1, 1], position: [3, 0, 0]}
joints:
  hinge: {type: revolute, bodies: [post, arm], point: [1, 0, 0], axis: [0, 0, 1]}
"""
    source = Machine.from_record(parse_machine(text)).viewer_source()
    content, _ = from_bytes(source.package())
    shown = content["stages"][0]
    assert [each["colour"] for each in shown["bodies"]] == ["#b8473c", "#3f6ea6", colour_of(2)]
    (solid,) = shown["surroundings"]
    assert (solid["kind"], solid["centre"], solid["colour"]) == ("box", [40.0, 0.0, -2.0], "#b7bec6")
    assert len(shown["bodies"]) == 3
    assert shown["high"][0] < 10


def test_round_off_of_a_scale_is_shown_as_zero(browser):
    """A slider from -1 m to 1 m: 6e-19 m is none, 2e-6 m is a number; in turn a coordinate that stands at 0.25 m says so."""
    text = """
format: 1
name: cart
bodies:
  cart: {mass: 1, inertia: [1, 1, 1], shape: {type: box, size: [1, 1, 1]}}
joints:
  rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]}
"""
    with served(Machine.from_record(parse_machine(text)).viewer_source()) as viewing, watched(browser) as seen:
        page = seen.open(viewing.address.url)
        for value, shown in ((6.33e-19, "0 m"), (-6.33e-19, "0 m"), (2e-6, "2e−6 m"), (0.25, "0.25 m")):
            page.evaluate("(value) => nivel.app.coordinates.update([value], nivel.app.stage.coordinates, '')", value)
            assert page.locator(".coordinates output").inner_text() == shown


def test_a_belt_drive_runs_around_its_pulleys():
    source = nivel.load(EXAMPLES / "machines" / "backhoe-swing.yaml").viewer_source()
    chain = named(from_bytes(source.package())[0]["stages"][0]["couplings"])["chain"]
    assert [each["radius"] for each in chain["wheels"]] == pytest.approx([0.08, 0.24])
    assert chain["belt"] == "open"
