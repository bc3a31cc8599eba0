"""Assumed mode shapes that the user gives: expressions of the place, or a table of nodal displacements."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Final

import numpy as np

from nivel.errors import ModelError
from nivel.flexible.bases import Basis
from nivel.flexible.free_body import FreeBody
from nivel.flexible.model import Array
from nivel.flexible.model_file import Located
from nivel.flexible.place_expression import PLACES, PlaceError, place_function

STEP: Final = 1e-6  # of the size of the body: differences for the turn of nodes


def given_modes(body: FreeBody, located: Located) -> Basis:
    """The basis of the shapes of a model file, (N, k); orthonormalised later like any other.

    Expressions are of the undeformed place x, y, z [m]. Nodes with turns get half the curl of the displacement, by
    central differences. A table (.csv) has the columns node, mode, x, y, z and, if nodes turn, rx, ry, rz; `.npy` is an
    array (modes, nodes, 3 or 6) in the order of the nodes.

    Raises ModelError.
    """
    shapes = located.record.reduction.shapes
    motions = _from_file(body, located, shapes) if isinstance(shapes, str) else _from_expressions(body, located)
    model = body.model
    vectors = np.zeros((model.expansion.shape[0], len(motions)))
    has = model.freedoms >= 0
    for k, motion in enumerate(motions):
        vectors[model.freedoms[has], k] = motion[has]
    vectors = vectors[model.independent]
    empty = [k for k in range(len(motions)) if not np.any(vectors[:, k])]
    if empty:
        place = ("reduction", "shapes") if isinstance(shapes, str) else ("reduction", "shapes", empty[0])
        raise ModelError(located.fault(place, f"shape {empty[0] + 1} is zero at every node"))
    return Basis(vectors, len(motions), np.zeros(0))


def _from_expressions(body: FreeBody, located: Located) -> list[Array]:
    motions, faults = [], []
    for at, shape in enumerate(located.record.reduction.shapes):
        functions = []
        for axis in PLACES:
            try:
                functions.append(place_function(getattr(shape, axis), located.parameters))
            except PlaceError as error:
                faults.append(located.fault(("reduction", "shapes", at, axis), str(error)))
        if len(functions) == 3:
            try:
                motions.append(_motion(body.model.position, functions, STEP * body.model.size))
            except PlaceError as error:
                faults.append(located.fault(("reduction", "shapes", at), str(error)))
    if faults:
        raise ModelError(faults)
    return motions


def _motion(position: Array, functions: list, step: float) -> Array:
    """(n, 6) displacement and half its curl."""

    def field(x: Array) -> Array:
        return np.stack([np.broadcast_to(f(*x.T), len(x)) for f in functions], axis=1)

    slope = [(field(position + step * e) - field(position - step * e)) / (2.0 * step) for e in np.eye(3)]
    curl = [slope[1][:, 2] - slope[2][:, 1], slope[2][:, 0] - slope[0][:, 2], slope[0][:, 1] - slope[1][:, 0]]
    return np.hstack([field(position), 0.5 * np.stack(curl, axis=1)])


def _from_file(body: FreeBody, located: Located, name: str) -> list[Array]:
    path = located.beside(name)
    place = ("reduction", "shapes")
    try:
        return _from_array(body, path) if path.suffix == ".npy" else _from_table(body, path)
    except FileNotFoundError:
        raise ModelError(located.fault(place, f"there is no file `{path}`")) from None
    except (OSError, ValueError) as error:
        raise ModelError(located.fault(place, f"`{path}`: {error}")) from None


def _from_array(body: FreeBody, path: Path) -> list[Array]:
    data = np.load(path, allow_pickle=False)
    nodes = len(body.model.position)
    if data.ndim != 3 or data.shape[1] != nodes or data.shape[2] not in (3, 6):
        raise ValueError(f"an array (modes, {nodes} nodes, 3 or 6) was expected, got {data.shape}")
    return [np.hstack([shape, np.zeros((nodes, 6 - shape.shape[1]))]) for shape in data.astype(float)]


def _from_table(body: FreeBody, path: Path) -> list[Array]:
    at = {int(number): k for k, number in enumerate(body.model.node_ids)}
    motions: dict[int, Array] = {}
    with path.open(encoding="utf-8", newline="") as file:
        for line, row in enumerate(csv.DictReader(file), start=2):
            try:
                node, mode = int(row["node"]), int(row["mode"])
                values = [float(row.get(axis) or 0.0) for axis in ("x", "y", "z", "rx", "ry", "rz")]
            except (KeyError, TypeError, ValueError):
                raise ValueError(f"line {line}: the columns node, mode, x, y, z were expected") from None
            if node not in at:
                raise ValueError(f"line {line}: there is no node {node}")
            motions.setdefault(mode, np.zeros((len(at), 6)))[at[node]] = values
    return [motions[mode] for mode in sorted(motions)]
