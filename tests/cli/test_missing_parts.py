"""A library that is missing is told before anything is loaded, computed or compiled, by every command that needs one."""

import sys

import pytest
from click.testing import CliRunner

import nivel.api
from nivel.cli import main
from nivel.errors import ModelError
from nivel.extras import LIBRARIES, is_installed, require
from nivel.flexible.model import solid_source
from nivel.native import library, workers
from nivel.results import Result
from nivel.view import capture

NEEDING = [
    (["demo"], "websockets", "the page needs websockets: pip install websockets"),
    (["live", "x.yaml"], "websockets", "the page needs websockets: pip install websockets"),
    (["view", "x.yaml"], "websockets", "the page needs websockets: pip install websockets"),
    (["view", "x.nc"], "websockets", "the page needs websockets: pip install websockets"),
    (["view", "x.nc", "--still", "a.png"], "websockets", "pictures and films need websockets: pip install websockets"),
    (["view", "x.nc", "--export", "a.gif"], "PIL", "a .gif film needs pillow: pip install 'nivel[film]'"),
    (["view", "x.nc", "--export", "a.mp4"], "imageio_ffmpeg", "an .mp4 film needs ffmpeg: install it, or pip install"),
    (["stress", "x.nc", "--node", "1", "--plot", "a.png"], "matplotlib", "plots need matplotlib: pip install"),
    (["reduce", "solid.yaml"], "gmsh", "a `solid` needs gmsh: pip install 'nivel[flex]'"),
]
SOLID = """format: 1
name: block
materials: {steel: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}}
solid: {file: part.step, material: steel, element_size: 0.1}
interfaces: {root: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}, tie: rigid}}
reduction: {modes: 2}
"""


def refused(*_given, **_more):
    pytest.fail("something was loaded or compiled before the missing part was told")


@pytest.mark.parametrize(
    ("words", "missing", "message"), NEEDING, ids=lambda each: " ".join(each) if isinstance(each, list) else ""
)
def test_a_missing_part_is_told_first(words, missing, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "solid.yaml").write_text(SOLID)
    monkeypatch.setitem(sys.modules, missing, None)
    monkeypatch.setattr(capture.shutil, "which", lambda _name: None)
    monkeypatch.setattr(capture, "find_browser", lambda: "chromium")
    monkeypatch.setattr(nivel.api, "load", refused)
    monkeypatch.setattr(Result, "open", refused)
    monkeypatch.setattr(solid_source, "meshed", refused)
    for module, name in ((library, "missing"), (workers, "compile_all")):
        monkeypatch.setattr(module, name, refused)
    done = CliRunner().invoke(main, words)
    assert message in done.output
    assert done.exit_code == 2


def test_all_missing_libraries_are_told_at_once(monkeypatch):
    for name in ("gmsh", "meshio"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ModelError) as told:
        require("a `solid` needs", "gmsh", "skfem", "meshio")
    assert [each.message.split()[3] for each in told.value.faults] == ["gmsh:", "meshio:"]


def test_the_page_of_a_film_needs_a_browser_before_its_result_is_read(tmp_path, monkeypatch):
    monkeypatch.setattr(capture, "PLACES", ())
    monkeypatch.setattr(capture.shutil, "which", lambda _name: None)
    monkeypatch.setattr(capture, "find_browser", lambda: None)
    monkeypatch.setattr(Result, "open", refused)
    done = CliRunner().invoke(main, ["view", "x.nc", "--still", str(tmp_path / "a.png")])
    assert done.exit_code == 2
    assert "browser" in done.output


def test_no_library_is_loaded_to_see_whether_it_is_there(monkeypatch):
    for name in LIBRARIES:
        monkeypatch.delitem(sys.modules, name, raising=False)
        is_installed(name)
        assert name not in sys.modules
