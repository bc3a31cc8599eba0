"""Drivers, couplings, forces and sensors have panels: by unit, and only where there are any."""

import json

import numpy as np
import pytest

import synthetic_run as pendulum
from nivel.integrate.loop.sink import Header
from nivel.report.panel import TOGETHER
from nivel.report.panels import panels
from nivel.report.write import report_html
from nivel.results import Memory
from nivel.system.layout import frame_layout

TIME = np.linspace(0.0, 2.0, 21)


def run(*outputs, time=TIME):
    """The synthetic pendulum with these further (name, units) among its outputs; the k-th is k + time."""
    plan = frame_layout(
        ["arm"], ["hinge"], ["hinge.angle"], list(pendulum.ROWS), [(name, unit, name) for name, unit in outputs]
    )
    values = {**pendulum.histories(time), **{name: k + time for k, (name, _) in enumerate(outputs)}}
    frames = np.empty((len(time), plan.width))
    frames[:, 0] = time
    for variable in plan.variables:
        frames[:, variable.columns] = np.reshape(values[variable.name], (len(time), -1))
    memory = Memory()
    memory.begin(Header(plan, pendulum.header().attributes))
    memory.take(frames)
    trust = pendulum.judged(memory.result()).to_json()
    return memory.close({"outcome": "done", "trust": trust})


def panel(result, title):
    found = [each for each in panels(result) if each.title == title]
    assert len(found) <= 1
    return found[0] if found else None


def groups(result, title):
    """Label → names of the curves."""
    return {group.label: [curve.label for curve in group.curves] for group in panel(result, title).groups}


DRIVEN = [
    ("driver.turn.effort", "N m"),
    ("driver.turn.power", "W"),
    ("driver.push.effort", "N"),
    ("driver.push.power", "W"),
]
FORCES = [
    ("force.spring.magnitude", "N"),
    ("force.spring.power", "W"),
    ("force.spring.length", "m"),
    ("force.spring.rate", "m/s"),
    ("force.motor.magnitude", "N m"),
    ("force.motor.power", "W"),
    ("force.motor.value", "rad"),
    ("force.motor.rate", "rad/s"),
    ("force.coil.angle", "rad"),
    ("force.ball.depth", "m"),
    ("force.ball.normal_force", "N"),
    ("force.brake.normal_load", "N"),
    ("force.brake.bristle", "m"),
    *((f"force.rubber.force_{axis}", "N") for axis in "xyz"),
    *((f"force.rubber.torque_{axis}", "N m") for axis in "xyz"),
]


def test_what_a_machine_does_not_have_has_no_panel():
    assert not {"Drivers", "Couplings", "Applied forces", "Sensors"} & {each.title for each in panels(run())}


def test_the_panels_follow_the_story():
    result = run(*DRIVEN, ("coupling.gear.effort", "N m"), *FORCES, ("sensor.tip", "m"))
    assert [each.title for each in panels(result)] == [
        "Joint coordinates",
        "Body positions",
        "Sensors",
        "Energies",
        "Energy error",
        "Drivers",
        "Couplings",
        "Applied forces",
        "Joint forces",
        "Constraint violations",
    ]


def test_efforts_of_drivers_are_apart_by_unit_and_power_is_together():
    assert groups(run(*DRIVEN), "Drivers") == {
        "effort, N m": ["turn"],
        "effort, N": ["push"],
        "power into the machine, W": ["turn", "push"],
    }


def test_efforts_of_couplings_are_apart_by_unit():
    result = run(("coupling.gear.effort", "N m"), ("coupling.rope.effort", "N"), ("coupling.belt.effort", "N m"))
    assert groups(result, "Couplings") == {
        "effort on the first coordinate, N m": ["gear", "belt"],
        "effort on the first coordinate, N": ["rope"],
    }
    (_, belt) = panel(result, "Couplings").groups[0].curves
    np.testing.assert_array_equal(belt.values, 2 + TIME)


def test_forces_offer_magnitudes_first_and_everything_they_measure():
    assert groups(run(*FORCES), "Applied forces") == {
        "magnitude, N": ["spring"],
        "magnitude, N m": ["motor"],
        "power, W": ["spring", "motor"],
        "lengths, m": ["spring"],
        "angles, rad": ["coil"],
        "rates, m/s": ["spring"],
        "depths, negative while apart, m": ["ball"],
        "normal forces, N": ["ball"],
        "normal loads, N": ["brake"],
        "deflections of bristles, m": ["brake"],
        "rubber, force": ["x", "y", "z"],
        "rubber, torque": ["x", "y", "z"],
    }


