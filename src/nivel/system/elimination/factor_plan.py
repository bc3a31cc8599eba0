"""Order and tables of the sparse LU of a machine's tangent: done once a machine, in Python; the kernels only follow it.

Unknowns come in groups that are coupled as a whole (velocities of a body, rows of a joint, states of a force). Groups of constraints have
(nearly) nothing on their diagonal and the kernels exchange no rows, so such a group waits for others, after which its pivots are those of
-G M⁻¹ Gᵀ. Otherwise the order is that of minimum degree (George, Liu 1989, "The evolution of the minimum degree ordering algorithm").
"""

import heapq
from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from nivel.kernels.algebra.sparse_lu import SparseLU
from nivel.kernels.record.record import NONE
from nivel.lazy import Struct
from nivel.system.tables import index_array

Index = NDArray[np.uint32]
Places = NDArray[np.int64]


class FactorPlan(Struct):
    """Pattern of a matrix A (N, N) and the tables of its factors."""

    row_start: Index  # (N+1,) first entry of each row of A, in the numbering of the unknowns
    column: Index  # (entries,) ascending in each row
    tables: SparseLU
    L_size: int  # numbers kept in L
    U_size: int  # numbers kept in U, with its diagonal and what of L stands left of it in the panels

    @property
    def size(self) -> int:
        """N."""
        return self.tables.order.size

    @property
    def fill(self) -> float:
        """Share of the places of a full matrix that the factors need: towards 1 a dense LU with exchanges of rows is as good."""
        return (self.L_size + self.U_size) / max(self.size**2, 1)

    def entry(self, rows: ArrayLike, columns: ArrayLike) -> Index:
        """Numbers of entries (rows[n], columns[n]) in the pattern, broadcast against each other. Raises KeyError where A has none."""
        row, column = np.broadcast_arrays(np.asarray(rows, dtype=np.int64), np.asarray(columns, dtype=np.int64))
        key = row * self.size + column
        found = np.searchsorted(self._keys[:-1], key)
        missing = (self._keys[found] != key) | (column < 0) | (column >= self.size)
        if np.any(missing):
            raise KeyError(f"the matrix has no entry ({row[missing][0]}, {column[missing][0]})")
        return found.astype(np.uint32)

    @cached_property
    def _keys(self) -> Places:
        """row N + column of each entry, ascending, and one that none has."""
        row = np.repeat(np.arange(self.size), np.diff(self.row_start.astype(np.int64)))
        return np.append(row * self.size + self.column, -1)

    def workspace(self, dtype: DTypeLike = np.float64) -> tuple[NDArray, NDArray, NDArray, NDArray]:
        """L, U, Dinv and work of the kernels."""
        widest = int(self.tables.width.max(initial=0))
        return tuple(np.zeros(count, dtype) for count in (self.L_size, self.U_size, self.size, self.size + widest))  # pyright: ignore[reportReturnType]


def plan_factor(sizes: Sequence[int], constraint: Sequence[bool], couples: Iterable[tuple[int, int]]) -> FactorPlan:
    """Plan the factors of a matrix of groups of unknowns, numbered one after the other.

    sizes : unknowns of each group; constraint : whether it is one of constraints; couples : pairs of groups with entries at (a, b) and
    (b, a). Diagonal blocks are always there.
    """
    count = len(sizes)
    adjacent: list[set[int]] = [set() for _ in range(count)]
    for a, b in couples:
        if a != b:
            adjacent[a].add(b)
            adjacent[b].add(a)
    start = np.concatenate([[0], np.cumsum(np.asarray(sizes, dtype=np.int64))]).astype(np.int64)
    row_start, column = _pattern(start, adjacent)
    waits = {g: {other for other in adjacent[g] if not constraint[other]} for g in range(count) if constraint[g]}
    order, beside = _postordered(*minimum_degree(sizes, adjacent, waits))
    return _tables(start, row_start, column, order, beside)


