"""A pendulum whose frames are written down, not computed: what sinks, results and reports are tested with.

An arm of mass 2 kg, its centre of mass 0.5 m from a hinge about Z, swings as θ(t) = 0.3 cos(ω t), ω² = g / 0.5 m (small
angles, no inertia about the centre of mass). θ is the angle of the arm's x axis from the downward vertical.
"""

import json

import numpy as np

import nivel
from nivel.integrate.loop.sink import Header
from nivel.judge.after.checks.joints import Freedom, Redundancy
from nivel.judge.after.report import assess
from nivel.judge.after.subject import Motion
from nivel.system.layout import FrameLayout, frame_layout

MASS, LENGTH, GRAVITY, SWING = 2.0, 0.5, 9.81, 0.3
RATE = np.sqrt(GRAVITY / LENGTH)
ROWS = {"hinge.s.x": "m", "hinge.s.y": "m", "hinge.s.z": "m", "hinge.d1.xz": "1", "hinge.d1.yz": "1"}
SIZE = LENGTH  # the joint point and the centre of mass are 0.5 m apart


def layout() -> FrameLayout:
    outputs = [("force.push.magnitude", "N", "magnitude"), ("force.push.power", "W", "power into the machine")]
    return frame_layout(["arm"], ["hinge"], ["hinge.angle"], list(ROWS), outputs)


def scene(shape=None):
    return {
        "bodies": [{"name": "arm", "shape": shape, "centre_of_mass": [0, 0, 0], "points": [[-LENGTH, 0, 0]]}],
        "ground_points": [[0, 0, 0]],
        "joints": [
            {
                "name": "hinge",
                "type": "revolute",
                "bodies": ["ground", "arm"],
                "points": [[0, 0, 0], [-LENGTH, 0, 0]],
                "axes": [[0, 0, 1], [0, 0, 1]],
            }
        ],
    }


def judged(result, outcome="done", *, degrees=1, failure="", **found):
    """The trust report of a run; degrees : of freedom, None where they are not known. found : what checks have found besides."""
    known = {"redundancy": Redundancy(), **({} if degrees is None else {"degrees_of_freedom": Freedom(degrees)})}
    return assess(Motion(result=result, outcome=outcome, failure=failure), known | found)


def header(**attributes) -> Header:
    known = {
        "machine": "pendulum",
        "machine_record": json.dumps({"name": "pendulum"}),
        "machine_source": "name: pendulum\n",
        "scene": json.dumps(scene()),
        "settings": json.dumps({"duration": 8.0, "step": 1e-3, "integrator": "rk4", "formulation": "newton-euler"}),
        "coordinate_units": json.dumps({"hinge.angle": "rad"}),
        "constraint_units": json.dumps(ROWS),
        "nivel_version": nivel.__version__,
        "outcome": "running",
    }
    return Header(layout(), {**known, **attributes})


def histories(time):
    """Every variable of the layout at the times `time` (n,)."""
    n = len(time)
    angle = SWING * np.cos(RATE * time)
    rate = -SWING * RATE * np.sin(RATE * time)
    acceleration = -(RATE**2) * angle
    down = angle - np.pi / 2  # of the arm's x axis from the global X axis
    radial = np.stack([np.cos(down), np.sin(down), np.zeros(n)], axis=-1)
    tangent = np.stack([-np.sin(down), np.cos(down), np.zeros(n)], axis=-1)
    about_z = np.tile([0.0, 0.0, 1.0], (n, 1))
    half = np.stack([np.cos(down / 2), np.zeros(n), np.zeros(n), np.sin(down / 2)], axis=-1)
    pull = MASS * LENGTH * (acceleration[:, None] * tangent - rate[:, None] ** 2 * radial) + [0.0, MASS * GRAVITY, 0.0]
    kinetic = 0.5 * MASS * (LENGTH * rate) ** 2
    zero, zeros = np.zeros(n), np.zeros((n, 1, 3))
    drift = 1e-9 * np.outer(time, [1.0, 2.0, 0.0, 0.5, 0.25])
    return {
        "position": LENGTH * radial[:, None],
        "orientation": half[:, None],
        "velocity": LENGTH * (rate[:, None] * tangent)[:, None],
        "angular_velocity": (rate[:, None] * about_z)[:, None],
        "acceleration": LENGTH * (acceleration[:, None] * tangent - rate[:, None] ** 2 * radial)[:, None],
        "angular_acceleration": (acceleration[:, None] * about_z)[:, None],
        "joint_force": -pull[:, None],
        "joint_torque": zeros,
        "joint_force_local": -pull[:, None],
        "joint_torque_local": zeros,
        "joint_coordinate": angle[:, None],
        "joint_rate": rate[:, None],
        "constraint_violation": drift,
        "constraint_rate_violation": 10.0 * drift,
        "constraint_force": np.zeros((n, len(ROWS))),
        "kinetic_energy": kinetic,
        "potential_energy": kinetic[:1] - kinetic,
        "external_work": zero,
        "dissipated_energy": zero,
        "energy_error": 1e-9 * time,
        "force.push.magnitude": zero,
        "force.push.power": zero,
    }


def frames(time):
    """(n, width) as a run hands them to its sinks."""
    return packed(time, histories(time))


def packed(time, values):
    """(n, width) of these histories."""
    plan = layout()
    out = np.empty((len(time), plan.width))
    out[:, 0] = time
    for variable in plan.variables:
        out[:, variable.columns] = np.reshape(values[variable.name], (len(time), -1))
    return out
