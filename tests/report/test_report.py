"""The report is one file that says what happened, needs nothing else, and stays small."""

import base64
import json
import re

import numpy as np
import pytest

import synthetic_run as pendulum
from nivel.errors import ModelError
from nivel.judge.after.checks.joints import Redundancy
from nivel.report.panel import Thinning
from nivel.report.panels import panels, peak_reactions
from nivel.report.write import number, quantity, report_html
from nivel.results import Memory

TIME = np.linspace(0.0, 2.0, 201)


def run(time=TIME, outcome="done", attributes=None, found=None, ended=None, **histories):
    memory = Memory()
    memory.begin(pendulum.header(**(attributes or {})))
    if len(time):
        memory.take(pendulum.packed(time, {**pendulum.histories(time), **histories}))
    trust = pendulum.judged(memory.result(), outcome, **(found or {})).to_json()
    timing = {"steps": 2000, "evaluations": 8001, "loop_seconds": 0.0123}
    return memory.close({"outcome": outcome, "trust": trust, "timing": json.dumps(timing), **(ended or {})})


def data_of(html):
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', html, re.DOTALL)[1])


def floats(text, kind):
    return np.frombuffer(base64.b64decode(text), kind)


def words(html):
    """What a reader reads, in one line."""
    visible = re.sub(r"<(style|script)\b.*?</\1>", " ", html, flags=re.DOTALL)
    return re.sub(r"\s+", " ", re.sub(r"<[^>]*>", " ", visible)).replace("\u2011", "-")


def test_the_report_answers_in_order():
    text = words(report_html(run()))
    order = [
        "pendulum",
        "Did it run?",
        "Can I trust it?",
        "Peak reactions",
        "What happened",
        "Settings",
        "The machine file",
    ]
    places = [text.index(each) for each in order]
    assert places == sorted(places)
    assert "2 s simulated, computed in 12.3 ms" in text
    assert "1 body 1 joint 1 force 1 degree of freedom step 1 ms rk4 newton-euler" in text
    assert "of the largest kinetic energy 0.441 J (green below 1e-4, amber below 1e-2)" in text


def test_the_report_loads_nothing_from_anywhere():
    html = report_html(run())
    assert "default-src 'none'" in html  # the browser itself refuses
    assert not re.search(r"<(script|img|iframe|object|embed|video|audio|source)\b[^>]*\bsrc\s*=", html)
    assert re.findall(r"<link\b[^>]*>", html) == ['<link rel="icon" href="data:,">']
    assert not re.search(r"@import|url\(|\bfetch\s*\(|XMLHttpRequest|WebSocket|sendBeacon|\bimport\s*\(", html)
    addresses = set(re.findall(r"https?://[^\s\"'<>)]+", html))
    assert addresses == {"http://www.w3.org/2000/svg", "https://github.com/leeoniya/uPlot"}  # a name and a comment


def test_the_report_carries_the_licence_of_what_it_carries():
    html = report_html(run())
    assert "uPlot.js (v1" in html or "uPlot" in html
    assert "The MIT License (MIT)" in html
    assert "Leon Sorokin" in html


def test_peak_reactions_have_their_times():
    force = np.zeros((len(TIME), 1, 3))
    force[42, 0] = [3.0, -4.0, 0.0]
    force[43, 0] = np.nan
    torque = np.zeros((len(TIME), 1, 3))
    torque[:, 0, 2] = 1e-12  # round-off of a force of 5 N at half a metre
    (peak,) = peak_reactions(run(joint_force=force, joint_torque=torque))
    assert (peak.joint, peak.kind, peak.force, peak.force_time, peak.torque) == (
        "hinge",
        "revolute",
        5.0,
        TIME[42],
        0.0,
    )
    text = words(report_html(run(joint_force=force, joint_torque=torque)))
    assert f"hinge revolute 5 N at {number(TIME[42])} s –" in text


def test_a_joint_without_reactions_says_so():
    nothing = np.zeros((len(TIME), 1, 3))
    text = words(report_html(run(joint_force=nothing, joint_torque=nothing)))
    assert "hinge revolute carries nothing" in text
    assert "carries nothing" not in words(report_html(run()))


def test_reactions_that_are_not_unique_are_marked():
    result = run(found={"redundancy": Redundancy(("hinge.d1.xz",), ("hinge",))})
    text = words(report_html(result))
    assert "hinge * revolute" in text
    assert "share the load is not unique" in text


