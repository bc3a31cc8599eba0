"""Tables 9 to 11 of report 44 (Rouvinen 2003) come out of its program written again, and docs/report-44.md says what is so.

Of the program the cells of the four-bar are run, with `--full` all. That it gives the library's numbers without its habits is asserted
for three of the seventeen cells that do not run away, with `--full` for ten; examples/report-44/report_44.py prints them all.
"""

import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import report_44

import nivel
from lanes import tail

PAGE = (Path(__file__).parent.parent / "docs" / "report-44.md").read_text(encoding="utf-8")
NUMBERED = tuple(enumerate(report_44.CASES))
# Report: 2378 J, which nothing reproduces: the method is unstable there
RUNS_AWAY = ("slider-crank", "direct", "gear")
CELLS = [(name, number, *case) for name in report_44.MACHINES for number, case in NUMBERED]
REPRODUCED = [cell for cell in CELLS if (cell[0], *cell[2:]) != RUNS_AWAY]
# the slider-crank takes six times as long
QUICK = [cell for cell in CELLS if cell[2:] in (("none", "rk4"), ("direct", "rkn4"))]
NAMES = dict(zip(report_44.INTEGRATORS, ("RK4", "RKN4", "Gear"), strict=True))

of_report = cache(report_44.of_report)


def identify(cell):
    return "-".join((cell[0], *cell[2:]))


@pytest.mark.parametrize("cell", tail(REPRODUCED, QUICK), ids=identify)
def test_energies_are_those_of_the_report(cell):
    """Target: 10 %; the page says 6 %."""
    name, number, *case = cell
    assert of_report(name, *case).energy == pytest.approx(report_44.LARGEST_ENERGY_ERROR[name][number], rel=0.06)


@pytest.mark.parametrize("cell", tail([cell for cell in CELLS if cell[2:] != ("direct", "gear")], QUICK), ids=identify)
def test_violations_are_those_of_the_report(cell):
    """Target: a factor of 3.5; the page says 1.7 for the largest and 2.2 for the mean."""
    name, number, *case = cell
    found = of_report(name, *case)
    assert 1 / 1.7 < found.largest_violation / report_44.LARGEST_VIOLATION[name][number] < 1.7
    assert 1 / 2.2 < found.mean_violation / report_44.MEAN_VIOLATION[name][number] < 2.2


@pytest.mark.parametrize("name", tail(report_44.MACHINES, ["four-bar"]))
def test_iterations_of_the_corrector_are_those_of_the_report(name):
    assert of_report(name, "direct", "gear").iterations == pytest.approx(report_44.ITERATIONS[name], rel=0.01)


@pytest.mark.parametrize("name", tail(report_44.MACHINES, ["four-bar"]))
def test_page_shows_the_iterations_of_every_second(name):
    """Figure 23; the report has their mean alone."""
    (row,) = re.findall(rf"^\| {name} \| ([\d.]+) \| ([\d.]+) \| (.*/.*)$", PAGE, re.MULTILINE)
    assert float(row[0]) == report_44.ITERATIONS[name]
    assert float(row[1]) == pytest.approx(of_report(name, "direct", "gear").iterations, abs=0.006)
    shown = [cell.split("/") for cell in row[2].split("|") if "/" in cell]
    found = report_44.iterations_of_seconds(name)
    assert [(float(mean), int(most)) for mean, most in shown] == [
        (pytest.approx(mean, abs=0.006), most) for mean, most in found
    ]


@pytest.mark.full
def test_the_one_cell_that_is_not_reproduced_is_said_to_be_so():
    found = of_report(*RUNS_AWAY).energy
    assert found > 9 * report_44.LARGEST_ENERGY_ERROR["slider-crank"][-1]
    assert "**10.4**" in PAGE


def page_rows(title):
    """{(stabilisation, integrator): cells} of the table whose heading begins with `title`."""
    (body,) = re.findall(rf"^\| {re.escape(title)} .*\n((?:\|.*\n)+)", PAGE, re.MULTILINE)
    rows, stabilisation = {}, ""
    for line in body.splitlines()[2:]:
        first, integrator, *cells = (cell.strip(" *") for cell in line.strip("|").split("|"))
        stabilisation = first or stabilisation
        rows[stabilisation.lower(), integrator] = cells
    return rows


