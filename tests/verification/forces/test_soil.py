"""Soil against closed forms: earth pressure, the wedge before a blade, heaps, loads that are taken along, rigid wheels."""

import math
import pickle

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from nivel.elements.contacts.height_field import HeightField
from nivel.elements.contacts.on_soil import sheared
from nivel.elements.contacts.soil import Soil, SoilRow, SoilUnit
from nivel.elements.contacts.soil_cells import failure_angle, raise_node, slide, wedge
from nivel.errors import ModelError
from nivel.kernels.elements.soil import ADDED, COUNT
from nivel.live.page import export_page
from nivel.live.preparation import live_plan, prepared_run
from nivel.live.shared import arrays_in, put_back, taken
from simulating import G, machine, simulate

CELL, SIZE = 0.05, 10.0
FLAT = {"size": [10, 10], "function": "1", "points": [201, 201]}


def cells(cell=CELL, size=SIZE, **soil):
    """Cells of level soil at the height 1 m."""
    points = [round(size / cell) + 1] * 2
    field = HeightField(size=[size, size], function="1", points=points)
    return SoilUnit(Soil(**soil), field, 1, np.array([0.0, 0.0, -G]), 0.0).record


def wedge_factor(rho, beta, phi, delta):
    """N_γ of a plane wedge under level ground: P = γ w d² N_γ (McKyes 1985, ch. 3)."""
    below = math.cos(rho + delta) + math.sin(rho + delta) / math.tan(beta + phi)
    return 0.5 * (1.0 / math.tan(rho) + 1.0 / math.tan(beta)) / below


@pytest.mark.parametrize("degrees", [(30, 0, 90), (35, 23, 90), (30, 20, 60), (40, 20, 50), (35, 23, 45)])
def test_the_wedge_under_level_ground_is_coulombs_passive_pressure(degrees):
    phi, delta, rho = map(math.radians, degrees)
    # K_p of a wall at rho to the horizontal (Coulomb 1776); P = ½ K_p γ d² w, so N_γ = K_p/2
    root = math.sqrt(math.sin(phi + delta) * math.sin(phi) / (math.sin(rho + delta) * math.sin(rho)))
    passive = math.sin(rho - phi) ** 2 / (math.sin(rho) ** 2 * math.sin(rho + delta) * (1.0 - root) ** 2)
    beta = failure_angle(rho, phi, delta)
    assert wedge_factor(rho, beta, phi, delta) == pytest.approx(0.5 * passive, rel=1e-12)


@pytest.mark.parametrize("degrees", [(30, 1e-6, 10), (30, 1e-6, -10), (35, 23, 10), (35, 23, -10)])
def test_the_least_wedge_of_cells_on_a_slope_is_coulombs_passive_pressure(degrees):
    """Of an upright face; the failure angle of level ground has a greater force, which is not the least."""
    phi, delta, rise = map(math.radians, degrees)
    field = HeightField(size=[5, 1], function=f"1 + {math.tan(rise)!r}*x", points=[201, 41])
    soil = Soil(density=1.0 / G, cohesion=0, tool_friction=delta, friction_angle=phi)
    own = SoilUnit(soil, field, 1, np.array([0.0, 0.0, -G]), 0.0).record
    edge = np.array([2.5, 0.3, 0.6, 2.5, 0.7, 0.6])
    upright, between = 0.5 * math.pi, (0.2 if rise > 0.0 else 0.05, 0.95 * (0.5 * math.pi - phi - delta))
    force = minimize_scalar(
        lambda beta: wedge(own, edge, 1.0, 0.0, upright, beta)[0], bounds=between, method="bounded"
    ).fun
    root = math.sqrt(math.sin(phi + delta) * math.sin(phi + rise) / (math.cos(delta) * math.cos(rise)))
    passive = math.cos(phi) ** 2 / (math.cos(delta) * (1.0 - root) ** 2)
    assert force == pytest.approx(0.5 * passive * 0.4**2 * 0.4, rel=2e-3)


