"""Load cases of a flexible body for finite-element programs: forces at nodes, and six freedoms held where they need no reaction.

The cards are those of CalculiX, whose user's manual (2.20) has them as Abaqus does, and of MSC Nastran (Quick Reference Guide: FORCE,
MOMENT and SPC1 in fields of 16 and 8 columns).
"""

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from scipy.linalg import qr

from nivel.errors import ModelError
from nivel.files.target import written
from nivel.flexible.model.model import rigid_modes
from nivel.known import RecoveredBody
from nivel.machine.core.vectors import Array

Held = Sequence[tuple[int, int]]  # number of the node, direction from 1


def write_load_cases(path: str | os.PathLike[str], body: RecoveredBody, times: Sequence[float]) -> Path:
    """Write the loads of a body at these times [s]: steps of CalculiX and Abaqus, to be read behind the model by *INCLUDE, or of Nastran
    sets of loads from 1 on. Raises ModelError for other endings, and where there are no loads or the file cannot be written."""
    cards = {".inp": _steps, ".bdf": _sets, ".nas": _sets, ".dat": _sets}.get(Path(path).suffix.lower())
    if cards is None:
        raise ModelError(f"{path}: load cases are for CalculiX and Abaqus, .inp, or for Nastran, .bdf, .nas or .dat")
    cases = [(float(body.time[body.frame(time)]), body.load_case(time)) for time in times]
    with written(path, "load case") as draft:
        draft.write_text("\n".join(cards(body, cases, _held(body))) + "\n", encoding="ascii")
    return Path(path)


def _held(body: RecoveredBody) -> Held:
    """Six displacements of nodes of the model that stop all rigid motions, far apart."""
    place, count = body.body.position, len(body.body.position)
    free = rigid_modes(place - place.mean(axis=0), np.arange(6 * count).reshape(-1, 6), 6 * count)
    free[:, 3:] /= np.ptp(place, axis=0).max()
    rows = 6 * np.flatnonzero(np.any(body.body.loads, axis=(1, 2)))[:, None] + np.arange(3)
    order: Any = qr(free[rows.ravel()].T, mode="r", pivoting=True)
    return sorted((int(body.body.node_ids[row // 6]), int(row % 6) + 1) for row in rows.ravel()[order[1][:6]])


def _loads(body: RecoveredBody, loads: Array) -> Iterator[tuple[int, Array]]:
    """Numbers of nodes, and their forces and moments (6,)."""
    return ((int(body.body.node_ids[k]), loads[k]) for k in np.flatnonzero(loads.any(axis=1)))


def _steps(body: RecoveredBody, cases: Sequence[tuple[float, Array]], held: Held) -> Iterator[str]:
    yield f"** loads of {body.name} [N, N m] in the axes of the model; they balance each other"
    for time, loads in cases:
        yield from (f"** at {time:.9g} s", "*STEP", "*STATIC", "*BOUNDARY")
        yield from (f"{node}, {axis}, {axis}" for node, axis in held)
        yield "*CLOAD, OP=NEW"
        for node, load in _loads(body, loads):
            yield from (f"{node}, {axis}, {value:.12e}" for axis, value in enumerate(load, 1) if value)
        yield from ("*NODE FILE", "U", "*EL FILE", "S", "*END STEP")


def _sets(body: RecoveredBody, cases: Sequence[tuple[float, Array]], held: Held) -> Iterator[str]:
    yield f"$ loads of {body.name} [N, N m] in the axes of the model; they balance each other: SPC = 1"
    yield from (f"SPC1    {1:8d}{axis:8d}{node:8d}" for node, axis in held)
    for number, (time, loads) in enumerate(cases, 1):
        yield f"$ LOAD = {number}: at {time:.9g} s"
        for node, load in _loads(body, loads):
            for card, part in (("FORCE*", load[:3]), ("MOMENT*", load[3:])):
                if part.any():
                    x, y, z = part
                    yield f"{card:8}{number:16d}{node:16d}{0:16d}{1.0:16.9E}"
                    yield f"{'*':8}{x:16.9E}{y:16.9E}{z:16.9E}"
