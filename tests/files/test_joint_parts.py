"""`rotor_inertia` of a joint adds ½ I ċ² to the kinetic energy, and nothing else; stops, friction and backlash are elements beside it."""

import numpy as np
import pytest

import nivel
from nivel.files import parse_machine

G, M, C, J = 9.81, 2.0, 0.4, 0.05
PENDULUM = f"""format: 1
gravity: [0, 0, -{G}]
parameters: {{I: 0.3 kg*m^2}}
bodies:
  bob: {{position: [{C}, 0, 0], mass: {M}, inertia: [{J}, {J}, {J}]}}
joints:
  pivot: {{type: revolute, bodies: [ground, bob], point: [0, 0, 0], axis: [0, 1, 0], rotor_inertia: I}}
simulation: {{duration: 2 ms, step: 1 ms}}
"""


def machine(text=PENDULUM):
    return nivel.Machine.from_record(parse_machine(text))


def test_it_is_added_to_the_mass_matrix_and_to_no_other_term():
    mechanics = machine().mechanics()
    np.testing.assert_allclose(mechanics.mass_matrix(), [[J + M * C**2 + 0.3]], rtol=1e-14)
    np.testing.assert_allclose(mechanics.bias(), [-M * G * C], rtol=1e-14)


@pytest.mark.parametrize(
    ("coordinates", "formulation"),
    [("relative", "newton-euler"), ("absolute", "newton-euler"), ("absolute", "lagrange")],
)
def test_the_first_acceleration_is_that_of_the_closed_form(coordinates, formulation):
    result = machine().simulate(coordinates=coordinates, formulation=formulation, verify=False)
    assert result.array("bob.angular_acceleration.y")[0] == pytest.approx(M * G * C / (J + M * C**2 + 0.3), rel=1e-12)


def test_of_a_length_it_is_a_mass_and_of_two_angles_each_has_its_own():
    slide = PENDULUM.replace("type: revolute", "type: translational").replace("rotor_inertia: I", "rotor_inertia: 3 kg")
    np.testing.assert_allclose(machine(slide).mechanics().mass_matrix(), [[M + 3.0]], rtol=1e-14)
    cross = PENDULUM.replace("type: revolute", "type: universal").replace(
        "axis: [0, 1, 0]", "axes: [[0, 1, 0], [0, 0, 1]]"
    )
    both = machine(cross.replace("rotor_inertia: I", "rotor_inertia: {angle_1: 0.1, angle_2: I}")).mechanics()
    about = J + M * C**2
    np.testing.assert_allclose(both.mass_matrix(), np.diag([about + 0.1, about + 0.3]), atol=1e-13)


def test_it_is_no_part_of_the_machine():
    """The mass, the centre and the inertia are those of the bob; a list, a scale or a motion in words names no rotor."""
    whole = machine().mass_properties()
    assert (whole.bodies, whole.mass, tuple(whole.centre_of_mass)) == (("bob",), M, (C, 0, 0))
    np.testing.assert_allclose(np.diag(whole.inertia), [J, J + M * C**2, J + M * C**2], rtol=1e-14)
    facts = machine().check()
    assert [body.name for body in facts.bodies] == ["bob"]
    assert [joint.name for joint in facts.joints] == ["pivot"]
    assert [freedom.words for freedom in facts.freedoms] == ["pivot.angle: bob moves"]
    assert "rotor of inertia 0.3 (SI) that turns with pivot.angle" in str(facts)
    result = machine().simulate(verify=False)
    assert [body["mass"] for body in result.scene["bodies"]] == [M, 0.0]
    heavy, light = (
        machine(PENDULUM.replace("I: 0.3", f"I: {moment}")).simulate(verify=False) for moment in (1e4, 1e-4)
    )
    assert heavy.trust.size == light.trust.size


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("rotor_inertia: -1", r"machine\.yaml:7:\d+: bodies\.pivot_rotor\.inertia: "),
        ("rotor_inertia: {angel: 1}", "there is no coordinate `angel`; its coordinate is `angle`"),
        ("rotor_inertia: 2 m", r"machine\.yaml:7:\d+: "),
    ],
)
def test_what_is_wrong_is_said_at_the_joint(given, message):
    with pytest.raises(nivel.ModelError, match=message):
        parse_machine(PENDULUM.replace("rotor_inertia: I", given))
    spherical = PENDULUM.replace("type: revolute", "type: spherical").replace(", axis: [0, 1, 0]", "")
    with pytest.raises(nivel.ModelError, match="has no coordinate that a rotor could follow"):
        parse_machine(spherical)


