"""Frictions with stiction that at rest share the load in more than one way: with what prescribes their motion, or with each other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.freedoms import coordinate_derivatives
from nivel.kernels.elements import friction as columns
from nivel.machine.forces import Friction
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import resolve
from nivel.results.trust.indeterminate_friction import Held, Sticking
from nivel.system.system import Array, System

# What the constraints leave of a unit derivative below this is round-off; shares of rows below it are none.
LEFT = 1e-7


def resting_frictions(
    machine: MachineRecord, motion: MotionEquations, y: Array
) -> tuple[tuple[Held, ...], tuple[Sticking, ...]]:
    """In the assembled state y of absolute coordinates: frictions whose coordinate is a combination of constraint rows, and whose rows
    these are; and all others, whose coordinates may move. Of machines that bend the former are only those that a driver moves directly, and
    of the latter only those of one coordinate follow from each other, for all else may follow from bending."""
    rubbing = [force for force in machine.forces if isinstance(force, Friction) and force.model == "stiction"]
    if not rubbing or not motion.system.machine_rows:
        return (), ()
    system = motion.system
    motion.evaluate(0.0, y)
    places = [
        int(system.record.friction.columns[system.frictions.index(force.name), columns.COORDINATE]) for force in rubbing
    ]
    wanted = _unit(coordinate_derivatives(motion, places))
    rows = motion.jacobian().reshape(system.machine_rows, -1, 6).copy()
    rows[:, :, :3] *= system.size
    rows = _unit(rows.reshape(system.machine_rows, -1))
    share = np.linalg.lstsq(rows.T, wanted.T, rcond=LEFT)[0].T
    left = wanted - share @ rows
    moves = (np.unique(places)[:, None] == places).T.astype(float) if machine.is_flexible else _unit(left)
    held, sticking = [], []
    for k, force in enumerate(rubbing):
        name = ".".join(resolve(force.coordinate, machine.joints))
        used = np.flatnonzero(np.abs(share[k]) > LEFT)
        driven = all(system.rows[row].endswith(".driver") for row in used)
        if np.linalg.norm(left[k]) > LEFT:
            arm = system.record.friction.number[system.frictions.index(force.name), columns.ARM]
            sticking.append(Sticking(force.name, name, moves[k], float(force.static * arm), force.viscous))
        elif driven or not machine.is_flexible:
            held.append(Held(force.name, name, *_owners(system, used)))
    return tuple(held), tuple(sticking)


def _owners(system: System, rows: NDArray[np.intp]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Drivers, and joints and couplings, whose rows these are."""
    owners = {system.row_owner[row]: system.rows[row].endswith(".driver") for row in rows}
    drivers = tuple(name for name, drives in owners.items() if drives)
    return drivers, tuple(name for name in owners if name not in drivers)


def _unit(rows: Array) -> Array:
    """Rows of unit length."""
    return rows / np.maximum(np.linalg.norm(rows, axis=1, keepdims=True), 1e-300)
