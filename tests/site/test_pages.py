"""The pages of the documentation: their machines work, their Python runs, their links lead somewhere, their words are standard ones."""

import importlib
import os
import re
import shutil
import subprocess
import sys
import time
import tomllib
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import yaml

import nivel
from browsing import watched
from checking import check
from example_files import rigid_example
from lanes import tail
from needing import needs
from nivel.analysis.plan.plan import plan_run
from nivel.cli import COMMANDS
from nivel.files import parse_machine
from nivel.files.schema import schema as file_schema
from patience import PATIENCE

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
BESIDE = (
    "README.md",
    "NOTATION.md",
    "ARCHITECTURE.md",
    "CONTRIBUTING.md",
    "CHANGELOG.md",
    "SECURITY.md",
    "benchmarks/README.md",
)
PAGES = sorted([*DOCS.rglob("*.md"), *(ROOT / name for name in BESIDE)])
# pages that are made when the site is built
MADE = {
    "architecture.md",
    "benchmarks.md",
    "changelog.md",
    "cheat-sheet.md",
    "command-line.md",
    "contributing.md",
    "gallery.md",
    "keys.md",
    "notation.md",
    *(f"notebooks/{path.stem}.md" for path in (DOCS / "notebooks").glob("*.ipynb")),
}
WRITTEN_HERE = [
    "index.md",
    "python.md",
    "optimisation.md",
    *(f"tutorials/{path.name}" for path in sorted((DOCS / "tutorials").glob("*.md"))),
]


def named(path):
    return path.relative_to(ROOT).as_posix()


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def files_of(text):
    """Blocks whose first line is the name of their file."""
    found = {}
    for block in blocks(text, "yaml"):
        name = re.match(r"# (\S+\.yaml)\n", block)
        if name:
            found[name[1]] = block
    return found


@pytest.mark.parametrize("page", WRITTEN_HERE)
def test_python_of_a_page_runs_from_top_to_bottom(page, tmp_path):
    text = (DOCS / page).read_text(encoding="utf-8")
    for name, block in files_of(text).items():
        (tmp_path / name).write_text(block, encoding="utf-8")
    for example in ("suspension", "toggle"):
        shutil.copy(rigid_example(example), tmp_path)
    for model in ("quadruped.urdf", "quadruped.yaml"):
        shutil.copy(ROOT / "examples" / "robots" / model, tmp_path)
    code = "\n".join(blocks(text, "python"))
    if not code:
        pytest.skip("no Python on this page")
    before = Path.cwd()
    os.chdir(tmp_path)
    try:
        exec(compile(code, page, "exec"), {"__name__": "page"})
    finally:
        os.chdir(before)


HOW_TO = (DOCS / "how-to.md").read_text(encoding="utf-8")
ANSWERS = re.findall(r"^### … ([^\n]*)\?\n(.*?)(?=^##|\Z)", HOW_TO, re.MULTILINE | re.DOTALL)


def merged(base, part):
    """The mappings of `base` with those of `part` in place of theirs, two levels deep."""
    out = dict(base)
    for section, content in part.items():
        out[section] = {**base.get(section, {}), **content} if isinstance(content, dict) else content
    return out


def whole_of(base, block):
    """The machine file of the base with a block of an answer."""
    whole = yaml.safe_dump(merged(yaml.safe_load(base), yaml.load(block, yaml.BaseLoader)), sort_keys=False)
    return re.sub(r"'(-?[\d.]+(?:e-?\d+)?|true|false)'", r"\1", whole)


@pytest.mark.parametrize(("question", "answer"), ANSWERS, ids=[question for question, _ in ANSWERS])
def test_every_answer_is_a_machine_that_can_be_run(question, answer):
    (base,) = files_of(HOW_TO).values()
    for block in blocks(answer, "yaml"):
        whole = whole_of(base, block)
        machine = parse_machine(whole, question)
        plan_run(machine)
        check(machine)


