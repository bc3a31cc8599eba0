"""Slopes of equilibria, positions, linear models and efforts against differences of whole analyses.

Over sixty triples of machine, parameter and output. Differences are of order six (Richardson over h, 2 h and 4 h). A slope is right within
NEAR of the scale of its output: its magnitude, or its largest change by any of the parameters for a change by itself.
"""

from math import pi

import numpy as np
import pytest

import nivel
from nivel.analysis.sweep.outputs import number_of
from nivel.machine.study.parameter import said_output

pytestmark = pytest.mark.compiles

NEAR, H = 1e-7, 2e-3

PENDULUM = """
format: 1
name: pendulum
parameters: {k: 8.0, length: 0.5}
gravity: [0, 0, -9.81]
bodies: {bar: {mass: 2, inertia: [0.02, 0.02, 0.02], position: [length, 0, 0]}}
joints: {pin: {type: revolute, bodies: [ground, bar], point: [0, 0, 0], axis: [0, 1, 0]}}
forces: {coil: {type: joint-spring-damper, coordinate: pin, stiffness: k, damping: 0.1}}
"""
FOUR_BAR = """
format: 1
name: four-bar
parameters: {crank: 1.0, base: 2.5, k: 300.0, speed: 2.0}
gravity: [0, -9.81, 0]
bodies:
  crank: {mass: 3, inertia: [0.1, 0.3, 0.3], position: [crank/2, 0, 0]}
  coupler: {mass: 5, inertia: [0.1, 2, 2], position: [crank, 1, 0], orientation: {axis: [0, 0, 1], angle: pi/2}}
  rocker: {mass: 4, inertia: [0.1, 1, 1], position: [(crank + base)/2, 2, 0]}
joints:
  pivot: {type: revolute, bodies: [ground, crank], point: [0, 0, 0], axis: [0, 0, 1]}
  pin: {type: spherical, bodies: [crank, coupler], point: [crank, 0, 0]}
  knee: {type: cylindrical, bodies: [coupler, rocker], point: [crank, 2, 0], axis: [0, 0, 1]}
  foot: {type: revolute, bodies: [rocker, ground], point: [base, 2, 0], axis: [0, 0, 1]}
forces: {coil: {type: joint-spring-damper, coordinate: pivot, stiffness: k, damping: 5}}
simulation: {duration: 0.3 s}
"""
DRIVEN = FOUR_BAR + "drivers: {turn: {coordinate: pivot, value: 0.3*sin(speed*time)}}\n"
BEAM = """
format: 1
name: cantilever
parameters: {bending: 200.0, density: 0.8, load: 5.0}
gravity: [0, 0, -9.81]
beams:
  mast:
    from: [0, 0, 0]
    to: [1, 0, 0]
    section: {type: general, stiffness: [1e5, 1e5, 1e5, 100, bending, bending], mass: density, inertia: [1e-3, 1e-3, 1e-3]}
    elements: 3
joints: {root: {type: fixed, bodies: [ground, mast.start], point: [0, 0, 0]}}
forces: {pull: {type: force, body: mast.end, vector: [0, 0, load]}}
"""
FILTERED = """
format: 1
name: filtered
parameters: {gain: 40.0, lag: 0.2}
gravity: [0, -9.81, 0]
bodies: {block: {mass: 3, inertia: [1, 1, 1]}}
joints: {rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [0, 1, 0]}}
states: {seen: {rate: (rail.displacement - seen)/lag}}
forces:
  hold: {type: motor, coordinate: rail, effort: -gain*seen}
  soft: {type: joint-spring-damper, coordinate: rail, stiffness: 100, damping: 30}
simulation: {duration: 1 s}
"""
TRIPLES = [
    (PENDULUM, "statics", {}, "pin.angle, pin.force.z, bar.position.x", "parameters.k, parameters.length, bodies.bar.mass"),
    (FOUR_BAR, "statics", {}, "pivot.angle, knee.force.y, max(foot.angle)", "parameters.k, parameters.crank, bodies.coupler.mass"),
    (BEAM, "statics", {}, "mast.end.position.z, root.torque.y", "parameters.bending, parameters.density, parameters.load"),
    (FILTERED, "statics", {}, "rail.displacement, force.hold.value", "parameters.gain, bodies.block.mass"),
    (DRIVEN, "kinematics", {}, "max(rocker.position.y), foot.angle at 0.2 s, rms(foot.angle.rate), peak(knee.force.y)",
     "parameters.crank, parameters.base, parameters.speed"),
    (DRIVEN, "inverse", {"actuators": "pivot"}, "peak(pivot.angle.effort), mean(pivot.angle.power)",
     "parameters.crank, bodies.coupler.mass, parameters.speed"),
    (FOUR_BAR, "linearise", {"about": "equilibrium"}, "mode.1.frequency, mode.1.damping_ratio, mode.1.real",
     "parameters.k, parameters.crank, bodies.rocker.mass"),
    (FILTERED, "linearise", {"about": "equilibrium"}, "mode.1.real, mode.1.frequency, mode.2.real",
     "parameters.gain, parameters.lag, forces.soft.damping"),
]  # fmt: skip


def machine_of(text, tmp_path):
    path = tmp_path / "machine.yaml"
    path.write_text(text, encoding="utf-8")
    return nivel.load(path)


