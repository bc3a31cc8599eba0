"""Slopes of two hundred triples of machine, parameter and method against differences of runs.

A slope is right within NEAR of the scale of its output: the largest size of the curve, or the largest change that any of the parameters
makes for a change by itself. Differences are of order six (Richardson over h, 2 h and 4 h); they know a slope only so far as both of order
four agree, which is allowed for up to TOLD. What is further off has to be told by the verdict.
"""

from __future__ import annotations

import shutil
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.analysis.gradients.outputs import outputs_of, parameters_of, value_of
from nivel.flexible.body.body_file import write_body
from nivel.flexible.reduce import reduce

pytestmark = pytest.mark.compiles  # runs on dual numbers, which `nivel warmup` leaves out

EXAMPLES = Path(__file__).parents[2] / "examples"
NEAR, TOLD = 1e-7, 1e-6

PENDULUM = """
format: 1
name: pendulum
parameters: {length: 0.5, stiffness: 8.0, damping: 0.2}
gravity: [0, 0, -9.81]
bodies:
  bar:
    mass: 2
    inertia: [0.02, 0.02, 0.02]
    position: [length*cos(0.5), 0, -length*sin(0.5)]
    orientation: {axis: [0, 1, 0], angle: 0.5}
joints: {pin: {type: revolute, bodies: [ground, bar], point: [0, 0, 0], axis: [0, 1, 0]}}
forces: {coil: {type: joint-spring-damper, coordinate: pin, stiffness: stiffness, damping: damping}}
simulation: {duration: 0.5 s, step: 2 ms, output_interval: 10 ms}
"""

FOUR_BAR = """
format: 1
name: four-bar
parameters: {crank: 1.0, base: 2.5}
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
simulation: {duration: 0.3 s, step: 2 ms, output_interval: 10 ms}
"""

BEAM = """
format: 1
name: cantilever
parameters: {bending: 200.0, density: 0.8, load: 5.0}
beams:
  mast:
    from: [0, 0, 0]
    to: [1, 0, 0]
    section: {type: general, stiffness: [1e5, 1e5, 1e5, 100, bending, bending], mass: density, inertia: [1e-3, 1e-3, 1e-3]}
    elements: 3
joints: {root: {type: fixed, bodies: [ground, mast.start], point: [0, 0, 0]}}
forces: {pull: {type: force, body: mast.end, vector: [0, 0, load]}}
simulation: {duration: 50 ms, step: 0.5 ms, output_interval: 5 ms}
"""

CROSSING = """
format: 1
name: crossing
parameters: {bending: 300.0, density: 2.0, speed: 3.0, load: 1.5}
gravity: [0, 0, -9.81]
beams:
  rail:
    from: [0, 0, 0]
    to: [1, 0, 0]
    section: {type: general, stiffness: [1e5, 5e4, 5e4, 200, bending, bending], mass: density, inertia: [2e-3, 1e-3, 1e-3]}
    elements: 4
bodies: {bead: {mass: load, inertia: [1e-3, 1e-3, 1e-3], position: [0.2, 0, 0], velocity: [speed, 0, 0]}}
joints:
  root: {type: fixed, bodies: [ground, rail.start], point: [0, 0, 0]}
  slide: {type: cylindrical-on-beam, bodies: [bead, rail], point: [0.2, 0, 0]}
simulation: {duration: 40 ms, step: 1 ms, output_interval: 5 ms}
"""

WOUND = """
format: 1
name: wound
parameters: {inertia: 0.05, k: 8e-3}
gravity: [0, 0, -9.81]
bodies: {wheel: {mass: 1, inertia: [inertia, inertia, 0.02], centre_of_mass: [0.02, 0, 0], angular_velocity: [0, 30, 0]}}
joints: {pin: {type: revolute, bodies: [ground, wheel], point: [0, 0, 0], axis: [0, 1, 0]}}
forces: {coil: {type: joint-spring-damper, coordinate: pin, law: "k*value^3 + 0.01*rate"}}
simulation: {duration: 0.5 s, step: 1 ms, output_interval: 10 ms}
"""

