"""Arrays of implicit methods: which rows and unknowns the residual of a machine has, and which derivatives its matrix needs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from nivel.kernels.implicit_record import Newton, Residual
from nivel.kernels.record import NONE, Record
from nivel.system.system import StateMap
from nivel.system.tables import index_array

Index = NDArray[np.uint32]


def no_residual() -> Residual:
    """For explicit methods: all arrays empty."""
    return residual_tables(0, 0, 0, 0, index_array([], 1), index_array([], 4))


def no_newton() -> Newton:
    """For explicit methods: all arrays empty."""
    return newton_tables(index_array([], 2), 0, 0, 0, [], [])


def residual_tables(bodies: int, state: int, velocities: int, states: int, row: Index, part: Index) -> Residual:
    """For so many bodies, entries of y, velocities and states of forces. row, part : as in `Residual`."""
    rows = len(row)
    moving = bodies + 1 if velocities else 0
    return Residual(
        row=row,
        part=part,
        y=np.zeros(state),
        vdot=np.zeros(velocities),
        lam=np.zeros(rows),
        value=np.zeros(velocities + states + 3 * rows),
        acceleration=np.zeros((moving, 6)),
        wrench=np.zeros((moving, 6)),
    )


def parts_of(record: Record, relative: bool) -> Index:
    """(row of the saddle, part of C_q, marker, body) of all constraint rows of the saddle."""
    table = record.tree.part if relative else record.saddle.block[: int(record.saddle.blocks[0])]
    return index_array([entry for entry in table.tolist() if entry[0] < len(record.saddle.row)], 4)


def places(state_map: StateMap, velocities: int, positions: int) -> Index:
    """What each velocity moves: `Newton.place`."""
    out = np.full((velocities, 2), NONE, dtype=np.uint32)
    for place, rate in state_map.plain.tolist():
        if rate < positions + velocities:
            out[rate - positions, 0] = place
    for place, rate in state_map.turns.tolist():
        for axis in range(3):
            out[rate - positions + axis] = place, axis
    return out


def newton_tables(
    place: Index, state: int, states: int, rows: int, groups: Sequence[Sequence[int]], columns: Sequence[Sequence[int]]
) -> Newton:
    """For `place` of the velocities, entries of y, states of forces and constraint rows.

    groups : unknowns whose derivatives are found at once. columns : the rows that each of the N unknowns has derivatives in; those of
    multipliers follow from the rows of the velocities where the unknown is in no group.
    """
    n = len(place)
    size = n + states + rows
    dense = np.arange(size * size, dtype=np.uint32).reshape(size, size)
    alone = {unknown for group in groups for unknown in group}
    starts, entries = [0], []
    for j, of_column in enumerate(columns):
        for i in of_column:
            mirrored = i >= n + states and i not in alone and j < n
            entries.append((i, dense[i, j], dense[j, i] if mirrored else NONE))
        starts.append(len(entries))
    return Newton(
        address=np.zeros(2, dtype=np.uint64),
        place=place,
        group=index_array([unknown for group in groups for unknown in group], 1),
        group_start=np.cumsum([0, *(len(group) for group in groups)]).astype(np.uint32),
        entry_start=index_array(starts, 1),
        entry=index_array(entries, 3),
        column=np.tile(np.arange(size, dtype=np.uint32), size),
        row_start=(np.arange(size + 1) * size).astype(np.uint32),
        base=np.zeros(state),
        turn=np.zeros(n),
        speed=np.zeros(n),
        state=np.zeros(states),
        correction=np.zeros(n),
        rate=np.zeros(states),
        change=np.zeros(n),
        value=np.zeros(size * size),
        matrix=np.zeros((size, size)),
        pivot=np.zeros(size, dtype=np.uint32),
        b=np.zeros(size),
        last=np.zeros(size),
        moved=np.zeros(n),
        before=np.zeros(size),
        moved_before=np.zeros(n),
        lam_before=np.zeros(rows),
        kept=np.zeros(4),
        settings=np.zeros(2),
        index=np.zeros(1, dtype=np.uint32),
    )
