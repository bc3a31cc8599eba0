"""Dataclasses whose methods are made late are those of the standard library in everything that one can ask of them."""

import copy
import dataclasses
import inspect
import pickle
import sys
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import pytest

from nivel.lazy import dataclass, field


def weighted():
    """A class of points that nobody has asked anything yet."""

    @dataclass(frozen=True, order=True)
    class Point:
        x: float
        y: float = 0.0

        def __str__(self):
            return f"({self.x}, {self.y})"

    @dataclass(frozen=True, order=True)
    class Weighted(Point):
        weight: float = 1.0
        names: list[str] = field(default_factory=list, compare=False)

    return Weighted


@dataclass(frozen=True)
class Kept:
    value: float


@dataclass
class Counter:
    count: int = 0


@pytest.mark.parametrize(
    "ask",
    [
        lambda kind: [each.name for each in dataclasses.fields(kind)] == ["x", "y", "weight", "names"],
        lambda kind: list(inspect.signature(kind).parameters) == ["x", "y", "weight", "names"],
        lambda kind: kind.__match_args__ == ("x", "y", "weight", "names"),
        dataclasses.is_dataclass,
        lambda kind: repr(kind(1.0)).endswith("Weighted(x=1.0, y=0.0, weight=1.0, names=[])"),
        lambda kind: kind(1.0, names=["a"]) == kind(1.0) != kind(2.0),
        lambda kind: hash(kind(1.0)) == hash(kind(1.0)),
        lambda kind: kind(1.0) < kind(1.0, 0.5),
        lambda kind: dataclasses.replace(kind(1.0), weight=3.0).weight == 3.0,
        lambda kind: copy.deepcopy(kind(1.0)) == kind(1.0),
        lambda kind: str(kind(1.0, 2.0)) == "(1.0, 2.0)",
    ],
)
def test_a_class_answers_whatever_is_asked_first(ask):
    assert ask(weighted())


def test_two_threads_may_ask_a_class_first_at_the_same_moment():
    """A run and its verification do; a switch of threads at any place shows a class that is half made."""
    before, begin = sys.getswitchinterval(), Barrier(2)

    def asked(kind):
        begin.wait()
        return repr(kind(1.0, weight=2.0)), kind(1.0) < kind(1.0, 0.5), hash(kind(1.0)) == hash(kind(1.0))

    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(2) as threads:
            for _ in range(40):
                one, other = threads.map(asked, [weighted()] * 2)
                assert one == other
    finally:
        sys.setswitchinterval(before)


def test_what_was_pickled_is_read_back():
    assert pickle.loads(pickle.dumps(Kept(1.0))) == Kept(1.0)


def test_frozen_ones_refuse_and_others_have_no_hash():
    with pytest.raises(dataclasses.FrozenInstanceError):
        weighted()(1.0).x = 2.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        del weighted()(1.0).x
    counter = Counter()
    counter.count += 1
    assert counter == Counter(1)
    with pytest.raises(TypeError, match="unhashable"):
        hash(counter)
