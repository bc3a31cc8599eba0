"""Time of `nivel check` where many constraints are redundant: processor time of the command on forty windows of the N-four-bar."""

import json
import resource
import subprocess
import sys

import pytest

import nivel
from patience import PATIENCE
from simulating import hinge, solid

COUNT, SECONDS = 40, 10.0  # 2 s on one core


def windows(count):
    """N four-bars side by side, all joints revolute with parallel axes (IFToMM benchmark A02): three rows too many in each."""
    bodies = {f"crank{k}": solid(position=[k, 0, 0.5]) for k in range(count + 1)}
    bodies |= {f"rod{k}": solid(position=[k + 0.5, 0, 1]) for k in range(count)}
    joints = {f"foot{k}": hinge("ground", f"crank{k}", (k, 0, 0), axis=[0, 1, 0]) for k in range(count + 1)}
    for k in range(count):
        joints[f"left{k}"] = hinge(f"crank{k}", f"rod{k}", (k, 0, 1), axis=[0, 1, 0])
        joints[f"right{k}"] = hinge(f"rod{k}", f"crank{k + 1}", (k + 1, 0, 1), axis=[0, 1, 0])
    return {"format": 1, "gravity": [0, 0, 9.81], "bodies": bodies, "joints": joints}


@pytest.mark.parametrize("start", ["as-given", "equilibrium"])
def test_checking_many_redundant_rows_takes_seconds(start, tmp_path):
    """A window has 3 bars more than the last one and one motion in common with it: 5·(3 N + 1) rows on 6·(2 N + 1) freedoms."""
    sections = {**windows(COUNT), "simulation": {"start": start}}
    (tmp_path / "windows.yaml").write_text(json.dumps(sections))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "nivel", "check", "windows.yaml"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True, timeout=PATIENCE)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime < SECONDS
    assert "1 degree of freedom" in done.stdout
    redundant = 5 * (3 * COUNT + 1) - 6 * (2 * COUNT + 1) + 1
    line = next(line for line in done.stdout.splitlines() if line.startswith("constraints: "))
    assert line.count(", ") == redundant - 1 + 1  # names, and the comma behind the number of rows


def test_few_windows_have_the_ranges_of_their_reactions(tmp_path):
    (tmp_path / "windows.yaml").write_text(json.dumps(windows(1)))
    assert any(facts.ranges for facts in nivel.load(tmp_path / "windows.yaml").check().reactions)
