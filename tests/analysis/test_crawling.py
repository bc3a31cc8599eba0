"""A force that jumps with the motion holds a body at rest only by turning round in every step: the run says so instead of crawling."""

import numpy as np
import pytest

from nivel import SolveError
from nivel.analysis.curves.corners import jumping_functions
from nivel.api import Machine
from nivel.files import parse_machine

PUSH, SPEED = 3.0, 1.0


def slide(effort, more=""):
    """A mass of 1 kg at SPEED on a rail, which `effort` brakes."""
    return parse_machine(f"""
format: 1
bodies: {{cart: {{mass: 1, inertia: [1, 1, 1], velocity: [{SPEED}, 0, 0]}}}}
joints: {{rail: {{type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]}}}}
forces: {{rub: {{type: motor, coordinate: rail, effort: "{effort}"}}{more}}}
simulation: {{duration: 1}}
""")


@pytest.mark.parametrize("integrator", ["radau", "bdf"])
def test_a_run_that_sticks_under_a_sign_stops_and_names_it(integrator):
    """It comes to rest at v/a; what was computed until then is right, x = v²/(2 a)."""
    with pytest.raises(SolveError, match=r"steps have shrunk|no step from here") as caught:
        Machine.from_record(slide(f"-{PUSH}*sign(rail.displacement_rate)")).simulate(integrator=integrator)
    assert "sign(rail.displacement_rate)` of forces.rub jumps" in caught.value.advice
    assert "model: stiction" in caught.value.advice
    result = caught.value.result
    assert result.time[-1] == pytest.approx(SPEED / PUSH, rel=1e-4)
    assert result.array("cart.position.x")[-1] == pytest.approx(SPEED**2 / (2.0 * PUSH), rel=1e-4)


@pytest.mark.parametrize("integrator", ["dopri5", "radau"])
def test_a_switch_that_turns_to_and_fro_is_named_in_bounded_work(integrator):
    """Near its end, too: 30 ms after the cart stands. A condition that is passed once jumps as well, and is not the one."""
    effort = f"if(rail.displacement > 0.1, -{PUSH}, -{PUSH + 0.1})*sign(rail.displacement_rate)"
    record = slide(effort, ", far: {type: motor, coordinate: rail, effort: 'if(rail.displacement > 0.1, 0, 1e-3)'}")
    with pytest.raises(SolveError, match="steps have shrunk") as caught:
        Machine.from_record(record).simulate(integrator=integrator, tolerance=1e-8, duration=0.36)
    assert "forces.rub jumps" in caught.value.advice
    assert "forces.far" not in caught.value.advice
    assert caught.value.result.timing["steps"] < 30_000


def test_what_the_message_proposes_runs_to_the_end_and_is_right():
    """Within v_t²/a of the place where Coulomb's friction stops the body."""
    proposals = (
        slide(f"-{PUSH}*tanh(rail.displacement_rate/(1 mm/s))"),
        slide(
            "0",
            f", sole: {{type: friction, coordinate: rail, model: stiction, coefficient: 0.3, normal_load: {PUSH / 0.3}}}",
        ),
    )
    for machine in proposals:
        result = Machine.from_record(machine).simulate(integrator="radau", verify=True)
        assert result.trust.verdict == "green"
        np.testing.assert_allclose(result.array("cart.position.x")[-1], SPEED**2 / (2.0 * PUSH), atol=1e-5)


@pytest.mark.parametrize(
    ("effort", "jumps"),
    [
        ("if(rail.displacement > 0.1, -1, 0)", True),
        ("-2*(rail.displacement_rate > 0)", True),
        ("floor(3*rail.displacement)", True),
        ("sign(time - 0.5)", False),
        ("-2*abs(rail.displacement)", False),
    ],
)
def test_functions_that_jump_with_the_motion_are_known(effort, jumps):
    assert bool(jumping_functions(slide(effort))) is jumps


def test_a_motion_that_is_too_fast_for_its_duration_ends_with_words():
    """A mass of 1 kg on 10¹⁸ N/m vibrates with 10⁹ rad/s: in 10 s more steps than any computer makes. What was computed is right."""
    machine = parse_machine("""
format: 1
bodies: {cart: {mass: 1, inertia: [1, 1, 1], velocity: [1, 0, 0]}}
joints: {rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]}}
forces: {spring: {type: joint-spring-damper, coordinate: rail, stiffness: 1e18, damping: 0}}
simulation: {duration: 10, output_interval: 1 ms}
""")
    with pytest.raises(SolveError, match="the end is out of reach") as caught:
        Machine.from_record(machine).simulate(integrator="dopri5")
    assert "Is a unit wrong" in caught.value.advice
    result = caught.value.result
    assert 0.0 < result.time[-1] < 0.1
    assert abs(result.array("cart.position.x")[-1]) < 1.1e-9
