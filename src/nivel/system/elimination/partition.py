"""Arrays of coordinate partitioning."""

from collections.abc import Sequence

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.kernels.record.record import Partition
from nivel.kernels.solve.partition import GROWTH, GROWTH_OF_FORMULAS
from nivel.system.tables import Array, zeros
from nivel.words.wording import unknown_word

NO_MODES = np.zeros(0)
# Velocities that are wanted as independent ones are measured in this share of their units: pivots, whose columns are the dependent ones,
# are found among the others unless these are this much smaller.
RELUCTANCE = 0.01
DIRECTIONS = ("x", "y", "z", "about_x", "about_y", "about_z")
PARAMETERS = ("x", "y", "z", "theta_0", "theta_1", "theta_2", "theta_3")


def no_partition() -> Partition:
    """For coordinates that are not partitioned: all arrays empty."""
    return partition(0, 0, 0, 1.0)


def velocities_named(names: Sequence[str], bodies: Sequence[str], ways: Sequence[str] = DIRECTIONS) -> list[int]:
    """Numbers of the velocities `BODY.x` … `BODY.about_z`: of the origin along global axes, angular about axes of the body; or in
    PARAMETERS, rates of Euler parameters.

    Raises ModelError with every name that says no velocity.
    """
    known = {f"{body}.{way}": len(ways) * b + i for b, body in enumerate(bodies) for i, way in enumerate(ways)}
    unknown = [name for name in names if name not in known]
    if unknown:
        raise ModelError([Fault.at("simulation.independent", _no_velocity(name, bodies, ways)) for name in unknown])
    return [known[name] for name in names]


def _no_velocity(name: str, bodies: Sequence[str], ways: Sequence[str]) -> str:
    body, _, way = name.rpartition(".")
    if body in bodies:
        return f"`{name}`: {unknown_word(way, ways, 'velocity')}"
    return f"`{name}` names no velocity of a body: {unknown_word(body or name, bodies, 'body')}; write e.g. `{bodies[0]}.{ways[-1]}`"


def refuse_dependent(chosen: Partition, wanted: Sequence[str], bodies: Sequence[str], ways: Sequence[str]) -> None:
    """Refuse `wanted` velocities that cannot all be independent in the state last evaluated."""
    free = len(chosen.B)
    if len(wanted) > free:
        message = f"{len(wanted)} velocities are named, and the machine has {free} {'degree' if free == 1 else 'degrees'} of freedom"
        raise ModelError(Fault.at("simulation.independent", message))
    independent = set(chosen.column[len(chosen.column) - free :].tolist())
    lost = [
        name for name, k in zip(wanted, velocities_named(wanted, bodies, ways), strict=True) if k not in independent
    ]
    if lost:
        message = (
            f"{', '.join(f'`{name}`' for name in lost)} follows from the constraints{' and the others' if len(wanted) > 1 else ''} at "
            f"the start, so it cannot be independent: name another velocity"
        )
        raise ModelError(Fault.at("simulation.independent", message))


def partition(
    bodies: int, rows: int, rank: int, size: float, modal: Array = NO_MODES, wanted: Sequence[int] = (), turns: int = 3
) -> Partition:
    """For the velocities Ṙ and `turns` of rotation of each body, `rank` independent ones of `rows` rows and a machine of the length `size`
    [m]; none chosen yet.

    modal : (m,) what modal velocities behind them are measured in [kg^½ m]. wanted : velocities to be independent where they can.
    """
    n = (3 + turns) * bodies + len(modal)
    free = n - rank
    unit = np.concatenate([np.tile([size] * 3 + [1.0] * turns, bodies), modal])
    unit[list(wanted)] *= RELUCTANCE
    return Partition(
        unit=unit,
        column=np.arange(n, dtype=np.uint32),
        row=np.arange(rows, dtype=np.uint32),
        choices=np.zeros(1, dtype=np.uint32),
        quality=np.array([0.0, 0.0, GROWTH]),
        column_place=np.zeros(n, dtype=np.uint32),
        row_place=np.zeros(rows, dtype=np.uint32),
        **zeros("scale weight b", rows),
        E=np.zeros((rows, n)),
        null=np.zeros((rows - rank, rows)),
        **zeros("B MB", free, n),
        H=np.zeros((free, free)),
        u=np.zeros(free),
        **zeros("D Q v p", n),
    )


def forget(chosen: Partition, *, formulas: bool = False) -> None:
    """As it was built: the next evaluation chooses. formulas : for a method whose formulas hold for the independent velocities alone."""
    chosen.quality[2] = GROWTH_OF_FORMULAS if formulas else GROWTH
    for order in (chosen.column, chosen.row):
        order[:] = np.arange(len(order))
    chosen.choices[:] = 0