@pytest.mark.parametrize("depth", [0.1, 0.2, 0.4])
def test_the_wedge_of_the_cells_has_mckyes_force(depth):
    own = cells(cohesion=5e3, density=16e3 / G, tool_friction=math.radians(23), friction_angle=math.radians(35))
    rho, phi, delta, width = (
        math.radians(60),
        own.number[SoilRow.FRICTION_ANGLE],
        own.number[SoilRow.TOOL_FRICTION],
        1.2,
    )
    beta = failure_angle(rho, phi, delta)
    edge = np.array([5.0, 4.4, 1.0 - depth, 5.0, 5.6, 1.0 - depth])
    force, found = wedge(own, edge, 1.0, 0.0, rho, beta)
    # McKyes 1985, ch. 3: P = w (γ d² N_γ + c d N_c)
    below = math.cos(rho + delta) + math.sin(rho + delta) / math.tan(beta + phi)
    cohesion = (1.0 + 1.0 / math.tan(beta) / math.tan(beta + phi)) / below
    expected = width * depth * (16e3 * depth * wedge_factor(rho, beta, phi, delta) + 5e3 * cohesion)
    assert found == pytest.approx(depth, rel=1e-12)
    assert force == pytest.approx(expected, rel=3e-3)


def test_a_heap_has_the_angle_of_repose_and_all_of_its_volume():
    own = cells()
    for _ in range(1000):
        raise_node(own, 100, 100, 1e-3 / CELL**2)
        slide(own)
    for _ in range(30_000):
        slide(own)
    assert own.turn[COUNT] == 0
    heights = own.h - 1.0
    assert math.fsum(heights.ravel()) * CELL**2 == pytest.approx(1.0, abs=1e-13)
    assert own.sum[ADDED] == pytest.approx(1.0, abs=1e-11)
    across = (own.h[1:, 1:] - own.h[:-1, :-1], own.h[1:, :-1] - own.h[:-1, 1:])
    slopes = [np.abs(np.diff(own.h, axis=axis)).max() for axis in (0, 1)] + [np.abs(d).max() / 2**0.5 for d in across]
    repose = own.number[SoilRow.REPOSE]
    for slope in slopes:
        assert math.degrees(math.atan(slope / CELL)) == pytest.approx(math.degrees(repose), abs=0.06)
    # A cone of 1 m³ with this slope. In eight directions nothing is steeper, between them slopes may be by 1/cos 22.5° = 1.08 at most: a
    # pyramid with eight sides is 3.5 % higher.
    cone = (3.0 / math.pi * math.tan(repose) ** 2) ** (1 / 3)
    assert heights.max() == pytest.approx(cone, rel=0.035)
    ends = [
        np.count_nonzero(line > 1e-3) * step
        for line, step in ((heights[100:, 100], CELL), (np.diag(heights)[100:], CELL * 2**0.5))
    ]
    assert ends == pytest.approx([cone / math.tan(repose)] * 2, abs=0.07)


def test_shear_comes_by_one_minus_exp():
    s, v, share = 0.0, 0.3, 1e-3 / 0.025
    for _ in range(500):
        s = sheared(s, v, v, share)
    assert s == pytest.approx(1.0 - math.exp(-0.3 * 0.5 / 0.025), rel=1e-6)


def bucket(**more):
    """A bucket on a rail along x, which cuts 5 cm deep."""
    return {
        "bodies": {"bucket": {"mass": 500, "inertia": [50, 60, 70], "position": [-4, 0, 2], "velocity": [2, 0, 0]}},
        "markers": {
            "road": {"body": "ground", "axis": [0, 0, 1]},
            "left": {"body": "bucket", "position": [0, 0.5, -1.05]},
            "right": {"body": "bucket", "position": [0, -0.5, -1.05]},
            "heart": {"body": "bucket", "position": [-0.5, 0.1, -0.8]},
        },
        "joints": {"rail": {"type": "translational", "bodies": ["ground", "bucket"], "point": [-4, 0, 2], "axis": [1, 0, 0]}},
        "forces": {
            "digging": {"type": "blade", "edge": ["left", "right"], "capacity": 2.0, "load_at": "heart", "plane": "road",
                        "heights": FLAT, "soil": {"repose": 0.6}, **more}
        },
        "simulation": {"duration": 2, "step": 1e-3, "output_interval": 0.01},
    }  # fmt: skip


DEGREES = math.radians(1.0)


@pytest.mark.parametrize("speed", [0.2, 1.0])
def test_a_blade_that_is_pulled_has_mckyes_draught(speed):
    rho, phi, delta, depth, width = 60 * DEGREES, 35 * DEGREES, 23 * DEGREES, 0.2, 1.0
    soil = {"cohesion": 5e3, "density": 16e3 / G, "friction_angle": phi, "tool_friction": delta}
    sections = bucket(rake=rho, capacity=100.0, soil=soil)
    for name in ("left", "right"):
        sections["markers"][name]["position"][2] = -1.0 - depth
    found = simulate(
        {
            **sections,
            "gravity": [0, 0, -G],
            "drivers": {"pull": {"coordinate": "rail.displacement", "value": f"{speed}*time"}},
        }
    )
    beta = failure_angle(rho, phi, delta)
    below = math.cos(rho + delta) + math.sin(rho + delta) / math.tan(beta + phi)
    cohesion = (1.0 + 1.0 / math.tan(beta) / math.tan(beta + phi)) / below
    most = width * depth * (16e3 * depth * wedge_factor(rho, beta, phi, delta) + 5e3 * cohesion)
    cutting = found.array("force.digging.cutting")
    assert cutting[-1] == pytest.approx(most, rel=3e-3)
    # along the way: the wedge at δ to the normal of the face, and what is taken in comes to this speed
    load = found.array("force.digging.load")
    intake = (load[-1] - load[100]) / (found.time[-1] - found.time[100]) * speed
    drawn = found.array("driver.pull.effort")[-1]
    assert drawn == pytest.approx(most * math.sin(rho + delta) + intake, rel=5e-3)