@pytest.mark.parametrize(("text", "analysis", "settings", "outputs", "paths"), TRIPLES)
def test_slopes_are_those_of_whole_analyses(text, analysis, settings, outputs, paths, tmp_path):
    machine, outputs, paths = machine_of(text, tmp_path), outputs.split(", "), paths.split(", ")
    found = machine.gradient(outputs, paths, analysis=analysis, analysis_settings=settings)

    def values(path, value):
        result = getattr(machine.with_values({path: value}), analysis)(**settings)
        return np.array([number_of(result, said_output(each)).value for each in outputs])

    slopes = np.zeros((len(paths), len(outputs)))
    for k, path in enumerate(paths):
        x = float(machine[path])
        one, two, four = (
            (values(path, x * (1 + s * H)) - values(path, x * (1 - s * H))) / (2 * s * H) for s in (1, 2, 4)
        )
        slopes[k] = (16 * (4 * one - two) / 3 - (4 * two - four) / 3) / 15
    for j, output in enumerate(outputs):
        scale = max(abs(float(found[output])), np.abs(slopes[:, j]).max())
        for k, path in enumerate(paths):
            slope = found[f"d({output})/d({path})"]
            assert abs(float(slope) * float(machine[path]) - slopes[k, j]) <= NEAR * scale, (output, path)
            assert slope.attrs["verdict"] == "green", (output, path, slope.attrs)


def test_an_equilibrium_has_the_slopes_of_its_formula(tmp_path):
    """k φ = m g l cos φ: (k + m g l sin φ) dφ = m g cos φ dl - φ dk."""
    found = machine_of(PENDULUM, tmp_path).gradient(
        "pin.angle", ["parameters.k", "parameters.length"], check=False, analysis="statics"
    )
    angle, m, g, length, k = float(found["pin.angle"]), 2.0, 9.81, 0.5, 8.0
    resists = k + m * g * length * np.sin(angle)
    assert float(found["d(pin.angle)/d(parameters.k)"]) == pytest.approx(-angle / resists, rel=1e-12)
    wanted = m * g * np.cos(angle) / resists
    assert float(found["d(pin.angle)/d(parameters.length)"]) == pytest.approx(wanted, rel=1e-12)


TWINS = """
format: 1
name: twins
parameters: {k: 100.0, weak: 1e-3}
bodies: {a: {mass: 1, inertia: [1, 1, 1]}, b: {mass: 1, inertia: [1, 1, 1], position: [0, 1, 0]}}
joints:
  left: {type: translational, bodies: [ground, a], point: [0, 0, 0], axis: [1, 0, 0]}
  right: {type: translational, bodies: [ground, b], point: [0, 1, 0], axis: [1, 0, 0]}
forces:
  one: {type: joint-spring-damper, coordinate: left, stiffness: k}
  two: {type: joint-spring-damper, coordinate: right, stiffness: 100}
  between: {type: joint-spring-damper, coordinate: left, stiffness: weak}
"""


def test_close_frequencies_are_amber_and_critical_loads_too(tmp_path):
    """ω² = k of each twin alone; they are told, since they bend away from each other where anything couples them."""
    found = machine_of(TWINS, tmp_path).gradient(
        ["mode.1.frequency", "mode.2.frequency"], "parameters.k", analysis="linearise"
    )
    assert found.attrs["verdict"] in ("amber", "red")
    slope = float(found["d(mode.2.frequency)/d(parameters.k)"])
    assert slope == pytest.approx(1.0 / (4.0 * pi * np.sqrt(100.0)), rel=1e-5)


COLUMN = BEAM.replace("vector: [0, 0, load]", "vector: [-load*time, 0, 0]").replace("-9.81", "0")


def test_critical_loads_have_slopes_that_are_never_green(tmp_path):
    """P = π² B/4 L² of a column: with P = load t, t is in proportion to B."""
    machine = machine_of(COLUMN, tmp_path)
    settings = {"buckling": 1, "duration": 1.0}
    found = machine.gradient("buckling.1", "parameters.bending", analysis="statics", analysis_settings=settings)
    slope = found["d(buckling.1)/d(parameters.bending)"]
    assert slope.attrs["verdict"] == "amber"
    assert float(slope) * 200.0 == pytest.approx(float(found["buckling.1"]), rel=1e-2)


def test_searches_take_the_slopes_of_analyses(tmp_path):
    """The frequency of a pendulum of k: ω² (m l² + I) = k without gravity."""
    machine = machine_of(PENDULUM.replace("-9.81", "0"), tmp_path)
    inertia = 2 * 0.5**2 + 0.02
    found = machine.optimise(
        "mode.1.frequency",
        {"parameters.k": (1.0, 50.0)},
        limits={"objective": (1.0, 1.0)},
        analysis="linearise",
        analysis_settings={"about": "equilibrium"},
        exact_slopes=True,
    )
    assert found.values["parameters.k"] == pytest.approx((2 * pi) ** 2 * inertia, rel=1e-6)
    identified = machine.identify(
        {"mode.1.frequency": [1.0, 1.0]}, {"parameters.k": (1.0, 50.0)}, analysis="linearise", exact_slopes=True
    )
    assert identified.values["parameters.k"] == pytest.approx((2 * pi) ** 2 * inertia, rel=1e-6)
