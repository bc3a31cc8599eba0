"""Comparing methods: grids, references, measures; against plain runs and closed forms."""

import csv
import math
import signal

import numpy as np
import pytest

from nivel.analysis.compare.compare_grid import Axes, lay_out
from nivel.analysis.progress.log import Listener
from nivel.errors import ModelError
from nivel.results.comparison import Comparison
from nivel.results.motion import Motion, distance
from simulating import hinge, machine, slide, solid, wheel

pytestmark = pytest.mark.covering

G = (0, -9.81, 0)


def oscillator(stiffness=(2 * math.pi) ** 2, mass=1.0, **simulation):
    """A mass on rails and a spring, released at x = 1 m: x = cos(ω t), ω² = stiffness/mass."""
    spring = {
        "type": "spring-damper",
        "markers": [{"body": "ground", "position": [-5, 0, 0]}, {"body": "block"}],
        "stiffness": stiffness,
        "damping": 0,
        "free_length": 5,
    }
    return machine(
        {
            "name": "oscillator",
            "bodies": {"block": solid(mass, position=[1, 0, 0])},
            "joints": {"rails": slide("ground", "block")},
            "forces": {"spring": spring},
            "simulation": {"duration": 1, "step": 0.01, **simulation},
        }
    )


def pendulum(**simulation):
    return machine(
        {
            "name": "pendulum",
            "gravity": G,
            "bodies": {"arm": wheel(0.2, position=[1, 0, 0])},
            "joints": {"pin": hinge("ground", "arm")},
            "simulation": {"duration": 1, "step": 0.01, **simulation},
        }
    )


@pytest.fixture(scope="module")
def compared():
    return pendulum().compare(
        formulations=["newton-euler", "lagrange"], stabilisations=["none", "direct"], steps=[0.01, "5 ms"], repeat=1
    )


def test_auto_and_the_coordinates_that_it_stands_for_are_one_row():
    rows = pendulum().compare(coordinates=["auto", "relative", "absolute"], steps=[0.01, 0.005], repeat=1).rows
    assert [(row.coordinates, row.step) for row in rows] == [
        (coordinates, step) for coordinates in ("relative", "absolute") for step in (0.01, 0.005)
    ]


def test_every_combination_is_a_row(compared):
    assert len(compared.rows) == 8
    assert len({(row.method, row.step) for row in compared.rows}) == 8
    assert {row.outcome for row in compared.rows} == {"done"}
    # `auto` means relative coordinates for newton-euler and absolute ones for lagrange
    assert compared.varying == ("formulation", "coordinates", "stabilisation")


@pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
@pytest.mark.parametrize("stabilisation", ["none", "direct"])
def test_the_numbers_of_a_cell_are_those_of_a_plain_run(compared, formulation, stabilisation):
    (row,) = (
        row
        for row in compared.rows
        if (row.formulation, row.stabilisation, row.step) == (formulation, stabilisation, 0.005)
    )
    result = pendulum().simulate(
        formulation=formulation, stabilisation=stabilisation, step=0.005, output_interval=compared.output_interval
    )
    assert (row.steps, row.evaluations) == (result.timing["steps"], result.timing["evaluations"])
    assert (row.rejected, row.iterations) == (result.timing["rejected"], result.timing["iterations"])
    assert row.energy_error == np.abs(result.array("energy_error")).max()
    assert row.energy_error_relative == pytest.approx(row.energy_error / result.array("kinetic_energy").max(), rel=1e-4)
    rows = [name for name in result.coordinates["constraint"] if not name.endswith("euler_parameters")]
    share = np.array([[result["constraint_violation"].sel(constraint=name)] for name in rows]).squeeze()
    scales = [compared.size if ".s." in name else 1.0 for name in rows]
    assert row.constraint_error == pytest.approx(np.abs(share / np.reshape(scales, (-1, 1))).max(), rel=1e-12)
    assert row.constraint_error_mean == pytest.approx(np.abs(share / np.reshape(scales, (-1, 1))).mean(), rel=1e-12)
    assert row.seconds_per_step * row.steps == pytest.approx(row.loop_seconds)


