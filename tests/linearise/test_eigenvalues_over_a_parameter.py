"""Eigenvalues over a parameter: followed modes, Campbell's diagram and changes of stability against closed forms."""

import numpy as np
import pytest
from test_linearise import C_ROTOR, GRAVITY, gyroscope, nutation_and_precession

import nivel
from nivel.results.analyses.linear_sweep import LinearSweep

INERTIA, MOMENT = 1.7, 2.0 * GRAVITY


@pytest.fixture(scope="module")
def speeds():
    values = np.linspace(2.0, 10.0, 17)
    return LinearSweep("spin", "rad/s", values, tuple(gyroscope(spin=value).linearise() for value in values))


def test_modes_are_followed(speeds):
    """One vibration becomes slower with the spin and one faster, in closed form."""
    found = np.sort(speeds.eigenvalues.imag, axis=1)[:, -2:]
    np.testing.assert_allclose(found, [nutation_and_precession(value) for value in speeds.values], rtol=1e-9)
    upper = speeds.eigenvalues.imag[:, np.all(speeds.eigenvalues.imag > 0.0, axis=0)]
    assert upper.shape[1] == 2
    slopes = np.sign(np.diff(upper, axis=0))
    assert (slopes == slopes[0]).all()
    assert slopes[0].sum() == 0.0


def test_crossings_with_the_speed_are_those_of_the_closed_form(speeds):
    """I ω² ∓ C Ω ω = m g l at ω = Ω; interpolation between values 0.5 apart errs by its square over the curvature."""
    found = sorted(each.value for each in speeds.crossings([1.0]))
    wanted = [np.sqrt(MOMENT / (INERTIA + C_ROTOR)), np.sqrt(MOMENT / (INERTIA - C_ROTOR))]
    np.testing.assert_allclose(found, wanted, rtol=2e-3)


@pytest.mark.parametrize(("unit", "factor"), [("rpm", 30.0 / np.pi), ("deg/s", 180.0 / np.pi), ("Hz", 0.5 / np.pi)])
def test_crossings_do_not_depend_on_the_unit_of_the_speed(speeds, unit, factor):
    plain = speeds.crossings([1.0])
    other = LinearSweep("spin", unit, factor * speeds.values, speeds.models).crossings([1.0])
    assert [each.mode for each in other] == [each.mode for each in plain]
    for name, scale in (("speed", 1.0), ("frequency", 1.0), ("value", factor)):
        wanted = [scale * getattr(each, name) for each in plain]
        np.testing.assert_allclose([getattr(each, name) for each in other], wanted, rtol=1e-12)
    assert f" {unit} (" in other[0].words(unit)


def test_orders_belong_to_speeds_of_rotation(speeds):
    with pytest.raises(nivel.ModelError, match="spin is in mm"):
        LinearSweep("spin", "mm", speeds.values, speeds.models).crossings([1.0])


def test_a_value_that_meets_the_speed_exactly_is_one_crossing():
    """A mass on a spring, whose √(k/m) of 3 rad/s is one of the values."""
    body = nivel.Body(name="m", mass=2.0, inertia=(1, 1, 1))
    rail = nivel.Joint(name="rail", type="translational", bodies=("ground", "m"), point=(0, 0, 0), axis=(1, 0, 0))
    spring = nivel.JointSpringDamper(name="s", coordinate="rail", stiffness=18.0)
    model = nivel.Machine("m", bodies=[body], joints=[rail], forces=[spring]).linearise()
    for values in ([1.0, 2.0, 3.0, 4.0], [1.0, 3.0], [3.0, 4.0], [-4.0, -2.5, -1.0]):
        found = LinearSweep("speed", "rad/s", np.array(values), (model,) * len(values)).crossings([1.0])
        assert [abs(each.speed) for each in found] == pytest.approx([3.0], rel=1e-12)


def test_a_spring_that_becomes_negative_changes_the_stability():
    body = nivel.Body(name="m", mass=2.0, inertia=(1, 1, 1))
    rail = nivel.Joint(name="rail", type="translational", bodies=("ground", "m"), point=(0, 0, 0), axis=(1, 0, 0))

    def model(stiffness):
        push = nivel.Motor(
            name="push", coordinate="rail", effort=f"{-stiffness!r}*rail.displacement - rail.displacement_rate"
        )
        return nivel.Machine("m", bodies=[body], joints=[rail], forces=[push]).linearise()

    values = np.array([-3.0, -1.0, 1.0, 3.0])
    sweep = LinearSweep("stiffness", "N/m", values, tuple(model(float(value)) for value in values))
    assert sweep.stability_changes() == [(-1.0, 1.0)]
    dataset = sweep.to_xarray()
    np.testing.assert_allclose(np.abs(dataset["eigenvalue_real"].sum("mode")), 0.5, rtol=1e-12)


def test_values_have_to_ascend(speeds):
    with pytest.raises(nivel.ModelError, match="ascending values"):
        LinearSweep("spin", "", speeds.values[::-1], speeds.models)
