"""Machines with beams, and what tests read of them."""

import json

import numpy as np

from nivel.analysis.assembly import implicit
from preparing import prepare
from simulating import machine

RAMP = {"times": [0, 0.5, 100], "values": [0, 1.5, 1.5], "interpolation": "linear"}


def general(EA=1e6, GA=1e6, GJ=1e3, EI=1e3, mass=1.0, inertia=(1.0, 1.0, 1.0), **more):
    """A section by its numbers."""
    return {"type": "general", "stiffness": [EA, GA, GA, GJ, EI, EI], "mass": mass, "inertia": list(inertia), **more}


def hinged(elements, **simulation):
    """The two hinged beams of Mäkinen and Marjamäki: the root turns about and moves along e3 by 1.5 in 0.5 s."""
    beam = {"section": general(), "elements": elements // 2}
    return {
        "name": "hinged",
        "beams": {
            "inner": {"from": [0, 0, 0], "to": [5, 0, 0], **beam},
            "outer": {"from": [5, 0, 0], "to": [10, 0, 0], **beam},
        },
        "joints": {
            "root": {"type": "cylindrical", "bodies": ["ground", "inner.start"], "point": [0, 0, 0], "axis": [0, 0, 1]},
            "hinge": {
                "type": "revolute",
                "bodies": ["inner.end", "outer.start"],
                "point": [5, 0, 0],
                "axis": [0, 0, 1],
            },
        },
        "drivers": {
            "turn": {"coordinate": "root.angle", "value": RAMP},
            "lift": {"coordinate": "root.displacement", "value": RAMP},
        },
        "simulation": {"duration": 3.0, "step": 0.01, "integrator": "newmark", "output_interval": 0.01, **simulation},
    }


def flying(order=1, mass="consistent", **beam):
    """A curved beam without any hold, whose mass centres are off its line."""
    section = {
        "type": "general",
        "stiffness": [2e4, 1e4, 1.2e4, 20, 30, 40],
        "mass": 1.0,
        "inertia": [2e-3, 1e-3, 1.2e-3],
        "mass_centre": [0.01, -0.02],
    }
    return {
        "name": "flying",
        "beams": {
            "rod": {
                "from": [0, 0, 0],
                "to": [1, 0, 0.3],
                "via": [0.5, 0.2, 0.1],
                "section": section,
                "elements": 6,
                "order": order,
                "mass": mass,
                "velocity": [0.3, -0.2, 0.1],
                "angular_velocity": [1.0, 9.0, 4.0],
                **beam,
            }
        },
    }


def prepared(sections, coordinates="absolute"):
    """The machine of `sections` ready for an implicit method."""
    sections = {**sections, "simulation": {"integrator": "generalised-alpha", **sections.get("simulation", {})}}
    record = machine({**sections, "simulation": {**sections["simulation"], "coordinates": coordinates}}).record
    return prepare(record, "newton-euler", coordinates)


def disturb(motion, start, seed, size=0.05, speed=1.0):
    """Put a state near `start`, with random velocities, accelerations and multipliers, into the residual of `motion`."""
    rng = np.random.default_rng(seed)
    system, own = motion.system, motion.system.record.residual
    n = len(own.vdot)
    positions = system.positions
    y = start.copy()
    y[:positions] += size * rng.standard_normal(positions)
    for place, _ in system.map.turns:
        y[place : place + 4] /= np.linalg.norm(y[place : place + 4])
    y[positions : positions + n] = speed * rng.standard_normal(n)
    own.y[:], own.vdot[:], own.lam[:] = y, rng.standard_normal(n), rng.standard_normal(len(own.lam))
    system.record.newton.change[:] = 0.1 * rng.standard_normal(n)


def forces(motion, y):
    """(elastic energy, wrenches (B, 6) of the elements on their nodes: force and torque, global) at rest in the state y, without weight."""
    own = motion.system.record.residual
    own.y[:], own.vdot[:], own.lam[:] = y, 0.0, 0.0
    own.y[motion.system.positions :] = 0.0
    assert implicit.evaluate_residual(motion, 0.0) == 0
    return float(motion.system.record.control.stored[0]), -own.wrench[
        : motion.system.body_count, [3, 4, 5, 0, 1, 2]
    ].copy()


def trust(result):
    """The trust report of a result."""
    return json.loads(result.dataset.attrs["trust"])
