"""The picture shows the machine as a designer would draw it."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

import synthetic_run as pendulum
from nivel.looks.solids import Ball, solid
from nivel.looks.viewpoint import choose_view
from nivel.report.drawing import HEIGHTS, WIDTH, Label, place
from nivel.report.picture import machine_picture

X, Y, Z = np.eye(3)
SHAPES = [
    {"type": "box", "size": [0.5, 0.2, 0.1]},
    {"type": "cylinder", "radius": 0.1, "length": 0.5, "along": "y"},
    {"type": "tube", "outer_radius": 0.1, "inner_radius": 0.07, "length": 0.5, "along": "z"},
    {"type": "sphere", "radius": 0.2},
]
HISTORY = pendulum.histories(np.array([0.0]))
POSITION, ORIENTATION = HISTORY["position"][0], HISTORY["orientation"][0]


def coordinates(svg):
    """All absolute coordinates of lines and polygons."""
    found = [float(v) for attribute in ("x1", "y1", "x2", "y2") for v in re.findall(rf'{attribute}="([-\d.]+)"', svg)]
    for points in re.findall(r'points="([^"]*)"', svg):
        found += [float(v) for pair in points.split() for v in pair.split(",")]
    return np.array(found)


@pytest.mark.parametrize("shape", [None, *SHAPES], ids=lambda shape: shape["type"] if shape else "link")
def test_a_picture_is_whole_names_everything_and_stays_inside(shape):
    svg = machine_picture(pendulum.scene(shape), POSITION, ORIENTATION)
    root = ET.fromstring(svg)
    texts = {element.text for element in root.iter("{http://www.w3.org/2000/svg}text")}
    assert {"arm", "hinge"} <= texts
    _, _, width, height = (float(v) for v in root.get("viewBox").split())
    assert width == WIDTH
    assert HEIGHTS[0] <= height <= HEIGHTS[1]
    assert np.all(coordinates(svg) > 0.0)
    assert np.all(coordinates(svg) < max(width, height))
    assert 'class="ground"' in svg
    assert "hinge: revolute, ground – arm" in svg


@pytest.mark.parametrize(
    ("normal", "right", "up"), [(Z, X, Y), (-Z, X, Y), (Y, X, Z), (-Y, X, Z), (X, Y, Z), (-X, Y, Z)], ids=str
)
def test_a_planar_machine_is_seen_head_on(normal, right, up):
    rotation = np.stack([right, up, np.cross(right, up)], axis=1)
    flat = np.array([[0, 0, 0], [1, 0, 0], [1, 2, 0], [3, 1, 0]]) @ rotation.T
    view = choose_view(flat, np.array([normal, -normal]), np.empty((0, 3)))
    np.testing.assert_allclose([view.right, view.up], [right, up], atol=1e-12)
    np.testing.assert_allclose(view.towards, np.cross(right, up), atol=1e-12)


def test_a_machine_in_a_plane_that_can_leave_it_is_seen_from_the_side():
    flat = np.array([[0, 0, 0], [1, 0, 0], [1, 2, 0], [3, 1, 0.0]])
    for turning, sliding in (([X], []), ([Z, X], []), ([Z], [Z]), ([], [])):
        view = choose_view(flat, np.reshape(turning, (-1, 3)), np.reshape(sliding, (-1, 3)))
        assert abs(view.towards @ Z) < 0.9


@pytest.mark.parametrize("up", [Z, Y, -Y, X], ids=str)
def test_views_are_right_handed_and_up_is_up(up, rng):
    view = choose_view(rng.normal(size=(12, 3)), np.empty((0, 3)), np.empty((0, 3)), up)
    frame = np.stack([view.right, view.up, view.towards])
    np.testing.assert_allclose(frame @ frame.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(frame) == pytest.approx(1.0)
    assert view.up @ up > 0.8
    assert view.towards @ up > 0.3  # from above


@pytest.mark.parametrize("shape", SHAPES[:3], ids=lambda shape: shape["type"])
def test_faces_close_the_solid_and_look_outwards(shape):
    faces = solid({**shape, "centre": [0.3, -0.2, 0.1]})
    assert not isinstance(faces, Ball)
    area, volume = np.zeros(3), 0.0
    for face in faces:
        fan = [
            np.cross(b - face.corners[0], c - face.corners[0]) / 2
            for b, c in zip(face.corners[1:-1], face.corners[2:], strict=True)
        ]
        whole = np.sum(fan, axis=0)
        assert whole @ face.normal > 0.999 * np.linalg.norm(whole)
        area += whole
        volume += whole @ face.corners[0] / 3
    np.testing.assert_allclose(area, 0.0, atol=1e-12)  # closed
    exact = {"box": 0.5 * 0.2 * 0.1, "cylinder": np.pi * 0.01 * 0.5, "tube": np.pi * (0.01 - 0.0049) * 0.5}
    assert volume == pytest.approx(exact[shape["type"]], rel=0.003)  # a polygon of 48 sides has 0.3 % less


def test_machines_of_any_size_fit():
    for factor in (1e-6, 1.0, 1e6):
        scene = pendulum.scene()
        scene["bodies"][0]["points"] = [[-0.5 * factor, 0, 0]]
        scene["joints"][0]["points"] = [[0, 0, 0], [-0.5 * factor, 0, 0]]
        svg = machine_picture(scene, factor * POSITION, ORIENTATION)
        ET.fromstring(svg)
        assert np.all(coordinates(svg) > 0)
        assert ("µm" in svg, "km" in svg) == (factor == 1e-6, factor == 1e6)


def test_a_single_free_body_is_drawn():
    scene = {
        "bodies": [{"name": "ball", "shape": None, "centre_of_mass": [0, 0, 0], "points": []}],
        "ground_points": [],
        "joints": [],
    }
    assert ">ball</text>" in machine_picture(scene, np.zeros((1, 3)), np.array([[1.0, 0, 0, 0]]))


def test_what_is_not_a_number_is_not_drawn():
    assert machine_picture(pendulum.scene(), np.full((1, 3), np.nan), ORIENTATION) == ""


def test_names_do_not_overlap():
    labels = [Label(f"joint_{k}", 200.0 + 4 * k, 150.0, "joint-name") for k in range(6)]
    placed = place(labels, np.array([[label.x, label.y] for label in labels]), np.empty((0, 2, 2)), 400.0, 300.0)
    assert len(placed) == 6
    for k, first in enumerate(placed):
        assert first.box[0] > 0
        assert first.box[2] < 400
        for second in placed[k + 1 :]:
            a, b = first.box, second.box
            assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]


def test_names_without_room_are_left_out():
    labels = [Label("a_name", 80.0, 30.0, "body")] * 30
    assert 0 < len(place(labels, np.empty((0, 2)), np.empty((0, 2, 2)), 160.0, 60.0)) < 30


def test_names_are_text_not_markup():
    scene = pendulum.scene()
    scene["bodies"][0]["name"] = scene["joints"][0]["bodies"][1] = "<b>&"
    svg = machine_picture(scene, POSITION, ORIENTATION)
    ET.fromstring(svg)
    assert "<b>" not in svg
