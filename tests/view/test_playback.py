"""Packages of results: poses, arrows and violations are those of the result; what is too much is thinned; what is wrong is said."""

import json
from pathlib import Path

import numpy as np
import pytest

import nivel
import synthetic_run as pendulum
from nivel import Body, Driver, Joint, Motor, PairForce, PointForce, SpringDamper, Torque
from nivel.errors import ModelError
from nivel.results import Memory
from nivel.view import records
from nivel.view.arrows import Moments, violation_vectors
from nivel.view.page import scene_html
from nivel.view.playback import ALONE, SERVED, SMALL, Budget, playback
from packages import from_bytes, unpacked

TIME = np.linspace(0.0, 8.0, 801)


def swung(time=TIME, values=None, **attributes):
    memory = Memory()
    memory.begin(pendulum.header(**attributes))
    memory.take(pendulum.frames(time) if values is None else pendulum.packed(time, values))
    return memory.close({"outcome": "done", **attributes})


def opened(*results, budget=ALONE):
    """The first stage, its times, its frames (n, width) and all stages."""
    head, arrays = from_bytes(playback(list(results), budget))
    stage = head["stages"][0]
    motion = stage["motion"]
    return stage, unpacked(motion["time"], arrays), unpacked(motion["frames"], arrays).T, head["stages"], arrays


def vectors(stage, frames):
    first = 7 * stage["layout"]["bodies"] + stage["layout"]["modes"]
    return frames[:, first:].reshape(len(frames), -1, 3)


def test_poses_and_times_are_those_of_the_result():
    result = swung()
    stage, time, frames, *_ = opened(result)
    np.testing.assert_array_equal(time, result.time)
    np.testing.assert_allclose(frames[:, :3], result.array("position")[:, 0], atol=1e-6)
    np.testing.assert_allclose(frames[:, 3:7], result.array("orientation")[:, 0], atol=1e-6)
    assert [body["name"] for body in stage["bodies"]] == ["arm"]
    assert stage["up"] == [0.0, 0.0, 1.0]


def test_columns_are_the_variables_of_the_result_and_belong_to_their_elements():
    result = swung()
    stage, *_, arrays = opened(result)
    columns = {column["name"]: column for column in stage["columns"]}
    for name in ("hinge.angle", "arm.position.x", "hinge.force.y", "kinetic_energy"):
        np.testing.assert_allclose(unpacked(columns[name]["values"], arrays), result.array(name), rtol=1e-6)
    assert columns["arm.position.x"]["owner"] == "arm"
    assert columns["hinge.angle"]["owner"] == "hinge"
    assert columns["hinge.angle"]["unit"] == "rad"
    assert columns["kinetic_energy"]["owner"] == ""


def test_a_gap_of_a_joint_is_its_violation_and_a_turn_that_of_its_directions():
    scene = pendulum.scene()
    scene["joints"][0]["x_axes"] = [[1, 0, 0], [1, 0, 0]]
    values = pendulum.histories(TIME)
    values["orientation"] = np.tile([1.0, 0.0, 0.0, 0.0], (len(TIME), 1, 1))  # both markers along the global axes
    stage, time, frames, *_ = opened(swung(values=values, scene=json.dumps(scene)))
    place = stage["joints"][0]["violation"]
    gap, turn = vectors(stage, frames)[:, place], vectors(stage, frames)[:, place + 1]
    # rows of synthetic_run: 1e-9 t (1, 2, 0) of the point, 0.5 and 0.25 of x and y of the first against z of the second;
    # with z = z: b × a = z × x = y, z × y = -x
    np.testing.assert_allclose(gap, 1e-9 * np.outer(time, [1, 2, 0]), rtol=1e-6, atol=1e-16)
    np.testing.assert_allclose(turn, 1e-9 * np.outer(time, [-0.25, 0.5, 0]), rtol=1e-6, atol=1e-16)


def machine(**parts):
    arm = Body(name="arm", mass=2.0, inertia=(0.01, 0.2, 0.2), position=(0.5, 0, 0))
    pin = Joint(name="pin", type="revolute", bodies=("ground", "arm"), point=(0, 0, 0), axis=(0, 0, 1))
    return nivel.Machine("arm", bodies=[arm], joints=[pin], gravity=(0, -9.81, 0), **parts)


