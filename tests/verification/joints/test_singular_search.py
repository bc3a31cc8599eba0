"""Singular positions that runs pass are found in machines of any size and kind, at a cost below the run's; changes of branch are told."""

import time

import numpy as np
import pytest

from linkages import change_point, folded_slider_crank, four_bar, jansen_leg
from nivel.analysis.plan.plan import plan_run
from nivel.analysis.run.dynamics import march
from nivel.analysis.run.prepared_state import prepare
from nivel.integrate.loop.sink import Header
from nivel.judge.after.checks import branches
from nivel.results.memory import Memory
from simulating import machine

START = 0.5
RUN = {"duration": 2.5, "step": 1e-3}


def verified(sections, **simulation):
    return machine({**sections, "simulation": {**RUN, **simulation}}).simulate(verify=True)


def told(result):
    """Times of the passages that the report names."""
    found = result.trust.found.get("singular")
    return [each["time"] for each in found["every"]] if found else []


def parallelogram(speed, prefix="", at=(0.0, 0.0)):
    return four_bar(2.0, 1.0, 2.0, 1.0, angle=START, speed=speed, prefix=prefix, at=at)


@pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])
@pytest.mark.parametrize(("make", "folded"), [(change_point, np.pi), (folded_slider_crank, 0.5 * np.pi)])
def test_position_in_line_is_found_where_the_crank_comes_to_it(make, folded, coordinates):
    result = verified(make(), coordinates=coordinates, step=9.7e-4)
    first = told(result)[0]
    assert START + np.interp(first, result.time, result.array("left.angle")) == pytest.approx(folded, abs=1e-5)
    assert result.trust.verdict == "amber"


def test_leg_without_singular_positions_has_none_and_repeats_nine_rows():
    result = verified(jansen_leg(), duration=1.8)
    assert result.array("ground-crank.angle")[-1] > 2 * np.pi
    assert len(result.trust.redundant_rows) == 9
    assert not told(result)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_six_parallelograms_in_one_machine_fold_at_their_own_times(coordinates):
    """102 rows. Each crank turns by START + speed t for ever; it folds at π and 2 π."""
    speeds = 1.0 + 0.31 * np.arange(6)
    parts = [parallelogram(float(speed), f"p{k}-", (0.0, 5.0 * k)) for k, speed in enumerate(speeds)]
    sections = {key: {name: each for part in parts for name, each in part[key].items()} for key in ("bodies", "joints")}
    expected = sorted(t for speed in speeds for t in (np.pi - START, 2 * np.pi - START) / speed if t < RUN["duration"])
    assert len(expected) == 6
    np.testing.assert_allclose(told(verified(sections, coordinates=coordinates)), expected, atol=1e-5)


@pytest.mark.parametrize("model", ["geometrically-exact", "ancf-beam"])
def test_parallelogram_beside_a_beam_is_found(model):
    """Nodes with gradients have modes as flexible bodies have."""
    sections = parallelogram(2.0)
    steel = {"youngs_modulus": 2e11, "poisson_ratio": 0.3, "density": 7800}
    section = {"type": "rectangle", "width": 0.05, "height": 0.05}
    arm = {"from": [0, 0, 3], "to": [1, 0, 3], "elements": 4, "material": steel, "section": section, "model": model}
    sections["beams"] = {"arm": arm}
    sections["joints"]["clamp"] = {"type": "fixed", "bodies": ["ground", "arm.start"], "point": [0, 0, 3]}
    result = verified(sections, duration=1.5, step=5e-3, integrator="generalised-alpha")
    np.testing.assert_allclose(told(result), [(np.pi - START) / 2.0], atol=1e-4)


