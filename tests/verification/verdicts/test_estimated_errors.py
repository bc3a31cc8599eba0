"""Estimated errors against true ones: within a factor of three above in 90 % of many pairs of machine and method, and below a third in 5 %
at most: of places, speeds, signals, currents, pressures and states. Of places, none is below a third."""

import numpy as np
import pytest

from deceiving import KINDS
from known_motions import KNOWN
from nivel import ModelError, SolveError
from nivel.api import Machine
from nivel.integrate.catalogue import INTEGRATORS

# Errors below are round-off of what the solutions themselves are computed by.
ROUND_OFF = 1e-9
METHODS = ("rk4", "dopri5", "radau")
FULL = (
    "heun",
    "ab3",
    "abm4",
    "am3",
    "gear3",
    "dop853",
    "adams",
    "generalised-alpha",
    "newmark",
    "bdf",
    "ros2",
    "energy-momentum",
)
STEPS = (4.0, 2.0, 1.0)
PLACES = (".position.x", ".angle", ".displacement")  # ends of their names
# Of the corners of a table fixed steps meet some and miss others, so that their errors are accidents; a block at rest has none.
LEFT_OUT = ("pulse", "stiction", "wall", "far", "flywheel", "sphere")
# of known motions those that need no numerical reference
CLOSED_FORMS = ("low-pass", "sampled-control", "bouncing", "slide-that-stops", "blow-down-isothermal")


def ratios(methods, steps):
    """Estimated over true error of machines of mechanics and loads, for all pairs that run and have an error above round-off."""
    out = {}
    for kind in KINDS:
        if kind.name.startswith(LEFT_OUT):
            continue
        record = kind.machine(True)
        for method, fineness in grid(methods, steps, record.simulation.step, 1e-7):
            add_ratio(out, kind, record, method, fineness, lambda time, kind=kind: kind.exact(time, True))
    return out


def known_ratios(methods, steps, kinds=KNOWN):
    """The same of circuits, gas, control, contact, friction, drives and ropes."""
    out = {}
    for kind in kinds:
        for method, fineness in grid(methods, steps, kind.step, 1e-8):
            add_ratio(out, kind, kind.machine(), method, fineness, kind.exact, kind.beside)
    return out


def grid(methods, steps, step, tolerance):
    """Methods with their step or tolerance, for each of `steps`: factors of the step."""
    for method in methods:
        for factor in steps:
            if INTEGRATORS[method].chooses_steps:
                yield method, {"tolerance": tolerance * factor**4, "step": step}
            else:
                yield method, {"step": step * factor}


def add_ratio(out, kind, record, method, fineness, exact, beside=()):
    """Run verified, and keep the ratio, of each number."""
    try:
        result = Machine.from_record(record).simulate(integrator=method, **fineness, verify=True)
    except (ModelError, SolveError):
        return
    for quantity, known in ((kind.quantity, exact), *beside):
        true = known(result.time)
        error = np.max(np.abs(result.array(quantity) - true))
        if error > ROUND_OFF * np.ptp(true):
            estimate = np.nanmax(result.estimated_error(quantity))
            out[f"{kind.name} {quantity}, {method}, {next(iter(fineness.values())):.2g}"] = float(estimate / error)


def judge(found, least):
    places = {name: ratio for name, ratio in found.items() if name.split(",")[0].endswith(PLACES)}
    assert min(places.values()) > 1.0 / 3.0, min(places.items(), key=lambda each: each[1])
    # Speeds may be: that of the load on a rope, by Adams' method over the corner where the rope tightens, is at 0.29.
    within = [name for name, ratio in found.items() if 1.0 / 3.0 <= ratio <= 3.0]
    assert len(found) >= least
    small = [name for name, ratio in found.items() if ratio < 1.0 / 3.0]
    assert len(small) <= 0.05 * len(found), small
    assert min(found.values()) > 0.25, min(found.items(), key=lambda each: each[1])
    assert np.median(list(found.values())) <= 2.0
    assert len(within) >= 0.9 * len(found), sorted(found.items(), key=lambda each: each[1])


def test_estimates_are_within_a_factor_of_three():
    judge(ratios(METHODS, (2.0,)), 10)


def test_estimates_are_within_a_factor_of_three_beyond_mechanics():
    quick = [kind for kind in KNOWN if kind.name in CLOSED_FORMS]
    judge(known_ratios(("heun",), (1.0,), quick), 5)


@pytest.mark.full
def test_estimates_are_within_a_factor_of_three_beyond_mechanics_over_the_whole_grid():
    judge(known_ratios((*METHODS, *FULL), STEPS), 100)


@pytest.mark.full
def test_estimates_are_within_a_factor_of_three_over_the_whole_grid():
    judge(ratios((*METHODS, *FULL), STEPS), 100)
