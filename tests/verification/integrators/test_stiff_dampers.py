"""Dampers that stop what they hold within a small part of a step: fixed steps of newmark, hht and generalised-alpha neither throw nor ring
it, at the start and beyond a corner of a load; what springs store is not lost for it."""

import numpy as np
import pytest

from nivel import Body, Joint, JointSpringDamper, MachineRecord, PointForce, SimulationSettings, Table
from running import run

pytestmark = pytest.mark.covering

MASS, DAMPING, STEP = 2.0, 1e6, 1e-3
METHODS = pytest.mark.parametrize("integrator", ["newmark", "hht", "generalised-alpha"])


def block(*, speed=0.0, stiffness=0.0, damping=0.0, load: float | Table = 0.0):
    """A block on a rail along x."""
    return MachineRecord(
        name="block",
        gravity=(0, 0, 0),
        bodies=(Body(name="block", mass=MASS, inertia=(0.01, 0.01, 0.01), velocity=(speed, 0, 0)),),
        joints=(Joint(name="rail", type="translational", bodies=("ground", "block"), point=(0, 0, 0), axis=(1, 0, 0)),),
        forces=(
            JointSpringDamper(name="holder", coordinate="rail", stiffness=stiffness, damping=damping),
            PointForce(name="load", body="block", vector=(load, 0.0, 0.0)),
        ),
        simulation=SimulationSettings(duration=0.03, step=STEP, output_interval=STEP),
    )


@METHODS
@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_a_speed_that_a_damper_stops_at_once_is_stopped_in_a_step(integrator, coordinates):
    """v₀ exp(-c t/m) is gone after a thousandth of a step; of the position m v₀/c a step knows v₀ at its begin and nothing at its end."""
    r = run(block(speed=1.0, damping=DAMPING), integrator=integrator, coordinates=coordinates)
    assert np.abs(r.velocity[1:, 0, 0]).max() < 2.5 * MASS / (DAMPING * STEP)
    assert np.abs(r.position[:, 0, 0] - MASS / DAMPING).max() < 0.6 * STEP


@pytest.mark.parametrize("radius", [0.0, 0.5, 1.0])
def test_whatever_the_spectral_radius(radius):
    r = run(
        block(speed=1.0, damping=DAMPING), integrator="generalised-alpha", generalised_alpha={"spectral_radius": radius}
    )
    assert np.abs(r.velocity[1:, 0, 0]).max() < 2.5 * MASS / (DAMPING * STEP)
    assert np.abs(r.position[:, 0, 0] - MASS / DAMPING).max() < 0.6 * STEP


@METHODS
@pytest.mark.parametrize("corner", [0.0102, 0.0108, 0.01])
def test_a_load_on_a_damper_moves_it_at_once(integrator, corner):
    """F/c from the frame beyond the corner on."""
    load = Table((0.0, corner, corner + 1e-9, 1.0), (0.0, 0.0, 1000.0, 1000.0))
    r = run(block(damping=DAMPING, load=load), integrator=integrator)
    expected = np.where(r.time > corner + 1e-6, 1000.0 / DAMPING, 0.0)
    away = np.abs(r.time - corner) > 1e-6
    beyond = r.time[r.time > corner + 1e-6][0] - corner
    assert np.abs(r.velocity[away, 0, 0] - expected[away]).max() < 2.5 * MASS / (DAMPING * beyond) * 1000.0 / DAMPING
    assert abs(r.position[-1, 0, 0] - (0.03 - corner) * 1000.0 / DAMPING) < 0.6 * STEP * 1000.0 / DAMPING


@METHODS
def test_what_is_resolved_keeps_its_order(integrator):
    """v₀ exp(-800 t), steps of 6.4 to 0.2 times its time: what is left out of the longest ones costs no more than they do."""
    rate, end = 800.0, 0.016
    machine = block(speed=1.0, damping=rate * MASS)
    errors = []
    for step in (8e-3, 4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4):
        r = run(machine, integrator=integrator, step=step, output_interval=8e-3, duration=end)
        errors.append(np.abs(r.position[:, 0, 0] - (1.0 - np.exp(-rate * r.time)) / rate).max())
    assert errors[0] < 0.6 * 8e-3
    assert np.log2(np.divide(errors[:-1], errors[1:]))[-2:].min() > 1.8


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_a_stiff_spring_keeps_its_energy(coordinates):
    """ω h = 10: the trapezoidal rule keeps ½ m v² + ½ k x²."""
    r = run(block(speed=1.0, stiffness=2e8), integrator="newmark", coordinates=coordinates)
    energy = 0.5 * MASS * r.velocity[:, 0, 0] ** 2 + 0.5 * 2e8 * r.position[:, 0, 0] ** 2
    assert np.abs(energy / energy[0] - 1.0).max() < 1e-9
