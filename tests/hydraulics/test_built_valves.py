"""Valves built from bodies, springs, chambers and edges that follow a joint: the same equations by SciPy, and their linear analysis."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.optimize import fsolve

from circuits import BAR, LITRE_PER_MINUTE, PA, history
from laws_anew import Circuit, Oil
from nivel.api import Machine
from nivel.errors import ModelError
from nivel.files import parse_machine

OIL = Oil()
AREA, MASS, STIFFNESS, PRELOAD = 0.25 * math.pi * 0.010**2, 0.06, 30e3, 705.0
VOLUME, CHAMBER, FLOW, STROKE, SEAT = 0.5e-3, 1e-6, 40 * LITRE_PER_MINUTE, 4e-3, 60e-6
# the least length of the face is reached 1 mm behind the seat
BEHIND = 1e-3
JET = math.radians(69)
ROOT = math.sqrt(2.0 / ((1 - OIL.air) * OIL.liquid + OIL.air * 1.2))
CORNER = 0.5 * BAR


def text(*, damping=60.0, keys="coordinate: bore, stroke: 4 mm", duration="50 ms"):
    return f"""
format: 1
gravity: [0, 0, 0]
bodies:
  poppet: {{mass: 60 g, inertia: [1e-5, 1e-5, 1e-5]}}
joints:
  bore: {{type: translational, bodies: [ground, poppet], point: [0, 0, 0], axis: [1, 0, 0]}}
forces:
  spring: {{type: joint-spring-damper, coordinate: bore, stiffness: 30 N/mm, preload: 705 N, damping: {damping}}}
hydraulics:
  tank: {{type: tank}}
  line: {{type: volume, volume: 0.5 L, start: 100 bar}}
  pump: {{type: flow-source, ports: {{A: tank, B: line}}, flow: 40 L/min}}
  seat: {{type: spool-valve, ports: {{P: line, T: tank}}, {keys},
    edges: {{PT: {{area: {{of: position, points: [0, 1], values: [0, 60 mm^2]}}}}}}}}
  face: {{type: cylinder, bodies: [ground, poppet], points: [[-50 mm, 0, 0], [0, 0, 0]], piston: 10 mm, rod: 0, stroke: 6 mm,
    retracted_length: 49 mm, acting: single, dead_volume_A: 1 cm^3, start_A: 100 bar}}
  damp: {{type: orifice, ports: {{A: line, B: face.A}}, diameter: 1.5 mm}}
simulation: {{duration: {duration}, output_interval: 0.1 ms, integrator: radau, tolerance: 1e-9}}
"""


def relief(**keys):
    return Machine.from_record(parse_machine(text(**keys)))


def rates(y, damping):
    """Of both pressures [bar], the place and the speed of the poppet."""
    line, chamber, x, v = y[0] * BAR, y[1] * BAR, y[2], y[3]
    c = Circuit(OIL, tank=PA, line=line, chamber=chamber)
    size = 0.65 * ROOT * SEAT * min(max(x / STROKE, 0.0), 1.0)
    c.restrict("line", "tank", size)
    c.restrict("line", "chamber", 0.65 * ROOT * 0.25 * math.pi * 0.0015**2)
    c.into["line"] += c.rho["tank"] * FLOW
    over = c.over("line", "tank")
    dropped = over * (over * over + CORNER**2) ** -0.25
    force = (
        (c.p["chamber"] - PA) * AREA
        - PRELOAD
        - STIFFNESS * x
        - damping * v
        - 2 / ROOT * math.cos(JET) * size * dropped**2
    )
    volume = CHAMBER + AREA * (x + BEHIND)
    return np.array([
        c.into["line"] / (VOLUME * c.slope["line"]) / BAR,
        (c.into["chamber"] - c.rho["chamber"] * AREA * v) / (volume * c.slope["chamber"]) / BAR,
        v, force / MASS,
    ])  # fmt: skip


def at_rest(damping):
    return fsolve(lambda y: rates([y[0], y[0], y[1] * 1e-3, 0], damping)[[0, 3]] / [1e4, 1e3], [95.0, 1.0], xtol=1e-13)


def test_a_relief_valve_of_parts_follows_its_equations():
    """Within 2e-6 of the range, and what the flows do to the poppet is not lost twice."""
    result = relief().simulate()
    t = np.asarray(result.time)
    other = solve_ivp(lambda _, y: rates(y, 60.0), (0, t[-1]), [100, 100, 0, 0], "Radau", t, rtol=1e-10, atol=1e-12).y
    for k, name in enumerate(("hydraulics.line.pressure", "hydraulics.face.pressure_A", "bore.displacement")):
        factor = BAR if k < 2 else 1.0
        assert np.max(np.abs(history(result, name) - factor * other[k])) < 2e-6 * factor * np.ptp(other[k]), name
    items = {item.name: item for item in result.trust.items}
    assert items["energy"].verdict == items["hydraulics"].verdict == "green"


def eigenvalue(damping):
    """That with the greatest real part, by differences of the equations about their equilibrium."""
    pressure, x = at_rest(damping)
    y = np.array([pressure, pressure, 1e-3 * x, 0.0])
    steps = np.diag([1e-3, 1e-3, 1e-9, 1e-5])
    columns = [(rates(y + h, damping) - rates(y - h, damping)) / (2 * h.max()) for h in steps]
    values = np.linalg.eigvals(np.array(columns).T)
    value = values[np.argmax(values.real)]
    return complex(value.real, abs(value.imag))


@pytest.mark.parametrize(("damping", "grows"), [(300.0, False), (60.0, True), (8.0, True)])
def test_its_linear_model_is_that_of_its_equations(damping, grows):
    wanted = eigenvalue(damping)
    values = np.asarray(relief(damping=damping).linearise(about="equilibrium").eigenvalues)
    assert np.min(np.abs(values - wanted)) < 1e-6 * abs(wanted)
    assert (wanted.real > 0) == grows


def test_a_valve_with_too_little_damping_begins_to_sing_as_its_linear_model_says():
    """A millionth more flow than that of the equilibrium: period and growth between zeros and peaks of the speed."""
    words = text(duration="40 ms").replace("flow: 40 L/min", 'flow: "40 L/min*(1 + 1e-6*step(time, 0, 0, 1 ms, 1))"')
    machine = Machine.from_record(parse_machine(words.replace("0.1 ms,", "0.02 ms, start: equilibrium,")))
    result = machine.simulate(verify=False, tolerance=1e-12)
    t, v = np.asarray(result.time), history(result, "bore.displacement.rate")
    spline = CubicSpline(t, v)
    zeros = [at for at in spline.roots(extrapolate=False) if at > 0.015]
    wanted = eigenvalue(60.0)
    assert math.pi / np.mean(np.diff(zeros)) == pytest.approx(wanted.imag, rel=1e-3)
    slopes = np.abs(spline(zeros, 1))
    assert math.log(slopes[-1] / slopes[0]) / (zeros[-1] - zeros[0]) == pytest.approx(wanted.real, rel=5e-3)


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ("coordinate: bore", "`stroke` is missing"),
        ("coordinate: bore, stroke: 4 mm, command: 1", "got `command` and `coordinate`"),
        ("coordinate: bore, stroke: 4 mm, frequency: 30 Hz", "belongs to a spool that is not a body"),
        ("coordinate: bolt, stroke: 4 mm", "bolt"),
    ],
)
def test_what_a_spool_that_is_a_body_needs_is_told(keys, told):
    with pytest.raises(ModelError, match=told):
        relief(keys=keys)
