"""Pattern and work arrays of the saddle-point system, with the rows of frictions behind those of constraints."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.kernels.elements.friction import LEVER, WAY
from nivel.kernels.record.record import NONE, Friction, Saddle
from nivel.system.builder import SystemBuilder
from nivel.system.elimination.elimination import plan
from nivel.system.joint_rows import RowTable
from nivel.system.system import Equations
from nivel.system.tables import index_array, padded, zeros

Index = NDArray[np.uint32]
# entries of the rows of frictions
COLUMNS: Final = WAY + 1
NUMBERS: Final = LEVER + 1


def friction_parts(builder: SystemBuilder, rows: RowTable, row_count: int) -> list[tuple[int, int, int]]:
    """(row, part, marker) of the parts of the extra rows of friction, behind all others."""
    parts: list[tuple[int, int, int]] = []
    for k, (index, _) in enumerate(builder.frictions):
        for marker in builder.coordinates.markers(index[0]):
            parts.append((row_count + k, len(rows.part_row) + len(parts), marker))
    return parts


def saddle_tables(
    rows: RowTable,
    builder: SystemBuilder,
    extra: list[tuple[int, int, int]],
    bodies: int,
    row_count: int,
    equations: Equations,
) -> Saddle:
    """Pattern and work arrays of the saddle-point system. The ground has no blocks; a normalisation block has no part."""
    own = list(zip(rows.part_row, range(len(rows.part_row)), rows.part_marker, strict=True))
    body_of = builder.markers.body
    blocks = [(row, part, marker, body_of[marker]) for row, part, marker in own if body_of[marker] != bodies]
    if equations.normalisation:
        blocks += [(len(rows.names) + body, NONE, 0, body) for body in range(bodies)]
    count = len(blocks)
    blocks += [(row, part, marker, body_of[marker]) for row, part, marker in extra if body_of[marker] != bodies]
    block = index_array(blocks, 4)
    row = np.arange(row_count, dtype=np.uint32)
    return solver_tables(row, block, count, _groups(rows, row_count), equations.velocities, bodies, bodies)


def solver_tables(
    row: Index, block: Index, count: int, groups: Sequence[Sequence[int]], width: int, factors: int, unknowns: int
) -> Saddle:
    """Pattern and work arrays for these rows of the constraints, and blocks of which the first `count` are theirs.

    groups : rows that are eliminated together. width : columns of a block. factors : bodies with a factor of their own. unknowns : rows
    of z.
    """
    elimination = plan(groups, block[:count, 0].tolist(), block[:count, 3].tolist())
    return Saddle(
        row=row,
        block=block,
        blocks=np.array([count], dtype=np.uint32),
        **vars(elimination),
        **zeros("shift least Dinv y b target before", len(row)),
        W=np.zeros((len(block), width)),
        G=np.zeros((factors, width, width)),
        z=np.zeros((unknowns, width)),
        S=np.zeros(len(elimination.S_row)),
        L=np.zeros(len(elimination.L_row)),
        **zeros("dense null", 0, 0),
        pivot=np.zeros(0, dtype=np.uint32),
    )


def _groups(rows: RowTable, row_count: int) -> list[list[int]]:
    """Rows that are eliminated together: those of a joint; all others one by one."""
    groups = [list(range(a, b)) for a, b in rows.spans if b > a]
    last = rows.spans[-1][1] if rows.spans else 0
    return groups + [[row] for row in range(last, row_count)]


def friction_tables(
    builder: SystemBuilder, saddle: Saddle, extra: list[tuple[int, int, int]], row_count: int
) -> Friction:
    count = len(builder.frictions)
    of_row = saddle.block[:, 0]
    first = [
        int(np.searchsorted(of_row[saddle.blocks[0] :], row_count + k) + saddle.blocks[0]) for k in range(count + 1)
    ]
    return Friction(
        columns=padded([_filled(index, COLUMNS, NONE) for index, _ in builder.frictions], NONE).astype(np.uint32),
        number=padded([_filled(numbers, NUMBERS, 0.0) for _, numbers in builder.frictions], 0.0),
        part=index_array([min(part for row, part, _ in extra if row == row_count + k) for k in range(count)], 1),
        block=index_array(list(pairwise(first)), 2),
        **zeros("force free anchor", count),
        mass=np.ones(count),
        **zeros("S jacobian", count, count),
        response=np.zeros((count, row_count)),
        change=np.zeros((count, *saddle.z.shape)),
        lam=np.zeros(row_count),
        work=np.zeros((11, count)),
    )


def _filled(row: list[Any], count: int, fill: float) -> list[Any]:
    """A row with as many entries as the kernel reads."""
    return [*row, *[fill] * (count - len(row))]


def moved_masses(builder: SystemBuilder, mass: NDArray[np.float64]) -> NDArray[np.float64]:
    """(X,) [kg] mass of the lighter of the bodies of each friction, which its effort moves until the equations of motion know better."""
    ends = [
        {builder.markers.body[end] for end in builder.coordinates.markers(index[0])} for index, _ in builder.frictions
    ]
    return np.array([min((mass[body] for body in each if body < len(mass)), default=1.0) for each in ends], dtype=float)
