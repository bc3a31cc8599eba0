"""The characteristic curves of valves in the report: each goes through the points of its catalogue and of its closed form."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest
from scipy.optimize import bisect

from nivel.elements.circuits.fluids import GRADES
from nivel.looks.circuit.characteristics import valve_charts, valve_diagram

BAR = 1e5


def record(at, **component):
    """A record with one valve, whose ports are all at a tank."""
    return {"hydraulics": [{"name": "valve", "ports": dict.fromkeys(at, "tank"), **component}]}


RATED = {"flow": "40 L/min", "pressure_drop": "7 bar"}


def only(**component):
    (chart,) = valve_charts(record(**component))
    return chart


def test_a_spool_valve_goes_through_the_points_of_its_catalogue():
    edges = {
        "PA": {"flow": {"of": "position", "points": [0.2, 0.5, 1], "values": [0, "10 L/min", "60 L/min"]}, "pressure_drop": "8 bar"},
        "AT": {"flow": {"of": "position", "points": [-1, 0], "values": ["30 L/min", 0]}, "pressure_drop": "5 bar"},
    }  # fmt: skip
    chart = only(type="spool-valve", at="PTA", edges=edges, command=0)
    curves = {curve.label: curve for curve in chart.curves}
    assert np.interp([0.2, 0.5, 1.0], curves["PA at 8 bar"].x, curves["PA at 8 bar"].y) == pytest.approx(
        [0, 10, 60], abs=0.3
    )
    assert np.interp([-1.0, -0.5], curves["AT at 5 bar"].x, curves["AT at 5 bar"].y) == pytest.approx([30, 15])


def test_a_directional_valve_has_its_rated_flow_at_its_full_stroke():
    chart = only(type="directional-valve", ways="4/3", at="PTAB", overlap=0.1, command=0, **RATED)
    for curve in chart.curves:
        assert max(curve.y[0], curve.y[-1]) == pytest.approx(40.0)
        assert np.all(curve.y[np.abs(curve.x) <= 0.1] == 0.0)


def test_a_relief_valve_is_shut_to_its_setting_and_open_at_the_end_of_its_range():
    chart = only(type="relief-valve", at="PT", opens_at="200 bar", opening_range="20 bar", **RATED)
    (curve,) = chart.curves
    assert np.all(curve.y[curve.x < 200.0] == 0.0)
    assert np.interp(220.0, curve.x, curve.y) == pytest.approx(40.0 * np.sqrt(220 / 7), rel=5e-3)


def test_a_pilot_opens_a_counterbalance_valve_earlier():
    chart = only(type="counterbalance-valve", at="LVX", opens_at="180 bar", **RATED)
    opens = [curve.x[np.argmax(curve.y > 0.0)] for curve in chart.curves]
    assert opens == pytest.approx([180.0, 126.0, 72.0], abs=3.0)


@pytest.mark.parametrize(("type_", "at", "keys", "middle", "shares"), [
    ("shuttle-valve", "ABC", {}, 0.0, (1.0, 1.0)), ("flow-divider", "PAB", {"share": 0.3}, 0.0, (0.3, 0.7)),
    ("priority-valve", ("P", "CF", "EF", "LS"), {"margin": "8 bar"}, 8.0, (1.0, 1.0)),
])  # fmt: skip
def test_two_edges_of_a_spool_open_against_each_other(type_, at, keys, middle, shares):
    """Both half open, 40 L/min at 7 bar, in the middle; one wholly open and the other shut at the ends of the range."""
    chart = only(type=type_, at=at, **keys, **RATED)
    first, second = chart.curves
    for curve, share in zip(chart.curves, shares, strict=True):
        assert np.interp(middle, curve.x, curve.y) == pytest.approx(20.0 * share)
        assert sorted([curve.y[0], curve.y[-1]]) == pytest.approx([0.0, 40.0 * share])
    assert (first.y[0] == 0.0) == (second.y[-1] == 0.0)


def test_an_orifice_by_its_diameter_takes_the_density_of_a_grade():
    """Q = C A √(2 Δp/ρ) at 10 bar; HLP 46 at 40 °C."""
    fluids = [{"name": "oil", "type": "liquid", "grade": "HLP 46", "density": None, "air": 0}]
    (chart,) = valve_charts({**record(type="orifice", at="AB", diameter="2 mm"), "fluids": fluids})
    density = GRADES["HLP 46"].at(313.15).density
    expected = 0.65 * np.pi * 1e-6 * np.sqrt(2e6 / density) * 6e4
    assert chart.curves[0].y[-1] == pytest.approx(expected, rel=1e-3)


def test_a_brake_valve_opens_over_its_range():
    (curve,) = only(
        type="brake-valve", at=("VA", "VB", "A", "B"), opens_at="10 bar", opening_range="15 bar", **RATED
    ).curves
    assert np.interp([10.0, 17.5, 25.0], curve.x, curve.y) == pytest.approx([0.0, 20.0, 40.0], abs=0.05)


def test_a_flushing_valve_opens_over_its_range():
    (curve,) = only(type="flushing-valve", at="ABC", opens_at="6 bar", opening_range="8 bar", **RATED).curves
    assert np.interp([6.0, 10.0, 14.0], curve.x, curve.y) == pytest.approx([0.0, 20.0, 40.0], abs=0.05)


def test_a_pilot_relief_valve_has_the_flow_of_its_pilot_then_that_of_its_main_stage():
    """p_X by bisection of the balance of the pilot; the main stage opens by p - p_X beyond its spring of 2 bar."""
    (curve,) = only(type="pilot-relief-valve", at="PT", opens_at="100 bar", **RATED).curves
    k = 2.0 / np.sqrt(5.0)  # L/min of the orifice at 1 bar
    for p in (101.5, 106.0):
        x = bisect(lambda x, p=p: drop(p - x) - 2 * smooth((x - 100) / 3) * drop(x), 0, p, xtol=1e-13)
        expected = k * drop(p - x) + 40 / np.sqrt(7) * smooth((p - x - 2) / 3) * drop(p)
        assert np.interp(p, curve.x, curve.y) == pytest.approx(expected, rel=0.02)
    assert np.all(curve.y[curve.x < 100] < 1e-9)


def test_a_pilot_reducing_valve_shuts_above_its_setting():
    (curve,) = only(type="pilot-reducing-valve", at="PAT", pressure="80 bar", **RATED).curves
    assert np.interp(79.0, curve.x, curve.y) == pytest.approx(40 * np.sqrt((160 - 79) / 7), rel=1e-3)
    assert curve.y[-1] == 0.0


def drop(p):
    """√p, rounded at half a bar as `transition` has it."""
    return p * (p * p + 0.25) ** -0.25


def smooth(t):
    t = np.clip(t, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def test_the_diagram_has_a_plot_for_each_valve():
    two = record(type="relief-valve", at="PT", opens_at="200 bar", opening_range="20 bar", **RATED)["hydraulics"]
    two += record(type="flow-control", at="PA", **RATED)["hydraulics"]
    root = ET.fromstring(valve_diagram({"hydraulics": two}))
    names = [text.text for text in root.iter("{http://www.w3.org/2000/svg}text") if text.get("class") == "name"]
    assert names == ["valve", "valve"]
    assert valve_diagram({"hydraulics": []}) == ""
