"""Frictions with stiction that rub against a motion which constraints prescribe: at rest they share the load in more than one way."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np

from nivel.analysis.equations import MotionEquations
from nivel.analysis.freedoms import coordinate_derivatives
from nivel.machine.coordinate_reference import resolve
from nivel.machine.forces import Friction
from nivel.machine.machine_record import MachineRecord
from nivel.results.held import Held
from nivel.system.system import Array

# What the constraints leave of a unit derivative below this is round-off; shares of rows below it are none.
LEFT = 1e-7


def held_frictions(machine: MachineRecord, motion: MotionEquations, y: Array) -> tuple[Held, ...]:
    """In the assembled state y of absolute coordinates: frictions whose coordinate is a combination of constraint rows, and whose rows
    these are. Of machines that bend only those that a driver moves directly, for the others may follow from bending."""
    rubbing = [force for force in machine.forces if isinstance(force, Friction) and force.model == "stiction"]
    if not rubbing or not motion.system.machine_rows:
        return ()
    system = motion.system
    motion.evaluate(0.0, y)
    columns: Any = import_module("nivel.kernels.friction")
    places = [
        int(system.record.friction.columns[system.frictions.index(force.name), columns.COORDINATE]) for force in rubbing
    ]
    wanted = _unit(coordinate_derivatives(motion, places))
    rows = motion.jacobian().reshape(system.machine_rows, -1, 6).copy()
    rows[:, :, :3] *= system.size
    rows = _unit(rows.reshape(system.machine_rows, -1))
    share = np.linalg.lstsq(rows.T, wanted.T, rcond=LEFT)[0].T
    out = []
    for force, its, left in zip(rubbing, share, np.linalg.norm(wanted - share @ rows, axis=1), strict=True):
        used = np.flatnonzero(np.abs(its) > LEFT)
        driven = [system.rows[row].endswith(".driver") for row in used]
        if left < LEFT and (all(driven) or not machine.is_flexible):
            owners = [system.row_owner[row] for row in used]
            drivers = dict.fromkeys(name for name, drives in zip(owners, driven, strict=True) if drives)
            others = dict.fromkeys(name for name, drives in zip(owners, driven, strict=True) if not drives)
            name = ".".join(resolve(force.coordinate, machine.joints))
            out.append(Held(force.name, name, tuple(drivers), tuple(others)))
    return tuple(out)


def _unit(rows: Array) -> Array:
    """Rows of unit length."""
    return rows / np.maximum(np.linalg.norm(rows, axis=1, keepdims=True), 1e-300)
