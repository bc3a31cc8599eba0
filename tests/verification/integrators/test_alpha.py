"""Newmark, HHT-α and generalised-α: orders, constraints, damping, corners, and what they refuse."""

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import machines
from lanes import tail
from nivel import Body, Driver, Joint, JointSpringDamper, MachineRecord, PointForce, SimulationSettings, Table
from nivel.errors import ModelError
from references import four_bar, heavy_top, slider_crank
from running import reference_run, run

pytestmark = pytest.mark.covering

DAMPED = {
    "newmark": {"newmark": {"beta": 0.3025, "gamma": 0.6}},
    "hht": {"hht": {"alpha": 0.1}},
    "generalised-alpha": {"generalised_alpha": {"spectral_radius": 0.6}},
}
SECOND_ORDER = {"newmark": {}, "hht": {"hht": {"alpha": 0.1}}, "generalised-alpha": {}}


def errors_against_fine(machine, integrator, steps, **settings):
    """Largest errors of positions, velocities and reactions over 0.4 s for each step, against a reference at tight tolerance."""
    common = {"duration": 0.4, "output_interval": 0.02}
    fine = reference_run(machine, integrator="dop853", tolerance=1e-11, coordinates="relative", **common)
    found = []
    for step in steps:
        r = run(machine, integrator=integrator, step=step, **common, **settings)
        assert r.finished.outcome == "done"
        found.append(
            [np.abs(getattr(r, name) - getattr(fine, name)).max() for name in ("position", "velocity", "joint_force")]
        )
    return np.array(found)


@pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])
@pytest.mark.parametrize("integrator", SECOND_ORDER)
def test_order_two_in_positions_velocities_and_multipliers(integrator, coordinates):
    steps = [4e-3, 2e-3, 1e-3]
    found = errors_against_fine(
        machines.slider_crank(), integrator, steps, coordinates=coordinates, **SECOND_ORDER[integrator]
    )
    slopes = np.log2(found[:-1] / found[1:])
    assert np.all(np.abs(slopes - 2.0) < 0.2)


@pytest.mark.parametrize("integrator", ["hht", "generalised-alpha"])
def test_order_two_as_index_three(integrator):
    steps = [4e-3, 2e-3, 1e-3]
    settings = {"coordinates": "absolute", "stabilisation": "none", **SECOND_ORDER[integrator]}
    found = errors_against_fine(machines.four_bar(), integrator, steps, **settings)
    slopes = np.log2(found[:-1] / found[1:])
    assert np.all(np.abs(slopes - 2.0) < 0.25)


@pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])
@pytest.mark.parametrize("name", ["slider_crank", "four_bar"])
def test_positions_and_velocities_both_hold(name, coordinates):
    machine = getattr(machines, name)()
    r = run(machine, integrator="generalised-alpha", step=1e-3, coordinates=coordinates)
    assert r.finished.outcome == "done"
    assert np.abs(r.constraint_violation).max() <= 1e-9
    assert np.abs(r.constraint_rate_violation).max() <= 1e-9


def test_slider_crank_survives_a_coarse_step():
    r = run(machines.slider_crank(), integrator="generalised-alpha", step=1e-2, coordinates="relative")
    assert r.finished.outcome == "done"
    expected = slider_crank.solve(r.time)
    # what order two leaves of 2e-5 m at 0.1 ms; the crank turns by 0.35 rad a step in the end
    assert np.abs(r.position - expected.position).max() < 0.15
    assert np.abs(r.energy_error).max() < 0.02 * r.kinetic_energy.max()


def test_four_bar_follows_its_reference():
    x, y, _ = run(machines.four_bar(), duration=1e-3).position[0, 0]
    r = run(machines.four_bar(), integrator="generalised-alpha", step=1e-3)
    expected = four_bar.solve(r.time, crank_angle=np.arctan2(y, x))
    assert np.abs(r.position - expected.position).max() < 1e-3


@pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])
def test_heavy_top_on_the_group_converges_with_order_two(coordinates):
    """150 rad/s: Euler parameters are multiplied, so their length stays one without a correction."""
    found = []
    for step in (4e-4, 2e-4):
        r = run(
            machines.heavy_top(), integrator="generalised-alpha", step=step, duration=0.2, output_interval=0.02,
            coordinates=coordinates,
        )  # fmt: skip
        rotation = Rotation.from_quat(r.orientation[:, 0], scalar_first=True).as_matrix()
        found.append(np.abs(rotation - heavy_top.solve(r.time).rotation).max())
    assert found[0] < 0.2
    assert abs(np.log2(found[0] / found[1]) - 2.0) < 0.2


@pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])
def test_rotations_do_not_depend_on_the_frame_of_the_body(coordinates):
    """Left invariance of the Lie group method: the same top, turned as a whole with its gravity, moves the same.

    In absolute coordinates positions are closed along the columns of a matrix that may be some steps old, and how old depends on which
    component is the largest.
    """
    turn = Rotation.from_rotvec([0.3, -1.1, 0.7])
    body = Body(
        name="top", mass=1.0, inertia=(0.2, 0.1, 0.3), position=(0.0, 0.2, 0.1), angular_velocity=(3.0, -4.0, 5.0),
    )  # fmt: skip

    def whirl(turned):
        place = turn if turned else Rotation.identity()
        quaternion = tuple(place.as_quat(scalar_first=True))
        return MachineRecord(
            name="whirl",
            gravity=tuple(place.apply([0.0, -9.81, 0.0])),
            bodies=(
                body.replace(
                    position=tuple(place.apply([0.0, 0.2, 0.1])),
                    orientation={"euler_parameters": quaternion},
                    angular_velocity=tuple(place.apply([3.0, -4.0, 5.0])),
                ),
            ),
            joints=(Joint(name="ball", type="spherical", bodies=("ground", "top"), point=(0, 0, 0)),),
            simulation=SimulationSettings(
                duration=0.5, step=5e-3, integrator="generalised-alpha", coordinates=coordinates, output_interval=0.05
            ),
        )

    plain, turned = run(whirl(False)), run(whirl(True))
    assert np.abs(turn.apply(plain.position[:, 0]) - turned.position[:, 0]).max() < (
        1e-9 if coordinates == "relative" else 1e-6
    )


def oscillator(stiffness, **settings):
    """1 kg on a spring, released at 1 m."""
    return MachineRecord(
        name="oscillator",
        bodies=(Body(name="block", mass=1.0, inertia=(1.0, 1.0, 1.0), position=(1.0, 0.0, 0.0)),),
        joints=(Joint(name="rail", type="translational", bodies=("ground", "block"), point=(0, 0, 0), axis=(1, 0, 0)),),
        forces=(JointSpringDamper(name="spring", coordinate="rail", stiffness=stiffness, free_value=-1.0),),
        simulation=SimulationSettings(coordinates="relative", **settings),
    )


@pytest.mark.parametrize("radius", [0.0, 0.5, 0.9])
def test_spectral_radius_at_infinity(radius):
    """A vibration far above the step's frequency is left with ρ∞ of its amplitude by each step (Chung, Hulbert 1993).

    All three roots meet at -ρ∞, so the envelope is (c₀ + c₁ n + c₂ n²) ρ∞ⁿ.
    """
    steps = 30
    r = run(
        oscillator(1e10, duration=steps * 1e-2, step=1e-2, output_interval=1e-2),
        integrator="generalised-alpha", generalised_alpha={"spectral_radius": radius},
    )  # fmt: skip
    x = r.position[:, 0, 0]
    assert r.finished.outcome == "done"
    if radius == 0.0:
        # round-off of the first acceleration, ω² h² = 1e6
        assert np.abs(x[4:]).max() < 1e-5
    else:
        n = np.arange(steps + 1)[10:]
        share = x[10:] / (-radius) ** n
        fit = np.polyfit(n, share, 2)
        assert np.abs(share - np.polyval(fit, n)).max() < 1e-3 * np.abs(share).max()


def test_trapezoidal_rule_keeps_the_energy_of_a_linear_machine():
    """ρ∞ = 1: β = ¼, γ = ½, which keeps ½ v² + ½ ω² x² exactly."""
    r = run(
        oscillator(400.0, duration=10.0, step=1e-2),
        integrator="generalised-alpha", generalised_alpha={"spectral_radius": 1.0},
    )  # fmt: skip
    assert np.abs(r.energy_error).max() < 1e-9 * 200.0


def test_frequency_error_is_that_of_the_trapezoidal_rule():
    """tan(ω' h/2) = ω h/2."""
    omega, h = 20.0, 1e-2
    r = run(oscillator(omega**2, duration=3.0, step=h, output_interval=h), integrator="newmark")
    slower = 2.0 / h * np.arctan(0.5 * omega * h)
    assert np.abs(r.position[:, 0, 0] - np.cos(slower * r.time)).max() < 1e-8


@pytest.mark.parametrize("integrator", SECOND_ORDER)
def test_undamped_methods_as_index_three_are_refused(integrator):
    undamped = {
        "newmark": {},
        "hht": {"hht": {"alpha": 0.0}},
        "generalised-alpha": {"generalised_alpha": {"spectral_radius": 1.0}},
    }
    with pytest.raises(ModelError, match="oscillate after a load changes"):
        run(machines.four_bar(), integrator=integrator, stabilisation="none", **undamped[integrator])


@pytest.mark.parametrize("integrator", DAMPED)
def test_damped_methods_settle_as_index_three_after_a_load_step(integrator):
    """A beam of no freedom held by its pin and a driver; the load jumps within a step; the spring's vibration has died out by 0.3 s."""
    r = run(
        loaded(), integrator=integrator, stabilisation="none", coordinates="absolute", duration=0.4, step=1e-3,
        output_interval=1e-3, **DAMPED[integrator],
    )  # fmt: skip
    late = r.time > 0.3
    assert np.abs(r.joint_force[late, 0, 1] - r.joint_force[-1, 0, 1]).max() < 1e-3 * np.abs(r.joint_force[-1, 0, 1])


