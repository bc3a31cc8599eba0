"""The machines of `nivel demo`: they are ready to be driven, stand still at rest, and go where their levers say."""

import numpy as np
import pytest

import nivel
from nivel import Table
from nivel.demos import DEMOS, FOLDER, demo_file
from nivel.live.preparation import live_plan
from nivel.live.recording import Recording, Take
from nivel.live.replay import replay
from nivel.machine.bodies.inertia import mass_properties

HYDRAULIC = {
    "loader-crane": {
        "lift_lever": "luffing.angle",
        "jib_lever": "folding.angle",
        "extension_lever": "telescope.displacement",
    },
    "excavator": {"boom_lever": "foot.angle", "stick_lever": "elbow.angle"},
    "wheel-loader": {"lift_lever": "boom_pin.angle"},
}
REST, PUSHED, END = 0.1, 0.35, 0.8  # s
STILL = 2e-3  # m: oil in closed chambers settles by less


def test_every_machine_of_the_folder_is_a_demo_and_the_first_is_the_loader_crane():
    assert {path.stem for path in FOLDER.glob("*.yaml")} == set(DEMOS)
    assert next(iter(DEMOS)) == "loader-crane"


@pytest.mark.parametrize("name", DEMOS)
def test_a_demo_is_live_at_one_kilohertz_and_every_input_says_what_it_does(name):
    machine = nivel.load(demo_file(name)).record
    _, pace = live_plan(machine, {}, None)
    assert pace.tick == pytest.approx(1e-3)
    assert machine.inputs
    for each in machine.inputs:
        assert each.description
        assert each.hold or (each.keys and each.gamepad and each.stick)
    keys = [key for each in machine.inputs if each.keys for key in (each.keys.raise_, each.keys.lower)]
    assert len(set(keys)) == len(keys)


def test_a_recorded_crane_is_replayed_with_its_trust_and_the_guard_of_its_circuit():
    """Forty ticks in which the boom lever is pushed; without frames there is nothing to compare."""
    plan, pace = live_plan(nivel.load(demo_file("loader-crane")).record, {}, None)
    tape = np.zeros((40, len(plan.machine.inputs)))
    lever = [each.name for each in plan.machine.inputs].index("lift_lever")
    tape[:, lever] = np.minimum(0.004 * np.arange(1, 41), 1.0)
    take = Take(tape, np.zeros((0, 1)))
    again = replay(Recording(plan.machine, "", {}, pace, (take,)), take)
    assert again.compared == 0
    assert "pressure steps" in {item.name for item in again.result.trust.items}
    assert again.result.array("lift_lever.value")[-1] == pytest.approx(tape[-1, lever], abs=0.03)


@pytest.mark.parametrize(
    ("name", "lever", "coordinate"), [(name, *each) for name, moved in HYDRAULIC.items() for each in moved.items()]
)
def test_a_hydraulic_machine_stands_still_until_a_lever_raises_what_it_says(name, lever, coordinate):
    table = Table((0, REST, PUSHED, END), (0, 0, 1, 1))
    result = nivel.load(demo_file(name)).simulate(duration=END, output_interval=0.05, inputs={lever: table})
    position, resting = result.array("position"), result.time <= REST + 1e-9
    assert resting.sum() > 2
    assert np.abs(position[resting] - position[0]).max() < STILL
    course = result.array(coordinate)
    assert course[-1] - course[0] > 0.02  # rad or m


@pytest.mark.parametrize("name", DEMOS)
def test_a_demo_is_painted_and_its_masses_follow_from_what_is_written_alone(name):
    """Every solid has a colour of its role; without looks and surroundings the numbers of all bodies are the same."""
    machine = nivel.load(demo_file(name)).record
    plain = machine.replace(surroundings=(), bodies=tuple(body.replace(looks=()) for body in machine.bodies))
    for body, bare in zip(machine.bodies, plain.bodies, strict=True):
        assert all(shape.colour for shape in (body.shape, *body.looks) if shape is not None)
        assert mass_properties(body).mass == mass_properties(bare).mass
        np.testing.assert_array_equal(mass_properties(body).inertia, mass_properties(bare).inertia)
    assert all(shape.colour for shape in machine.surroundings)
    for sensor in machine.sensors:
        assert sensor.range is None or sensor.limit is None or sensor.limit <= max(map(abs, sensor.range))


