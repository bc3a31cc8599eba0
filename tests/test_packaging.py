"""Wheels: what is in them, and what is refused. Here of a package of a few files; a whole one is checked when it is built."""

import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest
import yaml

import check_wheel
from nivel.native import shipped
from nivel.native.processor import LEVELS

ROOT = Path(__file__).parent.parent
SYSTEM = "manylinux_2_17_x86_64"
SHIPPED = "src/nivel/native/shipped"


@pytest.fixture
def project(tmp_path):
    """What building a wheel reads, with a package that has next to no code."""
    folder = tmp_path / "project"
    for name in (
        "pyproject.toml",
        "README.md",
        "LICENSE",
        "packaging/hatch_build.py",
        "src/nivel/__init__.py",
        "src/nivel/view/page/NOTICE",
    ):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, folder / name)
    shutil.copy(ROOT / ".gitignore", folder)
    return folder


@pytest.fixture
def with_library(project):
    """The same with files where the library would be."""
    (project / SHIPPED).mkdir(parents=True)
    for name in ("manifest.json", *map(shipped.file_of, LEVELS)):
        (project / SHIPPED / name).write_text("{}")
    (project / SHIPPED / "NOTICE").write_text("functions of Numba")
    return project


def build(project, what, system=""):
    """Run hatchling: the file that it made, or what it said."""
    out = project.parent / "out"
    done = subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "-t", what, "-d", out],
        cwd=project,
        env={**os.environ, "NIVEL_SHIPPED_FOR": system},
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        return done.stderr
    (found,) = out.iterdir()
    return found


def licences(names):
    return {name.partition("/licenses/")[2] for name in names if ".dist-info/licenses/" in name}


def test_a_wheel_with_the_library_is_for_one_system_and_carries_every_licence(with_library):
    wheel = build(with_library, "wheel", SYSTEM)
    assert wheel.name.endswith(f"-py3-none-{SYSTEM}.whl")
    assert check_wheel.faults(wheel) == []
    with zipfile.ZipFile(wheel) as packed:
        names = packed.namelist()
        (text,) = (packed.read(name).decode() for name in names if name.endswith("licenses/src/nivel/view/page/NOTICE"))
    assert licences(names) == {"LICENSE", "src/nivel/view/page/NOTICE", f"{SHIPPED}/NOTICE"}
    assert "three.js authors" in text
    assert "Leon Sorokin" in text  # of uPlot
    assert {f"nivel/native/shipped/{shipped.file_of(level)}" for level in LEVELS} <= {*names}


def test_a_plain_wheel_and_the_sources_carry_the_licences_of_the_page(project):
    wheel = build(project, "wheel")
    assert wheel.name.endswith("-py3-none-any.whl")
    with zipfile.ZipFile(wheel) as packed:
        assert licences(packed.namelist()) == {"LICENSE", "src/nivel/view/page/NOTICE"}
    assert check_wheel.faults(wheel) == ["it has no machine code", "it needs Numba", "its licences lack shipped/NOTICE"]
    with pytest.raises(check_wheel.UnfitWheelError, match="it has no machine code, and it needs Numba"):
        check_wheel.check(wheel)
    wheel.unlink()
    with tarfile.open(build(project, "sdist")) as packed:
        names = packed.getnames()
    for licence in ("LICENSE", "src/nivel/view/page/NOTICE"):
        assert any(name.endswith(f"/{licence}") for name in names)


def test_every_library_in_the_page_has_its_licence():
    """What the page imports from outside, by the first part of the name."""
    sources = (path.read_text(encoding="utf-8") for path in (ROOT / "viewer/src").rglob("*.ts"))
    used = {name for text in sources for name in re.findall(r"(?:from|import) \"([a-z][^/\"]*|@[^/\"]+/[^/\"]+)", text)}
    notice = (ROOT / "src/nivel/view/page/NOTICE").read_text(encoding="utf-8")
    assert used == {"three", "uplot", "@dagrejs/dagre"}
    assert used == {part.strip().splitlines()[0] for part in notice.split("\n---\n")}


def test_a_wheel_for_one_system_without_a_library_is_refused(project):
    assert f"{SHIPPED} has no library for {SYSTEM}" in build(project, "wheel", SYSTEM)


def test_the_package_of_another_folder_is_not_packed(tmp_path):
    """As where the environment of another checkout starts the script."""
    (tmp_path / "nivel").mkdir()
    (tmp_path / "nivel/__init__.py").write_text("")
    out = tmp_path / "out"
    done = subprocess.run(
        [sys.executable, ROOT / "packaging/build_wheel.py", out],
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert f"this would compile {tmp_path / 'nivel'} and pack {ROOT / 'src/nivel'}" in done.stderr
    assert "Traceback" not in done.stderr
    assert not out.exists()


def test_continuous_integration_builds_wheels_where_what_is_compiled_is_packed():
    job = yaml.safe_load((ROOT / ".github/workflows/ci.yml").read_text(encoding="utf-8"))["jobs"]["wheels"]
    lines = [step["run"] for step in job["steps"] if "run" in step]
    (build,) = (k for k, line in enumerate(lines) if "packaging/build_wheel.py" in line)
    (install,) = (k for k, line in enumerate(lines) if "pip install" in line)
    assert "--editable ." in lines[install]
    assert install < build


def test_examples_of_the_check_exist():
    for lines in check_wheel.KINDS.values():
        for line in lines:
            assert (check_wheel.EXAMPLES / line.split()[1]).is_file()
    assert {*check_wheel.KINDS} == {"rigid bodies", "beams", "flexible body", "hydraulics", "control"}