def test_the_error_of_the_motion_is_that_of_the_closed_form():
    comparison = oscillator().compare(stabilisations="direct", steps=[0.02, 0.01, 0.005], repeat=1)
    for row in comparison.rows:
        result = oscillator().simulate(step=row.step, output_interval=comparison.output_interval)
        true = np.abs(result.array("block.position")[:, 0] - np.cos(2 * math.pi * result.time)).max() / comparison.size
        assert row.motion_error == pytest.approx(true, rel=1e-5)
        assert row.motion_error_body == "block"


def test_the_error_of_the_reference_is_below_what_it_says():
    from nivel.analysis.compare.compare import solve

    record = oscillator().record
    grid = lay_out(record, Axes(steps=[0.02, 0.01]))
    for solution in solve(record, grid, Listener()):
        exact = np.zeros_like(solution.motion.position)
        exact[:, 0, 0] = np.cos(2 * math.pi * solution.motion.time)
        error = distance(
            Motion(solution.motion.time, exact, solution.motion.orientation, ("block",)), solution.motion, solution.size
        )
        assert error.value < 10 * solution.facts.error + 1e-13
        assert solution.facts.error < 1e-9


def test_the_error_of_the_motion_falls_with_the_order_of_the_method(compared):
    """Half the step leaves 2⁻⁴ of the error of rk4."""
    finer = [row for row in compared.rows if row.step == 0.005]
    assert all(row.order == pytest.approx(4.0, abs=0.3) for row in finer)
    for rows in compared.curves().values():
        assert math.log2(rows[0].motion_error / rows[1].motion_error) == pytest.approx(rows[1].order)


def test_the_spread_is_the_largest_distance_between_the_finest(compared):
    assert compared.spread.methods == 4
    finest = {compared.label(row): row.motion_error for row in compared.rows if row.step == 0.005}
    assert {compared.spread.first, compared.spread.second} <= set(finest)
    largest = sorted(finest.values())[-2:]
    # by the triangle inequality, the reference between them
    assert max(finest.values()) - min(finest.values()) <= compared.spread.distance <= sum(largest) + 1e-12


def test_methods_that_have_not_converged_are_left_out_of_the_spread():
    """Errors of cos(2π t) after 1 s, in a machine of 1 m: 2π² h for euler, (2π)³ h²/6 for heun."""
    comparison = oscillator().compare(integrators=["euler", "heun", "rk4"], steps=[0.004, 0.002], repeat=1)
    assert (comparison.spread.methods, comparison.spread.left_out) == (2, 1)
    assert {comparison.spread.first, comparison.spread.second} == {"heun", "rk4"}
    assert "1 method is left out" in str(comparison)


def test_a_cell_that_fails_does_not_stop_the_others():
    """ω h = 10 is beyond the stability of rk4: the state grows 400-fold a step until it is no number."""
    comparison = oscillator(stiffness=1e4, duration=13).compare(steps=[0.1, 0.001], stabilisations="none", repeat=1)
    failed, done = comparison.rows
    assert (failed.outcome, done.outcome) == ("failed", "done")
    assert "stopped at t = " in failed.reason
    assert failed.motion_error is None
    assert failed.steps > 0
    assert done.motion_error < 0.2
    assert comparison.spread is None
    assert "failed: stopped at t" in str(comparison)


def test_a_combination_without_meaning_is_refused_with_its_reason():
    comparison = pendulum().compare(formulations=["penalty", "newton-euler"], stabilisations="baumgarte", repeat=1)
    refused, done = comparison.rows
    assert (refused.outcome, done.outcome) == ("refused", "done")
    assert "does not go with `formulation: penalty`" in refused.reason


def test_runs_that_an_event_ended_are_told():
    """x = cos(2π t) passes 0 at t = 1/4; the frequency of euler is lower by the share (2π h)²/3."""
    spring = oscillator()
    spring.record = spring.record.replace(events=[{"name": "centre", "when": "block.x", "stop": True}])
    comparison = spring.compare(integrators=["rk4", "euler"], steps=[0.01, 0.005], stabilisations="none", repeat=1)
    assert [row.stopped_by for row in comparison.rows] == ["centre"] * 4
    times = [row.end_time for row in comparison.rows]
    assert times[:2] == pytest.approx([0.25, 0.25], abs=1e-7)
    assert times[2:] == pytest.approx([0.25 * (1 + (2 * math.pi * h) ** 2 / 3) for h in (0.01, 0.005)], abs=1e-5)
    text = str(comparison)
    assert f"4 of 4 runs were ended by the event centre, at {min(times):.6g} to {max(times):.6g} s" in text
    assert ", up to 1 s simulated;" in text
    assert "ended at" in text
    assert all(row.motion_error_time <= 0.25 + 1e-7 for row in comparison.rows)
    assert Comparison.from_json(comparison.to_json()) == comparison
    alone = spring.compare(repeat=1)
    assert "the run was ended by the event centre, at 0.25 s" in str(alone)


