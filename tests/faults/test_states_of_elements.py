"""States of elements against their own inequalities: a frame that contradicts is red, for every kind."""

from dataclasses import replace

import numpy as np
import pytest

from nivel import Machine
from nivel.analysis.plan.plan import plan_run
from nivel.analysis.run.dynamics import march
from nivel.analysis.run.prepared_state import prepare
from nivel.files import parse_machine
from nivel.judge.after.checks.states import look_at_sides
from nivel.judge.after.subject import run_of

ZOO = """
format: 1
gravity: [0, 0, -9.81]
bodies:
  ball: {mass: 1, position: [0, -2, 0.3], shape: {type: sphere, radius: 0.1}}
  grain: {mass: 1, position: [0, -4, 0.3], shape: {type: sphere, radius: 0.1}}
  seed: {mass: 1, position: [0.05, -4, 0.6], shape: {type: sphere, radius: 0.1}}
  slider: {mass: 1, inertia: [1, 1, 1], position: [0, -6, 0.1], shape: {type: box, size: [0.2, 0.2, 0.2]}, velocity: [1, 0, 0]}
  stopped: {mass: 1, inertia: [1, 1, 1], position: [0, 2, 0]}
  roped: {mass: 1, inertia: [1, 1, 1], position: [0, 4, 0]}
  rubbed: {mass: 1, inertia: [1, 1, 1], position: [0, 6, 0]}
  a: {mass: 1, inertia: [1, 1, 1], position: [0, 8, 0]}
  b: {mass: 1, inertia: [1, 1, 1], position: [0, 8, 1]}
  c: {mass: 1, inertia: [1, 1, 1], position: [0, 8, 2]}
  d: {mass: 1, inertia: [1, 1, 1], position: [0, 8, 3]}
  e: {mass: 1, inertia: [1, 1, 1], position: [0, 8, 4]}
  f: {mass: 1, inertia: [1, 1, 1], position: [0, 8, 5]}
  g: {mass: 1, inertia: [1, 1, 1], position: [0, 8, 6]}
markers: {floor: {body: ground, axis: [0, 0, 1], x_axis: [1, 0, 0]}}
joints:
  end: {type: translational, bodies: [ground, stopped], point: [0, 2, 0], axis: [1, 0, 0], start_rates: {displacement: 1}}
  line: {type: translational, bodies: [ground, roped], point: [0, 4, 0], axis: [1, 0, 0], start_rates: {displacement: 1}}
  pad: {type: translational, bodies: [ground, rubbed], point: [0, 6, 0], axis: [1, 0, 0], start_rates: {displacement: 1}}
  ja: {type: revolute, bodies: [ground, a], point: [0, 8, 0], axis: [0, 0, 1], start_rates: {angle: 1}}
  jb: {type: revolute, bodies: [ground, b], point: [0, 8, 1], axis: [0, 0, 1]}
  jc: {type: revolute, bodies: [ground, c], point: [0, 8, 2], axis: [0, 0, 1], start_rates: {angle: 1}}
  jd: {type: revolute, bodies: [ground, d], point: [0, 8, 3], axis: [0, 0, 1]}
  je: {type: revolute, bodies: [ground, e], point: [0, 8, 4], axis: [0, 0, 1]}
  jf: {type: revolute, bodies: [ground, f], point: [0, 8, 5], axis: [0, 0, 1]}
  jg: {type: revolute, bodies: [ground, g], point: [0, 8, 6], axis: [0, 0, 1]}
forces:
  contact: {type: contact, body: ball, plane: floor, stiffness: 1e4, exponent: 1, restitution: 0.5}
  heap: {type: contacts, between: [grain, seed], planes: [floor], stiffness: 1e4, restitution: 0.5}
  sticks: {type: contact, body: slider, plane: floor, stiffness: 1e5, exponent: 1, restitution: 0.5, friction: 0.4}
  stop: {type: stop, coordinate: end.displacement, upper: 0.2, lower: -0.2, stiffness: 1e4, restitution: 0.8}
  rope: {type: rope, bodies: [ground, roped], points: [[-1, 4, 0], [0, 4, 0]], stiffness: 1e3, damping: 5, length: 1.2}
  friction: {type: friction, coordinate: pad, model: stiction, coefficient: 0.2}
  clutch: {type: clutch, coordinate: jb, against: ja, capacity: 2}
  freewheel: {type: freewheel, coordinate: jc, against: ja}
  pawl: {type: freewheel, coordinate: jd, against: ja, stiffness: 1e3, damping: 1}
  shaft: {type: shaft, coordinate: je, against: ja, stiffness: 1e3, damping: 1, backlash: 0.2}
  belt: {type: belt-drive, coordinate: jf, against: ja, radii: [0.1, 0.1], stiffness: 1e5, damping: 10, pretension: 20, friction: 0.3}
  chain: {type: belt-drive, coordinate: jg, against: ja, radii: [0.1, 0.1], stiffness: 1e5, damping: 10, slack: 5 mm}
  turns: {type: torque, body: a, vector: [0, 0, "4*cos(3*time)"]}
fluids: {oil: {density: 860}}
hydraulics:
  tank: {type: tank}
  left: {type: volume, volume: 1 L, start: 50 bar}
  right: {type: volume, volume: 1 L, start: 10 bar}
  bleed: {type: orifice, ports: {A: left, B: tank}, flow: 1 L/min, pressure_drop: 5 bar}
  check: {type: check-valve, ports: {A: left, B: right}, flow: 10 L/min, pressure_drop: 5 bar}
simulation: {duration: 1, output_interval: 5 ms, integrator: radau}
"""


