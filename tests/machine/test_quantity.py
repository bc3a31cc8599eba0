"""Units and dimensions of quantities."""

import math
import subprocess
import sys

import numpy as np
import pytest

from nivel.machine.units.quantity import read_quantity
from nivel.machine.units.tree import ExpressionError, Number
from nivel.machine.units.unit import KINDS, UNITS, _ask_pint, dimension, symbol, unit


@pytest.mark.parametrize("name", [name for name in UNITS if name not in ("°", "rev", "Nm", "kNm")])
def test_the_table_of_units_agrees_with_pint(name):
    # pint takes `Nm` for the number of yarn
    asked = _ask_pint(name)
    assert asked is not None
    assert asked.dimension == UNITS[name].dimension
    assert asked.factor == pytest.approx(UNITS[name].factor, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "kind", "expected"),
    [
        (3, "mass", 3.0),
        ("3", "mass", 3.0),
        ("3 lb", "mass", 1.36077711),
        ("2 * 3 kg", "mass", 6.0),
        ("10 cm + 5", "length", 5.1),
        ("1 mile", "length", 1609.344),
        ("1 inch", "length", 0.0254),
        ("2 m * 3 rad/s", "velocity", 6.0),
        ("9.81 m/s^2", "acceleration", 9.81),
        ("7850 kg/m^3", "density", 7850.0),
        ("500 kg*cm^2", "inertia", 0.05),
        ("1 J", "torque", 1.0),
        ("2 rev/s", "angular velocity", 4 * math.pi),
        ("sqrt(4 m^2)", "length", 2.0),
        ("atan2(1 m, 1 m)", "angle", math.pi / 4),
        ("max(1 mm, 2 cm)", "length", 0.02),
        ("asin(1)", "angle", math.pi / 2),
        ("sin(30 deg) * 2 m", "length", 1.0),
        ("10 cm / (5 cm)", "number", 2.0),
        ("30 deg", "number", math.pi / 6),
        (np.float64(2.5), "length", 2.5),
        (np.int64(2), "length", 2.0),
        (np.array(2.0), "length", 2.0),
    ],
)
def test_reads_in_si(text, kind, expected):
    assert read_quantity(text, kind, {}) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "kind", "part"),
    [
        ("3 m", "mass", "`3 m` is a length (m); a mass (kg) was expected"),
        ("30 deg", "length", "is an angle (rad); a length (m) was expected"),
        ("3 Hz", "angular velocity", "write `rev/s`"),
        ("1/(2 rad)", "angle", "an angle (rad) was expected"),
        ("3 kg*m", "torque", "`3 kg*m` is a moment of inertia per length (kg*m); a torque (N*m) was expected"),
        ("3 kg*m*s", "torque", "is a quantity in kg*m*s"),
        ("1 m + 1 kg", "length", "a length (m) and a mass (kg) cannot be added"),
        ("1 m - 1 s", "length", "cannot be subtracted"),
        ("max(1 m, 1 s)", "length", "cannot be compared"),
        ("sin(1 m)", "number", "`sin` is taken of an angle"),
        ("exp(1 s)", "number", "`exp` is taken of a pure number"),
        ("2^(1 m)", "number", "an exponent is a pure number"),
        ("2*time", "length", "`time` may only be used"),
        (math.nan, "length", "not a number"),
        (math.inf, "length", "too large"),
        (True, "length", "got `true`"),
        (None, "mass", "got nothing"),
        ([1], "mass", "got a list"),
        ({}, "mass", "got a mapping"),
        (1j, "mass", "a mass (kg) was expected"),
    ],
)
def test_refuses_what_is_something_else(text, kind, part):
    with pytest.raises(ExpressionError) as caught:
        read_quantity(text, kind, {})
    assert part in str(caught.value)


def test_parameters_carry_their_dimension():
    parameters = {"arm": Number(0.25, dimension(m=1)), "plain": Number(0.5)}
    assert read_quantity("2*arm + 5 mm", "length", parameters) == pytest.approx(0.505)
    assert read_quantity("2*plain + 5 mm", "length", parameters) == pytest.approx(1.005)
    with pytest.raises(ExpressionError, match="is a length"):
        read_quantity("2*arm", "mass", parameters)


def test_ordinary_units_do_not_load_pint():
    code = (
        "import sys; from nivel import Body; Body(name='a', mass='2 kg', inertia=('1 kg*m^2',)*3, position=('1 cm', 0, 0));"
        "sys.exit(any(m in sys.modules for m in ('pint', 'yaml', 'numba', 'xarray', 'scipy', 'matplotlib')))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize("kind", KINDS)
def test_the_unit_of_every_kind_reads_back(kind):
    _, si, its = KINDS[kind]
    for written in (si, symbol(its)):
        text = f"3*({written})" if written.startswith("1") else f"3 {written}"
        if kind != "frequency" or written == "Hz":
            assert read_quantity(text.replace("cycle", "rev"), kind, {}) == 3


def test_a_unit_without_multiplication_is_refused():
    for name in ("degC", "degF", "dB", "nonsense", "_", "a" * 300):
        with pytest.raises(ValueError, match="is not known"):
            unit(name)


def test_newton_metres_may_be_written_together():
    from nivel import Torque

    torque = Torque(name="t", body="b", vector=("10 Nm", "2 kNm", "3 N m"))
    assert torque.vector == (10.0, 2000.0, 3.0)
