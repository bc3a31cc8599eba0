"""Assumed mode shapes that the user gives: expressions of the place, or a table of nodal displacements."""

import csv
from collections.abc import Callable
from pathlib import Path
from typing import Final

import numpy as np

from nivel.errors import ModelError, refuse
from nivel.flexible.body.invariants import LEVI_CIVITA
from nivel.flexible.model.model import AXES, Array, FiniteElementModel
from nivel.flexible.model.model_file import Located
from nivel.flexible.reduction.bases import NEXT, Basis, attachments
from nivel.flexible.reduction.factor import Whole
from nivel.flexible.reduction.free_body import FreeBody
from nivel.machine.units.arithmetic import bind, evaluate
from nivel.machine.units.grammar import parse
from nivel.machine.units.tree import ExpressionError, FaultyParameterError, Parameters

PLACES: Final = ("x", "y", "z")

PlaceFunction = Callable[[Array, Array, Array], Array]


class PlaceError(ValueError):
    """The expression cannot be used; the message says why."""


def place_function(given: str | float, parameters: Parameters) -> PlaceFunction:
    """The function of x, y, z [m], arrays (n,), that `given` says: a number or an expression such as ``(x/2)^2``.

    Raises PlaceError.
    """
    if isinstance(given, int | float):
        return lambda x, _y, _z: np.full(len(x), float(given))
    try:
        tree = bind(parse(given), parameters, PLACES)
    except FaultyParameterError:
        raise PlaceError("a parameter in it is at fault") from None
    except ExpressionError as error:
        raise PlaceError(f"`{given}`: {error}") from None

    def function(x: Array, y: Array, z: Array) -> Array:
        try:
            return np.array([evaluate(tree, values={"x": a, "y": b, "z": c}) for a, b, c in zip(x, y, z, strict=True)])
        except ExpressionError as error:
            raise PlaceError(f"`{given}`: {error}") from None

    return function


STEP: Final = 1e-6  # of the size of the body: differences for the turn of nodes


def given_modes(body: FreeBody, boundary: Whole, located: Located) -> Basis:
    """The basis of the shapes of a model file, (N, k); orthonormalised later like any other.

    Expressions are of the undeformed place x, y, z [m]; turns that are not given follow from them by central differences.
    A table (.csv) has the columns node, mode, x, y, z and, if nodes turn, rx, ry, rz; `.npy` is an array
    (modes, nodes, 3 or 6) in the order of the nodes. Left out are the lowest normal modes and the answers to loads on the `boundary`
    freedoms, as far as the shapes do not span them.

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
    left = np.hstack([body.elastic_modes(NEXT)[1], attachments(body, boundary)[0]])
    return Basis(vectors, len(motions), np.zeros(0), left)


def _from_expressions(body: FreeBody, located: Located) -> list[Array]:
    motions, faults = [], []
    for at, shape in enumerate(located.record.reduction.shapes):
        functions: list[PlaceFunction | None] = []
        for axis in AXES:
            try:
                given = getattr(shape, axis)
                functions.append(None if given is None else place_function(given, located.parameters))
            except PlaceError as error:
                faults.append(located.fault(("reduction", "shapes", at, axis), str(error)))
        if len(functions) == 6:
            try:
                motions.append(_motion(body.model, functions))
            except PlaceError as error:
                faults.append(located.fault(("reduction", "shapes", at), str(error)))
    refuse(faults)
    return motions


def _motion(model: FiniteElementModel, functions: list[PlaceFunction | None]) -> Array:
    """(n, 6) displacement and turn at the nodes.

    A turn that is not given is half the curl of the displacement. At nodes of beams, for which the displacement is that of the
    line, only its part along the beam is; across it the turn is t × ∂u/∂s, so that sections stay perpendicular.
    """
    position, step = model.position, STEP * model.size

    def field(x: Array) -> Array:
        return np.stack([f(*x.T) for f in functions[:3] if f is not None], axis=1)

    slope = np.stack(
        [(field(position + step * e) - field(position - step * e)) / (2.0 * step) for e in np.eye(3)], axis=1
    )
    turn = 0.5 * np.einsum("abc,nbc->na", LEVI_CIVITA, slope)  # slope[n, b, c] is ∂u_c/∂x_b
    tangents, beams = _tangents(model)
    if len(beams):
        bent = np.cross(tangents, np.einsum("nb,nbc->nc", tangents, slope[beams]))
        turn[beams] = bent + np.einsum("na,nb,nb->na", tangents, tangents, turn[beams])
    for axis, function in enumerate(functions[3:]):
        if function is not None:
            turn[:, axis] = function(*position.T)
    return np.hstack([field(position), turn])


def _tangents(model: FiniteElementModel) -> tuple[Array, Whole]:
    """(k, 3) unit directions of the beams at the nodes (k,) of lines: the mean where several meet."""
    total = np.zeros_like(model.position)
    for i, j in model.lines:
        along = model.position[j] - model.position[i]
        for node in (i, j):
            total[node] += along * (1.0 if along @ total[node] >= 0.0 else -1.0)
    size = np.linalg.norm(total, axis=1)
    beams = np.flatnonzero(size > 0.0)
    return total[beams] / size[beams][:, None], beams


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
