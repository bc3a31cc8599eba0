"""BDF of variable order with exact tangents: its tolerance on machines with known motions, and what stiff springs and bristles cost."""

import numpy as np
import pytest

import machines
from lanes import tail
from nivel.errors import ModelError
from references import four_bar, pendulum, slider_crank, stick_slip
from running import run
from simulating import G, simulate
from stiff_machines import elastic_pendulum
from test_events import LEVEL, passing, times
from test_events import pendulum as bar
from test_friction import MASS, sled
from test_tolerance import closing_angle, loop_angles, machine_size, squeezed, squeezer, swinging

pytestmark = pytest.mark.covering

ASKED = pytest.mark.parametrize("tolerance", tail([1e-4, 1e-6, 1e-8, 1e-10], [1e-4, 1e-8]))


@ASKED
@pytest.mark.parametrize("coordinates", ["relative", "absolute", "independent"])
def test_slider_crank(tolerance, coordinates):
    settings = {"duration": 2.0, "output_interval": 0.013, "coordinates": coordinates}
    result = run(machines.slider_crank(), integrator="bdf", tolerance=tolerance, **settings)
    expected = slider_crank.solve(result.time)
    assert np.abs(result.position - expected.position).max() < 10 * tolerance * machine_size(result)
    assert np.abs(result.external_work - expected.work).max() < 10 * tolerance * result.kinetic_energy.max()
    assert np.abs(result.constraint_violation).max() < 1e-12


@ASKED
@pytest.mark.parametrize("coordinates", ["relative", "absolute", "independent"])
def test_four_bar(tolerance, coordinates):
    settings = {"output_interval": 0.05, "coordinates": coordinates}
    result = run(machines.four_bar(), integrator="bdf", tolerance=tolerance, **settings)
    expected = four_bar.solve(result.time, crank_angle=closing_angle())
    assert np.abs(result.position - expected.position).max() < 10 * tolerance * machine_size(result)


@ASKED
def test_andrews_squeezer(tolerance):
    result = run(squeezer(), integrator="bdf", tolerance=tolerance, step=1e-4, output_interval=1e-4)
    assert np.abs(loop_angles(result) - squeezed()).max() < 10 * tolerance


@ASKED
def test_pendulum(tolerance):
    """10 s, closed form by elliptic functions."""
    result = run(swinging(), integrator="bdf", tolerance=tolerance)
    expected = pendulum.solve(result.time, pendulum.Pendulum(inertia=0.02))
    assert np.abs(result.position[:, 0] - expected.position).max() < 10 * tolerance


def steps(machine, **settings):
    finished = run(machine, integrator="bdf", **settings).finished
    assert finished.outcome == "done", finished.failure
    return finished.timing["steps"]


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8])
def test_a_spring_of_damped_material_costs_no_more_than_twice_the_steps(tolerance):
    """Damping of 20 ms times the stiffness, as of rubber: orders above two can be used at any step."""
    soft, relaxation = 10 * 9.81, 0.02
    settings = {"tolerance": tolerance, "duration": 5.0}
    stiff = elastic_pendulum(1e6 * soft, 1e6 * soft * relaxation)
    assert steps(stiff, **settings) <= 2 * steps(elastic_pendulum(soft, soft * relaxation), **settings)


def test_bristles_that_explicit_methods_have_to_follow():
    """Sliding at 0.9 m/s the bristles relax at σ0 v/μ: 3.6e6/s."""
    sigma0, sigma1, static, stribeck = 1e6, 600.0, 0.4, 0.02
    friction = {
        "model": "lugre",
        "coefficient": 0.25,
        "static_coefficient": static,
        "stribeck_speed": stribeck,
        "bristle_stiffness": sigma0,
        "bristle_damping": sigma1,
    }
    pull = {"pull": {"type": "force", "body": "block", "vector": ["8*min(1, time/0.3)", 0, 0]}}
    sections, settings = sled(friction, forces=pull), {"duration": 0.6, "output_interval": 0.01}
    stiff = simulate(sections, integrator="bdf", tolerance=1e-6, **settings)
    explicit = simulate(sections, integrator="dopri5", tolerance=1e-6, **settings)
    levels = (static, 0.25, stribeck), (sigma0, sigma1)
    x, _, _ = stick_slip.bristle(stiff.time, MASS, MASS * G, *levels, lambda t: 8 * min(1, t / 0.3))
    for result in (stiff, explicit):
        np.testing.assert_allclose(result.array("rail.displacement"), x, atol=1e-4 * np.abs(x).max())
    assert explicit.timing["evaluations"] > 50 * stiff.timing["evaluations"]


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_chunks_change_nothing(coordinates):
    settings = {"integrator": "bdf", "duration": 0.5, "output_interval": 0.05, "coordinates": coordinates}
    whole = run(machines.slider_crank(), **settings)
    for chunk_steps in (1, 7):
        pieces = run(machines.slider_crank(), chunk_steps=chunk_steps, **settings)
        assert np.array_equal(whole.frames, pieces.frames)
        assert whole.finished.timing["factorisations"] == pieces.finished.timing["factorisations"]


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_events_are_where_the_closed_form_has_them(coordinates):
    sections = bar(level=LEVEL)
    result = simulate(
        sections, integrator="bdf", tolerance=1e-8, duration=4.0, output_interval=0.1, coordinates=coordinates
    )
    expected = passing(0.5)
    found = times(result)
    np.testing.assert_allclose(found, expected[expected < 4.0][: len(found)], atol=1e-6)
    assert len(found) >= 4


def test_matrix_is_that_of_differences():
    """Exact tangents and those by differences lead Newton's iteration the same way: steps agree within a per cent."""
    settings = {"tolerance": 1e-6, "duration": 1.0, "output_interval": 0.1}
    exact = run(machines.slider_crank(), integrator="bdf", **settings)
    other = run(machines.slider_crank(), integrator="gear", corrector={"iteration": "newton"}, **settings)
    assert abs(exact.finished.timing["steps"] - other.finished.timing["steps"]) < 0.01 * other.finished.timing["steps"]
    assert exact.finished.timing["evaluations"] < other.finished.timing["evaluations"]


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"corrector": {"iteration": "functional"}}, "'functional' does not go with `integrator: bdf`"),
        ({"coordinates": "independent", "formulation": "penalty"}, "there is no violation to feed back"),
        ({"stabilisation": "baumgarte"}, "take direct, or own coefficients"),
    ],
)
def test_what_does_not_go_with_exact_tangents_is_refused(settings, words):
    with pytest.raises(ModelError, match=words):
        run(machines.slider_crank(), integrator="bdf", **settings)
    more = {**settings, "corrector": {"iteration": "functional"}}
    with pytest.raises(ModelError, match="functional"):
        run(machines.slider_crank(), integrator="generalised-alpha", **more)


def test_iteration_is_the_methods_own_where_none_is_chosen():
    from nivel import SimulationSettings
    from nivel.analysis.plan.settings import complete

    for integrator, expected in {"gear": "functional", "am2": "functional", "bdf": "newton", "hht": "newton"}.items():
        corrector = complete(SimulationSettings(integrator=integrator)).corrector
        assert corrector is not None
        assert corrector.iteration == expected
