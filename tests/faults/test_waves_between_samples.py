"""Waves in lines that are delays: what is lost between their samples is in the estimated error, and in the verdict."""

import math

import numpy as np
import pytest

import nivel

RHO, MODULUS, D, T = 870.0, 1.5e9, 0.02, 12.3e-3
C, AREA, NU = math.sqrt(MODULUS / RHO), math.pi * D**2 / 4, 46e-6
Z, L, FINE = RHO * C / AREA, C * T, 2e-5
MACHINE = f"""
format: 1
fluids: {{oil: {{air: 0, bulk_modulus_slope: 0, bulk_modulus: 1.5 GPa, density: {RHO}, viscosity: {NU}}}}}
hydraulics:
  a: {{type: tank, pressure: "60e5 + 8e5*PULSE"}}
  b: {{type: tank, pressure: 60e5}}
  line: {{type: line, model: delay, ports: {{A: a, B: b}}, mean_pressure: 101325, diameter: {D}, length: {L},
    unsteady_friction: false}}
simulation: {{duration: 100 ms, output_interval: 1 ms}}
"""


def exact(pulse):
    """Flow at A in frames of 1 ms: characteristics, of which fifty are followed in a sample of the machine."""
    critical = (0.3164 / 64) ** (-4 / 3) * NU * AREA / D
    delay, ends = round(T / FINE), ([], [])

    def loss(q):  # Hagen–Poiseuille, then Blasius
        return 128 * NU * L * RHO / (math.pi * D**4) * q * (1 + (q / critical) ** 6) ** 0.125

    flows = []
    for k in range(round(0.1 / FINE) + 1):
        p = 60e5 + 8e5 * pulse(k * FINE), 60e5
        came = [ends[1 - j][k - delay] if k >= delay else 60e5 for j in (0, 1)]
        q = [(p[j] - came[j]) / Z for j in (0, 1)]
        for j in (0, 1):
            ends[j].append(p[j] + Z * q[j] - loss(q[j]))
        flows.append(q[0])
    return np.array(flows[:: round(1e-3 / FINE)])


@pytest.mark.parametrize(
    ("written", "pulse", "lost"),
    [
        ("sin(2*pi*400*time)", lambda t: math.sin(800 * math.pi * t), True),
        # whole periods between two samples look like rest
        ("sin(2*pi*1000*time)", lambda t: math.sin(2000 * math.pi * t), True),
        ("sin(2*pi*20*time)^3", lambda t: math.sin(40 * math.pi * t) ** 3, False),
    ],
)
@pytest.mark.parametrize("method", [{}, {"integrator": "radau", "tolerance": 1e-8}])
def test_what_is_lost_between_samples_of_waves_is_in_the_estimate(written, pulse, lost, method, tmp_path):
    path = tmp_path / "line.yaml"
    path.write_text(MACHINE.replace("PULSE", written), encoding="utf-8")
    result = nivel.load(path).simulate(verify=True, **method)
    name = "hydraulics.line.flow_A"
    wanted = exact(pulse)
    off = np.max(np.abs(result.array(name) - wanted))
    stated = result.estimated_error(name).max()
    assert stated > off / 3
    quantities = [item.verdict for item in result.trust.items if item.name == "quantities"]
    assert (off > 0.01 * np.ptp(wanted)) == bool(lost)
    assert set(quantities) == {"red"} if lost else set(quantities) <= {"green"}
