"""A parallelogram linkage passes its flat position, where all its bars are in line and the loop may fold either way."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.errors import ModelError, SolveError
from simulating import machine, simulate

START = 0.5
EXAMPLES = Path(__file__).parents[3] / "examples"


def parallelogram(speed, axis_offset=0.0):
    """Crank and rocker of 1 m, 2 m apart, turning at `speed` without any force: the bars keep it up."""
    tip, far = [np.cos(START), np.sin(START), 0.0], [2 + np.cos(START), np.sin(START), axis_offset]

    def bar(p, q):
        return {"shape": {"type": "box", "from": p, "to": q, "width": 0.05, "height": 0.05}, "density": 1000}

    hinge = {"type": "revolute", "axis": [0, 0, 1]}
    return {
        "bodies": {"crank": bar([0, 0, 0], tip), "coupler": bar(tip, far), "rocker": bar([2, 0, 0], far)},
        "joints": {
            "left": {**hinge, "bodies": ["ground", "crank"], "point": [0, 0, 0], "start_rates": {"angle": speed}},
            "near": {"type": "spherical", "bodies": ["crank", "coupler"], "point": tip},
            "far": {"type": "cylindrical", "bodies": ["coupler", "rocker"], "point": far, "axis": [0, 0, 1]},
            "right": {**hinge, "bodies": ["ground", "rocker"], "point": [2, 0, 0]},
        },
    }


@pytest.mark.parametrize("step", [3.3e-3, 7e-4])
@pytest.mark.parametrize("speed", [2.0, -2.0])
@pytest.mark.parametrize("methods", [{}, {"formulation": "lagrange"}, {"coordinates": "independent"}])
def test_flat_position_between_two_steps_is_passed(speed, step, methods):
    """At 2 rad/s the angle is START + 2 t for ever: the parallelogram stays one through every flat position, 0, π, 2π."""
    r = simulate(parallelogram(speed), duration=3.0, step=step, **methods)
    np.testing.assert_allclose(r.array("left.angle"), speed * r.time, atol=1e-8)
    np.testing.assert_allclose(r.array("right.angle"), speed * r.time, atol=1e-8)
    assert r.trust.verdict == "green"


@pytest.mark.parametrize("speed", [2.0, -2.0])
def test_flat_position_that_is_passed_is_told_with_its_time(speed):
    """The angle of the bars is START + speed t."""
    r = machine({**parallelogram(speed), "simulation": {"duration": 3.0, "step": 7e-4}}).simulate(verify=True)
    (told,) = [item for item in r.trust.items if item.verdict != "green"]
    assert (told.name, told.verdict) == ("singular", "amber")
    assert told.time == pytest.approx((np.pi - START) / 2.0 if speed > 0.0 else START / 2.0, abs=1e-3)
    assert "left, near, far, right" in told.text
    assert "The motion is unique" not in str(r.trust)


def test_positions_in_line_that_are_not_singular_are_not_told():
    """The four-bar of report 44 has crank and coupler in line at 2.610 s, where its constraints stay independent."""
    result = nivel.load(EXAMPLES / "mechanisms" / "four-bar.yaml").simulate(duration=3.0, verify=True)
    assert "singular" not in {item.name for item in result.trust.items}


@pytest.mark.parametrize("coordinates", ["absolute", "independent"])
def test_flat_position_hit_by_a_step_is_named(coordinates):
    """At t = 1 s exactly: S has no inverse there. The result until then is kept."""
    with pytest.raises(SolveError, match="singular position") as caught:
        simulate(parallelogram(-0.5), duration=3.0, step=1e-3, coordinates=coordinates)
    assert caught.value.time == pytest.approx(0.999, abs=2e-3)
    assert "Look at" in caught.value.advice
    assert caught.value.result.time[-1] == pytest.approx(0.999, abs=5e-3)


@pytest.mark.parametrize("formulation", ["penalty", "augmented-lagrangian"])
@pytest.mark.parametrize("integrator", ["newmark", "generalised-alpha", "ros2"])
def test_flat_position_hit_by_a_step_of_implicit_penalty_methods_is_passed(integrator, formulation):
    """S + 1/α has an inverse there, and so has Newton's matrix with -1/α in its corner. START - t/2 for ever, to order two."""
    given = {"coordinates": "absolute", "formulation": formulation, "integrator": integrator}
    r = simulate(parallelogram(-0.5), duration=3.0, step=1e-3, **given)
    np.testing.assert_allclose(r.array("left.angle"), -0.5 * r.time, atol=1e-5)
    np.testing.assert_allclose(r.array("right.angle"), -0.5 * r.time, atol=1e-5)