@pytest.mark.parametrize(
    ("outcome", "said"),
    [
        ("done", "Yes, to its end"),
        ("interrupted", "Interrupted"),
        ("running", "Never closed"),
        ("failed", "No, it stopped"),
    ],
)
def test_every_outcome_is_said(outcome, said):
    reason = (
        {"failure": "stopped at t = 2 s: pin is singular", "advice": "Try a smaller step."}
        if outcome == "failed"
        else {}
    )
    text = words(report_html(run(outcome=outcome, attributes=reason)))
    assert said in text
    if reason:
        assert "Stopped at t = 2 s: pin is singular." in text
        assert "Try a smaller step." in text


def test_a_run_without_frames_has_a_report():
    text = words(report_html(run(time=np.empty(0), outcome="failed", attributes={"failure": "the first step failed"})))
    assert "nothing was computed" in text
    assert "The first step failed." in text


def test_a_run_that_ends_in_nan_has_a_report():
    broken = {}
    for name, values in pendulum.histories(TIME).items():
        broken[name] = values.copy()
        broken[name][150:] = np.nan
    html = report_html(run(outcome="failed", **broken))
    assert "NaN" not in json.dumps(data_of(html))
    assert "not a number from t = 1.5 s" in words(html)


def test_a_run_beyond_all_bounds_has_a_report_without_warnings():
    huge = {name: values * 1e300 for name, values in pendulum.histories(TIME).items() if name != "orientation"}
    huge["joint_force"][7] = np.inf
    assert "No: see what is red" in words(report_html(run(outcome="failed", **huge)))


def test_what_the_assembly_changed_stands_with_the_trust():
    assembly = {
        "gap": 0.001,
        "gap_row": "hinge.s.x",
        "moved": [["arm", 0.0005, 0.0], ["rod", 1e-16, 1.5e-5], ["pin", 1e-17, 1e-20]],
        "velocity_change": [["arm", 0.25, 2.0]],
    }
    text = words(report_html(run(attributes={"assembly": json.dumps(assembly)}))).replace("\u00a0", " ")
    start, end = text.index("Redundancy"), text.index("Peak reactions")
    shown = text[start:end]
    assert "Changed at the start" in shown
    assert (
        "arm was moved by 0.0005 m to close the joints, open by up to 0.001 m or rad as given (row hinge.s.x)" in shown
    )
    assert "rod was moved by 1.5e-05 rad" in shown
    assert "pin" not in shown  # round-off
    assert "The velocity of arm was changed by 0.25 m/s and 2 rad/s to fit the joints" in shown


@pytest.mark.parametrize("assembly", [None, {"gap": 0.0, "gap_row": "", "moved": [], "velocity_change": []}])
def test_an_assembly_that_changed_nothing_is_not_mentioned(assembly):
    attributes = {} if assembly is None else {"assembly": json.dumps(assembly)}
    assert "Changed at the start" not in words(report_html(run(attributes=attributes)))


def test_events_are_listed_and_marked():
    events = [
        {"name": name, "time": time, "direction": "rising"}
        for name, time in (("bottom", 0.5), ("top", 1.0), ("bottom", 2.0))
    ]
    html = report_html(run(ended={"events": json.dumps(events), "stopped_by": "bottom"}))
    text = words(html)
    assert "bottom at t = 0.5 s and 2 s, which ended the run" in text
    assert "top at t = 1 s" in text
    assert "until the event bottom" in text
    assert data_of(html)["events"] == [{"name": each["name"], "time": each["time"]} for each in events]


def test_a_run_without_events_does_not_mention_them():
    html = report_html(run())
    assert "Events" not in words(html)
    assert data_of(html)["events"] == []


def test_names_and_texts_are_shown_not_run():
    nasty = '</script><script>alert("x")</script>'
    html = report_html(run(attributes={"machine": nasty, "machine_source": nasty, "failure": nasty}))
    assert nasty not in html
    assert 'alert("x")' not in html


def test_all_panels_have_their_units():
    units = {(panel.title, group.unit) for panel in panels(run()) for group in panel.groups}
    assert {
        ("Joint coordinates", "rad"),
        ("Joint coordinates", "rad/s"),
        ("Body positions", "m"),
        ("Energies", "J"),
        ("Energy error", "J"),
        ("Joint forces", "N"),
        ("Constraint violations", "m"),
        ("Constraint violations", "1/s"),
        ("Applied forces", "W"),
    } <= units


def test_a_body_whose_origin_rests_is_shown_by_its_centre_of_mass():
    scene = pendulum.scene()
    scene["bodies"][0]["centre_of_mass"] = [0.3, 0, 0]
    result = run(position=np.zeros((len(TIME), 1, 3)), attributes={"scene": json.dumps(scene)})
    (panel,) = [panel for panel in panels(result) if panel.title == "Body positions"]
    assert [group.label for group in panel.groups] == ["arm, centre of mass"]
    x, y = (panel.groups[0].curves[k].values for k in (0, 1))
    np.testing.assert_allclose(np.hypot(x, y), 0.3)


