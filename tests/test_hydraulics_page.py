"""The page of hydraulics: its machine works, and no component, key or signal is missing. The examples run green."""

import re
from pathlib import Path

import pytest

import nivel
from nivel.api import Machine
from nivel.files import parse_machine
from nivel.machine.hydraulics import COMPONENTS, Cushion, Fluid, Gas, PistonFriction

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "hydraulics.md").read_text(encoding="utf-8")
WORDS = set(re.findall(r"`([\w/-]+)`", PAGE))
KNOWN = {"name", "type", "ports", "markers", "bodies", "points"}


def test_the_machine_of_the_page_runs():
    text = re.search(r"```yaml\n(format: 1.*?)```", PAGE, re.DOTALL)
    assert text is not None
    result = Machine.from_record(parse_machine(text.group(1))).simulate(duration=0.3)
    assert result.outcome == "done"


@pytest.mark.parametrize("record", [*COMPONENTS, Fluid, Gas, PistonFriction, Cushion], ids=lambda each: each.__name__)
def test_every_key_of_a_component_is_on_the_page(record):
    assert not set(record.model_fields) - KNOWN - WORDS
    if "type" in record.model_fields:
        assert record.model_fields["type"].default in WORDS


@pytest.mark.parametrize("path", sorted((ROOT / "examples" / "hydraulics").glob("*.yaml")), ids=lambda path: path.stem)
def test_an_example_runs_green(path):
    result = nivel.load(path).simulate()
    assert result.outcome == "done"
    assert [item for item in result.trust.items if item.verdict != "green"] == []