def result_of(question, folder):
    """The run of the machine of an answer; it is reliable."""
    (base,), (block,) = files_of(HOW_TO).values(), blocks(dict(ANSWERS)[question], "yaml")
    file = folder / "machine.yaml"
    file.write_text(whole_of(base, block), encoding="utf-8")
    result = nivel.load(file).simulate()
    assert result.trust.verdict == "green"
    return result


def test_a_part_in_a_gripper_is_held_without_creep(tmp_path):
    result = result_of("model a gripper", tmp_path)
    # two pads, each pressed by half the grip of 60 N, each carry half the weight
    assert np.abs(result.array("part.velocity")[-1]).max() < 1e-9
    for pad in ("left_pad", "right_pad"):
        assert result.array(f"force.{pad}.normal_force")[-1] == pytest.approx(30.0, rel=1e-3)
        assert result.array(f"force.{pad}.friction_force")[-1] == pytest.approx(0.25 * 9.81, rel=1e-3)


def test_a_tyre_rolls_and_is_pressed_by_its_weight(tmp_path):
    result = result_of("model a tyre", tmp_path)
    weight = 20 * 9.81
    assert result.array("force.tyre.magnitude")[-1] == pytest.approx(weight, rel=1e-3)
    height = result.array("wheel.position")[-1, 2]
    assert result.array("force.tyre.deflection")[-1] == pytest.approx(0.301 - height, rel=1e-6)
    rate = result.array("wheel.angular_velocity")[-1, 1]
    # 0.375 of the deflection, as many times as its load is the nominal one, are not followed by the radius with which it rolls
    radius = 0.301 - (1.0 - 0.375 * weight / 4e3) * (0.301 - height)
    assert result.array("wheel.velocity")[-1, 0] == pytest.approx(radius * rate, rel=1e-3)


def test_a_ball_screw_advances_by_its_pitch(tmp_path):
    result = result_of("model a ball screw", tmp_path)
    turned, moved = result.array("bearing.angle"), result.array("rail.displacement")
    assert np.ptp(moved) > 0.01
    np.testing.assert_allclose(moved, 5e-3 / (2 * np.pi) * turned, atol=1e-9)


def test_an_angle_is_seen_in_degrees(tmp_path):
    result = result_of("get results in degrees", tmp_path)
    assert result.units("sensor.swing") == "deg"
    np.testing.assert_allclose(result.array("sensor.swing"), np.degrees(result.array("hinge.angle")), rtol=1e-12)