STICKING = """
format: 1
name: sticking
parameters: {mu: 0.3, speed: 1.0}
gravity: [0, 0, -9.81]
bodies: {block: {mass: 2, inertia: [1, 1, 1], velocity: [speed, 0, 0]}}
joints: {rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0]}}
forces:
  rub: {type: friction, coordinate: rail.displacement, model: stiction, coefficient: mu}
  spring: {type: joint-spring-damper, coordinate: rail, stiffness: 40, damping: 0.1}
simulation: {duration: 0.5 s, step: 1 ms, output_interval: 10 ms}
"""

SLIDING = """
format: 1
name: sliding
parameters: {mu: 0.3, speed: 3.0}
gravity: [0, 0, -9.81]
bodies: {block: {mass: 2, inertia: [1, 1, 1], velocity: [speed, 0, 0]}}
joints: {rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0]}}
forces:
  rub: {type: friction, coordinate: rail.displacement, model: coulomb, coefficient: mu, transition_speed: 1e-3}
  spring: {type: joint-spring-damper, coordinate: rail, stiffness: 4, damping: 0.1}
simulation: {duration: 0.3 s, step: 2 ms, output_interval: 10 ms}
"""

PRESSED = """
format: 1
name: pressed
parameters: {radius: 0.1, speed: -0.05}
gravity: [0, 0, -9.81]
bodies: {ball: {shape: {type: sphere, radius: radius}, mass: 2, position: [0, 0, radius - 3.4e-3], velocity: [0, 0, speed]}}
forces: {floor: {type: contact, body: ball, plane: {body: ground}, stiffness: 1e5, restitution: 0.9}}
simulation: {duration: 0.1 s, step: 0.2 ms, output_interval: 5 ms}
"""

FALLING = """
format: 1
name: falling
parameters: {height: 2.0, g: 9.81, speed: 0.5, drag: 0.3}
gravity: [0, 0, -g]
bodies: {ball: {mass: 2, inertia: [1, 1, 1], position: [0, 0, height], velocity: [speed, 0, 0]}}
forces: {air: {type: force, body: ball, vector: [-drag*ball.vx, 0, -drag*ball.vz]}}
events: {landing: {when: ball.z, direction: falling, stop: true}}
simulation: {duration: 1 s, step: 10 ms}
"""

H = "differences"  # the step of differences, where a method asks for another one
EXACT = {"tolerance": 1e-10}
RELATIVE, ABSOLUTE = {"coordinates": "relative"}, {"coordinates": "absolute"}
# what the iterations of implicit methods with fixed steps leave, is noise to differences
CLOSE = {"corrector": {"tolerance": 1e-12}}
NEWTON = {"corrector": {"iteration": "newton", "tolerance": 1e-13}}
# a matrix that is kept, and made anew at other steps where parameters move, lets the run itself jump by some 1e-9
FULL = {"corrector": {"tolerance": 1e-12, "matrix": "full"}}


@dataclass(frozen=True)
class Case:
    """A machine, its outputs and parameters, and methods by a name. settings : of all runs. step : of differences, a share."""

    machine: str
    outputs: tuple[str, ...]
    parameters: tuple[str, ...]
    methods: dict[str, dict]
    settings: dict = field(default_factory=dict)
    step: float = 1e-3


