"""Circuits that are written wrongly: each fault names the component, says what stood there and what would be right."""

import pytest

from nivel.api import Machine
from nivel.errors import ModelError, SolveError
from nivel.files import parse_machine

GOOD = """format: 1
gravity: [0, -9.81, 0]
bodies:
  boom: {mass: 150, inertia: [67, 67, 67], position: [-0.09, 1.426, 0], centre_of_mass: [1.23, 0.05, 0]}
joints:
  hinge: {type: revolute, bodies: [ground, boom], point: [-0.09, 1.426, 0], axis: [0, 0, 1]}
hydraulics:
  tank: {type: tank, pressure: 2 bar}
  supply: {type: volume, volume: 1 L}
  pump: {type: pump, ports: {A: tank, B: supply}, displacement: 28 cm^3/rev, speed: 1500 rpm}
  relief: {type: relief-valve, ports: {P: supply, T: tank}, opens_at: 200 bar,
    opening_range: 20 bar, flow: 60 L/min, pressure_drop: 200 bar}
  valve: {type: directional-valve, ways: 4/3, ports: {P: supply, T: tank, A: lift.A, B: lift.B},
    flow: 40 L/min, pressure_drop: 7 bar, command: 0}
  lift: {type: cylinder, bodies: [ground, boom], points: [[0.17, 0.386, 0], [0.214, 1.326, 0]],
    piston: 100 mm, rod: 56 mm, stroke: 0.55, retracted_length: 0.82}
simulation: {duration: 0.1 s, step: 1 ms}
"""
CASES = {
    "an unknown node": ("B: supply}", "B: suply}", "there is no node `suply`; did you mean `supply`?"),
    "a cylinder for its chamber": ("B: lift.B", "B: lift", "a chamber of it is needed: `lift.A` or `lift.B`"),
    "no ports": ("ports: {P: supply, T: tank},", "", "ports P, T are not connected; write `ports: {P: …, T: …}`"),
    "a port too many": ("{A: tank, B: supply}", "{A: tank, B: supply, C: tank}", "the port `C` is not known"),
    "ports that are no mapping": ("{A: tank, B: supply}", "tank", "a mapping of ports to nodes"),
    "a negative volume": ("volume: 1 L", "volume: -1 L", "a volume greater than zero was expected, got `-1 L`"),
    "a closed volume": (
        "  tank: {",
        "  lost: {type: volume, volume: 1 L}\n  tank: {",
        "nothing flows into the volume `lost` or out of it",
    ),
    "a volume that is only felt": (
        "  tank: {",
        "  lost: {type: volume, volume: 1 L}\n  hold: {type: check-valve, ports: {A: lift.A, B: tank, X: lost}, pilot_ratio: 3, "
        "flow: 1 L/min, pressure_drop: 1 bar}\n  tank: {",
        "nothing flows into the volume `lost` or out of it",
    ),
    "a tank without pressure": (
        "pressure: 2 bar",
        "pressure: -2 bar",
        "pressures are absolute: one greater than zero was expected",
    ),
    "a tank that follows a pressure": (
        "pressure: 2 bar",
        "pressure: supply.pressure",
        "`supply.pressure` follows from pressures, of which this is one; use a state that follows it",
    ),
    "a loop through a block": (
        "hydraulics:",
        "control:\n  loop: {type: gain, input: valve.flow_PA, gain: 100}\nhydraulics:",
        "`valve.flow_PA` follows from the flows, and these from the control; take a sample of it",
    ),
    "a pump without relief": (
        "relief-valve, ports: {P: supply",
        "relief-valve, ports: {P: lift.A",
        "no relief valve bounds the pressure at `supply`",
    ),
    "an algebraic loop": (
        "command: 0",
        "command: valve.flow_PA",
        "cannot steer them at once; use a state that follows it",
    ),
    "a command with a unit": ("command: 0", "command: 3 bar", "`3 bar` is a pressure (Pa); a number was expected"),
    "a command beyond the stroke": ("command: 0", "command: 3", "a share from -1 to 1 was expected, got 3"),
    "unknown ways": ("ways: 4/3", "ways: 6/3", "the word `6/3` is not known"),
    "a rod thicker than its piston": (
        "rod: 56 mm",
        "rod: 156 mm",
        "a rod is thinner than its piston of 0.1 m, got 0.156 m",
    ),
    "a cylinder too short": (
        "retracted_length: 0.82",
        "retracted_length: 0.3",
        "0.941029 m between its ends at the start, and its stroke goes from 0.3 to 0.85 m",
    ),
    "a turning cylinder": ("speed: 1500 rpm", "coordinate: hinge.angel", "did you mean `angle`?"),
    "two fluids": ("hydraulics:", "fluids: {a: {}, b: {}}\nhydraulics:", "`fluid` is missing: there are `a`, `b`"),
    "a fluid without air": ("hydraulics:", "fluids: {a: {air: 1e-9}}\nhydraulics:", "or 0, was expected"),
    "an efficiency without its point": (
        "speed: 1500 rpm",
        "speed: 1500 rpm, volumetric_efficiency: 0.9",
        "`nominal_pressure` is missing: the efficiencies hold at one pressure and speed",
    ),
    "load sensing without its signal": ("speed: 1500 rpm", "speed: 1500 rpm, margin: 20 bar", "port LS is missing"),
    "a loop of two ports": ("{P: supply, T: tank}, opens", "{P: supply, T: supply}, opens", "nothing would flow"),
}


