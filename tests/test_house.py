"""Checks of the whole code: import layers, types, and indices of kernels, which run as plain Python in a process of their own."""

import importlib.util
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import rooms
from lanes import FULL
from patience import PATIENCE

ROOT = Path(__file__).parent.parent
PACKAGE, SETTINGS = ROOT / "src" / "nivel", ROOT / "pyproject.toml"
BIN = Path(sys.executable).parent
# kernels as plain Python: their own tests, and those that are marked `plain`
MARKED = sorted(
    path for path in (ROOT / "tests").rglob("test_*.py") if "mark.plain" in path.read_text(encoding="utf-8")
)
PLAIN = ["tests/interpreted", *map(str, MARKED), *([] if FULL else ["-m", "not full"])]
PYTEST = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "no:seconds"]


def done(command, environment):
    own = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    return subprocess.run(
        command,
        cwd=ROOT,
        env={**own, **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=10 * PATIENCE,
    )


def passed(request, check, digests):
    """Those of the names in `digests` with which a check passed as they are; none in the full tests."""
    cache = getattr(request.config, "cache", None)
    last = cache.get(check, {}) if cache else {}
    right = {*rooms.kept(check).values(), *(last.values() if isinstance(last, dict) else ())}
    return set() if FULL else {name for name, digest in digests.items() if digest in right}


def keep(request, check, digests):
    """Note that a check passed with these digests."""
    if (cache := getattr(request.config, "cache", None)) is not None:
        cache.set(check, digests)


@pytest.mark.house
def test_kernels_as_plain_python_leave_no_array(request):
    """Where nothing has changed on which they depend since they passed, they pass."""
    digests = {
        "kernels": rooms.digest_of_kernels(PACKAGE, SETTINGS, ROOT / "tests", [ROOT / "tests/interpreted", *MARKED])
    }
    if not passed(request, rooms.KERNELS, digests):
        check = done([*PYTEST, *PLAIN], {"NUMBA_DISABLE_JIT": "1"})
        assert check.returncode == 0, f"{check.stdout}\n{check.stderr}"
    keep(request, rooms.KERNELS, digests)


@pytest.mark.house
def test_rooms_import_only_from_rooms_below_them():
    check = done([str(BIN / "lint-imports")], {})
    assert check.returncode == 0, f"{check.stdout}\n{check.stderr}"


def missing(fault):
    """Whether a fault is an import of a library that is not installed: `.[test]` has none for films."""
    name = re.match(r'Import "(\w+)[\w.]*" could not be resolved', fault["message"])
    return name is not None and importlib.util.find_spec(name[1]) is None


@pytest.mark.house
def test_types(request):
    """Pyright looks at the rooms that are not as they were when it found no fault there; at all of them in the full tests."""
    digests = rooms.digests_of_types(PACKAGE, SETTINGS)
    right = passed(request, rooms.TYPES, digests)
    paths = [path for name, files in rooms.rooms_of(PACKAGE).items() if name not in right for path in files]
    if paths:
        names = [str(path) for path in paths]
        check = done([str(BIN / "pyright"), "--outputjson", "--pythonpath", sys.executable, *names], {})
        try:
            found = json.loads(check.stdout)
        except json.JSONDecodeError:
            pytest.fail(f"{check.stdout}\n{check.stderr}")
        assert found["summary"]["filesAnalyzed"] == len(paths)
        faults = [each for each in found["generalDiagnostics"] if each["severity"] == "error" and not missing(each)]
        lines = [f"{each['file']}:{each['range']['start']['line'] + 1}: {each['message']}" for each in faults]
        assert not lines, "\n".join(lines)
    keep(request, rooms.TYPES, digests)


def test_types_are_checked_anew_where_a_source_or_a_setting_changed(tmp_path):
    """Of the room that changed and of those that depend on it, and of no other."""
    package, settings = tmp_path / "machines", tmp_path / "pyproject.toml"
    (package / "high").mkdir(parents=True)
    (package / "__init__.py").touch()

    def digests(low, high, side, mode="standard"):
        (package / "low.py").write_text(low, encoding="utf-8")
        (package / "high" / "top.py").write_text(f"from machines.middle import x\n{high}", encoding="utf-8")
        (package / "middle.py").write_text("def f():\n    from machines.low import x", encoding="utf-8")
        (package / "side.py").write_text(side, encoding="utf-8")
        settings.write_text(f'[tool.pyright]\ntypeCheckingMode = "{mode}"', encoding="utf-8")
        return rooms.digests_of_types(package, settings)

    def changed(other):
        return {name for name, digest in digests(*other).items() if digest != first[name]}

    first = digests("x = 1", "y = 1", "z = 1")
    assert digests("x = 1", "y = 1", "z = 1") == first
    assert changed(["x = 2", "y = 1", "z = 1"]) == {"low", "middle", "high"}
    assert changed(["x = 1", "y = 2", "z = 1"]) == {"high"}
    assert changed(["x = 1", "y = 1", "z = 2"]) == {"side"}
    assert changed(["x = 1", "y = 1", "import machines"]) == {"side"}
    assert changed(["x = 1", "y = 1", "z = 1", "strict"]) == set(first)


def test_kernels_run_anew_where_a_source_or_a_test_changed(tmp_path):
    package, tests, settings = tmp_path / "nivel", tmp_path / "tests", tmp_path / "pyproject.toml"
    for name in ("kernels", "report"):
        (package / name).mkdir(parents=True)
    tests.mkdir()
    settings.write_text("[tool.pyright]", encoding="utf-8")
    files = [package / "kernels/spring.py", tests / "test_every.py", tests / "zoo.py", tests / "stones.py"]
    others = [package / "report/page.py", tests / "test_page.py"]
    for path in (*files, *others):
        path.touch()
    files[1].write_text("import zoo", encoding="utf-8")
    files[2].write_text("def f():\n    from stones import pebble", encoding="utf-8")
    digests = [rooms.digest_of_kernels(package, settings, tests, files[1:2])]
    for path in (*files, *others):
        path.write_text(f"{path.read_text(encoding='utf-8')}\n1", encoding="utf-8")
        digests.append(rooms.digest_of_kernels(package, settings, tests, files[1:2]))
    assert len(set(digests)) == 1 + len(files)
    assert len(set(digests[len(files) :])) == 1


@pytest.mark.parametrize(
    ("text", "is_missing"),
    [
        ('Import "no_such_library.part" could not be resolved', True),
        ('Import "numpy.no_such_part" could not be resolved', False),
        ('"places" is not a known attribute of module "numpy"', False),
    ],
)
def test_of_imports_only_those_of_missing_libraries_are_no_faults(text, is_missing):
    assert missing({"message": text}) == is_missing
