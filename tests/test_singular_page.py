"""What docs/singular-positions.md concludes is so, and its tables hold what examples/report-44/singular_positions.py computes."""

import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import singular_positions as example

from linkages import change_point
from nivel.errors import SolveError
from references import four_bar
from simulating import simulate

DOCS = Path(__file__).parent.parent / "docs"
PAGE = (DOCS / "singular-positions.md").read_text(encoding="utf-8")
BETWEEN, HIT, LOADED = (case[1:] for case in example.PASSAGES)
PENALISED = [name for name in example.NAMED if name.startswith(("penalty", "augmented"))]
CORRECTED = [name for name in example.NAMED if name.endswith(("direct", "geometric")) or name == "independent"]


@cache
def named(step, name):
    return example.four_bar_errors(step, **example.NAMED[name])


@cache
def passed(case, name):
    return example.passage(*case, **example.NAMED[name])


def page_rows(title):
    """{first cell: other cells} of the table whose heading begins with `title`."""
    (body,) = re.findall(rf"^\| {re.escape(title)} *\|.*\n((?:\|.*\n)+)", PAGE, re.MULTILINE)
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in body.splitlines()[1:]]
    return {row[0]: row[1:] for row in cells}


def test_reference_is_the_independent_one():
    """The page: within 1e-9 m. The reference of the tests is an equation of the crank angle alone."""
    result = example.reference()
    x, y, _ = result.array("position")[0, 0]
    expected = four_bar.solve(result.time, crank_angle=np.arctan2(y, x))
    np.testing.assert_allclose(result.array("position"), expected.position, atol=1e-9)


def test_crank_and_coupler_are_in_line_and_the_rows_are_independent():
    position = example.reference().array("position")
    tip = 2.0 * position[:, 0, :2]
    along = position[:, 1, :2] - tip
    sine = np.cross(np.pad(tip, ((0, 0), (0, 1))), np.pad(along, ((0, 0), (0, 1))))[:, 2] / 4.0
    time, value = example.independence()
    inside = np.abs(time - example.IN_LINE) < 0.006
    assert np.any(np.abs(sine[inside]) < 0.05)
    assert value[inside][0] == pytest.approx(0.227, abs=1e-3)
    assert 0.178 - 1e-3 < value.min() < value.max() < 0.255 + 1e-3
    assert time[value.argmin()] == pytest.approx(0.48)


def test_crank_turns_fast_there():
    """Accelerations of -119 and +236 rad/s² within 19 ms."""
    given = {"coordinates": "relative", "integrator": "dop853", "tolerance": 1e-10, "output_interval": 1e-3}
    result = example.four_bar_run(1e-3, **given)
    acceleration = np.gradient(np.gradient(result.array("crank_pivot.angle"), result.time), result.time)
    near = np.flatnonzero(np.abs(result.time - example.IN_LINE) < 0.05)
    least, largest = near[acceleration[near].argmin()], near[acceleration[near].argmax()]
    assert acceleration[least] == pytest.approx(-119, abs=1)
    assert acceleration[largest] == pytest.approx(236, abs=1)
    assert 0 < result.time[largest] - result.time[least] == pytest.approx(0.019, abs=1.1e-3)


@pytest.mark.parametrize("name", ["none", "baumgarte 5, 5", "baumgarte 20, 20", "penalty", "augmented"])
def test_violation_in_line_is_the_error_of_the_step(name):
    """Fourth order: a tenth of the step leaves between 10⁻³ and 10⁻⁵ of it."""
    assert 1e3 < named(0.01, name).near / named(0.001, name).near < 1e5


def test_coefficients_of_eq_111_do_harm():
    for step, factor in ((0.01, 10), (0.001, 400)):
        assert named(step, "baumgarte eq. 111").energy > factor * named(step, "none").energy
        assert named(step, "baumgarte eq. 111").near > 10 * named(step, "baumgarte 20, 20").near
    for alpha in (200.0, 500.0):
        with pytest.raises(SolveError):
            example.four_bar_errors(0.01, **example.baumgarte(alpha))


