"""The block diagram of a machine: a box for each element, lines between what hangs together, an arrow for each signal, and its lines in the
file."""

import json

import pytest

from browsing import watched
from nivel.files import parse_machine
from nivel.looks.diagram import LARGEST, block_diagram
from nivel.view.page import built

TEXT = """
format: 1
bodies:
  arm: {mass: 3, centre_of_mass: [0.5, 0, 0], inertia: [0.1, 0.3, 0.3]}
  tip:
    mass: 1
    inertia: [1, 1, 1]

markers:
  grip: {body: tip, position: [1, 0, 0]}
joints:
  boom: {type: revolute, bodies: [ground, arm], point: [0, 0, 0], axis: [0, 0, 1]}
  wrist: {type: fixed, bodies: [arm, tip], point: [1, 0, 0]}
control:
  wish: {type: signal, value: sin(time)}
  hold: {type: pid, reference: wish, measured: boom.angle + 0.1*late, kp: 3, sample_time: 2 ms}
  late: {type: low-pass, input: hold, time_constant: 1}
  felt: {type: gain, input: grip.position.x, gain: 2}
forces:
  drive: {type: motor, coordinate: boom, effort: hold}
  spring: {type: spring-damper, bodies: [ground, tip], points: [[0, 1, 0], [1, 0, 0]], stiffness: 10, free_length: 1}
hydraulics:
  tank: {type: tank}
  feed: {type: flow-source, flow: 1 L/min, ports: {A: tank, B: line}}
  valve: {type: orifice, diameter: 2 mm, opening: hold, ports: {A: line, B: tank}}
  line: {type: volume, volume: 1 L}
"""


def boxes(text=TEXT):
    return block_diagram(parse_machine(text).model_dump(mode="json", by_alias=True), text)


def links(found, kind):
    return {(box.name, found[number].name) for box in found for number in getattr(box, kind)}


def test_what_hangs_together_is_joined_and_what_is_measured_is_read():
    found = boxes()
    assert {box.name: box.kind for box in found} == {
        "ground": "body",
        "arm": "body",
        "tip": "body",
        "boom": "joint",
        "wrist": "joint",
        "drive": "element",
        "spring": "element",
        "valve": "circuit",
        "wish": "block",
        "hold": "sampled",
        "late": "block",
        "felt": "block",
        "circuit": "circuit",
    }
    assert links(found, "joins") == {
        ("boom", "ground"),
        ("boom", "arm"),
        ("wrist", "arm"),
        ("wrist", "tip"),
        ("drive", "boom"),
        ("spring", "ground"),
        ("spring", "tip"),
        ("circuit", "valve"),
    }
    signals = {
        ("hold", "wish"),
        ("hold", "boom"),
        ("hold", "late"),
        ("late", "hold"),
        ("felt", "tip"),
        ("drive", "hold"),
    }
    assert links(found, "reads") == signals | {("valve", "hold")}
    assert next(box.words for box in found if box.name == "hold") == "pid · 2 ms"
    assert found[-1].words == "3 components"


def test_a_box_has_its_lines_of_the_file():
    lines = {box.name: (box.line, box.lines) for box in boxes()}
    assert lines["tip"] == (5, "  tip:\n    mass: 1\n    inertia: [1, 1, 1]")
    for name in ("arm", "wrist", "hold", "spring", "valve"):
        number, text = lines[name]
        assert text == TEXT.splitlines()[number - 1]
        assert text.startswith(f"  {name}: ")
    assert lines["ground"] == lines["circuit"] == (0, "")
    assert all(box.line == 0 for box in block_diagram(parse_machine(TEXT).model_dump(mode="json"), "<robot/>"))


def test_a_single_body_and_a_crowd_have_no_diagram():
    start, end = TEXT.index("  tip:"), TEXT.index("control:")
    one = "format: 1\nbodies: {ball: {mass: 1, inertia: [1, 1, 1]}}\n"
    assert boxes(one) == []
    many = "".join(f"  b{k}: {{mass: 1, inertia: [1, 1, 1]}}\n" for k in range(LARGEST))
    assert boxes(TEXT[:start] + many + TEXT[start:end]) == []


# what stands in the picture, after a click on a box and with the pointer on it
SEEN = """() => {
  const box = (g) => {
    const { x, y, width, height } = g.querySelector("rect").getBBox();
    return [g.querySelector("title").textContent, x, y, width, height];
  };
  const hold = [...document.querySelectorAll("g.sampled")].find((g) => g.textContent.startsWith("hold"));
  hold.dispatchEvent(new Event("click"));
  hold.dispatchEvent(new Event("pointerenter"));
  const picture = document.querySelector("svg.block-diagram");
  return { boxes: [...picture.querySelectorAll("g")].map(box), joins: picture.querySelectorAll("path.join").length,
    signals: picture.querySelectorAll("path.signal").length, marked: picture.querySelectorAll("path.marked").length,
    lines: document.querySelector("pre.lines").textContent, wide: +picture.getAttribute("width") };
}"""


def test_the_page_lays_boxes_out_and_shows_lines_at_a_click(tmp_path, browser):
    found = boxes()
    data = json.dumps([vars(box) for box in found])
    path = tmp_path / "diagram.html"
    body = f'<script type="application/json" id="blocks">{data}</script><script>{built("diagram.js")}</script>'
    path.write_text(
        f'<!doctype html><meta charset="utf-8"><style>{built("diagram.css")}</style><body>{body}', encoding="utf-8"
    )
    with watched(browser) as watching:
        watching.page.goto(path.as_uri())
        seen = watching.page.evaluate(SEEN)
    assert len(seen["boxes"]) == len(found)
    for k, (name, x, y, width, height) in enumerate(seen["boxes"]):
        assert 0 <= x <= x + width <= seen["wide"], name
        for _, u, v, wide, high in seen["boxes"][:k]:
            assert x + width <= u or u + wide <= x or y + height <= v or v + high <= y
    assert (seen["joins"], seen["signals"]) == (8, 7)
    assert seen["marked"] == 6  # of hold: three that it reads, three that read it
    number = next(box.line for box in found if box.name == "hold")
    assert seen["lines"].strip() == f"{number}    {TEXT.splitlines()[number - 1].strip()}"
    places = {name.partition(",")[0]: x for name, x, *_ in seen["boxes"]}
    assert places["ground"] < places["boom"] < places["arm"] < places["wrist"] < places["tip"]
    assert places["wish"] < places["hold"] < places["drive"]


@pytest.mark.parametrize("text", ["", "[1, 2", "- a\n- b"])
def test_what_is_no_machine_file_has_no_lines(text):
    found = block_diagram(parse_machine(TEXT).model_dump(mode="json"), text)
    assert found
    assert not any(box.line for box in found)
