"""Examples from an SDF model and a STEP file: a linkage against virtual work, solids against their volumes."""

from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import nivel
from needing import needs

EXAMPLES = Path(__file__).parents[2] / "examples" / "robots"
CRANK, COUPLER, ROCKER, GROUND = 0.25, 0.8, 0.5, 0.8


def angles(first):
    """Directions of crank, coupler and rocker in the plane x, z, by the law of cosines."""
    b = CRANK * np.array([np.cos(first), np.sin(first)])
    way = np.array([GROUND, 0.0]) - b
    d = np.hypot(*way)
    along = (COUPLER**2 - ROCKER**2 + d**2) / (2 * d)
    c = b + (along * way + np.sqrt(COUPLER**2 - along**2) * np.array([-way[1], way[0]])) / d
    coupler, rocker = c - b, c - [GROUND, 0.0]
    return np.array([first, np.arctan2(coupler[1], coupler[0]), np.arctan2(rocker[1], rocker[0])])


def centres(first):
    """Centres of mass of the three bars, and their directions."""
    turn = angles(first)
    u = np.column_stack([np.cos(turn), np.sin(turn)])
    b = CRANK * u[0]
    return np.array([0.5 * b, b + 0.5 * COUPLER * u[1], [GROUND, 0.0] + 0.5 * ROCKER * u[2]]), turn


def test_the_linkage_of_sdf_begins_as_virtual_work_says():
    """I(φ) φ̈ = -V'(φ) from rest, with I = Σ m |r'|² + J φᵢ'² over the bars; derivatives by differences."""
    masses, lengths = np.array([0.8, 2.0, 1.3]), np.array([CRANK, COUPLER, ROCKER])
    first, h = np.deg2rad(70), 1e-5
    (after, turned), (before, turn) = centres(first + h), centres(first - h)
    rates, spins = (after - before) / (2 * h), (turned - turn) / (2 * h)
    inertia = np.sum(masses * np.sum(rates**2, axis=1) + masses * lengths**2 / 12 * spins**2)
    expected = -9.81 * np.sum(masses * rates[:, 1]) / inertia
    mechanics = nivel.load(EXAMPLES / "linkage.yaml").mechanics()
    found = mechanics.forward_dynamics(mechanics.start, [0.0], [0.0])
    # about +y, from z to x: against the angles from x to z
    ways = {"shaft.angle": -1.0, "elbow.angle": spins[0] - spins[1], "pivot.angle": -spins[2]}
    assert found[0] == pytest.approx(ways[mechanics.names[0]] * expected, rel=1e-6)


def test_the_linkage_is_the_translation_of_its_model():
    ours, example = nivel.import_model(EXAMPLES / "linkage.sdf").record, nivel.load(EXAMPLES / "linkage.yaml").record
    for section in ("bodies", "joints", "forces", "gravity"):
        assert getattr(ours, section) == getattr(example, section)


def test_the_lift_of_step_has_the_masses_of_its_solids():
    """The post: two boxes less a slot of 120 x 50 x 80 mm and a hole of 30 mm through both cheeks of 35 mm."""
    needs("gmsh")
    lift = nivel.load(EXAMPLES / "lift.yaml")
    volume = 120 * 120 * 300 + 300 * 300 * 20 - 120 * 50 * 80 - np.pi * 15**2 * 70
    assert lift.mass_properties(bodies="post").mass == pytest.approx(7850e-9 * volume, rel=1e-9)
    result = lift.simulate(duration=0.5, verify=False)
    assert result.outcome == "done"
    assert result.array("hinge.angle")[-1] == pytest.approx(0.4 * (1 - np.cos(1.0)), abs=1e-9)


def test_the_spindle_follows_its_log():
    """Its angle is the integral of the logged speed, and the effort of the driver that of both inertias and the drag, at the motor."""
    folder = EXAMPLES.parent / "exchange"
    log = np.genfromtxt(folder / "spindle-log.csv", delimiter=",", names=True)
    speed = CubicSpline(log["time_ms"] / 1e3, log["speed_rpm"] * np.pi / 30, bc_type="natural")
    result = nivel.load(folder / "spindle.yaml").simulate(verify=False)
    assert result.array("motor.angle")[-1] == pytest.approx(float(speed.integrate(0, 2)), rel=1e-9)
    rotor, spindle = 7850 * np.pi * 0.15 * 0.04**4 / 2, 7850 * np.pi * 0.4 * 0.06**4 / 2
    wanted = (rotor + 4 * spindle) * speed(result.time, 1) + 4 * 0.02 * speed(result.time)
    np.testing.assert_allclose(result.array("driver.log.effort"), wanted, atol=1e-4 * np.abs(wanted).max())
