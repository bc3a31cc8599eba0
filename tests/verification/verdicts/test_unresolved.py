"""A force that is too fast for the steps of a run: where the energy is not right for it, the trust report says whose work is not known."""

import numpy as np
import pytest

from nivel.errors import SolveError
from nivel.judge.after.checks.energy import unresolved_force
from nivel.results.result import Result
from simulating import G, simulate, slide, solid
from test_growth import stiff_pair

MASS, SPEED, STEP = 2.0, 1.0, 1e-3
ENERGY = 0.5 * MASS * SPEED**2


def block(*, damping=0.0, stiffness=0.0, **more):
    """A block on a rail, on a spring and a damper."""
    holder = {"type": "joint-spring-damper", "coordinate": "rail", "stiffness": stiffness, "damping": damping}
    return {
        "gravity": [0, -G, 0],
        "bodies": {"block": solid(MASS, velocity=[SPEED, 0, 0])},
        "joints": {"rail": slide("ground", "block")},
        "forces": {"holder": holder, **more},
    }


def energy(result):
    return next(item for item in result.trust.items if item.name == "energy")


@pytest.mark.parametrize("integrator", ["newmark", "hht", "generalised-alpha", "ros2"])
@pytest.mark.parametrize("rate", [2.0, 500.0])
def test_a_decay_within_a_step_is_named(integrator, rate):
    """c v₀² h = 2 r h of the energy is what a step of the power at the start would take: with r h = 500 a thousand times what there is."""
    r = simulate(
        block(damping=rate * MASS / STEP), integrator=integrator, coordinates="relative", duration=0.03, step=STEP
    )
    assert energy(r).verdict == "red"
    assert energy(r).row == r.trust.unresolved_force == "holder"
    assert (r.trust.unresolved_work, r.trust.unresolved_time) == (pytest.approx(2 * rate * ENERGY), 0.0)
    joules = 2 * rate * ENERGY
    work = f"{joules:g} J" if joules < 1000 else f"{joules / 1000:g} kJ"
    assert (
        f"holder does {work} in one step of 0.001 s at t = 0 s, {2 * rate:g} times all other energy" in energy(r).text
    )
    assert "an integrator that chooses its steps (radau)" in energy(r).text


@pytest.mark.parametrize(
    ("integrator", "holder"),
    [
        ("rk4", {"damping": 3.0 * MASS / STEP}),
        ("heun", {"damping": 2.2 * MASS / STEP}),
        ("ab4", {"damping": 0.5 * MASS / STEP}),
        ("rk4", {"stiffness": MASS * (2.9 / STEP) ** 2}),
    ],
    ids=["damper, rk4", "damper, heun", "damper, ab4", "spring, rk4"],
)
def test_what_grows_without_overflow_is_named(integrator, holder):
    """Beyond the limits of stability, 2.785 and 2 for decays, 2.828 for vibrations, but for few steps."""
    r = simulate(block(**holder), integrator=integrator, coordinates="relative", duration=0.03, step=STEP)
    assert r.attributes["outcome"] == "done"
    assert (energy(r).verdict, r.trust.unresolved_force) == ("red", "holder")


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize(("integrator", "rate"), [("rk4", 500.0), ("rk4", 20.0), ("heun", 20.0)])
def test_a_run_that_a_damper_breaks_off_says_so(integrator, rate, coordinates):
    sections = block(
        damping=rate * MASS / STEP,
        rub={"type": "friction", "coordinate": "rail", "coefficient": 0.3, "model": "stiction"},
    )
    with pytest.raises(SolveError) as caught:
        simulate(sections, integrator=integrator, coordinates=coordinates, duration=10.0, step=STEP)
    message = "A step of 0.001 s is too long for its fastest decay, and holder is the force that takes most power"
    assert message in caught.value.message
    assert "less for a stiffer damper" in caught.value.advice
    assert isinstance(caught.value.result, Result)
    assert caught.value.result.trust.unresolved_force == "holder"


@pytest.mark.parametrize(
    ("integrator", "holder"),
    [
        ("rk4", {"damping": 0.1 * MASS / STEP}),
        ("newmark", {"damping": 0.05 * MASS / STEP}),
        ("radau", {"damping": 500 * MASS / STEP}),
        ("rk4", {"stiffness": MASS * (0.1 / STEP) ** 2}),
    ],
    ids=["damper, rk4", "damper, newmark", "damper, radau", "spring, rk4"],
)
def test_forces_that_are_followed_are_not_named(integrator, holder):
    r = simulate(block(**holder), integrator=integrator, coordinates="relative", duration=0.05, step=STEP)
    assert (r.trust.unresolved_force, energy(r).row) == ("", "")
    assert "in one step" not in energy(r).text


def test_an_error_of_other_origin_is_not_blamed_on_a_fast_force():
    """A stiff damper holds a rod while the pair next to it vibrates too fast: the spring between those is named, with its own work."""
    sections = stiff_pair()
    sections["bodies"]["still"] = solid(position=[0, 3, 0])
    sections["joints"]["track"] = slide("ground", "still", point=[0, 3, 0])
    sections["forces"]["holder"] = {"type": "joint-spring-damper", "coordinate": "track", "damping": 1e6}
    sections["forces"]["stay"]["stiffness"] = 5e6
    r = simulate(sections, integrator="rk4", coordinates="relative", duration=0.01, step=STEP)
    assert r.trust.unresolved_force == "stay"
    assert np.isfinite(r.trust.unresolved_work)


def test_slow_machines_under_loads_are_not_named():
    """A carriage of 1 mm/s lifts 20 kg by a spring, whose work in a step, m g v h, is twenty times the kinetic energy, but a hundredth of
    the work of the driver: an error of 5 % of that, whatever it came from, is not the spring's."""
    sections = {
        "gravity": [0, -G, 0],
        "bodies": {"load": solid(20.0), "lift": solid(1.0, position=[0, 1, 0], velocity=[0, 1e-3, 0])},
        "joints": {
            "rail": slide("ground", "load", (0, 1, 0)),
            "track": slide("ground", "lift", (0, 1, 0), point=[0, 1, 0]),
        },
        "drivers": {"winch": {"coordinate": "track", "value": "1e-3*time"}},
        "forces": {
            "rope": {
                "type": "spring-damper",
                "bodies": ["load", "lift"],
                "points": [[0, 0, 0], [0, 1, 0]],
                "stiffness": 2e3,
            }
        },
    }
    sections["forces"]["rope"]["free_length"] = 1.0 - 20.0 * G / 2e3
    r = simulate(sections, integrator="rk4", coordinates="relative", duration=0.1, step=STEP, output_interval=STEP)
    work = STEP * np.abs(r.array("force.rope.power")).max()
    assert work > 10 * r.array("kinetic_energy").max()
    assert work == pytest.approx(r.trust.energy_scale / 100, rel=0.1)
    assert unresolved_force(r, 0.05 * r.trust.energy_scale) is None