CASES = {
    "pendulum": Case(
        PENDULUM,
        ("pin.angle", "pin.angle.rate", "dissipated_energy", "integral(kinetic_energy)"),
        ("bodies.bar.mass", "parameters.stiffness", "parameters.length", "parameters.damping", "gravity.2"),
        {
            "rk4": RELATIVE | {"integrator": "rk4"},
            "heun": RELATIVE | {"integrator": "heun"},
            "dopri5": RELATIVE | EXACT | {"integrator": "dopri5"},
            "dop853": RELATIVE | EXACT | {"integrator": "dop853"},
            "ab3": RELATIVE | {"integrator": "ab3"},
            "abm4": RELATIVE | {"integrator": "abm4"},
            "am3": RELATIVE | CLOSE | {"integrator": "am3"},
            "gear2": RELATIVE | NEWTON | {"integrator": "gear2"},
            "adams": RELATIVE | EXACT | {"integrator": "adams"},
            "gear": RELATIVE | EXACT | {"integrator": "gear"},
            "bdf": RELATIVE | EXACT | {"integrator": "bdf"},
            "radau": RELATIVE | EXACT | {"integrator": "radau"},
            "radau, absolute": ABSOLUTE | EXACT | {"integrator": "radau"},
            "ros2": RELATIVE | {"integrator": "ros2"},
            "ros2, absolute": ABSOLUTE | {"integrator": "ros2"},
            "newmark, absolute": ABSOLUTE | FULL | {"integrator": "newmark"},
            "hht, absolute": ABSOLUTE | FULL | {"integrator": "hht"},
            "alpha, relative": RELATIVE | CLOSE | {"integrator": "generalised-alpha"},
            "alpha, independent": FULL | {"coordinates": "independent", "integrator": "generalised-alpha"},
            "alpha, chosen": RELATIVE
            | {"integrator": "generalised-alpha", "step_control": "error", "tolerance": 1e-8, H: 1e-4},
        },
    ),
    "four-bar": Case(
        FOUR_BAR,
        ("rocker.position", "rms(crank.velocity)"),
        ("parameters.base", "parameters.crank", "bodies.coupler.mass", "bodies.rocker.inertia.zz", "gravity.1"),
        {
            "rk4": RELATIVE | {"integrator": "rk4"},
            "rk4, absolute": ABSOLUTE | {"integrator": "rk4", "stabilisation": "direct"},
            "rk4, geometric": RELATIVE | {"integrator": "rk4", "stabilisation": "geometric"},
            "alpha, relative": RELATIVE | CLOSE | {"integrator": "generalised-alpha"},
            "alpha, absolute": ABSOLUTE | CLOSE | {"integrator": "generalised-alpha"},
            "bdf": RELATIVE | EXACT | {"integrator": "bdf"},
            "radau": RELATIVE | EXACT | {"integrator": "radau"},
            "ros2": RELATIVE | {"integrator": "ros2"},
        },
    ),
    "circuit": Case(
        "hydraulics/cylinder-boom.yaml",
        ("hinge.angle", "hinge.angle.rate"),
        (
            "hydraulics.relief.flow",
            "hydraulics.valve.flow",
            "hydraulics.lift.piston",
            "hydraulics.pump.displacement",
            "hydraulics.lift.friction.viscous",
            "bodies.boom.mass",
        ),
        {
            "bdf": EXACT | {"integrator": "bdf"},
            "radau": EXACT | {"integrator": "radau"},
            "alpha": CLOSE | {"integrator": "generalised-alpha"},
        },
        {"duration": 0.3},
    ),
    "beam": Case(
        BEAM,
        ("mast.end.position.z", "kinetic_energy"),
        ("parameters.bending", "parameters.density", "parameters.load"),
        {
            "alpha": ABSOLUTE | CLOSE | {"integrator": "generalised-alpha"},
            "bdf": ABSOLUTE | EXACT | {"integrator": "bdf"},
            "radau": ABSOLUTE | EXACT | {"integrator": "radau"},
        },
    ),
    # a slider passes a node of the beam that carries it, at the same step for all values of the differences
    "crossing": Case(
        CROSSING,
        ("slide.displacement.rate", "rail.end.position.z", "bead.velocity.z"),
        ("parameters.load", "parameters.bending", "parameters.speed"),
        {
            "rk4": RELATIVE | {"integrator": "rk4", "step": 2e-5, "duration": 0.025},
            "ros2": RELATIVE | {"integrator": "ros2", "step": 2e-4},
            "alpha": RELATIVE | CLOSE | {"integrator": "generalised-alpha"},
            "ros2, absolute": ABSOLUTE | {"integrator": "ros2", "step": 2e-4},
        },
        step=1e-5,
    ),
    # a start of which fast vibrations are left out
    "cable": Case(
        "beams/cable.yaml",
        ("velocity", "joint_coordinate"),
        ("parameters.height", "parameters.load"),
        {"alpha": FULL | {"integrator": "generalised-alpha"}},
        {"duration": 0.01},
    ),
    "bicycle": Case(
        "vehicles/bicycle.yaml",
        ("position", "joint_coordinate"),
        ("parameters.front", "parameters.speed", "joints.front_tyre.radius"),
        {"rk4, absolute": ABSOLUTE | {"integrator": "rk4"}, "rk4, relative": RELATIVE | {"integrator": "rk4"}},
        {"duration": 0.1},
    ),
    "flexible": Case(
        "flexible/pendulum.yaml",
        ("hinge.angle", "hinge.angle.rate"),
        ("gravity.0", "gravity.1"),
        {
            "rk4": {"integrator": "rk4"},
            "radau": {"integrator": "radau", "tolerance": 1e-8},
            "ros2, modes": RELATIVE | {"integrator": "ros2", "step": 1e-3},
        },
        {"duration": 0.05},
    ),
    "control": Case(
        "control/servo-axis.yaml",
        ("guide.displacement", "guide.displacement.rate"),
        (
            "control.axis.position_gain",
            "control.axis.speed_gain",
            "parameters.moved",
            "forces.motor.gear_stiffness",
            "control.axis.integral_time",
        ),
        {"rk4": {"integrator": "rk4"}, "alpha": CLOSE | {"integrator": "generalised-alpha"}},
        {"duration": 0.2},
    ),
    "friction": Case(
        SLIDING,
        ("rail.displacement", "rail.displacement.rate", "dissipated_energy"),
        ("parameters.mu", "bodies.block.mass", "parameters.speed", "forces.spring.stiffness"),
        {
            "rk4": {"integrator": "rk4"},
            "alpha": CLOSE | {"integrator": "generalised-alpha"},
            "radau": EXACT | {"integrator": "radau"},
        },
    ),
    # a law of an angle that is followed over turns
    "wound": Case(
        WOUND,
        ("pin.angle", "kinetic_energy"),
        ("parameters.k", "parameters.inertia"),
        {
            "ros2": RELATIVE | {"integrator": "ros2"},
            "ros2, absolute": ABSOLUTE | {"integrator": "ros2"},
            "radau": EXACT | {"integrator": "radau"},
        },
        step=1e-4,
    ),
    "stiction": Case(
        STICKING,
        ("rail.displacement", "dissipated_energy"),
        ("parameters.mu", "parameters.speed"),
        {
            "rk4": {"integrator": "rk4"},
            "alpha, chosen": {"integrator": "generalised-alpha", "step_control": "error", "tolerance": 1e-7},
        },
        step=1e-5,
    ),
    "contact": Case(
        PRESSED,
        ("ball.position.z", "ball.velocity.z"),
        ("forces.floor.stiffness", "bodies.ball.mass", "parameters.speed", "bodies.ball.velocity.0"),
        {
            "rk4": {"integrator": "rk4"},
            "dopri5": EXACT | {"integrator": "dopri5"},
            "alpha": CLOSE | {"integrator": "generalised-alpha"},
            "bdf": EXACT | {"integrator": "bdf"},
        },
    ),
    "event": Case(
        FALLING,
        ("time(landing)", "ball.position.x", "peak(ball.velocity.z)"),
        ("parameters.height", "parameters.g", "parameters.speed", "parameters.drag"),
        {
            "rk4": {"integrator": "rk4"},
            "dopri5": EXACT | {"integrator": "dopri5"},
            "bdf": EXACT | {"integrator": "bdf"},
            "radau": EXACT | {"integrator": "radau"},
        },
    ),
    "top": Case(
        "mechanisms/heavy-top.yaml",
        ("top.angular_velocity", "kinetic_energy"),
        ("bodies.top.mass", "bodies.top.centre_of_mass.1", "gravity.2", "bodies.top.angular_velocity_body.1"),
        {
            "rk4": ABSOLUTE | {"integrator": "rk4"},
            "alpha": ABSOLUTE | CLOSE | {"integrator": "generalised-alpha"},
            "radau": ABSOLUTE | EXACT | {"integrator": "radau"},
        },
        {"duration": 0.1},
        1e-5,
    ),
}
PAIRS = [(name, method) for name, case in CASES.items() for method in case.methods]
# what needs no code that the tests of gradients do not compile
SAMPLE = [("pendulum", "hht, absolute"), ("event", "rk4")]


