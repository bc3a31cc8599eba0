"""The arrays of a spanning tree, still without numbers."""

from __future__ import annotations

import numpy as np

from nivel.kernels.record.record import NONE, Constraints, Tree


def empty_tree(
    constraints: Constraints,
    nodes: int = 0,
    columns: int = 0,
    positions: int = 0,
    bundle: int = 0,
    bodies: int = 0,
    sliders: int = 0,
) -> Tree:
    """Work arrays for a tree of so many nodes, columns, positions, rows in its largest bundle, bodies (with the ground and frames at
    interfaces), sliders on beams; tables are empty."""
    empty = np.zeros(0, dtype=np.uint32)
    return Tree(
        node=empty.reshape(0, 6),
        place=empty.reshape(0, 2),
        number=np.zeros((nodes, 7)),
        first=np.zeros((nodes, 3, 3)),
        marker=empty,
        turning=empty,
        rows=constraints,
        carried=empty.reshape(0, 2),
        reaction=empty.reshape(0, 3),
        part=empty.reshape(0, 4),
        part_start=empty,
        path=empty.reshape(0, 2),
        path_start=empty,
        row_blocks=empty,
        bundle=np.zeros(1, dtype=np.uint32),
        counted=empty.reshape(0, 2),
        turn=np.zeros((0, 2)),
        slider=empty.reshape(0, 2),
        slider_of=empty,
        theta=np.zeros((nodes, 4)),
        own=np.zeros((nodes, 3)),
        own_theta=np.zeros((nodes, 4)),
        size=np.ones(1),
        positions=np.array([positions], dtype=np.uint32),
        axes=np.zeros((3, 3)),
        arm=np.zeros((bodies, 3)),
        alpha0=np.zeros((bodies, 3)),
        Rddot0=np.zeros((bodies, 3)),
        column=np.zeros((columns, 6)),
        element=np.full((sliders, 2), NONE, dtype=np.uint32),
        frame=np.zeros((sliders, 28)),
        jump=np.zeros((sliders, 6)),
        before=np.zeros((sliders, 12)),
        inertia=np.zeros((bodies, 27)),
        U=np.zeros((columns, 6)),
        Dinv=np.zeros(columns),
        root=np.zeros(columns),
        wrench=np.zeros((bodies, 6)),
        load=np.zeros((bundle, bodies, 6)),
        delta=np.zeros((bodies, 6)),
        state=np.zeros(positions),
        change=np.zeros(columns),
        moved=np.zeros(positions),
        small=np.zeros((6, 7)),
    )
