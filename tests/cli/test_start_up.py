"""What is loaded when: help of every command and import are light."""

import subprocess
import sys

import pytest

from nivel.cli import COMMANDS

HEAVY = (
    "llvmlite",
    "numba",
    "numpy",
    "scipy",
    "xarray",
    "pandas",
    "matplotlib",
    "pint",
    "pydantic",
    "h5py",
    "websockets",
)


def modules_after(code):
    script = f"{code}\nimport sys; print('loaded:', *(name for name in {HEAVY!r} if name in sys.modules))"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    return done.stdout.strip().splitlines()[-1].removeprefix("loaded:").split()


def test_importing_nivel_loads_nothing_heavy():
    assert modules_after("import nivel") == []


def test_help_loads_nothing_heavy():
    code = "from nivel.cli import main\nmain(['--help'], standalone_mode=False)"
    assert modules_after(code) == []


@pytest.mark.parametrize("command", COMMANDS)
def test_help_of_a_command_is_there_and_loads_nothing_heavy(command):
    code = f"""
from click.testing import CliRunner
from nivel.cli import main
done = CliRunner().invoke(main, [{command!r}, '--help'])
assert done.exit_code == 0, done.output
assert 'Usage: ' in done.stdout
"""
    assert modules_after(code) == []


def test_public_names_exist_and_are_few():
    import nivel

    assert len(nivel.__all__) <= 60
    for name in nivel.__all__:
        assert getattr(nivel, name) is not None
    with pytest.raises(AttributeError, match="no attribute"):
        _ = nivel.nothing_of_this_name


def test_the_module_is_the_command():
    command = [sys.executable, "-m", "nivel", "run", "--help"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "nivel run [OPTIONS] MACHINE" in done.stdout
