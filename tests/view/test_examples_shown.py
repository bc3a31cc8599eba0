"""Examples of beams, of flexible bodies and of statics in the page; and what is drawn beside beams."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from browsing import drawn, watched
from nivel.view.page import write_scene
from nivel.view.playback import ALONE, playback
from packages import from_bytes
from playing import assert_plays_and_scrubs
from test_flexible_examples import MACHINES, folder, machine  # noqa: F401

EXAMPLES = Path(__file__).parent.parent.parent / "examples"
# seconds of the motion: enough to see that it moves
BEAMS = {
    "bend-45": 20.0,
    "cable": 0.2,
    "hinged-beams": 0.6,
    "slider-crank": 0.12,
    "spin-up": 4.0,
    "telescopic-boom": 0.5,
    "three-models": 0.4,
}
FLEXIBLE = {
    "crane": 1.0,
    "lever-spring": 0.2,
    "pendulum": 0.5,
    "slider-crank": 0.1,
    "spinning-blade": 0.5,
    "swing": 0.5,
}
BESIDE = """
format: 1
gravity: [0, 0, -9.81]
bodies:
  nut: {mass: 1, inertia: [0.01, 0.01, 0.01], position: [1.2, 0, 0], shape: {type: sphere, radius: 2 cm}}
beams:
  boom:
    from: [0, 0, 0]
    to: [1, 0, 0]
    section: {type: circle, radius: 1 cm}
    material: {youngs_modulus: 70 GPa, poisson_ratio: 0.3, density: 2700 kg/m^3}
    elements: 4
joints:
  clamp: {type: fixed, bodies: [ground, boom.start], point: [0, 0, 0.15]}
  thread: {type: screw, bodies: [boom.end, nut], point: [1.1, 0, 0], axis: [1, 0, 0], pitch: 2 mm}
