# ruff: noqa: E501
"""Typical mistakes in circuits: all are answered with the component, the line and what to write."""

import re
import tempfile
from pathlib import Path

import pytest

from nivel.api import load
from nivel.errors import ModelError

GOOD = """format: 1
gravity: [0, -9.81, 0]
bodies:
  boom: {mass: 150, inertia: [67, 67, 67], position: [-0.09, 1.426, 0], centre_of_mass: [1.23, 0.05, 0]}
joints:
  hinge: {type: revolute, bodies: [ground, boom], point: [-0.09, 1.426, 0], axis: [0, 0, 1]}
hydraulics:
  tank: {type: tank, pressure: 2 bar}
  supply: {type: volume, volume: 1 L}
  ls: {type: load-sensing, valves: [valve, slew], lag: 10 ms}
  pump: {type: pump, ports: {A: tank, B: supply, LS: ls}, displacement: 28 cm^3/rev, speed: 1500 rpm, margin: 20 bar, cut_off: 190 bar}
  relief: {type: relief-valve, ports: {P: supply, T: tank}, opens_at: 200 bar, opening_range: 20 bar, flow: 60 L/min, pressure_drop: 200 bar}
  gap: {type: volume, volume: 5 cm^3}
  comp: {type: compensator, ports: {P: supply, A: gap, LS: ls}, margin: 7 bar, flow: 60 L/min, pressure_drop: 3 bar}
  valve: {type: directional-valve, ways: 4/3, ports: {P: gap, T: tank, A: line, B: lift.B}, flow: 40 L/min, pressure_drop: 7 bar, command: 0, frequency: 8 Hz}
  slew: {type: section, ports: {P: supply, T: tank, A: left, B: right, LS: ls}, flow: 30 L/min, pressure_drop: 7 bar, command: 0}
  line: {type: volume, volume: 20 cm^3}
  left: {type: volume, volume: 0.2 L}
  right: {type: volume, volume: 0.2 L}
  cross: {type: cross-port-relief, ports: {A: left, B: right, T: tank}, opens_at: 100 bar, flow: 40 L/min, pressure_drop: 100 bar}
  hold: {type: counterbalance-valve, ports: {L: lift.A, V: line, X: lift.B}, opens_at: 180 bar, flow: 60 L/min, pressure_drop: 7 bar}
  check: {type: check-valve, ports: {A: supply, B: reserve}, flow: 40 L/min, pressure_drop: 2 bar}
  reserve: {type: volume, volume: 0.1 L}
  store: {type: accumulator, ports: {A: reserve}, volume: 2 L, precharge: 90 bar, flow: 60 L/min, pressure_drop: 2 bar}
  pilot: {type: reducing-valve, ports: {P: supply, A: reserve}, pressure: 35 bar, flow: 10 L/min, pressure_drop: 5 bar}
  lift: {type: cylinder, bodies: [ground, boom], points: [[0.17, 0.386, 0], [0.214, 1.326, 0]], piston: 100 mm, rod: 56 mm, stroke: 0.55, retracted_length: 0.82}
simulation: {duration: 0.1 s, step: 1 ms}
"""
# what is wrong: what stood there, what stands there, the component that the answer names, and words that say what to write
MISTAKES = {
    "an unknown node": ("B: reserve}", "B: reserv}", "check", "did you mean `reserve`"),
    "a cylinder for its chamber": ("B: lift.B}", "B: lift}", "valve", "`lift.A` or `lift.B`"),
    "no ports": ("ports: {P: supply, T: tank}, opens", "opens", "relief", "write `ports: {P: …, T: …}`"),
    "a port too many": ("{A: tank, B: supply, LS: ls}", "{A: tank, B: supply, LS: ls, C: tank}", "pump", "port `C` is not known"),
    "the LS port left out": ("{A: tank, B: supply, LS: ls}", "{A: tank, B: supply}", "pump", "port LS is missing"),
    "the LS port of a section": ("B: right, LS: ls}", "B: right}", "slew", "write `LS: ls`"),
    "both ports at one node": ("{P: supply, T: tank}, opens", "{P: supply, T: supply}, opens", "relief", "nothing would flow"),
    "a volume that nothing joins": ("  tank:", "  lost: {type: volume, volume: 1 L}\n  tank:", "lost", "name it in the `ports`"),
    "a volume that leads nowhere": ("A: left, B: right, T: tank}", "A: left, B: left, T: tank}", "right|cross", "name `right` in the `ports`|nothing would flow"),
    "a chamber that nothing fills": ("B: lift.B}", "B: right}", "lift", "name `lift.B` in the `ports`"),
    "a reversed pump": ("{A: tank, B: supply, LS: ls}", "{A: supply, B: tank, LS: ls}", "pump", "pump is reversed"),
    "a pump that turns backwards": ("speed: 1500 rpm", "speed: -1500 rpm", "pump", "without a minus"),
    "a pump at rest": ("speed: 1500 rpm", "speed: 0 rpm", "pump", "speed: 1500 rpm"),
    "a speed without its unit": ("speed: 1500 rpm", "speed: 1500", "pump", "for example `speed: 1500 rpm`"),
    "a displacement per radian": ("28 cm^3/rev", "28 cm^3", "pump", "write `displacement: 28 cm^3/rev`"),
    "a displacement in litres": ("28 cm^3/rev", "28 L/rev", "pump", "for example `displacement: 28 cm^3/rev`"),
    "no relief valve": ("LS: ls}, displacement: 28 cm^3/rev, speed: 1500 rpm, margin: 20 bar, cut_off: 190 bar}\n  relief: {type: relief-valve, ports: {P: supply", "B: supply}, displacement: 28 cm^3/rev, speed: 1500 rpm}\n  relief: {type: relief-valve, ports: {P: left", "pump", "add one such as"),
    "a reversed relief valve": ("{P: supply, T: tank}, opens", "{P: tank, T: supply}, opens", "relief", "relief valve is reversed"),
    "a relief valve too small": ("opening_range: 20 bar, flow: 60 L/min", "opening_range: 20 bar, flow: 6 L/min", "relief", "write for example `flow:"),
    "a reversed directional valve": ("{P: supply, T: tank, A: left", "{P: tank, T: supply, A: left", "slew", "valve is reversed"),
    "a return into pressure": ("T: tank, A: line", "T: high, A: line", "valve", "write `{type: tank, pressure: 2 bar}`"),
    "a reversed counterbalance valve": ("{L: lift.A, V: line,", "{L: line, V: lift.A,", "hold", "valve is reversed"),
    "a pilot on its own load": ("X: lift.B}", "X: lift.A}", "hold", "such as `X: lift.B`"),
    "a reversed check valve": ("{A: supply, B: reserve}, flow", "{A: reserve, B: supply}, flow", "check", "check valve is reversed"),
    "a precharge above the relief valve": ("{A: reserve}, volume: 2 L, precharge: 90 bar", "{A: supply}, volume: 2 L, precharge: 250 bar", "store", "write for example `precharge:"),
    "a cut-off above the relief valve": ("cut_off: 190 bar", "cut_off: 210 bar", "pump", "write for example `cut_off:"),
    "a reduced pressure above the supply": ("pressure: 35 bar", "pressure: 350 bar", "pilot", "write for example `pressure:"),
    "a margin above that of the pump": ("margin: 7 bar", "margin: 25 bar", "comp", "write for example `margin:"),
    "a section that the signal forgets": ("[valve, slew]", "[valve]", "slew", "write `valves: [valve, slew]`"),
    "a signal of no valve": ("[valve, slew]", "[valve, cross]", "ls", "is no 4/3 directional valve or section"),
    "a signal that nothing reads": ("  tank:", "  spare: {type: load-sensing, valves: [valve]}\n  tank:", "spare", "`LS: spare`"),
    "flow without its pressure drop": ("flow: 40 L/min, pressure_drop: 7 bar", "flow: 40 L/min", "valve", "`pressure_drop` is missing"),
    "a command in percent": ("command: 0, frequency", "command: 60, frequency", "valve", "a share from -1 to 1"),
    "a command in percent that varies": ("command: 0, frequency", 'command: "step(time, 0, 0, 0.05, 60)", frequency', "valve", "percent? Write `command: (step("),
    "a lever in percent": ("command: 0, frequency", "command: lever, frequency", "valve", "percent? Write `command: (lever.value)/100`"),
    "two pumps in a row": ("{A: tank, B: supply, LS: ls}, displacement: 28 cm^3/rev, speed: 1500 rpm,", "{A: boost, B: supply, LS: ls}, displacement: 28 cm^3/rev, speed: 1500 rpm,", "first", "safety: {type: relief-valve, ports: {P: boost, T: tank}"),
    "a pressure in pascals": ("opens_at: 200 bar", "opens_at: 200", "relief", "opens_at: 250 bar"),
    "a volume in cubic metres": ("supply: {type: volume, volume: 1 L", "supply: {type: volume, volume: 1e4", "supply", "for example `volume: 1 l`"),
    "millimetres without the unit": ("piston: 100 mm, rod: 56 mm", "piston: 100, rod: 56", "lift", "for example `piston: 80 mm`"),
    "a lag in milliseconds": ("lag: 10 ms}", "lag: 10}", "ls", "for example `lag: 10 ms`"),
    "a cylinder that is too short": ("retracted_length: 0.82", "retracted_length: 0.3", "lift", "its stroke goes from"),
    "a rod thicker than its piston": ("rod: 56 mm", "rod: 156 mm", "lift", "thinner than its piston"),
    "a tank that is forgotten": ("  tank: {type: tank, pressure: 2 bar}\n", "", "pump", "for a tank add `tank: {type: tank}`"),
    "turns in a minute": ("speed: 1500 rpm", "speed: 1500 1/min", "pump", "turns in a minute are `rpm`"),
    "a gauge pressure": ("opens_at: 200 bar", "opens_at: 200 barg", "relief", "write `bar`"),
    "litres in a minute": ("flow: 60 L/min, pressure_drop: 200 bar", "flow: 60 lpm, pressure_drop: 200 bar", "relief", "write `L/min`"),
    "gallons in a minute": ("flow: 60 L/min, pressure_drop: 200 bar", "flow: 16 GPM, pressure_drop: 200 bar", "relief", "write `gal/min`"),
    "an efficiency in percent": ("cut_off: 190 bar", "cut_off: 190 bar, volumetric_efficiency: 95 %", "pump", "write `0.95`"),
    "an efficiency of no point": ("cut_off: 190 bar", "cut_off: 190 bar, volumetric_efficiency: 0.95", "pump", "`nominal_pressure` is missing"),
    "an orifice in metres": ("  left:", "  o: {type: orifice, ports: {A: line, B: tank}, diameter: 2}\n  left:", "o", "for example `diameter: 2 mm`"),
    "an orifice by two sizes": ("  left:", "  o: {type: orifice, ports: {A: line, B: tank}, diameter: 2 mm, flow: 3 L/min, pressure_drop: 5 bar}\n  left:", "o", "give one of them"),
    "a type of another spelling": ("type: relief-valve", "type: relief_valve", "relief", "did you mean `relief-valve`"),
    "ways with a hyphen": ("ways: 4/3", "ways: 4-3", "valve", "did you mean `4/3`"),
    "ports in small letters": ("{P: supply, T: tank}, opens", "{p: supply, t: tank}, opens", "relief", "did you mean `P`"),
    "ports in a list": ("{P: supply, T: tank}, opens", "[supply, tank], opens", "relief", "such as {P: supply, T: tank}"),
    "a command by a flow": ("command: 0, frequency", "command: pump.flow*1000, frequency", "valve", "use a state that follows it"),
    "a name twice": ("  left:", "  line: {type: volume, volume: 1 L}\n  left:", "line", "the first is in line 17"),
    "a fluid that is not there": ("line: {type: volume", "line: {type: volume, fluid: oil", "line", "there is no fluid `oil`"),
    "a sonic conductance of oil": ("{A: supply, B: reserve}, flow: 40 L/min, pressure_drop: 2 bar", "{A: supply, B: reserve}, sonic_conductance: 3 dm^3/(s*bar)", "check", "liquids have `flow` at `pressure_drop`"),
    "a bore": ("piston: 100 mm", "bore: 100 mm", "lift", "did you mean `piston`"),
    "an accumulator without a port": ("ports: {A: reserve}, volume: 2 L", "volume: 2 L", "store", "write `ports: {A: …}`"),
    "a precharge of zero": ("precharge: 90 bar", "precharge: 0 bar", "store", "greater than zero"),
    "an engine that is not there": ("speed: 1500 rpm, margin", "engine: diesel, margin", "pump", "there is no engine `diesel`"),
    "a pump that two things turn": ("speed: 1500 rpm, margin", "speed: 1500 rpm, coordinate: hinge, margin", "pump", "got `speed` and `coordinate`"),
    "a setting in percent": ("LS: ls}, displacement: 28 cm^3/rev, speed: 1500 rpm, margin: 20 bar, cut_off: 190 bar", "B: supply}, displacement: 28 cm^3/rev, speed: 1500 rpm, setting: 80", "pump", "a share from -1 to 1"),
    "an overlap in percent": ("command: 0, frequency", "overlap: 10, command: 0, frequency", "valve", "a share of the stroke"),
    "a negative margin": ("margin: 20 bar", "margin: -20 bar", "pump", "greater than zero"),
    "ends in millimetres": ("[[0.17, 0.386, 0], [0.214, 1.326, 0]]", "[[170, 386, 0], [214, 1326, 0]]", "lift", "between its ends at the start"),
    "a cylinder of no bodies": ("bodies: [ground, boom], points: [[0.17, 0.386, 0], [0.214, 1.326, 0]], piston", "piston", "lift", "two `bodies` and two `points`"),
    "a range that is missing": ("opening_range: 20 bar, flow: 60", "flow: 60", "relief", "`opening_range` is missing"),
    "a part that is not there": ("displacement: 28 cm^3/rev, speed", "part: a10vso-28, speed", "pump", "entry of `catalogue`"),
    "a wrong coordinate": ("  left:", "  m: {type: hydraulic-motor, ports: {A: left, B: right}, displacement: 50 cm^3/rev, coordinate: hing}\n  left:", "m", "did you mean `hinge`"),
    "a tank below no pressure": ("pressure: 2 bar", "pressure: -1 bar", "tank", "one greater than zero"),
}  # fmt: skip
MORE = {
    "a lever in percent": ("hydraulics:", "inputs: {lever: {range: [-100, 100]}}\nhydraulics:"),
    "two pumps in a row": (
        "  tank:",
        "  first: {type: pump, ports: {A: tank, B: boost}, displacement: 28 cm^3/rev, speed: 1500 rpm}\n  tank:",
    ),
    "a return into pressure": ("  tank:", "  high: {type: tank, pressure: 100 bar}\n  tank:"),
}


