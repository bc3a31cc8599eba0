"""The page of hydraulics: its machine works, and no component, key or signal is missing. The examples run green."""

import re
import shutil
from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.api import Machine
from nivel.elements.circuits import COMPONENTS
from nivel.elements.circuits.actuators import Cushion
from nivel.elements.circuits.fluids import Fluid, Gas
from nivel.elements.circuits.pistons import PistonFriction
from nivel.files import parse_machine

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "hydraulics.md").read_text(encoding="utf-8")
WORDS = set(re.findall(r"`([\w/-]+)`", PAGE))
KNOWN = {"name", "type", "ports", "markers", "bodies", "points"}


def test_the_machine_of_the_page_runs():
    text = re.search(r"```yaml\n(format: 1.*?)```", PAGE, re.DOTALL)
    assert text is not None
    result = Machine.from_record(parse_machine(text.group(1))).simulate(duration=0.3)
    assert result.outcome == "done"


@pytest.mark.parametrize(
    "record", [*COMPONENTS.records, Fluid, Gas, PistonFriction, Cushion], ids=lambda each: each.__name__
)
def test_every_key_of_a_component_is_on_the_page(record):
    assert not set(record.model_fields) - KNOWN - WORDS
    if "type" in record.model_fields:
        assert record.model_fields["type"].default in WORDS


@pytest.mark.parametrize("path", sorted((ROOT / "examples" / "hydraulics").glob("*.yaml")), ids=lambda path: path.stem)
def test_an_example_runs_green(path):
    result = nivel.load(path).simulate(
        **({"duration": 1.0} if path.stem == "loader-crane" else {})
    )  # its cycle has tests of its own
    assert result.outcome == "done"
    assert [item for item in result.trust.items if item.verdict != "green"] == []


def test_the_boom_of_the_crane_bends_by_one_word(tmp_path):
    """Bent or rigid it stands on the same pressure, of nearly the same weight."""
    from nivel.flexible.body.body_file import write_body
    from nivel.flexible.reduce import reduce

    folder = tmp_path / "hydraulics"
    shutil.copytree(ROOT / "examples" / "hydraulics", folder, ignore=shutil.ignore_patterns("*.nc"))
    write_body(reduce(folder / "booms" / "boom.yaml").body, folder / "booms" / "boom.nc")
    settings = {
        "coordinates": "relative",
        "integrator": "radau",
        "tolerance": 1e-5,
        "duration": 0.1,
        "start": "equilibrium",
    }
    stiff, bent = (
        nivel.load(folder / "loader-crane.yaml", {"include": f"booms/{word}.yaml"}).simulate(**settings)
        for word in ("rigid", "flexible")
    )
    assert bent.trust.verdict == "green"
    pressures = [float(np.mean(each.array("hydraulics.lift.pressure_A"))) for each in (stiff, bent)]
    assert pressures[1] == pytest.approx(pressures[0], rel=0.03)
    assert np.all(bent.array("modal_coordinate")[:, 0] != 0.0)
