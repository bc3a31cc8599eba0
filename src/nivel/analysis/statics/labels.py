"""Directions and rows of statics by name, for messages."""

from __future__ import annotations

import numpy as np

from nivel.analysis.assembly.unknowns import unknown_name
from nivel.analysis.statics.equations import StaticEquations
from nivel.system.system import Array

# Parts of a direction that are this share of its largest are named, so many at most.
NAMED, MOST = 0.35, 3


def direction_in_words(equations: StaticEquations, direction: Array) -> str:
    """The bodies and joints that move most in a direction (f,) without units."""
    size = np.abs(direction)
    if not np.any(size > 0.0):
        return "an unknown direction"
    order = np.argsort(-size, kind="stable")
    chosen = [k for k in order[: MOST + 1] if size[k] >= NAMED * size[order[0]]]
    names = list(dict.fromkeys(unknown_name(equations.system, int(equations.free[k])) for k in chosen[:MOST]))
    return "; ".join(names) + ("; and more" if len(chosen) > MOST else "")


def worst_row(equations: StaticEquations, r: Array, C: Array) -> str:
    """The equation with the largest residual: a body or joint and its direction, or a constraint that is open."""
    forces, open_ = float(np.max(np.abs(r), initial=0.0)), float(np.max(np.abs(C), initial=0.0))
    if open_ > 1e-9 and (not forces > 0.0 or open_ > 1e-3 * forces):
        row = int(equations.residual.row[int(np.argmax(np.abs(C)))])
        return f"the constraint {equations.system.rows[row]}, open by {open_:.3g} of its scale"
    if not forces > 0.0:
        return "no row"
    k = int(np.argmax(np.abs(r)))
    number = int(equations.free[k])
    force = r[k] * equations.energy / equations.length[number]
    units = "N" if equations.system.map.units[equations.place[number, 0]] == "m" else "N m"
    return f"{unknown_name(equations.system, number)}, unbalanced by {force:.3g} {units}"
