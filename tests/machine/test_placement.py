"""Frames of bodies and markers."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from nivel import Body, Marker
from nivel.errors import ModelError
from nivel.machine.bodies.shape import Box, Sphere
from nivel.machine.core.orientation import Orientation, matrix_from_euler_parameters, rotation_matrix
from nivel.machine.core.placement import (
    VERTICAL,
    frame_between,
    frame_from_axes,
    initial_velocity,
    marker_frame,
    most_perpendicular,
    placement,
)

vectors = st.tuples(*[st.floats(-10, 10)] * 3).map(np.array).filter(lambda v: np.linalg.norm(v) > 1e-2)


def _is_frame(A):
    assert np.allclose(A.T @ A, np.eye(3), atol=1e-13)
    assert np.linalg.det(A) == pytest.approx(1)


@given(vectors, vectors)
@example(np.array([0.0, 0.0, 9.0]), np.array([0.0, 0.015625, 2.0]))
def test_x_points_from_the_first_point_to_the_second(start, end):
    if np.linalg.norm(end - start) < 1e-2:
        return
    A = frame_between(start, end)
    _is_frame(A)
    x = (end - start) / np.linalg.norm(end - start)
    assert np.allclose(A[:, 0], x, atol=1e-13)
    reference = np.eye(3)[1] if np.hypot(x[0], x[1]) < np.sin(VERTICAL) else np.eye(3)[2]
    assert A[:, 2] @ reference > 0  # z leans towards global Z (or Y) …
    assert A[:, 1] @ reference == pytest.approx(0, abs=1e-9)  # … and y has no part of it


@pytest.mark.parametrize(("tilt", "vertical"), [(0.0, True), (0.9e-3, True), (1.1e-3, False), (np.pi - 0.9e-3, True)])
def test_the_rule_changes_a_milliradian_from_the_vertical(tilt, vertical):
    A = frame_between((0, 0, 0), (0.3 * np.sin(tilt), 0, 0.3 * np.cos(tilt)))
    assert np.allclose(A[:, 2], [0, 1, 0]) == vertical


def test_along_global_x_nothing_is_turned():
    assert np.array_equal(frame_between((0, 0, 0), (5, 0, 0)), np.eye(3))


def test_a_body_between_points_stands_in_their_middle():
    body = Body(name="bar", density=1, shape=Box(from_=(1, 0, 0), to=(1, 4, 0), width=0.1, height=0.1))
    position, parameters = placement(body)
    assert np.allclose(position, [1, 2, 0])
    A = matrix_from_euler_parameters(parameters)
    assert np.allclose(A @ [2, 0, 0], [0, 2, 0])
    assert np.allclose(A @ [0, 0, 1], [0, 0, 1])


def test_a_body_is_where_it_is_said_to_be():
    turned = Orientation(axis=(0, 0, 1), angle="90 deg")
    position, parameters = placement(
        Body(name="a", density=1, shape=Sphere(radius=1), position=(1, 2, 3), orientation=turned)
    )
    assert np.array_equal(position, [1, 2, 3])
    assert np.allclose(matrix_from_euler_parameters(parameters), rotation_matrix(turned))


@given(vectors, vectors)
def test_frame_from_axes(axis, x_axis):
    if np.linalg.norm(np.cross(axis, x_axis)) < 1e-2 * np.linalg.norm(axis) * np.linalg.norm(x_axis):
        return
    A = frame_from_axes(axis, x_axis)
    _is_frame(A)
    assert np.allclose(A[:, 2], axis / np.linalg.norm(axis), atol=1e-13)
    assert A[:, 0] @ x_axis > 0
    assert A[:, 1] @ x_axis == pytest.approx(0, abs=1e-9)


@given(vectors)
def test_without_x_axis_the_most_perpendicular_parent_axis_is_taken(axis):
    A = frame_from_axes(axis)
    _is_frame(A)
    share = np.abs(axis) / np.linalg.norm(axis)
    chosen = most_perpendicular(axis)
    assert share @ chosen <= share.min() + 1e-6
    assert A[:, 0] @ chosen > 0


@pytest.mark.parametrize(
    ("axis", "x"),
    [
        ((0, 0, 1), (1, 0, 0)),
        ((0, 1, 0), (1, 0, 0)),
        ((1, 0, 0), (0, 1, 0)),
        ((0, 0, -2), (1, 0, 0)),
        ((1e-12, 0, 1), (1, 0, 0)),  # round-off does not change the choice
    ],
)
def test_among_equals_the_first_axis_is_taken(axis, x):
    assert np.allclose(frame_from_axes(axis)[:, 0], x)


def test_markers():
    turned = Orientation(axis=(1, 0, 0), angle=0.3)
    position, axes = marker_frame(Marker(name="a", body="b", position=(1, 2, 3), orientation=turned))
    assert np.array_equal(position, [1, 2, 3])
    assert np.allclose(axes, rotation_matrix(turned))
    cyclic = [[0, 1, 0], [0, 0, 1], [1, 0, 0]]  # x along Z, y along X, z along Y
    assert np.allclose(marker_frame(Marker(body="b", axis=(0, 2, 0), x_axis=(0, 5, 7)))[1], cyclic)
    assert np.array_equal(marker_frame(Marker(body="b"))[1], np.eye(3))


def test_angular_velocity_in_either_axes():
    turned = {"orientation": Orientation(axis=(0, 0, 1), angle="90 deg"), "density": 1, "shape": Sphere(radius=1)}
    spinning = Body(name="a", angular_velocity=(1, 0, 2), velocity=(4, 5, 6), **turned)
    velocity, rate = initial_velocity(spinning)
    assert np.array_equal(velocity, [4, 5, 6])
    assert np.allclose(rate, [0, -1, 2])
    assert np.allclose(initial_velocity(Body(name="a", angular_velocity_body=(1, 0, 2), **turned))[1], [1, 0, 2])
    assert np.allclose(initial_velocity(Body(name="a", **turned))[1], 0)


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({"axis": (0, 0, 0)}, "no direction"),
        ({"x_axis": (1, 0, 0)}, "needs an `axis`"),
        ({"axis": (1, 0, 0), "x_axis": (0, 0, 0)}, "no direction"),
        ({"axis": (1, 0, 0), "x_axis": (-2, 1e-4, 0)}, "parallel"),
        ({"axis": (1, 0, 0), "orientation": Orientation()}, "not both"),
    ],
)
def test_refusals(given, part):
    with pytest.raises(ModelError) as caught:
        Marker(body="b", **given)
    assert part in str(caught.value)