def minimum_degree(
    sizes: Sequence[int], neighbours: Sequence[Collection[int]], waits: Mapping[int, Collection[int]]
) -> tuple[list[int], list[set[int]]]:
    """Order of elimination, and for each group the later ones that it meets: always the group with the fewest unknowns beside it.

    waits : groups that some must follow. Ties: the earlier group.
    """
    adjacent = [set(groups) for groups in neighbours]
    blocking = [0] * len(sizes)
    followers: dict[int, list[int]] = {}
    for g, groups in waits.items():
        blocking[g] = len(groups)
        for other in groups:
            followers.setdefault(other, []).append(g)
    degree = [sum(sizes[other] for other in groups) for groups in adjacent]
    heap = [(degree[g], g) for g in range(len(sizes)) if not blocking[g]]
    heapq.heapify(heap)
    done = [False] * len(sizes)
    order: list[int] = []
    while heap:
        claimed, g = heapq.heappop(heap)
        if done[g] or claimed != degree[g]:
            continue
        done[g] = True
        order.append(g)
        for other in followers.get(g, ()):
            blocking[other] -= 1
        beside = adjacent[g]
        for other in beside:
            met = adjacent[other]
            met |= beside
            met -= {g, other}
            degree[other] = sum(sizes[third] for third in met)
        for other in {*beside, *followers.get(g, ())}:
            if not (done[other] or blocking[other]):
                heapq.heappush(heap, (degree[other], other))
    if len(order) < len(sizes):
        raise ValueError("groups of constraints wait for each other")
    return order, adjacent


def _pattern(start: Places, adjacent: Sequence[set[int]]) -> tuple[Index, Index]:
    """Row starts and columns of A."""
    columns: list[int] = []
    counts: list[int] = []
    for g, groups in enumerate(adjacent):
        row = [unknown for other in sorted({g, *groups}) for unknown in range(start[other], start[other + 1])]
        size = int(start[g + 1] - start[g])
        columns += row * size
        counts += [len(row)] * size
    return _index(np.concatenate([[0], np.cumsum(counts)])), _index(columns)


def _postordered(order: Sequence[int], beside: Sequence[set[int]]) -> tuple[list[int], list[set[int]]]:
    """The same elimination with every group as close as can be behind those it follows from (postorder of the elimination tree).

    Fill and pivots are the same, and a group follows directly on the child whose unknowns beside it are the most, so blocks are long.
    """
    place = {g: k for k, g in enumerate(order)}
    children: dict[int, list[int]] = {g: [] for g in order}
    roots = []
    for g in order:
        if beside[g]:
            children[min(beside[g], key=place.__getitem__)].append(g)
        else:
            roots.append(g)
    result: list[int] = []
    stack = roots
    while stack:  # parents first, from the end
        g = stack.pop()
        result.append(g)
        stack += sorted(children[g], key=lambda child: (len(beside[child]), place[child]))
    return result[::-1], list(beside)


def _blocks(order: Sequence[int], beside: Sequence[set[int]]) -> list[list[int]]:
    """Groups that are eliminated one after the other and meet the same later groups."""
    blocks: list[list[int]] = []
    for g in order:
        if blocks and g in beside[blocks[-1][-1]] and len(beside[blocks[-1][-1]]) == len(beside[g]) + 1:
            blocks[-1].append(g)
        else:
            blocks.append([g])
    return blocks


class _Layout(Struct):
    """Where the panels of the blocks stand; *place* is the number of an unknown in the order."""

    count: int  # unknowns
    first: Places  # (S+1,) first place of each block
    block: Places  # (N,) block of each place
    beside_start: Places  # (S+1,)
    beside: Places  # places beside each block, ascending
    width: Places  # (S,)
    U_start: Places  # (S+1,)
    L_start: Places  # (S+1,)

    def rank(self, blocks: Places, places: Places) -> Places:
        """Number of each place among those beside its block."""
        key = np.repeat(np.arange(self.width.size), np.diff(self.beside_start)) * self.count + self.beside
        return np.searchsorted(key, blocks * self.count + places) - self.beside_start[blocks]

    def home(self, rows: Places, columns: Places) -> tuple[NDArray[np.bool_], Places]:
        """Whether entries (places) stand in panels of U, and at which number of U or L."""
        i, j = self.block[rows], self.block[columns]
        upper = j >= i
        at = np.empty(rows.size, dtype=np.int64)
        size = np.diff(self.first)
        right = columns - self.first[i]
        later = j > i
        right[later] = size[i[later]] + self.rank(i[later], columns[later])
        at[upper] = (self.U_start[i] + (rows - self.first[i]) * self.width[i] + right)[upper]
        rows, columns, j = rows[~upper], columns[~upper], j[~upper]
        at[~upper] = self.L_start[j] + self.rank(j, rows) * size[j] + columns - self.first[j]
        return upper, at