class Spoilt:
    """A result of which some numbers are others."""

    def __init__(self, result, changes):
        self._result, self._changes = result, changes

    def __getattr__(self, name):
        return getattr(self._result, name)

    def __contains__(self, name):
        return name in self._result

    def array(self, name, *frames):
        values = np.array(self._result.array(name, *frames))
        for changed, at, value in self._changes:
            if changed == name:
                values[at] = value
        return values


@pytest.fixture(scope="module")
def zoo():
    record = parse_machine(ZOO)
    plan = plan_run(record)
    prepared = prepare(plan.methods)
    finished = march(prepared, plan.settings, [])
    return run_of(plan, prepared, finished, Machine.from_record(record).simulate(verify=False))


def test_no_kind_contradicts_itself(zoo):
    """Each is on both of its sides in the run."""
    assert look_at_sides(zoo) == []
    force = zoo.result.array
    for name in (
        "contact.normal_force",
        "heap.normal_force",
        "stop.magnitude",
        "rope.magnitude",
        "shaft.magnitude",
        "pawl.magnitude",
    ):
        acts = force(f"force.{name}") != 0.0
        assert acts.any(), name
        assert not acts.all(), name
    assert set(force("force.sticks.sticks")) == {0.0, 1.0}
    for name in ("clutch", "freewheel"):
        slips = np.abs(force(f"force.{name}.slip")) > 1e-3
        assert slips.any(), name
        assert not slips.all(), name


@pytest.mark.parametrize(
    ("element", "sides", "effort"),
    [
        ("contact", "depth", "normal_force"),
        ("heap", "depth", "normal_force"),
        ("rope", "stretch", "magnitude"),
    ],
)
def test_an_effort_on_the_wrong_side_is_red(zoo, element, sides, effort):
    overlap = zoo.result.array(f"force.{element}.{sides}")
    apart, closed = int(np.argmin(overlap)), 100
    changes = [(f"force.{element}.{effort}", apart, 1.0)]
    (found,) = look_at_sides(replace(zoo, result=Spoilt(zoo.result, changes)))
    assert (found.element, found.time) == (element, zoo.result.time[apart])
    # it grows from frame to frame, and nothing acts
    near = slice(closed - 1, closed + 2)
    changes = [(f"force.{element}.{sides}", near, [0.01, 0.02, 0.03]), (f"force.{element}.{effort}", near, 0.0)]
    changes.append((f"force.{element}.rate", near, 1.0))
    (found,) = look_at_sides(replace(zoo, result=Spoilt(zoo.result, changes)))
    assert found.element == element
    assert abs(found.time - zoo.result.time[closed]) <= 0.0051


def test_round_off_at_one_end_is_no_effort_at_the_other(zoo):
    """A stop that rests at its upper end has efforts of both signs at round-off, and never comes near its lower end."""
    low = zoo.result.array("end.displacement") < -0.19
    changes = [("end.displacement", low, -0.19), ("force.stop.magnitude", low, 0.0), ("force.stop.magnitude", 3, 1e-17)]
    assert look_at_sides(replace(zoo, result=Spoilt(zoo.result, changes))) == []


ALL, LAST = slice(0, 200), slice(160, 201)


@pytest.mark.parametrize(
    ("element", "changes"),
    [
        ("stop", [("force.stop.magnitude", 3, -1.0)]),
        ("shaft", [("force.shaft.magnitude", 0, 1.0)]),
        ("pawl", [("force.pawl.run", 50, -1.0), ("force.pawl.magnitude", 50, 5.0)]),
        ("chain", [("force.chain.first_tension", 0, 1.0)]),
        ("belt", [("force.belt.magnitude", 50, 60.0)]),
        ("clutch", [("force.clutch.magnitude", 50, 2.1)]),
        ("clutch", [("force.clutch.magnitude", ALL, 0.5), ("force.clutch.slip", ALL, 0.1)]),
        ("freewheel", [("force.freewheel.magnitude", 50, -0.1)]),
        ("freewheel", [("force.freewheel.slip", ALL, -0.1)]),
        ("friction", [("force.friction.magnitude", 50, 0.21 * 9.81)]),
        ("sticks", [("force.sticks.friction_force", -1, 0.41 * 9.81)]),
        ("sticks", [("force.sticks.slip_speed", LAST, 0.1), ("force.sticks.friction_force", LAST, 1.0)]),
        (
            "check",
            [
                ("hydraulics.check.flow", -1, 1e-4),
                ("hydraulics.left.pressure", -1, 1e5),
                ("hydraulics.right.pressure", -1, 5e5),
            ],
        ),
    ],
)
def test_a_state_that_contradicts_its_inequality_is_red(zoo, element, changes):
    (found,) = look_at_sides(replace(zoo, result=Spoilt(zoo.result, changes)))
    assert found.element == element
    assert found.time in np.concatenate([np.atleast_1d(zoo.result.time[at]) for _, at, _ in changes])


def test_what_is_left_out_of_a_result_is_not_looked_at(zoo):
    class Without(Spoilt):
        def __contains__(self, name):
            return not name.startswith("force.contact") and name in self._result

    assert look_at_sides(replace(zoo, result=Without(zoo.result, [("force.contact.normal_force", 0, 5.0)]))) == []
