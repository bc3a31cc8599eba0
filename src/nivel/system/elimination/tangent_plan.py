"""Derivatives that Newton's iteration of a machine needs, grouped by evaluation: done once, in Python.

Unknowns come in groups that depend on each other as a whole: velocities of a body, states of a force, rows of a joint. Groups that meet no
group in common are moved together (Curtis, Powell, Reid 1974, "On the estimation of sparse Jacobian matrices"), so the number of
evaluations does not grow with a chain.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from nivel.kernels.record.record import NONE
from nivel.lazy import dataclass
from nivel.system.elimination.factor_plan import FactorPlan, plan_factor
from nivel.system.tables import index_array

Index = NDArray[np.uint32]


@dataclass(frozen=True)
class TangentPlan:
    """The factors of the matrix, those of the stages of a step as one system where they were asked for, and `group`, `group_start`,
    `entry_start`, `entry` of `nivel.kernels.record.implicit_record.Newton`."""

    factor: FactorPlan
    coupled: FactorPlan | None
    group: Index
    group_start: Index
    entry_start: Index
    entry: Index


def plan_tangent(
    sizes: Sequence[int],
    constraint: Sequence[bool],
    couples: Iterable[tuple[int, int]],
    *,
    mirrored: bool,
    found: Collection[int] = (),
    alone: Collection[int] = (),
    stages: int = 0,
) -> TangentPlan:
    """For groups of so many unknowns, of constraints or not, that are coupled in pairs.

    mirrored : derivatives with respect to multipliers are those of the constraints, so they are not found by evaluations of their own.
    found : groups whose derivatives are found otherwise; their entries are in the plan all the same.
    alone : groups that nothing depends on, moved apart from all others: on what they depend is not in `couples`.
    stages : of a step, which are planned as one system too; 0: they are not.
    Arrays of a plan are only read: machines of one structure share them.
    """
    pairs = frozenset((a, b) for a, b in couples if a != b)
    return _planned(tuple(sizes), tuple(constraint), pairs, mirrored, frozenset(found), frozenset(alone), stages)


@lru_cache(maxsize=8)
def _planned(
    sizes: tuple[int, ...],
    constraint: tuple[bool, ...],
    pairs: frozenset[tuple[int, int]],
    mirrored: bool,
    found: frozenset[int],
    alone: frozenset[int],
    stages: int,
) -> TangentPlan:
    beside = [{g} for g in range(len(sizes))]
    for a, b in pairs:
        beside[a].add(b)
        beside[b].add(a)
    factor = plan_factor(sizes, constraint, pairs)
    first = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)
    moved = [g for g in range(len(sizes)) if not (mirrored and constraint[g])]
    groups = [
        [int(first[g]) + k for g in together if k < sizes[g]]
        for together in (
            *_together([g for g in moved if g not in found and g not in alone], beside),
            *([sorted(alone)] if alone else []),
        )
        for k in range(max(sizes[g] for g in together))
    ]
    rows, columns, copied = [], [], []
    for g in moved:
        for other in sorted(beside[g]):
            row, column = np.meshgrid(
                np.arange(first[other], first[other + 1]), np.arange(first[g], first[g + 1]), indexing="ij"
            )
            rows.append(row.ravel())
            columns.append(column.ravel())
            copied.append(np.full(row.size, mirrored and constraint[other]))
    row, column, mirror = (
        np.concatenate(each) if each else np.zeros(0, dtype=np.int64) for each in (rows, columns, copied)
    )
    order = np.argsort(column, kind="stable")
    row, column, mirror = row[order], column[order], mirror[order].astype(bool)
    transposed = np.full(len(row), NONE, dtype=np.uint32)
    transposed[mirror] = factor.entry(column[mirror], row[mirror])
    return TangentPlan(
        factor=factor,
        coupled=plan_factor([stages * size for size in sizes], constraint, pairs) if stages else None,
        group=index_array([unknown for group in groups for unknown in group], 1),
        group_start=np.cumsum([0, *(len(group) for group in groups)]).astype(np.uint32),
        entry_start=np.searchsorted(column, np.arange(factor.size + 1)).astype(np.uint32),
        entry=np.column_stack([row.astype(np.uint32), factor.entry(row, column), transposed]).reshape(-1, 3),
    )


def _together(groups: Sequence[int], beside: Sequence[set[int]]) -> list[list[int]]:
    """The groups in classes without a common neighbour, each as early as it fits."""
    classes: list[list[int]] = []
    meeting: list[set[int]] = [set() for _ in beside]  # classes that have a group next to each group
    for g in groups:
        used = set().union(*(meeting[other] for other in beside[g]))
        k = next(k for k in range(len(classes) + 1) if k not in used)
        if k == len(classes):
            classes.append([])
        classes[k].append(g)
        for other in beside[g]:
            meeting[other].add(k)
    return classes