@pytest.mark.parametrize("question", [question for question, answer in ANSWERS if blocks(answer, "python")])
def test_python_of_an_answer_runs(question, tmp_path, monkeypatch):
    for name, block in files_of(HOW_TO).items():
        (tmp_path / name).write_text(block, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    (code,) = blocks(dict(ANSWERS)[question], "python")
    names = {"__name__": "page"}
    exec(compile(code, question, "exec"), names)
    assert names["result"].trust.verdict == "green"


@pytest.mark.skipif(shutil.which("bash") is None, reason="no Bash on this machine")
@pytest.mark.parametrize(
    ("typed", "offered"), [("de", "demo"), ("demo ex", "excavator"), ("run --inte", "--integrator")]
)
def test_bash_completes_what_is_typed(typed, offered):
    (line,) = blocks(dict(ANSWERS)["complete commands in the shell"], "bash")
    words = ["nivel", *typed.split()]
    ask = f"{line}\nCOMP_WORDS=({' '.join(words)}); COMP_CWORD={len(words) - 1}; _nivel_completion nivel; echo ${{COMPREPLY[*]}}"
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    done = subprocess.run(
        ["bash", "-c", ask], capture_output=True, text=True, check=True, env={**os.environ, "PATH": path}
    )
    assert offered in done.stdout.split()


METHODS = (DOCS / "methods.md").read_text(encoding="utf-8")
BOX = METHODS[METHODS.index("Which method?</p>") : METHODS.index("## Coordinates")]


@pytest.mark.parametrize("settings", re.findall(r"`(\{.*?\})`", BOX))
def test_the_box_of_methods_names_settings_that_run(settings, tmp_path):
    (base,) = files_of(HOW_TO).values()
    file = tmp_path / "base.yaml"
    file.write_text(base, encoding="utf-8")
    result = nivel.load(file).with_settings({**yaml.safe_load(settings), "duration": 0.05}).simulate()
    assert result.trust.verdict == "green"


def test_there_are_thirty_answers():
    assert len(ANSWERS) >= 30


def anchors(text):
    """Anchors of the headings of a page, as MkDocs and GitHub make them."""
    bare = re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)
    titles = re.findall(r"^#+ (.+)$", bare, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", re.sub(r"[`*]", "", title).lower()).strip().replace(" ", "-") for title in titles}


@pytest.mark.parametrize("path", PAGES, ids=named)
def test_links_of_a_page_lead_somewhere(path):
    text = path.read_text(encoding="utf-8")
    bare = re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)
    for target, anchor in re.findall(r"\]\((?!http)([^)#\s]*)(?:#([^)\s]+))?\)", bare):
        place = (path.parent / target).resolve() if target else path
        if place.name in MADE and place.parent == DOCS:
            continue
        assert place.exists(), f"{named(path)}: {target}"
        if anchor and place.suffix == ".md":
            assert anchor in anchors(place.read_text(encoding="utf-8")), f"{named(path)}: {target}#{anchor}"


def test_every_page_stands_in_the_navigation_or_is_a_guide():
    text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    for path in DOCS.rglob("*.md"):
        page = path.relative_to(DOCS).as_posix()
        assert page in text or "/" not in page, page
    for page in re.findall(r"[\w/-]+\.md", text[text.index("nav:") :]):
        assert page in MADE or (DOCS / page).exists(), page


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The site without its pictures, built without a warning."""
    needs("mkdocs", "material", "mkdocstrings")
    # the processes of one run of the tests share it: the first builds, others wait
    base = tmp_path_factory.getbasetemp()
    shared = (base.parent if os.environ.get("PYTEST_XDIST_WORKER") else base) / "pages"
    folder, built = shared / "site", shared / "built"
    try:
        shared.mkdir()
    except FileExistsError:
        end = time.monotonic() + PATIENCE
        while not built.exists():
            assert time.monotonic() < end, "the site was not built by the process that began"
            time.sleep(0.1)
        assert not built.read_text(encoding="utf-8")
        return folder
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(folder)]
    own = {**os.environ, "NIVEL_SITE_PICTURES": "0"}
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False, env=own)
    built.write_text("" if done.returncode == 0 else done.stderr or "failed", encoding="utf-8")
    assert done.returncode == 0, done.stderr
    return folder


@pytest.mark.full
def test_no_page_of_the_site_fetches_anything(site):
    assert (site / "api.html").exists()
    for page in site.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        assert not re.findall(r'<(?:script|img|iframe|link)\b[^>]*?(?:src|href)="?(?:https?:)?//[^>]*', text), page


def test_the_first_page_frames_nothing_that_was_left_out(site):
    """Without pictures there is no page for the frame in which the crane works."""
    text = (site / "index.html").read_text(encoding="utf-8")
    for place in re.findall(r'<(?:iframe|img)\b[^>]*?src="?([^">#\s]+)', text):
        assert (site / place).exists(), place
    assert "viewer.png" in text


def test_the_keys_of_a_machine_file_stand_on_one_screen(site, browser):
    with watched(browser, width=1280, height=800) as seen:
        seen.page.goto((site / "cheat-sheet.html").as_uri())
        sheet = seen.page.locator(".sheet").bounding_box()
        assert sheet["x"] + sheet["width"] <= 1280
        assert sheet["y"] + sheet["height"] <= 1.05 * 800
        size = seen.page.evaluate("getComputedStyle(document.querySelector('.sheet')).fontSize")
        assert float(size.removesuffix("px")) >= 8


@cache
def keys_of_the_schema():
    """(kind, keys) of all elements in the schema that editors use, which is made of what reads a machine file."""
    found = [each.get("properties", {}) for each in file_schema()["$defs"].values()]
    return [(each.get("type", {}).get("const", ""), set(each) - {"type", "name"}) for each in found]


@pytest.mark.parametrize(("module", "page"), [("cheat_sheet", "cheat_sheet"), ("reference", "key_page")])
def test_every_key_stands_on_the_pages_of_keys(module, page, monkeypatch):
    monkeypatch.syspath_prepend(str(DOCS / "site"))
    text = getattr(importlib.import_module(module), page)()
    words = set(re.findall(r"[\w-]+", re.sub(r"</?(?:b|i|u)>", " ", text)))
    found = [kind for kind, _ in keys_of_the_schema()]
    assert len(found) > 60
    words |= {"markers", "bodies", "points"} if "ends" in words else set()
    assert {kind for kind in found if kind} <= words
    assert set().union(*(keys for _, keys in keys_of_the_schema())) <= words
    assert set(file_schema()["properties"]) <= words


# the deeper page has the longer way to the index
@pytest.mark.parametrize("start", tail(["index.html", "tutorials/pendulum.html"], ["tutorials/pendulum.html"]))
def test_the_site_is_searched_when_it_is_opened_from_a_disk(site, browser, start):
    with watched(browser) as seen:
        page = seen.page
        seen.context.set_offline(True)
        page.goto((site / start).as_uri())
        page.get_by_role("textbox", name="Search").fill("Baumgarte")
        found = page.locator(".md-search-result__link", has_text="Baumgarte").first
        found.wait_for()
        found.click()
        page.wait_for_url(lambda address: start not in address)
        assert "baumgarte" in page.locator("article").inner_text().lower()


def test_the_gallery_begins_with_crane_excavator_and_robot_and_goes_on_by_folder(monkeypatch):
    monkeypatch.syspath_prepend(str(DOCS / "site"))
    gallery = importlib.import_module("gallery")
    page, _ = gallery.gallery(False)
    begin, *groups = page.split("\n## ")
    assert re.findall(r"\[([\w-]+)\]\(", begin) == ["loader-crane", "excavator", "six-axis-arm"]
    shown = re.findall(r"\]\(files/([^)]+)\)", page)
    assert sorted(shown) == sorted(path.relative_to(ROOT).as_posix() for path in gallery.examples())
    for group in groups:
        title = group.partition("\n")[0]
        folders = {place.split("/")[1] for place in re.findall(r"\]\(files/([^)]+)\)", group)}
        assert folders == {title.lower().replace(" ", "-")}


@pytest.mark.full
def test_every_example_has_a_picture_in_the_gallery(monkeypatch):
    needs("gmsh")
    monkeypatch.syspath_prepend(str(DOCS / "site"))
    gallery = importlib.import_module("gallery")
    page, drawn = gallery.gallery(True)
    assert len(drawn) == len(gallery.examples()) == page.count("![")
    assert all("<path" in svg or "<line" in svg or "<poly" in svg for svg in drawn.values())


def test_the_site_is_built_by_the_versions_that_its_page_names():
    needed = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    assert any(re.fullmatch(r"mkdocs-material>=9\.\d+,<10", each) for each in needed["docs"])
    assert any(re.fullmatch(r"mkdocs>=1\.\d+,<2", each) for each in needed["docs"])


def test_the_page_of_all_functions_names_every_command():
    text = (DOCS / "features.md").read_text(encoding="utf-8")
    assert {name for name in COMMANDS if f"| `nivel {name}" not in text} == set()
