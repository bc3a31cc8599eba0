"""Loads that jump at an instant: up to it the load before it acts, then the one beyond it, whichever comparison is written."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from nivel.kernels.record import program as kernel
from nivel.machine.laws.varying_value import Expression
from nivel.system.laws.program import expression_program
from simulating import simulate

pytestmark = pytest.mark.covering

MASS, LOW, HIGH, END, STEP = 2.0, -20.0, 100.0, 0.5, 1e-3
COMPARISONS = (">", ">=", "<", "<=")


def pushed(force, **settings):
    """A free mass that is pushed along x."""
    return simulate(
        {
            "gravity": [0, 0, 0],
            "bodies": {"block": {"mass": MASS, "inertia": [1, 1, 1]}},
            "forces": {"push": {"type": "force", "body": "block", "position": [0, 0, 0], "vector": [force, 0, 0]}},
            "simulation": {"duration": END, "output_interval": 0.1, **settings},
        }
    ).dataset


def switched(symbol, at):
    """A load that is switched at an instant, and what it is on either side."""
    before, beyond = (LOW, HIGH) if ">" in symbol else (HIGH, LOW)
    return f"if(time {symbol} {at!r}, {HIGH}, {LOW})", before, beyond


# at the begin, at the end of a step and of an interval of output, within a step
@pytest.mark.parametrize("at", [0.0, 0.3, 0.30003])
@pytest.mark.parametrize(
    ("integrator", "settings", "within"),
    [
        # 2e-8: from the part of a step to 1e-12 s, with which a method begins anew behind a jump at the begin
        *((name, {"step": STEP}, 5e-8) for name in ("newmark", "hht", "generalised-alpha")),
        ("radau", {"tolerance": 1e-6}, 1e-10),
        ("bdf", {"tolerance": 1e-8}, 1e-8),
        # no step of rk4 ends at a corner: weights 1/6, 2/3, 1/6 of its stages give up to h/3 to the wrong side
        ("rk4", {"step": STEP}, STEP / 3.0 * (HIGH - LOW) / MASS * 1.001),
    ],
)
def test_velocity_beyond_a_jump_is_that_of_both_impulses(integrator, settings, within, at):
    check_velocity(at, within, integrator=integrator, **settings)


@pytest.mark.parametrize(("at", "within"), [(0.0, 5e-8), (0.3, 1e-10), (0.30003, 1e-10)])
def test_velocity_beyond_a_jump_with_chosen_steps(at, within):
    check_velocity(at, within, integrator="generalised-alpha", step_control="error", tolerance=1e-6)


def check_velocity(at, within, **settings):
    """m v = F₋ t₀ + F₊ (t - t₀)."""
    for symbol in COMPARISONS:
        force, before, beyond = switched(symbol, at)
        found = pushed(force, **settings)
        t = found["time"].values
        expected = (before * np.minimum(t, at) + beyond * np.maximum(t - at, 0.0)) / MASS
        assert_allclose(found["velocity"].values[:, 0, 0], expected, rtol=0.0, atol=within, err_msg=symbol)


@pytest.mark.parametrize("integrator", ["newmark", "hht", "generalised-alpha"])
@pytest.mark.parametrize("condition", ["sin(20*pi*time + 0.3) > 0.2", "not(sin(20*pi*time + 0.3) <= 0.2)"])
def test_impulse_of_many_jumps_is_that_of_their_share_of_time(integrator, condition):
    """Five whole periods, in each of which the load acts for the share (π - 2 asin 0.2)/(2 π)."""
    found = pushed(f"if({condition}, {HIGH}, 0)", integrator=integrator, step=STEP)
    share = 0.5 - np.arcsin(0.2) / np.pi
    assert found["velocity"].values[-1, 0, 0] == pytest.approx(HIGH * share * END / MASS, abs=1e-9)


@pytest.mark.parametrize("integrator", ["newmark", "hht", "generalised-alpha"])
def test_a_jump_at_the_end_which_round_off_puts_behind_it_has_not_acted(integrator):
    """3 · 0.3 is less than 0.9."""
    found = pushed(f"if(3*time > 0.9, {HIGH}, 0)", integrator=integrator, step=STEP, duration=0.3)
    assert found["velocity"].values[-1, 0, 0] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("integrator", ["newmark", "hht", "generalised-alpha"])
def test_a_load_behind_the_begin_is_not_in_the_equilibrium(integrator):
    """k x = F (1 - cos ω t): the start is the equilibrium without the load. Order 2: (ω h)² ω t/12 of F/k, or twice that."""
    stiffness, omega = 200.0, 10.0
    found = simulate(
        {
            "gravity": [0, 0, 0],
            "bodies": {"block": {"mass": MASS, "inertia": [1, 1, 1]}},
            "joints": {
                "rail": {"type": "translational", "bodies": ["ground", "block"], "point": [0, 0, 0], "axis": [1, 0, 0]}
            },
            "forces": {
                "spring": {"type": "joint-spring-damper", "coordinate": "rail.displacement", "stiffness": stiffness},
                "push": {"type": "motor", "coordinate": "rail", "effort": f"if(time > 0, {HIGH}, 0)"},
            },
            "simulation": {
                "duration": END, "output_interval": 0.1, "step": STEP, "integrator": integrator, "start": "equilibrium"
            },
        }
    ).dataset  # fmt: skip
    t, x = found["time"].values, found["position"].values[:, 0, 0]
    within = (omega * STEP) ** 2 * omega * END / 6.0 * HIGH / stiffness
    assert_allclose(x, HIGH / stiffness * (1.0 - np.cos(omega * t)), rtol=0.0, atol=within)


@pytest.mark.parametrize("symbol", COMPARISONS)
def test_a_program_of_what_acts_has_the_value_beyond_the_instant(symbol):
    """Also where the round-off of a step leaves its time an instant before; a sample asks for what is written."""
    law, before, beyond = switched(symbol, 0.3)

    def value(time, **options):
        return kernel.run.code(np.array([*expression_program(Expression(law), ["time"], **options), time]))

    for time in (np.nextafter(0.3, 0.0), 0.3, 0.3 * (1.0 + 1e-12)):
        assert value(time, beyond=True) == beyond
    assert value(0.3 * (1.0 - 1e-12), beyond=True) == before
    assert value(0.3) == (beyond if symbol in (">=", "<") else before)


def test_a_sample_compares_as_it_is_written():
    """`time > 0.3` does not hold in the sample at 0.3 s, but in the next one."""
    values = {}
    for symbol in (">", ">="):
        found = simulate(
            {
                "bodies": {"block": {"mass": MASS, "inertia": [1, 1, 1]}},
                "states": {"on": {"update": f"if(time {symbol} 0.3, 1, 0)", "every": 0.1, "start": 0}},
                "simulation": {"duration": END, "output_interval": 0.1, "step": 0.05, "integrator": "rk4"},
            }
        )
        values[symbol] = found.array("state.on")
    # the frame at a sample is before or beyond it, for both alike
    assert np.flatnonzero(values[">"])[0] - np.flatnonzero(values[">="])[0] == 1