@pytest.mark.parametrize("case", CASES)
def test_a_fault_says_what_would_be_right(case):
    old, new, message = CASES[case]
    assert old in GOOD
    with pytest.raises(ModelError) as caught:
        Machine.from_record(parse_machine(GOOD.replace(old, new, 1))).simulate()
    assert message in str(caught.value)


def test_faults_of_several_components_come_at_once():
    text = (
        GOOD.replace("B: supply}", "B: suply}").replace("rod: 56 mm", "rod: 156 mm").replace("ways: 4/3", "ways: 6/3")
    )
    with pytest.raises(ModelError) as caught:
        parse_machine(text)
    assert len(caught.value.faults) >= 3


def test_a_step_that_empties_a_volume_says_which():
    text = GOOD.replace("volume: 1 L", "volume: 1 mm^3").replace("command: 0", "command: 1")
    with pytest.raises(SolveError, match="the volume supply has no fluid left in it"):
        Machine.from_record(parse_machine(text)).simulate(integrator="rk4")


def test_a_valve_at_its_end_for_the_whole_run_is_told():
    result = Machine.from_record(parse_machine(GOOD.replace("command: 0", "command: 1"))).simulate()
    assert "saturation" in [item.name for item in result.trust.items]


def test_a_valve_of_two_positions_may_stay_in_one():
    text = GOOD.replace("ways: 4/3", "ways: 4/2").replace("command: 0", "command: 1")
    assert "saturation" not in [item.name for item in Machine.from_record(parse_machine(text)).simulate().trust.items]


def test_a_relief_valve_that_is_too_small_is_told():
    result = Machine.from_record(parse_machine(GOOD.replace("28 cm^3/rev", "280 cm^3/rev"))).simulate()
    item = next(item for item in result.trust.items if item.name == "saturation")
    assert item.verdict == "amber"
    assert "the relief valve relief is fully open for the whole run" in item.text


def test_a_chamber_that_cavitates_for_the_whole_run_is_told():
    text = GOOD.replace("stroke: 0.55", "stroke: 0.55, start_B: 0.05 bar")
    item = next(
        item for item in Machine.from_record(parse_machine(text)).simulate().trust.items if item.name == "cavitation"
    )
    assert "lift.pressure_B falls to 0.05 bar" in item.text
    assert "for 100 % of the run" in item.text