def test_search_takes_less_than_the_run(monkeypatch):
    """Of a machine with redundant rows, in a run of 27 ms. Seconds of this thread, the least of three."""
    seconds = {"search": [], "run": []}
    passages = branches.passages

    def timed(run):
        begin = time.thread_time()
        found = list(passages(run))
        seconds["search"].append(time.thread_time() - begin)
        return iter(found)

    monkeypatch.setattr(branches, "passages", timed)
    leg = machine({**jansen_leg(), "simulation": {"duration": 1.0, "step": 1e-3}})
    for _ in range(3):
        leg.simulate(verify=True)
        begin = time.thread_time()
        leg.simulate(verify=False)
        seconds["run"].append(time.thread_time() - begin)
    assert min(seconds["search"]) < min(seconds["run"])


def test_result_of_two_frames_is_not_examined():
    result = verified(parallelogram(2.0), duration=0.2, output_interval=0.2)
    lines = [item for item in result.trust.items if item.name == "unexamined"]
    (line,) = [item for item in lines if "singular positions" in item.text]
    assert line.verdict == "green"


def side(result):
    """(n,) on which side of the line from the crank's tip to the fixed pin the rocker's tip is: a sine."""
    crank = result.array("left.angle") + START
    tip = np.stack([np.cos(crank), np.sin(crank)], axis=1)
    far = result.array("coupler.position")[:, :2] * 2.0 - tip
    line = np.array([4.0, 0.0]) - tip
    return np.cross(np.pad(line, ((0, 0), (0, 1))), np.pad(far - tip, ((0, 0), (0, 1))))[:, 2]


@pytest.mark.parametrize("given", [{"integrator": "radau"}, {"integrator": "bdf"}, {"integrator": "rk4"}])
def test_motion_goes_straight_on_by_inertia(given):
    """The height of the triangle of coupler and rocker is analytic in the crank's angle and passes zero: it changes its sign."""
    result = machine({**change_point(), "simulation": {**RUN, **given}}).simulate(verify=False)
    before, after = side(result)[[0, -1]]
    assert before * after < 0.0
    assert "branch" not in {item.name for item in result.trust.items}


@pytest.mark.parametrize("output", [{}, {"output_interval": 0.3}])
@pytest.mark.parametrize("given", [{"tolerance": 1e-6}, {"integrator": "radau", "tolerance": 1e-10}])
def test_motion_that_turns_to_another_branch_is_red_without_a_second_run(given, output):
    """Near the position these methods take steps of 1e-8 s along the rounded corner of the two branches."""
    simulation = {"duration": 2.5, "integrator": "dopri5", "coordinates": "relative", **given, **output}
    result = machine({**change_point(), "simulation": simulation}).simulate(verify=False)
    before, after = side(result)[[0, -1]]
    (line,) = [item for item in result.trust.items if item.name == "branch"]
    assert before * after > 0.0
    assert (line.verdict, result.trust.verdict) == ("red", "red")
    assert "turns from one branch to another" in line.text


def test_second_run_on_another_branch_leaves_the_error_unknown():
    """The tolerance of the run passes the position, a tenth of it turns."""
    simulation = {"duration": 2.5, "integrator": "dopri5", "coordinates": "relative", "tolerance": 1e-5}
    result = machine({**change_point(), "simulation": simulation}).simulate(verify=True)
    before, after = side(result)[[0, -1]]
    assert before * after < 0.0
    assert "two runs go different ways from t = 2.0" in result.trust.headline
    assert "within" not in result.trust.headline
    assert "second run changes the branch" in str(result.trust)


@pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])
def test_machine_prepared_once_runs_twice_bit_by_bit(coordinates):
    """The second run has records of its own: what the first leaves in its own does not count."""
    plan = plan_run(machine({**jansen_leg(), "simulation": {"duration": 0.1, "coordinates": coordinates}}).record)
    first = prepare(plan.methods)
    second = first.again()
    frames = []
    for prepared in (first, second):
        sink = Memory()
        sink.begin(Header(prepared.motion.system.layout, {}))
        march(prepared, plan.settings, [sink])
        frames.append({name: sink.result().array(name) for name in sink.result().variables})
    for name, values in frames[0].items():
        np.testing.assert_array_equal(values, frames[1][name], name)
