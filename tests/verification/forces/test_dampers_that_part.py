"""Flanks, ropes and chains with dampers cease to act before they part: what they then pulled or pushed would be wrong.

J ẍ = -(k x + d ẋ) from x₀ at rest, until the bracket is zero at ln(s₂/s₁)/(s₁ - s₂) with the roots s of J s² + d s + k, complex or real;
from then on the speed is constant. Between that and x = 0 are about d/k seconds, longer or shorter than a step.
"""

import numpy as np
import pytest

from nivel.api import Machine
from nivel.files import parse_machine

K, X = 100.0, 0.01
DISC = "{mass: 1, inertia: [1, 1, 1]"
JOINT = "type: revolute, point: [0, 0, 0], axis: [1, 0, 0]"
TURNING = f"""
format: 1
name: parting
bodies:
  fixed: {DISC}}}
  disc: {DISC}}}
joints:
  held: {{{JOINT}, bodies: [ground, fixed]}}
  c: {{{JOINT}, bodies: [ground, disc], start: {{angle: 0.02}}}}
drivers: {{rest: {{coordinate: held, value: 0}}}}
forces:
  part: {{coordinate: c, against: held, damping: DAMPING, stiffness: {K}, FORCE}}
"""
ROPE = f"""
format: 1
name: parting
bodies:
  load: {DISC}, position: [1.01, 0, 0]}}
joints:
  c: {{type: translational, bodies: [ground, load], point: [1.01, 0, 0], axis: [1, 0, 0]}}
forces:
  part: {{type: rope, bodies: [ground, load], points: [[0, 0, 0], [1.01, 0, 0]], length: 1, stiffness: {K}, damping: DAMPING}}
"""
MACHINES = {
    "shaft": (TURNING.replace("FORCE", "type: shaft, backlash: 0.02"), "c.angle", 0.02),
    "chain": (TURNING.replace("FORCE", "type: belt-drive, radii: [1, 1], slack: 0.01"), "c.angle", 0.02),
    "rope": (ROPE, "c.displacement", 0.0),
}


def moved(t, damping):
    """x - x₀."""
    one, other = np.roots([1.0, damping, K]).astype(complex)
    until = np.minimum(t, (np.log(other / one) / (one - other)).real)
    first, second = np.exp(one * until), np.exp(other * until)
    rate = X * one * other * (first - second) / (other - one)
    return (X * (other * first - one * second) / (other - one) - X + rate * (t - until)).real


@pytest.mark.parametrize("damping", [30.0, 1.0, 0.1])
@pytest.mark.parametrize("integrator", ["radau", "dopri5"])
@pytest.mark.parametrize("name", MACHINES)
def test_what_has_ceased_to_act_changes_no_speed(name, integrator, damping):
    text, coordinate, start = MACHINES[name]
    settings = {"integrator": integrator, "tolerance": 1e-8, "duration": 0.3, "verify": False}
    result = Machine.from_record(parse_machine(text.replace("DAMPING", str(damping)))).simulate(**settings)
    assert np.max(np.abs(result.array(coordinate) - start - moved(result.time, damping))) < 1e-5 * X
