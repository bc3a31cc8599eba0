"""The diagram of circuits: no line crosses a symbol, no two lines lie upon each other, no words are over others."""

import re
import xml.etree.ElementTree as ET
from itertools import combinations
from pathlib import Path

import pytest

import nivel
from nivel.elements.circuits import COMPONENTS
from nivel.files import parse_machine
from nivel.looks.circuit.drawing import circuit_diagram, laid_out
from nivel.looks.circuit.parts import circuit_of

FILES = sorted((Path(__file__).parents[2] / "examples" / "hydraulics").glob("*.yaml"))
SVG = "{http://www.w3.org/2000/svg}"
WITHOUT_SYMBOL = {"volume", "reservoir"}  # a line, and a tank at the end of each line that leads there

FORTY = Path("forty-components")  # no file: a machine of seven functions

each_example = pytest.mark.parametrize("path", [*FILES, FORTY], ids=lambda path: path.stem)


def forty_components():
    """A record with seven functions on one pump, each with section, counterbalance valve, check valve and cylinder."""
    parts = [
        {"name": "tank", "type": "tank", "pressure": 2e5},
        {"name": "supply", "type": "volume"},
        {"name": "ls", "type": "load-sensing", "ports": {}},
        {"name": "pump", "type": "pump", "ports": {"A": "tank", "B": "supply", "LS": "ls"}, "margin": 2e6},
        {"name": "relief", "type": "relief-valve", "ports": {"P": "supply", "T": "tank"}, "opens_at": 2.3e7},
    ]
    for k in range(7):
        own, load = {"P": "supply", "T": "tank", "A": f"line_{k}", "B": f"ram_{k}.B", "LS": "ls"}, f"ram_{k}.A"
        compensation = "post" if k % 2 else "pre"
        parts += [
            {"name": f"section_{k}", "type": "section", "compensation": compensation, "margin": 7e5, "ports": own},
            {"name": f"line_{k}", "type": "volume"},
            {
                "name": f"hold_{k}",
                "type": "counterbalance-valve",
                "ports": {"L": load, "V": own["A"], "X": own["B"]},
                "opens_at": 1.8e7,
            },
            {"name": f"refill_{k}", "type": "check-valve", "ports": {"A": "tank", "B": own["B"]}},
            {"name": f"ram_{k}", "type": "cylinder"},
        ]
    return {"hydraulics": parts}


def record_of(path):
    if path is FORTY:
        return forty_components()
    return parse_machine(path.read_text(encoding="utf-8"), path).model_dump(mode="json")


def drawn(path):
    circuit = circuit_of(record_of(path))
    return circuit, laid_out(circuit)


def pieces(drawing):
    """(node, x0, y0, x1, y1) of all straight pieces of lines."""
    for line in drawing.lines:
        for (x0, y0), (x1, y1) in zip(line.points, line.points[1:], strict=False):
            yield line.node, min(x0, x1), min(y0, y1), max(x0, x1), max(y0, y1)


def boxes(circuit):
    """(x0, y0, x1, y1) of symbols with their words."""
    for part in circuit.parts:
        wide, high = part.symbol.wide, part.symbol.high
        yield part.x - wide, part.y - high + 0.5, part.x + wide, part.y + high - 0.5
        half = 6.5 * (len(part.words) + 1)
        yield part.x + wide + 6, part.y - half, part.x + wide + 6 + part.label_width, part.y + half


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


@each_example
def test_lines_cross_no_symbol_and_no_words(path):
    circuit, drawing = drawn(path)
    for box in boxes(circuit):
        for node, *piece in pieces(drawing):
            assert not overlap(box, piece), node


@each_example
def test_lines_of_different_nodes_do_not_lie_upon_each_other(path):
    _, drawing = drawn(path)
    for (one, *a), (other, *b) in combinations(pieces(drawing), 2):
        if one != other:
            level = a[1] == a[3] and b[1] == b[3] and abs(a[1] - b[1]) < 2 and a[0] < b[2] and b[0] < a[2]
            upright = a[0] == a[2] and b[0] == b[2] and abs(a[0] - b[0]) < 2 and a[1] < b[3] and b[1] < a[3]
            assert not level, (one, other)
            assert not upright, (one, other)


@each_example
def test_no_words_are_over_others(path):
    circuit, drawing = drawn(path)
    labels = [(label.x, label.y - 9, label.x + label.wide, label.y + 2) for label in drawing.labels]
    for a, b in combinations([*boxes(circuit), *labels], 2):
        assert not overlap(a, b)
    for label in labels:
        assert not any(overlap(label, piece) for _, *piece in pieces(drawing))


@each_example
def test_every_pin_of_a_component_is_on_a_line_or_at_a_tank(path):
    circuit, drawing = drawn(path)
    ends = {(round(x, 3), round(y, 3)) for line in drawing.lines for x, y in line.points[:1]}
    ends |= {(round(x, 3), round(y, 3)) for x, y, *_ in drawing.tanks}
    for _, part, port in circuit.pins():
        above = port in part.symbol.above
        x = part.x + (part.symbol.above if above else part.symbol.below)[port]
        assert (round(x, 3), round(part.y + (-part.symbol.high if above else part.symbol.high), 3)) in ends