def test_a_plough_that_casts_aside_has_mckyes_draught_and_leaves_its_furrow():
    rho, phi, delta, depth, width = 45 * DEGREES, 35 * DEGREES, 23 * DEGREES, 0.2, 1.0
    soil = {"cohesion": 5e3, "density": 16e3 / G, "friction_angle": phi, "tool_friction": delta}
    sections = bucket(rake=rho, capacity=1e-9, soil=soil, cast=[-0.5, -1.2])
    for name in ("left", "right"):
        sections["markers"][name]["position"][2] = -1.0 - depth
    found = simulate(
        {**sections, "gravity": [0, 0, -G], "drivers": {"pull": {"coordinate": "rail.displacement", "value": "time"}}}
    )
    beta = failure_angle(rho, phi, delta)
    below = math.cos(rho + delta) + math.sin(rho + delta) / math.tan(beta + phi)
    cohesion = (1.0 + 1.0 / math.tan(beta) / math.tan(beta + phi)) / below
    most = width * depth * (16e3 * depth * wedge_factor(rho, beta, phi, delta) + 5e3 * cohesion)
    # nothing is carried, so nothing is accelerated: the draught is the force of the wedge alone
    assert found.array("driver.pull.effort")[-1] == pytest.approx(most * math.sin(rho + delta), rel=1e-9)
    assert np.abs(found.array("force.digging.balance")).max() < 1e-12
    heights = next(iter(found.terrains.values())).at(found.time[-1])
    furrow, bank = (
        heights[100, 28:50],
        heights[76, 28:50],
    )  # at y 0 and -1.2, behind the edge, which came from x -4 to -2
    assert furrow.mean() < 1.0 - 0.5 * depth
    assert bank.mean() > 1.0 + 0.25 * depth


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_what_is_taken_in_keeps_momentum_volume_and_energy(coordinates):
    # without gravity soil has no strength: only its mass acts
    found, still = (
        simulate(bucket(capacity=each), coordinates=coordinates, output_interval=1e-3) for each in (2.0, 0.02)
    )
    for each in (found, still):
        load, speed = each.array("force.digging.load"), each.array("velocity")[:, 0, 0]
        # what is taken in at a sample is at speed one period later
        assert (500.0 + load[:-1]) * speed[1:] == pytest.approx(1000.0, rel=1e-12)
    assert found.array("force.digging.load")[-1] > 100.0
    assert still.array("force.digging.load")[-1] == pytest.approx(0.02 * 1700.0, rel=1e-12)
    for each in (found, still):
        assert np.abs(each.array("force.digging.balance")).max() < 1e-12
        assert np.abs(each.array("energy_error")).max() < 1e-9 * 1000.0
        assert each.trust.verdict == "green"


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_a_load_on_an_arm_that_turns_keeps_moment_of_momentum_and_energy(coordinates):
    """Relative coordinates move the frame of the body to the hinge, 2 m above its centre."""
    sections = bucket()
    sections["bodies"]["bucket"] |= {"angular_velocity": [0, -1, 0]}
    sections["joints"] = {
        "hinge": {"type": "revolute", "bodies": ["ground", "bucket"], "point": [-4, 0, 4], "axis": [0, -1, 0]}
    }
    found = simulate(sections, coordinates=coordinates, output_interval=1e-3, duration=0.3)
    load, rate = found.array("force.digging.load"), found.array("hinge.angle_rate")
    ball = 0.4 * load * (0.75 * load / 1700.0 / np.pi) ** (2.0 / 3.0)
    inertia = 60.0 + 500.0 * 2.0**2 + load * (0.5**2 + 2.8**2) + ball
    assert load[-1] > 10.0
    # an impulse acts in the direction of the sample while the arm turns by 1e-3
    assert inertia[:-1] * rate[1:] == pytest.approx(2060.0, rel=1e-7)
    assert np.abs(found.array("energy_error")).max() < 1e-6 * 1000.0


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_what_falls_into_a_box_is_its_mass_and_keeps_momentum_and_volume(coordinates):
    sections = bucket(capacity=0.05)
    sections["bodies"]["box"] = {
        "mass": 300,
        "inertia": [60, 60, 60],
        "position": [-2, 0, 0.5],
        "velocity": [0.5, 0, 0],
    }
    sections["joints"]["way"] = {
        "type": "translational",
        "bodies": ["ground", "box"],
        "point": [-2, 0, 0.5],
        "axis": [1, 0, 0],
    }
    at = {name: {"body": "box", "position": [x, y, 0]} for name, (x, y) in
          {"tail_left": (-0.9, -0.6), "tail_right": (-0.9, 0.6), "near": (0.8, -0.6), "far": (-0.8, 0.6)}.items()}  # fmt: skip
    sections["markers"] |= at
    soil = {key: sections["forces"]["digging"][key] for key in ("plane", "heights", "soil")}
    sections["forces"]["catching"] = {
        "type": "blade",
        "edge": ["tail_left", "tail_right"],
        "capacity": 3.0,
        "opening": ["near", "far"],
        **soil,
    }
    found = simulate(sections, coordinates=coordinates, output_interval=1e-3)
    dug, caught = (found.array(f"force.{name}.load") for name in ("digging", "catching"))
    speed = found.array("velocity")[:, :, 0]
    for load, own, momentum, v in ((dug, 500.0, 1000.0, speed[:, 0]), (caught, 300.0, 150.0, speed[:, 1])):
        assert (own + load[:-1]) * v[1:] == pytest.approx(momentum, rel=1e-12)
    assert dug[-1] == pytest.approx(0.05 * 1700.0, rel=1e-12)
    assert 100.0 < caught[-1] < 1000.0
    for name in ("digging", "catching"):
        assert np.abs(found.array(f"force.{name}.balance")).max() < 1e-12
    assert np.abs(found.array("energy_error")).max() < 1e-9 * 1000.0


