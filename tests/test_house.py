"""Checks of the whole code: import layers, types, and indices of kernels, which run as plain Python in a process of their own."""

import hashlib
import importlib.util
import json
import os
import re
import subprocess
import sys
from importlib.metadata import distributions
from pathlib import Path

import pytest

from lanes import FULL
from needing import MUST_RUN
from patience import PATIENCE

ROOT = Path(__file__).parent.parent
BIN = Path(sys.executable).parent
# kernels as plain Python: their own tests, and those that are marked `plain`
MARKED = sorted(
    path for path in (ROOT / "tests").rglob("test_*.py") if "mark.plain" in path.read_text(encoding="utf-8")
)
PLAIN = ["tests/interpreted", *map(str, MARKED), *([] if FULL else ["-m", "not full"])]
PYTEST = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "no:seconds"]
# the longest first, so that it does not end alone; two processes of pytest share two processors with nothing else
CHECKS = {
    "kernels as plain Python": ([*PYTEST, *PLAIN], {"NUMBA_DISABLE_JIT": "1"}),
    "import layers": ([str(BIN / "lint-imports")], {}),
}


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


@pytest.mark.house
@pytest.mark.parametrize("name", CHECKS)
def test_the_whole_code_passes(name):
    check = done(*CHECKS[name])
    assert check.returncode == 0, f"{check.stdout}\n{check.stderr}"


def missing(fault):
    """Whether a fault is an import of a library that is not installed: `.[test]` has none for films."""
    name = re.match(r'Import "(\w+)[\w.]*" could not be resolved', fault["message"])
    return name is not None and importlib.util.find_spec(name[1]) is None


def digest_of_types(source, settings):
    """Of all that the types depend on: sources of the package, settings and the versions of what is installed."""
    files = sorted([*source.rglob("*.py"), *source.rglob("*.pyi")])
    parts = [path.relative_to(source).as_posix().encode() + path.read_bytes() for path in files]
    parts += [sys.version.encode(), settings.read_bytes()]
    parts += sorted(f"{each.name}=={each.version}".encode() for each in distributions())
    return hashlib.sha256(b"\0".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()


@pytest.mark.house
def test_types(request):
    """Where nothing has changed since they were right they are right; the full tests and CI check them in any case."""
    kept, digest = getattr(request.config, "cache", None), digest_of_types(ROOT / "src", ROOT / "pyproject.toml")
    if kept is not None and not FULL and not MUST_RUN and kept.get("nivel/types", "") == digest:
        return
    check = done([str(BIN / "pyright"), "--outputjson", "--pythonpath", sys.executable], {})
    try:
        found = json.loads(check.stdout)
    except json.JSONDecodeError:
        pytest.fail(f"{check.stdout}\n{check.stderr}")
    assert found["summary"]["filesAnalyzed"] > 800
    faults = [each for each in found["generalDiagnostics"] if each["severity"] == "error" and not missing(each)]
    lines = [f"{each['file']}:{each['range']['start']['line'] + 1}: {each['message']}" for each in faults]
    assert not lines, "\n".join(lines)
    if kept is not None:
        kept.set("nivel/types", digest)


def test_types_are_checked_anew_where_a_source_or_a_setting_changed(tmp_path):
    source, settings = tmp_path / "src", tmp_path / "pyproject.toml"
    source.mkdir()
    digests = []
    for name, text, said in (("a.py", "1", ""), ("a.py", "2", ""), ("b.py", "1", ""), ("a.py", "2", "strict")):
        (source / name).write_text(text, encoding="utf-8")
        settings.write_text(said, encoding="utf-8")
        digests.append(digest_of_types(source, settings))
    assert len(set(digests)) == len(digests)
    assert digest_of_types(source, settings) == digests[-1]


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
