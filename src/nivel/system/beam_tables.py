"""Tables of beams: the mass that their nodes and points have in common; and for derivatives by hand which unknowns move an element, and
where what they do stands in the matrix."""

from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from nivel.kernels.record.beam_record import BeamTangent, PointInertia, SharedMass
from nivel.kernels.record.hook import FAMILIES
from nivel.kernels.record.record import FREE, NONE, Record
from nivel.kernels.tree.joints import BY_ADDRESS
from nivel.known import Beam
from nivel.lazy import nivel
from nivel.system.builder import SystemBuilder
from nivel.system.elimination.factor_plan import TangentPlan
from nivel.system.system import System
from nivel.system.tables import empty, index_array

ELASTIC = "nivel.elements.beams.exact:apply_elastic.code"
MOST_VECTORS = 8  # of an element with gradients
Index = NDArray[np.integer]


def elastic_family(record: Record) -> int:
    """Number of the family of elements without damping among the families of forces; -1: there are none."""
    families = [FAMILIES[int(address)].code.name for address in record.elements.address]
    return families.index(ELASTIC) if ELASTIC in families else -1


def has_elastic_beams(record: Record) -> bool:
    """Whether the machine has elements without damping."""
    return elastic_family(record) >= 0


def rail_of(record: Record, n: int) -> tuple[int, ...]:
    """The nodes of the beam along which the body of node n of the tree slides, as bodies; none where it does not."""
    if not len(record.tree.slider) or record.tree.slider_of[n] == NONE:
        return ()
    along = int(record.tree.slider[record.tree.slider_of[n], 1])
    first, last = record.coordinates.start[along : along + 2].astype(int)
    return tuple(record.markers.body[record.coordinates.part_marker[first + 1 : last]].tolist())


def has_carried_nodes(record: Record) -> bool:
    """Whether an element without damping has a node that is moved by modes of a flexible body, or by a beam along which it, or what carries
    it, slides."""
    if not has_elastic_beams(record):
        return False
    carried: set[int] = set()
    for child, parent, kind in record.tree.node[:, :3].tolist():
        if parent in carried or FREE < kind < BY_ADDRESS:
            carried.add(child)
    return any(body in carried for nodes in _nodes(record) for body in record.markers.body[nodes].tolist())


def plain_nodes(system: System, part: Index) -> dict[int, int]:
    """Bodies that nothing but such elements takes hold of, and their groups of unknowns. part : of all rows, as in `Residual`."""
    record = system.record
    own = Counter(frozenset(record.markers.body[nodes].tolist()) for nodes in _nodes(record))
    others = Counter(each.bodies for each in system.coupled) - own
    touched = {body for bodies in others for body in bodies} | set(part[:, 3].tolist())
    bodies = {body for nodes in own for body in nodes} - touched
    bodies = {body for body in bodies if not record.bodies.centre_b[body].any()}
    tree = record.tree.node.tolist()
    if not tree:
        return {body: body for body in sorted(bodies)}
    carrying = {parent for _, parent, *_ in tree} | {body for n in range(len(tree)) for body in rail_of(record, n)}
    ground = system.body_count
    free = {child: k for k, (child, parent, kind, *_) in enumerate(tree) if kind == FREE and parent == ground}
    return {body: free[body] for body in sorted(bodies) if body in free and body not in carrying}


def _nodes(record: Record) -> list[list[int]]:
    """Markers of the nodes of each element without damping."""
    first, last = record.elements.span[elastic_family(record)]
    count = nivel.elements.beams.exact.ElementRow.COUNT
    return [row[: row[count]] for row in record.elements.columns[first:last].tolist()]