def test_digging_has_a_second_run_and_the_same_end_by_another_method():
    sections = {**bucket(soil={"cohesion": 1e3}), "gravity": [0, 0, -G]}
    runs = [machine(sections).simulate(verify=True, integrator=name) for name in ("rk4", "dopri5")]
    stated, way = 0.0, np.ptp(runs[0].array("position")[:, 0, 0])
    for each in runs:
        assert each.array("force.digging.load")[-1] > 50.0
        assert np.abs(each.array("force.digging.balance")).max() < 1e-12
        lights = {item.name: item for item in each.trust.items}
        assert lights["energy"].verdict == lights["soil"].verdict == "green"
        assert lights["accuracy"].fraction < 1e-3
        stated += lights["accuracy"].fraction * way
    apart = np.abs(runs[0].array("position") - runs[1].array("position")).max()
    assert 0.0 < apart <= stated


def test_a_loaded_machine_begins_again_empty_and_its_copy_goes_on_loaded():
    sim = machine({**bucket(), "gravity": [0, 0, -G]}).start()
    empty = sim.state
    for _ in range(1700):
        sim.step()
    other = pickle.loads(pickle.dumps(sim))
    assert other["force.digging.load"] == sim["force.digging.load"] > 0.0
    for _ in range(100):
        sim.step()
        other.step()
    assert (other["bucket.position"] == sim["bucket.position"]).all()
    sim.restore(empty)
    assert sim["force.digging.load"] == 0.0
    for _ in range(1800):
        sim.step()
    assert (other["bucket.position"] == sim["bucket.position"]).all()


def test_a_live_machine_that_is_put_back_has_its_cells_again():
    plan, pace = live_plan(machine({**bucket(), "gravity": [0, 0, -G]}).record, {}, None)
    run = prepared_run(plan, pace)
    (soil,) = run.prepared.motion.system.units
    arrays = arrays_in(run.records)
    before = taken(arrays, 0)
    for each in soil.record[1:]:
        each[...] += 1
    put_back(arrays, before)
    assert all(each.sum() == 0 for each in (soil.record.volume, soil.record.shear, soil.record.marked))
    assert (soil.record.h == 1.0).all()


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


