"""Forces count as soft where the step is short beside what they alone make of a body."""

import pytest

from nivel.analysis.plan.beam_facts import SOFT, is_soft
from nivel.files import parse_machine

STEP, MASS, INERTIA = 1e-3, 4.0, 0.5


def machine(force):
    return parse_machine(f"""
format: 1
name: m
gravity: [0, 0, -10]
bodies:
  box: {{mass: {MASS}, inertia: [{INERTIA}, 1, 1], shape: {{type: box, size: [1, 1, 1]}}}}
joints:
  turn: {{type: cylindrical, bodies: [ground, box], point: [0, 0, 0], axis: [0, 0, 1]}}
markers:
  floor: {{body: ground, position: [0, 0, -1], axis: [0, 0, 1]}}
forces:
  it: {{{force}}}
simulation: {{duration: 1, step: {STEP}}}
""")


def spring(coordinate, **given):
    return f"type: joint-spring-damper, coordinate: turn.{coordinate}, " + ", ".join(
        f"{k}: {v}" for k, v in given.items()
    )


def contact(more):
    return f"type: contact, body: box, plane: floor, restitution: 0.1, {more}"


@pytest.mark.parametrize(
    ("of", "limit"),
    [
        (lambda k: spring("angle", stiffness=k), INERTIA * (SOFT / STEP) ** 2),
        (lambda d: spring("angle", damping=d), INERTIA * SOFT / STEP),
        (lambda k: spring("displacement", stiffness=k), MASS * (SOFT / STEP) ** 2),
        (lambda k: contact(f"stiffness: {k}, exponent: 1"), MASS / 4 * (SOFT / STEP) ** 2),
        (
            lambda mu: contact(
                f"stiffness: 1, exponent: 1, friction: {mu}, friction_model: coulomb, friction_transition_speed: 0.1"
            ),
            SOFT / STEP * 0.1 / 30,
        ),
    ],
    ids=["spring", "damper", "length", "contact", "friction"],
)
def test_a_force_is_soft_up_to_its_limit(of, limit):
    """ω h or d/J h up to SOFT; ω² = k/J, k/m, 4 k/m of a corner; of friction 3 μ g / v_t."""
    for share, soft in ((0.99, True), (1.01, False)):
        made = machine(of(share * limit))
        assert is_soft(made, made.forces[0]) is soft


@pytest.mark.parametrize(
    "force",
    [
        contact("stiffness: 1"),
        contact("law: 1e3*depth").replace("restitution: 0.1, ", ""),
        spring("angle", law="value"),
    ],
    ids=["exponent", "law of a contact", "law of a spring"],
)
def test_what_does_not_follow_from_a_few_numbers_is_not_soft(force):
    made = machine(force)
    assert not is_soft(made, made.forces[0])


def test_a_hand_is_soft():
    made = machine("type: hand, pull: 1, body_number: 0, point: [0, 0, 0], towards: [0, 0, 1]")
    assert is_soft(made, made.forces[0])
