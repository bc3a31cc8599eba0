"""What the benchmarks import from the package exists; they themselves take too long for a test."""

import ast
import re
from importlib import import_module
from pathlib import Path

import pytest

BENCHMARKS = sorted((Path(__file__).parent.parent / "benchmarks").glob("*.py"))


@pytest.mark.parametrize("path", BENCHMARKS, ids=lambda path: path.stem)
def test_imports_exist(path):
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.startswith("nivel"):
            module = import_module(node.module)
            for alias in node.names:
                assert hasattr(module, alias.name) or import_module(f"{node.module}.{alias.name}"), alias.name


def test_the_page_installs_what_the_other_programs_ask_for():
    page = (BENCHMARKS[0].parent / "README.md").read_text(encoding="utf-8")
    (command,) = re.findall(r"\.venv-peers/bin/pip install (.*)", page)
    peers = [path.read_text(encoding="utf-8") for path in (BENCHMARKS[0].parent / "peers").glob("*_*.py")]
    asked = {name for text in peers for name in re.findall(r"pip install ([\w-]+)", text)}
    assert asked
    assert asked <= {*command.split()}