def tangent_tables(record: Record, plan: TangentPlan, plain: Mapping[int, int]) -> BeamTangent:
    """For the matrix planned and the plain nodes."""
    elements = _nodes(record)
    tree = record.tree.node.tolist()
    branch = {child: (parent, first, last) for child, parent, _, _, first, last in tree}
    unknown: list[tuple[int, int, int, int]] = []
    start, rows, columns, place_start = [0], [], [], []
    count = 0
    for nodes in elements:
        bodies = record.markers.body[nodes].tolist()
        moved: dict[int, list[int]] = {}
        for a, body in enumerate(bodies):
            for j, mover in _movers(branch, body):
                moved.setdefault(j, [mover, 0])[1] |= 1 << a
        own = np.array(list(moved), dtype=np.int64)
        for j, (mover, nodes_moved) in moved.items():
            unknown.append((j, mover, nodes_moved, bodies.index(mover) if mover in plain else NONE))
        rows.append(np.repeat(own, len(own)))
        columns.append(np.tile(own, len(own)))
        place_start.append(count)
        count += len(own) ** 2
        start.append(len(unknown))
    place = plan.factor.entry(np.concatenate(rows), np.concatenate(columns))
    pairs = {tuple(pair): k for k, pair in reversed(list(enumerate(record.shared.pair[:, 2:].tolist())))}
    spans = []
    for nodes in elements:
        first = pairs.get((nodes[0], nodes[1]), NONE)
        spans.append((first, first + len(nodes) * (len(nodes) - 1) // 2) if first != NONE else (0, 0))
    return empty_tangent(len(elements), int(np.diff(start).max()))._replace(
        first=index_array([record.elements.span[elastic_family(record), 0]], 1),
        start=index_array(start, 1),
        unknown=index_array(unknown, 4),
        place_start=index_array(place_start, 1),
        place=place,
        pair=index_array(spans, 2),
        plain=_plain_table(branch, plan, plain),
    )


def _movers(branch: Mapping[int, tuple[int, int, int]], body: int) -> list[tuple[int, int]]:
    """Unknowns that move a body, with the body that each of them moves first."""
    if not branch:
        return [(6 * body + i, body) for i in range(6)]
    out: list[tuple[int, int]] = []
    while body in branch:
        parent, first, last = branch[body]
        out += [(j, body) for j in range(first, last)]
        body = parent
    return out


def _plain_table(branch: Mapping[int, tuple[int, int, int]], plan: TangentPlan, plain: Mapping[int, int]) -> Index:
    firsts = [branch[body][1] if branch else 6 * body for body in plain]
    at = np.array(firsts, dtype=np.int64).reshape(-1, 1)
    places = plan.factor.entry(at + np.arange(6), at) if firsts else np.zeros((0, 6))
    table = np.column_stack([np.array(list(plain), dtype=np.int64).reshape(-1, 1), at, places])
    return np.ascontiguousarray(table.astype(np.uint32).reshape(-1, 8))


def no_tangent() -> BeamTangent:
    """For machines whose derivatives are found otherwise: all arrays empty."""
    return empty(BeamTangent)


def empty_tangent(elements: int, unknowns: int) -> BeamTangent:
    """Room for so many elements, and unknowns of one at most; tables are empty."""
    none, most = index_array([], 1), nivel.elements.beams.exact.MOST
    return BeamTangent(
        wrench=np.zeros((elements, 6 * most)),
        first=np.zeros(1, dtype=np.uint32),
        start=np.zeros(1, dtype=np.uint32),
        unknown=index_array([], 4),
        place_start=none,
        place=none,
        pair=index_array([], 2),
        plain=index_array([], 8),
        S=np.zeros((9, 9)),
        B=np.zeros((6, 9)),
        k=np.zeros((18, 18)),
        P=np.zeros(18),
        twist=np.zeros((unknowns, 6 * most)),
        change=np.zeros((most, 6)),
        local=np.zeros(36),
        psi=np.zeros((most, 3)),
    )


def shared_mass(builder: SystemBuilder, beams: Sequence[Beam]) -> SharedMass:
    """What the nodes of beams with consistent mass have in common."""
    pairs, mass, moment, turn = [], [np.zeros(0)], [np.zeros((0, 3, 3))], [np.zeros((0, 3, 3))]
    for beam in beams:
        if beam.model == "geometrically-exact" and beam.shares_mass:
            own = nivel.elements.beams.exact.masses_of(beam)
            ends = np.array([(builder.body(name), builder.frame(name)) for name in beam.node_names])
            pairs += ends[own.pairs].transpose(0, 2, 1).reshape(-1, 4).tolist()
            mass.append(own.shared)
            moment.append(own.moment)
            turn.append(own.turn)
    return SharedMass(index_array(pairs, 4), np.concatenate(mass), np.concatenate(moment), np.concatenate(turn))


def point_inertia(builder: SystemBuilder, beams: Sequence[Beam]) -> PointInertia:
    """The mass that the points of beams in absolute nodal coordinates have in common."""
    markers, matrices = [], [np.zeros((0, MOST_VECTORS, MOST_VECTORS))]
    for beam in beams:
        if not beam.has_gradients:
            continue
        gradients = nivel.elements.beams.gradients
        width = gradients.vectors_of_node(beam)
        T = np.kron(np.eye(2), gradients.as_points(width, gradients.reach_of(beam)))
        points = gradients.points_of(builder, beam)
        for e, length in enumerate(gradients.lengths_of(beam).tolist()):
            first, second = gradients.lumped_mass(beam, length)
            rest = gradients.consistent_mass(beam, length)
            rest[:width, :width] -= first
            rest[width:, width:] -= second
            matrix = np.zeros((1, MOST_VECTORS, MOST_VECTORS))
            matrix[0, : 2 * width, : 2 * width] = T.T @ rest @ T
            matrices.append(matrix)
            own = [*points[e], *points[e + 1]]
            markers.append(own + [NONE] * (MOST_VECTORS - len(own)))
    return PointInertia(index_array(markers, MOST_VECTORS), np.concatenate(matrices))
