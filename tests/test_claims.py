"""Claims that share a state: a failure names each claim that does not hold and shows its numbers."""

import numpy as np
import pytest

import claims


def test_every_claim_is_checked_and_those_that_fail_are_told_with_their_numbers():
    checked = []

    def holds(value):
        checked.append("holds")
        assert value == 3.25

    def is_off(value):
        checked.append("is off")
        assert value < 1.5

    def array_is_off(value):
        checked.append("array is off")
        np.testing.assert_allclose([value, 0.0], [7.75, 0.0])

    def breaks(value):
        checked.append("breaks")
        raise IndexError(f"place {value}")

    every = {"is off": is_off, "holds": holds, "array is off": array_is_off, "breaks": breaks}
    with pytest.raises(AssertionError) as told:
        claims.check(every, 3.25)
    assert checked == list(every)
    text = str(told.value)
    assert text.startswith("3 of 4 claims do not hold")
    for part in (
        "- is off (test_claims.py:",
        "3.25 < 1.5",
        "- array is off (",
        "7.75",
        "- breaks (",
        "IndexError: place 3.25",
    ):
        assert part in text
    assert "- holds" not in text


def test_claims_that_hold_say_nothing():
    claims.check({"is a number": lambda value: None}, 1.0)