WHEEL = """format: 1
gravity: [0, 0, 0]
bodies:
  wheel: {position: [0, 0, 0], mass: 2, inertia: [0.1, 0.2, 0.1]}
joints:
  pivot:
    {type: revolute, bodies: [ground, wheel], point: [0, 0, 0], axis: [0, 1, 0], start: {angle: 0.2}, PARTS}
forces:
  push: {type: motor, coordinate: pivot, effort: 6}
simulation: {duration: 0.3 s, step: 1 ms}
"""


def test_stops_and_friction_of_a_joint_are_the_elements_beside_it():
    parts = "stops: {upper: 50 deg, stiffness: 1e4, restitution: 0.5}, friction: 2 N m"
    stop = "  pivot_stop: {type: stop, coordinate: pivot.angle, upper: 50 deg, stiffness: 1e4, restitution: 0.5}"
    friction = "  pivot_friction: {type: friction, coordinate: pivot.angle, model: stiction, coefficient: 1, normal_load: 2, radius: 1}"
    beside = WHEEL.replace(", PARTS", "").replace("simulation:", f"{stop}\n{friction}\nsimulation:")
    short, long = (parse_machine(text) for text in (WHEEL.replace("PARTS", parts), beside))
    assert short.forces == long.forces
    creeping = WHEEL.replace("PARTS", "friction: {angle: {effort: 2, model: coulomb, transition_speed: 1 mm/s}}")
    assert parse_machine(creeping).forces[-1].transition_speed == 1e-3


def test_with_backlash_the_rotor_runs_through_half_the_play_before_the_joint_moves():
    """From rest the rotor I = 0.3 needs t = √(2 I · 0.1/6) = 0.1 s; then 0.3 ω₁ + 0.2 ω₂ = 6 t."""
    parts = "rotor_inertia: 0.3, backlash: {play: 0.2 rad, stiffness: 1e4 N m/rad}"
    result = nivel.Machine.from_record(parse_machine(WHEEL.replace("PARTS", parts))).simulate(integrator="dopri5")
    rotor, wheel = (result.array(f"{name}.angle.rate") for name in ("pivot_rotor", "pivot"))
    free = result.time < 0.0999
    np.testing.assert_allclose(wheel[free], 0.0, atol=1e-12)
    np.testing.assert_allclose(rotor[free], 20.0 * result.time[free], atol=1e-9)
    np.testing.assert_allclose(0.3 * rotor + 0.2 * wheel, 6.0 * result.time, atol=1e-7)
    assert wheel[-1] > 1.0
    assert result.trust.verdict != "red"
    assert nivel.Machine.from_record(parse_machine(WHEEL.replace("PARTS", parts))).mass_properties().mass == 2.0


@pytest.mark.parametrize(
    ("parts", "message"),
    [
        ("friction: 2 m", r"machine\.yaml:7:\d+: forces\.pivot_friction\.normal_load: "),
        ("stops: 3", r"machine\.yaml:7:\d+: joints\.pivot\.stops: a mapping such as"),
        ("stops: {upper: 1 m, stiffness: 1, restitution: 1}", r"machine\.yaml:7:\d+: forces\.pivot_stop\.upper: "),
        ("friction: {effort: 1, radius: 2}", "`radius` must not be given with `effort`"),
        ("backlash: {play: 1 deg, stiffness: 2}", "give its `rotor_inertia` too"),
        ("rotor_inertia: 1, backlash: 1 deg", "`play` and `stiffness` of the flanks were expected"),
        ("stops: {coordinate: x, upper: 1}", "`coordinate` does not belong here"),
        ("rotor_inertia: 1, backlash: {play: 1 deg, stiffness: 2, free_value: 1}", "`free_value` does not belong here"),
    ],
)
def test_what_is_wrong_with_a_part_is_said_at_the_joint(parts, message):
    with pytest.raises(nivel.ModelError, match=message):
        parse_machine(WHEEL.replace("PARTS", parts))