def test_violations_are_the_worst_of_each_joint_beside_their_thresholds():
    (panel,) = [panel for panel in panels(run()) if panel.title == "Constraint violations"]
    gaps = panel.groups[0]
    assert panel.log
    np.testing.assert_allclose(gaps.curves[0].values, 2e-9 * TIME)  # hinge.s.y
    np.testing.assert_allclose([value for value, _ in gaps.limits], [1e-6 * pendulum.SIZE, 1e-4 * pendulum.SIZE])


def test_short_runs_are_plotted_completely():
    result = run()
    data = data_of(report_html(result))
    np.testing.assert_array_equal(floats(data["time"], "<f8"), TIME)
    curve = data["panels"][0]["groups"][0]["curves"][0]
    assert curve["label"] == "hinge.angle"
    np.testing.assert_array_equal(floats(curve["values"], "<f4"), result.array("hinge.angle").astype("f4"))


def test_long_runs_stay_small_and_keep_their_peaks():
    time = np.linspace(0.0, 200.0, 100_001)
    error = np.zeros(len(time))
    error[77_777] = 5.0  # a single frame
    html = report_html(run(time, energy_error=error))
    assert len(html) < 1_500_000
    data = data_of(html)
    assert len(floats(data["time"], "<f8")) == 4000
    (panel,) = [panel for panel in data["panels"] if panel["title"] == "Energy error"]
    values = floats(panel["groups"][0]["curves"][0]["values"], "<f4")
    assert len(values) == 4000
    assert values.max() == 5.0
    at = floats(data["time"], "<f8")[values.argmax()]
    assert abs(at - time[77_777]) <= 200.0 / 2000  # within its stretch


def test_thinning_keeps_least_and_largest_in_their_order():
    time = np.arange(12.0)
    values = np.array([3.0, 9, 1, 2, 5, 5, 5, 5, 0, 7, 8, -1])
    thin = Thinning(time, 6)
    np.testing.assert_array_equal(thin(values), [9, 1, 5, 5, 8, -1])
    np.testing.assert_array_equal(thin.time, [0.0, 1.5, 4.0, 5.5, 8.0, 11.0])
    assert np.all(np.diff(thin.time) > 0)
    values[5] = np.nan
    assert np.isnan(thin(values)[2:4]).all()


@pytest.mark.parametrize("count", [1, 2, 3999, 4000, 4001, 4002, 8001, 12_345])
def test_thinning_of_any_length(count, rng):
    time, values = np.linspace(0.0, 1.0, count), rng.normal(size=count)
    thin = Thinning(time, 4000)
    assert len(thin.time) == len(thin(values)) == min(count, 4000)
    assert (thin(values).min(), thin(values).max()) == (values.min(), values.max())
    assert np.all(np.diff(thin.time) > 0)
    assert (thin.time[0], thin.time[-1]) == (time[0], time[-1])


def test_the_report_is_written_and_replaced(tmp_path):
    result = run()
    assert result.report(tmp_path / "run.html").read_text(encoding="utf-8").startswith("<!doctype html>")
    assert result.report(tmp_path / "run.html").exists()
    with pytest.raises(ModelError, match="cannot be written: no such file or directory"):
        result.report(tmp_path / "nowhere" / "run.html")


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0"), (49691.4, "49691"), (8.314159, "8.314"), (1.5e-9, "1.5e-9"), (2.5e7, "2.5e7"), (-0.5, "-0.5")],
)
def test_numbers_read_well(value, text):
    assert number(value) == text


def test_passed_checks_are_one_line_and_what_is_not_green_stands_open():
    good = report_html(run())
    assert re.search(r"All \d numerical checks passed", words(good))
    assert '<li class="green">' not in good.split('<details class="passed">')[0]
    assert not re.search(r"All \d", words(report_html(run(outcome="failed"))))
    huge = {name: values * 1e300 for name, values in pendulum.histories(TIME).items() if name != "orientation"}
    bad = report_html(run(**huge))
    shown, folded = bad.split('<details class="passed">')
    assert '<li class="red">' in shown
    assert '<li class="red">' not in folded.split("</details>")[0]
    assert not re.search(r"All \d", words(bad))


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [(49_720.0, "N", "49.72 kN"), (1.223e5, "N m", "122.3 kN m"), (840.4, "N", "840.4 N"), (3.2e6, "N", "3.2 MN")],
)
def test_quantities_have_the_prefix_that_people_read(value, unit, text):
    assert quantity(value, unit) == text
