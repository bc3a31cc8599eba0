"""Parameters that use each other."""

import pytest

from nivel.machine.parameters import resolve
from nivel.machine.units.tree import Number
from nivel.machine.units.unit import dimension


def test_order_does_not_matter():
    values, faults = resolve({"c": "a + b", "b": "2*a", "a": "1.5"})
    assert not faults
    assert values == {"a": Number(1.5), "b": Number(3.0), "c": Number(4.5)}


def test_dimensions_are_carried():
    values, _ = resolve({"speed": "way/span", "way": "3 m", "span": "2 s", "turn": "30 deg"})
    assert values["speed"] == Number(1.5, dimension(m=1, s=-1))
    assert values["turn"].dimension == dimension(rad=1)


def test_a_ring_is_reported_once_and_the_rest_is_kept():
    values, faults = resolve({"a": "b", "b": "c + 1", "c": "a", "user": "2*b", "free": 3})
    assert len(faults) == 1
    assert "a → b → c → a" in faults["a"]
    assert values["free"] == Number(3.0)
    assert values["user"] is None


def test_a_chain_of_faults_is_reported_at_its_start():
    values, faults = resolve({"a": "1 +", "b": "a", "c": "b"})
    assert list(faults) == ["a"]
    assert values == {"a": None, "b": None, "c": None}


@pytest.mark.parametrize(
    ("name", "value", "part"),
    [
        ("min", 1, "has a meaning already"),
        ("pi", 3, "has a meaning already"),
        ("time", 3, "has a meaning already"),
        ("sin", 3, "has a meaning already"),
        ("two words", 1, "letters, digits and `_` only"),
        ("a-b", 1, "letters, digits and `_` only"),
        ("1a", 1, "letters, digits and `_` only"),
        ("x", None, "was expected"),
        ("x", [1], "was expected"),
        ("x", True, "was expected"),
        ("x", float("nan"), "not a number"),
        ("x", float("inf"), "a finite number was expected"),
        ("x", 10**400, "too large"),
        ("x", "2*time", "cannot change with `time`"),
        ("x", "1 m + 1 s", "cannot be added"),
        ("x", "x", "x → x"),
        ("x", "yy", "neither a parameter nor a unit"),
    ],
)
def test_refusals(name, value, part):
    _, faults = resolve({name: value})
    assert part in faults[name]


def test_very_long_chains_end_in_a_message():
    _, faults = resolve({f"p{i}": f"p{i + 1}" for i in range(5000)} | {"p5000": 1})
    assert all("more than 100" in message for message in faults.values())
