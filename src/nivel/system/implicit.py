"""Arrays of implicit methods: which rows and unknowns the residual of a machine has, and which derivatives its matrix needs."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.kernels.record import implicit_record
from nivel.kernels.record.record import NONE, Record
from nivel.system.elimination.factor_plan import FactorPlan, TangentPlan, plan_tangent
from nivel.system.system import Array, StateMap
from nivel.system.tables import index_array, zeros

# share of the places of a full matrix that its factors need: above it exchanges of rows cost nothing
MOSTLY_FULL = 0.6
Index = NDArray[np.uint32]
EMPTY = plan_tangent([], [], [], mirrored=True)


def no_residual() -> implicit_record.Residual:
    """For explicit methods: all arrays empty."""
    return residual_tables(0, 0, 0, 0, index_array([], 1), index_array([], 4))


def no_newton() -> implicit_record.Newton:
    """For explicit methods: all arrays empty."""
    return newton_tables(index_array([], 2), 0, 0, 0, EMPTY)


def residual_tables(
    bodies: int,
    state: int,
    velocities: int,
    states: int,
    row: Index,
    part: Index,
    *,
    stiction: Sequence[int] = (),
    free: bool | None = None,
    flexible: tuple[int, int, int] = (0, 0, 0),
    nodes: Sequence[int] = (),
) -> implicit_record.Residual:
    """For so many bodies, entries of y, velocities and states of forces. row, part, stiction : as in `Residual`.

    free : whether nothing joins the machine to the ground, for residuals over a whole step; None for all others. flexible : numbers of
    modes, frames at interfaces and flexible bodies that such a residual knows. nodes : markers that are nodes of geometrically exact beams.
    """
    rows = len(row) + len(stiction)
    whole = free is not None
    return implicit_record.Residual(
        row=row,
        stiction=index_array(stiction, 1),
        part=part,
        y=np.zeros(state),
        vdot=np.zeros(velocities),
        lam=np.zeros(rows),
        value=np.zeros(velocities + states + 3 * rows),
        **zeros("branch made limit rate begun", len(stiction)),
        bidden=np.full(len(stiction), np.nan),
        span=np.zeros(1),
        tally=np.zeros(3 + len(stiction)),
        frozen=np.full(len(stiction), np.nan),
        **zeros("acceleration wrench", bodies + 1, 6),
        interval=implicit_record.StepResidual(
            numbers=np.array([0.0, 0.0, 0.0, float(bool(free))]),
            start=np.zeros((bodies if whole else 0, 12)),
            inertia=np.zeros((bodies if whole else 0, 3, 3)),
            internal=np.zeros((bodies if whole else 0, 6)),
            modal=np.zeros(flexible[0]),
            frame=np.zeros((flexible[1], 12)),
            defect=np.zeros(flexible[2]),
            node=index_array(nodes, 1),
            state=np.zeros(states + 2 if whole else 0),
        ),
    )


def parts_of(record: Record, relative: bool) -> Index:
    """(row of the saddle, part of C_q, marker, body) of all constraint rows of the saddle."""
    if relative:
        return index_array([entry for entry in record.tree.part.tolist() if entry[0] < len(record.saddle.row)], 4)
    blocks, bodies = record.saddle.block[: int(record.saddle.blocks[0])].tolist(), len(record.bodies.mass)
    # what is on a frame at an interface of a flexible body acts there; blocks behind the bodies are those of modes
    # and those without a part of C_q are normalisations
    return index_array(
        [(row, part, m, record.markers.body[m]) for row, part, m, body in blocks if body < bodies and part != NONE], 4
    )


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


def shifted_tables(plan: TangentPlan, place: Index, state: int) -> implicit_record.Shifted:
    """For the derivatives planned, `place` of the velocities and entries of y."""
    entries, velocities = len(plan.factor.column), len(place)
    return implicit_record.Shifted(
        **zeros("M D K", entries),
        real=real_factors(plan.factor, velocities, state),
        pair=_factors(implicit_record.ComplexFactors, np.complex128, plan.factor, velocities, state),
        coupled=_coupled(plan, place, state),
    )


def _coupled(plan: TangentPlan, place: Index, state: int) -> implicit_record.Coupled:
    """For the stages of a step; without numbers where they are not planned."""
    factor, stages, kept = plan.coupled or EMPTY.factor, 3 if plan.coupled else 0, 4 if plan.coupled else 0
    entries, velocities = len(plan.factor.column), len(place)
    turns = int(np.sum(place[:, 1] == 0))
    return implicit_record.Coupled(
        lu=factor.tables,
        column=factor.column,
        row_start=factor.row_start,
        factors=real_factors(factor, 0, 0),
        **zeros("M D K", kept, entries),
        **zeros("state r", stages, state),
        moved=np.zeros((stages, velocities)),
        reach=np.zeros((velocities, 3, 9)),
        spin=np.zeros((turns, 12, 12)),
        pivot=np.zeros((turns, 12), dtype=np.uint32),
        work=np.zeros((2, 12)),
    )


def real_factors(factor: FactorPlan, velocities: int, state: int) -> implicit_record.RealFactors:
    """Room for the factors of a matrix with the pattern planned."""
    return _factors(implicit_record.RealFactors, np.float64, factor, velocities, state)


def _factors(kind: type, dtype: type, factor: FactorPlan, velocities: int, state: int) -> Any:
    dense = factor.fill > MOSTLY_FULL
    full = factor.size if dense else 0
    L, U, Dinv, work = factor.workspace(dtype) if not dense else (np.zeros(0, dtype),) * 4
    return kind(
        value=np.zeros(len(factor.column), dtype),
        L=L,
        U=U,
        Dinv=Dinv,
        work=work,
        matrix=np.zeros((full, full), dtype),
        pivot=np.zeros(full, dtype=np.uint32),
        b=np.zeros(factor.size, dtype),
        moved=np.zeros(velocities, dtype),
        r=np.zeros(state, dtype),
    )


def newton_tables(
    place: Index,
    state: int,
    states: int,
    rows: int,
    plan: TangentPlan,
    corners: Sequence[float] = (),
    *,
    shifted: bool = False,
    balance: bool = False,
    filtered: bool = False,
    length: float = 1.0,
    compliance: Array | None = None,
) -> implicit_record.Newton:
    """For `place` of the velocities, entries of y, states of forces, multipliers, the derivatives planned and corners [s]; with room
    for `Shifted`, for the balance of accelerations and for filtered errors where a method or a machine asks for it.

    length : of the machine [m]. compliance : (H,) 1/α of penalty methods; None for multipliers.
    """
    n, factor = len(place), plan.factor
    size = factor.size
    solved = real_factors(factor, n, 0)._asdict()
    del solved["r"]
    return implicit_record.Newton(
        address=np.zeros(3, dtype=np.uint64),
        place=place,
        group=plan.group,
        group_start=plan.group_start,
        entry_start=plan.entry_start,
        entry=plan.entry,
        column=factor.column,
        row_start=factor.row_start,
        lu=factor.tables,
        base=np.zeros(state),
        **zeros("turn speed correction change moved_before", n),
        **zeros("state rate", states),
        **solved,
        last=np.zeros(max(size, 4)),
        before=np.zeros(size),
        **zeros("lam lam_before", rows),
        corners=np.array(corners, dtype=float),
        **zeros("kept settings", 4),
        balance=real_factors((plan if balance else EMPTY).factor, 0, 0),
        filter=real_factors((plan if filtered else EMPTY).factor, 0, 0),
        balanced=np.array([0.0, length]),
        asked=np.zeros(3),
        level=np.zeros(1, dtype=np.uint32),
        compliance=np.zeros(0) if compliance is None else compliance,
        diagonal=_corner(plan, rows, 0 if compliance is None else len(compliance)),
        shifted=shifted_tables(plan, place, state) if shifted else shifted_tables(EMPTY, place[:0], 0),
    )


def _corner(plan: TangentPlan, rows: int, count: int) -> Index:
    """Places of the diagonal of the first `count` of the last `rows` unknowns."""
    first = plan.factor.size - rows
    own = np.arange(first, first + count)
    return plan.factor.entry(own, own)
