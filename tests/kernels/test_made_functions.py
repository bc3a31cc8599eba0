"""Functions made within others, each with parts of its own, in entries that different processes have compiled into one cache."""

import os
import subprocess
import sys

import pytest

# large enough that the compiler leaves it a function of its own, called twice
TERM = """
            s += np.sin(weight * x[k] + {n}.0) * np.exp(-s) / (1.0 + x[k] * s * weight)
            if s > 3.0 * weight:
                s -= np.log(1.0 + s) * np.tanh(weight)
            elif s < -weight:
                s += np.cos(s) * weight
"""
MAKER = f"""
import numpy as np
from nivel.kernels.compile import leaf

def made(weight):
    @leaf
    def total(x):
        s = 0.0
        for k in range(x.shape[0]):
{"".join(TERM.format(n=n) for n in range(6))}
        return s
    return total
"""
ENTRY = """
import numpy as np
from numba import types
from nivel.kernels import cache
cache.install()
from nivel.kernels.compile import entry
from maker import made

total = made({weight})

@entry(types.float64(types.float64[::1]))
def run(x):
    return total(x) + total(x[1:])
"""


@pytest.fixture
def results(tmp_path):
    (tmp_path / "maker.py").write_text(MAKER)
    for name, weight in (("first", 1.0), ("second", 0.5)):
        (tmp_path / f"{name}.py").write_text(ENTRY.format(weight=weight))
    places = os.pathsep.join([str(tmp_path), *sys.path])

    def run(*names):
        text = f"import numpy as np\nfor x in {names}:\n    print(__import__(x).run(np.arange(5.0)))"
        environment = os.environ | {"PYTHONPATH": places, "NIVEL_CACHE_DIR": str(tmp_path / "cache")}
        done = subprocess.run([sys.executable, "-c", text], env=environment, capture_output=True, text=True, check=True)
        return [float(line) for line in done.stdout.split()]

    return run


def test_none_is_taken_for_another(results):
    (first,), (second,) = results("first"), results("second")
    assert first != second
    assert results("first", "second") == [first, second]