def arrow(result, owner, kind):
    """The arrow's record, its vectors (n, 3) and the result."""
    stage, _, frames, *_ = opened(result)
    found = [each for each in stage["arrows"] if each["owner"] == owner and each["kind"] == kind]
    return found, [vectors(stage, frames)[:, each["vector"]] for each in found]


def test_the_reaction_of_a_pin_carries_weight_and_acceleration():
    result = machine().simulate(duration=0.5, step=1e-3)
    (record,), (shown,) = arrow(result, "pin", "force")
    # on the arm: m (a - g)
    np.testing.assert_allclose(
        shown, 2.0 * (result.array("arm.acceleration") - np.array([0, -9.81, 0])), rtol=1e-5, atol=1e-4
    )
    assert record["body"] == 0
    assert record["point"] == pytest.approx([-0.5, 0, 0])
    assert record["largest"] == pytest.approx(np.linalg.norm(shown, axis=1).max(), rel=1e-6)


def test_a_spring_pulls_both_ways_along_its_line():
    spring = SpringDamper(
        name="spring", bodies=("ground", "arm"), points=((0.5, 1, 0), (0.5, 0, 0)), stiffness=50, free_length=0.2
    )
    result = machine(forces=[spring]).simulate(duration=1.0, step=1e-3)
    (record,), (shown,) = arrow(result, "spring", "force")
    end = result.array("arm.position")
    line = np.array([0.5, 1, 0]) - end
    length = np.linalg.norm(line, axis=1, keepdims=True)
    np.testing.assert_allclose(shown, 50 * (length - 0.2) * line / length, rtol=1e-4, atol=1e-3)
    assert record["source"] == "applied"


def test_a_contact_pushes_where_it_touches_at_each_moment():
    """A ball that rolls at v: its arrows stand under its centre, not at a point of the ball."""
    ball = Body(name="ball", mass=1.0, inertia=(0.004,) * 3, position=(0, 0, 0.1), velocity=(1, 0, 0),
                angular_velocity=(0, 10, 0), shape={"type": "sphere", "radius": 0.1})  # fmt: skip
    floor = nivel.Contact(
        name="floor",
        body="ball",
        plane={"body": "ground", "axis": (0, 0, 1)},
        stiffness=1e5,
        exponent=1,
        restitution=0.5,
    )
    rolling = nivel.Machine("ball", bodies=[ball], forces=[floor], gravity=(0, 0, -9.81))
    result = rolling.simulate(duration=0.5, integrator="radau")
    stage, _, frames, *_ = opened(result)
    (record,) = [each for each in stage["arrows"] if each["owner"] == "floor"]
    place = vectors(stage, frames)[:, record["place"]]
    touching = result.array("force.floor.normal_force") > 0.0
    centre = result.array("ball.position")
    np.testing.assert_allclose(place[touching, :2], centre[touching, :2], atol=1e-6)
    np.testing.assert_allclose(place[touching, 2], 0.0, atol=1e-4)
    assert np.ptp(place[touching, 0]) == pytest.approx(0.5, rel=1e-2)


def test_loads_motors_and_drivers_have_their_sign_from_their_power():
    push = PointForce(name="push", body="arm", vector=("3*sin(20*time)", 0, 0))
    twist = Torque(name="twist", body="arm", vector=(0, 0, 1.5))
    motor = Motor(name="motor", coordinate="pin.angle", effort="2*cos(10*time)")
    pair = PairForce(name="ram", bodies=("ground", "arm"), points=((0, -1, 0), (0.5, 0, 0)), magnitude="4*sin(9*time)")
    result = machine(forces=[push, twist, motor, pair]).simulate(duration=0.6, step=1e-3)
    time, moving = result.time, slice(5, None)
    _, (shown,) = arrow(result, "push", "force")
    np.testing.assert_allclose(shown[moving, 0], 3 * np.sin(20 * time[moving]), atol=1e-5)
    _, (shown,) = arrow(result, "twist", "torque")
    np.testing.assert_allclose(shown, np.tile([0, 0, 1.5], (len(time), 1)), atol=1e-6)
    _, (shown,) = arrow(result, "motor", "torque")
    np.testing.assert_allclose(shown[moving, 2], 2 * np.cos(10 * time[moving]), atol=1e-5)
    _, (shown,) = arrow(result, "ram", "force")
    line = result.array("arm.position") - np.array([0, -1, 0])
    np.testing.assert_allclose(
        np.sum(shown * line, axis=1)[moving] / np.linalg.norm(line, axis=1)[moving],
        4 * np.sin(9 * time[moving]),
        atol=1e-4,
    )
    driven = machine(drivers=[Driver(name="drive", coordinate="pin.angle", value="time^2")]).simulate(
        duration=0.5, step=1e-3
    )
    _, (shown,) = arrow(driven, "drive", "torque")
    # about the pin: J θ'' = effort - weight's moment, J = 0.2 + 2 · 0.25
    expected = 0.7 * 2.0 + 2.0 * 9.81 * 0.5 * np.cos(driven.time**2)
    np.testing.assert_allclose(shown[moving, 2], expected[moving], rtol=1e-5)


