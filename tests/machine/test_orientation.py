"""Orientations against an independent product of elementary rotations (SciPy)."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from nivel.errors import ModelError
from nivel.machine.core.orientation import (
    SEQUENCES,
    Orientation,
    euler_parameters,
    euler_parameters_from_matrix,
    matrix_from_euler_parameters,
    rotation_matrix,
)

angles = st.tuples(*[st.floats(-10, 10)] * 3)
ROUND_OFF = 1e-13


def _scipy_parameters(rotation):
    x, y, z, w = rotation.as_quat()
    parameters = np.array([w, x, y, z])
    return parameters * (-1 if w < 0 else 1)


@given(st.sampled_from(SEQUENCES), angles)
def test_every_sequence_is_a_product_of_elementary_rotations_about_moving_axes(sequence, three):
    orientation = Orientation(euler=three, sequence=sequence)
    # capital letters: SciPy's word for moving (intrinsic) axes
    expected = Rotation.identity()
    for axis, angle in zip(sequence, three, strict=True):
        expected = expected * Rotation.from_rotvec(angle * np.eye(3)["xyz".index(axis)])
    assert np.allclose(rotation_matrix(orientation), expected.as_matrix(), atol=ROUND_OFF)
    assert np.allclose(
        rotation_matrix(orientation), Rotation.from_euler(sequence.upper(), three).as_matrix(), atol=ROUND_OFF
    )


@given(st.sampled_from(SEQUENCES), angles)
def test_matrix_and_euler_parameters_say_the_same(sequence, three):
    orientation = Orientation(euler=three, sequence=sequence)
    parameters = euler_parameters(orientation)
    assert parameters[0] >= 0
    assert np.linalg.norm(parameters) == pytest.approx(1, abs=1e-15)
    assert np.allclose(matrix_from_euler_parameters(parameters), rotation_matrix(orientation), atol=ROUND_OFF)


@given(angles.filter(lambda a: np.linalg.norm(a) > 1e-3), st.floats(-10, 10))
def test_axis_and_angle(axis, angle):
    orientation = Orientation(axis=axis, angle=angle)
    expected = Rotation.from_rotvec(angle * np.array(axis) / np.linalg.norm(axis))
    assert np.allclose(rotation_matrix(orientation), expected.as_matrix(), atol=ROUND_OFF)


@given(st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda p: np.linalg.norm(p) > 1e-2))
def test_matrix_to_parameters_is_exact_all_around(four):
    unit = np.array(four) / np.linalg.norm(four)
    matrix = Rotation.from_quat([*unit[1:], unit[0]]).as_matrix()
    back = euler_parameters_from_matrix(matrix)
    assert np.allclose(np.outer(back, back), np.outer(unit, unit), atol=ROUND_OFF)


@pytest.mark.parametrize("axis", range(3))
def test_half_turns(axis):
    matrix = -np.eye(3)
    matrix[axis, axis] = 1
    assert np.allclose(euler_parameters(Orientation(matrix=matrix)), np.eye(4)[axis + 1])


def test_digits_name_the_same_sequences():
    assert Orientation(euler=(1, 2, 3), sequence=313) == Orientation(euler=(1, 2, 3), sequence="zxz")
    assert Orientation(euler=(1, 2, 3), sequence="321") == Orientation(euler=(1, 2, 3), sequence="zyx")


def test_moving_and_fixed_axes_are_reverses_of_each_other_as_the_message_says():
    moving = rotation_matrix(Orientation(euler=(0.1, 0.2, 0.3), sequence="zyx"))
    fixed = Rotation.from_euler("xyz", (0.3, 0.2, 0.1)).as_matrix()  # SciPy's small letters: fixed axes
    assert np.allclose(moving, fixed)


def test_printed_digits_are_made_exact():
    c = 0.866
    coarse = Orientation(matrix=[[c, -0.5, 0], [0.5, c, 0], [0, 0, 1]])
    assert np.allclose(rotation_matrix(coarse).T @ rotation_matrix(coarse), np.eye(3), atol=1e-15)
    assert np.allclose(rotation_matrix(coarse), Rotation.from_euler("z", 30, degrees=True).as_matrix(), atol=1e-3)
    assert np.linalg.norm(euler_parameters(Orientation(euler_parameters=(0.7071, 0.7071, 0, 0)))) == pytest.approx(
        1, abs=1e-15
    )


def test_nothing_given_is_not_turned():
    for none in (None, Orientation()):
        assert np.array_equal(rotation_matrix(none), np.eye(3))
        assert np.array_equal(euler_parameters(none), [1, 0, 0, 0])


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({"euler": (0, 0, 0)}, "belong together"),
        ({"sequence": "zxz"}, "belong together"),
        ({"axis": (1, 0, 0)}, "belong together"),
        ({"angle": 1}, "belong together"),
        ({"axis": (0, 0, 0), "angle": 1}, "no direction"),
        ({"euler": (0, 0, 0), "sequence": "ZXZ"}, "moving axes"),
        ({"euler": (0, 0, 0), "sequence": "zzx"}, "is not known"),
        ({"euler": (0, 0, 0), "sequence": 414}, "is not known"),
        ({"euler": (0, 0, 0), "sequence": True}, "was expected"),
        ({"euler_parameters": (1, 1, 0, 0)}, "length 1"),
        ({"euler_parameters": (0, 0, 0, 0)}, "length 1"),
        ({"euler_parameters": (1, 0, 0)}, "entries are missing"),
        ({"matrix": np.diag([1, 1, -1])}, "reflection"),
        ({"matrix": np.diag([1, 1, 2])}, "no rotation"),
        ({"matrix": np.zeros((3, 3))}, "no rotation"),
        ({"matrix": np.eye(3), "euler_parameters": (1, 0, 0, 0)}, "give one of"),
    ],
)
def test_refusals(given, part):
    with pytest.raises(ModelError) as caught:
        Orientation(**given)
    assert part in str(caught.value)
