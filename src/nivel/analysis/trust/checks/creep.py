"""Creep of contacts whose friction goes to zero with the speed of sliding: how far bodies slid that real friction would have held."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.trust.check import FRAMES, Check
from nivel.analysis.trust.subject import Run
from nivel.machine.forces import Contact, Contacts
from nivel.results.scales import machine_size
from nivel.results.trust import Item, Threshold, number

Array = NDArray[np.float64]
THRESHOLD = Threshold(
    1e-4,
    np.inf,
    "Way over which a contact with `friction_model: coulomb` lets bodies creep, as a share of the size of the machine. Real friction would "
    "hold them.",
)


@dataclass(frozen=True)
class Creep:
    """A contact, how far its bodies creep in all [m], as a share of the machine's size, and the time [s] and speed [m/s] where they are
    fastest."""

    contact: str
    way: float
    share: float
    time: float
    speed: float


def look(run: Run) -> list[Creep]:
    """Contacts that creep: they slide slower than the transition speed of their friction, from frame to frame."""
    time, found = run.result.time, []
    if len(time) < 2:
        return found
    for force in run.machine.forces:
        if not isinstance(force, Contact | Contacts) or not _is_smooth(force):
            continue
        speed = _sliding(run, force)
        touches = run.result.array(f"force.{force.name}.normal_force") > 0.0
        creeps = touches & (speed < (force.friction_transition_speed or np.inf))
        between = creeps[1:] & creeps[:-1]
        way = float(np.sum(np.where(between, 0.5 * (speed[1:] + speed[:-1]) * np.diff(time), 0.0)))
        if way > 0.0:
            fastest = int(np.argmax(np.where(creeps, speed, 0.0)))
            share = way / machine_size(run.result)[0]
            found.append(Creep(force.name, way, share, float(time[fastest]), float(speed[fastest])))
    return found


def _is_smooth(force: Contact | Contacts) -> bool:
    """Whether a force has friction that goes to zero with the speed of sliding."""
    if isinstance(force, Contact):
        return bool(force.friction) and not force.sticks
    return bool(force.friction) and force.friction_transition_speed is not None


def _sliding(run: Run, force: Contact | Contacts) -> Array:
    """(n,) [m/s] speed of sliding; of many pairs the mean by their friction."""
    if isinstance(force, Contact):
        return run.result.array(f"force.{force.name}.slip_speed")
    friction, power = (run.result.array(f"force.{force.name}.friction_{each}") for each in ("force", "power"))
    return np.divide(power, friction, out=np.zeros_like(power), where=friction > 0.0)


def say(found: Creep) -> Item:
    """How far it creeps."""
    said = (
        f"Contact: {found.contact} lets its bodies creep by {number(found.way)} m, with up to {number(found.speed)} m/s at "
        f"t = {found.time:.6g} s, where friction would hold them: a `contact` with `friction_model: stiction` does"
    )
    return THRESHOLD.item("creep", said, found.share, found.time, found.contact)


CHECKS = (Check("creep", Run, look, say, 225, (FRAMES,), "Contact", THRESHOLD, quiet=True),)