def loaded(tmp_path, text):
    if text.startswith("flexible/"):
        for name in ("pendulum", "pendulum-bar"):
            shutil.copy(EXAMPLES / "flexible" / f"{name}.yaml", tmp_path)
        write_body(reduce(tmp_path / "pendulum-bar.yaml").body, tmp_path / "pendulum-bar.nc")
        return nivel.load(tmp_path / "pendulum.yaml")
    if text.endswith(".yaml"):
        return nivel.load(EXAMPLES / text)
    path = tmp_path / "machine.yaml"
    path.write_text(text, encoding="utf-8")
    return nivel.load(path)


def differences(machine, outputs, parameter, h, settings):
    """Slopes of the outputs for a change of the parameter by its scale, of order six, and how far both of order four are apart."""

    def run(share):
        value = parameter.value + share * parameter.scale
        result = machine.with_values({parameter.path: value}).simulate(verify=False, **settings)
        return [value_of(each, result) for each in outputs_of(outputs, result)]

    first, second, third = (
        [(up - down) / (2.0 * k * h) for up, down in zip(run(k * h), run(-k * h), strict=True)] for k in (1, 2, 4)
    )
    near = [(4.0 * a - b) / 3.0 for a, b in zip(first, second, strict=True)]
    far = [(4.0 * a - b) / 3.0 for a, b in zip(second, third, strict=True)]
    return [((16.0 * a - b) / 15.0, np.max(np.abs(a - b))) for a, b in zip(near, far, strict=True)]