@pytest.mark.full
@pytest.mark.parametrize(
    ("title", "field", "printed"),
    [
        ("Table 9, largest violation", "largest_violation", report_44.LARGEST_VIOLATION),
        ("Table 10, mean violation", "mean_violation", report_44.MEAN_VIOLATION),
        ("Table 11, energy error [J]", "energy", report_44.LARGEST_ENERGY_ERROR),
    ],
    ids=["9", "10", "11"],
)
def test_page_shows_what_the_program_gives(title, field, printed):
    shown = page_rows(title)
    for name, number, stabilisation, integrator in CELLS:
        first = 3 * report_44.MACHINES.index(name)
        report, again, ratio = shown[stabilisation, NAMES[integrator]][first : first + 3]
        value = getattr(of_report(name, stabilisation, integrator), field)
        assert float(again) == pytest.approx(value, rel=1e-3)
        if report != "–":
            assert float(report) == pytest.approx(printed[name][number], rel=1e-3)
            assert float(ratio) == pytest.approx(value / printed[name][number], rel=5e-3)


SAME_AS_LIBRARY = [*(("four-bar", *case) for case in report_44.CASES), ("slider-crank", "none", "rk4")]
SHORT = [("four-bar", "none", "rk4"), ("four-bar", "direct", "rkn4"), ("four-bar", "baumgarte", "gear")]


@pytest.mark.parametrize("cell", tail(SAME_AS_LIBRARY, SHORT), ids="-".join)
def test_without_its_habits_the_program_gives_the_library_s_numbers(cell):
    """Two programs that share no line: the same equations, methods and step. The library's corrector has a tolerance relative to
    the largest value of each entry, its correction is repeated, and its work is integrated with the motion."""
    program, library = of_report_without_habits(*cell), report_44.of_nivel(*cell)
    assert program.energy == pytest.approx(library.energy, rel=5e-3)
    if cell[1] != "direct":
        assert program.largest_violation == pytest.approx(
            library.largest_violation, rel=5e-3 if "gear" in cell else 1e-4
        )


def of_report_without_habits(*cell):
    return report_44.of_report(*cell, **report_44.WITHOUT)


@pytest.mark.parametrize("phi", [0.2, 0.3])
def test_gear_of_order_4_with_direct_correction_gains_energy_as_its_root_does(phi):
    """Σ (1 - 1/w)ᵏ/k = iφ has w = exp(iφ + φ⁶/3 + …): what turns by φ in a step gains 2φ⁶/3 of its energy. Of the crank's
    energy 0.71 is that of its centre, which turns by φ; the rest is in Euler parameters, which turn by φ/2."""
    step = 0.01
    machine = nivel.Machine(
        "crank",
        bodies=[nivel.Body(name="crank", mass=21.0, inertia=(0.022, 0.513, 0.526), position=(0.25, 0.0, 0.0))],
        joints=[
            nivel.Joint(
                name="hinge",
                type="revolute",
                bodies=("ground", "crank"),
                point=(0.0, 0.0, 0.0),
                axis=(0.0, 0.0, 1.0),
                start_rates={"angle": phi / step},
            )
        ],
    )
    settings = {
        "step": step,
        "output_interval": step,
        "duration": 1.0,
        "formulation": "lagrange",
        "coordinates": "absolute",
        "integrator": "gear4",
        "stabilisation": "direct",
        "corrector": {"tolerance": 1e-10},
    }
    energy = machine.with_settings(settings).simulate().array("kinetic_energy")
    gain = (energy[-1] / energy[50]) ** (1 / 50) - 1
    assert 0.7 < gain / (2 * phi**6 / 3) < 1.1
    # the root itself
    polynomial = sum(np.poly1d([1.0, -1.0]) ** k * np.poly1d([1.0] + [0.0] * (4 - k)) / k for k in range(1, 5))
    w = (polynomial - 1j * phi * np.poly1d([1.0, 0, 0, 0, 0])).roots
    assert np.log(np.abs(w).max()) == pytest.approx(phi**6 / 3, rel=0.1)


def test_lines_are_short():
    assert not [line for line in PAGE.splitlines() if len(line) > 130]
