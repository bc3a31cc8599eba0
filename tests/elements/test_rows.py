"""Rows: a kernel and what fills it have the same names, in the same places."""

from collections.abc import Sequence
from types import SimpleNamespace

import numpy as np
import pytest

from nivel.elements.rows import Row, several
from nivel.native.function import leaf


class Pull(Row):
    """A row with all sorts of fields."""

    output: int
    stiffness: Sequence[float] = several(3)
    law: int = 7
    damping: float
    work: Sequence[float] = several(2, default=(0.0, 0.0))
    parts: Sequence[float] = several()


def test_places_count_columns_and_numbers_apart():
    assert (Pull.OUTPUT, Pull.LAW) == (0, 1)
    assert (Pull.STIFFNESS, Pull.DAMPING, Pull.WORK, Pull.PARTS) == (0, 3, 4, 6)


def test_a_row_has_its_values_in_these_places():
    row = Pull(parts=[8.0, 9.0], damping=4.0, stiffness=(1.0, 2.0, 3.0), output=5)
    assert row.columns == [5, 7]
    assert row.numbers == [1.0, 2.0, 3.0, 4.0, 0.0, 0.0, 8.0, 9.0]


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({}, "Pull needs output"),
        ({"output": 1, "stiffness": (1.0, 2.0), "damping": 1.0, "parts": ()}, "Pull needs 3 of stiffness, got 2"),
        ({"output": 1, "stiffnes": 1.0}, "Pull has no stiffnes"),
    ],
)
def test_a_missing_or_an_unknown_name_is_refused(values, message):
    with pytest.raises(TypeError, match=message):
        Pull(**values)


def test_only_the_last_field_has_any_length():
    with pytest.raises(TypeError, match=r"Bad\.last stands behind"):

        class Bad(Row):
            parts: Sequence[float] = several()
            last: float


def test_a_field_is_a_column_or_a_number():
    with pytest.raises(TypeError, match=r"Bad\.name is a column"):

        class Bad(Row):
            name: str


@leaf
def third(numbers):
    return numbers[Pull.STIFFNESS + 2] + 10.0 * numbers[Pull.DAMPING]


def test_places_are_constants_of_compiled_functions():
    numbers = np.array([1.0, 2.0, 3.0, 4.0])
    assert third(numbers) == third.py_func(numbers) == 43.0


def test_the_rest_of_a_row_is_taken_from_a_record():
    given = SimpleNamespace(stiffness=(1.0, 2.0, 3.0), damping=4.0, output=None, law=9)
    row = Pull.of(given, output=5, law=6, parts=())
    assert row == ([5, 6], [1.0, 2.0, 3.0, 4.0, 0.0, 0.0])
    with pytest.raises(TypeError, match="Pull needs output"):
        Pull.of(given, parts=())