def test_long_results_are_thinned_evenly_and_it_is_said():
    time = np.linspace(0.0, 1000.0, 100_000)
    stage, shown, frames, *_ = opened(swung(time), budget=SERVED)
    assert len(shown) <= SERVED.frames
    assert stage["motion"]["stride"] == 5
    np.testing.assert_array_equal(shown, time[::5])
    assert len(frames) == len(shown)
    assert any("5th of 100000" in note for note in stage["notes"])
    assert len(scene_html([swung(time)])) < 6_000_000


@pytest.mark.parametrize("budget", [SERVED, ALONE, SMALL])
def test_poses_that_are_not_finite_are_told_and_do_no_harm(budget):
    values = pendulum.histories(TIME)
    values["position"] = values["position"].copy()
    values["position"][700:] = np.nan
    values["orientation"] = values["orientation"].copy()
    values["orientation"][750:] = np.inf
    values["joint_force"] = np.full_like(values["joint_force"], 1e300)
    stage, _, frames, *_ = opened(swung(values=values, outcome="failed", failure="it broke"), budget=budget)
    assert "it broke" in stage["notes"][0]
    assert any("not finite" in note for note in stage["notes"])
    assert np.all(np.isfinite(stage["low"] + stage["high"]))
    assert np.isnan(frames[-1, 0])


@pytest.mark.parametrize("size", [1e31, 1e39, 1e300])
def test_poses_that_are_too_far_away_to_be_drawn_are_told(size):
    values = pendulum.histories(TIME)
    values["position"] = values["position"].copy()
    values["position"][600:] = size
    stage, *_ = opened(swung(values=values))
    assert [note for note in stage["notes"] if "201 of 801 frames have positions beyond 1e+30 m" in note]
    assert not any("not finite" in note for note in stage["notes"])


@pytest.mark.parametrize("wrong", [np.nan, np.inf, 3.0])
def test_frames_whose_times_are_wrong_are_left_out_and_it_is_said(wrong):
    time = TIME.copy()
    time[500] = wrong  # 5 s
    stage, shown, frames, *_ = opened(swung(time, values=pendulum.histories(TIME)))
    assert len(shown) == len(frames) == 500
    np.testing.assert_array_equal(shown, TIME[:500])
    assert any("last 301 frames are left out" in note for note in stage["notes"])


def test_a_result_whose_first_time_is_no_number_is_refused():
    time = TIME.copy()
    time[0] = np.nan
    with pytest.raises(ModelError, match="has no times"):
        playback([swung(time, values=pendulum.histories(TIME))], ALONE)


def test_times_may_be_negative():
    result = swung(np.linspace(-2.0, -1.0, 101))
    _, shown, *_ = opened(result)
    np.testing.assert_array_equal(shown, result.time)


def test_a_run_that_explodes_is_looked_at_where_it_began():
    values = pendulum.histories(TIME)
    values["position"] = values["position"] * np.exp(np.clip(TIME - 4.0, 0.0, None) * 20.0)[:, None, None]
    stage, *_ = opened(swung(values=values))
    assert np.abs(stage["high"] + stage["low"]).max() < 250.0
    assert stage["size"] < 2.0


def test_machines_far_from_the_origin_keep_their_digits():
    values = pendulum.histories(TIME)
    values["position"] = values["position"] + 1e6
    scene = pendulum.scene()
    scene["ground_points"] = []
    stage, _, frames, *_ = opened(swung(values=values, scene=json.dumps(scene)))
    np.testing.assert_allclose(frames[:, :3] + stage["origin"], values["position"][:, 0], atol=1e-6)
    assert stage["size"] < 10.0