def test_the_pressures_at_the_start_stand_at_the_nodes():
    path = next(each for each in FILES if each.stem == "cylinder-boom")
    facts = nivel.load(path).check()
    root = ET.fromstring(circuit_diagram(record_of(path), facts.pressures))
    found = {span.get("data-pressure"): span.text for span in root.iter() if span.get("data-pressure")}
    assert set(found) == {"supply.pressure", "lift.pressure_A", "lift.pressure_B"}
    for name, text in found.items():
        assert float(text.removesuffix(" bar")) == pytest.approx(facts.pressures[f"hydraulics.{name}"] / 1e5, rel=1e-3)


def test_lines_have_the_colours_of_their_pressures():
    """Red at the highest pressure, blue at none; each says which result it follows, so that pages change it."""
    path = next(each for each in FILES if each.stem == "cylinder-boom")
    facts = nivel.load(path).check()
    root = ET.fromstring(circuit_diagram(record_of(path), facts.pressures))
    hues = {}
    for line in root.iter(f"{SVG}polyline"):
        if line.get("data-level"):
            hues[line.get("data-level")] = float(re.search(r"hsl\((\d+)", line.get("style"))[1])
    highest = max(facts.pressures.values())
    for name, hue in hues.items():
        assert hue == pytest.approx(220 * (1 - facts.pressures[f"hydraulics.{name}"] / highest), abs=0.51)
    assert {"supply.pressure", "lift.pressure_A", "lift.pressure_B"} <= {*hues}
    (key,) = (span.text for span in root.iter(f"{SVG}tspan") if span.get("data-highest"))
    assert float(key) == pytest.approx(highest / 1e5, rel=1e-3)


def test_gas_has_sources_and_exhausts_of_its_own():
    """Triangles of gas are not filled (ISO 1219-1); a tank that takes gas is an exhaust, not a reservoir."""
    path = next(each for each in FILES if each.stem == "pneumatic-pusher")
    circuit, drawing = drawn(path)
    text = circuit_diagram(record_of(path), {})
    exhausts = [node for *_, node in drawing.tanks if node in circuit.gases]
    assert exhausts
    assert text.count('class="hollow"') == len(exhausts) + 1  # and that of the supply
    oil = next(each for each in FILES if each.stem == "cylinder-boom")
    assert 'class="hollow"' not in circuit_diagram(record_of(oil), {})


def test_every_component_has_a_symbol():
    assert {word for word, kind in COMPONENTS.items() if kind.symbol is None} == WITHOUT_SYMBOL


@pytest.mark.parametrize("ways", ["2/2", "3/2", "4/2", "4/3", "5/2", "5/3"])
def test_the_symbol_of_a_valve_has_a_box_for_each_position_and_a_pin_for_each_port(ways):
    symbol = COMPONENTS["directional-valve"].symbol({"ways": ways})
    assert len(re.findall(r"h30 v30 h-30 z", symbol.body)) == int(ways[2])
    assert len(symbol.above) + len(symbol.below) == int(ways[0])


def test_a_machine_without_a_circuit_has_no_diagram():
    assert circuit_diagram({"bodies": []}, {}) == ""


def boxed(path):
    """An example whose pump, check valves and directional valves are of types that have no symbol."""
    record = record_of(path)
    for component in record["hydraulics"]:
        if component["type"] in ("pump", "check-valve", "directional-valve", "load-sensing", "line", "flow-source"):
            component["type"] = f"other-{component['type']}"
    return record


@each_example
def test_a_component_without_a_symbol_is_a_box_with_its_type(path):
    record = boxed(path)
    circuit = circuit_of(record)
    drawing = laid_out(circuit)
    parts = {part.name: part for part in circuit.parts}
    for component in record["hydraulics"]:
        if component["type"].startswith("other-"):
            part = parts[component["name"]]
            assert part.symbol.text == component["type"]
            assert {*part.symbol.above, *part.symbol.below} == {*component["ports"]}
            assert len({*part.symbol.above.values()}) == len(part.symbol.above)
    for box in boxes(circuit):
        for node, *piece in pieces(drawing):
            assert not overlap(box, piece), node
    texts = [text.text for text in ET.fromstring(circuit_diagram(record, {})).iter(f"{SVG}text")]
    kinds = [each["type"] for each in record["hydraulics"] if each["type"].startswith("other-")]
    assert kinds
    assert sorted(text for text in texts if text and text.startswith("other-")) == sorted(kinds)


def test_a_symbol_without_a_pin_for_a_port_gives_way_to_a_box():
    valve = {"name": "valve", "type": "orifice", "ports": {"A": "one", "B": "two", "X": "two"}}
    volumes = [{"name": name, "type": "volume"} for name in ("one", "two")]
    (part,) = circuit_of({"hydraulics": [*volumes, valve]}).parts
    assert part.symbol.text == "orifice"
    assert part.lines == valve["ports"]
