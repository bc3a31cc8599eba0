"""Examples run in a process that cannot import Numba: what is in the library or the cache is all they need."""

import subprocess
import sys
from pathlib import Path

import pytest

from nivel import PythonLaw
from nivel.errors import ModelError
from nivel.native import workers
from nivel.system.laws.laws import law_address

EXAMPLES = Path(__file__).parents[2] / "examples"
# controllers sampled and continuous, set-points, drives, circuits, expressions
NAMES = ("control/servo-axis", "hydraulics/excavator", "control/crane-control")
CODE = f"""
import sys
sys.modules["numba"] = None
import nivel
nivel.load("{EXAMPLES}/mechanisms/slider-crank.yaml").simulate(duration=2e-3)
print("scipy" not in sys.modules)
for name in {NAMES}:
    print(nivel.load(f"{EXAMPLES}/{{name}}.yaml").simulate(duration=2e-3).time.size > 1)
"""


def test_examples_with_blocks_need_no_compiler_and_rigid_machines_no_scipy():
    done = subprocess.run([sys.executable, "-c", CODE], capture_output=True, text=True, check=False)
    assert done.stdout.split() == ["True"] * (1 + len(NAMES)), done.stderr


def test_a_python_law_is_refused_with_what_brings_a_compiler(monkeypatch, tmp_path):
    monkeypatch.setattr(workers, "find_spec", lambda name: None)
    law = PythonLaw(f"def push(t):\n    return t + {id(tmp_path)}.0\n", "push", ("time",))  # in no cache
    with pytest.raises(ModelError, match=r"pip install 'nivel\[laws\]'"):
        law_address(law, motion=False)
