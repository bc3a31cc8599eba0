"""What the README promises: its Python runs, its commands exist, its set-up commands are those of CI."""

import re
import subprocess
import sys
from pathlib import Path

from needing import needs
from nivel.cli import COMMANDS

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_python_of_the_readme_runs():
    needs("matplotlib")
    (code,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    script = f"import matplotlib\nmatplotlib.use('Agg')\n{code}"
    done = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "1 degree of freedom" in done.stdout
    assert "green" in done.stdout


def test_every_command_stands_in_the_readme():
    for name in COMMANDS:
        assert f"`nivel {name}" in README


def test_files_that_the_readme_names_exist():
    for target in re.findall(r"\]\(([^)#:]+)\)", README):
        assert (ROOT / target).exists(), target


def test_continuous_integration_calls_the_test_command_of_the_readme():
    assert "<!-- tests -->" in README
    assert "tests/all.py" in README
    assert "README.md" in (ROOT / ".ci" / "run").read_text(encoding="utf-8")
