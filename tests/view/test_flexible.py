"""Flexible bodies in the viewer: what is drawn is where the run says that the body is."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import nivel
from browsing import watched
from models import bar, reduced
from nivel.flexible.body.body import moving_surface
from nivel.flexible.body.body_file import write_body
from nivel.view.package import KINDS, Block
from nivel.view.page import write_scene
from nivel.view.playback import SERVED, stage

MACHINE = """
format: 1
gravity: [0, -9.81, 0]
bodies:
  bar: {flexible: {file: bar.nc, modes: 6}}
markers:
  tip: {body: bar, position: [2, 0, 0]}
joints:
  hinge: {type: revolute, bodies: [ground, bar], point: [0, 0, 0], axis: [0, 0, 1]}
sensors:
  tip: {marker: tip, quantity: position}
simulation: {duration: 0.2 s, step: 0.5 ms, output_interval: 10 ms}
"""


@pytest.fixture(scope="module")
def result(tmp_path_factory):
    folder = tmp_path_factory.mktemp("seen")
    body, _ = reduced(bar(width=0.01, height=0.01, reduction="modes: 6"))
    write_body(body, folder / "bar.nc")
    (folder / "machine.yaml").write_text(MACHINE)
    return nivel.load(folder / "machine.yaml").simulate()


def unpacked(block, packed):
    """The numbers of an array; its bytes stand plane by plane."""
    kind = np.dtype(KINDS[packed.kind])
    count = int(np.prod(packed.shape))
    planes = np.frombuffer(block.content(), np.uint8, count * kind.itemsize, packed.start)
    return planes.reshape(kind.itemsize, count).T.copy().view(kind).reshape(packed.shape)


def test_tip_is_drawn_where_its_sensor_is(result):
    block = Block()
    shown = stage(result, SERVED, block)
    (looks,) = shown.flexible
    vertices, modes = unpacked(block, looks.vertices), unpacked(block, looks.modes)
    frames = unpacked(block, shown.motion.frames).T
    at_tip = np.abs(vertices[:, 0] - 2.0) < 1e-6
    assert at_tip.sum() == 4
    largest = 0.0
    for k, frame in enumerate(frames):
        modal = frame[7 + looks.first : 7 + looks.first + len(modes)]
        moved = vertices + np.tensordot(modal, modes, 1)
        A = Rotation.from_quat(frame[3:7], scalar_first=True).as_matrix()
        place = frame[:3] + A @ moved[at_tip].mean(axis=0) + np.array(shown.origin)
        sensor = [float(result[f"sensor.tip.{axis}"][k]) for axis in "xyz"]
        np.testing.assert_allclose(place, sensor, atol=2e-6)
        largest = max(largest, float(np.linalg.norm(moved - vertices, axis=1).max()))
    assert looks.high == pytest.approx(largest, rel=1e-5)
    assert largest > 1e-3


def test_the_floor_is_below_all_of_a_body_that_bends(result):
    shown = stage(result, SERVED, Block())
    assert shown.low[1] <= min(result["sensor.tip.y"]) + 0.01
    assert shown.size >= 2.0


def test_bars_are_closed_and_keep_their_thickness_where_they_turn():
    body, _ = reduced(bar(elements=4, reduction="modes: 2"))
    surface = moving_surface(body)
    edges = np.sort(surface.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    _, counts = np.unique(edges, axis=0, return_counts=True)
    assert np.all(counts == 2)
    # a small turn moves no corner nearer to its node, to the first order
    start = surface.vertices.reshape(-1, 4, 3)
    moved = (surface.vertices + 1e-6 * surface.modes[0]).reshape(-1, 4, 3)
    radius = np.linalg.norm(start - start.mean(axis=1, keepdims=True), axis=2)
    np.testing.assert_allclose(np.linalg.norm(moved - moved.mean(axis=1, keepdims=True), axis=2), radius, rtol=1e-9)


def test_a_marker_of_a_body_that_bends_is_traced_where_its_sensor_is(result, tmp_path, browser):
    write_scene([result], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open((tmp_path / "scene.html").as_uri())
        page.get_by_role("button", name="bar", exact=True).click()
        page.get_by_role("button", name="Trace tip").click()
        path = "Array.from(nivel.app.traces.paths.get('marker tip').whole.geometry.attributes.position.array)"
        traced = np.reshape(page.evaluate(path), (-1, 3))
        sensor = np.stack([result.array(f"sensor.tip.{axis}") for axis in "xyz"], axis=1)
        np.testing.assert_allclose(traced, sensor, atol=5e-6)
        page.evaluate(f"nivel.app.goTo({float(result.time[-1])!r})")
        dot = page.evaluate("nivel.app.traces.paths.get('marker tip').dot.position.toArray()")
        np.testing.assert_allclose(dot, sensor[-1], atol=5e-6)
    rigid = result.array("bar.position")[-1] + Rotation.from_quat(
        result.array("bar.orientation")[-1], scalar_first=True
    ).apply([2.0, 0.0, 0.0])
    assert np.linalg.norm(rigid - sensor[-1]) > 1e-4  # it bends by more than what is allowed above
