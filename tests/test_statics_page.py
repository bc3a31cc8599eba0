"""The page on statics: its options and variables are those of the program, and its Python runs."""

import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from click import Context

import nivel
from nivel.analysis.statics.frames import BENDING, OWN, VIBRATION
from nivel.cli import main
from nivel.errors import SolveError

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "statics.md").read_text(encoding="utf-8")


def first_cells():
    """Words between backticks in the first cells of all tables."""
    return {
        word for line in PAGE.splitlines() if line[:1] == "|" for word in re.findall(r"`([^`]+)`", line.split("|")[1])
    }


def options():
    command = main.get_command(Context(main), "statics")
    return {word for parameter in command.params for word in parameter.opts if word.startswith("--")}


def test_every_option_has_its_row():
    assert {word for word in first_cells() if word.startswith("--")} == options()


def test_every_variable_has_its_row():
    assert {name for name, *_ in (*OWN, *VIBRATION, BENDING)} <= first_cells()


def test_commands_have_options_that_exist():
    (command,) = re.findall(r"```bash\n(.*?)```", PAGE, re.DOTALL)
    assert {word for word in shlex.split(command) if word.startswith("--")} <= options()


def test_python_of_the_page_runs(tmp_path):
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert {"toggle.html", "mode.html"} <= {path.name for path in tmp_path.iterdir()}


def test_toggle_has_the_limit_load_that_its_file_states():
    """9.95 N: 2 k (l/s - 1) √(s² - a²) with s = (l a²)^⅓; the load is 20 N/s."""
    half_span, stiffness, length = 1.0, 1000.0, 1.09**0.5
    s = (length * half_span**2) ** (1 / 3)
    limit = 2 * stiffness * (length / s - 1) * (s**2 - half_span**2) ** 0.5
    assert f"{limit:.2f} N" in (ROOT / "examples" / "mechanisms" / "toggle.yaml").read_text(encoding="utf-8")
    with pytest.raises(SolveError, match="limit point") as caught:
        nivel.load(ROOT / "examples" / "mechanisms" / "toggle.yaml").statics()
    assert 20 * caught.value.result.time[-1] == pytest.approx(limit, rel=1e-4)


def test_lines_are_short():
    assert not [line for line in PAGE.splitlines() if len(line) > 140 and not line.startswith("|")]
