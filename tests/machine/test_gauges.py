"""What a machine file says of the gauges and levers that people see."""

import pytest

from nivel import Input, Sensor
from nivel.errors import ModelError
from nivel.live.picture import control, gauge
from nivel.words.wording import label_of

PRESSURE = {"name": "lift-cylinder", "value": "time", "units": "bar"}


@pytest.mark.parametrize(
    ("name", "label"),
    [("lift_lever", "Lift lever"), ("lift-cylinder", "Lift cylinder"), ("LS_pressure", "LS pressure"), ("x", "X")],
)
def test_a_name_becomes_a_label(name, label):
    assert label_of(name) == label


def test_a_plain_number_is_in_the_units_of_the_sensor_and_one_with_a_unit_is_converted():
    """1 MPa is 10 bar; an SI sensor has its numbers in SI: 180° are π."""
    sensor = Sensor(**PRESSURE, range=(0, "25 MPa"), limit="230 bar")
    assert sensor.range == pytest.approx((0.0, 250.0))
    assert sensor.limit == pytest.approx(230.0)
    turned = Sensor(name="a", coordinate="hinge", quantity="value", range=("-180 deg", 1.5))
    assert turned.range == pytest.approx((-3.141592653589793, 1.5))
    assert Sensor(**PRESSURE, range=sensor.range).range == sensor.range


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"limit": "3 m"}, "the sensor is in `bar`, which `3 m` is not"),
        ({"units": "%", "limit": "3 bar"}, "the sensor is in `%`, which is no unit; write a plain number"),
        ({"range": (250, 0)}, "the least value comes first and is below the greatest; got 250 and 0"),
        ({"limit": -1}, "a magnitude greater than zero was expected, got -1"),
    ],
)
def test_what_makes_no_gauge_is_refused(given, said):
    with pytest.raises(ModelError, match=said):
        Sensor(**PRESSURE | given)


def test_a_marker_has_no_scale():
    with pytest.raises(ModelError, match="`range` belongs to a sensor of one number"):
        Sensor(name="tip", marker="m", quantity="position", range=(0, 1))


def test_the_page_gets_labels_ranges_and_limits():
    sensors = {
        "lift-cylinder": Sensor(**PRESSURE, range=(0, 250), limit=230),
        "reach": Sensor(name="reach", distance=("a", "b"), label="Reach of the hook", range=(0, 7)),
    }
    lift = gauge("lift-cylinder", "bar", sensors)
    assert (lift.label, lift.low, lift.high, lift.limit) == ("Lift cylinder", 0.0, 250.0, 230.0)
    reach, rate = gauge("reach.distance", "m", sensors), gauge("reach.rate", "m/s", sensors)
    assert (reach.label, reach.high) == ("Reach of the hook", 7.0)
    assert (rate.label, rate.high) == ("Reach of the hook, rate", None)
    assert gauge("hinge.angle", "rad", sensors).label == "Hinge.angle"
    assert control(Input(name="lift_lever")).label == "Lift lever"
    assert control(Input(name="lift_lever", label="Boom")).label == "Boom"


def test_a_key_cannot_raise_and_lower_an_input():
    with pytest.raises(ModelError, match="`d` raises it already; another key was expected"):
        Input(name="lever", keys={"raise": "d", "lower": "D"})
