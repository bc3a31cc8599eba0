"""Copies of a machine in lanes: each has the motion that it has alone, and what its lane cannot do is done singly."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.errors import ModelError
from nivel.files import parse_machine
from nivel.native.processor import lane_count

pytestmark = pytest.mark.compiles
EXAMPLES = Path(__file__).parents[2] / "examples"
LANES = lane_count()
COUNT = LANES + 3
# machine, numbers of copies between shares of its own value, readings
MACHINES = {
    "control/cart-pole.yaml": (
        "bodies.pole.mass",
        0.5,
        2.0,
        ["hinge.angle", "joint_force", "cart.position", "energy_error"],
    ),
    "control/robot-arm.yaml": ("bodies.hand.mass", 0.5, 2.0, ["joint_coordinate", "joint_torque", "hand.orientation"]),
    "mechanisms/four-bar.yaml": ("bodies.crank.mass", 0.8, 1.2, ["joint_coordinate", "joint_force", "joint_rate"]),
    "mechanisms/slider-crank.yaml": ("bodies.rod.mass", 0.7, 1.4, ["joint_coordinate", "joint_force", "acceleration"]),
}
CART = """
format: 1
bodies: {cart: {mass: 2, inertia: [1, 1, 1]}}
joints: {rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]}}
inputs: {push: {range: [-10, 10]}}
forces: {drive: {type: motor, coordinate: rail.displacement, effort: push.value}}
events: {far: {when: rail.displacement - 1, direction: rising, stop: true}, half: {when: rail.displacement - 0.5}}
simulation: {duration: 1 s, step: 1 ms, integrator: rk4}
"""
# stiffness of the spring, which is an input too: 1e13 N/m are too stiff for the step
SPRUNG = """
format: 1
bodies: {cart: {mass: 2, inertia: [1, 1, 1]}}
joints:
  rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0], start: {displacement: 0.1}}
