"""Wheels on soil against closed forms: shear, compaction, rest on a slope; and what machines with soil can do."""

import math
import pickle

import numpy as np
import pytest

from nivel.elements.contacts.on_soil import sheared
from nivel.errors import ModelError
from nivel.live.opening import export_page
from nivel.live.preparation import live_plan, prepared_run
from nivel.live.shared import arrays_in, put_back, taken
from simulating import G, machine, simulate

FLAT = {"size": [4, 2], "function": "0", "points": [161, 81]}


def roller(**more):
    """A wheel that falls onto soil and rolls."""
    return {
        "gravity": [0, 0, -G],
        "bodies": {"roller": {"mass": 400, "inertia": [20, 30, 20], "position": [-1, 0, 0.47], "velocity": [1, 0, 0],
                              "angular_velocity": [0, 2, 0]}},
        "markers": {"road": {"body": "ground", "axis": [0, 0, 1]}, "axle": {"body": "roller", "axis": [0, 1, 0]}},
        "forces": {"rolling": {"type": "soil-wheel", "wheel": "axle", "radius": 0.5, "width": 0.4, "plane": "road",
                               "heights": FLAT, "soil": {"cohesion": 1e3}, **more}},
        "simulation": {"duration": 1, "step": 1e-3, "output_interval": 0.01},
    }  # fmt: skip


def test_shear_comes_by_one_minus_exp():
    s, v, share = 0.0, 0.3, 1e-3 / 0.025
    for _ in range(500):
        s = sheared(s, v, v, share)
    assert s == pytest.approx(1.0 - math.exp(-0.3 * 0.5 / 0.025), rel=1e-6)


def test_rolling_has_a_second_run_and_the_same_end_by_another_method():
    # the coordinates of trees meet the same kernels
    ways = [{"integrator": "rk4"}, {"integrator": "dopri5"}, {"integrator": "rk4", "coordinates": "relative"}]
    runs = [machine(roller()).simulate(verify=True, **way) for way in ways]
    stated = 0.0
    for each in runs:
        lights = {item.name: item for item in each.trust.items}
        assert lights["energy"].verdict == "green"
        assert lights["accuracy"].fraction < 1e-3
        stated += lights["accuracy"].fraction * max(1.0, np.ptp(each.array("position")[:, 0, 0]))
    for each in runs[1:]:
        assert np.abs(runs[0].array("position") - each.array("position")).max() <= stated


def test_a_copy_and_a_saved_state_go_on_to_the_last_bit():
    sim = machine(roller()).start()
    empty = sim.state
    for _ in range(300):
        sim.step()
    state, other = sim.state, pickle.loads(pickle.dumps(sim))
    for _ in range(200):
        sim.step()
        other.step()
    first = sim["roller.position"].tobytes(), sim["force.rolling.magnitude"]
    assert sim["force.rolling.sinkage"] > 0.01
    assert (other["roller.position"].tobytes(), other["force.rolling.magnitude"]) == first
    sim.restore(state)
    for _ in range(200):
        sim.step()
    assert (sim["roller.position"].tobytes(), sim["force.rolling.magnitude"]) == first
    sim.restore(empty)
    for _ in range(500):
        sim.step()
    assert (sim["roller.position"].tobytes(), sim["force.rolling.magnitude"]) == first


def test_a_live_machine_that_is_put_back_has_its_cells_again():
    plan, pace = live_plan(machine(roller()).record, {}, None)
    run = prepared_run(plan, pace)
    (soil,) = run.prepared.motion.system.units
    arrays = arrays_in(run.records)
    before = taken(arrays, 0)
    for each in soil.record[1:]:
        each[...] += 1
    put_back(arrays, before)
    assert all((each == 0.0).all() for each in soil.record[1:])


def cart(slope):
    """A cart with locked wheels on level soil in the gravity of a slope."""
    places = {f"{a}{b}": (x, y) for a, x in (("f", 0.8), ("r", -0.8)) for b, y in (("l", 0.5), ("r", -0.5))}
    soil = {"plane": "road", "heights": {"size": [6, 3], "function": "0", "points": [241, 121]}, "soil": {}}
    sections = {
        "gravity": [-G * math.sin(slope), 0, -G * math.cos(slope)],
        "bodies": {"frame": {"mass": 800, "inertia": [80, 200, 250], "position": [0, 0, 0.6]}},
        "markers": {"road": {"body": "ground", "axis": [0, 0, 1]}},
        "joints": {},
        "forces": {},
        "simulation": {"duration": 5, "step": 1e-3, "output_interval": 0.05},
    }
    for name, (x, y) in places.items():
        sections["bodies"][name] = {"mass": 20, "inertia": [0.5, 0.9, 0.5], "position": [x, y, 0.27]}
        sections["markers"][f"{name}_hub"] = {"body": name, "axis": [0, 1, 0]}
        sections["joints"][f"{name}_axle"] = {"type": "fixed", "bodies": ["frame", name], "point": [x, y, 0.27]}
        sections["forces"][f"{name}_tread"] = {
            "type": "soil-wheel",
            "wheel": f"{name}_hub",
            "radius": 0.3,
            "width": 0.2,
            **soil,
        }
    return sections


