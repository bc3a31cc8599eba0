"""Surfaces tied to a reference node, rigidly (RBE2) or by average (RBE3), by eliminating freedoms."""

from typing import Final

import numpy as np
import scipy.linalg as la
import scipy.sparse as sp

from nivel.errors import Fault, refuse
from nivel.flexible.model.model import Array, FiniteElementModel, Sparse, Whole, numbered, rigid_modes
from nivel.flexible.model.model_file import Located
from nivel.flexible.model.records import InterfaceRecord
from nivel.flexible.model.selection import NodeSets, chosen_nodes
from nivel.flexible.reduction.factor import pivots
from nivel.lazy import Struct

FLAT: Final = 1e-9  # the nodes of a surface must spread in two directions at least by this share of its size


class Attachment(Struct):
    """An interface of the model: `node` is its place among the nodes; `tied` are the nodes that it stands for, if any."""

    name: str
    node: int
    tied: Whole


def with_interfaces(
    model: FiniteElementModel, located: Located, sets: NodeSets
) -> tuple[FiniteElementModel, tuple[Attachment, ...]]:
    """The model with the reference nodes of the interfaces of its file, and these.

    A reference node has six freedoms. `rigid`: the nodes of the surface follow it as one solid. `average`: it moves as
    the rigid motion that fits the displacements of the surface best (least squares, every node the same weight), so that
    forces on it are shared and the surface stays soft; six freedoms of the surface are eliminated for its own.

    Raises ModelError with all faults.
    """
    faults: list[Fault] = []
    attachments: list[Attachment] = []
    references: list[Array] = []
    owner: dict[int, str] = {}
    for name, record in located.record.interfaces.items():
        nodes = chosen_nodes(model, sets, located, name, record)
        if isinstance(nodes, Fault):
            faults.append(nodes)
            continue
        shared = [int(node) for node in nodes if int(node) in owner]
        if shared:
            message = f"node {model.node_ids[shared[0]]} belongs to the interface `{owner[shared[0]]}` already"
            faults.append(located.fault(("interfaces", name), f"{message}; a node can be part of one interface only"))
            continue
        owner.update(dict.fromkeys(nodes.tolist(), name))
        if record.node is not None:
            attachments.append(Attachment(name, int(nodes[0]), np.zeros(0, dtype=np.int64)))
            continue
        at = _middle(model, nodes, record) if record.at is None else np.array(record.at)
        problem = _too_few(model, nodes, record.tie, at)
        if problem:
            faults.append(located.fault(("interfaces", name), problem))
            continue
        attachments.append(Attachment(name, len(model.position) + len(references), nodes))
        references.append(at)
    refuse(faults)
    ties = {each.name: located.record.interfaces[each.name].tie for each in attachments if len(each.tied)}
    return _tied(model, attachments, references, ties), tuple(attachments)


def _middle(model: FiniteElementModel, nodes: Whole, record: InterfaceRecord) -> Array:
    """(3,) [m] where a reference node is if nothing else is said: on the axis of a cylinder, in the centroid of the faces of other
    surfaces, and in the mean of nodes that have no faces.
    """
    x = model.position[nodes]
    if record.cylinder is not None:
        axis = np.array(record.cylinder.axis) / np.linalg.norm(record.cylinder.axis)
        along = (x - record.cylinder.point) @ axis
        return np.array(record.cylinder.point) + 0.5 * (along.min() + along.max()) * axis
    faces = model.triangles[np.isin(model.triangles, nodes).all(axis=1)] if len(model.triangles) else model.triangles
    corners = model.position[faces]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    if not area.sum() > 0.0:
        return x.mean(axis=0)
    return area @ corners.mean(axis=1) / area.sum()


