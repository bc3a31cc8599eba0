"""Record of implicit methods: the machine's equations as a residual, and Newton's iteration for them.

n velocities, S states of forces and K multipliers make N = n + S + K unknowns: accelerations v̇, rates ẋ, multipliers λ. Of the latter H
hold constraint rows; the last K - H are the efforts of frictions with stiction, with rows of their own:
`nivel.kernels.residual.friction_residual`.
"""

from __future__ import annotations

from typing import NamedTuple

from nivel.kernels.algebra.sparse_lu import SparseLU
from nivel.kernels.core.arrays import A1, C1, C2, F1, F2, F3, P2, U1, U2, W1, W2


class StepResidual(NamedTuple):
    """What residuals over a whole step know of it; see `nivel.motion.energy_momentum_residual`. Without numbers for other methods."""

    numbers: F1  # (4,) step [s], elastic energy at its start [J], least motion in it [J], 1 where the machine touches no ground
    # (B, 12) centre of mass [m], its velocity, angular momentum about it at the start, global axes; of flexible bodies also in their axes
    start: F2
    inertia: F3  # (B, 3, 3) about the centre of mass, axes of the body; zero for a point mass; of flexible bodies at their mean place
    # (B, 6) velocity of the centre of mass by the modes alone, their angular momentum about it, at the mean place, global axes
    internal: F2
    modal: F1  # (m,) modal momenta at the start, the frame moving so that the body has no linear momentum
    frame: F2  # (N, 12) place and axes of the frames at interfaces at the start
    defect: F1  # (F,) power that the inertia forces on the modes miss
    node: U1  # markers that are nodes of geometrically exact beams
    # work
    state: W1  # (S + 2,) mean states of forces


class Residual(NamedTuple):
    """The equations of motion as a residual; see `nivel.kernels.residual.residual`. Without numbers for explicit methods."""

    row: U1  # (H,) row of the constraints that each row here is: redundant ones have compliance
    stiction: U1  # (K - H,) friction of each effort behind them
    part: U2  # (·, 4) row here, part of C_q, marker, body
    # what it is to be evaluated for
    y: W1  # (ny,) state
    vdot: W1  # (n,) accelerations
    lam: W1  # (K,) multipliers
    # work
    # (n + S + 3 K,) M v̇ + C_qᵀ λ - Q, rates of the states of forces, then C, Ċ and C̈ with its feedback; of efforts what stands for C̈ alone
    value: W1
    # (K - H,) as last evaluated: 0 where a friction sticks, else the sign of its effort, twice where Stribeck's curve is too steep
    branch: F1
    made: F1  # (K - H,) the same when Newton's matrix was made
    bidden: F1  # (K - H,) the same where it does not follow from the state; not a number: it does
    limit: F1  # (K - H,) [N or N m] greatest effort of a friction, as last evaluated
    rate: F1  # (K - H,) [m/s or 1/s] of the coordinate, as last evaluated
    begun: F1  # (K - H,) [m/s or 1/s] rate of the coordinate at the begin of the step
    span: F1  # (1,) [s] the step where c̈ of frictions is its mean; 0: it is that at the time
    # (3,) of the iteration: turns, evaluations where Stribeck's curve was steep, seed; see `nivel.integrate.newmark.friction_turns`
    tally: F1
    frozen: F1  # (K - H,) [m/s or 1/s] that for which Stribeck's curve is taken in place of it; not a number: none
    acceleration: W2  # (B+1, 6) (α, R̈) of the bodies, global axes
    wrench: W2  # (B+1, 6) (moment about the frame origin, force) that their joints have to transmit
    interval: StepResidual


class RealFactors(NamedTuple):
    """One system (1 - s ∂f/∂y) x = r for a real s, see `nivel.kernels.residual.shifted_matrix`."""

    value: F1  # (·,) entries of the matrix
    L: F1  # its factors where it is sparse
    U: F1
    Dinv: F1
    work: F1
    matrix: P2  # (N, N) its factors where it is not, or (0, 0)
    pivot: U1  # (N,)
    b: F1  # (N,) right-hand side of the equations of motion, then solution
    moved: F1  # (n,) change of the positions while accelerations do not change
    r: F1  # (ny,) right-hand side, then solution


class ComplexFactors(NamedTuple):
    """The same for a complex s."""

    value: C1
    L: C1
    U: C1
    Dinv: C1
    work: C1
    matrix: C2
    pivot: U1
    b: C1
    moved: C1
    r: C1