def test_a_cart_comes_to_rest_on_a_slope():
    slope = math.atan(0.1)
    trust = machine(cart(slope)).simulate(verify=True).trust
    assert next(item.verdict for item in trust.items if item.name == "accuracy") == "green"
    assert trust.verdict != "red"
    rests = machine(cart(slope)).simulate(duration=40)
    place, speed = rests.array("position")[:, 0, :], rests.array("velocity")[:, 0, :]
    # nothing creeps: it swings out, and what is left of that after 30 s moves it less than a nanometre in a second
    assert np.abs(speed[rests.time > 38.0]).max() < 1e-8
    assert np.abs(place[rests.time > 38.0] - place[-1]).max() < 1e-8
    weight = 880.0 * G
    treads = [f"force.{name}_tread" for name in ("fl", "fr", "rl", "rr")]
    assert sum(rests.array(f"{each}.magnitude")[-1] for each in treads) == pytest.approx(
        weight * math.cos(slope), rel=1e-6
    )
    assert sum(rests.array(f"{each}.longitudinal")[-1] for each in treads) == pytest.approx(
        weight * math.sin(slope), rel=1e-6
    )


@pytest.mark.parametrize(
    "analysis",
    [
        lambda own: own.statics(),
        lambda own: own.linearise(),
        lambda own: own.inverse(),
        lambda own: own.gradient("roller.position.x", "bodies.roller.mass"),
        lambda own: own.export_c("soil"),
        lambda own: own.export_fmu("soil.fmu"),
        lambda own: export_page(own, "soil.html"),
    ],
)
def test_what_cannot_have_soil_says_so(analysis, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ModelError, match="depends on how it was pressed before") as raised:
        analysis(machine(roller()))
    assert raised.value.faults[0].path == "forces.rolling"
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("changes", "place", "said"),
    [
        (
            {"heights": {**FLAT, "points": [161, 41]}},
            "heights",
            "cells of soil are squares: here they are 0.025 m by 0.05 m",
        ),
        ({"plane": {"body": "roller"}}, "plane", "the plane is on `roller` itself"),
        ({"wheel": "axel"}, "wheel", "did you mean `axle`"),
        ({"soil": {"friction_angle": 1.3}}, "soil.friction_angle", "less than 60 deg"),
        ({"soil": {"period": 7e-4}}, "soil.period", "no whole number of steps"),
    ],
)
def test_soil_that_cannot_be_is_refused(changes, place, said):
    with pytest.raises(ModelError) as raised:
        simulate(roller(**changes))
    fault = raised.value.faults[0]
    assert said in fault.message
    assert fault.path.startswith(f"forces.rolling.{place}")


def test_a_rigid_wheel_rolls_against_the_work_of_compaction():
    sinkage, width, k, n = 0.08, 0.4, 1.5e6, 0.7
    sections = {
        "bodies": {"wheel": {"mass": 100, "inertia": [5, 8, 5], "position": [-1.2, 0, 0.5 - sinkage]}},
        "markers": {
            "road": {"body": "ground", "axis": [0, 0, 1]},
            "axle": {"body": "wheel", "axis": [0, 1, 0]},
        },
        "joints": {"rail": {"type": "translational", "bodies": ["ground", "wheel"], "point": [-1.2, 0, 0], "axis": [1, 0, 0]}},
        "drivers": {"tow": {"coordinate": "rail.displacement", "value": "1.0*time"}},
        "forces": {
            "rolling": {"type": "soil-wheel", "wheel": "axle", "radius": 0.5, "width": width, "plane": "road",
                        "heights": {"size": [4, 0.8], "function": "0", "points": [321, 65]},
                        # without friction there is no shear: what resists is the pressure alone
                        "soil": {"friction_angle": 1e-6, "modulus": k, "exponent": n, "unloading": 5e10}}
        },
        "simulation": {"duration": 2, "step": 1e-3, "output_interval": 1e-3},
    }  # fmt: skip
    found = simulate(sections)
    late = found.time > 1.0
    resisted = -found.array("force.rolling.longitudinal")[late].mean()
    # Bekker 1969: the work of a plate of the same width that sinks as deep, by the length of the rut
    assert resisted == pytest.approx(width * k * sinkage ** (n + 1) / (n + 1), rel=3e-3)
