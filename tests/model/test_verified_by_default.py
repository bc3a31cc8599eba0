"""Runs in Python are verified as those of the command are, unless one asks for a single run."""

import subprocess
import sys

from example_files import EXAMPLES
from patience import PATIENCE

RUN = """
import sys
import nivel
machine = nivel.load(sys.argv[1])
for words in ({}, {"verify": False}):
    result = machine.simulate(duration=0.2, **words)
    error = result.estimated_error("bob.position").max()
    print(result.trust.headline, "error", error)
"""


def test_simulate_verifies_unless_told_otherwise():
    # a process of its own: in the tests the default is one run, for their time
    file = str(EXAMPLES / "mechanisms" / "simple-pendulum.yaml")
    done = subprocess.run(
        [sys.executable, "-c", RUN, file], capture_output=True, text=True, timeout=PATIENCE, check=True
    )
    by_default, single = done.stdout.splitlines()
    assert "not verified" not in by_default
    assert 0.0 < float(by_default.rpartition("error ")[2]) < 1e-3
    assert "not verified" in single
    assert single.endswith("error nan")
