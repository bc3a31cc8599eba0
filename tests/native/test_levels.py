"""The level of processors that a user asks for: refused in words where there is none, part of the cache's key, kept by machine code."""

import os
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from example_files import EXAMPLES
from nivel.cli import main
from nivel.native import processor, shipped, store
from nivel.native.processor import LEVELS, VARIABLE
from nivel.native.workers import CompilationError

X = np.random.default_rng(3).uniform(0.5, 1.0, (50, 3))
CODE = f"""
import numpy as np
import toy_entries
for row in np.array({X.tolist()}):
    print(toy_entries.squares(row, 0).hex())
"""


def forget():
    for function in (processor.asked_level, store.compiler, shipped.level, shipped._library):
        function.cache_clear()


@pytest.fixture
def asked(monkeypatch):
    """A function that asks for a level."""

    def ask(level):
        monkeypatch.setenv(VARIABLE, level)
        forget()

    yield ask
    monkeypatch.undo()
    forget()


@pytest.mark.parametrize(
    ("level", "said"), [("v3", "there is no such level"), ("armv8-a", "this processor cannot run that")]
)
def test_another_level_is_refused_in_words(asked, level, said):
    if level in LEVELS and processor.runs_here(LEVELS[level]):
        pytest.skip("a processor of this level")
    asked(level)
    done = CliRunner().invoke(main, ["check", str(EXAMPLES / "mechanisms" / "slider-crank.yaml")])
    assert done.exit_code == 2
    assert f"{VARIABLE} is `{level}`; {said}: write one of " in " ".join(done.output.split())
    with pytest.raises(CompilationError, match=f"{VARIABLE} is `{level}`; {said}"):
        store.compiler()  # asked for wherever an entry is loaded or compiled


def test_each_level_has_its_place_in_the_cache(asked):
    places = set()
    possible = ["", *(name for name in LEVELS if processor.runs_here(LEVELS[name]))]
    for level in possible:
        asked(level)
        places.add(store.path_of("symbol", "text"))
    assert len(places) == len(possible)


def test_a_library_of_another_level_is_not_used(asked, monkeypatch):
    monkeypatch.setattr(shipped, "manifest", lambda: {"levels": ["x86-64-v4", "x86-64-v3"], "entries": {}})
    for level in filter(lambda name: processor.runs_here(LEVELS[name]), ("x86-64-v3", "x86-64-v2")):
        asked(level)
        assert shipped.level() == (level if level == "x86-64-v3" else "")


def fused(x, y, s):
    """x y + s with one rounding: a ratio of two whole numbers is rounded once."""
    exact = Fraction(x) * Fraction(y) + Fraction(s)
    return exact.numerator / exact.denominator


@pytest.mark.parametrize(
    ("level", "add"), [("x86-64-v2", lambda x, y, s: x * y + s), ("x86-64-v3", fused), ("x86-64-v4", fused)]
)
def test_a_sum_of_products_is_that_of_the_level_to_the_last_bit(level, add):
    """Below v3 a product is rounded before it is added, from v3 on product and sum are one instruction with one rounding."""
    if not processor.runs_here(LEVELS[level]):
        pytest.skip("a processor below this level")
    own = {**os.environ, VARIABLE: level, "PYTHONPATH": os.pathsep.join([str(Path(__file__).parent), *sys.path])}
    done = subprocess.run([sys.executable, "-c", CODE], env=own, capture_output=True, text=True, check=True)
    expected = [add(c, c, add(b, b, add(a, a, 0.0))) for a, b, c in X.tolist()]
    assert [float.fromhex(line) for line in done.stdout.split()] == expected
    rounded_twice = [c * c + (b * b + a * a) for a, b, c in X.tolist()]
    assert (expected == rounded_twice) == (add is not fused)
