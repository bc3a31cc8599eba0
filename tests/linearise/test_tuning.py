"""Gains of a PID from the linear model: the machine with these gains has the margins that were asked, by its own linear model and by
Nyquist's criterion on the closed form of the loop."""

import numpy as np
import pytest

from nivel.analysis.linearise.sampled import tuned
from nivel.api import Machine
from nivel.errors import ModelError
from nivel.files import parse_machine

SERVO = """
format: 1
bodies:
  disc: {{mass: 5 kg, inertia: [0.1, 0.1, 0.2]}}
joints:
  shaft: {{type: revolute, bodies: [ground, disc], point: [0, 0, 0], axis: [0, 0, 1]}}
control:
  position: {{type: pid, input: -shaft.angle, kp: {0}, ki: {1}, kd: {2}, sample_time: 2 ms, latency: 2 ms}}
  other: {{type: gain, input: 0, gain: 1, sample_time: 2 ms}}
forces:
  drive: {{type: motor, coordinate: shaft, effort: position + other - {3}*shaft.angle_rate}}
simulation: {{duration: 1, step: 1 ms}}
"""


def linear(*gains, damping=0.3):
    machine = Machine.from_record(parse_machine(SERVO.format(*gains, damping)))
    return machine.record, machine.linearise(about="equilibrium").sampled


def open_loop(f, kp, ki, kd, T=2e-3, inertia=0.2, damping=0.3):
    """L of the closed form: the disc between samples exactly, one sample late, and the controller of the page."""
    z, r = np.exp(2j * np.pi * f * T), damping / inertia
    E = np.exp(-r * T)
    plant = ((r * T - 1 + E) * z + 1 - E - r * T * E) / (inertia * r * r * (z - 1) * (z - E))
    a = 0.1 * kd / kp / (0.1 * kd / kp + T)
    return plant / z * (kp + ki * T / (z - 1) + kd * (1 - a) / T * (z - 1) / (z - a))


WIDE = [(kp, 4 / 40 * ratio * kp) for kp in np.geomspace(1, 200, 40) for ratio in np.geomspace(1 / 8, 8, 25)]
GRID = np.geomspace(1e-2, 249.9, 3000)


def has_margins(kp, ki, kd, phase, gain):
    """Whether a loop has margins by its closed form; |L| falls through one once."""
    L = open_loop(GRID, kp, ki, kd)
    down = np.flatnonzero((np.abs(L[:-1]) > 1) != (np.abs(L[1:]) > 1))
    real = L.real[:-1][(L.imag[:-1] * L.imag[1:] < 0) & (L.real[:-1] < 0)]
    return (
        len(down) == 1
        and np.degrees(np.angle(-L[down[0]])) > phase
        and np.min(np.maximum(-real, -1 / real), initial=np.inf) > gain
    )


@pytest.mark.parametrize(("phase", "gain"), [(60.0, 2.0), (45.0, 6.0)])
def test_the_machine_with_the_tuned_gains_has_the_margins(phase, gain):
    found = tuned(*linear(40, 30, 4), "position", phase, gain)
    assert not any(has_margins(kp, 1.3 * found.ki, kd, phase, gain) for kp, kd in WIDE)
    _, model = linear(found.kp, found.ki, found.kd)
    loop = model.loops[0]
    assert model.stable
    assert loop.phase_margin == pytest.approx(found.phase_margin, abs=0.1)
    assert loop.phase_margin > phase - 0.6
    f = np.geomspace(1e-3, 249.9, 200_000)
    L = open_loop(f, found.kp, found.ki, found.kd)
    at = np.flatnonzero((np.abs(L[:-1]) > 1) & (np.abs(L[1:]) <= 1))[-1]
    assert np.degrees(np.angle(-L[at])) == pytest.approx(found.phase_margin, abs=0.1)
    real = L.real[:-1][(L.imag[:-1] * L.imag[1:] < 0) & (L.real[:-1] < 0)]
    assert np.min(np.maximum(-real, -1 / real)) >= gain * 0.999


def test_what_cannot_be_tuned_is_said():
    record, model = linear(40, 30, 4)
    with pytest.raises(ModelError, match="a sampled `pid` with `kp` and `ki` was expected"):
        tuned(record, model, "other")
    with pytest.raises(ModelError, match="no gains were found"):
        tuned(record, model, "position", 89.0, 2.0)