@pytest.mark.parametrize("integrator", ["radau", "bdf", "ros2"])
def test_flat_position_is_passed_by_implicit_methods_in_independent_coordinates(integrator):
    given = {"coordinates": "independent", "integrator": integrator}
    r = simulate(parallelogram(2.0), duration=3.0, step=7e-4, **given)
    np.testing.assert_allclose(r.array("right.angle"), 2.0 * r.time, atol=1e-5)


def test_flat_position_in_a_frame_between_chosen_steps_is_named_and_other_frames_pass_it():
    """At t = 1 s exactly, where a driver turns the crank by -0.5 rad/s."""
    machine = parallelogram(0.0)
    del machine["joints"]["left"]["start_rates"]
    machine["drivers"] = {"turn": {"coordinate": "left.angle", "value": "-0.5*time"}}
    methods = {"integrator": "dopri5", "coordinates": "absolute", "duration": 3.0}
    with pytest.raises(SolveError, match="in a frame inside it: there the machine is in a singular position") as caught:
        simulate(machine, output_interval=0.01, **methods)
    assert "another `output_interval`" in caught.value.advice
    assert 0.8 < caught.value.result.time[-1] < 1.0
    passed = simulate(machine, output_interval=0.3, **methods)
    np.testing.assert_allclose(passed.array("right.angle"), -0.5 * passed.time, atol=1e-9)


def folded(kind="spherical"):
    """The parallelogram as it is drawn flat, without any motion."""
    sections = parallelogram(0.0)
    del sections["joints"]["left"]["start_rates"]
    sections["joints"]["near"] = {**sections["joints"]["near"], "type": kind}
    if kind == "revolute":
        sections["joints"]["near"]["axis"] = [0, 0, 1]
        sections["joints"]["far"]["type"] = kind
    sections["joints"]["left"]["start"] = {"angle": -START}
    return sections


def test_a_flat_start_that_is_driven_is_told_with_both_assemblies():
    """The driver leaves no free motion; the two are those of the bars without it."""
    sections = folded()
    angle = -sections["joints"]["left"].pop("start")["angle"]
    sections["drivers"] = {"d": {"coordinate": "left", "value": f"{-angle!r} - 0.5*time^2"}}
    with pytest.raises(ModelError, match=r"starts in a singular position.*Two assemblies meet there"):
        simulate(sections, duration=0.1)


@pytest.mark.parametrize("kind", ["spherical", "revolute"])
def test_start_in_the_flat_position_is_refused_with_both_assemblies(kind):
    """The parallelogram turns both bars alike. Folded across, of 4 = |(2 + cos ψ - cos φ, sin ψ - sin φ)|² for bars of 1 m that stand 2 m
    apart, (φ - ψ)(3 φ + ψ) = 0 is left near the flat position; also where three rows of a loop of revolutes repeat others everywhere.
    """
    with pytest.raises(ModelError, match=r"starts in a singular position.*Two assemblies meet there") as caught:
        simulate(folded(kind), duration=0.1, step=1e-3)
    told = str(caught.value)
    assert "left.angle by +1°" in told or "right.angle by +1°" in told
    assert "angle by -0.333°" in told or "angle by -3°" in told


@pytest.mark.parametrize("ratio", [1.0, -3.0])
def test_bodies_a_little_aside_say_which_assembly_is_meant(ratio):
    sections, small = parallelogram(1.0), 0.02
    tip, far = [np.cos(small), np.sin(small), 0.0], [2 + np.cos(ratio * small), np.sin(ratio * small), 0.0]
    for name, ends in {"crank": ([0, 0, 0], tip), "coupler": (tip, far), "rocker": ([2, 0, 0], far)}.items():
        sections["bodies"][name]["shape"] |= {"from": ends[0], "to": ends[1]}
    sections["joints"]["near"]["point"], sections["joints"]["far"]["point"] = tip, far
    result = simulate(sections, duration=0.01, step=1e-3)
    assert result.array("right.angle.rate")[-1] / result.array("left.angle.rate")[-1] == pytest.approx(ratio, rel=0.05)
