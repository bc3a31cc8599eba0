"""Arrays of coordinate partitioning."""

from __future__ import annotations

import numpy as np

from nivel.kernels.record.record import Partition
from nivel.kernels.solve.partition import GROWTH, GROWTH_OF_FORMULAS
from nivel.system.tables import Array

NO_MODES = np.zeros(0)


def no_partition() -> Partition:
    """For coordinates that are not partitioned: all arrays empty."""
    return partition(0, 0, 0, 1.0)


def partition(bodies: int, rows: int, rank: int, size: float, modal: Array = NO_MODES) -> Partition:
    """For six velocities (Ṙ, ω̄) a body, `rank` independent ones of `rows` rows and a machine of the length `size` [m]; none chosen yet.

    modal : (m,) what modal velocities behind them are measured in [kg^½ m].
    """
    n = 6 * bodies + len(modal)
    free = n - rank
    return Partition(
        unit=np.concatenate([np.tile([size, size, size, 1.0, 1.0, 1.0], bodies), modal]),
        column=np.arange(n, dtype=np.uint32),
        row=np.arange(rows, dtype=np.uint32),
        choices=np.zeros(1, dtype=np.uint32),
        quality=np.array([0.0, 0.0, GROWTH]),
        column_place=np.zeros(n, dtype=np.uint32),
        row_place=np.zeros(rows, dtype=np.uint32),
        scale=np.zeros(rows),
        weight=np.zeros(rows),
        E=np.zeros((rows, n)),
        null=np.zeros((rows - rank, rows)),
        B=np.zeros((free, n)),
        MB=np.zeros((free, n)),
        H=np.zeros((free, free)),
        u=np.zeros(free),
        D=np.zeros(n),
        Q=np.zeros(n),
        v=np.zeros(n),
        p=np.zeros(n),
        b=np.zeros(rows),
    )


def forget(chosen: Partition, *, formulas: bool = False) -> None:
    """As it was built: the next evaluation chooses. formulas : for a method whose formulas hold for the independent velocities alone."""
    chosen.quality[2] = GROWTH_OF_FORMULAS if formulas else GROWTH
    for order in (chosen.column, chosen.row):
        order[:] = np.arange(len(order))
    chosen.choices[:] = 0
