"""Many copies of a machine stepped by one call: each is what it would be alone."""

import numpy as np
import pytest

import nivel
from nivel.errors import ModelError
from nivel.files import parse_machine

CART = """
format: 1
bodies: {cart: {mass: 2, inertia: [1, 1, 1]}}
joints: {rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]}}
inputs: {push: {range: [-10, 10]}}
forces: {drive: {type: motor, coordinate: rail.displacement, effort: push.value}}
events: {far: {when: rail.displacement - 1, direction: rising, stop: true}}
simulation: {duration: 1 s, step: 1 ms, integrator: rk4}
"""


@pytest.fixture(scope="module")
def machine():
    return nivel.Machine.from_record(parse_machine(CART))


def test_copies_move_as_single_machines_to_the_last_bit(machine):
    pushes = np.array([-3.0, 0.0, 2.0, 5.0])
    many = machine.start(n=4)
    many.advance(0.2, {"push": pushes})
    many.step({"push": 1.0})
    for k, push in enumerate(pushes):
        alone = machine.start()
        alone.advance(0.2, {"push": push})
        alone.step({"push": 1.0})
        assert many["rail.displacement"][k] == alone["rail.displacement"]
    assert many["cart.position"].shape == (4, 3)
    np.testing.assert_allclose(many.time, 0.201)


def test_copies_with_other_numbers(machine):
    """x = ½ (F/m) t² of each mass."""
    masses = np.array([1.0, 2.0, 4.0])
    many = machine.start(n=3, values={"bodies.cart.mass": masses})
    many.advance(0.5, {"push": 2.0})
    np.testing.assert_allclose(many["rail.displacement"], 0.25 / masses, rtol=1e-12)


def test_a_copy_that_ends_stands_still_until_it_is_restored(machine):
    """½ (F/m) t² = 1 for F = 8 N, m = 2 kg at t = 1/√2 s."""
    many = machine.start(n=2)
    begin = many.states
    many.advance(1.0, {"push": [8.0, 1.0]})
    assert many.alive.tolist() == [False, True]
    assert many.reasons == ["the event `far` ended it at t = 0.707107 s", ""]
    np.testing.assert_allclose(many.time, [0.5**0.5, 1.0])
    many.restore(begin[0], ~many.alive)
    np.testing.assert_allclose(many.time, [0.0, 1.0])
    assert many.alive.all()
    assert many.reasons == ["", ""]
    assert many[0].time == 0.0


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda m: m.start(n=0), "at least 1"),
        (lambda m: m.start(n=2, record=True), "copies keep no frames"),
        (lambda m: m.start(values={"bodies.cart.mass": [1.0]}), "say how many, n=3"),
        (lambda m: m.start(n=2, values={"bodies.cart.mass": [1.0]}), "lists of 2 values are needed; there are 1"),
        (lambda m: m.start(n=2).step({"push": [1.0, 2.0, 3.0]}), "a number, or 2 of them, was expected"),
        (lambda m: m.start(n=2).step({"psh": 1.0}), "did you mean `push`"),
        (lambda m: m.start(n=2).step({"push": [1.0, 11.0]}), "outside the range"),
    ],
)
def test_faults_say_what_to_write(machine, call, message):
    with pytest.raises(ModelError, match=message):
        call(machine)
