"""The extra `test` has what tests import; what further tests need is skipped with a reason, or fails in CI."""

import ast
import re
import sys
import tomllib
from pathlib import Path

import pytest

import needing

ROOT = Path(__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
EXTRAS = PROJECT["project"]["optional-dependencies"]
DEPENDENCIES = PROJECT["tool"]["hatch"]["metadata"]["hooks"]["custom"]["dependencies"]
# where tests find modules of the repository, and packages whose distributions have another name
FOLDERS = ("tests", "examples", "packaging", "benchmarks", "docs/site")
INSTALLED_AS = {"yaml": "pyyaml", "skfem": "scikit-fem"}


@pytest.mark.parametrize(("in_ci", "outcome"), [(False, pytest.skip.Exception), (True, pytest.fail.Exception)])
def test_a_missing_library_is_a_skip_with_a_reason_and_a_failure_in_ci(monkeypatch, in_ci, outcome):
    monkeypatch.setattr(needing, "MUST_RUN", in_ci)
    with pytest.raises(outcome, match=r"no_such_library, which `pip install --editable '\.\[dev\]'` installs"):
        needing.needs("pathlib", "no_such_library")
    assert needing.needs("pathlib", "ast") is ast


def installed_by(extra):
    """Names of the distributions that an extra installs, by those that it includes as well."""
    for requirement in EXTRAS[extra]:
        name, more = re.match(r"([\w-]+)(?:\[([\w,-]+)\])?", requirement).groups()
        if name == PROJECT["project"]["name"]:
            for each in more.split(","):
                yield from installed_by(each)
        else:
            yield name


def imported(path):
    """Names of the packages that a file imports wherever it does."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (each.name.partition(".")[0] for each in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module.partition(".")[0]


def test_all_that_tests_import_is_in_the_extra_for_tests():
    """What is asked for by `needs` is in `dev`: that of the site, of notebooks and of films is no part of `test`."""
    files = [path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py")]
    own = {name for path in files for name in (path.stem, path.parent.name)}
    known = {
        *installed_by("test"),
        *(re.match(r"[\w-]+", each)[0] for each in DEPENDENCIES),
        "numba",
        "llvmlite",
        "nivel",
    }
    for path in sorted((ROOT / "tests").rglob("*.py")):
        for name in set(imported(path)) - sys.stdlib_module_names - own:
            assert INSTALLED_AS.get(name, name) in known, f"{path.relative_to(ROOT)} imports {name}"


def test_everything_is_in_the_extra_for_development():
    further = {"asammdf", "fmpy", "mcap", "mcap-ros2-support", "pyarrow"}
    own = set().union(
        *(
            installed_by(extra)
            for extra in ("test", "docs", "film", "robots", "gym", "mqtt", "opcua", "search", "shapes")
        )
    )
    assert set(installed_by("dev")) == own | further
    assert {"mkdocs", "ipykernel", "pillow"}.isdisjoint(installed_by("test"))
