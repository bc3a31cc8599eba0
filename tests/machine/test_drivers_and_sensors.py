"""Drivers and sensors: their forms, units, and what they refuse."""

import pytest
from refusals import refused

from nivel import Driver, Event, Expression, Sensor, Table

TURNS = "def turn(t):\n    return t, 1.0, 0.0\n"


def test_the_kind_of_a_driver_follows_from_its_coordinate_or_axis():
    assert Driver(name="d", coordinate="hinge.angle", value="90 deg").value == pytest.approx(1.5707963267948966)
    assert Driver(name="d", coordinate="slide.displacement", value="90 cm").kind == "length"
    assert Driver(name="d", coordinate="hinge", value="90 deg").kind is None
    assert Driver(name="d", marker="tip", along="x", value="2 m/s * time").kind == "length"
    driver = Driver(name="d", marker="tip", about="z", relative_to="base", value="2*pi*time")
    assert (driver.kind, driver.reference) == ("angle", "base")
    assert Driver(name="d", marker="tip", along="x", relative_to="ground", value=0).reference is None


def test_what_drives_is_smooth():
    assert Driver(name="d", coordinate="h.angle", value={"source": TURNS, "function": "turn", "arguments": ["time"]})
    assert Driver(name="d", coordinate="h.angle", value=Table((0, 1, 2), (0, 1, 4), "cubic"))
    assert Driver(name="d", coordinate="h.angle", value="sin(time)").value == Expression("sin(time)")


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({"value": 1}, "drivers.d: a driver needs a `coordinate`, or a `marker` and `along` or `about`"),
        ({"coordinate": "h.angle"}, "`value` is missing"),
        (
            {"coordinate": "h.angle", "value": "1 m"},
            "drivers.d.value: `1 m` is a length (m); an angle (rad) was expected",
        ),
        (
            {"coordinate": "h.x", "value": "1 rad"},
            "drivers.d.value: `1 rad` is an angle (rad); a length (m) was expected",
        ),
        ({"coordinate": "h", "value": "1 kg"}, "was expected"),
        ({"marker": "tip", "along": "x", "value": "1 rad"}, "a length (m) was expected"),
        ({"marker": "tip", "about": "z", "value": "1 m"}, "an angle (rad) was expected"),
        ({"coordinate": "h.angle", "value": "abs(time)"}, "has corners; a driver must be smooth"),
        ({"coordinate": "h.angle", "value": "2*k.angle"}, "drivers.d.value"),
        ({"coordinate": "h.angle", "marker": "tip", "value": 1}, "drivers.d.marker: `marker` must not be given"),
        ({"coordinate": "h.angle", "relative_to": "tip", "value": 1}, "drivers.d.relative_to: `relative_to` must not"),
        ({"marker": "tip", "value": 1}, "`along` or `about` is missing"),
        (
            {"marker": "tip", "along": "x", "about": "z", "value": 1},
            "drivers.d.about: `about` stands in place of `along`",
        ),
        ({"marker": "tip", "about": "w", "value": 1}, "drivers.d.about: the word `w` is not known; there are x, y, z"),
        ({"marker": "tip", "along": "x", "relative_to": "tip", "value": 1}, "does not move relative to itself"),
    ],
)
def test_drivers_refused(given, part):
    assert part in refused(Driver, name="d", **given)


@pytest.mark.parametrize(
    ("given", "form"),
    [
        ({"marker": "tip", "quantity": "velocity", "relative_to": "base"}, "marker"),
        ({"coordinate": "hinge", "quantity": "acceleration"}, "coordinate"),
        ({"distance": ("tip", {"body": "rod", "position": (1, 0, 0)})}, "distance"),
        ({"angle": ("tip", "base")}, "angle"),
        ({"force": "spring", "quantity": "power"}, "force"),
        ({"value": "0.5*hinge.angle_rate^2 + 3 N", "units": "N"}, "value"),
    ],
)
def test_sensors_have_one_of_six_forms(given, form):
    assert Sensor(name="s", **given).form == form


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({}, "sensors.s: a sensor needs one of marker, coordinate, distance, angle, force, value"),
        ({"marker": "tip", "force": "spring", "quantity": "power"}, "got marker and force"),
        ({"marker": "tip"}, "`quantity` is missing: what is measured of the marker"),
        ({"marker": "tip", "quantity": "speed"}, "sensors.s.quantity: the quantity `speed` is not known"),
        ({"marker": "tip", "quantity": "angular_velocty"}, "did you mean `angular_velocity`?"),
        ({"marker": "tip", "quantity": 5}, "a quantity such as `velocity` was expected, got `5`"),
        ({"marker": "tip", "quantity": "position", "relative_to": "tip"}, "does not move relative to itself"),
        ({"coordinate": "h", "quantity": "position"}, "did you mean `value`"),
        ({"coordinate": "h", "quantity": "rate", "relative_to": "tip"}, "sensors.s.relative_to: `relative_to` belongs"),
        ({"distance": ("a", "b"), "quantity": "rate"}, "sensors.s.quantity: `quantity` belongs"),
        ({"distance": ("a", "a")}, "sensors.s.distance: distance is measured between two different markers"),
        ({"angle": ("a",)}, "sensors.s.angle: entries are missing"),
        ({"distance": ("a", "b"), "units": "m"}, "sensors.s.units: `units` belongs to a `value`"),
        ({"value": "2 m + 3 kg + h.angle"}, "cannot be added"),
    ],
)
def test_sensors_refused(given, part):
    assert part in refused(Sensor, name="s", **given)


@pytest.mark.parametrize(
    ("when", "part"),
    [
        (
            "hinge.angle - 2 m",
            "`hinge.angle` is an angle (rad); a length (m) cannot be added to it or subtracted from it",
        ),
        ("2 kg - arm.x", "`arm.x` is a length (m); a mass (kg)"),
        ("-(time + 1) - 3 m", "`time` is a time (s); a length (m)"),
        ("arm.x - 3 deg", "`arm.x` is a length (m); an angle (rad)"),
        ("gap.rate - 3 N", "`gap.rate` is a velocity (m/s) or an angular velocity (rad/s); a force (N)"),
    ],
)
def test_an_event_does_not_add_unlike_terms(when, part):
    assert f"events.e.when: `{when}`: {part}" in refused(Event, name="e", when=when)


@pytest.mark.parametrize(
    "when",
    [
        "arm.x - 20 cm",
        "hinge.angle - 30 deg",
        "hinge.angle_rate - 30 rpm",
        "200*arm.x - 5 N",
        "gap.rate - 1",
        "a.b - 1 N",
    ],
)
def test_an_event_of_like_or_bare_terms_is_taken(when):
    assert Event(name="e", when=when).when