"""


def test_every_example_is_here():
    assert {path.stem for path in (EXAMPLES / "beams").glob("*.yaml")} == set(BEAMS)
    assert set(FLEXIBLE) == set(MACHINES)


@pytest.mark.parametrize("name", BEAMS)
@pytest.mark.full
def test_examples_of_beams_play_and_scrub(name, browser, tmp_path):
    result = nivel.load(EXAMPLES / "beams" / f"{name}.yaml").simulate(duration=BEAMS[name])
    assert_plays_and_scrubs(browser, result, tmp_path / "scene.html")


@pytest.mark.parametrize("name", FLEXIBLE)
@pytest.mark.full
def test_examples_of_flexible_bodies_play_and_scrub(name, folder, browser, tmp_path):  # noqa: F811
    result = machine(folder, name).simulate(duration=FLEXIBLE[name])
    assert_plays_and_scrubs(browser, result, tmp_path / "scene.html")


@pytest.mark.full
def test_a_path_of_equilibria_says_its_load_and_not_a_time(browser, tmp_path):
    path = nivel.load(EXAMPLES / "mechanisms" / "toggle.yaml").statics(duration=1, step=0.05, arc_length=True)
    assert_plays_and_scrubs(browser, path, tmp_path / "scene.html")
    assert (np.diff(path.time) < 0.0).any()  # the load falls on the way
    with watched(browser) as seen:
        page = seen.open((tmp_path / "scene.html").as_uri())
        for frame in (2, int(np.argmin(path.time)), len(path.time) - 1):
            page.evaluate(f"nivel.app.goTo({float(path.abscissa[frame])!r})")
            word, _, number = page.locator("output.time").inner_text().rpartition(" ")
            assert word == "load factor"
            assert float(number.replace("−", "-")) == pytest.approx(path.time[frame], abs=6e-4)
        assert " s" not in page.locator(".timeline .clock").inner_text().replace(" states", "")
        assert page.get_by_role("slider", name="Path of equilibria").count() == 1


def test_joints_beside_a_beam_have_signs_and_arms(browser, tmp_path):
    (tmp_path / "beside.yaml").write_text(BESIDE, encoding="utf-8")
    result = nivel.load(tmp_path / "beside.yaml").simulate(duration=0.01, step=5e-4, integrator="generalised-alpha")
    stage = from_bytes(playback([result], ALONE))[0]["stages"][0]
    bodies = {each["name"]: each for each in stage["bodies"]}
    assert bodies["boom.start"]["links"] == [pytest.approx([0, 0, 0.15])]
    assert bodies["boom.end"]["links"] == [pytest.approx([0.1, 0, 0])]
    assert all(not bodies[f"boom.{k}"]["links"] for k in (1, 2, 3))
    file = write_scene([result], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        for name in ("clamp", "thread"):
            page.evaluate(f"nivel.app.choose({{ kind: 'joint', name: '{name}' }})")
            assert page.evaluate("nivel.app.actor.marked.length") >= 1


def test_what_slides_along_a_beam_stands_at_the_slider(browser, tmp_path):
    """Its node of the beam is only where it began: no arm leads there, and no frame stands there."""
    result = nivel.load(EXAMPLES / "beams" / "telescopic-boom.yaml").simulate(duration=0.5)
    stage = from_bytes(playback([result], ALONE))[0]["stages"][0]
    assert not any(each["links"] for each in stage["bodies"])
    file = write_scene([result], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        page.evaluate(f"nivel.app.show('joints', true), nivel.app.goTo({float(result.time[-1])!r})")
        drawn(page)
        spots = page.evaluate(
            "() => nivel.app.actor.extras.made.get('joints').spots.map((each) => [each.owner.name, each.body])"
        )
        names = [each["name"] for each in stage["bodies"]]
        assert [names[body] for name, body in spots if name in ("rear", "front")] == ["inner.start", "outer.end"]


def test_axes_and_frames_of_joints_and_markers_stand_where_they_are(browser, tmp_path):
    result = nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml").simulate(duration=0.2)
    file = write_scene([result], tmp_path / "scene.html")
    place = """(what) => { const { instances, spots } = nivel.app.actor.extras.made.get(what), m = instances.mesh;
      return spots.map((spot, k) => { const a = Array.from(m.instanceMatrix.array.slice(16 * k, 16 * k + 16));
        return [spot.owner.name, a.slice(12, 15), a.slice(8, 11)] }) }"""
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        page.get_by_role("button", name="Display", exact=True).click()
        for switch in ("Joint axes", "Joint frames"):
            page.get_by_role("switch", name=switch).check()
        page.evaluate(f"nivel.app.goTo({float(result.time[-1])!r})")
        drawn(page)
        found = page.evaluate(place, "joints")
        poses = [seen.pose(k) for k in range(len(result.scene["bodies"]))]
        names = [each["name"] for each in result.scene["bodies"]]
        expected = [
            (joint["name"], *in_space(poses, names, body, point, axis))
            for joint in result.scene["joints"]
            for body, point, axis in zip(joint["bodies"], joint["points"], joint["axes"], strict=True)
        ]
        assert [each[0] for each in found] == [each[0] for each in expected]
        for (_, at, z), (_, point, axis) in zip(found, expected, strict=True):
            np.testing.assert_allclose(at, point, atol=1e-5)
            np.testing.assert_allclose(np.array(z) / np.linalg.norm(z), axis, atol=1e-5)
        kinds = [joint["type"] for joint in result.scene["joints"]]
        assert len(page.evaluate(place, "axes")) == len(kinds) - kinds.count("spherical") + kinds.count("universal")


def in_space(poses, names, body, point, axis):
    """A point and a direction of a body, global."""
    from scipy.spatial.transform import Rotation

    if body == "ground":
        return np.array(point), np.array(axis)
    pose = np.array(poses[names.index(body)])
    A = Rotation.from_quat(pose[3:], scalar_first=True).as_matrix()
    return pose[:3] + A @ point, A @ axis
