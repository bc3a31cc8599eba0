"""The page on comparing methods: its Python runs, its options and columns are those of the program, and none is missing."""

import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from click import Context

from nivel.cli import main
from nivel.lazy import asdict
from nivel.results.comparison import Row

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "compare.md").read_text(encoding="utf-8")


def first_cells():
    """Words between backticks in the first cells of all tables."""
    return {
        word for line in PAGE.splitlines() if line[:1] == "|" for word in re.findall(r"`([^`]+)`", line.split("|")[1])
    }


def options():
    command = main.get_command(Context(main), "compare")
    return {word for parameter in command.params for word in parameter.opts if word.startswith("--")}


def test_every_option_has_its_row():
    assert {word for word in first_cells() if word.startswith("--")} == options()


def test_every_column_has_its_row():
    assert {word for word in first_cells() if not word.startswith("--")} == set(asdict(Row("", "", "", "", "")))


def test_commands_have_options_that_exist():
    (command,) = re.findall(r"```bash\n(.*?)```", PAGE, re.DOTALL)
    assert {word for word in shlex.split(command) if word.startswith("--")} <= options()


def test_python_of_the_page_runs(tmp_path):
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "spread: the 2 methods" in done.stdout
    assert {"four-bar.csv", "four-bar.html"} <= {path.name for path in tmp_path.iterdir()}


def test_lines_are_short():
    assert not [line for line in PAGE.splitlines() if len(line) > 140 and not line.startswith("|")]