class Coupled(NamedTuple):
    """The stages of a Runge–Kutta method as one system, each with derivatives of its own; see `nivel.integrate.radau.coupled_stages`.

    Unknown u at stage s is number 3 u + s, and so in the pattern of one system every entry becomes three by three. T bodies that turn.
    """

    lu: SparseLU
    column: U1  # pattern of the matrix, as in `Newton`
    row_start: U1
    factors: RealFactors
    M: F2  # (4, ·) derivatives at the three stages, as in `Shifted`; last those of the begin of the step, put aside
    D: F2
    K: F2
    state: F2  # (3, ny) where they were found
    r: F2  # (3, ny) what is missing in the equations of the stages, then the change of the states
    moved: F2  # (3, n) change of the positions while accelerations do not change
    reach: (
        F3  # (n, 3, 9) change of a position at a stage by accelerations of the body: one of it, or three, at each stage
    )
    spin: F3  # (T, 12, 12) factors of the equations of Euler parameters at the stages
    pivot: U2  # (T, 12)
    work: F2  # (2, 12)


class Shifted(NamedTuple):
    """Derivatives of the residual apart, and systems made of them. Without numbers for methods that have no use for it."""

    M: F1  # (·,) entries with respect to accelerations and multipliers, where `Newton.value` has them
    D: F1  # (·,) with respect to velocities and states of forces
    K: F1  # (·,) with respect to positions
    real: RealFactors
    pair: ComplexFactors
    coupled: Coupled


class Newton(NamedTuple):
    """Newton's iteration for the residual, in a state affine in the unknowns; see `nivel.integrate.newmark.newton_state`."""

    address: A1  # (3,) of the record on dual numbers, of its residual, and of that at an instant where the residual is over a step
    place: (
        U2  # (n, 2) place in y of the position that a velocity moves, NONE; or of four Euler parameters, axis 0, 1 or 2
    )
    group: U1  # unknowns with derivatives of their own, those with nothing in common next to each other
    group_start: U1  # groups + 1
    entry_start: U1  # (N + 1,) entries of each unknown
    entry: U2  # (·, 3) row, place of its derivative in `value`, place of the transposed one or NONE
    column: U1  # (·,) column of each entry of the matrix
    row_start: U1  # (N + 1,) entries of each row of the matrix
    lu: SparseLU  # order of elimination, where the matrix is sparse
    # The state to be found: y = base ∘ (turn + cq v̇ + correction), v = speed + cv v̇, x = state + cx ẋ
    base: F1  # (ny,)
    turn: F1  # (n,) [m or rad] change of the positions for v̇ = 0
    speed: F1  # (n,) velocities for v̇ = 0
    state: F1  # (S,) states of forces for ẋ = 0
    correction: F1  # (n,) [m or rad] further change that closes the positions
    rate: F1  # (S,) ẋ
    # work
    change: F1  # (n,) of the positions
    value: F1  # (·,) entries of the matrix
    L: F1  # its factors where it is sparse
    U: F1
    Dinv: F1
    work: F1
    matrix: P2  # (N, N) its factors where it is not, or (0, 0)
    pivot: U1  # (N,)
    b: F1  # (N,) right-hand side, then solution
    last: F1  # (max(N, 4),) work
    moved: F1  # (n,) solution for the positions
    before: F1  # (N,) the change before
    moved_before: F1  # (n,)
    lam: F1  # (K,) multipliers of the accepted state
    lam_before: F1  # (K,) those of the state before
    corners: F1  # [s] times at which functions of time have corners, ascending
    kept: F1  # (4,) cq, cv, cx that the factors are for (0: none), contraction seen with them
    # (4,) tolerance of a change as a share of the scales, most iterations, whether each iteration gets a new matrix; roundings between the
    # ground and a constraint, in units in the last place
    settings: F1
    balance: (
        RealFactors  # of the accelerations, see `nivel.kernels.residual.balance`; without numbers for most machines
    )
    filter: RealFactors  # of errors of chosen steps, see `nivel.integrate.newmark.alpha_step`; without numbers where none are
    balanced: F1  # (2,) 1 where it has factors; length of the machine [m], which turns are measured by
    asked: F1  # (3,) cq and cv of derivatives by hand, 1 where they are of `balance`; see `nivel.elements.beams.exact_slopes`
    # (1,) 3: positions are closed by the multipliers; 2: velocities are, and positions by a correction; 1: accelerations are; 0: of
    # independent coordinates all that depends on them is found from the constraints
    level: U1
    compliance: F1  # (K,) 1/α of penalty methods and of redundant machines; empty for multipliers
    diagonal: U1  # (K,) places of their -1/α in `value`
    shifted: Shifted
