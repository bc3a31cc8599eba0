"""No light is green over a wrong answer of circuits and controls; made harmless, they stay green."""

import numpy as np
import pytest

from deceiving_circuits import KINDS, parsed
from nivel import ModelError, SolveError
from nivel.analysis.curves.corners import corners
from nivel.api import Machine
from test_deceiving import GRID, ROUND_OFF

# of each kind the method that it deceives, or would
DEFAULT = {
    "spike-of-an-input": "rk4",
    "spike-of-a-block": "dopri5",
    "valve-pulse-of-3-ms": "rk4",
    "chattering-relief": "radau",
    "stiff-volume": "rk4",
    "end-stop-between-frames": "generalised-alpha",
}
PAIRS = [
    pytest.param(
        kind,
        *method,
        id=f"{kind.name}-{'-'.join(method)}",
        marks=() if method == (DEFAULT[kind.name], "relative") else pytest.mark.full,
    )
    for kind in KINDS
    for method in GRID
]


def run(kind, integrator, coordinates, *, harmless):
    """A verified run; None where it was refused or failed, and said so."""
    machine = Machine.from_record(kind.machine(harmless))
    try:
        return machine.simulate(integrator=integrator, coordinates=coordinates, verify=True)
    except (ModelError, SolveError):
        return None


@pytest.mark.parametrize(("kind", "integrator", "coordinates"), PAIRS)
def test_no_green_light_stands_over_a_wrong_answer(kind, integrator, coordinates):
    result = run(kind, integrator, coordinates, harmless=False)
    if result is not None and result.trust.verdict == "green":
        assert kind.error(result) <= 10.0 * result.trust.accuracy_estimate + ROUND_OFF * result.trust.size, result


@pytest.mark.parametrize(("kind", "integrator", "coordinates"), PAIRS)
def test_harmless_machines_stay_green(kind, integrator, coordinates):
    result = run(kind, integrator, coordinates, harmless=True)
    if result is not None:
        error = kind.error(result, harmless=True)
        assert error <= 10.0 * result.trust.accuracy_estimate + ROUND_OFF * result.trust.size, result
        if error < 1e-5 * result.trust.size:
            assert result.trust.verdict == "green", result


EVERYWHERE = """
format: 1
name: corners
bodies:
  cart: {mass: 1, inertia: [1, 1, 1]}
joints:
  rail: {type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]}
inputs: {lever: {signal: {times: [0, 0.11, 2], values: [0, 1, 1]}}}
control:
  wish: {type: signal, value: "if(time < 0.22, 0, 1)"}
  seen: {type: signal, value: "if(time < 0.77, 0, 1)", sample_time: 10 ms}
  way: {type: trapezoid, last: 0.5, begin: 0.33, speed: 5, acceleration: 5}
fluids:
  oil: {density: 870 kg/m^3}
hydraulics:
  supply: {type: tank, pressure: {times: [0, 0.44, 2], values: [100 bar, 200 bar, 200 bar]}}
  line: {type: volume, volume: 1 L}
  inlet: {type: orifice, ports: {A: supply, B: line}, flow: 10 L/min, pressure_drop: 10 bar, opening: "step(time, 0.55, 0, 0.66, 1)"}
forces:
  push: {type: force, body: cart, vector: [lever.value + wish.value + way.value + seen.value, 0, 0]}
simulation: {duration: 1}
"""


def test_steps_end_at_corners_of_inputs_blocks_and_circuits():
    """Of the trapezoid: a way of 0.5 at 5/s² takes 2 √(0.5/5), and turns half way. What is sampled has no corners between samples."""
    turns = 0.33 + np.sqrt(0.5 / 5.0) * np.arange(3)
    found = np.array(corners(parsed(EVERYWHERE)))
    np.testing.assert_allclose(found, sorted([0.11, 0.22, 0.44, 0.55, 0.66, *turns]), rtol=1e-12)


@pytest.mark.parametrize(("width", "told"), [(1e-3, True), (0.05, False)])
def test_what_samples_do_not_see_is_told(width, told):
    """A peak of a block that is sampled every 10 ms."""
    machine = parsed(
        EVERYWHERE.split("inputs:", maxsplit=1)[0]
        + f"""
control: {{seen: {{type: signal, value: "exp(-((time - 0.505)/{width})**2)", sample_time: 10 ms}}}}
forces: {{push: {{type: force, body: cart, vector: [seen.value, 0, 0]}}}}
simulation: {{duration: 1, step: 1 ms}}
"""
    )
    items = [item for item in Machine.from_record(machine).simulate().trust.items if item.name == "sampling"]
    assert bool(items) is told
    if items:
        assert (items[0].verdict, items[0].row) == ("amber", "seen.value")
        assert items[0].time == pytest.approx(0.5)