@pytest.mark.full
def test_without_a_reference_the_other_numbers_stay():
    """A force that stops being a number ends every run."""
    burst = machine(
        {
            "bodies": {"block": solid()},
            "joints": {"rails": slide("ground", "block")},
            "forces": {"push": {"type": "force", "body": "block", "vector": ["log(0.5 - time)", 0, 0]}},
            "simulation": {"duration": 1, "step": 0.01},
        }
    )
    comparison = burst.compare(repeat=1)
    assert [row.outcome for row in comparison.rows] == ["failed"]
    assert comparison.references == ()
    assert comparison.note.startswith("no reference")
    assert "no reference" in str(comparison)


def test_an_interrupt_keeps_what_was_computed():
    def interrupt(text, _total):
        if text.startswith("2 of "):
            raise KeyboardInterrupt

    comparison = pendulum().compare(steps=[0.01, 0.005], repeat=1, listener=Listener(interrupt))
    assert comparison.outcome == "interrupted"
    assert len(comparison.rows) == 1
    assert "cells are missing" in str(comparison)


def test_an_interrupt_within_the_last_steps_of_a_run_is_not_lost():
    def interrupt(time):
        if time == 1.0:
            signal.raise_signal(signal.SIGINT)

    comparison = pendulum().compare(steps=[0.01, 0.005], repeat=1, listener=Listener(progress=interrupt))
    assert comparison.outcome == "interrupted"
    assert comparison.rows == ()


def test_a_machine_that_cannot_start_is_refused_as_a_whole():
    far = {"type": "spherical", "markers": [{"body": "ground", "position": [5, 0, 0]}, {"body": "arm"}]}
    torn = machine(
        {"bodies": {"arm": wheel(0.2, position=[1, 0, 0])}, "joints": {"pin": hinge("ground", "arm"), "far": far}}
    )
    with pytest.raises(ModelError, match=r"far\.s\.x is open"):
        torn.compare(steps=[0.01, 0.005])


def test_words_that_are_not_known_are_refused_all_at_once():
    with pytest.raises(ModelError) as caught:
        pendulum().compare(integrators=["rk4", "rk5"], formulations="lagrang", steps=["3 kg"], tolerances=[2])
    told = str(caught.value)
    for part in ("integrators.1", "did you mean `rk4`", "did you mean `lagrange`", "a time (s)", "less than 1"):
        assert part in told


@pytest.mark.parametrize(
    ("asked", "part"),
    [
        ({"tolerances": [1e-6]}, "the steps of rk4 are fixed"),
        ({"rotations": ["euler-angles"]}, "not among the formulations"),
        ({"largest_step": 0.01}, "the steps of rk4 are fixed"),
        ({"cut": ["pin"], "coordinates": ["absolute"]}, "no cell is in relative coordinates"),
        ({"steps": [0.01, 0.01 * math.sqrt(2)]}, "no common multiple"),
        ({"steps": [1e-3, 1.000000001e-3]}, "the steps 0.001 s, 0.001000000001 s have no common multiple"),
        ({"repeat": 0}, "at least 1"),
        ({"repeat": 1.5}, "repeat: a whole number was expected, got `1.5`"),
        ({"repeat": "3"}, "repeat: a whole number was expected, got `3`"),
        ({"cut": "nail"}, "there is no joint `nail`"),
    ],
)
def test_what_would_have_no_effect_is_refused(asked, part):
    with pytest.raises(ModelError, match=part):
        pendulum().compare(**asked)


@pytest.mark.parametrize("axis", ["integrators", "formulations", "coordinates", "rotations", "stabilisations", "steps"])
@pytest.mark.parametrize("values", [[], (), "", ["", "10 ms"]])
def test_an_axis_that_is_given_and_empty_is_refused(axis, values):
    with pytest.raises(ModelError, match=f"{axis}: a value is missing"):
        pendulum().compare(**{axis: values})