def loaded():
    return MachineRecord(
        name="loaded",
        bodies=(Body(name="bar", mass=1.0, inertia=(0.1, 0.1, 0.1), position=(0.5, 0.0, 0.0)),),
        joints=(Joint(name="pin", type="revolute", bodies=("ground", "bar"), point=(0, 0, 0), axis=(0, 0, 1)),),
        forces=(
            JointSpringDamper(name="spring", coordinate="pin", stiffness=1e4, damping=100.0),
            PointForce(
                name="load",
                body="bar",
                position=(0.5, 0.0, 0.0),
                vector=(0.0, Table((0.0, 0.1003, 0.1004, 1.0), (0.0, 0.0, -50.0, -50.0)), 0.0),
            ),
        ),
        simulation=SimulationSettings(duration=0.2, step=1e-3),
    )


@cache
def crossed(step):
    """A block that a force table with corners pushes; closed form by pieces of the second degree."""
    table = Table((0.0, 0.3037, 0.7011, 1.0), (1.0, 1.0, -2.0, -2.0))
    machine = MachineRecord(
        name="pushed",
        bodies=(Body(name="block", mass=2.0, inertia=(1.0, 1.0, 1.0)),),
        joints=(Joint(name="rail", type="translational", bodies=("ground", "block"), point=(0, 0, 0), axis=(1, 0, 0)),),
        forces=(PointForce(name="push", body="block", position=(0, 0, 0), vector=(table, 0.0, 0.0)),),
        simulation=SimulationSettings(duration=1.0, step=step, integrator="newmark", output_interval=0.1),
    )
    return run(machine)


def test_a_step_lands_on_the_corners_of_a_load():
    """The force is linear between corners: then the trapezoidal rule gives velocities exactly, whatever the step."""
    r = crossed(0.1)
    impulse = 0.3037 * 1.0 + 0.5 * (1.0 - 2.0) * (0.7011 - 0.3037) - 2.0 * (1.0 - 0.7011)
    assert abs(r.velocity[-1, 0, 0] - impulse / 2.0) < 1e-12
    # and at the corner nothing rings: the acceleration in a frame is that of the force
    times, values = (0.0, 0.3037, 0.7011, 1.0), (1.0, 1.0, -2.0, -2.0)
    assert np.abs(r.acceleration[:, 0, 0] - np.interp(r.time, times, values) / 2.0).max() < 1e-12


def test_chunks_do_not_change_the_result():
    settings = {"duration": 0.0537, "step": 1e-3, "output_interval": 3e-3, "integrator": "generalised-alpha"}
    whole = run(machines.slider_crank(), chunk_steps=10_000, **settings)
    for chunk in (1, 7):
        parts = run(machines.slider_crank(), chunk_steps=chunk, **settings)
        assert np.array_equal(whole.frames, parts.frames)


@pytest.mark.parametrize("tolerance", tail([1e-3, 1e-4, 1e-5], [1e-3]))
@pytest.mark.parametrize("integrator", SECOND_ORDER)
def test_chosen_steps_meet_the_tolerance(integrator, tolerance):
    r = run(
        machines.slider_crank(), integrator=integrator, step_control="error", tolerance=tolerance, duration=2.0,
        output_interval=0.013, **SECOND_ORDER[integrator],
    )  # fmt: skip
    expected = slider_crank.solve(r.time)
    assert np.abs(r.position - expected.position).max() < 10 * tolerance * r.prepared.motion.system.size
    assert np.abs(r.constraint_violation).max() < 1e-9


def test_driver_with_a_corner_in_its_acceleration_is_followed():
    """The natural spline of a driver: positions and rates exactly, whatever the step."""
    times, values = (0.0, 0.31, 0.77, 1.0), (0.0, 0.4, 0.1, 0.5)
    table = Table(times, values, interpolation="cubic")
    machine = MachineRecord(
        name="driven",
        gravity=(0.0, -9.81, 0.0),
        bodies=(Body(name="arm", mass=1.0, inertia=(0.1, 0.1, 0.1), position=(0.5, 0.0, 0.0)),),
        joints=(Joint(name="pivot", type="revolute", bodies=("ground", "arm"), point=(0, 0, 0), axis=(0, 0, 1)),),
        drivers=(Driver(name="turn", coordinate="pivot", value=table),),
        simulation=SimulationSettings(duration=1.0, step=0.02, integrator="generalised-alpha"),
    )
    r = run(machine)
    assert np.abs(r.joint_coordinate[:, 0] - [table(t) for t in r.time]).max() < 1e-10
    # the driver's work and the weight's make up the energy
    assert np.abs(r.energy_error).max() < 1e-2
