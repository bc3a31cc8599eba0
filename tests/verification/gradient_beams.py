"""Machines with beams in absolute nodal coordinates, for their tests."""

from types import SimpleNamespace

import numpy as np

from beams import prepared
from nivel.flexible.body.body import ReducedBody
from nivel.system.beam_nodes import with_nodes
from nivel.system.flexible import bending_bodies

MODELS = ("ancf-cable", "ancf-beam")
EI, LENGTH = 100.0, 10.0


def section(model, EA=1e5, GA=1e5, GJ=80.0, EI=EI, mass=1.0, turning=0.02):
    """A section that either model can have."""
    return {
        "type": "general",
        "stiffness": [EA, GA, GA, GJ, EI, EI],
        "mass": mass,
        "inertia": [2 * turning, turning, turning],
    }


def cantilever(model, load, elements=8, **beam):
    """Clamped at the origin, along x, with a force or a torque at its end."""
    rod = {"from": [0, 0, 0], "to": [LENGTH, 0, 0], "section": section(model), "elements": elements, "model": model}
    return {
        "beams": {"rod": {**rod, **beam}},
        "joints": {"wall": {"type": "fixed", "bodies": ["ground", "rod.start"], "point": [0, 0, 0]}},
        "forces": {"load": {"body": "rod.end", **load}} if load else {},
    }


def flying(model, elements=4, **beam):
    """A beam without any hold: a cable that spins and turns, or a curved beam whose mass and shear centres are off its line."""
    rod = {"elements": elements, "model": model, "velocity": [0.3, -0.2, 0.1], "angular_velocity": [1.0, 9.0, 4.0]}
    if model == "ancf-cable":
        rod |= {"from": [0, 0, 0], "to": [1, 0, 0.3], "section": section(model, 2e4, 1e4, 20, 30, 1.0, 1e-3)}
    else:
        own = {
            "type": "general",
            "stiffness": [2e4, 1e4, 1.2e4, 20, 30, 40],
            "mass": 1.0,
            "inertia": [2.2e-3, 1e-3, 1.2e-3],
            "mass_centre": [0.01, -0.02],
        }
        rod |= {
            "from": [0, 0, 0],
            "to": [1, 0, 0.3],
            "via": [0.5, 0.2, 0.1],
            "section": own,
            "shear_centre": [0.01, 0.02],
        }
    return {"name": "flying", "beams": {"rod": {**rod, **beam}}}


def deformed(motion, start, seed, size=0.03, speed=1.0):
    """A state near `start`, in motion: every node moved by `size` times its own measure."""
    rng = np.random.default_rng(seed)
    system = motion.system
    y, positions = start.copy(), system.positions
    units = np.array(system.map.units[:positions])
    y[:positions] += size * rng.standard_normal(positions) * np.where(units == "kg^0.5 m", 0.0, 1.0)
    y[np.flatnonzero(units == "kg^0.5 m")] += size * system.modal_sizes() * rng.standard_normal(len(system.modes))
    for place, _ in system.map.turns:
        y[place : place + 4] /= np.linalg.norm(y[place : place + 4])
    n = len(motion.system.record.residual.vdot)
    velocity = speed * rng.standard_normal(n)
    velocity[n - len(system.modes) :] *= system.modal_sizes()
    y[positions : positions + n] = velocity
    return y


def in_motion(sections, rng, seed=2):
    """Equations of `sections` with a state in motion, accelerations, rates and multipliers there, as `unknowns` wants them."""
    ready = prepared(sections)
    motion, system = ready.motion, ready.motion.system
    y = deformed(motion, ready.start, seed)
    n, rows = len(system.record.residual.vdot), len(system.record.residual.row)
    return SimpleNamespace(
        motion=motion,
        y=y,
        size=system.size,
        positions=system.positions,
        n=n,
        states=0,
        rows=rows,
        vdot=rng.standard_normal(n),
        xdot=np.zeros(0),
        lam=rng.standard_normal(rows),
    )


def bodies_of_nodes(machine) -> list[ReducedBody]:
    """What makes the nodes of its beams deform."""
    return [each.reduced for each in bending_bodies(with_nodes(machine.record))]
