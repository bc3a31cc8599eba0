"""Soil against closed forms: earth pressure, the wedge before a blade, heaps, loads that are taken along, rigid wheels."""

import math

import numpy as np
import pytest

from nivel.elements.contacts.height_field import HeightField
from nivel.elements.contacts.on_soil import sheared
from nivel.elements.contacts.soil import ADDED, COUNT, FRICTION, REPOSE, TOOL, Soil, SoilUnit
from nivel.elements.contacts.soil_cells import failure_angle, pour, slide, wedge, wedge_factor
from simulating import G, machine, simulate

CELL, SIZE = 0.05, 10.0
FLAT = {"size": [10, 10], "function": "1", "points": [201, 201]}


def cells(cell=CELL, size=SIZE, **soil):
    """Cells of level soil at the height 1 m."""
    points = [round(size / cell) + 1] * 2
    field = HeightField(size=[size, size], function="1", points=points)
    return SoilUnit(Soil(**soil), field, 1, np.array([0.0, 0.0, -G]), 0.0).record


@pytest.mark.parametrize("degrees", [(30, 0, 90), (35, 23, 90), (30, 20, 60), (40, 20, 50), (35, 23, 45)])
def test_the_wedge_under_level_ground_is_coulombs_passive_pressure(degrees):
    phi, delta, rho = map(math.radians, degrees)
    # K_p of a wall at rho to the horizontal (Coulomb 1776); P = ½ K_p γ d² w, so N_γ = K_p/2
    root = math.sqrt(math.sin(phi + delta) * math.sin(phi) / (math.sin(rho + delta) * math.sin(rho)))
    passive = math.sin(rho - phi) ** 2 / (math.sin(rho) ** 2 * math.sin(rho + delta) * (1.0 - root) ** 2)
    beta = failure_angle(rho, phi, delta, 0.0)
    assert wedge_factor(rho, beta, phi, delta) == pytest.approx(0.5 * passive, rel=1e-12)


@pytest.mark.parametrize("depth", [0.1, 0.2, 0.4])
def test_the_wedge_of_the_cells_has_mckyes_force(depth):
    own = cells(cohesion=5e3, density=16e3 / G, tool_friction=math.radians(23), friction_angle=math.radians(35))
    rho, phi, delta, width = math.radians(60), own.number[FRICTION], own.number[TOOL], 1.2
    beta = failure_angle(rho, phi, delta, 0.0)
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
    edge = np.array([5.0, 4.8, 2.0, 5.0, 5.2, 2.0])
    for _ in range(1000):
        pour(own, edge, 1.0, 0.0, 1e-3)
        slide(own, 400)
    for _ in range(10_000):
        slide(own, 10_000)
    assert own.turn[COUNT] == 0
    heights = own.h - 1.0
    assert math.fsum(heights.ravel()) * CELL**2 == pytest.approx(1.0, abs=1e-13)
    assert own.sum[ADDED] == pytest.approx(1.0, abs=1e-13)
    steepest = max(np.abs(np.diff(own.h, axis=axis)).max() for axis in (0, 1)) / CELL
    assert math.degrees(math.atan(steepest)) == pytest.approx(math.degrees(own.number[REPOSE]), abs=0.06)
    # a cone of 1 m³ with this slope
    assert heights.max() == pytest.approx((3.0 / math.pi * math.tan(own.number[REPOSE]) ** 2) ** (1 / 3), rel=0.01)


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


def test_what_is_taken_in_keeps_momentum_volume_and_energy():
    # without gravity soil has no strength: only its mass acts
    found = simulate(bucket())
    load, speed = found.array("force.digging.load"), found.array("velocity")[:, 0, 0]
    assert load[-1] > 100.0
    # what was taken in at a sample is at speed one period later: frames at such a sample show more
    momentum = (500.0 + load) * speed
    assert momentum.min() == pytest.approx(1000.0, rel=1e-12)
    assert np.median(momentum) == pytest.approx(1000.0, rel=1e-12)
    still = simulate(bucket(capacity=0.02))
    load, speed = still.array("force.digging.load"), still.array("velocity")[:, 0, 0]
    assert (500.0 + load[-1]) * speed[-1] == pytest.approx(1000.0, rel=1e-12)
    for each in (found, still):
        assert np.abs(each.array("force.digging.balance")).max() < 1e-12
        assert np.abs(each.array("energy_error")).max() < 1e-9 * 1000.0
        assert each.trust.verdict == "green"


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