def _too_few(model: FiniteElementModel, nodes: Whole, tie: str, at: Array) -> str:
    """Why the nodes cannot be tied; empty where they can."""
    x = model.position[nodes] - model.position[nodes].mean(axis=0)
    spread = la.svdvals(x) if len(nodes) > 1 else np.zeros(3)
    turns = bool(np.all(model.freedoms[nodes, 3:] >= 0))
    if (turns and tie == "rigid") or (len(nodes) > 1 and spread[1] > FLAT * model.size):
        return ""
    return (
        f"the {len(nodes)} nodes of this interface lie on a line and cannot hold a turn of the reference node; take a surface, "
        "or a single `node`"
    )


def _tied(
    model: FiniteElementModel, attachments: list[Attachment], references: list[Array], ties: dict[str, str]
) -> FiniteElementModel:
    if not references:
        return model
    old, count = model.expansion.shape
    position = np.concatenate([model.position, np.array(references)])
    added = numbered(np.ones((len(references), 6), dtype=bool)) + old
    freedoms = np.concatenate([model.freedoms, added])
    # rows: the independent ones, then those of the references
    within = np.where(freedoms >= old, freedoms - old + count, freedoms)
    dependent: dict[int, tuple[Whole, Array]] = {}  # row → columns and values
    for each in attachments:
        if not len(each.tied):
            continue
        rows = _rigid_rows if ties[each.name] == "rigid" else _average_rows
        dependent.update(rows(position, within, each))
    independent = _expansion(count + added.size, dependent)
    own = independent[:count]
    expansion = sp.csr_array(sp.vstack([model.expansion @ own, independent[count:]]))
    return model.changed(
        node_ids=np.concatenate([model.node_ids, model.node_ids.max() + 1 + np.arange(len(references))]),
        position=position,
        freedoms=freedoms,
        stiffness=sp.csc_array(own.T @ model.stiffness @ own),
        mass=model.mass.transformed(sp.csr_array(own)),
        expansion=expansion,
        names={**model.names, **{each.name: each.node for each in attachments if len(each.tied)}},
    )


def _expansion(total: int, dependent: dict[int, tuple[Whole, Array]]) -> Sparse:
    """(total, N) all freedoms from those that are not dependent."""
    kept = np.setdiff1d(np.arange(total), np.array(sorted(dependent), dtype=np.int64))
    column = np.full(total, -1)
    column[kept] = np.arange(len(kept))
    rows, columns, values = [kept], [column[kept]], [np.ones(len(kept))]
    for row, (at, value) in dependent.items():
        rows.append(np.full(len(at), row))
        columns.append(column[at])
        values.append(value)
    data = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return sp.csr_array(data, shape=(total, len(kept)))


def _rigid_rows(position: Array, freedoms: Whole, each: Attachment) -> dict[int, tuple[Whole, Array]]:
    """Every freedom of the tied nodes from the six of the reference node."""
    reference = freedoms[each.node]
    R = rigid_modes(
        position[each.tied], _compact(freedoms[each.tied]), int((freedoms[each.tied] >= 0).sum()), position[each.node]
    )
    rows = freedoms[each.tied][freedoms[each.tied] >= 0]
    return {int(row): (reference[R[k] != 0.0], R[k][R[k] != 0.0]) for k, row in enumerate(rows)}


def _compact(freedoms: Whole) -> Whole:
    return numbered(freedoms >= 0)


def _average_rows(position: Array, freedoms: Whole, each: Attachment) -> dict[int, tuple[Whole, Array]]:
    """Six freedoms of the surface from the reference node and the others: u_ref = W u solved for those six."""
    surface = freedoms[each.tied].copy()
    surface[:, 3:] = -1
    rows = surface[surface >= 0]
    R = rigid_modes(position[each.tied], _compact(surface), len(rows), position[each.node])
    W = np.linalg.pinv(R)
    order = pivots(W * np.abs(R).max(axis=0)[:, None])
    taken, others = order[:6], np.sort(order[6:])
    inverse = la.inv(W[:, taken])
    columns = np.concatenate([freedoms[each.node], rows[others]])
    values = np.hstack([inverse, -inverse @ W[:, others]])
    return {int(rows[row]): (columns, values[k]) for k, row in enumerate(taken)}