def test_what_a_motor_measures_is_not_drawn_twice():
    """Its value and rate are those of the joint coordinate."""
    labels = [label for names in groups(run(*FORCES), "Applied forces").values() for label in names]
    assert labels.count("motor") == 2


def test_sensors_of_one_unit_are_together():
    vectors = [(f"sensor.tip.{axis}", "m/s") for axis in "xyz"]
    result = run(*vectors, ("sensor.gap.distance", "m"), ("sensor.gap.rate", "m/s"), ("sensor.ratio", ""))
    assert groups(result, "Sensors") == {
        "speeds, m/s": ["tip.x", "tip.y", "tip.z", "gap.rate"],
        "lengths, m": ["gap.distance"],
        "numbers": ["ratio"],
    }
    assert [group.unit for group in panel(result, "Sensors").groups] == ["m/s", "m", "1"]


def test_a_single_vector_has_the_colours_of_the_axes_and_all_curves_differ():
    one = [(f"sensor.tip.{axis}", "m") for axis in "xyz"]
    two = [(f"sensor.elbow.{axis}", "m") for axis in "xyz"]
    for outputs, first in ((one, ["x", "y", "z"]), ([*one, *two], ["0", "1", "2"])):
        (group,) = panel(run(*outputs, ("sensor.gap.distance", "m")), "Sensors").groups
        tones = [curve.tone for curve in group.curves]
        assert tones[:3] == first
        assert len(set(tones)) == len(tones)
        assert first[0] != "x" or int(tones[3]) > 2  # blue, orange and green look like the axes


def test_many_sensors_are_split_and_none_is_lost():
    outputs = [(f"sensor.s{k}.{axis}", "m") for k in range(12) for axis in "xyz"]
    found = panel(run(*outputs), "Sensors").groups
    assert [group.label for group in found] == [f"lengths, m ({k} of 3)" for k in (1, 2, 3)]
    names = [curve.label for group in found for curve in group.curves]
    assert names == [name.removeprefix("sensor.") for name, _ in outputs]
    assert max(len(group.curves) for group in found) <= 2 * TOGETHER


def test_units_that_people_wrote_are_shown_as_text():
    nasty = "</script><b>"
    html = report_html(run(("sensor.odd", nasty)))
    assert nasty not in html
    assert panel(run(("sensor.odd", "furlong")), "Sensors").groups[0].label == "furlong"


def test_many_forces_are_cut_off_with_a_word():
    found = panel(run(*((f"force.f{k}.magnitude", "N") for k in range(2 * TOGETHER + 3))), "Applied forces")
    assert len(found.groups[0].curves) == 2 * TOGETHER
    assert found.note == "3 more in the result file"


def test_long_runs_of_many_elements_stay_small():
    outputs = [(f"sensor.s{k}.{axis}", "m") for k in range(40) for axis in "xyz"]
    html = report_html(run(*outputs, *FORCES, time=np.linspace(0.0, 20.0, 20_001)))
    assert len(html) < 4_500_000


def test_the_header_counts_what_there_is():
    html = report_html(run(*DRIVEN, ("coupling.gear.effort", "N m"), ("force.spring.magnitude", "N")))
    facts = html[html.index('<ul class="facts">') : html.index("</ul>", html.index('<ul class="facts">'))]
    assert "<li>1 coupling</li><li>2 drivers</li><li>1 force</li><li>1 degree of freedom</li>" in facts
    assert "sensor" not in facts


@pytest.mark.parametrize(("unit", "shown"), [("rad", "1"), ("1", "1")])
def test_rows_in_radians_are_among_the_violations(unit, shown):
    """Gears and driven angles hold angles."""
    rows = {**pendulum.ROWS, "hinge.d1.yz": unit}
    memory = Memory()
    memory.begin(pendulum.header(constraint_units=json.dumps(rows)))
    memory.take(pendulum.frames(TIME))
    trust = pendulum.judged(memory.result()).to_json()
    found = panel(memory.close({"outcome": "done", "trust": trust}), "Constraint violations")
    (group,) = [group for group in found.groups if group.label == "misalignments"]
    assert group.unit == shown
    np.testing.assert_allclose(group.curves[0].values, 0.5e-9 * TIME)  # the larger of both rows