def test_two_results_of_different_machines_are_laid_over_each_other():
    other = machine().simulate(duration=0.2, step=1e-3)
    *_, stages, _ = opened(swung(), other)
    assert [stage["name"] for stage in stages] == ["pendulum", "arm"]


@pytest.mark.parametrize(
    ("attributes", "said"),
    [
        ({"scene": "{}"}, "nothing about bodies"),
        ({"scene": "{not json"}, "cannot be read"),
        ({"scene": "[]"}, "cannot be read"),
        (
            {"scene": json.dumps({"bodies": [{"name": "leg", "shape": None, "centre_of_mass": [0, 0, 0]}]})},
            "not those of its motion",
        ),
    ],
)
def test_results_without_a_picture_are_refused_with_the_reason(attributes, said):
    with pytest.raises(ModelError, match=said):
        playback([swung(**attributes)], ALONE)


@pytest.mark.parametrize(
    ("part", "wrong"),
    [
        ("joints", [{"name": "pin", "type": "revolute"}]),
        ("joints", [{"name": "pin", "type": "revolute", "bodies": ["ground", "nobody"]}]),
        ("forces", [{"name": "spring", "type": "spring-damper", "bodies": ["arm"], "points": "here"}]),
        ("sweeps", [{"name": "boom", "bodies": ["boom.1", "boom.2"], "section": [[0, 0]]}]),
        ("sweeps", [{"name": "boom", "bodies": [], "section": []}]),
    ],
)
def test_a_scene_that_is_damaged_is_refused_with_the_reason(part, wrong):
    scene = pendulum.scene() | {part: wrong}
    with pytest.raises(ModelError, match="description of the machine is damaged"):
        playback([swung(scene=json.dumps(scene))], ALONE)


def test_a_result_without_frames_is_refused():
    memory = Memory()
    memory.begin(pendulum.header())
    with pytest.raises(ModelError, match="no frame"):
        playback([memory.close({"outcome": "failed"})], ALONE)


def test_a_scene_of_an_older_version_is_shown():
    scene = pendulum.scene()  # knows no masses, no x axes, no markers, no forces
    assert "markers" not in scene
    stage, *_ = opened(swung(scene=json.dumps(scene), machine_record="{}"))
    assert stage["forces"] == stage["markers"] == []


def test_names_cannot_break_the_page():
    text = scene_html([swung(machine="</script><script>alert(1)</script>")])
    assert "<script>alert" not in text


def test_ten_seconds_of_the_slider_crank_fit_into_two_megabytes():
    path = Path(__file__).parent.parent.parent / "examples" / "mechanisms" / "slider-crank.yaml"
    result = nivel.load(path).simulate(duration=10)
    assert len(result.time) == 1001
    text = scene_html([result])
    assert len(text.encode()) <= 2_000_000
    # all of it, not a thinned one
    _, time, *_ = opened(result)
    assert len(time) == 1001


def test_the_budget_of_columns_is_kept():
    stage, *_ = opened(swung(), budget=Budget(motion=10**6, columns=4 * 801 * 3, frames=1000))
    assert sum(column["values"] is not None for column in stage["columns"]) == 3


def test_a_slider_off_the_line_of_its_beam_has_a_gap_across_the_section():
    """`across.y` is y·(p - X) of the slider's point p: the line is off the other way. x of the second marker is y of the section."""
    turned = np.array([[np.cos(0.2), 0.0, 0.0, np.sin(0.2)]])  # about z by 0.4
    moments = Moments.of(np.zeros((1, 2, 3)), np.stack([np.array([[1.0, 0, 0, 0]]), turned], axis=1))
    # the beam's line along its x axis: y of the section is x of the marker, z of the section its y
    joint = records.Joint("pad", "point-on-beam", (0, 1), ((0, 0, 0),) * 2, ((1, 0, 0),) * 2, ((0, 1, 0),) * 2)
    gap, turn = violation_vectors([joint], ("pad.across.y", "pad.across.z"), np.array([[2e-6, 5e-6]]), moments)[0]
    y = np.array([-np.sin(0.4), np.cos(0.4), 0.0])
    np.testing.assert_allclose(gap, -2e-6 * y - 5e-6 * np.array([0, 0, 1]), atol=1e-18)
    np.testing.assert_array_equal(turn, 0.0)
