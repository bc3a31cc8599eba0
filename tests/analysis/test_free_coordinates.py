"""Coordinates without stiffness that are named free: statics leaves them where they are, and refuses where a force acts on them."""

import pytest

import nivel
from nivel.errors import ModelError, SolveError
from nivel.files import parse_machine

WHEEL = """\
format: 1
gravity: [0, 0, -9.81]
bodies:
  block: {mass: 5, inertia: [1, 1, 1], position: [0, 0, 1]}
  wheel: {mass: 1, inertia: [1, 1, 1], position: [1, 0, 1]}
joints:
  rail: {type: translational, bodies: [ground, block], point: [0, 0, 1], axis: [0, 0, 1]}
  axle: {type: revolute, bodies: [block, wheel], point: [1, 0, 1], axis: [0, 1, 0]}
forces:
  spring: {type: spring-damper, bodies: [ground, block], points: [[0, 0, 0], [0, 0, 1]], stiffness: 1000, free_length: 1}
simulation: {duration: 0.5, step: 1 ms, start: equilibrium, free: [axle]}
"""
UNBALANCED = WHEEL.replace("wheel: {mass: 1,", "wheel: {mass: 1, centre_of_mass: [0.1, 0, 0],")


def loaded(text, tmp_path):
    file = tmp_path / "machine.yaml"
    file.write_text(text, encoding="utf-8")
    return nivel.load(file)


def test_a_wheel_that_may_spin_does_not_stop_the_search_for_equilibrium(tmp_path):
    result = loaded(WHEEL, tmp_path).statics()
    assert result.trust.verdict == "green"
    assert result.array("rail.displacement")[-1] == pytest.approx(-6 * 9.81 / 1000, rel=1e-8)


def test_a_run_from_equilibrium_stays_there(tmp_path):
    result = loaded(WHEEL, tmp_path).simulate()
    assert result.array("rail.displacement") == pytest.approx(-6 * 9.81 / 1000, rel=1e-8)
    assert result.array("axle.angle") == pytest.approx(0.0, abs=1e-12)


def test_without_its_name_the_wheel_is_a_mechanism(tmp_path):
    with pytest.raises(SolveError, match="the machine is a mechanism") as caught:
        loaded(WHEEL.replace(", free: [axle]", ""), tmp_path).statics()
    assert "`simulation: {free: [axle.angle]}`" in caught.value.advice


def test_a_machine_without_equilibrium_is_checked_as_drawn(tmp_path):
    facts = loaded(WHEEL.replace(", free: [axle]", ""), tmp_path).check()
    assert [each.words for each in facts.freedoms] == [
        "rail.displacement: block and wheel move",
        "axle.angle: wheel moves",
    ]
    assert "`simulation: {free: [axle.angle]}`" in facts.unsettled[1]


def test_a_rod_that_spins_between_two_balls_is_no_coordinate_to_be_named_free(tmp_path):
    rod = "  rod: {mass: 1, inertia: [1, 1, 1], position: [1, 1, 1]}\njoints:\n"
    balls = (
        "  left: {type: spherical, bodies: [ground, rod], point: [1, 1, 0]}\n"
        "  right: {type: point-on-line, bodies: [ground, rod], point: [1, 1, 2], axis: [0, 0, 1]}\n"
    )
    with pytest.raises(SolveError, match="rod, its turn about its z axis") as caught:
        loaded(WHEEL.replace("joints:\n", rod + balls), tmp_path).simulate()
    assert "free:" not in caught.value.advice
    assert "`nivel check` names every freedom" in caught.value.advice


def test_a_wheel_out_of_balance_is_not_free(tmp_path):
    with pytest.raises(SolveError, match=r"0.981 N m act on axle.angle") as caught:
        loaded(UNBALANCED, tmp_path).statics()
    assert caught.value.result.trust.verdict == "red"
    with pytest.raises(SolveError, match="this is no equilibrium"):
        loaded(UNBALANCED, tmp_path).simulate()


@pytest.mark.parametrize(
    ("free", "answer"),
    [
        ("[axl]", "did you mean `axle`"),
        ("[rail.y]", "is not known"),
        ("[axle.angle, motor]", "there is no joint `motor`"),
    ],
)
def test_what_is_named_free_is_a_joint_coordinate(free, answer):
    with pytest.raises(ModelError, match=answer):
        parse_machine(WHEEL.replace("[axle]", free))


def test_a_driven_coordinate_is_not_free():
    driven = WHEEL.replace("forces:", "drivers:\n  hold: {coordinate: axle.angle, value: 0}\nforces:").replace(
        "[axle]", "[axle.angle]"
    )
    with pytest.raises(ModelError, match="is driven by `hold`: it is not free"):
        parse_machine(driven)
