"""The page on analyses: its options are those of the program, its commands and its Python run."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from click import Context
from click.testing import CliRunner

from nivel.cli import main

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "analyses.md").read_text(encoding="utf-8")
SHARED = {"--set", "--allow-code", "--out", "--force", "--no-report", "--quiet", "--json"}
SECTIONS = {"kinematics": "Kinematics", "linearise": "Linearisation", "inverse": "Inverse dynamics"}


def options(name):
    command = main.get_command(Context(main), name)
    return {word for parameter in command.params for word in parameter.opts if word.startswith("--")} - SHARED


@pytest.mark.parametrize("name", SECTIONS)
def test_every_option_has_its_row(name):
    section = re.search(rf"^## {SECTIONS[name]}\n(.*?)^## ", PAGE, re.MULTILINE | re.DOTALL)[1]
    cells = [line.split("|")[1] for line in section.splitlines() if line[:1] == "|"]
    assert {word for cell in cells for word in re.findall(r"`(--[^`]+)`", cell)} == options(name)


@pytest.mark.parametrize("line", re.search(r"```bash\n(.*?)```", PAGE, re.DOTALL)[1].splitlines())
def test_commands_of_the_page_run(line, tmp_path):
    words = shlex.split(line)[1:]
    words[1] = str(ROOT / words[1])
    done = CliRunner().invoke(main, [*words, "--quiet", "--out", str(tmp_path / "out.nc")], prog_name="nivel")
    assert done.exit_code == 0, done.stderr
    assert {"out.nc", "out.html"} <= {path.name for path in tmp_path.iterdir()}


def test_python_of_the_page_runs(tmp_path):
    code = "\n".join(re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)).replace('"examples/', f'"{ROOT}/examples/')
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert {"lift.html", "swing.html"} <= {path.name for path in tmp_path.iterdir()}
