"""The block diagram of a control: a box for each block, what it measures and what it acts on, and an arrow for each signal."""

import re
import xml.etree.ElementTree as ET

from nivel.files import parse_machine
from nivel.report.control_diagram import WIDE, control_diagram

TEXT = """
format: 1
bodies:
  arm: {mass: 3, centre_of_mass: [0.5, 0, 0], inertia: [0.1, 0.3, 0.3]}
joints:
  boom: {type: revolute, bodies: [ground, arm], point: [0, 0, 0], axis: [0, 0, 1]}
control:
  wish: {type: signal, value: sin(time)}
  hold: {type: pid, reference: wish, measured: boom.angle + 0.1*late, kp: 3, sample_time: 2 ms}
  late: {type: low-pass, input: hold, time_constant: 1}
forces:
  drive: {type: motor, coordinate: boom, effort: hold}
"""


def drawn(text):
    return control_diagram(parse_machine(text).model_dump(mode="json"))


def boxes(svg):
    root = ET.fromstring(svg)
    found = {}
    for group in root.findall("g"):
        box = group.find("rect")
        found[group.find("title").text] = (group.get("class"), float(box.get("x")), float(box.get("y")))
    return found


def test_each_block_signal_and_actuator_has_a_box_in_the_order_of_the_flow():
    found = boxes(drawn(TEXT))
    assert {name: kind for name, (kind, *_) in found.items()} == {
        "wish": "continuous",
        "hold": "sampled",
        "late": "continuous",
        "boom.angle": "measured",
        "drive": "acting",
    }
    assert found["wish"][1] < found["hold"][1] < found["drive"][1]
    assert found["boom.angle"][1] < found["hold"][1]


def test_boxes_do_not_overlap_and_arrows_are_as_many_as_signals():
    svg = drawn(TEXT)
    places = [(x, y) for _, x, y in boxes(svg).values()]
    assert len(set(places)) == len(places)
    assert all(abs(a - c) >= WIDE or abs(b - d) >= 40 for a, b in places for c, d in places if (a, b) != (c, d))
    assert len(re.findall('class="tip"', svg)) == 5
    assert len(re.findall('class="back"', svg)) == 1


def test_a_machine_without_control_has_no_diagram():
    start, end = TEXT.index("control:"), TEXT.index("forces:")
    assert drawn(TEXT[:start] + TEXT[end:].replace("effort: hold", "effort: 1")) == ""
