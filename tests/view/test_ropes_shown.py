"""Ropes around wheels in pictures: they are as long as the solver says, and the page draws the same points."""

import json

import numpy as np
import pytest

from browsing import drawn, watched
from nivel.looks.viewpoint import body_poses
from nivel.report.force_drawing import STEPS, rope_line
from nivel.report.picture import machine_picture
from nivel.results.frames.stored import strangers
from nivel.view.page import write_scene
from simulating import simulate, solid

R, LENGTH = 0.1, 0.1
ENDS = """(name) => {
  const { actor } = nivel.app, force = actor.stage.forces.findIndex((each) => each.name === name);
  const bars = actor.stretching[force].object.children.filter((each) => each.visible);
  const end = (bar, share) => bar.position.clone().set(0, 0, share * bar.scale.z).applyQuaternion(bar.quaternion).add(bar.position);
  return [...bars.map((bar) => end(bar, 0)), end(bars.at(-1), 1)].map((p) => p.toArray().map((x, i) => x + actor.stage.origin[i]));
}"""


@pytest.fixture(scope="module")
def result():
    """Two ropes from a drum to a load that flies past, on a base that turns: one leaves a wheel, both wind and unwind."""
    rope = {"type": "rope", "axis": [0, 1, 0], "stiffness": 1e-6, "length": LENGTH}
    return simulate(
        {
            "gravity": [0, 0, 0],
            "bodies": {
                "base": solid(),
                "drum": solid(position=[-1, 0, 0]),
                "load": solid(position=[1, 0, -0.5], velocity=[0, 0.1, 1]),
            },
            "joints": {
                "column": {"type": "revolute", "bodies": ["ground", "base"], "point": [0, 0, 0], "axis": [0, 0, 1]},
                "axle": {"type": "revolute", "bodies": ["base", "drum"], "point": [-1, 0, 0], "axis": [0, 1, 0]},
            },
            "drivers": {
                "slew": {"coordinate": "column", "value": "0.8*time"},
                "turn": {
                    "coordinate": "axle",
                    "value": "0.8*pi*step(time, 0, 0, 0.3, 1) - 3*pi*step(time, 0.4, 0, 1, 1)",
                },
            },
            "forces": {
                "over": {
                    **rope,
                    "bodies": ["drum", "base", "load"],
                    "points": [[-1, 0, 0], [0, 0.02, 0], [1, 0, -0.5]],
                    "radii": [R, R, 0],
                    "wound": [0.25, 0],
                },
                "back": {
                    **rope,
                    "bodies": ["load", "base", "drum"],
                    "points": [[1, 0, -0.5], [0.3, -0.02, 1], [-1, 0, 0]],
                    "radii": [0, -0.15, R],
                    "wound": [0, 0.25],
                },
            },
        },
        duration=1.0,
        step=1e-3,
        output_interval=0.02,
        integrator="rk4",
    )


def scene_of(result):
    return json.loads(result.attributes["scene"])


def line(result, name, k, steps=STEPS):
    """Points (n, 3) of a rope in a frame."""
    scene = scene_of(result)
    poses = body_poses(scene, result.array("position")[k], result.array("orientation")[k])
    return rope_line(next(each for each in scene["forces"] if each["name"] == name), poses, steps)


def near_the_start(result):
    """Frames until which the drum has turned by less than half a turn: turns beyond are not in a picture alone."""
    return np.flatnonzero(np.abs(result.array("axle.angle")) < 0.95 * np.pi)


@pytest.mark.parametrize(("name", "left_out"), [("over", {0, STEPS, STEPS + 1}), ("back", {0, STEPS})])
def test_a_drawn_rope_is_as_long_as_the_solver_says(result, name, left_out):
    """Tangents, arcs, a wheel that is left (a place less), an unwound drum (a point in place of an arc), parts out of the plane."""
    frames = near_the_start(result)
    lines = [line(result, name, k, 4000) for k in frames]
    drawn = [np.linalg.norm(np.diff(each, axis=0), axis=1).sum() for each in lines]
    np.testing.assert_allclose(drawn, result.array(f"force.{name}.stretch")[frames] + LENGTH, atol=1e-7)
    most = 2 * (STEPS + 1) + 1
    assert {most - len(line(result, name, k)) for k in frames} >= left_out


@pytest.fixture(scope="module")
def page(result, tmp_path_factory, browser):
    file = write_scene([result], tmp_path_factory.mktemp("ropes") / "scene.html")
    with watched(browser) as seen:
        yield seen.open(file.as_uri())


def shown(page, result, name, k):
    page.evaluate("(time) => nivel.app.goTo(time)", float(result.time[k]))
    drawn(page, 1)
    return np.array(page.evaluate(ENDS, name))


def test_the_page_draws_the_same_rope(page, result):
    frames = near_the_start(result)
    for k in (0, frames[len(frames) // 3], frames[2 * len(frames) // 3], frames[-1]):
        for name in ("over", "back"):
            np.testing.assert_allclose(shown(page, result, name, k), line(result, name, k), atol=2e-6)


def test_turns_on_a_drum_are_counted_wherever_the_page_is_led(page, result):
    """At the end there are 1.35 turns on the drum: the whole rim; at the start a quarter, in whatever order one looks."""
    for k, turned in ((-1, 1.0), (0, 0.25), (-1, 1.0)):
        rim = shown(page, result, "over", k)[: STEPS + 1]
        sides = np.linalg.norm(np.diff(rim, axis=0), axis=1)
        np.testing.assert_allclose(sides, 2 * R * np.sin(np.pi * turned / STEPS), atol=2e-6)


def test_the_picture_of_a_report_has_the_rope_in_one_line(result):
    scene = scene_of(result)
    picture = machine_picture(scene, result.array("position")[0], result.array("orientation")[0])
    paths = [part.split('"')[0] for part in picture.split('<path d="')[1:] if 'class="rope"' in part.split("/>")[0]]
    assert [path.count("L") + 1 for path in paths] == [len(line(result, name, 0)) for name in ("over", "back")]


def test_a_changed_scene_whose_wheels_do_not_fit_is_refused(result):
    scene = scene_of(result)
    assert strangers(scene) == ""
    scene["forces"][1]["wheels"]["arcs"].pop()
    assert "wheels of the rope back" in strangers(scene)