@pytest.mark.parametrize(("step", "best"), [(0.01, 20.0), (0.001, 50.0)])
def test_best_coefficient_depends_on_the_step(step, best):
    found = {alpha: example.four_bar_errors(step, **example.baumgarte(alpha)).near for alpha in example.BAUMGARTE[:5]}
    assert min(found, key=found.__getitem__) == best


@pytest.mark.parametrize("step", [0.01, 0.001])
def test_correction_keeps_constraints_to_round_off(step):
    assert all(named(step, name).violation < 1e-11 for name in CORRECTED)
    assert min(example.NAMED, key=lambda name: named(step, name).position) == "geometric"


def test_correction_does_not_make_the_motion_better_at_the_large_step():
    assert named(0.01, "direct").energy > named(0.01, "none").energy
    assert named(0.01, "direct").position > named(0.01, "none").position


def test_penalty_converges_as_1_over_alpha_and_augmented_is_there():
    errors = {
        way: [example.four_bar_errors(1e-3, **example.penalised(way, factor)).position for factor in (1e4, 1e6, 1e8)]
        for way in ("penalty", "augmented-lagrangian")
    }
    one, two, three = errors["penalty"]
    assert one / two == pytest.approx(100, rel=0.1)
    assert two / three == pytest.approx(100, rel=0.1)
    assert max(errors["augmented-lagrangian"]) < 2e-7


def test_violation_of_the_augmented_lagrangian_is_that_of_baumgarte():
    own, other = named(0.01, "augmented"), example.four_bar_errors(0.01, **example.baumgarte(10.0))
    assert own.violation == pytest.approx(other.violation, rel=0.01)


@pytest.mark.parametrize("case", [BETWEEN, LOADED], ids=["free", "loaded"])
def test_all_pass_the_flat_position_between_two_steps(case):
    for name in example.NAMED:
        found = passed(case, name)
        assert found.apart < 1e-3, name
        assert found.violation < 3e-7, name
        assert found.energy < (6e-4 if name in PENALISED else 3e-7), name


def test_penalties_lose_energy_under_load():
    assert all(3e-6 < passed(LOADED, name).energy < 6e-4 for name in PENALISED)


@pytest.mark.parametrize("name", example.NAMED)
def test_flat_position_hit_by_a_step_is_passed_by_penalties_only(name):
    if name in PENALISED:
        assert passed(HIT, name).apart < 1e-6
        assert passed(HIT, name).violation < 1e-9
    else:
        with pytest.raises(SolveError) as caught:
            passed(HIT, name)
        assert caught.value.time == pytest.approx(1.0, abs=2e-3)


@pytest.mark.parametrize(("title", "step"), [("step 10 ms", 0.01), ("step 1 ms", 0.001)])
def test_page_shows_the_errors_of_the_four_bar(title, step):
    """Round-off may differ from machine to machine: up to 1e-11 only its smallness is asserted."""
    for name, cells in page_rows(title).items():
        if name in example.NAMED:
            found = named(step, name)
            for cell, value in zip(cells, (found.violation, found.near, found.energy, found.position), strict=True):
                assert max(float(cell), value) < 1e-10 or float(cell) == pytest.approx(value, rel=0.06), name


def test_picture_is_there():
    (picture,) = re.findall(r"!\[.*\]\((.*)\)", PAGE)
    assert (DOCS / picture).stat().st_size < 150_000


def test_lines_are_short():
    assert not [line for line in PAGE.splitlines() if len(line) > 130]


TURNING = page_rows("relative coordinates, crank starts at 0.5 rad with 2 rad/s")


@pytest.mark.parametrize("integrator", TURNING)
def test_methods_that_choose_their_steps_turn_at_the_tolerances_of_the_page(integrator):
    """`integrator` in the words of the page; a run may stop in place of turning."""
    straight, turned = (set(re.findall(r"1e-\d+", cell)) for cell in TURNING[integrator])
    for tolerance in sorted(straight | turned):
        given = {"integrator": integrator.strip("`"), "tolerance": float(tolerance), "coordinates": "relative"}
        try:
            result = simulate(change_point(), duration=2.5, **given)
        except SolveError:
            assert tolerance in turned
        else:
            assert ("branch" in {item.name for item in result.trust.items}) == (tolerance in turned)
