"""Modules of nivel that commands import for the slider-crank: the numbers of budgets.json may only fall."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
MACHINE = str(HERE.parent / "examples" / "mechanisms" / "slider-crank.yaml")
BUDGETS = json.loads((HERE / "budgets.json").read_text(encoding="utf-8"))
COUNTED = """
import sys
{start}
print(sum(name.partition(".")[0] == "nivel" for name in sys.modules))
"""
COMMAND = "from nivel.cli import main\nmain({arguments!r}, standalone_mode=False)"
STARTS = {
    "load": f"import nivel\nnivel.load({MACHINE!r})",
    "check": COMMAND.format(arguments=["check", MACHINE]),
    "run": COMMAND.format(arguments=["run", MACHINE, "--force"]),
}


@pytest.mark.parametrize("name", BUDGETS)
def test_commands_import_no_more_modules(name, tmp_path):
    arguments = [sys.executable, "-c", COUNTED.format(start=STARTS[name])]
    for _ in range(2):  # the first one may compile, which imports more
        ended = subprocess.run(arguments, cwd=tmp_path, capture_output=True, text=True, encoding="utf-8", check=True)
    assert int(ended.stdout.split()[-1]) <= BUDGETS[name]
