"""The page on trust: its commands and its program run and say what the page says."""

import re
from pathlib import Path

import matplotlib as mpl
import pytest
from click.testing import CliRunner

from nivel.cli import main
from nivel.results.trust.findings import _damped_item, _growth_item
from nivel.results.trust.second_look import Damped, Growth
from nivel.results.trust.verdicts import CHECKS

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "trust.md").read_text(encoding="utf-8")


def test_the_command_of_the_page_says_its_headline(tmp_path, monkeypatch):
    (command,) = re.findall(r"^```bash\n(.*?)\n^```$", PAGE, re.MULTILINE | re.DOTALL)
    (shown,) = re.findall(r"^```text\n(.*?)\n^```$", PAGE, re.MULTILINE | re.DOTALL)
    monkeypatch.chdir(tmp_path)
    words = command.split()
    done = CliRunner().invoke(main, [*words[1:2], str(ROOT / words[2]), *words[3:], "--no-report"])
    assert done.exit_code == 0, done.output
    assert shown in done.output


@pytest.mark.filterwarnings("ignore")
def test_the_program_of_the_page_runs(verified, monkeypatch, capsys):
    (program,) = re.findall(r"^```python\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    mpl.use("Agg")
    monkeypatch.chdir(ROOT)
    exec(program, {})
    headline, error = capsys.readouterr().out.splitlines()
    assert headline.startswith("within ")
    assert 0.0 < float(error) < 1e-6


def test_every_item_that_is_told_stands_in_the_table():
    told = re.findall(r"^\| (\w[\w-]*) \|", PAGE, re.MULTILINE)
    assert {
        "Loads",
        "Sampling",
        "Turning",
        "Round-off",
        "Parts",
        "Stiffening",
        "Bending",
        "Mesh",
        "Contact",
        "Damped",
        "Sensitivity",
    } <= set(told)
    assert set(CHECKS) == {
        "loads",
        "sampling",
        "steps",
        "turn",
        "rounding",
        "parts",
        "stiffening",
        "bending",
        "mesh",
        "modes",
    }
    assert _damped_item(Damped(1.0, 1.0), "bdf").text.startswith("Damped")
    assert _growth_item(Growth(1.0, 2.0)).text.startswith("Sensitivity")
