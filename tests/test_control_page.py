"""The page on control: its machines work, and nothing that can be written is missing."""

import re
from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.api import Machine
from nivel.elements.control import BLOCKS
from nivel.files import parse_machine
from nivel.machine.control.block import Block
from nivel.machine.core.record import field_words

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "control.md").read_text(encoding="utf-8")
MACHINES = re.findall(r"^```yaml\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
(PYTHON,) = re.findall(r"^```python\n# (\S+)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
ROWS = {line.split("|")[1].strip(): line for line in PAGE.splitlines() if line.startswith("|")}


@pytest.mark.parametrize("kind", BLOCKS.records, ids=lambda kind: kind.model_fields["type"].default)
def test_every_kind_of_block_has_its_keys_in_the_page(kind):
    word = kind.model_fields["type"].default
    text = ROWS.get(f"`{word}`", PAGE if f"`type: {word}`" in PAGE else "")
    assert set(field_words(kind)) - set(field_words(Block)) - {"type"} <= set(re.findall(r"\w+", text))


def test_what_all_blocks_share_has_its_rows():
    assert {f"`{word}`" for word in {*field_words(Block), "type"} - {"name"}} <= set(ROWS)


@pytest.mark.parametrize("text", MACHINES, ids=[f"machine-{number}" for number in range(len(MACHINES))])
def test_machines_of_the_page_run_green(text, tmp_path):
    (tmp_path / PYTHON[0]).write_text(PYTHON[1], encoding="utf-8")
    result = Machine.from_record(parse_machine(text, str(tmp_path / "m.yaml"), allow_code=True)).simulate(duration=2)
    assert result.trust.verdict == "green", result
    for name in result.variables:
        if name.startswith("control."):
            assert np.all(np.isfinite(result[name]))


def test_lines_are_short():
    assert not [line for line in PAGE.splitlines() if len(line) > 141 and not line.startswith("|")]


def axis_errors(result, count):
    return [float(np.max(np.abs(result[f"sensor.error_{k + 1}"]))) for k in range(count)]


def test_the_servo_axis_follows_its_path():
    result = nivel.load(ROOT / "examples" / "control" / "servo-axis.yaml").simulate()
    assert result.trust.verdict == "green", result
    assert float(np.max(np.abs(result["sensor.following_error"]))) < 0.5e-3
    assert float(np.abs(result["sensor.following_error"][-1])) < 5e-6


def test_the_six_axis_arm_stands_still_at_first_and_follows_its_trajectory():
    result = nivel.load(ROOT / "examples" / "control" / "six-axis-arm.yaml").simulate()
    assert result.trust.verdict == "green", result
    assert max(axis_errors(result, 6)) < np.radians(1.5)
    before = result.time < 0.295
    for k in range(6):
        assert np.max(np.abs(result[f"sensor.error_{k + 1}"][before])) < 1e-6
