"""Moving a machine onto its constraints by the least change of its positions or velocities (Gauss–Newton, least squares)."""

from collections.abc import Iterator, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations, moved
from nivel.errors import Fault, ModelError
from nivel.lazy import Struct, scipy
from nivel.system.system import Array

Index = NDArray[np.int64]

ITERATIONS, MOST_STEPS = 100, 20_000
# Constraints hold to this share of the scale of their row: the machine's length, or 1 for cosines.
CLOSED = 1e-12
# Longest step of an iteration, in radians and machine lengths.
LONGEST = 0.5
# A row that cannot be closed better than this share is named.
OPEN = 1e-9
# Machines larger than this many entries of C_q are solved iteratively.
DENSE_ENTRIES = 1_000_000


class Aim(Protocol):
    """Something else that positions q (7 B,) are to fulfil: k numbers that are to be zero."""

    @property
    def scale(self) -> Array:
        """(k,) what counts as one of each number."""
        ...

    def error(self, q: Array) -> Array:
        """(k,) the numbers."""
        ...

    def rows(self, q: Array) -> Iterator[tuple[int, int, Array]]:
        """Row, body and (6,) derivatives of the number for (Ṙ, ω̄) of the body."""
        ...


class Wishes(Struct):
    """What the assembly has to respect beside the constraints.

    weight : (B,) how unwilling each body is to move. hold : (B,) bodies that are not moved. values, rates : of joint coordinates,
    (name, coordinate, wanted). aims : what else positions are to fulfil.
    """

    weight: Array
    hold: NDArray[np.bool_]
    values: tuple[tuple[str, int, float], ...] = ()
    rates: tuple[tuple[str, int, float], ...] = ()
    aims: tuple[Aim, ...] = ()


def close_positions(
    motion: MotionEquations,
    t: float,
    y: Array,
    wishes: Wishes | None = None,
    *,
    iterations: int = ITERATIONS,
    from_afar: bool = True,
) -> bool:
    """Move the positions in the state y as little as possible onto the constraints, in place; whether all rows are closed.

    iterations : at most; from_afar : more where they are far open.
    Where they cannot be closed, y is the best position found. The record is left evaluated at y; measured angles are followed.
    """
    system = motion.system
    rows, coordinates = slice(0, system.machine_rows), system.record.coordinates
    C, scale = system.record.constraints.C, system.record.constraints.scale[rows]
    values, aims = (wishes.values, wishes.aims) if wishes is not None else ((), ())
    scale = np.append(
        scale, [1.0 if name.partition(".")[2].startswith("angle") else system.size for name, _, _ in values]
    )
    scale = np.concatenate([scale, *(aim.scale for aim in aims)])
    willing = np.ones(system.body_count) if wishes is None else np.where(wishes.hold, 0.0, 1.0 / wishes.weight)
    ways = willing[:, None, None] * np.eye(6)
    chosen, wanted = [q for _, q, _ in values], np.array([value for _, _, value in values])

    def violations() -> Array:
        errors = (aim.error(y[: system.positions]) for aim in aims)
        return np.concatenate([C[rows], coordinates.value[chosen] - wanted, *errors])

    best, least, steps, budget = y.copy(), np.inf, 0, iterations
    while steps < budget:
        steps += 1
        _evaluate_and_follow(motion, t, y)
        violation = violations()
        if not np.all(np.isfinite(violation)):
            return False
        size = float(np.linalg.norm(violation / scale))
        if steps == 1 and from_afar:
            # a value far away takes its share of steps
            budget += min(MOST_STEPS, int(4.0 * size / LONGEST)) if np.isfinite(size) else 0
        if size < least:
            best, least = y.copy(), size
        if np.max(np.abs(violation) / scale, initial=0.0) <= CLOSED:
            return True
        further = _blocks(aims, y[: system.positions], system.machine_rows + len(chosen))
        change = least_change(motion, -violation, chosen, scale, ways, further)
        # a step of more than half a radian or half the machine is outside the linear range
        length = float(np.abs(change).max())
        change *= min(1.0, LONGEST / length) if length > 0.0 else 0.0
        change.reshape(-1, 6)[:, :3] *= system.size
        y[: system.positions] = moved(y[: system.positions], change)
    y[:] = best
    _evaluate_and_follow(motion, t, y)
    return bool(np.max(np.abs(violations()) / scale, initial=0.0) <= OPEN)


Blocks = tuple[Index, Index, Array]  # row (n,), body (n,), entries (n, 6)
NOTHING: Blocks = (np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 6)))


def _blocks(aims: tuple[Aim, ...], q: Array, first: int) -> Blocks:
    """Derivatives of aims whose rows stand from row `first` on."""
    row, body, block = [], [], []
    for aim in aims:
        for k, of, entries in aim.rows(q):
            row.append(first + k)
            body.append(of)
            block.append(entries)
        first += len(aim.scale)
    return (np.array(row, np.int64), np.array(body, np.int64), np.array(block)) if row else NOTHING


def _evaluate_and_follow(motion: MotionEquations, t: float, y: Array) -> None:
    """Evaluate, and take the measured angles as those that the next ones are near to."""
    motion.evaluate(t, y)
    coordinates = motion.system.record.coordinates
    active = coordinates.active
    coordinates.reference[active] = coordinates.value[active]


def least_change(
    motion: MotionEquations,
    target: Array,
    coordinates: Sequence[int],
    scale: Array,
    ways: Array,
    further: Blocks = NOTHING,
) -> Array:
    """The change x (6 B,) with [C_q; derivatives of the coordinates; further] x = target, lengths of x in units of the machine's length.

    x = ways z, block by block (B, 6, 6), for the least z. Rows are weighed by their scales. further : blocks of the rows after the
    coordinates.
    """
    system = motion.system
    if not np.any(target):
        return np.zeros(6 * system.body_count)
    row, body, block = motion.jacobian_blocks(coordinates)
    row, body, block = np.append(row, further[0]), np.append(body, further[1]), np.vstack([block, further[2]])
    block[:, :3] *= system.size
    block = np.einsum("ki,kij->kj", block / scale[row][:, None], ways[body])
    z = _least_solution(row, body, block, system.body_count, target / scale)
    return np.einsum("bij,bj->bi", ways, z.reshape(-1, 6)).ravel()


def _least_solution(row: Index, body: Index, block: Array, bodies: int, target: Array) -> Array:
    """Least x (6 B,) for rows made of blocks (n, 6), each of one row and body, to be added up."""
    shape = (len(target), 6 * bodies)
    if shape[0] * shape[1] <= DENSE_ENTRIES:
        J = np.zeros((len(target), bodies, 6))
        np.add.at(J, (row, body), block)
        try:
            return np.asarray(np.linalg.lstsq(J.reshape(shape), target, rcond=1e-10)[0], dtype=np.float64)
        except np.linalg.LinAlgError:
            message = "the positions and lengths of the machine are too far apart in size to compute with"
            raise ModelError(Fault.at("machine", message)) from None
    column = 6 * body[:, None] + np.arange(6)
    J = scipy.sparse.csr_array((block.ravel(), (np.repeat(row, 6), column.ravel())), shape=shape)
    return scipy.sparse.linalg.lsmr(J, target, atol=1e-15, btol=1e-15, conlim=1e15, maxiter=20 * len(target))[0]