@pytest.mark.parametrize(
    ("steps", "interval"),
    [([0.001, 0.002], 0.002), ([0.002, 0.003], 0.006), ([1 / 300, 1 / 200], 0.01), ([0.001], 0.001), ([1e-4], 1e-3)],
)
def test_frames_are_at_a_common_multiple_of_all_steps(steps, interval):
    grid = lay_out(pendulum(duration=1).record, Axes(steps=steps))
    assert grid.interval == pytest.approx(interval, rel=1e-12)
    assert all(cell.plan is not None for cell in grid.cells)


def test_the_interval_of_the_machine_is_taken_where_it_fits():
    record = pendulum(output_interval=0.1).record
    assert lay_out(record, Axes(steps=[0.01, 0.02])).interval == 0.1
    assert lay_out(record, Axes(steps=[0.03])).interval == pytest.approx(0.03)


def test_steps_that_do_not_divide_the_interval_asked_for_are_refused_cells():
    record = pendulum(output_interval=0.1).record
    fitting, other = lay_out(record, Axes(steps=[0.02, 0.03]), {"output_interval"}).cells
    assert fitting.plan is not None
    assert other.plan is None
    assert "not a multiple of the step" in other.reason


def test_words_given_twice_and_rotations_of_other_formulations_make_no_cells():
    axes = Axes(
        formulations=["newton-euler", "lagrange"],
        rotations=["euler-parameters", "rotation-vector"],
        steps=[0.01, "10 ms"],
    )
    methods = [cell.method for cell in lay_out(pendulum().record, axes).cells]
    assert [(each.formulation, each.rotations) for each in methods] == [
        ("newton-euler", "euler-parameters"),
        ("lagrange", "euler-parameters"),
        ("lagrange", "rotation-vector"),
    ]


def test_tables_are_read_back_as_they_were(compared, tmp_path):
    assert Comparison.from_json(compared.to_json(tmp_path / "c.json")) == compared
    assert (tmp_path / "c.json").read_text(encoding="utf-8") == compared.to_json()
    text = compared.to_csv(tmp_path / "c.csv")
    assert (tmp_path / "c.csv").read_text(encoding="utf-8") == text
    table = list(csv.DictReader(text.splitlines()))
    for line, row in zip(table, compared.rows, strict=True):
        assert float(line["step [s]"]) == row.step
        assert float(line["motion_error"]) == row.motion_error
        assert line["stabilisation"] == row.stabilisation
        assert line["tolerance"] == ""


@pytest.mark.parametrize("write", ["to_csv", "to_json", "report"])
def test_an_existing_file_is_replaced_with_force_only(compared, tmp_path, write):
    mine = tmp_path / "mine"
    mine.write_text("mine")
    with pytest.raises(ModelError, match="force=True"):
        getattr(compared, write)(mine)
    assert mine.read_text() == "mine"
    getattr(compared, write)(mine, force=True)
    assert mine.read_text(encoding="utf-8") != "mine"


def test_a_single_joint_may_be_cut_by_its_name():
    grid = pendulum().compare(cut="pin", coordinates="relative", repeat=1)
    assert grid.rows[0].outcome == "done"


def test_the_text_has_a_line_for_every_row(compared):
    text = str(compared)
    assert text.count("newton-euler  ") == 4
    assert "reference: " in text
    assert "spread: the 4 methods" in text
    assert compared._repr_html_().count("<tr>") == 9


def test_the_distance_of_two_motions():
    """A turn by 0.3 rad about z, θ = (cos 0.15, 0, 0, sin 0.15); a shift of 1 m in a machine of 2 m is 0.5."""
    time = np.linspace(0, 1, 3)
    rest = Motion(time, np.zeros((3, 1, 3)), np.tile([1.0, 0, 0, 0], (3, 1, 1)), ("a",))
    turned = Motion(time, rest.position, np.tile([-np.cos(0.15), 0, 0, -np.sin(0.15)], (3, 1, 1)), ("a",))
    shifted = Motion(time[1:], np.full((2, 1, 3), [0, 1.0, 0]), rest.orientation[1:], ("a",))
    assert distance(rest, turned, 2.0).value == pytest.approx(0.3, rel=1e-12)
    assert distance(rest, shifted, 2.0).value == 0.5
    assert distance(rest, shifted, 2.0).time == 0.5
