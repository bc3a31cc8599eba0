"""The page on beams: its machine is what it says, and so is what is said of it."""

import re
from pathlib import Path

import numpy as np
import pytest

import nivel
from checking import check
from nivel.api import Machine
from nivel.files import parse_machine

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "beams.md").read_text(encoding="utf-8")
(MACHINE,) = re.findall(r"^```yaml\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
(SHOWN,) = re.findall(r"^```text\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


def test_the_check_says_what_the_page_shows():
    assert SHOWN in f"{check(parse_machine(MACHINE))}\n"


@pytest.fixture(scope="module")
def result():
    return Machine.from_record(parse_machine(MACHINE)).simulate()


def test_the_machine_of_the_page_runs_green(result):
    assert result.outcome == "done"
    assert result.trust.verdict == "green", result


def test_a_thin_leaf_bends_in_its_plane_only(result):
    """About y of the world, which is z of its sections; the eye takes no moment about y."""
    sections = result.sections("leaf")
    moment = np.abs(sections["moment"].values).max(axis=(0, 1))
    assert moment[2] > 1.0
    assert moment[:2].max() < 1e-9 * moment[2]
    assert set(sections.data_vars) >= {"strain", "curvature", "force", "moment"}
    assert "leaf.5" in result.coordinates["body"]


def test_examples_that_are_named_exist():
    for name in re.findall(r"`(examples/\S+?)`", PAGE):
        assert (ROOT / name).exists()


def test_links_lead_somewhere():
    for target in re.findall(r"\]\(([^)]+)\)", PAGE):
        file, _, heading = target.partition("#")
        text = (ROOT / "docs" / file).read_text(encoding="utf-8") if file else PAGE
        headings = {
            re.sub(r"[^\w -]", "", line.lower()).replace(" ", "-")
            for line in re.findall(r"^#+ (.*)", text, re.MULTILINE)
        }
        assert not heading or heading in headings, target


def test_explicit_steps_of_the_page_are_stable_and_no_longer_ones():
    """RK4 is stable up to ω h = 2√2 along the imaginary axis; the leaf's highest element frequency bounds ω from above."""
    facts = check(parse_machine(MACHINE)).beams[0]
    limit = 2 * np.sqrt(2) / (2 * np.pi * facts.fastest)
    machine = Machine.from_record(parse_machine(MACHINE))
    steps = 2000
    stable = machine.simulate(
        integrator="rk4", step=0.95 * limit, output_interval=0.95 * limit * steps, duration=0.95 * limit * steps
    )
    assert stable.outcome == "done"
    assert np.abs(stable.array("energy_error")).max() < 1e-6
    try:
        wild = machine.simulate(
            integrator="rk4", step=2 * limit, output_interval=2 * limit * steps, duration=2 * limit * steps
        )
    except nivel.SolveError:
        return
    assert not np.abs(wild.array("energy_error")).max() < 1.0