def answers(text):
    """Everything that is said of a machine in a file, as text with line and place: faults as it is read or checked, then remarks."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "circuit.yaml"
        path.write_text(text, encoding="utf-8")
        try:
            machine = load(path)
            said = [str(each) for each in machine.remarks]
            if not said:
                machine.check()
        except ModelError as error:
            return [str(fault) for fault in error.faults]
        return said


def is_answered(name):
    """Whether the mistake is answered with its component, a line, and the words that help."""
    old, new, component, words = MISTAKES[name]
    text = GOOD
    if name in MORE:
        text = text.replace(*MORE[name], 1)
    assert old in text, name
    found = answers(text.replace(old, new, 1))
    place = re.compile(rf":\d+:\d+: hydraulics\.({component})\b")
    return any(
        place.search(each) and re.search("|".join(map(re.escape, words.split("|"))), each) for each in found
    ), found


def test_the_circuit_without_mistakes_is_right():
    assert answers(GOOD) == []


def test_a_node_that_two_components_name_is_a_volume_of_the_usual_size():
    """Without the volumes `left`, `right` and `reserve` the machine is the same as with them at the usual size."""
    short = "".join(line for line in GOOD.splitlines(True) if not re.match("  (left|right|reserve): ", line))
    plain = GOOD.replace("reserve: {type: volume, volume: 0.1 L}", "reserve: {type: volume, volume: 0.2 L}")
    with tempfile.TemporaryDirectory() as folder:
        machines = []
        for name, text in {"short": short, "plain": plain}.items():
            path = Path(folder) / f"{name}.yaml"
            path.write_text(text, encoding="utf-8")
            machines.append(load(path))
    found = [{each.name: each.model_dump(exclude_unset=False) for each in m.record.hydraulics} for m in machines]
    assert found[0] == found[1]
    assert "left: volume of 0.2 L, as none is given" in str(machines[0].check())


def test_all_mistakes_are_answered():
    assert len(MISTAKES) == 73
    left = {name: found for name in MISTAKES for answered, found in [is_answered(name)] if not answered}
    assert not left


@pytest.mark.parametrize("name", ["a reversed pump", "no relief valve", "a chamber that nothing fills"])
def test_what_stops_most_circuits_is_answered(name):
    assert is_answered(name)[0], is_answered(name)[1]
