"""Fields that may vary: expressions with signals, tables, motions of drivers; their written form and schema."""

from typing import Annotated

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from nivel.errors import ModelError
from nivel.machine.core.record import Record
from nivel.machine.laws.time_function import (
    Expression,
    ForceComponent,
    Measured,
    PythonLaw,
    SpringForce,
    SpringTorque,
    Table,
    TimeFunction,
    TorqueComponent,
    read_time_function,
    signals_of,
    varying,
)
from nivel.machine.units.tree import ExpressionError, Number

AngleMotion = Annotated[TimeFunction, varying("angle", smooth=True)]
LengthMotion = Annotated[TimeFunction, varying("length", smooth=True)]
Motion = Annotated[TimeFunction, varying(("angle", "length"), smooth=True)]
Effort = Annotated[TimeFunction, varying(("force", "torque"))]


class Fields(Record):
    """A field of each type."""

    force: ForceComponent = 0.0
    torque: TorqueComponent = 0.0
    effort: Effort = 0.0
    speed: Annotated[TimeFunction, varying(("velocity", "angular velocity"))] = 0.0
    measured: Measured = 0.0
    spring_force: SpringForce = 0.0
    spring_torque: SpringTorque = 0.0
    spring_effort: Annotated[TimeFunction, varying(("force", "torque"), local=("value", "rate"))] = 0.0
    angle: AngleMotion = 0.0
    length: LengthMotion = 0.0
    motion: Motion = 0.0
    pressure: Annotated[TimeFunction, varying("pressure")] = 0.0


def read(field, value, parameters=None):
    context = {"parameters": {name: Number(number) for name, number in (parameters or {}).items()}}
    return getattr(Fields.model_validate({field: value}, context=context), field)


def refused(field, value):
    with pytest.raises(ModelError) as caught:
        Fields(**{field: value})
    return str(caught.value)


def cubic(**more):
    return {"times": [0, 1, 3, 4], "values": [0, 2, -1, 1], "interpolation": "cubic", **more}


@pytest.mark.parametrize(
    ("field", "text", "written"),
    [
        ("force", "-20*hinge.angle_rate", "-20.0*hinge.angle_rate"),
        ("force", "-2 kN*s/m * slide.displacement_rate", "-2000.0*slide.displacement_rate"),
        ("force", "3 N - 2 N*s/m * tip.vx", None),
        ("force", "5 N*sin(2*pi*time) - 20 N*s/m*slide.displacement_rate", None),  # time bare, the signal is not
        ("torque", "-3 N*m*s * hinge.angle_rate", None),
        ("torque", "1 N*m*sin(hinge.angle)", None),
        ("torque", "2 N * tip.x", None),
        ("effort", "2 N*m*s*a.rate + 3 N*m*s*b.angle_rate", None),
        ("effort", "2 N * time", None),
        ("speed", "3 rad/s * sin(time)", None),
        ("speed", "3 m/s * sin(time)", None),
        ("measured", "3 kg*tip.z^2", None),
        ("spring_force", "1 kN/m*(length - 0.2 m) + 5 N*s/m*rate", None),
        ("spring_torque", "1 N*m*(angle - 20 deg)^3 + rate", None),
        ("spring_effort", "1 kN/m*value + 5 N*s/m*rate", None),
        ("spring_effort", "1 kN*m/rad*value + 5 N*m*s/rad*rate", None),
        ("angle", "30 deg*sin(2*pi*time)", None),
        ("angle", "2 rpm*time", None),
        ("length", "2 cm*cos(3 rad/s*time)", None),
        ("pressure", "2 bar*exp(-time)", None),
    ],
)
def test_expressions_are_read_and_written(field, text, written):
    function = read(field, text)
    assert isinstance(function, Expression)
    assert written is None or function.text == written
    assert read(field, function.text) == function
    assert Fields(**{field: function}).model_dump()[field] == function.text