@pytest.mark.parametrize("kind", ["blade", "track"])
@pytest.mark.parametrize(
    "analysis",
    [
        lambda own: own.statics(),
        lambda own: own.linearise(),
        lambda own: own.inverse(),
        lambda own: own.with_values({"bodies.bucket.velocity": [0, 0, 0]}).simulate(start="equilibrium"),
        lambda own: own.gradient("bucket.position.x", "bodies.bucket.mass"),
        lambda own: own.export_c("soil"),
        lambda own: own.export_fmu("soil.fmu"),
        lambda own: export_page(own, "soil.html"),
    ],
)
def test_what_cannot_have_soil_says_so(analysis, kind, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    sections = bucket()
    if kind == "track":
        sections["bodies"]["sprocket"] = {"mass": 5, "inertia": [1, 1, 1], "position": [-5, 0, 2]}
        sections["joints"]["hub"] = {
            "type": "revolute",
            "bodies": ["bucket", "sprocket"],
            "point": [-5, 0, 2],
            "axis": [0, 1, 0],
        }
        ends = [{"body": "bucket", "position": [x, 0, -1.05]} for x in (1, -1)]
        soil = {key: sections["forces"]["digging"][key] for key in ("plane", "heights", "soil")}
        sections["forces"]["digging"] = {"type": "track", "contact": ends, "radius": 0.3, "width": 0.5, **soil,
                                         "sprocket": {"body": "sprocket", "axis": [0, 1, 0]}}  # fmt: skip
    with pytest.raises(ModelError, match="depends on how it was pressed and cut before") as raised:
        analysis(machine(sections))
    assert raised.value.faults[0].path == "forces.digging"
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("changes", "place", "said"),
    [
        (
            {"heights": {**FLAT, "points": [201, 101]}},
            "heights",
            "cells of soil are squares: here they are 0.05 m by 0.1 m",
        ),
        ({"plane": {"body": "bucket"}}, "plane", "soil lies on the ground"),
        ({"plane": "raod"}, "plane", "did you mean `road`"),
        ({"load_at": {"body": "ground"}}, "edge", "stand on one rigid body"),
        ({"edge": ["left", "left"]}, "edge", "the ends of the edge are in one place"),
        ({"edge": ["left", "rigth"]}, "edge", "did you mean `right`"),
        ({"rake": 2.2}, "rake", "must be below 180 deg"),
        ({"soil": {"repose": 1.3}}, "soil.repose", "less than 69 deg"),
        ({"soil": {"period": 7e-4}}, "soil.period", "no whole number of steps"),
    ],
)
def test_soil_that_cannot_be_is_refused(changes, place, said):
    with pytest.raises(ModelError) as raised:
        simulate(bucket(**changes))
    fault = raised.value.faults[0]
    assert said in fault.message
    assert fault.path.startswith(f"forces.digging.{place}")


def test_a_body_has_one_blade():
    sections = bucket()
    sections["forces"]["second"] = {**sections["forces"]["digging"]}
    with pytest.raises(ModelError, match="has another blade"):
        simulate(sections)


def test_a_saved_state_goes_on_to_the_last_bit():
    sections = {**bucket(), "gravity": [0, 0, -G]}
    sim = machine(sections).start()
    for _ in range(1300):
        sim.step()
    state = sim.state
    for _ in range(400):
        sim.step()
    first = sim["force.digging.load"], sim["bucket.position"].tobytes(), sim["force.digging.cutting"]
    assert first[0] > 0.0
    sim.restore(state)
    for _ in range(400):
        sim.step()
    assert (sim["force.digging.load"], sim["bucket.position"].tobytes(), sim["force.digging.cutting"]) == first


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
                        "soil": {"friction_angle": 1e-6, "tool_friction": 1e-6, "modulus": k, "exponent": n, "unloading": 5e10}}
        },
        "simulation": {"duration": 2, "step": 1e-3, "output_interval": 1e-3},
    }  # fmt: skip
    found = simulate(sections)
    late = found.time > 1.0
    resisted = -found.array("force.rolling.longitudinal")[late].mean()
    # Bekker 1969: the work of a plate of the same width that sinks as deep, by the length of the rut
    assert resisted == pytest.approx(width * k * sinkage ** (n + 1) / (n + 1), rel=3e-3)
    # its load: the pressure k zⁿ before the axle, and behind it that of a rebound by p/U, which ends √(2 R p/U) from the axle
    x = np.linspace(0.0, math.sqrt(sinkage * (1.0 - sinkage)), 20_001)
    before = np.trapezoid((sinkage - 0.5 + np.sqrt(0.25 - x * x)).clip(0.0) ** n, x)
    borne = width * k * (before + 2.0 / 3.0 * sinkage**n * math.sqrt(2.0 * 0.5 * k * sinkage**n / 5e10))
    assert found.array("force.rolling.magnitude")[late].mean() == pytest.approx(borne, rel=1e-3)