def _layout(start: Places, blocks: Sequence[Sequence[int]], beside: Sequence[set[int]]) -> tuple[Places, _Layout]:
    """Order of the unknowns, and where their panels stand."""
    groups = [g for block in blocks for g in block]
    size = np.diff(start)
    group_place = np.empty(size.size, dtype=np.int64)
    group_place[groups] = np.cumsum([0, *size[groups]])[:-1]
    order = np.concatenate([np.zeros(0, np.int64), *(np.arange(start[g], start[g + 1]) for g in groups)])
    block_size = np.array([sum(int(size[g]) for g in block) for block in blocks], dtype=np.int64)
    places = [
        [
            place
            for first, n in sorted((int(group_place[g]), int(size[g])) for g in beside[block[-1]])
            for place in range(first, first + n)
        ]
        for block in blocks
    ]
    beside_count = np.array([len(row) for row in places], dtype=np.int64)
    layout = _Layout(
        count=order.size,
        first=_starts(block_size),
        block=np.repeat(np.arange(len(blocks)), block_size),
        beside_start=_starts(beside_count),
        beside=np.array([place for row in places for place in row], dtype=np.int64),
        width=block_size + beside_count,
        U_start=_starts(block_size * (block_size + beside_count)),
        L_start=_starts(block_size * beside_count),
    )
    return order, layout


def _tables(
    start: Places, row_start: Index, column: Index, groups: Sequence[int], beside: Sequence[set[int]]
) -> FactorPlan:
    order, layout = _layout(start, _blocks(groups, beside), beside)
    place = np.empty(order.size, dtype=np.int64)
    place[order] = np.arange(order.size)
    rows = place[np.repeat(np.arange(order.size), np.diff(row_start.astype(np.int64)))]
    upper, at = layout.home(rows, place[column])
    part_start, part_first, part_count, target_start, target = _parts(layout)
    tables = SparseLU(
        order=_index(order),
        upper_from=_index(np.flatnonzero(upper)),
        upper_at=_index(at[upper]),
        lower_from=_index(np.flatnonzero(~upper)),
        lower_at=_index(at[~upper]),
        first=_index(layout.first),
        width=_index(layout.width),
        U_start=_index(layout.U_start[:-1]),
        L_start=_index(layout.L_start[:-1]),
        part_start=_index(part_start),
        part_first=_index(part_first),
        part_count=_index(part_count),
        part_block=_index(layout.block[part_first]),
        target_start=_index(target_start),
        target=_index(target),
    )
    return FactorPlan(row_start, column, tables, int(layout.L_start[-1]), int(layout.U_start[-1]))


def _parts(layout: _Layout) -> tuple[Places, Places, Places, Places, Places]:
    """Runs of places beside each block, within one later block each, and where the product of each pair of them goes."""
    owner = np.repeat(np.arange(layout.width.size), np.diff(layout.beside_start))
    block = layout.block[layout.beside]
    begins = np.ones(owner.size, dtype=bool)
    begins[1:] = (np.diff(owner) != 0) | (np.diff(block) != 0) | (np.diff(layout.beside) != 1)
    part = np.flatnonzero(begins)
    part_first = layout.beside[part]
    part_count = np.diff(np.append(part, owner.size))
    count = np.bincount(owner[part], minlength=layout.width.size)
    part_start = _starts(count)
    pairs = count[owner[part]]
    row = np.repeat(np.arange(part.size), pairs)
    column = np.arange(row.size) - np.repeat(_starts(pairs)[:-1], pairs) + part_start[owner[part]][row]
    _, target = layout.home(part_first[row], part_first[column])
    return part_start, part_first, part_count, _starts(count**2)[:-1], target


def _starts(counts: NDArray[np.integer]) -> Places:
    return np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)


def _index(values: ArrayLike) -> Index:
    return np.ascontiguousarray(np.asarray(values, dtype=np.int64).astype(np.uint32))


# Derivatives that Newton's iteration of a machine needs, grouped by evaluation: done once, in Python.
#
# Unknowns come in groups that depend on each other as a whole: velocities of a body, states of a force, rows of a joint. Groups that meet
# no group in common are moved together (Curtis, Powell, Reid 1974, "On the estimation of sparse Jacobian matrices"), so the number of
# evaluations does not grow with a chain.


class TangentPlan(Struct):
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