@pytest.mark.parametrize(
    ("field", "text", "part"),
    [
        ("force", "3 m*hinge.angle", "is a length (m); a force (N) was expected"),
        ("force", "1 N + 1 kg*tip.vx", "cannot be added"),
        ("force", "hinge", "`hinge` is neither a parameter nor a unit"),
        ("force", "2*length*time", "(only the `law` of a spring knows its `length`)"),
        ("effort", "2 m*time", "a force (N) or a torque (N*m) was expected"),
        ("effort", "2 kg", "a force (N) or a torque (N*m) was expected"),
        ("spring_torque", "2*length", "`length` is neither"),
        (
            "angle",
            "2*hinge.angle",
            "`hinge.angle` is only known while the machine moves; a driver depends on `time` alone",
        ),
        ("angle", "abs(time)", "`abs` has corners; a driver must be smooth"),
        ("angle", "3 m*time", "is a length (m); an angle (rad) was expected"),
        ("angle", "3 Hz*time^2", "an angle (rad) was expected"),
        ("motion", "3 kg*time", "an angle (rad) or a length (m) was expected"),
        ("angle", cubic(of="hinge.angle", points=[0, 1, 3, 4], times=None), "write `points`"),
        (
            "angle",
            Table((0, 1, 2), (0, 1, 2), "cubic", "hinge.angle"),
            "a driver depends on `time` alone, not on `hinge.angle`",
        ),
        ("measured", None, "a number or a quantity was expected, got nothing"),
    ],
)
def test_refused_with_the_reason(field, text, part):
    assert part in refused(field, text)


def test_where_nothing_varies_symbols_are_refused():
    class Plain(Record):
        """A quantity that is constant."""

        length: Annotated[TimeFunction, varying("length")] = 0.0

    assert Plain(length="2 cm").length == 0.02
    from nivel.machine.units.quantity import read_quantity

    for text, part in [
        (
            "2*hinge.angle",
            "`hinge.angle` may only be used where a value may vary: in forces, couplings of `type: function`, states, ",
        ),
        ("2*time", "`time` may only be used where a value may vary: in forces, drivers, states, sensors and events"),
        ("2*length", "(only the `law` of a spring knows its `length`)"),
    ]:
        with pytest.raises(ExpressionError) as caught:
            read_quantity(text, "length", {})
        assert part in str(caught.value)


def test_a_parameter_may_be_called_like_a_local_symbol_where_that_is_not_used():
    assert read("force", "2*length*time", {"length": 3.0}) == Expression("6.0*time")
    assert read("spring_force", "2*rate", {"length": 3.0}) == Expression("2.0*rate")
    with pytest.raises(ExpressionError, match="rename the parameter"):
        read_time_function("2*length", "force", {"length": Number(3.0)}, ("length", "rate"))


def test_signals_in_order_of_appearance():
    assert signals_of(Expression("b.x*a.y - b.x*time")) == ("b.x", "a.y")
    assert signals_of(read("spring_force", "3*rate + length")) == ("rate", "length")
    assert signals_of(Table((0, 1), (0, 1), of="hinge.angle")) == ("hinge.angle",)
    assert signals_of(Table((0, 1), (0, 1))) == signals_of(2.0) == ()
    assert signals_of(PythonLaw("", "f", ("time", "a.x", 2.0, "a.x"))) == ("a.x",)


def test_expressions_are_evaluated_with_values_of_signals():
    law = read("spring_force", "100*(length - 0.2) + time*probe.rate")
    assert law(2.0, {"length": 0.3, "probe.rate": 4.0}) == pytest.approx(18.0)
    with pytest.raises(ExpressionError, match="only known while the machine moves"):
        law(2.0)


# Tables


def test_cubic_tables_are_natural_splines():
    table = read("length", cubic())
    spline = CubicSpline(table.times, table.values, bc_type="natural")
    inside = np.linspace(0, 4, 33)
    assert [table(t) for t in inside] == pytest.approx(spline(inside))
    assert (table(-1), table(0), table(4), table(9)) == (0.0, 0.0, 1.0, 1.0)


strictly = st.lists(st.integers(-50, 50), min_size=3, max_size=9, unique=True).map(
    lambda xs: [x / 7 for x in sorted(xs)]
)


@settings(max_examples=60, deadline=None)
@given(strictly, st.sampled_from(["linear", "cubic"]), st.data())
def test_coefficients_are_those_of_the_table(times, interpolation, data):
    values = data.draw(st.lists(st.floats(-9, 9), min_size=len(times), max_size=len(times)))
    table = Table(times, values, interpolation)
    c = table.coefficients()
    assert c.shape == (len(times) - 1, 4)
    h = np.diff(times)
    np.testing.assert_array_equal(c[:, 0], values[:-1])
    ends = c[:, 0] + h * (c[:, 1] + h * (c[:, 2] + h * c[:, 3]))
    np.testing.assert_allclose(ends, values[1:], atol=1e-10)
    middle = [table(t) for t in times[:-1] + h / 2]
    np.testing.assert_allclose(
        c @ [1, 0, 0, 0] + (c[:, 1:] * (h[:, None] / 2) ** [1, 2, 3]).sum(axis=1), middle, atol=1e-10
    )
    if interpolation == "linear":
        assert not c[:, 2:].any()
        return
    slope, bend = c[:, 1] + h * (2 * c[:, 2] + 3 * h * c[:, 3]), 2 * c[:, 2] + 6 * h * c[:, 3]
    scale = 1 + np.abs(c).max()
    np.testing.assert_allclose(slope[:-1], c[1:, 1], atol=1e-9 * scale)
    np.testing.assert_allclose(bend[:-1], 2 * c[1:, 2], atol=1e-9 * scale)
    np.testing.assert_allclose([c[0, 2], bend[-1]], 0, atol=1e-9 * scale)  # natural


