"""Equilibria of machines with first-order states: rates that are zero beside forces that balance.

Positions q, multipliers λ and states x are found together by Newton's iteration with exact tangents:

    [K  D_x  Cᵀ; -∂g/∂q  -∂g/∂x  0; C  0  0] (Δq, Δx, Δλ) = -(r, -g, C)        g = ẋ at rest

A state whose rate depends on nothing that is at rest keeps its start value: a memory that an event changes. Fluid that is shut in keeps
its mass, and what a motion stretches has the stretch of the way from the start: `kept_combinations`.
Sampled states are at rest where a sample would leave them as they are.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import svd
from scipy.sparse import csc_matrix, diags

from nivel.analysis.statics.equations import Rest, Sparse, StateError, StaticEquations
from nivel.analysis.statics.linear import PivotError, factors
from nivel.analysis.statics.newton import EquilibriumError, Found, Iteration
from nivel.lazy import Struct
from nivel.system.system import Array

# The longest change of one iteration, in lengths of the machine and radians; most iterations, of which the last ones are Newton's own.
LONGEST, MOST = 0.3, 200
# The least share of a step that is tried, and what a state may change by in one, as a share of its size.
LEAST_SHARE = 1.0 / 1024.0
# What a step that leads nowhere is made shorter by, where machines settle.
MORE = 2.0
# Motions that grow by less than this share of their own rate are vibrations that neither grow nor decay.
GROWING = 1e-7
# Rates below this share of the size of the state in the duration are none.
STILL = 1e-12


class AtRest(Struct):
    """The equations at a state: matrix and right-hand side of scaled unknowns, and what a scaled unknown is in units.

    chosen, weight : of r, -ẋ and C which, and by what these are scaled. keeps : whether some states keep what they began with.
    """

    matrix: csc_matrix
    right: Array
    unit: Array
    states: NDArray[np.intp]
    chosen: NDArray[np.intp]
    weight: Array
    keeps: bool


class Since(Struct):
    """Where an equilibrium is asked from: the states (S,) there, and how far the free unknowns (f,) have moved since, without units."""

    states: Array
    moved: Array

    @classmethod
    def start(cls, equations: StaticEquations, state: Rest) -> "Since":
        """Nothing has moved yet."""
        return cls(state.y[equations.first_state :][: equations.state_count].copy(), np.zeros(len(equations.free)))

    def further(self, change: Array) -> "Since":
        """After a change of the free unknowns."""
        return Since(self.states, self.moved + change)


class RestlessStateError(EquilibriumError):
    """The rate of a state is not zero whatever the machine does. name : of the state."""

    def __init__(self, name: str, rate: float, state: Rest) -> None:
        super().__init__(
            f"the state {name} never rests: its rate is {rate:.6g} per second wherever the machine is", state
        )


def find_moving_states(equations: StaticEquations, state: Rest) -> None:
    """Say in `equations.states_move` whether rates of states are equations at all. Raises StateError, RestlessStateError."""
    equations.states_move = bool(len(assembled(equations, state, Since.start(equations, state)).states))


def equilibrate_states(equations: StaticEquations, state: Rest, iteration: Iteration) -> Found:
    """The equilibrium of positions and states next to `state`, at its time. Raises EquilibriumError."""
    sizes: list[float] = []
    since = Since.start(equations, state)
    f = len(equations.free)
    for number in range(1, MOST + 1):
        try:
            system = assembled(equations, state, since)
            x = factors(system.matrix).solve(system.right)
        except StateError:
            raise EquilibriumError("a force, or the state, is not a number", state, tuple(sizes)) from None
        except PivotError:
            raise EquilibriumError("nothing resists a motion, or holds a state", state, tuple(sizes)) from None
        motion = float(np.max(np.abs(x[:f]), initial=0.0))
        size = float(np.max(np.abs(x[: f + len(system.states)]), initial=0.0))
        if not np.isfinite(size):
            raise EquilibriumError("nothing resists a motion, or holds a state", state, tuple(sizes))
        share = min(1.0, LONGEST / motion) if motion > 0.0 else 1.0
        state, since, share = _nearer(equations, state, since, system, x, share)
        sizes.append(size)
        stalled = len(sizes) > 1 and size > 0.3 * sizes[-2] and size <= 1e-7
        if share == 1.0 and (size <= iteration.tolerance or stalled):
            return Found(state, equations.tangent(state), number, since.moved, tuple(sizes))
    raise EquilibriumError(f"{MOST} iterations are not enough", state, tuple(sizes))


def settle_states(equations: StaticEquations, state: Rest, iteration: Iteration) -> Found:
    """The equilibrium where positions, in overdamped motion, and states settle from `state` on, at its time.

    Steps are those of Euler's implicit method, as long as what is left over is small, and in the end Newton's: σ is added to the diagonal
    of positions and states, and falls with what is left over (Kelley, Keyes 1998). What nothing resists yet moves on, as a piston under a
    given pressure until it meets a stop. Raises EquilibriumError.
    """
    since, sigma, sizes = Since.start(equations, state), 1.0, list[float]()
    f = len(equations.free)
    try:
        system = assembled(equations, state, since)
        for number in range(1, MOST + 1):
            own = f + len(system.states)
            added = np.where(np.arange(len(system.right)) < own, sigma, 0.0)
            x = factors(csc_matrix(system.matrix + diags(added))).solve(system.right)
            size = float(np.max(np.abs(x[:own]), initial=0.0))
            if not size <= LONGEST:
                sigma *= MORE
                continue
            after, moved = _changed(equations, state, system, x), since.further(x[:f])
            then = _assembled_or_none(equations, after, moved)
            left = float(np.linalg.norm(system.right))
            if then is None or np.linalg.norm(then.right) > max(MORE * left, STILL):
                sigma *= MORE
                continue
            state, since, system = after, moved, then
            sizes.append(size)
            # a large σ makes every step short
            if size * max(sigma, 1.0) <= iteration.tolerance:
                return Found(state, equations.tangent(state), number, since.moved, tuple(sizes))
            sigma *= min(float(np.linalg.norm(then.right)) / left, 1.0)
    except StateError:
        raise EquilibriumError("a force, or the state, is not a number", state, tuple(sizes)) from None
    except PivotError:
        raise EquilibriumError("nothing resists a motion, or holds a state", state, tuple(sizes)) from None
    raise EquilibriumError(f"{MOST} iterations are not enough", state, tuple(sizes))


def _assembled_or_none(equations: StaticEquations, state: Rest, since: Since) -> AtRest | None:
    """The equations at a state that may have no forces."""
    try:
        return assembled(equations, state, since)
    except StateError:
        return None


def _nearer(
    equations: StaticEquations, state: Rest, since: Since, system: AtRest, x: Array, share: float
) -> tuple[Rest, Since, float]:
    """The state after the largest share of the change that does not make what is left over larger; the least one where none does."""
    left = float(np.linalg.norm(system.right))
    while True:
        after = _changed(equations, state, system, share * x)
        moved = since.further(share * x[: len(equations.free)])
        then = _assembled_or_none(equations, after, moved)
        nearer = then is not None and float(np.linalg.norm(then.right)) <= max(2.0 * left, 1e-9)
        if nearer or share <= LEAST_SHARE:
            return after, moved, share
        share *= 0.5


def _changed(equations: StaticEquations, state: Rest, system: AtRest, x: Array) -> Rest:
    """The state after a change of the scaled unknowns."""
    f, count = len(equations.free), len(system.states)
    change = np.zeros(equations.n)
    change[equations.free] = x[:f]
    y = equations.displaced(state.y, change * equations.length)
    y[equations.first_state + system.states] += (x * system.unit)[f : f + count]
    return Rest(y, state.lam + (x * system.unit)[f + count :], state.t)


# Conserved combinations of states in an equilibrium: fluid that is shut in.
#
# Rates ẋ = g(q, v, x) of states whose equations depend on each other do not fix these. With u from the left null space of the derivatives
# of g at rest, uᵀ ẋ depends on velocities alone, so
#
#     uᵀ (x - x₀) = uᵀ ∂g/∂v (q - q₀)
#
# holds on every way that the machine may have come: Σ m of volumes behind closed valves stays, or goes from one side of a motor to the
# other as it turns. This takes the place of uᵀ g = 0.

# Singular values of derivatives, with rows of the size one, that are none.
DEPENDENT_RATES = 1e-11
# More states than this are looked at one by one only: those whose own row is zero.
MOST_RATES = 400


def kept_combinations(rates: Sparse) -> Array:
    """(S, k) orthonormal combinations of the rates that depend on nothing at rest. rates : derivatives (S, ·), rows of the size one."""
    count = rates.shape[0]
    if not 0 < count <= MOST_RATES:
        return np.zeros((count, 0))
    left, values, _ = svd(rates.toarray())
    rank = int(np.sum(values > DEPENDENT_RATES * values.max(initial=0.0)))
    return left[:, rank:]


def assembled(equations: StaticEquations, state: Rest, since: Since) -> AtRest:
    """The equations at a state. Raises StateError, RestlessStateError."""
    n, count, rows = equations.n, equations.state_count, equations.rows
    r, C = equations.evaluate(state)
    rate = equations.rates()
    parts = equations.whole_parts(state)
    size = np.maximum(equations.state_scale, np.abs(state.y[equations.first_state :][:count]))
    unit = np.concatenate([equations.length, size, equations.energy / equations.row_scale])
    weight = np.concatenate([equations.length / equations.energy, np.ones(count), 1.0 / equations.row_scale])
    matrix = csc_matrix(diags(weight) @ equations.at_rest(*parts) @ diags(unit))
    own = abs(matrix[n : n + count]).tocsr()
    largest = own.max(axis=1).toarray().ravel() if own.shape[1] else np.zeros(count)
    moving = largest > 0.0
    still = np.abs(rate) * equations.duration <= STILL * size
    for k in np.flatnonzero(~moving & ~still):
        raise RestlessStateError(equations.system.states[k].name, float(rate[k]), state)
    states = np.flatnonzero(moving | equations.follows)
    scale = np.where(largest > 0.0, largest, size)[states]
    rescaled = np.ones(n + count + rows)
    rescaled[n + states] = 1.0 / scale
    chosen = np.concatenate([equations.free, n + states, n + count + np.arange(rows)])
    matrix = csc_matrix(diags(rescaled) @ matrix)[chosen][:, chosen]
    right = np.concatenate([-r, rate[states] / scale, -C])
    f = len(equations.free)
    own_rows = slice(f, f + len(states))
    kept = kept_combinations(csc_matrix(matrix[own_rows]))
    if kept.shape[1]:
        by_speed = -parts[1][n + states][:, equations.free].toarray() * equations.length[equations.free]
        laws = np.hstack([-kept.T @ (by_speed / scale[:, None]), kept.T * (size[states] / scale)])
        laws /= np.max(np.abs(laws), axis=1, keepdims=True)
        change = np.concatenate(
            [since.moved, ((state.y[equations.first_state :][:count] - since.states) / size)[states]]
        )
        matrix = csc_matrix(matrix + _placed(kept @ laws, f, matrix.shape))
        right[own_rows] -= kept @ (laws @ change)
    return AtRest(matrix, right, unit[chosen], states, chosen, (rescaled * weight)[chosen], bool(kept.shape[1]))


def _placed(rows: Array, first: int, shape: tuple[int, int]) -> csc_matrix:
    """A matrix of this shape with the rows from the first on, and from the first column."""
    row, column = np.nonzero(rows)
    return csc_matrix((rows[row, column], (row + first, column)), shape=shape)


def restlessness(equations: StaticEquations, state: Rest) -> float:
    """What a state would change by within its own time, as a share of its size, at most: zero in equilibrium."""
    system = assembled(equations, state, Since.start(equations, state))
    f = len(equations.free)
    return float(np.max(np.abs(system.right[f : f + len(system.states)]), initial=0.0))


def depends_on_samples(equations: StaticEquations, state: Rest) -> bool:
    """Whether forces or rates depend on values that are sampled."""
    n, count = equations.n, equations.state_count
    sampled = np.array([fact.sampled for fact in equations.system.states], dtype=bool)
    matrix = csc_matrix(equations.at_rest(*equations.whole_parts(state)))
    rows = np.concatenate([np.arange(n), n + np.flatnonzero(~sampled)])
    return matrix[rows][:, n + np.flatnonzero(sampled)].count_nonzero() > 0 if count else False


def growing_motions(equations: StaticEquations, state: Rest) -> int:
    """Number of small motions about an equilibrium, of positions and states together, that grow with time: eigenvalues λ of

    M q̈ + D q̇ + K q + D_x x = 0,  ẋ = ∂g/∂v q̇ + ∂g/∂q q + ∂g/∂x x  on the motions that all constraints allow, with Re λ > 0.
    """
    tangent = equations.tangent(state)
    n, count = equations.n, equations.state_count
    K, D, M = (part.toarray() for part in equations.whole_parts(state))
    free, Z = equations.free, tangent.free_directions
    Z = equations.length[free, None] * Z
    own = slice(n, n + count)
    m = Z.shape[1]
    inertia = Z.T @ M[np.ix_(free, free)] @ Z
    accelerations = np.hstack([-Z.T @ K[np.ix_(free, free)] @ Z, -Z.T @ D[np.ix_(free, free)] @ Z, -Z.T @ D[free, own]])
    rates = np.hstack([-K[own][:, free] @ Z, -D[own][:, free] @ Z, -D[own, own]])
    first = np.hstack([np.zeros((m, m)), np.eye(m), np.zeros((m, count))])
    system = np.vstack([first, np.linalg.solve(inertia, accelerations) if m else accelerations, rates])
    values: Any = np.linalg.eigvals(system)
    return int(
        np.sum(values.real > GROWING * np.maximum(np.abs(values), np.max(np.abs(values), initial=0.0) * GROWING))
    )