def energy_error(result):
    """The largest error of energy as a share of the largest energy, of which an amber trust report allows 0.01."""
    return result.trust.energy_error_max / result.trust.energy_scale


def test_a_crane_that_pushes_its_load_into_the_ground_keeps_its_energy():
    """Boom up, outer boom down, extension out: the hook pushes the load, which slides and does not leap. The whole test of 4 s."""
    levers = {"lift_lever": -1, "jib_lever": -1, "extension_lever": 1}
    tables = {lever: Table((0, 0.3, 30), (0, end, end)) for lever, end in levers.items()}
    result = nivel.load(demo_file("loader-crane")).simulate(verify=False, duration=4, inputs=tables)
    assert energy_error(result) < 1e-3
    assert result.array("sensor.load-height").min() > -0.02


@pytest.mark.parametrize("lengths", [{}, {"ground_bar": 1.6, "crank_bar": 0.15, "rocker_bar": 0.4}, {"crank_bar": 0.6}])
def test_a_four_bar_keeps_its_energy_at_rest_and_with_lengths_at_their_ends(lengths):
    machine = nivel.load(demo_file("four-bar"))
    rest = {each.name: each.rest_value for each in machine.record.inputs}
    tables = {name: Table((0, 0.5, 3, 5), (rest[name], rest[name], end, end)) for name, end in lengths.items()}
    assert energy_error(machine.simulate(verify=False, inputs=tables)) < 1e-4


def test_a_loader_that_drives_into_its_heap_fills_its_bucket():
    tables = {
        "drive_lever": Table((0, 0.3, 0.7, 30), (0, 0, 0.7, 0.7)),
        "tilt_lever": Table((0, 2.6, 3, 30), (0, 0, -0.5, -0.5)),
    }
    machine = nivel.load(demo_file("wheel-loader"))
    result = machine.simulate(verify=False, duration=4, output_interval=0.05, inputs=tables)
    assert (
        result.timing["evaluations"] < 4.2 * result.timing["steps"]
    )  # derivatives by hand: soil is soft beside a step
    assert result.array("force.digging.load")[-1] > 800.0
    for each in ("digging", "dump_body", "fl_wheel"):
        assert np.abs(result.array(f"force.{each}.balance")).max() < 1e-11
    # of the yard, of 10.4 m³ in the heap
    assert result.array("force.digging.spilt").max() == 0.0
    assert energy_error(result) < 1e-2


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.full if name == "wheel-loader" else ()) for name in HYDRAULIC]
)
def test_gauges_of_a_demo_stay_on_their_scales(name):
    """With each lever held at either end until its actuator is there."""
    machine = nivel.load(demo_file(name))
    scaled = [each for each in machine.record.sensors if each.range is not None]
    assert scaled
    for lever in (each for each in machine.record.inputs if not each.name.startswith("slew")):
        for end in (-1, 1):
            table = Table((0, 0.5, 30), (0, end, end))
            result = machine.simulate(verify=False, duration=6, output_interval=0.02, inputs={lever.name: table})
            for each in scaled:
                shown = result.array(f"sensor.{each.name}")
                assert each.range[0] - 0.02 <= shown.min(), (each.name, lever.name, end)
                assert shown.max() <= each.range[1], (each.name, lever.name, end)


@pytest.mark.parametrize(
    ("values", "duration", "inputs", "sensor", "least"),
    [
        # the load is set down, the ropes go slack and are hauled in at full speed
        ({}, 10.5, {"hoist": Table((0, 0.5, 7, 8, 10.5), (0, -1, -1, 1, 1))}, "rope-force", 110e3),
        # the trolley turns round with the swing of long ropes
        (
            {"parameters.hoist_start": "20 m"},
            9.2,
            {"trolley": Table((0, 0.7, 4.6, 6, 9.2), (0, 1, 1, -1, -1))},
            "swing",
            6.0,
        ),
    ],
    ids=["hauled in from slack", "in step with the swing"],
)
def test_gauges_of_the_harbour_crane_hold_what_an_operator_can_do(values, duration, inputs, sensor, least):
    crane = nivel.load(demo_file("harbour-crane")).with_values(values)
    shown = crane.simulate(duration=duration, output_interval=0.02, inputs=inputs).array(f"sensor.{sensor}")
    low, high = next(each for each in crane.record.sensors if each.name == sensor).range
    assert np.abs(shown).max() > least
    assert low <= shown.min() <= shown.max() <= high