def test_a_table_of_one_point_is_constant():
    assert Table((1,), (5,)).coefficients().shape == (0, 4)
    assert Table((1,), (5,))(9) == 5


@pytest.mark.parametrize(
    ("field", "of", "points", "expected"),
    [
        ("force", "hinge.angle", ["0 deg", "180 deg"], (0.0, np.pi)),
        ("force", "left-hinge.angle_rate", ["0 rpm", "60 rpm"], (0.0, 2 * np.pi)),
        ("force", "tip.vx", ["0 km/h", "3.6 km/h"], (0.0, 1.0)),
        ("force", "probe.rate", ["0 m/s", "1 mm/s"], (0.0, 0.001)),
        ("spring_force", "length", ["1 cm", "2 cm"], (0.01, 0.02)),
        ("force", "probe.other", ["1 kg", 2], (1.0, 2.0)),
    ],
)
def test_tables_of_signals(field, of, points, expected):
    table = read(field, {"of": of, "points": points, "values": ["1 N", "2 kN"]})
    assert table == Table(expected, (1.0, 2000.0), of=of)
    assert Fields(**{field: table}).model_dump()[field] == {"of": of, "points": list(expected), "values": [1.0, 2000.0]}


@pytest.mark.parametrize(
    ("table", "part"),
    [
        ({"of": "hinge.angle", "times": [0], "values": [0]}, "`times` belong to a table of `time`; write `points`"),
        ({"points": [0], "values": [0]}, "a table of `time` has `times`; write `times`"),
        ({"of": "hinge.angle", "points": ["1 m"], "values": [0]}, "an angle (rad) was expected"),
        (
            {"of": "hinge.angle", "points": [1, 1], "values": [0, 0]},
            "points increase; 1 does not come after 1; for a jump place them close",
        ),
        ({"of": "hinge.angle", "points": [], "values": []}, "a table needs at least one point"),
        ({"of": "hinge.angle", "points": [1], "values": [0, 2]}, "as many values as points; got 2 and 1"),
        (
            {"of": "hinge", "points": [1], "values": [0]},
            "`time` or a symbol such as `hinge.angle` was expected, got `hinge`",
        ),
        ({"of": 3, "points": [1], "values": [0]}, "was expected, got `3`"),
        ({"of": "length", "points": [1], "values": [0]}, "got `length`"),
        ({"times": [0, 1], "values": [0, 1], "interpolation": "cubic"}, "at least three times, got 2"),
        ({"times": [0, 1], "values": [0, 1], "interpolation": "cubik"}, "did you mean `cubic`"),
        ({"times": [0, 1], "values": [0, 1], "interpolation": [1]}, "is not known"),
    ],
)
def test_tables_refused(table, part):
    assert part in refused("force", table)


@pytest.mark.parametrize(
    "table",
    [
        Table((0.0, 1.0), (2.0, 3.0)),
        Table((0.0, 1.0, 2.0), (2.0, 3.0, 1.0), "cubic"),
        Table((0.0, 1.0, 2.0), (2.0, 3.0, 1.0), "cubic", "hinge.angle"),
    ],
)
def test_tables_are_read_back(table):
    record = Fields(force=table)
    assert Fields(**record.model_dump()) == record


# The schema


def test_the_schema_tells_drivers_from_forces():
    properties = Fields.model_json_schema()["properties"]
    force, angle = properties["force"], properties["angle"]
    assert force["description"].startswith("a force (N): number, quantity, expression of `time`, signals")
    assert "`length`, `rate`" in properties["spring_force"]["description"]
    tables = [form for form in force["anyOf"] if "values" in form.get("properties", {})]
    assert [form["required"] for form in tables] == [["times", "values"], ["of", "points", "values"]]
    (table,) = [form for form in angle["anyOf"] if "values" in form.get("properties", {})]
    assert table["properties"]["interpolation"] == {"enum": ["linear", "cubic", "monotone", "quintic", "periodic"]}
    assert "of" not in table["required"]