inputs: {stiffness: {range: [0, 1e14]}}
forces: {spring: {type: motor, coordinate: rail.displacement, effort: "-stiffness.value*rail.displacement"}}
simulation: {duration: 1 s, step: 1 ms, integrator: rk4}
"""


@pytest.fixture(scope="module")
def cart():
    return nivel.Machine.from_record(parse_machine(CART))


def agree(many, alone, names):
    """Whether copies have the numbers of those stepped singly, to round-off."""
    np.testing.assert_allclose(many.time, alone.time, rtol=1e-14)
    for name in names:
        wanted = alone[name]
        size = np.abs(wanted).max(initial=1e-300)
        np.testing.assert_allclose(many[name], wanted, rtol=0.0, atol=1e-11 * size, err_msg=name)


@pytest.mark.parametrize("file", MACHINES, ids=lambda file: Path(file).stem)
def test_copies_move_as_single_machines(file):
    path, low, high, names = MACHINES[file]
    machine = nivel.load(EXAMPLES / file)
    given = {
        "n": COUNT,
        "integrator": "rk4",
        "step": 1e-3,
        "values": {path: np.linspace(low, high, COUNT) * machine[path]},
    }
    many, alone = (machine.start(lanes=lanes, **given) for lanes in (True, False))
    random = np.random.default_rng(1)
    for _ in range(20):
        inputs = {}
        for name, each in machine.inputs.items():
            bottom, top = np.clip(each.range, -1.0, 1.0)
            inputs[name] = random.uniform(bottom, top, COUNT)
        for sims in (many, alone):
            sims.advance(5e-3, inputs)
    assert many.in_lanes.all()
    assert not alone.in_lanes.any()
    agree(many, alone, names)
    for sims in (many, alone):
        sims.step()
    agree(many, alone, names)


def test_copies_are_restored_one_by_one_at_any_time(cart):
    """x = ½ (F/m) (t - t₀)², from the last moment at which each was put back to its start."""
    many, pushes = cart.start(n=COUNT, lanes=True), np.linspace(-1.0, 1.0, COUNT)
    begin, since = many.states[0], np.zeros(COUNT)
    for k in range(COUNT):
        many.advance(0.01, {"push": pushes})
        many.restore(begin, [k])
        since[k] = 0.01 * (k + 1)
    assert many["rail.displacement"][-1] == 0.0
    assert not many.in_lanes[-1]
    many.advance(0.1, {"push": pushes})  # singly, and into its lane with the next
    many.advance(0.3, {"push": pushes})
    ages = 0.01 * COUNT + 0.4 - since
    np.testing.assert_allclose(many.time, ages, rtol=1e-13)
    np.testing.assert_allclose(many["rail.displacement"], 0.25 * pushes * ages**2, rtol=1e-10, atol=1e-15)
    assert many.in_lanes.all()


def test_states_of_copies_in_lanes_go_on_as_single_machines(cart):
    many = cart.start(n=COUNT, lanes=True)
    many.advance(0.2, {"push": np.linspace(1.0, 2.0, COUNT)})
    states, alone = many.states, cart.start()
    many.advance(0.1)
    for k in (0, COUNT - 1):
        alone.restore(states[k])
        alone.advance(0.1)
        assert alone["rail.displacement"] == pytest.approx(many["rail.displacement"][k], rel=1e-13)
        assert alone.steps == 300
    one = many[2]
    assert one["rail.displacement"] == many["rail.displacement"][2]
    many.step({"push": 0.0})
    assert not many.in_lanes[2]
    assert one.time == pytest.approx(0.301)
    assert one["push.value"] == 0.0
    assert many.in_lanes.sum() == COUNT - 1


def test_a_copy_that_an_event_ends_leaves_its_lane(cart):
    """½ (F/m) t² = 1 for F = 8 N, m = 2 kg at t = 1/√2 s; those with 2 N pass half a metre at 1 s."""
    pushes = np.full(COUNT, 2.0)
    pushes[3] = 8.0
    many = cart.start(n=COUNT, lanes=True)
    begin = many.states
    many.advance(0.9, {"push": pushes})
    assert (many.alive == (pushes < 8.0)).all()
    assert many.reasons[3] == "the event `far` ended it at t = 0.707107 s"
    assert many["rail.displacement"][3] == pytest.approx(1.0, abs=1e-12)
    np.testing.assert_allclose(np.delete(many["rail.displacement"], 3), 0.5 * 0.9**2, rtol=1e-12)
    many.advance(0.2)
    np.testing.assert_allclose(many.time, np.where(pushes < 8.0, 1.1, 0.5**0.5), rtol=1e-12)
    # all lanes had the same event in the same step: none left
    assert (many.in_lanes == (pushes < 8.0)).all()
    times = [[(each.name, each.time) for each in many[k].events] for k in (0, 3)]
    assert times == [[("half", pytest.approx(1.0))], [("half", pytest.approx(0.5)), ("far", pytest.approx(0.5**0.5))]]
    many.restore(begin[3], [3])
    many.advance(0.3, {"push": 2.0})
    assert many.alive.all()


def test_a_copy_that_fails_fails_alone():
    """x = x₀ cos √(k/m) t."""
    machine = nivel.Machine.from_record(parse_machine(SPRUNG))
    many, stiffness = machine.start(n=COUNT, lanes=True), np.linspace(20.0, 200.0, COUNT)
    many.advance(0.2, {"stiffness": stiffness})
    many.advance(0.3, {"stiffness": np.where(np.arange(COUNT) == 1, 1e13, stiffness)})
    assert (many.alive == (np.arange(COUNT) != 1)).all()
    assert "stopped at t = " in many.reasons[1]
    assert (many.in_lanes == many.alive).all()
    found = np.delete(many["rail.displacement"], 1)
    np.testing.assert_allclose(found, np.delete(0.1 * np.cos(np.sqrt(stiffness / 2.0) * 0.5), 1), atol=1e-7)


# nodes of those that have circuits alone, or mostly
PRESSURES = {"hydraulics/water-hammer.yaml": ("plant",)}


def of_all_kinds():
    """Examples: number of the machine to vary, or else gravity. All but a handful are for the full tests."""
    varied = {
        "contact": {"bouncing-ball": "ball", "conveyor": "", "friction-brake": "load", "rolling-coin": "coin"},
        "control": {"crane-control": "trolley", "servo-axis": "table", "six-axis-arm": "load"},
        "exchange": {"spindle": "", "trolley": "trolley"},
        "hydraulics": {
            "accumulator-press": "slide",
            "accumulator-station": "",
            "closed-transmission": "dumper",
            "cylinder-boom": "boom",
            "excavator": "boom",
            "faults": "load",
            "harvester-crane": "boom",
            "loader-crane": "boom",
            "pneumatic-pusher": "pusher",
            "position-servo": "slide",
            "positive-flow-excavator": "boom",
            "power-pack": "rotor",
            "two-pump-excavator": "boom",
            "water-hammer": "",
            "wheel-loader": "chassis",
        },
        "machines": {
            "backhoe-swing": "boom",
            "excavator": "boom",
            "flywheel-press": "",
            "isolated-pump": "floor",
            "mobile-crane": "turntable",
            "rope-crane": "column",
            "washing-machine": "tub",
        },
        "mechanisms": {"four-bar-revolutes": "", "gear-train": ""},
    }
    default = ("conveyor", "crane-control", "rope-crane", "gear-train")
    for folder, machines in varied.items():
        for name, body in machines.items():
            marks = () if name in default else pytest.mark.full
            yield pytest.param(f"{folder}/{name}.yaml", body, marks=marks, id=f"{folder}-{name}")


@pytest.mark.parametrize(("file", "body"), [*of_all_kinds()])
def test_copies_of_machines_of_all_kinds_move_as_single_ones(file, body):
    machine = nivel.load(EXAMPLES / file)
    if body:
        values = {f"bodies.{body}.mass": np.linspace(0.9, 1.1, COUNT) * machine[f"bodies.{body}.mass"]}
    else:
        values = {"gravity": [[0.0, 0.1 * k, -9.0 - 0.1 * k] for k in range(COUNT)]}
    given = {"n": COUNT, "integrator": "rk4", "coordinates": "relative", "step": 2e-4, "values": values}
    many, alone = (machine.start(lanes=lanes, **given) for lanes in (True, False))
    for _ in range(4):
        for sims in (many, alone):
            sims.advance(1e-3)
    assert many.in_lanes.any()
    assert many.alive.all()
    pressures = [f"hydraulics.{name}.pressure" for name in PRESSURES.get(file, ())]
    motion = ["position", "velocity"] if machine.bodies else []
    joints = ["joint_coordinate", "joint_rate", "joint_force"] if machine.joints else []
    agree(many, alone, [*pressures, *motion, *joints])


def test_copies_of_another_structure_go_beside_the_lanes(cart):
    """A copy without mass of its own kind is refused; one with other whole numbers is stepped singly."""
    values = {"simulation.integrator": ["rk4"] * (COUNT - 1) + ["heun"]}
    many = cart.start(n=COUNT, lanes=True, values=values)
    many.advance(0.2, {"push": 2.0})
    assert (many.in_lanes == (np.arange(COUNT) < COUNT - 1)).all()
    np.testing.assert_allclose(many["rail.displacement"], 0.5 * 0.2**2, rtol=1e-10)


@pytest.mark.parametrize(
    ("given", "why"),
    [
        ({"integrator": "am2"}, "`am2` is not explicit"),
        ({"integrator": "ab2"}, "`ab2` remembers earlier steps"),
        ({"coordinates": "absolute"}, "its coordinates are not relative"),
        ({"n": 1}, "there are too few"),
    ],
)
def test_what_cannot_go_in_lanes_says_why(cart, given, why):
    given = {"n": 3, **given}
    with pytest.raises(ModelError, match=f"^copies cannot go in lanes: {why}"):
        cart.start(lanes=True, **given)
    many = cart.start(**given)
    many.step({"push": 1.0})
    assert why in many.not_in_lanes
    assert not many.in_lanes.any()
    with pytest.raises(ModelError, match="lanes: several copies go in lanes: say how many"):
        cart.start(lanes=True)
