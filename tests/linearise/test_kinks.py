"""Kinks of forces: both slopes are told where a state lies on one, and nothing where it does not."""

import pytest

import nivel

STIFFNESS = 100.0


def mass(*forces, states=()):
    body = nivel.Body(name="m", mass=1.0, inertia=(1, 1, 1))
    rail = nivel.Joint(name="r", type="translational", bodies=("ground", "m"), point=(0, 0, 0), axis=(1, 0, 0))
    spring = nivel.JointSpringDamper(name="spring", coordinate="r", stiffness=STIFFNESS)
    return nivel.Machine("mass", bodies=[body], joints=[rail], forces=[spring, *forces], states=list(states))


def motor(effort):
    return nivel.Motor(name="act", coordinate="r", effort=effort)


def table(corner):
    points = {"deflections": [-1, corner, 1], "efforts": [-100, 100 * corner, 1000]}
    return nivel.JointSpringDamper(name="stop", coordinate="r", free_value=0.0, table=points)


KINKS = {
    "table": (table(0.0), "r.displacement", 200.0, 1100.0, "N/m"),
    "abs": (motor("-30*abs(r.displacement)"), "r.displacement", 70.0, 130.0, "N/m"),
    "max": (motor("-max(2e6*r.displacement, 0)"), "r.displacement", 100.0, 2000100.0, "N/m"),
    "min": (motor("min(5*r.displacement, 0)"), "r.displacement", 95.0, 100.0, "N/m"),
    "damper": (motor("-max(20*r.displacement_rate, 5*r.displacement_rate)"), "r.displacement.rate", 5.0, 20.0, "N s/m"),
}


@pytest.mark.parametrize(("force", "along", "lower", "upper", "unit"), KINKS.values(), ids=KINKS)
def test_both_slopes_of_a_kink_are_told(force, along, lower, upper, unit):
    model = mass(force).linearise()
    assert model.steady
    assert f"with {along} has the slope {lower:.6g} {unit} below and {upper:.6g} {unit} above" in model.notes[-1]


def test_a_kink_of_a_state_is_told():
    slow = nivel.State(name="slow", rate="min(-2*slow.value, -5*slow.value)", start=0.0, scale=1.0)
    model = mass(states=[slow]).linearise()
    assert "the rate of state.slow with state.slow has the slope -2 1/s" in model.notes[-1]


def test_what_jumps_has_no_eigenvalues():
    model = mass(motor("-3*sign(r.displacement_rate)")).linearise()
    assert not model.steady
    assert not model.modes
    assert "jumps where r.displacement.rate passes" in model.notes[-1]


SMOOTH = {
    "polynomial": motor("-1e6*r.displacement^3 + 7*sin(3*r.displacement) - 2*r.displacement_rate^3"),
    "contact by Hertz's law": motor("-1e6*max(r.displacement, 0)^1.5"),
    "steep": motor("-40*tanh(r.displacement_rate/1e-3)"),
    "kink beside the state": table(0.01),
    "drag": motor("-5*r.displacement_rate*abs(r.displacement_rate)"),
}


@pytest.mark.parametrize("force", SMOOTH.values(), ids=SMOOTH)
def test_smooth_forces_have_no_kink(force):
    assert mass(force).linearise().notes == ()


@pytest.mark.parametrize("name", ["beams/bend-45", "control/crane-control", "mechanisms/slider-crank"])
def test_examples_without_kinks_have_none(name):
    model = nivel.load(f"examples/{name}.yaml").linearise(about="equilibrium")
    assert not [each for each in model.notes if "kink" in each or "jump" in each]