def misses(case, method, tmp_path):
    """(output, parameter, how far the slope is off as a share of the scale, what the differences know, verdict) of all triples."""
    machine, settings = loaded(tmp_path, case.machine), case.settings | case.methods[method]
    h = settings.pop(H, case.step)
    found = machine.gradient(list(case.outputs), list(case.parameters), **settings)
    result = machine.simulate(verify=False, **settings)
    parameters = parameters_of(machine, case.parameters)
    expected = [differences(machine, case.outputs, each, h, settings) for each in parameters]
    for k, output in enumerate(outputs_of(case.outputs, result)):
        slopes = [found[f"d({output.label})/d({each.path})"] for each in parameters]
        scaled = [each.to_numpy() * parameter.scale for each, parameter in zip(slopes, parameters, strict=True)]
        size = np.max(np.abs(result.array(output.name))) if not output.is_event else float(result.time[-1])
        scale = max(size, *(np.max(np.abs(each)) for each in scaled))
        for parameter, slope, got, of in zip(parameters, slopes, scaled, expected, strict=True):
            exact, doubt = of[k]
            yield output.label, parameter.path, np.max(np.abs(got - exact)) / scale, doubt / scale, slope.verdict


def check_pair(name, method, tmp_path):
    wrong = [
        f"{output} by {parameter}: off by {off:.1e}, differences know {doubt:.1e}, {verdict}"
        for output, parameter, off, doubt, verdict in misses(CASES[name], method, tmp_path)
        if not off <= max(NEAR, min(doubt, TOLD)) and verdict == "green"
    ]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize(("name", "method"), SAMPLE)
def test_slopes_are_those_of_differences(name, method, tmp_path):
    check_pair(name, method, tmp_path)


@pytest.mark.full
@pytest.mark.parametrize(("name", "method"), [each for each in PAIRS if each not in SAMPLE])
def test_slopes_of_all_families_and_methods_are_those_of_differences(name, method, tmp_path):
    check_pair(name, method, tmp_path)


def test_there_are_two_hundred_triples():
    assert sum(len(case.parameters) * len(case.methods) for case in CASES.values()) >= 200
