"""Nodes of interfaces: by name or number, or on a surface."""

from collections.abc import Mapping
from difflib import get_close_matches
from typing import Final

import numpy as np

from nivel.errors import Fault
from nivel.flexible.model.model import Array, FiniteElementModel, Whole
from nivel.flexible.model.model_file import Located
from nivel.flexible.model.records import InterfaceRecord

FLAT: Final = 1e-6  # of the size of the body: how far a node may be from the plane on which it is
ROUND: Final = 1e-3  # of the radius: the same for cylinders

NodeSets = Mapping[str, Whole]  # places of nodes by the name of the set


def chosen_nodes(
    model: FiniteElementModel, sets: NodeSets, located: Located, name: str, record: InterfaceRecord
) -> Whole | Fault:
    """Places of the nodes of the interface `name`; a fault where there are none.

    Of several nodes, those that follow others are replaced by what they stand for: a node of shells by its nodes through the thickness.
    """
    found = _chosen(model, sets, located, name, record)
    if isinstance(found, Fault) or record.node is not None or not model.stands_for:
        return found
    return np.unique([own for node in found.tolist() for own in model.stands_for.get(node, (node,))]).astype(np.int64)


def _chosen(
    model: FiniteElementModel, sets: NodeSets, located: Located, name: str, record: InterfaceRecord
) -> Whole | Fault:
    place = ("interfaces", name)
    if record.node is not None:
        found = _by_word(model, record.node)
        return found if isinstance(found, np.ndarray) else located.fault((*place, "node"), found)
    if record.nodes is not None:
        missing = [number for number in record.nodes if number not in set(model.node_ids.tolist())]
        if missing:
            return located.fault((*place, "nodes"), _no_nodes(model, missing))
        return np.flatnonzero(np.isin(model.node_ids, record.nodes))
    if record.set is not None:
        if record.set.upper() not in sets:
            near = get_close_matches(record.set.upper(), sets, n=1)
            hint = f"did you mean `{near[0]}`?" if near else f"there {'are ' + ', '.join(sets) if sets else 'are none'}"
            return located.fault((*place, "set"), f"the mesh has no node set `{record.set}`; {hint}")
        nodes = sets[record.set.upper()]
    else:
        distance, tolerance, key = _distance(model, record)
        nodes = np.flatnonzero(distance <= (record.tolerance or tolerance))
        if not len(nodes):
            nearest = model.node_ids[int(np.argmin(distance))]
            message = f"no node is there; the nearest is node {nearest}, {distance.min():.3g} m away"
            return located.fault((*place, key), f"{message}; move the {key}, or give a `tolerance`")
    if record.within is not None:
        inside = _outside(model.position[nodes], record.within.from_, record.within.to) <= FLAT * model.size
        nodes = nodes[inside]
        if not len(nodes):
            return located.fault((*place, "within"), "none of the nodes of this interface is in this box")
    return nodes


def _by_word(model: FiniteElementModel, word: str | int) -> Whole | str:
    if isinstance(word, str):
        if word in model.names:
            return np.array([model.names[word]])
        near = get_close_matches(word, model.names, n=1)
        hint = f"did you mean `{near[0]}`?" if near else f"there are {', '.join(model.names) or 'only numbered ones'}"
        return f"there is no node `{word}`; {hint}"
    found = np.flatnonzero(model.node_ids == word)
    return found if len(found) else _no_nodes(model, [word])


def _no_nodes(model: FiniteElementModel, missing: list[int]) -> str:
    what = (
        f"there is no node {missing[0]}"
        if len(missing) == 1
        else f"there are no nodes {', '.join(map(str, missing[:8]))}"
    )
    return f"{what}; the {len(model.node_ids)} nodes have numbers from {model.node_ids.min()} to {model.node_ids.max()}"


def _distance(model: FiniteElementModel, record: InterfaceRecord) -> tuple[Array, float, str]:
    """(n,) [m] of the nodes from the surface; what is on it; the key of the surface."""
    x = model.position
    if record.plane is not None:
        normal = np.array(record.plane.normal) / np.linalg.norm(record.plane.normal)
        return np.abs((x - record.plane.point) @ normal), FLAT * model.size, "plane"
    if record.cylinder is not None:
        given = record.cylinder
        axis = np.array(given.axis) / np.linalg.norm(given.axis)
        along = (x - given.point) @ axis
        across = np.linalg.norm(x - given.point - along[:, None] * axis, axis=1)
        distance = np.abs(across - given.radius)
        if given.between is not None:
            low, high = min(given.between), max(given.between)
            distance = np.hypot(distance, np.maximum(np.maximum(low - along, along - high), 0.0))
        return distance, ROUND * given.radius, "cylinder"
    assert record.box is not None
    return _outside(x, record.box.from_, record.box.to), FLAT * model.size, "box"


def _outside(x: Array, first: tuple[float, ...], second: tuple[float, ...]) -> Array:
    """(n,) [m] distance from a box."""
    low, high = np.minimum(first, second), np.maximum(first, second)
    return np.linalg.norm(np.maximum(np.maximum(low - x, x - high), 0.0), axis=1)
